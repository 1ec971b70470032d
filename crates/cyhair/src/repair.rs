//! Mending what is odd or wrong about a file in memory.

use std::fmt;

use crate::{Field, HairError, HairFile, KNOWN_ARRAYS, check};

/// Something that was mended.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Repair {
    /// Bits of `arrays` the format does not define were cleared.
    ClearedUnknownArrays {
        /// The bits.
        bits: u32,
    },
    /// Bytes behind the last array were dropped.
    DroppedTrailingBytes {
        /// Where they started.
        offset: u64,
        /// How many there were.
        bytes: u64,
    },
    /// A count in the header contradicted everything else and was set.
    SetCount {
        /// The count.
        field: Field,
        /// What it was.
        from: u32,
        /// What it is now.
        to: u32,
    },
    /// An array that was cut off by the end of the file was dropped.
    DroppedArray {
        /// The array.
        field: Field,
    },
    /// Strands whose points were cut off by the end of the file were dropped.
    DroppedCutStrands {
        /// How many were kept.
        kept: u64,
        /// How many were dropped.
        dropped: u64,
    },
    /// Points that were not finite were dropped; their neighbours are joined.
    DroppedPoints {
        /// How many.
        count: u64,
    },
    /// Segments without length were merged into the one before.
    MergedSegments {
        /// How many.
        count: u64,
    },
    /// Strands with fewer than two points (left) were dropped.
    DroppedStrands {
        /// How many.
        count: u64,
    },
    /// Values that were not finite were replaced by the header's default.
    ReplacedValues {
        /// The array.
        field: Field,
        /// How many.
        count: u64,
    },
    /// A default that was not finite was replaced by that of a fresh header.
    ReplacedDefault {
        /// The default.
        field: Field,
    },
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Repair::ClearedUnknownArrays { bits } => {
                write!(f, "arrays: cleared the undefined bits {bits:#x}")
            }
            Repair::DroppedTrailingBytes { offset, bytes } => {
                write!(f, "dropped {bytes} bytes behind the last array, at byte {offset}")
            }
            Repair::SetCount { field, from, to } => write!(f, "{field}: {from} became {to}"),
            Repair::DroppedArray { field } => write!(f, "{field}: dropped the array, which was cut off"),
            Repair::DroppedCutStrands { kept, dropped } => {
                write!(f, "points: cut off; kept {kept} whole strands and dropped {dropped}")
            }
            Repair::DroppedPoints { count } => write!(f, "points: dropped {count} that were not finite"),
            Repair::MergedSegments { count } => write!(f, "points: merged {count} segments without length"),
            Repair::DroppedStrands { count } => {
                write!(f, "dropped {count} strands with fewer than two points")
            }
            Repair::ReplacedValues { field, count } => {
                write!(f, "{field}: replaced {count} values that were not finite by the default")
            }
            Repair::ReplacedDefault { field } => write!(f, "{field}: replaced, it was not finite"),
        }
    }
}

impl HairFile {
    /// Mends what can be mended and says what was done; a clean file is left alone, to the bit.
    ///
    /// Points that are not finite are dropped and so are points that repeat the one before them (in
    /// every array); strands left with fewer than two points go. Other values that are not finite
    /// become the header's default. Undefined array bits are cleared. Without points only strands
    /// with a single point are dropped. What came in must agree with itself in its counts, as
    /// everything read does.
    ///
    /// # Errors
    /// Those of [`HairFile::check`] for counts that disagree; [`HairError::NoStrands`] when no strand
    /// is left; [`HairError::TooLarge`] when a strand left is too long for the segments array that is
    /// now needed. The file may then be partly mended.
    pub fn repair(&mut self) -> Result<Vec<Repair>, HairError> {
        match self.check() {
            Ok(()) | Err(HairError::NonFinitePoint { .. }) => {}
            Err(error) => return Err(error),
        }
        let mut repairs = Vec::new();
        let bits = self.header.arrays & !KNOWN_ARRAYS;
        if bits != 0 {
            self.header.arrays &= KNOWN_ARRAYS;
            repairs.push(Repair::ClearedUnknownArrays { bits });
        }
        self.mend_defaults(&mut repairs);
        self.mend_values(&mut repairs);
        let plan = Plan::of(self);
        if plan.changes() {
            plan.note(&mut repairs);
            self.keep(&plan)?;
        }
        if self.header.hair_count == 0 { Err(HairError::NoStrands) } else { Ok(repairs) }
    }

    fn mend_defaults(&mut self, repairs: &mut Vec<Repair>) {
        let (header, fresh) = (&mut self.header, crate::Header::default());
        if !header.default_thickness.is_finite() {
            header.default_thickness = fresh.default_thickness;
            repairs.push(Repair::ReplacedDefault { field: Field::DefaultThickness });
        }
        if !header.default_transparency.is_finite() {
            header.default_transparency = fresh.default_transparency;
            repairs.push(Repair::ReplacedDefault { field: Field::DefaultTransparency });
        }
        if !check::all_finite(&header.default_color) {
            header.default_color = fresh.default_color;
            repairs.push(Repair::ReplacedDefault { field: Field::DefaultColor });
        }
    }

