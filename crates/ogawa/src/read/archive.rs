//! The file being read.

use super::cursor::Cursor;
use super::group::{Data, Group};
use super::object::ObjectReader;
use crate::{HEADER, MetadataText, OgawaError, TimeSampling};

/// The newest version of the layout there is.
const VERSION: i32 = 0;
/// The oldest Alembic that wrote this layout.
const OLDEST_LIBRARY: i32 = 9999;

/// An archive in memory. Nothing but its times is copied; what a place in the file says is checked when it is looked at.
#[derive(Clone, Debug)]
pub struct Archive<'a> {
    top: Group<'a>,
    library: i32,
    metadata: MetadataText<'a>,
    times: Vec<TimeSampling>,
    pub(super) table: Vec<MetadataText<'a>>,
}

impl<'a> Archive<'a> {
    /// Opens an archive.
    ///
    /// # Errors
    /// [`OgawaError::Invalid`] when the header, the root or one of the tables are not those of a finished
    /// archive.
    pub fn new(file: &'a [u8]) -> Result<Self, OgawaError> {
        let root = Group::at(file, header(file)?)?;
        if root.len() < 6 {
            let found = format!("{} children", root.len());
            return Err(OgawaError::invalid(root.offset, "root", found, "6, as Alembic writes"));
        }
        let version = number(root.data(0, "version")?, "version")?;
        if !(0..=VERSION).contains(&version) {
            let offset = root.offset;
            return Err(OgawaError::invalid(offset, "version", version.to_string(), VERSION.to_string()));
        }
        let library = number(root.data(1, "library version")?, "library version")?;
        if library < OLDEST_LIBRARY {
            let expected = format!("{OLDEST_LIBRARY} or newer");
            return Err(OgawaError::invalid(root.offset, "library version", library.to_string(), expected));
        }
        let mut words = root.data(3, "metadata")?.cursor();
        let len = root.data(3, "metadata")?.bytes.len() as u64;
        let metadata = MetadataText(words.text(len, "metadata")?);
        let times = read_times(root.data(4, "time samplings")?.cursor())?;
        let table = read_table(root.data(5, "metadata table")?.cursor())?;
        let top = root.group(2, "top object")?;
        Ok(Archive { top, library, metadata, times, table })
    }

    /// The object above all others.
    #[must_use]
    pub fn top(&self) -> ObjectReader<'_> {
        ObjectReader::top(self, self.top)
    }

    /// Words about the archive: `_ai_Application` and the like.
    #[must_use]
    pub fn metadata(&self) -> MetadataText<'a> {
        self.metadata
    }

    /// The Alembic that wrote it: 10808 is 1.8.8.
    #[must_use]
    pub fn library_version(&self) -> i32 {
        self.library
    }

    /// Times at which samples are taken: number `index` of the archive, `None` past the last.
    #[must_use]
    pub fn times(&self, index: u32) -> Option<&TimeSampling> {
        self.times.get(usize::try_from(index).ok()?)
    }
}

/// The place of the root group.
fn header(file: &[u8]) -> Result<u64, OgawaError> {
    if file.starts_with(b"\x89HDF") {
        let expected = "Ogawa (abcconvert -toOgawa makes it from this)";
        return Err(OgawaError::invalid(0, "magic", "an Alembic archive of the older HDF5 kind", expected));
    }
    let mut cursor = Cursor::new(file, 0);
    let magic = cursor.take(5, "magic")?;
    if magic != b"Ogawa" {
        return Err(OgawaError::invalid(0, "magic", format!("{magic:?}"), "\"Ogawa\""));
    }
    let whole = cursor.u8("mark of a whole file")?;
    if whole != 0xff {
        let expected = "255; the program that wrote it did not finish";
        return Err(OgawaError::invalid(5, "mark of a whole file", whole.to_string(), expected));
    }
    let version = cursor.take(2, "Ogawa version")?;
    if version != [0, 1] {
        return Err(OgawaError::invalid(6, "Ogawa version", format!("{version:?}"), "[0, 1]"));
    }
    let root = cursor.take(8, "place of the root")?;
    let mut place = [0; 8];
    place.copy_from_slice(root);
    match u64::from_le_bytes(place) {
        0 => Err(OgawaError::invalid(8, "place of the root", "0", format!("{HEADER} or more"))),
        place => Ok(place),
    }
}

fn number(data: Data<'_>, what: &'static str) -> Result<i32, OgawaError> {
    if data.bytes.len() != 4 {
        let found = format!("{} bytes", data.bytes.len());
        return Err(OgawaError::invalid(data.offset, what, found, "4"));
    }
    Ok(data.cursor().u32(what)? as i32)
}

/// Read once, as every property asks for them.
fn read_times(cursor: Cursor<'_>) -> Result<Vec<TimeSampling>, OgawaError> {
    let (mut counted, mut samplings) = (cursor, 0);
    while !counted.is_empty() {
        one_sampling(&mut counted)?;
        samplings += 1;
    }
    let mut cursor = cursor;
    let sampling = |_| {
        let (cycle, times) = one_sampling(&mut cursor)?;
        let times = times.iter().map(|&time| f64::from_le_bytes(time)).collect();
        Ok(TimeSampling::from_file(cycle, times))
    };
    (0..samplings).map(sampling).collect()
}

/// Seconds of a cycle, and the times in it.
fn one_sampling<'a>(cursor: &mut Cursor<'a>) -> Result<(f64, &'a [[u8; 8]]), OgawaError> {
    let what = "time samplings";
    let _samples_taken = cursor.u32(what)?;
    let cycle = cursor.f64(what)?;
    let count = cursor.u32(what)?;
    Ok((cycle, cursor.take(u64::from(count) * 8, what)?.as_chunks::<8>().0))
}

fn read_table(mut cursor: Cursor<'_>) -> Result<Vec<MetadataText<'_>>, OgawaError> {
    let what = "metadata table";
    let mut table = vec![MetadataText::default()];
    // Bounded by what an index can name, so that a file of empty texts makes no long table.
    while !cursor.is_empty() && table.len() < 255 {
        let len = cursor.u8(what)?;
        table.push(MetadataText(cursor.text(len.into(), what)?));
    }
    Ok(table)
}
