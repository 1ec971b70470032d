//! What a render does without, and why that changes no pixel.

use fibre_material::{Dressed, Varying};
use fibre_scattering::Absorption;
use groom::{Attribute, Groom, names};

use crate::{Aov, Background, HairObject, MovingCamera, RenderSettings, SceneDescription, Transparency};

/// Something that was not loaded, built or computed.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct LeftOut {
    /// What was left out.
    pub what: String,
    /// Why it is not needed, and what that saves.
    pub why: String,
}

/// What rendering `description` with `settings` leaves out.
///
/// Each groom is dressed in its material to know what that comes to; of one whose material cannot be had
/// nothing is told of absorption and roughness, and [`crate::Scene::build`] says why.
#[must_use]
pub fn explain(description: &SceneDescription, settings: &RenderSettings) -> Vec<LeftOut> {
    let mut list = List(Vec::new());
    motion(description, &mut list);
    if !description.hair.iter().any(|object| object.material.fibre.medulla.scatters()) {
        list.add("medulla tables", "no fibre has a medulla that scatters");
    }
    if description.meshes.is_empty() {
        list.add("triangles in the tree", "the scene has no mesh");
    }
    light(description, &mut list);
    for (index, object) in description.hair.iter().enumerate() {
        hair(index, object, &mut list);
    }
    passes(settings, &mut list);
    list.0
}

struct List(Vec<LeftOut>);

impl List {
    fn add(&mut self, what: impl Into<String>, why: impl Into<String>) {
        self.0.push(LeftOut { what: what.into(), why: why.into() });
    }
}

/// What is not blurred.
fn motion(description: &SceneDescription, list: &mut List) {
    let hair = description.hair.iter().map(|h| ("hair", &h.motion));
    let meshes = description.meshes.iter().map(|m| ("mesh", &m.motion));
    let moves = description.moves();
    if !moves {
        list.add("motion in the tree", "nothing moves within a frame: boxes and points are held once");
    }
    for (index, (kind, motion)) in hair.enumerate().chain(meshes.enumerate()) {
        if motion.key_count() > 1 && !motion.moves() {
            let why = format!("all {} keys are the same: one is held", motion.key_count());
            list.add(format!("{kind} {index}: its motion"), why);
        } else if moves && !motion.moves() {
            list.add(format!("{kind} {index}: motion keys"), "it stands still: its points are held once");
        }
    }
}

/// What is left out for a camera, beside what [`explain`] tells; `moves` is whether anything of the scene does
/// ([`SceneDescription::moves`]).
#[must_use]
pub fn explain_camera(camera: &MovingCamera, moves: bool) -> Vec<LeftOut> {
    let mut list = List(Vec::new());
    if !camera.moves() {
        list.add("a lens for each sample", "the camera stands still: one serves all");
        if !moves {
            list.add("times of samples", "nothing moves: all are of one moment, whatever the shutter");
        }
    }
    list.0
}

fn light(description: &SceneDescription, list: &mut List) {
    match &description.environment {
        None => list.add("the environment", "the scene has none"),
        Some(environment) if environment.picture().is_none() => {
            list.add("the environment's table", "a constant environment is as bright everywhere");
        }
        Some(_) => {}
    }
    if description.lights.is_empty() {
        list.add("choosing among area lights", "the scene has none");
    } else if !description.lights.iter().any(|light| light.visible_camera) {
        list.add("area lights before the camera", "none is to be seen: they only light the scene");
    }
}

fn hair(index: usize, object: &HairObject, list: &mut List) {
    if let Ok(dressed) = object.material.fibre.dress(&object.groom) {
        varying(index, &object.groom, &dressed, list);
    }
    let parameters = &object.material.fibre.parameters;
    if parameters.aspect == 1.0 {
        list.add(
            format!("hair {index}: an axis by strand"),
            format!("the fibres are round: {} bytes saved", 12 * object.groom.strand_count()),
        );
    }
    let transparent = object.groom.attribute(names::TRANSPARENCY).is_some_and(some_are_clear);
    if transparent && object.material.transparency == Transparency::Ignored {
        list.add(
            format!("hair {index}: its transparency"),
            "fibres already let light through by refraction; ask for it to be obeyed",
        );
    }
    for (lobe, weight) in fibre_scattering::Lobe::ALL.into_iter().zip(parameters.lobe_weights) {
        if weight == 0.0 {
            list.add(
                format!("hair {index}: the {} lobe", lobe.name()),
                "its weight is 0: it is never sampled",
            );
        }
    }
}

/// What is held less often than it could vary.
fn varying(index: usize, groom: &Groom, dressed: &Dressed, list: &mut List) {
    let (strands, points) = (groom.strand_count(), groom.point_count());
    let (held, serves) = match dressed.absorption {
        Varying::Constant(_) => (0, "one absorption serves all strands"),
        Varying::Strand(_) => (strands, "one absorption serves each strand from root to tip"),
        Varying::Vertex(_) => (points, ""),
    };
    if held < points {
        let bytes = size_of::<Absorption>() * (points - held);
        list.add(format!("hair {index}: absorption by vertex"), format!("{serves}: {bytes} bytes saved"));
    }
    if dressed.roughness.is_none() {
        list.add(format!("hair {index}: a model by strand"), "one roughness serves all strands");
    }
}

