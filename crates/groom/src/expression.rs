//! Values of attributes as people write them.

use std::str::FromStr;

use glam::{Vec2, Vec3};

use crate::{Attribute, Domain, Groom, GroomError, Values, names, random};

/// What an expression's text must be.
const TEXT: &str = "a number, `a~b` (for each strand another one from a-b to a+b), two or three of them as \
                    1,2,3, or a whole number as int:3";

/// A value for an attribute: one for all, or for each strand another one around a middle.
///
/// As text, each of up to three components is `0.6` or `0.6~0.1`: evenly distributed from 0.5 to 0.7, by
/// the hash of seed, strand id and name that [`random`] gives. `int:3` is a whole number.
///
/// ```
/// # use groom::{Expression, Groom};
/// # let mut groom = Groom::new(vec![0, 1], vec![glam::Vec3::ZERO])?;
/// let melanin: Expression = "0.6~0.1".parse()?;
/// groom.set("melanin", &melanin, 7)?;
/// # Ok::<(), groom::GroomError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    kind: Kind,
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Int(i32),
    /// One to three of them.
    Numbers(Vec<Around>),
}

/// Numbers from `middle - spread` to `middle + spread`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Around {
    middle: f32,
    spread: f32,
}

impl Around {
    fn parse(word: &str) -> Option<Around> {
        let number = |word: &str| word.trim().parse().ok().filter(|v: &f32| v.is_finite());
        let (middle, spread) = word.split_once('~').unwrap_or((word, "0"));
        let around = Around { middle: number(middle)?, spread: number(spread)? };
        (around.spread >= 0.0 && around.low().is_finite() && around.high().is_finite()).then_some(around)
    }

    fn low(self) -> f32 {
        self.middle - self.spread
    }

    fn high(self) -> f32 {
        self.middle + self.spread
    }

    fn value(self, seed: u64, id: u32, purpose: &str) -> f32 {
        if self.spread == 0.0 {
            return self.middle;
        }
        let value = self.middle + self.spread * (2.0 * random(seed, id, purpose) - 1.0);
        value.clamp(self.low(), self.high())
    }

    fn times(self, factor: f32) -> Around {
        Around { middle: self.middle * factor, spread: self.spread * factor }
    }
}

impl FromStr for Expression {
    type Err = GroomError;

    fn from_str(text: &str) -> Result<Self, GroomError> {
        let refused = || GroomError::argument("value", format!("`{text}`"), TEXT);
        if let Some(whole) = text.trim().strip_prefix("int:") {
            let kind = Kind::Int(whole.trim().parse().map_err(|_| refused())?);
            return Ok(Expression { kind });
        }
        let numbers: Option<Vec<_>> = text.split(',').map(Around::parse).collect();
        match numbers.filter(|numbers| numbers.len() <= 3) {
            Some(numbers) => Ok(Expression { kind: Kind::Numbers(numbers) }),
            None => Err(refused()),
        }
    }
}

impl Groom {
    /// Gives the attribute `name` the value of `expression`: one for the groom, or one a strand when it is
    /// random. `width` sets the radius to half.
    ///
    /// A strand's number depends on `seed`, its id and the attribute's name (with `.1` and `.2` for the
    /// second and third component), and so survives thinning out and reordering.
    ///
    /// # Errors
    /// [`GroomError::AttributeType`] when a standard name needs another type, [`GroomError::Argument`] for
    /// values out of the name's range, for whole numbers that are not, and for `id`, which no two strands
    /// may share.
    pub fn set(&mut self, name: &str, expression: &Expression, seed: u64) -> Result<(), GroomError> {
        check_range(name, &expression.kind)?;
        let (name, kind) = match (name, &expression.kind) {
            (names::ID, _) => {
                return Err(GroomError::argument("id", "one value for all", "one of its own a strand"));
            }
            ("width", Kind::Numbers(n)) => {
                (names::RADIUS, Kind::Numbers(n.iter().map(|a| a.times(0.5)).collect()))
            }
            ("width", Kind::Int(value)) => {
                (names::RADIUS, Kind::Numbers(vec![Around { middle: *value as f32 * 0.5, spread: 0.0 }]))
            }
            (name, kind) => (name, as_standard(name, kind)?),
        };
        let attribute = match &kind {
            Kind::Int(value) => Attribute { domain: Domain::Groom, values: Values::Int(vec![*value]) },
            Kind::Numbers(numbers) => self.numbers(name, numbers, seed),
        };
        self.set_attribute(name, attribute)
    }

