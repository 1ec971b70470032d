//! Values in a text.

use std::sync::Arc;

use super::array;
use super::cursor::{Cursor, unescaped};
use super::numbers;
use super::parser::Parser;
use crate::read::ReadError;
use crate::{Element, ListOp, Name, Reference, Scalar, Shape, Tuple, Value};

/// Dictionaries, tuples and lists in each other beyond this are refused.
const DEEPEST: u32 = 32;

/// The value of an attribute of a type: `point3f[]`, `token`.
pub(super) fn typed(parser: &mut Parser<'_>, type_name: &str) -> Result<Value, ReadError> {
    let cursor = &mut parser.cursor;
    cursor.skip();
    if cursor.eat_word(b"None") || cursor.eat_word(b"AnimationBlock") {
        return Ok(Value::Blocked);
    }
    let (name, is_array) = type_name.strip_suffix("[]").map_or((type_name, false), |name| (name, true));
    let Some(element) = Element::from_type_name(name) else {
        untyped(parser, 0)?;
        return Ok(Value::Unsupported(type_name.into()));
    };
    if is_array {
        return array::find(cursor, element);
    }
    single(parser, element)
}

fn single(parser: &mut Parser<'_>, element: Element) -> Result<Value, ReadError> {
    let cursor = &mut parser.cursor;
    match element.scalar {
        Scalar::Asset => {
            cursor.skip();
            let text = if cursor.here() == Some(b'@') { cursor.asset()? } else { cursor.string()? };
            Ok(Value::Asset(parser.text(text)?))
        }
        Scalar::String => parser.string().map(Value::String),
        Scalar::Token => parser.string().map(Value::Token),
        Scalar::Bool if cursor.eat_word(b"true") || cursor.eat_word(b"True") => Ok(Value::Bool(true)),
        Scalar::Bool if cursor.eat_word(b"false") || cursor.eat_word(b"False") => Ok(Value::Bool(false)),
        _ if element.shape != Shape::Single => {
            let mut values = Vec::new();
            tuple(cursor, element, &mut values)?;
            parser.charge(8 * values.len())?;
            Ok(Value::Tuple(Arc::new(Tuple { element, values })))
        }
        Scalar::Bool => Ok(Value::Bool(float(cursor)? != 0.0)),
        scalar if scalar.is_integer() => match numbers::integer({
            cursor.skip();
            cursor.rest()
        }) {
            Some((value, len)) => {
                cursor.at += len;
                Ok(Value::Int(value))
            }
            None => float(cursor).map(Value::Float),
        },
        // As the file format's own reader: to 64 bits, then to the type's.
        scalar => Ok(Value::Float(numbers::rounded(float(cursor)?, scalar))),
    }
}

fn float(cursor: &mut Cursor<'_>) -> Result<f64, ReadError> {
    cursor.skip();
    let (value, len) = numbers::float(cursor.rest()).ok_or_else(|| cursor.fault("a number"))?;
    cursor.at += len;
    Ok(value)
}

/// Numbers in ( ), which for a matrix are rows in ( ).
fn tuple(cursor: &mut Cursor<'_>, element: Element, values: &mut Vec<f64>) -> Result<(), ReadError> {
    let components = usize::from(element.components);
    let row = if element.shape == Shape::Matrix { components.isqrt() } else { components };
    let rows = components / row;
    if rows > 1 {
        cursor.expect(b'(', "a matrix in ( )")?;
    }
    for place in 0..components {
        if place > 0 {
            cursor.expect(b',', "`,` and another number")?;
        }
        if place % row == 0 {
            cursor.expect(b'(', "numbers in ( )")?;
        }
        let value = float(cursor)?;
        values.push(numbers::rounded(value, element.scalar));
        if place % row == row - 1 {
            cursor.expect(b')', "`)` after as many numbers as the type has")?;
        }
    }
    if rows > 1 { cursor.expect(b')', "the end of a matrix, )") } else { Ok(()) }
}

