//! Geometry parameters as attributes.

use std::collections::BTreeMap;

use groom::{Attribute, Domain, Values, names};
use ogawa::{OgawaError, PropertyKind, PropertyReader};

use super::curves::Curves;
use super::gather::gather;
use super::guides;
use super::values::Samples;
use crate::Warning;
use crate::alembic::schema;
use crate::cubic::Point;

/// The compound of a parameter whose values are named by index.
const VALUES: &str = ".vals";
const INDICES: &str = ".indices";
/// Normals, the one parameter of the curves' own besides width and uv.
const NORMALS: &str = "N";
/// Houdini's colour, taken where there is no other.
const HOUDINI_COLOR: &str = "Cd";

pub(super) type Attributes = BTreeMap<String, Attribute>;

/// Every attribute of the curves by its name in a groom.
pub(super) fn read(
    curves: &Curves<'_>,
    samples: &Samples,
    warnings: &mut Vec<Warning>,
) -> Result<Attributes, OgawaError> {
    let mut reader = Reader { curves, samples, warnings, found: Attributes::new() };
    let arbitrary = curves.geometry.find(schema::ARBITRARY)?.map(|p| p.compound()).transpose()?;
    if let Some(arbitrary) = &arbitrary {
        let closest = guides::closest(arbitrary, samples)?.filter(|ids| ids.len() == reader.strands());
        let followed = closest.is_some();
        if let Some(ids) = closest {
            let values = reader.of_strands(Values::Int(ids));
            reader.found.insert(names::CLOSEST_GUIDE.into(), Attribute { domain: Domain::Strand, values });
        }
        for property in arbitrary.iter() {
            let property = property?;
            let is_known = [schema::CLOSEST_GUIDES, schema::GUIDE_WEIGHTS].contains(&property.name());
            if !(followed && is_known) {
                reader.arbitrary(&property)?;
            }
        }
    }
    for name in [schema::WIDTH, schema::UV, NORMALS] {
        if let Some(property) = curves.geometry.find(name)? {
            reader.native(&property)?;
        }
    }
    if let Some(velocities) = curves.velocities(samples)? {
        let velocity = Attribute { domain: Domain::Vertex, values: Values::Vec3(velocities) };
        reader.found.insert(names::VELOCITY.into(), velocity);
    }
    let mut found = reader.found;
    if !found.contains_key(names::COLOR)
        && let Some(color) = found.remove(HOUDINI_COLOR)
    {
        found.insert(names::COLOR.into(), color);
    }
    gather(curves, samples, &mut found)?;
    Ok(found)
}

struct Reader<'r, 'a> {
    curves: &'r Curves<'a>,
    samples: &'r Samples,
    warnings: &'r mut Vec<Warning>,
    found: Attributes,
}

impl Reader<'_, '_> {
    fn strands(&self) -> usize {
        self.curves.polylines.counts.len()
    }

    fn arbitrary(&mut self, property: &PropertyReader<'_>) -> Result<(), OgawaError> {
        let name = property.name();
        let standard = schema::PARAMETERS.iter().find(|(_, written)| *written == name);
        let Some(mut attribute) = self.attribute(property)? else { return Ok(()) };
        if name == schema::GROOM_WIDTH {
            self.halve(&mut attribute);
        }
        let name = match standard {
            Some((name, _)) => *name,
            None if name == schema::GROOM_WIDTH => names::RADIUS,
            None => name,
        };
        self.found.insert(name.to_owned(), attribute);
        Ok(())
    }

    /// The curves' own: a width that `groom_width` does not overrule, and a uv that is the roots' if there is
    /// one a strand.
    fn native(&mut self, property: &PropertyReader<'_>) -> Result<(), OgawaError> {
        let name = property.name();
        let taken = |found: &Attributes, name: &str| found.contains_key(name);
        if name == schema::WIDTH && taken(&self.found, names::RADIUS) {
            return Ok(());
        }
        // The same as the roots' where we wrote it.
        if name == schema::UV && taken(&self.found, names::ROOT_UV) {
            return Ok(());
        }
        let Some(mut attribute) = self.attribute(property)? else { return Ok(()) };
        let name = match name {
            schema::WIDTH => {
                self.halve(&mut attribute);
                names::RADIUS
            }
            schema::UV if attribute.domain == Domain::Strand => names::ROOT_UV,
            other => other,
        };
        if !taken(&self.found, name) {
            self.found.insert(name.to_owned(), attribute);
        }
        Ok(())
    }

    /// Diameters to radii, in the archive's space.
    fn halve(&self, attribute: &mut Attribute) {
        let scale = self.curves.scale();
        if let Values::Float(values) = &mut attribute.values {
            for value in values {
                *value = if scale == 1.0 { 0.5 * *value } else { (f64::from(*value) * 0.5 * scale) as f32 };
            }
        }
    }

