//! Settings of a pipeline as the renderer takes them.

use glam::Vec3;
use hair_render::{
    Aov, AovSet, Backdrop, Background, Blur, Curve, RenderError, RenderSettings, Shutter, ShutterShape,
    ToneMapping,
};
use moving_scene::Exposure;

use crate::schema::{BlurBy, MotionSettings, Render, Tone, ToneCurve};

/// The renderer's settings of a view; the noise of views must differ, so each has its own seed.
pub(crate) fn render_settings(source: &Render, seed: u64, threads: Option<usize>) -> RenderSettings {
    let all = source.aovs.iter().any(|name| name.eq_ignore_ascii_case("all"));
    let aovs = if all {
        AovSet::all()
    } else {
        source.aovs.iter().filter_map(|name| Aov::from_name(name)).collect()
    };
    RenderSettings {
        width: source.width,
        height: source.height,
        spp: source.spp,
        seed,
        max_bounces: source.max_bounces,
        threads,
        aovs,
        background: if source.transparent { Background::Transparent } else { Background::Visible },
        ..RenderSettings::default()
    }
}

/// How frames become display colours.
pub(crate) fn tone_mapping(tone: &Tone) -> ToneMapping {
    let curve = match tone.curve {
        ToneCurve::Neutral => Curve::Neutral,
        ToneCurve::Clip => Curve::Clip,
    };
    let backdrop = Backdrop::Solid(Vec3::from_array(tone.background));
    ToneMapping { exposure: tone.exposure, curve, backdrop }
}

/// How pictures are exposed; without `motion` as with none of its keys.
pub(super) fn exposure(motion: Option<&MotionSettings>) -> Result<Exposure, RenderError> {
    let Some(motion) = motion else { return Ok(Exposure::default()) };
    let [open, close] = motion.shutter;
    let shape: ShutterShape = motion.shape.parse()?;
    let blur = motion.blur.map(|by| match by {
        BlurBy::Off => Blur::Off,
        BlurBy::Positions => Blur::Positions,
        BlurBy::Velocities => Blur::Velocities,
        BlurBy::Accelerations => Blur::Accelerations,
    });
    let samples = motion.samples.map(|samples| samples as usize);
    Ok(Exposure { shutter: Shutter::new(open, close, shape)?, blur, samples, frame_rate: motion.fps })
}
