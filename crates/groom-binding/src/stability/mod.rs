//! What strands do on meshes that do what no mesh should: a table of cases, run by the tests and by whoever wants to
//! see it.
//!
//! Every case moves a mesh along a known motion and spoils something on the way. What is told of it is what the rigid
//! carry promises: heights, lengths, numbers that are numbers, and no strand that turns over by itself.

mod cases;
mod shapes;

use glam::{DAffine3, DMat3, DVec3, Vec3};
use groom::Groom;
use moving_mesh::Pose;

use crate::root::place;
use crate::{BindOptions, Binding, BindingError, RootFrames, Surface, carry_rigid};
use shapes::Mesh;

/// One row of the table: a mesh, what is done to it, and the strands on it.
pub struct StabilityCase {
    name: &'static str,
    mesh: Mesh,
    groom: Groom,
    /// The motion that the mesh makes by and large, one a pose.
    motions: Vec<DAffine3>,
    /// What is done to the vertices after the motion, by the number of the pose.
    spoil: fn(&Mesh, usize, &mut [DVec3]),
    /// Whether the mesh does nothing but the motion, so that one knows where every point belongs.
    is_rigid: bool,
}

/// What came of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct StabilityRow {
    /// The case.
    pub case: &'static str,
    /// Strands that were bound.
    pub strands: usize,
    /// Poses they were carried to.
    pub poses: usize,
    /// The most that a root's distance from its place ever differed from its bound height, in sizes of the mesh at
    /// rest, after rounding to f32.
    pub height_error: f64,
    /// The most that the length of a segment ever differed from its length at rest, as a share of it, before rounding
    /// to f32.
    pub length_error: f64,
    /// The same after rounding, in sizes of the mesh at rest.
    pub rounded_length_error: f64,
    /// The most that a point ever was from where the motion of the mesh would have it, in sizes of the mesh at rest;
    /// `None` when the mesh does more than move.
    pub misplaced: Option<f64>,
    /// Points that ever were not finite.
    pub not_finite: usize,
    /// How often a strand was turned by more than 90 degrees away from the motion of the mesh.
    pub flips: usize,
    /// How often a strand kept the rotation of an earlier pose.
    pub held: usize,
}

/// All cases.
///
/// # Errors
/// None that could be met: the cases' grooms are made by the same rules as all others.
pub fn cases() -> Result<Vec<StabilityCase>, BindingError> {
    Ok(cases::all()?)
}

impl Mesh {
    fn surface(&self) -> Surface<'_> {
        Surface { triangles: &self.triangles, rest: &self.rest, uvs: Some(&self.uvs) }
    }
}

impl StabilityCase {
    /// What the case is called.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Binds the strands, carries them to every pose in turn, and tells what came of it.
    ///
    /// # Errors
    /// What [`Binding::new`] and [`RootFrames::follow`] refuse; no case is meant to be.
    pub fn run(&self) -> Result<StabilityRow, BindingError> {
        let surface = self.mesh.surface();
        let (binding, _) = Binding::new(&self.groom, &surface, &BindOptions::default())?;
        let mut frames = RootFrames::new(&binding, surface)?;
        let mut row = StabilityRow {
            case: self.name,
            strands: binding.strand_count(),
            poses: self.motions.len(),
            height_error: 0.0,
            length_error: 0.0,
            rounded_length_error: 0.0,
            misplaced: self.is_rigid.then_some(0.0),
            not_finite: 0,
            flips: 0,
            held: 0,
        };
        let mut out = Vec::new();
        for (number, motion) in self.motions.iter().enumerate() {
            let mut pose = self.mesh.posed(|p| motion.transform_point3(p));
            (self.spoil)(&self.mesh, number, &mut pose.positions);
            frames.follow(&pose)?;
            // Relative to where the character is, as a program would write it.
            let origin = motion.translation;
            carry_rigid(&self.groom, &frames, origin, &mut out)?;
            let seen = Seen { case: self, frames: &frames, pose: &pose, motion, origin, out: &out };
            seen.count(&mut row);
        }
        Ok(row)
    }
}

/// The strands at one pose.
struct Seen<'a> {
    case: &'a StabilityCase,
    frames: &'a RootFrames<'a>,
    pose: &'a Pose,
    motion: &'a DAffine3,
    origin: DVec3,
    out: &'a [Vec3],
}

impl Seen<'_> {
    fn count(&self, row: &mut StabilityRow) {
        let Seen { case, frames, pose, motion, origin, out } = *self;
        let surface = case.mesh.surface();
        let size = match surface.size() {
            size if size > 0.0 => size,
            _ => 1.0,
        };
        row.held += frames.held();
        row.not_finite += out.iter().filter(|p| !p.is_finite()).count();
        for (strand, root) in frames.binding().roots().iter().enumerate() {
            let rigid = frames.motion(strand);
            row.flips += usize::from(is_turned_away(rigid.turn, motion.matrix3));
            let range = case.groom.strand_range(strand);
            let (rest, moved) = (case.groom.strand(strand), &out[range]);
            let at = place(surface.corners(&pose.positions, root.triangle), root.barycentrics) - origin;
            let height = moved.first().map_or(f64::NAN, |root| root.as_dvec3().distance(at));
            row.height_error = worst(row.height_error, (height - root.height.abs()).abs() / size);
            for (before, after) in rest.windows(2).zip(moved.windows(2)) {
                let [a, b] = [before[0], before[1]].map(Vec3::as_dvec3);
                let length = a.distance(b);
                let exact = rigid.apply(a).distance(rigid.apply(b));
                let rounded = after[0].as_dvec3().distance(after[1].as_dvec3());
                row.length_error = worst(row.length_error, (exact / length - 1.0).abs());
                row.rounded_length_error = worst(row.rounded_length_error, (rounded - length).abs() / size);
            }
            if let Some(misplaced) = &mut row.misplaced {
                for (before, after) in rest.iter().zip(moved) {
                    let expected = motion.transform_point3(before.as_dvec3()) - origin;
                    *misplaced = worst(*misplaced, expected.distance(after.as_dvec3()) / size);
                }
            }
        }
    }
}

/// The greater one; not-a-number is greater than anything.
fn worst(a: f64, b: f64) -> f64 {
    if b.is_nan() || b > a { b } else { a }
}

/// Whether two turns are more than 90 degrees apart, or one a mirror and the other not.
fn is_turned_away(a: DMat3, b: DMat3) -> bool {
    let between = a * b.transpose();
    let trace = between.x_axis.x + between.y_axis.y + between.z_axis.z;
    let (one, other) = (a.determinant(), b.determinant());
    trace < 1.0 || one * other < 0.0
}
