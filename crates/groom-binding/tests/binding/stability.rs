//! The stability table.

use groom_binding::stability::{StabilityRow, cases};

/// What every row promises. Lengths and places are kept to what f64 loses 1e6 away; f32 rounds points 2 sizes away by
/// 1e-7.
fn check(row: &StabilityRow) {
    assert_eq!((row.not_finite, row.flips), (0, 0), "{row:?}");
    assert!(row.height_error < 1e-6, "{row:?}");
    assert!(row.length_error < 1e-6, "{row:?}");
    assert!(row.rounded_length_error < 1e-6, "{row:?}");
    assert!(row.misplaced.is_none_or(|error| error < 1e-6), "{row:?}");
}

#[test]
fn every_case_holds() {
    let cases = cases().unwrap();
    let rows: Vec<StabilityRow> = cases.iter().map(|case| case.run().unwrap()).collect();
    for row in &rows {
        println!("{row:?}");
    }
    rows.iter().for_each(check);
    let row = |name: &str| rows.iter().find(|row| row.case == name).unwrap();
    // The cases do what they are for.
    assert_eq!(row("no strand").strands, 0);
    assert!(row("triangles that collapse").held > 100 && row("triangles that turn over").held > 100);
    assert_eq!(row("a mesh that collapses to a point").held, 3 * 400);
    assert_eq!(row("mirrored").held, 0);
    assert_eq!(row("degenerate triangles at rest").held, 0);
    assert!(rows.iter().all(|row| row.poses == 8));
}
