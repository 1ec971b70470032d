//! Farthest-point sampling: places chosen one after another, each as far as can be from those before.
//!
//! Gonzalez: Clustering to minimize the maximum intercluster distance (1985). The places hang in a tree
//! of boxes that know the loneliest place in them; a choice that is farther from a box than that changes
//! nothing inside, so the tree is entered only near the choice. The outcome is that of the plain method.

use std::ops::Range;

/// Numbers of a place.
pub(crate) const DIMENSIONS: usize = 9;

/// A place: coordinates whose Euclidean distance matters.
pub(crate) type Place = [f32; DIMENSIONS];

/// Most places in a leaf.
const LEAF: usize = 32;

/// What was chosen.
pub(crate) struct Choice {
    /// Indices of the chosen places, in order of choice.
    pub chosen: Vec<u32>,
    /// For every place, which of `chosen` is the closest; the earlier one of two that are equally close.
    pub closest: Vec<u32>,
}

/// Chooses `count` of `places` (all, when there are fewer), beginning with `first`; all numbers are finite.
pub(crate) fn farthest(places: &[Place], count: usize, first: usize) -> Choice {
    let mut choice = Choice { chosen: Vec::new(), closest: vec![0; places.len()] };
    if places.is_empty() || count == 0 {
        return choice;
    }
    let mut tree = Tree::new(places);
    let mut next = first.min(places.len() - 1) as u32;
    for rank in 0..count.min(places.len()) as u32 {
        choice.chosen.push(next);
        tree.add(0, next, rank, &places[next as usize]);
        next = tree.nodes[0].loneliest.index;
    }
    for leaf in &tree.members {
        choice.closest[leaf.index as usize] = leaf.closest;
    }
    choice
}

/// A place in the tree.
#[derive(Clone, Copy)]
struct Member {
    place: Place,
    index: u32,
    /// Squared distance to the closest choice; under 0 when it is one.
    distance: f32,
    /// Which choice that is.
    closest: u32,
}

impl Member {
    /// The lonelier of two; of two alike the one that comes first in the groom.
    fn lonelier(self, other: Lonely) -> Lonely {
        let mine = Lonely { distance: self.distance, index: self.index };
        mine.lonelier(other)
    }
}

#[derive(Clone, Copy)]
struct Lonely {
    distance: f32,
    index: u32,
}

impl Lonely {
    const NONE: Lonely = Lonely { distance: f32::NEG_INFINITY, index: u32::MAX };

    fn lonelier(self, other: Lonely) -> Lonely {
        let key = |lonely: Lonely| (lonely.distance, std::cmp::Reverse(lonely.index));
        if key(self) > key(other) { self } else { other }
    }
}

struct Node {
    low: Place,
    high: Place,
    loneliest: Lonely,
    members: Range<usize>,
    /// The second child; the first follows its parent.
    second: Option<usize>,
}

struct Tree {
    nodes: Vec<Node>,
    members: Vec<Member>,
}

impl Tree {
    fn new(places: &[Place]) -> Tree {
        let member = |(index, &place): (usize, &Place)| Member {
            place,
            index: index as u32,
            distance: f32::INFINITY,
            closest: 0,
        };
        let members: Vec<Member> = places.iter().enumerate().map(member).collect();
        let mut tree = Tree { nodes: Vec::with_capacity(4 * members.len() / LEAF + 1), members };
        tree.build(0..places.len());
        tree
    }

    /// Adds the node of some members, and those below it: as deep as the members can be halved.
    fn build(&mut self, range: Range<usize>) {
        let members = &mut self.members[range.clone()];
        let (mut low, mut high) = ([f32::INFINITY; DIMENSIONS], [f32::NEG_INFINITY; DIMENSIONS]);
        for member in members.iter() {
            for axis in 0..DIMENSIONS {
                low[axis] = low[axis].min(member.place[axis]);
                high[axis] = high[axis].max(member.place[axis]);
            }
        }
        let loneliest = members.iter().fold(Lonely::NONE, |lonely, member| member.lonelier(lonely));
        let node = self.nodes.len();
        self.nodes.push(Node { low, high, loneliest, members: range.clone(), second: None });
        if range.len() <= LEAF {
            return;
        }
        let width = |axis: &usize| high[*axis] - low[*axis];
        let widest = (0..DIMENSIONS).max_by(|a, b| width(a).total_cmp(&width(b))).unwrap_or(0);
        let middle = range.len() / 2;
        members.select_nth_unstable_by(middle, |a, b| {
            a.place[widest].total_cmp(&b.place[widest]).then(a.index.cmp(&b.index))
        });
        self.build(range.start..range.start + middle);
        self.nodes[node].second = Some(self.nodes.len());
        self.build(range.start + middle..range.end);
    }

