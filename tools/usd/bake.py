#!/usr/bin/env python3
"""Bakes an animated stage to one plain layer: meshes and curves, their points in the stage's space at every step.

Composition is flattened, transforms are applied, UsdSkel skinning and blend shapes are evaluated. What does not
move is written once. Exit 0: done. 2: could not.
"""

import argparse
import sys

from whole_file import missing_usd_core, whole_file

try:
    import numpy as np
    from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdSkel, Vt
except ImportError:
    if __name__ == "__main__":
        sys.exit(missing_usd_core())
    raise

ENDINGS = (".usda", ".usdc", ".usd")
# What is copied from a prim as it is at the first time.
TOPOLOGY = {
    "Mesh": ("faceVertexCounts", "faceVertexIndices", "subdivisionScheme", "orientation", "holeIndices"),
    "BasisCurves": ("curveVertexCounts", "type", "basis", "wrap"),
}
COUNTS = {"Mesh": ("faceVertexCounts", "faceVertexIndices"), "BasisCurves": ("curveVertexCounts",)}


class BakeError(Exception):
    """A stage that cannot be baked; the message says where and why."""


def frame_times(stage, frames, step):
    """The time codes to bake: `frames` as (first, last), else the stage's own range."""
    if frames:
        first, last = frames
    elif stage.HasAuthoredTimeCodeRange():
        first, last = stage.GetStartTimeCode(), stage.GetEndTimeCode()
    else:
        found = sorted({time for prim in stage.Traverse() for a in prim.GetAttributes() for time in a.GetTimeSamples()})
        first, last = (found[0], found[-1]) if found else (0.0, 0.0)
    if not (last >= first and step > 0):
        raise BakeError(f"frames {first:g} to {last:g} by {step:g}: expected A <= B and a step over 0")
    return [first + step * place for place in range(int((last - first) / step + 1e-9) + 1)]


def bake_skinning(stage, times, step):
    """Evaluates UsdSkel into a layer above the stage; the files it came from are not touched."""
    session = stage.GetSessionLayer()
    baked = Sdf.Layer.CreateAnonymous(".usdc")
    # A layer that does not say has as many time codes a second as frames, and layers that differ are stretched.
    rate = stage.GetTimeCodesPerSecond()
    baked.timeCodesPerSecond = session.timeCodesPerSecond = rate
    session.subLayerPaths.append(baked.identifier)
    stage.SetEditTarget(session)
    # BakeSkinning samples once a frame: this makes every step one.
    stage.SetFramesPerSecond(rate / step)
    stage.SetEditTarget(baked)
    for root in [prim for prim in stage.Traverse() if prim.IsA(UsdSkel.Root)]:
        if not UsdSkel.BakeSkinning(UsdSkel.Root(root), Gf.Interval(times[0], times[-1])):
            raise BakeError(f"{root.GetPath()}: its skinning cannot be evaluated")
    # A layer that nobody holds is gone.
    return baked


def world_points(prim, cache, time):
    """Points in the stage's space, as float32, and the matrix that brought them there."""
    cache.SetTime(time)
    points = UsdGeom.PointBased(prim).GetPointsAttr().Get(time)
    points = np.asarray(points if points is not None else [], np.float32).reshape(-1, 3)
    world = np.array(cache.GetLocalToWorldTransform(prim))
    if np.array_equal(world, np.eye(4)):
        return points, world
    return (points.astype(np.float64) @ world[:3, :3] + world[3, :3]).astype(np.float32), world


def copy_still(prim, to, kind, time, world):
    """Copies topology, widths and primvars as they are at `time`."""
    for name in TOPOLOGY[kind]:
        value = prim.GetAttribute(name).Get(time)
        if value is not None:
            to.GetAttribute(name).Set(value)
    if kind == "BasisCurves":
        widths = UsdGeom.Curves(prim).GetWidthsAttr().Get(time)
        if widths is not None:
            scale = abs(np.linalg.det(world[:3, :3])) ** (1 / 3)
            scale = 1.0 if abs(scale - 1) < 1e-9 else scale
            curves = UsdGeom.Curves(to)
            curves.CreateWidthsAttr(Vt.FloatArray.FromNumpy((np.asarray(widths) * scale).astype(np.float32)))
            curves.SetWidthsInterpolation(UsdGeom.Curves(prim).GetWidthsInterpolation())
    api = UsdGeom.PrimvarsAPI(to)
    for primvar in UsdGeom.PrimvarsAPI(prim).GetPrimvarsWithValues():
        name = primvar.GetPrimvarName()
        if name.startswith("skel:"):
            continue
        copied = api.CreatePrimvar(name, primvar.GetTypeName(), primvar.GetInterpolation(), primvar.GetElementSize())
        copied.Set(primvar.ComputeFlattened(time) if primvar.IsIndexed() else primvar.Get(time))


