//! Light walked through two coaxial cylinders, from the physics alone: textbook refraction, Fresnel's
//! equations, free paths, Henyey and Greenstein. Shares no code, numbers or method with the library's walks: it
//! is three-dimensional, in f64, and decides everything by chance.
#![allow(dead_code)] // each user takes a part

pub type Vector = [f64; 3];

#[derive(Debug, Clone, Copy)]
pub struct Cylinders {
    pub eta: f64,
    pub kappa: f64,
    pub sigma_s: f64,
    pub g: f64,
    /// Cuticle layers of Yan 2017; nothing for the bare surface.
    pub layers: Option<f64>,
    /// Index of a film of water, if there is one.
    pub film: Option<f64>,
}

/// Sets A and B of the published fits; the surface is bare.
pub const SET_A: Cylinders =
    Cylinders { eta: 1.49, kappa: 0.86, sigma_s: 3.15, g: 0.79, layers: None, film: None };
pub const SET_B: Cylinders =
    Cylinders { eta: 1.55, kappa: 0.88, sigma_s: 1.69, g: 0.44, layers: None, film: None };

#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    pub way: Vector,
    pub cortex: f64,
    pub medulla: f64,
    pub scatterings: u32,
    pub reflections: u32,
}

impl Outcome {
    /// What is left of the light for these absorptions of cortex and medulla.
    pub fn passed(&self, [cortex, medulla]: [f64; 2]) -> f64 {
        (-cortex * self.cortex - medulla * self.medulla).exp()
    }
}

/// xorshift64* (Vigna 2016).
pub struct Chance(u64);

impl Chance {
    pub fn new(seed: u64) -> Self {
        let mut chance = Chance(seed.wrapping_mul(0x5851_f42d_4c95_7f2d) | 1);
        for _ in 0..8 {
            chance.next();
        }
        chance
    }

    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn add(a: Vector, b: Vector, times: f64) -> Vector {
    [a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]]
}

