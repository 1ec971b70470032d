//! Inputs that move: a sequence of files, or a file with frames.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::path::Path;
use std::rc::Rc;

use anyhow::{Result, bail};
use command_line::progress_bar;
use groom::{Attribute, Groom, Values, names};
use groom_formats::{
    Format, FormatError, Frame, Loaded, MotionOptions, Warning, WriteOptions, write_animation,
};

use crate::args::{Args, is_stream};
use crate::edit::Edits;
use crate::load::{Input, load_from};
use crate::sequence::{self, Sequence};
use crate::store::{clear, size};

/// Frames a second when neither the input nor the options say.
const FRAME_RATE: f64 = 24.0;

/// A groom that moves, its options applied.
pub(crate) struct Motion<'a> {
    pub(crate) name: String,
    pub(crate) format: Format,
    pub(crate) bytes: u64,
    pub(crate) repairs: Vec<String>,
    pub(crate) warnings: Vec<Warning>,
    pub(crate) had_ids: bool,
    /// The farthest that quantizing moved a point, so far.
    pub(crate) quantize_error: Rc<Cell<Option<f64>>>,
    /// The first frame, edited.
    pub(crate) groom: Rc<Groom>,
    /// Attributes whose values differ from the first frame's in a frame that was stored.
    changed: Rc<RefCell<BTreeSet<String>>>,
    /// Whether a frame had accelerations, which edits do not know.
    accelerates: Rc<Cell<bool>>,
    frame_rate: f64,
    frames: Frames<'a>,
    frame_count: u64,
}

type Frames<'a> = Box<dyn Iterator<Item = Result<Frame>> + 'a>;

/// The input as something that moves, if it moves and the output can.
pub(crate) fn find<'a>(path: &Path, format: Format, args: &'a Args) -> Result<Option<Motion<'a>>> {
    let moves = matches!(format, Format::Usda | Format::Usdc | Format::Usdz | Format::Alembic);
    if sequence::is_sequence(path) {
        if !moves {
            bail!(
                "{} is a sequence, and {format} holds no motion; use usda, usdc, usdz or abc",
                path.display()
            );
        }
        return of_sequence(path, args).map(Some);
    }
    let held = moves && args.reading.time.is_none() && !is_stream(path);
    if held && matches!(args.input_format()?, Format::Usda | Format::Usdc | Format::Usdz | Format::Alembic) {
        return of_file(path, args);
    }
    Ok(None)
}

fn of_sequence<'a>(pattern: &Path, args: &'a Args) -> Result<Motion<'a>> {
    let Sequence { files } = sequence::find(pattern, args.writing.frames)?;
    let (_, first) = &files[0];
    let Input { format, bytes, loaded, .. } = load_from(first, args)?;
    let count = files.len() as u64;
    let frames = files.into_iter().map(move |(number, path)| {
        let input = load_from(&path, args)?;
        Ok((number as f64, path.display().to_string(), input.loaded.groom))
    });
    Motion::new(pattern, format, bytes * count, loaded, Box::new(frames), count, args)
}

fn of_file<'a>(path: &Path, args: &'a Args) -> Result<Option<Motion<'a>>> {
    let (loaded, frames) = groom_formats::read_frames(path, &args.reading.options())?;
    if loaded.times.len() < 2 {
        return Ok(None);
    }
    let wanted = args.writing.frames.map(|(first, last)| first as f64..=last as f64);
    let is_wanted = move |time: f64| wanted.as_ref().is_none_or(|wanted| wanted.contains(&time));
    let count = loaded.times.iter().filter(|&&time| is_wanted(time)).count() as u64;
    if count == 0 {
        let (first, last) = (loaded.times[0], loaded.times[loaded.times.len() - 1]);
        bail!("{}: its frames are {first} to {last}, none of which was asked for", path.display());
    }
    let still = loaded.groom.clone();
    let name = path.display().to_string();
    let accelerates = Rc::new(Cell::new(false));
    let seen = Rc::clone(&accelerates);
    let frames = frames.filter(move |frame| frame.as_ref().map_or(true, |frame| is_wanted(frame.time))).map(
        move |frame| {
            let frame = frame?;
            seen.set(seen.get() || frame.accelerations.is_some());
            Ok((frame.time, format!("{name}, frame {}", frame.time), moved(&still, frame)?))
        },
    );
    let format = loaded.format.or(Format::from_path(path)).unwrap_or(Format::Usdc);
    let motion = Motion::new(path, format, size(path), loaded, Box::new(frames), count, args)?;
    Ok(Some(Motion { accelerates, ..motion }))
}

