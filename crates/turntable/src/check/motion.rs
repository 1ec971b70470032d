//! How strands are bound, and what moves.

use hair_render::{Shutter, ShutterShape};

use super::Check;
use crate::schema::{Beyond, Bind, BindBy, BindMode, BlurBy, Pipeline, Rest};

impl Check<'_> {
    pub(super) fn bind(&mut self, pipeline: &Pipeline) {
        let Some(bind) = &pipeline.bind else { return };
        if pipeline.mesh.is_none() {
            self.fault("bind", "needs a `mesh` to bind the strands to");
        }
        self.bind_distances(bind);
        if bind.keep_length && bind.mode == BindMode::Rigid {
            self.fault("bind.keep_length", "is for `mode: blended`; rigid strands keep their lengths anyway");
        }
        if bind.beyond != Beyond::Keep && bind.limit.is_none() {
            self.fault("bind.beyond", "needs `limit`, the distance it begins at");
        }
        if bind.by == BindBy::Id && bind.limit.is_some() {
            self.fault(
                "bind.limit",
                "is a distance to the nearest place; `by: id` names the triangle itself",
            );
        }
        if let Rest::Frame(frame) = bind.rest {
            self.need(frame.is_finite(), "bind.rest", frame, "`bind`, `nodes` or a frame");
        }
        self.bind_placing(bind);
    }

    fn bind_distances(&mut self, bind: &Bind) {
        let off = bind.avoid_penetration;
        let good = off.is_none_or(|off| off >= 0.0 && off.is_finite());
        self.need(good, "bind.avoid_penetration", off.unwrap_or_default(), "a distance of at least 0");
        self.above_zero("bind.limit", bind.limit, "a distance above 0");
        self.above_zero("bind.teleport", bind.teleport, "a distance above 0");
    }

    fn bind_placing(&mut self, bind: &Bind) {
        self.unit("bind.scale", bind.scale);
        self.point("bind.translate", bind.translate.unwrap_or_default());
        let Some(matrix) = bind.matrix else { return };
        if bind.scale.is_some() || bind.translate.is_some() {
            self.fault("bind.matrix", "contradicts `scale` and `translate`: it is all of that at once");
        }
        let finite = matrix.iter().flatten().all(|v| v.is_finite());
        self.need(
            finite && matrix[3] == [0.0, 0.0, 0.0, 1.0],
            "bind.matrix",
            matrix,
            "finite rows, the last [0, 0, 0, 1]",
        );
        let m = glam::DMat3::from_cols_array_2d(&[0, 1, 2].map(|c| [0, 1, 2].map(|r| matrix[r][c])));
        if finite && m.determinant() == 0.0 {
            self.fault(
                "bind.matrix",
                "makes everything flat: its first three rows and columns have determinant 0",
            );
        }
    }

    pub(super) fn motion(&mut self, pipeline: &Pipeline) {
        let Some(motion) = &pipeline.motion else { return };
        if let Some(first) = motion.first {
            self.need(first.is_finite(), "motion.first", first, "a frame of the animation");
        }
        self.need(motion.step.is_finite(), "motion.step", motion.step, "a finite number of frames");
        self.above_zero("motion.fps", motion.fps, "above 0 frames a second");
        match motion.shape.parse::<ShutterShape>() {
            Err(error) => self.fault("motion.shape", error.to_string()),
            Ok(shape) => {
                let [open, close] = motion.shutter;
                if let Err(error) = Shutter::new(open, close, shape) {
                    self.fault("motion.shutter", error.to_string());
                }
            }
        }
        let instant = motion.shutter[0] == motion.shutter[1];
        if instant && motion.blur.is_some_and(|blur| blur != BlurBy::Off) {
            self.fault("motion.shutter", "opens and closes at the same time: nothing can be blurred");
        }
        if let Some(samples) = motion.samples {
            self.need((2..=255).contains(&samples), "motion.samples", samples, "2..=255");
        }
    }
}
