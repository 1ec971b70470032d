//! How a terminal shows pictures.

use crate::{Picture, ViewError, blocks, graphics, sixel};

/// How a terminal shows pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Manner {
    /// Half blocks in 24-bit colours: two pixels a character, in any terminal of today.
    Blocks,
    /// The graphics of kitty, Ghostty and Konsole.
    Kitty,
    /// The inline pictures of iTerm2, WezTerm and mintty.
    Inline,
    /// Sixels: foot, mlterm, xterm where it says so.
    Sixel,
}

impl Manner {
    /// The manner of the terminal that these environment variables describe; `None` where it shows no colours, or
    /// there is none. Within tmux and screen, which swallow graphics, it is half blocks.
    #[must_use]
    pub fn of(variable: impl Fn(&str) -> Option<String>) -> Option<Manner> {
        let get = |name| variable(name).unwrap_or_default();
        let (term, program) = (get("TERM"), get("TERM_PROGRAM"));
        if term.is_empty() || term == "dumb" || !get("NO_COLOR").is_empty() {
            return None;
        }
        let multiplexed = !get("TMUX").is_empty() || term.starts_with("screen") || term.starts_with("tmux");
        let manner = if multiplexed {
            Manner::Blocks
        } else if !get("KITTY_WINDOW_ID").is_empty() || term == "xterm-kitty" || term == "xterm-ghostty" {
            Manner::Kitty
        } else if ["iTerm.app", "WezTerm", "mintty"].contains(&program.as_str()) {
            Manner::Inline
        } else if term.contains("sixel") || term.starts_with("foot") || term.starts_with("mlterm") {
            Manner::Sixel
        } else {
            Manner::Blocks
        };
        Some(manner)
    }
}

/// The bytes that show `picture` in a terminal of `columns` x `rows` characters, ending in a line feed; one row is
/// left for the prompt.
///
/// # Errors
/// [`ViewError::Packed`] when the picture could not be packed.
pub fn drawn(picture: &Picture, (columns, rows): (u16, u16), manner: Manner) -> Result<Vec<u8>, ViewError> {
    // A character is about twice as high as wide: half of one is a square.
    let room = (u32::from(columns).max(1), 2 * u32::from(rows).saturating_sub(1).max(1));
    let (across, halves) = picture.size_in(room, manner != Manner::Blocks);
    let cells = (across, halves.div_ceil(2));
    match manner {
        Manner::Blocks => {
            let (across, halves) = picture.size_in(room, true);
            Ok(blocks::drawn(&picture.scaled(across, halves)).into_bytes())
        }
        Manner::Kitty => Ok(graphics::kitty(picture, cells)),
        Manner::Inline => graphics::inline(picture, cells),
        Manner::Sixel => Ok(sixel::drawn(picture, cells)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(variables: &[(&str, &str)]) -> Option<Manner> {
        Manner::of(|name| variables.iter().find(|(n, _)| *n == name).map(|(_, value)| (*value).to_owned()))
    }

    #[test]
    fn terminals_are_known_by_what_they_say() {
        assert_eq!(of(&[]), None);
        assert_eq!(of(&[("TERM", "dumb")]), None);
        assert_eq!(of(&[("TERM", "xterm-kitty"), ("NO_COLOR", "1")]), None);
        assert_eq!(of(&[("TERM", "xterm-256color")]), Some(Manner::Blocks));
        assert_eq!(of(&[("TERM", "xterm-kitty")]), Some(Manner::Kitty));
        assert_eq!(of(&[("TERM", "xterm-kitty"), ("TMUX", "/tmp/x")]), Some(Manner::Blocks));
        assert_eq!(of(&[("TERM", "xterm"), ("TERM_PROGRAM", "WezTerm")]), Some(Manner::Inline));
        assert_eq!(of(&[("TERM", "foot")]), Some(Manner::Sixel));
        assert_eq!(of(&[("TERM", "xterm+sixel")]), Some(Manner::Sixel));
    }
}
