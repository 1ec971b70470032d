//! The way of a ray through a fibre of elliptical cross-section, by plane geometry.
//!
//! An affine map makes the ellipse a circle. Lines stay lines and tangents stay tangents, so that an offset
//! over the projected half-width is the offset in the circle too, and a chord's two ends mirror each other
//! there. Only angles, at which light is bent and reflected, are those of the ellipse itself.
//!
//! In double precision for both of the model's: it is done once a hit, and next to total reflection a
//! rounding of single precision would show in the reflectance.

use std::ops::{Add, Mul};

/// A vector of the cross-section: y and z of the fibre's frame.
#[derive(Debug, Clone, Copy)]
struct Plane(f64, f64);

impl Plane {
    fn dot(self, other: Plane) -> f64 {
        self.0 * other.0 + self.1 * other.1
    }

    /// Sine of the angle from this to another, times both lengths.
    fn cross(self, other: Plane) -> f64 {
        self.0 * other.1 - self.1 * other.0
    }

    fn turned_left(self) -> Plane {
        Plane(-self.1, self.0)
    }

    fn unit(self) -> Plane {
        self * (1.0 / self.0.hypot(self.1))
    }
}

impl Add for Plane {
    type Output = Plane;
    fn add(self, other: Plane) -> Plane {
        Plane(self.0 + other.0, self.1 + other.1)
    }
}

impl Mul<f64> for Plane {
    type Output = Plane;
    fn mul(self, factor: f64) -> Plane {
        Plane(self.0 * factor, self.1 * factor)
    }
}

/// What a ray meets on its way through the fibre.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Crossing {
    /// Squared cosine, in the air, of the ray that enters or would leave where the surface is met for the
    /// first, second and third time; less than 0 where total reflection lets none leave.
    pub cos2: [f64; 3],
    /// Lengths of the first two crossings, in units of the larger half axis.
    pub lengths: [f64; 2],
    /// Cosine and sine of the azimuth of R, TT and TRT against that of the viewer.
    pub turns: [(f64, f64); 3],
}

/// A cross-section with half axes 1 along y and `aspect` along z.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ellipse {
    pub aspect: f64,
}

/// A point of the ellipse, by its image on the circle, and the outward normal.
#[derive(Debug, Clone, Copy)]
struct Meeting {
    on_circle: Plane,
    normal: Plane,
    /// Length of the gradient whose direction the normal is.
    steepness: f64,
}

impl Ellipse {
    fn to_circle(self, v: Plane) -> Plane {
        Plane(v.0, v.1 / self.aspect)
    }

    fn meeting(self, on_circle: Plane) -> Meeting {
        let gradient = self.to_circle(on_circle);
        let steepness = gradient.0.hypot(gradient.1);
        Meeting { on_circle, normal: gradient * (1.0 / steepness), steepness }
    }

    /// Follows the ray from a viewer of inclination cosine `cos_theta` and azimuth `turn` (its cosine and
    /// sine), past the axis at `h` of the projected half-width, into a fibre of `eta^2 = 1 + e`.
    pub fn crossing(self, e: f64, cos_theta: f64, turn: [f64; 2], h: f64) -> Crossing {
        let viewer = Plane(turn[0], turn[1]);
        let image = self.to_circle(viewer);
        let straight = image.unit();
        let cos_h = ((1.0 - h) * (1.0 + h)).sqrt();
        let first = self.meeting(straight * cos_h + straight.turned_left() * -h);
        // The angle of incidence in the plane. Its cosine is the dot product of both, with nothing to cancel.
        let cos_i = (image.dot(straight) * cos_h / first.steepness).min(1.0);
        let sin_i = first.normal.cross(viewer);
        // Snell's law in the plane: eta' = bent / cos(theta).
        let bent = (e + cos_theta * cos_theta).sqrt();
        let sin_t = sin_i * cos_theta / bent;
        let cos_t = (e + cos_theta * cos_theta * cos_i * cos_i).sqrt() / bent;
        let way = first.normal * -cos_t + first.normal.turned_left() * -sin_t;

        let (second, length_1) = self.across(first, way, cos_t);
        let cos_2 = (first.steepness * cos_t / second.steepness).min(1.0);
        let (leaving_2, tt) = leave(e, bent, second.normal, way, cos_2);
        let way = (way + second.normal * (-2.0 * cos_2)).unit();
        let (third, length_2) = self.across(second, way, cos_2);
        let cos_3 = (second.steepness * cos_2 / third.steepness).min(1.0);
        let (leaving_3, trt) = leave(e, bent, third.normal, way, cos_3);

        let against_viewer = |out: Plane| {
            let Plane(cos, sin) = Plane(viewer.dot(out), viewer.cross(out)).unit();
            (cos, sin)
        };
        // A mirror turns by twice the angle of incidence.
        let r = (cos_i * cos_i - sin_i * sin_i, -2.0 * sin_i * cos_i);
        let entering = cos_theta * cos_i;
        // A length in the plane over the cosine of the inclination inside, bent / eta.
        let stretch = (1.0 + e).sqrt() / bent;
        Crossing {
            cos2: [entering * entering, leaving_2, leaving_3],
            lengths: [length_1 * stretch, length_2 * stretch],
            turns: [r, against_viewer(tt), against_viewer(trt)],
        }
    }

