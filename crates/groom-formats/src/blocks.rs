//! Long texts made on all cores: blocks of items become text wherever a core is free, and leave in order.

use std::io::{self, Write};
use std::ops::Range;

use groom::Groom;

use crate::numbers::Text;

/// Items (points, strands, numbers) of one block: 10 to 100 KB of text, small enough for a core's cache.
const BLOCK: usize = 1024;

/// Blocks a core has before it while those of the round before are written.
const AHEAD: usize = 4;

/// Writes the text of items `0..items`: `push` turns a range of them into text, in order within the range
/// and without regard to where ranges begin.
///
/// Ranges are the same whatever the number of threads, and so are the bytes. At most `2 * AHEAD` blocks a
/// thread are in memory. `stream` is written to by the calling thread alone, while others make the next
/// blocks; after an error no new ones are begun.
///
/// # Errors
/// What `stream` says.
pub(crate) fn write(
    stream: &mut impl Write,
    items: usize,
    push: impl Fn(&mut Text, Range<usize>) + Sync,
) -> io::Result<()> {
    if items <= BLOCK {
        let mut text = Text::new();
        push(&mut text, 0..items);
        return stream.write_all(text.as_bytes());
    }
    let round = AHEAD * rayon::current_num_threads() * BLOCK;
    let mut being_made: Vec<Text> = Vec::new();
    let mut made: Vec<Text> = Vec::new();
    let mut start = 0;
    loop {
        let end = items.min(start + round);
        being_made.resize_with((end - start).div_ceil(BLOCK), Text::new);
        let mut written = Ok(());
        rayon::in_place_scope(|scope| {
            let push = &push;
            for (text, first) in being_made.iter_mut().zip((start..end).step_by(BLOCK)) {
                scope.spawn(move |_| {
                    text.clear();
                    push(text, first..end.min(first + BLOCK));
                });
            }
            written = made.iter().try_for_each(|text| stream.write_all(text.as_bytes()));
        });
        written?;
        if being_made.is_empty() {
            return Ok(());
        }
        std::mem::swap(&mut being_made, &mut made);
        start = end;
    }
}

/// The strands that have some of the groom's points `points`: index and those of its points, in order.
pub(crate) fn strands_among(
    groom: &Groom,
    points: Range<usize>,
) -> impl Iterator<Item = (usize, Range<usize>)> + '_ {
    let first = groom.offsets().partition_point(|&offset| offset as usize <= points.start).saturating_sub(1);
    (first..groom.strand_count())
        .map(move |strand| {
            let all = groom.strand_range(strand);
            (strand, all.start.max(points.start)..all.end.min(points.end))
        })
        .take_while(|(_, some)| !some.is_empty())
}

#[cfg(test)]
mod tests {
    use std::io::ErrorKind;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use glam::Vec3;

    use super::*;

    const LENGTHS: [usize; 8] = [0, 1, 7, BLOCK - 1, BLOCK, BLOCK + 1, 40 * BLOCK, 100 * BLOCK + 3];

    fn numbers(items: usize) -> Vec<u8> {
        let mut bytes = Vec::new();
        write(&mut bytes, items, |text, range| {
            for item in range {
                text.float(item as f32);
                text.push(b",");
            }
        })
        .unwrap();
        bytes
    }

    #[test]
    fn the_number_of_threads_changes_nothing() {
        let expected = |items| (0..items).map(|item| format!("{item},")).collect::<String>().into_bytes();
        for threads in [1, 2, 7] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            for items in LENGTHS {
                assert_eq!(pool.install(|| numbers(items)), expected(items), "{items} on {threads}");
            }
        }
        // Outside a pool too.
        assert_eq!(numbers(5000), expected(5000));
    }

    /// Takes one piece, then is closed.
    struct Closed(bool);

    impl Write for Closed {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            if std::mem::replace(&mut self.0, true) {
                return Err(ErrorKind::BrokenPipe.into());
            }
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_closed_pipe_ends_the_work() {
        let made = AtomicUsize::new(0);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        let error = pool.install(|| {
            write(&mut Closed(false), 1_000_000 * BLOCK, |text, _| {
                made.fetch_add(1, Ordering::Relaxed);
                text.push(b"x");
            })
        });
        assert_eq!(error.unwrap_err().kind(), ErrorKind::BrokenPipe);
        assert!(made.into_inner() <= 2 * 2 * AHEAD, "two rounds at most");
    }

    #[test]
    fn strands_among_points_are_cut_to_them() {
        let groom = Groom::new(vec![0, 2, 3, 7], vec![Vec3::ZERO; 7]).unwrap();
        let among = |points| strands_among(&groom, points).collect::<Vec<_>>();
        assert_eq!(among(0..7), [(0, 0..2), (1, 2..3), (2, 3..7)]);
        assert_eq!(among(1..5), [(0, 1..2), (1, 2..3), (2, 3..5)]);
        assert_eq!(among(2..3), [(1, 2..3)]);
        assert_eq!(among(4..4), []);
        assert_eq!(among(7..7), []);
        for start in 0..7 {
            for end in start..=7 {
                let points: Vec<usize> = among(start..end).into_iter().flat_map(|(_, some)| some).collect();
                assert_eq!(points, (start..end).collect::<Vec<_>>());
            }
        }
    }
}
