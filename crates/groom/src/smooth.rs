//! Smoother strands.

use glam::{DVec3, Vec3};

use crate::{Groom, GroomError};

/// How strands are smoothed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoothing {
    /// How often.
    pub iterations: u32,
    /// How much, 0 (not at all) to 1.
    pub strength: f32,
    /// Whether every segment gets its old length back, from the root outwards: the tip then moves instead
    /// of the strand getting shorter.
    pub keep_length: bool,
}

impl Groom {
    /// Moves every inner point towards the middle of its neighbours, `iterations` times.
    ///
    /// At strength 1 a point becomes a quarter, a half and a quarter of the point before, itself and the
    /// point after (the binomial filter: a zigzag from point to point is gone after one time); at a
    /// lower strength it goes that part of the way. No strength overshoots. Roots stay; tips stay unless
    /// `keep_length` is set, for smoothing alone shortens a wavy strand. Attributes stay with their points.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless the strength lies in 0..=1.
    pub fn smooth(&mut self, smoothing: Smoothing) -> Result<(), GroomError> {
        let Smoothing { iterations, strength, keep_length } = smoothing;
        if !(0.0..=1.0).contains(&strength) {
            return Err(GroomError::argument("smoothing strength", strength, "a number from 0 to 1"));
        }
        if iterations == 0 || strength == 0.0 {
            return Ok(());
        }
        let mut points = Vec::new();
        for strand in 0..self.strand_count() {
            let range = self.strand_range(strand);
            let old = &mut self.positions_mut()[range];
            points.clear();
            points.extend(old.iter().map(|p| p.as_dvec3()));
            for _ in 0..iterations {
                relax(&mut points, f64::from(strength) * 0.25);
            }
            if keep_length {
                restore_lengths(&mut points, old);
            }
            // The root is not computed, and neither is the tip unless it moves.
            let last = old.len() - 1;
            let end = if keep_length { old.len() } else { last };
            for i in 1..end {
                old[i] = points[i].as_vec3();
            }
        }
        Ok(())
    }
}

/// One step of smoothing; every point moves by `part` of the way to both neighbours, from where they were.
fn relax(points: &mut [DVec3], part: f64) {
    let Some(&first) = points.first() else { return };
    let mut before = first;
    for i in 1..points.len().saturating_sub(1) {
        let here = points[i];
        points[i] = here + ((before - here) + (points[i + 1] - here)) * part;
        before = here;
    }
}

/// Gives every segment the length it had, from the root on. A segment that smoothing brought to nothing
/// keeps its old direction.
fn restore_lengths(points: &mut [DVec3], old: &[Vec3]) {
    let Some(&root) = points.first() else { return };
    let (mut smooth, mut end) = (root, root);
    for i in 1..points.len() {
        let was = old[i].as_dvec3() - old[i - 1].as_dvec3();
        let step = points[i] - smooth;
        smooth = points[i];
        let direction = step.try_normalize().or_else(|| was.try_normalize());
        end += direction.unwrap_or(DVec3::ZERO) * was.length();
        points[i] = end;
    }
}
