//! Laws of picking guides.

use std::collections::BTreeSet;

use crate::support::{grooms, ints, wavy};
use groom::{Distance, Groom, names};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn guides_are_distinct_and_everyone_has_one(groom in grooms(), count in 1_usize..12, seed in any::<u64>()) {
        let guides = groom.pick_guides(count, seed).unwrap();
        let distinct: BTreeSet<u32> = guides.strands.iter().copied().collect();
        prop_assert_eq!(distinct.len(), count.min(groom.strand_count()));
        prop_assert_eq!(guides.closest.len(), groom.strand_count());
        prop_assert!(guides.closest.iter().all(|guide| distinct.contains(guide)));
        prop_assert!(guides.strands.iter().all(|&guide| guides.closest[guide as usize] == guide));
        // More guides begin with the same ones.
        let more = groom.pick_guides(count + 3, seed).unwrap();
        prop_assert!(more.strands.starts_with(&guides.strands));
    }
}

/// The distance guides are spread by, as the documentation has it.
fn apart(groom: &Groom, a: u32, b: u32) -> f32 {
    let parts = |strand: u32| {
        let points = groom.strand(strand as usize);
        let (root, middle, tip) = (points[0], points[points.len() / 2], points[points.len() - 1]);
        [root, (middle - root) * 0.5, (tip - root) * 0.5]
    };
    parts(a).iter().zip(parts(b)).map(|(a, b)| a.distance_squared(b)).sum::<f32>().sqrt()
}

#[test]
fn guides_are_spread_and_cover_the_groom() {
    let groom = wavy(1500, 8);
    let guides = groom.pick_guides(40, 3).unwrap();
    let pairs = guides.strands.iter().enumerate();
    let closest_pair = pairs
        .flat_map(|(i, &a)| guides.strands[..i].iter().map(move |&b| (a, b)))
        .map(|(a, b)| apart(&groom, a, b))
        .fold(f32::INFINITY, f32::min);
    let loneliest = (0..1500).map(|s| apart(&groom, s, guides.closest[s as usize])).fold(0.0, f32::max);
    assert!(
        loneliest <= closest_pair * 1.0001,
        "no strand is lonelier than two guides: {loneliest} {closest_pair}"
    );
    for strand in 0..1500 {
        let least = guides.strands.iter().map(|&g| apart(&groom, strand, g)).fold(f32::INFINITY, f32::min);
        assert!(apart(&groom, strand, guides.closest[strand as usize]) <= least * 1.0001);
    }
    assert_ne!(groom.pick_guides(40, 4).unwrap().strands[0], guides.strands[0]);
}

#[test]
fn guides_are_marked_and_kept_with_their_ids() {
    let mut groom = wavy(200, 5).subsample_by_stride(2).unwrap();
    let guides = groom.pick_guides(7, 1).unwrap();
    groom.mark_guides(&guides).unwrap();
    groom.mark_closest_guides(&guides).unwrap();
    assert_eq!(ints(&groom, names::GUIDE).iter().sum::<i32>(), 7);
    let kept = groom.keep_guides().unwrap();
    assert_eq!(kept.strand_count(), 7);
    assert_eq!(ints(&kept, names::ID), ints(&kept, names::CLOSEST_GUIDE));
    let distance = Distance::between(&kept, &groom);
    assert_eq!((distance.strands, distance.max()), (7, 0.0));
    assert!(wavy(3, 2).keep_guides().unwrap_err().to_string().contains("`guide` is not there"));
    assert!(wavy(3, 2).mark_guides(&guides).is_err() && wavy(3, 2).mark_closest_guides(&guides).is_err());
    assert!(groom.pick_guides(0, 1).is_err());
}
