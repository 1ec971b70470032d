//! Odd sizes made even by doubling the last column and row.

/// Pixels of `channels` values each, `width` of them a row, in rows of `wide` pixels and `high` rows.
///
/// `values` holds `width` x `height` pixels; `wide` and `high` are at most one more.
pub(crate) fn padded<T: Copy>(values: &[T], width: usize, wide: usize, high: usize) -> Vec<T> {
    const CHANNELS: usize = 4;
    let mut out = Vec::with_capacity(wide * high * CHANNELS);
    for row in values.chunks_exact((width * CHANNELS).max(1)) {
        out.extend_from_slice(row);
        if wide > width {
            out.extend_from_slice(&row[row.len() - CHANNELS..]);
        }
    }
    let row = wide * CHANNELS;
    if out.len() >= row && out.len() < row * high {
        out.extend_from_within(out.len() - row..);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_column_and_row_are_doubled() {
        let picture: Vec<u8> = (0..3).flat_map(|i| [i; 4]).collect();
        let pixels = |padded: Vec<u8>| padded.chunks(4).map(|p| p[0]).collect::<Vec<_>>();
        assert_eq!(pixels(padded(&picture, 3, 3, 1)), [0, 1, 2]);
        assert_eq!(pixels(padded(&picture, 3, 4, 2)), [0, 1, 2, 2, 0, 1, 2, 2]);
        assert_eq!(pixels(padded(&picture, 1, 2, 4)), [0, 0, 1, 1, 2, 2, 2, 2]);
    }
}
