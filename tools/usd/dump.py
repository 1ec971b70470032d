#!/usr/bin/env python3
"""Prints the metadata and BasisCurves of stages as a JSON list, arrays as 8 hexadecimal digits a value."""

import json
import sys

import numpy as np
from pxr import Tf, Usd, UsdGeom


def bits(values):
    """The 32 bits of every value in order, as one string: far quicker to pass on than lists of numbers."""
    array = np.ascontiguousarray(values)
    if array.dtype.itemsize != 4:
        raise TypeError(f"expected values of 32 bits, found {array.dtype}")
    return array.view(np.uint32).astype(">u4").tobytes().hex()


def curves_of(prim):
    """The attributes of one BasisCurves prim."""
    curves = UsdGeom.BasisCurves(prim)
    return {
        "path": str(prim.GetPath()),
        "type": curves.GetTypeAttr().Get(),
        "basis": curves.GetBasisAttr().Get(),
        "wrap": curves.GetWrapAttr().Get(),
        "curveVertexCounts": bits(curves.GetCurveVertexCountsAttr().Get()),
        "points": bits(curves.GetPointsAttr().Get()),
        "widths": bits(curves.GetWidthsAttr().Get()),
        "widthsInterpolation": str(curves.GetWidthsInterpolation()),
        "extent": bits(curves.GetExtentAttr().Get()),
        "primvars": {
            primvar.GetPrimvarName(): {
                "type": str(primvar.GetTypeName()),
                "interpolation": str(primvar.GetInterpolation()),
                "values": bits(primvar.Get()),
            }
            for primvar in UsdGeom.PrimvarsAPI(prim).GetPrimvarsWithValues()
        },
    }


def dump(stage):
    """Everything about one stage."""
    prims = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.BasisCurves)]
    return {
        "defaultPrim": stage.GetDefaultPrim().GetName(),
        "upAxis": str(UsdGeom.GetStageUpAxis(stage)),
        "metersPerUnit": UsdGeom.GetStageMetersPerUnit(stage),
        "timeCodesPerSecond": stage.GetTimeCodesPerSecond(),
        "curves": [curves_of(prim) for prim in prims],
    }


def main():
    if len(sys.argv) < 2:
        print("usage: dump.py FILE...", file=sys.stderr)
        return 2
    reports = []
    for path in sys.argv[1:]:
        try:
            reports.append(dump(Usd.Stage.Open(path)))
        except Tf.ErrorException as error:
            print(f"error: {path}: {error}", file=sys.stderr)
            return 2
    json.dump(reports, sys.stdout)
    return 0


if __name__ == "__main__":
    sys.exit(main())
