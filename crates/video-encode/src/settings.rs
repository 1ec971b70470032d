//! What a film is.

use crate::VideoError;

/// The longest edge that both codecs can hold.
const MAX_EDGE: u32 = 16384;

/// How pictures are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Codec {
    /// H.264 in an `.mp4`: 8 bits, 4:2:0, no alpha; plays everywhere. Takes [`crate::Picture::Rgba8`], of which alpha
    /// is ignored. `crf` says how good it looks, 0 (exact) to 51.
    H264 {
        /// Constant rate factor.
        crf: u32,
    },
    /// ProRes 4444 in a `.mov`: 10 bits and 16 bits of straight alpha, for editing. Takes
    /// [`crate::Picture::Rgba16`].
    ProRes4444,
}

/// What a film is, before its first picture.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmSettings {
    /// Pixels across, 1 to 16384. H.264 has even sizes only: the last column is then doubled.
    pub width: u32,
    /// Pixels down, 1 to 16384; as for the width.
    pub height: u32,
    /// Pictures a second.
    pub rate: FrameRate,
    /// How it is packed.
    pub codec: Codec,
    /// Words that are kept in the file beside the pictures, such as the command that made it.
    pub comment: Option<String>,
}

impl FilmSettings {
    pub(crate) fn check(&self) -> Result<(), VideoError> {
        for (name, found) in [("width", self.width), ("height", self.height)] {
            if !(1..=MAX_EDGE).contains(&found) {
                return Err(VideoError::Setting { name, found: found.to_string(), expected: "1 to 16384" });
            }
        }
        match self.codec {
            Codec::H264 { crf } if crf > 51 => {
                Err(VideoError::Setting { name: "crf", found: crf.to_string(), expected: "0 to 51" })
            }
            _ => Ok(()),
        }
    }
}

/// Pictures a second, as a fraction: 24, 30000/1001 (NTSC's 29.97).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameRate {
    over: u32,
    under: u32,
}

impl FrameRate {
    /// The fraction over 1, 1001 or 1000 that is nearest to `rate` pictures a second; 23.976, 29.97 and 59.94 mean
    /// NTSC's.
    ///
    /// # Errors
    /// [`VideoError::Setting`] when `rate` is not in 0.001..=1000.
    pub fn new(rate: f64) -> Result<FrameRate, VideoError> {
        if !(0.001..=1000.0).contains(&rate) {
            let (found, expected) = (rate.to_string(), "0.001 to 1000 pictures a second");
            return Err(VideoError::Setting { name: "fps", found, expected });
        }
        // As written in practice: two or three digits.
        let is_near = |under: u32, off: f64| {
            let scaled = rate * f64::from(under) / if under == 1001 { 1000.0 } else { 1.0 };
            (scaled - scaled.round()).abs() < off
        };
        let (over, under) = if is_near(1, 1e-9) {
            (rate, 1)
        } else if is_near(1001, 5e-3) && rate > 1.0 {
            ((rate * 1.001).round() * 1000.0, 1001)
        } else {
            (rate * 1000.0, 1000)
        };
        Ok(FrameRate { over: over.round() as u32, under })
    }
}

impl std::fmt::Display for FrameRate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.under == 1 { write!(f, "{}", self.over) } else { write!(f, "{}/{}", self.over, self.under) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_the_fractions_people_mean() {
        let cases = [
            (24.0, "24"),
            (23.976, "24000/1001"),
            (29.97, "30000/1001"),
            (30000.0 / 1001.0, "30000/1001"),
            (59.94, "60000/1001"),
            (12.5, "12500/1000"),
            (0.5, "500/1000"),
            (1.0, "1"),
            (1000.0, "1000"),
        ];
        for (rate, words) in cases {
            assert_eq!(FrameRate::new(rate).unwrap().to_string(), words);
        }
        for rate in [0.0, -1.0, f64::NAN, f64::INFINITY, 1000.5] {
            assert!(FrameRate::new(rate).is_err(), "{rate}");
        }
    }

    #[test]
    fn sizes_and_factors_have_their_ranges() {
        let rate = FrameRate::new(24.0).unwrap();
        let good =
            FilmSettings { width: 1, height: 16384, rate, codec: Codec::H264 { crf: 51 }, comment: None };
        assert!(good.check().is_ok());
        let bad = [
            FilmSettings { width: 0, ..good.clone() },
            FilmSettings { height: 16385, ..good.clone() },
            FilmSettings { codec: Codec::H264 { crf: 52 }, ..good },
        ];
        for (settings, name) in bad.iter().zip(["width is 0", "height is 16385", "crf is 52"]) {
            assert!(settings.check().unwrap_err().to_string().starts_with(name));
        }
    }
}
