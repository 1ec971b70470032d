#!/usr/bin/env python3
"""Bakes an animated stage to one plain layer: meshes and curves, their points in the stage's space at every step.

Composition is flattened, transforms are applied, UsdSkel skinning and blend shapes are evaluated. What does not
move is written once. A mesh's value outside the samples is the pose it was bound in, if it is skinned, else that of
the stage outside its samples (where there is none, at their first), whatever the times that are baked. With
--transforms points stay in the prim's own space, below one matrix in float64: a character that is far away keeps
its shape. Exit 0: done. 2: could not.
"""

import argparse
import math
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


def frame_times(stage, frames, step, hold=None):
    """The time codes to bake: `frames` as (first, last), else the stage's own range; widened by whole steps to `hold`.

    The last is where a step reaches the end of the range or first goes beyond it.
    """
    if frames:
        first, last = frames
    elif stage.HasAuthoredTimeCodeRange():
        first, last = stage.GetStartTimeCode(), stage.GetEndTimeCode()
    else:
        found = sorted({time for prim in stage.Traverse() for a in prim.GetAttributes() for time in a.GetTimeSamples()})
        first, last = (found[0], found[-1]) if found else (0.0, 0.0)
    if not (math.isfinite(first) and math.isfinite(last) and last >= first and math.isfinite(step) and step > 0):
        raise BakeError(f"frames {first:g} to {last:g} by {step:g}: expected A <= B and a step over 0")
    if hold is not None:
        if not math.isfinite(hold):
            raise BakeError(f"time code {hold:g} to hold: expected a finite number")
        first, last = first - step * max(whole_steps(first - hold, step), 0), max(last, hold)
    return [first + step * place for place in range(whole_steps(last - first, step) + 1)]


def whole_steps(length, step):
    """As many steps as `length` needs; a rounding error needs none."""
    return math.ceil(length / step - 1e-9)


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


def bind_poses(stage):
    """The pose of each skinned prim as it was bound, by path: points, normals, the matrix to the stage's space."""
    poses, worlds = {}, UsdGeom.XformCache()
    for root in [prim for prim in stage.Traverse() if prim.IsA(UsdSkel.Root)]:
        cache = UsdSkel.Cache()
        cache.Populate(UsdSkel.Root(root), Usd.PrimDefaultPredicate)
        for binding in cache.ComputeSkelBindings(UsdSkel.Root(root), Usd.PrimDefaultPredicate):
            world = np.array(worlds.GetLocalToWorldTransform(binding.GetSkeleton().GetPrim()))
            for query in binding.GetSkinningTargets():
                prim = query.GetPrim()
                # Blend shapes alone leave a prim where it is.
                skinned = query.HasJointInfluences()
                to_stage = np.array(query.GetGeomBindTransform()) @ world if skinned else np.array(
                    worlds.GetLocalToWorldTransform(prim))
                points = UsdGeom.PointBased(prim).GetPointsAttr().Get(Usd.TimeCode.EarliestTime())
                if points is not None:
                    _, normals = normals_of(prim, Usd.TimeCode.EarliestTime())
                    poses[str(prim.GetPath())] = np.asarray(points, np.float32).reshape(-1, 3), normals, to_stage
    return poses


def rest_time(attribute):
    """Where the value of an attribute outside its samples is, else the first of them."""
    authored = attribute.Get(Usd.TimeCode.Default()) is not None
    return Usd.TimeCode.Default() if authored else Usd.TimeCode.EarliestTime()