    /// Where a ray that sets out inwards meets the ellipse again, and the length of its way there. `cos` is
    /// that of its angle against the normal.
    fn across(self, from: Meeting, way: Plane, cos: f64) -> (Meeting, f64) {
        let image = self.to_circle(way);
        let length = 2.0 * from.steepness * cos / image.dot(image);
        (self.meeting((from.on_circle + image * length).unit()), length)
    }
}

/// The squared cosine, in the air, of the ray that leaves, and its direction in the plane (any length).
fn leave(e: f64, bent: f64, normal: Plane, way: Plane, cos: f64) -> (f64, Plane) {
    let leaving = bent * bent * cos * cos - e;
    let aside = bent * normal.cross(way);
    let out = normal * leaving.max(0.0).sqrt() + normal.turned_left() * aside;
    // Along the fibre there is no direction in the plane, and no light that leaves.
    (leaving, if out.0 == 0.0 && out.1 == 0.0 { normal } else { out })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::hair::attenuation::Chord;

    const E: f64 = 1.55 * 1.55 - 1.0;

    /// Azimuths of R, TT and TRT.
    fn azimuths(crossing: &Crossing) -> [f64; 3] {
        crossing.turns.map(|(cos, sin)| sin.atan2(cos))
    }

    fn apart(a: f64, b: f64) -> f64 {
        ((a - b + PI).rem_euclid(2.0 * PI) - PI).abs()
    }

    #[test]
    fn an_ellipse_that_is_a_circle_is_the_round_fibre() {
        for h in [-1.0, -0.7, 0.0, 0.2, 0.999] {
            for (theta, azimuth) in [(0.0_f64, 0.3_f64), (0.9, -2.0), (-1.4, 1.0)] {
                let chord = Chord::new(E, theta.cos(), h);
                let turn = [azimuth.cos(), azimuth.sin()];
                let found = Ellipse { aspect: 1.0 }.crossing(E, theta.cos(), turn, h);
                let cos = theta.cos() * ((1.0 - h) * (1.0 + h)).sqrt();
                for place in 0..3 {
                    assert!((found.cos2[place] - cos * cos).abs() < 1e-13, "{found:?}");
                    let p = place as f64;
                    let exit = 2.0 * p * chord.turn_t.0.asin() - 2.0 * chord.turn_i.0.asin() + p * PI;
                    assert!(apart(azimuths(&found)[place], exit) < 1e-6, "{h} {exit} {found:?}");
                }
                assert!(found.lengths.iter().all(|length| (length - chord.length).abs() < 1e-13));
            }
        }
    }

    /// Seen along either axis, the ray through the middle goes straight through and back.
    #[test]
    fn through_the_middle_along_an_axis() {
        for (turn, length) in [([1.0, 0.0], 2.0), ([0.0, -1.0], 0.8)] {
            let found = Ellipse { aspect: 0.4 }.crossing(E, 1.0, turn, 0.0);
            assert!(found.lengths.iter().all(|found| (found - length).abs() < 1e-13), "{found:?}");
            let [r, tt, trt] = azimuths(&found);
            assert!(r == 0.0 && apart(tt, PI) < 1e-13 && trt.abs() < 1e-13, "{found:?}");
        }
    }

    /// Light that leaves can enter again by the same way: the path from the far end is the path itself.
    #[test]
    fn a_path_can_be_walked_back() {
        let ellipse = Ellipse { aspect: 0.5 };
        for azimuth in [0.1_f64, 0.8, 1.5, 2.9] {
            for h in [-0.9, -0.3, 0.1, 0.6] {
                let turn = [azimuth.cos(), azimuth.sin()];
                let there = ellipse.crossing(E, 0.8, turn, h);
                if there.cos2[1] <= 1e-6 {
                    continue;
                }
                let out = azimuth + azimuths(&there)[1];
                let turn = [out.cos(), out.sin()];
                // The exit's offset is not told: it is found by the way back, which is to be as long.
                let miss = |h: f64| {
                    let back = ellipse.crossing(E, 0.8, turn, h);
                    apart(out + azimuths(&back)[1], azimuth) + (back.lengths[0] - there.lengths[0]).abs()
                };
                let least =
                    (0..200_000).map(|i| miss(f64::from(i) / 1e5 - 1.0)).fold(f64::INFINITY, f64::min);
                assert!(least < 1e-3, "{least}");
            }
        }
    }
}
