//! A layer in a package (`.usdz`): a zip file whose files are stored as they are, each from a multiple of 64 bytes
//! on, the layer first (the USDZ specification; APPNOTE.TXT of PKWARE for zip itself).

use std::io::{Seek, SeekFrom, Write};

use crate::write::{CrateWriter, WriteError};

const ALIGNMENT: u64 = 64;
const LOCAL: [u8; 4] = *b"PK\x03\x04";
const CENTRAL: [u8; 4] = *b"PK\x01\x02";
const END: [u8; 4] = *b"PK\x05\x06";
const LOCAL_BYTES: u64 = 30;
/// Version 1.0 of zip, no flags, stored; midnight of 1 January 1980, zip's first moment.
const COMMON: [u8; 10] = [10, 0, 0, 0, 0, 0, 0, 0, 0x21, 0];
/// The field OpenUSD pads with, and its own head of four bytes.
const PADDING: [u8; 2] = [0x86, 0x19];
const PADDING_HEAD: u64 = 4;

/// Writes a package that holds one layer.
///
/// ```
/// use std::io::Cursor;
/// use usd_layer::write::{PackageWriter, Value};
///
/// let mut package = PackageWriter::new(Cursor::new(Vec::new()), "lock.usdc")?;
/// package.layer().metadata("defaultPrim", Value::Token("Lock"))?;
/// package.layer().prim("/Lock", "Xform")?;
/// let bytes = package.finish()?.into_inner();
/// assert_eq!(&bytes[64..72], b"PXR-USDC");
/// # Ok::<(), usd_layer::write::WriteError>(())
/// ```
#[derive(Debug)]
pub struct PackageWriter<W> {
    layer: CrateWriter<W>,
    start: u64,
    name: String,
}

impl<W: Write + Seek> PackageWriter<W> {
    /// A package that starts where `stream` stands, with a layer called `name`, which ends in `.usdc`.
    ///
    /// # Errors
    /// When the stream refuses.
    pub fn new(mut stream: W, name: &str) -> Result<Self, WriteError> {
        let start = stream.stream_position()?;
        let head = local_head(name, &[0; 12])?;
        stream.write_all(&head)?;
        Ok(PackageWriter { layer: CrateWriter::with_checksum(stream)?, start, name: name.to_owned() })
    }

    /// The layer.
    pub fn layer(&mut self) -> &mut CrateWriter<W> {
        &mut self.layer
    }

    /// Finishes the layer and the package and gives the stream back, standing behind it.
    ///
    /// # Errors
    /// As [`CrateWriter::finish`]; [`WriteError::TooLarge`] for a layer of 4 GiB or more.
    pub fn finish(self) -> Result<W, WriteError> {
        let (mut stream, length, checksum) = self.layer.finish_counted()?;
        let limit = u64::from(u32::MAX);
        let size =
            u32::try_from(length).ok().filter(|&size| size < u32::MAX).ok_or(WriteError::TooLarge {
                what: "bytes in a package's layer",
                found: length,
                limit: limit - 1,
            })?;
        let mut facts = [0; 12];
        facts[..4].copy_from_slice(&checksum.unwrap_or_default().to_le_bytes());
        facts[4..8].copy_from_slice(&size.to_le_bytes());
        facts[8..].copy_from_slice(&size.to_le_bytes());
        let local = local_head(&self.name, &facts)?;
        stream.seek(SeekFrom::Start(self.start))?;
        stream.write_all(&local)?;
        let directory = local.len() as u64 + length;
        stream.seek(SeekFrom::Start(self.start + directory))?;
        stream.write_all(&directory_bytes(&self.name, &facts, directory)?)?;
        Ok(stream)
    }
}

/// The head before a file at the start of the package, as long as the file's alignment wants it.
fn local_head(name: &str, facts: &[u8; 12]) -> Result<Vec<u8>, WriteError> {
    let unpadded = LOCAL_BYTES + name.len() as u64 + PADDING_HEAD;
    let zeros = unpadded.next_multiple_of(ALIGNMENT) - unpadded;
    let mut head = LOCAL.to_vec();
    head.extend(COMMON);
    head.extend(facts);
    head.extend(name_length(name)?);
    head.extend(((PADDING_HEAD + zeros) as u16).to_le_bytes());
    head.extend(name.bytes());
    head.extend(PADDING);
    head.extend((zeros as u16).to_le_bytes());
    head.resize(head.len() + zeros as usize, 0);
    Ok(head)
}

/// The directory of a package of one file, and the end of the package.
fn directory_bytes(name: &str, facts: &[u8; 12], place: u64) -> Result<Vec<u8>, WriteError> {
    let mut out = CENTRAL.to_vec();
    out.extend([10, 0]);
    out.extend(COMMON);
    out.extend(facts);
    out.extend(name_length(name)?);
    // Extra field, comment, disk, attributes and place of the file: all 0.
    out.extend([0; 16]);
    out.extend(name.bytes());
    let length = out.len() as u32;
    let too_large =
        |_| WriteError::TooLarge { what: "bytes in a package", found: place, limit: u64::from(u32::MAX) };
    let place = u32::try_from(place).map_err(too_large)?;
    out.extend(END);
    out.extend([0, 0, 0, 0, 1, 0, 1, 0]);
    out.extend(length.to_le_bytes());
    out.extend(place.to_le_bytes());
    out.extend([0, 0]);
    Ok(out)
}

fn name_length(name: &str) -> Result<[u8; 2], WriteError> {
    let too_long = |_| WriteError::TooLarge {
        what: "bytes in a file's name",
        found: name.len() as u64,
        limit: u64::from(u16::MAX),
    };
    Ok(u16::try_from(name.len()).map_err(too_long)?.to_le_bytes())
}
