//! Strands on their surface, pose after pose.

use glam::{DVec3, Vec3};
use groom::Groom;
use moving_mesh::Pose;

use crate::deformation_field::{Deformation, DeformationField};
use crate::jumps::{self, Deformations};
use crate::keep_out::{KeepOut, Pushed};
use crate::strand_blocks::each_strand;
use crate::strand_carry::{Bend, Part, StrandCarry};
use crate::{
    Binding, BindingError, CarryMode, CarryOptions, CarryReport, Moved, RigidMotion, RootFrame, RootFrames,
    Stencil, Surface, segment_lengths,
};

/// Carries a groom with the mesh it is bound to.
///
/// A triangle that has collapsed keeps the frame of the pose before, so poses are to be given in the order of
/// time; all else depends on the pose alone. Stencils count by the first of their poses, which alone is kept: they may
/// overlap, and no frame is taken from a time after. The same poses give the same bits, whatever the number of threads.
#[derive(Clone, Debug)]
pub struct Carrier<'a> {
    groom: &'a Groom,
    binding: &'a Binding,
    frames: RootFrames<'a>,
    options: CarryOptions,
    bending: Option<Bending>,
    keep_out: Option<KeepOut<'a>>,
}

/// What blending needs beside the frames.
#[derive(Clone, Debug)]
struct Bending {
    field: DeformationField,
    /// What part of the deformation each point follows.
    weights: Vec<f32>,
    restore_lengths: bool,
}

/// What a pose comes to.
struct Still {
    frames: Vec<RootFrame>,
    mirrored: bool,
    held: usize,
    deformation: Option<Deformation>,
}

impl<'a> Carrier<'a> {
    /// A carrier of `groom`, which is bound to `surface` by `binding`, at the rest pose.
    ///
    /// # Errors
    /// [`BindingError`]: an option out of range, or a groom or surface that `binding` is not of.
    pub fn new(
        groom: &'a Groom,
        binding: &'a Binding,
        surface: Surface<'a>,
        options: CarryOptions,
    ) -> Result<Self, BindingError> {
        options.check()?;
        binding.check(groom, &surface)?;
        let frames = RootFrames::new(binding, surface)?;
        let bending = match options.mode {
            CarryMode::Rigid => None,
            CarryMode::Blended(blend) => {
                let field = DeformationField::new(&surface.rest.positions, surface.triangles, blend.anchors);
                field.map(|field| {
                    let weights = groom.along_strands().into_iter().map(|t| t.powf(blend.power)).collect();
                    Bending { field, weights, restore_lengths: blend.restore_lengths }
                })
            }
        };
        let keep_out = options.keep_out.map(|distance| KeepOut::new(surface, distance));
        Ok(Carrier { groom, binding, frames, options, bending, keep_out })
    }

    /// Back to the rest pose, as if no pose had been.
    pub fn reset(&mut self) {
        self.frames.reset();
    }

    /// The points at `pose`, relative to [`CarryOptions::origin`], in the order of the groom.
    ///
    /// # Errors
    /// [`BindingError::Invalid`] for a pose of another mesh or with a vertex that is not finite; `out` is then as it
    /// was.
    pub fn positions(&mut self, pose: &Pose, out: &mut Vec<Vec3>) -> Result<CarryReport, BindingError> {
        self.frames.follow(pose)?;
        let deformation = self.deformation(pose);
        let mut report = CarryReport {
            held: self.frames.held(),
            mirrored: self.frames.mirrored(),
            anchors: self.anchors(),
            ..CarryReport::default()
        };
        out.resize(self.groom.point_count(), Vec3::ZERO);
        let origin = self.options.origin;
        if self.is_linear() {
            let deformations = deformation.as_ref().map(|deformation| [deformation]);
            let parts = |motion: RigidMotion| [Part { turn: motion.turn, to: motion.to - origin }];
            let rounded = |place: DVec3| place.as_vec3();
            self.go([out], rounded, |strand| (parts(self.frames.motion(strand)), deformations));
        } else {
            let still = Still {
                frames: self.frames.frames().to_vec(),
                mirrored: report.mirrored,
                held: report.held,
                deformation,
            };
            let (places, pushed) = self.bent(&still, pose);
            report.count(pushed);
            each_strand(self.groom, [out], |strand, [own]| {
                let places = &places[self.groom.strand_range(strand)];
                own.iter_mut().zip(places).for_each(|(own, &place)| *own = (place - origin).as_vec3());
            });
        }
        Ok(report)
    }

