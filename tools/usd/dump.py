#!/usr/bin/env python3
"""Prints a stage's metadata and its BasisCurves as JSON, floats as the unsigned value of their 32 bits."""

import json
import sys

import numpy as np
from pxr import Tf, Usd, UsdGeom


def bits(values):
    """A flat list: floats as the unsigned integers with the same bits, integers as they are."""
    array = np.asarray(values)
    if array.dtype == np.float32:
        array = array.view(np.uint32)
    return array.ravel().tolist()


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


def main():
    if len(sys.argv) != 2:
        print("usage: dump.py FILE", file=sys.stderr)
        return 2
    try:
        stage = Usd.Stage.Open(sys.argv[1])
    except Tf.ErrorException as error:
        print(f"error: {sys.argv[1]}: {error}", file=sys.stderr)
        return 2
    prims = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.BasisCurves)]
    report = {
        "defaultPrim": stage.GetDefaultPrim().GetName(),
        "upAxis": str(UsdGeom.GetStageUpAxis(stage)),
        "metersPerUnit": UsdGeom.GetStageMetersPerUnit(stage),
        "timeCodesPerSecond": stage.GetTimeCodesPerSecond(),
        "curves": [curves_of(prim) for prim in prims],
    }
    json.dump(report, sys.stdout)
    return 0


if __name__ == "__main__":
    sys.exit(main())
