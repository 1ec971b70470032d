//! Laws of what changes the shape of strands, and of measuring the change.

use crate::support::{floats, from_strands, grooms, ints, wavy};
use glam::{DVec3, Vec3};
use groom::{Distance, Grid, Groom, GroomError, Smoothing, Statistics};
use proptest::prelude::*;

/// The distance from a point to a polyline, by another road: dense samples of each segment, refined about
/// the best one. Never less than the true distance.
fn sampled_distance(point: DVec3, line: &[Vec3]) -> f64 {
    let at = |pair: &[Vec3], t: f64| pair[0].as_dvec3().lerp(pair[1].as_dvec3(), t).distance(point);
    let mut best = line[0].as_dvec3().distance(point);
    for pair in line.windows(2) {
        let (mut low, mut high) = (0.0, 1.0);
        // The distance along a segment falls and then rises.
        for _ in 0..60 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if at(pair, a) < at(pair, b) { high = b } else { low = a }
        }
        best = best.min(at(pair, (low + high) * 0.5));
    }
    best
}

fn smoothing(iterations: u32, strength: f32, keep_length: bool) -> Smoothing {
    Smoothing { iterations, strength, keep_length }
}

/// How much a strand turns and wiggles: the sum of the squared second differences.
fn roughness(groom: &Groom) -> f64 {
    let bend = |w: &[Vec3]| (w[0].as_dvec3() - 2.0 * w[1].as_dvec3() + w[2].as_dvec3()).length_squared();
    groom.strands().flat_map(|strand| strand.windows(3).map(bend)).sum()
}

