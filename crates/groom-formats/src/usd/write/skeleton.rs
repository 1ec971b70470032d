//! Joints as UsdSkel has them: a skeleton, its animation, and what binds the curves to it.

use std::collections::BTreeSet;

use glam::{DMat4, DVec3};
use usd_layer::write::WriteError;

use crate::rig::{Influences, Rig, RigMotion, Space, Track, Tracks};
use crate::usd::write::array::{Array, Rows, Shape};
use crate::usd::write::curves::Curves;
use crate::usd::write::half;
use crate::usd::write::primvars::identifier;
use crate::usd::write::sink::{Content, Declaration, Head, Single, Sink};
use crate::usd::write::stage;
use crate::{Format, FormatError, Warning};

const SKELETON: &str = "/Groom/Skeleton";
const ANIMATION: &str = "/Groom/Skeleton/Animation";

/// A rig, ready to be written.
pub(super) struct Skeleton {
    /// Paths of joints, `Root/Neck/Head`.
    joints: Vec<String>,
    binds: Vec<[f64; 16]>,
    /// The bind pose again, each joint in its parent's space.
    rests: Vec<[f64; 16]>,
    tracks: Tracks,
    pub frame_rate: f64,
    origin: DVec3,
    influences: Vec<Influences>,
}

impl Skeleton {
    pub fn of(
        motion: RigMotion<'_>,
        curves: &Curves<'_>,
        format: Format,
        file: &str,
        warnings: &mut Vec<Warning>,
    ) -> Result<Self, FormatError> {
        let (rig, options) = (motion.rig, motion.options);
        let scale = |scale| half::to_f32(half::from_f32(scale));
        let space = Space { change: DMat4::IDENTITY, origin: options.origin, scale };
        let binds: Vec<DMat4> =
            rig.joints.iter().map(|joint| space.inverse_bind(&joint.inverse_bind).inverse()).collect();
        let rests = rig.joints.iter().zip(&binds).map(|(joint, bind)| {
            joint.parent.and_then(|parent| binds.get(parent)).map_or(*bind, |parent| parent.inverse() * *bind)
        });
        let rests = rests.map(|rest| rest.to_cols_array()).collect();
        let influences = (0..curves.len()).map(|curve| rig.influences[curves.strand(curve)].normalized());
        Ok(Skeleton {
            joints: paths(rig),
            rests,
            binds: binds.iter().map(DMat4::to_cols_array).collect(),
            influences: influences.collect(),
            frame_rate: options.frame_rate,
            origin: options.origin,
            tracks: Tracks::gather(motion, space, format, file, warnings)?,
        })
    }

    /// Time codes of the first and the last frame.
    pub fn range(&self) -> (f64, f64) {
        let times = &self.tracks.times;
        (times.first().copied().unwrap_or_default(), times.last().copied().unwrap_or_default())
    }

    /// What the SkelRoot says, which is open: where it is, and the bounds of what is in it.
    pub fn root<S: Sink>(&self, sink: &mut S, radius: f32) -> Result<(), WriteError> {
        stage::place(sink, self.origin)?;
        let corners: Vec<[[f32; 3]; 2]> = self
            .tracks
            .extents
            .iter()
            .map(|[low, high]| [low.map(|v| v - radius), high.map(|v| v + radius)])
            .collect();
        let samples = self.samples(corners.iter().map(|corners| Single::Float3s(corners)));
        sink.attribute(Declaration::new("float3[]", "extent"), Content::Moving(&samples))
    }

