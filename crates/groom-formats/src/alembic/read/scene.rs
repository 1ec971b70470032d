//! All curves of an archive as one groom.

use glam::{DVec3, Vec3};
use groom::{Attribute, Domain, UpAxis, Values, names};
use ogawa::{Archive, CompoundReader, OgawaError};

use super::curves::Curves;
use super::time::Clock;
use super::tree::Tree;
use super::values::Samples;
use super::xform::world_from_node;
use super::{fault, params};
use crate::alembic::schema;
use crate::join::{self, Part};
use crate::polylines::Polylines;
use crate::{Format, FormatError, Frame, Loaded, ReadOptions, Warning};

/// The curves of an archive at a time.
pub(super) struct Scene<'a> {
    file: &'a str,
    tree: Tree<'a>,
    samples: Samples,
    /// When points or what moves them change, in frames.
    pub(super) times: Vec<f64>,
    /// Where positions are measured from.
    pub(super) origin: DVec3,
}

impl<'a> Scene<'a> {
    pub(super) fn new(
        archive: &'a Archive<'a>,
        file: &'a str,
        file_len: usize,
        time: Option<f64>,
    ) -> Result<Self, FormatError> {
        let error = |error| fault(file, "", error);
        let tree = Tree::new(archive, file_len).map_err(error)?;
        if tree.curves.is_empty() {
            let expected = "one or more objects with the schema AbcGeom_Curve_v2";
            return Err(FormatError::invalid(file, "objects", "no curves", expected));
        }
        let samples = Samples::new(Clock::new(archive), time, file_len);
        let times = times(&tree, &samples).map_err(error)?;
        Ok(Scene { file, tree, samples, times, origin: DVec3::ZERO })
    }

    /// Measures positions from where the first curves stand.
    pub(super) fn keep_origin(&mut self) -> Result<(), FormatError> {
        if let Some(&(node, _)) = self.tree.curves.first() {
            let world = world_from_node(&self.tree, node, &self.samples);
            let origin = world.map_err(|error| self.fault(0, error))?.w_axis.truncate();
            if !origin.is_finite() {
                let place = format!("place of {}", self.tree.path(Some(node)));
                return Err(FormatError::invalid(self.file, place, origin.to_string(), "finite numbers"));
            }
            self.origin = origin;
        }
        Ok(())
    }

    pub(super) fn load(&self, options: &ReadOptions) -> Result<(Loaded, Vec<Polylines>), FormatError> {
        let mut warnings = Vec::new();
        let (mut parts, mut cuts, mut empty) = (Vec::new(), Vec::new(), 0);
        let mut positions: Vec<Vec3> = Vec::new();
        let mut places: Vec<i32> = Vec::new();
        for index in 0..self.tree.curves.len() {
            let curves = self.curves(index, options, None)?;
            let attributes = params::read(&curves, &self.samples, &mut warnings);
            let attributes = attributes.map_err(|error| self.fault(index, error))?;
            if let Some(error) = curves.polylines.coarser {
                warnings.push(Warning::CurvesCoarser { error });
            }
            let strand_lens = curves.polylines.strand_lens().collect();
            parts.push(Part { strand_lens, points: curves.positions.len(), attributes });
            let counts = &curves.polylines.counts;
            let missing = counts.iter().filter(|&&count| count == 0).count();
            if missing > 0 {
                empty += missing;
                places.extend((0..).zip(counts).filter(|(_, count)| **count > 0).map(|(place, _)| place));
            }
            // The first object, often the only one, gives its points away.
            if positions.is_empty() {
                positions = curves.positions;
            } else {
                positions.extend(curves.positions);
            }
            cuts.push(curves.polylines);
        }
        let take = |name: &str, count: usize, size: usize| {
            let taken = self.samples.spend(count.saturating_mul(size), name);
            taken.map_err(|error| self.fault(0, error))
        };
        let mut groom = join::groom(parts, positions, Format::Alembic, self.file, &take, &mut warnings)?;
        if empty > 0 {
            warnings.push(Warning::EmptyStrandsLeftOut { format: Format::Alembic, strands: empty });
            if groom.attribute(names::ID).is_none() && self.tree.curves.len() == 1 {
                let ids = Attribute { domain: Domain::Strand, values: Values::Int(places) };
                groom.set_attribute(names::ID, ids).map_err(|e| FormatError::groom(self.file, e))?;
            }
        }
        let space = self.space().map_err(|error| self.fault(0, error))?;
        groom.up_axis = options.up_axis.or(space.0).unwrap_or_default();
        groom.meters_per_unit = options.meters_per_unit.or(space.1).unwrap_or(1.0);
        let repairs = if options.repair { groom.repair() } else { Vec::new() };
        let repairs = repairs.iter().map(ToString::to_string).collect();
        let mut loaded = Loaded { warnings, repairs, origin: self.origin, ..Loaded::still(groom) };
        if self.times.len() > 1 {
            loaded.times.clone_from(&self.times);
            loaded.frame_rate = Some(self.samples.clock.frame_rate);
        }
        Ok((loaded, cuts))
    }

