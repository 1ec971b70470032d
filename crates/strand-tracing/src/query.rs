//! One ray against one pose of a tracer's geometry.

use glam::{DVec3, Vec3};

use crate::build::TRIANGLE;
use crate::inside::{self, Departure};
use crate::line::Line;
use crate::pose::Pose;
use crate::triangle::{self, Shear};
use crate::{Hit, HitKind, Primitive, Ray};

/// What a ray starts on.
enum Left {
    Nothing,
    Fibre(Departure),
    Triangle(u32),
}

/// What a ray asks of single segments and triangles.
pub(crate) struct Query<P> {
    pose: P,
    line: Line,
    left: Left,
}

impl<P: Pose> Query<P> {
    #[inline]
    pub(crate) fn new(pose: P, ray: &Ray, leaving: Option<Primitive>) -> Self {
        let left = match leaving {
            None => None,
            Some(Primitive::Segment { object, strand, segment }) => {
                pose.fibres().departure(object, strand, segment).map(Left::Fibre)
            }
            Some(Primitive::Triangle { object, triangle }) => {
                pose.meshes().number(object, triangle).map(|n| Left::Triangle(TRIANGLE | n))
            }
        };
        Self { pose, line: Line::of(ray), left: left.unwrap_or(Left::Nothing) }
    }

    /// Where the ray hits a primitive, if that is at `within` or before.
    #[inline]
    pub(crate) fn hit(&self, leaf: u32, within: f64) -> Option<f64> {
        if leaf & TRIANGLE == 0 { self.fibre_hit(leaf, within) } else { self.triangle_hit(leaf, within) }
    }

    #[inline]
    fn fibre_hit(&self, number: u32, within: f64) -> Option<f64> {
        if let Left::Fibre(departure) = &self.left
            && departure.is_segment(number)
        {
            return None;
        }
        let cone = self.pose.cone(number)?;
        let t = cone.entry(&self.line).map(|entry| entry.t).filter(|&t| t > 0.0 && t <= within)?;
        let inside = match &self.left {
            Left::Fibre(departure) if departure.is_strand_of(number) => {
                inside::still_inside(&self.pose, departure, &self.line, t)
            }
            _ => inside::is_inner(&self.pose, number, &cone, self.line.at(t)),
        };
        (!inside).then_some(t)
    }

    fn triangle_hit(&self, leaf: u32, within: f64) -> Option<f64> {
        if let Left::Triangle(left) = self.left
            && left == leaf
        {
            return None;
        }
        let vertices = self.pose.triangle(leaf & !TRIANGLE)?;
        let t = Shear::new(&self.line).cross(&self.line, &vertices)?.t;
        (t > 0.0 && t <= within && !self.is_seam(&vertices, t)).then_some(t)
    }

    /// Whether a crossing is the seam between the triangle left and a neighbour.
    fn is_seam(&self, vertices: &[Vec3; 3], t: f64) -> bool {
        let Left::Triangle(left) = self.left else { return false };
        let left = self.pose.triangle(left & !TRIANGLE);
        left.is_some_and(|left| triangle::is_seam(&self.line, &left, vertices, t))
    }

    pub(crate) fn describe(&self, leaf: u32, t: f64, t_max: f32) -> Option<Hit> {
        let t = (t as f32).min(t_max);
        if leaf & TRIANGLE == 0 { self.describe_fibre(leaf, t) } else { self.describe_triangle(leaf, t) }
    }

    fn describe_fibre(&self, number: u32, t: f32) -> Option<Hit> {
        let cone = self.pose.cone(number)?;
        let entry = cone.entry(&self.line)?;
        let tangent = self.pose.tangent(number, &cone);
        let position = self.line.at(entry.t);
        let outward: DVec3 = position - cone.a - cone.ab * entry.u;
        Some(Hit {
            t,
            position: position.as_vec3(),
            primitive: self.pose.fibres().primitive(number),
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
        let vertices = self.pose.triangle(number)?;
        let crossing = Shear::new(&self.line).cross(&self.line, &vertices)?;
        Some(Hit {
            t,
            position: triangle::point(&vertices, crossing.weights),
            primitive: self.pose.meshes().primitive(number),
            kind: HitKind::Triangle {
                barycentrics: crossing.weights.map(|w| w as f32),
                normal: triangle::normal(&vertices),
            },
        })
    }
}
