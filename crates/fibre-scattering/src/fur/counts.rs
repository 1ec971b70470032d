//! Where a row's light goes: how much of each class is about each knot, to look up and to draw from.

use crate::arithmetic::lanes::Lanes;
use crate::arithmetic::real::{Real, four};
use crate::fur::density::Density;
use crate::fur::grid::{ALONG, AROUND, CELLS};
use crate::fur::knots::Knots;
use crate::fur::row::CLASSES;

/// Parts in 65536ths of each class, line by line along the fibre.
pub(crate) type Entries = [[[u16; CLASSES]; AROUND]; ALONG];

/// The entries of a row. Those of a class sum to 65536, of which the last line has some: so every sum before
/// a line is below 65536.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Counts {
    entries: Entries,
    /// What the lines before each sum to.
    before: [[u16; CLASSES]; ALONG],
}

impl Counts {
    /// The densities of the classes in whole counts: differences of rounded sums.
    pub fn of_densities(densities: [Density; CLASSES]) -> Counts {
        let mut entries = [[[0; CLASSES]; AROUND]; ALONG];
        for (class, density) in densities.iter().enumerate() {
            let total: f64 = density.iter().map(|&mass| f64::from(mass)).sum();
            let (mut sum, mut before) = (0.0, 0);
            for (number, (entry, &mass)) in entries.as_flattened_mut().iter_mut().zip(density).enumerate() {
                sum += f64::from(mass);
                let share = if total > 0.0 { sum / total } else { (number + 1) as f64 / CELLS as f64 };
                let rounded = (share * 65536.0).round() as u32;
                // The last entry has some of it and not all.
                let upto = match CELLS - number {
                    1 => 65536,
                    2 => rounded.clamp(1, 65535),
                    _ => rounded.min(65535),
                };
                entry[class] = (upto - before) as u16;
                before = upto;
            }
        }
        Counts::summed(entries).0
    }

    /// Entries that sum to what they should, in every class.
    pub fn checked(entries: Entries) -> Option<Counts> {
        let (counts, sums) = Counts::summed(entries);
        let sound = |class: usize| {
            let last: u32 = entries[ALONG - 1].iter().map(|entry| u32::from(entry[class])).sum();
            sums[class] == 65536 && last > 0
        };
        (0..CLASSES).all(sound).then_some(counts)
    }

    /// And the sums of all.
    fn summed(entries: Entries) -> (Counts, [u32; CLASSES]) {
        let mut sums = [0_u32; CLASSES];
        let mut before = [[0; CLASSES]; ALONG];
        for (line, before) in entries.iter().zip(&mut before) {
            *before = sums.map(|sum| sum as u16);
            for entry in line {
                sums = four(|class| sums[class] + u32::from(entry[class]));
            }
        }
        (Counts { entries, before }, sums)
    }

    pub fn entries(&self) -> &Entries {
        &self.entries
    }

    /// Density of each class between the knots, per steradian.
    #[inline(always)]
    pub fn densities<T: Real>(&self, knots: &Knots<T>) -> T::Four {
        let [low, high] = [&self.entries[knots.line], &self.entries[knots.line + 1]];
        let weight = |corner: usize| T::Four::splat(knots.weights[corner]);
        let counts = |entry: &[u16; CLASSES]| T::Four::of_counts(entry);
        let below = counts(&low[knots.next]).times_plus(weight(1), counts(&low[knots.column]) * weight(0));
        let above = counts(&high[knots.next]).times_plus(weight(3), counts(&high[knots.column]) * weight(2));
        below + above
    }

    /// Line and column of the entry that a count below 65536 falls on, of a class below [`CLASSES`].
    pub fn drawn(&self, class: usize, count: usize) -> (usize, usize) {
        // Counted and not searched: every line's sums are in two cache lines, and no branch has to be foreseen.
        let later = self.before[1..].iter().map(|before| usize::from(usize::from(before[class]) <= count));
        let line = later.sum::<usize>();
        let left = count - usize::from(self.before[line][class]);
        let (mut sum, mut column) = (0, 0);
        for entry in &self.entries[line] {
            sum += usize::from(entry[class]);
            column += usize::from(sum <= left);
        }
        (line, column.min(AROUND - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A density with all of one class in one entry, a third in each of three, all alike, and nothing.
    fn densities() -> [Density; CLASSES] {
        let mut peak = vec![0.0; CELLS];
        peak[100] = 3.0;
        let mut three = vec![0.0; CELLS];
        for entry in [0, 57, CELLS - 1] {
            three[entry] = 1.0;
        }
        [peak, three, vec![0.1; CELLS], vec![0.0; CELLS]]
    }

    #[test]
    fn every_count_draws_an_entry_as_often_as_it_says() {
        let counts = Counts::of_densities(densities());
        assert!(Counts::checked(*counts.entries()).is_some());
        assert_eq!(counts.entries.as_flattened()[100][0], 65535);
        for class in 0..CLASSES {
            let mut drawn = [[0_u32; AROUND]; ALONG];
            for count in 0..65536 {
                let (line, column) = counts.drawn(class, count);
                drawn[line][column] += 1;
            }
            for (drawn, entry) in drawn.as_flattened().iter().zip(counts.entries.as_flattened()) {
                assert_eq!(*drawn, u32::from(entry[class]));
            }
        }
    }

    #[test]
    fn entries_that_are_no_parts_of_a_whole_are_refused() {
        let sound = *Counts::of_densities(densities()).entries();
        for (line, by) in [(0, 1), (ALONG - 1, -1_i16)] {
            let mut entries = sound;
            entries[line][0][1] = entries[line][0][1].wrapping_add_signed(by);
            assert!(Counts::checked(entries).is_none());
        }
        // A sum of a whole before the last line would look like nothing.
        let mut entries = sound;
        let last: u16 = entries[ALONG - 1].iter().map(|entry| entry[2]).sum();
        entries[ALONG - 1].iter_mut().for_each(|entry| entry[2] = 0);
        entries[0][0][2] += last;
        assert!(Counts::checked(entries).is_none());
    }
}