    fn numbers(&self, name: &str, numbers: &[Around], seed: u64) -> Attribute {
        let is_random = numbers.iter().any(|a| a.spread != 0.0);
        let (domain, count) =
            if is_random { (Domain::Strand, self.strand_count()) } else { (Domain::Groom, 1) };
        let column = |i: usize, around: Around| -> Vec<f32> {
            let purpose = if i == 0 { name.to_owned() } else { format!("{name}.{i}") };
            let id = |strand| if is_random { self.strand_id(strand) } else { 0 };
            (0..count).map(|strand| around.value(seed, id(strand), &purpose)).collect()
        };
        let mut columns = numbers.iter().enumerate().map(|(i, &around)| column(i, around));
        let values = match (columns.next(), columns.next(), columns.next()) {
            (Some(x), Some(y), Some(z)) => {
                Values::Vec3(x.iter().zip(&y).zip(&z).map(|((&x, &y), &z)| Vec3::new(x, y, z)).collect())
            }
            (Some(x), Some(y), None) => {
                Values::Vec2(x.iter().zip(&y).map(|(&x, &y)| Vec2::new(x, y)).collect())
            }
            (x, ..) => Values::Float(x.unwrap_or_default()),
        };
        Attribute { domain, values }
    }
}

/// The value in the type its standard name wants, where a number can be taken either way.
fn as_standard(name: &str, kind: &Kind) -> Result<Kind, GroomError> {
    let whole = matches!(name, names::GROUP | names::GUIDE | names::CLOSEST_GUIDE);
    match kind {
        Kind::Numbers(numbers) if whole => match numbers[..] {
            [Around { middle, spread: 0.0 }] if middle == middle.trunc() && middle.abs() < 16_777_216.0 => {
                Ok(Kind::Int(middle as i32))
            }
            _ => Err(GroomError::argument("group or guide", "no whole number", "a whole number, as int:3")),
        },
        Kind::Int(value) if standard_float(name) => {
            Ok(Kind::Numbers(vec![Around { middle: *value as f32, spread: 0.0 }]))
        }
        other => Ok(other.clone()),
    }
}

fn standard_float(name: &str) -> bool {
    matches!(name, names::RADIUS | names::TRANSPARENCY | names::MELANIN | names::REDNESS)
}

fn check_range(name: &str, kind: &Kind) -> Result<(), GroomError> {
    let (range, what, expected) = match name {
        "width" => (0.0..=f32::MAX, "width", "0 or more"),
        names::RADIUS => (0.0..=f32::MAX, "radius", "0 or more"),
        names::TRANSPARENCY => (0.0..=1.0, "transparency", "0 to 1"),
        names::MELANIN => (0.0..=1.0, "melanin", "0 to 1"),
        names::REDNESS => (0.0..=1.0, "redness", "0 to 1"),
        names::COLOR => (0.0..=1.0, "colour", "channels from 0 to 1"),
        _ => return Ok(()),
    };
    let outside = |a: &&Around| !(range.contains(&a.low()) && range.contains(&a.high()));
    match kind {
        Kind::Int(value) if !range.contains(&(*value as f32)) => {
            Err(GroomError::argument(what, value, expected))
        }
        Kind::Int(_) => Ok(()),
        Kind::Numbers(numbers) => match numbers.iter().find(outside) {
            Some(Around { middle, spread: 0.0 }) => Err(GroomError::argument(what, middle, expected)),
            Some(Around { middle, spread }) => {
                Err(GroomError::argument(what, format!("{middle}~{spread}"), expected))
            }
            None => Ok(()),
        },
    }
}
