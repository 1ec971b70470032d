//! Walks of light through a whole fibre: two coaxial cylinders, the outer of which reflects and refracts,
//! the inner of which scatters.
//!
//! Nothing is absorbed on the way. A walk returns the lengths of its path in both media instead, from which
//! any absorption follows afterwards.
//!
//! The fibre is endless, so that a walk is a matter of the cross-section: a position there, and a direction
//! with its part along the fibre. A straight line keeps its offset from the axis when it is reflected at
//! the surface; it turns by `pi + 2 gamma_t` around the axis, and nothing else about it changes.

use std::f64::consts::PI;

use crate::fur::grid::{ray_of_row, widest_offset};
use crate::fur::table::MedullaKey;
use crate::hair::attenuation::Chord;
use crate::hair::surface::Surface;

/// Where and how a walk ended outside the fibre.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Exit {
    /// Azimuth against that where the ray would have left unscattered for the first time, in radians.
    pub azimuth: f32,
    /// Sine of the inclination.
    pub sin_theta: f32,
    /// Length of the path in the cortex, in fibre radii.
    pub cortex: f32,
    /// Length of the path in the medulla.
    pub medulla: f32,
}

/// No path is longer, in radii: what is caught that well is absorbed by anything, and products stay finite.
const LONGEST: f32 = 1e9;
/// Chords of the medulla are no shorter than this, so that light caught inside meets it at last.
const SHORTEST: f32 = 1e-7;

/// The fibre a walk goes through.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Walker {
    kappa: f32,
    /// `1 / sigma_s`
    mean_free_path: f32,
    g: f32,
    eta: f32,
    surface: Surface<f32>,
}

/// A ray that has entered the fibre and will be scattered.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Entry {
    /// Offset from the axis and cosine of the angle against the normal, inside.
    turn: (f32, f32),
    /// `gamma_t - gamma_i`: by how much the surface bends the ray around the axis.
    bend: f32,
    /// Sine and cosine of the inclination inside.
    theta: (f32, f32),
    /// Half of the chord through the medulla, in the cross-section.
    half: f32,
    /// Lengths of one crossing in the cortex and in the medulla.
    cortex: f32,
    medulla: f32,
    /// `1 - exp(-tau)`: the chance to be scattered in one crossing.
    caught: f32,
    /// Logarithm of the chance to pass a crossing and be reflected into the next.
    ln_again: f32,
}

impl Walker {
    /// `key` has passed its check.
    pub fn new(key: &MedullaKey) -> Self {
        let mean_free_path = 1.0 / key.sigma_s;
        let surface = Surface::new(&key.parameters().hair);
        Walker { kappa: key.kappa, mean_free_path, g: key.g, eta: key.eta, surface }
    }

    /// The ray a row stands for.
    pub fn entry_of_row(&self, row: usize) -> Entry {
        let (offset, theta) = ray_of_row(row);
        let (sin_theta, cos_theta) = theta.sin_cos();
        let eta = f64::from(self.eta);
        let kappa = f64::from(self.kappa);
        let e = (eta - 1.0) * (eta + 1.0);
        let h = offset * widest_offset(kappa, e, cos_theta);
        let chord = Chord::new(e, cos_theta, h);
        let (sin_t, cos_t) = chord.turn_t;
        let half = ((kappa - sin_t) * (kappa + sin_t)).max(0.0).sqrt();
        let medulla = 2.0 * half * chord.stretch;
        let depth = medulla / f64::from(self.mean_free_path);
        let reflected = f64::from(self.surface.reflectance((cos_theta * (1.0 - h * h).sqrt()) as f32));
        Entry {
            turn: (sin_t as f32, cos_t as f32),
            bend: chord.bend() as f32,
            theta: ((sin_theta / eta) as f32, (1.0 / chord.stretch) as f32),
            half: half as f32,
            cortex: (2.0 * (cos_t - half) * chord.stretch) as f32,
            medulla: medulla as f32,
            caught: -(-depth).exp_m1() as f32,
            ln_again: (reflected.ln() - depth).min(-1e-9) as f32,
        }
    }

    /// Walks from the first scattering to the exit. `first` are three numbers in [0, 1) that may be
    /// stratified over walks: where the ray is first scattered, and two that say whereto.
    pub fn walk(&self, entry: &Entry, first: [f32; 3], numbers: &mut Numbers) -> Exit {
        let mut photon = self.enter(entry, first[0], numbers);
        photon.turn_aside(self.g, first[1], turn(first[2]));
        loop {
            self.cross_medulla(&mut photon, numbers);
            if let Some(exit) = self.cross_cortex(&mut photon, entry, numbers) {
                return exit;
            }
            photon.scatter(self.g, numbers);
        }
    }

