//! Renders that are stopped and taken up again, crops, and files that were damaged in between.

use std::path::Path;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

use crate::common::*;
use exr::prelude::read_first_flat_layer_from_file;
use glam::Vec3;
use hair_render::*;
use proptest::prelude::*;

fn stage() -> Scene {
    let lights = vec![];
    scene(vec![hair(tuft(60, 0.03), blond())], Some(Environment::studio(64).unwrap()), lights)
}

/// 3 whole passes and one of 5 samples, in an odd size.
fn asked() -> RenderSettings {
    RenderSettings { width: 37, height: 21, aovs: AovSet::all(), ..settings(1, 3 * PASS_SPP + 5) }
}

/// Stops after so many passes, or in the middle of one after so many tiles.
struct Stop {
    passes: AtomicU32,
    tiles: AtomicU64,
}

impl Stop {
    fn after_passes(passes: u32) -> Self {
        Stop { passes: passes.into(), tiles: u64::MAX.into() }
    }

    fn after_tiles(tiles: u64) -> Self {
        Stop { passes: u32::MAX.into(), tiles: tiles.into() }
    }
}

impl Progress for Stop {
    fn advance(&self, done: u64, total: u64) {
        assert!(done <= total);
        self.tiles.fetch_sub(1, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.tiles.load(Ordering::Relaxed) == 0
    }

    fn pass_done(&self, so_far: &SoFar<'_>) -> Next {
        assert!(so_far.spp().is_multiple_of(PASS_SPP) && so_far.spp() < so_far.spp_asked());
        let left = self.passes.fetch_sub(1, Ordering::Relaxed);
        if left == 1 { Next::Stop } else { Next::GoOn }
    }
}

fn begin(
    scene: &Scene,
    settings: &RenderSettings,
    start: Option<Checkpoint>,
    stop: &dyn Progress,
) -> Result<Rendered, RenderError> {
    render_from(scene, &front(scene).into(), settings, "digest 1", start, stop)
}

fn stopped(scene: &Scene, settings: &RenderSettings, start: Option<Checkpoint>, stop: &Stop) -> Checkpoint {
    match begin(scene, settings, start, stop).unwrap() {
        Rendered::Stopped(checkpoint) => checkpoint,
        Rendered::Done(_) => unreachable!("it was not stopped"),
    }
}

fn done(scene: &Scene, settings: &RenderSettings, start: Option<Checkpoint>) -> Frame {
    match begin(scene, settings, start, &Silent).unwrap() {
        Rendered::Done(frame) => frame,
        Rendered::Stopped(_) => unreachable!("nobody stopped it"),
    }
}

/// Written to a file and read from it.
fn by_file(checkpoint: &Checkpoint, folder: &Path) -> Checkpoint {
    let path = folder.join("part.exr");
    checkpoint.write(&path).unwrap();
    let read = Checkpoint::read(&path).unwrap();
    assert!(read == *checkpoint, "a checkpoint comes back as it was");
    read
}

/// Everything but what hangs on the clock and the threads.
fn assert_same(found: &Frame, expected: &Frame) {
    let bits = |pixels: &[Vec3]| pixels.iter().map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    assert_eq!(bits(&found.beauty), bits(&expected.beauty));
    assert_eq!(found.alpha, expected.alpha);
    assert_eq!(found.passes.len(), expected.passes.len());
    for ((aov, pass), (other, expected)) in found.passes.iter().zip(&expected.passes) {
        assert_eq!((aov, bits(pass)), (other, bits(expected)));
    }
    let untimed = |frame: &Frame| FrameReport { seconds: 0.0, threads: 0, ..frame.report.clone() };
    assert_eq!(untimed(found), untimed(expected));
}

#[test]
fn a_render_stopped_after_any_pass_has_the_bits_of_one_that_was_not() {
    let (scene, settings) = (stage(), asked());
    let folder = tempfile::tempdir().unwrap();
    let undisturbed = render(&scene, &front(&scene), &settings, &Silent).unwrap();
    for passes in 1..=3 {
        for threads in [1, 3] {
            let settings = RenderSettings { threads: Some(threads), ..settings.clone() };
            let checkpoint = stopped(&scene, &settings, None, &Stop::after_passes(passes));
            assert_eq!((checkpoint.spp(), checkpoint.digest()), (passes * PASS_SPP, "digest 1"));
            let settings = RenderSettings { threads: Some(4 - threads), ..settings };
            let frame = done(&scene, &settings, Some(by_file(&checkpoint, folder.path())));
            assert_same(&frame, &undisturbed);
            assert!(frame.report.seconds > checkpoint.seconds());
        }
    }
}

#[test]
fn a_render_stopped_in_mid_pass_again_and_again_has_the_same_bits() {
    let (scene, settings) = (stage(), asked());
    let folder = tempfile::tempdir().unwrap();
    let undisturbed = render(&scene, &front(&scene), &settings, &Silent).unwrap();
    // 3 x 2 tiles and 4 passes: each start finishes a tile or more, so it ends.
    let (mut checkpoint, mut starts) = (None, 0);
    let frame = loop {
        let settings = RenderSettings { threads: Some(1 + starts % 3), ..settings.clone() };
        match begin(&scene, &settings, checkpoint.take(), &Stop::after_tiles(1)).unwrap() {
            Rendered::Done(frame) => break frame,
            Rendered::Stopped(found) => checkpoint = Some(by_file(&found, folder.path())),
        }
        starts += 1;
        assert!(starts <= 24);
    };
    assert!(starts >= 7, "{starts}");
    assert_same(&frame, &undisturbed);
}

#[test]
fn fewer_samples_than_a_pass_and_none_at_all() {
    let scene = stage();
    let settings = RenderSettings { spp: 3, ..asked() };
    let undisturbed = render(&scene, &front(&scene), &settings, &Silent).unwrap();
    let checkpoint = stopped(&scene, &settings, None, &Stop::after_tiles(0));
    assert_eq!((checkpoint.spp(), checkpoint.frame().report.rel_mse), (0, None));
    assert!(checkpoint.frame().alpha.iter().all(|&alpha| alpha == 0.0));
    let folder = tempfile::tempdir().unwrap();
    assert_same(&done(&scene, &settings, Some(by_file(&checkpoint, folder.path()))), &undisturbed);
}

/// The picture of a checkpoint is the one of so many samples: its halves are those of a shorter render.
#[test]
fn a_checkpoint_is_a_picture_with_an_honest_error() {
    let (scene, long) = (stage(), asked());
    let checkpoint = stopped(&scene, &long, None, &Stop::after_passes(2));
    let short = RenderSettings { spp: 2 * PASS_SPP, ..long };
    let expected = render(&scene, &front(&scene), &short, &Silent).unwrap();
    assert_same(&checkpoint.frame(), &expected);
    // And any viewer shows it.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.exr");
    checkpoint.write(&path).unwrap();
    let image = read_first_flat_layer_from_file(&path).unwrap();
    let red = image.layer_data.channel_data.list.iter().find(|c| c.name == *"R").unwrap();
    let red: Vec<f32> = red.sample_data.values_as_f32().collect();
    assert_eq!(red, expected.beauty.iter().map(|b| b.x).collect::<Vec<_>>());
}

#[test]
fn crops_are_parts_of_the_whole() {
    let (scene, whole_settings) = (stage(), RenderSettings { spp: 20, ..asked() });
    let camera = front(&scene);
    let whole = render(&scene, &camera, &whole_settings, &Silent).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let mut pixels = 0;
    let cuts = [0.0, 0.3, 0.55, 1.0];
    for (x0, x1) in [(cuts[0], cuts[1]), (cuts[1], cuts[2]), (cuts[2], cuts[3])] {
        for (y0, y1) in [(0.0, 0.4), (0.4, 1.0)] {
            let settings = RenderSettings { crop: Some(Crop { x0, x1, y0, y1 }), ..whole_settings.clone() };
            let part = render(&scene, &camera, &settings, &Silent).unwrap();
            let cutout = part.cutout.unwrap();
            assert_eq!((cutout.full_width, cutout.full_height), (whole.width, whole.height));
            for (i, &beauty) in part.beauty.iter().enumerate() {
                let (x, y) = (i as u32 % part.width + cutout.x, i as u32 / part.width + cutout.y);
                let at = (y * whole.width + x) as usize;
                assert_eq!((beauty, part.alpha[i]), (whole.beauty[at], whole.alpha[at]));
                assert_eq!(part.passes[1].1[i], whole.passes[1].1[at]);
            }
            pixels += part.beauty.len();
            let path = folder.path().join("crop.exr");
            part.write_exr(&path, &Metadata { camera: Some(camera), ..Metadata::default() }).unwrap();
            assert_eq!(Frame::read_exr(&path).unwrap().0, part);
            let image = read_first_flat_layer_from_file(&path).unwrap();
            let position = image.layer_data.attributes.layer_position;
            assert_eq!((position.x(), position.y()), (cutout.x as i32, cutout.y as i32));
            let display = image.attributes.display_window;
            assert_eq!((display.size.width(), display.size.height()), (37, 21));
            // A crop is stopped and taken up like a whole picture.
            let checkpoint = stopped(&scene, &settings, None, &Stop::after_passes(1));
            assert_same(&done(&scene, &settings, Some(by_file(&checkpoint, folder.path()))), &part);
        }
    }
    assert_eq!(pixels, whole.beauty.len());
}

#[test]
fn a_checkpoint_of_another_picture_is_refused() {
    let (scene, settings) = (stage(), asked());
    let checkpoint = || stopped(&scene, &settings, None, &Stop::after_passes(1));
    let crop = Some(Crop { x0: 0.0, x1: 0.5, y0: 0.0, y1: 1.0 });
    for (other, says) in [
        (RenderSettings { seed: 1, ..settings.clone() }, "seed is 0, expected 1"),
        (RenderSettings { spp: 64, ..settings.clone() }, "number of samples is 53, expected 64"),
        (RenderSettings { width: 40, ..settings.clone() }, "size is 37 x 21"),
        (RenderSettings { crop, ..settings.clone() }, "size is 37 x 21"),
        (RenderSettings { aovs: AovSet::none(), ..settings.clone() }, "set of passes is R,TT"),
    ] {
        let refused = begin(&scene, &other, Some(checkpoint()), &Silent).unwrap_err().to_string();
        assert!(refused.contains(says), "{refused}");
    }
    let other =
        render_from(&scene, &front(&scene).into(), &settings, "digest 2", Some(checkpoint()), &Silent);
    assert!(matches!(other, Err(RenderError::OtherCheckpoint { what: "digest", .. })));
}

/// A small checkpoint and a small frame as files, to be broken.
fn bytes() -> &'static [Vec<u8>; 2] {
    static BYTES: std::sync::OnceLock<[Vec<u8>; 2]> = std::sync::OnceLock::new();
    BYTES.get_or_init(|| {
        let (scene, folder) = (stage(), tempfile::tempdir().unwrap());
        let settings = RenderSettings { width: 18, height: 19, spp: 40, ..settings(1, 1) }.with_aov(Aov::Tt);
        let (part, whole) = (folder.path().join("part.exr"), folder.path().join("whole.exr"));
        stopped(&scene, &settings, None, &Stop::after_passes(1)).write(&part).unwrap();
        let frame = done(&scene, &settings, None);
        frame.write_exr(&whole, &Metadata { digest: "d".into(), ..Metadata::default() }).unwrap();
        [part, whole].map(|path| std::fs::read(path).unwrap())
    })
}

