"""Rules for hair in UsdGeom.BasisCurves that usd-core's validators do not check."""

from dataclasses import dataclass

import numpy as np
from pxr import Sdf, Usd, UsdGeom

STAGE_METADATA = ("defaultPrim", "upAxis", "metersPerUnit", "timeCodesPerSecond")
EXTENT_TOLERANCE = 1e-5
# How near a ratio of speeds must be to what a wrong unit or sign makes of it.
RATIO_TOLERANCE = 0.2


@dataclass(frozen=True)
class Finding:
    """Something wrong: `severity` is error, warning or info; `place` a path in the stage."""

    severity: str
    rule: str
    place: str
    message: str


def check_stage(stage):
    """Yields every finding about the stage and its curves."""
    for key in STAGE_METADATA:
        if not stage.HasAuthoredMetadata(key):
            yield Finding("error", "stage-metadata", "/", f"{key} is not authored")
    for prim in stage.Traverse():
        if prim.IsA(UsdGeom.BasisCurves):
            yield from _check_curves(UsdGeom.BasisCurves(prim))


def _check_curves(curves):
    path = str(curves.GetPath())
    yield from _check_tokens(curves, path)
    times = curves.GetPointsAttr().GetTimeSamples() or [Usd.TimeCode.Default()]
    for time in sorted({times[0], times[-1]}, key=lambda t: Usd.TimeCode(t).GetValue()):
        points = curves.GetPointsAttr().Get(time)
        counts = curves.GetCurveVertexCountsAttr().Get(time)
        if points is None or counts is None:
            yield Finding("error", "geometry", path, "points or curveVertexCounts are missing")
            continue
        points, counts = np.asarray(points), np.asarray(counts, np.int64)
        yield from _check_counts(curves, path, points, counts)
        yield from _check_widths(curves, path, time, len(counts), len(points))
        yield from _check_extent(curves, path, time, points)
        yield from _check_primvars(curves, path, time, len(counts), len(points))
        yield from _check_motion(curves, path, time, len(points))
    yield from _check_velocities(curves, path)
    yield from _check_skinning(curves, path)


def _check_tokens(curves, path):
    for name in ("type", "basis", "wrap"):
        attribute = curves.GetPrim().GetAttribute(name)
        if not attribute.HasAuthoredValue():
            message = f"{name} is not authored; readers differ on the fallback"
            yield Finding("warning", "token", path, message)
            continue
        allowed = list(attribute.GetMetadata("allowedTokens") or [])
        if allowed and attribute.Get() not in allowed:
            message = f'{name} is "{attribute.Get()}", expected one of {", ".join(allowed)}'
            yield Finding("error", "token", path, message)
        if attribute.GetVariability() != Sdf.VariabilityUniform:
            yield Finding("error", "token", path, f"{name} must be uniform")


def _fewest_points(curves):
    if curves.GetTypeAttr().Get() == "linear":
        return 2
    pinned = curves.GetWrapAttr().Get() == "pinned" and curves.GetBasisAttr().Get() != "bezier"
    return 2 if pinned else 4


def _check_counts(curves, path, points, counts):
    if counts.sum() != len(points):
        message = f"curveVertexCounts add up to {counts.sum()}, but there are {len(points)} points"
        yield Finding("error", "count", path, message)
    fewest = _fewest_points(curves)
    if len(counts) and counts.min() < fewest:
        message = f"{int((counts < fewest).sum())} curves have fewer than {fewest} points"
        yield Finding("error", "count", path, message)
    if not np.isfinite(points).all():
        yield Finding("error", "finite", path, "points are not all finite")


def _expected_len(interpolation, curve_count, point_count):
    sizes = {"constant": 1, "uniform": curve_count, "vertex": point_count}
    return sizes.get(interpolation)


def _check_widths(curves, path, time, curve_count, point_count):
    attribute = curves.GetWidthsAttr()
    widths = attribute.Get(time)
    if widths is None:
        yield Finding("error", "widths", path, "no widths: readers take a whole unit")
        return
    if not attribute.HasAuthoredMetadata("interpolation"):
        yield Finding("error", "widths", path, "the interpolation of widths is not authored")
    interpolation = curves.GetWidthsInterpolation()
    expected = _expected_len(interpolation, curve_count, point_count)
    if expected is None:
        message = f"widths are {interpolation}; readers agree on constant, uniform and vertex only"
        yield Finding("warning", "widths", path, message)
    elif len(widths) != expected:
        message = f"{len(widths)} widths, but {interpolation} needs {expected}"
        yield Finding("error", "widths", path, message)
    widths = np.asarray(widths)
    if not np.isfinite(widths).all() or (len(widths) and widths.min() < 0):
        yield Finding("error", "widths", path, "widths must be finite and not negative")
    if UsdGeom.PrimvarsAPI(curves).HasPrimvar("widths"):
        yield Finding("warning", "widths", path, "primvars:widths wins over widths")


