//! One primitive of lines, where its node stands.

use glam::{DMat4, DVec3, Vec2, Vec3};
use gltf::accessor::Dimensions;
use gltf::{Accessor, Primitive, Semantic};
use gltf_bytes::{Asset, Elements, GltfError};
use groom::Values;

use super::Found;
use super::chains::{Chains, chains};

/// Adds the strands of `primitive`, number `number` among those of lines.
pub(super) fn add(
    found: &mut Found,
    asset: &Asset<'_>,
    mesh: usize,
    primitive: &Primitive<'_>,
    world: Option<DMat4>,
    number: i32,
) -> Result<(), GltfError> {
    let place = format!("meshes[{mesh}].primitives[{}]", primitive.index());
    let Some(accessor) = primitive.get(&Semantic::Positions) else {
        let found = "no POSITION".to_owned();
        return Err(GltfError::Invalid {
            place,
            found,
            expected: "one in every primitive of lines".to_owned(),
        });
    };
    look_at_replaced(found, &accessor, &place)?;
    let positions = Elements::of(&accessor, &[Dimensions::Vec3], &asset.buffers)?;
    let indices = match primitive.indices() {
        Some(accessor) => {
            look_at_replaced(found, &accessor, &place)?;
            let indices = Elements::open(&accessor, &asset.buffers)?;
            found.look(indices.len(), &place)?;
            let indices = indices.indices()?;
            // Vertices between the first and the last are gone through.
            let span = indices.iter().max().zip(indices.iter().min()).map_or(0, |(max, min)| max - min);
            found.look(positions.len().min(span as usize), &place)?;
            Some(indices)
        }
        None => None,
    };
    let at = |vertex: u32| positions.map(std::iter::once(vertex as usize), |p: [f64; 3]| p).pop();
    let chains = chains(primitive.mode(), indices, positions.len(), |a, b| at(a) == at(b), &place)?;
    let points = chains.vertices.len();
    let before = found.positions.len();
    if u32::try_from(before.saturating_add(points)).is_err() {
        let found = format!("{points} points after {before} others");
        return Err(GltfError::Invalid { place, found, expected: "4294967295 in all".to_owned() });
    }
    found.spend(points, size_of::<Vec3>() + 1, &place)?;
    let which = || chains.vertices.iter().map(|&vertex| vertex as usize);
    let mut placed = match world {
        None => positions.map(which(), |p: [f64; 3]| Vec3::from_array(p.map(|v| v as f32))),
        Some(world) => positions.map(which(), |p| world.transform_point3(DVec3::from_array(p)).as_vec3()),
    };
    if found.positions.is_empty() {
        found.positions = placed;
    } else {
        found.positions.append(&mut placed);
    }
    let mut end = before as u32;
    found.offsets.extend(chains.lengths.iter().map(|length| {
        end += length;
        end
    }));
    found.primitives.extend(chains.lengths.iter().map(|_| number));
    let scale = world.map_or(1.0, |world| world.determinant().abs().cbrt());
    for (semantic, accessor) in primitive.attributes() {
        if semantic != Semantic::Positions {
            look_at_replaced(found, &accessor, &place)?;
            let elements = Elements::open(&accessor, &asset.buffers)?;
            same_count(&elements, positions.len(), &semantic, &place)?;
            let column = Column { semantic, elements, world, scale };
            column.add(found, &chains, before, &place)?;
        }
    }
    Ok(())
}

/// Sparse accessors are copied.
fn look_at_replaced(found: &mut Found, accessor: &Accessor<'_>, place: &str) -> Result<(), GltfError> {
    if accessor.sparse().is_some() { found.look(accessor.count(), place) } else { Ok(()) }
}

fn same_count(
    elements: &Elements<'_>,
    count: usize,
    semantic: &Semantic,
    place: &str,
) -> Result<(), GltfError> {
    if elements.len() == count {
        return Ok(());
    }
    let place = format!("{place}.attributes.{}", semantic.to_string());
    let (found, expected) = (format!("{} values", elements.len()), format!("{count}, one a POSITION"));
    Err(GltfError::Invalid { place, found, expected })
}

/// An attribute of a primitive.
struct Column<'a> {
    semantic: Semantic,
    elements: Elements<'a>,
    world: Option<DMat4>,
    /// How much larger the node makes things.
    scale: f64,
}

impl Column<'_> {
    fn add(&self, found: &mut Found, chains: &Chains, before: usize, place: &str) -> Result<(), GltfError> {
        let name = self.semantic.to_string();
        let points = chains.vertices.len();
        let which = || chains.vertices.iter().map(|&vertex| vertex as usize);
        let dimensions = self.elements.dimensions();
        let mut add = |name: &str, bytes: usize, values: &dyn Fn() -> Values| {
            found.spend(points, bytes, place)?;
            found.columns.add(name, values(), before);
            Ok(())
        };
        match (&self.semantic, dimensions) {
            (Semantic::Colors(set), Dimensions::Vec3 | Dimensions::Vec4) => {
                add(&name, 12, &|| Values::Vec3(self.elements.map(which(), vec3)))?;
                if *set == 0 && dimensions == Dimensions::Vec4 {
                    let alpha = |[_, _, _, a]: [f64; 4]| (1.0 - a) as f32;
                    add("ALPHA", 4, &|| Values::Float(self.elements.map(which(), alpha)))?;
                }
                Ok(())
            }
            (Semantic::Extras(_), Dimensions::Scalar) if name == "_WIDTH" || name == "_RADIUS" => {
                let factor = if name == "_WIDTH" { 0.5 * self.scale } else { self.scale };
                add(&name, 4, &|| {
                    Values::Float(self.elements.map(which(), |[v]: [f64; 1]| (v * factor) as f32))
                })
            }
            (Semantic::Extras(_), Dimensions::Vec3) if name == "_VELOCITY" && self.world.is_some() => {
                let world = self.world.unwrap_or_default();
                let turned = |v: [f64; 3]| world.transform_vector3(DVec3::from_array(v)).as_vec3();
                add(&name, 12, &|| Values::Vec3(self.elements.map(which(), turned)))
            }
            (Semantic::Extras(_) | Semantic::TexCoords(_), Dimensions::Scalar) => {
                let integer = |[v]: [f64; 1]| v as i32;
                let float = |[v]: [f64; 1]| v as f32;
                let is_integer = self.elements.is_integer();
                add(&name, 4, &|| match is_integer {
                    true => Values::Int(self.elements.map(which(), integer)),
                    false => Values::Float(self.elements.map(which(), float)),
                })
            }
            (Semantic::Extras(_) | Semantic::TexCoords(_), Dimensions::Vec2) => {
                let pair = |v: [f64; 2]| Vec2::from_array(v.map(|v| v as f32));
                add(&name, 8, &|| Values::Vec2(self.elements.map(which(), pair)))
            }
            (Semantic::Extras(_), Dimensions::Vec3) => {
                add(&name, 12, &|| Values::Vec3(self.elements.map(which(), vec3)))
            }
            // Normals, tangents, skins, quadruples and matrices: a groom has no place for them.
            _ => {
                if !found.columns.torn.contains(&name) {
                    found.columns.torn.push(name);
                }
                Ok(())
            }
        }
    }
}

fn vec3(v: [f64; 3]) -> Vec3 {
    Vec3::from_array(v.map(|v| v as f32))
}