    /// A parameter as an attribute; `None`, with a warning, where a groom has no place for it.
    fn attribute(&mut self, property: &PropertyReader<'_>) -> Result<Option<Attribute>, OgawaError> {
        let (values, words) = match property.kind() {
            PropertyKind::Compound => {
                let Some(values) = property.compound()?.find(VALUES)? else { return Ok(None) };
                (self.indexed(property, &values)?, values.metadata())
            }
            _ if property.sample_count() == 0 => return Ok(None),
            _ => (self.samples.values(property)?, property.metadata()),
        };
        let scope = words.get("geoScope").unwrap_or_default();
        match values.and_then(|values| self.placed(values, scope)) {
            Ok(attribute) => Ok(Some(attribute)),
            Err(why) => {
                let name = property.name().to_owned();
                self.warnings.push(Warning::AttributeNotRead { name, why });
                Ok(None)
            }
        }
    }

    fn indexed(
        &self,
        property: &PropertyReader<'_>,
        values: &PropertyReader<'_>,
    ) -> Result<Result<Values, String>, OgawaError> {
        let indices = property.compound()?.find(INDICES)?.filter(|indices| indices.sample_count() > 0);
        if values.sample_count() == 0 {
            return Ok(Err("it has no values".into()));
        }
        let values = match (self.samples.values(values)?, indices) {
            (Ok(values), Some(indices)) => (values, indices),
            (values, _) => return Ok(values),
        };
        let (values, indices) = values;
        let sample = self.samples.held(&indices)?;
        let each = match &values {
            Values::Float(_) | Values::Int(_) => 4,
            Values::Vec2(_) => 8,
            Values::Vec3(_) => 12,
        };
        self.samples.spend((4 + each) * sample.len(), property.name())?;
        let indices = sample.to_i32()?;
        let chosen = match &values {
            Values::Float(values) => choose(values, &indices).map(Values::Float),
            Values::Vec2(values) => choose(values, &indices).map(Values::Vec2),
            Values::Vec3(values) => choose(values, &indices).map(Values::Vec3),
            Values::Int(values) => choose(values, &indices).map(Values::Int),
        };
        Ok(chosen.ok_or_else(|| format!("its indices name more than its {} values", values.len())))
    }

    /// The values at the strands or their points: by the scope if their number fits it, else by their number alone,
    /// as Unreal does.
    fn placed(&self, values: Values, scope: &str) -> Result<Attribute, String> {
        let (curves, polylines) = (self.curves, &self.curves.polylines);
        let (count, strands) = (values.len(), polylines.counts.len());
        let domain = match scope {
            "con" if count == 1 => Some(Domain::Groom),
            "uni" if count == strands => Some(Domain::Strand),
            "vtx" if count == curves.control_points => Some(Domain::Vertex),
            _ if count == curves.control_points && count != strands => Some(Domain::Vertex),
            _ if count == strands => Some(Domain::Strand),
            _ if count == 1 => Some(Domain::Groom),
            _ => None,
        };
        let per_point = domain == Some(Domain::Vertex);
        let points = |domain: Option<Domain>, values| {
            domain.map(|domain| Attribute { domain, values }).ok_or_else(|| {
                let points = curves.control_points;
                let cubic = if polylines.are_plain() { "" } else { " that take no whole numbers" };
                format!("{count} values fit neither {strands} curves nor {points} points{cubic}")
            })
        };
        match domain {
            Some(Domain::Groom) => points(domain, values),
            Some(Domain::Strand) => points(domain, self.of_strands(values)),
            _ => {
                let values = match values {
                    Values::Float(values) => self.over(values, per_point).map(Values::Float),
                    Values::Vec2(values) => self.over(values, per_point).map(Values::Vec2),
                    Values::Vec3(values) => self.over(values, per_point).map(Values::Vec3),
                    // Whole numbers are not mixed on a cubic curve.
                    Values::Int(values) if polylines.are_plain() && per_point => Some(Values::Int(values)),
                    Values::Int(_) => None,
                };
                match values {
                    Some(values) => points(Some(Domain::Vertex), values),
                    None => points(None, Values::Int(Vec::new())),
                }
            }
        }
    }

    /// Values at the points of the strands, from one a control point or one an end of a span.
    fn over<P: Point>(&self, values: Vec<P>, per_point: bool) -> Option<Vec<P>> {
        let polylines = &self.curves.polylines;
        if per_point { Some(polylines.per_point(values)) } else { polylines.per_span_end(values) }
    }

    /// Without the values of curves that have no points and are no strands.
    fn of_strands(&self, values: Values) -> Values {
        fn kept<T: Copy>(values: Vec<T>, counts: &[u32]) -> Vec<T> {
            if counts.iter().all(|&count| count > 0) {
                return values;
            }
            values.iter().zip(counts).filter(|(_, count)| **count > 0).map(|(value, _)| *value).collect()
        }
        let counts = &self.curves.polylines.counts;
        match values {
            Values::Float(values) => Values::Float(kept(values, counts)),
            Values::Vec2(values) => Values::Vec2(kept(values, counts)),
            Values::Vec3(values) => Values::Vec3(kept(values, counts)),
            Values::Int(values) => Values::Int(kept(values, counts)),
        }
    }
}

fn choose<T: Copy>(values: &[T], indices: &[i32]) -> Option<Vec<T>> {
    indices.iter().map(|&index| values.get(usize::try_from(index).ok()?).copied()).collect()
}
