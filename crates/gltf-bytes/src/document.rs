//! From JSON to a document whose indices and types are checked.

use gltf::json::deserialize::{from_slice, from_value};
use gltf::json::image::{Image, MimeType};
use gltf::json::validation::Checked;
use gltf::json::{Error, Index, Root, Value};
use gltf::{Document, Semantic};

use crate::GltfError;

/// Extensions a file may require because the data is read with them or does without.
const KNOWN: [&str; 5] = [
    // Only widens the types of accessors, all of which are read.
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_lights_punctual",
    "EXT_lights_image_based",
    "EXT_texture_webp",
];

/// Objects a document may always have, and bytes of text for each of any more: `{}` is two bytes of text and
/// hundreds of memory, while a real document spends several times this.
const ALWAYS_ALLOWED: usize = 1 << 12;
const OBJECT_BYTES: usize = 16;

/// Parses and validates a document: afterwards every index in it is in range.
///
/// # Errors
/// [`GltfError::Invalid`] with the JSON's line and column or the path of the value at fault;
/// [`GltfError::Unsupported`] for a required extension that changes geometry.
pub(crate) fn parse(json: &[u8]) -> Result<Document, GltfError> {
    let objects = json.iter().filter(|&&byte| byte == b'{').count();
    let most = ALWAYS_ALLOWED.max(json.len() / OBJECT_BYTES);
    if objects > most {
        let found = format!("{objects} objects in {} bytes", json.len());
        return Err(GltfError::invalid("JSON", found, format!("at most {most}")));
    }
    let mut root = root(json).map_err(|e| {
        let place = format!("JSON line {} column {}", e.line(), e.column());
        GltfError::invalid(place, e.to_string(), "a glTF 2.0 document")
    })?;
    refuse_unknown(&root)?;
    // `Document::from_json` would also refuse the required extensions it has not been compiled for.
    root.extensions_required.clear();
    check_positions(&mut root)?;
    check_channels(&root)?;
    complete_textures(&mut root);
    complete_images(&mut root);
    Document::from_json(root).map_err(|e| match e {
        gltf::Error::Validation(faults) => match faults.first() {
            Some((path, fault)) => GltfError::invalid(path.as_str(), fault.to_string(), "as glTF 2.0 says"),
            None => GltfError::invalid("JSON", "a fault", "a glTF 2.0 document"),
        },
        other => GltfError::invalid("JSON", other.to_string(), "a glTF 2.0 document"),
    })
}

/// Channels without a node move what only an extension knows (glTF 2.0, section 3.11); the crate does not read
/// them, so they are taken out before, in files that name the one extension there is.
fn root(json: &[u8]) -> Result<Root, Error> {
    const EXTENSION: &[u8] = b"KHR_animation_pointer";
    if !json.windows(EXTENSION.len()).any(|text| text == EXTENSION) {
        return from_slice(json);
    }
    let mut root: Value = from_slice(json)?;
    let animations = root.get_mut("animations").and_then(Value::as_array_mut);
    for animation in animations.into_iter().flatten() {
        if let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) {
            channels
                .retain(|channel| channel.get("target").is_none_or(|target| target.get("node").is_some()));
        }
    }
    from_value(root)
}

fn refuse_unknown(root: &Root) -> Result<(), GltfError> {
    let is_known =
        |name: &str| KNOWN.contains(&name) || name.starts_with("KHR_materials_") || name.contains("texture");
    match root.extensions_required.iter().find(|name| !is_known(name)) {
        Some(extension) => Err(GltfError::Unsupported {
            what: format!("the required extension {extension}"),
            remedy: "export without it (most exporters have a switch for compression)",
        }),
        None => Ok(()),
    }
}

/// The crate's validation looks up every `POSITION` accessor before it has checked the index, and wants its
/// bounds to be there. Nobody here trusts bounds, so those that are missing or odd are no reason to refuse.
fn check_positions(root: &mut Root) -> Result<(), GltfError> {
    let Root { meshes, accessors, .. } = root;
    let count = accessors.len();
    for (m, mesh) in meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let position = Checked::Valid(Semantic::Positions);
            let Some(index) = primitive.attributes.get(&position) else { continue };
            let Some(accessor) = accessors.get_mut(index.value()) else {
                let place = format!("meshes[{m}].primitives[{p}].attributes.POSITION");
                return Err(GltfError::invalid(
                    place,
                    index.to_string(),
                    format!("below the accessor count {count}"),
                ));
            };
            for bound in [&mut accessor.min, &mut accessor.max] {
                *bound = Some(Value::from(vec![0.0_f32; 3]));
            }
        }
    }
    Ok(())
}

/// The crate validates the samplers of an animation but not what its channels move, and panics on either fault
/// when asked for it.
fn check_channels(root: &Root) -> Result<(), GltfError> {
    for (a, animation) in root.animations.iter().enumerate() {
        for (c, channel) in animation.channels.iter().enumerate() {
            let place = format!("animations[{a}].channels[{c}].target");
            let (node, nodes) = (channel.target.node.value(), root.nodes.len());
            if node >= nodes {
                let expected = format!("below the node count {nodes}");
                return Err(GltfError::invalid(format!("{place}.node"), node.to_string(), expected));
            }
            if matches!(channel.target.path, Checked::Invalid) {
                let expected = "translation, rotation, scale or weights";
                return Err(GltfError::invalid(format!("{place}.path"), "another word", expected));
            }
        }
    }
    Ok(())
}

