//! What every sample fulfils.

use glam::Vec3;
use groom::Statistics;
use groom_samples::{HEAD_RADII, Options, Style, hair};

#[test]
fn hair_is_sound_and_stays_out_of_the_head() {
    for style in Style::ALL {
        let options = Options { style, strands: 2200, points: 24, ..Options::default() };
        let groom = hair(&options).unwrap();
        let figures = Statistics::of(&groom);
        assert_eq!((figures.non_finite_points, figures.zero_length_segments), (0, 0));
        // A strand that is pulled to a lock across the parting jumps over the head in one segment.
        let segment = figures.segment_length.unwrap();
        assert!(segment.max < 2.5 * segment.mean, "{style} jumps: {segment:?}");
        let level = |p: &Vec3| (*p / HEAD_RADII).length();
        assert!(groom.positions().iter().all(|p| level(p) > 0.999), "{style} passes through the head");
        assert!(groom.strands().all(|strand| strand[strand.len() - 1].y < strand[0].y + 0.02));
        assert_eq!(groom, hair(&options).unwrap());
        assert_ne!(groom, hair(&Options { seed: 2, ..options }).unwrap());
    }
}

#[test]
fn options_out_of_range_are_refused() {
    let base = Options::default();
    for options in [
        Options { strands: 0, ..base },
        Options { strands: u32::MAX, ..base },
        Options { points: 2, ..base },
        Options { strands: 1 << 24, points: 1000, ..base },
    ] {
        assert!(hair(&options).is_err());
    }
}
