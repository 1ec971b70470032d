"""The rules find what is wrong with stages that break them, and nothing with one that does not."""

import unittest

from pxr import Sdf, Usd, UsdGeom

from check import run_validators
from curve_rules import check_stage


def good_stage():
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetTimeCodesPerSecond(24)
    root = UsdGeom.Xform.Define(stage, "/Groom")
    stage.SetDefaultPrim(root.GetPrim())
    curves = UsdGeom.BasisCurves.Define(stage, "/Groom/Strands")
    curves.CreateTypeAttr("linear")
    curves.CreateBasisAttr("catmullRom")
    curves.CreateWrapAttr("nonperiodic")
    curves.CreateCurveVertexCountsAttr([2, 3])
    curves.CreatePointsAttr([(0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (1, 2, 0)])
    curves.CreateWidthsAttr([0.1] * 5)
    curves.SetWidthsInterpolation("vertex")
    curves.CreateExtentAttr([(-0.05, -0.05, -0.05), (1.05, 2.05, 0.05)])
    primvar = UsdGeom.PrimvarsAPI(curves).CreatePrimvar("id", Sdf.ValueTypeNames.IntArray, "uniform")
    primvar.Set([0, 1])
    return stage, curves


class Rules(unittest.TestCase):
    def rules(self, stage):
        return {finding.rule for finding in check_stage(stage)}

    def test_good_stage_is_good(self):
        stage, _ = good_stage()
        self.assertEqual(list(check_stage(stage)), [])
        found = [finding for finding in run_validators(stage, False) if finding.severity != "info"]
        self.assertEqual(found, [])

    def test_each_fault_is_found(self):
        faults = {
            "count": lambda c: c.GetCurveVertexCountsAttr().Set([2, 2]),
            "widths": lambda c: c.GetWidthsAttr().Set([0.1] * 2),
            "extent": lambda c: c.GetExtentAttr().Set([(0, 0, 0), (1, 2, 0)]),
            "token": lambda c: c.GetTypeAttr().Set("wavy"),
            "primvar": lambda c: UsdGeom.PrimvarsAPI(c).GetPrimvar("id").Set([0, 1, 2]),
            "normals": lambda c: c.CreateNormalsAttr([(0, 0, 1)] * 5),
            "motion": lambda c: c.CreateVelocitiesAttr([(0, 0, 1)] * 4),
            "finite": lambda c: c.GetPointsAttr().Set([(float("nan"), 0, 0)] * 5),
        }
        for rule, spoil in faults.items():
            with self.subTest(rule):
                stage, curves = good_stage()
                spoil(curves)
                self.assertIn(rule, self.rules(stage))

    def test_unset_interpolation_is_found(self):
        stage, curves = good_stage()
        curves.GetWidthsAttr().ClearMetadata("interpolation")
        self.assertIn("widths", self.rules(stage))

    def test_missing_metadata_is_found(self):
        stage, _ = good_stage()
        stage.ClearMetadata("metersPerUnit")
        self.assertIn("stage-metadata", self.rules(stage))


if __name__ == "__main__":
    unittest.main()
