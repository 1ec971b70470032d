//! A value that changes with time, by its keys (glTF 2.0, section 3.11 and appendix C).

use glam::{DQuat, DVec3};
use gltf::accessor::Dimensions;
use gltf::animation::{Interpolation, Sampler};
use gltf_bytes::{Buffers, Elements};

use crate::error::Fault;

/// Keys of `width` numbers each.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    /// Seconds, never falling, at least one.
    times: Vec<f64>,
    /// `width` numbers a key; three times as many with cubic splines: in-tangent, value, out-tangent.
    values: Vec<f64>,
    width: usize,
    interpolation: Interpolation,
}

/// Where a time lies among the keys.
enum Place {
    /// At a key, or held by it.
    Key(usize),
    /// After this key by a part, 0 to 1, of so many seconds.
    Between(usize, f64, f64),
}

/// The times of a sampler's keys in seconds, finite and never falling.
pub(super) fn times(sampler: &Sampler<'_>, buffers: &Buffers<'_>, place: &str) -> Result<Vec<f64>, Fault> {
    let times = Elements::of(&sampler.input(), &[Dimensions::Scalar], buffers)?.all(|[time]| time);
    if times.is_empty() {
        return Err(Fault::invalid(place, "no keys, expected at least one"));
    }
    if let Some(i) = times.iter().position(|time| !time.is_finite()) {
        return Err(Fault::invalid(place, format!("key {i} is at time {}, expected a number", times[i])));
    }
    if let Some(i) = times.windows(2).position(|pair| pair[1] < pair[0]) {
        let fault = format!("key {} is at {} s after key {i} at {} s", i + 1, times[i + 1], times[i]);
        return Err(Fault::invalid(place, format!("{fault}, expected rising times")));
    }
    Ok(times)
}

impl Curve {
    /// `element` is the type of an output, `width` how many numbers make a key.
    pub(super) fn read(
        sampler: &Sampler<'_>,
        element: Dimensions,
        width: usize,
        buffers: &Buffers<'_>,
        place: &str,
    ) -> Result<Self, Fault> {
        let times = times(sampler, buffers, place)?;
        let output = Elements::of(&sampler.output(), &[element], buffers)?;
        let interpolation = sampler.interpolation();
        let a_key = width * if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let mut values = Vec::with_capacity(output.len() * element.multiplicity());
        match element {
            Dimensions::Scalar => output.all(|[v]: [f64; 1]| values.push(v)),
            Dimensions::Vec3 => output.all(|v: [f64; 3]| values.extend(v)),
            _ => output.all(|v: [f64; 4]| values.extend(v)),
        };
        if Some(values.len()) != times.len().checked_mul(a_key) {
            let fault = format!("{} numbers for {} keys, expected {a_key} a key", values.len(), times.len());
            return Err(Fault::invalid(place, fault));
        }
        if let Some(i) = values.iter().position(|value| !value.is_finite()) {
            let fault = format!("key {} holds {}, expected numbers", i / a_key, values[i]);
            return Err(Fault::invalid(place, fault));
        }
        Ok(Curve { times, values, width, interpolation })
    }

    /// The value at `time` as one vector.
    pub(super) fn vector(&self, time: f64) -> DVec3 {
        let mut value = [0.0; 3];
        self.sample(time, &mut value);
        DVec3::from_array(value)
    }

    /// The value at `time` as a rotation: on the shortest great circle between keys, or normalised on a spline.
    pub(super) fn rotation(&self, time: f64) -> DQuat {
        let unit =
            |value: DQuat| if value.length_squared() > 0.0 { value.normalize() } else { DQuat::IDENTITY };
        let key = |key| unit(self.key(key).try_into().map_or(DQuat::IDENTITY, DQuat::from_array));
        match (self.place(time), self.interpolation) {
            (Place::Key(i), _) => key(i),
            (Place::Between(i, part, _), Interpolation::Linear) => key(i).slerp(key(i + 1), part).normalize(),
            _ => {
                let mut value = [0.0; 4];
                self.sample(time, &mut value);
                unit(DQuat::from_array(value))
            }
        }
    }

    /// The value at `time`, number by number.
    pub(super) fn sample(&self, time: f64, out: &mut [f64]) {
        let (i, u, seconds) = match self.place(time) {
            Place::Key(i) => {
                for (out, value) in out.iter_mut().zip(self.key(i)) {
                    *out = *value;
                }
                return;
            }
            Place::Between(i, u, seconds) => (i, u, seconds),
        };
        let (from, to) = (self.key(i), self.key(i + 1));
        if self.interpolation == Interpolation::Linear {
            for (out, (from, to)) in out.iter_mut().zip(from.iter().zip(to)) {
                *out = from + (to - from) * u;
            }
            return;
        }
        let (leaving, arriving) = (self.third(i, 2), self.third(i + 1, 0));
        let (u2, u3) = (u * u, u * u * u);
        let tangents = leaving.iter().zip(arriving);
        for (out, ((from, to), (leaving, arriving))) in out.iter_mut().zip(from.iter().zip(to).zip(tangents))
        {
            *out = (2.0 * u3 - 3.0 * u2 + 1.0) * from
                + seconds * (u3 - 2.0 * u2 + u) * leaving
                + (3.0 * u2 - 2.0 * u3) * to
                + seconds * (u3 - u2) * arriving;
        }
    }

    fn place(&self, time: f64) -> Place {
        let after = self.times.partition_point(|&key| key <= time);
        let Some(before) = after.checked_sub(1) else { return Place::Key(0) };
        if after == self.times.len() || self.interpolation == Interpolation::Step {
            return Place::Key(before);
        }
        let (start, end) = (self.times[before], self.times[after]);
        if time == start {
            Place::Key(before)
        } else {
            Place::Between(before, (time - start) / (end - start), end - start)
        }
    }

    fn key(&self, key: usize) -> &[f64] {
        match self.interpolation {
            Interpolation::CubicSpline => self.third(key, 1),
            _ => self.values.get(key * self.width..(key + 1) * self.width).unwrap_or_default(),
        }
    }

    /// In-tangent, value or out-tangent of a key of a spline.
    fn third(&self, key: usize, which: usize) -> &[f64] {
        let start = (3 * key + which) * self.width;
        self.values.get(start..start + self.width).unwrap_or_default()
    }
}
