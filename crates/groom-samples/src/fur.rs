//! Fur on any surface.

use glam::DVec3;
use groom::{Attribute, Domain, Groom, Values, names, random};

use crate::scatter::{self, Root};
use crate::thickness::{PROBES, thickness};
use crate::trigonometry::{cos, sin};
use crate::tufts::Tufts;
use crate::{FurOptions, FurSurface, SampleError, dress};

/// Strands that share a tuft, about.
const TUFT: usize = 24;

/// A body this many strand lengths thick carries its fur at full length.
const THICK: f64 = 4.0;

/// How many times over the strands would cover the skin, laid flat side by side.
const COVER: f64 = 3.0;

/// A coat of fur on `surface`: roots spread evenly by area, each strand rising from the skin and leaning over to
/// [`FurOptions::towards`], with a `radius` at each point that tapers to the tip. The unit and the axis are those of
/// the surface, which the caller sets on the groom. The same input gives the same bits on every machine.
///
/// ```
/// use glam::dvec3;
/// use groom_samples::{FurOptions, FurSurface, fur_on};
///
/// let positions = [dvec3(0.0, 0.0, 0.0), dvec3(0.0, 0.0, 1.0), dvec3(1.0, 0.0, 0.0)];
/// let meadow = FurSurface { positions: &positions, triangles: &[[0, 1, 2]], normals: None };
/// let fur = fur_on(&meadow, &FurOptions { strands: 50, ..FurOptions::default() })?;
/// assert_eq!(fur.strand_count(), 50);
/// # Ok::<(), groom_samples::SampleError>(())
/// ```
///
/// # Errors
/// [`SampleError::Option`] and [`SampleError::Number`] for options out of range, [`SampleError::Surface`] for a surface
/// without area or with numbers that do not hold together.
pub fn fur_on(surface: &FurSurface<'_>, options: &FurOptions) -> Result<Groom, SampleError> {
    options.check()?;
    scatter::check(surface)?;
    let vertex_normals = scatter::normals(surface);
    let (roots, area) = scatter::roots(surface, &vertex_normals, options.strands, options.seed)?;
    let coat = Coat { options, length: f64::from(options.length) * diagonal(surface) };

    let centres: Vec<Root> = roots.iter().skip(TUFT / 2).step_by(TUFT).copied().collect();
    let spacing = (area / centres.len().max(1) as f64).sqrt();
    let tufts = Tufts::new(&centres, 1.5 * spacing);
    // Tufts draw their chances from ids no strand has.
    let shares = thin_places(surface, &centres, &coat);
    let tuft_paths: Vec<Vec<DVec3>> = (0..)
        .zip(centres.iter().zip(&shares))
        .map(|(i, (root, &share))| coat.path(root, u32::MAX - i, share))
        .collect();

    let mut positions = Vec::with_capacity(roots.len() * options.points as usize);
    for (id, root) in (0..).zip(&roots) {
        let tuft = tufts.closest(root);
        let share = coat.share(id) * tuft.map_or(1.0, |tuft| shares[tuft]);
        let mut path = coat.path(root, id, share);
        if let Some(tuft) = tuft {
            coat.gather(&mut path, &tuft_paths[tuft], share);
        }
        positions.extend(path.iter().map(|point| point.as_vec3()));
    }
    let offsets = (0..=options.strands).map(|i| i * options.points).collect();
    let mut groom = Groom::new(offsets, positions)?;
    let root_radius =
        (COVER * area / (2.0 * f64::from(options.strands) * coat.length)).min(0.02 * coat.length);
    let taper =
        groom.along_strands().into_iter().map(|t| root_radius as f32 * (1.0 - 0.85 * t * t)).collect();
    groom.set_attribute(names::RADIUS, Attribute { domain: Domain::Vertex, values: Values::Float(taper) })?;
    if options.color {
        dress::color(&mut groom, options.seed)?;
    }
    Ok(groom)
}

