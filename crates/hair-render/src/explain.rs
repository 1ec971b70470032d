//! What a render does without, and why that changes no pixel.

use groom::{Attribute, Domain, names};

use crate::{Aov, Background, HairColor, HairObject, RenderSettings, SceneDescription, Transparency};

/// Something that was not loaded, built or computed.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct LeftOut {
    /// What was left out.
    pub what: String,
    /// Why it is not needed, and what that saves.
    pub why: String,
}

/// What rendering `description` with `settings` leaves out.
#[must_use]
pub fn explain(description: &SceneDescription, settings: &RenderSettings) -> Vec<LeftOut> {
    let mut list = List(Vec::new());
    list.add("motion in the tree", "nothing moves within a frame: boxes and points are held once");
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
    }
}

fn hair(index: usize, object: &HairObject, list: &mut List) {
    let color = object.groom.attribute(names::COLOR);
    let constant = !matches!(object.material.fibre.color, HairColor::Groom { .. })
        || color.is_none_or(|c| c.domain == Domain::Groom);
    if constant {
        let bytes = 12 * object.groom.point_count();
        list.add(
            format!("hair {index}: absorption by vertex"),
            format!("one colour serves all strands: {bytes} bytes saved"),
        );
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

fn some_are_clear(attribute: &Attribute) -> bool {
    matches!(&attribute.values, groom::Values::Float(values) if values.iter().any(|&v| v > 0.0))
}

fn passes(settings: &RenderSettings, list: &mut List) {
    let pixels = u64::from(settings.width) * u64::from(settings.height);
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
    use fibre_scattering::Medulla;
    use glam::Vec3;

    use super::*;
    use crate::{AovSet, Environment, HairMaterial};

    #[test]
    fn only_what_is_not_used_is_told() {
        let mut groom = groom::Groom::new(vec![0, 2], vec![Vec3::ZERO, Vec3::Y]).unwrap();
        groom.set_attribute(names::TRANSPARENCY, Attribute::constant_float(0.3)).unwrap();
        let mut material = HairMaterial::default();
        material.fibre.parameters.lobe_weights[3] = 0.0;
        let mut description = SceneDescription {
            hair: vec![HairObject { groom, material }],
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