def check_topology(prim, kind, times):
    """Refuses counts and indices that change."""
    for name in COUNTS[kind]:
        attribute = prim.GetAttribute(name)
        if attribute.GetNumTimeSamples() < 2:
            continue
        first = attribute.Get(times[0])
        for time in times:
            if attribute.Get(time) != first:
                raise BakeError(f"{prim.GetPath()}.{name} changes at time {time:g}; expected the same points at all times")


def bake_prim(prim, out, kind, times, cache):
    """Bakes one prim; how many points it has."""
    check_topology(prim, kind, times)
    to = out.DefinePrim(prim.GetPath(), kind)
    first, world = world_points(prim, cache, times[0])
    copy_still(prim, to, kind, times[0], world)
    target = UsdGeom.PointBased(to)
    widths = UsdGeom.Curves(to).GetWidthsAttr().Get() if kind == "BasisCurves" else None
    half = float(np.max(widths)) / 2 if widths else 0.0
    points_attribute, extent_attribute = target.CreatePointsAttr(), target.CreateExtentAttr()

    def put(points, time):
        points_attribute.Set(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(points)), time)
        if len(points):
            extent = np.stack([points.min(axis=0) - half, points.max(axis=0) + half]).astype(np.float32)
            extent_attribute.Set(Vt.Vec3fArray.FromNumpy(extent), time)

    moves = False
    for time in times[1:]:
        points, _ = world_points(prim, cache, time)
        if len(points) != len(first):
            message = f"{len(points)} points at time {time:g}, but {len(first)} at {times[0]:g}"
            raise BakeError(f"{prim.GetPath()}.points: {message}; expected the same points at all times")
        if not moves and np.array_equal(points, first):
            continue
        if not moves:
            # Up to here it stood still: the first and the last of these times say so.
            moves = True
            put(first, times[0])
            before = times[times.index(time) - 1]
            if before != times[0]:
                put(first, before)
        put(points, time)
    if not moves:
        put(first, Usd.TimeCode.Default())
    return len(first)


def bake(source, target, frames=None, step=1.0):
    """Bakes the stage `source` to the layer `target`; the number of prims and of times."""
    stage = Usd.Stage.Open(source)
    times = frame_times(stage, frames, step)
    skinned = bake_skinning(stage, times, step)
    out = Usd.Stage.CreateNew(target)
    UsdGeom.SetStageUpAxis(out, UsdGeom.GetStageUpAxis(stage))
    UsdGeom.SetStageMetersPerUnit(out, UsdGeom.GetStageMetersPerUnit(stage))
    out.SetTimeCodesPerSecond(stage.GetTimeCodesPerSecond())
    out.SetStartTimeCode(times[0])
    out.SetEndTimeCode(times[-1])
    cache, count = UsdGeom.XformCache(), 0
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        kind = next((kind for kind in TOPOLOGY if prim.GetTypeName() == kind), None)
        if kind is None or UsdGeom.Imageable(prim).ComputePurpose() == UsdGeom.Tokens.guide:
            continue
        bake_prim(prim, out, kind, times, cache)
        count += 1
    if not count:
        raise BakeError(f"{source}: no Mesh and no BasisCurves prim")
    out.SetDefaultPrim(out.GetPseudoRoot().GetChildren()[0])
    out.GetRootLayer().Save()
    del skinned
    return count, len(times)


def frame_range(text):
    """`A:B` as two numbers."""
    first, _, last = text.partition(":")
    return float(first), float(last or first)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", metavar="IN", help=".usda, .usdc, .usd or .usdz")
    parser.add_argument("target", metavar="OUT", help=".usda, .usdc or .usd")
    parser.add_argument("--frames", metavar="A:B", type=frame_range, help="time codes (default: the stage's range)")
    parser.add_argument("--step", metavar="S", type=float, default=1.0, help="time codes from one to the next (default: 1)")
    options = parser.parse_args(arguments)
    if not options.target.endswith(ENDINGS):
        print(f"error: {options.target}: expected one of {', '.join(ENDINGS)}", file=sys.stderr)
        return 2
    try:
        with whole_file(options.target) as temporary:
            prims, times = bake(options.source, temporary, options.frames, options.step)
    except (BakeError, Tf.ErrorException, OSError) as error:
        print(f"error: {options.source}: {error}", file=sys.stderr)
        return 2
    print(f"{options.target}: {prims} prims at {times} times")
    return 0


if __name__ == "__main__":
    sys.exit(main())