    /// What the curves say, which are open. Every point has its curve's joints: of values a curve, UsdSkel bakes
    /// nothing and does not say so.
    pub fn binding<S: Sink>(&self, sink: &mut S, curves: &Curves<'_>) -> Result<(), WriteError> {
        let each = self.influences.iter().map(|influences| influences.iter().count()).max().unwrap_or(1);
        let points = || {
            self.influences.iter().zip(&curves.counts).flat_map(|(influences, &count)| {
                std::iter::repeat_n(influences, usize::try_from(count).unwrap_or_default())
            })
        };
        let per_point = |name, type_name| Declaration {
            interpolation: Some("vertex"),
            element_size: Some(each as i32),
            ..Declaration::new(type_name, name)
        };
        let indices: Vec<i32> = points()
            .flat_map(|influences| influences.joints.iter().take(each).map(|&joint| joint as i32))
            .collect();
        let indices = Array { curves, rows: Rows::Ints(&indices), shape: Shape::FIXED };
        sink.attribute(per_point("primvars:skel:jointIndices", "int[]"), Content::Array(&indices))?;
        let weights: Vec<f32> =
            points().flat_map(|influences| influences.weights.iter().take(each).copied()).collect();
        let weights = Array { curves, rows: Rows::Floats(&weights), shape: Shape::FIXED };
        sink.attribute(per_point("primvars:skel:jointWeights", "float[]"), Content::Array(&weights))?;
        let identity = Content::Single(Single::Matrix4(DMat4::IDENTITY.to_cols_array()));
        let bind = Declaration {
            interpolation: Some("constant"),
            ..Declaration::new("matrix4d", "primvars:skel:geomBindTransform")
        };
        sink.attribute(bind, identity)?;
        sink.relationship("skel:skeleton", SKELETON)
    }

    /// The skeleton and its animation; the SkelRoot is open.
    pub fn write<S: Sink>(&self, sink: &mut S) -> Result<(), WriteError> {
        let paths: Vec<&str> = self.joints.iter().map(String::as_str).collect();
        let joints = || Content::Single(Single::Tokens(&paths));
        let apis = &["SkelBindingAPI"];
        sink.begin(&Head { name: "Skeleton", type_name: "Skeleton", apis, is_component: false })?;
        sink.attribute(Declaration::uniform("token[]", "joints"), joints())?;
        for (name, matrices) in [("bindTransforms", &self.binds), ("restTransforms", &self.rests)] {
            let matrices = Content::Single(Single::Matrix4s(matrices));
            sink.attribute(Declaration::uniform("matrix4d[]", name), matrices)?;
        }
        sink.relationship("skel:animationSource", ANIMATION)?;
        sink.begin(&Head { name: "Animation", type_name: "SkelAnimation", ..Head::default() })?;
        sink.attribute(Declaration::uniform("token[]", "joints"), joints())?;
        self.animation(sink)?;
        sink.end()?;
        sink.end()
    }

    fn animation<S: Sink>(&self, sink: &mut S) -> Result<(), WriteError> {
        let translations = self.each_frame(|track, frame| track.translations[frame]);
        let samples = self.samples(translations.iter().map(|values| Single::Float3s(values)));
        sink.attribute(Declaration::new("float3[]", "translations"), Content::Moving(&samples))?;
        drop(translations);
        let rotations = self.each_frame(|track, frame| {
            let [x, y, z, w] = track.rotations[frame];
            [w, x, y, z]
        });
        let samples = self.samples(rotations.iter().map(|values| Single::Quaternions(values)));
        sink.attribute(Declaration::new("quatf[]", "rotations"), Content::Moving(&samples))?;
        drop(rotations);
        let scales = self.each_frame(|track, frame| track.scales[frame].map(half::from_f32));
        let samples = self.samples(scales.iter().map(|values| Single::Half3s(values)));
        sink.attribute(Declaration::new("half3[]", "scales"), Content::Moving(&samples))
    }

    /// One value a joint for every frame.
    fn each_frame<T>(&self, value: impl Fn(&Track, usize) -> T) -> Vec<Vec<T>> {
        let Tracks { times, joints, .. } = &self.tracks;
        let frame = |frame| joints.iter().map(|track| value(track, frame)).collect();
        (0..times.len()).map(frame).collect()
    }

    fn samples<'v>(&self, values: impl Iterator<Item = Single<'v>>) -> Vec<(f64, Single<'v>)> {
        self.tracks.times.iter().copied().zip(values).collect()
    }
}

/// Names with those of all parents before them, each an identifier that no other joint has.
fn paths(rig: &Rig) -> Vec<String> {
    let mut used = BTreeSet::new();
    let mut paths: Vec<String> = Vec::new();
    for joint in &rig.joints {
        let name = identifier(&joint.name, &mut used);
        let parent = joint.parent.and_then(|parent| paths.get(parent));
        let path = parent.map_or(name.clone(), |parent| format!("{parent}/{name}"));
        paths.push(path);
    }
    paths
}
