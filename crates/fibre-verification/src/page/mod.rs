//! Pages: self-contained HTML, no script, no network, good on paper.

mod chart;
mod document;
mod polar;
mod report;
mod stability;

pub(crate) use chart::{Chart, Line};
pub(crate) use report::html as report_html;
pub(crate) use stability::html as stability_html;

/// Colours of the five lobes, which colour-blind eyes tell apart (Okabe and Ito 2008).
pub(crate) const LOBE_COLORS: [&str; 5] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00"];

/// A figure as tables show it: four digits, an exponent where it is needed.
pub(crate) fn figure(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !value.is_finite() {
        value.to_string()
    } else if (1e-3..1e5).contains(&size) {
        let digits = (3 - size.log10().floor() as i32).clamp(0, 6) as usize;
        format!("{value:.digits$}")
    } else {
        format!("{value:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::figure;

    #[test]
    fn figures_are_short() {
        for (value, shown) in [
            (0.0, "0"),
            (0.123456, "0.1235"),
            (1.0, "1.000"),
            (12345.6, "12346"),
            (2.5e-7, "2.50e-7"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(figure(value), shown);
        }
    }
}
