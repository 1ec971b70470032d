//! Reading the OpenEXR files this crate writes, whatever became of them since.
//!
//! The decoder takes memory as a header asks for it, and one that fails ends the program: so headers are held
//! against the size of the file before anything is unpacked, and the decoder, which is other people's, runs where
//! a panic can be caught.

use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use exr::block::UncompressedBlock;
use exr::block::reader::{ChunksReader as _, Reader};
use exr::meta::BlockDescription;
use exr::meta::attribute::{AttributeValue, SampleType};
use exr::meta::header::Header;
use exr::prelude::Text;
use glam::Mat4;
use half::f16;

use crate::RenderError;
use crate::crop::Window;

/// Deflate makes at most so many bytes of one.
const MOST_FROM_A_BYTE: u64 = 1032;

/// The largest edge of a picture.
const MOST_PIXELS: usize = 65_536;

/// A file whose header was found sound.
pub(crate) struct Opened {
    reader: Reader<BufReader<File>>,
    /// The pixels that are there.
    pub window: Window,
    /// Pixels across and down the whole picture.
    pub size: [u32; 2],
}

/// What is wrong with a file.
pub(crate) enum Unreadable {
    Io(std::io::Error),
    Invalid(String),
}

impl From<exr::error::Error> for Unreadable {
    fn from(fault: exr::error::Error) -> Self {
        match fault {
            exr::error::Error::Io(source) if source.kind() != std::io::ErrorKind::UnexpectedEof => {
                Unreadable::Io(source)
            }
            other => Unreadable::Invalid(other.to_string()),
        }
    }
}

impl From<String> for Unreadable {
    fn from(reason: String) -> Self {
        Unreadable::Invalid(reason)
    }
}

/// Runs `read` on the opened file, in fear of the decoder.
pub(crate) fn with_file<T>(
    path: &Path,
    read: impl FnOnce(Opened) -> Result<T, Unreadable>,
) -> Result<T, RenderError> {
    let all = || read(open(path)?);
    let found = catch_unwind(AssertUnwindSafe(all))
        .unwrap_or_else(|_| Err(Unreadable::Invalid("its decoder gave up on it".into())));
    found.map_err(|fault| match fault {
        Unreadable::Io(source) => RenderError::Io { path: path.to_owned(), source },
        Unreadable::Invalid(reason) => RenderError::InvalidPicture { path: path.to_owned(), reason },
    })
}

fn open(path: &Path) -> Result<Opened, Unreadable> {
    let mut file = BufReader::new(File::open(path).map_err(Unreadable::Io)?);
    let bytes = file.get_ref().metadata().map_err(Unreadable::Io)?.len();
    let mut magic = [0; 4];
    let found = file.read(&mut magic).map_err(Unreadable::Io)?;
    if magic != [0x76, 0x2f, 0x31, 0x01] {
        let found = magic.get(..found).unwrap_or_default();
        return Err(format!("it begins with the bytes {found:02x?}, expected 76 2f 31 01 (OpenEXR)").into());
    }
    file.rewind().map_err(Unreadable::Io)?;
    let reader = Reader::read_from_buffered(file, true)?;
    let (window, size) = check(reader.headers(), bytes)?;
    Ok(Opened { reader, window, size })
}

fn check(headers: &[Header], bytes: u64) -> Result<(Window, [u32; 2]), String> {
    let [header] = headers else { return Err(format!("{} parts, expected 1", headers.len())) };
    if header.deep || header.blocks != BlockDescription::ScanLines {
        return Err("tiles or deep samples, expected flat scan lines".into());
    }
    let display = header.shared_attributes.display_window;
    let (data, position) = (header.layer_size, header.own_attributes.layer_position);
    let edges = [
        ("data", data.width()),
        ("data", data.height()),
        ("display", display.size.width()),
        ("display", display.size.height()),
    ];
    for (window, edge) in edges {
        if !(1..=MOST_PIXELS).contains(&edge) {
            return Err(format!("a {window} window of {edge} pixels, expected 1 to {MOST_PIXELS}"));
        }
    }
    let found = (data.area() as u64).saturating_mul(header.channels.bytes_per_pixel as u64);
    let most = bytes.saturating_mul(MOST_FROM_A_BYTE);
    if found > most {
        return Err(format!("{found} bytes of pixels, expected at most {most} in a file of {bytes} bytes"));
    }
    if let Some(channel) = header.channels.list.iter().find(|c| c.sampling != exr::math::Vec2(1, 1)) {
        return Err(format!("channel `{}` has not a sample in every pixel", channel.name));
    }
    let place = |position: i32, origin: i32, length: usize, whole: usize| {
        let from = i64::from(position) - i64::from(origin);
        let inside = from >= 0 && from as u64 + length as u64 <= whole as u64;
        inside.then_some(from as u32).ok_or_else(|| {
            format!("pixels {from} to {} of {whole}: outside the display window", from + length as i64)
        })
    };
    let window = Window {
        x: place(position.x(), display.position.x(), data.width(), display.size.width())?,
        y: place(position.y(), display.position.y(), data.height(), display.size.height())?,
        width: data.width() as u32,
        height: data.height() as u32,
    };
    Ok((window, [display.size.width() as u32, display.size.height() as u32]))
}

