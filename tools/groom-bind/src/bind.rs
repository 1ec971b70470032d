//! `groom-bind GROOM --mesh MESH -o OUT`.

use std::time::Instant;

use anyhow::{Context, Result, bail};
use command_line::Outcome;
use groom::Groom;
use groom_binding::{Beyond, BindBy, BindOptions, Binding, Blend, Carrier, CarryMode, CarryOptions, Surface};
use groom_formats::{Format, Warning, WriteOptions};
use serde_json::json;

use crate::args::{Args, BindingOptions, Far, Mode, Place, Rest};
use crate::carried::{Carried, Wanted};
use crate::character::{self, Character};
use crate::done::Done;
use crate::events::Events;
use crate::report::{self, Distances};
use crate::skinned::{self, Skinned};
use crate::store::{self, Strands};
use crate::target::Target;
use crate::timeline::Timeline;
use crate::{accuracy, attributes, far, load, overwrite, plausible, usd};

pub(crate) fn run(args: &Args) -> Result<Outcome> {
    let start = Instant::now();
    let target = Target::of(args)?;
    if args.answers_on_stdout() > 1 {
        bail!("of --json, --report - and --accuracy - only one can have standard output");
    }
    args.report.as_deref().map_or(Ok(()), report::refuse_unknown)?;
    args.accuracy.as_deref().map_or(Ok(()), accuracy::refuse_unknown)?;
    let checker = args.writing.check.then(usd::checker).transpose()?;
    let character = character::open(args)?;
    overwrite::refuse(args, target.as_ref(), &character.timeline)?;
    refuse_frames(target.as_ref(), &character)?;

    let loaded = load::load(args, &character)?;
    let mut done = Done::new(args, &character, target.as_ref());
    done.tell(&loaded.repairs, loaded.warnings, args.json)?;
    let mut groom = loaded.groom;
    let surface = character.surface();
    let (binding, distances) = bind(&mut groom, &surface, &args.binding)?;
    let odd = plausible::check(&groom, &surface, &distances.report, loaded.turned, &args.aligning)?;
    done.tell(&[], odd.into_iter().chain(told(&distances, &args.binding)).collect(), args.json)?;
    done.groups = attributes::give(&mut groom, &binding, &character, &args.attributes)?;

    let events = Events::default();
    if let Some(target) = &target {
        let (lost, skinned_error) = write(args, target, &groom, &binding, &character, &events, &mut done)?;
        done.skinned_error = skinned_error;
        done.tell(&[], lost.iter().map(ToString::to_string).collect(), args.json)?;
    }
    let frames = events.into_frames();
    if let Some(path) = &args.accuracy {
        accuracy::store(path, &groom, &binding, &character)?;
    }
    if let Some(path) = &args.report {
        report::store(path, &distances, &frames, json!({"groom": args.groom(), "mesh": character.name}))?;
    }
    done.finish(&groom, &distances.report, &frames, start.elapsed().as_secs_f64());
    done.print(args.json)?;
    match (checker, &target) {
        (Some(checker), Some(target)) => usd::check(&checker, target.display().as_ref()),
        _ => Ok(Outcome::Good),
    }
}

/// A format that holds one frame is given one, and a file a frame whole ones.
fn refuse_frames(target: Option<&Target>, character: &Character) -> Result<()> {
    let frames = character.timeline.frames().len();
    let step = character.timeline.range.step;
    match target {
        Some(Target::Still(path, format)) if frames > 1 => bail!(
            "{}: {format} holds one frame, and there are {frames}; choose one with --frames N, or write a file a \
             frame, as {}",
            path.display(),
            path.with_extension(format!("####.{format}")).display()
        ),
        Some(Target::Files(..)) if step.fract() != 0.0 => {
            bail!("a file a frame needs whole frames, and --frames has a step of {step}")
        }
        _ => Ok(()),
    }
}

/// Binds the strands, and leaves out those the options say to.
fn bind(groom: &mut Groom, surface: &Surface<'_>, args: &BindingOptions) -> Result<(Binding, Distances)> {
    let by = match args.bind_by {
        Place::Nearest => BindBy::Nearest,
        Place::Uv => BindBy::RootUv,
        Place::Id => BindBy::RootTriangle,
    };
    let options = BindOptions { by, limit: args.limit, beyond: Beyond::Keep };
    // As they are, for the report, whatever is to be done with those beyond the limit.
    let (all, report) = Binding::new(groom, surface, &options)?;
    let beyond = match args.beyond {
        Some(Far::Snap) => Beyond::Snap,
        Some(Far::Drop) => Beyond::Drop,
        _ => Beyond::Keep,
    };
    let mut binding = all.clone();
    let distances = Distances::new(groom, all, report, args.limit);
    if beyond != Beyond::Keep && !distances.report.beyond.is_empty() {
        let (changed, report) = Binding::new(groom, surface, &BindOptions { beyond, ..options })?;
        if let Some(kept) = &report.kept {
            if kept.is_empty() {
                bail!("--beyond drop leaves no strand: all {} are beyond the limit", report.strands);
            }
            *groom = groom.keep_strands(kept).context("--beyond drop")?;
        }
        binding = changed;
    }
    Ok((binding, distances))
}

