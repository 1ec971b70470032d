//! One sample of a property.

use super::group::Data;
use crate::{DataType, KEY, OgawaError, Pod, Value};

/// The values of a property at one of its times.
#[derive(Clone, Copy, Debug)]
pub struct Sample<'a> {
    name_for_errors: &'a str,
    /// Their bytes, little endian, without the key.
    bytes: &'a [u8],
    offset: u64,
    data_type: DataType,
    key: Option<[u8; KEY]>,
}

impl<'a> Sample<'a> {
    pub(super) fn new(
        data: Data<'a>,
        data_type: DataType,
        dimensions: Option<Data<'a>>,
        name_for_errors: &'a str,
    ) -> Result<Self, OgawaError> {
        let Data { bytes, offset } = data;
        if bytes.is_empty() {
            return Ok(Sample { name_for_errors, bytes, offset, data_type, key: None });
        }
        let Some((key, values)) = bytes.split_first_chunk::<KEY>() else {
            let found = format!("{} bytes", bytes.len());
            return Err(OgawaError::invalid(offset, "sample", found, "none, or a key of 16 and values"));
        };
        let sample = Sample {
            name_for_errors,
            bytes: values,
            offset: offset + KEY as u64,
            data_type,
            key: Some(*key),
        };
        sample.check_size(dimensions)?;
        Ok(sample)
    }

    /// Whole values, and as many as the dimensions say.
    fn check_size(&self, dimensions: Option<Data<'a>>) -> Result<(), OgawaError> {
        let Some(size) = self.data_type.size() else { return Ok(()) };
        let len = self.bytes.len();
        if !len.is_multiple_of(size) {
            let expected = format!("a multiple of {size}");
            return Err(OgawaError::invalid(self.offset, "sample", format!("{len} bytes"), expected));
        }
        let Some(dimensions) = dimensions else {
            if len == size {
                return Ok(());
            }
            return Err(OgawaError::invalid(self.offset, "scalar", format!("{len} bytes"), size.to_string()));
        };
        let (ranks, _) = dimensions.bytes.as_chunks::<8>();
        let said = ranks.iter().try_fold(1_u64, |all, &rank| all.checked_mul(u64::from_le_bytes(rank)));
        if ranks.is_empty() || said == Some((len / size) as u64) {
            return Ok(());
        }
        let found = format!("{} values", len / size);
        let expected = said.map_or("fewer than 2^64".to_owned(), |said| said.to_string());
        Err(OgawaError::invalid(dimensions.offset, "dimensions", found, expected))
    }

    /// The type of its values.
    #[must_use]
    pub fn data_type(&self) -> DataType {
        self.data_type
    }

    /// Its bytes, little endian; texts end with a 0 byte.
    #[must_use]
    pub fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// Where its bytes begin in the file.
    #[must_use]
    pub fn offset(&self) -> u64 {
        self.offset
    }

    /// The name the writer gave to its content; `None` for no bytes.
    #[must_use]
    pub fn key(&self) -> Option<[u8; 16]> {
        self.key
    }

    /// How many values it holds; for texts, how many end.
    #[must_use]
    pub fn len(&self) -> usize {
        match self.data_type.size() {
            Some(size) => self.bytes.len() / size,
            None => self.bytes.iter().filter(|&&byte| byte == 0).count(),
        }
    }

    /// Whether it holds no value.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// Its numbers, when they are of this type; extents are laid flat.
    ///
    /// # Errors
    /// [`OgawaError::Property`] when they are not.
    pub fn to_vec<T: Value>(&self) -> Result<Vec<T>, OgawaError> {
        if self.data_type.pod != T::POD {
            return Err(self.unlike(format!("{:?}", T::POD)));
        }
        if cfg!(target_endian = "little") && self.bytes.len().is_multiple_of(size_of::<T>()) {
            return Ok(bytemuck::pod_collect_to_vec(self.bytes));
        }
        Ok(self.numbers().collect())
    }

