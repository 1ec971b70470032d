#!/usr/bin/env python3
"""Loads USD files in Blender and compares the strands with what they should be.

usage: usd.py FILE EXPECTED.json [FILE EXPECTED.json ...]

EXPECTED holds `counts` (points a strand), `positions` (all coordinates), `radii` and, for a file that moves,
`frames`: {frame: coordinates}. Exit 0: all equal. 1: something differs. 2: no Blender, or a file it cannot load.
"""

import json
import sys

try:
    import bpy
except ImportError:
    print("skipped: this Python has no Blender (python -m pip install bpy)", file=sys.stderr)
    sys.exit(2)

import numpy as np

RADIUS_TOLERANCE = 1e-6


def coordinates(curves):
    values = np.empty(3 * len(curves.points), np.float32)
    curves.attributes["position"].data.foreach_get("vector", values)
    return values


def differences(path, expected):
    """Yields what is wrong with the file, in words."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=path)
    objects = [item for item in bpy.data.objects if item.type == "CURVES"]
    if len(objects) != 1:
        yield f"{len(objects)} hair objects, expected 1"
        return
    curves = objects[0].data
    counts = [curve.points_length for curve in curves.curves]
    if counts != expected["counts"]:
        yield f"{len(counts)} strands of {sum(counts)} points, expected {len(expected['counts'])} of {sum(expected['counts'])}"
        return
    if not np.array_equal(coordinates(curves), np.array(expected["positions"], np.float32)):
        yield "positions differ"
    radii = np.empty(len(curves.points), np.float32)
    curves.attributes["radius"].data.foreach_get("value", radii)
    if not np.allclose(radii, expected["radii"], rtol=RADIUS_TOLERANCE, atol=0):
        yield f"radii differ: the first is {radii[0]}, expected {expected['radii'][0]}"
    for frame, positions in expected.get("frames", {}).items():
        bpy.context.scene.frame_set(int(frame))
        moved = objects[0].evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        if not np.array_equal(coordinates(moved), np.array(positions, np.float32)):
            yield f"positions differ at frame {frame}"


def main(arguments):
    if not arguments or len(arguments) % 2:
        print(__doc__, file=sys.stderr)
        return 2
    wanting = False
    for path, expected in zip(arguments[::2], arguments[1::2]):
        with open(expected, encoding="utf-8") as file:
            expected = json.load(file)
        try:
            found = list(differences(path, expected))
        except RuntimeError as error:
            print(f"error: {path}: {error}", file=sys.stderr)
            return 2
        for line in found:
            print(f"{path}: {line}")
        wanting |= bool(found)
    return int(wanting)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
