//! From segments to strands.

use gltf::mesh::Mode;
use gltf_bytes::GltfError;

/// No vertex.
const NONE: u32 = u32::MAX;

/// Strands as lists of vertices, one after the other.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Chains {
    /// Vertices of each strand, 2 or more.
    pub(super) lengths: Vec<u32>,
    pub(super) vertices: Vec<u32>,
}

impl Chains {
    fn push(&mut self, chain: impl Iterator<Item = u32>) {
        let before = self.vertices.len();
        self.vertices.extend(chain);
        match self.vertices.len() - before {
            0 | 1 => self.vertices.truncate(before),
            length => self.lengths.push(length as u32),
        }
    }
}

/// The strands of a primitive of `count` vertices. `same` says whether two vertices are at one place, which
/// is asked only where there are no indices.
///
/// # Errors
/// [`GltfError::Invalid`] at `place`: an index that is no vertex, an odd number of ends, a vertex with three
/// segments.
pub(super) fn chains(
    mode: Mode,
    indices: Option<Vec<u32>>,
    count: usize,
    same: impl Fn(u32, u32) -> bool,
    place: &str,
) -> Result<Chains, GltfError> {
    let count = u32::try_from(count)
        .map_err(|_| invalid(place, format!("{count} vertices"), "at most 4294967295".to_owned()))?;
    if let Some(index) = indices.iter().flatten().find(|&&index| index >= count) {
        return Err(invalid(place, format!("index {index}"), format!("below the vertex count {count}")));
    }
    let mut chains = Chains::default();
    match (mode, indices) {
        (Mode::Lines, Some(indices)) => {
            let (pairs, rest) = indices.as_chunks::<2>();
            if !rest.is_empty() {
                return Err(odd(place, indices.len()));
            }
            chains = in_order(pairs);
            let (Some(&low), Some(&high)) = (indices.iter().min(), indices.iter().max()) else {
                return Ok(chains);
            };
            if !are_distinct(&chains.vertices, low, high) {
                chains = walked(pairs, low, high, place)?;
            }
        }
        (Mode::Lines, None) => {
            if !count.is_multiple_of(2) {
                return Err(odd(place, count as usize));
            }
            let mut start = 0;
            for end in (2..=count).step_by(2) {
                if end == count || !same(end - 1, end) {
                    let starts = (start..end).step_by(2);
                    chains.push(starts.chain([end - 1]));
                    start = end;
                }
            }
        }
        (mode, indices) => {
            let indices = indices.unwrap_or_else(|| (0..count).collect());
            let again = indices.first().copied().filter(|_| mode == Mode::LineLoop && indices.len() > 2);
            chains.push(indices.into_iter().chain(again));
        }
    }
    Ok(chains)
}

/// A strand goes on while a segment starts where the one before it ended.
fn in_order(pairs: &[[u32; 2]]) -> Chains {
    let mut chains = Chains { lengths: Vec::new(), vertices: Vec::with_capacity(pairs.len() + 1) };
    let (mut end, mut length) = (NONE, 0);
    for &[from, to] in pairs {
        if from != end {
            if length > 0 {
                chains.lengths.push(length);
            }
            chains.vertices.push(from);
            length = 1;
        }
        chains.vertices.push(to);
        length += 1;
        end = to;
    }
    if length > 0 {
        chains.lengths.push(length);
    }
    chains
}

/// Whether no vertex is twice among `vertices`, all of which lie from `low` to `high`.
fn are_distinct(vertices: &[u32], low: u32, high: u32) -> bool {
    let span = (high - low) as usize + 1;
    if vertices.len() > span {
        return false;
    }
    let mut seen = vec![false; span];
    vertices.iter().all(|&v| match seen.get_mut((v - low) as usize) {
        Some(seen) => !std::mem::replace(seen, true),
        None => false,
    })
}

/// Strands of segments in any order: from the ends of chains, then around rings.
fn walked(pairs: &[[u32; 2]], low: u32, high: u32, place: &str) -> Result<Chains, GltfError> {
    let mut neighbours = vec![[NONE; 2]; (high - low) as usize + 1];
    for &[a, b] in pairs.iter().filter(|[a, b]| a != b) {
        for (vertex, other) in [(a, b), (b, a)] {
            let Some(slots) = neighbours.get_mut((vertex - low) as usize) else { continue };
            // The same segment twice is one.
            if slots.contains(&other) {
                continue;
            }
            match slots.iter_mut().find(|slot| **slot == NONE) {
                Some(slot) => *slot = other,
                None => {
                    let found = format!("three segments at vertex {vertex}");
                    return Err(invalid(place, found, "at most two: strands do not branch".to_owned()));
                }
            }
        }
    }
    let mut chains = Chains::default();
    for is_end in [|slots: [u32; 2]| slots[1] == NONE, |_| true] {
        for start in low..=high {
            let slots = neighbours.get((start - low) as usize).copied().unwrap_or([NONE; 2]);
            if slots[0] != NONE && is_end(slots) {
                chains.push(Walk { neighbours: &mut neighbours, low, at: start });
            }
        }
    }
    Ok(chains)
}

