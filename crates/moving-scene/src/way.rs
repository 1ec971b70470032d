//! The way of bound strands through one picture.

use glam::Vec3;
use groom::Groom;
use groom_binding::{Carrier, Moved, Stencil};
use hair_render::{Blur, Motion, Movement};
use moving_mesh::Pose;

use crate::{Exposure, FilmedMesh, MovingSceneError};

/// Frames before a picture at which strands look for the last frame their triangle had, where it has collapsed.
const RUN_UP: f64 = 240.0;

/// Strands on their way through one picture.
pub(crate) struct Way<'a> {
    /// As they were bound.
    pub groom: &'a Groom,
    /// What moves farther than this in a frame, in the mesh's unit, jumps.
    pub teleport: Option<f64>,
    pub mesh: &'a FilmedMesh,
    pub exposure: &'a Exposure,
    pub rate: f64,
    pub frame: f64,
}

impl Way<'_> {
    fn pose(&self, time: f64) -> Result<Pose, MovingSceneError> {
        Ok(self.mesh.mesh().pose(self.mesh.seconds(time, self.rate))?)
    }

    /// The points at some times, in frames and rising. Strands on a triangle that has collapsed keep the last frame it
    /// had in the animation, whichever pictures were made before this one.
    pub fn positions(
        &self,
        carrier: &mut Carrier<'_>,
        times: &[f64],
    ) -> Result<Vec<Vec<Vec3>>, MovingSceneError> {
        let go = |carrier: &mut Carrier<'_>| -> Result<(Vec<Vec<Vec3>>, bool), MovingSceneError> {
            let (mut all, mut held) = (Vec::with_capacity(times.len()), false);
            for &time in times {
                let mut points = Vec::new();
                held |= carrier.positions(&self.pose(time)?, &mut points)?.held > 0;
                all.push(points);
            }
            Ok((all, held))
        };
        carrier.reset();
        let (all, held) = go(carrier)?;
        if !held {
            return Ok(all);
        }
        self.run_up(carrier, times)?;
        Ok(go(carrier)?.0)
    }

    /// Shows the carrier the frames of the animation before the first of some times.
    fn run_up(&self, carrier: &mut Carrier<'_>, times: &[f64]) -> Result<(), MovingSceneError> {
        carrier.reset();
        let (Some(&first), Some((start, _))) = (times.first(), self.mesh.frames(self.rate)) else {
            return Ok(());
        };
        let mut unused = Vec::new();
        let mut time = start.floor().max((first - RUN_UP).floor());
        while time < first {
            carrier.positions(&self.pose(time)?, &mut unused)?;
            time += 1.0;
        }
        Ok(())
    }

    /// Positions at the keys of the shutter. What jumps between two of them stands where it is at the frame.
    pub fn through_positions(
        &self,
        carrier: &mut Carrier<'_>,
    ) -> Result<(Vec<Vec3>, Motion, bool), MovingSceneError> {
        let times = self.mesh.key_times(self.frame, self.exposure)?;
        let mut keys = self.positions(carrier, &times)?;
        let jumping = self.jumping(&keys, &times);
        let middle = if jumping.is_empty() {
            keys.get(keys.len() / 2).cloned().unwrap_or_default()
        } else {
            let own = self.positions(carrier, &[self.frame])?.remove(0);
            for strand in &jumping {
                let range = self.groom.strand_range(*strand);
                for key in &mut keys {
                    key[range.clone()].copy_from_slice(&own[range.clone()]);
                }
            }
            own
        };
        Ok((middle, Motion::keys(keys)?, !jumping.is_empty()))
    }

    /// Strands whose root jumps between two keys.
    fn jumping(&self, keys: &[Vec<Vec3>], times: &[f64]) -> Vec<usize> {
        let Some(teleport) = self.teleport else { return Vec::new() };
        let groom = self.groom;
        let jumps = |strand: &usize| {
            let range = groom.strand_range(*strand);
            !range.is_empty()
                && keys.windows(2).zip(times.windows(2)).any(|(keys, times)| {
                    let way = keys[0][range.start].as_dvec3().distance(keys[1][range.start].as_dvec3());
                    way > teleport * (times[1] - times[0])
                })
        };
        (0..groom.strand_count()).filter(jumps).collect()
    }

    /// Velocities at the frame, and accelerations where they are asked for.
    pub fn by_rates(
        &self,
        carrier: &mut Carrier<'_>,
        blur: Blur,
    ) -> Result<(Vec<Vec3>, Motion, bool), MovingSceneError> {
        let shutter = &self.exposure.shutter;
        let reach = self.mesh.seconds(0.5 * (shutter.close() - shutter.open()), self.rate);
        let seconds = self.mesh.seconds(self.frame, self.rate);
        let stencil = Stencil::new(seconds, reach, self.mesh.mesh().time_range())?;
        let [before, at, after] = stencil.times().map(|time| self.mesh.mesh().pose(time));
        let (poses, mut moved) = ([before?, at?, after?], Moved::default());
        let accelerations = blur == Blur::Accelerations;
        let mut go =
            |carrier: &mut Carrier<'_>| carrier.moved(&stencil, poses.each_ref(), accelerations, &mut moved);
        let mut report = go(carrier)?;
        if report.held > 0 {
            self.run_up(carrier, &[self.frame])?;
            report = go(carrier)?;
        }
        let Moved { positions, velocities, accelerations } = moved;
        let movement = Movement {
            positions: &positions,
            velocities: Some(&velocities),
            accelerations: accelerations.as_deref(),
            other_times: false,
        };
        let rate = 1.0 / self.mesh.seconds(1.0, self.rate);
        let nowhere = |_| Ok::<_, MovingSceneError>(Vec::new());
        let keys = self.exposure.keys(blur);
        let motion = movement.motion(blur, shutter, (self.frame, rate), keys, nowhere)?;
        Ok((positions, motion, report.teleported > 0))
    }
}