/// A value whose type its looks tell: metadata.
pub(super) fn untyped(parser: &mut Parser<'_>, depth: u32) -> Result<Value, ReadError> {
    let cursor = &mut parser.cursor;
    cursor.skip();
    if depth > DEEPEST {
        return Err(cursor.fault("values fewer than 32 deep in each other"));
    }
    match cursor.here() {
        Some(b'"' | b'\'') => parser.string().map(Value::String),
        Some(b'@' | b'<') => reference(parser),
        Some(b'{') => dictionary(parser, depth),
        Some(b'[') => {
            cursor.at += 1;
            let items = items(parser, b']', depth)?;
            Ok(Value::List(Arc::new(ListOp { explicit: Some(items), ..ListOp::default() })))
        }
        Some(b'(') => {
            cursor.at += 1;
            let items = items(parser, b')', depth)?;
            let values: Vec<f64> = items.iter().filter_map(Value::components).flatten().collect();
            let components = values.len().min(usize::from(u8::MAX)) as u8;
            let element = Element::vector(Scalar::Double, components);
            Ok(Value::Tuple(Arc::new(Tuple { element, values })))
        }
        Some(b'-' | b'+' | b'.' | b'0'..=b'9') => {
            let rest = cursor.rest();
            let (value, len) = numbers::float(rest).ok_or_else(|| cursor.fault("a number"))?;
            let whole = numbers::integer(rest).filter(|&(_, digits)| digits == len);
            cursor.at += len;
            Ok(whole.map_or(Value::Float(value), |(whole, _)| Value::Int(whole)))
        }
        _ => {
            let at = cursor.at;
            match cursor.word() {
                b"None" => Ok(Value::Blocked),
                b"true" | b"True" => Ok(Value::Bool(true)),
                b"false" | b"False" => Ok(Value::Bool(false)),
                b"inf" => Ok(Value::Float(f64::INFINITY)),
                b"nan" => Ok(Value::Float(f64::NAN)),
                b"" => Err(cursor.fault_at(at, "a value")),
                word => parser.text(word).map(Value::Token),
            }
        }
    }
}

/// What is between brackets, up to `end`.
fn items(parser: &mut Parser<'_>, end: u8, depth: u32) -> Result<Vec<Value>, ReadError> {
    let mut items = Vec::new();
    loop {
        if parser.cursor.eat(end) {
            return Ok(items);
        }
        parser.charge(2 * size_of::<Value>())?;
        items.push(untyped(parser, depth + 1)?);
        if !parser.cursor.eat(b',') {
            parser.cursor.expect(end, "`,` or the closing bracket")?;
            return Ok(items);
        }
    }
}

/// `@asset@`, `@asset@<path>` or `<path>`, with what may be said of it in ( ).
fn reference(parser: &mut Parser<'_>) -> Result<Value, ReadError> {
    let asset = match parser.cursor.here() {
        Some(b'@') => {
            let text = parser.cursor.asset()?;
            Some(parser.text(text)?)
        }
        _ => None,
    };
    let path = match parser.cursor.here() {
        Some(b'<') => {
            let text = parser.cursor.path()?;
            Some(parser.text(text)?)
        }
        _ => None,
    };
    let mut ahead = parser.cursor;
    if asset.is_some() && ahead.eat(b'(') {
        // A layer offset or custom data, which nothing here follows.
        parser.cursor = ahead;
        parser.metadata_until_end(&mut Vec::new())?;
    }
    Ok(match (asset, path) {
        (Some(asset), Some(prim)) => Value::Reference(Arc::new(Reference { asset, prim })),
        (Some(asset), None) => Value::Asset(asset),
        (None, path) => Value::Path(path.unwrap_or_default()),
    })
}

/// `{ type name = value ... }`
pub(super) fn dictionary(parser: &mut Parser<'_>, depth: u32) -> Result<Value, ReadError> {
    parser.cursor.expect(b'{', "a dictionary in { }")?;
    if depth > DEEPEST {
        return Err(parser.cursor.fault("dictionaries fewer than 32 deep in each other"));
    }
    let mut entries = Vec::new();
    while !parser.cursor.eat(b'}') {
        let at = parser.cursor.at;
        let type_name = parser.type_name()?;
        if type_name.is_empty() {
            return Err(parser.cursor.fault_at(at, "a type, a name and a value, or `}`"));
        }
        parser.cursor.skip();
        let name = match parser.cursor.here() {
            Some(b'"' | b'\'') => parser.string()?,
            _ => {
                let word = parser.cursor.word();
                parser.name(word)?
            }
        };
        parser.cursor.expect(b'=', "`=` and a value")?;
        let value = match &*type_name {
            "dictionary" => dictionary(parser, depth + 1)?,
            _ => typed(parser, &type_name)?,
        };
        parser.charge(2 * size_of::<(Name, Value)>())?;
        entries.push((name, value));
        parser.cursor.eat(b',');
    }
    Ok(Value::Dictionary(entries.into()))
}

/// The text of a string in quotes.
pub(super) fn string(cursor: &mut Cursor<'_>) -> Result<String, ReadError> {
    cursor.string().map(unescaped)
}
