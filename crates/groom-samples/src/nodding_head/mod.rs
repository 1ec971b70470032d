//! The head as a character that moves: skinned, morphing, animated, in one binary glTF.

mod document;
mod motion;
mod surface;

use motion::Clip;

/// The head on two joints, `neck` and `head`, with the morph target `surprise` that pulls the scalp back, and the
/// animations `Nod` (both joints and the morph) and `Shake`: a second each, at 24 frames, ending as they begin.
///
/// The rest pose is that of the skin at its bind pose, which is where the sample hair grows; y up, in metres. The
/// materials `scalp` and `skin` part it along the hairline.
#[must_use]
pub fn nodding_head_glb() -> Vec<u8> {
    document::glb(&surface::Surface::new(), &[Clip::nod(), Clip::shake()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_small_and_whole() {
        let glb = nodding_head_glb();
        assert!(glb.len() < 300_000, "{} bytes", glb.len());
        let word = |at: usize| u32::from_le_bytes([glb[at], glb[at + 1], glb[at + 2], glb[at + 3]]) as usize;
        assert_eq!((&glb[..4], word(4), word(8)), (&b"glTF"[..], 2, glb.len()));
        let json = word(12);
        assert_eq!(&glb[16..20], b"JSON");
        assert_eq!((word(20 + json), &glb[24 + json..28 + json]), (glb.len() - 28 - json, &b"BIN\0"[..]));
        assert!(json % 4 == 0 && glb == nodding_head_glb());
    }
}
