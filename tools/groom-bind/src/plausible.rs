//! Whether groom and mesh lie on each other at all, and what to try when they do not.

use anyhow::Result;
use glam::Vec3;
use groom::{Groom, UpAxis};
use groom_binding::{BindOptions, BindReport, Binding, Surface};

use crate::args::Aligning;

/// Roots that are farther off than this part of the mesh, half of them, are not meant so.
const FAR: f64 = 0.1;

/// A remedy whose roots span less than this part of the mesh has shrunk them to where distance says nothing.
const SHRUNK: f64 = 0.02;

/// Roots that remedies are tried on, about.
const TRIED: usize = 200;

/// Factors between units that are in use: metres, centimetres, millimetres, inches, tenths of an inch, feet.
const FACTORS: [f64; 13] = [
    1.0,
    0.01,
    100.0,
    0.001,
    1000.0,
    0.1,
    10.0,
    0.0254,
    1.0 / 0.0254,
    0.002_54,
    1.0 / 0.002_54,
    0.3048,
    3.28084,
];

/// The axes a groom was turned between.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turned {
    pub(crate) from: UpAxis,
    pub(crate) to: UpAxis,
}

/// A warning when groom and mesh are obviously in different units or axes, with the hint what to try.
pub(crate) fn check(
    groom: &Groom,
    surface: &Surface<'_>,
    report: &BindReport,
    turned: Turned,
    args: &Aligning,
) -> Result<Option<String>> {
    let (size, Some(median)) = (report.mesh_size, report.distance_at(0.5)) else { return Ok(None) };
    if median <= FAR * size {
        return Ok(None);
    }
    let roots = roots(groom);
    let told = format!(
        "half of the roots are {median:.4} and more off the mesh, which is {size:.4} large: roots lie in {}, the \
         mesh in {}",
        Bounds::of(roots.iter().copied()),
        Bounds::of(surface.rest.positions.iter().map(|p| p.as_vec3()))
    );
    let placed = args.matrix.is_some() || args.translate.is_some();
    let remedy = if placed { None } else { remedy(&roots, surface, turned, size)? };
    let hint = match remedy {
        Some(Remedy { other_up, factor, median }) if median <= FAR * size => {
            let up = other_up.then(|| match turned.from {
                UpAxis::Y => "--up z".to_owned(),
                UpAxis::Z => "--up y".to_owned(),
            });
            let scale = (factor != 1.0).then(|| format!("--scale {}", factor * args.scale.unwrap_or(1.0)));
            let words: Vec<String> = up.into_iter().chain(scale).collect();
            format!("try {} (half of them are then within {median:.4})", words.join(" "))
        }
        _ => "try --scale, --up, --translate or --matrix".into(),
    };
    Ok(Some(format!("{told}; {hint}")))
}

/// Some of the roots.
fn roots(groom: &Groom) -> Vec<Vec3> {
    let every = groom.strand_count().div_ceil(TRIED).max(1);
    groom.strands().step_by(every).filter_map(|strand| strand.first().copied()).collect()
}

/// Another axis and unit for the groom.
struct Remedy {
    other_up: bool,
    factor: f64,
    /// What is left of the roots' distance.
    median: f64,
}

/// The axis and unit that bring the roots nearest to the mesh.
fn remedy(roots: &[Vec3], surface: &Surface<'_>, turned: Turned, size: f64) -> Result<Option<Remedy>> {
    let other = if turned.from == UpAxis::Y { UpAxis::Z } else { UpAxis::Y };
    let turn = |root: Vec3| other.rotate(turned.to.rotate(root, turned.from), turned.to);
    let choices = FACTORS
        .iter()
        .flat_map(|&factor| [(false, factor), (true, factor)])
        .filter(|&(_, factor)| f64::from(Bounds::of(roots.iter().copied()).size()) * factor > SHRUNK * size);
    let choices: Vec<(bool, f64)> = choices.collect();
    let all: Vec<Vec3> = choices
        .iter()
        .flat_map(|&(other_up, factor)| {
            roots.iter().map(move |&root| if other_up { turn(root) } else { root } * factor as f32)
        })
        .collect();
    // One binding of all of them: the mesh is sorted into a tree once.
    let groom = Groom::new((0..=all.len() as u32).collect(), all)?;
    let (binding, _) = Binding::new(&groom, surface, &BindOptions::default())?;
    let tried = choices.into_iter().zip(binding.roots().chunks(roots.len().max(1)));
    let remedies = tried.map(|((other_up, factor), roots)| {
        let mut distances: Vec<f64> = roots.iter().map(|root| root.height.abs()).collect();
        distances.sort_unstable_by(f64::total_cmp);
        Remedy {
            other_up,
            factor,
            median: distances.get(distances.len() / 2).copied().unwrap_or(f64::INFINITY),
        }
    });
    Ok(remedies.min_by(|a, b| a.median.total_cmp(&b.median)))
}

/// A box, for people to read.
struct Bounds {
    low: Vec3,
    high: Vec3,
}

impl Bounds {
    fn of(points: impl Iterator<Item = Vec3>) -> Bounds {
        let empty = Bounds { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };
        points.fold(empty, |Bounds { low, high }, p| Bounds { low: low.min(p), high: high.max(p) })
    }

    fn size(&self) -> f32 {
        self.low.distance(self.high)
    }
}

impl std::fmt::Display for Bounds {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Bounds { low, high } = self;
        write!(f, "({:.3} {:.3} {:.3})..({:.3} {:.3} {:.3})", low.x, low.y, low.z, high.x, high.y, high.z)
    }
}
