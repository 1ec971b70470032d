//! The curves of a stage and where they stand.

use glam::{DMat4, DVec3};
use usd_layer::{Layer, Prim, Specifier, Value, xform};

use super::Context;
use super::values::Fault;
use crate::FormatError;

/// Metadata that pulls in other layers or prims.
const ARCS: [&str; 4] = ["references", "payload", "inherits", "specializes"];

/// A stage of one layer.
pub(super) struct Stage<B> {
    pub(super) layer: Layer<B>,
    pub(super) context: Context,
    pub(super) curves: Vec<Place>,
    /// Times at which something about the curves' points is given, rising.
    pub(super) times: Vec<f64>,
    /// How many prims, and sublayers, pull in what is not followed.
    pub(super) composed: usize,
    /// Where positions are measured from.
    pub(super) origin: DVec3,
}

/// Where a prim is.
#[derive(Clone, Default)]
pub(super) struct Place {
    /// Its path, `/Groom/Strands`.
    pub(super) path: String,
    /// Its index in its parent, and theirs.
    indices: Vec<usize>,
}

impl<B: AsRef<[u8]>> Stage<B> {
    pub(super) fn new(layer: Layer<B>, context: Context) -> Result<Self, FormatError> {
        let mut stage =
            Stage { layer, context, curves: Vec::new(), times: Vec::new(), composed: 0, origin: DVec3::ZERO };
        let mut found = Found::default();
        if let Some(Value::List(layers)) = stage.layer.metadata("subLayers") {
            found.composed += layers.items().count();
        }
        found.search(&stage.layer.prims, &Place::default());
        (stage.curves, stage.composed) = (found.curves, found.composed);
        if stage.curves.is_empty() {
            let (found, expected) = match (found.composed, found.guides) {
                (1.., _) => (
                    "no BasisCurves prim, and references to others",
                    "curves in this layer: composition is not followed; flatten it: tools/usd/bake.py",
                ),
                (_, 1..) => ("no BasisCurves prim but guides", "one whose purpose is not `guide`"),
                _ => ("no BasisCurves prim", "at least one that is defined and active"),
            };
            return Err(FormatError::invalid(&stage.context.file, "/", found, expected));
        }
        stage.times = stage.moving_times();
        Ok(stage)
    }

    fn moving_times(&self) -> Vec<f64> {
        let mut times = Vec::new();
        for place in &self.curves {
            let chain: Vec<&Prim> = self.chain(place).collect();
            let points = chain.last().and_then(|prim| prim.attribute("points")).into_iter();
            let ops = chain.iter().flat_map(|prim| xform::moving_attributes(prim));
            for attribute in points.chain(ops) {
                times.extend(attribute.samples.iter().flat_map(|samples| samples.times.iter().copied()));
            }
        }
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// The time that is read when `asked` for: the first if none is.
    pub(super) fn start(&self, asked: Option<f64>) -> Option<f64> {
        asked.or_else(|| self.times.first().copied())
    }

    /// The prims from the root to the one at `place`.
    pub(super) fn chain(&self, place: &Place) -> impl Iterator<Item = &Prim> {
        let mut prims = &self.layer.prims;
        place.indices.clone().into_iter().map_while(move |index| {
            let prim = prims.get(index)?;
            prims = &prim.children;
            Some(prim)
        })
    }

    /// Measures positions from where the first curves stand at a time.
    pub(super) fn keep_origin(&mut self, time: Option<f64>) -> Result<(), FormatError> {
        if let Some(first) = self.curves.first() {
            let origin = self.world_from_prim(first, time)?.w_axis.truncate();
            if !origin.is_finite() {
                let place = format!("place of {}", first.path);
                return Err(FormatError::invalid(
                    &self.context.file,
                    place,
                    origin.to_string(),
                    "finite numbers",
                ));
            }
            self.origin = origin;
        }
        Ok(())
    }

    /// From the space of the prim at `place` to the stage's, or to the origin that is kept.
    pub(super) fn world_from_prim(&self, place: &Place, time: Option<f64>) -> Result<DMat4, FormatError> {
        let mut world = DMat4::IDENTITY;
        for prim in self.chain(place) {
            let (local, resets) = xform::parent_from_prim(&self.layer, prim, time)
                .map_err(|error| Fault::from(error).into_error(&self.context.file, &place.path))?;
            world = if resets { local } else { world * local };
        }
        if self.origin != DVec3::ZERO {
            world.w_axis -= self.origin.extend(0.0);
        }
        Ok(world)
    }
}

#[derive(Default)]
struct Found {
    curves: Vec<Place>,
    composed: usize,
    guides: usize,
}

impl Found {
    /// Goes through prims that are there, first before what is in them.
    fn search(&mut self, prims: &[Prim], parent: &Place) {
        for (index, prim) in prims.iter().enumerate() {
            if prim.specifier != Specifier::Def || !prim.is_active() {
                continue;
            }
            self.composed += usize::from(ARCS.iter().any(|arc| prim.metadata(arc).is_some()));
            if prim.attribute("purpose").and_then(|purpose| purpose.held(None)?.text()) == Some("guide") {
                self.guides += 1;
                continue;
            }
            let indices = parent.indices.iter().copied().chain([index]).collect();
            let place = Place { path: format!("{}/{}", parent.path, prim.name), indices };
            if &*prim.type_name == "BasisCurves" {
                self.curves.push(place.clone());
            }
            self.search(&prim.children, &place);
        }
    }
}
