//! `cyhair-convert IN OUT`.

use std::path::Path;
use std::rc::Rc;
use std::time::Instant;

use anyhow::{Result, bail};
use command_line::Outcome;
use groom::{Groom, names};
use groom_formats::{Format, Loaded, Warning, WriteOptions};

use crate::args::{Args, is_stream};
use crate::edit::Edits;
use crate::load::{Input, load_from};
use crate::motion::{self, Motion};
use crate::report::{self, Done};
use crate::store::store;
use crate::{material, reduction, streaming, usd};

pub(crate) fn run(args: &Args) -> Result<Outcome> {
    let start = Instant::now();
    let (output, format) = args.target()?;
    args.refuse_misread()?;
    args.refuse_miswritten(&output.display().to_string(), format)?;
    if args.writing.check && is_stream(output) {
        bail!("--check needs a file, and the output is standard output");
    }
    let checker = args.writing.check.then(|| usd::checker(output, format)).transpose()?;
    let baked = args.reading.bake.then(|| usd::bake(args.input(), args.input_format()?)).transpose()?;
    let path = baked.as_ref().map_or(args.input(), |baked| &baked.path);
    let mut done = match motion::find(path, format, args)? {
        Some(moving) => convert_motion(moving, output, format, args)?,
        None if args.writing.frames.is_some() => {
            bail!("--frames is for inputs that move, and {} does not", args.input().display())
        }
        None => convert_still(path, output, format, args)?,
    };
    if baked.is_some() {
        done.input = args.input().display().to_string();
    }
    done.add(material::left_out(&args.material)?);
    done.seconds = start.elapsed().as_secs_f64();
    report::print_done(&done, args.json)?;
    checker.map_or(Ok(Outcome::Good), |checker| usd::check(&checker, output))
}

fn convert_still(path: &Path, output: &Path, format: Format, args: &Args) -> Result<Done> {
    if let Some(done) = streaming::convert(path, output, format, args)? {
        return Ok(done);
    }
    let Input { name, format: input_format, bytes: input_bytes, loaded } = load_from(path, args)?;
    let Loaded { groom, warnings, repairs, hair, .. } = loaded;
    let mut done = Done::new(name, input_format, input_bytes, output, format);
    done.tell(&repairs, &warnings, args.json)?;
    let had_ids = groom.attribute(names::ID).is_some();
    let mut edits = Edits::new(args);
    let mut measured = None;
    let groom = match &args.measuring.report {
        None => edits.apply(groom)?,
        Some(path) => {
            let full = edits.shape(groom)?;
            let options = WriteOptions { hair, ..write_options(&full, args)? };
            measured = Some((path, reduction::measure(&full, args, format, &options)?));
            edits.reduce(full)?
        }
    };
    done.quantize_error = edits.quantize_error;
    let options = WriteOptions { hair, ..write_options(&groom, args)? };
    let (lost, output_bytes) = store(&groom, output, format, &options)?;
    if let Some((path, measured)) = measured {
        reduction::store(&measured, path)?;
    }
    done.finish(
        groom.strand_count() as u64,
        groom.point_count() as u64,
        output_bytes,
        &missed(lost, had_ids, args),
    );
    Ok(done)
}

fn convert_motion(moving: Motion<'_>, output: &Path, format: Format, args: &Args) -> Result<Done> {
    if args.measuring.report.is_some() {
        bail!(
            "--report measures a groom that stands still, and {} moves; choose a frame by --time",
            moving.name
        );
    }
    let mut done = Done::new(moving.name.clone(), moving.format, moving.bytes, output, format);
    done.tell(&moving.repairs, &moving.warnings, args.json)?;
    let (had_ids, quantize_error) = (moving.had_ids, Rc::clone(&moving.quantize_error));
    let options = write_options(&moving.groom, args)?;
    let (groom, frames, lost, output_bytes) = moving.store(output, format, &options)?;
    done.frames = Some(frames);
    done.quantize_error = quantize_error.get();
    done.finish(
        groom.strand_count() as u64,
        groom.point_count() as u64,
        output_bytes,
        &missed(lost, had_ids, args),
    );
    Ok(done)
}

fn write_options(groom: &Groom, args: &Args) -> Result<WriteOptions> {
    let writing = &args.writing;
    Ok(WriteOptions {
        dialect: writing.dialect.map(Into::into),
        look: material::look(&args.material, groom)?,
        mesh: writing.as_mesh,
        all_attributes: writing.all_attributes,
        quantize: args.strands.quantize,
        ..WriteOptions::default()
    })
}

/// What is worth saying: thinning out gives the strands numbers nobody misses, and what `--quantize` moved is
/// told as a whole, not as what the writer rounded after it.
fn missed(lost: Vec<Warning>, had_ids: bool, args: &Args) -> Vec<Warning> {
    let is_news = |warning: &Warning| match warning {
        Warning::AttributeLeftOut { name, .. } => had_ids || name != names::ID,
        Warning::PositionsRounded { .. } => args.strands.quantize.is_none(),
        _ => true,
    };
    lost.into_iter().filter(is_news).collect()
}
