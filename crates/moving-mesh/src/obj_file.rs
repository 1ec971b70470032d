//! Wavefront OBJ through `tobj`.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use glam::{DVec3, Vec2, Vec3};
use tobj::{LoadError, LoadOptions, Material};

use crate::error::Fault;
use crate::loaded::{Loaded, Motion, Source};
use crate::shape::{Look, Shape};
use crate::{MeshOptions, Pose};

/// Reads all faces of an OBJ file, triangulated.
pub(crate) fn read(path: &Path, _: &MeshOptions) -> Result<Loaded, Fault> {
    let file = File::open(path).map_err(|source| Fault::Io { path: path.to_owned(), source })?;
    let (shape, pose) = from_reader(&mut BufReader::new(file))?;
    Ok(Loaded { shape, motion: Motion::default(), source: Source::Still(pose) })
}

fn from_reader(reader: &mut impl BufRead) -> Result<(Shape, Pose), Fault> {
    // Lines and points are no surface; tobj would hand them out as thin triangles.
    let options =
        LoadOptions { triangulate: true, single_index: true, ignore_lines: true, ignore_points: true };
    let (models, _) = tobj::load_obj_buf(reader, &options, |_| Err(LoadError::OpenFileFailed))
        .map_err(|e| Fault::invalid("OBJ text", e.to_string()))?;
    let mut shape = Shape::default();
    let mut pose = Pose { positions: Vec::new(), normals: Some(Vec::new()) };
    for model in models {
        append(&mut shape, &mut pose, &model.name, &model.mesh, &[])?;
    }
    Ok((shape, pose))
}

fn append(
    shape: &mut Shape,
    pose: &mut Pose,
    name: &str,
    mesh: &tobj::Mesh,
    _materials: &[Material],
) -> Result<(), Fault> {
    let (positions, []) = mesh.positions.as_chunks::<3>() else {
        return Err(Fault::invalid(format!("object `{name}`"), "positions are not triples"));
    };
    let (triangles, []) = mesh.indices.as_chunks::<3>() else {
        return Err(Fault::invalid(format!("object `{name}`"), "faces do not split into triangles"));
    };
    let (normals, _) = mesh.normals.as_chunks::<3>();
    let normals = (normals.len() == positions.len() && !normals.is_empty())
        .then(|| normals.iter().map(|&n| Vec3::from(n).normalize_or_zero()));
    let uvs: Vec<Vec2> = mesh.texcoords.as_chunks::<2>().0.iter().map(|&uv| uv.into()).collect();
    let uvs = (uvs.len() == positions.len() && !uvs.is_empty()).then_some(uvs);
    shape.append(name.to_owned(), positions.len(), triangles, uvs.as_deref(), Look::default())?;
    pose.positions.extend(positions.iter().map(|&p| DVec3::from_array(p.map(f64::from))));
    pose.normals = pose.normals.take().zip(normals).map(|(mut all, more)| {
        all.extend(more);
        all
    });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn parse(text: &str) -> Result<(Shape, Pose), Fault> {
        from_reader(&mut text.as_bytes())
    }

    #[test]
    fn a_quad_becomes_two_triangles() {
        let (shape, pose) =
            parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 2\nf 1//1 2//1 3//1 4//1\n").unwrap();
        assert_eq!(shape.triangles.len(), 2);
        assert_eq!(pose.normals.unwrap(), [Vec3::Z; 4]);
    }

    #[test]
    fn several_objects_become_one_and_lines_are_left_out() {
        let (shape, pose) = parse(
            "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nl 1 2\no b\nv 0 0 1\nv 1 0 1\nv 1 1 1\nf 4 5 6\n",
        )
        .unwrap();
        assert_eq!(shape.triangles, [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(pose.positions[3], DVec3::Z);
        assert_eq!(pose.normals, None, "one of them has none");
    }

    proptest! {
        #[test]
        fn text_of_any_kind_is_read_or_refused(lines in prop::collection::vec("(v|f|vn|l|o|g|p)( -?[0-9]{1,2}(/[0-9]?){0,2}){0,5}", 0..12)) {
            let _ = parse(&lines.join("\n"));
        }
    }
}
