//! A text in pieces that end where lines end.

use std::io::Read;

use super::lines::LINE_LIMIT;

/// About how long a piece is.
const PIECE: usize = 1 << 18;

/// Cuts a stream into pieces of whole lines.
pub(super) struct Pieces<R> {
    stream: R,
    /// The beginning of the line that the last piece ended before.
    rest: Vec<u8>,
    ended: bool,
}

impl<R: Read> Pieces<R> {
    pub(super) fn new(stream: R) -> Self {
        Pieces { stream, rest: Vec::new(), ended: false }
    }

    /// The next lines; the last may have no end, or may have been cut because it is longer than any line
    /// should be. Empty after the last.
    pub(super) fn next(&mut self, piece: &mut Vec<u8>) -> std::io::Result<()> {
        piece.clear();
        piece.append(&mut self.rest);
        while !self.ended {
            self.ended = !fill(&mut self.stream, piece)?;
            let end = piece.iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1);
            // What does not end within the limit is refused, and must not be waited for.
            if end > 0 && !self.ended {
                self.rest.extend_from_slice(&piece[end..]);
                piece.truncate(end);
            }
            if end > 0 || piece.len() > LINE_LIMIT {
                break;
            }
        }
        Ok(())
    }
}

/// Reads up to a full piece; tells whether there may be more. Memory grows with what arrives.
fn fill(stream: &mut impl Read, piece: &mut Vec<u8>) -> std::io::Result<bool> {
    let wanted = PIECE.max(piece.len() + LINE_LIMIT) - piece.len();
    let came = stream.by_ref().take(wanted as u64).read_to_end(piece)?;
    Ok(came == wanted)
}
