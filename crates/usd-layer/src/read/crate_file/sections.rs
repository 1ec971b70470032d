//! The header, the table of contents and the sections that are lists of numbers.

use std::sync::Arc;

use super::bytes::Bytes;
use super::compression::{block, integers, too_much};
use crate::Name;
use crate::read::ReadError;
use crate::read::budget::Budget;

/// The oldest and newest layout that is understood.
const OLDEST: Version = Version(0, 4, 0);
const NEWEST: Version = Version(0, 13, u8::MAX);

/// A crate's version.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Version(pub(crate) u8, pub(crate) u8, pub(crate) u8);

/// A field: a name and a value.
#[derive(Clone, Copy)]
pub(super) struct Field {
    pub(super) name: u32,
    pub(super) value: u64,
}

/// A spec: a path, the first of its fields' indices, and what it is.
#[derive(Clone, Copy)]
pub(super) struct Spec {
    pub(super) path: u32,
    pub(super) fields: u32,
    pub(super) kind: u32,
}

/// Everything but the values.
pub(super) struct Sections {
    pub(super) version: Version,
    pub(super) tokens: Vec<Name>,
    pub(super) strings: Vec<u32>,
    pub(super) fields: Vec<Field>,
    pub(super) field_sets: Vec<u32>,
    pub(super) paths: EncodedPaths,
    pub(super) specs: Vec<Spec>,
}

/// The tree of paths as it is stored; [`super::paths`] says how.
pub(super) struct EncodedPaths {
    pub(super) at: u64,
    pub(super) count: usize,
    pub(super) indices: Vec<u32>,
    pub(super) elements: Vec<i32>,
    pub(super) jumps: Vec<i32>,
}

pub(super) fn version(all: &[u8]) -> Result<(Version, u64), ReadError> {
    let mut bytes = Bytes::new(all, 0);
    let magic = bytes.take(8, "the magic PXR-USDC")?;
    if magic != b"PXR-USDC" {
        return Err(ReadError::byte(0, crate::read::error::quoted(magic), "the magic PXR-USDC"));
    }
    let version = bytes.take(8, "the version")?;
    let version = Version(version[0], version[1], version[2]);
    if !(OLDEST..=NEWEST).contains(&version) {
        let Version(a, b, c) = version;
        let expected = format!("0.{}.0 to 0.{}", OLDEST.1, NEWEST.1);
        return Err(ReadError::byte(8, format!("crate version {a}.{b}.{c}"), expected));
    }
    let at = bytes.at;
    let contents = bytes.u64("the place of the table of contents")?;
    if contents >= all.len() as u64 {
        let found = format!("a table of contents at byte {contents}");
        return Err(ReadError::byte(at, found, format!("one before the end, {}", all.len())));
    }
    Ok((version, contents))
}

pub(super) fn read(all: &[u8], budget: &mut Budget) -> Result<Sections, ReadError> {
    let (version, contents) = version(all)?;
    let mut table = Bytes::new(all, contents);
    let count = table.count(32, "sections")?;
    let find = |name: &str| -> Result<Bytes<'_>, ReadError> {
        let mut entry = Bytes::new(all, contents + 8);
        for _ in 0..count {
            let found = entry.take(16, "a section's name")?;
            let at = entry.at;
            let (start, size) = (entry.u64("a section's place")?, entry.u64("a section's size")?);
            if found.split(|&byte| byte == 0).next() != Some(name.as_bytes()) {
                continue;
            }
            let end = start.checked_add(size).filter(|&end| end <= all.len() as u64);
            let Some(end) = end else {
                let found = format!("{name} at byte {start}, {size} long");
                return Err(ReadError::byte(at, found, format!("a section before the end, {}", all.len())));
            };
            return Ok(Bytes::new(&all[..end as usize], start));
        }
        Err(ReadError::byte(contents, format!("no section {name}"), "one"))
    };
    let tokens = tokens(find("TOKENS")?, budget)?;
    let strings = strings(find("STRINGS")?, tokens.len(), budget)?;
    let fields = fields(find("FIELDS")?, tokens.len(), budget)?;
    let field_sets = field_sets(find("FIELDSETS")?, budget)?;
    let paths = paths(find("PATHS")?, budget)?;
    let specs = specs(find("SPECS")?, budget)?;
    Ok(Sections { version, tokens, strings, fields, field_sets, paths, specs })
}