/// Reads a broken checkpoint and a broken frame: neither may end the program.
fn read_both(path: &Path, broken: &[u8]) -> (Result<Checkpoint, RenderError>, Result<Frame, RenderError>) {
    std::fs::write(path, broken).unwrap();
    (Checkpoint::read(path), Frame::read_exr(path).map(|(frame, _)| frame))
}

#[test]
fn files_cut_short_and_files_of_another_kind_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.exr");
    let [part, whole] = bytes();
    let (whole_as_part, frame) = read_both(&path, whole);
    assert!(frame.is_ok());
    assert!(whole_as_part.unwrap_err().to_string().contains("no attribute `checkpoint`"));
    assert!(read_both(&path, part).0.is_ok());
    for file in [part, whole] {
        for cut in (0..file.len()).step_by(41).chain([file.len() - 1]) {
            let (a, b) = read_both(&path, &file[..cut]);
            for error in [a.map(drop), b.map(drop)].map(Result::unwrap_err) {
                assert!(error.to_string().contains("broken.exr"), "{error}");
            }
        }
    }
    for other in [&b""[..], b"PNG", &[0x76, 0x2f, 0x31, 0x01]] {
        let (a, b) = read_both(&path, other);
        assert!(a.is_err() && b.is_err());
    }
    let missing = Checkpoint::read(&folder.path().join("none.exr"));
    assert!(matches!(missing, Err(RenderError::Io { .. })));
}

