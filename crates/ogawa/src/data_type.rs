//! Types of values: Alembic's `PlainOldDataType` and how many of them make one value.

use bytemuck::AnyBitPattern;

/// What one number of a value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Pod {
    /// A truth value in a byte.
    Bool = 0,
    /// `u8`.
    U8 = 1,
    /// `i8`.
    I8 = 2,
    /// `u16`.
    U16 = 3,
    /// `i16`.
    I16 = 4,
    /// `u32`.
    U32 = 5,
    /// `i32`.
    I32 = 6,
    /// `u64`.
    U64 = 7,
    /// `i64`.
    I64 = 8,
    /// IEEE half.
    F16 = 9,
    /// `f32`.
    F32 = 10,
    /// `f64`.
    F64 = 11,
    /// UTF-8, ended by a 0 byte.
    String = 12,
    /// Unicode in 32-bit units, ended by a 0 unit.
    WideString = 13,
}

impl Pod {
    const ALL: [Pod; 14] = [
        Pod::Bool,
        Pod::U8,
        Pod::I8,
        Pod::U16,
        Pod::I16,
        Pod::U32,
        Pod::I32,
        Pod::U64,
        Pod::I64,
        Pod::F16,
        Pod::F32,
        Pod::F64,
        Pod::String,
        Pod::WideString,
    ];

    pub(crate) fn from_code(code: u32) -> Option<Pod> {
        Pod::ALL.into_iter().find(|&pod| pod as u32 == code)
    }

    /// Bytes of one number; `None` for strings, which end where they end.
    #[must_use]
    pub fn size(self) -> Option<usize> {
        match self {
            Pod::Bool | Pod::U8 | Pod::I8 => Some(1),
            Pod::U16 | Pod::I16 | Pod::F16 => Some(2),
            Pod::U32 | Pod::I32 | Pod::F32 => Some(4),
            Pod::U64 | Pod::I64 | Pod::F64 => Some(8),
            Pod::String | Pod::WideString => None,
        }
    }
}

/// The type of one value: so many numbers of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct DataType {
    /// What one number is.
    pub pod: Pod,
    /// How many numbers make a value, 1 to 255.
    pub extent: u8,
}

impl DataType {
    /// One `u8`.
    pub const U8: DataType = DataType::new(Pod::U8, 1);
    /// One `i16`.
    pub const I16: DataType = DataType::new(Pod::I16, 1);
    /// One `i32`.
    pub const I32: DataType = DataType::new(Pod::I32, 1);
    /// One `u32`.
    pub const U32: DataType = DataType::new(Pod::U32, 1);
    /// One `f32`.
    pub const F32: DataType = DataType::new(Pod::F32, 1);
    /// Two `f32`.
    pub const F32X2: DataType = DataType::new(Pod::F32, 2);
    /// Three `f32`.
    pub const F32X3: DataType = DataType::new(Pod::F32, 3);
    /// One `f64`.
    pub const F64: DataType = DataType::new(Pod::F64, 1);
    /// A box: two corners of three `f64`.
    pub const BOX: DataType = DataType::new(Pod::F64, 6);
    /// A text.
    pub const STRING: DataType = DataType::new(Pod::String, 1);

    /// So many numbers of a kind.
    #[must_use]
    pub const fn new(pod: Pod, extent: u8) -> Self {
        DataType { pod, extent }
    }

    /// Bytes of one value; `None` for strings.
    #[must_use]
    pub fn size(self) -> Option<usize> {
        self.pod.size().map(|size| size * usize::from(self.extent))
    }
}

/// A Rust number that is one of Alembic's.
pub trait Value: AnyBitPattern + bytemuck::NoUninit {
    /// Which of them it is.
    const POD: Pod;
}

macro_rules! value {
    ($($number:ty: $pod:ident),*) => {
        $(impl Value for $number {
            const POD: Pod = Pod::$pod;
        })*
    };
}

value!(u8: U8, i8: I8, u16: U16, i16: I16, u32: U32, i32: I32, u64: U64, i64: I64, f32: F32, f64: F64);