    fn mend_values(&mut self, repairs: &mut Vec<Repair>) {
        let header = self.header;
        let mut replace = |field, values: &mut [f32], defaults: &[f32]| {
            let mut count = 0;
            for (i, value) in values.iter_mut().enumerate().filter(|(_, v)| !v.is_finite()) {
                *value = defaults[i % defaults.len()];
                count += 1;
            }
            if count > 0 {
                repairs.push(Repair::ReplacedValues { field, count });
            }
        };
        let colors = self.colors.as_deref_mut().map(bytemuck::cast_slice_mut);
        replace(
            Field::Thickness,
            self.thickness.as_deref_mut().unwrap_or_default(),
            &[header.default_thickness],
        );
        replace(
            Field::Transparency,
            self.transparency.as_deref_mut().unwrap_or_default(),
            &[header.default_transparency],
        );
        replace(Field::Colors, colors.unwrap_or_default(), &header.default_color);
    }

    /// Keeps the points `plan` keeps, in every array.
    fn keep(&mut self, plan: &Plan) -> Result<(), HairError> {
        let default = u64::from(self.header.default_segments);
        if self.segments.is_some() || plan.segments.iter().any(|&count| count != default) {
            // Only a default can be longer than the array can say, and then strands must stay whole.
            let narrow = |&found: &u64| {
                let limit = u64::from(u16::MAX);
                u16::try_from(found).map_err(|_| HairError::TooLarge { field: Field::Segments, found, limit })
            };
            self.segments = Some(plan.segments.iter().map(narrow).collect::<Result<_, _>>()?);
            self.header.arrays |= Field::Segments.bit();
        }
        keep_values(self.points.as_mut(), &plan.keep);
        keep_values(self.thickness.as_mut(), &plan.keep);
        keep_values(self.transparency.as_mut(), &plan.keep);
        keep_values(self.colors.as_mut(), &plan.keep);
        // Neither is more than what the header held before.
        self.header.hair_count = plan.segments.len() as u32;
        self.header.point_count = plan.segments.iter().map(|&count| count as u32 + 1).sum();
        Ok(())
    }
}

/// Which points stay, and the strands they make.
#[derive(Default)]
struct Plan {
    /// One for each point, if any array has values for points; a header alone may promise 2^32.
    keep: Vec<bool>,
    segments: Vec<u64>,
    not_finite: u64,
    repeated: u64,
    short: u64,
}

impl Plan {
    fn of(file: &HairFile) -> Plan {
        match file.per_point_len() {
            Some(points) => Plan::of_points(file, points),
            None => Plan::of_segments(file),
        }
    }

    /// Without values for points all that can be wrong with a strand is its number of segments.
    fn of_segments(file: &HairFile) -> Plan {
        let Some(segments) = &file.segments else {
            // All strands are alike, and nothing is as long as the header says there are.
            let short = if file.header.default_segments == 0 { file.header.hair_count } else { 0 };
            return Plan { short: short.into(), ..Plan::default() };
        };
        let kept: Vec<u64> = segments.iter().filter(|&&count| count > 0).map(|&c| c.into()).collect();
        Plan { short: (segments.len() - kept.len()) as u64, segments: kept, ..Plan::default() }
    }

    fn of_points(file: &HairFile, points: usize) -> Plan {
        let mut plan = Plan { keep: vec![true; points], ..Plan::default() };
        for range in file.strand_ranges() {
            let keep = &mut plan.keep[range.clone()];
            if let Some(points) = &file.points {
                let mut last: Option<[f32; 3]> = None;
                for (keep, point) in keep.iter_mut().zip(&points[range]) {
                    let finite = point.iter().all(|c| c.is_finite());
                    let repeats = last == Some(*point);
                    *keep = finite && !repeats;
                    plan.not_finite += u64::from(!finite);
                    plan.repeated += u64::from(repeats);
                    last = if finite { Some(*point) } else { last };
                }
            }
            let left = keep.iter().filter(|keep| **keep).count();
            if left < 2 {
                keep.fill(false);
                plan.short += 1;
            } else {
                plan.segments.push(left as u64 - 1);
            }
        }
        plan
    }

    fn changes(&self) -> bool {
        self.not_finite + self.repeated + self.short > 0
    }

    fn note(&self, repairs: &mut Vec<Repair>) {
        let mut note = |count, repair| {
            if count > 0 {
                repairs.push(repair);
            }
        };
        note(self.not_finite, Repair::DroppedPoints { count: self.not_finite });
        note(self.repeated, Repair::MergedSegments { count: self.repeated });
        note(self.short, Repair::DroppedStrands { count: self.short });
    }
}

fn keep_values<T>(values: Option<&mut Vec<T>>, keep: &[bool]) {
    let mut kept = keep.iter();
    if let Some(values) = values {
        values.retain(|_| kept.next().copied().unwrap_or(false));
    }
}
