//! The header of a TressFX file: counts, and where the arrays are.

use crate::FormatError;
use crate::bytes::Bytes;

/// One array: where the header says so, and where it is; `None` when it is not there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Byte of the offset in the header.
    pub(crate) field: usize,
    pub(crate) offset: u32,
}

impl Place {
    pub(crate) fn is_there(self) -> bool {
        self.offset != 0
    }
}

/// Either version's header; an array that a version does not know is not there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Header {
    /// Floats of a position: 3 or 4.
    pub(crate) width: usize,
    pub(crate) strands: u32,
    pub(crate) vertices_per_strand: u32,
    pub(crate) follow_strands: u32,
    pub(crate) both_ends_immovable: bool,
    pub(crate) positions: Place,
    pub(crate) strand_uvs: Place,
    pub(crate) vertex_uvs: Place,
    pub(crate) thickness: Place,
    pub(crate) colors: Place,
    pub(crate) guides: Place,
    /// Bytes of the header, before which no array starts.
    pub(crate) bytes: usize,
}

/// Words at the end of the header and, in version 3, in its middle, that mean nothing.
const RESERVED_3: u64 = 31;
const RESERVED: u64 = 32;

impl Header {
    pub(crate) fn read(bytes: &mut Bytes<'_>) -> Result<Header, FormatError> {
        let version = bytes.f32("the version")?;
        match version {
            3.0..4.0 => Self::version_3(bytes),
            4.0..5.0 => Self::version_4(bytes),
            _ => Err(wrong_version(bytes, version)),
        }
    }

    fn version_3(bytes: &mut Bytes<'_>) -> Result<Header, FormatError> {
        let (strands, vertices_per_strand) = counts(bytes)?;
        let follow_strands = bytes.u32("the number of strands that follow a guide")?;
        let both_ends_immovable = bytes.u32("whether both ends are immovable")? != 0;
        bytes.take(4 * RESERVED_3, "reserved words of the header")?;
        let positions = place(bytes)?;
        let thickness = place(bytes)?;
        let strand_uvs = place(bytes)?;
        let colors = place(bytes)?;
        let guides = place(bytes)?;
        let vertex_uvs = place(bytes)?;
        bytes.take(4 * RESERVED, "reserved words of the header")?;
        Ok(Header {
            width: 3,
            strands,
            vertices_per_strand,
            follow_strands,
            both_ends_immovable,
            positions,
            strand_uvs,
            vertex_uvs,
            thickness,
            colors,
            guides,
            bytes: bytes.at(),
        })
    }

    fn version_4(bytes: &mut Bytes<'_>) -> Result<Header, FormatError> {
        let (strands, vertices_per_strand) = counts(bytes)?;
        let positions = place(bytes)?;
        let strand_uvs = place(bytes)?;
        let vertex_uvs = place(bytes)?;
        let thickness = place(bytes)?;
        let colors = place(bytes)?;
        bytes.take(4 * RESERVED, "reserved words of the header")?;
        Ok(Header {
            width: 4,
            strands,
            vertices_per_strand,
            follow_strands: 0,
            both_ends_immovable: false,
            positions,
            strand_uvs,
            vertex_uvs,
            thickness,
            colors,
            guides: Place { field: 0, offset: 0 },
            bytes: bytes.at(),
        })
    }
}

fn counts(bytes: &mut Bytes<'_>) -> Result<(u32, u32), FormatError> {
    let strands = bytes.u32("the number of strands")?;
    let at = bytes.at();
    let vertices = bytes.u32("the number of vertices of a strand")?;
    if vertices == 0 {
        return Err(bytes.fault(
            at,
            "strands of 0 vertices",
            "1 or more (TressFX itself wants 4, 8, 16, 32 or 64)",
        ));
    }
    Ok((strands, vertices))
}

fn place(bytes: &mut Bytes<'_>) -> Result<Place, FormatError> {
    Ok(Place { field: bytes.at(), offset: bytes.u32("an array's offset")? })
}

fn wrong_version(bytes: &Bytes<'_>, version: f32) -> FormatError {
    let turned = f32::from_bits(version.to_bits().swap_bytes());
    let found = if (3.0..5.0).contains(&turned) {
        format!("version {turned}, big endian")
    } else if version.to_le_bytes().iter().all(u8::is_ascii_graphic) {
        "text, as TressFX 2 and older wrote".to_owned()
    } else {
        format!("version {version}")
    };
    bytes.fault(0, found, "version 3 or 4, a little-endian float")
}