    /// The points at the time of `stencil` and how fast they move, from the poses at [`Stencil::times`]; with how
    /// their velocities change, if `accelerations`.
    ///
    /// Rates are differences of motions in f64, not of rounded points, wherever the carry is linear in the motions; where
    /// lengths are restored or strands kept out of the mesh they are differences of points in f64. A pose whose mirror
    /// image the next one is is one that strands jump between.
    ///
    /// # Errors
    /// [`BindingError::Invalid`] for a pose of another mesh or with a vertex that is not finite; `out` is then as it
    /// was.
    pub fn moved(
        &mut self,
        stencil: &Stencil,
        poses: [&Pose; 3],
        accelerations: bool,
        out: &mut Moved,
    ) -> Result<CarryReport, BindingError> {
        let first = self.still(poses[0])?;
        // The next stencil may begin before this one ends.
        let others = self.still(poses[1]).and_then(|second| Ok([second, self.still(poses[2])?]));
        self.frames.go_back(&first.frames, first.mirrored, first.held);
        let [second, third] = others?;
        let stills = [first, second, third];
        let at = stencil.at();
        let mut report = CarryReport {
            held: stills[at].held,
            mirrored: stills[at].mirrored,
            anchors: self.anchors(),
            ..CarryReport::default()
        };
        let kinds: Vec<usize> =
            (0..self.groom.strand_count()).map(|strand| self.kind(&stills, stencil, strand)).collect();
        report.teleported = kinds.iter().filter(|&&kind| kind != 0).count();
        out.prepare(self.groom.point_count(), accelerations);
        if self.is_linear() {
            self.linear(&stills, stencil, &kinds, out);
        } else {
            let [a, b, c] = [0, 1, 2].map(|i| self.bent(&stills[i], poses[i]));
            report.count([&a, &b, &c][at].1);
            self.differences([&a.0, &b.0, &c.0], stencil, &kinds, out);
        }
        Ok(report)
    }
}

