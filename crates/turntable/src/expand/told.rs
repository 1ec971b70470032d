//! Faults of many variants, told once each.

use crate::Fault;

/// Faults and the variants that have them, in the order they were met.
#[derive(Default)]
pub(super) struct Told(Vec<(Fault, Vec<String>)>);

/// As many faults are enough.
const MOST: usize = 200;

impl Told {
    /// Adds faults of a variant.
    pub fn add(&mut self, id: &str, faults: impl IntoIterator<Item = Fault>) {
        for fault in faults {
            if let Some((_, ids)) = self.0.iter_mut().find(|(known, _)| *known == fault) {
                if ids.last().is_none_or(|last| last != id) {
                    ids.push(id.to_owned());
                }
            } else if self.0.len() < MOST {
                self.0.push((fault, vec![id.to_owned()]));
            }
        }
    }

    /// The faults; those that not all of `variants` have with the name of one that has them.
    pub fn faults(self, variants: usize) -> Vec<Fault> {
        let named = |(mut fault, ids): (Fault, Vec<String>)| {
            if let Some(first) = ids.first().filter(|_| ids.len() < variants) {
                let more = match ids.len() - 1 {
                    0 => String::new(),
                    more => format!(" and {more} more"),
                };
                fault.message += &format!(" (in `{first}`{more})");
            }
            fault
        };
        self.0.into_iter().map(named).collect()
    }
}
