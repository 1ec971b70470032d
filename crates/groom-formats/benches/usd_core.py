#!/usr/bin/env python3
"""usd-core's own writer, fed from numpy with the arrays the bench left in FOLDER: CPU seconds and bytes.

usage: usd_core.py FOLDER RUNS FRAMES
"""

import os
import sys
import time

import numpy as np
from pxr import Sdf, Usd, UsdGeom, Vt

POINTS = 25
RATE = 24.0


def write(path, groom, frames):
    """One layer with what ours has: all values still, or points, extent and velocities a frame."""
    if os.path.exists(path):
        os.remove(path)
    stage = Usd.Stage.CreateNew(path)
    stage.SetTimeCodesPerSecond(RATE)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/Groom").GetPrim())
    curves = UsdGeom.BasisCurves.Define(stage, "/Groom/Strands")
    curves.CreateTypeAttr("linear")
    curves.CreateBasisAttr("catmullRom")
    curves.CreateWrapAttr("nonperiodic")
    points = groom["points"]
    counts = np.full(len(points) // POINTS, POINTS, np.int32)
    curves.CreateCurveVertexCountsAttr(Vt.IntArray.FromNumpy(counts))
    widths = 2 * groom["radii"]
    curves.CreateWidthsAttr(Vt.FloatArray.FromNumpy(widths))
    curves.SetWidthsInterpolation("vertex")
    half = widths.max() / 2

    def sample(points, velocities, time):
        extent = np.stack([points.min(axis=0) - half, points.max(axis=0) + half]).astype(np.float32)
        curves.GetPointsAttr().Set(Vt.Vec3fArray.FromNumpy(points), time)
        curves.GetVelocitiesAttr().Set(Vt.Vec3fArray.FromNumpy(velocities), time)
        curves.GetExtentAttr().Set(Vt.Vec3fArray.FromNumpy(extent), time)

    if frames:
        for frame in range(frames):
            moved = points + np.array([frame, 0, 0], np.float32)
            sample(moved, np.full_like(points, [RATE, 0, 0]), float(frame))
    else:
        sample(points, groom["velocities"], Usd.TimeCode.Default())
    primvars = UsdGeom.PrimvarsAPI(curves)
    color = primvars.CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray, "uniform")
    color.Set(Vt.Vec3fArray.FromNumpy(groom["colors"]))
    uv = primvars.CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, "uniform")
    uv.Set(Vt.Vec2fArray.FromNumpy(groom["uvs"]))
    stage.Save()


def main():
    folder, runs, frames = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])

    def array(name, width):
        values = np.fromfile(os.path.join(folder, f"{name}.f32"), np.float32)
        return values.reshape(-1, width) if width > 1 else values

    groom = {"points": array("points", 3), "radii": array("radii", 1)}
    groom |= {"colors": array("colors", 3), "uvs": array("uvs", 2)}
    groom["velocities"] = groom["points"][::-1].copy()
    for what, name, moving in (
        ("still usdc", "core.usdc", 0),
        ("still usda", "core.usda", 0),
        ("ten frames usdc", "core_moving.usdc", frames),
    ):
        path = os.path.join(folder, name)
        best = float("inf")
        for _ in range(runs):
            before = time.process_time()
            write(path, groom, moving)
            best = min(best, time.process_time() - before)
        print(f"{what}: {best} {os.path.getsize(path)}")


if __name__ == "__main__":
    main()