    /// Its numbers of this type, one after another; the caller has looked at [`Sample::data_type`].
    fn numbers<T: Value>(&self) -> impl ExactSizeIterator<Item = T> + 'a {
        self.bytes.chunks_exact(size_of::<T>()).map(|bytes| {
            if cfg!(target_endian = "little") {
                return bytemuck::pod_read_unaligned(bytes);
            }
            // No number is longer than 8 bytes.
            let mut turned = [0; 8];
            let turned = &mut turned[..bytes.len()];
            turned.copy_from_slice(bytes);
            turned.reverse();
            bytemuck::pod_read_unaligned(turned)
        })
    }

    /// Its numbers as `f32`, rounded where they have more digits.
    ///
    /// # Errors
    /// [`OgawaError::Property`] for texts.
    pub fn to_f32(&self) -> Result<Vec<f32>, OgawaError> {
        match self.data_type.pod {
            Pod::F32 => self.to_vec(),
            Pod::F64 => Ok(self.numbers::<f64>().map(|v| v as f32).collect()),
            Pod::F16 => Ok(self.numbers::<u16>().map(half).collect()),
            Pod::Bool | Pod::U8 => Ok(self.numbers::<u8>().map(f32::from).collect()),
            Pod::I8 => Ok(self.numbers::<i8>().map(f32::from).collect()),
            Pod::U16 => Ok(self.numbers::<u16>().map(f32::from).collect()),
            Pod::I16 => Ok(self.numbers::<i16>().map(f32::from).collect()),
            Pod::U32 => Ok(self.numbers::<u32>().map(|v| v as f32).collect()),
            Pod::I32 => Ok(self.numbers::<i32>().map(|v| v as f32).collect()),
            Pod::U64 => Ok(self.numbers::<u64>().map(|v| v as f32).collect()),
            Pod::I64 => Ok(self.numbers::<i64>().map(|v| v as f32).collect()),
            Pod::String | Pod::WideString => Err(self.unlike("numbers")),
        }
    }

    /// Its numbers as `f64`.
    ///
    /// # Errors
    /// [`OgawaError::Property`] for texts.
    pub fn to_f64(&self) -> Result<Vec<f64>, OgawaError> {
        match self.data_type.pod {
            Pod::F64 => self.to_vec(),
            _ => Ok(self.to_f32()?.into_iter().map(f64::from).collect()),
        }
    }

    /// Its numbers as `i32`.
    ///
    /// # Errors
    /// [`OgawaError::Property`] for texts, fractions and numbers too large.
    pub fn to_i32(&self) -> Result<Vec<i32>, OgawaError> {
        fn narrow<T: TryInto<i32>>(numbers: impl Iterator<Item = T>) -> Option<Vec<i32>> {
            numbers.map(|number| number.try_into().ok()).collect()
        }
        let numbers = match self.data_type.pod {
            Pod::I32 => return self.to_vec(),
            Pod::Bool | Pod::U8 => narrow(self.numbers::<u8>()),
            Pod::I8 => narrow(self.numbers::<i8>()),
            Pod::U16 => narrow(self.numbers::<u16>()),
            Pod::I16 => narrow(self.numbers::<i16>()),
            Pod::U32 => narrow(self.numbers::<u32>()),
            Pod::U64 => narrow(self.numbers::<u64>()),
            Pod::I64 => narrow(self.numbers::<i64>()),
            _ => None,
        };
        numbers.ok_or_else(|| self.unlike("whole numbers of 32 bits"))
    }

    /// Its texts.
    ///
    /// # Errors
    /// [`OgawaError::Property`] when they are numbers, wide or not UTF-8.
    pub fn texts(&self) -> Result<Vec<&'a str>, OgawaError> {
        if self.data_type.pod != Pod::String {
            return Err(self.unlike("texts"));
        }
        let text = std::str::from_utf8(self.bytes).map_err(|_| self.unlike("UTF-8 texts"))?;
        let Some(text) = text.strip_suffix('\0') else { return Ok(Vec::new()) };
        Ok(text.split('\0').collect())
    }

    fn unlike(&self, expected: impl Into<String>) -> OgawaError {
        OgawaError::Property {
            name: self.name_for_errors.to_owned(),
            found: format!("{:?} times {}", self.data_type.pod, self.data_type.extent),
            expected: expected.into(),
        }
    }
}

/// IEEE half to single: every half is a single.
fn half(bits: u16) -> f32 {
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f32::from(bits & 1023));
    let size = match exponent {
        0 => fraction * 2.0_f32.powi(-24),
        31 if fraction == 0.0 => f32::INFINITY,
        31 => f32::NAN,
        _ => (1.0 + fraction / 1024.0) * 2.0_f32.powi(exponent - 15),
    };
    if bits >> 15 == 1 { -size } else { size }
}

#[cfg(test)]
mod tests {
    use super::half;

    #[test]
    fn halves_are_read() {
        assert_eq!([0x3c00, 0xc000, 0x7bff, 1].map(half), [1.0, -2.0, 65504.0, 2.0_f32.powi(-24)]);
        assert!(half(0x7c00) == f32::INFINITY && half(0x7e00).is_nan());
    }
}
