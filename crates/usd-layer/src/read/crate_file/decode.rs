//! The elements of a crate's arrays.

use half::f16;

use super::bytes::Bytes;
use super::compression::{integers, too_much};
use crate::read::ReadError;
use crate::read::arrays::refuse_large;
use crate::read::budget::Budget;
use crate::{Array, Name, Number, Scalar};

/// Elements that are stored one after another.
pub(crate) fn plain<T: Number, const N: usize>(all: &[u8], array: Array) -> Result<Vec<[T; N]>, ReadError> {
    let len = array.extent.saturating_mul(array.element.size() as u64);
    let stored = Bytes::new(all, array.start).take(len, "an array")?;
    refuse_large(all.len(), array.start, array.extent, size_of::<[T; N]>())?;
    // Zeroes from the system cost nothing until they are written over.
    let mut elements = bytemuck::allocation::try_zeroed_vec::<[T; N]>(array.extent as usize)
        .map_err(|()| too_much(array.start, len, "an array"))?;
    if T::SCALAR == array.element.scalar {
        bytemuck::cast_slice_mut(&mut elements).copy_from_slice(stored);
        return Ok(elements);
    }
    let scalar = array.element.scalar;
    let components = elements.as_flattened_mut().iter_mut();
    for (place, (to, from)) in components.zip(stored.chunks_exact(scalar.size())).enumerate() {
        let number = if scalar.is_integer() {
            T::from_integer(integer(scalar, from))
        } else {
            T::from_float(float(from))
        };
        *to =
            number.ok_or_else(|| misfit(array.start + (place * scalar.size()) as u64, scalar, T::SCALAR))?;
    }
    Ok(elements)
}

/// Numbers that are stored as compressed differences, directly or as indices of a table.
pub(crate) fn compressed<T: Number>(
    all: &[u8],
    array: Array,
    budget: &mut Budget,
) -> Result<Vec<T>, ReadError> {
    let mut bytes = Bytes::new(all, array.start);
    let count = usize::try_from(array.extent).ok().filter(|&count| count <= u32::MAX as usize);
    let size = array.extent.saturating_mul(size_of::<T>() as u64);
    let count = count.ok_or_else(|| too_much(array.start, size, "an array"))?;
    budget.take(size, || too_much(array.start, size, "an array"))?;
    let scalar = array.element.scalar;
    let whole = |value: i64| T::from_integer(value).ok_or_else(|| misfit(array.start, scalar, T::SCALAR));
    match scalar {
        Scalar::Int => integers::<i32>(&mut bytes, count, budget, "numbers")?
            .into_iter()
            .map(|v| whole(v.into()))
            .collect(),
        Scalar::UInt => {
            let values = integers::<i32>(&mut bytes, count, budget, "numbers")?;
            values.into_iter().map(|value| whole((value as u32).into())).collect()
        }
        Scalar::Int64 | Scalar::UInt64 => {
            integers::<i64>(&mut bytes, count, budget, "numbers")?.into_iter().map(whole).collect()
        }
        _ => floats(&mut bytes, array, count, budget),
    }
}

fn floats<T: Number>(
    bytes: &mut Bytes<'_>,
    array: Array,
    count: usize,
    budget: &mut Budget,
) -> Result<Vec<T>, ReadError> {
    let at = bytes.at;
    let scalar = array.element.scalar;
    let number = |value: f64| T::from_float(value).ok_or_else(|| misfit(at, scalar, T::SCALAR));
    match bytes.u8("how numbers are compressed")? {
        b'i' => {
            let values = integers::<i32>(bytes, count, budget, "numbers")?;
            values.into_iter().map(|value| number(value.into())).collect()
        }
        b't' => {
            let size = bytes.u32("the size of a table")?;
            let stored = bytes.take(u64::from(size) * scalar.size() as u64, "a table of numbers")?;
            let cost = u64::from(size) * size_of::<T>() as u64;
            budget.take(cost, || too_much(at, cost, "a table"))?;
            let table = stored.chunks_exact(scalar.size()).map(|from| number(float(from)));
            let table = table.collect::<Result<Vec<T>, _>>()?;
            let places = integers::<i32>(bytes, count, budget, "places in a table")?;
            let look = |place: i32| {
                table.get(place as u32 as usize).copied().ok_or_else(|| {
                    ReadError::byte(at, format!("place {place} in a table"), format!("one of {size}"))
                })
            };
            places.into_iter().map(look).collect()
        }
        other => {
            Err(ReadError::byte(at, format!("compression {other}"), "105 (whole numbers) or 116 (a table)"))
        }
    }
}

/// Texts that are stored as indices of tokens or strings.
pub(crate) fn texts(
    all: &[u8],
    array: Array,
    tokens: &[Name],
    strings: &[u32],
) -> Result<Vec<Name>, ReadError> {
    refuse_large(all.len(), array.start, array.extent, size_of::<Name>())?;
    let stored = Bytes::new(all, array.start).take(array.extent.saturating_mul(4), "an array")?;
    let look = |bytes: &[u8; 4]| {
        let index = u32::from_le_bytes(*bytes);
        let token = match array.element.scalar {
            Scalar::Token => Some(index),
            _ => strings.get(index as usize).copied(),
        };
        let text = token.and_then(|token| tokens.get(token as usize)).cloned();
        text.ok_or_else(|| ReadError::byte(array.start, format!("text {index}"), "one of the file's texts"))
    };
    stored.as_chunks::<4>().0.iter().map(look).collect()
}

fn float(bytes: &[u8]) -> f64 {
    match *bytes {
        [a, b] => f16::from_le_bytes([a, b]).into(),
        [a, b, c, d] => f32::from_le_bytes([a, b, c, d]).into(),
        [a, b, c, d, e, f, g, h] => f64::from_le_bytes([a, b, c, d, e, f, g, h]),
        _ => 0.0,
    }
}

fn integer(scalar: Scalar, bytes: &[u8]) -> i64 {
    match (scalar, bytes) {
        (_, &[a]) => a.into(),
        (Scalar::UInt, &[a, b, c, d]) => u32::from_le_bytes([a, b, c, d]).into(),
        (_, &[a, b, c, d]) => i32::from_le_bytes([a, b, c, d]).into(),
        (_, &[a, b, c, d, e, f, g, h]) => i64::from_le_bytes([a, b, c, d, e, f, g, h]),
        _ => 0,
    }
}

fn misfit(at: u64, from: Scalar, to: Scalar) -> ReadError {
    ReadError::byte(at, format!("a number of type {from:?}"), format!("one that fits {to:?}"))
}
