//! Surface and clips as a binary glTF file.

use glam::{Quat, Vec3};

use super::motion::Clip;
use super::surface::{HEAD, NECK, Surface};

/// glTF's names for the types of numbers.
const BYTE: u32 = 5121;
const SHORT: u32 = 5123;
const FLOAT: u32 = 5126;

/// What a view of the buffer is for: vertices, indices.
const VERTICES: &str = r#","target":34962"#;
const INDICES: &str = r#","target":34963"#;

/// The buffer so far, and what the document says of it.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
}

impl Buffer {
    /// Adds an array; returns the accessor's index.
    fn add(
        &mut self,
        bytes: &[u8],
        number: u32,
        shape: &str,
        count: usize,
        target: &str,
        more: &str,
    ) -> usize {
        let (view, start) = (self.views.len(), self.bytes.len());
        self.views
            .push(format!(r#"{{"buffer":0,"byteOffset":{start},"byteLength":{}{target}}}"#, bytes.len()));
        self.accessors.push(format!(
            r#"{{"bufferView":{view},"componentType":{number},"count":{count},"type":"{shape}"{more}}}"#
        ));
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        view
    }

    fn floats<const N: usize>(&mut self, values: &[[f32; N]], target: &str, more: &str) -> usize {
        let shape = ["SCALAR", "VEC2", "VEC3", "VEC4"].get(N.wrapping_sub(1)).unwrap_or(&"MAT4");
        let bytes: Vec<u8> = values.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
        self.add(&bytes, FLOAT, shape, values.len(), target, more)
    }

    /// Positions, of which glTF wants to know the bounds.
    fn places(&mut self, values: &[Vec3]) -> usize {
        let (least, most) = values
            .iter()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(least, most), v| (least.min(*v), most.max(*v)));
        let more = format!(r#","min":{:?},"max":{:?}"#, least.to_array(), most.to_array());
        self.floats(&arrays(values), VERTICES, &more)
    }

    fn triangles(&mut self, triangles: &[[u16; 3]]) -> usize {
        let bytes: Vec<u8> = triangles.iter().flatten().flat_map(|index| index.to_le_bytes()).collect();
        self.add(&bytes, SHORT, "SCALAR", 3 * triangles.len(), INDICES, "")
    }

    /// Two numbers a vertex and two zeros, as joints and weights come in fours.
    fn pairs(&mut self, values: impl ExactSizeIterator<Item = [u8; 2]>, more: &str) -> usize {
        let count = values.len();
        let bytes: Vec<u8> = values.flat_map(|[a, b]| [a, b, 0, 0]).collect();
        self.add(&bytes, BYTE, "VEC4", count, VERTICES, more)
    }
}

fn arrays(values: &[Vec3]) -> Vec<[f32; 3]> {
    values.iter().map(|v| v.to_array()).collect()
}

pub(super) fn glb(surface: &Surface, clips: &[Clip]) -> Vec<u8> {
    let mut buffer = Buffer::default();
    let meshes = meshes(surface, &mut buffer);
    let bind = |joint: Vec3| {
        let [x, y, z] = (-joint).to_array();
        [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, x, y, z, 1.0]
    };
    let bind = buffer.floats(&[bind(NECK), bind(HEAD)], "", "");
    let animations: Vec<String> = clips.iter().map(|clip| animation(clip, &mut buffer)).collect();
    let json = format!(
        r#"{{"asset":{{"version":"2.0","generator":"groom-samples"}},"scene":0,"scenes":[{{"nodes":[0,1]}}],"nodes":[{{"name":"character","mesh":0,"skin":0}},{{"name":"neck","translation":{:?},"children":[2]}},{{"name":"head","translation":{:?}}}],"skins":[{{"joints":[1,2],"inverseBindMatrices":{bind}}}],"meshes":[{meshes}],"materials":[{},{}],"animations":[{}],"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}}"#,
        NECK.to_array(),
        (HEAD - NECK).to_array(),
        material("scalp", [0.30, 0.17, 0.10]),
        material("skin", [0.78, 0.50, 0.38]),
        animations.join(","),
        buffer.accessors.join(","),
        buffer.views.join(","),
        buffer.bytes.len(),
    );
    container(json.into_bytes(), &buffer.bytes)
}

fn meshes(surface: &Surface, buffer: &mut Buffer) -> String {
    let positions = buffer.places(&surface.positions);
    let normals = buffer.floats(&arrays(&surface.normals), VERTICES, "");
    let uvs: Vec<[f32; 2]> = surface.uvs.iter().map(|uv| uv.to_array()).collect();
    let uvs = buffer.floats(&uvs, VERTICES, "");
    let joints = buffer.pairs(surface.weights.iter().map(|weights| [0, u8::from(weights[1] > 0)]), "");
    let weights = buffer.pairs(surface.weights.iter().copied(), r#","normalized":true"#);
    let surprise = buffer.places(&surface.surprise);
    let primitive = |triangles: usize, material: usize| {
        format!(
            r#"{{"attributes":{{"POSITION":{positions},"NORMAL":{normals},"TEXCOORD_0":{uvs},"JOINTS_0":{joints},"WEIGHTS_0":{weights}}},"targets":[{{"POSITION":{surprise}}}],"indices":{triangles},"material":{material}}}"#
        )
    };
    let (scalp, skin) = (buffer.triangles(&surface.scalp), buffer.triangles(&surface.skin));
    format!(
        r#"{{"name":"head","primitives":[{},{}],"weights":[0],"extras":{{"targetNames":["surprise"]}}}}"#,
        primitive(scalp, 0),
        primitive(skin, 1)
    )
}

fn material(name: &str, [r, g, b]: [f32; 3]) -> String {
    format!(
        r#"{{"name":"{name}","pbrMetallicRoughness":{{"baseColorFactor":[{r},{g},{b},1],"metallicFactor":0,"roughnessFactor":0.6}}}}"#
    )
}

fn animation(clip: &Clip, buffer: &mut Buffer) -> String {
    let last = clip.times.last().copied().unwrap_or(0.0);
    let times: Vec<[f32; 1]> = clip.times.iter().map(|&time| [time]).collect();
    let times = buffer.floats(&times, "", &format!(r#","min":[0],"max":[{last}]"#));
    let quaternions = |turns: &[Quat]| turns.iter().map(|turn| turn.to_array()).collect::<Vec<_>>();
    let mut outputs: Vec<(usize, usize, &str)> = Vec::new();
    for (node, turns) in [1, 2].into_iter().zip(&clip.turns) {
        outputs.push((node, buffer.floats(&quaternions(turns), "", ""), "rotation"));
    }
    if let Some(surprise) = &clip.surprise {
        let weights: Vec<[f32; 1]> = surprise.iter().map(|&weight| [weight]).collect();
        outputs.push((0, buffer.floats(&weights, "", ""), "weights"));
    }
    let channel = |(i, (node, _, path)): (usize, &(usize, usize, &str))| {
        format!(r#"{{"sampler":{i},"target":{{"node":{node},"path":"{path}"}}}}"#)
    };
    let sampler = |(_, output, _): &(usize, usize, &str)| format!(r#"{{"input":{times},"output":{output}}}"#);
    let channels: Vec<String> = outputs.iter().enumerate().map(channel).collect();
    let samplers: Vec<String> = outputs.iter().map(sampler).collect();
    format!(
        r#"{{"name":"{}","channels":[{}],"samplers":[{}]}}"#,
        clip.name,
        channels.join(","),
        samplers.join(",")
    )
}

/// Header, document, buffer.
fn container(mut json: Vec<u8>, buffer: &[u8]) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut glb = b"glTF".to_vec();
    for word in [2, 28 + json.len() + buffer.len(), json.len()] {
        glb.extend((word as u32).to_le_bytes());
    }
    glb.extend(b"JSON");
    glb.extend(json);
    glb.extend((buffer.len() as u32).to_le_bytes());
    glb.extend(b"BIN\0");
    glb.extend_from_slice(buffer);
    glb
}