    /// Positions and velocities alone; the curves must be those of `cuts`.
    pub(super) fn frame(
        &self,
        time: f64,
        options: &ReadOptions,
        cuts: &[Polylines],
    ) -> Result<Frame, FormatError> {
        let mut frame = Frame { time, ..Frame::default() };
        let mut velocities: Option<Vec<Vec3>> = None;
        let mut all = true;
        for (index, cut) in cuts.iter().enumerate() {
            let curves = self.curves(index, options, Some(cut))?;
            match curves.velocities(&self.samples).map_err(|error| self.fault(index, error))? {
                Some(more) => velocities.get_or_insert_default().extend(more),
                None => all = false,
            }
            if frame.positions.is_empty() {
                frame.positions = curves.positions;
            } else {
                frame.positions.extend(curves.positions);
            }
        }
        frame.velocities = velocities.filter(|_| all);
        Ok(frame)
    }

    fn curves(
        &self,
        index: usize,
        options: &ReadOptions,
        like: Option<&Polylines>,
    ) -> Result<Curves<'a>, FormatError> {
        let (node, geometry) = self.tree.curves[index];
        let read = || {
            let mut world = world_from_node(&self.tree, node, &self.samples)?;
            world.w_axis -= self.origin.extend(0.0);
            Curves::read(geometry, &self.samples, options.curve_error, world, like)
        };
        read().map_err(|error| self.fault(index, error))
    }

    /// What the numbers mean, where our writer said so.
    fn space(&self) -> Result<(Option<UpAxis>, Option<f64>), OgawaError> {
        let Some((_, geometry)) = self.tree.curves.first() else { return Ok((None, None)) };
        let Some(user) = geometry.find(schema::USER)?.map(|p| p.compound()).transpose()? else {
            return Ok((None, None));
        };
        let sample = |user: &CompoundReader<'a>, name: &str| {
            let property = user.find(name)?.filter(|property| property.sample_count() > 0);
            property.map(|property| property.sample(0)).transpose()
        };
        let axis = match sample(&user, schema::UP_AXIS)?.map(|text| text.texts()).transpose()?.as_deref() {
            Some(["z"]) => Some(UpAxis::Z),
            Some(["y"]) => Some(UpAxis::Y),
            _ => None,
        };
        let unit = sample(&user, schema::METERS_PER_UNIT)?.map(|unit| unit.to_f64()).transpose()?;
        let unit = unit.and_then(|unit| unit.first().copied()).filter(|v| v.is_finite() && *v > 0.0);
        Ok((axis, unit))
    }

    fn fault(&self, index: usize, error: OgawaError) -> FormatError {
        let node = self.tree.curves.get(index).map(|(node, _)| *node);
        fault(self.file, &self.tree.path(node), error)
    }
}

/// Every time at which something has a sample, in order.
fn times(tree: &Tree<'_>, samples: &Samples) -> Result<Vec<f64>, OgawaError> {
    let mut all: Vec<f64> = Vec::new();
    let points = tree.curves.iter().map(|(_, geometry)| geometry.find(schema::POINTS));
    let moving = tree.nodes.iter().filter_map(|node| node.xform).map(|xform| xform.find(schema::CHANNELS));
    for property in points.chain(moving) {
        let Some(property) = property? else { continue };
        if !property.is_constant() {
            let bytes = usize::try_from(property.sample_count()).unwrap_or(usize::MAX).saturating_mul(8);
            samples.spend(bytes, property.name())?;
            let frames = samples.clock.frames(&property)?;
            if all != frames {
                all.extend(frames);
            }
        }
    }
    all.sort_by(f64::total_cmp);
    all.dedup();
    Ok(all)
}
