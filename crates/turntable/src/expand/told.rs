//! Faults of many variants, told once each.

use crate::Fault;

/// Faults and the variants that have them, in the order they were met.
#[derive(Default)]
pub(super) struct Told {
    faults: Vec<(Fault, Vec<String>)>,
    /// How many were told, those told again too: each takes time to be placed.
    count: usize,
}

/// As many faults, of as many variants, are enough.
const MOST: usize = 200;
const MOST_TOLD: usize = 2000;

impl Told {
    /// Adds faults of a variant.
    pub fn add(&mut self, id: &str, faults: impl IntoIterator<Item = Fault>) {
        for fault in faults {
            self.count += 1;
            if let Some((_, ids)) = self.faults.iter_mut().find(|(known, _)| *known == fault) {
                if ids.last().is_none_or(|last| last != id) {
                    ids.push(id.to_owned());
                }
            } else if self.faults.len() < MOST {
                self.faults.push((fault, vec![id.to_owned()]));
            }
        }
    }

    /// Whether more need not be looked for.
    pub fn is_enough(&self) -> bool {
        self.count >= MOST_TOLD
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
        self.faults.into_iter().map(named).collect()
    }
}