/// A header of 65536 x 65536 pixels in a small file must not take the memory for them.
#[test]
fn pictures_larger_than_their_file_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.exr");
    for file in bytes() {
        let name = b"dataWindow\0box2i\0\x10\0\0\0";
        let at = file.windows(name.len()).position(|w| w == name).unwrap() + name.len();
        let mut huge = file.clone();
        huge[at + 8..at + 16].copy_from_slice(&[0xff, 0xff, 0, 0, 0xff, 0xff, 0, 0]);
        let (a, b) = read_both(&path, &huge);
        for error in [a.map(drop), b.map(drop)].map(Result::unwrap_err) {
            assert!(error.to_string().contains("broken.exr"), "{error}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    /// Whatever bytes are changed: an error or a value, and never sums that nobody wrote.
    #[test]
    fn changed_bytes_end_nothing_and_change_no_sum(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
        header_only in any::<bool>(),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("broken.exr");
        std::fs::write(&path, &bytes()[0]).unwrap();
        let sound = Checkpoint::read(&path).unwrap();
        for file in bytes() {
            let mut broken = file.clone();
            let reach = if header_only { 1500.min(broken.len()) } else { broken.len() };
            for (at, byte) in &changes {
                broken[at.index(reach)] = *byte;
            }
            let (part, _) = read_both(&path, &broken);
            if let Ok(part) = part {
                prop_assert_eq!(part.frame().beauty, sound.frame().beauty.clone());
            }
        }
    }
}
