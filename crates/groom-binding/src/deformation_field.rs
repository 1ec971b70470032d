//! How a mesh in motion deforms the space around it.

use glam::{DMat3, DVec3, Vec3};

use crate::anchors::Anchors;
use crate::linear_system::LinearSystem;

/// Centres that are worked on at once.
const WIDE: usize = 8;

/// A smooth field through the anchors of a mesh: an affine part and a radial function about every anchor, |x - c|, the
/// biharmonic spline of three dimensions (Carr et al.: Reconstruction and Representation of 3D Objects with Radial
/// Basis Functions, SIGGRAPH 2001, section 3).
///
/// The spline bends space the least of all that pass through the anchors, has no width to be chosen, and gives any
/// affine motion exactly; a rigid motion stays rigid. The system depends on the rest pose alone: it is solved once, and
/// no pose, however degenerate, can spoil it. Of k nearest frames blended instead, neighbours change from
/// point to point and the field has steps where they do.
#[derive(Clone, Debug)]
pub(crate) struct DeformationField {
    anchors: Anchors,
    /// The anchors' middle and size at rest; inside, places are (x - middle) / size.
    middle: DVec3,
    size: f64,
    system: LinearSystem,
    centres: [Vec<[f32; WIDE]>; 3],
}

/// What the field does at one pose, or how fast it changes there: it is linear in the anchors' places.
#[derive(Clone, Debug)]
pub(crate) struct Deformation {
    /// Derivative of the affine part.
    pub(crate) linear: DMat3,
    weights: [Vec<[f32; WIDE]>; 3],
    exact: Vec<DVec3>,
}

impl DeformationField {
    /// The field of a mesh with this rest pose, through at most `count` anchors. None for a mesh too thin to say how
    /// space turns with it: fewer than three vertices apart, or all in one line.
    pub(crate) fn new(rest: &[DVec3], triangles: &[[u32; 3]], count: usize) -> Option<Self> {
        let anchors = Anchors::new(rest, triangles, count);
        let n = anchors.len();
        if n < 4 {
            return None;
        }
        let middle = anchors.rest.iter().sum::<DVec3>() / n as f64;
        let size = anchors.rest.iter().map(|p| p.distance(middle)).fold(0.0, f64::max);
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        let places: Vec<DVec3> = anchors.rest.iter().map(|&p| (p - middle) / size).collect();
        let system = LinearSystem::new(n + 4, matrix(&places))?;
        let centres = wide(&places);
        Some(DeformationField { anchors, middle, size, system, centres })
    }

    /// How many anchors it goes through.
    pub(crate) fn anchor_count(&self) -> usize {
        self.anchors.len()
    }

    /// A place at rest in the field's own measure.
    pub(crate) fn inside(&self, place: DVec3) -> Vec3 {
        ((place - self.middle) / self.size).as_vec3()
    }

    /// What one unit is in the field's own measure.
    pub(crate) fn unit(&self) -> f32 {
        (1.0 / self.size) as f32
    }

    /// What the field does when the vertices are at `positions`.
    pub(crate) fn at(&self, positions: &[DVec3]) -> Deformation {
        let mut right = self.anchors.at(positions);
        // Only differences matter; a mesh far away loses no digits to where it is.
        let middle = right.iter().sum::<DVec3>() / right.len() as f64;
        for place in &mut right {
            *place -= middle;
        }
        right.extend([DVec3::ZERO; 4]);
        let mut exact = self.system.solve(&right);
        let affine = exact.split_off(self.anchors.len());
        let linear = match affine[..] {
            [_, x, y, z] => DMat3::from_cols(x, y, z) * (1.0 / self.size),
            _ => DMat3::ZERO,
        };
        Deformation::new(linear, exact)
    }

    /// The sum over the centres, for several deformations at once, at a place in the field's own measure.
    #[inline]
    pub(crate) fn bend<const N: usize>(&self, deformations: [&Deformation; N], at: Vec3) -> [Vec3; N] {
        let mut sums = [[[0.0_f32; WIDE]; 3]; N];
        let [xs, ys, zs] = &self.centres;
        for (i, ((x, y), z)) in xs.iter().zip(ys).zip(zs).enumerate() {
            let mut distance = [0.0_f32; WIDE];
            for lane in 0..WIDE {
                let (dx, dy, dz) = (at.x - x[lane], at.y - y[lane], at.z - z[lane]);
                distance[lane] = (dx * dx + dy * dy + dz * dz).sqrt();
            }
            for (sums, deformation) in sums.iter_mut().zip(deformations) {
                for (sum, weights) in sums.iter_mut().zip(&deformation.weights) {
                    let Some(weights) = weights.get(i) else { continue };
                    for lane in 0..WIDE {
                        sum[lane] += weights[lane] * distance[lane];
                    }
                }
            }
        }
        sums.map(|sums| Vec3::from_array(sums.map(|lanes| lanes.iter().sum())))
    }
}

impl Deformation {
    fn new(linear: DMat3, exact: Vec<DVec3>) -> Self {
        Deformation { linear, weights: wide(&exact), exact }
    }