    /// Tells the members below `node` of the choice `index`, the `rank`-th, at `place`.
    fn add(&mut self, node: usize, index: u32, rank: u32, place: &Place) {
        let Node { low, high, loneliest, members, second } = &self.nodes[node];
        // Each step of both sums is monotone, in floats too: no member is closer than its box.
        let to_box: f32 = (0..DIMENSIONS)
            .map(|axis| {
                let outside = (low[axis] - place[axis]).max(place[axis] - high[axis]).max(0.0);
                outside * outside
            })
            .sum();
        // At 0 it may be a member itself, which is to be marked.
        if to_box > 0.0 && to_box >= loneliest.distance {
            return;
        }
        self.nodes[node].loneliest = match *second {
            Some(second) => {
                self.add(node + 1, index, rank, place);
                self.add(second, index, rank, place);
                self.nodes[node + 1].loneliest.lonelier(self.nodes[second].loneliest)
            }
            None => {
                let members = &mut self.members[members.clone()];
                members.iter_mut().fold(Lonely::NONE, |lonely, member| {
                    member.meet(index, rank, place);
                    member.lonelier(lonely)
                })
            }
        };
    }
}

impl Member {
    fn meet(&mut self, index: u32, rank: u32, place: &Place) {
        let squares = (0..DIMENSIONS).map(|axis| {
            let apart = self.place[axis] - place[axis];
            apart * apart
        });
        let distance: f32 = squares.sum();
        if self.index == index {
            (self.distance, self.closest) = (-1.0, rank);
        } else if distance < self.distance {
            (self.distance, self.closest) = (distance, rank);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random;

    fn places(count: u32) -> Vec<Place> {
        // On a coarse lattice, so that many are alike.
        let number = |id, axis: usize| (random(1, id, &axis.to_string()) * 6.0).floor();
        (0..count)
            .map(|id| std::array::from_fn(|axis| if axis < 4 { number(id, axis) } else { 0.0 }))
            .collect()
    }

    fn squared(a: &Place, b: &Place) -> f32 {
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
    }

    /// The plain method, as the definition says.
    fn plainly(places: &[Place], count: usize, first: usize) -> Vec<u32> {
        let mut chosen = vec![first as u32];
        while chosen.len() < count {
            let distance = |i: usize| {
                let to = |&c: &u32| squared(&places[i], &places[c as usize]);
                chosen.iter().map(to).fold(f32::INFINITY, f32::min)
            };
            let free = (0..places.len()).filter(|&i| !chosen.contains(&(i as u32)));
            let next = free.max_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(b.cmp(&a))).unwrap();
            chosen.push(next as u32);
        }
        chosen
    }

    #[test]
    fn the_tree_chooses_what_the_plain_method_chooses() {
        let places = places(700);
        for first in [0, 333, 699] {
            let choice = farthest(&places, 120, first);
            assert_eq!(choice.chosen, plainly(&places, 120, first));
            for (place, &closest) in places.iter().zip(&choice.closest) {
                let to = |&c: &u32| squared(place, &places[c as usize]);
                let least = choice.chosen.iter().map(to).fold(f32::INFINITY, f32::min);
                assert_eq!(to(&choice.chosen[closest as usize]), least);
            }
        }
    }

    #[test]
    fn all_are_chosen_when_more_are_asked_for() {
        let places = places(100);
        let mut chosen = farthest(&places, 1000, 5).chosen;
        chosen.sort_unstable();
        assert_eq!(chosen, (0..100).collect::<Vec<_>>());
        assert!(farthest(&[], 5, 0).chosen.is_empty());
    }
}
