//! The colour that was picked, on this groom.

use anyhow::{Context, Result, bail};
use command_line::{Bar, say};
use fibre_material::Varying;
use glam::Vec3;
use hair_render::{
    Camera, ColorMatch, ColorMatching, HairColor, HairObject, Progress, Reach, RenderError, RenderSettings,
    Scene,
};

/// Shows tiles on a bar and stops on Ctrl-C.
struct OnBar(Bar);

impl Progress for OnBar {
    fn advance(&self, done: u64, total: u64) {
        self.0.set_len(total);
        self.0.set(done);
    }

    fn cancelled(&self) -> bool {
        command_line::interrupted()
    }
}

/// The colour that the hair was given, where it is one for all strands: what is matched is one absorption.
pub fn picked(hair: &[HairObject]) -> Result<Vec3> {
    let HairObject { groom, material, .. } = hair.first().context("no groom given")?;
    let fibre = &material.fibre;
    let what = match fibre.color {
        HairColor::Color(color) => match fibre.dress(groom)?.absorption {
            Varying::Constant(_) => return Ok(color),
            _ => "a colour that the variation changes along strands or from one to the next",
        },
        HairColor::Groom { .. } => "the groom's own colour",
        HairColor::GroomMelanin { .. } => "the groom's own melanin",
        HairColor::Ramp(_) => "colours from root to tip",
        HairColor::Texture(_) => "a texture",
        HairColor::Melanin { .. } => "melanin",
        HairColor::Pigments { .. } => "pigments",
        HairColor::Absorption(_) => "an absorption",
    };
    bail!("--match-color: the hair has {what}, expected one colour (--color, or `color` in the material)")
}

/// Gives the hair the absorption that makes it `color`, and says how that went; `None` when Ctrl-C
/// stopped it.
pub fn run(
    color: Vec3,
    scene: &mut Scene,
    camera: &Camera,
    settings: &RenderSettings,
) -> Result<Option<ColorMatch>> {
    let bar = OnBar(command_line::progress_bar(1, "matching the colour"));
    let matching = ColorMatching { color, ..ColorMatching::default() };
    let result = hair_render::match_color(scene, camera, settings, &matching, &bar);
    bar.0.finish();
    let found = match result {
        Err(RenderError::Cancelled) => return Ok(None),
        found => found?,
    };
    let [r, g, b] = found.absorption;
    say(&format!(
        "colour matched by absorption {r:.4},{g:.4},{b:.4}: {:.4} off (Chiang's fit: {:.4}), {} probes, {:.2} s",
        found.error, found.fit_error, found.probes, found.seconds
    ));
    for (channel, reach) in ["red", "green", "blue"].into_iter().zip(found.reach) {
        if let Some(why) = not_reached(reach) {
            say(&format!("warning: {channel} is not reached: {why}"));
        }
    }
    Ok(Some(found))
}

fn not_reached(reach: Reach) -> Option<&'static str> {
    match reach {
        Reach::Reached => None,
        Reach::TooBright => Some("hair that absorbs nothing is still darker"),
        Reach::TooDark => Some("what the surfaces of black fibres reflect is still lighter"),
        Reach::NotYet => Some("the probes were used up"),
    }
}
