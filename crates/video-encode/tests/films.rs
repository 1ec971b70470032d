//! Films decoded again: what was piped in comes out, under the tags that are true.
#![allow(clippy::unwrap_used, clippy::panic, clippy::explicit_write)]

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use video_encode::{Codec, Ffmpeg, Film, FilmSettings, FrameRate, Picture, VideoError};

/// The machine's ffmpeg, or the one that `cargo xtask setup` installs; says aloud when there is neither.
fn ffmpeg() -> Option<Ffmpeg> {
    let installed = || {
        let python = concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/venv/bin/python");
        let script = "import imageio_ffmpeg; print(imageio_ffmpeg.get_ffmpeg_exe())";
        let output = Command::new(python).args(["-c", script]).output().ok()?;
        Ffmpeg::at(Path::new(String::from_utf8_lossy(&output.stdout).trim()))
    };
    let found = Ffmpeg::find().or_else(installed);
    if found.is_none() {
        let words = "skipped: no ffmpeg in $FFMPEG, in PATH or in target/venv (cargo xtask setup)";
        writeln!(std::io::stderr(), "{words}").unwrap();
    }
    found
}

fn settings(size: (u32, u32), codec: Codec) -> FilmSettings {
    let rate = FrameRate::new(24.0).unwrap();
    FilmSettings { width: size.0, height: size.1, rate, codec, comment: Some("turn: it's \"one\"".into()) }
}

/// A smooth picture that moves with `time`, alpha rising from left to right.
fn picture(width: u32, height: u32, time: u32) -> Vec<u16> {
    let mut values = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let wave = |phase: f64| {
                let at = f64::from(x) * 0.06 + f64::from(y) * 0.045 + f64::from(time) * 0.4 + phase;
                ((at.sin() * 0.45 + 0.5) * 65535.0) as u16
            };
            let alpha = (f64::from(x) / f64::from(width.max(2) - 1) * 65535.0) as u16;
            values.extend([wave(0.0), wave(2.0), wave(4.0), alpha]);
        }
    }
    values
}

fn eight(values: &[u16]) -> Vec<u8> {
    values.iter().map(|&value| (value / 257) as u8).collect()
}

fn film(
    ffmpeg: &Ffmpeg,
    path: &Path,
    size: (u32, u32),
    codec: Codec,
    count: u32,
) -> video_encode::FilmReport {
    let mut film = Film::begin(ffmpeg, path, settings(size, codec)).unwrap();
    for time in 0..count {
        let values = picture(size.0, size.1, time);
        match codec {
            Codec::H264 { .. } => film.push(Picture::Rgba8(&eight(&values))).unwrap(),
            Codec::ProRes4444 => film.push(Picture::Rgba16(&values)).unwrap(),
        }
    }
    film.finish().unwrap()
}

/// What ffmpeg says of a file, and its pictures in `format`.
fn decoded(ffmpeg: &Ffmpeg, path: &Path, format: &str) -> (String, Vec<u8>) {
    let output = Command::new(ffmpeg.program())
        .args(["-hide_banner", "-i"])
        .arg(path)
        .args(["-vf", "scale=flags=accurate_rnd+full_chroma_int", "-f", "rawvideo", "-pix_fmt", format, "-"])
        .output()
        .unwrap();
    let words = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{words}");
    (words, output.stdout)
}

fn psnr(a: impl Iterator<Item = f64>, b: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = a.zip(b).fold((0.0, 0.0), |(sum, count), (a, b)| (sum + (a - b).powi(2), count + 1.0));
    10.0 * (count / sum).log10()
}

/// Only the finished film is in the folder.
fn names(folder: &Path) -> Vec<PathBuf> {
    std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into()).collect()
}

#[test]
fn h264_comes_back_as_it_went_in_with_true_tags() {
    let Some(ffmpeg) = ffmpeg() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("-odd: name.mp4");
    let report = film(&ffmpeg, &path, (161, 91), Codec::H264 { crf: 12 }, 7);
    assert_eq!((report.pictures, report.width, report.height), (7, 162, 92));
    assert_eq!(names(folder.path()).len(), 1);
    let (words, pixels) = decoded(&ffmpeg, &path, "rgb24");
    for part in ["h264", "yuv420p(tv, bt709/bt709/iec61966-2-1", "162x92", "24 fps", "turn: it's \"one\""] {
        assert!(words.contains(part), "no `{part}` in: {words}");
    }
    assert_eq!(pixels.len(), 7 * 162 * 92 * 3, "seven pictures");
    for (time, decoded) in pixels.chunks(162 * 92 * 3).enumerate() {
        let sent = eight(&picture(161, 91, time as u32));
        let inside = (0..91).flat_map(|y| (0..161).map(move |x| (x, y)));
        let pairs =
            inside.flat_map(|(x, y)| (0..3).map(move |c| ((y * 161 + x) * 4 + c, (y * 162 + x) * 3 + c)));
        let sent = pairs.clone().map(|(i, _)| f64::from(sent[i]) / 255.0);
        let found = psnr(sent, pairs.map(|(_, i)| f64::from(decoded[i]) / 255.0));
        assert!(found > 38.0, "picture {time}: {found:.1} dB");
    }
}

