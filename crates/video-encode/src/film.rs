//! One ffmpeg at work.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::JoinHandle;

use whole_file::WholeFile;

use crate::command::arguments;
use crate::pad::padded;
use crate::{Codec, Ffmpeg, FilmSettings, VideoError};

/// Bytes kept of what ffmpeg says: its last words tell why.
const LAST_WORDS: usize = 4000;

/// A picture: sRGB, straight alpha, row by row from the upper left.
#[derive(Clone, Copy, Debug)]
pub enum Picture<'a> {
    /// Red, green, blue, alpha in eight bits.
    Rgba8(&'a [u8]),
    /// The same in sixteen bits.
    Rgba16(&'a [u16]),
}

/// What became of the pictures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilmReport {
    /// How many.
    pub pictures: u64,
    /// Pixels across in the film: more than were given where odd sizes were padded.
    pub width: u32,
    /// Pixels down in the film.
    pub height: u32,
    /// Size of the file.
    pub bytes: u64,
}

/// A film being made; dropped before [`Film::finish`] it leaves nothing behind.
#[derive(Debug)]
pub struct Film {
    path: PathBuf,
    program: PathBuf,
    settings: FilmSettings,
    /// Even, where the codec wants that.
    size: (u32, u32),
    pictures: u64,
    process: Process,
    file: WholeFile,
}

/// ffmpeg itself, killed when dropped at work.
#[derive(Debug)]
struct Process {
    child: Child,
    words: Option<JoinHandle<Vec<u8>>>,
}

impl Drop for Process {
    fn drop(&mut self) {
        // Gone already is as good.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Film {
    /// Starts an ffmpeg that writes the film beside `path`, under a temporary name.
    ///
    /// # Errors
    /// [`VideoError::Setting`], [`VideoError::Io`] when ffmpeg does not start, or [`VideoError::WholeFile`] when the
    /// folder cannot be written.
    pub fn begin(ffmpeg: &Ffmpeg, path: &Path, settings: FilmSettings) -> Result<Film, VideoError> {
        settings.check()?;
        let even = |edge: u32| match settings.codec {
            Codec::H264 { .. } => edge.next_multiple_of(2),
            Codec::ProRes4444 => edge,
        };
        let size = (even(settings.width), even(settings.height));
        let file = WholeFile::create(path)?;
        let program = ffmpeg.program().to_owned();
        let mut command = Command::new(&program);
        command.args(arguments(&settings, size, file.temporary_path()));
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        // Ctrl-C in a terminal is for whoever pipes the pictures: ffmpeg would end with half a film and be content.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let io = |source| VideoError::Io { program: program.clone(), action: "start it", source };
        let mut child = command.spawn().map_err(io)?;
        // Read all the while: a full pipe would stop ffmpeg, and then us.
        let words = child.stderr.take().map(|stderr| std::thread::spawn(move || last_words(stderr)));
        let process = Process { child, words };
        Ok(Film { path: path.to_owned(), program, settings, size, pictures: 0, process, file })
    }

    /// Pipes one picture in.
    ///
    /// # Errors
    /// [`VideoError::Picture`] when its size or depth is not the film's, [`VideoError::Ffmpeg`] when ffmpeg gave up.
    pub fn push(&mut self, picture: Picture) -> Result<(), VideoError> {
        let FilmSettings { width, height, codec, .. } = self.settings;
        let (wide, high) = (self.size.0 as usize, self.size.1 as usize);
        let expected = width as usize * height as usize * 4;
        let bytes = match (picture, codec) {
            (Picture::Rgba8(values), Codec::H264 { .. }) if values.len() == expected => {
                padded(values, width as usize, wide, high)
            }
            (Picture::Rgba16(values), Codec::ProRes4444) if values.len() == expected => {
                let values = padded(values, width as usize, wide, high);
                values.iter().flat_map(|value| value.to_le_bytes()).collect()
            }
            (picture, codec) => {
                let found = match picture {
                    Picture::Rgba8(values) => values.len(),
                    Picture::Rgba16(values) => values.len(),
                };
                let depth = match codec {
                    Codec::H264 { .. } => "eight bits each",
                    Codec::ProRes4444 => "sixteen bits each",
                };
                let index = self.pictures;
                return Err(VideoError::Picture { index, found, width, height, expected, depth });
            }
        };
        let Some(stdin) = self.process.child.stdin.as_mut() else { return Err(self.gave_up()) };
        if stdin.write_all(&bytes).is_err() {
            return Err(self.gave_up());
        }
        self.pictures += 1;
        Ok(())
    }

    /// Waits for ffmpeg and puts the film in its place.
    ///
    /// # Errors
    /// [`VideoError::Empty`] for a film without pictures, [`VideoError::Ffmpeg`], [`VideoError::WholeFile`].
    pub fn finish(mut self) -> Result<FilmReport, VideoError> {
        if self.pictures == 0 {
            return Err(VideoError::Empty { path: self.path.clone() });
        }
        drop(self.process.child.stdin.take());
        let program = self.program.clone();
        let io = |source| VideoError::Io { program, action: "wait for it", source };
        let status = self.process.child.wait().map_err(io)?;
        let bytes = std::fs::metadata(self.file.temporary_path()).map_or(0, |file| file.len());
        if !status.success() || bytes == 0 {
            return Err(self.gave_up());
        }
        let Film { file, size: (width, height), pictures, .. } = self;
        file.commit()?;
        Ok(FilmReport { pictures, width, height, bytes })
    }

    /// ffmpeg's own words about its end.
    fn gave_up(&mut self) -> VideoError {
        drop(self.process.child.stdin.take());
        let status = self.process.child.wait().map_or_else(|e| e.to_string(), |status| status.to_string());
        let words = self.process.words.take().and_then(|thread| thread.join().ok()).unwrap_or_default();
        let words = String::from_utf8_lossy(&words).trim().to_owned();
        let words = if words.is_empty() { "it said nothing".to_owned() } else { words };
        VideoError::Ffmpeg { path: self.path.clone(), status, words }
    }
}

/// The end of what is said on `stderr`.
fn last_words(mut stderr: impl std::io::Read) -> Vec<u8> {
    let mut words = Vec::new();
    let mut buffer = [0; 1024];
    while let Ok(count @ 1..) = stderr.read(&mut buffer) {
        words.extend_from_slice(&buffer[..count]);
        let extra = words.len().saturating_sub(LAST_WORDS);
        words.drain(..extra);
    }
    words
}
