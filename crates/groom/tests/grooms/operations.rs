//! Laws of what can be done to a groom.
use glam::Vec3;
use groom::{Attribute, Domain, Groom, Repair, Statistics, UpAxis, Values, names};
use proptest::prelude::*;

/// Grooms whose points lie on a coarse grid, so that points coincide now and then, with a per-vertex
/// attribute that repeats the position, a per-strand one and a radius.
fn grooms() -> impl Strategy<Value = Groom> {
    let point = prop::array::uniform3(-3_i8..3).prop_map(|p| Vec3::from(p.map(f32::from)));
    let strand = prop::collection::vec(point, 1..8);
    prop::collection::vec(strand, 1..12).prop_map(|strands| {
        let mut offsets = vec![0];
        offsets.extend(strands.iter().scan(0, |end, strand| {
            *end += strand.len() as u32;
            Some(*end)
        }));
        let mut groom = Groom::new(offsets, strands.concat()).unwrap();
        let ids = (0..strands.len() as i32).map(|i| i * 10).collect();
        let copy = Attribute { domain: Domain::Vertex, values: Values::Vec3(strands.concat()) };
        groom.set_attribute("copy", copy).unwrap();
        groom
            .set_attribute(names::ID, Attribute { domain: Domain::Strand, values: Values::Int(ids) })
            .unwrap();
        groom.set_attribute(names::RADIUS, Attribute::constant_float(0.25)).unwrap();
        groom
    })
}

