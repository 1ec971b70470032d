//! Text as a groom.

use std::io::Read;

use groom::{Attribute, Domain, Groom, UpAxis, Values, names};

use super::lines::Lines;
use super::pieces::Pieces;
use crate::{FormatError, Loaded, ReadOptions};

/// Pieces a core has before it while the next are read.
const AHEAD: usize = 2;

/// Some editors put it before the first line.
const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// Reads a groom from text in the layout that the module `text` states; `name` stands for the file in messages.
///
/// Lines are understood on all cores while the next are read.
///
/// # Errors
/// [`FormatError::Text`] with line and column, [`FormatError::Io`], [`FormatError::TooLarge`].
pub fn read(stream: impl Read, name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let mut lines = Lines::new(name, None);
    let mut pieces = Pieces::new(stream);
    let io = |e| FormatError::io(name, e);
    let mut piece = Vec::new();
    pieces.next(&mut piece).map_err(io)?;
    lines.take(piece.strip_prefix(BYTE_ORDER_MARK).unwrap_or(&piece))?;
    // The first line with numbers says how many there are on each.
    while lines.columns.is_none() && !piece.is_empty() {
        pieces.next(&mut piece).map_err(io)?;
        lines.take(&piece)?;
    }
    if !piece.is_empty() {
        lines.make_room(piece.len(), options.known_len);
        take_the_others(&mut lines, &mut pieces, name)?;
    }
    lines.finish()?;
    groom_of(lines, name, options)
}

/// Reads pieces and hands them to whoever is free, round by round.
fn take_the_others(
    lines: &mut Lines<'_>,
    pieces: &mut Pieces<impl Read>,
    name: &str,
) -> Result<(), FormatError> {
    let columns = lines.columns;
    let most = AHEAD * rayon::current_num_threads();
    let (mut full, mut empty): (Vec<Vec<u8>>, Vec<Vec<u8>>) = (Vec::new(), Vec::new());
    loop {
        let mut understood: Vec<_> = full.iter().map(|_| (Lines::new(name, columns), Ok(()))).collect();
        let mut read = Ok(());
        empty.resize_with(most, Vec::new);
        rayon::in_place_scope(|scope| {
            for (piece, (lines, outcome)) in full.iter().zip(&mut understood) {
                scope.spawn(move |_| *outcome = lines.take(piece));
            }
            read = empty.iter_mut().try_for_each(|piece| pieces.next(piece));
        });
        for (next, outcome) in understood {
            lines.append(next, outcome)?;
        }
        read.map_err(|e| FormatError::io(name, e))?;
        std::mem::swap(&mut full, &mut empty);
        full.retain(|piece| !piece.is_empty());
        if full.is_empty() {
            return Ok(());
        }
    }
}

fn groom_of(lines: Lines<'_>, name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let fault = |source| FormatError::groom(name, source);
    let ends = lines.ends.into_iter().filter(|&end| end > 0);
    let offsets = std::iter::once(0).chain(ends).collect();
    let mut groom = Groom::new(offsets, lines.positions).map_err(fault)?;
    groom.up_axis = options.up_axis.unwrap_or(UpAxis::Z);
    groom.meters_per_unit = options.meters_per_unit.unwrap_or(1.0);
    let per_vertex = |values| Attribute { domain: Domain::Vertex, values };
    let radius = if lines.radii.is_empty() {
        Attribute::constant_float(groom::DEFAULT_RADIUS)
    } else {
        per_vertex(Values::Float(lines.radii))
    };
    groom.set_attribute(names::RADIUS, radius).map_err(fault)?;
    if !lines.colors.is_empty() {
        groom.set_attribute(names::COLOR, per_vertex(Values::Vec3(lines.colors))).map_err(fault)?;
    }
    if !lines.transparencies.is_empty() {
        let values = per_vertex(Values::Float(lines.transparencies));
        groom.set_attribute(names::TRANSPARENCY, values).map_err(fault)?;
    }
    let repairs = if options.repair { groom.repair() } else { Vec::new() };
    let repairs = repairs.iter().map(ToString::to_string).collect();
    Ok(Loaded { warnings: lines.warnings, repairs, ..Loaded::still(groom) })
}
