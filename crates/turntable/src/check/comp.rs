//! What is done to finished frames before they are shown.

use hair_render::Aov;

use super::{Check, render};
use crate::schema::Pipeline;

/// What plates are read from.
const PICTURES: [&str; 5] = ["png", "jpg", "jpeg", "exr", "hdr"];

impl Check<'_> {
    pub(super) fn comp(&mut self, pipeline: &Pipeline) {
        let aovs = &pipeline.render.aovs;
        for (name, &weight) in &pipeline.comp.weights {
            let key = format!("comp.weights.{name}");
            self.factor(&key, f64::from(weight));
            if let Some(pass) = self.pass(&key, name)
                && !aovs.iter().any(|aov| render::is_all(aov) || Aov::from_name(aov) == Some(pass))
            {
                self.fault(key, format!("needs the pass: add `{}` to `render.aovs`", pass.name()));
            }
        }
        if let Some(plate) = &pipeline.comp.plate {
            self.file("comp.plate", plate);
            self.ending("comp.plate", plate, &PICTURES);
            if !pipeline.render.transparent {
                self.fault(
                    "comp.plate",
                    "is seen through transparent frames alone; say `render: {transparent: true}`",
                );
            }
        }
    }
}
