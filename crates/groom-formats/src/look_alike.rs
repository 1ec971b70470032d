//! Files that end in `.hair` and are not Yuksel's, told by their first bytes.

/// Whether `head`, the first bytes of a `.hair` file, are those of MonoHair's layout: no magic, and counts
/// that can be true.
///
/// Where they cannot, the file stays HAIR's, whose reader says what is wrong.
pub(crate) fn is_monohair(head: &[u8]) -> bool {
    let word = |at: usize| Some(u32::from_le_bytes(head.get(at..at + 4)?.try_into().ok()?));
    let (Some(strands), Some(points)) = (word(0), word(4)) else { return false };
    // HAIR itself, Tungsten's fibers, text.
    let is_other = head.starts_with(b"HAIR") || head.starts_with(b"\x80\xBF\x80FIBER");
    let is_text = head.iter().all(|byte| byte.is_ascii_graphic() || byte.is_ascii_whitespace());
    if is_other || is_text || strands == 0 {
        return false;
    }
    let counts = head[8..].chunks_exact(2).take(strands as usize);
    let (mut seen, mut sum) = (0_u64, 0_u64);
    for count in counts {
        seen += 1;
        sum += u64::from(u16::from_le_bytes([count[0], count[1]]));
    }
    let (Some(rest), unseen) = (u64::from(points).checked_sub(sum), u64::from(strands) - seen) else {
        return false;
    };
    // A strand of MonoHair has up to 65,535 points, and all but a few have some.
    rest <= unseen * u64::from(u16::MAX) && points >= strands && sum > 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head(strands: u32, points: u32, counts: &[u16]) -> Vec<u8> {
        let mut bytes = [strands.to_le_bytes(), points.to_le_bytes()].concat();
        bytes.extend(counts.iter().flat_map(|count| count.to_le_bytes()));
        bytes
    }

    #[test]
    fn counts_decide() {
        assert!(is_monohair(&head(2, 5, &[2, 3, 0, 0])));
        assert!(is_monohair(&head(10_000, 250_000, &[25, 25, 30, 1])));
        assert!(!is_monohair(&head(2, 6, &[2, 3])), "the counts are all there and do not add up");
        assert!(!is_monohair(&head(2, 4, &[2, 3])));
        assert!(!is_monohair(&head(0, 0, &[0; 4])));
        assert!(!is_monohair(&head(9, 5, &[0; 4])), "more strands than points");
        assert!(!is_monohair(&head(5, 3_000_000, &[1; 4])), "more points than a u16 can say");
    }

    #[test]
    fn other_files_stay_what_they_are() {
        let hair = [b"HAIR".as_slice(), &[16, 0, 0, 0, 80, 0, 0, 0, 4, 0, 4, 0]].concat();
        for head in [&hair, &b"\x80\xBF\x80FIBER\0\0\0\0\0\0\0\0"[..], b"0.5 0.25 1 0.1\n0", b"", b"HAI"] {
            assert!(!is_monohair(head));
        }
        // A HAIR file whose magic is damaged has a count of about 1.4e9 strands there.
        assert!(!is_monohair(&[b"hAIR".as_slice(), &hair[4..]].concat()));
    }
}
