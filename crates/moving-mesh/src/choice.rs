//! Which animation is meant.

use crate::error::Fault;
use crate::{Animation, AnimationChoice};

impl AnimationChoice {
    /// Its number among those there are.
    pub(crate) fn among(&self, animations: &[Animation]) -> Result<Option<usize>, Fault> {
        let found = match self {
            AnimationChoice::None => return Ok(None),
            AnimationChoice::First => return Ok((!animations.is_empty()).then_some(0)),
            AnimationChoice::Name(name) => animations.iter().position(|a| a.name == *name),
            AnimationChoice::Index(index) => Some(*index).filter(|&index| index < animations.len()),
        };
        found.map(Some).ok_or_else(|| {
            let asked = match self {
                AnimationChoice::Index(index) => format!("number {index}"),
                AnimationChoice::Name(name) => format!("{name:?}"),
                AnimationChoice::First | AnimationChoice::None => String::new(),
            };
            let names: Vec<String> =
                animations.iter().enumerate().map(|(i, a)| format!("{i} {:?}", a.name)).collect();
            let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            Fault::NoAnimation { asked, known }
        })
    }
}
