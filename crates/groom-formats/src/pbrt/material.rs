//! pbrt's hair material.

use glam::Vec3;
use groom::{Groom, Vec3View};

use crate::{Format, Look, Warning};

/// The azimuthal roughness pbrt takes when none is given.
const BETA_N: f64 = 0.3;

/// The darkest colour that has an absorption, well below what can be seen.
const BLACK: f64 = 1e-4;

/// The statement for a look, else for the colour of the strands.
pub(crate) fn statement(groom: &Groom, look: Option<&Look>, warnings: &mut Vec<Warning>) -> String {
    if let Some(look) = look {
        return format!(
            "Material \"hair\" \"rgb sigma_a\" [ {} ] \"float beta_m\" [ {} ] \"float beta_n\" [ {} ] \
             \"float alpha\" [ {} ] \"float eta\" [ {} ]\n",
            list(look.absorption.map(f64::from)),
            look.beta_m,
            look.beta_n,
            -look.alpha.to_degrees(),
            look.eta
        );
    }
    match mean_color(groom, warnings) {
        Some(color) => format!("Material \"hair\" \"rgb sigma_a\" [ {} ]\n", list(absorption(color))),
        None => "Material \"hair\"\n".to_owned(),
    }
}

/// The colour all strands have, or the mean of them with a warning.
fn mean_color(groom: &Groom, warnings: &mut Vec<Warning>) -> Option<[f64; 3]> {
    let mean = |colors: &[Vec3]| {
        let sum = colors.iter().fold([0.0; 3], |sum, color| {
            let color = color.to_array();
            std::array::from_fn(|i| sum[i] + f64::from(color[i]))
        });
        sum.map(|sum: f64| sum / colors.len() as f64)
    };
    match groom.colors()? {
        Vec3View::Constant(color) => Some(color.to_array().map(f64::from)),
        Vec3View::Strand(colors) | Vec3View::Vertex(colors) => {
            if colors.iter().any(|color| *color != colors[0]) {
                warnings.push(Warning::Averaged { format: Format::Pbrt, name: groom::names::COLOR });
            }
            Some(mean(colors))
        }
    }
}

/// The absorption at which hair of pbrt's default roughness has this colour.
fn absorption(color: [f64; 3]) -> [f64; 3] {
    let b = BETA_N;
    let scale =
        5.969 - 0.215 * b + 2.532 * b.powi(2) - 10.73 * b.powi(3) + 5.574 * b.powi(4) + 0.245 * b.powi(5);
    color.map(|value| (value.clamp(BLACK, 1.0).ln() / scale).powi(2))
}

/// Three numbers in pbrt's notation, as floats.
fn list(values: [f64; 3]) -> String {
    values.map(|value| (value as f32).to_string()).join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_absorbs_nothing_and_darker_more() {
        assert_eq!(absorption([1.0, 2.0, 1.0]), [0.0; 3]);
        let [a, b, c] = absorption([0.5, 0.1, 0.0]);
        assert!(0.0 < a && a < b && b < c && c.is_finite());
        // pbrt's own formula by hand: (ln 0.5 / 5.9058...)^2.
        assert!((a - 0.013_8).abs() < 1e-4, "{a}");
    }
}
