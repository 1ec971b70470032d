//! What shines.

use super::Check;
use crate::schema::{EnvironmentSource, Lights};

impl Check<'_> {
    pub(super) fn lights(&mut self, lights: &Lights) {
        if let Some(environment) = &lights.environment {
            self.environment(environment);
        }
        for (i, area) in lights.area.iter().enumerate() {
            let key = |name: &str| format!("lights.area.{i}.{name}");
            self.color(&key("radiance"), Some(area.radiance), f32::MAX);
            self.point(&key("position"), area.position);
            self.point(&key("target"), area.target);
            let size = area.size.iter().all(|&s| s > 0.0 && s.is_finite());
            self.need(size, &key("size"), area.size, "two lengths above 0");
            self.need(
                area.position != area.target,
                &key("target"),
                area.target,
                "a point away from the position",
            );
        }
        if let Some(cornell) = &lights.cornell {
            let room = cornell.room;
            self.need(room > 1.0 && room <= 1000.0, "lights.cornell.room", room, "above 1, at most 1000");
            self.factor("lights.cornell.intensity", f64::from(cornell.intensity));
        }
        if lights.environment.is_none() && lights.area.is_empty() && lights.cornell.is_none() {
            self.fault("lights", "holds nothing that shines; add `environment: {studio: true}`");
        }
    }

    fn environment(&mut self, environment: &EnvironmentSource) {
        let EnvironmentSource { file, constant, studio, rotation, intensity } = environment;
        let kinds = [file.is_some(), constant.is_some(), *studio].into_iter().filter(|&k| k).count();
        if kinds != 1 {
            self.fault("lights.environment", "needs one of `file`, `constant`, `studio: true`");
        }
        if let Some(file) = file {
            self.file("lights.environment.file", file);
        }
        self.color("lights.environment.constant", *constant, f32::MAX);
        self.need(rotation.is_finite(), "lights.environment.rotation", rotation, "an angle in degrees");
        self.factor("lights.environment.intensity", f64::from(*intensity));
    }
}
