//! The page as it is filled.

use std::path::Path;

use error_report::Report;

use crate::data::{Data, Frame, Shown};
use crate::{Axis, PageError, Plate, Tone, Variant, html, pack};

/// One frame of a variant, at the size it has on the page.
#[derive(Clone, Debug)]
pub struct Shot<'a> {
    /// Its number in the turntable.
    pub number: u32,
    /// What is said under it: names and values.
    pub facts: Vec<(String, String)>,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// What is shown before anybody touches anything: red, green, blue in sRGB.
    pub shown: &'a [u8],
    /// Coverage, 0..1, of every pixel.
    pub alpha: &'a [f32],
    /// The light of each pass in the page's order, linear Rec. 709, premultiplied, unweighed; `None` where they are
    /// not to be kept.
    pub layers: Option<&'a [&'a [[f32; 3]]]>,
}

/// Where the bytes of a page are, as they stand in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bytes {
    /// Ready-made pictures.
    pub pictures: u64,
    /// Passes and coverage.
    pub layers: u64,
    /// Frames in all.
    pub frames: usize,
    /// Frames whose passes are kept.
    pub with_layers: usize,
}

/// A page being filled.
#[derive(Debug)]
pub struct Page {
    pub(crate) title: String,
    pub(crate) passes: Vec<String>,
    pub(crate) variants: Vec<Filled>,
    pub(crate) axes: Vec<Axis>,
    pub(crate) report: Option<Report>,
    pub(crate) left_out: Vec<(String, String)>,
    pub(crate) about: Vec<(String, String)>,
    pub(crate) bytes: Bytes,
    /// Each once.
    tones: Vec<Tone>,
    fps: f64,
}

/// A variant as far as it is filled.
#[derive(Debug)]
pub(crate) struct Filled {
    pub variant: Variant,
    pub frames: Vec<Frame>,
    /// Its place among the tones.
    tone: usize,
}

impl Page {
    /// A page without pictures, whose frames have these passes.
    #[must_use]
    pub fn new(title: impl Into<String>, passes: &[&str]) -> Page {
        Page {
            title: title.into(),
            passes: passes.iter().map(|&pass| pass.to_owned()).collect(),
            variants: Vec::new(),
            axes: Vec::new(),
            report: None,
            left_out: Vec::new(),
            about: Vec::new(),
            bytes: Bytes::default(),
            tones: Vec::new(),
            fps: 12.0,
        }
    }

    /// The page, with menus for what differs from variant to variant.
    #[must_use]
    pub fn with_axes(mut self, axes: Vec<Axis>) -> Page {
        self.axes = axes;
        self
    }

    /// The page, played at so many pictures a second, brought into 1..=60.
    #[must_use]
    pub fn with_rate(mut self, fps: f64) -> Page {
        self.fps = if fps.is_finite() { fps.clamp(1.0, 60.0) } else { 12.0 };
        self
    }

    /// The page, with plots of error against seconds.
    #[must_use]
    pub fn with_report(mut self, report: Report) -> Page {
        self.report = Some(report);
        self
    }

    /// The page, with what was left out and why.
    #[must_use]
    pub fn with_left_out(mut self, left_out: Vec<(String, String)>) -> Page {
        self.left_out = left_out;
        self
    }

    /// The page, with lines about its origin: command, version.
    #[must_use]
    pub fn with_about(mut self, about: Vec<(String, String)>) -> Page {
        self.about = about;
        self
    }

    /// Adds a variant whose light is shown by `tone`, and returns its place.
    pub fn variant(&mut self, variant: Variant, tone: Tone) -> usize {
        let known = self.tones.iter().position(|known| *known == tone);
        let tone = known.unwrap_or_else(|| {
            self.tones.push(tone);
            self.tones.len() - 1
        });
        self.variants.push(Filled { variant, frames: Vec::new(), tone });
        self.variants.len() - 1
    }

