#!/usr/bin/env python3
"""Where usd-core puts the points of curves that move.

usage: usd_motion.py FILE TIME:BASE [TIME:BASE ...]

Prints a JSON list: for each pair the coordinates of all points of the first BasisCurves in its own space, worked out by
UsdGeomPointBased.ComputePointsAtTime: from the samples at or before BASE, by velocities and accelerations if those
count, to TIME. Exit 0: done. 2: could not.
"""

import json
import sys

from pxr import Usd, UsdGeom


def main(arguments):
    stage = Usd.Stage.Open(arguments[0])
    curves = next(prim for prim in stage.Traverse() if prim.IsA(UsdGeom.BasisCurves))
    found = []
    for pair in arguments[1:]:
        time, base = map(float, pair.split(":"))
        points = UsdGeom.PointBased(curves).ComputePointsAtTime(Usd.TimeCode(time), Usd.TimeCode(base))
        found.append([number for point in points for number in point])
    json.dump(found, sys.stdout)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
