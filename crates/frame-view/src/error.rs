//! What can keep a picture from being shown.

/// Why a picture is not shown.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// The values are not those of a picture of that size.
    #[error("{found} values for {width} x {height} pixels, expected {expected}")]
    Size {
        /// How many there are.
        found: usize,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// How many there should be.
        expected: u64,
    },
    /// A name that the viewer's messages cannot hold.
    #[error("the name `{found}` {reason}")]
    Name {
        /// What was given.
        found: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A tile that does not lie in its picture.
    #[error("a tile of {width} x {height} pixels at {x}, {y} does not lie in a picture of {whole:?}")]
    Tile {
        /// Left edge.
        x: u32,
        /// Upper edge.
        y: u32,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Pixels of the picture across and down.
        whole: (u32, u32),
    },
    /// The viewer cannot be reached or does not take the picture.
    #[error("{address}: could not {action}: {source}")]
    Viewer {
        /// Host and port.
        address: String,
        /// What was tried.
        action: &'static str,
        /// What the system said.
        source: std::io::Error,
    },
    /// The terminal does not take the picture.
    #[error("writing to the terminal: {0}")]
    Terminal(std::io::Error),
    /// The picture could not be packed for the terminal.
    #[error("the picture could not be packed: {0}")]
    Packed(String),
}
