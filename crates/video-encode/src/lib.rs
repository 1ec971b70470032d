//! Frames as a film, encoded by ffmpeg in a process of its own.
//!
//! Display-referred pixels go in as they are shown, straight alpha, sRGB; nothing here maps tones. [`Ffmpeg::find`]
//! says whether there is an ffmpeg at all; [`Film::begin`] starts one, [`Film::push`] pipes a picture in and
//! [`Film::finish`] puts the film in its place: whole, or not at all.
//!
//! ```no_run
//! use std::path::Path;
//! use video_encode::{Codec, Ffmpeg, Film, FilmSettings, FrameRate, Picture};
//!
//! if let Some(ffmpeg) = Ffmpeg::find() {
//!     let settings = FilmSettings {
//!         width: 640,
//!         height: 360,
//!         rate: FrameRate::new(24.0)?,
//!         codec: Codec::H264 { crf: 18 },
//!         comment: None,
//!     };
//!     let mut film = Film::begin(&ffmpeg, Path::new("turntable.mp4"), settings)?;
//!     let grey = vec![128; 640 * 360 * 4];
//!     film.push(Picture::Rgba8(&grey))?;
//!     film.finish()?;
//! }
//! # Ok::<(), video_encode::VideoError>(())
//! ```

mod command;
mod error;
mod ffmpeg;
mod film;
mod pad;
mod settings;

pub use error::VideoError;
pub use ffmpeg::Ffmpeg;
pub use film::{Film, FilmReport, Picture};
pub use settings::{Codec, FilmSettings, FrameRate};
