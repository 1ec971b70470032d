//! The camera of each frame: on its circle, in one place, or as a scene file has it.

use std::path::{Path, PathBuf};

use glam::{DMat3, DVec3};
use hair_render::{Bounds, Camera, MovingCamera};
use moving_mesh::{CameraChoice, CameraFile, CameraOptions};
use moving_scene::{Exposure, animation_named, is_stage, outside};

use super::cornell::Room;
use super::views;
use crate::TurntableError;
use crate::schema::{CameraSettings, Pipeline, Turn, Turning};

/// What holds for the camera of all frames.
pub(super) struct Filming {
    settings: CameraSettings,
    turn: Turn,
    aspect: f64,
    file: Option<Filmed>,
}

/// A camera of a scene file.
struct Filmed {
    path: PathBuf,
    camera: CameraFile,
    /// Whether frames are time codes of its own.
    own_rate: bool,
}

/// What a camera frames, and when.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taken {
    pub number: u32,
    /// The frame of the animation, where there is one.
    pub frame: Option<f64>,
    /// Frames a second.
    pub rate: f64,
    pub bounds: Option<Bounds>,
    pub room: Option<Room>,
}

impl Filming {
    pub fn set(pipeline: &Pipeline, base: &Path) -> Result<Filming, TurntableError> {
        let (settings, turn) = (pipeline.camera.clone(), pipeline.turntable.clone());
        let aspect = f64::from(pipeline.render.width) / f64::from(pipeline.render.height);
        let file = settings.file.as_ref().map(|asked| {
            let path = base.join(&asked.path);
            let camera = asked.name.clone().map_or(CameraChoice::First, |name| {
                name.parse().map_or(CameraChoice::Name(name), CameraChoice::Index)
            });
            let animation = animation_named(asked.animation.as_deref());
            let camera = CameraFile::open(&path, &CameraOptions { camera, animation })?;
            let own_rate = is_stage(&path);
            Ok::<_, TurntableError>(Filmed { path, camera, own_rate })
        });
        Ok(Filming { settings, turn, aspect, file: file.transpose()? })
    }

    /// The first frame of the file's own animation, where there is one.
    pub fn first_frame(&self) -> Option<f64> {
        let Filmed { camera, .. } = self.file.as_ref()?;
        Some(camera.time_range()?.0 * camera.frame_rate()?)
    }

    /// Frames a second, as the file says.
    pub fn frame_rate(&self) -> Option<f64> {
        self.file.as_ref().and_then(|file| file.camera.frame_rate())
    }

    /// The camera of a frame, and its way while the shutter is open.
    pub fn camera(&self, taken: &Taken, exposure: &Exposure) -> Result<MovingCamera, TurntableError> {
        let blurred = self.settings.blur && exposure.blurs() && !exposure.shutter.is_instant();
        if !blurred {
            return Ok(self.at(taken, 0.0)?.into());
        }
        let keys = exposure.samples.unwrap_or(2).max(2);
        let times = exposure.shutter.key_times(0.0, keys)?;
        let cameras = times.into_iter().map(|time| self.at(taken, time));
        Ok(MovingCamera::new(cameras.collect::<Result<_, _>>()?)?)
    }

    /// The camera so many frames from the frame itself.
    fn at(&self, taken: &Taken, offset: f64) -> Result<Camera, TurntableError> {
        let number = f64::from(taken.number) + offset;
        // As ever: the azimuth of a frame is within the circle.
        let azimuth = match offset {
            0.0 => views::azimuth(&self.turn, taken.number),
            _ => views::turned(&self.turn, number),
        };
        let turned = match self.turn.turn {
            Turning::Camera => DMat3::IDENTITY,
            // The groom turns, which is to say that camera and lights go round it.
            Turning::Groom => DMat3::from_rotation_y(azimuth.to_radians()),
        };
        if let Some(filmed) = &self.file {
            let seconds = filmed.seconds(taken, offset);
            let pose = filmed.camera.at(seconds)?;
            let (position, target) = (turned * pose.position(), turned * (pose.position() + pose.forward()));
            return Ok(Camera::look_at(position, target, turned * pose.up(), pose.vertical_fov)?);
        }
        let fov = self.settings.fov.to_radians();
        if let Some(position) = self.settings.position {
            let middle = taken.room.map(|room| room.center).or(taken.bounds.map(|bounds| bounds.center()));
            let target = self.settings.target.map_or(middle.unwrap_or(DVec3::ZERO), DVec3::from_array);
            let position = turned * DVec3::from_array(position);
            return Ok(Camera::look_at(position, turned * target, DVec3::Y, fov)?);
        }
        let elevation = views::elevation(&self.turn, &self.settings, number);
        self.orbit(taken, azimuth.to_radians(), elevation.to_radians(), fov)
    }

    fn orbit(&self, taken: &Taken, azimuth: f64, elevation: f64, fov: f64) -> Result<Camera, TurntableError> {
        let fitted = match taken.room {
            None => Camera::fit(taken.bounds, azimuth, elevation, fov, self.aspect)?,
            Some(room) => {
                Camera::orbit(room.center, room.distance(fov, self.aspect), azimuth, elevation, fov)?
            }
        };
        let target = self.settings.target.map_or(fitted.target(), DVec3::from_array);
        let fitted_distance = (fitted.position() - fitted.target()).length() / self.settings.zoom;
        let distance = self.settings.distance.unwrap_or(fitted_distance);
        Ok(Camera::orbit(target, distance, azimuth, elevation, fov)?)
    }

    /// What there is to say of the camera of a frame.
    pub fn words(&self, taken: &Taken) -> Vec<String> {
        let mut words = Vec::new();
        if let Some(Filmed { path, camera, .. }) = &self.file {
            let rate = camera.frame_rate().unwrap_or(taken.rate);
            let frames = camera.time_range().map(|(start, end)| (start * rate, end * rate));
            let frame = self.file.as_ref().map(|filmed| filmed.seconds(taken, 0.0) * rate);
            words.extend(frame.zip(frames).and_then(|(frame, frames)| outside(path, frame, frames)));
            let aspect = camera.at(0.0).ok().and_then(|pose| pose.aspect);
            if let Some(aspect) = aspect.filter(|aspect| (aspect / self.aspect - 1.0).abs() > 0.01) {
                words.push(format!(
                    "{}: the camera's picture is {aspect:.3} as wide as high, `render` says {:.3}; what it sees from \
                     bottom to top is kept",
                    path.display(),
                    self.aspect
                ));
            }
        } else if let (Some(room), Turning::Camera) = (taken.room, self.turn.turn)
            && let Ok(camera) = self.at(taken, 0.0)
        {
            let from = camera.position() - room.center;
            let is_before = from.z >= 0.5 * room.edge && from.z >= from.x.abs();
            if !is_before && from.abs().max_element() > 0.5 * room.edge {
                words.push(
                    "lights.cornell: the camera looks at the box from outside of a wall; with `turntable.turn: groom` \
                     the open side stays before it"
                        .to_owned(),
                );
            }
        }
        words
    }
}

impl Filmed {
    fn seconds(&self, taken: &Taken, offset: f64) -> f64 {
        let own = self.camera.frame_rate();
        let rate = if self.own_rate { own.unwrap_or(taken.rate) } else { taken.rate };
        match taken.frame {
            Some(frame) => (frame + offset) / rate,
            // Without an animation of anything else, its own: a frame of it each.
            None => {
                let start = self.camera.time_range().map_or(0.0, |(start, _)| start);
                start + (f64::from(taken.number) - 1.0 + offset) / own.unwrap_or(rate)
            }
        }
    }
}
