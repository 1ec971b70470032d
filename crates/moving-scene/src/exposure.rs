//! How long the shutter is open, and what is blurred meanwhile.

use hair_render::{Blur, Shutter};

/// Frames a second where nobody says.
pub const USUAL_RATE: f64 = 24.0;

/// How pictures are exposed.
#[derive(Clone, Debug, Default)]
pub struct Exposure {
    /// When the shutter opens and closes.
    pub shutter: Shutter,
    /// What strands are blurred by; the best that is known of them when absent.
    pub blur: Option<Blur>,
    /// At how many times through the shutter the shape of what moves is held, 2..=1025; as [`Blur::usual_keys`] when
    /// absent.
    pub samples: Option<usize>,
    /// Frames a second; the groom's, or the mesh's, or [`USUAL_RATE`] when absent. Frames of stages and Alembic files
    /// stay at their own.
    pub frame_rate: Option<f64>,
}

impl Exposure {
    /// Whether anything is to be blurred.
    #[must_use]
    pub fn blurs(&self) -> bool {
        self.blur != Some(Blur::Off)
    }

    /// At how many times things are looked at that are blurred by `blur`.
    #[must_use]
    pub fn keys(&self, blur: Blur) -> usize {
        self.samples.unwrap_or(blur.usual_keys())
    }

    /// The rate that holds for a picture of things with these rates of their own.
    #[must_use]
    pub fn rate(&self, groom: Option<f64>, mesh: Option<f64>) -> f64 {
        self.frame_rate.or(groom).or(mesh).unwrap_or(USUAL_RATE)
    }
}
