//! The elements of an accessor, every range checked before a byte is read.

use std::borrow::Cow;

use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};

use crate::component::{Component, F32, I8, I16, Layout, U8, U16, U32};
use crate::{Buffers, GltfError, sparse};

/// What an accessor with values of its own may take beside the file: a morph target that moves nothing is
/// all zeros and costs the file no byte.
const ALWAYS_ALLOWED: usize = 1 << 16;

/// The elements of one accessor, ready to be read in any order.
#[derive(Clone, Debug)]
pub struct Elements<'a> {
    bytes: Cow<'a, [u8]>,
    count: usize,
    stride: usize,
    layout: Layout,
    kind: DataType,
    dimensions: Dimensions,
    /// What a component is divided by, if its type is normalised.
    one: Option<f64>,
    index: usize,
}

impl<'a> Elements<'a> {
    /// The elements of `accessor`, sparse ones replaced. `min` and `max` are not looked at.
    ///
    /// Nothing is copied unless the accessor is sparse.
    ///
    /// # Errors
    /// [`GltfError::Invalid`] when the elements do not lie inside their view, the view not inside its buffer,
    /// or a sparse index not below the count.
    pub fn open(accessor: &Accessor<'_>, buffers: &'a Buffers<'_>) -> Result<Self, GltfError> {
        let place = format!("accessors[{}]", accessor.index());
        let (kind, dimensions, count) = (accessor.data_type(), accessor.dimensions(), accessor.count());
        let layout = Layout::new(dimensions, kind);
        let element = layout.bytes();
        let (mut bytes, mut stride) = (Cow::Borrowed(&[][..]), element);
        if let Some(view) = accessor.view() {
            stride = view.stride().unwrap_or(element);
            let span = Span { offset: accessor.offset(), count, stride, element };
            bytes = Cow::Borrowed(span.of(buffers.view(&view, &place)?, &place)?);
        } else if accessor.sparse().is_none() {
            return Err(GltfError::invalid(place, "neither bufferView nor sparse", "one of them"));
        }
        if let Some(sparse) = accessor.sparse() {
            let mut dense = dense(&bytes, count, stride, element, buffers, &place)?;
            sparse::apply(&mut dense, &sparse, element, buffers, &place)?;
            (bytes, stride) = (Cow::Owned(dense), element);
        }
        let one = accessor.normalized().then_some(match kind {
            DataType::I8 => I8::ONE,
            DataType::U8 => U8::ONE,
            DataType::I16 => I16::ONE,
            DataType::U16 => U16::ONE,
            DataType::U32 | DataType::F32 => 1.0,
        });
        Ok(Elements { bytes, count, stride, layout, kind, dimensions, one, index: accessor.index() })
    }

    /// As [`Elements::open`] for an accessor that must have one of these `dimensions`.
    ///
    /// # Errors
    /// As [`Elements::open`], and [`GltfError::Invalid`] for another type.
    pub fn of(
        accessor: &Accessor<'_>,
        dimensions: &[Dimensions],
        buffers: &'a Buffers<'_>,
    ) -> Result<Self, GltfError> {
        if !dimensions.contains(&accessor.dimensions()) {
            let place = format!("accessors[{}]", accessor.index());
            let words = dimensions.iter().map(|d| format!("{d:?}")).collect::<Vec<_>>().join(" or ");
            return Err(GltfError::invalid(place, format!("type {:?}", accessor.dimensions()), words));
        }
        Elements::open(accessor, buffers)
    }

    /// How many elements there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The type of an element.
    #[must_use]
    pub fn dimensions(&self) -> Dimensions {
        self.dimensions
    }

    /// The type of a component.
    #[must_use]
    pub fn data_type(&self) -> DataType {
        self.kind
    }

    /// Whether the components are integers that mean themselves.
    #[must_use]
    pub fn is_integer(&self) -> bool {
        self.kind != DataType::F32 && self.one.is_none()
    }

    /// The elements `which`, each made into something from its first `N` components: numbers as they are,
    /// normalised integers from 0 or -1 to 1 (section 3.6.2.2). Components an element has not are 0, and so
    /// is an element that is not there.
    pub fn map<const N: usize, T>(
        &self,
        which: impl Iterator<Item = usize>,
        make: impl FnMut([f64; N]) -> T,
    ) -> Vec<T> {
        match self.kind {
            DataType::I8 => self.map_as::<I8, N, T>(which, make),
            DataType::U8 => self.map_as::<U8, N, T>(which, make),
            DataType::I16 => self.map_as::<I16, N, T>(which, make),
            DataType::U16 => self.map_as::<U16, N, T>(which, make),
            DataType::U32 => self.map_as::<U32, N, T>(which, make),
            DataType::F32 => self.map_as::<F32, N, T>(which, make),
        }
    }

