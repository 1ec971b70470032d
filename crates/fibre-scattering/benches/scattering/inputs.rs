//! What is evaluated: directions, offsets and numbers spread evenly.

use glam::Vec3;

/// A direction, an offset and four numbers, by the multiples of irrational numbers.
pub fn spread(index: u32) -> (Vec3, f32, [f32; 4]) {
    let fraction = |factor: f64| (f64::from(index) * factor).fract() as f32;
    let u =
        [fraction(0.618_033_988), fraction(0.754_877_666), fraction(0.569_840_291), fraction(0.819_172_513)];
    let sin = 2.0 * u[0] - 1.0;
    let cos = (1.0 - sin * sin).sqrt();
    let (z, y) = (std::f32::consts::TAU * u[1]).sin_cos();
    (Vec3::new(sin, cos * y, cos * z), 2.0 * u[2] - 1.0, u)
}

const COUNT: usize = 256;

/// As many as that, gone round; a hit is paired with another's direction.
pub struct Inputs {
    all: [(Vec3, f32, [f32; 4]); COUNT],
    next: usize,
}

impl Inputs {
    pub fn new() -> Inputs {
        Inputs { all: std::array::from_fn(|index| spread(index as u32)), next: 0 }
    }

    /// The fibre's state at each input's direction and offset.
    pub fn hits<H>(&self, at: impl Fn(Vec3, f32) -> H) -> Vec<H> {
        self.all.iter().map(|&(wo, h, _)| at(wo, h)).collect()
    }

    /// The next input, and the number of the hit it goes with.
    #[inline(always)]
    pub fn next(&mut self) -> (Vec3, f32, [f32; 4], usize) {
        self.next = (self.next + 1) % COUNT;
        let (direction, h, u) = self.all[self.next];
        (direction, h, u, (self.next * 7 + 3) % COUNT)
    }
}
