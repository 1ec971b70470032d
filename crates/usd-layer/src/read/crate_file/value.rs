//! From the 64 bits that stand for a value to the value: OpenUSD's `crateFile.cpp` and `crateDataTypes.h`.
//!
//! Bit 63 is an array, 62 a value in the bits themselves, 61 a compressed one; bits 48 to 55 are the type, the
//! 48 bits below a place in the file or the value.

use std::sync::Arc;

use half::f16;

use super::bytes::Bytes;
use super::compression::too_much;
use super::paths::Paths;
use super::sections::{Sections, Version};
use super::types::{self, Kind};
use crate::layer::Samples;
use crate::read::ReadError;
use crate::read::budget::Budget;
use crate::value::Storage;
use crate::{Array, Element, ListOp, Name, Reference, Scalar, Shape, Tuple, Value};

/// Dictionaries in dictionaries beyond this are refused.
const DEEPEST: u32 = 32;

/// Shorter arrays are never compressed, whatever their bits say.
const SHORTEST_COMPRESSED: u64 = 16;

/// What values are read from.
pub(super) struct Source<'a> {
    pub(super) all: &'a [u8],
    pub(super) sections: &'a Sections,
    pub(super) paths: &'a Paths,
}

/// A value's 64 bits.
#[derive(Clone, Copy)]
struct Bits(u64);

impl Bits {
    fn is_array(self) -> bool {
        self.0 >> 63 != 0
    }
    fn is_inlined(self) -> bool {
        self.0 >> 62 & 1 != 0
    }
    fn is_compressed(self) -> bool {
        self.0 >> 61 & 1 != 0
    }
    fn kind(self) -> u8 {
        (self.0 >> 48) as u8
    }
    fn payload(self) -> u64 {
        self.0 & ((1 << 48) - 1)
    }
}

/// What a field can be beside a value.
#[derive(Clone)]
pub(super) enum FieldValue {
    Value(Value),
    Samples(Arc<Samples>),
}

