"""What Blender makes of Alembic curves, and curves as Blender writes them.

    python alembic.py check FILE.abc EXPECTED.json    import FILE and compare it with EXPECTED
    python alembic.py export FILE.abc CURVES.json     write CURVES from Blender

Exit codes: 0 done and equal, 1 checked and found wanting, 2 could not (a line starting "skipped:" when there is
no bpy in this Python).

JSON: {"counts": [points of each curve], "up": "y" or "z", "frame_rate": 24,
       "radii": [one a point] or null, "frames": [{"frame": 1, "positions": [x, y, z, ...]}, ...]}
"""

import json
import sys

try:
    import bpy
    import numpy as np
except ImportError as error:
    print(f"skipped: Blender's bpy is not installed in this Python ({error})")
    sys.exit(2)


def array(attributes, name, field, width):
    """A curves attribute as rows, or None."""
    if name not in attributes:
        return None
    values = np.empty(len(attributes[name].data) * width, np.float32)
    attributes[name].data.foreach_get(field, values)
    return values.reshape(-1, width)


def to_z_up(positions, up):
    """Blender takes Alembic for y up and turns it."""
    x, y, z = positions.T
    return np.stack([x, -z, y], 1) if up == "y" else positions


def curves_of(scene):
    """Counts, positions and radii of all curves of the scene as it is now."""
    graph = bpy.context.evaluated_depsgraph_get()
    counts, positions, radii = [], [], []
    for thing in scene.objects:
        if thing.type != "CURVES":
            continue
        curves = thing.evaluated_get(graph).data
        counts += [len(curve.points) for curve in curves.curves]
        world = np.array(thing.matrix_world, np.float32)
        points = array(curves.attributes, "position", "vector", 3)
        positions.append(points @ world[:3, :3].T + world[:3, 3])
        radius = array(curves.attributes, "radius", "value", 1)
        radii.append(np.full(len(points), np.nan) if radius is None else radius[:, 0])
    return counts, np.concatenate(positions), np.concatenate(radii)


def check(path, expected):
    """Every difference in words."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = int(expected["frame_rate"])
    bpy.ops.wm.alembic_import(filepath=path)
    faults = []
    for frame in expected["frames"]:
        time = frame["frame"]
        scene.frame_set(int(time), subframe=time - int(time))
        counts, positions, radii = curves_of(scene)
        if counts != expected["counts"]:
            faults.append(f"frame {time}: points of the curves {counts[:8]}, expected {expected['counts'][:8]}")
            continue
        wanted = np.array(frame["positions"], np.float32).reshape(-1, 3)
        # Blender reads the file as y up, whatever its numbers mean.
        difference = np.abs(positions - to_z_up(wanted, "y")).max()
        if not difference <= expected.get("tolerance", 0):
            faults.append(f"frame {time}: positions differ by {difference}")
        if expected["radii"] is not None:
            difference = np.abs(radii - np.array(expected["radii"], np.float32)).max()
            if not difference == 0:
                faults.append(f"frame {time}: radii differ by {difference}")
    return faults


def export(path, wanted):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = int(wanted["frame_rate"])
    data = bpy.data.hair_curves.new("hair")
    data.add_curves(wanted["counts"])
    data.position_data.foreach_set("vector", np.array(wanted["frames"][0]["positions"], np.float32))
    if wanted["radii"] is not None:
        radius = data.attributes.get("radius") or data.attributes.new("radius", "FLOAT", "POINT")
        radius.data.foreach_set("value", np.array(wanted["radii"], np.float32))
    kind = {"poly": 1, "catmull_rom": 0, "bspline": 3}[wanted.get("type", "poly")]
    if hasattr(data, "set_types"):
        data.set_types(type={1: "POLY", 0: "CATMULL_ROM", 3: "NURBS"}[kind])
    thing = bpy.data.objects.new("hair", data)
    thing.location = wanted.get("location", [0, 0, 0])
    scene.collection.objects.link(thing)
    if "move" in wanted:
        for frame, location in wanted["move"]:
            thing.location = location
            thing.keyframe_insert("location", frame=frame)
        for curve in getattr(thing.animation_data.action, "fcurves", []):
            for key in curve.keyframe_points:
                key.interpolation = "LINEAR"
    first, last = wanted.get("range", [1, 1])
    bpy.context.view_layer.update()
    bpy.ops.wm.alembic_export(filepath=path, start=first, end=last)


def main(arguments):
    if len(arguments) != 3 or arguments[0] not in ("check", "export"):
        print(__doc__)
        return 2
    with open(arguments[2], encoding="utf-8") as file:
        wanted = json.load(file)
    try:
        if arguments[0] == "export":
            export(arguments[1], wanted)
            return 0
        faults = check(arguments[1], wanted)
    except RuntimeError as error:
        print(f"could not: {error}")
        return 2
    print("\n".join(faults) or f"{arguments[1]}: as expected")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
