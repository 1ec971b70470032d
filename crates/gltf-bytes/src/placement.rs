//! Where the nodes of a scene stand.

use glam::{DMat4, DQuat, DVec3};
use gltf::scene::Transform;
use gltf::{Document, Node};

use crate::GltfError;

/// `world_from_node` of every node of the default scene (else of the first, else of all nodes), before any
/// animation; `None` for nodes outside it.
///
/// # Errors
/// [`GltfError::Invalid`] when a node is reached twice: nodes form trees (glTF 2.0, section 3.5.2).
pub fn placements(document: &Document) -> Result<Vec<Option<DMat4>>, GltfError> {
    let locals: Vec<Local> = document.nodes().map(|node| Local::of(&node)).collect();
    let mut worlds = vec![None; locals.len()];
    for (node, parent) in parents_first(document)? {
        let parent = parent.and_then(|parent| worlds[parent]).unwrap_or(DMat4::IDENTITY);
        worlds[node] = Some(parent * locals[node].matrix());
    }
    Ok(worlds)
}

/// Every node of the default scene (else of the first, else all nodes) with its parent, parents first; both
/// are indices of nodes.
///
/// # Errors
/// As [`placements`].
pub fn parents_first(document: &Document) -> Result<Vec<(usize, Option<usize>)>, GltfError> {
    let mut reached = vec![false; document.nodes().len()];
    let mut order = Vec::new();
    let mut visit: Vec<(Node<'_>, Option<usize>)> =
        roots(document).into_iter().map(|node| (node, None)).collect();
    while let Some((node, parent)) = visit.pop() {
        let index = node.index();
        let first = reached.get_mut(index).is_some_and(|reached| !std::mem::replace(reached, true));
        if !first {
            let place = format!("nodes[{index}]");
            return Err(GltfError::invalid(place, "a node reached twice", "a tree of nodes"));
        }
        order.push((index, parent));
        visit.extend(node.children().map(|child| (child, Some(index))));
    }
    Ok(order)
}

/// How a node stands on its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Local {
    /// As a matrix; such a node is not animated.
    Matrix(DMat4),
    /// In parts, scaled first and moved last.
    Parts {
        /// Where its origin stands.
        translation: DVec3,
        /// How it is turned, of length 1.
        rotation: DQuat,
        /// How it is scaled along its own axes.
        scale: DVec3,
    },
}

impl Local {
    /// That of `node`, before any animation.
    #[must_use]
    pub fn of(node: &Node<'_>) -> Local {
        match node.transform() {
            Transform::Matrix { matrix } => {
                Local::Matrix(DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from))))
            }
            Transform::Decomposed { translation, rotation, scale } => {
                let [translation, scale] = [translation, scale].map(|v| DVec3::from_array(v.map(f64::from)));
                let rotation = unit(DQuat::from_array(rotation.map(f64::from)));
                Local::Parts { translation, rotation, scale }
            }
        }
    }

    /// The same as a matrix.
    #[must_use]
    pub fn matrix(&self) -> DMat4 {
        match *self {
            Local::Matrix(matrix) => matrix,
            Local::Parts { translation, rotation, scale } => {
                DMat4::from_scale_rotation_translation(scale, rotation, translation)
            }
        }
    }
}

/// Not every writer's quaternions are of length 1; one of length 0 turns nothing.
fn unit(rotation: DQuat) -> DQuat {
    if rotation.length_squared() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY }
}

fn roots(document: &Document) -> Vec<Node<'_>> {
    if let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) {
        return scene.nodes().collect();
    }
    let mut is_child = vec![false; document.nodes().len()];
    for child in document.nodes().flat_map(|node| node.children()) {
        if let Some(is_child) = is_child.get_mut(child.index()) {
            *is_child = true;
        }
    }
    document.nodes().filter(|node| !is_child.get(node.index()).copied().unwrap_or_default()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worlds(nodes: &str) -> Result<Vec<Option<DMat4>>, GltfError> {
        let json = format!(r#"{{"asset":{{"version":"2.0"}},{nodes}}}"#);
        placements(&crate::document::parse(json.as_bytes()).unwrap())
    }

    #[test]
    fn children_stand_on_their_parents() {
        let worlds = worlds(
            r#""scenes":[{"nodes":[1]}],"nodes":[{"translation":[1,0,0]},
            {"children":[0],"rotation":[0,0,0.70710678,0.70710678],"scale":[2,2,2],"translation":[0,0,5]},{}]"#,
        )
        .unwrap();
        let at = worlds[0].unwrap().transform_point3(DVec3::X);
        assert!((at - DVec3::new(0.0, 4.0, 5.0)).length() < 1e-6, "{at}");
        assert!(worlds[2].is_none(), "outside the scene");
    }

    #[test]
    fn without_a_scene_every_tree_stands() {
        let worlds = worlds(
            r#""nodes":[{"children":[1]},{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,7,8,9,1],"children":[2]},{}]"#,
        )
        .unwrap();
        assert_eq!(worlds[2].unwrap().w_axis.truncate(), DVec3::new(7.0, 8.0, 9.0));
    }

    #[test]
    fn what_is_no_tree_is_told() {
        let error = worlds(r#""scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}]"#);
        assert_eq!(
            error.unwrap_err().to_string(),
            "nodes[0]: found a node reached twice, expected a tree of nodes"
        );
    }
}
