//! Materials of a USD mesh, as far as they say a base colour.

use std::path::Path;
use std::sync::Arc;

use glam::Vec3;
use usd_layer::{Layer, Prim, Relationship, Value};

use super::stage::Place;
use crate::shape::Look;
use crate::texture::TextureSource;

/// Names of the relationship that binds a material, most wanted first.
const BINDINGS: [&str; 2] = ["material:binding:full", "material:binding"];

/// Prims that are asked one after another for one colour; a ring of connections ends here.
const MOST_STEPS: usize = 16;

/// The look of the prim at the end of `chain`: its own material, else that of the nearest prim above.
pub(super) fn look<B>(layer: &Layer<B>, chain: &[&Prim], path: &Path) -> Look {
    let binding =
        chain.iter().rev().find_map(|prim| BINDINGS.iter().find_map(|name| target(prim.relationship(name)?)));
    let Some(material) = binding else { return display_color(chain) };
    let name = material.rsplit('/').next().unwrap_or_default();
    let mut look = Look { material: Some(name.to_owned()), ..Look::default() };
    let Some(prim) = layer.prim(&material) else { return look };
    let Some(surface) = prim.attribute("outputs:surface") else { return look };
    let Some(shader) = followed(layer, surface) else { return look };
    match shader.attribute("inputs:diffuseColor") {
        Some(color) => match followed(layer, color) {
            Some(texture) => look.texture = picture(texture, path).map(Arc::new),
            None => look.base_color = color.held(None).and_then(vector).unwrap_or(Vec3::ONE),
        },
        // What UsdPreviewSurface means without one.
        None => look.base_color = Vec3::splat(0.18),
    }
    look
}

/// A mesh without a material may say one colour.
fn display_color(chain: &[&Prim]) -> Look {
    let color = chain.last().and_then(|prim| prim.attribute("primvars:displayColor")?.held(None));
    Look { base_color: color.and_then(vector).unwrap_or(Vec3::ONE), ..Look::default() }
}

fn vector(value: &Value) -> Option<Vec3> {
    let components = value.components()?;
    let [x, y, z] = *components.as_slice() else { return None };
    Some(Vec3::new(x as f32, y as f32, z as f32))
}

fn target(relationship: &Relationship) -> Option<String> {
    relationship.targets.as_ref()?.items().find_map(Value::text).map(str::to_owned)
}

/// The prim whose output an attribute is connected to, through materials and node graphs that only pass it on.
fn followed<'l, B>(layer: &'l Layer<B>, attribute: &usd_layer::Attribute) -> Option<&'l Prim> {
    let source = |attribute: &usd_layer::Attribute| {
        attribute.connections.as_ref()?.items().find_map(Value::text).map(str::to_owned)
    };
    let mut at = source(attribute)?;
    for _ in 0..MOST_STEPS {
        let (path, output) = at.rsplit_once('.')?;
        let prim = layer.prim(path)?;
        match prim.attribute(output).and_then(source) {
            Some(next) => at = next,
            None => return Some(prim),
        }
    }
    None
}

fn picture(texture: &Prim, layer: &Path) -> Option<TextureSource> {
    let file = texture.attribute("inputs:file")?.held(None)?.text()?.to_owned();
    let place = "inputs:file".to_owned();
    let lost = |fault: &str| {
        let fault = format!("{file:?} {fault}");
        Some(TextureSource::Lost { path: layer.to_owned(), place: place.clone(), fault })
    };
    if layer.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("usdz")) {
        return lost("is inside the package, which is not read for pictures; unpack it");
    }
    match layer.parent() {
        Some(folder) => Some(TextureSource::File(folder.join(&file))),
        None => lost("is beside a layer without a folder"),
    }
}

/// The look of the prim at `place`, or of the subset of it, when `layer` has it.
pub(super) fn at_place<B>(layer: &Layer<B>, place: &Place, subset: Option<&str>, path: &Path) -> Look {
    let mut chain = Vec::new();
    let mut prims = &layer.prims;
    for name in place.path.split('/').skip(1).chain(subset) {
        let Some(prim) = prims.iter().find(|prim| &*prim.name == name) else { break };
        chain.push(prim);
        prims = &prim.children;
    }
    look(layer, &chain, path)
}
