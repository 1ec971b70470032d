"""What Blender makes of glTF files: python gltf.py QUESTIONS.json, in a Python that has bpy.

QUESTIONS.json is a list of files with what should be in them: points (z up, metres), widths, the number of edges
(lines) or faces (tubes, ribbons), and the vertices a point (`sides`). Exit 0: all as expected. 1: not.
"""

import json
import sys

import bpy
import numpy


def load(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    # Without merging, vertices keep their order.
    bpy.ops.import_scene.gltf(filepath=path, merge_vertices=False)
    meshes = [thing for thing in bpy.data.objects if thing.type == "MESH"]
    assert len(meshes) == 1, f"{len(meshes)} meshes"
    return meshes[0]


def positions_of(thing):
    found = numpy.empty(len(thing.data.vertices) * 3, dtype=numpy.float32)
    thing.data.vertices.foreach_get("co", found)
    world = numpy.array(thing.matrix_world)
    return found.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3], float(numpy.cbrt(numpy.linalg.det(world[:3, :3])))


def check(question):
    thing = load(question["path"])
    found, scale = positions_of(thing)
    points, widths = numpy.array(question["points"]), numpy.array(question["widths"])
    size = float((points.max(axis=0) - points.min(axis=0)).max())
    bits = question["path"]
    tolerance = size / (4095 if "12 bits" in bits else 60000) + 1e-6
    if question["sides"] == 0:
        assert len(thing.data.edges) == question["edges"], f"{len(thing.data.edges)} edges"
        assert numpy.abs(found - points).max() <= tolerance, "positions differ"
        attribute = thing.data.attributes["_WIDTH"]
        values = numpy.empty(len(points), dtype=numpy.float32)
        attribute.data.foreach_get("value", values)
        assert numpy.allclose(values * scale, widths, rtol=1e-5, atol=1e-9), "widths differ"
        return
    sides = question["sides"]
    assert len(thing.data.polygons) == question["faces"], f"{len(thing.data.polygons)} faces"
    rings = found.reshape(-1, sides, 3)
    assert len(rings) == len(points), f"{len(rings)} rings"
    middle = rings.mean(axis=1)
    assert numpy.abs(middle - points).max() <= tolerance, "the axis differs"
    away = numpy.linalg.norm(rings - points[:, None], axis=2)
    assert numpy.abs(away - widths[:, None] / 2).max() <= 2 * tolerance, "the radius differs"


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        questions = json.load(file)
    wrong = 0
    for question in questions:
        try:
            check(question)
        except (AssertionError, KeyError) as error:
            wrong += 1
            print(f"{question['path']}: {error}")
    print(f"{len(questions)} files, {wrong} not as expected")
    return 1 if wrong else 0


if __name__ == "__main__":
    # Leaves at once: Blender's own shutdown is slow.
    code = main()
    sys.stdout.flush()
    sys.exit(code)
