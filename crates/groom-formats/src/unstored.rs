//! What formats with a fixed set of columns cannot hold.

use groom::{Groom, UpAxis, names};

use crate::{Format, Warning};

/// Warns of the unit, the up axis and the attributes that HAIR and text have no place for.
pub(crate) fn warnings(groom: &Groom, format: Format, usual: UpAxis) -> Vec<Warning> {
    let mut warnings = axis_and_unit(groom, format, usual);
    left_out(groom, format, &[names::RADIUS, names::COLOR, names::TRANSPARENCY], &mut warnings);
    warnings
}

/// Warns of an up axis other than the `usual` one and of a unit other than the metre, where a format has neither.
pub(crate) fn axis_and_unit(groom: &Groom, format: Format, usual: UpAxis) -> Vec<Warning> {
    let mut warnings = Vec::new();
    if groom.up_axis != usual {
        warnings.push(Warning::UpAxisNotStored { format, usual, groom: groom.up_axis });
    }
    if groom.meters_per_unit != 1.0 {
        warnings.push(Warning::UnitNotStored { format, meters_per_unit: groom.meters_per_unit });
    }
    warnings
}

/// Warns of every attribute but those in `held`.
pub(crate) fn left_out(groom: &Groom, format: Format, held: &[&str], warnings: &mut Vec<Warning>) {
    let others = groom.attributes().map(|(name, _)| name).filter(|name| !held.contains(name));
    warnings.extend(others.map(|name| Warning::AttributeLeftOut { format, name: name.to_owned() }));
}
