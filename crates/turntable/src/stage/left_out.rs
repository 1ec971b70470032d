//! What the frames of a pipeline do without, and why that changes no picture.

use crate::schema::{BlurBy, Pipeline, Turning};

/// What is not read, built or looked at, and why.
pub(crate) fn left_out(pipeline: &Pipeline) -> Vec<(&'static str, &'static str)> {
    let Pipeline { motion, bind, mesh, camera, turntable, lights, .. } = pipeline;
    let blurs = motion.as_ref().is_some_and(|motion| motion.blur != Some(BlurBy::Off));
    let still = motion.is_none() && turntable.turn == Turning::Camera;
    let cases = [
        (motion.is_none(), "animation", "the pipeline has no `motion`: files are read as they stand"),
        (
            motion.is_some() && !blurs,
            "keys within a frame",
            "`motion.blur` is off: every picture is of one instant",
        ),
        (still, "a scene for each frame", "nothing moves but the camera: one serves all"),
        (mesh.is_some() && bind.is_none(), "binding strands to the mesh", "the pipeline has no `bind`"),
        (!camera.blur, "the camera's way within a frame", "`camera.blur` is off"),
        (camera.file.is_some(), "framing by the scene's size", "the camera is that of `camera.file`"),
        (lights.cornell.is_none(), "walls about the scene", "the pipeline has no `lights.cornell`"),
    ];
    cases.into_iter().filter(|(is_left_out, ..)| *is_left_out).map(|(_, what, why)| (what, why)).collect()
}
