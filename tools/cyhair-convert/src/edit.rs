//! What the options do to a groom.

use anyhow::{Context, Result, bail};
use groom::{Groom, Guides, Smoothing, Statistics, names};

use crate::args::{Args, Strands};
use crate::texture::Picture;

/// The order in which edits are done, for the help.
pub(crate) const ORDER: &str = "\
Edits are done in this order, wherever they stand on the command line: --stride; --scale, --rotate, \
--translate (or --matrix), --up; --min-length, --max-length, --max-strands; --reverse, --smooth, --resample \
or --resample-step; --guides, --guides-only; --set, colours, widths, --melanin, --redness, --width-ramp; \
--tolerance; --quantize. Lengths and widths are thus in the output's numbers.";

/// The edits the options ask for, and what was decided on the first groom they were done to.
///
/// Which strands and points stay, and which strands are guides, depends on the strands' shape. Frames of
/// one groom are all done as the first, so that they stay frames of one groom.
pub(crate) struct Edits<'a> {
    args: &'a Args,
    kept_by_length: Option<Vec<u32>>,
    resampled: Option<Vec<u32>>,
    guides: Option<Guides>,
    simple_points: Option<Vec<u32>>,
    picture: Option<Picture>,
    /// The farthest that quantizing moved a point, in the output's numbers.
    pub(crate) quantize_error: Option<f64>,
}

impl<'a> Edits<'a> {
    pub(crate) fn new(args: &'a Args) -> Self {
        Edits {
            args,
            kept_by_length: None,
            resampled: None,
            guides: None,
            simple_points: None,
            picture: None,
            quantize_error: None,
        }
    }

    /// Does what the options ask for, in the order of [`ORDER`].
    pub(crate) fn apply(&mut self, groom: Groom) -> Result<Groom> {
        let full = self.shape(groom)?;
        self.reduce(full)
    }

    /// As [`Edits::apply`], but for the reductions at its end.
    pub(crate) fn shape(&mut self, mut groom: Groom) -> Result<Groom> {
        let strands = &self.args.strands;
        if let Some(stride) = strands.stride.filter(|&stride| stride > 1) {
            groom = groom.subsample_by_stride(stride as usize)?;
        }
        place(&mut groom, strands)?;
        groom = self.choose(groom)?;
        groom = self.reshape(groom)?;
        groom = self.guide(groom)?;
        self.dress(&mut groom)?;
        Ok(groom)
    }

    /// Leaves out points and rounds them, as the options ask.
    pub(crate) fn reduce(&mut self, mut groom: Groom) -> Result<Groom> {
        let strands = &self.args.strands;
        if let Some(tolerance) = strands.tolerance {
            let points = match self.simple_points.take() {
                Some(points) => points,
                None => groom.simple_points(tolerance).context("--tolerance")?,
            };
            groom = groom.keep_points(&points).context("--tolerance")?;
            self.simple_points = Some(points);
        }
        if let Some(bits) = strands.quantize {
            let moved = groom.quantize(bits).context("--quantize")?;
            self.quantize_error = Some(self.quantize_error.unwrap_or(0.0).max(moved));
        }
        Ok(groom)
    }

    /// Keeps some strands.
    fn choose(&mut self, mut groom: Groom) -> Result<Groom> {
        let strands = &self.args.strands;
        if strands.min_length.is_some() || strands.max_length.is_some() {
            let kept = match self.kept_by_length.take() {
                Some(kept) => kept,
                None => by_length(&groom, strands)?,
            };
            if kept.len() != groom.strand_count() {
                groom = groom.keep_strands(&kept).context("--min-length, --max-length")?;
            }
            self.kept_by_length = Some(kept);
        }
        match strands.max_strands.map(|most| most as usize) {
            Some(most) if most < groom.strand_count() => Ok(groom.subsample_to(most)),
            _ => Ok(groom),
        }
    }

    /// Changes strands by themselves.
    fn reshape(&mut self, mut groom: Groom) -> Result<Groom> {
        let strands = &self.args.strands;
        if strands.reverse {
            groom.reverse();
        }
        if let Some(smooth) = strands.smooth {
            let (iterations, strength) = (smooth.iterations, smooth.strength);
            let smoothing = Smoothing { iterations, strength, keep_length: strands.keep_length };
            groom.smooth(smoothing).context("--smooth")?;
        }
        if let Some(points) = strands.resample {
            groom = groom.resample_by_count(points as usize).context("--resample")?;
        }
        if let Some(step) = strands.resample_step {
            groom = match &self.resampled {
                Some(offsets) => groom.resample_like(offsets),
                None => groom.resample_by_length(step),
            }
            .context("--resample-step")?;
            self.resampled.get_or_insert_with(|| groom.offsets().to_owned());
        }
        Ok(groom)
    }

    fn guide(&mut self, mut groom: Groom) -> Result<Groom> {
        let strands = &self.args.strands;
        if let Some(count) = strands.guides {
            let guides = match self.guides.take() {
                Some(guides) => guides,
                None => groom.pick_guides(count as usize, self.seed()).context("--guides")?,
            };
            groom.mark_guides(&guides).context("--guides")?;
            if strands.closest_guide {
                groom.mark_closest_guides(&guides).context("--closest-guide")?;
            }
            self.guides = Some(guides);
        }
        if strands.guides_only {
            groom = groom
                .keep_guides()
                .context("--guides-only needs --guides N, or an input that marks guides")?;
        }
        Ok(groom)
    }

