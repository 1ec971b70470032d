//! What the options do to a groom.

use anyhow::{Context, Result, bail};
use groom::{Groom, Smoothing, Statistics};

use crate::args::{Args, Look, Strands};
use crate::texture::Picture;

/// The order in which edits are done, for the help.
pub(crate) const ORDER: &str = "\
Edits are done in this order, wherever they stand on the command line: --stride; --scale, --rotate, \
--translate (or --matrix), --up; --min-length, --max-length, --max-strands; --reverse, --smooth, --resample \
or --resample-step; --guides, --guides-only; --set, colours, widths, --melanin, --redness, --width-ramp; \
--tolerance; --quantize. Lengths and widths are thus in the output's numbers.";

/// A groom that was edited.
pub(crate) struct Edited {
    pub(crate) groom: Groom,
    /// The farthest that quantizing moved a point.
    pub(crate) quantize_error: Option<f64>,
}

/// Does what the options ask for, in the order of [`ORDER`].
pub(crate) fn edit(mut groom: Groom, args: &Args) -> Result<Edited> {
    let (strands, look) = (&args.strands, &args.look);
    let seed = look.seed.unwrap_or(0);
    if let Some(stride) = strands.stride.filter(|&stride| stride > 1) {
        groom = groom.subsample_by_stride(stride as usize)?;
    }
    place(&mut groom, strands)?;
    groom = choose(groom, strands)?;
    groom = reshape(groom, strands)?;
    groom = guides(groom, strands, seed)?;
    dress(&mut groom, look, seed)?;
    if let Some(tolerance) = strands.tolerance {
        groom = groom.simplify(tolerance).context("--tolerance")?;
    }
    let quantize_error =
        strands.quantize.map(|bits| groom.quantize(bits)).transpose().context("--quantize")?;
    Ok(Edited { groom, quantize_error })
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

/// Keeps some strands.
fn choose(mut groom: Groom, strands: &Strands) -> Result<Groom> {
    if strands.min_length.is_some() || strands.max_length.is_some() {
        let (min, max) = (strands.min_length.unwrap_or(0.0), strands.max_length.unwrap_or(f32::INFINITY));
        let kept = groom.filter_by_length(min, max).context("--min-length, --max-length")?;
        if let (0, Some(lengths)) = (kept.strand_count(), Statistics::of(&groom).strand_length) {
            let (shortest, longest) = (lengths.min as f32, lengths.max as f32);
            bail!("--min-length and --max-length leave no strand; lengths here are {shortest} to {longest}");
        }
        groom = kept;
    }
    match strands.max_strands.map(|most| most as usize) {
        Some(most) if most < groom.strand_count() => Ok(groom.subsample_to(most)),
        _ => Ok(groom),
    }
}

/// Changes strands by themselves.
fn reshape(mut groom: Groom, strands: &Strands) -> Result<Groom> {
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
        groom = groom.resample_by_length(step).context("--resample-step")?;
    }
    Ok(groom)
}

fn guides(mut groom: Groom, strands: &Strands, seed: u64) -> Result<Groom> {
    if let Some(count) = strands.guides {
        let guides = groom.pick_guides(count as usize, seed).context("--guides")?;
        groom.mark_guides(&guides).context("--guides")?;
        if strands.closest_guide {
            groom.mark_closest_guides(&guides).context("--closest-guide")?;
        }
    }
    if strands.guides_only {
        groom =
            groom.keep_guides().context("--guides-only needs --guides N, or an input that marks guides")?;
    }
    Ok(groom)
}

fn dress(groom: &mut Groom, look: &Look, seed: u64) -> Result<()> {
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
        let picture = Picture::load(path)?;
        let texture = picture.texture(look.texture_v.map(Into::into).unwrap_or_default())?;
        groom.color_from_texture(&texture).context("--color-from-texture")?;
    }
    if let Some(width) = look.width {
        groom.set_width(width).context("--width")?;
    }
    if let (Some(root), Some(tip)) = (look.root_width, look.tip_width) {
        groom.ramp_width(root, tip).context("--root-width, --tip-width")?;
    }
    let named = [("melanin", &look.melanin), ("redness", &look.redness)];
    for (name, value) in named.into_iter().filter_map(|(name, value)| Some((name, value.as_ref()?))) {
        groom.set(name, value, seed).with_context(|| format!("--{name}"))?;
    }
    if let Some(ramp) = &look.width_ramp {
        groom.multiply_width(ramp).context("--width-ramp")?;
    }
    Ok(())
}
