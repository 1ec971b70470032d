"""Baked stages have the points of the stages they come from; files are whole or not there."""

import os
import tempfile
import unittest

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdSkel

import bake
import package


def moving_stage(path):
    """A line of two points below a transform that turns from time 1 to 3."""
    stage = Usd.Stage.CreateNew(path)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 0.5)
    stage.SetStartTimeCode(1)
    stage.SetEndTimeCode(3)
    root = UsdGeom.Xform.Define(stage, "/Root")
    turn = root.AddRotateZOp()
    turn.Set(0, 1)
    turn.Set(180, 3)
    curves = UsdGeom.BasisCurves.Define(stage, "/Root/Hair")
    curves.CreateTypeAttr("linear")
    curves.CreateCurveVertexCountsAttr([2])
    curves.CreatePointsAttr([(0, 0, 0), (1, 0, 0)])
    curves.CreateWidthsAttr([0.1])
    curves.SetWidthsInterpolation("constant")
    mesh = UsdGeom.Mesh.Define(stage, "/Still")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    mesh.CreateFaceVertexCountsAttr([3])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
    stage.GetRootLayer().Save()
    return stage


class Baking(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = lambda name: os.path.join(folder.name, name)

    def test_points_are_in_the_stages_space_at_every_step(self):
        moving_stage(self.path("in.usda"))
        self.assertEqual(bake.main([self.path("in.usda"), self.path("out.usdc"), "--step", "0.5"]), 0)
        out = Usd.Stage.Open(self.path("out.usdc"))
        points = UsdGeom.BasisCurves(out.GetPrimAtPath("/Root/Hair")).GetPointsAttr()
        self.assertEqual(points.GetTimeSamples(), [1, 1.5, 2, 2.5, 3])
        for time, expected in ((1, (1, 0, 0)), (2, (0, 1, 0)), (2.5, (-(0.5**0.5), 0.5**0.5, 0)), (3, (-1, 0, 0))):
            np.testing.assert_allclose(points.Get(time)[1], expected, atol=1e-6)
        still = UsdGeom.Mesh(out.GetPrimAtPath("/Still")).GetPointsAttr()
        self.assertEqual((still.GetNumTimeSamples(), len(still.Get())), (0, 3))
        self.assertEqual((UsdGeom.GetStageUpAxis(out), UsdGeom.GetStageMetersPerUnit(out)), ("Z", 0.5))
        self.assertEqual(sorted(os.listdir(os.path.dirname(self.path("x")))), ["in.usda", "out.usdc"])

    def test_frames_are_chosen(self):
        moving_stage(self.path("in.usda"))
        self.assertEqual(bake.main([self.path("in.usda"), self.path("out.usda"), "--frames", "2:3"]), 0)
        out = Usd.Stage.Open(self.path("out.usda"))
        self.assertEqual((out.GetStartTimeCode(), out.GetEndTimeCode()), (2, 3))

    def test_every_step_of_the_range_and_what_is_to_be_held_are_covered(self):
        moving_stage(self.path("in.usda"))

        def times(*options):
            self.assertEqual(bake.main([self.path("in.usda"), self.path("out.usda"), *options]), 0)
            out = Usd.Stage.Open(self.path("out.usda"))
            return UsdGeom.BasisCurves(out.GetPrimAtPath("/Root/Hair")).GetPointsAttr().GetTimeSamples()

        self.assertEqual(times("--frames=-1.5:3", "--step=2"), [-1.5, 0.5, 2.5, 4.5])
        self.assertEqual(times("--frames=2:3", "--hold=1.8", "--step=0.5"), [1.5, 2, 2.5, 3])
        self.assertEqual(times("--frames=1:2", "--hold=3"), [1, 2, 3])
        self.assertEqual(times("--frames=1:3", "--hold=2"), [1, 2, 3])
        for wrong in ("--frames=0:inf", "--frames=nan:1", "--step=0", "--step=inf", "--hold=nan"):
            with self.subTest(wrong):
                self.assertEqual(bake.main([self.path("in.usda"), self.path("out.usda"), wrong]), 2)

    def test_the_value_outside_the_samples_does_not_depend_on_the_range(self):
        stage = Usd.Stage.CreateNew(self.path("in.usda"))
        root = UsdGeom.Xform.Define(stage, "/R")
        translate = root.AddTranslateOp()
        for time in (0, 10):
            translate.Set(Gf.Vec3d(time, 0, 0), time)
        root.AddScaleOp().Set(Gf.Vec3f(2))
        mesh = UsdGeom.Mesh.Define(stage, "/R/B")
        mesh.CreatePointsAttr([(0, 0, 9), (1, 0, 9), (0, 1, 9)])
        mesh.CreateNormalsAttr([(1, 0, 0)] * 3)
        for time in (2, 4):
            mesh.GetPointsAttr().Set([(0, 0, time), (1, 0, time), (0, 1, time)], time)
            mesh.GetNormalsAttr().Set([(0, 0, 1)] * 3, time)
        mesh.CreateFaceVertexCountsAttr([3])
        mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
        proxy = UsdGeom.Mesh.Define(stage, "/R/Proxy")
        proxy.CreatePurposeAttr(UsdGeom.Tokens.proxy)
        stage.GetRootLayer().Save()
        for options in (["--frames=5:8"], ["--frames=5:8", "--transforms"], ["--transforms"], []):
            with self.subTest(options):
                self.assertEqual(bake.main([self.path("in.usda"), self.path("out.usda"), *options]), 0)
                out = Usd.Stage.Open(self.path("out.usda"))
                self.assertFalse(out.GetPrimAtPath("/R/Proxy"))
                prim, outside = out.GetPrimAtPath("/R/B"), Usd.TimeCode.Default()
                world = UsdGeom.XformCache(outside).GetLocalToWorldTransform(prim)
                points = UsdGeom.Mesh(prim).GetPointsAttr().Get(outside)
                self.assertEqual([world.Transform(Gf.Vec3d(p)) for p in points], [(0, 0, 18), (2, 0, 18), (0, 2, 18)])
                self.assertEqual(list(UsdGeom.Mesh(prim).GetNormalsAttr().Get(outside)), [(1, 0, 0)] * 3)

    def test_skinning_is_exact_between_frames(self):
        path = self.path("skin.usda")
        stage = Usd.Stage.CreateNew(path)
        stage.SetStartTimeCode(0)
        stage.SetEndTimeCode(2)
        UsdSkel.Root.Define(stage, "/R")
        skeleton = UsdSkel.Skeleton.Define(stage, "/R/S")
        skeleton.CreateJointsAttr(["j"])
        skeleton.CreateBindTransformsAttr([Gf.Matrix4d(1)])
        skeleton.CreateRestTransformsAttr([Gf.Matrix4d(1)])
        motion = UsdSkel.Animation.Define(stage, "/R/S/M")
        motion.CreateJointsAttr(["j"])
        motion.CreateRotationsAttr([Gf.Quatf(1)])
        motion.CreateScalesAttr([Gf.Vec3h(1)])
        # A corner at time 0.5, which steps of a whole frame do not see.
        for time, x in ((0, 0), (0.5, 4), (1, 0), (2, 0)):
            motion.CreateTranslationsAttr().Set([Gf.Vec3f(x, 0, 0)], time)
        UsdSkel.BindingAPI.Apply(skeleton.GetPrim()).CreateAnimationSourceRel().SetTargets(["/R/S/M"])
        mesh = UsdGeom.Mesh.Define(stage, "/R/B")
        mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
        mesh.CreateFaceVertexCountsAttr([3])
        mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
        binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
        binding.CreateSkeletonRel().SetTargets(["/R/S"])
        binding.CreateJointIndicesPrimvar(True, 1).Set([0])
        binding.CreateJointWeightsPrimvar(True, 1).Set([1.0])
        stage.GetRootLayer().Save()
        self.assertEqual(bake.main([path, self.path("out.usdc"), "--step", "0.25"]), 0)
        out = Usd.Stage.Open(self.path("out.usdc"))
        points = UsdGeom.Mesh(out.GetPrimAtPath("/R/B")).GetPointsAttr()
        found = [points.Get(time)[0][0] for time in (0, 0.25, 0.5, 0.75, 1, 1.5)]
        np.testing.assert_allclose(found, [0, 2, 4, 2, 0, 0], atol=1e-6)

    def test_a_skinned_prim_keeps_its_bind_pose_and_far_ones_their_shape(self):
        path = self.path("far.usda")
        stage = Usd.Stage.CreateNew(path)
        stage.SetStartTimeCode(0)
        stage.SetEndTimeCode(2)
        UsdSkel.Root.Define(stage, "/R")
        far = UsdGeom.Xform.Define(stage, "/R/Far")
        far.AddTranslateOp().Set(Gf.Vec3d(1e6, 0, 0.1))
        skeleton = UsdSkel.Skeleton.Define(stage, "/R/Far/S")
        skeleton.CreateJointsAttr(["j"])
        skeleton.CreateBindTransformsAttr([Gf.Matrix4d(1)])
        skeleton.CreateRestTransformsAttr([Gf.Matrix4d(1)])
        motion = UsdSkel.Animation.Define(stage, "/R/Far/S/M")
        motion.CreateJointsAttr(["j"])
        motion.CreateTranslationsAttr([Gf.Vec3f(0)])
        motion.CreateScalesAttr([Gf.Vec3h(1)])
        half = 0.5**0.5
        # Always turned by 90 degrees about z: nothing moves, and the bind pose is still another.
        motion.CreateRotationsAttr([Gf.Quatf(half, 0, 0, half)])
        UsdSkel.BindingAPI.Apply(skeleton.GetPrim()).CreateAnimationSourceRel().SetTargets(["/R/Far/S/M"])
        mesh = UsdGeom.Mesh.Define(stage, "/R/Far/B")
        mesh.CreatePointsAttr([(0.001, 0, 0), (1, 0, 0), (0, 1, 0)])
        mesh.CreateNormalsAttr([(1, 0, 0)] * 3)
        mesh.CreateFaceVertexCountsAttr([3])
        mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
        binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
        binding.CreateSkeletonRel().SetTargets(["/R/Far/S"])
        binding.CreateJointIndicesPrimvar(False, 1).Set([0, 0, 0])
        binding.CreateJointWeightsPrimvar(False, 1).Set([1.0, 1.0, 1.0])
        stage.GetRootLayer().Save()
        self.assertEqual(bake.main([path, self.path("out.usda"), "--transforms"]), 0)
        out = Usd.Stage.Open(self.path("out.usda"))
        prim = out.GetPrimAtPath("/R/Far/B")

        def placed(time):
            world = np.array(UsdGeom.XformCache(time).GetLocalToWorldTransform(prim))
            points = np.asarray(UsdGeom.Mesh(prim).GetPointsAttr().Get(time), float)
            return points @ world[:3, :3] + world[3, :3] - [1e6, 0, 0.1]

        np.testing.assert_allclose(placed(Usd.TimeCode.Default()), [(0.001, 0, 0), (1, 0, 0), (0, 1, 0)], atol=1e-7)
        np.testing.assert_allclose(placed(1), [(0, 0.001, 0), (0, 1, 0), (-1, 0, 0)], atol=1e-6)
        normals = UsdGeom.Mesh(prim).GetNormalsAttr()
        np.testing.assert_allclose(normals.Get(1), [(0, 1, 0)] * 3, atol=1e-6)
        np.testing.assert_allclose(normals.Get(Usd.TimeCode.Default()), [(1, 0, 0)] * 3, atol=1e-6)
        # Without it the points are in the stage's space, as far as float32 has it.
        self.assertEqual(bake.main([path, self.path("out.usda")]), 0)
        out.Reload()
        points = UsdGeom.Mesh(out.GetPrimAtPath("/R/Far/B")).GetPointsAttr()
        np.testing.assert_allclose(points.Get(1)[1], (1e6, 1, 0.1), atol=0.1)

    def test_changing_topology_is_refused_and_leaves_the_old_file(self):
        stage = moving_stage(self.path("in.usda"))
        counts = UsdGeom.Mesh(stage.GetPrimAtPath("/Still")).GetFaceVertexCountsAttr()
        counts.Set([3], 1)
        counts.Set([2], 2)
        stage.GetRootLayer().Save()
        with open(self.path("out.usda"), "w") as file:
            file.write("old")
        self.assertEqual(bake.main([self.path("in.usda"), self.path("out.usda")]), 2)
        with open(self.path("out.usda")) as file:
            self.assertEqual(file.read(), "old")
        self.assertEqual(sorted(os.listdir(os.path.dirname(self.path("x")))), ["in.usda", "out.usda"])

    def test_packages_hold_the_layer(self):
        moving_stage(self.path("in.usda"))
        self.assertEqual(package.main([self.path("in.usda"), self.path("out.usdz")]), 0)
        packed = Usd.Stage.Open(self.path("out.usdz"))
        self.assertTrue(packed.GetPrimAtPath("/Root/Hair"))
        self.assertEqual(package.main([self.path("none.usda"), self.path("no.usdz")]), 2)
        self.assertFalse(os.path.exists(self.path("no.usdz")))
        self.assertEqual(package.main([self.path("in.usda"), self.path("out.zip")]), 2)


if __name__ == "__main__":
    unittest.main()