/// A groom with the points of a frame.
fn moved(groom: &Groom, frame: Frame) -> Result<Groom> {
    let mut groom = groom.clone();
    groom.positions_mut().copy_from_slice(&frame.positions);
    // Never those of the first frame.
    groom.remove_attribute(names::VELOCITY);
    if let Some(velocities) = frame.velocities {
        let domain = groom::Domain::Vertex;
        groom.set_attribute(names::VELOCITY, Attribute { domain, values: Values::Vec3(velocities) })?;
    }
    Ok(groom)
}

impl<'a> Motion<'a> {
    /// `frames` brings time, name and unedited groom of each.
    fn new(
        path: &Path,
        format: Format,
        bytes: u64,
        loaded: Loaded,
        frames: Box<dyn Iterator<Item = Result<(f64, String, Groom)>> + 'a>,
        frame_count: u64,
        args: &'a Args,
    ) -> Result<Motion<'a>> {
        let Loaded { groom, warnings, repairs, frame_rate, .. } = loaded;
        let had_ids = groom.attribute(names::ID).is_some();
        let mut edits = Edits::new(args);
        let mut groom = edits.apply(groom)?;
        // It comes with every frame.
        groom.remove_attribute(names::VELOCITY);
        let groom = Rc::new(groom);
        let changed = Rc::default();
        let quantize_error = Rc::new(Cell::new(edits.quantize_error));
        let (like, differing, moved) = (Rc::clone(&groom), Rc::clone(&changed), Rc::clone(&quantize_error));
        let frames = frames.map(move |frame| {
            let (time, name, groom) = frame?;
            let groom = edits.apply(groom)?;
            moved.set(edits.quantize_error);
            frame_of(time, &name, groom, &like, &differing)
        });
        Ok(Motion {
            name: path.display().to_string(),
            format,
            bytes,
            repairs,
            warnings,
            had_ids,
            groom,
            quantize_error,
            changed,
            accelerates: Rc::default(),
            frame_rate: args.writing.fps.or(frame_rate).unwrap_or(FRAME_RATE),
            frames: Box::new(frames),
            frame_count,
        })
    }

    /// Writes it; returns the groom, how many frames, what the format could not hold and the bytes.
    pub(crate) fn store(
        self,
        output: &Path,
        format: Format,
        options: &WriteOptions,
    ) -> Result<(Rc<Groom>, u64, Vec<Warning>, u64)> {
        if is_stream(output) {
            bail!("a groom that moves cannot go to standard output; name a file");
        }
        clear(output, format);
        let bar = progress_bar(self.frame_count, "frames");
        // An error of ours travels around the writer, which knows only its own.
        let fault = Cell::new(None);
        let written = {
            let mut frames = self.frames.map(|frame| {
                bar.inc(1);
                frame.map_err(|error| {
                    let stopped = std::io::Error::other("a frame could not be read");
                    fault.set(Some(error));
                    FormatError::Io { file: self.name.clone(), source: stopped }
                })
            });
            let motion = MotionOptions::at_rate(self.frame_rate);
            write_animation(&self.groom, &mut frames, &motion, output, options)
        };
        bar.finish();
        match (fault.take(), written) {
            (Some(error), _) => Err(error),
            (None, written) => {
                let mut lost = written?;
                lost.extend(self.changed.take().into_iter().map(|name| Warning::AttributeNotRead {
                    name,
                    why: "only points and velocities move, and it changes; the first frame's is kept".into(),
                }));
                if self.accelerates.get() {
                    lost.push(Warning::AttributeNotRead {
                        name: "accelerations".into(),
                        why: "only points and velocities move; they are left out".into(),
                    });
                }
                Ok((self.groom, self.frame_count, lost, size(output)))
            }
        }
    }
}

/// A groom as a frame of `like`; notes the names of the attributes that differ.
fn frame_of(
    time: f64,
    name: &str,
    mut groom: Groom,
    like: &Groom,
    changed: &RefCell<BTreeSet<String>>,
) -> Result<Frame> {
    if groom.offsets() != like.offsets() {
        bail!(
            "{name}: {} strands of {} points, expected {} of {}, as in the first frame, and as many on every strand",
            groom.strand_count(),
            groom.point_count(),
            like.strand_count(),
            like.point_count()
        );
    }
    let velocities = match groom.remove_attribute(names::VELOCITY) {
        Some(Attribute { values: Values::Vec3(velocities), .. })
            if velocities.len() == groom.point_count() =>
        {
            Some(velocities)
        }
        _ => None,
    };
    let both = groom.attributes().chain(like.attributes());
    let differing = both.filter(|(name, _)| groom.attribute(name) != like.attribute(name));
    changed.borrow_mut().extend(differing.map(|(name, _)| name.to_owned()));
    Ok(Frame { time, positions: groom.positions().to_owned(), velocities, ..Frame::default() })
}
