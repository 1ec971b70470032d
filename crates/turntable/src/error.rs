//! What can keep a turntable from being made.

use std::path::PathBuf;

use strict_yaml::Fault;

use crate::FrameRangeError;

/// A turntable that could not be planned or made. What was finished before stays finished.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TurntableError {
    /// The pipeline file says what it may not; every fault that could be found at once.
    #[error("{}", lines(.0))]
    Pipeline(Vec<Fault>),
    /// The frames asked for cannot be read.
    #[error(transparent)]
    Frames(#[from] FrameRangeError),
    /// None of the frames asked for is in the turntable.
    #[error("frames {asked}: the turntable has frames 1-{count}")]
    NoSuchFrame {
        /// What was asked for.
        asked: String,
        /// How many frames there are.
        count: u32,
    },
    /// `only` names an axis or a setting that the pipeline's `matrix` has not.
    #[error("--only {asked}: {reason}")]
    NoSuchVariant {
        /// What was asked for.
        asked: String,
        /// What is wrong with it, and what there is.
        reason: String,
    },
    /// The system refused.
    #[error("{}: could not {action}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What was tried.
        action: &'static str,
        /// What the system said.
        source: std::io::Error,
    },
    /// An output could not be put in its place.
    #[error(transparent)]
    WholeFile(#[from] whole_file::WholeFileError),
    /// The groom could not be read or written.
    #[error(transparent)]
    Format(#[from] groom_formats::FormatError),
    /// The groom could not be changed as asked.
    #[error("attributes: {0}")]
    Groom(#[from] groom::GroomError),
    /// The sample groom could not be made.
    #[error("groom.sample: {0}")]
    Sample(String),
    /// The material could not be made.
    #[error("material: {0}")]
    Material(#[from] fibre_material::MaterialError),
    /// The mesh could not be read.
    #[error(transparent)]
    Mesh(#[from] moving_mesh::MeshError),
    /// What moves cannot be shown.
    #[error(transparent)]
    Motion(#[from] moving_scene::MovingSceneError),
    /// Keys of the pipeline that lack each other.
    #[error("{0}")]
    Stage(String),
    /// A frame could not be rendered, or a picture not read.
    #[error(transparent)]
    Render(#[from] hair_render::RenderError),
    /// A frame that was rendered could not be put in its place.
    #[error(transparent)]
    Write(hair_render::RenderError),
    /// Frames could not be put together as `comp` says.
    #[error("comp: {0}")]
    Comp(#[from] frame_comp::CompError),
    /// A film could not be made.
    #[error(transparent)]
    Video(#[from] video_encode::VideoError),
    /// A film that is required cannot be made without ffmpeg.
    #[error("{}: a film needs ffmpeg, which is neither $FFMPEG nor in PATH; install it, or leave `required` out", path.display())]
    NoFfmpeg {
        /// The film.
        path: PathBuf,
    },
    /// The page could not be made.
    #[error(transparent)]
    Page(#[from] flip_page::PageError),
    /// The error report could not be written down.
    #[error(transparent)]
    Report(#[from] error_report::ReportError),
    /// The caller asked to stop; run again to go on.
    #[error("stopped; run again to go on")]
    Interrupted,
}

impl TurntableError {
    pub(crate) fn io(path: &std::path::Path, action: &'static str, source: std::io::Error) -> Self {
        TurntableError::Io { path: path.to_owned(), action, source }
    }

    /// Whether nothing else could be made after it: what was rendered could not be written down.
    pub(crate) fn ends_all(&self) -> bool {
        use hair_render::RenderError;
        match self {
            TurntableError::Interrupted | TurntableError::WholeFile(_) | TurntableError::Report(_) => true,
            TurntableError::Io { action, .. } => *action != "read",
            TurntableError::Write(_) | TurntableError::Render(RenderError::Threads { .. }) => true,
            _ => false,
        }
    }
}

fn lines(faults: &[Fault]) -> String {
    faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}
