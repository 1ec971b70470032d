//! Strands the other way round.

use crate::{Domain, Groom, Values};

impl Groom {
    /// Turns every strand round: its tip becomes its root. Values per vertex go with their points; values
    /// per strand stay, `root_uv` too, which then says where the tip is.
    pub fn reverse(&mut self) {
        let offsets = self.offsets().to_vec();
        flip(self.positions_mut(), &offsets);
        for attribute in self.attributes_mut().filter(|a| a.domain == Domain::Vertex) {
            match &mut attribute.values {
                Values::Float(v) => flip(v, &offsets),
                Values::Vec2(v) => flip(v, &offsets),
                Values::Vec3(v) => flip(v, &offsets),
                Values::Int(v) => flip(v, &offsets),
            }
        }
    }
}

fn flip<T>(values: &mut [T], offsets: &[u32]) {
    for ends in offsets.windows(2) {
        values[ends[0] as usize..ends[1] as usize].reverse();
    }
}
