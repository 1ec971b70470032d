//! Files that end in `.hair` and are something else.

use std::fmt;

/// What a file without the magic seems to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LookAlike {
    /// MonoHair: `u32` strands, `u32` points, one `u16` **point** count a strand, then points.
    MonoHair {
        /// Strands by its first field.
        strands: u32,
        /// Points by its second field.
        points: u32,
    },
    /// Tungsten's `.fiber`.
    TungstenFiber,
    /// Text, perhaps `x y z` lines.
    Text,
}

impl fmt::Display for LookAlike {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LookAlike::MonoHair { strands, points } => write!(
                f,
                "a MonoHair file ({strands} strands, {points} points, no magic, point counts instead of segments)"
            ),
            LookAlike::TungstenFiber => write!(f, "a Tungsten .fiber file"),
            LookAlike::Text => write!(f, "a text file"),
        }
    }
}

/// Guesses what `start`, the first bytes of a file of `file_bytes` bytes, belongs to.
pub(crate) fn recognise(start: &[u8], file_bytes: Option<u64>) -> Option<LookAlike> {
    if start.starts_with(b"\x80\xBF\x80FIBER") {
        return Some(LookAlike::TungstenFiber);
    }
    if start.iter().all(|byte| byte.is_ascii_graphic() || byte.is_ascii_whitespace()) {
        return Some(LookAlike::Text);
    }
    mono_hair(start, file_bytes)
}

fn mono_hair(start: &[u8], file_bytes: Option<u64>) -> Option<LookAlike> {
    let word = |at: usize| Some(u32::from_le_bytes(start.get(at..at + 4)?.try_into().ok()?));
    let (strands, points) = (word(0)?, word(4)?);
    let bytes = 8 + 2 * u64::from(strands) + 12 * u64::from(points);
    // Without a length the first counts must do: no strand of MonoHair is longer than a u16 can say.
    let first_counts = start.get(8..)?.chunks_exact(2).take(strands as usize).take(16);
    let counts_fit = first_counts.map(|c| u16::from_le_bytes([c[0], c[1]])).all(|count| count > 0);
    let fits = file_bytes.is_none_or(|len| len == bytes) && counts_fit && strands > 0 && strands <= points;
    fits.then_some(LookAlike::MonoHair { strands, points })
}