    /// All elements, as [`Elements::map`] gives them.
    pub fn all<const N: usize, T>(&self, make: impl FnMut([f64; N]) -> T) -> Vec<T> {
        self.map(0..self.count, make)
    }

    /// All components of all elements, matrices column by column.
    ///
    /// # Errors
    /// [`GltfError::Invalid`] for a number of components that memory cannot count.
    pub fn floats(&self) -> Result<Vec<f32>, GltfError> {
        let too_many = || GltfError::invalid(self.place(), format!("count {}", self.count), "fewer elements");
        // The elements are there, so their number is no lie.
        let mut floats =
            Vec::with_capacity(self.count.checked_mul(self.layout.width()).ok_or_else(too_many)?);
        match self.layout.width() {
            1 => self.all(|[v]| floats.push(v as f32)),
            2 => self.all(|v: [f64; 2]| floats.extend(v.map(|v| v as f32))),
            3 => self.all(|v: [f64; 3]| floats.extend(v.map(|v| v as f32))),
            4 => self.all(|v: [f64; 4]| floats.extend(v.map(|v| v as f32))),
            9 => self.all(|v: [f64; 9]| floats.extend(v.map(|v| v as f32))),
            _ => self.all(|v: [f64; 16]| floats.extend(v.map(|v| v as f32))),
        };
        Ok(floats)
    }

    /// Scalars that count something: indices of vertices.
    ///
    /// # Errors
    /// [`GltfError::Invalid`] unless the accessor is a SCALAR of u8, u16 or u32.
    pub fn indices(&self) -> Result<Vec<u32>, GltfError> {
        let unsigned = matches!(self.kind, DataType::U8 | DataType::U16 | DataType::U32);
        if !unsigned || self.one.is_some() || self.dimensions != Dimensions::Scalar {
            let found = format!("{:?} of {:?}", self.dimensions, self.kind);
            return Err(GltfError::invalid(self.place(), found, "Scalar of U8, U16 or U32, not normalised"));
        }
        Ok(self.all(|[index]| index as u32))
    }

    fn map_as<C: Component, const N: usize, T>(
        &self,
        which: impl Iterator<Item = usize>,
        mut make: impl FnMut([f64; N]) -> T,
    ) -> Vec<T> {
        let width = self.layout.width();
        let places: [Option<usize>; N] =
            std::array::from_fn(|i| (i < width).then(|| self.layout.place(i, C::SIZE)));
        let element = self.layout.bytes();
        let scale = |value: f64| match self.one {
            Some(one) => (value / one).max(-1.0),
            None => value,
        };
        let read = |i: usize| {
            // Cannot fail below the count: `Span` has seen all of them.
            let start = i * self.stride;
            let bytes = self.bytes.get(start..start + element).unwrap_or_default();
            make(places.map(|place| {
                place.and_then(|place| bytes.get(place..)).map_or(0.0, |bytes| scale(C::value(bytes)))
            }))
        };
        which.map(read).collect()
    }

    fn place(&self) -> String {
        format!("accessors[{}]", self.index)
    }
}

/// A copy without gaps; zeros when there is nothing to copy.
fn dense(
    bytes: &[u8],
    count: usize,
    stride: usize,
    element: usize,
    buffers: &Buffers<'_>,
    place: &str,
) -> Result<Vec<u8>, GltfError> {
    let wanted = count.saturating_mul(element);
    // Component types are at most doubled when they are read, so the values stay below 4 times the file.
    let allowed = buffers.total().saturating_mul(2).saturating_add(ALWAYS_ALLOWED);
    if wanted > allowed {
        let found = format!("{wanted} bytes of values in a sparse accessor");
        return Err(GltfError::invalid(place, found, format!("at most {allowed} for buffers of this size")));
    }
    let mut dense = vec![0; wanted];
    for (to, from) in dense.chunks_mut(element).zip(bytes.chunks(stride)) {
        if let Some(from) = from.get(..element) {
            to.copy_from_slice(from);
        }
    }
    Ok(dense)
}

/// Equally spaced elements inside a buffer view.
pub(crate) struct Span {
    pub(crate) offset: usize,
    pub(crate) count: usize,
    pub(crate) stride: usize,
    pub(crate) element: usize,
}

impl Span {
    /// The bytes from the first element to the end of the last.
    pub(crate) fn of<'b>(&self, bytes: &'b [u8], place: &str) -> Result<&'b [u8], GltfError> {
        let &Span { offset, count, stride, element } = self;
        let end = count
            .checked_sub(1)
            .map_or(Some(offset), |last| last.checked_mul(stride)?.checked_add(offset)?.checked_add(element));
        let range = end.and_then(|end| bytes.get(offset..end)).filter(|_| stride >= element);
        range.ok_or_else(|| {
            let found = format!("{count} elements of {element} bytes every {stride} from {offset}");
            GltfError::invalid(place, found, format!("elements inside the view's {} bytes", bytes.len()))
        })
    }
}