fn tokens(mut bytes: Bytes<'_>, budget: &mut Budget) -> Result<Vec<Name>, ReadError> {
    let at = bytes.at;
    let count = bytes.u64("tokens")?;
    let size = bytes.u64("bytes of tokens")?;
    let text = block(&mut bytes, size, true, budget, "tokens")?;
    if count > size {
        return Err(ReadError::byte(at, format!("{count} tokens in {size} bytes"), "a byte a token or more"));
    }
    // A shared name costs its text, two counts and the pointer to it.
    let cost = size + count * 32;
    budget.take(cost, || too_much(at, cost, "tokens"))?;
    let mut tokens = Vec::with_capacity(count as usize);
    for token in text.split(|&byte| byte == 0).take(count as usize) {
        tokens.push(Arc::from(String::from_utf8_lossy(token)));
    }
    let ends = text.iter().filter(|&&byte| byte == 0).count() as u64;
    if ends != count {
        return Err(ReadError::byte(at, format!("{ends} tokens"), count.to_string()));
    }
    Ok(tokens)
}

fn strings(mut bytes: Bytes<'_>, tokens: usize, budget: &mut Budget) -> Result<Vec<u32>, ReadError> {
    let count = bytes.count(4, "strings")?;
    let at = bytes.at;
    budget.take(4 * count as u64, || too_much(at, 4 * count as u64, "strings"))?;
    let stored = bytes.take(4 * count as u64, "strings")?;
    let strings: Vec<u32> =
        stored.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    match strings.iter().find(|&&token| token as usize >= tokens) {
        Some(token) => Err(ReadError::byte(at, format!("token {token}"), format!("one of {tokens}"))),
        None => Ok(strings),
    }
}

fn fields(mut bytes: Bytes<'_>, tokens: usize, budget: &mut Budget) -> Result<Vec<Field>, ReadError> {
    let at = bytes.at;
    let count = claimed(&mut bytes, "fields")?;
    let names: Vec<i32> = integers(&mut bytes, count, budget, "fields")?;
    let values = block(&mut bytes, 8 * count as u64, true, budget, "values")?;
    budget.take(16 * count as u64, || too_much(at, 16 * count as u64, "fields"))?;
    if let Some(name) = names.iter().find(|&&name| name as u32 as usize >= tokens) {
        return Err(ReadError::byte(at, format!("token {name}"), format!("one of {tokens}")));
    }
    let values = values.as_chunks::<8>().0.iter().map(|&value| u64::from_le_bytes(value));
    Ok(names.iter().zip(values).map(|(&name, value)| Field { name: name as u32, value }).collect())
}

fn field_sets(mut bytes: Bytes<'_>, budget: &mut Budget) -> Result<Vec<u32>, ReadError> {
    let count = claimed(&mut bytes, "fields of specs")?;
    Ok(unsigned(integers(&mut bytes, count, budget, "fields of specs")?))
}

fn paths(mut bytes: Bytes<'_>, budget: &mut Budget) -> Result<EncodedPaths, ReadError> {
    let at = bytes.at;
    let count = claimed(&mut bytes, "paths")?;
    let stored = claimed(&mut bytes, "stored paths")?;
    if stored > count {
        return Err(ReadError::byte(at + 8, format!("{stored} stored paths"), format!("{count} at most")));
    }
    let indices = unsigned(integers(&mut bytes, stored, budget, "paths")?);
    let elements = integers(&mut bytes, stored, budget, "names of paths")?;
    let jumps = integers(&mut bytes, stored, budget, "jumps between paths")?;
    Ok(EncodedPaths { at, count, indices, elements, jumps })
}

fn specs(mut bytes: Bytes<'_>, budget: &mut Budget) -> Result<Vec<Spec>, ReadError> {
    let at = bytes.at;
    let count = claimed(&mut bytes, "specs")?;
    let paths: Vec<i32> = integers(&mut bytes, count, budget, "paths of specs")?;
    let sets: Vec<i32> = integers(&mut bytes, count, budget, "fields of specs")?;
    let kinds: Vec<i32> = integers(&mut bytes, count, budget, "kinds of specs")?;
    budget.take(12 * count as u64, || too_much(at, 12 * count as u64, "specs"))?;
    let spec = |((&path, &fields), &kind): ((&i32, &i32), &i32)| Spec {
        path: path as u32,
        fields: fields as u32,
        kind: kind as u32,
    };
    Ok(paths.iter().zip(&sets).zip(&kinds).map(spec).collect())
}

fn unsigned(values: Vec<i32>) -> Vec<u32> {
    values.into_iter().map(|value| value as u32).collect()
}

/// A count of compressed things: what it takes is checked when they are unpacked.
fn claimed(bytes: &mut Bytes<'_>, what: &str) -> Result<usize, ReadError> {
    let at = bytes.at;
    let count = bytes.u64(what)?;
    match u32::try_from(count) {
        Ok(count) => Ok(count as usize),
        Err(_) => Err(ReadError::byte(at, format!("{count} {what}"), "no more than 32 bits can count")),
    }
}