impl<'a> Source<'a> {
    fn at(&self, place: u64) -> Bytes<'a> {
        Bytes::new(self.all, place)
    }

    /// The value of a field, which may be one at times.
    pub(super) fn field(&self, bits: u64, budget: &mut Budget) -> Result<FieldValue, ReadError> {
        match types::kind(Bits(bits).kind()) {
            Kind::TimeSamples if !Bits(bits).is_inlined() => {
                Ok(FieldValue::Samples(Arc::new(self.samples(Bits(bits), budget)?)))
            }
            _ => Ok(FieldValue::Value(self.value(bits, 0, budget)?)),
        }
    }

    pub(super) fn value(&self, bits: u64, depth: u32, budget: &mut Budget) -> Result<Value, ReadError> {
        let bits = Bits(bits);
        let at = bits.payload();
        let mut bytes = self.at(at);
        Ok(match types::kind(bits.kind()) {
            Kind::Element(element) if bits.is_array() => self.array(element, bits)?,
            Kind::Element(element) => self.single(element, bits)?,
            Kind::Dictionary if bits.is_inlined() => Value::Dictionary(Arc::new([])),
            Kind::Dictionary => self.dictionary(bytes, depth, budget)?,
            Kind::ListOp(item) => self.list_op(item, bits, budget)?,
            Kind::Vector(item) => {
                let explicit = Some(self.items(item, &mut bytes, budget)?);
                Value::List(Arc::new(ListOp { explicit, ..ListOp::default() }))
            }
            Kind::DoubleVector => {
                let count = bytes.count(8, "numbers")? as u64;
                let element = Element::single(Scalar::Double);
                Value::Array(Array { element, storage: Storage::Plain, start: bytes.at, extent: count })
            }
            Kind::Payload => {
                let payload = self.item(types::Item::Payload, &mut bytes, budget)?;
                Value::List(Arc::new(ListOp { explicit: Some(vec![payload]), ..ListOp::default() }))
            }
            Kind::Specifier => choice(&["def", "over", "class"], at),
            Kind::Variability => choice(&["varying", "uniform", "config"], at),
            Kind::Permission => choice(&["public", "private"], at),
            Kind::VariantSelection => self.variant_selection(bytes, budget)?,
            Kind::Blocked => Value::Blocked,
            Kind::Wrapped if depth < DEEPEST => {
                let inner = bytes.jump("a value")?.u64("a value")?;
                self.value(inner, depth + 1, budget)?
            }
            Kind::Wrapped => return Err(deep(at)),
            Kind::TimeSamples => Value::Unsupported("TimeSamples".into()),
            Kind::Unsupported(name) => Value::Unsupported(name.into()),
        })
    }

    fn array(&self, element: Element, bits: Bits) -> Result<Value, ReadError> {
        let version = self.sections.version;
        let empty = Array { element, storage: Storage::Plain, start: 0, extent: 0 };
        if bits.payload() == 0 {
            return Ok(Value::Array(empty));
        }
        let mut bytes = self.at(bits.payload());
        if version < Version(0, 5, 0) {
            bytes.u32("the rank of an array")?;
        }
        let at = bytes.at;
        let count = if version < Version(0, 7, 0) {
            u64::from(bytes.u32("the size of an array")?)
        } else {
            bytes.u64("the size of an array")?
        };
        let integer = matches!(element.scalar, Scalar::Int | Scalar::UInt | Scalar::Int64 | Scalar::UInt64);
        let since = if integer { Version(0, 5, 0) } else { Version(0, 6, 0) };
        let float = matches!(element.scalar, Scalar::Half | Scalar::Float | Scalar::Double);
        let compressible = element.shape == Shape::Single && (integer || float) && version >= since;
        let compressed = bits.is_compressed() && compressible && count >= SHORTEST_COMPRESSED;
        if compressed {
            let array = Array { element, storage: Storage::Compressed, start: bytes.at, extent: count };
            return Ok(Value::Array(array));
        }
        if count.checked_mul(element.size() as u64).is_none_or(|size| size > bytes.left()) {
            let expected =
                format!("{} at most, as the file ends there", bytes.left() / element.size() as u64);
            return Err(ReadError::byte(at, format!("an array of {count} elements"), expected));
        }
        Ok(Value::Array(Array { element, storage: Storage::Plain, start: bytes.at, extent: count }))
    }

    fn single(&self, element: Element, bits: Bits) -> Result<Value, ReadError> {
        let inline = (bits.payload() as u32).to_le_bytes();
        let mut bytes = if bits.is_inlined() { Bytes::new(&inline, 0) } else { self.at(bits.payload()) };
        if element.scalar.is_text() {
            let index = bytes.u32("a text")?;
            // An asset path in the bits is a token, one in the file a string.
            let is_string =
                element.scalar == Scalar::String || (element.scalar == Scalar::Asset && !bits.is_inlined());
            let text = if is_string {
                self.string(index, bits.payload())?
            } else {
                self.token(index, bits.payload())?
            };
            return Ok(match element.scalar {
                Scalar::String => Value::String(text),
                Scalar::Token => Value::Token(text),
                _ => Value::Asset(text),
            });
        }
        if element.shape == Shape::Single {
            return single_number(element.scalar, bits, &mut bytes);
        }
        let mut values = inlined_tuple(element, bits, inline).map_or_else(
            || {
                (0..element.components)
                    .map(|_| component(element.scalar, &mut bytes))
                    .collect::<Result<Vec<_>, _>>()
            },
            Ok,
        )?;
        if element.shape == Shape::Quaternion {
            values.rotate_right(1);
        }
        Ok(Value::Tuple(Arc::new(Tuple { element, values })))
    }

    fn dictionary(&self, mut bytes: Bytes<'a>, depth: u32, budget: &mut Budget) -> Result<Value, ReadError> {
        let at = bytes.at;
        if depth >= DEEPEST {
            return Err(deep(at));
        }
        // A name, a jump and, behind it, the value.
        let count = bytes.count(12, "entries of a dictionary")?;
        charge(budget, at, count, size_of::<(Name, Value)>())?;
        let mut entries = Vec::with_capacity(count);
        for _ in 0..count {
            let name = self.string(bytes.u32("a name")?, bytes.at)?;
            let mut value = bytes.jump("a value")?;
            let bits = value.u64("a value")?;
            // The next entry follows the 64 bits of this one's value.
            bytes.at = value.at;
            entries.push((name, self.value(bits, depth + 1, budget)?));
        }
        Ok(Value::Dictionary(entries.into()))
    }

    fn samples(&self, bits: Bits, budget: &mut Budget) -> Result<Samples, ReadError> {
        let mut bytes = self.at(bits.payload());
        let mut place = bytes.jump("times")?;
        let at = place.at;
        let times = self.value(place.u64("times")?, 0, budget)?;
        let Value::Array(Array { element, storage: Storage::Plain, start, extent }) = times else {
            return Err(ReadError::byte(at, "times that are no plain numbers", "an array of doubles"));
        };
        if element != Element::single(Scalar::Double) {
            return Err(ReadError::byte(at, "times that are no doubles", "an array of doubles"));
        }
        bytes.at = place.at;
        let mut values = bytes.jump("samples")?;
        let at = values.at;
        let count = values.count(8, "samples")?;
        if count as u64 != extent {
            return Err(ReadError::byte(at, format!("{count} samples at {extent} times"), "one a time"));
        }
        charge(budget, at, count, 8 + size_of::<Value>())?;
        let mut times = self.at(start);
        let mut samples = Samples { times: Vec::with_capacity(count), values: Vec::with_capacity(count) };
        for _ in 0..count {
            let at = times.at;
            let time = times.f64("a time")?;
            if samples
                .times
                .last()
                .is_some_and(|&last| last.partial_cmp(&time) != Some(std::cmp::Ordering::Less))
            {
                return Err(ReadError::byte(at, format!("time {time} out of order"), "rising times"));
            }
            samples.times.push(time);
            samples.values.push(self.value(values.u64("a sample")?, 0, budget)?);
        }
        Ok(samples)
    }

    fn list_op(&self, item: types::Item, bits: Bits, budget: &mut Budget) -> Result<Value, ReadError> {
        let mut bytes = self.at(bits.payload());
        let header = bytes.u8("a list's header")?;
        let mut part = |bit: u8, budget: &mut Budget| match header >> bit & 1 {
            0 => Ok(Vec::new()),
            _ => self.items(item, &mut bytes, budget),
        };
        let explicit = part(1, budget)?;
        let list = ListOp {
            explicit: (header & 1 != 0).then_some(explicit),
            added: part(2, budget)?,
            prepended: part(5, budget)?,
            appended: part(6, budget)?,
            deleted: part(3, budget)?,
            ordered: part(4, budget)?,
        };
        Ok(Value::List(Arc::new(list)))
    }

    fn items(
        &self,
        item: types::Item,
        bytes: &mut Bytes<'a>,
        budget: &mut Budget,
    ) -> Result<Vec<Value>, ReadError> {
        let at = bytes.at;
        let count = bytes.count(item.least(), "items of a list")?;
        charge(budget, at, count, size_of::<Value>())?;
        let mut items = Vec::with_capacity(count);
        for _ in 0..count {
            items.push(self.item(item, bytes, budget)?);
        }
        Ok(items)
    }

    fn item(
        &self,
        item: types::Item,
        bytes: &mut Bytes<'a>,
        budget: &mut Budget,
    ) -> Result<Value, ReadError> {
        use types::Item;
        let at = bytes.at;
        Ok(match item {
            Item::Token => Value::Token(self.token(bytes.u32("a token")?, at)?),
            Item::String => Value::String(self.string(bytes.u32("a string")?, at)?),
            Item::Path => Value::Path(self.path(bytes.u32("a path")?, at, budget)?),
            Item::Int => Value::Int(bytes.i32("a number")?.into()),
            Item::UInt => Value::Int(bytes.u32("a number")?.into()),
            Item::Int64 | Item::UInt64 => Value::Int(bytes.u64("a number")? as i64),
            Item::LayerOffset => {
                let values = vec![bytes.f64("an offset")?, bytes.f64("a scale")?];
                Value::Tuple(Arc::new(Tuple { element: Element::vector(Scalar::Double, 2), values }))
            }
            Item::Payload | Item::Reference => {
                let asset = self.string(bytes.u32("an asset")?, at)?;
                let prim = bytes.u32("a path")?;
                // The root stands for the default prim.
                let prim = self.path(prim, at, budget)?;
                let prim = if &*prim == "/" { Name::from("") } else { prim };
                if item == Item::Reference || self.sections.version >= Version(0, 8, 0) {
                    bytes.take(16, "a layer offset")?;
                }
                if item == Item::Reference {
                    self.skip_dictionary(bytes, budget)?;
                }
                Value::Reference(Arc::new(Reference { asset, prim }))
            }
        })
    }

    /// Goes behind the custom data of a reference.
    fn skip_dictionary(&self, bytes: &mut Bytes<'a>, budget: &mut Budget) -> Result<(), ReadError> {
        let at = bytes.at;
        let count = bytes.count(12, "entries of a dictionary")?;
        charge(budget, at, count, 1)?;
        for _ in 0..count {
            bytes.u32("a name")?;
            let mut value = bytes.jump("a value")?;
            value.u64("a value")?;
            bytes.at = value.at;
        }
        Ok(())
    }

    fn variant_selection(&self, mut bytes: Bytes<'a>, budget: &mut Budget) -> Result<Value, ReadError> {
        let at = bytes.at;
        let count = bytes.count(8, "variant selections")?;
        charge(budget, at, count, size_of::<(Name, Value)>())?;
        let mut entries = Vec::with_capacity(count);
        for _ in 0..count {
            let name = self.string(bytes.u32("a variant set")?, at)?;
            entries.push((name, Value::String(self.string(bytes.u32("a variant")?, at)?)));
        }
        Ok(Value::Dictionary(entries.into()))
    }

    pub(super) fn token(&self, index: u32, at: u64) -> Result<Name, ReadError> {
        let tokens = &self.sections.tokens;
        tokens
            .get(index as usize)
            .cloned()
            .ok_or_else(|| ReadError::byte(at, format!("token {index}"), format!("one of {}", tokens.len())))
    }

    fn string(&self, index: u32, at: u64) -> Result<Name, ReadError> {
        let strings = &self.sections.strings;
        match strings.get(index as usize) {
            Some(&token) => self.token(token, at),
            None => Err(ReadError::byte(at, format!("string {index}"), format!("one of {}", strings.len()))),
        }
    }

    fn path(&self, index: u32, at: u64, budget: &mut Budget) -> Result<Name, ReadError> {
        let text = self.paths.text(index, &self.sections.tokens);
        let text =
            text.ok_or_else(|| ReadError::byte(at, format!("path {index}"), "one of the file's paths"))?;
        charge(budget, at, text.len() + 16, 1)?;
        Ok(text.into())
    }
}