def rest_pose(prim):
    """The pose of a mesh without a skin outside its samples, as `bind_poses` gives those of others; or nothing."""
    attribute = UsdGeom.Mesh(prim).GetPointsAttr()
    points = attribute.Get(rest_time(attribute))
    if points is None:
        return None
    primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar("normals")
    of_normals = primvar.GetAttr() if primvar and primvar.HasValue() else UsdGeom.Mesh(prim).GetNormalsAttr()
    _, normals = normals_of(prim, rest_time(of_normals))
    to_stage = Gf.Matrix4d(1)
    while prim and not prim.IsPseudoRoot():
        place = UsdGeom.Xformable(prim)
        if place:
            # The first op is the outermost; matrices take rows.
            for op in reversed(place.GetOrderedXformOps()):
                to_stage *= op.GetOpTransform(rest_time(op.GetAttr()))
            if place.GetResetXformStack():
                break
        prim = prim.GetParent()
    return np.asarray(points, np.float32).reshape(-1, 3), normals, np.array(to_stage)


def local_points(prim, cache, time):
    """Points in the prim's own space, as float32, and the matrix to the stage's."""
    cache.SetTime(time)
    points = UsdGeom.PointBased(prim).GetPointsAttr().Get(time)
    points = np.asarray(points if points is not None else [], np.float32).reshape(-1, 3)
    return points, np.array(cache.GetLocalToWorldTransform(prim))


def moved(points, world):
    """Points brought along by a matrix, as float32."""
    if np.array_equal(world, np.eye(4)):
        return points
    return (points.astype(np.float64) @ world[:3, :3] + world[3, :3]).astype(np.float32)


def normals_of(prim, time):
    """The primvar or attribute of a mesh's normals and their values, indices looked up; or nothing."""
    primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar("normals")
    if primvar and primvar.HasValue():
        return primvar.GetInterpolation(), primvar.ComputeFlattened(time)
    mesh = UsdGeom.Mesh(prim)
    return mesh.GetNormalsInterpolation(), mesh.GetNormalsAttr().Get(time)


def turned(normals, world):
    """Normals brought along by a matrix, of length 1, as float32."""
    normals = np.asarray(normals, np.float64).reshape(-1, 3)
    x, y, z = world[:3, :3]
    # The inverse transpose but for a factor; also for a matrix that flattens.
    cofactors = np.stack([np.cross(y, z), np.cross(z, x), np.cross(x, y)])
    normals = normals @ (cofactors if np.dot(x, cofactors[0]) >= 0 else -cofactors)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0).astype(np.float32)


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
    if kind == "Mesh":
        for subset in UsdGeom.Subset.GetGeomSubsets(UsdGeom.Imageable(prim), UsdGeom.Tokens.face, "materialBind"):
            name, indices = subset.GetPrim().GetName(), subset.GetIndicesAttr().Get(time)
            UsdGeom.Subset.CreateGeomSubset(UsdGeom.Imageable(to), name, UsdGeom.Tokens.face, indices, "materialBind")
    api = UsdGeom.PrimvarsAPI(to)
    for primvar in UsdGeom.PrimvarsAPI(prim).GetPrimvarsWithValues():
        name = primvar.GetPrimvarName()
        if name.startswith("skel:") or name == "normals":
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


class Track:
    """An attribute at rising times, written from where it first changes."""

    def __init__(self, make, write):
        self.make, self.write = make, write
        self.attribute, self.first, self.times = None, None, []

    def put(self, value, time):
        """The value at the next time."""
        if self.first is None:
            self.first = value
        moves = self.attribute is not None
        if not moves and not np.array_equal(value, self.first):
            # Up to here it stood still: the first and the last of these times say so.
            moves, self.attribute = True, self.make()
            for before in dict.fromkeys((self.times[0], self.times[-1])):
                self.write(self.attribute, self.first, before)
        if moves:
            self.write(self.attribute, value, time)
        self.times.append(time)

    def rest(self, value):
        """The value outside the samples: `value`, or what it was all the time."""
        if self.first is None or value is None and self.attribute:
            return
        value = self.first if value is None else value
        if not self.attribute:
            self.attribute = self.make()
            if not np.array_equal(value, self.first):
                self.write(self.attribute, self.first, self.times[0])
        self.write(self.attribute, value, Usd.TimeCode.Default())


