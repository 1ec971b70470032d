//! Strands bound to a mesh, at any frame of it.

use glam::DVec3;
use groom::Groom;
use groom_binding::{
    Beyond, BindBy, BindOptions, BindReport, Binding, Carrier, CarryMode, CarryOptions, Surface,
};
use hair_render::{Blur, Motion};
use moving_mesh::Pose;

use crate::way::Way;
use crate::{Exposure, FilmedMesh, MovingSceneError};

/// Half of the roots farther off than this part of the mesh are not meant so.
const FAR_ROOTS: f64 = 0.1;

/// A character farther off than so many of its sizes has an origin of its own: one step of a 32-bit number there is a
/// part of its size that shows.
const FAR_CHARACTER: f64 = 16.0;

/// How strands are bound and carried.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bindings {
    /// What says where a root is.
    pub by: BindBy,
    /// The farthest that roots should be from the mesh, in its unit.
    pub limit: Option<f64>,
    /// What becomes of strands beyond it.
    pub beyond: Beyond,
    /// How a strand goes with the mesh.
    pub mode: CarryMode,
    /// How far points stay off the mesh, in its unit; they may enter it where nothing is said.
    pub keep_out: Option<f64>,
    /// What moves farther than this in a frame, in the mesh's unit, jumps: nothing of it is blurred.
    pub teleport: Option<f64>,
}

/// A groom in a mesh's numbers, bound to it.
#[derive(Debug)]
pub struct BoundGroom {
    groom: Groom,
    binding: Binding,
    bindings: Bindings,
}

/// Strands at a frame.
#[derive(Debug)]
pub struct Carried {
    /// The strands in the mesh's unit and axes, relative to `origin`; where `motion` moves them, as at one of its keys.
    pub groom: Groom,
    /// What positions are relative to: 0 but for a character far away.
    pub origin: DVec3,
    /// Their way while the shutter is open, relative to `origin`.
    pub motion: Motion,
    /// Whether anything jumped: the mesh is then not to be blurred either.
    pub jumped: bool,
}

impl BoundGroom {
    /// Binds `groom`, which is in the numbers of `mesh` ([`groom_binding::Alignment::apply`]), to the pose that the mesh calls
    /// its rest. Also what there is to say of it.
    ///
    /// # Errors
    /// [`MovingSceneError::Binding`], and [`MovingSceneError::NothingBound`].
    pub fn bind(
        mut groom: Groom,
        mesh: &FilmedMesh,
        bindings: Bindings,
    ) -> Result<(BoundGroom, Vec<String>), MovingSceneError> {
        let Bindings { by, limit, beyond, .. } = bindings;
        let surface = Surface::of(mesh.mesh());
        let (binding, report) = Binding::new(&groom, &surface, &BindOptions { by, limit, beyond })?;
        if let Some(kept) = &report.kept {
            if kept.is_empty() {
                let (strands, limit) = (report.strands, limit.unwrap_or_default());
                return Err(MovingSceneError::NothingBound { strands, limit });
            }
            groom = groom.keep_strands(kept)?;
        }
        let words = told(&report, &bindings);
        Ok((BoundGroom { groom, binding, bindings }, words))
    }

    /// The strands as they were bound.
    #[must_use]
    pub fn groom(&self) -> &Groom {
        &self.groom
    }

    /// What strands are blurred by: positions, which meet those of the mesh at every key, where nobody says.
    #[must_use]
    pub fn blur(&self, exposure: &Exposure) -> Blur {
        exposure.blur.unwrap_or(Blur::Positions)
    }

    /// The strands at `frame`, at `rate` frames a second where the mesh knows no better; where the mesh was opened for
    /// no frames, as its file stands.
    ///
    /// # Errors
    /// [`MovingSceneError::Mesh`] for a pose that cannot be had, [`MovingSceneError::Binding`], and as [`Motion::keys`].
    pub fn at(
        &self,
        mesh: &FilmedMesh,
        frame: f64,
        exposure: &Exposure,
        rate: f64,
    ) -> Result<Carried, MovingSceneError> {
        let pose = mesh.mesh().pose(mesh.seconds(frame, rate))?;
        let origin = far_origin(&pose);
        let options = CarryOptions {
            mode: self.bindings.mode,
            keep_out: self.bindings.keep_out,
            origin,
            // A frame is as long as the mesh's own.
            teleport: self.bindings.teleport.map(|distance| distance / mesh.seconds(1.0, rate)),
        };
        let mut carrier = Carrier::new(&self.groom, &self.binding, Surface::of(mesh.mesh()), options)?;
        let moves = mesh.mesh().moves() && !exposure.shutter.is_instant();
        let blur = if moves { self.blur(exposure) } else { Blur::Off };
        let teleport = self.bindings.teleport;
        let way = Way { groom: &self.groom, teleport, mesh, exposure, rate, frame };
        let (positions, motion, jumped) = match blur {
            Blur::Off => (way.positions(&mut carrier, &[frame])?.remove(0), Motion::STILL, false),
            Blur::Positions => way.through_positions(&mut carrier)?,
            Blur::Velocities | Blur::Accelerations => way.by_rates(&mut carrier, blur)?,
        };
        let mut groom = self.groom.clone();
        groom.positions_mut().copy_from_slice(&positions);
        Ok(Carried { groom, origin, motion, jumped })
    }
}

/// Where points are measured from: 0 unless the character is far away.
fn far_origin(pose: &Pose) -> DVec3 {
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = pose.positions.iter().fold(empty, |(low, high), p| (low.min(*p), high.max(*p)));
    let middle = 0.5 * (low + high);
    let is_far = middle.length() > FAR_CHARACTER * low.distance(high);
    if is_far && middle.is_finite() { middle.round() } else { DVec3::ZERO }
}

/// What the binding has to say.
fn told(report: &BindReport, bindings: &Bindings) -> Vec<String> {
    let mut told = Vec::new();
    let (size, strands) = (report.mesh_size, report.strands);
    if let Some(median) = report.distance_at(0.5).filter(|&median| median > FAR_ROOTS * size) {
        told.push(format!(
            "half of the roots are {median:.4} and more off the mesh, which is {size:.4} large; \
             `groom-bind --report` says what unit or axis to try"
        ));
    }
    if !report.beyond.is_empty() {
        let what = match bindings.beyond {
            Beyond::Snap => "are moved onto it",
            Beyond::Drop => "are left out",
            Beyond::Keep => "are kept where they are (`beyond: snap` or `drop` would change that)",
        };
        let (count, limit) = (report.beyond.len(), bindings.limit.unwrap_or_default());
        told.push(format!("{count} of {strands} strands are farther than {limit} from the mesh and {what}"));
    }
    let cases = [
        (report.outside.len(), "have a root_uv that no triangle holds; the nearest was taken"),
        (
            report.ambiguous.len(),
            "have a root_uv that several triangles hold; the one nearest in space was taken",
        ),
        (report.without_frame, "are on triangles without an area and will not be turned"),
    ];
    told.extend(
        cases.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} strands {what}")),
    );
    told
}