impl Carrier<'_> {
    /// Whether nothing happens to points but what is linear in the motions of the mesh.
    fn is_linear(&self) -> bool {
        self.keep_out.is_none() && !self.bending.as_ref().is_some_and(|bending| bending.restore_lengths)
    }

    fn anchors(&self) -> usize {
        self.bending.as_ref().map_or(0, |bending| bending.field.anchor_count())
    }

    fn deformation(&self, pose: &Pose) -> Option<Deformation> {
        self.bending.as_ref().map(|bending| bending.field.at(&pose.positions))
    }

    fn still(&mut self, pose: &Pose) -> Result<Still, BindingError> {
        self.frames.follow(pose)?;
        Ok(Still {
            frames: self.frames.frames().to_vec(),
            mirrored: self.frames.mirrored(),
            held: self.frames.held(),
            deformation: self.deformation(pose),
        })
    }

    fn motion(&self, still: &Still, strand: usize) -> RigidMotion {
        self.binding.roots()[strand].rest.motion_to(&still.frames[strand], still.mirrored)
    }

    /// Which of [`jumps::rates`] is a strand's.
    fn kind(&self, stills: &[Still; 3], stencil: &Stencil, strand: usize) -> usize {
        let [a, b, c] = stills;
        let roots = [a, b, c].map(|still| still.frames[strand].origin);
        let [first, second] = jumps::jumps(roots, stencil.step(), self.options.teleport);
        let jumps = [first || a.mirrored != b.mirrored, second || b.mirrored != c.mirrored];
        jumps::kind(stencil.at(), jumps)
    }

    /// Takes every strand along by `N` motions, which `by` names with the deformations of the space around it.
    fn go<'d, T: Send, const N: usize>(
        &self,
        out: [&mut [T]; N],
        rounded: impl Fn(DVec3) -> T + Sync,
        by: impl Fn(usize) -> ([Part; N], Option<[&'d Deformation; N]>) + Sync,
    ) {
        each_strand(self.groom, out, |strand, mut own| {
            let (parts, deformations) = by(strand);
            let bend = self.bending.as_ref().zip(deformations).map(|(bending, deformations)| {
                let weights = &bending.weights[self.groom.strand_range(strand)];
                (Bend { field: &bending.field, deformations }, weights)
            });
            let carry = StrandCarry { from: self.binding.roots()[strand].rest.origin, parts, bend };
            carry.each(self.groom.strand(strand), |i, places| {
                for (own, place) in own.iter_mut().zip(places) {
                    own[i] = rounded(place);
                }
            });
        });
    }

    /// Positions and rates that are linear in the motions.
    fn linear(&self, stills: &[Still; 3], stencil: &Stencil, kinds: &[usize], out: &mut Moved) {
        let (at, rates) = (stencil.at(), jumps::rates(stencil));
        let [a, b, c] = stills;
        let deformations = match [a, b, c].map(|still| still.deformation.as_ref()) {
            [Some(a), Some(b), Some(c)] => Some(Deformations::new([a, b, c], at, &rates)),
            _ => None,
        };
        let parts = |strand: usize| {
            let motions = [a, b, c].map(|still| self.motion(still, strand));
            let rate = &rates[kinds[strand]];
            let place = Part { turn: motions[at].turn, to: motions[at].to - self.options.origin };
            [place, Part::rate(&motions, rate.first), Part::rate(&motions, rate.second)]
        };
        let bends = |strand: usize| {
            let kind = kinds[strand];
            deformations.as_ref().map(|d| [&d.at, &d.first[kind], &d.second[kind]])
        };
        let rounded = |place: DVec3| place.as_vec3();
        match &mut out.accelerations {
            Some(accelerations) => {
                let out = [&mut out.positions[..], &mut out.velocities, accelerations];
                self.go(out, rounded, |strand| (parts(strand), bends(strand)));
            }
            None => self.go([&mut out.positions[..], &mut out.velocities], rounded, |strand| {
                let [place, velocity, _] = parts(strand);
                ([place, velocity], bends(strand).map(|[at, first, _]| [at, first]))
            }),
        }
    }

    /// The points at a pose, with what is not linear done to them, in the mesh's own space.
    fn bent(&self, still: &Still, pose: &Pose) -> (Vec<DVec3>, Pushed) {
        let mut places = vec![DVec3::ZERO; self.groom.point_count()];
        let deformations = still.deformation.as_ref().map(|deformation| [deformation]);
        self.go(
            [&mut places],
            |place| place,
            |strand| {
                let motion = self.motion(still, strand);
                ([Part { turn: motion.turn, to: motion.to }], deformations)
            },
        );
        if self.bending.as_ref().is_some_and(|bending| bending.restore_lengths) {
            each_strand(self.groom, [&mut places], |strand, [own]| {
                segment_lengths::restore(own, self.groom.strand(strand));
            });
        }
        let pushed = match &self.keep_out {
            Some(keep_out) => keep_out.push(self.groom, pose, &mut places),
            None => Pushed::default(),
        };
        (places, pushed)
    }

    /// Positions and rates as differences of points.
    fn differences(&self, places: [&[DVec3]; 3], stencil: &Stencil, kinds: &[usize], out: &mut Moved) {
        let (at, rates) = (stencil.at(), jumps::rates(stencil));
        let mut none = Vec::new();
        let accelerations = match &mut out.accelerations {
            Some(accelerations) => accelerations,
            None => {
                none.resize(self.groom.point_count(), Vec3::ZERO);
                &mut none
            }
        };
        let out = [&mut out.positions[..], &mut out.velocities, accelerations];
        each_strand(self.groom, out, |strand, [positions, velocities, accelerations]| {
            let rate = &rates[kinds[strand]];
            let range = self.groom.strand_range(strand);
            for (i, point) in range.enumerate() {
                let three = places.map(|places| places[point]);
                let (before, after) = (three[0] - three[1], three[2] - three[1]);
                let sum = |by: [f64; 3]| (before * by[0] + after * by[2]).as_vec3();
                positions[i] = (three[at] - self.options.origin).as_vec3();
                velocities[i] = sum(rate.first);
                accelerations[i] = sum(rate.second);
            }
        });
    }
}
