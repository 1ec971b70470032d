//! HAIR files as grooms: the bytes are `cyhair`'s, their meaning is given here.
//!
//! Thickness is a diameter and becomes a radius; a default becomes a constant attribute, an array one
//! per vertex. Numbers are kept as they are: the file has no unit and no up axis, and z is taken for
//! up, as in Yuksel's models. Halving and doubling are exact, so a file read and written comes out with
//! the same bytes (but for thickness below 2^-125, whose last bit halving loses, and what `cyhair`
//! warns of).

mod blocks;
mod read;
mod sink;
mod write;

pub(crate) use blocks::Blocks;
use read::hair_fault;
pub(crate) use read::read;
pub(crate) use sink::HairSink;
pub(crate) use write::write;
