//! The hair's material: one prim whose outputs are what renderers look for.
//!
//! | output | node | what it takes of the look |
//! |---|---|---|
//! | `surface` | UsdPreviewSurface | `color` (or the curves' displayColor), `beta_m` as roughness, `eta` |
//! | `mtlx:surface` | MaterialX 1.39 `ND_chiang_hair_bsdf` -> `ND_surface` | `absorption`, `roughness`, `eta`, `alpha`: the same model, nothing is lost |
//! | `ri:surface` | PxrMarschnerHair | cone angles from the variances, offset -`alpha` in degrees, `eta`, `color` behind TT and TRT |
//! | `arnold:surface` | `arnold:standard_hair` | `melanin` and redness, or `color`; `beta_m`, `beta_n`, `eta`, `alpha` in degrees as shift |
//!
//! MaterialX's `cuticle_angle` is `alpha / pi + 0.5`: 0 to 1 stand for -pi/2 to pi/2, and its R lobe moves by
//! 2 `alpha` as ours does, towards the root when `alpha` is over 0, with the curve's direction from root to tip
//! (`Tworld`, which its input `curve_direction` takes by itself). Its absorption is per fibre radius too. Its
//! generators clamp variances to 1, so `beta_m` over about 0.78 looks smoother there than it is.
//!
//! The last two have not been seen in their renderers.

use usd_layer::write::WriteError;

use crate::Look;
use crate::usd::write::sink::{Content, Declaration, Head, Single, Sink};

/// Where the material is.
pub(super) const PATH: &str = "/Groom/Looks/Hair";

/// Says the scope, the material and its nodes; the Xform is open.
pub(super) fn write<S: Sink>(sink: &mut S, look: &Look, has_colors: bool) -> Result<(), WriteError> {
    sink.begin(&Head { name: "Looks", type_name: "Scope", ..Head::default() })?;
    let apis = &["MaterialXConfigAPI"];
    sink.begin(&Head { name: "Hair", type_name: "Material", apis, is_component: false })?;
    sink.attribute(Declaration::new("string", "config:mtlx:version"), Content::Single(Single::Text("1.39")))?;
    for (output, source) in [
        ("outputs:surface", "/Groom/Looks/Hair/Preview.outputs:surface"),
        ("outputs:mtlx:surface", "/Groom/Looks/Hair/MaterialX.outputs:out"),
        ("outputs:ri:surface", "/Groom/Looks/Hair/Marschner.outputs:bxdf_out"),
        ("outputs:arnold:surface", "/Groom/Looks/Hair/Arnold.outputs:out"),
    ] {
        sink.attribute(Declaration::new("token", output), Content::Connection(source))?;
    }
    preview(sink, look, has_colors)?;
    materialx(sink, look)?;
    marschner(sink, look)?;
    arnold(sink, look)?;
    sink.end()?;
    sink.end()
}

/// A shader node that is open.
struct Node<'a, S> {
    sink: &'a mut S,
}

impl<'a, S: Sink> Node<'a, S> {
    fn open(sink: &'a mut S, name: &str, id: &str) -> Result<Self, WriteError> {
        sink.begin(&Head { name, type_name: "Shader", ..Head::default() })?;
        sink.attribute(Declaration::uniform("token", "info:id"), Content::Single(Single::Token(id)))?;
        Ok(Node { sink })
    }

    fn input(&mut self, type_name: &str, name: &str, value: Single<'_>) -> Result<(), WriteError> {
        self.sink.attribute(Declaration::new(type_name, name), Content::Single(value))
    }

    fn float(&mut self, name: &str, value: f32) -> Result<(), WriteError> {
        self.input("float", name, Single::Float(value))
    }

    fn color(&mut self, name: &str, value: [f32; 3]) -> Result<(), WriteError> {
        self.input("color3f", name, Single::Float3(value))
    }

    fn connect(&mut self, type_name: &str, name: &str, source: &str) -> Result<(), WriteError> {
        self.sink.attribute(Declaration::new(type_name, name), Content::Connection(source))
    }

