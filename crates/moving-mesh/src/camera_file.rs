//! Cameras that stand in a file, at any time.

use std::path::{Path, PathBuf};

use glam::{DMat3, DMat4, DVec3, DVec4};

use crate::error::Fault;
use crate::{AnimationChoice, CameraChoice, MeshError, gltf_file, usd_file};

/// How [`CameraFile::open`] reads a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CameraOptions {
    /// Which of the file's cameras.
    pub camera: CameraChoice,
    /// Which of the file's animations moves it (glTF; a stage holds one). [`AnimationChoice::First`] is the first
    /// that moves this camera: exporters write an animation an object.
    pub animation: AnimationChoice,
}

/// A perspective camera of a glTF file or a USD stage, at any time.
///
/// ```no_run
/// use moving_mesh::{CameraChoice, CameraFile, CameraOptions};
///
/// let options = CameraOptions { camera: CameraChoice::Name("Side".into()), ..CameraOptions::default() };
/// let camera = CameraFile::open("shot.usdc", &options)?;
/// let pose = camera.at(0.5)?;
/// println!("{} stands at {} metres", camera.name(), pose.position());
/// # Ok::<(), moving_mesh::MeshError>(())
/// ```
#[derive(Debug)]
pub struct CameraFile {
    path: PathBuf,
    names: Vec<String>,
    chosen: usize,
    track: Track,
}

/// A camera as a reader of a format hands it over.
#[derive(Debug)]
pub(crate) struct Read {
    /// Of all cameras in the file.
    pub(crate) names: Vec<String>,
    pub(crate) chosen: usize,
    pub(crate) track: Track,
}

/// What gives the camera its poses.
#[derive(Debug)]
pub(crate) enum Track {
    Gltf(Box<gltf_file::GltfCamera>),
    Usd(Box<usd_file::UsdCamera>),
}

/// Where a camera is and how wide it sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraPose {
    /// From the camera's space to the world: metres, Y up. The camera looks along its -Z with +Y upwards in the
    /// picture. Turns and moves only: what a file scales or shears is taken out.
    pub world: DMat4,
    /// The whole angle from the lower to the upper edge of the picture, in radians.
    pub vertical_fov: f64,
    /// Width of the picture over its height, where the file says.
    pub aspect: Option<f64>,
}

impl CameraPose {
    /// Where the camera stands, in world metres.
    #[must_use]
    pub fn position(&self) -> DVec3 {
        self.world.w_axis.truncate()
    }

    /// The direction it looks in, of length 1.
    #[must_use]
    pub fn forward(&self) -> DVec3 {
        -self.world.z_axis.truncate()
    }

    /// What is upwards in the picture, of length 1.
    #[must_use]
    pub fn up(&self) -> DVec3 {
        self.world.y_axis.truncate()
    }
}

impl CameraFile {
    /// Reads a camera of `.gltf`, `.glb`, `.usd`, `.usda`, `.usdc` or `.usdz`, told apart by the ending.
    ///
    /// # Errors
    /// [`MeshError`]: the file cannot be read or breaks its format's rules; it has no such camera
    /// ([`MeshError::NoCamera`] lists those there are) or animation; the camera is orthographic, shifts its lens or
    /// comes by composition, which is not supported.
    pub fn open(path: impl AsRef<Path>, options: &CameraOptions) -> Result<Self, MeshError> {
        let path = path.as_ref();
        let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let read: fn(&Path, &CameraOptions) -> Result<Read, Fault> = match ending.as_str() {
            "gltf" | "glb" => gltf_file::read_camera,
            "usd" | "usda" | "usdc" | "usdz" => usd_file::read_camera,
            _ => {
                return Err(MeshError::Unsupported {
                    path: path.to_owned(),
                    what: format!("the ending `.{ending}` of a camera's file"),
                    remedy: "use .gltf, .glb, .usd, .usda, .usdc or .usdz",
                });
            }
        };
        let Read { names, chosen, track } = read(path, options).map_err(|fault| fault.in_file(path))?;
        Ok(CameraFile { path: path.to_owned(), names, chosen, track })
    }

