//! A groom from the arrays of a file that says little about them.

use glam::Vec3;
use groom::{Attribute, Domain, Groom, UpAxis, Values, names};

use crate::{Format, FormatError, Loaded, ReadOptions, Warning};

/// What was read, before it is known to make a groom.
pub(crate) struct Parts<'a> {
    pub(crate) file: &'a str,
    pub(crate) format: Format,
    /// What is up unless the options say otherwise.
    pub(crate) up_axis: UpAxis,
    /// As in [`Groom::new`], but empty strands may be among them.
    pub(crate) offsets: Vec<u32>,
    pub(crate) positions: Vec<Vec3>,
    /// Fit for the groom without its empty strands.
    pub(crate) attributes: Vec<(String, Attribute)>,
    pub(crate) warnings: Vec<Warning>,
}

impl Parts<'_> {
    /// The groom; `place` says where in the file a point is.
    ///
    /// Empty strands are left out with a warning, and the others then keep their index in the file as
    /// `id`. Points that are not finite are refused unless the options ask for repair.
    pub(crate) fn load(
        mut self,
        options: &ReadOptions,
        place: impl Fn(usize) -> String,
    ) -> Result<Loaded, FormatError> {
        if self.positions.is_empty() {
            return Err(FormatError::invalid(
                self.file,
                "the whole file",
                "no strand with a point",
                "at least one",
            ));
        }
        let bad = |p: &Vec3| !p.is_finite();
        if let Some(index) = self.positions.iter().position(bad).filter(|_| !options.repair) {
            let [x, y, z] = self.positions[index].to_array();
            let found = format!("the point {x} {y} {z}");
            let expected = "finite numbers (repairing leaves such points out)";
            return Err(FormatError::invalid(self.file, place(index), found, expected));
        }
        let ids = self.leave_out_empty();
        let fault = |source| FormatError::groom(self.file, source);
        let mut groom = Groom::new(self.offsets, self.positions).map_err(fault)?;
        groom.up_axis = options.up_axis.unwrap_or(self.up_axis);
        groom.meters_per_unit = options.meters_per_unit.unwrap_or(1.0);
        if let Some(ids) = ids {
            let ids = Attribute { domain: Domain::Strand, values: Values::Int(ids) };
            groom.set_attribute(names::ID, ids).map_err(fault)?;
        }
        for (name, attribute) in self.attributes {
            groom.set_attribute(name, attribute).map_err(fault)?;
        }
        let repairs = if options.repair { groom.repair() } else { Vec::new() };
        self.warnings.extend(zero_length(&groom));
        let repairs = repairs.iter().map(ToString::to_string).collect();
        Ok(Loaded { warnings: self.warnings, repairs, ..Loaded::still(groom) })
    }

    /// Takes empty strands out; the indices of the others, if there were any.
    fn leave_out_empty(&mut self) -> Option<Vec<i32>> {
        let strands = self.offsets.len().saturating_sub(1);
        let filled = self.offsets.windows(2).filter(|pair| pair[0] < pair[1]).count();
        if filled == strands {
            return None;
        }
        let mut ids = Vec::with_capacity(filled);
        let pairs = self.offsets.windows(2).enumerate();
        ids.extend(pairs.filter(|(_, pair)| pair[0] < pair[1]).map(|(strand, _)| strand as i32));
        self.offsets.dedup();
        let (format, strands) = (self.format, strands - filled);
        self.warnings.push(Warning::EmptyStrandsLeftOut { format, strands });
        Some(ids)
    }
}

fn zero_length(groom: &Groom) -> Option<Warning> {
    let (mut count, mut first_point) = (0, 0);
    for strand in 0..groom.strand_count() {
        let range = groom.strand_range(strand);
        for (i, pair) in groom.positions()[range.clone()].windows(2).enumerate() {
            if pair[0] == pair[1] {
                first_point = if count == 0 { range.start + i + 1 } else { first_point };
                count += 1;
            }
        }
    }
    (count > 0).then_some(Warning::ZeroLengthSegments { count, first_point })
}

/// One value a vertex.
pub(crate) fn per_vertex(values: Values) -> Attribute {
    Attribute { domain: Domain::Vertex, values }
}

/// One value a strand.
pub(crate) fn per_strand(values: Values) -> Attribute {
    Attribute { domain: Domain::Strand, values }
}

/// `points` as a u32, or the error that there are too many.
pub(crate) fn offset(points: usize, format: Format, file: &str) -> Result<u32, FormatError> {
    u32::try_from(points).map_err(|_| FormatError::TooLarge {
        file: file.to_owned(),
        format,
        what: "points",
        found: points as u64,
        limit: u32::MAX.into(),
    })
}
