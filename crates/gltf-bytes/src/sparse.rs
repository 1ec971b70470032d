//! Sparse accessors: most values as they are, a few replaced (glTF 2.0, section 3.6.2.3).

use gltf::accessor::DataType;
use gltf::accessor::sparse::{IndexType, Sparse};

use crate::component::{Component, U8, U16, U32};
use crate::elements::Span;
use crate::{Buffers, GltfError};

/// Puts the replaced elements of `sparse`, `element` bytes each, into `dense`.
pub(crate) fn apply(
    dense: &mut [u8],
    sparse: &Sparse<'_>,
    element: usize,
    buffers: &Buffers<'_>,
    accessor: &str,
) -> Result<(), GltfError> {
    let place = format!("{accessor}.sparse");
    let (indices, values) = (sparse.indices(), sparse.values());
    let (kind, read): (_, fn(&[u8]) -> f64) = match indices.index_type() {
        IndexType::U8 => (DataType::U8, U8::value),
        IndexType::U16 => (DataType::U16, U16::value),
        IndexType::U32 => (DataType::U32, U32::value),
    };
    let size = kind.size();
    let count = sparse.count();
    let span = Span { offset: indices.offset(), count, stride: size, element: size };
    let at = span.of(buffers.view(&indices.view(), &place)?, &place)?;
    let span = Span { offset: values.offset(), count, stride: element, element };
    let new = span.of(buffers.view(&values.view(), &place)?, &place)?;
    let elements = dense.len() / element;
    for (at, new) in at.chunks(size).zip(new.chunks(element)) {
        let index = read(at) as usize;
        let Some(slot) = index.checked_mul(element).and_then(|i| dense.get_mut(i..)?.get_mut(..element))
        else {
            return Err(GltfError::invalid(place, format!("index {index}"), format!("below {elements}")));
        };
        slot.copy_from_slice(new);
    }
    Ok(())
}
