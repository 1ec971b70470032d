//! How the groom is framed.

use super::Check;
use crate::schema::{CameraFile, CameraSettings};

/// What cameras are read from.
const CAMERAS: [&str; 6] = ["gltf", "glb", "usd", "usda", "usdc", "usdz"];

impl Check<'_> {
    pub(super) fn camera(&mut self, camera: &CameraSettings) {
        let fov = camera.fov;
        self.need(fov > 0.0 && fov < 180.0, "camera.fov", fov, "above 0, below 180 degrees");
        let ends =
            [("camera.elevation", Some(camera.elevation)), ("camera.elevation_to", camera.elevation_to)];
        for (key, angle) in ends {
            let good = angle.is_none_or(|angle| angle.abs() <= 90.0);
            self.need(good, key, angle.unwrap_or_default(), "-90..90 degrees");
        }
        self.unit("camera.distance", camera.distance);
        self.unit("camera.zoom", Some(camera.zoom));
        self.point("camera.target", camera.target.unwrap_or_default());
        if let Some(position) = camera.position {
            self.point("camera.position", position);
            self.need(
                camera.target != Some(position),
                "camera.position",
                position,
                "a point away from the target",
            );
            for (key, said) in [
                ("camera.distance", camera.distance.is_some()),
                ("camera.elevation_to", camera.elevation_to.is_some()),
            ] {
                if said {
                    self.fault(key, "contradicts `position`, which says where the camera stands; keep one");
                }
            }
        }
        if let Some(CameraFile { path, .. }) = &camera.file {
            if path.as_os_str().is_empty() {
                self.fault("camera.file", "needs `path: PATH`");
            } else {
                self.file("camera.file.path", path);
                self.ending("camera.file.path", path, &CAMERAS);
            }
            if camera.position.is_some() {
                self.fault(
                    "camera.position",
                    "contradicts `file`, whose camera stands where it stands; keep one",
                );
            }
        }
    }
}