    /// The node's output, which is the last that is said of it.
    fn close(self, type_name: &str, output: &str) -> Result<(), WriteError> {
        self.sink.attribute(Declaration::new(type_name, output), Content::Nothing)?;
        self.sink.end()
    }
}

fn preview<S: Sink>(sink: &mut S, look: &Look, has_colors: bool) -> Result<(), WriteError> {
    if has_colors {
        let mut reader = Node::open(sink, "Color", "UsdPrimvarReader_float3")?;
        reader.input("float3", "inputs:fallback", Single::Float3(look.color))?;
        reader.input("string", "inputs:varname", Single::Text("displayColor"))?;
        reader.close("float3", "outputs:result")?;
    }
    let mut node = Node::open(sink, "Preview", "UsdPreviewSurface")?;
    if has_colors {
        node.connect("color3f", "inputs:diffuseColor", "/Groom/Looks/Hair/Color.outputs:result")?;
    } else {
        node.color("inputs:diffuseColor", look.color)?;
    }
    node.float("inputs:ior", look.eta)?;
    node.float("inputs:roughness", look.beta_m)?;
    node.close("token", "outputs:surface")
}

fn materialx<S: Sink>(sink: &mut S, look: &Look) -> Result<(), WriteError> {
    let mut node = Node::open(sink, "Chiang", "ND_chiang_hair_bsdf")?;
    node.input("float3", "inputs:absorption_coefficient", Single::Float3(look.absorption))?;
    node.float("inputs:cuticle_angle", look.alpha / std::f32::consts::PI + 0.5)?;
    node.float("inputs:ior", look.eta)?;
    let [r, tt, trt] = look.roughness;
    for (name, roughness) in
        [("inputs:roughness_R", r), ("inputs:roughness_TT", tt), ("inputs:roughness_TRT", trt)]
    {
        node.input("float2", name, Single::Float2(roughness))?;
    }
    node.close("token", "outputs:out")?;
    let mut node = Node::open(sink, "MaterialX", "ND_surface")?;
    node.connect("token", "inputs:bsdf", "/Groom/Looks/Hair/Chiang.outputs:out")?;
    node.close("token", "outputs:out")
}

fn marschner<S: Sink>(sink: &mut S, look: &Look) -> Result<(), WriteError> {
    let mut node = Node::open(sink, "Marschner", "PxrMarschnerHair")?;
    node.float("inputs:diffuseGain", 0.0)?;
    let [r, tt, trt] = look.roughness.map(|[variance, _]| variance.max(0.0).sqrt().to_degrees());
    for (name, degrees) in [
        ("inputs:specularConeAngleR", r),
        ("inputs:specularConeAngleTT", tt),
        ("inputs:specularConeAngleTRT", trt),
    ] {
        node.float(name, degrees.min(90.0))?;
    }
    node.color("inputs:specularColorTT", look.color)?;
    node.color("inputs:specularColorTRT", look.color)?;
    node.float("inputs:specularIor", look.eta)?;
    node.float("inputs:specularOffset", -look.alpha.to_degrees())?;
    node.close("token", "outputs:bxdf_out")
}

fn arnold<S: Sink>(sink: &mut S, look: &Look) -> Result<(), WriteError> {
    let mut node = Node::open(sink, "Arnold", "arnold:standard_hair")?;
    // Melanin already is the colour; the base colour would be multiplied on it.
    let [melanin, redness] = look.melanin.unwrap_or([0.0, 0.0]);
    let base = if look.melanin.is_some() { [1.0; 3] } else { look.color };
    node.color("inputs:base_color", base)?;
    node.float("inputs:melanin", melanin)?;
    node.float("inputs:melanin_redness", redness)?;
    node.float("inputs:ior", look.eta)?;
    node.float("inputs:roughness", look.beta_m)?;
    node.float("inputs:roughness_azimuthal", look.beta_n)?;
    node.float("inputs:shift", look.alpha.to_degrees())?;
    node.close("token", "outputs:out")
}
