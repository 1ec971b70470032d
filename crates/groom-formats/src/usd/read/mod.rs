//! BasisCurves as a groom.
//!
//! Every `BasisCurves` prim that is defined and active is read; prims whose `purpose` is `guide` are not, as
//! renderers leave them out. Their points are brought into the stage's space, and several prims become one
//! groom with an attribute `group`, the prim's place in the file, unless a primvar says otherwise.
//!
//! | USD | groom |
//! |---|---|
//! | `points`, `curveVertexCounts` | points and strands; cubic curves become polylines ([`cubic`](crate::cubic)) |
//! | `primvars:widths`, else `widths` | `radius`, half of it, times the mean scale of the prim's transform |
//! | `primvars:displayColor`, `primvars:displayOpacity` | `color`, `transparency` = 1 - opacity |
//! | `primvars:st`, `velocities` | `root_uv`, `velocity` (turned with the prim) |
//! | `primvars:NAME` | `NAME` |
//! | `constant`; `uniform`; `vertex`, `varying`, `faceVarying` | one value; one a strand; one a point |
//! | `upAxis`, `metersPerUnit` | up axis (fallback Y), unit (fallback 0.01) |
//!
//! What is not authored is what USD says: `type` cubic, `basis` bezier, `wrap` nonperiodic; `widths` per vertex,
//! primvars constant. A periodic strand ends where it starts. Composition is not followed: a stage of several
//! layers has to be flattened first.
//!
//! A groom may take four times the size of its file and a megabyte: a crate holds equal arrays once, and a short
//! one could make any number of prims of them.

mod attribute;
mod curves;
mod frames;
mod merge;
mod stage;
mod values;

use groom::UpAxis;
use usd_layer::{Layer, ReadError};

use crate::polylines::Polylines;
use crate::room::Room;
use crate::{Format, FormatError, Loaded, ReadOptions, Warning};

pub(crate) use frames::read as read_moving;

/// Metres a unit has in a stage that does not say.
const METERS_PER_UNIT: f64 = 0.01;

/// Time codes a second has in a stage that does not say.
const TIME_CODES_PER_SECOND: f64 = 24.0;

pub(crate) fn read(
    bytes: &[u8],
    format: Format,
    name: &str,
    options: &ReadOptions,
) -> Result<Loaded, FormatError> {
    let stage = open(bytes, format, name, options)?;
    Ok(load(&stage, stage.start(options.time), options)?.0)
}

/// What is asked of curves everywhere.
pub(crate) struct Context {
    pub(crate) file: String,
    pub(crate) format: Format,
    pub(crate) curve_error: Option<f32>,
    /// What the groom, or one frame of it, may take.
    pub(crate) room: Room,
}

fn open<B: AsRef<[u8]>>(
    bytes: B,
    format: Format,
    name: &str,
    options: &ReadOptions,
) -> Result<stage::Stage<B>, FormatError> {
    let layer = Layer::read(bytes).map_err(|error| broken(name, &error))?;
    let room = Room::of(layer.bytes().as_ref().len());
    let context = Context { file: name.to_owned(), format, curve_error: options.curve_error, room };
    let mut stage = stage::Stage::new(layer, context)?;
    if options.keep_origin {
        stage.keep_origin(stage.start(options.time))?;
    }
    Ok(stage)
}

fn broken(name: &str, error: &ReadError) -> FormatError {
    FormatError::invalid(name, error.place.to_string(), error.found.clone(), error.expected.clone())
}

/// The groom at a time, and how its curves were sampled.
fn load<B: AsRef<[u8]>>(
    stage: &stage::Stage<B>,
    time: Option<f64>,
    options: &ReadOptions,
) -> Result<(Loaded, Vec<Polylines>), FormatError> {
    let mut warnings = Vec::new();
    if stage.composed > 0 {
        warnings.push(Warning::CompositionNotFollowed { prims: stage.composed });
    }
    let (mut groom, cuts) = merge::merge(stage, time, &mut warnings)?;
    let layer = &stage.layer;
    let up = match layer.metadata("upAxis").and_then(usd_layer::Value::text) {
        Some("Z") => UpAxis::Z,
        _ => UpAxis::Y,
    };
    let number = |name: &str| {
        layer.metadata(name).and_then(usd_layer::Value::number).filter(|v| v.is_finite() && *v > 0.0)
    };
    groom.up_axis = options.up_axis.unwrap_or(up);
    groom.meters_per_unit =
        options.meters_per_unit.or_else(|| number("metersPerUnit")).unwrap_or(METERS_PER_UNIT);
    let repairs = if options.repair { groom.repair() } else { Vec::new() };
    let repairs = repairs.iter().map(ToString::to_string).collect();
    let mut loaded = Loaded { warnings, repairs, origin: stage.origin, ..Loaded::still(groom) };
    if stage.times.len() > 1 {
        let rate = number("timeCodesPerSecond").or_else(|| number("framesPerSecond"));
        loaded.frame_rate = Some(rate.unwrap_or(TIME_CODES_PER_SECOND));
        loaded.times.clone_from(&stage.times);
    }
    Ok((loaded, cuts))
}
