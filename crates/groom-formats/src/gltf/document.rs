//! The JSON document that describes the buffer.

use std::collections::BTreeMap;
use std::io;

use gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use gltf::json::buffer::{Stride, Target, View};
use gltf::json::material::{AlphaMode, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf::json::mesh::{Mode, Primitive};
use gltf::json::validation::Checked::{self, Valid};
use gltf::json::validation::USize64;
use gltf::json::{Accessor, Buffer, Index, Material, Mesh, Node, Root, Scene, Value, serialize};
use gltf::mesh::Semantic;

use crate::gltf::Plan;

pub(super) fn json(plan: &Plan<'_>, bytes_name: Option<&[u8]>) -> io::Result<Vec<u8>> {
    let mut builder = Builder { root: Root::default(), used: 0, buffer: Index::new(0) };
    builder.root.asset.generator = Some(concat!("groomkit ", env!("CARGO_PKG_VERSION")).to_owned());
    builder.buffer = builder.root.push(Buffer {
        byte_length: plan.buffer_bytes().into(),
        name: None,
        uri: bytes_name.map(percent_encoded),
        extensions: None,
        extras: None,
    });
    let primitive = builder.primitive(plan);
    builder.place(primitive);
    // A document is read by people when it stands alone.
    let bytes = match bytes_name {
        Some(_) => serialize::to_vec_pretty(&builder.root),
        None => serialize::to_vec(&builder.root),
    };
    bytes.map_err(io::Error::other)
}

struct Builder {
    root: Root,
    /// Bytes of the buffer described so far.
    used: u64,
    buffer: Index<Buffer>,
}

/// The shape of one array in the buffer.
struct Array {
    count: usize,
    item_bytes: usize,
    component: ComponentType,
    kind: Type,
    target: Target,
}

impl Builder {
    /// Describes the arrays in the order [`bytes`](super::bytes) writes them.
    fn primitive(&mut self, plan: &Plan<'_>) -> Primitive {
        let points = plan.drawable.points;
        let vertex = |item_bytes, component, kind| Array {
            count: points,
            item_bytes,
            component,
            kind,
            target: Target::ArrayBuffer,
        };
        let indices = self.array(&Array {
            count: plan.index_count(),
            item_bytes: 4,
            component: ComponentType::U32,
            kind: Type::Scalar,
            target: Target::ElementArrayBuffer,
        });
        let mut attributes: BTreeMap<Checked<Semantic>, Index<Accessor>> = BTreeMap::new();
        let positions = self.array(&vertex(12, ComponentType::F32, Type::Vec3));
        let bounds = |corner: glam::Vec3| Some(Value::from(corner.to_array().map(f64::from).to_vec()));
        let accessor = &mut self.root.accessors[positions.value()];
        (accessor.min, accessor.max) = (bounds(plan.min), bounds(plan.max));
        attributes.insert(Valid(Semantic::Positions), positions);
        if plan.colors.is_some() {
            let colors = self.array(&vertex(4, ComponentType::U8, Type::Vec4));
            self.root.accessors[colors.value()].normalized = true;
            attributes.insert(Valid(Semantic::Colors(0)), colors);
        }
        let widths = self.array(&vertex(4, ComponentType::F32, Type::Scalar));
        attributes.insert(Valid(Semantic::Extras("WIDTH".to_owned())), widths);
        let material = Some(self.root.push(hair_material(plan.is_clear)));
        Primitive {
            attributes,
            extensions: None,
            extras: None,
            indices: Some(indices),
            material,
            mode: Valid(Mode::Lines),
            targets: None,
        }
    }

    fn array(&mut self, array: &Array) -> Index<Accessor> {
        let bytes = (array.count * array.item_bytes) as u64;
        let is_vertex = array.target == Target::ArrayBuffer;
        let view = self.root.push(View {
            buffer: self.buffer,
            byte_length: bytes.into(),
            byte_offset: Some(self.used.into()),
            byte_stride: is_vertex.then_some(Stride(array.item_bytes)),
            name: None,
            target: Some(Valid(array.target)),
            extensions: None,
            extras: None,
        });
        self.used += bytes;
        self.root.push(Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: USize64::from(array.count),
            component_type: Valid(GenericComponentType(array.component)),
            extensions: None,
            extras: None,
            type_: Valid(array.kind),
            min: None,
            max: None,
            name: None,
            normalized: false,
            sparse: None,
        })
    }

    /// Puts the primitive into a mesh, a node and the scene.
    fn place(&mut self, primitive: Primitive) {
        let mesh = self.root.push(Mesh {
            extensions: None,
            extras: None,
            name: Some("Strands".to_owned()),
            primitives: vec![primitive],
            weights: None,
        });
        let node = Node { mesh: Some(mesh), name: Some("Groom".to_owned()), ..Node::default() };
        let nodes = vec![self.root.push(node)];
        let scene = Scene { extensions: None, extras: None, name: None, nodes };
        self.root.scene = Some(self.root.push(scene));
    }
}

/// White, so that COLOR_0 shows as it is; glTF's default material is a metal, which hair is not. Alpha
/// is looked at only when the material asks for it.
fn hair_material(is_clear: bool) -> Material {
    Material {
        name: Some("Hair".to_owned()),
        alpha_mode: Valid(if is_clear { AlphaMode::Blend } else { AlphaMode::Opaque }),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor([1.0; 4]),
            metallic_factor: StrengthFactor(0.0),
            roughness_factor: StrengthFactor(1.0),
            ..PbrMetallicRoughness::default()
        },
        ..Material::default()
    }
}

/// A file name as a relative URI: every byte but the unreserved ones of RFC 3986 as `%XX`.
fn percent_encoded(name: &[u8]) -> String {
    let mut uri = String::with_capacity(name.len());
    for &byte in name {
        if byte.is_ascii_alphanumeric() || b"-._~".contains(&byte) {
            uri.push(char::from(byte));
        } else {
            uri.push_str(&format!("%{byte:02X}"));
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn file_names_become_uris() {
        assert_eq!(percent_encoded(b"head-1_a.bin"), "head-1_a.bin");
        assert_eq!(percent_encoded("my hair#2 ä.bin".as_bytes()), "my%20hair%232%20%C3%A4.bin");
        assert_eq!(percent_encoded(b"\xff.bin"), "%FF.bin", "names need not be UTF-8");
    }
}