def vectors(attribute, value, time):
    attribute.Set(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(value)), time)


def bake_prim(prim, out, kind, times, cache, bind=None, transforms=False):
    """Bakes one prim, which was bound as `bind` says; how many points it has."""
    check_topology(prim, kind, times)
    to = out.DefinePrim(prim.GetPath(), kind)
    first, world = local_points(prim, cache, times[0])
    copy_still(prim, to, kind, times[0], np.eye(4) if transforms else world)
    target = UsdGeom.PointBased(to)
    widths = UsdGeom.Curves(to).GetWidthsAttr().Get() if kind == "BasisCurves" else None
    half = float(np.max(widths)) / 2 if widths else 0.0
    extent_attribute = target.CreateExtentAttr()

    def put_points(attribute, points, time):
        vectors(attribute, points, time)
        if len(points):
            extent = np.stack([points.min(axis=0) - half, points.max(axis=0) + half]).astype(np.float32)
            extent_attribute.Set(Vt.Vec3fArray.FromNumpy(extent), time)

    points_track = Track(target.CreatePointsAttr, put_points)
    normals_track = Track(target.CreateNormalsAttr, vectors)
    matrix_track = Track(
        lambda: UsdGeom.Xformable(to).AddTransformOp().GetAttr(),
        lambda attribute, matrix, time: attribute.Set(Gf.Matrix4d(*matrix.flatten().tolist()), time),
    )
    for time in times:
        points, world = local_points(prim, cache, time)
        if len(points) != len(first):
            message = f"{len(points)} points at time {time:g}, but {len(first)} at {times[0]:g}"
            raise BakeError(f"{prim.GetPath()}.points: {message}; expected the same points at all times")
        points_track.put(points if transforms else moved(points, world), time)
        if transforms:
            matrix_track.put(world, time)
        interpolation, normals = normals_of(prim, time) if kind == "Mesh" else (None, None)
        if normals:
            target.SetNormalsInterpolation(interpolation)
            normals_track.put(turned(normals, np.eye(4) if transforms else world), time)
    bound, normals, to_stage = bind or (None, None, None)
    points_track.rest(bound if bound is None or transforms else moved(bound, to_stage))
    matrix_track.rest(to_stage)
    normals_track.rest(turned(normals, np.eye(4) if transforms else to_stage) if normals else None)
    return len(first)


def bake(source, target, frames=None, step=1.0, transforms=False, hold=None):
    """Bakes the stage `source` to the layer `target`; the number of prims and of times."""
    stage = Usd.Stage.Open(source)
    times = frame_times(stage, frames, step, hold)
    bound = bind_poses(stage)
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
        if kind is None:
            continue
        purpose = UsdGeom.Imageable(prim).ComputePurpose()
        # A proxy stands for another mesh, which is here too.
        if purpose == UsdGeom.Tokens.guide or kind == "Mesh" and purpose == UsdGeom.Tokens.proxy:
            continue
        bind = bound.get(str(prim.GetPath())) or (rest_pose(prim) if kind == "Mesh" else None)
        bake_prim(prim, out, kind, times, cache, bind, transforms)
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
    parser.add_argument("--hold", metavar="T", type=float, help="a time code that is to be in the range as well")
    parser.add_argument("--transforms", action="store_true", help="keep points in the prims' own spaces (see above)")
    options = parser.parse_args(arguments)
    if not options.target.endswith(ENDINGS):
        print(f"error: {options.target}: expected one of {', '.join(ENDINGS)}", file=sys.stderr)
        return 2
    try:
        with whole_file(options.target) as temporary:
            prims, times = bake(options.source, temporary, options.frames, options.step, options.transforms, options.hold)
    except (BakeError, Tf.ErrorException, OSError) as error:
        print(f"error: {options.source}: {error}", file=sys.stderr)
        return 2
    print(f"{options.target}: {prims} prims at {times} times")
    return 0


if __name__ == "__main__":
    sys.exit(main())
