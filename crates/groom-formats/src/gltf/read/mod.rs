//! glTF LINES, LINE_STRIP and LINE_LOOP as a groom.
//!
//! Every primitive of lines in the default scene is read where its node stands; skins and morph targets are not
//! applied, with a warning. Y is up and the unit is the metre unless the options say otherwise.
//!
//! - Segments of LINES that follow one another in the file make a strand, root first. Segments in any other
//!   order are walked from the ends of their chains; the root is then the end with the lower index. A vertex
//!   with three segments is an error: strands do not branch. Without indices, a segment goes on where the one
//!   before it ended if the positions are the same.
//! - A LINE_LOOP, or a ring of LINES, ends with its first point again.
//! - Triangles and points are skipped with a warning; a file without lines is refused.
//! - COLOR_0 becomes `color` and, where any alpha is below 1, `transparency`; `_WIDTH` (a diameter) or `_RADIUS`
//!   becomes `radius`, scaled with the node; `_STRAND` is `id`; TEXCOORD_0, if it stays the same along
//!   every strand and there is no `_ROOT_UV`, is `root_uv` with v turned up. Other custom attributes keep their name
//!   in lower case, TEXCOORD_n and COLOR_n likewise.
//! - `id`, `root_uv`, `group` and `guide` come back per strand if they stay the same along every strand; so do
//!   attributes that groomkit has marked as such in the mesh's `extras`. All others are per vertex.
//! - Several primitives become one groom. Unless each is a single strand, `group` says which one a strand
//!   came from; attributes that only some of them have are 0 (colour: white) elsewhere, with a warning.

mod chains;
mod columns;
mod marks;
mod meaning;
mod part;

use std::path::Path;

use glam::DMat4;
use gltf::mesh::Mode;
use gltf_bytes::{Asset, GltfError};
use groom::{UpAxis, Values, names};

use crate::assemble::{Parts, per_strand};
use crate::{Format, FormatError, Loaded, ReadOptions, Warning};
use columns::Columns;

/// Bytes a groom may take whatever the file's size.
const ALWAYS_ALLOWED: usize = 1 << 16;

/// Indices and replaced values that are looked at, in bytes of the file: primitives may share them without end.
const LOOKS: usize = 64;

/// `folder` is where the document's other files are; a stream has none.
pub(crate) fn read(
    bytes: &[u8],
    folder: Option<&Path>,
    name: &str,
    options: &ReadOptions,
) -> Result<Loaded, FormatError> {
    let format = if bytes.starts_with(b"glTF") { Format::Glb } else { Format::Gltf };
    let asset = Asset::open(bytes, folder).map_err(|e| fault(name, e))?;
    let mut found = Found::new(bytes.len().saturating_add(asset.buffers.total()));
    found.gather(&asset).map_err(|e| fault(name, e))?;
    let skipped = found.triangles + found.points;
    if found.strands() == 0 {
        let what = format!("{skipped} primitives of triangles or points, and no line");
        return Err(FormatError::invalid(
            name,
            "meshes",
            what,
            "LINES, LINE_STRIP or LINE_LOOP in the scene",
        ));
    }
    let mut warnings = Vec::new();
    if skipped > 0 {
        warnings.push(Warning::PrimitivesSkipped { format, primitives: skipped });
    }
    for (by, moves) in [("joints", found.by_joints), ("morph targets", found.by_targets)] {
        if moves {
            warnings.push(Warning::StillAsModelled { by, remedy: "" });
        }
    }
    let marks = marks::of(&asset.document);
    let attributes = meaning::attributes(&mut found, &marks, format, &mut warnings);
    let mut parts = Parts {
        file: name,
        format,
        up_axis: UpAxis::Y,
        offsets: found.offsets,
        positions: found.positions,
        attributes,
        warnings,
    };
    let is_grouped = parts.attributes.iter().any(|(name, _)| name == names::GROUP);
    let strands = found.primitives.len();
    let groups = found.primitives.last().map_or(0, |&last| last as usize + 1);
    if !is_grouped && groups > 1 && groups < strands {
        let group = per_strand(Values::Int(found.primitives));
        parts.attributes.push((names::GROUP.to_owned(), group));
    }
    parts.load(options, |point| format!("point {point} of the strands"))
}