/// Goes from vertex to vertex and takes the segments away behind it.
struct Walk<'a> {
    neighbours: &'a mut [[u32; 2]],
    low: u32,
    at: u32,
}

impl Iterator for Walk<'_> {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        if self.at == NONE {
            return None;
        }
        let from = self.at;
        let slots = self.neighbours.get_mut((from - self.low) as usize)?;
        self.at = slots[0];
        *slots = [slots[1], NONE];
        if let Some(slots) = self.neighbours.get_mut(self.at.wrapping_sub(self.low) as usize)
            && self.at != NONE
        {
            *slots = match *slots {
                [a, b] if a == from => [b, NONE],
                [a, _] => [a, NONE],
            };
        }
        Some(from)
    }
}

fn odd(place: &str, found: usize) -> GltfError {
    invalid(place, format!("{found} ends of segments"), "an even number".to_owned())
}

fn invalid(place: &str, found: String, expected: String) -> GltfError {
    GltfError::Invalid { place: place.to_owned(), found, expected }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(indices: &[u32]) -> Vec<Vec<u32>> {
        split(chains(Mode::Lines, Some(indices.to_vec()), 100, |_, _| false, "").unwrap())
    }

    fn split(chains: Chains) -> Vec<Vec<u32>> {
        let mut rest = &chains.vertices[..];
        let strands = chains.lengths.iter().map(|&length| {
            let (strand, after) = rest.split_at(length as usize);
            rest = after;
            strand.to_vec()
        });
        let strands = strands.collect();
        assert!(rest.is_empty());
        strands
    }

    #[test]
    fn segments_in_order_keep_their_direction() {
        assert_eq!(lines(&[0, 1, 1, 2, 3, 4]), [vec![0, 1, 2], vec![3, 4]]);
        assert_eq!(lines(&[9, 8, 8, 7]), [[9, 8, 7]]);
        assert!(lines(&[]).is_empty());
    }

    #[test]
    fn segments_in_any_order_are_walked_from_the_lower_end() {
        assert_eq!(lines(&[2, 3, 0, 1, 1, 2, 7, 6]), [vec![0, 1, 2, 3], vec![6, 7]]);
        assert_eq!(lines(&[1, 0, 1, 2, 0, 1, 5, 5]), [[0, 1, 2]], "twice and without length");
        assert_eq!(lines(&[5, 3, 3, 4, 4, 5]), [[3, 5, 4, 3]], "a ring");
        assert_eq!(lines(&[5, 3, 3, 4, 4, 5, 0, 1]), [vec![0, 1], vec![3, 5, 4, 3]]);
    }

    #[test]
    fn without_indices_segments_join_where_they_meet() {
        let same = |a: u32, b: u32| (a, b) == (1, 2);
        let chains = chains(Mode::Lines, None, 6, same, "").unwrap();
        assert_eq!(split(chains), [vec![0, 2, 3], vec![4, 5]]);
    }

    #[test]
    fn strips_and_loops() {
        let of = |mode, indices: Option<&[u32]>| {
            split(chains(mode, indices.map(<[u32]>::to_vec), 4, |_, _| false, "").unwrap())
        };
        assert_eq!(of(Mode::LineStrip, None), [[0, 1, 2, 3]]);
        assert_eq!(of(Mode::LineStrip, Some(&[3, 1])), [[3, 1]]);
        assert_eq!(of(Mode::LineLoop, Some(&[3, 1, 2])), [[3, 1, 2, 3]]);
        assert!(of(Mode::LineStrip, Some(&[3])).is_empty());
    }

    #[test]
    fn what_is_no_strand_is_told() {
        let told = |mode, indices: &[u32]| {
            chains(mode, Some(indices.to_vec()), 9, |_, _| false, "here").unwrap_err().to_string()
        };
        let fork = "here: found three segments at vertex 1, expected at most two: strands do not branch";
        assert_eq!(told(Mode::Lines, &[0, 1, 1, 2, 1, 3]), fork);
        assert_eq!(told(Mode::LineStrip, &[0, 9]), "here: found index 9, expected below the vertex count 9");
        assert!(told(Mode::Lines, &[0, 1, 2]).contains("3 ends of segments"));
        assert!(told(Mode::LineStrip, &[u32::MAX]).contains("index 4294967295"), "restarts are not allowed");
    }
}
