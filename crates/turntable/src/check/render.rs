//! Which views are taken and how they are rendered.

use super::Check;
use crate::schema::Pipeline;

impl Check<'_> {
    pub(super) fn render(&mut self, pipeline: &Pipeline) {
        let turn = &pipeline.turntable;
        self.need((1..=9999).contains(&turn.frames), "turntable.frames", turn.frames, "1..=9999");
        self.need(turn.start.is_finite(), "turntable.start", turn.start, "an angle in degrees");
        self.need(turn.degrees.abs() <= 360.0, "turntable.degrees", turn.degrees, "-360..360 degrees");
        let render = &pipeline.render;
        for (key, size) in [("render.width", render.width), ("render.height", render.height)] {
            self.need((1..=65_536).contains(&size), key, size, "1..=65536 pixels");
        }
        self.pixels("render", u64::from(render.width), u64::from(render.height));
        self.need(render.spp >= 1, "render.spp", render.spp, "at least 1");
        for (i, name) in render.aovs.iter().enumerate().filter(|(_, name)| !is_all(name)) {
            self.pass(&format!("render.aovs.{i}"), name);
        }
        let exposure = pipeline.tone.exposure;
        self.need(exposure.abs() <= 64.0, "tone.exposure", exposure, "-64..64 stops");
        self.color("tone.background", Some(pipeline.tone.background), 1.0);
    }
}

/// The word for every pass.
pub(super) fn is_all(name: &str) -> bool {
    name.eq_ignore_ascii_case("all")
}