    /// Where a ray that is scattered at all is scattered first.
    fn enter(&self, entry: &Entry, u: f32, numbers: &mut Numbers) -> Photon {
        let missed = (numbers.next_open().ln() / entry.ln_again).floor();
        let along = (-(-u * entry.caught).ln_1p() * self.mean_free_path).min(entry.medulla);
        let mut photon = Photon {
            at: [0.0; 2],
            way: [-entry.theta.0, entry.theta.1, 0.0],
            cortex: entry.cortex * (missed + 0.5),
            medulla: entry.medulla * missed + along,
        };
        photon.turn_times(missed, entry.turn);
        photon.place(entry.turn.0, entry.theta.1, along * entry.theta.1 - entry.half);
        photon
    }

    /// Scatters on inside the medulla until its boundary is met.
    fn cross_medulla(&self, photon: &mut Photon, numbers: &mut Numbers) {
        let kappa2 = self.kappa * self.kappa;
        loop {
            let free = self.free_path(numbers);
            let [_, y, z] = photon.way;
            let [at_y, at_z] = photon.at;
            let (there_y, there_z) = (at_y + y * free, at_z + z * free);
            // A way between two points inside is inside: no need to know how far the boundary is.
            if there_y * there_y + there_z * there_z >= kappa2 {
                photon.medulla += boundary(kappa2, [at_y, at_z], [y, z]).min(free);
                return;
            }
            photon.medulla += free;
            photon.at = [there_y, there_z];
            photon.scatter(self.g, numbers);
        }
    }

    fn free_path(&self, numbers: &mut Numbers) -> f32 {
        -numbers.next_open().ln() * self.mean_free_path
    }

    /// From the medulla's boundary out of the fibre, or back to the next scattering.
    fn cross_cortex(&self, photon: &mut Photon, entry: &Entry, numbers: &mut Numbers) -> Option<Exit> {
        let across = photon.across();
        let (y, z) = (photon.way[1] / across, photon.way[2] / across);
        let offset = (photon.at[1] * y - photon.at[0] * z).clamp(-self.kappa, self.kappa);
        let turn = (offset, ((1.0 - offset) * (1.0 + offset)).sqrt());
        let half = ((self.kappa - offset) * (self.kappa + offset)).sqrt();
        let cortex = (turn.1 - half) / across;
        let medulla = (2.0 * half / across).max(SHORTEST);
        let inside = across * turn.1;
        let eta2 = self.eta * self.eta;
        let reflected = self.surface.reflectance_of_leaving(1.0 - eta2 * (1.0 - inside) * (1.0 + inside));
        loop {
            photon.cortex += cortex;
            if reflected < 1.0 && numbers.next() >= reflected {
                return Some(self.leave(photon, turn, entry));
            }
            photon.cortex += cortex;
            photon.turn_times(1.0, turn);
            let mut free = self.free_path(numbers);
            if reflected >= 1.0 {
                // Nothing but scattering ends this: all crossings before it at once.
                let missed = (free / medulla).floor();
                photon.cortex += 2.0 * cortex * missed;
                photon.medulla += medulla * missed;
                photon.turn_times(missed, turn);
                free = (free - missed * medulla).clamp(0.0, medulla);
            }
            if free <= medulla {
                photon.medulla += free;
                photon.place(offset, across, free * across - half);
                return None;
            }
            photon.medulla += medulla;
        }
    }

    fn leave(&self, photon: &Photon, (offset, _): (f32, f32), entry: &Entry) -> Exit {
        let sin_theta = (self.eta * photon.way[0]).clamp(-1.0, 1.0);
        let cos_theta = ((1.0 - sin_theta) * (1.0 + sin_theta)).sqrt().max(1e-6);
        let bent = ((self.eta - sin_theta) * (self.eta + sin_theta)).sqrt();
        let outside = (offset * bent / cos_theta).clamp(-1.0, 1.0);
        let azimuth = photon.way[2].atan2(photon.way[1]) + offset.asin() - outside.asin() - entry.bend;
        Exit { azimuth, sin_theta, cortex: photon.cortex.min(LONGEST), medulla: photon.medulla.min(LONGEST) }
    }
}

/// How far the circle of that squared radius is from a point inside it.
pub(crate) fn boundary(radius2: f32, [at_y, at_z]: [f32; 2], [y, z]: [f32; 2]) -> f32 {
    let across2 = (y * y + z * z).max(1e-12);
    let outward = at_y * y + at_z * z;
    let inside = (radius2 - at_y * at_y - at_z * at_z).max(0.0);
    let root = (outward * outward + across2 * inside).sqrt();
    // Whichever of the two forms does not cancel.
    if outward > 0.0 { inside / (outward + root) } else { (root - outward) / across2 }
}