impl Opened {
    pub fn attributes(&self) -> Attributes<'_> {
        Attributes(self.header())
    }

    fn header(&self) -> &Header {
        // `check` let only files with one part pass.
        &self.reader.headers()[0]
    }

    /// Names and types of the channels, in their order.
    pub fn channels(&self) -> Vec<(String, SampleType)> {
        let list = &self.header().channels.list;
        list.iter().map(|channel| (words(&channel.name), channel.sample_type)).collect()
    }

    /// Calls `line` for every row of every channel with the channel's index, the row and its samples' bytes. Each
    /// comes once, or the file is refused.
    pub fn lines(self, mut line: impl FnMut(usize, usize, &[u8])) -> Result<(), Unreadable> {
        let (width, height) = (self.window.width as usize, self.window.height as usize);
        let channels = self.header().channels.clone();
        let mut seen = vec![false; height];
        // In this thread alone: a panic in one of the decoder's could not be caught.
        let mut blocks = self.reader.all_chunks(true)?.sequential_decompressor(true);
        while let Some(block) = blocks.decompress_next_block() {
            let block: UncompressedBlock = block?;
            for found in block.lines(&channels) {
                let (row, channel) = (found.location.position.y(), found.location.channel);
                let begins = channel == 0 && seen.get(row) == Some(&false);
                let goes_on = channel > 0 && seen.get(row) == Some(&true);
                if !(begins || goes_on) || found.location.sample_count != width {
                    return Err(format!("row {row} is there twice or is no row").into());
                }
                seen[row] = true;
                line(channel, row, found.value);
            }
        }
        match seen.iter().position(|seen| !seen) {
            Some(row) => Err(format!("row {row} of {height} is missing").into()),
            None => Ok(()),
        }
    }
}

/// The samples of a row, as floats.
pub(crate) fn floats(bytes: &[u8], kind: SampleType) -> impl Iterator<Item = f32> {
    let size = kind.bytes_per_sample();
    bytes.chunks_exact(size).map(move |sample| match (kind, sample) {
        (SampleType::F16, &[a, b]) => f16::from_ne_bytes([a, b]).to_f32(),
        (SampleType::F32, &[a, b, c, d]) => f32::from_ne_bytes([a, b, c, d]),
        (SampleType::U32, &[a, b, c, d]) => u32::from_ne_bytes([a, b, c, d]) as f32,
        _ => 0.0,
    })
}

/// The samples of a row of whole numbers.
pub(crate) fn wholes(bytes: &[u8]) -> impl Iterator<Item = u32> {
    bytes.as_chunks::<4>().0.iter().map(|&sample| u32::from_ne_bytes(sample))
}

fn words(text: &Text) -> String {
    String::from_utf8_lossy(text.bytes()).into_owned()
}

/// The attributes of a header, by name.
pub(crate) struct Attributes<'a>(&'a Header);

impl Attributes<'_> {
    pub fn software(&self) -> String {
        self.0.own_attributes.software_name.as_ref().map(words).unwrap_or_default()
    }

    /// Frames a second.
    pub fn frame_rate(&self) -> Option<f64> {
        self.0.own_attributes.frames_per_second.map(|(over, under)| f64::from(over) / f64::from(under))
    }

    /// Seconds that the shutter was open.
    pub fn exposure_seconds(&self) -> Option<f64> {
        self.0.own_attributes.exposure.map(f64::from)
    }

    /// World to camera, and to normalised device coordinates.
    pub fn matrices(&self) -> Option<[Mat4; 2]> {
        let own = &self.0.own_attributes;
        let of = |rows: &Option<[f32; 16]>| rows.as_ref().map(Mat4::from_cols_array);
        Some([of(&own.world_to_camera)?, of(&own.world_to_normalized_device)?])
    }

    fn get(&self, name: &str) -> Option<&AttributeValue> {
        self.0.own_attributes.other.get(&Text::new_or_none(name)?)
    }

    pub fn text(&self, name: &str) -> Option<String> {
        match self.get(name)? {
            AttributeValue::Text(value) => Some(words(value)),
            _ => None,
        }
    }

    /// All texts.
    pub fn texts(&self) -> impl Iterator<Item = (String, String)> {
        self.0.own_attributes.other.iter().filter_map(|(name, value)| match value {
            AttributeValue::Text(value) => Some((words(name), words(value))),
            _ => None,
        })
    }

    pub fn number(&self, name: &str) -> Option<f64> {
        match self.get(name)? {
            AttributeValue::F64(value) => Some(*value),
            AttributeValue::F32(value) => Some(f64::from(*value)),
            AttributeValue::I32(value) => Some(f64::from(*value)),
            _ => None,
        }
    }

    /// A number that has to be there, in a range.
    pub fn needed(&self, name: &str, range: std::ops::RangeInclusive<f64>) -> Result<f64, String> {
        let expected = || format!("expected a number in {}..={}", range.start(), range.end());
        match self.number(name) {
            Some(value) if range.contains(&value) => Ok(value),
            Some(value) => Err(format!("attribute `{name}` is {value}, {}", expected())),
            None => Err(format!("there is no attribute `{name}`, {}", expected())),
        }
    }
}