    /// The rate of change of deformations, by weights that sum to nothing.
    pub(crate) fn rate([a, b, c]: [&Deformation; 3], by: [f64; 3]) -> Deformation {
        let linear = (a.linear - b.linear) * by[0] + (c.linear - b.linear) * by[2];
        let three = a.exact.iter().zip(&b.exact).zip(&c.exact);
        let exact = three.map(|((&a, &b), &c)| (a - b) * by[0] + (c - b) * by[2]).collect();
        Deformation::new(linear, exact)
    }
}

/// |c_i - c_j| bordered by the affine part, whose weights the radial ones must not repeat.
fn matrix(places: &[DVec3]) -> Vec<f64> {
    let n = places.len();
    let size = n + 4;
    let mut matrix = vec![0.0; size * size];
    for (i, a) in places.iter().enumerate() {
        for (j, b) in places.iter().enumerate() {
            matrix[i * size + j] = a.distance(*b);
        }
        for (k, value) in [1.0, a.x, a.y, a.z].into_iter().enumerate() {
            matrix[i * size + n + k] = value;
            matrix[(n + k) * size + i] = value;
        }
    }
    matrix
}

/// Coordinates side by side, filled up with zeros.
fn wide(values: &[DVec3]) -> [Vec<[f32; WIDE]>; 3] {
    [0, 1, 2].map(|axis| {
        let pack = |chunk: &[DVec3]| {
            std::array::from_fn(|lane| chunk.get(lane).map_or(0.0, |value| value[axis] as f32))
        };
        values.chunks(WIDE).map(pack).collect()
    })
}

#[cfg(test)]
mod tests {
    use glam::{DQuat, dvec3};
    use groom::random;

    use super::*;

    /// Places on a ball, each a vertex of some triangle.
    fn ball(count: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let number = |id, purpose| f64::from(random(5, id, purpose)) - 0.5;
        let place = |i| dvec3(number(i, "x"), number(i, "y"), number(i, "z")).normalize_or(DVec3::X) * 3.0;
        ((0..count).map(place).collect(), (0..count - 2).map(|i| [i, i + 1, i + 2]).collect())
    }

    /// How far the field carries `x` from where it carries `from`.
    fn difference(field: &DeformationField, deformation: &Deformation, from: DVec3, x: DVec3) -> DVec3 {
        let sum = |x| field.bend([deformation], field.inside(x))[0].as_dvec3();
        deformation.linear * (x - from) + sum(x) - sum(from)
    }

    #[test]
    fn it_passes_through_its_anchors() {
        let (rest, triangles) = ball(60);
        let field = DeformationField::new(&rest, &triangles, 60).unwrap();
        let bent: Vec<DVec3> =
            rest.iter().map(|p| dvec3(p.x + 0.3 * p.y * p.y, p.y * (1.0 + 0.1 * p.z), p.z)).collect();
        let deformation = field.at(&bent);
        for (before, after) in rest.iter().zip(&bent) {
            let moved = difference(&field, &deformation, rest[0], *before);
            assert!(moved.distance(*after - bent[0]) < 1e-5, "{moved} {}", *after - bent[0]);
        }
    }

    #[test]
    fn affine_motions_need_no_bending_however_far_away() {
        let (rest, triangles) = ball(80);
        let field = DeformationField::new(&rest, &triangles, 50).unwrap();
        let matrix =
            DMat3::from_quat(DQuat::from_rotation_y(1.1)) * DMat3::from_diagonal(dvec3(2.0, 1.0, 0.5));
        for away in [DVec3::ZERO, DVec3::splat(1e6)] {
            let posed: Vec<DVec3> = rest.iter().map(|&p| matrix * p + away).collect();
            let deformation = field.at(&posed);
            assert!((deformation.linear - matrix).to_cols_array().iter().all(|x| x.abs() < 1e-9));
            assert!(deformation.exact.iter().all(|weight| weight.length() < 1e-8));
        }
    }

    #[test]
    fn any_pose_gives_numbers() {
        let (rest, triangles) = ball(50);
        let field = DeformationField::new(&rest, &triangles, 50).unwrap();
        for posed in [vec![DVec3::ONE; 50], rest.iter().map(|p| p * dvec3(1.0, 0.0, 1.0)).collect()] {
            let moved = difference(&field, &field.at(&posed), rest[3], dvec3(4.0, 1.0, -2.0));
            assert!(moved.is_finite() && moved.length() < 10.0, "{moved}");
        }
    }

    #[test]
    fn meshes_without_breadth_have_no_field() {
        let line: Vec<DVec3> = (0..20).map(|i| dvec3(f64::from(i), 0.0, 0.0)).collect();
        let triangles: Vec<[u32; 3]> = (0..18).map(|i| [i, i + 1, i + 2]).collect();
        assert!(DeformationField::new(&line, &triangles, 20).is_none());
        assert!(DeformationField::new(&[DVec3::ONE; 3], &[[0, 1, 2]], 20).is_none());
        // One triangle has: with the places over its corners.
        assert!(DeformationField::new(&[DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]], 20).is_some());
    }
}
