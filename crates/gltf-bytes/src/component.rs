//! Components of accessors: their types, their places in an element, their values.

use gltf::accessor::{DataType, Dimensions};

/// Where the components of one element lie (glTF 2.0, section 3.6.2.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    pub(crate) rows: usize,
    pub(crate) columns: usize,
    /// Bytes from one column of a matrix to the next, a multiple of 4; a vector is one column.
    column_bytes: usize,
}

impl Layout {
    pub(crate) fn new(dimensions: Dimensions, kind: DataType) -> Self {
        let (rows, columns) = match dimensions {
            Dimensions::Mat2 => (2, 2),
            Dimensions::Mat3 => (3, 3),
            Dimensions::Mat4 => (4, 4),
            vector => (vector.multiplicity(), 1),
        };
        let bytes = rows * kind.size();
        let column_bytes = if columns > 1 { bytes.next_multiple_of(4) } else { bytes };
        Layout { rows, columns, column_bytes }
    }

    /// Components of an element.
    pub(crate) fn width(self) -> usize {
        self.rows * self.columns
    }

    /// Bytes of an element, the padding of columns included.
    pub(crate) fn bytes(self) -> usize {
        self.columns * self.column_bytes
    }

    /// Byte of component `i` in the element, its columns one after the other.
    pub(crate) fn place(self, i: usize, size: usize) -> usize {
        i / self.rows * self.column_bytes + i % self.rows * size
    }
}

/// A component type of glTF.
pub(crate) trait Component {
    /// Bytes.
    const SIZE: usize;
    /// The largest value, which stands for 1 when normalised; 1 for types that cannot be normalised.
    const ONE: f64;
    /// The value of the first bytes; 0 when there are too few.
    fn value(bytes: &[u8]) -> f64;
}

macro_rules! component {
    ($name:ident, $number:ty, $size:literal, $one:expr) => {
        pub(crate) struct $name;

        impl Component for $name {
            const SIZE: usize = $size;
            const ONE: f64 = $one;

            #[inline]
            fn value(bytes: &[u8]) -> f64 {
                let word = bytes.first_chunk::<$size>().copied().unwrap_or_default();
                f64::from(<$number>::from_le_bytes(word))
            }
        }
    };
}

component!(I8, i8, 1, 127.0);
component!(U8, u8, 1, 255.0);
component!(I16, i16, 2, 32767.0);
component!(U16, u16, 2, 65535.0);
component!(U32, u32, 4, 1.0);
component!(F32, f32, 4, 1.0);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_small_matrices_are_padded() {
        let places = |dimensions, kind: DataType| {
            let layout = Layout::new(dimensions, kind);
            (layout.bytes(), (0..layout.width()).map(|i| layout.place(i, kind.size())).collect::<Vec<_>>())
        };
        assert_eq!(places(Dimensions::Mat2, DataType::U8), (8, vec![0, 1, 4, 5]));
        assert_eq!(places(Dimensions::Mat3, DataType::I8).1, [0, 1, 2, 4, 5, 6, 8, 9, 10]);
        assert_eq!(places(Dimensions::Mat3, DataType::U16).1, [0, 2, 4, 8, 10, 12, 16, 18, 20]);
        assert_eq!(places(Dimensions::Mat2, DataType::F32), (16, vec![0, 4, 8, 12]));
        assert_eq!(places(Dimensions::Vec3, DataType::U8), (3, vec![0, 1, 2]));
        assert_eq!(places(Dimensions::Scalar, DataType::U16), (2, vec![0]));
    }

    #[test]
    fn values_are_little_endian() {
        assert_eq!((I8::value(&[0xff]), U8::value(&[0xff])), (-1.0, 255.0));
        assert_eq!((I16::value(&[0, 0x80]), U16::value(&[1, 2])), (-32768.0, 513.0));
        assert_eq!((U32::value(&[0xff; 4]), F32::value(&1.5_f32.to_le_bytes())), (4_294_967_295.0, 1.5));
    }
}
