//! The structural sections behind the values, the table of contents, and the head of the file.

use std::io::{Seek, Write};

use crate::write::WriteError;
use crate::write::compress::compress;
use crate::write::heap::Heap;
use crate::write::integers::{pack, pack_unsigned};
use crate::write::paths::Paths;
use crate::write::records::Records;
use crate::write::tokens::Tokens;

/// Bytes of the head: magic, version, place of the table of contents, room for later versions.
pub(super) const HEAD: usize = 88;
const VERSION: [u8; 8] = [0, 8, 0, 0, 0, 0, 0, 0];
const NAME: usize = 16;

/// Writes all that is not values; returns the head, which belongs at the start.
pub(super) fn write<W: Write + Seek>(
    heap: &mut Heap<W>,
    tokens: &mut Tokens,
    paths: &Paths,
    records: &Records,
) -> Result<[u8; HEAD], WriteError> {
    let tree = paths.flatten(tokens);
    let mut table = Table { heap, entries: Vec::new() };

    let mut body = number(tokens.len());
    body.extend(number(tokens.text.len()));
    sized(&mut body, compress(&tokens.text)?);
    table.section("TOKENS", &body)?;

    let mut body = number(tokens.strings.len());
    body.extend(tokens.strings.iter().flat_map(|token| token.to_le_bytes()));
    table.section("STRINGS", &body)?;

    let mut body = number(records.fields.len());
    sized(&mut body, pack_unsigned(records.fields.iter().map(|&(name, _)| name))?);
    let values: Vec<u8> = records.fields.iter().flat_map(|(_, value)| value.0.to_le_bytes()).collect();
    sized(&mut body, compress(&values)?);
    table.section("FIELDS", &body)?;

    let mut body = number(records.sets.len());
    sized(&mut body, pack_unsigned(records.sets.iter().copied())?);
    table.section("FIELDSETS", &body)?;

    let mut body = number(paths.len());
    body.extend(number(tree.paths.len()));
    for column in [&tree.paths, &tree.names, &tree.jumps] {
        sized(&mut body, pack(column.iter().copied())?);
    }
    table.section("PATHS", &body)?;

    let mut body = number(records.specs.len());
    sized(&mut body, pack_unsigned(records.specs.iter().map(|&(path, ..)| path))?);
    sized(&mut body, pack_unsigned(records.specs.iter().map(|&(_, set, _)| set))?);
    sized(&mut body, pack_unsigned(records.specs.iter().map(|&(.., kind)| kind as u32))?);
    table.section("SPECS", &body)?;
    table.finish()
}

/// The sections so far: name, start, length.
struct Table<'a, W> {
    heap: &'a mut Heap<W>,
    entries: Vec<(&'static str, u64, u64)>,
}

impl<W: Write + Seek> Table<'_, W> {
    fn section(&mut self, name: &'static str, body: &[u8]) -> Result<(), WriteError> {
        let start = self.heap.align()?;
        self.heap.write(body)?;
        self.entries.push((name, start, body.len() as u64));
        Ok(())
    }

    fn finish(self) -> Result<[u8; HEAD], WriteError> {
        let place = self.heap.align()?;
        let mut body = number(self.entries.len());
        for (name, start, length) in self.entries {
            let mut padded = [0; NAME];
            padded[..name.len()].copy_from_slice(name.as_bytes());
            body.extend(padded);
            body.extend(start.to_le_bytes());
            body.extend(length.to_le_bytes());
        }
        self.heap.write(&body)?;
        let mut head = [0; HEAD];
        head[..8].copy_from_slice(b"PXR-USDC");
        head[8..16].copy_from_slice(&VERSION);
        head[16..24].copy_from_slice(&place.to_le_bytes());
        Ok(head)
    }
}

fn number(count: usize) -> Vec<u8> {
    (count as u64).to_le_bytes().to_vec()
}

fn sized(body: &mut Vec<u8>, bytes: Vec<u8>) {
    body.extend(number(bytes.len()));
    body.extend(bytes);
}