/// Light on its way.
pub(crate) struct Photon {
    /// Position in the cross-section.
    pub at: [f32; 2],
    /// Unit direction, the first part along the fibre.
    pub way: [f32; 3],
    cortex: f32,
    medulla: f32,
}

impl Photon {
    /// On the axis.
    pub fn new(way: [f32; 3]) -> Self {
        Photon { at: [0.0; 2], way, cortex: 0.0, medulla: 0.0 }
    }

    /// Moves on by that length.
    pub fn advance(&mut self, length: f32) {
        self.at = [self.at[0] + self.way[1] * length, self.at[1] + self.way[2] * length];
    }

    /// Scatters by Henyey and Greenstein's phase function.
    pub fn scatter(&mut self, g: f32, numbers: &mut Numbers) {
        self.turn_aside(g, numbers.next(), numbers.turn());
    }

    /// Length of the direction's part across the fibre.
    fn across(&self) -> f32 {
        let [_, y, z] = self.way;
        (y * y + z * z).sqrt().max(1e-6)
    }

    /// Puts the photon on the line it moves along: at `offset` from the axis, `along` past the point next
    /// to it (in the cross-section).
    pub fn place(&mut self, offset: f32, across: f32, along: f32) {
        let (y, z) = (self.way[1] / across, self.way[2] / across);
        self.at = [y * along - z * offset, z * along + y * offset];
    }

    /// `times` reflections at the surface: each turns the direction by `pi + 2 gamma_t`.
    fn turn_times(&mut self, times: f32, (sin, cos): (f32, f32)) {
        let (sin, cos) = if times == 1.0 {
            (-2.0 * sin * cos, 2.0 * sin * sin - 1.0)
        } else if times > 0.0 {
            let turn = (f64::from(times) * (PI + 2.0 * f64::from(sin).asin())) % (2.0 * PI);
            let (sin, cos) = turn.sin_cos();
            (sin as f32, cos as f32)
        } else {
            return;
        };
        let [_, y, z] = self.way;
        self.way[1] = y * cos - z * sin;
        self.way[2] = y * sin + z * cos;
    }

    /// Scatters by Henyey and Greenstein's phase function of mean cosine `g`.
    fn turn_aside(&mut self, g: f32, u: f32, (side_cos, side_sin): (f32, f32)) {
        // Multiplied out, the inverse needs no case for small g.
        let a = 2.0 * u - 1.0;
        let below = 1.0 + g * a;
        let cos =
            (a + 0.5 * g * (a * a + 3.0) + g * g * a + 0.5 * g * g * g * (a * a - 1.0)) / (below * below);
        let cos = cos.clamp(-1.0, 1.0);
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
        // Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
        let [x, y, z] = self.way;
        let sign = 1.0_f32.copysign(z);
        let p = -1.0 / (sign + z);
        let q = x * y * p;
        let (s, t) = (sin * side_cos, sin * side_sin);
        let way = [
            s * (1.0 + sign * x * x * p) + t * q + cos * x,
            s * sign * q + t * (sign + y * y * p) + cos * y,
            -s * sign * x - t * y + cos * z,
        ];
        // One step of Newton's towards unit length, which rounding has hardly left.
        let mend = 1.5 - 0.5 * (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
        self.way = way.map(|part| part * mend);
    }
}

/// Cosine and sine of a part of a full turn.
fn turn(u: f32) -> (f32, f32) {
    let (sin, cos) = (u * std::f32::consts::TAU).sin_cos();
    (cos, sin)
}

/// Uniform numbers: SplitMix64 (Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators,
/// OOPSLA 2014).
#[derive(Debug, Clone)]
pub(crate) struct Numbers(u64);

impl Numbers {
    /// Numbers of their own for each row and walk.
    pub fn new(row: usize, walk: u32) -> Self {
        let mut numbers = Numbers(((row as u64) << 32) | u64::from(walk));
        // One step, mixed, so that neighbours do not run one behind the other.
        Numbers(numbers.bits())
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// In [0, 1).
    pub fn next(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1_u32 << 24) as f32
    }

    /// In (0, 1].
    fn next_open(&mut self) -> f32 {
        1.0 - self.next()
    }

    /// Cosine and sine of an angle, all alike: twice that of a point in the unit disc.
    fn turn(&mut self) -> (f32, f32) {
        loop {
            let bits = self.bits();
            let part = |bits: u64| (bits & 0xff_ffff) as f32 / (1_u32 << 23) as f32 - 1.0;
            let (x, y) = (part(bits >> 40), part(bits >> 8));
            let square = x * x + y * y;
            if square <= 1.0 && square > 1e-9 {
                let scale = 1.0 / square;
                return ((x * x - y * y) * scale, 2.0 * x * y * scale);
            }
        }
    }
}