fn fault(file: &str, error: GltfError) -> FormatError {
    match error {
        GltfError::Invalid { place, found, expected } => FormatError::invalid(file, place, found, expected),
        GltfError::Unsupported { what, remedy } => {
            FormatError::invalid(file, "the document", what, format!("what can be read; {remedy}"))
        }
        GltfError::Io { path, source } => FormatError::io(&path.display().to_string(), source),
        other => FormatError::invalid(file, "the document", other.to_string(), "glTF 2.0"),
    }
}

/// The strands of all primitives so far.
struct Found {
    offsets: Vec<u32>,
    positions: Vec<glam::Vec3>,
    columns: Columns,
    /// Which primitive of lines each strand is from.
    primitives: Vec<i32>,
    triangles: usize,
    points: usize,
    /// Whether a skin or morph targets move any of the strands.
    by_joints: bool,
    by_targets: bool,
    /// Bytes the groom may still take.
    budget: usize,
    /// Shared values that may still be looked at.
    looks: usize,
}

impl Found {
    fn new(file_bytes: usize) -> Self {
        Found {
            offsets: vec![0],
            positions: Vec::new(),
            columns: Columns::default(),
            primitives: Vec::new(),
            triangles: 0,
            points: 0,
            by_joints: false,
            by_targets: false,
            budget: file_bytes.saturating_mul(4).saturating_add(ALWAYS_ALLOWED),
            looks: file_bytes.saturating_mul(LOOKS).saturating_add(ALWAYS_ALLOWED),
        }
    }

    fn strands(&self) -> usize {
        self.offsets.len() - 1
    }

    fn gather(&mut self, asset: &Asset<'_>) -> Result<(), GltfError> {
        let worlds = gltf_bytes::placements(&asset.document)?;
        let mut lines = 0;
        for (node, world) in asset.document.nodes().zip(worlds) {
            let (Some(world), Some(mesh)) = (world, node.mesh()) else { continue };
            // Most grooms stand at the origin; their numbers then stay as they are.
            let world = (world != DMat4::IDENTITY).then_some(world);
            for primitive in mesh.primitives() {
                match primitive.mode() {
                    Mode::Lines | Mode::LineStrip | Mode::LineLoop => {
                        part::add(self, asset, mesh.index(), &primitive, world, lines)?;
                        lines += i32::from(self.primitives.last() == Some(&lines));
                        self.by_joints |= node.skin().is_some();
                        self.by_targets |= primitive.morph_targets().next().is_some();
                    }
                    Mode::Points => self.points += 1,
                    Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan => self.triangles += 1,
                }
            }
        }
        Ok(())
    }

    /// Takes memory for `points` more points of `bytes` each, before it is reserved.
    fn spend(&mut self, points: usize, bytes: usize, place: &str) -> Result<(), GltfError> {
        let wanted = points.saturating_mul(bytes);
        self.budget = self.budget.checked_sub(wanted).ok_or_else(|| GltfError::Invalid {
            place: place.to_owned(),
            found: format!("{points} more points of strands, which the file's other meshes have too"),
            expected: "strands of at most 4 times the file's bytes; write instances out one by one"
                .to_owned(),
        })?;
        Ok(())
    }

    /// Takes time for looking at `values` that other primitives may look at too.
    fn look(&mut self, values: usize, place: &str) -> Result<(), GltfError> {
        self.looks = self.looks.checked_sub(values).ok_or_else(|| GltfError::Invalid {
            place: place.to_owned(),
            found: format!("{values} more values that other primitives share"),
            expected: format!("at most {LOOKS} a byte of the file"),
        })?;
        Ok(())
    }
}
