//! Arrays, read when they are asked for.

use std::borrow::Cow;

use crate::read::ReadError;
use crate::read::budget::{self, Budget};
use crate::read::{crate_file, text};
use crate::value::Storage;
use crate::{Array, Layer, Name, Number, Shape, Value};

impl<B: AsRef<[u8]>> Layer<B> {
    /// The elements of an array of numbers, `N` components each; a single value is an array of one.
    ///
    /// # Errors
    /// [`ReadError`] when the value is no array of numbers with `N` components, when its bytes are broken, and
    /// when a compressed array claims more than four times the size of the file.
    pub fn values<T: Number, const N: usize>(&self, value: &Value) -> Result<Vec<[T; N]>, ReadError> {
        let array = match value {
            Value::Array(array) => *array,
            single => return self.one(single).map(|one| vec![one]),
        };
        let components = usize::from(array.element.components);
        if array.element.scalar.is_text() || components != N {
            return Err(self.fault(array.start, describe(array), &format!("an array of {N} numbers each")));
        }
        let bytes = self.layer_bytes();
        let mut elements: Vec<[T; N]> = match array.storage {
            Storage::Text => text::array::numbers(bytes, array)?,
            Storage::Plain => crate_file::decode::plain(bytes, array)?,
            Storage::Compressed => {
                let numbers =
                    crate_file::decode::compressed::<T>(bytes, array, &mut Budget::of(bytes.len()))?;
                bytemuck::allocation::try_cast_vec(numbers)
                    .map_err(|_| self.fault(array.start, describe(array), "single numbers"))?
            }
        };
        if array.element.shape == Shape::Quaternion && array.storage != Storage::Text {
            // A crate has the real part last.
            elements.iter_mut().for_each(|element| element.rotate_right(1));
        }
        Ok(elements)
    }

    /// As [`values`](Self::values), for arrays of single numbers.
    ///
    /// # Errors
    /// As [`values`](Self::values).
    pub fn numbers<T: Number>(&self, value: &Value) -> Result<Vec<T>, ReadError> {
        let singles = self.values::<T, 1>(value)?;
        Ok(bytemuck::allocation::cast_vec(singles))
    }

    /// The texts of an array of strings, tokens or asset paths, or of a list of them.
    ///
    /// # Errors
    /// [`ReadError`] when the value is no such array, or broken.
    pub fn texts(&self, value: &Value) -> Result<Vec<Name>, ReadError> {
        let array = match value {
            Value::Array(array) => *array,
            Value::List(list) => return Ok(list.items().filter_map(Value::text).map(Name::from).collect()),
            single => {
                let text = single.text().ok_or_else(|| self.fault(0, "a value that is no text", "texts"))?;
                return Ok(vec![text.into()]);
            }
        };
        if !array.element.scalar.is_text() {
            return Err(self.fault(array.start, describe(array), "an array of texts"));
        }
        match array.storage {
            Storage::Text => text::array::texts(self.layer_bytes(), array),
            _ => crate_file::decode::texts(self.layer_bytes(), array, &self.tokens, &self.strings),
        }
    }

    /// How many elements an array has, as far as it says so without being read: `None` in a text.
    #[must_use]
    pub fn len_of(&self, value: &Value) -> Option<u64> {
        match value {
            Value::Array(Array { storage: Storage::Text, .. }) => None,
            Value::Array(array) => Some(array.extent),
            _ => Some(1),
        }
    }

    /// The bytes of the layer, in a package those of the file in it.
    pub(crate) fn layer_bytes(&self) -> &[u8] {
        self.bytes.as_ref().get(self.start..self.end).unwrap_or_default()
    }

    /// The bytes the layer was read from.
    #[must_use]
    pub fn bytes(&self) -> &B {
        &self.bytes
    }

    fn one<T: Number, const N: usize>(&self, value: &Value) -> Result<[T; N], ReadError> {
        let components = value.components().filter(|components| components.len() == N);
        let mut one = [T::default(); N];
        let fault = || self.fault(0, "a value of another type", &format!("an array of {N} numbers each"));
        for (to, from) in one.iter_mut().zip(components.ok_or_else(fault)?) {
            let whole = from == from.trunc() && from.abs() < 9e15;
            let read = T::from_float(from).or_else(|| T::from_integer(from as i64).filter(|_| whole));
            *to = read.ok_or_else(fault)?;
        }
        Ok(one)
    }

    fn fault(&self, at: u64, found: impl Into<String>, expected: &str) -> ReadError {
        if self.is_text() {
            ReadError::text(self.layer_bytes(), at as usize, found, expected)
        } else {
            ReadError::byte(at, found, expected)
        }
    }

    /// Whether the layer is a text.
    #[must_use]
    pub fn is_text(&self) -> bool {
        !self.layer_bytes().starts_with(b"PXR-USDC")
    }
}

fn describe(array: Array) -> Cow<'static, str> {
    format!("an array of {} components each ({:?})", array.element.components, array.element.scalar).into()
}

/// Refuses arrays that are larger than the file allows.
pub(super) fn refuse_large(file: usize, at: u64, elements: u64, size: usize) -> Result<(), ReadError> {
    if elements.checked_mul(size as u64).is_some_and(|bytes| bytes <= budget::limit(file)) {
        return Ok(());
    }
    Err(ReadError::byte(at, format!("an array of {elements} elements"), budget::EXPECTED))
}