/// What the binding has to say.
fn told(distances: &Distances, args: &BindingOptions) -> Vec<String> {
    let report = &distances.report;
    let mut told = Vec::new();
    if !report.beyond.is_empty() {
        let what = match args.beyond {
            Some(Far::Snap) => "are moved onto it",
            Some(Far::Drop) => "are left out",
            _ => "are kept where they are (--beyond snap or drop would change that)",
        };
        let (count, limit) = (report.beyond.len(), args.limit.unwrap_or(0.0));
        told.push(format!(
            "{count} of {} strands are farther than {limit} from the mesh and {what}",
            report.strands
        ));
    }
    if !report.outside.is_empty() {
        told.push(format!(
            "{} strands have a root_uv that no triangle holds; the nearest was taken",
            report.outside.len()
        ));
    }
    if !report.ambiguous.is_empty() {
        told.push(format!(
            "{} strands have a root_uv that several triangles hold; the one nearest in space was taken",
            report.ambiguous.len()
        ));
    }
    if report.without_frame > 0 {
        let count = report.without_frame;
        told.push(format!("{count} strands are on triangles without an area and will not be turned"));
    }
    told
}

fn write(
    args: &Args,
    target: &Target,
    groom: &Groom,
    binding: &Binding,
    character: &Character,
    events: &Events,
    done: &mut Done,
) -> Result<(Vec<Warning>, Option<f64>)> {
    let Character { mesh, timeline, .. } = character;
    let dialect = args.writing.dialect.map(Into::into);
    let options = WriteOptions { dialect, all_attributes: true, ..WriteOptions::default() };
    let origin = far::origin(character)?;
    if let Some(warning) = far::warning(target, origin) {
        done.tell(&[], vec![warning], args.json)?;
    }
    let carry = CarryOptions {
        mode: match args.carrying.mode {
            Mode::Rigid => CarryMode::Rigid,
            Mode::Blended => {
                CarryMode::Blended(Blend { restore_lengths: args.carrying.keep_length, ..Blend::default() })
            }
        },
        keep_out: args.carrying.avoid_penetration,
        origin,
        // From a frame to the next is a step of the rate, whatever the step of --frames.
        teleport: args.carrying.teleport.map(|distance| distance * timeline.rate),
    };
    let mut carrier = Carrier::new(groom, binding, character.surface(), carry)?;
    if let Target::Skinned(path, _) = target {
        let skinned = Skinned::new(groom, binding, character, rest_seconds(args, timeline)?)?;
        let (lost, error) = skinned::write(&skinned, character, &mut carrier, origin, path, &options)?;
        return Ok((lost, Some(error)));
    }
    let wanted = Wanted::of(args, target.holds_velocities());
    let count = timeline.frames().len() * wanted.offsets.len();
    let mut carried = Carried::new(mesh, carrier, *timeline, wanted, origin);
    if args.json || args.report.is_some() {
        carried = carried.measuring(groom, binding);
    }
    let frames = carried.frames(events);
    let strands = Strands { groom, origin, options: &options };
    let lost = match target {
        Target::Files(numbered, format) => store::files(&strands, frames, count, numbered, *format),
        // One frame moves nothing, and glTF has no other place for its time.
        Target::Animated(path, format @ (Format::Gltf | Format::Glb)) if count == 1 => {
            store::one(&strands, frames, path, *format)
        }
        Target::Still(path, format) => store::one(&strands, frames, path, *format),
        Target::Animated(path, format) | Target::Skinned(path, format) => {
            store::animated(&strands, frames, count, timeline.rate, path, *format)
        }
    };
    Ok((lost?, None))
}

/// When the mesh is at rest, in seconds; `None` when that is as its skin was modelled.
fn rest_seconds(args: &Args, timeline: &Timeline) -> Result<Option<f64>> {
    match args.mesh.rest {
        Rest::Bind => Ok(None),
        Rest::Frame(frame) => Ok(Some(timeline.seconds(frame))),
        Rest::Nodes => bail!("--as-skinned starts from --rest bind or a frame; `nodes` has no time"),
    }
}
