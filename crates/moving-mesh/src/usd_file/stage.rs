//! The meshes and cameras of a layer, and what in it is not read here.

use usd_layer::{Layer, Prim, ReadError, Specifier, Value};

use crate::error::Fault;

/// Metadata that pulls in other layers or prims, or times.
const ARCS: [&str; 5] = ["references", "payload", "inherits", "specializes", "clips"];

/// What a layer holds.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub(super) meshes: Vec<Place>,
    pub(super) cameras: Vec<Place>,
    /// Whether there is composition, which is not followed here.
    pub(super) composed: bool,
    /// Whether it is of the layer as a whole: sublayers.
    pub(super) layered: bool,
    /// Whether a skeleton moves a mesh.
    pub(super) skinned: bool,
}

/// Where a prim is.
#[derive(Clone, Debug, Default)]
pub(super) struct Place {
    /// Its path, `/Head/Skin`.
    pub(super) path: String,
    /// Its index in its parent, and theirs.
    indices: Vec<usize>,
}

impl Place {
    /// The prims from the root to this one.
    pub(super) fn chain<'l, B>(&self, layer: &'l Layer<B>) -> Vec<&'l Prim> {
        let mut prims = &layer.prims;
        let mut chain = Vec::with_capacity(self.indices.len());
        for index in &self.indices {
            let Some(prim) = prims.get(*index) else { break };
            chain.push(prim);
            prims = &prim.children;
        }
        chain
    }
}

impl Found {
    pub(super) fn search<B>(layer: &Layer<B>) -> Self {
        let mut found = Found::default();
        if let Some(Value::List(layers)) = layer.metadata("subLayers") {
            found.layered = layers.items().next().is_some();
            found.composed = found.layered;
        }
        found.prims(&layer.prims, &Place::default(), None);
        found
    }

    /// Goes through prims that are there, first before what is in them. `bound` is known below a SkelRoot:
    /// whether a prim above binds a skeleton.
    fn prims(&mut self, prims: &[Prim], parent: &Place, bound: Option<bool>) {
        for (index, prim) in prims.iter().enumerate() {
            if prim.specifier != Specifier::Def || !prim.is_active() {
                continue;
            }
            self.composed |= pulls_in(prim);
            let purpose = prim.attribute("purpose").and_then(|purpose| purpose.held(None)?.text());
            if matches!(purpose, Some("guide" | "proxy")) {
                continue;
            }
            let bound = if &*prim.type_name == "SkelRoot" { Some(bound.unwrap_or_default()) } else { bound };
            let bound = bound.map(|bound| bound || binds(prim));
            let indices = parent.indices.iter().copied().chain([index]).collect();
            let place = Place { path: format!("{}/{}", parent.path, prim.name), indices };
            match &*prim.type_name {
                "Mesh" => {
                    self.skinned |= bound == Some(true);
                    self.meshes.push(place.clone());
                }
                "Camera" => self.cameras.push(place.clone()),
                _ => {}
            }
            self.prims(&prim.children, &place, bound);
        }
    }
}

/// Whether a prim pulls in other layers or prims, or times.
pub(super) fn pulls_in(prim: &Prim) -> bool {
    ARCS.iter().any(|arc| prim.metadata(arc).is_some())
}

/// Whether a prim binds what is in it to a skeleton (UsdSkelBindingAPI).
fn binds(prim: &Prim) -> bool {
    prim.relationships.iter().any(|relationship| relationship.name.starts_with("skel:"))
        || prim
            .attributes
            .iter()
            .any(|a| a.name.starts_with("primvars:skel:") || &*a.name == "skel:blendShapes")
}

/// An attribute whose bytes are broken.
pub(super) fn fault_of(attribute: &str, error: ReadError) -> Fault {
    Fault::invalid(
        format!("{attribute}, {}", error.place),
        format!("found {}, expected {}", error.found, error.expected),
    )
}
