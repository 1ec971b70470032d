//! The variants that a prim selects become part of it.

use crate::Value;
use crate::layer::Prim;

/// Selects in prims and in what is in them. A variant is weaker than what the prim says itself; it is moved, not
/// copied, so that variants in variants take no more memory.
pub(super) fn select(prims: &mut [Prim]) {
    for prim in prims {
        let mut sets = std::mem::take(&mut prim.variant_sets);
        let mut place = 0;
        while let Some(set) = sets.get_mut(place) {
            place += 1;
            let chosen = prim.metadata("variantSelection").and_then(|selection| selection.entry(&set.name));
            let chosen = chosen.and_then(Value::text);
            if let Some(found) = set.variants.iter().position(|variant| Some(&*variant.name) == chosen) {
                let variant = set.variants.swap_remove(found);
                add_weaker(prim, variant);
                // A variant may have sets of its own.
                sets.append(&mut prim.variant_sets);
            }
        }
        prim.variant_sets = sets;
        select(&mut prim.children);
    }
}

/// Adds what `weaker` says and `prim` does not.
fn add_weaker(prim: &mut Prim, weaker: Prim) {
    if prim.type_name.is_empty() {
        prim.type_name = weaker.type_name;
    }
    for (name, value) in weaker.metadata {
        if prim.metadata(&name).is_none() {
            prim.metadata.push((name, value));
        }
    }
    for attribute in weaker.attributes {
        match prim.attributes.iter_mut().find(|known| known.name == attribute.name) {
            Some(known) => {
                known.default = known.default.take().or(attribute.default);
                known.samples = known.samples.take().or(attribute.samples);
                for (name, value) in attribute.metadata {
                    if known.metadata(&name).is_none() {
                        known.metadata.push((name, value));
                    }
                }
            }
            None => prim.attributes.push(attribute),
        }
    }
    for relationship in weaker.relationships {
        if prim.relationship(&relationship.name).is_none() {
            prim.relationships.push(relationship);
        }
    }
    prim.variant_sets.extend(weaker.variant_sets);
    for child in weaker.children {
        match prim.children.iter_mut().find(|known| known.name == child.name) {
            Some(known) => {
                if known.specifier == crate::layer::Specifier::Over {
                    known.specifier = child.specifier;
                }
                add_weaker(known, child);
            }
            None => prim.children.push(child),
        }
    }
}
