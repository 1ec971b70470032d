//! Vectors of an attribute at a time code.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use usd_layer::{Attribute, Value};

use crate::error::Fault;
use crate::recent::Recent;

/// Points, or normals: one sample.
pub(super) type Vectors = Vec<[f32; 3]>;

/// Two samples and how far a time is from the first to the second.
pub(super) struct Between {
    before: Arc<Vectors>,
    after: Arc<Vectors>,
    part: f64,
}

impl Between {
    /// Those of `attribute` around `time`; `read` is told how to name them.
    pub(super) fn of(
        attribute: &Attribute,
        time: Option<f64>,
        recent: &Recent<Vectors>,
        read: impl Fn(&Value, &str) -> Result<Vectors, Fault>,
    ) -> Result<Between, Fault> {
        let (Some(samples), Some(time)) = (attribute.samples.as_deref(), time) else {
            let value = attribute.held(time);
            let none = || Fault::invalid(&*attribute.name, "no value, expected one");
            let value = recent.get(usize::MAX, || read(value.ok_or_else(none)?, &attribute.name))?;
            return Ok(Between { before: Arc::clone(&value), after: value, part: 0.0 });
        };
        let sample = |number: usize| {
            recent.get(number, || {
                let at = samples.times.get(number).copied().unwrap_or_default();
                let name = format!("{} at time code {at}", attribute.name);
                let value = samples.values.get(number);
                read(value.ok_or_else(|| Fault::invalid(&name, "no value, expected one"))?, &name)
            })
        };
        let (first, second, part) = samples.around(time);
        let before = sample(first)?;
        let after = if part > 0.0 { sample(second)? } else { Arc::clone(&before) };
        Ok(Between { before, after, part })
    }

    pub(super) fn at(&self, place: usize) -> DVec3 {
        let [before, after] = [&self.before, &self.after].map(|sample| Vec3::from(sample[place]).as_dvec3());
        before + (after - before) * self.part
    }
}
