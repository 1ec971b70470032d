//! A HAIR file looked at where its bytes lie.

use std::ops::Range;

use crate::check::{self, Oddities};
use crate::file::read_header;
use crate::little_endian::Value;
use crate::source::Source;
use crate::{Field, HairError, Header, Warning};

/// One array of a file, seen in the file's bytes.
#[derive(Clone, Copy, Debug)]
pub struct ArrayView<'a, T> {
    bytes: &'a [u8],
    values: std::marker::PhantomData<T>,
}

impl<'a, T: Value> ArrayView<'a, T> {
    fn new(bytes: &'a [u8]) -> Self {
        ArrayView { bytes, values: std::marker::PhantomData }
    }

    /// How many values there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.bytes.len() / size_of::<T>()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// The values without a copy, where the bytes allow it: on a little-endian machine, and when
    /// they happen to be aligned. An odd number of strands with a segments array puts every later
    /// array at an address divisible by two only.
    #[must_use]
    pub fn as_slice(&self) -> Option<&'a [T]> {
        if cfg!(target_endian = "big") { None } else { bytemuck::try_cast_slice(self.bytes).ok() }
    }

    /// Value `index`, wherever its bytes lie.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<T> {
        let start = index.checked_mul(size_of::<T>())?;
        let bytes = self.bytes.get(start..start.checked_add(size_of::<T>())?)?;
        Some(bytemuck::pod_read_unaligned::<T>(bytes).swapped_on_big_endian())
    }

    /// The values in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = T> + 'a {
        let read = |bytes| bytemuck::pod_read_unaligned::<T>(bytes).swapped_on_big_endian();
        self.bytes.chunks_exact(size_of::<T>()).map(read)
    }

    /// Copies the values of `range` behind those in `into`.
    ///
    /// # Panics
    /// When `range` is not within the array.
    pub fn copy_to(&self, range: Range<usize>, into: &mut Vec<T>) {
        let bytes = &self.bytes[range.start * size_of::<T>()..range.end * size_of::<T>()];
        into.extend(ArrayView::<T>::new(bytes).iter());
    }
}

/// A HAIR file checked and looked at in place; nothing is copied.
#[derive(Clone, Debug)]
pub struct HairView<'a> {
    header: Header,
    bytes: &'a [u8],
    warnings: Vec<Warning>,
}

impl<'a> HairView<'a> {
    /// Checks `bytes`, a whole file, as strictly as [`crate::HairFile::read`] does.
    ///
    /// # Errors
    /// As [`crate::HairFile::read`], without input failures.
    pub fn new(bytes: &'a [u8]) -> Result<Self, HairError> {
        let len = bytes.len() as u64;
        let header = read_header(&mut Source::new(bytes, Some(len)))?;
        let layout = check::header(&header, Some(len))?;
        let mut view = HairView { header, bytes, warnings: check::header_warnings(&header) };
        if len > layout.end {
            view.warnings.push(Warning::TrailingBytes { offset: layout.end, bytes: len - layout.end });
        }
        let mut oddities = Oddities::default();
        view.check_segments(&mut oddities)?;
        view.check_points(&mut oddities)?;
        for field in [Field::Thickness, Field::Transparency, Field::Colors] {
            let mut first = 0;
            for_blocks(view.array::<f32>(field), |block| {
                oddities.values(field, first, block);
                first += block.len() as u64;
                Ok(())
            })?;
        }
        view.warnings.extend(oddities.warnings(&layout));
        Ok(view)
    }

    /// The header.
    #[must_use]
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// What is odd about the file.
    #[must_use]
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// The segments array, if there is one.
    #[must_use]
    pub fn segments(&self) -> Option<ArrayView<'a, u16>> {
        self.array(Field::Segments)
    }

    /// The points array, if there is one.
    #[must_use]
    pub fn points(&self) -> Option<ArrayView<'a, [f32; 3]>> {
        self.array(Field::Points)
    }

    /// The thickness array (diameters), if there is one.
    #[must_use]
    pub fn thickness(&self) -> Option<ArrayView<'a, f32>> {
        self.array(Field::Thickness)
    }

    /// The transparency array, if there is one.
    #[must_use]
    pub fn transparency(&self) -> Option<ArrayView<'a, f32>> {
        self.array(Field::Transparency)
    }

    /// The colours array, if there is one.
    #[must_use]
    pub fn colors(&self) -> Option<ArrayView<'a, [f32; 3]>> {
        self.array(Field::Colors)
    }

    /// The strands in order, each as the range of its points in the per-point arrays.
    pub fn strand_ranges(&self) -> impl Iterator<Item = Range<usize>> + use<'a> {
        let (segments, default) = (self.segments(), self.header.default_segments as usize);
        let mut start = 0;
        (0..self.header.hair_count as usize).map(move |strand| {
            let count = segments.map_or(default, |array| array.get(strand).unwrap_or_default().into());
            let range = start..start + count + 1;
            start = range.end;
            range
        })
    }

    fn array<T: Value>(&self, field: Field) -> Option<ArrayView<'a, T>> {
        let span = self.header.layout().span(field)?;
        let (start, len) = (usize::try_from(span.offset).ok()?, usize::try_from(span.bytes).ok()?);
        Some(ArrayView::new(self.bytes.get(start..start.checked_add(len)?)?))
    }

    fn check_segments(&self, oddities: &mut Oddities) -> Result<(), HairError> {
        let Some(segments) = self.segments() else {
            if self.header.default_segments == 0 {
                oddities.only_one_point_strands(self.header.hair_count.into());
            }
            return Ok(());
        };
        check::point_count(&self.header, segments.iter().map(|s| u64::from(s) + 1).sum())?;
        for (strand, _) in segments.iter().enumerate().filter(|(_, count)| *count == 0) {
            oddities.one_point_strand(strand as u64);
        }
        Ok(())
    }

    fn check_points(&self, oddities: &mut Oddities) -> Result<(), HairError> {
        let (Some(points), Some(span)) = (self.points(), self.header.layout().span(Field::Points)) else {
            return Ok(());
        };
        let (mut first, mut last, mut repeats) = (0, None, false);
        for_blocks(Some(points), |block| {
            check::points(block, first, span.offset)?;
            repeats |= check::neighbours_coincide(block) || last.as_ref() == block.first();
            first += block.len() as u64;
            last = block.last().copied();
            Ok(())
        })?;
        if repeats {
            let mut strand = Vec::new();
            for range in self.strand_ranges() {
                strand.clear();
                points.copy_to(range.clone(), &mut strand);
                oddities.strand(range.start as u64, &strand);
            }
        }
        Ok(())
    }
}

/// Hands the values on in aligned blocks: the array itself, or copies of pieces of it.
fn for_blocks<T: Value>(
    array: Option<ArrayView<'_, T>>,
    mut visit: impl FnMut(&[T]) -> Result<(), HairError>,
) -> Result<(), HairError> {
    const BLOCK: usize = 4096;
    let Some(array) = array else { return Ok(()) };
    if let Some(values) = array.as_slice() {
        return values.chunks(BLOCK).try_for_each(visit);
    }
    let mut block = Vec::with_capacity(BLOCK.min(array.len()));
    for start in (0..array.len()).step_by(BLOCK) {
        block.clear();
        array.copy_to(start..array.len().min(start + BLOCK), &mut block);
        visit(&block)?;
    }
    Ok(())
}