fn unit(a: Vector) -> Vector {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The distance along a line at which it leaves a cylinder about x, and (first) that at which it enters it.
fn meets(at: Vector, way: Vector, radius: f64) -> Option<(f64, f64)> {
    let a = way[1] * way[1] + way[2] * way[2];
    let b = at[1] * way[1] + at[2] * way[2];
    let c = at[1] * at[1] + at[2] * at[2] - radius * radius;
    let d = b * b - a * c;
    (d > 0.0 && a > 1e-18).then(|| ((-b - d.sqrt()) / a, (-b + d.sqrt()) / a))
}

/// Fresnel's equations, by the indices on both sides and both cosines.
fn polarised(n1: f64, cos1: f64, n2: f64, cos2: f64) -> [f64; 2] {
    let s = (n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2);
    let p = (n2 * cos1 - n1 * cos2) / (n2 * cos1 + n1 * cos2);
    [s * s, p * p]
}

impl Cylinders {
    /// Whether light is reflected, by the indices on both sides and both cosines.
    fn reflects(&self, n1: f64, cos1: f64, n2: f64, cos2: f64, chance: &mut Chance) -> bool {
        let Some(water) = self.film else {
            return chance.next() < self.reflectance(n1, cos1, n2, cos2);
        };
        // Back and forth between the film's faces, in one polarisation all the way.
        let cos_water = (1.0 - (n1 / water).powi(2) * (1.0 - cos1 * cos1)).sqrt();
        let polarisation = usize::from(chance.next() < 0.5);
        let near = polarised(n1, cos1, water, cos_water)[polarisation];
        let far = polarised(water, cos_water, n2, cos2)[polarisation];
        if chance.next() < near {
            return true;
        }
        loop {
            if chance.next() >= far {
                return false;
            }
            if chance.next() >= near {
                return true;
            }
        }
    }

    fn reflectance(&self, n1: f64, cos1: f64, n2: f64, cos2: f64) -> f64 {
        let [s, p] = polarised(n1, cos1, n2, cos2);
        match self.layers {
            None => 0.5 * (s + p),
            Some(l) => {
                let one = 0.5 * (2.0 * s / (1.0 + s) + 2.0 * p / (1.0 + p));
                l * one / (1.0 + (l - 1.0) * one)
            }
        }
    }

    /// Goes on as reflected or refracted; true when refracted. The normal faces against the way.
    fn meet_surface(&self, way: &mut Vector, normal: Vector, n1: f64, n2: f64, chance: &mut Chance) -> bool {
        let cos1 = -dot(*way, normal);
        let sin2 = n1 / n2 * (1.0 - cos1 * cos1).max(0.0).sqrt();
        if sin2 < 1.0 {
            let cos2 = (1.0 - sin2 * sin2).sqrt();
            if !self.reflects(n1, cos1, n2, cos2, chance) {
                let bent = add(way.map(|x| x * n1 / n2), normal, n1 / n2 * cos1 - cos2);
                *way = unit(bent);
                return true;
            }
        }
        *way = unit(add(*way, normal, 2.0 * cos1));
        false
    }

    fn scatter(&self, way: Vector, chance: &mut Chance) -> Vector {
        let u = chance.next();
        let cos = if self.g.abs() < 1e-4 {
            1.0 - 2.0 * u
        } else {
            let g = self.g;
            let part = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
            ((1.0 + g * g - part * part) / (2.0 * g)).clamp(-1.0, 1.0)
        };
        let phi = std::f64::consts::TAU * chance.next();
        let other = if way[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let side = unit(cross(way, other));
        let third = cross(way, side);
        let sin = (1.0 - cos * cos).sqrt();
        unit(add(add(way.map(|x| x * cos), side, sin * phi.cos()), third, sin * phi.sin()))
    }

    /// One walk of light seen from `wo` at the offset `h`.
    pub fn walk(&self, wo: Vector, h: f64, chance: &mut Chance) -> Outcome {
        let toward = unit([0.0, wo[1], wo[2]]);
        let aside = cross([1.0, 0.0, 0.0], toward);
        let mut at = add(toward.map(|x| x * (1.0 - h * h).sqrt()), aside, -h);
        let mut way = wo.map(|x| -x);
        let mut found = Outcome { way, cortex: 0.0, medulla: 0.0, scatterings: 0, reflections: 0 };
        let normal = unit([0.0, at[1], at[2]]);
        if !self.meet_surface(&mut way, normal, 1.0, self.eta, chance) {
            return Outcome { way, ..found };
        }
        loop {
            // In the cortex: to the medulla if it lies ahead, else to the surface.
            let ahead = meets(at, way, self.kappa).filter(|(enter, _)| *enter > 1e-9);
            if let Some((enter, _)) = ahead {
                found.cortex += enter;
                at = add(at, way, enter);
                let (inside, way_after) = self.through_medulla(&mut at, way, &mut found, chance);
                way = way_after;
                debug_assert!(inside);
            }
            let Some((_, leave)) = meets(at, way, 1.0) else { continue };
            found.cortex += leave;
            at = add(at, way, leave);
            let normal = unit([0.0, -at[1], -at[2]]);
            if self.meet_surface(&mut way, normal, self.eta, 1.0, chance) {
                return Outcome { way, ..found };
            }
            found.reflections += 1;
        }
    }

    /// From the boundary of the medulla to its boundary.
    fn through_medulla(
        &self,
        at: &mut Vector,
        mut way: Vector,
        found: &mut Outcome,
        chance: &mut Chance,
    ) -> (bool, Vector) {
        loop {
            let free = -(1.0 - chance.next()).ln() / self.sigma_s;
            let leave = meets(*at, way, self.kappa).map_or(0.0, |(_, leave)| leave.max(0.0));
            found.medulla += free.min(leave);
            *at = add(*at, way, free.min(leave));
            if free >= leave {
                return (true, way);
            }
            way = self.scatter(way, chance);
            found.scatterings += 1;
        }
    }
}
