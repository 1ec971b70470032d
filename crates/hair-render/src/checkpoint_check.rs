//! Whether a checkpoint that was read is one that was written.
//!
//! Blocks of noise are stored as they are, without a checksum of their own: so there is one over all sums.

use crate::{Checkpoint, PASS_SPP};

impl Checkpoint {
    /// Whether these are sums that a render could have left, and those that were written: what its header tells of both is
    /// given.
    pub(crate) fn check_sums(&self, told_spp: f64, told_sum: &str) -> Result<(), String> {
        let (spp, asked) = (self.spp(), self.spp_asked);
        if spp != asked && !(spp < asked && spp.is_multiple_of(PASS_SPP)) {
            return Err(format!("{spp} samples a pixel of {asked}, expected a multiple of {PASS_SPP}"));
        }
        if f64::from(spp) != told_spp {
            return Err(format!("{spp} samples a pixel, and its header says {told_spp}"));
        }
        let next = asked.min(spp.saturating_add(PASS_SPP));
        for (index, tile) in self.tiles.iter().enumerate() {
            if tile.spp != spp && tile.spp != next {
                let found = tile.spp;
                return Err(format!("tile {index} has {found} samples a pixel, expected {spp} or {next}"));
            }
            if let Some(covered) = tile.covered.iter().find(|&&covered| covered > tile.spp) {
                return Err(format!("tile {index}: {covered} of {} samples met something", tile.spp));
            }
            if !tile.halves.iter().flatten().chain(&tile.parts).all(|sum| sum.is_finite()) {
                return Err(format!("tile {index}: a sum is not finite"));
            }
        }
        let found = self.checksum();
        if found != told_sum {
            return Err(format!("the checksum of its sums is {found}, and its header says `{told_sum}`"));
        }
        Ok(())
    }

    /// Of the sums and of what they are sums of, in 16 letters.
    pub(crate) fn checksum(&self) -> String {
        let mut sum = Check(0);
        self.digest.bytes().for_each(|byte| sum.add(byte.into()));
        let Checkpoint { window, tally, .. } = self;
        for value in [window.x, window.y, window.width, window.height, self.spp_asked] {
            sum.add(value.into());
        }
        for value in
            [self.seed, tally.rays.closest, tally.rays.shadow, tally.rejected, self.seconds.to_bits()]
        {
            sum.add(value);
        }
        for tile in &self.tiles {
            sum.add(tile.spp.into());
            tile.covered.iter().for_each(|&covered| sum.add(covered.into()));
            let sums = tile.halves.iter().flatten().chain(&tile.parts);
            sums.flat_map(|sum| sum.to_array()).for_each(|value| sum.add(value.to_bits()));
        }
        format!("{:016x}", sum.0)
    }
}

/// Any change of a single value changes it, and so do nearly all others.
struct Check(u64);

impl Check {
    fn add(&mut self, value: u64) {
        let mixed = (self.0.rotate_left(23) ^ value).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = mixed ^ (mixed >> 29);
    }
}