    /// Adds a frame to a variant.
    ///
    /// # Errors
    /// [`PageError::Variant`], [`PageError::Size`] or [`PageError::Encode`].
    pub fn shot(&mut self, variant: usize, shot: &Shot) -> Result<(), PageError> {
        let count = self.variants.len();
        let Some(Filled { frames, .. }) = self.variants.get_mut(variant) else {
            return Err(PageError::Variant { found: variant, count });
        };
        let &Shot { number, width, height, shown, alpha, layers, .. } = shot;
        let pixels = u64::from(width) * u64::from(height);
        let check = |what, found: usize, expected: u64| {
            let fault = PageError::Size { frame: number, what, found, expected, width, height };
            if found as u64 == expected && pixels > 0 { Ok(()) } else { Err(fault) }
        };
        check("the picture", shown.len(), pixels.saturating_mul(3))?;
        check("coverage", alpha.len(), pixels)?;
        for layer in layers.into_iter().flatten() {
            check("a pass", layer.len(), pixels)?;
        }
        let layers = match layers {
            // Without passes there is nothing to weigh.
            Some(layers) if layers.len() == self.passes.len() && !layers.is_empty() => {
                let packed: Result<Vec<_>, _> =
                    layers.iter().map(|pixels| pack::layer(width, pixels)).collect();
                Some(packed?)
            }
            _ => None,
        };
        let alpha = if layers.is_some() { pack::alpha(width, alpha)? } else { None };
        let jpeg = pack::jpeg(width, height, shown)?;
        self.bytes.frames += 1;
        self.bytes.pictures += jpeg.len() as u64;
        self.bytes.with_layers += usize::from(layers.is_some());
        let packed = layers.iter().flatten().flatten().chain(&alpha);
        self.bytes.layers += packed.map(|packed| packed.len() as u64).sum::<u64>();
        frames.push(Frame { number, facts: shot.facts.clone(), width, height, jpeg, alpha, layers });
        Ok(())
    }

    /// Where the bytes are so far.
    #[must_use]
    pub fn bytes(&self) -> Bytes {
        self.bytes
    }

    /// The page as text; the same for the same contents.
    ///
    /// # Errors
    /// [`PageError::Report`] or [`PageError::Json`].
    pub fn to_html(&self) -> Result<String, PageError> {
        if let Some(report) = &self.report {
            report.check()?;
        }
        // A pass that is black in every frame is no pass to flip to.
        let is_lit = |pass: &usize| self.frames().any(|frame| frame.layer(*pass).is_some());
        let lit: Vec<usize> = (0..self.passes.len()).filter(is_lit).collect();
        let variants = self.variants.iter().map(|Filled { variant, frames, tone }| Shown {
            variant,
            tone: *tone,
            frames: frames.iter().map(|frame| frame.shown(&lit)).collect(),
        });
        let data = Data {
            tones: &self.tones,
            fps: self.fps,
            axes: &self.axes,
            passes: lit.iter().filter_map(|&pass| self.passes.get(pass)).collect(),
            variants: variants.collect(),
        };
        Ok(html::write(self, &serde_json::to_string(&data)?))
    }

    fn frames(&self) -> impl Iterator<Item = &Frame> {
        self.variants.iter().flat_map(|filled| &filled.frames)
    }

    /// Writes the page, whole or not at all, and returns its size in bytes.
    ///
    /// # Errors
    /// As for [`Page::to_html`], and [`PageError::WholeFile`].
    pub fn write(&self, path: &Path) -> Result<u64, PageError> {
        let html = self.to_html()?;
        whole_file::write_whole(path, html.as_bytes())?;
        Ok(html.len() as u64)
    }
}

impl Plate {
    /// A picture behind all frames of its size: red, green, blue in sRGB.
    ///
    /// # Errors
    /// [`PageError::Size`] or [`PageError::Encode`].
    pub fn new(width: u32, height: u32, rgb: &[u8]) -> Result<Plate, PageError> {
        let expected = (u64::from(width) * u64::from(height)).saturating_mul(3);
        if expected == 0 || rgb.len() as u64 != expected {
            let (frame, what, found) = (0, "the plate", rgb.len());
            return Err(PageError::Size { frame, what, found, expected, width, height });
        }
        Ok(Plate { width, height, png: pack::png(width, rgb)? })
    }
}
