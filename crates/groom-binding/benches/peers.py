"""Blender's Surface Deform and OpenUSD's skinning on the mesh and the points of the bench `carry`.

    cargo bench -p groom-binding --bench carry -- --peers PYTHON
    python peers.py FOLDER [ROUNDS]     on what the bench left with --write FOLDER

Prints one row for each of the two that this Python has, and says what it skipped. Times are the least of ROUNDS
(default 3): seconds of the wall, and of all of the process's threads together.

Surface Deform binds every point by itself to the mesh and carries it with it: it bends strands, where a rigid carry
does not. OpenUSD skins every point with one joint of its own strand's: the nearest to a rigid carry that UsdSkel has.
"""

import sys
import time
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed in this Python")
    sys.exit(2)


def load(folder):
    """Triangles, rest and posed vertices, and points."""
    read = lambda name, kind: np.fromfile(Path(folder) / name, kind).reshape(-1, 3)
    return read("triangles.u32", "<u4"), read("rest.f32", "<f4"), read("pose.f32", "<f4"), read("points.f32", "<f4")


def best(rounds, run):
    """Least wall seconds and least seconds of all threads."""
    walls, cores = [], []
    for _ in range(rounds):
        wall, core = time.perf_counter(), time.process_time()
        run()
        walls.append(time.perf_counter() - wall)
        cores.append(time.process_time() - core)
    return min(walls), min(cores)


def row(what, times):
    print(f"| {what} | {times[0] * 1e3:.1f} | {times[1] * 1e3:.1f} |", flush=True)


def blender(folder, rounds):
    try:
        import bpy
    except ImportError:
        print("skipped: Blender's bpy is not installed in this Python")
        return
    triangles, rest, pose, points = load(folder)
    bpy.ops.wm.read_factory_settings(use_empty=True)

    def mesh(name, vertices, faces):
        data = bpy.data.meshes.new(name)
        data.from_pydata(vertices, [], faces)
        thing = bpy.data.objects.new(name, data)
        bpy.context.collection.objects.link(thing)
        return thing

    target = mesh("head", rest.tolist(), triangles.tolist())
    hair = mesh("hair", points.tolist(), [])
    modifier = hair.modifiers.new("deform", "SURFACE_DEFORM")
    modifier.target = target
    bpy.context.view_layer.objects.active = hair
    start, on_cores = time.perf_counter(), time.process_time()
    with bpy.context.temp_override(object=hair, active_object=hair):
        bpy.ops.object.surfacedeform_bind(modifier="deform")
    row(f"Blender {bpy.app.version_string}, Surface Deform, bind {len(points)} points",
        (time.perf_counter() - start, time.process_time() - on_cores))
    if not modifier.is_bound:
        print("Surface Deform did not bind")
        return
    shapes = [pose, rest]

    def carry():
        shapes.reverse()
        target.data.vertices.foreach_set("co", shapes[0].reshape(-1))
        target.data.update()
        bpy.context.view_layer.update()
        deformed = hair.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        assert len(deformed.vertices) == len(points)

    row("Blender, Surface Deform, carry a frame", best(rounds, carry))


def usd(folder, rounds):
    try:
        from pxr import Gf, Usd, UsdSkel, Vt
    except ImportError:
        print("skipped: usd-core is not installed in this Python")
        return
    _, _, _, points = load(folder)
    strands = len(points) // 25
    turn = Gf.Matrix4f().SetRotate(Gf.Rotation(Gf.Vec3d(1, 0, 0), 20))
    joints = Vt.Matrix4fArray([turn] * strands)
    indices = Vt.IntArray.FromNumpy(np.repeat(np.arange(strands, dtype=np.int32), 25))
    weights = Vt.FloatArray.FromNumpy(np.ones(len(points), np.float32))
    skinned = Vt.Vec3fArray.FromNumpy(points)
    bind = Gf.Matrix4f(1)
    version = ".".join(map(str, Usd.GetVersion()))

    def carry(in_serial):
        # Skins in place: after the first round the points are turned further, which costs the same.
        assert UsdSkel.SkinPointsLBS(bind, joints, indices, weights, 1, skinned, inSerial=in_serial)

    row(f"OpenUSD {version}, linear skinning, {strands} joints, one thread", best(rounds, lambda: carry(True)))
    row(f"OpenUSD {version}, linear skinning, {strands} joints, all threads", best(rounds, lambda: carry(False)))


def main():
    if len(sys.argv) not in (2, 3):
        print(__doc__)
        sys.exit(2)
    folder, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) == 3 else 3
    print("| what | milliseconds | of all cores together |\n|---|---|---|")
    usd(folder, rounds)
    blender(folder, rounds)


main()
