"""What Blender makes of strands that move: python motion.py QUESTIONS.json, in a Python that has bpy.

QUESTIONS.json is a list of files with what should be in them: `path`, `fps` of the scene, `frames` {frame: points, z up,
in metres}, `velocity` (the vector that the attribute `velocity` of every point holds, or null), `tolerance`, and
`blur` (null, or how far apart the ends of one frame's blur are along x with the shutter open for a whole frame, and
the frame, as Cycles renders it). Exit 0: all as expected. 1: not.
"""

import json
import sys
import tempfile

import bpy
import numpy

IMPORTERS = {
    "usd": lambda path: bpy.ops.wm.usd_import(filepath=path),
    "abc": lambda path: bpy.ops.wm.alembic_import(filepath=path),
    "glb": lambda path: bpy.ops.import_scene.gltf(filepath=path, merge_vertices=False),
}


def load(question):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = question["fps"]
    IMPORTERS[question["path"].rsplit(".", 1)[1][:3]](question["path"])
    # An importer may leave shapes for bones behind.
    moving = [thing for thing in bpy.data.objects if thing.type in ("CURVES", "MESH") and "Icosphere" not in thing.name]
    assert len(moving) == 1, f"{[thing.name for thing in moving]}, expected one"
    return moving[0]


def vectors(attribute):
    found = numpy.empty(len(attribute.data) * 3, dtype=numpy.float32)
    attribute.data.foreach_get("vector", found)
    return found.reshape(-1, 3)


def points_of(thing, frame):
    bpy.context.scene.frame_set(int(frame), subframe=frame - int(frame))
    data = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    world = numpy.array(thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world)
    points = vectors(data.attributes["position"])
    return points.astype(float) @ world[:3, :3].T + world[:3, 3], data


def blur_ends(thing, frame):
    """The ends of what is seen along x, from above."""
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 64, False
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
    scene.render.film_transparent = True
    scene.render.resolution_x, scene.render.resolution_y = 512, 8
    camera = bpy.data.cameras.new("above")
    camera.type, camera.ortho_scale = "ORTHO", 16
    above = bpy.data.objects.new("above", camera)
    above.location = (0, 0, 50)
    scene.collection.objects.link(above)
    scene.camera = above
    scene.frame_set(frame)
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath, scene.render.image_settings.file_format = f"{folder}/blur.exr", "OPEN_EXR"
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        alpha = numpy.array(image.pixels[:]).reshape(8, 512, 4)[4, :, 3]
    seen = numpy.flatnonzero(alpha > 0.01)
    return (seen.max() + 1 - seen.min()) * 16 / 512


def check(question):
    thing = load(question)
    for frame, expected in question["frames"].items():
        found, data = points_of(thing, float(frame))
        expected = numpy.array(expected).reshape(-1, 3)
        assert found.shape == expected.shape, f"frame {frame}: {len(found)} points, expected {len(expected)}"
        off = numpy.abs(found - expected).max()
        assert off <= question["tolerance"], f"frame {frame}: positions are off by {off}"
        if question["velocity"] is not None:
            velocities = vectors(data.attributes["velocity"])
            assert numpy.array_equal(velocities, numpy.float32([question["velocity"]] * len(found))), (
                f"frame {frame}: velocities {velocities[:2]}, expected {question['velocity']}"
            )
        elif question["path"].endswith("abc"):
            assert "velocity" not in data.attributes, "Blender reads velocities of Alembic curves after all"
    if question["blur"] is not None:
        frame, expected = question["blur"]
        found = blur_ends(thing, frame)
        # Two pixels, the width of the strand and the falling edge.
        assert abs(found - expected) <= 0.15, f"blurred over {found}, expected {expected}"


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        questions = json.load(file)
    wrong = 0
    for question in questions:
        try:
            check(question)
        except (AssertionError, KeyError, RuntimeError) as error:
            wrong += 1
            print(f"{question['path']}: {error!r}")
    print(f"{len(questions)} files, {wrong} not as expected")
    return 1 if wrong else 0


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    sys.exit(code)
