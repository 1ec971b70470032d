//! Camera prims of USD layers (UsdGeomCamera).

use std::path::Path;

use glam::DMat4;
use usd_layer::{Attribute, Layer, Prim, Value, xform};

use super::mesh::world;
use super::stage::{Found, Place};
use super::{METERS_PER_UNIT, TIME_CODES_PER_SECOND, open, positive};
use crate::camera_file::{self, Read, Track};
use crate::error::Fault;
use crate::{AnimationChoice, CameraOptions, CameraPose};

/// A lens that does not say, as UsdGeomCamera has it: tenths of the stage's unit, of which only the ratio counts.
const FOCAL_LENGTH: f64 = 50.0;
const HORIZONTAL_APERTURE: f64 = 20.955;
const VERTICAL_APERTURE: f64 = 15.2908;

/// A camera of a layer, with the layer.
#[derive(Debug)]
pub(crate) struct UsdCamera {
    layer: Layer<Vec<u8>>,
    place: Place,
    /// Whether samples count, be it one that lies over what stands without them.
    is_animated: bool,
    /// In seconds; none where nothing moves it.
    time_range: Option<(f64, f64)>,
    time_codes_per_second: f64,
    /// From the stage's numbers to metres, Y up.
    metres_from_stage: DMat4,
}

pub(crate) fn read_camera(path: &Path, options: &CameraOptions) -> Result<Read, Fault> {
    let layer = open(path)?;
    let mut found = Found::search(&layer);
    let names: Vec<String> = found.cameras.iter().map(|place| place.path.clone()).collect();
    let last = |index: usize| names.get(index)?.rsplit('/').next().map(str::to_owned);
    let chosen = match options.camera.among(&names, last) {
        // It may be in what is pulled in.
        Err(Fault::NoCamera { asked, .. }) if found.composed => {
            return Err(composed(format!("a camera{asked} that comes")));
        }
        chosen => chosen?,
    };
    let place = found.cameras.swap_remove(chosen);
    // What pulls in could say more about it, or about the prims it hangs below.
    if found.layered || place.chain(&layer).iter().any(|prim| super::stage::pulls_in(prim)) {
        return Err(composed(format!("the camera {}, to which there may be added", place.path)));
    }
    let number = |name| positive(&layer, name);
    let rate = number("timeCodesPerSecond").or_else(|| number("framesPerSecond"));
    let rate = rate.unwrap_or(TIME_CODES_PER_SECOND);
    let mut axes = DMat4::from_scale(glam::DVec3::splat(number("metersPerUnit").unwrap_or(METERS_PER_UNIT)));
    if layer.metadata("upAxis").and_then(Value::text) == Some("Z") {
        axes *= DMat4::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    }
    let is_animated = options.animation != AnimationChoice::None;
    let time_range = is_animated.then(|| range(&times(&place.chain(&layer)), rate)).flatten();
    let camera = UsdCamera {
        layer,
        place,
        is_animated,
        time_range,
        time_codes_per_second: rate,
        metres_from_stage: axes,
    };
    camera.check()?;
    Ok(Read { names, chosen, track: Track::Usd(Box::new(camera)) })
}

fn composed(what: String) -> Fault {
    Fault::Unsupported {
        what: format!("{what} by composition (references, sublayers, payloads)"),
        remedy: "flatten the stage first (usdcat --flatten, or stage.Export in Python), or name the layer that holds \
                 the camera",
    }
}

/// Times of all samples that move the last prim of a chain or its lens, in no order.
fn times(chain: &[&Prim]) -> Vec<f64> {
    let lens = ["focalLength", "verticalAperture", "horizontalAperture"];
    let lens = lens.into_iter().filter_map(|name| chain.last()?.attribute(name));
    let ops = chain.iter().flat_map(|prim| xform::moving_attributes(prim));
    let samples = ops.chain(lens).filter_map(|attribute| attribute.samples.as_deref());
    samples.flat_map(|samples| samples.times.iter().copied()).collect()
}

