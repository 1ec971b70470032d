//! What ffmpeg is asked to do.

use std::ffi::OsString;
use std::path::Path;

use crate::{Codec, FilmSettings};

/// The arguments of an ffmpeg that reads raw pictures from its standard input and writes `output`.
///
/// ffmpeg knows nothing of the meaning of RGB that comes through a pipe. The pixels are Rec. 709 primaries with
/// the sRGB transfer (IEC 61966-2-1); the conversion to Y'CbCr uses the Rec. 709 matrix, and the tags say what was
/// done. Tagging the film `bt709` throughout would be the custom and not the truth: a player that honours tags
/// would show it darker than the PNGs.
pub(crate) fn arguments(settings: &FilmSettings, (wide, high): (u32, u32), output: &Path) -> Vec<OsString> {
    let (from, to, range) = match settings.codec {
        Codec::H264 { .. } => ("rgba", "yuv420p", "tv"),
        Codec::ProRes4444 => ("rgba64le", "yuva444p10le", "tv"),
    };
    let crf;
    let codec: &[&str] = match settings.codec {
        Codec::H264 { crf: factor } => {
            crf = factor.to_string();
            &["-c:v", "libx264", "-preset", "medium", "-crf", &crf, "-profile:v", "high"]
        }
        Codec::ProRes4444 => {
            &["-c:v", "prores_ks", "-profile:v", "4444", "-alpha_bits", "16", "-vendor", "apl0"]
        }
    };
    let container: &[&str] = match settings.codec {
        // The index in front: a page can play the film while it loads.
        Codec::H264 { .. } => &["-movflags", "+faststart+write_colr", "-f", "mp4"],
        Codec::ProRes4444 => &["-movflags", "+write_colr", "-f", "mov"],
    };
    let filter = format!(
        "scale=out_color_matrix=bt709:out_range={range}:flags=accurate_rnd+full_chroma_int+bicubic,format={to},\
         setparams=color_primaries=bt709:color_trc=iec61966-2-1:colorspace=bt709:range={range}"
    );
    let (size, rate) = (format!("{wide}x{high}"), settings.rate.to_string());
    let comment = settings.comment.as_ref().map(|words| format!("comment={}", words.replace('\0', " ")));
    let mut all: Vec<&str> = vec!["-hide_banner", "-nostdin", "-loglevel", "error", "-nostats", "-y"];
    all.extend([
        "-f",
        "rawvideo",
        "-pix_fmt",
        from,
        "-video_size",
        &size,
        "-framerate",
        &rate,
        "-i",
        "pipe:0",
    ]);
    all.extend(["-an", "-vf", &filter]);
    all.extend(codec);
    all.extend(["-pix_fmt", to, "-color_primaries", "bt709", "-color_trc", "iec61966-2-1"]);
    all.extend(["-colorspace", "bt709", "-color_range", range]);
    // Neither times nor versions in the file: the same pictures give the same bytes on one machine.
    all.extend(["-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"]);
    if let Some(comment) = &comment {
        all.extend(["-metadata", comment]);
    }
    all.extend(container);
    let mut all: Vec<OsString> = all.into_iter().map(OsString::from).collect();
    // A name that begins with a dash or holds a colon would be an option or a protocol.
    let mut file = OsString::from("file:");
    file.push(output);
    all.push(file);
    all
}
