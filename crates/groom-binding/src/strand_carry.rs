//! Where one strand goes, and how fast.

use glam::{DMat3, DVec3, Vec3};

use crate::RigidMotion;
use crate::deformation_field::{Deformation, DeformationField};

/// A motion that is linear in the pose: where a strand goes, or a rate at which it does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    pub(crate) turn: DMat3,
    pub(crate) to: DVec3,
}

impl Part {
    /// The rate of change of motions, by weights that sum to nothing.
    pub(crate) fn rate(motions: &[RigidMotion; 3], by: [f64; 3]) -> Part {
        let [a, b, c] = motions;
        // By differences, which are nothing where nothing moves and stay exact far from the origin.
        Part {
            turn: (a.turn - b.turn) * by[0] + (c.turn - b.turn) * by[2],
            to: (a.to - b.to) * by[0] + (c.to - b.to) * by[2],
        }
    }
}

/// How the deformation of the mesh acts on the strands of a groom, for `N` motions at once.
#[derive(Clone, Copy)]
pub(crate) struct Bend<'a, const N: usize> {
    pub(crate) field: &'a DeformationField,
    pub(crate) deformations: [&'a Deformation; N],
}

/// One strand on its way: `N` motions of it at once, its place first and then its rates of change.
pub(crate) struct StrandCarry<'a, const N: usize> {
    /// Where the motion takes hold of the strand at rest.
    pub(crate) from: DVec3,
    pub(crate) parts: [Part; N],
    /// The deformation, and what part of it each point follows.
    pub(crate) bend: Option<(Bend<'a, N>, &'a [f32])>,
}

impl<const N: usize> StrandCarry<'_, N> {
    /// Tells `found` where every point goes.
    ///
    /// The rigid part is worked out in f64. What the deformation adds to it is seen from the strand's own root, in
    /// f32: at rest, and under a rigid motion, it is nothing but the rounding of a system of equations in f64.
    #[inline]
    pub(crate) fn each(&self, points: &[Vec3], mut found: impl FnMut(usize, [DVec3; N])) {
        let rigid = |point: DVec3| self.parts.map(|part| part.turn * (point - self.from) + part.to);
        let (Some((bend, weights)), Some(root)) = (&self.bend, points.first()) else {
            for (i, point) in points.iter().enumerate() {
                found(i, rigid(point.as_dvec3()));
            }
            return;
        };
        let root = root.as_dvec3();
        let (inside, unit) = (bend.field.inside(root), bend.field.unit());
        let at_root = bend.field.bend(bend.deformations, inside);
        let mut stretch = [glam::Mat3::ZERO; N];
        for ((stretch, part), deformation) in stretch.iter_mut().zip(&self.parts).zip(bend.deformations) {
            *stretch = (deformation.linear - part.turn).as_mat3();
        }
        for (i, (point, &weight)) in points.iter().zip(*weights).enumerate() {
            let point = point.as_dvec3();
            let mut places = rigid(point);
            if weight > 0.0 {
                let from_root = (point - root).as_vec3();
                let bent = bend.field.bend(bend.deformations, inside + from_root * unit);
                for (k, place) in places.iter_mut().enumerate() {
                    *place += ((stretch[k] * from_root + (bent[k] - at_root[k])) * weight).as_dvec3();
                }
            }
            found(i, places);
        }
    }
}