/// What part of its length the fur of each tuft has: less where the body is thin.
fn thin_places(surface: &FurSurface<'_>, centres: &[Root], coat: &Coat<'_>) -> Vec<f64> {
    let part = f64::from(coat.options.thin);
    if part == 0.0 {
        return vec![1.0; centres.len()];
    }
    let probes: Vec<Root> = centres.iter().step_by(centres.len().div_ceil(PROBES).max(1)).copied().collect();
    let thickness = thickness(surface, &probes);
    // The probes are as evenly spread as the tufts; each tuft takes the nearest three, so that no edge shows.
    let share = |root: &Root| {
        let mut nearest = [(f64::INFINITY, 1.0); 3];
        for (probe, &thickness) in probes.iter().zip(&thickness) {
            let facing = if probe.normal.dot(root.normal) > 0.0 { 1.0 } else { 16.0 };
            let found = (probe.place.distance_squared(root.place) * facing, thickness);
            if found.0 < nearest[2].0 {
                nearest[2] = found;
                nearest.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            }
        }
        let room = |&(_, thickness): &(f64, f64)| (thickness / (THICK * coat.length)).min(1.0);
        1.0 - part * (1.0 - nearest.iter().map(room).sum::<f64>() / 3.0)
    };
    centres.iter().map(share).collect()
}

/// What all strands of a coat share.
struct Coat<'a> {
    options: &'a FurOptions,
    /// Length of the longest strand, in the surface's unit.
    length: f64,
}

impl Coat<'_> {
    /// How long strand `id` is, as a part of the longest.
    fn share(&self, id: u32) -> f64 {
        1.0 - f64::from(self.options.variation * random(self.options.seed, id, "fur length"))
    }

    /// The points of one strand: up from the skin, then over to where the coat lies.
    fn path(&self, root: &Root, id: u32, share: f64) -> Vec<DVec3> {
        let chance = |purpose| f64::from(random(self.options.seed, id, purpose));
        let normal = root.normal;
        // What is left of the direction on the skin: short where the skin faces along it, so that fur parts there
        // smoothly instead of turning from one place to the next.
        let towards = self.options.towards.as_dvec3().normalize_or_zero();
        let along = towards - normal * towards.dot(normal);
        let side = normal.any_orthonormal_vector();
        let other = normal.cross(side);
        let stray = (side * (chance("fur x") - 0.5) + other * (chance("fur y") - 0.5)) * 0.16;
        let lean = f64::from(self.options.lean) * (0.9 + 0.2 * chance("fur lean")).min(1.0);

        let segments = self.options.points - 1;
        let length = self.length * share;
        let step = length / f64::from(segments);
        let turn = chance("fur turn");
        let mut point = root.place;
        let mut points = vec![point];
        for i in 1..=segments {
            let middle = (f64::from(i) - 0.5) / f64::from(segments);
            let over = lean * (0.55 + 0.45 * middle);
            let direction = normal * (1.0 - over) + along * over + stray;
            point += direction.normalize_or(normal) * step;
            let t = f64::from(i) / f64::from(segments);
            let angle = std::f64::consts::TAU * (turn + 1.5 * t);
            let wind = side * f64::from(cos(angle)) + other * f64::from(sin(angle));
            points.push(point + wind * (f64::from(self.options.curl) * length * t));
        }
        points
    }

    /// Bends a strand to its tuft, the more the nearer to the tip; less to one that is farther than the strand reaches.
    fn gather(&self, path: &mut [DVec3], tuft: &[DVec3], share: f64) {
        let (Some(root), Some(middle)) = (path.first(), tuft.first()) else { return };
        let reach = (0.5 * self.length * share / root.distance(*middle).max(f64::MIN_POSITIVE)).min(1.0);
        let clump = f64::from(self.options.clump) * reach;
        let last = (path.len().max(2) - 1) as f64;
        for (i, (point, middle)) in path.iter_mut().zip(tuft).enumerate() {
            let t = i as f64 / last;
            *point = point.lerp(*middle, clump * t * t);
        }
    }
}

fn diagonal(surface: &FurSurface<'_>) -> f64 {
    let used = || surface.triangles.iter().flatten().map(|&v| surface.positions[v as usize]);
    let low = used().fold(DVec3::INFINITY, DVec3::min);
    let high = used().fold(DVec3::NEG_INFINITY, DVec3::max);
    (high - low).length()
}
