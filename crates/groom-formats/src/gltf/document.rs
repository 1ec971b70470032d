//! The JSON document that describes the buffer.

use std::collections::BTreeMap;
use std::io;

use gltf::json::accessor::{ComponentType, GenericComponentType};
use gltf::json::buffer::{Stride, Target, View};
use gltf::json::extras::RawValue;
use gltf::json::material::{AlphaMode, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf::json::mesh::{Mode, MorphTarget, Primitive};
use gltf::json::validation::Checked::{self, Valid};
use gltf::json::validation::USize64;
use gltf::json::{Accessor, Buffer, Index, Material, Mesh, Node, Root, Scene, serialize};
use gltf::mesh::Semantic;

use super::Plan;
use super::moving::Moving;
use super::nodes;
use super::surface::Surface;
use super::tail::Stored;
use super::views::{self, Field};

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
    let mut primitive = builder.primitive(plan);
    let tail: Vec<Index<Accessor>> = plan.tail.arrays.iter().map(|array| builder.stored(array)).collect();
    primitive.targets = targets(plan, &tail);
    builder.place(plan, primitive, &tail)?;
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

impl Builder {
    /// Describes the arrays in the order [`bytes`](super::bytes) writes them.
    fn primitive(&mut self, plan: &Plan<'_>) -> Primitive {
        let mut indices = None;
        let mut attributes: BTreeMap<Checked<Semantic>, Index<Accessor>> = BTreeMap::new();
        for view in &plan.views {
            let place = self.view(view);
            for field in &view.fields {
                let accessor = self.accessor(place, view.count, field);
                match &field.semantic {
                    Some(semantic) => drop(attributes.insert(Valid(semantic.clone()), accessor)),
                    None => indices = Some(accessor),
                }
            }
        }
        let material = Some(self.root.push(hair_material(plan)));
        let mode = Valid(if plan.surface.is_some() { Mode::Triangles } else { Mode::Lines });
        Primitive { attributes, extensions: None, extras: None, indices, material, mode, targets: None }
    }

    fn view(&mut self, view: &views::View<'_>) -> Index<View> {
        let is_vertex = view.fields.iter().any(|field| field.semantic.is_some());
        let target = if is_vertex { Target::ArrayBuffer } else { Target::ElementArrayBuffer };
        let bytes = view.bytes();
        let place = self.root.push(View {
            buffer: self.buffer,
            byte_length: bytes.into(),
            byte_offset: Some(self.used.into()),
            byte_stride: is_vertex.then_some(Stride(view.stride)),
            name: None,
            target: Some(Valid(target)),
            extensions: None,
            extras: None,
        });
        self.used += bytes;
        place
    }

    fn accessor(&mut self, view: Index<View>, count: usize, field: &Field) -> Index<Accessor> {
        let [min, max] = field.bounds.clone().map_or([None, None], |bounds| bounds.map(Some));
        self.root.push(Accessor {
            buffer_view: Some(view),
            byte_offset: (field.offset > 0).then(|| USize64::from(field.offset)),
            count: USize64::from(count),
            component_type: Valid(GenericComponentType(field.component)),
            extensions: None,
            extras: None,
            type_: Valid(field.kind),
            min,
            max,
            name: None,
            normalized: field.normalized,
            sparse: None,
        })
    }

    /// Describes an array behind those of the mesh.
    fn stored(&mut self, array: &Stored) -> Index<Accessor> {
        let place = self.root.push(View {
            buffer: self.buffer,
            byte_length: array.bytes().into(),
            byte_offset: Some(self.used.into()),
            byte_stride: array.is_vertex.then_some(Stride(12)),
            name: None,
            target: array.is_vertex.then_some(Valid(Target::ArrayBuffer)),
            extensions: None,
            extras: None,
        });
        self.used += array.bytes();
        let field = Field::new(None, ComponentType::F32, array.kind);
        self.accessor(place, array.count, &Field { bounds: array.bounds.clone(), ..field })
    }

    /// Puts the primitive into a mesh, a node and the scene, with what moves it.
    fn place(&mut self, plan: &Plan<'_>, primitive: Primitive, tail: &[Index<Accessor>]) -> io::Result<()> {
        let extras = match &plan.marks {
            Some(marks) => Some(RawValue::from_string(marks.to_string()).map_err(io::Error::other)?),
            None => None,
        };
        let weights = primitive.targets.as_ref().map(|targets| vec![0.0; targets.len()]);
        let mesh = self.root.push(Mesh {
            extensions: None,
            extras,
            name: Some("Strands".to_owned()),
            primitives: vec![primitive],
            weights,
        });
        let mut node = Node { mesh: Some(mesh), name: Some("Groom".to_owned()), ..Node::default() };
        if let Some(grid) = plan.grid.filter(|grid| grid.is_stored()) {
            // A skin places the integers itself; the node of its mesh does not count.
            if !matches!(plan.moving, Moving::Skin(_)) {
                node.translation = Some(grid.translation().to_array());
                node.scale = Some([grid.scale(); 3]);
            }
            let extension = "KHR_mesh_quantization".to_owned();
            self.root.extensions_used.push(extension.clone());
            self.root.extensions_required.push(extension);
        }
        let mut nodes = Vec::new();
        match &plan.moving {
            Moving::Nothing => nodes.push(self.root.push(node)),
            Moving::Skin(skin) => {
                let (skin, joints) = nodes::skin(&mut self.root, skin, tail);
                node.skin = Some(skin);
                nodes.push(self.root.push(node));
                nodes.extend(joints);
            }
            Moving::Morphs(morphs) => {
                let place = morphs.origin.as_vec3();
                node.translation = (place != glam::Vec3::ZERO).then_some(place.to_array());
                let node = self.root.push(node);
                nodes::morphs(&mut self.root, node, morphs, tail);
                nodes.push(node);
            }
        }
        let scene = Scene { extensions: None, extras: None, name: None, nodes };
        self.root.scene = Some(self.root.push(scene));
        Ok(())
    }
}

/// What the frames of a mesh move its vertices by.
fn targets(plan: &Plan<'_>, tail: &[Index<Accessor>]) -> Option<Vec<MorphTarget>> {
    let Moving::Morphs(morphs) = &plan.moving else { return None };
    let target = |place: &usize| {
        let positions = tail.get(*place).copied();
        MorphTarget { positions, normals: None, tangents: None }
    };
    let targets: Vec<MorphTarget> = morphs.targets.iter().map(target).collect();
    (!targets.is_empty()).then_some(targets)
}

/// White, so that COLOR_0 shows as it is; glTF's default material is a metal, which hair is not. Alpha
/// is looked at only when the material asks for it.
fn hair_material(plan: &Plan<'_>) -> Material {
    Material {
        name: Some("Hair".to_owned()),
        alpha_mode: Valid(if plan.is_clear { AlphaMode::Blend } else { AlphaMode::Opaque }),
        double_sided: plan.surface.as_ref().is_some_and(Surface::is_ribbon),
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
