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

    def moving_stage(self, speed):
        """Points that move 2 units a second, and say `speed`."""
        stage, curves = good_stage()
        still = [(0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (1, 2, 0)]
        velocities = curves.CreateVelocitiesAttr()
        for time in (1, 2, 4):
            moved = [(x + 2 * time / 24, y, z) for x, y, z in still]
            curves.GetPointsAttr().Set(moved, time)
            velocities.Set([(speed, 0, 0)] * 5, time)
            curves.GetExtentAttr().Set([(-1, -1, -1), (3, 3, 1)], time)
        return stage

    def test_velocities_against_the_motion_or_per_frame_are_found(self):
        self.assertEqual(self.rules(self.moving_stage(2)), set())
        self.assertEqual(self.rules(self.moving_stage(2.2)), set())
        for wrong in (-2, 2 / 24):
            with self.subTest(wrong):
                self.assertEqual(self.rules(self.moving_stage(wrong)), {"velocity"})

    def test_joints_that_skin_nothing_are_found(self):
        cases = [("uniform", True, (1, 1)), ("vertex", False, (1, 1)), ("vertex", True, (1, 2))]
        for interpolation, applied, sizes in cases:
            with self.subTest(interpolation):
                stage, curves = good_stage()
                if applied:
                    curves.GetPrim().AddAppliedSchema("SkelBindingAPI")
                count = 2 if interpolation == "uniform" else 5
                api = UsdGeom.PrimvarsAPI(curves)
                for name, kind, value, size in (
                    ("skel:jointIndices", Sdf.ValueTypeNames.IntArray, 0, sizes[0]),
                    ("skel:jointWeights", Sdf.ValueTypeNames.FloatArray, 1.0, sizes[1]),
                ):
                    api.CreatePrimvar(name, kind, interpolation, size).Set([value] * count * size)
                self.assertEqual(self.rules(stage), {"skinning"})

    def test_joints_without_weights_are_found(self):
        stage, curves = good_stage()
        curves.GetPrim().AddAppliedSchema("SkelBindingAPI")
        indices = UsdGeom.PrimvarsAPI(curves).CreatePrimvar(
            "skel:jointIndices", Sdf.ValueTypeNames.IntArray, "vertex", 1
        )
        indices.Set([0] * 5)
        self.assertEqual(self.rules(stage), {"skinning"})

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