#[test]
fn prores_keeps_ten_bits_and_alpha() {
    let Some(ffmpeg) = ffmpeg() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("turn.mov");
    film(&ffmpeg, &path, (160, 90), Codec::ProRes4444, 3);
    let (words, bytes) = decoded(&ffmpeg, &path, "rgba64le");
    for part in ["prores", "4444", "yuva444p1", "bt709/bt709/iec61966-2-1", "160x90", "24 fps"] {
        assert!(words.contains(part), "no `{part}` in: {words}");
    }
    let values: Vec<u16> = bytes.chunks(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect();
    assert_eq!(values.len(), 3 * 160 * 90 * 4, "three pictures");
    for (time, decoded) in values.chunks(160 * 90 * 4).enumerate() {
        let sent = picture(160, 90, time as u32);
        let part = |values: &[u16], alpha: bool| {
            let kept = values.iter().enumerate().filter(|(i, _)| (i % 4 == 3) == alpha);
            kept.map(|(_, &value)| f64::from(value) / 65535.0).collect::<Vec<_>>()
        };
        let found = |alpha| psnr(part(&sent, alpha).into_iter(), part(decoded, alpha).into_iter());
        assert!(found(false) > 44.0, "picture {time}: {:.1} dB", found(false));
        assert!(found(true) > 60.0, "picture {time}: alpha {:.1} dB", found(true));
    }
}

#[test]
fn the_same_pictures_give_the_same_bytes() {
    let Some(ffmpeg) = ffmpeg() else { return };
    let folder = tempfile::tempdir().unwrap();
    let bytes = |name: &str| {
        let path = folder.path().join(name);
        let report = film(&ffmpeg, &path, (64, 48), Codec::H264 { crf: 20 }, 5);
        let bytes = std::fs::read(path).unwrap();
        assert_eq!(report.bytes, bytes.len() as u64);
        bytes
    };
    assert!(bytes("a.mp4") == bytes("b.mp4"));
}

#[test]
fn what_goes_wrong_is_said_and_leaves_the_old_film() {
    let Some(ffmpeg) = ffmpeg() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("turn.mp4");
    std::fs::write(&path, b"old").unwrap();
    let begin = |codec| Film::begin(&ffmpeg, &path, settings((16, 16), codec)).unwrap();
    let small = begin(Codec::H264 { crf: 18 }).push(Picture::Rgba8(&[0; 7])).unwrap_err();
    assert!(matches!(small, VideoError::Picture { index: 0, found: 7, expected: 1024, .. }), "{small}");
    let deep = begin(Codec::H264 { crf: 18 }).push(Picture::Rgba16(&[0; 1024])).unwrap_err();
    assert!(deep.to_string().contains("eight bits"), "{deep}");
    let empty = begin(Codec::ProRes4444).finish().unwrap_err();
    assert!(matches!(empty, VideoError::Empty { .. }), "{empty}");
    drop(begin(Codec::H264 { crf: 18 }));
    let nowhere =
        Film::begin(&ffmpeg, &folder.path().join("no/turn.mp4"), settings((16, 16), Codec::ProRes4444));
    assert!(matches!(nowhere, Err(VideoError::WholeFile(_))));
    assert_eq!(std::fs::read(&path).unwrap(), b"old");
    assert_eq!(names(folder.path()).len(), 1);
}

/// A program that says it is ffmpeg and then gives up.
#[cfg(unix)]
#[test]
fn ffmpegs_own_words_are_passed_on() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("ffmpeg");
    let script = "#!/bin/sh\n[ \"$1\" = -version ] && { echo ffmpeg version 0-test; exit 0; }\n\
        head -c 100 >/dev/null; echo 'Unknown encoder libx264' >&2; exit 8\n";
    std::fs::write(&program, script).unwrap();
    std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).unwrap();
    let ffmpeg = Ffmpeg::at(&program).unwrap();
    assert_eq!(ffmpeg.version(), "0-test");
    let path = folder.path().join("turn.mp4");
    let mut film = Film::begin(&ffmpeg, &path, settings((640, 480), Codec::H264 { crf: 18 })).unwrap();
    let grey = vec![128; 640 * 480 * 4];
    // The pipe holds some of it, whatever ffmpeg does; the end is told at the latest when the film is finished.
    let error = (0..10).find_map(|_| film.push(Picture::Rgba8(&grey)).err());
    let error = error.unwrap_or_else(|| film.finish().unwrap_err());
    let VideoError::Ffmpeg { words, status, .. } = &error else { panic!("{error}") };
    assert_eq!(words, "Unknown encoder libx264");
    assert!(status.contains('8'), "{status}");
    assert_eq!(names(folder.path()), [Path::new("ffmpeg")]);
}
