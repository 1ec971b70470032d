//! All checks of one material, gathered.

mod curves;
mod judged;
mod parameters;
mod tables;

use std::collections::BTreeMap;

use serde::Serialize;

use crate::checks::{FarField, FiveLobe};
use crate::error::VerificationError;
use crate::scatterer::Model;
use crate::verdict::{Check, Verdict};

pub use curves::{Curves, LobeCurve};
pub(crate) use judged::ENERGY_BOUND;
pub use tables::{AlbedoRow, GoodnessRow, LightRow, LobeRow, WeightRow};

/// Name and version of the JSON; the number rises when old readers would misread it.
pub const SCHEMA: &str = "fibre-report/1";

/// How much work a report is worth.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// Directions drawn from each view.
    pub samples: u64,
    /// Seed of everything random.
    pub seed: u64,
    /// Fewer views and no far field: for tests on every change.
    pub quick: bool,
}

impl Default for Settings {
    /// A million samples of seed 1.
    fn default() -> Self {
        Settings { samples: 1_000_000, seed: 1, quick: false }
    }
}

/// Everything that was found out about one material.
#[derive(Debug, Clone, Serialize)]
pub struct Report {
    /// `"fibre-report/1"`.
    pub schema: &'static str,
    /// Name of the material.
    pub title: String,
    /// What explains the numbers: samples, seed, command.
    pub about: BTreeMap<String, String>,
    /// Name and value of every parameter.
    pub parameters: Vec<(String, String)>,
    /// The laws and how they were kept.
    pub checks: Vec<Check>,
    /// What each lobe is and carries.
    pub lobes: Vec<LobeRow>,
    /// What is scattered, by inclination and offset.
    pub albedo: Vec<AlbedoRow>,
    /// The chi-square tests.
    pub goodness: Vec<GoodnessRow>,
    /// Weights of samples.
    pub weights: Vec<WeightRow>,
    /// Estimates of the light of a sky.
    pub light: Vec<LightRow>,
    /// The far field by nodes.
    pub far_field: Vec<FarField>,
    /// The five-lobe model of Yan et al. beside the whole fibre, for fur.
    pub five_lobe: Vec<FiveLobe>,
    /// What is plotted.
    pub curves: Curves,
}

impl Report {
    /// Makes every check. `step` is called after each part of `of` parts: (done, of).
    ///
    /// # Errors
    /// [`VerificationError`] where the material itself is refused; that a check fails is no error.
    pub fn new(
        model: &dyn Model,
        title: &str,
        settings: Settings,
        step: &dyn Fn(u64, u64),
    ) -> Result<Report, VerificationError> {
        let views = tables::Views::of(model, settings.quick);
        let steps = views.steps();
        let done = std::cell::Cell::new(0);
        let tick = || {
            done.set(done.get() + 1);
            step(done.get(), steps);
        };
        let (white, colored) = tables::energies(model, &views, &tick);
        let goodness = tables::goodness_rows(model, &views, settings, &tick);
        let light = tables::light_rows(model, &views, settings, &tick);
        // What comes of many offsets belongs to the near field alone.
        let far_field = if views.near && !settings.quick {
            crate::checks::far_field(model.parameters())?
        } else {
            Vec::new()
        };
        let five_lobe = if settings.quick { Vec::new() } else { crate::checks::five_lobe(model)? };
        tick();
        let checks = judged::checks(model, &white, &colored, &goodness, &light, settings);
        let mut about = BTreeMap::new();
        about.insert("samples a view".to_owned(), settings.samples.to_string());
        about.insert("seed".to_owned(), settings.seed.to_string());
        tick();
        Ok(Report {
            schema: SCHEMA,
            title: title.to_owned(),
            about,
            parameters: parameters::listed(model.parameters()),
            checks,
            lobes: tables::lobe_rows(model),
            albedo: colored.iter().zip(&white).map(AlbedoRow::new).collect(),
            goodness: goodness.iter().map(GoodnessRow::new).collect(),
            weights: goodness.iter().map(WeightRow::new).collect(),
            light: light.iter().map(LightRow::new).collect(),
            far_field,
            five_lobe,
            curves: Curves::of(model),
        })
    }

    /// Whether no law was found broken.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.checks.iter().all(|check| check.verdict != Verdict::Fail)
    }

    /// The report as JSON, ending in a newline. Numbers that are not finite become null.
    ///
    /// # Errors
    /// [`VerificationError::Json`].
    pub fn to_json(&self) -> Result<String, VerificationError> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }
}

impl Report {
    /// The report as one self-contained HTML page: no script, no other file, no network.
    #[must_use]
    pub fn to_html(&self) -> String {
        crate::page::report_html(self)
    }
}
