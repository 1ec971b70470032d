//! From rows to pictures.

use std::time::Instant;

use glam::Vec3;
use hair_render::{
    Backdrop, ContactSheet, Preview, Progress, RenderError, RenderSettings, SheetLayout, TableUse,
    ToneMapping, render, tone_map,
};
use serde::Serialize;

use crate::{Row, Stage, SweepError};

/// Behind the hair: linear grey.
const BACKDROP: f32 = 0.18;
/// Pixels between pictures.
const GAP: u32 = 4;

/// How a sweep is rendered.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepOptions {
    /// Pixels along the edges of each picture, 16..=4096.
    pub size: u32,
    /// Samples a pixel, at least 1.
    pub spp: u32,
    /// Everything random follows from it.
    pub seed: u64,
    /// Threads; one a core when `None`.
    pub threads: Option<usize>,
}

impl Default for SweepOptions {
    fn default() -> Self {
        SweepOptions { size: 256, spp: 64, seed: 0, threads: None }
    }
}

/// A row as a picture, with what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct SweptRow {
    /// Its pictures side by side.
    pub sheet: Preview,
    /// What is known about them.
    pub report: RowReport,
}

/// What is known about a row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RowReport {
    /// The row's name.
    pub name: &'static str,
    /// What changes.
    pub title: &'static str,
    /// The figure of the thesis it stands for.
    pub figure: Option<&'static str>,
    /// What is to be seen.
    pub shows: &'static str,
    /// The pictures, left to right.
    pub cells: Vec<CellReport>,
}

/// What is known about a picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CellReport {
    /// What is written under it.
    pub caption: String,
    /// Seconds spent rendering.
    pub seconds: f64,
    /// Seconds spent on the material before that: the medulla's table, where one had to be built.
    pub material_seconds: f64,
    /// Estimated relative error of a typical pixel; `None` below 2 spp.
    pub relative_error: Option<f64>,
    /// Mean radiance of the hair, red, green, blue.
    pub mean: [f32; 3],
    /// The medulla's table, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub medulla_table: Option<TableUse>,
}

/// Renders a row. All its pictures share camera, light and random numbers: what differs is the material.
///
/// # Errors
/// [`SweepError::Size`]; [`SweepError::Render`], also when `progress` asks to stop.
pub fn sweep(
    stage: &mut Stage,
    row: &Row,
    options: &SweepOptions,
    progress: &dyn Progress,
) -> Result<SweptRow, SweepError> {
    let &SweepOptions { size, spp, seed, threads } = options;
    let refused = SweepError::Size { found: size };
    if !(16..=4096).contains(&size) {
        return Err(refused);
    }
    let count = row.cells.len() as u32;
    let layout = SheetLayout {
        cell: (size, size),
        columns: Some(count.max(1)),
        gap: GAP,
        labels: false,
        caption_lines: 0,
    };
    let mapping = ToneMapping { backdrop: Backdrop::Solid(Vec3::splat(BACKDROP)), ..ToneMapping::default() };
    let Some(mut sheet) = ContactSheet::new(layout, count, [255; 3]) else { return Err(refused) };
    let settings =
        RenderSettings { width: size, height: size, spp, seed, threads, ..RenderSettings::default() };
    let camera = stage.camera(1.0)?;
    let mut cells = Vec::with_capacity(row.cells.len());
    for (number, cell) in (1..).zip(&row.cells) {
        if progress.cancelled() {
            return Err(RenderError::Cancelled.into());
        }
        let start = Instant::now();
        stage.dress(&cell.material)?;
        let material_seconds = start.elapsed().as_secs_f64();
        let frame = render(stage.scene(), &camera, &settings, progress)?;
        sheet.place(number, &tone_map(&frame, &mapping));
        let coverage: f32 = frame.alpha.iter().sum();
        let mean = frame.beauty.iter().sum::<Vec3>() / coverage.max(f32::MIN_POSITIVE);
        cells.push(CellReport {
            caption: cell.caption.clone(),
            seconds: frame.report.seconds,
            material_seconds,
            relative_error: frame.report.relative_error,
            mean: mean.to_array(),
            medulla_table: stage.scene().medulla_tables().next().cloned(),
        });
    }
    let &Row { name, title, figure, shows, .. } = row;
    Ok(SweptRow { sheet: sheet.finish(), report: RowReport { name, title, figure, shows, cells } })
}
