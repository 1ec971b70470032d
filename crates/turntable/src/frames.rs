//! Which frames to make, as text: `1-5`, `1-10:2`, `1,3,7-9`.

use std::collections::BTreeSet;
use std::str::FromStr;

/// A set of frame numbers, written as Open Job Description writes integer ranges: numbers and
/// `first-last` with an optional `:step`, separated by commas.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FrameRange(BTreeSet<u32>);

/// More frames than this in one range are taken for a slip.
const MOST: u64 = 1_000_000;

/// A frame range that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("frames `{text}`: {reason} (write `1-5`, `1-10:2` or `1,3,7-9`)")]
pub struct FrameRangeError {
    /// What was given.
    pub text: String,
    /// What is wrong with it.
    pub reason: String,
}

impl FrameRange {
    /// Whether `frame` is in the set.
    #[must_use]
    pub fn contains(&self, frame: u32) -> bool {
        self.0.contains(&frame)
    }

    /// The frames, rising.
    pub fn iter(&self) -> impl Iterator<Item = u32> + '_ {
        self.0.iter().copied()
    }
}

impl FromIterator<u32> for FrameRange {
    fn from_iter<I: IntoIterator<Item = u32>>(frames: I) -> Self {
        FrameRange(frames.into_iter().collect())
    }
}

impl FromStr for FrameRange {
    type Err = FrameRangeError;

    fn from_str(text: &str) -> Result<Self, FrameRangeError> {
        let mut frames = BTreeSet::new();
        for part in text.split(',') {
            let fault = |reason: String| FrameRangeError { text: text.to_owned(), reason };
            let (first, last, step) = parse_part(part.trim()).map_err(fault)?;
            let wanted = u64::from(last - first) / u64::from(step) + 1;
            if wanted + frames.len() as u64 > MOST {
                return Err(fault(format!("more than {MOST} frames")));
            }
            frames.extend((first..=last).step_by(step as usize));
        }
        Ok(FrameRange(frames))
    }
}

fn parse_part(part: &str) -> Result<(u32, u32, u32), String> {
    let number = |s: &str| {
        let s = s.trim();
        // `parse` alone would take a leading plus sign.
        let digits = !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
        digits.then(|| s.parse::<u32>().ok()).flatten().ok_or_else(|| format!("`{s}` is no frame number"))
    };
    let (range, step) = match part.split_once(':') {
        Some((range, step)) => (range, Some(number(step)?)),
        None => (part, None),
    };
    let (first, last) = match range.split_once('-') {
        Some((first, last)) => (number(first)?, number(last)?),
        None if step.is_some() => return Err(format!("`{part}` has a step but no range")),
        None => (number(range)?, number(range)?),
    };
    if last < first {
        return Err(format!("`{range}` runs backwards"));
    }
    match step.unwrap_or(1) {
        0 => Err(format!("`{part}` has a step of 0")),
        step => Ok((first, last, step)),
    }
}

impl std::fmt::Display for FrameRange {
    /// The shortest usual form: runs of neighbours as `first-last`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut frames = self.iter().peekable();
        let mut separator = "";
        while let Some(first) = frames.next() {
            let mut last = first;
            while let Some(next) = frames.next_if(|&next| next == last + 1) {
                last = next;
            }
            if first == last {
                write!(f, "{separator}{first}")?;
            } else {
                write!(f, "{separator}{first}-{last}")?;
            }
            separator = ",";
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn ranges_mean_what_they_say() {
        for (text, expect) in [
            ("1-5", vec![1, 2, 3, 4, 5]),
            ("1-10:2", vec![1, 3, 5, 7, 9]),
            ("1,3,7-9", vec![1, 3, 7, 8, 9]),
            ("1-5,7,9-11:2", vec![1, 2, 3, 4, 5, 7, 9, 11]),
            (" 3 , 3 - 4 ", vec![3, 4]),
            ("4-4:9", vec![4]),
        ] {
            assert_eq!(text.parse::<FrameRange>().unwrap().iter().collect::<Vec<_>>(), expect, "{text}");
        }
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for text in [
            "",
            ",",
            "1-",
            "-1",
            "5-1",
            "1-5:0",
            "3:2",
            "a",
            "+1",
            "1--2",
            "1-2-3",
            "99999999999",
            "0-4294967295",
        ] {
            let error = text.parse::<FrameRange>().unwrap_err();
            assert!(error.to_string().contains(&format!("`{text}`")), "{error}");
        }
    }

    proptest! {
        #[test]
        fn text_leads_back_to_the_set(frames in prop::collection::btree_set(0u32..500, 1..60)) {
            let range: FrameRange = frames.iter().copied().collect();
            prop_assert_eq!(range.to_string().parse::<FrameRange>().unwrap(), range);
        }

        #[test]
        fn steps_are_arithmetic(first in 0u32..1000, len in 0u32..1000, step in 1u32..50) {
            let range: FrameRange = format!("{first}-{}:{step}", first + len).parse().unwrap();
            let expect: Vec<u32> = (0..=len / step).map(|i| first + i * step).collect();
            prop_assert_eq!(range.iter().collect::<Vec<_>>(), expect);
        }

        #[test]
        fn no_text_panics(text in "[-0-9:, a]{0,20}") {
            let _ = text.parse::<FrameRange>();
        }
    }
}
