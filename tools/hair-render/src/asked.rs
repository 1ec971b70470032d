//! What the arguments ask of the renderer, and what they leave to be said beside the picture.

use hair_render::{
    Aov, AovSet, Background, Camera, Crop, Metadata, Precision, RenderSettings, SceneDescription,
};

use crate::args::{Args, Numbers};
use crate::scene::Moment;

/// How the picture is made; its passes are for [`usual_passes`] to say where nobody named any.
pub fn settings(args: &Args) -> RenderSettings {
    let quality = &args.quality;
    RenderSettings {
        width: args.view.width,
        height: args.view.height,
        spp: quality.spp,
        seed: quality.seed,
        max_bounces: quality.max_bounces,
        roulette_start: quality.roulette_start,
        threads: quality.threads,
        crop: args.view.crop.map(|Numbers([x0, x1, y0, y1])| Crop { x0, x1, y0, y1 }),
        background: if args.light.background { Background::Visible } else { Background::Transparent },
        ..RenderSettings::default()
    }
}

/// The passes of a picture when nobody named any: those that hold light.
pub fn usual_passes(description: &SceneDescription) -> AovSet {
    let fur = description.hair.iter().any(|hair| hair.material.fibre.medulla.scatters());
    let scattered = fur.then_some(Aov::Scattered);
    [Aov::R, Aov::Tt, Aov::Trt, Aov::Residual, Aov::Surface].into_iter().chain(scattered).collect()
}

/// What is written into the picture beside its pixels.
pub fn metadata(args: &Args, camera: Camera, moment: Moment, blurred: bool, digest: &str) -> Metadata {
    let named = moment.frame.map(|number| ("frame".to_owned(), number.to_string()));
    Metadata {
        command: command_line::words(),
        digest: digest.to_owned(),
        camera: Some(camera),
        precision: if args.quality.half { Precision::Half } else { Precision::Float },
        frame_rate: (blurred || named.is_some()).then_some(moment.frame_rate),
        exposure_seconds: blurred.then_some(moment.exposure_seconds),
        extra: named.into_iter().collect(),
        ..Metadata::default()
    }
}
