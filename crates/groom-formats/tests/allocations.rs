//! No reader takes more memory than four times the file beside the file itself, whatever the file says of
//! itself: a byte that becomes a number of four is the most a sound file asks for.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests

mod support;

use glam::Vec3;
use groom::{Domain, Groom, Values, names};
use groom_formats::{
    Format, Frame, MotionOptions, ReadOptions, WriteOptions, read_from, read_moving, write_animation,
};
use peak_alloc::PeakAlloc;
use support::{set, to_bytes};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// What messages, headers and small tables may take beside.
const BESIDE: usize = 32 << 10;

/// Reads `bytes`, whatever comes of it, and holds the memory it took at most against them.
///
/// The copy of the file that a reader makes comes on top.
fn check(format: Format, bytes: &[u8], what: &str) {
    let options = ReadOptions { known_len: Some(bytes.len() as u64), ..ReadOptions::default() };
    MEMORY.reset_peak_usage();
    let before = MEMORY.current_usage();
    let result = read_from(format, bytes, what, &options);
    let peak = MEMORY.peak_usage().saturating_sub(before);
    let most = bytes.len() + 4 * bytes.len() + BESIDE;
    let was = if result.is_ok() { "read" } else { "refused" };
    assert!(peak <= most, "{format}, {what}: {was}, {peak} bytes for a file of {}", bytes.len());
}

/// A groom of `strands` strands of `points` points with radii and colours at the points.
fn groom(strands: u32, points: u32) -> Groom {
    let positions = (0..strands * points).map(|i| Vec3::new(i as f32, 0.5, 0.25)).collect();
    let mut groom = Groom::new((0..=strands).map(|i| i * points).collect(), positions).unwrap();
    let count = groom.point_count();
    set(&mut groom, names::RADIUS, Domain::Vertex, Values::Float(vec![0.125; count]));
    set(&mut groom, names::COLOR, Domain::Vertex, Values::Vec3(vec![Vec3::splat(0.3); count]));
    groom
}

const GOLDEN: [(Format, &[u8]); 9] = [
    (Format::Data, include_bytes!("golden/lock.data")),
    (Format::Ct2Hair, include_bytes!("golden/lock.bin")),
    (Format::MonoHair, include_bytes!("golden/monohair.hair")),
    (Format::Tfx, include_bytes!("golden/v3.tfx")),
    (Format::Tfx, include_bytes!("golden/v4.tfx")),
    (Format::Ply, include_bytes!("golden/little.ply")),
    (Format::Ply, include_bytes!("golden/big.ply")),
    (Format::Ply, include_bytes!("golden/ascii.ply")),
    (Format::Ply, include_bytes!("golden/edges.ply")),
];

/// Each of `files` with a large number at every byte.
fn lies() {
    for (format, bytes) in GOLDEN {
        check(format, bytes, "as it is");
        for at in 0..bytes.len().saturating_sub(4) {
            for value in [u32::MAX, 1 << 31, i32::MAX as u32, 1 << 24, 0x0000_0100] {
                for value in [value.to_le_bytes(), value.to_be_bytes()] {
                    let mut lie = bytes.to_vec();
                    lie[at..at + 4].copy_from_slice(&value);
                    check(format, &lie, "a large number in it");
                }
            }
        }
    }
    let head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    for count in ["4294967295", "18446744073709551615", "2000000000"] {
        let text =
            format!("{head}element strand {count}\nproperty uchar nsegs\nend_header\n0 0 0 1 1 1 2 2 2 2\n");
        check(Format::Ply, text.as_bytes(), "many strands");
        let text = format!("{head}element nothing {count}\nend_header\n0 0 0 1 1 1 2 2 2 2\n");
        check(Format::Ply, text.as_bytes(), "many rows of nothing");
    }
}

/// Large files that are sound.
fn sound() {
    for (strands, points) in [(100, 200), (10_000, 2)] {
        let groom = groom(strands, points);
        for format in [Format::Data, Format::Ply, Format::Obj] {
            check(format, &to_bytes(format, &groom).unwrap().0, "sound");
        }
    }
}

/// Files made to take much for little.
fn greedy() {
    let points = 20_000;
    let shortest = format!(
        "{}l{}\n",
        "v 0 0 0\n".repeat(points),
        (1..=points).map(|i| format!(" {i}")).collect::<String>()
    );
    check(Format::Obj, shortest.as_bytes(), "short numbers");
    check(Format::Obj, format!("v 0 0 0\nl{}\n", " 1".repeat(points)).as_bytes(), "one vertex over and over");
    check(Format::Obj, format!("v 0 0 0\n{}", "l 1 1\n".repeat(points)).as_bytes(), "lines over and over");
    let twice = format!("{}l{}\n", "v 0 0 0\n".repeat(points), " 1".repeat(2 * points));
    check(Format::Obj, twice.as_bytes(), "vertices used twice");
    let bytes: String = (0..40).map(|i| format!("property uchar p{i}\n")).collect();
    let mut ply = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {points}\nproperty float x\nproperty float y\n\
         property float z\n{bytes}element strand {points}\nproperty uchar nsegs\nend_header\n"
    )
    .into_bytes();
    ply.resize(ply.len() + points * (12 + 40) + points, 0);
    check(Format::Ply, &ply, "one point a strand, forty bytes at each");
    let empty =
        [&(points as i32).to_le_bytes()[..], &vec![0; 4 * (points - 1)], &1_i32.to_le_bytes(), &[0; 12]]
            .concat();
    check(Format::Data, &empty, "empty strands");
}

/// Frames on their way into a file and out of it: as many again take no more memory.
fn motion() {
    let folder = tempfile::tempdir().unwrap();
    let groom = groom(100, 200);
    for ending in ["usda", "usdc", "usdz", "abc", "glb"] {
        let path = folder.path().join(format!("a.{ending}"));
        let write = |count: u32| {
            let mut frames = (0..count).map(|frame| {
                let moved = |p: &Vec3| *p + Vec3::new(p.x.sin(), 1.0, 0.0) * frame as f32;
                let positions: Vec<Vec3> = groom.positions().iter().map(moved).collect();
                let velocities = Some(positions.clone());
                Ok(Frame { time: frame.into(), positions, velocities, ..Frame::default() })
            });
            MEMORY.reset_peak_usage();
            let before = MEMORY.current_usage();
            let motion = MotionOptions::at_rate(24.0);
            write_animation(&groom, &mut frames, &motion, &path, &WriteOptions::default()).unwrap();
            MEMORY.peak_usage().saturating_sub(before)
        };
        let (few, many) = (write(4), write(40));
        // A frame's description in the document of a glTF takes a kilobyte; the frame itself, 240.
        let described = if ending == "glb" { 36 << 10 } else { 0 };
        assert!(many <= few + BESIDE + described, "{ending}: {few} bytes for 4 frames, {many} for 40");
        if ending == "glb" {
            continue;
        }
        let moving = read_moving(&path, &ReadOptions::default()).unwrap();
        let read = |frames: u32| {
            MEMORY.reset_peak_usage();
            let before = MEMORY.current_usage();
            for frame in 0..frames {
                assert_eq!(moving.at(f64::from(frame) + 0.5).unwrap().positions.len(), groom.point_count());
            }
            MEMORY.peak_usage().saturating_sub(before)
        };
        let (few, many) = (read(4), read(39));
        assert!(many <= few + BESIDE, "{ending}: {few} bytes for reading 4 frames, {many} for 39");
    }
}

// One test: the allocator counts for the whole process.
#[test]
fn memory_keeps_to_four_times_the_file() {
    lies();
    sound();
    greedy();
    motion();
}
