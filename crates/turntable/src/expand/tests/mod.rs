mod hostile;
mod laws;
mod matrix;
mod reading;

use super::*;

const GOOD: &str = "version: 1\ngroom: {sample: {}}\nlights: {environment: {studio: true}}\n";

fn good(more: &str) -> Vec<Variant> {
    of_text(&format!("{GOOD}{more}"), &[]).unwrap_or_else(|faults| panic!("{faults:#?}"))
}

fn told(more: &str) -> Vec<String> {
    words(of_text(&format!("{GOOD}{more}"), &[]))
}

fn words(result: Result<Vec<Variant>, Vec<Fault>>) -> Vec<String> {
    result.unwrap_err().iter().map(ToString::to_string).collect()
}

fn ids(variants: &[Variant]) -> Vec<&str> {
    variants.iter().map(|variant| variant.id.as_str()).collect()
}