    fn dress(&mut self, groom: &mut Groom) -> Result<()> {
        let (look, seed) = (&self.args.look, self.seed());
        // First of all, for it may say where in a picture the roots are.
        for (name, value) in &look.set {
            groom.set(name, value, seed).with_context(|| format!("--set {name}"))?;
        }
        if let Some(color) = look.color {
            groom.set_color(color).context("--color")?;
        }
        if let (Some(root), Some(tip)) = (look.root_color, look.tip_color) {
            groom.ramp_color(root, tip).context("--root-color, --tip-color")?;
        }
        if let Some(path) = &look.color_from_texture {
            let picture = match self.picture.take() {
                Some(picture) => picture,
                None => Picture::load(path)?,
            };
            let texture = picture.texture(look.texture_v.map(Into::into).unwrap_or_default())?;
            groom.color_from_texture(&texture).context("--color-from-texture")?;
            self.picture = Some(picture);
        }
        if let Some(width) = look.width {
            groom.set_width(width).context("--width")?;
        }
        if let (Some(root), Some(tip)) = (look.root_width, look.tip_width) {
            groom.ramp_width(root, tip).context("--root-width, --tip-width")?;
        }
        let named = [(names::MELANIN, &look.melanin), (names::REDNESS, &look.redness)];
        for (name, value) in named.into_iter().filter_map(|(name, value)| Some((name, value.as_ref()?))) {
            groom.set(name, value, seed).with_context(|| format!("--{name}"))?;
        }
        if let Some(ramp) = &look.width_ramp {
            groom.multiply_width(ramp).context("--width-ramp")?;
        }
        Ok(())
    }

    fn seed(&self) -> u64 {
        self.args.look.seed.unwrap_or(0)
    }
}

/// Moves the groom as a whole.
fn place(groom: &mut Groom, strands: &Strands) -> Result<()> {
    if let Some(factor) = strands.scale {
        groom.scale(factor).context("--scale")?;
    }
    for turn in &strands.rotate {
        groom.rotate(turn.axis, turn.degrees.to_radians()).context("--rotate")?;
    }
    if let Some(offset) = strands.translate {
        groom.translate(offset).context("--translate")?;
    }
    if let Some(matrix) = &strands.matrix {
        groom.transform(matrix).context("--matrix")?;
    }
    if let Some(up) = strands.up {
        groom.turn_to(up.into());
    }
    Ok(())
}

/// The strands as long as asked for; none is an error.
fn by_length(groom: &Groom, strands: &Strands) -> Result<Vec<u32>> {
    let (min, max) = (strands.min_length.unwrap_or(0.0), strands.max_length.unwrap_or(f32::INFINITY));
    let kept = groom.strands_by_length(min, max).context("--min-length, --max-length")?;
    if let (true, Some(lengths)) = (kept.is_empty(), Statistics::of(groom).strand_length) {
        let (shortest, longest) = (lengths.min as f32, lengths.max as f32);
        bail!("--min-length and --max-length leave no strand; lengths here are {shortest} to {longest}");
    }
    Ok(kept)
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use glam::Vec3;

    use super::*;

    /// 40 strands of 12 points that are bent and long by `bend`.
    fn frame(bend: f32) -> Groom {
        let point = |i: u16| {
            let (strand, t) = (f32::from(i / 12), f32::from(i % 12) / 11.0);
            let wave = bend * (t * 9.0 + strand * bend).sin();
            Vec3::new(strand + wave, t * (1.0 + (strand * 7.0 * bend).cos().abs()), wave * wave)
        };
        Groom::new((0..=40).map(|i| i * 12).collect(), (0..480).map(point).collect()).unwrap()
    }

    #[test]
    fn frames_keep_what_the_first_kept() {
        let options = [
            &["--min-length", "1.5"][..],
            &["--resample-step", "0.11"],
            &["--guides", "5", "--guides-only"],
            &["--tolerance", "0.02"],
            &["--min-length", "1.4", "--resample-step", "0.2", "--guides", "6", "--tolerance", "0.01"],
        ];
        for options in options {
            let args = Args::parse_from([&["cyhair-convert", "in.hair", "out.hair"], options].concat());
            let mut edits = Edits::new(&args);
            let (first, second) = (edits.apply(frame(0.1)).unwrap(), edits.apply(frame(0.4)).unwrap());
            assert_eq!(first.offsets(), second.offsets(), "{options:?}");
            assert_eq!(first.attribute(names::ID), second.attribute(names::ID), "{options:?}");
            assert_eq!(first.attribute(names::GUIDE), second.attribute(names::GUIDE), "{options:?}");
            // By itself the second would have become another groom.
            let alone = Edits::new(&args).apply(frame(0.4)).unwrap();
            let differs = alone.offsets() != second.offsets()
                || alone.attribute(names::ID) != second.attribute(names::ID);
            assert!(differs, "{options:?}");
        }
    }
}
