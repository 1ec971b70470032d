//! The tracer: geometry, its tree, and the two questions a ray asks.

use std::time::Instant;

use glam::{DVec3, Vec3};

use crate::build::{self, Built, TRIANGLE};
use crate::fibres::{Departure, Fibres};
use crate::line::Line;
use crate::meshes::Meshes;
use crate::pack::{NOTHING, Sight};
use crate::triangle::{self, Shear};
use crate::wide_tree::reach;
use crate::{BuildOptions, Hit, HitKind, Primitive, Ray, Strands, TracingError, Triangles};

/// Geometry ready to be traced. Shared between threads; a query changes nothing.
#[derive(Clone, Debug)]
pub struct Tracer {
    fibres: Fibres,
    meshes: Meshes,
    built: Built,
    statistics: Statistics,
}

/// What a tracer holds and what building it cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Segments that can be hit.
    pub segments: usize,
    /// Triangles.
    pub triangles: usize,
    /// Nodes of the tree.
    pub nodes: usize,
    /// Memory held, in bytes.
    pub bytes: usize,
    /// Seconds the build took.
    pub build_seconds: f64,
}

impl Tracer {
    /// Copies the geometry and builds the tree over it. Nothing is built for what is not there.
    ///
    /// # Errors
    /// Offsets, indices or counts that do not fit, and numbers that are not finite.
    pub fn build(
        strands: &[Strands],
        triangles: &[Triangles],
        options: &BuildOptions,
    ) -> Result<Self, TracingError> {
        let start = Instant::now();
        build::check_counts(strands, triangles)?;
        let fibres = Fibres::gather(strands)?;
        let meshes = Meshes::gather(triangles)?;
        let built = build::tree(&fibres, &meshes, options);
        let statistics = Statistics {
            segments: fibres.solid().count(),
            triangles: meshes.all().len(),
            nodes: built.tree.node_count(),
            bytes: fibres.bytes() + meshes.bytes() + built.tree.bytes() + built.packs.bytes(),
            build_seconds: start.elapsed().as_secs_f64(),
        };
        Ok(Self { fibres, meshes, built, statistics })
    }

    /// The first hit with `0 < t <= ray.t_max`, not counting what the ray leaves: pass the primitive of the
    /// hit a ray starts from, with the ray's origin at [`Hit::position`].
    ///
    /// Of several hits at the same distance the one that came first in the input counts, strands before
    /// triangles. A ray with a component that is not a number hits nothing.
    #[must_use]
    pub fn closest(&self, ray: &Ray, leaving: Option<Primitive>) -> Option<Hit> {
        let query = Query::new(self, ray, leaving);
        let mut far = reach(f64::from(ray.t_max));
        let mut within = f64::from(ray.t_max);
        let mut best: Option<(f64, u32)> = None;
        self.built.tree.walk::<true>(ray, &mut far, |leaf, far| {
            query.each(leaf, |leaf| {
                if let Some(t) = query.hit(leaf, within)
                    && best.is_none_or(|(nearest, first)| t < nearest || leaf < first)
                {
                    best = Some((t, leaf));
                    within = t;
                    *far = reach(t);
                }
                false
            })
        });
        best.and_then(|(t, leaf)| query.describe(leaf, t, ray.t_max))
    }

    /// Whether [`closest`](Tracer::closest) would find anything; stops at the first thing found.
    #[must_use]
    pub fn occluded(&self, ray: &Ray, leaving: Option<Primitive>) -> bool {
        let query = Query::new(self, ray, leaving);
        let mut found = false;
        let within = f64::from(ray.t_max);
        self.built.tree.walk::<false>(ray, &mut reach(within), |leaf, _| {
            query.each(leaf, |leaf| {
                found = query.hit(leaf, within).is_some();
                found
            })
        });
        found
    }

    /// Least and greatest corner of everything that can be hit; two zeros for an empty tracer.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        self.built.bounds
    }

    /// What the tracer holds.
    #[must_use]
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }
}

/// What a ray starts on.
enum Left {
    Nothing,
    Fibre(Departure),
    Triangle(u32),
}

/// One ray against one tracer.
struct Query<'a> {
    tracer: &'a Tracer,
    line: Line,
    sight: Sight,
    left: Left,
}

