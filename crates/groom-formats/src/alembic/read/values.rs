//! Samples as numbers of a groom, at a time.

use std::cell::Cell;

use glam::{Vec2, Vec3};
use groom::Values;
use ogawa::{OgawaError, Pod, PropertyReader, Sample};

use super::time::{Clock, Moment};

/// Bytes of memory a byte of the file may become, and what even the smallest may.
const FACTOR: u64 = 4;
const LEAST: u64 = 1 << 16;

/// What a reader of samples knows: the time that is asked for, and how much memory is left.
///
/// Identical samples stand once in a file, so that a small file may name many large arrays.
pub(super) struct Samples {
    pub(super) clock: Clock,
    /// The frame; `None` for the first sample.
    pub(super) frame: Option<f64>,
    left: Cell<u64>,
}

impl Samples {
    pub(super) fn new(clock: Clock, frame: Option<f64>, file_len: usize) -> Self {
        let left = (file_len as u64).saturating_mul(FACTOR).saturating_add(LEAST);
        Samples { clock, frame, left: Cell::new(left) }
    }

    /// Takes memory for so many bytes.
    pub(super) fn spend(&self, bytes: usize, name: &str) -> Result<(), OgawaError> {
        let left = self.left.get().checked_sub(bytes as u64).ok_or_else(|| OgawaError::Property {
            name: name.to_owned(),
            found: format!("{bytes} bytes of values, repeated from elsewhere in the file"),
            expected: format!("{} at most: {FACTOR} times the file in all", self.left.get()),
        })?;
        self.left.set(left);
        Ok(())
    }

    pub(super) fn moment(&self, property: &PropertyReader<'_>) -> Result<Moment, OgawaError> {
        self.clock.moment(property, self.frame)
    }

    /// The last sample that is not after the time.
    pub(super) fn held<'a>(&self, property: &PropertyReader<'a>) -> Result<Sample<'a>, OgawaError> {
        property.sample(self.moment(property)?.before)
    }

    /// The sample as a groom's values, fractions between two samples; `Err` in words where a groom has no such type.
    pub(super) fn values(&self, property: &PropertyReader<'_>) -> Result<Result<Values, String>, OgawaError> {
        let moment = self.moment(property)?;
        let mut values = match self.of_sample(&property.sample(moment.before)?, property.name())? {
            Ok(values) => values,
            Err(why) => return Ok(Err(why)),
        };
        if moment.blend > 0.0 {
            let after = self.of_sample(&property.sample(moment.after)?, property.name())?;
            if let Ok(after) = after {
                blend(&mut values, &after, moment.blend as f32);
            }
        }
        Ok(Ok(values))
    }

    fn of_sample(&self, sample: &Sample<'_>, name: &str) -> Result<Result<Values, String>, OgawaError> {
        let data_type = sample.data_type();
        if data_type.size().is_none() {
            return Ok(Err("a groom holds no texts".into()));
        }
        let numbers = sample.len() * usize::from(data_type.extent);
        self.spend(numbers * size_of::<f32>(), name)?;
        let fraction = matches!(data_type.pod, Pod::F16 | Pod::F32 | Pod::F64);
        Ok(Ok(match (data_type.extent, fraction) {
            (1, false) => match sample.to_i32() {
                Ok(numbers) => Values::Int(numbers),
                Err(_) => return Ok(Err("its integers are larger than 32 bits".into())),
            },
            (1, true) => Values::Float(sample.to_f32()?),
            (2, _) => Values::Vec2(pairs(sample)?),
            (3, _) => Values::Vec3(triples(sample)?),
            (extent, _) => return Ok(Err(format!("a groom holds no {extent} numbers a value"))),
        }))
    }
}

fn pairs(sample: &Sample<'_>) -> Result<Vec<Vec2>, OgawaError> {
    if is_plain(sample) {
        return Ok(bytemuck::pod_collect_to_vec(sample.bytes()));
    }
    Ok(sample.to_f32()?.chunks_exact(2).map(|v| Vec2::new(v[0], v[1])).collect())
}

pub(super) fn triples(sample: &Sample<'_>) -> Result<Vec<Vec3>, OgawaError> {
    if is_plain(sample) {
        return Ok(bytemuck::pod_collect_to_vec(sample.bytes()));
    }
    Ok(sample.to_f32()?.chunks_exact(3).map(|v| Vec3::new(v[0], v[1], v[2])).collect())
}

/// Whether its bytes are already what this machine calls numbers.
fn is_plain(sample: &Sample<'_>) -> bool {
    sample.data_type().pod == Pod::F32 && cfg!(target_endian = "little")
}

/// Goes from `values` to `after`; whole numbers stay, and so do arrays of another length.
fn blend(values: &mut Values, after: &Values, part: f32) {
    match (values, after) {
        (Values::Float(a), Values::Float(b)) => between(a, b, |a, b| a + (b - a) * part),
        (Values::Vec2(a), Values::Vec2(b)) => between(a, b, |a, b| a.lerp(b, part)),
        (Values::Vec3(a), Values::Vec3(b)) => between(a, b, |a, b| a.lerp(b, part)),
        _ => {}
    }
}

fn between<T: Copy>(a: &mut [T], b: &[T], lerp: impl Fn(T, T) -> T) {
    if a.len() == b.len() {
        a.iter_mut().zip(b).for_each(|(a, &b)| *a = lerp(*a, b));
    }
}
