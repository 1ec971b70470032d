//! Every check can fail: models broken on purpose, and what finds them.

use std::collections::BTreeSet;

use fibre_scattering::{Absorption, FibreSample, FurParameters, HairParameters, LobeValues};
use fibre_verification::{
    DoubleScatterer, Landmarks, Model, Report, Scatterer, Settings, Subject, Verdict, View, accuracy,
};
use glam::Vec3;

/// What is broken.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    /// Nothing.
    None,
    /// The density is one percent too large.
    LargeDensity,
    /// The density is a fifth too small.
    SmallDensity,
    /// The residual lobe is forgotten in evaluation: the thesis' three lobes.
    NoResidual,
    /// TT is one percent too bright.
    BrightTt,
    /// The direction that was drawn is tilted, and not the outgoing one before: pbrt-v3's issue 256.
    TiltedAfterwards,
    /// The first number for the inclination is kept away from 0: the lobe's tail is never drawn.
    ClampedNumber,
    /// Lobes are drawn with other chances than the density says.
    OtherChances,
    /// Some draws give nothing, and nobody makes up for them.
    LostDraws,
    /// A sample's values are those of the direction before it was rounded.
    StaleValues,
    /// Light from one side counts more, from the other as much less.
    Sided,
    /// No number near the pole.
    NotANumber,
    /// The direction is rounded to three digits before it is looked up.
    Coarse,
}

struct Mutant {
    inner: Subject,
    upright: Subject,
    fault: Fault,
}

fn fibre() -> FurParameters {
    HairParameters {
        beta_m: 0.2,
        beta_n: 0.4,
        sigma_a: Vec3::new(0.06, 0.1, 0.3),
        alpha: 0.08,
        ..Default::default()
    }
    .into()
}

impl Mutant {
    fn new(fault: Fault) -> Mutant {
        let parameters = fibre();
        let mut upright = parameters;
        upright.hair.alpha = 0.0;
        Mutant {
            inner: Subject::new(&parameters, None).unwrap(),
            upright: Subject::new(&upright, None).unwrap(),
            fault,
        }
    }
}

impl Model for Mutant {
    fn parameters(&self) -> &FurParameters {
        self.inner.parameters()
    }

    fn at(&self, view: View, absorption: Absorption) -> Box<dyn Scatterer + '_> {
        Box::new(MutantScatter {
            inner: self.inner.at(view, absorption),
            upright: self.upright.at(view, absorption),
            fault: self.fault,
            alpha: self.parameters().hair.alpha,
        })
    }

    fn double_at(&self, view: View, absorption: Absorption) -> Option<Box<dyn DoubleScatterer + '_>> {
        self.inner.double_at(view, absorption)
    }

    fn landmarks(&self, view: View) -> Landmarks {
        self.inner.landmarks(view)
    }

    fn upright(&self) -> Option<Box<dyn Model + '_>> {
        self.inner.upright()
    }
}

struct MutantScatter<'a> {
    inner: Box<dyn Scatterer + 'a>,
    upright: Box<dyn Scatterer + 'a>,
    fault: Fault,
    alpha: f32,
}

impl Scatterer for MutantScatter<'_> {
    fn evaluate_with_pdf(&self, wi: Vec3) -> (LobeValues, f32) {
        let coarse = |wi: Vec3| ((wi * 1000.0).round() / 1000.0).normalize();
        let (mut values, mut pdf) =
            self.inner.evaluate_with_pdf(if self.fault == Fault::Coarse { coarse(wi) } else { wi });
        match self.fault {
            Fault::LargeDensity => pdf *= 1.01,
            Fault::SmallDensity => pdf *= 0.8,
            Fault::NoResidual => values.0[3] = Vec3::ZERO,
            Fault::BrightTt => values.0[1] *= 1.01,
            Fault::Sided => values = values * if wi.z > 0.0 { 1.02 } else { 0.98 },
            Fault::NotANumber if wi.x > 0.95 => values.0[0].y = f32::NAN,
            _ => {}
        }
        (values, pdf)
    }

    fn sample(&self, mut u: [f32; 4]) -> Option<FibreSample> {
        let mut sample = match self.fault {
            Fault::TiltedAfterwards => {
                let mut sample = self.upright.sample(u)?;
                let turn = [2.0, -1.0, -4.0, 0.0, 0.0][sample.lobe.index()] * self.alpha;
                let (sin, across) = (sample.wi.x, sample.wi.y.hypot(sample.wi.z));
                let theta = sin.atan2(across) - turn;
                sample.wi = Vec3::new(
                    theta.sin(),
                    sample.wi.y / across * theta.cos(),
                    sample.wi.z / across * theta.cos(),
                );
                sample
            }
            Fault::ClampedNumber => {
                u[1] = u[1].min(0.98);
                self.inner.sample(u)?
            }
            Fault::OtherChances => {
                u[0] = u[0].powf(1.03).min(0.999_999);
                self.inner.sample(u)?
            }
            Fault::LostDraws if u[3] < 0.02 => return None,
            _ => self.inner.sample(u)?,
        };
        let before = sample.wi + Vec3::new(0.0, 1e-5, 0.0);
        (sample.values, sample.pdf) = self.evaluate_with_pdf(sample.wi);
        if self.fault == Fault::StaleValues {
            sample.values = self.evaluate_with_pdf(before.normalize()).0;
        }
        Some(sample)
    }

    fn albedo(&self) -> [Vec3; 5] {
        self.inner.albedo()
    }
}

/// The checks that fail, by the first words of their names.
fn failing(fault: Fault) -> BTreeSet<String> {
    let settings = Settings { samples: 200_000, seed: 1, quick: true };
    let report = Report::new(&Mutant::new(fault), "mutant", settings, &|_, _| {}).unwrap();
    let failed = report.checks.iter().filter(|check| check.verdict == Verdict::Fail);
    assert_eq!(report.passes(), failed.clone().count() == 0);
    failed.map(|check| check.name.clone()).collect()
}

#[test]
fn every_fault_is_found_by_the_check_that_is_there_for_it() {
    assert_eq!(failing(Fault::None), BTreeSet::new());
    for (fault, expected) in [
        (Fault::LargeDensity, &["Density integrates", "Mean weight", "Light is the same"][..]),
        (Fault::SmallDensity, &["No sample weighs more", "Density integrates"]),
        (Fault::NoResidual, &["White furnace, single", "Every lobe"]),
        (Fault::BrightTt, &["White furnace, single", "Every lobe"]),
        (Fault::TiltedAfterwards, &["Samples follow"]),
        (Fault::ClampedNumber, &["Samples follow"]),
        (Fault::OtherChances, &["Samples follow"]),
        (Fault::LostDraws, &["Mean weight", "Light is the same"]),
        (Fault::StaleValues, &["A sample is what evaluation says"]),
        (Fault::Sided, &["Mirrored offset"]),
        (Fault::NotANumber, &["White furnace, single", "Every lobe", "Every number"]),
    ] {
        let found = failing(fault);
        for name in expected {
            assert!(found.iter().any(|found| found.starts_with(name)), "{fault:?}: no `{name}` in {found:?}");
        }
    }
}

#[test]
fn coarse_arithmetic_is_found() {
    let view = View::degrees(20.0, 0.3);
    let error = |fault| {
        let mutant = Mutant::new(fault);
        accuracy(&mutant, view, mutant.absorption(), 1000, 1).unwrap().value
    };
    assert!(error(Fault::None) < 1e-5 && error(Fault::Coarse) > 1e-3);
}
