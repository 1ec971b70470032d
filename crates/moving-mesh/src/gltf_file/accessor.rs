//! Accessor values, every range checked before it is read.

use gltf::Accessor;
use gltf::accessor::sparse::IndexType;
use gltf::accessor::{DataType, Dimensions};

use super::buffers::Buffers;
use crate::error::Fault;

/// The values of an accessor as `f64`, flat, `components` an element; normalised integers become 0..1.
pub(crate) fn read(
    accessor: &Accessor<'_>,
    components: Dimensions,
    buffers: &Buffers<'_>,
) -> Result<Vec<f64>, Fault> {
    let place = format!("accessors[{}]", accessor.index());
    if accessor.dimensions() != components {
        let fault = format!("type {:?}, expected {components:?}", accessor.dimensions());
        return Err(Fault::invalid(place, fault));
    }
    let width = components.multiplicity();
    let count =
        accessor.count().checked_mul(width).ok_or_else(|| Fault::invalid(&*place, "count overflows"))?;
    let kind = accessor.data_type();
    let element = accessor.size();
    let mut values = match accessor.view() {
        Some(view) => {
            let stride = view.stride().unwrap_or(element);
            let span = Span { offset: accessor.offset(), count: accessor.count(), stride, element };
            let bytes = view_bytes(&view, buffers, &place)?;
            let elements = span.of(bytes, &place)?;
            elements.flat_map(|e| components_of(e, kind, width)).collect()
        }
        // Without a view all values are zero; only a sparse one may then be larger than the file.
        None if accessor.sparse().is_some() && count <= total(buffers).saturating_mul(64) => vec![0.0; count],
        None => return Err(Fault::invalid(place, "neither bufferView nor a sparse part of fitting size")),
    };
    if let Some(sparse) = accessor.sparse() {
        let place = format!("{place}.sparse");
        let (indices, replaced) = (sparse.indices(), sparse.values());
        let index_kind = match indices.index_type() {
            IndexType::U8 => DataType::U8,
            IndexType::U16 => DataType::U16,
            IndexType::U32 => DataType::U32,
        };
        let size = byte_size(index_kind);
        let span = Span { offset: indices.offset(), count: sparse.count(), stride: size, element: size };
        let index_view = indices.view();
        let at = span.of(view_bytes(&index_view, buffers, &place)?, &place)?;
        let span = Span { offset: replaced.offset(), count: sparse.count(), stride: element, element };
        let value_view = replaced.view();
        let new = span.of(view_bytes(&value_view, buffers, &place)?, &place)?;
        for (at, new) in at.zip(new) {
            let index = component(at, index_kind) as usize;
            let Some(slot) = index.checked_mul(width).and_then(|i| values.get_mut(i..)?.get_mut(..width))
            else {
                let fault = format!("index {index}, expected below {}", accessor.count());
                return Err(Fault::invalid(place, fault));
            };
            slot.copy_from_slice(&components_of(new, kind, width).collect::<Vec<_>>());
        }
    }
    if accessor.normalized() {
        normalise(&mut values, kind);
    }
    Ok(values)
}

/// Equally spaced elements inside a buffer view.
struct Span {
    offset: usize,
    count: usize,
    stride: usize,
    element: usize,
}

impl Span {
    fn of<'a>(
        &self,
        bytes: &'a [u8],
        place: &str,
    ) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>, Fault> {
        let &Span { offset, count, stride, element } = self;
        let end = count
            .checked_sub(1)
            .map_or(Some(offset), |last| last.checked_mul(stride)?.checked_add(offset)?.checked_add(element));
        let range = end.and_then(|end| bytes.get(offset..end)).filter(|_| stride >= element);
        match range {
            Some(range) => Ok(range.chunks(stride).take(count).map(move |chunk| &chunk[..element])),
            None => Err(Fault::invalid(
                place,
                format!(
                    "{count} elements of {element} bytes every {stride} from {offset}, expected to fit the view's {} bytes",
                    bytes.len()
                ),
            )),
        }
    }
}

fn view_bytes<'a>(
    view: &gltf::buffer::View<'_>,
    buffers: &'a Buffers<'_>,
    place: &str,
) -> Result<&'a [u8], Fault> {
    let buffer = &buffers[view.buffer().index()];
    let range = view.offset().checked_add(view.length()).and_then(|end| buffer.get(view.offset()..end));
    range.ok_or_else(|| {
        let (offset, length, found) = (view.offset(), view.length(), buffer.len());
        Fault::invalid(
            format!("bufferViews[{}] (of {place})", view.index()),
            format!("bytes {offset} + {length}, expected inside the buffer's {found}"),
        )
    })
}

fn total(buffers: &Buffers<'_>) -> usize {
    buffers.iter().map(|b| b.len()).sum()
}

fn byte_size(kind: DataType) -> usize {
    match kind {
        DataType::I8 | DataType::U8 => 1,
        DataType::I16 | DataType::U16 => 2,
        DataType::U32 | DataType::F32 => 4,
    }
}

fn components_of(element: &[u8], kind: DataType, width: usize) -> impl Iterator<Item = f64> + '_ {
    element.chunks(byte_size(kind)).take(width).map(move |bytes| component(bytes, kind))
}

fn component(bytes: &[u8], kind: DataType) -> f64 {
    let word = |n: usize| {
        let mut word = [0u8; 4];
        word[..n].copy_from_slice(&bytes[..n]);
        u32::from_le_bytes(word)
    };
    match kind {
        DataType::I8 => f64::from(word(1) as u8 as i8),
        DataType::U8 => f64::from(word(1)),
        DataType::I16 => f64::from(word(2) as u16 as i16),
        DataType::U16 => f64::from(word(2)),
        DataType::U32 => f64::from(word(4)),
        DataType::F32 => f64::from(f32::from_bits(word(4))),
    }
}

/// glTF 2.0, section 3.6.2.2: unsigned by the largest value, signed likewise and not below -1.
fn normalise(values: &mut [f64], kind: DataType) {
    let largest = match kind {
        DataType::I8 => f64::from(i8::MAX),
        DataType::U8 => f64::from(u8::MAX),
        DataType::I16 => f64::from(i16::MAX),
        DataType::U16 => f64::from(u16::MAX),
        DataType::U32 | DataType::F32 => return,
    };
    for value in values {
        *value = (*value / largest).max(-1.0);
    }
}
