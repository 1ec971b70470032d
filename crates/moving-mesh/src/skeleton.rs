//! The joints that carry a skinned mesh.

use std::collections::{BTreeSet, HashMap};

use glam::DMat4;

/// The joints of all skins, and which of them carry a vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skeleton {
    /// One a joint of every skin (a joint of two skins is here twice), parents before children.
    pub joints: Vec<Joint>,
    /// Where the influences of each vertex begin, and the end of the last.
    starts: Vec<usize>,
    influences: Vec<(u32, f32)>,
}

/// A joint of one skin.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its name, different from that of every other joint.
    pub name: String,
    /// The nearest joint of the same skin above it.
    pub parent: Option<usize>,
    /// `joint_from_mesh`: takes a vertex as it was modelled to the space of the joint.
    pub inverse_bind: DMat4,
}

impl Skeleton {
    pub(crate) fn new(joints: Vec<Joint>) -> Self {
        let mut skeleton = Skeleton { joints, starts: vec![0], influences: Vec::new() };
        skeleton.name_apart();
        skeleton
    }

    /// Numbers and weights of the joints that carry `vertex`: weights above 0 that sum to 1 (as near as `f32`
    /// has it), no joint twice. Empty for a vertex without a skin.
    #[must_use]
    pub fn influences(&self, vertex: usize) -> &[(u32, f32)] {
        match (self.starts.get(vertex), self.starts.get(vertex + 1)) {
            (Some(&start), Some(&end)) => &self.influences[start..end],
            _ => &[],
        }
    }

    /// Adds the influences of the next vertex; `given` may name a joint twice and is left empty.
    pub(crate) fn push(&mut self, given: &mut Vec<(u32, f64)>) {
        given.sort_by_key(|&(joint, _)| joint);
        given.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            kept.1 += if same { next.1 } else { 0.0 };
            same
        });
        let sum: f64 = given.iter().map(|&(_, weight)| weight).sum();
        self.influences.extend(given.drain(..).map(|(joint, weight)| (joint, (weight / sum) as f32)));
        self.starts.push(self.influences.len());
    }

    /// Adds `count` vertices without a skin.
    pub(crate) fn skip(&mut self, count: usize) {
        self.starts.resize(self.starts.len() + count, self.influences.len());
    }

    /// Two skins may have a joint in common, two nodes a name.
    fn name_apart(&mut self) {
        let mut taken = BTreeSet::new();
        let mut numbers: HashMap<String, usize> = HashMap::new();
        for joint in &mut self.joints {
            let plain = joint.name.clone();
            // Those below it are taken.
            let number = numbers.entry(plain.clone()).or_insert(2);
            while !taken.insert(joint.name.clone()) {
                joint.name = format!("{plain}_{number}");
                *number += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joint(name: &str) -> Joint {
        Joint { name: name.into(), parent: None, inverse_bind: DMat4::IDENTITY }
    }

    #[test]
    fn influences_are_summed_and_normalised() {
        let mut skeleton = Skeleton::new(vec![joint("a"), joint("b")]);
        skeleton.skip(1);
        skeleton.push(&mut vec![(1, 2.0), (0, 4.0), (1, 2.0)]);
        assert!(skeleton.influences(0).is_empty());
        assert_eq!(skeleton.influences(1), [(0, 0.5), (1, 0.5)]);
        assert!(skeleton.influences(2).is_empty() && skeleton.influences(usize::MAX - 1).is_empty());
    }

    #[test]
    fn joints_are_named_apart() {
        let names = |joints: &[&str]| -> Vec<String> {
            let joints = joints.iter().map(|name| joint(name)).collect();
            Skeleton::new(joints).joints.into_iter().map(|joint| joint.name).collect()
        };
        assert_eq!(names(&["a", "a_2", "a", "a"]), ["a", "a_2", "a_3", "a_4"]);
    }
}
