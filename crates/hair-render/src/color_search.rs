//! The search for one channel's absorption.

use serde::Serialize;

/// More absorption per fibre radius than this changes nothing that could be seen: what is left is what the
/// fibres' surfaces reflect.
const MOST: f64 = 100.0;

/// A step towards 0 below this share of the last is taken at once.
const LEAST: f64 = 1e-5;

/// Whether a channel of a colour could be had.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reach {
    /// Within the tolerance, or the noise of the probe where that is larger.
    Reached,
    /// Fibres that absorb nothing are still darker: what light is missing was swallowed by meshes or by a
    /// cap on bounces, or the colour asks for more light than there is.
    TooBright,
    /// Fibres that swallow all that enters them are still lighter: their surfaces reflect that much.
    TooDark,
    /// There were not enough probes.
    NotYet,
}

/// A bracket about the absorption of one channel. More absorption is never lighter, so it can only shrink.
///
/// Steps are taken in the root of the absorption and the logarithm of the colour, between which Chiang's
/// fit is a straight line: a chord of the bracket lands near the answer. A step that leaves more than half of
/// the bracket is followed by a plain bisection, so the search never crawls.
#[derive(Clone, Debug)]
pub(crate) struct Channel {
    wanted: f64,
    /// Root of an absorption that is too light, and the colour with it.
    light: Option<(f64, f64)>,
    /// The same of one that is too dark.
    dark: Option<(f64, f64)>,
    last: (f64, f64),
    /// How many probes there were before both sides were known.
    one_sided: u32,
    width: f64,
    bisect: bool,
    reach: Reach,
}

impl Channel {
    pub fn new(wanted: f64) -> Channel {
        Channel {
            wanted,
            light: None,
            dark: None,
            last: (0.0, 1.0),
            one_sided: 0,
            width: f64::INFINITY,
            bisect: false,
            reach: Reach::NotYet,
        }
    }

    /// Takes in that `sigma` gave `color`, which is as wanted if `near` to it.
    pub fn learn(&mut self, sigma: f64, color: f64, near: f64) {
        let x = sigma.sqrt();
        self.last = (x, color);
        self.reach = if (color - self.wanted).abs() <= near {
            Reach::Reached
        } else if color > self.wanted && sigma >= MOST {
            Reach::TooDark
        } else if color < self.wanted && sigma <= 0.0 {
            Reach::TooBright
        } else {
            Reach::NotYet
        };
        // Noise may contradict what was learned before; the newer probe counts, and the bracket gives way.
        if color >= self.wanted {
            self.light = Some((x, color));
            self.dark = self.dark.filter(|&(dark, _)| dark > x);
        } else {
            self.dark = Some((x, color));
            self.light = self.light.filter(|&(light, _)| light < x);
        }
        if self.light.is_none() || self.dark.is_none() {
            self.one_sided += 1;
        }
        let width = match (self.light, self.dark) {
            (Some((light, _)), Some((dark, _))) => dark - light,
            _ => f64::INFINITY,
        };
        self.bisect = !self.bisect && width > 0.5 * self.width;
        self.width = width;
    }

    pub fn reach(&self) -> Reach {
        self.reach
    }

    /// Whether nothing is gained by another probe.
    pub fn is_settled(&self) -> bool {
        self.reach != Reach::NotYet
    }

    /// The absorption to look at next; the last one once settled.
    pub fn next(&self) -> f64 {
        let (x, color) = self.last;
        if self.is_settled() {
            return x * x;
        }
        let log = |color: f64| color.max(1e-4).ln();
        let along = |color: f64| log(self.wanted) / log(color).min(-1e-6);
        let guess = match (self.light, self.dark) {
            (Some((light, _)), Some((dark, _))) if self.bisect => 0.5 * (light + dark),
            (Some((light, above)), Some((dark, below))) => {
                let slope = (log(below) - log(above)) / (dark - light);
                let guess = light + (log(self.wanted) - log(above)) / slope;
                let margin = 0.05 * (dark - light);
                if guess.is_finite() {
                    guess.clamp(light + margin, dark - margin)
                } else {
                    0.5 * (light + dark)
                }
            }
            // Only one side is known: along the line from white hair, at first carefully.
            (None, _) => {
                let most = if self.one_sided > 1 { 0.5 } else { 0.95 };
                let guess = x * along(color).clamp(0.0, most);
                if guess * guess < LEAST { 0.0 } else { guess }
            }
            (Some(_), None) => {
                let least = if self.one_sided > 1 { 2.0 } else { 1.05 };
                let guess = if x > 0.0 { x * along(color).clamp(least, 4.0) } else { 0.03 };
                guess.min(MOST.sqrt())
            }
        };
        guess * guess
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looks at `of(sigma)` until settled; the last sigma and how many looks it took.
    fn run(of: impl Fn(f64) -> f64, wanted: f64, start: f64) -> (f64, Reach, u32) {
        let mut channel = Channel::new(wanted);
        let mut sigma = start;
        for looks in 1..40 {
            channel.learn(sigma, of(sigma), 1e-3);
            if channel.is_settled() {
                return (sigma, channel.reach(), looks);
            }
            sigma = channel.next();
        }
        (sigma, Reach::NotYet, 40)
    }

    #[test]
    fn the_answer_is_found_from_any_start() {
        // Hair of that kind: a fit with another slope over a floor of reflection.
        let hair = |sigma: f64| 0.04 + 0.93 * (-7.3 * sigma.sqrt() - 0.3 * sigma).exp();
        for wanted in [0.05, 0.1, 0.3, 0.6, 0.9, 0.96] {
            for start in [0.0, 1e-4, 0.02, 0.3, 5.0, 99.0] {
                let (sigma, reach, looks) = run(hair, wanted, start);
                assert_eq!(reach, Reach::Reached, "{wanted} from {start}");
                assert!(
                    (hair(sigma) - wanted).abs() <= 1e-3 && looks <= 16,
                    "{wanted} from {start}: {looks}"
                );
            }
        }
    }

    #[test]
    fn what_cannot_be_had_is_told() {
        let hair = |sigma: f64| 0.04 + 0.86 * (-5.0 * sigma.sqrt()).exp();
        for start in [0.0, 0.1, 3.0] {
            let (bright, dark) = (run(hair, 0.95, start), run(hair, 0.01, start));
            assert_eq!((bright.1, bright.0), (Reach::TooBright, 0.0));
            assert_eq!((dark.1, dark.0), (Reach::TooDark, MOST));
            assert!(bright.2 < 16 && dark.2 < 16, "{} {}", bright.2, dark.2);
        }
    }
}
