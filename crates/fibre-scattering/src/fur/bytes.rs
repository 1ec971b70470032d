//! A medulla's table as bytes, for caches.
//!
//! Little endian: the magic `gkmedull`, the format's version (u32), the key (numbers as bits, an absent one
//! as the bits of NaN), then counts and paths, each row by row.

use crate::error::ScatteringError;
use crate::fur::counts::Counts;
use crate::fur::grid::{ALONG, AROUND, CELLS, ROWS};
use crate::fur::paths::{NODES, PathNode, SHARES};
use crate::fur::row::CLASSES;
use crate::fur::table::{MedullaKey, MedullaTable};

const MAGIC: [u8; 8] = *b"gkmedull";
const KEY: usize = 7 * 4;
const HEADER: usize = MAGIC.len() + 4 + KEY;
const COUNTS: usize = ROWS * CELLS * CLASSES * 2;
const PATHS: usize = ROWS * CLASSES * NODES * 3 * 4;

impl MedullaKey {
    /// The key as bytes, equal for equal keys: what a cache may hash.
    #[must_use]
    pub fn to_bytes(&self) -> [u8; KEY] {
        let absent = |value: Option<f32>| value.map_or(f32::NAN.to_bits(), f32::to_bits);
        let words = [
            self.kappa.to_bits(),
            self.sigma_s.to_bits(),
            self.g.to_bits(),
            self.eta.to_bits(),
            absent(self.cuticle_layers),
            absent(self.film_eta),
            self.walks,
        ];
        let mut bytes = [0; KEY];
        for (place, word) in bytes.chunks_exact_mut(4).zip(words) {
            place.copy_from_slice(&word.to_le_bytes());
        }
        bytes
    }

    fn from_bytes(bytes: &mut Bytes<'_>) -> Option<MedullaKey> {
        let present = |value: f32| (!value.is_nan()).then_some(value);
        Some(MedullaKey {
            kappa: bytes.float()?,
            sigma_s: bytes.float()?,
            g: bytes.float()?,
            eta: bytes.float()?,
            cuticle_layers: present(bytes.float()?),
            film_eta: present(bytes.float()?),
            walks: u32::from_le_bytes(bytes.take()?),
        })
    }
}

impl MedullaTable {
    /// Changes with the format and with how walks are traced: tables of another version are made anew.
    pub const VERSION: u32 = 3;

    /// The table as bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(HEADER + COUNTS + PATHS);
        bytes.extend_from_slice(&MAGIC);
        bytes.extend_from_slice(&Self::VERSION.to_le_bytes());
        bytes.extend_from_slice(&self.key().to_bytes());
        for count in self.counts.iter().flat_map(|counts| counts.entries().as_flattened().as_flattened()) {
            bytes.extend_from_slice(&count.to_le_bytes());
        }
        for node in self.nodes.iter().flatten().flatten() {
            for number in [node.cortex, node.medulla, node.share] {
                bytes.extend_from_slice(&number.to_le_bytes());
            }
        }
        bytes
    }

    /// The table that [`MedullaTable::to_bytes`] wrote.
    ///
    /// # Errors
    /// [`ScatteringError::Table`] for anything else: another version, another length, counts of no whole,
    /// lengths that are none.
    pub fn from_bytes(bytes: &[u8]) -> Result<MedullaTable, ScatteringError> {
        if bytes.len() != HEADER + COUNTS + PATHS {
            return Err(ScatteringError::Table);
        }
        Self::read(&mut Bytes(bytes)).ok_or(ScatteringError::Table)
    }

    fn read(bytes: &mut Bytes<'_>) -> Option<MedullaTable> {
        if bytes.take()? != MAGIC || u32::from_le_bytes(bytes.take()?) != Self::VERSION {
            return None;
        }
        let key = MedullaKey::from_bytes(bytes)?;
        key.check().ok()?;
        let counts = (0..ROWS).map(|_| bytes.counts()).collect::<Option<_>>()?;
        let mut nodes = vec![[[PathNode::default(); NODES]; CLASSES]; ROWS];
        for class in nodes.iter_mut().flatten() {
            for node in class.iter_mut() {
                *node = PathNode { cortex: bytes.float()?, medulla: bytes.float()?, share: bytes.float()? };
            }
            is_sound(class).then_some(())?;
        }
        Some(MedullaTable::of_parts(key, counts, nodes))
    }
}

/// Whether lengths are lengths and shares sum to 1.
fn is_sound(class: &[PathNode; NODES]) -> bool {
    let is_length = |length: f32| length.is_finite() && length >= 0.0;
    let is_share = |share: f32| (0.0..=1.0).contains(&share) && (share * SHARES).fract() == 0.0;
    class.iter().all(|node| is_length(node.cortex) && is_length(node.medulla) && is_share(node.share))
        && class.iter().map(|node| node.share).sum::<f32>() == 1.0
}

/// What is left to read.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*first)
    }

    /// Of a row, if they are counts of a whole.
    fn counts(&mut self) -> Option<Counts> {
        let mut entries = [[[0; CLASSES]; AROUND]; ALONG];
        for count in entries.as_flattened_mut().as_flattened_mut() {
            *count = u16::from_le_bytes(self.take()?);
        }
        Counts::checked(entries)
    }

    fn float(&mut self) -> Option<f32> {
        self.take().map(f32::from_le_bytes)
    }
}
