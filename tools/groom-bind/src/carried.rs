//! The strands, frame after frame.

use anyhow::{Context, Result};
use glam::{DVec3, Vec3};
use groom::Groom;
use groom_binding::{Binding, Carrier, CarryReport, Moved, Stencil};
use groom_formats::Frame;
use moving_mesh::{MovingMesh, Pose};

use crate::args::Args;
use crate::events::Events;
use crate::root_error::root_error;
use crate::timeline::Timeline;

/// What is written of each frame.
#[derive(Clone, Debug)]
pub(crate) struct Wanted {
    pub(crate) velocities: bool,
    pub(crate) accelerations: bool,
    /// When in a frame its points are taken, in frames from it.
    pub(crate) offsets: Vec<f64>,
    /// How far before and after it the poses lie of which velocities are taken, in frames.
    pub(crate) reach: f64,
}

impl Wanted {
    pub(crate) fn of(args: &Args, velocities: bool) -> Wanted {
        Wanted {
            velocities: velocities && args.shutter.velocities(),
            accelerations: velocities && args.shutter.accelerations,
            offsets: args.shutter.offsets(),
            reach: args.shutter.reach(),
        }
    }
}

/// Carries a groom through the frames, one in memory at a time.
pub(crate) struct Carried<'a> {
    mesh: &'a MovingMesh,
    carrier: Carrier<'a>,
    timeline: Timeline,
    wanted: Wanted,
    /// The mesh around a time.
    poses: [Pose; 3],
    /// Which of them is of that time.
    at: usize,
    moved: Moved,
    origin: DVec3,
    /// What roots are held against, when that is wanted.
    measured: Option<(&'a Groom, &'a Binding)>,
}

impl<'a> Carried<'a> {
    /// `origin` is the carrier's.
    pub(crate) fn new(
        mesh: &'a MovingMesh,
        carrier: Carrier<'a>,
        timeline: Timeline,
        wanted: Wanted,
        origin: DVec3,
    ) -> Carried<'a> {
        let poses = std::array::from_fn(|_| Pose::default());
        Carried {
            mesh,
            carrier,
            timeline,
            wanted,
            poses,
            at: 0,
            moved: Moved::default(),
            origin,
            measured: None,
        }
    }

    /// Has roots held against the place they are bound to, in every frame.
    pub(crate) fn measuring(mut self, groom: &'a Groom, binding: &'a Binding) -> Carried<'a> {
        self.measured = Some((groom, binding));
        self
    }

    /// Every frame in turn, sub-frames included; what happens on the way is told to `events`.
    pub(crate) fn frames(mut self, events: &'a Events) -> impl Iterator<Item = Result<Frame>> + 'a {
        let offsets = self.wanted.offsets.clone();
        let times = self.timeline.frames().flat_map(move |frame| {
            let offsets = offsets.clone();
            offsets.into_iter().map(move |offset| (frame, frame + offset))
        });
        times.map(move |(frame, time)| {
            let (carried, report) = self.at(time).with_context(|| format!("frame {time}"))?;
            events.add(frame, &report, self.root_error(&carried.positions));
            Ok(carried)
        })
    }

    /// Of the frame that was carried last.
    fn root_error(&self, positions: &[Vec3]) -> Option<f64> {
        let (groom, binding) = self.measured?;
        let pose = self.poses.get(self.at)?;
        Some(root_error(groom, binding, self.mesh.triangles(), pose, positions, self.origin))
    }

    fn at(&mut self, time: f64) -> Result<(Frame, CarryReport)> {
        let seconds = self.timeline.seconds(time);
        if !self.wanted.velocities {
            self.at = 0;
            self.mesh.pose_into(seconds, &mut self.poses[0])?;
            let mut positions = Vec::new();
            let report = self.carrier.positions(&self.poses[0], &mut positions)?;
            return Ok((Frame { time, positions, velocities: None, accelerations: None }, report));
        }
        let reach = self.timeline.seconds(self.wanted.reach);
        let stencil = Stencil::new(seconds, reach, self.mesh.time_range())?;
        for (pose, time) in self.poses.iter_mut().zip(stencil.times()) {
            self.mesh.pose_into(time, pose)?;
        }
        self.at = stencil.at();
        let poses = self.poses.each_ref();
        let report = self.carrier.moved(&stencil, poses, self.wanted.accelerations, &mut self.moved)?;
        let Moved { positions, velocities, accelerations } = std::mem::take(&mut self.moved);
        Ok((Frame { time, positions, velocities: Some(velocities), accelerations }, report))
    }
}