fn charge(budget: &mut Budget, at: u64, count: usize, size: usize) -> Result<(), ReadError> {
    let bytes = (count as u64).saturating_mul(size as u64);
    budget.take(bytes, || too_much(at, bytes, "values"))
}

fn deep(at: u64) -> ReadError {
    ReadError::byte(at, format!("values {DEEPEST} deep in each other"), "fewer")
}

fn choice(names: &[&str], index: u64) -> Value {
    let name = names.get(index as u32 as usize).copied().unwrap_or("unknown");
    Value::Token(name.into())
}

fn single_number(scalar: Scalar, bits: Bits, bytes: &mut Bytes<'_>) -> Result<Value, ReadError> {
    Ok(match scalar {
        Scalar::Bool => Value::Bool(bytes.u8("a bool")? != 0),
        // A double in the bits is a float, a long integer a short one.
        Scalar::Double if bits.is_inlined() => Value::Float(f32::from_bits(bytes.u32("a number")?).into()),
        Scalar::Int64 if bits.is_inlined() => Value::Int(bytes.i32("a number")?.into()),
        Scalar::UInt64 if bits.is_inlined() => Value::Int(bytes.u32("a number")?.into()),
        Scalar::Int64 => Value::Int(bytes.u64("a number")? as i64),
        Scalar::UInt64 => match bytes.u64("a number")? {
            value if value <= i64::MAX as u64 => Value::Int(value as i64),
            value => Value::Float(value as f64),
        },
        Scalar::Int => Value::Int(bytes.i32("a number")?.into()),
        Scalar::UInt => Value::Int(bytes.u32("a number")?.into()),
        Scalar::UChar => Value::Int(bytes.u8("a number")?.into()),
        float => Value::Float(component(float, bytes)?),
    })
}

fn component(scalar: Scalar, bytes: &mut Bytes<'_>) -> Result<f64, ReadError> {
    let what = "a number";
    Ok(match scalar {
        Scalar::Half => {
            let low = bytes.u8(what)?;
            f16::from_le_bytes([low, bytes.u8(what)?]).into()
        }
        Scalar::Float => f32::from_bits(bytes.u32(what)?).into(),
        Scalar::Double => bytes.f64(what)?,
        _ => bytes.i32(what)?.into(),
    })
}

/// A vector of small whole numbers, or a diagonal matrix of such, one byte each; `half2` fits as it is.
fn inlined_tuple(element: Element, bits: Bits, inline: [u8; 4]) -> Option<Vec<f64>> {
    if !bits.is_inlined() || element.size() <= 4 {
        return None;
    }
    let small = inline.map(|byte| f64::from(byte as i8));
    let components = usize::from(element.components);
    if element.shape != Shape::Matrix {
        return Some(small.into_iter().take(components).collect());
    }
    let side = match components {
        4 => 2,
        9 => 3,
        _ => 4,
    };
    let mut values = vec![0.0; components];
    for (row, &value) in small.iter().enumerate().take(side) {
        values[row * (side + 1)] = value;
    }
    Some(values)
}
