//! The 128 bytes every HAIR file starts with.

use crate::{Field, HairError, Layout, look_alike};

/// Bytes of the header.
pub const HEADER_BYTES: usize = 128;

/// The first four bytes.
pub const MAGIC: [u8; 4] = *b"HAIR";

/// The bits of [`Header::arrays`] the format defines.
pub const KNOWN_ARRAYS: u32 = 0b11111;

/// The header, field by field as the file has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Header {
    /// How many strands there are.
    pub hair_count: u32,
    /// How many points all strands have together.
    pub point_count: u32,
    /// Which arrays follow, see [`Field::bit`]; bits above [`KNOWN_ARRAYS`] mean nothing.
    pub arrays: u32,
    /// Segments of every strand when there is no segments array.
    pub default_segments: u32,
    /// Thickness (a diameter, in the file's units) when there is no thickness array.
    pub default_thickness: f32,
    /// Transparency, 0 opaque .. 1 clear, when there is no transparency array.
    pub default_transparency: f32,
    /// Colour, 0..1, when there is no colours array.
    pub default_color: [f32; 3],
    /// Free text, padded with zero bytes; kept as it is.
    pub info: [u8; 88],
}

impl Default for Header {
    /// No strands, no arrays, and the defaults of Yuksel's own reader: thickness 1, opaque, white.
    fn default() -> Self {
        Header {
            hair_count: 0,
            point_count: 0,
            arrays: 0,
            default_segments: 0,
            default_thickness: 1.0,
            default_transparency: 0.0,
            default_color: [1.0; 3],
            info: [0; 88],
        }
    }
}

impl Header {
    /// Reads the fields, judging nothing but the magic.
    ///
    /// `file_bytes`, the length of the whole file where known, helps to name a look-alike.
    ///
    /// # Errors
    /// [`HairError::Magic`].
    pub fn from_bytes(bytes: &[u8; HEADER_BYTES], file_bytes: Option<u64>) -> Result<Self, HairError> {
        check_magic(bytes, file_bytes)?;
        Ok(Header {
            hair_count: u32_at(bytes, 4),
            point_count: u32_at(bytes, 8),
            arrays: u32_at(bytes, 12),
            default_segments: u32_at(bytes, 16),
            default_thickness: f32_at(bytes, 20),
            default_transparency: f32_at(bytes, 24),
            default_color: [f32_at(bytes, 28), f32_at(bytes, 32), f32_at(bytes, 36)],
            info: std::array::from_fn(|i| bytes[40 + i]),
        })
    }

    /// The header as the file has it.
    #[must_use]
    pub fn to_bytes(&self) -> [u8; HEADER_BYTES] {
        let mut bytes = [0; HEADER_BYTES];
        let mut put =
            |offset: usize, value: &[u8]| bytes[offset..offset + value.len()].copy_from_slice(value);
        put(0, &MAGIC);
        put(4, &self.hair_count.to_le_bytes());
        put(8, &self.point_count.to_le_bytes());
        put(12, &self.arrays.to_le_bytes());
        put(16, &self.default_segments.to_le_bytes());
        put(20, &self.default_thickness.to_le_bytes());
        put(24, &self.default_transparency.to_le_bytes());
        for (i, channel) in self.default_color.iter().enumerate() {
            put(28 + 4 * i, &channel.to_le_bytes());
        }
        put(40, &self.info);
        bytes
    }

    /// Whether the header announces `array`.
    #[must_use]
    pub fn has(&self, array: Field) -> bool {
        self.arrays & array.bit() != 0
    }

    /// Where the announced arrays lie in the file.
    #[must_use]
    pub fn layout(&self) -> Layout {
        Layout::of(self)
    }

    /// The info text up to its first zero byte, with what is not UTF-8 replaced.
    #[must_use]
    pub fn info_text(&self) -> String {
        let end = self.info.iter().position(|&byte| byte == 0).unwrap_or(self.info.len());
        String::from_utf8_lossy(&self.info[..end]).into_owned()
    }

    /// Sets the info text, cut to 88 bytes at a character boundary and padded with zero bytes.
    pub fn set_info_text(&mut self, text: &str) {
        let mut end = text.len().min(self.info.len());
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        self.info = [0; 88];
        self.info[..end].copy_from_slice(&text.as_bytes()[..end]);
    }
}

/// Refuses what does not start with `HAIR`; `bytes` may be shorter than a header.
pub(crate) fn check_magic(bytes: &[u8], file_bytes: Option<u64>) -> Result<(), HairError> {
    if bytes.len() < 4 || bytes[..4] == MAGIC {
        return Ok(());
    }
    let found = std::array::from_fn(|i| bytes[i]);
    Err(HairError::Magic { found, looks_like: look_alike::recognise(bytes, file_bytes) })
}

fn u32_at(bytes: &[u8; HEADER_BYTES], offset: usize) -> u32 {
    u32::from_le_bytes(std::array::from_fn(|i| bytes[offset + i]))
}

fn f32_at(bytes: &[u8; HEADER_BYTES], offset: usize) -> f32 {
    f32::from_bits(u32_at(bytes, offset))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn info_text_is_cut_between_characters() {
        let mut header = Header::default();
        header.set_info_text(&"ä".repeat(50));
        assert_eq!(header.info_text(), "ä".repeat(44));
        header.set_info_text(&format!("x{}", "ä".repeat(50)));
        assert_eq!(header.info_text().len(), 87);
        assert_eq!(header.info[87], 0);
    }
}
