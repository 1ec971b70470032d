//! What the camera frames, and how large a room about it is: everything that is seen in any of the pictures.

use hair_render::{Blur, Bounds, HairMaterial, HairObject, SceneDescription};
use moving_scene::{Exposure, FilmedMesh, GroomAt};

use super::cornell::Room;
use super::hair::Hair;
use super::meshes::Body;
use crate::TurntableError;
use crate::schema::Pipeline;

/// At how many times what moves is looked at, evenly from the first picture to the last. Not at the pictures' own:
/// half as many at twice the step are framed alike, and a task of a thousand frames does not look at all of them.
const LOOKS: u32 = 17;

/// What is framed in all pictures.
#[derive(Clone, Copy, Debug)]
pub(super) struct Framing {
    pub bounds: Option<Bounds>,
    pub room: Option<Room>,
}

impl Framing {
    pub fn of(pipeline: &Pipeline, bounds: Option<Bounds>) -> Framing {
        let room = pipeline.lights.cornell.as_ref().map(|settings| Room::about(bounds, settings));
        Framing { bounds, room }
    }
}

/// Whether what there is to see says where the camera stands, or how large the room is.
pub(super) fn is_by_contents(pipeline: &Pipeline) -> bool {
    let camera = &pipeline.camera;
    let is_placed = camera.target.is_some() && (camera.position.is_some() || camera.distance.is_some());
    pipeline.lights.cornell.is_some() || camera.file.is_none() && !is_placed
}

/// How many frames of the animation pass from the first picture to the last; below 0 where it runs backwards.
pub(super) fn length(pipeline: &Pipeline) -> f64 {
    let step = pipeline.motion.as_ref().map_or(1.0, |motion| motion.step);
    step * f64::from(pipeline.turntable.frames.saturating_sub(1))
}

/// First and last frame of the animation that is shown.
pub(super) fn shown(pipeline: &Pipeline, first: f64) -> (f64, f64) {
    let last = first + length(pipeline);
    (first.min(last), first.max(last))
}

/// What moves, as far as a box about it needs.
pub(super) struct Moving<'a> {
    pub hair: &'a Hair,
    pub body: Option<&'a Body>,
    pub exposure: &'a Exposure,
    /// Frames a second.
    pub rate: f64,
}

impl Moving<'_> {
    /// The box about everything between two frames. The shutter does not count: a picture with blur and one without are
    /// framed alike, and can be compared.
    pub fn bounds(&self, (first, last): (f64, f64)) -> Result<Option<Bounds>, TurntableError> {
        let sharp = Exposure { blur: Some(Blur::Off), ..self.exposure.clone() };
        let mut strands = Strands::of(self.hair)?;
        let mesh = self.body.and_then(Body::filmed).map(|filmed| &filmed.mesh);
        let mut all: Option<Bounds> = None;
        for look in 0..LOOKS {
            let frame = first + (last - first) * f64::from(look) / f64::from(LOOKS - 1);
            let posed = self.body.map(|body| body.posed(Some(frame), self.rate, &sharp, true)).transpose()?;
            let meshes = posed.map(|posed| posed.objects).unwrap_or_default();
            let hair = strands.at(frame, mesh, &sharp, self.rate)?;
            let description = SceneDescription { hair, meshes, ..SceneDescription::default() };
            all = [all, description.bounds()].into_iter().flatten().reduce(Bounds::union);
        }
        Ok(all)
    }
}

/// Strands at one time after the other; a file is opened once.
enum Strands<'a> {
    Still(&'a Hair),
    Filmed { groom: Box<GroomAt>, object: Box<HairObject>, scale: f32 },
}

impl<'a> Strands<'a> {
    fn of(hair: &'a Hair) -> Result<Strands<'a>, TurntableError> {
        let Hair::Filmed { path, options, attributes } = hair else { return Ok(Strands::Still(hair)) };
        let groom = Box::new(GroomAt::read(path, options, None)?);
        let scale = attributes.scale.unwrap_or(1.0);
        // Thinned or not: who is left goes as far.
        let still = HairObject::still(groom.loaded.groom.clone(), HairMaterial::default());
        let object = Box::new(HairObject { origin: groom.loaded.origin * f64::from(scale), ..still });
        Ok(Strands::Filmed { groom, object, scale })
    }

    fn at(
        &mut self,
        frame: f64,
        mesh: Option<&FilmedMesh>,
        exposure: &Exposure,
        rate: f64,
    ) -> Result<Vec<HairObject>, TurntableError> {
        match self {
            Strands::Still(hair) => {
                let strands = hair.strands(Some(frame), rate, mesh, exposure, &HairMaterial::default())?;
                Ok(vec![strands.object])
            }
            Strands::Filmed { groom, object, scale } => {
                let positions = groom.positions_at(frame)?;
                for (to, from) in object.groom.positions_mut().iter_mut().zip(positions) {
                    *to = from * *scale;
                }
                Ok(vec![HairObject::clone(object)])
            }
        }
    }
}
