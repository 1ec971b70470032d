//! What pipelines do without, and why that changes no picture.

use crate::schema::{BlurBy, Pipeline, Turning};

/// What it is, why it is left out, and whether a pipeline does without it.
type Case = (&'static str, &'static str, fn(&Pipeline) -> bool);

const CASES: [Case; 16] = [
    ("mesh", "the pipeline names none", |p| p.mesh.is_none()),
    ("environment", "the pipeline names none", |p| p.lights.environment.is_none()),
    ("area lights", "the pipeline names none", |p| p.lights.area.is_empty()),
    ("walls about the scene", "the pipeline has no `lights.cornell`", |p| p.lights.cornell.is_none()),
    ("light passes", "`render.aovs` asks for none", |p| p.render.aovs.is_empty()),
    ("animation", "the pipeline has no `motion`: files are read as they stand", |p| p.motion.is_none()),
    ("keys within a frame", "`motion.blur` is off: every picture is of one instant", |p| {
        p.motion.as_ref().is_some_and(|motion| motion.blur == Some(BlurBy::Off))
    }),
    ("a scene for each frame", "nothing moves but the camera: one serves all", |p| {
        p.motion.is_none() && p.turntable.turn == Turning::Camera
    }),
    ("binding strands to the mesh", "the pipeline has no `bind`", |p| p.mesh.is_some() && p.bind.is_none()),
    ("the camera's way within a frame", "`camera.blur` is off", |p| !p.camera.blur),
    ("framing by the scene's size", "the camera is that of `camera.file`", |p| p.camera.file.is_some()),
    ("contact sheet", "the pipeline has no `sheet`", |p| p.sheet.is_none()),
    ("film", "the pipeline has no `video`", |p| p.video.is_empty()),
    ("page", "the pipeline has no `page`", |p| p.page.is_none()),
    ("PNG frames", "`tone.frames` is off", |p| !p.tone.frames),
    ("converted files", "`convert` lists none", |p| p.convert.is_empty()),
];

/// What none of these pipelines has, and why.
pub(crate) fn left_out<'a>(
    pipelines: impl Iterator<Item = &'a Pipeline> + Clone,
) -> impl Iterator<Item = (&'static str, &'static str)> {
    let by_all = move |(_, _, is_left_out): &Case| pipelines.clone().all(is_left_out);
    CASES.into_iter().filter(by_all).map(|(what, why, _)| (what, why))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expand::of_text;

    #[test]
    fn what_some_variant_has_is_not_left_out() {
        let text = "version: 1
groom: {sample: {}}
matrix:
  light:
    sky: {lights: {environment: {studio: true}}}
    lamp: {lights: {area: [{position: [0, 0, 9], target: [0, 0, 0], size: [1, 1], radiance: [1, 1, 1]}]}}
";
        let variants = of_text(text, &[]).unwrap();
        let names = |only: &[usize]| -> Vec<&str> {
            left_out(only.iter().map(|&index| &variants[index].pipeline)).map(|(what, _)| what).collect()
        };
        assert!(names(&[0]).contains(&"area lights") && !names(&[0]).contains(&"environment"));
        assert!(names(&[1]).contains(&"environment") && !names(&[1]).contains(&"area lights"));
        let both = names(&[0, 1]);
        assert!(!both.contains(&"area lights") && !both.contains(&"environment"), "{both:?}");
        assert!(both.contains(&"mesh") && both.contains(&"animation"), "{both:?}");
    }
}