fn copy(groom: &Groom) -> &[Vec3] {
    match &groom.attribute("copy").unwrap().values {
        Values::Vec3(values) => values,
        _ => &[],
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn resampling_keeps_ends_and_carries_attributes(groom in grooms(), count in 2_usize..20, step in 0.1_f32..4.0) {
        for resampled in [groom.resample_by_count(count).unwrap(), groom.resample_by_length(step).unwrap()] {
            prop_assert_eq!(resampled.strand_count(), groom.strand_count());
            prop_assert_eq!(copy(&resampled), resampled.positions());
            for (new, old) in resampled.strands().zip(groom.strands()) {
                prop_assert_eq!((new.first(), new.last()), (old.first(), old.last()));
            }
            let (before, after) = (Statistics::of(&groom), Statistics::of(&resampled));
            prop_assert_eq!(after.non_finite_points, 0);
            // Corners are cut, so nothing gets longer.
            let longest = |figures: &Statistics| figures.strand_length.unwrap().max;
            prop_assert!(longest(&after) <= longest(&before) + 1e-4);
        }
        let by_count = groom.resample_by_count(count).unwrap();
        prop_assert!(by_count.strands().all(|strand| strand.len() == count));
        let by_length = groom.resample_by_length(step).unwrap();
        let longest = Statistics::of(&by_length).segment_length.unwrap().max;
        prop_assert!(longest <= f64::from(step) * 1.0001);
    }

    #[test]
    fn repair_leaves_nothing_to_repair(mut groom in grooms(), bad in prop::collection::vec(any::<prop::sample::Index>(), 0..4)) {
        for index in bad {
            let index = index.index(groom.point_count());
            groom.positions_mut()[index].y = f32::NAN;
        }
        let before = Statistics::of(&groom);
        let repairs = groom.repair();
        let after = Statistics::of(&groom);
        prop_assert_eq!((after.non_finite_points, after.zero_length_segments, after.one_point_strands), (0, 0, 0));
        prop_assert_eq!(groom.clone().repair(), []);
        let dropped = before.points - after.points;
        prop_assert_eq!(repairs.is_empty(), dropped == 0);
        prop_assert!((0..groom.strand_count()).all(|strand| groom.strand_id(strand) % 10 == 0));
    }

    #[test]
    fn subsampling_takes_whole_strands_and_keeps_their_ids(groom in grooms(), max in 0_usize..14, stride in 1_usize..5) {
        let fewer = groom.subsample_to(max);
        prop_assert_eq!(fewer.strand_count(), max.min(groom.strand_count()));
        let strided = groom.subsample_by_stride(stride).unwrap();
        prop_assert_eq!(strided.strand_count(), groom.strand_count().div_ceil(stride));
        for part in [fewer, strided] {
            for strand in 0..part.strand_count() {
                let id = part.strand_id(strand);
                prop_assert_eq!(part.strand(strand), groom.strand(id as usize / 10));
            }
            prop_assert_eq!(copy(&part), part.positions());
        }
    }

    #[test]
    fn turning_and_scaling_there_and_back(groom in grooms()) {
        let mut turned = groom.clone();
        turned.turn_to(UpAxis::Z);
        prop_assert_eq!(turned.up_axis, UpAxis::Z);
        turned.turn_to(UpAxis::Y);
        prop_assert_eq!(&turned, &groom);
        turned.scale(4.0).unwrap();
        prop_assert_eq!(turned.radii().get(0, 0), 1.0);
        turned.scale(0.25).unwrap();
        prop_assert_eq!(&turned, &groom);
    }

    #[test]
    fn ramps_run_from_root_to_tip(mut groom in grooms()) {
        groom.ramp_width(4.0, 1.0).unwrap();
        groom.ramp_color(Vec3::X, Vec3::Y).unwrap();
        for strand in 0..groom.strand_count() {
            let range = groom.strand_range(strand);
            let radius = |vertex| groom.radii().get(strand, vertex);
            prop_assert_eq!(radius(range.start), 2.0);
            prop_assert_eq!(groom.colors().unwrap().get(strand, range.start), Vec3::X);
            if range.len() > 1 {
                prop_assert_eq!(radius(range.end - 1), 0.5);
                prop_assert_eq!(groom.colors().unwrap().get(strand, range.end - 1), Vec3::Y);
            }
            prop_assert!(range.clone().skip(1).all(|vertex| radius(vertex) <= radius(vertex - 1)));
        }
    }
}

#[test]
fn resampling_a_straight_strand_spreads_points_evenly() {
    let mut groom = Groom::new(vec![0, 3], vec![Vec3::ZERO, Vec3::X, Vec3::X * 8.0]).unwrap();
    let radii = Values::Float(vec![1.0, 0.5, 0.0]);
    groom.set_attribute(names::RADIUS, Attribute { domain: Domain::Vertex, values: radii }).unwrap();
    let five = groom.resample_by_count(5).unwrap();
    assert_eq!(five.positions(), [0.0, 2.0, 4.0, 6.0, 8.0].map(|x| Vec3::X * x));
    assert!((five.radii().get(0, 2) - 0.5 * 4.0 / 7.0).abs() < 1e-6);
    assert_eq!(groom.resample_by_length(2.0).unwrap().positions(), five.positions());
}

#[test]
fn strands_keep_their_identity_even_beside_an_id_of_the_whole_groom() {
    let points: Vec<Vec3> = (0..6).map(|i| Vec3::splat(i as f32)).collect();
    let mut groom = Groom::new(vec![0, 2, 4, 6], points).unwrap();
    let id = Attribute { domain: Domain::Groom, values: Values::Int(vec![5]) };
    groom.set_attribute(names::ID, id).unwrap();
    let fewer = groom.subsample_by_stride(2).unwrap();
    assert_eq!([fewer.strand_id(0), fewer.strand_id(1)], [0, 2]);
}

#[test]
fn one_repair_a_fault() {
    let nan = Vec3::splat(f32::NAN);
    let points = vec![Vec3::ZERO, nan, Vec3::ZERO, Vec3::X, nan, Vec3::Y];
    let mut groom = Groom::new(vec![0, 4, 6], points).unwrap();
    let done = groom.repair();
    let expected = [
        Repair::DroppedPoints { count: 2 },
        Repair::MergedSegments { count: 1 },
        Repair::DroppedStrands { count: 1 },
    ];
    assert_eq!(done, expected);
    assert_eq!(groom.positions(), [Vec3::ZERO, Vec3::X]);
}

#[test]
fn arguments_out_of_range_are_refused() {
    let mut groom = Groom::new(vec![0, 2], vec![Vec3::ZERO, Vec3::X]).unwrap();
    assert!(groom.resample_by_count(1).is_err());
    assert!(groom.resample_by_count(usize::MAX).is_err());
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(groom.resample_by_length(bad).is_err());
        assert!(groom.scale(bad).is_err());
    }
    assert!(groom.resample_by_length(f32::MIN_POSITIVE).is_err());
    assert!(groom.subsample_by_stride(0).is_err());
    assert!(groom.set_width(-1.0).is_err() && groom.set_width(f32::NAN).is_err());
    assert!(groom.set_color(Vec3::new(0.0, 0.5, 1.1)).is_err());
    assert_eq!(groom.attributes().count(), 0);
}
