//! What cannot be put together.

use std::path::PathBuf;

/// Why frames cannot be put together as asked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompError {
    /// A weight that is not `PASS=FACTOR`.
    #[error("weight `{found}`: {reason}; expected PASS=FACTOR, such as TT=0.5")]
    Weight {
        /// What was given.
        found: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A pass that the frame does not carry.
    #[error(
        "the frame has no pass `{pass}` (it has {has}); render it with `--aovs {pass}` or `render.aovs: [{pass}]`"
    )]
    NoSuchPass {
        /// The pass.
        pass: &'static str,
        /// Those that are there.
        has: String,
    },
    /// A colour that cannot be read.
    #[error("colour `{found}`: expected #rrggbb (sRGB) or r,g,b (linear Rec. 709, each 0 to 1000)")]
    Color {
        /// What was given.
        found: String,
    },
    /// Outputs cannot be named as asked.
    #[error("{} {reason}", path.display())]
    Naming {
        /// The frame or the output.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A file could not be read.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A plate is no picture, or none that is read here.
    #[error("{}: not a picture that can be put behind a frame (.png, .jpg, .exr, .hdr): {reason}", path.display())]
    Plate {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A plate of light could not be read.
    #[error(transparent)]
    Light(#[from] hair_render::RenderError),
}
