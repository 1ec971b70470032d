//! Which mesh it is, whatever its pose.

use std::fmt;

/// A number for the triangles of a mesh: equal when the same vertices make the same triangles in the same order.
///
/// BLAKE3 over the vertex count and the vertex numbers, each little-endian; poses do not enter.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct TopologyHash([u8; 32]);

impl TopologyHash {
    /// The number of a mesh of `vertex_count` vertices and these triangles.
    #[must_use]
    pub fn of(vertex_count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&(vertex_count as u64).to_le_bytes());
        let mut bytes = Vec::with_capacity(BLOCK * 12);
        for block in triangles.chunks(BLOCK) {
            bytes.clear();
            bytes.extend(block.as_flattened().iter().flat_map(|vertex| vertex.to_le_bytes()));
            hasher.update(&bytes);
        }
        TopologyHash(*hasher.finalize().as_bytes())
    }
}

/// Triangles hashed in one go.
const BLOCK: usize = 4096;

impl fmt::Display for TopologyHash {
    /// The first 16 digits, enough for a report.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().take(8).try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for TopologyHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "TopologyHash({self})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_and_their_order_tell_meshes_apart() {
        let triangles: Vec<[u32; 3]> = (0..9000).map(|i| [i, i + 1, i + 2]).collect();
        let hash = TopologyHash::of(9002, &triangles);
        assert_eq!(hash, TopologyHash::of(9002, &triangles));
        assert_ne!(hash, TopologyHash::of(9003, &triangles));
        let mut turned = triangles.clone();
        turned[8999].rotate_left(1);
        assert_ne!(hash, TopologyHash::of(9002, &turned));
        assert_eq!(hash.to_string().len(), 16);
    }
}
