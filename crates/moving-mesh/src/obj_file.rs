//! Wavefront OBJ through `tobj`.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use glam::Vec3;
use tobj::{LoadError, LoadOptions};

use crate::TriangleMesh;
use crate::error::Fault;

/// Reads all faces of an OBJ file, triangulated; materials are not looked at.
pub(crate) fn read(path: &Path) -> Result<TriangleMesh, Fault> {
    let file = File::open(path).map_err(|source| Fault::Io { path: path.to_owned(), source })?;
    from_reader(&mut BufReader::new(file))
}

fn from_reader(reader: &mut impl std::io::BufRead) -> Result<TriangleMesh, Fault> {
    // Lines and points are no surface; tobj would hand them out as thin triangles.
    let options =
        LoadOptions { triangulate: true, single_index: true, ignore_lines: true, ignore_points: true };
    let (models, _) = tobj::load_obj_buf(reader, &options, |_| Err(LoadError::OpenFileFailed))
        .map_err(|e| Fault::invalid("OBJ text", e.to_string()))?;
    let mut mesh = TriangleMesh::default();
    for model in models {
        mesh.append(part(&model.name, &model.mesh)?)?;
    }
    Ok(mesh)
}

fn part(name: &str, mesh: &tobj::Mesh) -> Result<TriangleMesh, Fault> {
    let (positions, []) = mesh.positions.as_chunks::<3>() else {
        return Err(Fault::invalid(format!("object `{name}`"), "positions are not triples"));
    };
    let (triangles, []) = mesh.indices.as_chunks::<3>() else {
        return Err(Fault::invalid(format!("object `{name}`"), "faces do not split into triangles"));
    };
    let (normals, _) = mesh.normals.as_chunks::<3>();
    let normals = (normals.len() == positions.len() && !normals.is_empty())
        .then(|| normals.iter().map(|&n| Vec3::from(n).normalize_or_zero()).collect());
    Ok(TriangleMesh {
        positions: positions.iter().map(|&p| p.into()).collect(),
        triangles: triangles.to_vec(),
        normals,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn parse(text: &str) -> Result<TriangleMesh, Fault> {
        from_reader(&mut text.as_bytes())
    }

    #[test]
    fn a_quad_becomes_two_triangles() {
        let mesh = parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 2\nf 1//1 2//1 3//1 4//1\n").unwrap();
        assert_eq!(mesh.triangles.len(), 2);
        assert_eq!(mesh.normals.unwrap(), [Vec3::Z; 4]);
    }

    #[test]
    fn several_objects_become_one_and_lines_are_left_out() {
        let mesh = parse(
            "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nl 1 2\no b\nv 0 0 1\nv 1 0 1\nv 1 1 1\nf 4 5 6\n",
        )
        .unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(mesh.positions[3], Vec3::Z);
    }

    proptest! {
        #[test]
        fn text_of_any_kind_is_read_or_refused(lines in prop::collection::vec("(v|f|vn|l|o|g|p)( -?[0-9]{1,2}(/[0-9]?){0,2}){0,5}", 0..12)) {
            let _ = parse(&lines.join("\n"));
        }
    }
}