def _check_extent(curves, path, time, points):
    extent = curves.GetExtentAttr().Get(time)
    if extent is None or len(extent) != 2:
        yield Finding("error", "extent", path, "extent is not authored as two corners")
        return
    if not len(points):
        return
    widths = np.asarray(curves.GetWidthsAttr().Get(time) or [0.0], np.float64)
    half = widths.max() / 2
    low, high = points.min(axis=0) - half, points.max(axis=0) + half
    slack = EXTENT_TOLERANCE * max(1e-30, np.abs(np.stack([low, high])).max())
    if (np.asarray(extent[0]) > low + slack).any() or (np.asarray(extent[1]) < high - slack).any():
        message = f"extent {list(map(tuple, extent))} does not hold the points and half the widest width"
        yield Finding("error", "extent", path, message)


def _check_primvars(curves, path, time, curve_count, point_count):
    for primvar in UsdGeom.PrimvarsAPI(curves).GetPrimvarsWithValues():
        place = f"{path}.{primvar.GetName()}"
        if not primvar.HasAuthoredInterpolation():
            yield Finding("error", "primvar", place, "the interpolation is not authored")
        value = primvar.ComputeFlattened(time) if primvar.IsIndexed() else primvar.Get(time)
        interpolation = primvar.GetInterpolation()
        expected = _expected_len(interpolation, curve_count, point_count)
        if expected is None or not primvar.GetTypeName().isArray:
            continue
        found, expected = len(value), expected * max(1, primvar.GetElementSize())
        if found != expected:
            message = f"{found} values, but {interpolation} needs {expected}"
            yield Finding("error", "primvar", place, message)
    if curves.GetNormalsAttr().HasAuthoredValue():
        yield Finding("warning", "normals", path, "normals turn round strands into flat ribbons")


def _check_motion(curves, path, time, point_count):
    point_times = curves.GetPointsAttr().GetTimeSamples()
    for attribute in (curves.GetVelocitiesAttr(), curves.GetAccelerationsAttr()):
        values = attribute.Get(time)
        if values is None:
            continue
        if len(values) != point_count:
            message = f"{len(values)} values, but there are {point_count} points"
            yield Finding("error", "motion", str(attribute.GetPath()), message)
        if attribute.GetTimeSamples() != point_times:
            message = "samples at other times than the points': they are ignored"
            yield Finding("error", "motion", str(attribute.GetPath()), message)


def _check_velocities(curves, path):
    """Velocities against what the points do between samples: their sign and unit."""
    points, velocities = curves.GetPointsAttr(), curves.GetVelocitiesAttr()
    times = points.GetTimeSamples()
    rate = curves.GetPrim().GetStage().GetTimeCodesPerSecond()
    if len(times) < 2 or velocities.GetTimeSamples() != times or rate <= 0:
        return
    moved, said = 0.0, 0.0
    for before, after in [(times[0], times[1]), (times[-2], times[-1])]:
        ends = [np.asarray(values.Get(time), float) for values in (points, velocities) for time in (before, after)]
        if len({end.shape for end in ends}) != 1:
            return
        step = (ends[1] - ends[0]) * rate / (after - before)
        moved += (step * step).sum()
        said += (step * 0.5 * (ends[2] + ends[3])).sum()
    if moved == 0:
        return
    ratio = said / moved
    place = str(velocities.GetPath())
    if abs(ratio + 1) < RATIO_TOLERANCE:
        yield Finding("error", "velocity", place, "velocities point against the way the points move")
    elif rate > 2 and abs(ratio * rate - 1) < RATIO_TOLERANCE:
        message = f"velocities are units per time code, expected per second: {rate:g} times as large"
        yield Finding("error", "velocity", place, message)


def _check_skinning(curves, path):
    """What UsdSkel needs of curves; where it is missing, nothing is skinned and nobody says so."""
    api = UsdGeom.PrimvarsAPI(curves)
    indices, weights = api.GetPrimvar("skel:jointIndices"), api.GetPrimvar("skel:jointWeights")
    for primvar in (indices, weights):
        if primvar.HasValue() and primvar.GetInterpolation() not in ("vertex", "constant"):
            message = f"{primvar.GetInterpolation()} joints skin nothing; expected vertex or constant"
            yield Finding("error", "skinning", f"{path}.{primvar.GetName()}", message)
    if indices.HasValue() and not curves.GetPrim().HasAPI("SkelBindingAPI"):
        yield Finding("error", "skinning", path, "SkelBindingAPI is not applied")
    if indices.HasValue() and not weights.HasValue():
        yield Finding("error", "skinning", path, "skel:jointIndices without skel:jointWeights")
    elif indices.HasValue() and indices.GetElementSize() != weights.GetElementSize():
        message = f"{indices.GetElementSize()} joints a point, but {weights.GetElementSize()} weights"
        yield Finding("error", "skinning", path, message)