fn segment_lengths(groom: &Groom) -> Vec<f32> {
    groom.strands().flat_map(|strand| strand.windows(2).map(|pair| pair[0].distance(pair[1]))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn smoothing_keeps_ends_and_never_roughens(groom in grooms(), iterations in 0_u32..12, strength in 0.0_f32..=1.0) {
        let mut smooth = groom.clone();
        smooth.smooth(smoothing(iterations, strength, false)).unwrap();
        prop_assert!(smooth.positions().iter().all(|p| p.is_finite()));
        prop_assert!(roughness(&smooth) <= roughness(&groom) * 1.000_01 + 1e-9);
        for (new, old) in smooth.strands().zip(groom.strands()) {
            prop_assert_eq!((new.first(), new.last()), (old.first(), old.last()));
        }
        prop_assert_eq!(ints(&smooth, "index"), ints(&groom, "index"));
        let box_of = |groom: &Groom| Statistics::of(groom).bounds.unwrap();
        let ((low, high), (new_low, new_high)) = (box_of(&groom), box_of(&smooth));
        prop_assert!(new_low.cmpge(low - 1e-5).all() && new_high.cmple(high + 1e-5).all(), "nothing overshoots");
    }

    #[test]
    fn smoothing_that_keeps_lengths_does(groom in grooms(), iterations in 1_u32..12, strength in 0.01_f32..=1.0) {
        let mut smooth = groom.clone();
        smooth.smooth(smoothing(iterations, strength, true)).unwrap();
        for (new, old) in segment_lengths(&smooth).iter().zip(segment_lengths(&groom)) {
            prop_assert!((new - old).abs() <= 1e-4, "{new} {old}");
        }
        let roots = |groom: &Groom| groom.strands().map(|strand| strand[0]).collect::<Vec<_>>();
        prop_assert_eq!(roots(&smooth), roots(&groom));
    }

    #[test]
    fn simplifying_stays_within_the_tolerance(groom in grooms(), tolerance in 0.0_f32..12.0) {
        let simple = groom.simplify(tolerance).unwrap();
        prop_assert_eq!(simple.strand_count(), groom.strand_count());
        let bound = f64::from(tolerance) + 1e-4;
        for (strand, (new, old)) in simple.strands().zip(groom.strands()).enumerate() {
            prop_assert_eq!((new.first(), new.last()), (old.first(), old.last()));
            prop_assert!(old.iter().all(|p| sampled_distance(p.as_dvec3(), new) <= bound));
            // Between the points too, both ways.
            for (from, to) in [(new, old), (old, new)] {
                for pair in from.windows(2) {
                    for i in 0..=10 {
                        let point = pair[0].as_dvec3().lerp(pair[1].as_dvec3(), f64::from(i) * 0.1);
                        prop_assert!(sampled_distance(point, to) <= bound, "strand {strand}");
                    }
                }
            }
        }
        // What is kept is kept with all it has.
        for (vertex, &old) in ints(&simple, "index").iter().enumerate() {
            prop_assert_eq!(simple.positions()[vertex], groom.positions()[old as usize]);
            prop_assert_eq!(floats(&simple, "radius")[vertex], floats(&groom, "radius")[old as usize]);
        }
    }

    #[test]
    fn the_grid_moves_no_point_farther_than_it_says(groom in grooms(), bits in 4_u32..=24) {
        let mut rounded = groom.clone();
        let farthest = rounded.quantize(bits).unwrap();
        let grid = Grid::of(&groom, bits).unwrap();
        let moved = |(a, b): (&Vec3, &Vec3)| a.as_dvec3().distance(b.as_dvec3());
        let most = rounded.positions().iter().zip(groom.positions()).map(moved).fold(0.0, f64::max);
        prop_assert_eq!(most, farthest);
        // A float near 10 is rounded by no more than 2^-21.
        prop_assert!(farthest <= grid.step * 0.75_f64.sqrt() + 1e-6);
        let once = rounded.clone();
        prop_assert!(rounded.quantize(bits).unwrap() <= 1e-6);
        prop_assert!(once.positions().iter().zip(rounded.positions()).all(|(a, b)| a.distance(*b) <= 1e-6));
        prop_assert!(groom.positions().iter().all(|&p| grid.index(p).max_element() <= grid.last()));
    }

    #[test]
    fn the_distance_is_that_of_dense_samples(pair in (grooms(), grooms())) {
        let strands = |groom: &Groom| groom.strands().map(<[Vec3]>::to_vec).collect::<Vec<_>>();
        let (a, b) = (from_strands(&strands(&pair.0)), from_strands(&strands(&pair.1)));
        let distance = Distance::between(&a, &b);
        let both = a.strand_count().min(b.strand_count());
        prop_assert_eq!(distance.strands, both);
        prop_assert_eq!(distance.only_in_first, a.strand_count() - both);
        prop_assert_eq!(distance.only_in_second, b.strand_count() - both);
        let all = |from: &Groom, to: &Groom| -> Vec<f64> {
            let of = |i: usize| from.strand(i).iter().map(move |p| sampled_distance(p.as_dvec3(), to.strand(i)));
            (0..both).flat_map(of).collect()
        };
        for (deviation, expected) in [(distance.there, all(&a, &b)), (distance.back, all(&b, &a))] {
            let most = expected.iter().copied().fold(0.0, f64::max);
            let mean = expected.iter().map(|d| d * d).sum::<f64>() / expected.len() as f64;
            prop_assert!((deviation.max - most).abs() < 1e-6, "{} {most}", deviation.max);
            prop_assert!((deviation.rms - mean.sqrt()).abs() < 1e-6);
            prop_assert_eq!(deviation.points, expected.len());
        }
    }
}

#[test]
fn long_strands_are_measured_exactly_too() {
    // Many boxes a strand, and a strand that comes back to where it was.
    let (a, b) = (wavy(3, 300), wavy(3, 211));
    let distance = Distance::between(&a, &b);
    let all = (0..3).flat_map(|i| a.strand(i).iter().map(move |p| (i, p)));
    let most = all.map(|(i, p)| sampled_distance(p.as_dvec3(), b.strand(i))).fold(0.0, f64::max);
    assert!((distance.there.max - most).abs() < 1e-9 && most > 0.0, "{} {most}", distance.there.max);
    assert!(distance.rms() <= distance.max());
}

#[test]
fn strands_are_matched_by_their_ids() {
    let groom = wavy(40, 9);
    let thinned = groom.subsample_by_stride(3).unwrap();
    let distance = Distance::between(&groom, &thinned);
    assert_eq!((distance.strands, distance.only_in_first, distance.only_in_second), (14, 26, 0));
    assert_eq!((distance.max(), distance.rms()), (0.0, 0.0));
    let mut moved = thinned.clone();
    moved.positions_mut()[9 * 5 + 2] += Vec3::X * 1e-3;
    let distance = Distance::between(&groom, &moved);
    assert_eq!(distance.worst_strand, Some(15));
    assert!(distance.max() > 1e-4 && distance.max() <= 1.0001e-3);
    let nothing = Distance::between(&Groom::new(vec![0], vec![]).unwrap(), &moved);
    assert_eq!((nothing.strands, nothing.only_in_second, nothing.max(), nothing.rms()), (0, 14, 0.0, 0.0));
}

#[test]
fn smoothing_of_a_zigzag_is_known() {
    let zigzag: Vec<Vec3> =
        (0..9).map(|i| Vec3::new(i as f32, if i % 2 == 0 { 1.0 } else { -1.0 }, 0.0)).collect();
    let mut groom = from_strands(&[zigzag]);
    groom.smooth(smoothing(1, 1.0, false)).unwrap();
    let heights: Vec<f32> = groom.positions().iter().map(|p| p.y).collect();
    assert_eq!(heights, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    // A fold whose end would come to lie on the point before keeps its length, in its old direction.
    let mut fold = from_strands(&[vec![Vec3::ZERO, Vec3::X, Vec3::ZERO]]);
    fold.smooth(smoothing(50, 1.0, true)).unwrap();
    assert!(fold.positions().iter().all(|p| p.is_finite()));
    assert_eq!(segment_lengths(&fold), [1.0, 1.0]);
}

#[test]
fn simplifying_drops_what_is_straight_and_keeps_what_is_not() {
    let line: Vec<Vec3> = (0..100).map(|i| Vec3::X * i as f32).collect();
    assert_eq!(from_strands(&[line]).simplify(0.0).unwrap().point_count(), 2);
    let wave = wavy(50, 60);
    let counts: Vec<usize> =
        [0.0, 0.001, 0.01, 0.1, 10.0].iter().map(|&t| wave.simplify(t).unwrap().point_count()).collect();
    assert!(counts.windows(2).all(|pair| pair[1] < pair[0] || pair[0] == 100), "{counts:?}");
    assert_eq!(counts[4], 100, "two points a strand are left");
}

#[test]
fn simplifying_minds_the_radius() {
    // Straight, but thick in the middle.
    let mut groom = from_strands(&[(0..5).map(|i| Vec3::X * i as f32).collect()]);
    groom.multiply_width(&"0:1,0.5:3,1:1".parse().unwrap()).unwrap();
    assert_eq!(floats(&groom.simplify(0.01).unwrap(), "radius"), [0.5, 1.5, 0.5]);
    assert_eq!(floats(&groom.simplify(1.0).unwrap(), "radius"), [0.5, 0.5]);
}

#[test]
fn points_that_are_not_finite_do_no_harm() {
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, -f32::MAX, 0.0, 1.0];
    let points: Vec<Vec3> =
        (0..60).map(|i| Vec3::new(odd[i % 7], odd[(i / 7) % 7], odd[(i / 3) % 7])).collect();
    let groom =
        from_strands(&[points.clone(), points[..1].to_vec(), vec![Vec3::MAX, -Vec3::MAX, Vec3::ZERO]]);
    for keep_length in [false, true] {
        groom.clone().smooth(smoothing(3, 1.0, keep_length)).unwrap();
    }
    assert_eq!(groom.simplify(1.0).unwrap().strand(0).len(), 60);
    assert!(groom.clone().quantize(8).unwrap() > 0.0);
    let _ = Distance::between(&groom, &groom);
    assert_eq!(groom.pick_guides(2, 0).unwrap().strands.len(), 2);
    assert_eq!(groom.strands_by_length(0.0, 1.0).unwrap(), [1]);
    groom.clone().reverse();
}

#[test]
fn arguments_out_of_range_are_refused() {
    let mut groom = wavy(2, 3);
    let before = groom.clone();
    let refused = |error: GroomError| matches!(error, GroomError::Argument { .. });
    for strength in [-0.1, 1.1, f32::NAN] {
        assert!(refused(groom.smooth(smoothing(1, strength, false)).unwrap_err()));
    }
    for tolerance in [-1.0, f32::NAN, f32::INFINITY] {
        assert!(refused(groom.simplify(tolerance).unwrap_err()));
    }
    for bits in [0, 3, 25, 64, u32::MAX] {
        assert!(refused(groom.quantize(bits).unwrap_err()));
    }
    for (min, max) in [(2.0, 1.0), (f32::NAN, 1.0), (0.0, f32::NAN)] {
        assert!(refused(groom.strands_by_length(min, max).unwrap_err()));
    }
    assert_eq!(groom, before);
}

#[test]
fn lengths_filter_strands() {
    let strand = |length: f32| vec![Vec3::ZERO, Vec3::X * length * 0.5, Vec3::X * length];
    let groom = from_strands(&[strand(1.0), strand(2.0), strand(3.0), vec![Vec3::ONE]]);
    let indices = |min, max| groom.strands_by_length(min, max).unwrap();
    assert_eq!(indices(2.0, f32::INFINITY), [1, 2]);
    assert_eq!(indices(0.0, 2.0), [0, 1, 3]);
    assert_eq!(indices(5.0, 6.0), []);
    let kept = groom.keep_strands(&[2, 0]).unwrap();
    assert_eq!((ints(&kept, "id"), kept.strand(0)), (&[2, 0][..], groom.strand(2)));
    assert!(groom.keep_strands(&[4]).is_err());
}

#[test]
fn frames_are_reshaped_like_the_first() {
    let (first, mut second) = (wavy(20, 40), wavy(20, 40));
    second.smooth(smoothing(30, 1.0, false)).unwrap();
    let kept = first.simple_points(0.05).unwrap();
    let (simple, like) = (first.keep_points(&kept).unwrap(), second.keep_points(&kept).unwrap());
    assert_eq!(simple, first.simplify(0.05).unwrap());
    assert_eq!(simple.offsets(), like.offsets());
    let taken = kept.iter().map(|&point| second.positions()[point as usize]);
    assert!(like.positions().iter().copied().eq(taken));
    let stepped = first.resample_by_length(0.4).unwrap();
    let like = second.resample_like(stepped.offsets()).unwrap();
    assert_eq!(like.offsets(), stepped.offsets());
    assert_eq!(first.resample_like(stepped.offsets()).unwrap(), stepped);
    for points in [vec![], vec![0, 1], vec![0; 20], (0..=800).collect(), (0..800).rev().collect()] {
        assert!(first.keep_points(&points).is_err(), "{points:?}");
    }
    for offsets in [vec![], vec![0, 2], (0..=20).collect(), vec![0; 21], (0..21).rev().collect()] {
        assert!(first.resample_like(&offsets).is_err(), "{offsets:?}");
    }
}