    /// All cameras of the file: names of nodes in glTF, paths of prims in USD.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The name of this one.
    #[must_use]
    pub fn name(&self) -> &str {
        self.names.get(self.chosen).map_or("", String::as_str)
    }

    /// Times of the first and last key that may move it or its lens, in seconds; `None` where none does.
    #[must_use]
    pub fn time_range(&self) -> Option<(f64, f64)> {
        match &self.track {
            Track::Gltf(camera) => camera.time_range(),
            Track::Usd(camera) => camera.time_range(),
        }
    }

    /// Frames a second, as [`crate::MovingMesh::frame_rate`] has them.
    #[must_use]
    pub fn frame_rate(&self) -> Option<f64> {
        match &self.track {
            Track::Gltf(camera) => camera.frame_rate(),
            Track::Usd(camera) => Some(camera.frame_rate()),
        }
    }

    /// The camera at `time`, in seconds; before the first key and after the last it stands as it does there.
    ///
    /// # Errors
    /// [`MeshError::Parameter`] for a time that is no number; [`MeshError::Invalid`] for a camera whose transform
    /// leaves it no direction to look in, or whose lens sees no angle.
    pub fn at(&self, time: f64) -> Result<CameraPose, MeshError> {
        if !time.is_finite() {
            return Err(MeshError::Parameter { name: "time", value: time, range: "a finite number" });
        }
        let pose = match &self.track {
            Track::Gltf(camera) => camera.at(time),
            Track::Usd(camera) => camera.at(time),
        };
        pose.map_err(|fault| fault.below(&format!("camera {:?}", self.name())).in_file(&self.path))
    }
}

/// A camera's view by its transform in metres, Y up.
pub(crate) fn pose(world: DMat4, vertical_fov: f64, aspect: Option<f64>) -> Result<CameraPose, Fault> {
    if !(vertical_fov > 0.0 && vertical_fov < std::f64::consts::PI) {
        let found = format!("a vertical field of view of {} degrees", vertical_fov.to_degrees());
        return Err(Fault::invalid("lens", format!("{found}, expected one between 0 and 180")));
    }
    let world = rigid(&world).ok_or_else(|| {
        let found = format!("{:?}", world.to_cols_array());
        Fault::invalid(
            "transform",
            format!("{found} leaves no direction to look in, expected one that turns"),
        )
    })?;
    Ok(CameraPose { world, vertical_fov, aspect })
}

/// Turn and place of a transform, without what scales, shears or mirrors: the view direction counts, then "up".
fn rigid(world: &DMat4) -> Option<DMat4> {
    let turned = DMat3::from_mat4(*world);
    // Brought near 1 first: squares of small numbers vanish.
    let unit = |v: DVec3| {
        let most = v.abs().max_element();
        (most > 0.0 && most.is_finite()).then(|| v / most)?.try_normalize()
    };
    let back = unit(turned.z_axis)?;
    let above = unit(turned.y_axis)?;
    let right = above.cross(back);
    let right = (right.length() > 1e-9).then(|| right.normalize())?;
    let place = world.w_axis;
    let sound = place.is_finite() && place.w == 1.0;
    let column = |v: DVec3| DVec4::from((v, 0.0));
    sound.then(|| DMat4::from_cols(column(right), column(back.cross(right)), column(back), place))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_scales_and_shears_is_taken_out() {
        let turn = DMat4::from_rotation_y(0.7) * DMat4::from_rotation_x(-0.3);
        let place = DMat4::from_translation(DVec3::new(1e6, 2.0, -3e6));
        for scale in [DVec3::ONE, DVec3::new(2.0, 0.5, 3.0), DVec3::splat(1e-200), DVec3::new(-1.0, 1.0, 1.0)]
        {
            let found = rigid(&(place * turn * DMat4::from_scale(scale))).unwrap();
            assert!(found.abs_diff_eq(place * turn, 1e-9), "{scale}: {found}");
        }
        for flat in [DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.0, 0.0, 1.0), DVec3::ZERO] {
            assert_eq!(rigid(&DMat4::from_scale(flat)), None, "{flat}");
        }
        assert_eq!(rigid(&DMat4::from_translation(DVec3::NAN)), None);
    }
}