fn range(times: &[f64], rate: f64) -> Option<(f64, f64)> {
    let first = times.iter().copied().fold(f64::INFINITY, f64::min) / rate;
    let last = times.iter().copied().fold(f64::NEG_INFINITY, f64::max) / rate;
    (last > first && first.is_finite() && last.is_finite()).then_some((first, last))
}

impl UsdCamera {
    pub(crate) fn time_range(&self) -> Option<(f64, f64)> {
        self.time_range
    }

    pub(crate) fn frame_rate(&self) -> f64 {
        self.time_codes_per_second
    }

    pub(crate) fn at(&self, seconds: f64) -> Result<CameraPose, Fault> {
        let time = self.is_animated.then_some(seconds * self.time_codes_per_second);
        let chain = self.place.chain(&self.layer);
        let world = self.metres_from_stage * world(&self.layer, &chain, time)?;
        let number = |name, fallback| self.number(name, fallback, time);
        let focal_length = number("focalLength", FOCAL_LENGTH)?;
        let vertical = number("verticalAperture", VERTICAL_APERTURE)?;
        let horizontal = number("horizontalAperture", HORIZONTAL_APERTURE)?;
        let vertical_fov = 2.0 * (vertical / (2.0 * focal_length)).atan();
        // The unit of the stage scales places, not the matrix of a view: it is taken out with all other scales.
        camera_file::pose(world, vertical_fov, Some(horizontal / vertical))
    }

    /// A length of the lens, above 0.
    fn number(&self, name: &str, fallback: f64, time: Option<f64>) -> Result<f64, Fault> {
        let value = self.attribute(name).and_then(|attribute| number_at(attribute, time)).unwrap_or(fallback);
        if value.is_finite() && value > 0.0 {
            return Ok(value);
        }
        let expected = "a length above 0, in tenths of the stage's unit";
        Err(Fault::invalid(name, format!("{value}, expected {expected}")))
    }

    fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.place.chain(&self.layer).last()?.attribute(name)
    }

    /// Refuses what cannot be shown.
    fn check(&self) -> Result<(), Fault> {
        let path = &self.place.path;
        let text = |attribute: &Attribute| attribute.held(None).and_then(Value::text).map(str::to_owned);
        match self.attribute("projection").and_then(text).as_deref() {
            None | Some("perspective") => {}
            Some("orthographic") => {
                return Err(Fault::Unsupported {
                    what: format!("the orthographic camera {path}"),
                    remedy: "use a perspective one, far away for nearly parallel rays",
                });
            }
            Some(other) => {
                let fault = format!("{other:?}, expected \"perspective\" or \"orthographic\"");
                return Err(Fault::invalid(format!("{path}.projection"), fault));
            }
        }
        let shifts = |name: &str| {
            let Some(attribute) = self.attribute(name) else { return false };
            let samples = attribute.samples.iter().flat_map(|samples| samples.values.iter());
            samples.chain(&attribute.default).any(|value| value.number().is_some_and(|v| v != 0.0))
        };
        if shifts("horizontalApertureOffset") || shifts("verticalApertureOffset") {
            return Err(Fault::Unsupported {
                what: format!("the shifted lens of {path} (horizontal- or verticalApertureOffset)"),
                remedy: "turn the camera instead, or frame wider and crop",
            });
        }
        Ok(())
    }
}

/// A number at a time code, linear between samples.
fn number_at(attribute: &Attribute, time: Option<f64>) -> Option<f64> {
    if let (Some(samples), Some(time)) = (attribute.samples.as_deref(), time) {
        let (first, second, part) = samples.around(time);
        let [before, after] = [first, second].map(|i| samples.values.get(i).and_then(Value::number));
        if let (Some(before), Some(after)) = (before, after) {
            return Some(before + (after - before) * part);
        }
    }
    attribute.held(time).and_then(Value::number)
}
