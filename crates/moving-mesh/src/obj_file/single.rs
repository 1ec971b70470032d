//! One OBJ file, which stands still.

use std::path::Path;

use glam::{DVec3, Vec2, Vec3};
use tobj::{Material, Model};

use super::{load, materials, triangles, triples};
use crate::Pose;
use crate::error::Fault;
use crate::loaded::{Loaded, Motion, Source};
use crate::shape::Shape;

/// Reads all faces, triangulated. Every combination of position, texture coordinate and normal is a vertex.
pub(super) fn read(path: &Path) -> Result<Loaded, Fault> {
    let (models, materials) = load(path, true)?;
    let (shape, pose) = assemble(&models, &materials, path)?;
    Ok(Loaded { shape, motion: Motion::default(), source: Source::Still(pose) })
}

fn assemble(models: &[Model], materials: &[Material], path: &Path) -> Result<(Shape, Pose), Fault> {
    let mut shape = Shape::default();
    let mut pose = Pose { positions: Vec::new(), normals: Some(Vec::new()) };
    for model in models {
        let mesh = &model.mesh;
        let positions = triples(model, "positions", &mesh.positions)?;
        let (normals, _) = mesh.normals.as_chunks::<3>();
        let normals = (normals.len() == positions.len() && !normals.is_empty())
            .then(|| normals.iter().map(|&n| Vec3::from(n).normalize_or_zero()));
        let uvs: Vec<Vec2> = mesh.texcoords.as_chunks::<2>().0.iter().map(|&uv| uv.into()).collect();
        let uvs = (uvs.len() == positions.len() && !uvs.is_empty()).then_some(uvs);
        let look = materials::look(model, materials, path);
        shape.append(model.name.clone(), positions.len(), triangles(model)?, uvs.as_deref(), look)?;
        pose.positions.extend(positions.iter().map(|&p| DVec3::from_array(p.map(f64::from))));
        pose.normals = pose.normals.take().zip(normals).map(|(mut all, more)| {
            all.extend(more);
            all
        });
    }
    Ok((shape, pose))
}

#[cfg(test)]
mod tests {
    use super::super::parse as parse_text;
    use super::*;
    use proptest::prelude::*;

    fn parse(text: &str) -> Result<(Shape, Pose), Fault> {
        let (models, materials) = parse_text(&mut text.as_bytes(), None, true)?;
        assemble(&models, &materials, Path::new("a.obj"))
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
    }

    #[test]
    fn normals_survive_only_where_all_have_them() {
        let with = "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
        let without = "o b\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\n";
        for (text, count) in [
            (with.to_owned(), Some(3)),
            (format!("{with}{without}"), None),
            (format!("{without}{}", with.replace("f 1//1 2//1 3//1", "f 4//1 5//1 6//1")), None),
            (without.to_owned(), None),
        ] {
            assert_eq!(parse(&text).unwrap().1.normals.map(|normals| normals.len()), count, "{text}");
        }
    }

    proptest! {
        #[test]
        fn text_of_any_kind_is_read_or_refused(lines in prop::collection::vec("(v|f|vn|l|o|g|p)( -?[0-9]{1,2}(/[0-9]?){0,2}){0,5}", 0..12)) {
            let _ = parse(&lines.join("\n"));
        }
    }
}
