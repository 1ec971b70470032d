//! The geometry as one ray sees it: standing still, or at the ray's time.

use glam::{DVec3, Vec3, Vec4, Vec4Swizzles};

use crate::cone_sphere::ConeSphere;
use crate::fibres::Fibres;
use crate::meshes::Meshes;
use crate::tracks::Between;

/// Where everything is. Still scenes have a path of their own, made from the same source.
pub(crate) trait Pose {
    /// The strands, for what stays the same when they move.
    fn fibres(&self) -> &Fibres;

    /// The triangles, likewise.
    fn meshes(&self) -> &Meshes;

    /// The points of a segment and their radii; none where no segment starts.
    fn ends(&self, number: u32) -> Option<(Vec4, Vec4)>;

    /// The corners of a triangle.
    fn triangle(&self, number: u32) -> Option<[Vec3; 3]>;

    /// Direction of a segment without length.
    fn borrowed(&self, number: u32) -> DVec3;

    #[inline]
    fn cone(&self, number: u32) -> Option<ConeSphere> {
        self.ends(number).map(|(a, b)| ConeSphere::new(a, b))
    }

    /// Unit vector from root to tip.
    fn tangent(&self, number: u32, cone: &ConeSphere) -> DVec3 {
        cone.ab.try_normalize().unwrap_or_else(|| self.borrowed(number))
    }
}

/// Everything at its first key.
#[derive(Clone, Copy)]
pub(crate) struct Still<'a> {
    pub(crate) fibres: &'a Fibres,
    pub(crate) meshes: &'a Meshes,
}

impl Pose for Still<'_> {
    #[inline]
    fn fibres(&self) -> &Fibres {
        self.fibres
    }

    #[inline]
    fn meshes(&self) -> &Meshes {
        self.meshes
    }

    #[inline]
    fn ends(&self, number: u32) -> Option<(Vec4, Vec4)> {
        self.fibres.ends(number)
    }

    #[inline]
    fn triangle(&self, number: u32) -> Option<[Vec3; 3]> {
        self.meshes.all().get(number as usize).copied()
    }

    fn borrowed(&self, number: u32) -> DVec3 {
        self.fibres.borrowed(number)
    }
}

/// Everything at one time of the shutter.
#[derive(Clone, Copy)]
pub(crate) struct Moment<'a> {
    pub(crate) fibres: &'a Fibres,
    pub(crate) meshes: &'a Meshes,
    /// 0 to 1.
    pub(crate) time: f64,
}

impl Pose for Moment<'_> {
    #[inline]
    fn fibres(&self) -> &Fibres {
        self.fibres
    }

    #[inline]
    fn meshes(&self) -> &Meshes {
        self.meshes
    }

    #[inline]
    fn ends(&self, number: u32) -> Option<(Vec4, Vec4)> {
        let (a, b) = self.fibres.ends(number)?;
        let Some(track) = self.fibres.tracks().of(number) else { return Some((a, b)) };
        let between = Between::of(self.time, track.intervals());
        let before = match between.before.checked_sub(1) {
            Some(key) => track.pair(number, key)?,
            None => [a.xyz(), b.xyz()],
        };
        let after = track.pair(number, between.before)?;
        let mix = |end: usize, point: Vec4| between.mix(before[end], after[end]).extend(point.w);
        Some((mix(0, a), mix(1, b)))
    }

    #[inline]
    fn triangle(&self, number: u32) -> Option<[Vec3; 3]> {
        let first = *self.meshes.all().get(number as usize)?;
        let Some(track) = self.meshes.tracks().of(number) else { return Some(first) };
        let between = Between::of(self.time, track.intervals());
        let before = track.at(number, between.before, first);
        let after = track.at(number, between.before + 1, first);
        Some(std::array::from_fn(|corner| between.mix(before[corner], after[corner])))
    }

    fn borrowed(&self, number: u32) -> DVec3 {
        self.fibres.nearest_direction(number, self)
    }
}
