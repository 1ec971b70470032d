//! Rows are rendered as asked, and show what they say.
#![allow(clippy::unwrap_used)] // also the helpers are test code

use groom_samples::{Options, hair};
use hair_render::{Progress, RenderError, Silent};
use look_sweep::{Row, Stage, SweepError, SweepOptions, page, sweep};

fn stage() -> Stage {
    Stage::new(hair(&Options { strands: 400, points: 6, ..Options::default() }).unwrap()).unwrap()
}

fn small() -> SweepOptions {
    SweepOptions { size: 20, spp: 16, ..SweepOptions::default() }
}

/// The mean colours of a row's pictures.
fn means(stage: &mut Stage, name: &str) -> Vec<[f32; 3]> {
    let mut row = Row::named(&[name.to_owned()]).unwrap().remove(0);
    if name == "medulla-index" {
        // Each medulla costs a table; the ends of this row tell all there is to tell.
        row.cells.remove(1);
    }
    let swept = sweep(stage, &row, &small(), &Silent).unwrap();
    assert_eq!(swept.report.cells.len(), row.cells.len());
    assert_eq!(swept.sheet.height, 20 + 2 * 4);
    assert_eq!(swept.sheet.width as usize, 4 + 24 * row.cells.len());
    swept.report.cells.iter().map(|cell| cell.mean).collect()
}

#[test]
fn every_row_has_a_name_of_its_own_and_cells_that_differ() {
    let rows = Row::all().unwrap();
    for (i, row) in rows.iter().enumerate() {
        assert!(row.cells.len() >= 2, "{}", row.name);
        assert!(rows[..i].iter().all(|other| other.name != row.name));
        assert!(row.name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-'));
        for (k, cell) in row.cells.iter().enumerate() {
            assert!(row.cells[..k].iter().all(|o| o.material != cell.material && o.caption != cell.caption));
        }
    }
    let unknown = Row::named(&["beta".into()]).unwrap_err();
    assert!(unknown.to_string().contains("beta-m"), "{unknown}");
    assert_eq!(Row::named(&["wet".into(), "h".into()]).unwrap().len(), 2);
}

#[test]
fn rows_show_what_they_say() {
    let mut stage = stage();
    let h = means(&mut stage, "h");
    // At the rims nothing is absorbed: grey, and much lighter than through the middle.
    let saturation = |[r, g, b]: [f32; 3]| r.max(g).max(b) / r.min(g).min(b);
    assert!(saturation(h[0]) < 1.2 && saturation(h[1]) > 1.5 && h[0][2] > 2.0 * h[1][2], "{h:?}");
    let layers = means(&mut stage, "cuticle-layers");
    assert!(saturation(layers[1]) < saturation(layers[0]), "more layers are paler: {layers:?}");
    let index = means(&mut stage, "medulla-index");
    assert!(
        index[0][0] > index[0][2] && index[1][2] / index[1][0] > 2.0 * index[0][2] / index[0][0],
        "{index:?}"
    );
    let wet = means(&mut stage, "wet");
    assert!(wet[1][1] < wet[0][1], "wet is darker: {wet:?}");
}

struct Stop;

impl Progress for Stop {
    fn advance(&self, _: u64, _: u64) {}

    fn cancelled(&self) -> bool {
        true
    }
}

#[test]
fn what_cannot_be_is_refused_and_what_is_stopped_stops() {
    let mut stage = stage();
    let row = &Row::named(&["alpha".into()]).unwrap()[0];
    for size in [0, 15, 5000] {
        let refused = sweep(&mut stage, row, &SweepOptions { size, ..small() }, &Silent);
        assert!(matches!(refused, Err(SweepError::Size { .. })), "{size}");
    }
    assert!(sweep(&mut stage, row, &SweepOptions { spp: 0, ..small() }, &Silent).is_err());
    let stopped = sweep(&mut stage, row, &small(), &Stop);
    assert!(matches!(stopped, Err(SweepError::Render(RenderError::Cancelled))));
}

#[test]
fn the_page_names_every_sheet_and_caption() {
    let mut stage = stage();
    let row = &Row::named(&["alpha".into()]).unwrap()[0];
    let report = sweep(&mut stage, row, &SweepOptions { spp: 2, ..small() }, &Silent).unwrap().report;
    let page = page("a <groom> & more", &[report]);
    for words in ["src=\"alpha.png\"", "alpha = 4.5 degrees", "a &lt;groom&gt; &amp; more", "figure 3.11"] {
        assert!(page.contains(words), "{words}");
    }
}
