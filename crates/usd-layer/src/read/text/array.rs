//! Arrays in a text: found first, read when they are asked for.

use super::cursor::{Cursor, unescaped};
use super::numbers;
use crate::read::ReadError;
use crate::value::Storage;
use crate::{Array, Element, Name, Number, Scalar, Shape, Value};

/// The array at `[`, which is gone behind.
pub(super) fn find(cursor: &mut Cursor<'_>, element: Element) -> Result<Value, ReadError> {
    let start = cursor.at;
    cursor.expect(b'[', "an array in [ ]")?;
    let from = cursor.at;
    loop {
        let next =
            cursor.rest().iter().position(|&byte| matches!(byte, b']' | b'[' | b'"' | b'\'' | b'@' | b'#'));
        let Some(next) = next else { return Err(cursor.fault_at(start, "an array that ends with ]")) };
        cursor.at += next;
        match cursor.here() {
            Some(b']') => break,
            Some(b'[') => return Err(cursor.fault("an array without arrays in it")),
            Some(b'@') => drop(cursor.asset()?),
            Some(b'#') => cursor.skip(),
            _ => drop(cursor.string()?),
        }
    }
    let array = Array { element, storage: Storage::Text, start: from as u64, extent: cursor.at as u64 };
    cursor.at += 1;
    Ok(Value::Array(array))
}

/// A cursor at the start of the array that sees nothing behind its end.
fn inside<'a>(bytes: &'a [u8], array: &Array) -> Cursor<'a> {
    let end = (array.extent as usize).min(bytes.len());
    Cursor::new(&bytes[..end], array.start as usize)
}

/// The elements of an array of numbers.
pub(crate) fn numbers<T: Number, const N: usize>(
    bytes: &[u8],
    array: Array,
) -> Result<Vec<[T; N]>, ReadError> {
    let mut cursor = inside(bytes, &array);
    // At most one element a comma, and one after the last: for that many the bytes are there.
    let commas = cursor.rest().iter().filter(|&&byte| byte == b',').count();
    let mut elements = Vec::with_capacity((commas + 1).div_ceil(N));
    let scalar = array.element.scalar;
    loop {
        cursor.skip();
        if cursor.here().is_none() {
            return Ok(elements);
        }
        let mut element = [T::default(); N];
        match array.element.shape {
            Shape::Single => element[0] = number(&mut cursor, scalar)?,
            Shape::Matrix => {
                let side = N.isqrt().max(1);
                cursor.expect(b'(', "a matrix in ( )")?;
                for (place, row) in element.chunks_mut(side).enumerate() {
                    separate(&mut cursor, place)?;
                    tuple(&mut cursor, row, scalar)?;
                }
                cursor.expect(b')', "the end of a matrix, )")?;
            }
            Shape::Vector | Shape::Quaternion => tuple(&mut cursor, &mut element, scalar)?,
        }
        // With a lone comma at the end there is one more than elements, never fewer.
        elements.push(element);
        if !cursor.eat(b',') && cursor.here().is_some() {
            return Err(cursor.fault("`,` or the end of the array"));
        }
    }
}

fn separate(cursor: &mut Cursor<'_>, place: usize) -> Result<(), ReadError> {
    if place == 0 { Ok(()) } else { cursor.expect(b',', "`,` and another number") }
}

fn tuple<T: Number>(cursor: &mut Cursor<'_>, to: &mut [T], scalar: Scalar) -> Result<(), ReadError> {
    cursor.expect(b'(', "numbers in ( )")?;
    for (place, to) in to.iter_mut().enumerate() {
        separate(cursor, place)?;
        *to = number(cursor, scalar)?;
    }
    cursor.expect(b')', "`)` after as many numbers as the type has")
}

#[inline]
fn number<T: Number>(cursor: &mut Cursor<'_>, scalar: Scalar) -> Result<T, ReadError> {
    cursor.skip();
    if scalar.is_integer() {
        return match numbers::integer(cursor.rest()) {
            Some((value, len)) => {
                let read = T::from_integer(value).ok_or_else(|| cursor.fault("a number that fits"))?;
                cursor.at += len;
                Ok(read)
            }
            None => boolean(cursor).and_then(T::from_integer).ok_or_else(|| cursor.fault("a whole number")),
        };
    }
    let (value, len) = numbers::float(cursor.rest()).ok_or_else(|| cursor.fault("a number"))?;
    let read = T::from_float(numbers::rounded(value, scalar))
        .ok_or_else(|| cursor.fault("a type that holds fractions"))?;
    cursor.at += len;
    Ok(read)
}

fn boolean(cursor: &mut Cursor<'_>) -> Option<i64> {
    if cursor.eat_word(b"true") {
        return Some(1);
    }
    cursor.eat_word(b"false").then_some(0)
}

/// The elements of an array of texts.
pub(crate) fn texts(bytes: &[u8], array: Array) -> Result<Vec<Name>, ReadError> {
    let mut cursor = inside(bytes, &array);
    let mut texts = Vec::new();
    loop {
        cursor.skip();
        if cursor.here().is_none() {
            return Ok(texts);
        }
        let text: Name = match array.element.scalar {
            Scalar::Asset if cursor.here() == Some(b'@') => String::from_utf8_lossy(cursor.asset()?).into(),
            _ => unescaped(cursor.string()?).into(),
        };
        texts.push(text);
        if !cursor.eat(b',') && cursor.here().is_some() {
            return Err(cursor.fault("`,` or the end of the array"));
        }
    }
}