/// An extension may be the only one to know a texture's image (EXT_texture_webp, KHR_texture_basisu); the crate
/// refuses such a texture. It gets an image that is found missing when it is wanted.
fn complete_textures(root: &mut Root) {
    let missing = u32::try_from(root.images.len()).unwrap_or(u32::MAX);
    let mut is_wanted = false;
    for texture in root.textures.iter_mut().filter(|texture| texture.source.value() == u32::MAX as usize) {
        texture.source = Index::new(missing);
        is_wanted = true;
    }
    if is_wanted {
        let (extensions, extras) = Default::default();
        root.images.push(Image {
            buffer_view: None,
            mime_type: None,
            name: None,
            uri: None,
            extensions,
            extras,
        });
    }
}

/// The crate panics when it is asked for an image that has a view and no type, or neither view nor address.
/// Types are not trusted here, and an empty address is refused when the image is wanted.
fn complete_images(root: &mut Root) {
    for image in &mut root.images {
        match image.buffer_view {
            Some(_) if image.mime_type.is_none() => image.mime_type = Some(MimeType(String::new())),
            None if image.uri.is_none() => image.uri = Some(String::new()),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(json: &str) -> String {
        parse(json.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn broken_documents_name_the_place() {
        assert!(told("{").starts_with("JSON line 1 column 1: found EOF"));
        assert!(told(r#"{"asset":{"version":"2.0"},"scene":3}"#).starts_with("scene: found Index out of"));
        let mesh = r#"{"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]}"#;
        let error =
            "meshes[0].primitives[0].attributes.POSITION: found 0, expected below the accessor count 0";
        assert_eq!(told(mesh), error);
        let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
        assert!(told(&deep).starts_with("JSON line 1"), "no stack is used up");
    }

    #[test]
    fn empty_objects_take_no_memory() {
        let nodes = |text: &str, count: usize| {
            format!(r#"{{"asset":{{"version":"2.0"}},"nodes":[{}]}}"#, vec![text; count].join(","))
        };
        assert_eq!(
            told(&nodes("{}", 5000)),
            "JSON: found 5002 objects in 15037 bytes, expected at most 4096"
        );
        assert!(parse(nodes(r#"{"name":"strand 1"}"#, 5000).as_bytes()).is_ok());
    }

    #[test]
    fn extensions_that_change_no_geometry_may_be_required() {
        let with = |name: &str| {
            parse(format!(r#"{{"asset":{{"version":"2.0"}},"extensionsRequired":["{name}"]}}"#).as_bytes())
        };
        for known in ["KHR_mesh_quantization", "KHR_materials_clearcoat", "KHR_texture_basisu"] {
            assert!(with(known).is_ok(), "{known}");
        }
        for unknown in ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing"] {
            let error = with(unknown).unwrap_err();
            assert!(matches!(error, GltfError::Unsupported { .. }) && error.to_string().contains(unknown));
        }
    }

    #[test]
    fn bounds_are_not_asked_for() {
        let json = r#"{"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
            "accessors":[{"componentType":5126,"count":1,"type":"VEC3","bufferView":0}],
            "bufferViews":[{"buffer":0,"byteLength":12}],"buffers":[{"byteLength":12}]}"#;
        assert!(parse(json.as_bytes()).is_ok());
    }

    #[test]
    fn channels_that_move_nothing_are_told() {
        let with = |target: &str| {
            format!(
                r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"name":"a"}}],
                "accessors":[{{"componentType":5126,"count":1,"type":"SCALAR","bufferView":0}}],
                "bufferViews":[{{"buffer":0,"byteLength":4}}],"buffers":[{{"byteLength":4}}],
                "animations":[{{"samplers":[{{"input":0,"output":0}}],
                "channels":[{{"sampler":0,"target":{target}}}]}}]}}"#
            )
        };
        assert!(parse(with(r#"{"node":0,"path":"weights"}"#).as_bytes()).is_ok());
        let node = "animations[0].channels[0].target.node: found 7, expected below the node count 1";
        assert_eq!(told(&with(r#"{"node":7,"path":"scale"}"#)), node);
        assert!(
            told(&with(r#"{"node":0,"path":"colour"}"#)).starts_with("animations[0].channels[0].target.path")
        );
    }

    #[test]
    fn channels_of_extensions_are_left_out() {
        let json = r#"{"asset":{"version":"2.0"},"nodes":[{"name":"a"}],
            "accessors":[{"componentType":5126,"count":1,"type":"SCALAR","bufferView":0}],
            "bufferViews":[{"buffer":0,"byteLength":4}],"buffers":[{"byteLength":4}],
            "animations":[{"samplers":[{"input":0,"output":0}],"channels":[
            {"sampler":0,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":"/a"}}}},
            {"sampler":0,"target":{"node":0,"path":"weights"}}]}]}"#;
        let document = parse(json.as_bytes()).unwrap();
        assert_eq!(document.animations().map(|animation| animation.channels().count()).sum::<usize>(), 1);
        assert!(told(&json.replace("KHR_animation_pointer", "other")).contains("missing field `node`"));
    }

    #[test]
    fn images_can_be_asked_for() {
        let json = r#"{"asset":{"version":"2.0"},"images":[{},{"bufferView":0},{"uri":"a.png"}],
            "textures":[{"source":2},{"extensions":{"EXT_texture_webp":{"source":2}}}],
            "bufferViews":[{"buffer":0,"byteLength":4}],"buffers":[{"byteLength":4}]}"#;
        let document = parse(json.as_bytes()).unwrap();
        for image in document.images() {
            let _ = image.source();
        }
        let of_textures: Vec<usize> = document.textures().map(|texture| texture.source().index()).collect();
        assert_eq!((document.images().len(), of_textures), (4, vec![2, 3]));
    }
}
