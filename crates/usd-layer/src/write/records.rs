//! Specs: what the layer says of each path, as fields.

use std::collections::HashMap;

use crate::write::Stored;

/// What stands at a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum SpecKind {
    Attribute = 1,
    Prim = 6,
    Layer = 7,
    Relationship = 8,
}

/// A field: the token of its name, and its value.
pub(super) type Field = (u32, Stored);

/// The specs of a layer and their fields, each field and each set of fields stored once.
#[derive(Debug, Default)]
pub(super) struct Records {
    field_numbers: HashMap<Field, u32>,
    pub fields: Vec<Field>,
    set_starts: HashMap<Vec<u32>, u32>,
    /// Numbers of fields; [`END`] ends a set.
    pub sets: Vec<u32>,
    /// Path, start of the set of fields, kind.
    pub specs: Vec<(u32, u32, SpecKind)>,
}

/// Ends a set of fields.
const END: u32 = u32::MAX;

impl Records {
    pub fn spec(&mut self, path: u32, kind: SpecKind, fields: &[Field]) {
        let numbers: Vec<u32> = fields.iter().map(|&field| self.field(field)).collect();
        let start = *self.set_starts.entry(numbers).or_insert_with_key(|numbers| {
            let start = self.sets.len() as u32;
            self.sets.extend(numbers);
            self.sets.push(END);
            start
        });
        self.specs.push((path, start, kind));
    }

    fn field(&mut self, field: Field) -> u32 {
        let next = self.fields.len() as u32;
        let number = *self.field_numbers.entry(field).or_insert(next);
        if number == next {
            self.fields.push(field);
        }
        number
    }
}
