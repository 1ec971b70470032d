//! Error against run time, for what can be had more or less exactly.

use std::time::Instant;

use glam::Vec3;
use groom::Groom;
use moving_mesh::Pose;

use crate::{Binding, BindingError, Blend, Carrier, CarryMode, CarryOptions, Moved, Stencil, Surface};

/// One way of carrying: what it costs and how far it is from the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AccuracyRow {
    /// What was varied: anchors, or seconds from pose to pose.
    pub value: f64,
    /// Seconds for one pose, the least of all.
    pub seconds: f64,
    /// Root of the mean squared error over all points and poses, as a part of the reference's measure.
    pub error: f64,
    /// The greatest error, likewise.
    pub worst: f64,
}

/// What the numbers of anchors cost in [`CarryMode::Blended`], and how far the points are from those with `reference`
/// anchors, in sizes of the mesh at rest. A mesh with fewer vertices than `reference` has an anchor at each.
///
/// # Errors
/// [`BindingError`]: as [`Carrier::new`] and [`Carrier::positions`].
pub fn blending_accuracy(
    groom: &Groom,
    binding: &Binding,
    surface: Surface<'_>,
    poses: &[Pose],
    anchors: &[usize],
    reference: usize,
) -> Result<Vec<AccuracyRow>, BindingError> {
    let carried = |anchors: usize| -> Result<(Vec<Vec<Vec3>>, f64), BindingError> {
        let mode = CarryMode::Blended(Blend { anchors, ..Blend::default() });
        let options = CarryOptions { mode, ..CarryOptions::default() };
        let mut carrier = Carrier::new(groom, binding, surface, options)?;
        let mut seconds = f64::INFINITY;
        let all = poses.iter().map(|pose| {
            let (start, mut out) = (Instant::now(), Vec::new());
            carrier.positions(pose, &mut out)?;
            seconds = seconds.min(start.elapsed().as_secs_f64());
            Ok(out)
        });
        Ok((all.collect::<Result<_, BindingError>>()?, seconds))
    };
    let (expected, _) = carried(reference)?;
    let size = surface.size();
    let row = |&anchors: &usize| {
        let (found, seconds) = carried(anchors)?;
        let (error, worst) = errors(found.iter().flatten(), expected.iter().flatten(), size);
        Ok(AccuracyRow { value: anchors as f64, seconds, error, worst })
    };
    anchors.iter().map(row).collect()
}

/// What velocities at `time` from poses `steps` seconds apart are wrong by, in parts of the greatest speed. The reference
/// are poses a hundredth of the least step apart. `pose` poses the mesh at a time; `range` is what [`Stencil::new`] asks
/// for. Rates are taken in the rigid mode.
///
/// # Errors
/// [`BindingError`], or what `pose` says.
pub fn velocity_accuracy<E: From<BindingError>>(
    groom: &Groom,
    binding: &Binding,
    surface: Surface<'_>,
    time: f64,
    range: Option<(f64, f64)>,
    steps: &[f64],
    mut pose: impl FnMut(f64) -> Result<Pose, E>,
) -> Result<Vec<AccuracyRow>, E> {
    let mut velocities = |step: f64| -> Result<(Vec<Vec3>, f64), E> {
        let stencil = Stencil::new(time, step, range)?;
        let [a, b, c] = stencil.times();
        let poses = [pose(a)?, pose(b)?, pose(c)?];
        let mut carrier = Carrier::new(groom, binding, surface, CarryOptions::default())?;
        let (start, mut moved) = (Instant::now(), Moved::default());
        carrier.moved(&stencil, poses.each_ref(), false, &mut moved)?;
        Ok((moved.velocities, start.elapsed().as_secs_f64()))
    };
    let finest = steps.iter().copied().fold(f64::INFINITY, f64::min);
    if !finest.is_finite() {
        return Ok(Vec::new());
    }
    let (expected, _) = velocities(finest / 100.0)?;
    let fastest = expected.iter().map(|v| f64::from(v.length())).fold(0.0, f64::max);
    let mut rows = Vec::new();
    for &step in steps {
        let (found, seconds) = velocities(step)?;
        let (error, worst) = errors(found.iter(), expected.iter(), fastest);
        rows.push(AccuracyRow { value: step, seconds, error, worst });
    }
    Ok(rows)
}

/// Root of the mean square and the greatest of all differences, in parts of `measure`; as they are when that is nothing.
fn errors<'v>(
    found: impl Iterator<Item = &'v Vec3>,
    expected: impl Iterator<Item = &'v Vec3>,
    measure: f64,
) -> (f64, f64) {
    let measure = if measure > 0.0 { measure } else { 1.0 };
    let (mut sum, mut worst, mut count) = (0.0, 0.0_f64, 0_usize);
    for (a, b) in found.zip(expected) {
        let squared = a.as_dvec3().distance_squared(b.as_dvec3());
        (sum, worst, count) = (sum + squared, worst.max(squared), count + 1);
    }
    ((sum / count.max(1) as f64).sqrt() / measure, worst.sqrt() / measure)
}