fn some_are_clear(attribute: &Attribute) -> bool {
    matches!(&attribute.values, groom::Values::Float(values) if values.iter().any(|&v| v > 0.0))
}

fn passes(settings: &RenderSettings, list: &mut List) {
    // Settings that are out of range keep nothing.
    let pixels = settings.window().map_or(0, |window| window.count() as u64);
    for aov in Aov::ALL.into_iter().filter(|&aov| !settings.aovs.contains(aov)) {
        list.add(
            format!("the {} pass", aov.name()),
            format!("nobody asked for it: {} bytes saved", 12 * pixels),
        );
    }
    if settings.background == Background::Transparent {
        list.add("the environment behind the hair", "the background is transparent");
    }
}

#[cfg(test)]
mod tests {
    use fibre_material::{ColorRamp, Variation};
    use fibre_scattering::Medulla;
    use glam::Vec3;

    use super::*;
    use crate::{AovSet, Environment, HairColor, HairMaterial};

    /// Five strands of two points, and why their absorption is held as it is.
    fn absorption_of(change: impl FnOnce(&mut Groom, &mut HairMaterial)) -> Option<String> {
        let points = (0..10).map(|i| Vec3::new(i as f32, (i % 2) as f32, 0.0)).collect();
        let mut groom = Groom::new(vec![0, 2, 4, 6, 8, 10], points).unwrap();
        let mut material = HairMaterial::default();
        change(&mut groom, &mut material);
        let description =
            SceneDescription { hair: vec![HairObject::still(groom, material)], ..Default::default() };
        let told = explain(&description, &RenderSettings::default());
        told.into_iter().find(|left| left.what == "hair 0: absorption by vertex").map(|left| left.why)
    }

    #[test]
    fn one_absorption_is_told_of_where_there_is_one() {
        let vary = |variation| move |_: &mut Groom, m: &mut HairMaterial| m.fibre.variation = variation;
        let paint = |color| move |_: &mut Groom, m: &mut HairMaterial| m.fibre.color = color;
        assert_eq!(absorption_of(|_, _| {}).unwrap(), "one absorption serves all strands: 240 bytes saved");
        let each = absorption_of(vary(Variation { value: 0.3, ..Default::default() }));
        assert_eq!(each.unwrap(), "one absorption serves each strand from root to tip: 120 bytes saved");
        let ramp = ColorRamp::new(vec![(0.0, Vec3::splat(0.2)), (1.0, Vec3::splat(0.8))]).unwrap();
        assert_eq!(absorption_of(paint(HairColor::Ramp(ramp))), None);
        let by_vertex = absorption_of(|groom, material| {
            let values = (0..10).map(|i| i as f32 / 10.0).collect();
            let melanin = Attribute { domain: groom::Domain::Vertex, values: groom::Values::Float(values) };
            groom.set_attribute(names::MELANIN, melanin).unwrap();
            material.fibre.color = HairColor::GroomMelanin { concentration: 0.5, redness: 0.5 };
        });
        assert_eq!(by_vertex, None);
        assert_eq!(absorption_of(paint(HairColor::Color(Vec3::splat(2.0)))), None, "no such colour");
    }

    #[test]
    fn only_what_is_not_used_is_told() {
        let mut groom = groom::Groom::new(vec![0, 2], vec![Vec3::ZERO, Vec3::Y]).unwrap();
        groom.set_attribute(names::TRANSPARENCY, Attribute::constant_float(0.3)).unwrap();
        let mut material = HairMaterial::default();
        material.fibre.parameters.lobe_weights[3] = 0.0;
        let mut description = SceneDescription {
            hair: vec![HairObject::still(groom, material)],
            environment: Some(Environment::constant(Vec3::ONE).unwrap()),
            ..Default::default()
        };
        let all =
            RenderSettings { aovs: AovSet::all(), background: Background::Visible, ..Default::default() };
        let told = |description: &SceneDescription, settings| -> Vec<String> {
            explain(description, settings).into_iter().map(|left| left.what).collect()
        };
        let whats = told(&description, &all);
        for what in ["the environment's table", "hair 0: its transparency", "hair 0: the residual lobe"] {
            assert!(whats.iter().any(|w| w == what), "{whats:?}");
        }
        assert!(!whats.iter().any(|w| w.ends_with("pass")));
        assert!(whats.iter().any(|w| w == "medulla tables"));
        let mut fur = description.clone();
        fur.hair[0].material.fibre.medulla = Medulla { kappa: 0.5, sigma_s: 2.0, ..Medulla::NONE };
        assert!(!told(&fur, &all).iter().any(|w| w == "medulla tables"));
        description.environment = Some(Environment::studio(8).unwrap());
        assert!(!told(&description, &all).iter().any(|w| w == "the environment's table"));
        assert!(told(&description, &RenderSettings::default()).iter().any(|w| w == "the TT pass"));
    }
}