impl<'a> Query<'a> {
    #[inline]
    fn new(tracer: &'a Tracer, ray: &Ray, leaving: Option<Primitive>) -> Self {
        let left = match leaving {
            None => None,
            Some(Primitive::Segment { object, strand, segment }) => {
                tracer.fibres.departure(object, strand, segment).map(Left::Fibre)
            }
            Some(Primitive::Triangle { object, triangle }) => {
                tracer.meshes.number(object, triangle).map(|n| Left::Triangle(TRIANGLE | n))
            }
        };
        let sight = Sight::new(ray, tracer.built.packs.bounds());
        Self { tracer, line: Line::of(ray), sight, left: left.unwrap_or(Left::Nothing) }
    }

    /// Calls `visit` for what a leaf of the tree holds and the ray may hit, until it returns true.
    #[inline(always)]
    fn each(&self, leaf: u32, mut visit: impl FnMut(u32) -> bool) -> bool {
        if leaf & TRIANGLE != 0 {
            return visit(leaf);
        }
        let Some(pack) = self.tracer.built.packs.get(leaf) else { return false };
        let mut near = self.sight.near(pack);
        while near != 0 {
            let number = pack.number(near.trailing_zeros() as usize);
            near &= near - 1;
            if number != NOTHING && visit(number) {
                return true;
            }
        }
        false
    }

    /// Where the ray hits a primitive, if that is at `within` or before.
    #[inline]
    fn hit(&self, leaf: u32, within: f64) -> Option<f64> {
        if leaf & TRIANGLE == 0 { self.fibre_hit(leaf, within) } else { self.triangle_hit(leaf, within) }
    }

    #[inline]
    fn fibre_hit(&self, number: u32, within: f64) -> Option<f64> {
        let fibres = &self.tracer.fibres;
        if let Left::Fibre(departure) = &self.left
            && departure.is_segment(number)
        {
            return None;
        }
        let cone = fibres.cone(number)?;
        let t = cone.entry(&self.line).map(|entry| entry.t).filter(|&t| t > 0.0 && t <= within)?;
        let inside = match &self.left {
            Left::Fibre(departure) if departure.is_strand_of(number) => {
                fibres.still_inside(departure, &self.line, t)
            }
            _ => fibres.is_inner(number, &cone, self.line.at(t)),
        };
        (!inside).then_some(t)
    }

    fn triangle_hit(&self, leaf: u32, within: f64) -> Option<f64> {
        if let Left::Triangle(left) = self.left
            && left == leaf
        {
            return None;
        }
        let vertices = self.tracer.meshes.all().get((leaf & !TRIANGLE) as usize)?;
        let t = Shear::new(&self.line).cross(&self.line, vertices)?.t;
        (t > 0.0 && t <= within && !self.is_seam(vertices, t)).then_some(t)
    }

    /// Whether a crossing is the seam between the triangle left and a neighbour.
    fn is_seam(&self, vertices: &[Vec3; 3], t: f64) -> bool {
        let Left::Triangle(left) = self.left else { return false };
        let left = self.tracer.meshes.all().get((left & !TRIANGLE) as usize);
        left.is_some_and(|left| triangle::is_seam(&self.line, left, vertices, t))
    }

    fn describe(&self, leaf: u32, t: f64, t_max: f32) -> Option<Hit> {
        let t = (t as f32).min(t_max);
        if leaf & TRIANGLE == 0 { self.describe_fibre(leaf, t) } else { self.describe_triangle(leaf, t) }
    }

    fn describe_fibre(&self, number: u32, t: f32) -> Option<Hit> {
        let fibres = &self.tracer.fibres;
        let cone = fibres.cone(number)?;
        let entry = cone.entry(&self.line)?;
        let tangent = fibres.tangent(number, &cone);
        let position = self.line.at(entry.t);
        let outward: DVec3 = position - cone.a - cone.ab * entry.u;
        Some(Hit {
            t,
            position: position.as_vec3(),
            primitive: fibres.primitive(number),
            kind: HitKind::Segment {
                u: entry.u as f32,
                tangent: tangent.as_vec3(),
                h: cone.offset(&self.line, tangent, entry.u) as f32,
                radius: cone.radius(entry.u) as f32,
                normal: outward.normalize_or(-self.line.direction).as_vec3(),
            },
        })
    }

    fn describe_triangle(&self, leaf: u32, t: f32) -> Option<Hit> {
        let number = leaf & !TRIANGLE;
        let vertices = self.tracer.meshes.all().get(number as usize)?;
        let crossing = Shear::new(&self.line).cross(&self.line, vertices)?;
        Some(Hit {
            t,
            position: triangle::point(vertices, crossing.weights),
            primitive: self.tracer.meshes.primitive(number),
            kind: HitKind::Triangle {
                barycentrics: crossing.weights.map(|w| w as f32),
                normal: triangle::normal(vertices),
            },
        })
    }
}
