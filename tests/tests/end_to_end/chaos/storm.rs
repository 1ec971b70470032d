//! Many renderers in one folder, killed at random moments and started again, until all is made.
//!
//! `tests/chaos` runs the long one.

use std::io::{Read, Write};
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use super::watcher::Watcher;
use crate::turntable_bench::{Bench, assert_same, contents, files_below, is_hidden};

const PIPELINE: &str = "version: 1
groom: {sample: {style: wavy, strands: 40, points: 6}}
convert: [groom.txt, groom.hair]
lights: {environment: {constant: [1, 0.9, 0.8]}}
turntable: {frames: FRAMES}
render: {width: 24, height: 24, spp: SPP, max_bounces: 8, aovs: [R]}
tone: {frames: true}
sheet: {columns: 3, gap: 2}
";

/// Checkpoints as often as there can be one, so that kills hit them too.
const FLAGS: [&str; 4] = ["--threads", "1", "--checkpoint-every", "16spp"];

struct Storm {
    seed: u64,
    frames: u32,
    spp: u32,
    renderers: u32,
    /// Kills, or as many as come within the time.
    kills: u32,
    time: Option<Duration>,
}

/// What a storm did.
struct Told {
    kills: u32,
    runs: u32,
    reads: usize,
    checkpoints: usize,
}

impl Storm {
    fn pipeline(&self) -> String {
        PIPELINE.replace("FRAMES", &self.frames.to_string()).replace("SPP", &self.spp.to_string())
    }

    /// The same numbers for the same seed; when kills come is a matter of the machine all the same.
    fn random(&self, id: u32, purpose: &str) -> f64 {
        f64::from(groom::random(self.seed, id, purpose))
    }

    fn rage(&self) -> Told {
        let undisturbed = Bench::new(&self.pipeline());
        let start = Instant::now();
        undisturbed.make(&FLAGS);
        let alone = start.elapsed().as_secs_f64();
        let wanted = contents(&undisturbed.out());

        let bench = Bench::new(&self.pipeline());
        let watcher = Watcher::start(bench.out());
        let (kills, mut runs) = self.kill_and_kill(&bench, alone);
        // Nobody is killed any more: every renderer ends well, whatever the killed ones left.
        let children: Vec<Child> = (0..self.renderers).map(|_| start_one(&bench)).collect();
        runs += self.renderers;
        for child in children {
            let output = child.wait_with_output().unwrap();
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        }
        let seen = watcher.stop();
        assert!(seen.broken.is_empty(), "{} parts of files were seen: {:?}", seen.broken.len(), seen.broken);
        assert!(seen.whole > 0, "the reader saw nothing");
        // One more run, alone, has nothing to make, and sweeps.
        bench.make(&FLAGS);
        let check = bench.command(&["--check"]).output().unwrap();
        assert_eq!(check.status.code(), Some(0), "everything is up to date");
        assert_same(&contents(&bench.out()), &wanted);
        let left: Vec<_> = files_below(&bench.out()).into_iter().filter(|path| is_hidden(path)).collect();
        assert!(left.is_empty(), "left behind: {left:?}");
        Told { kills, runs: runs + 1, reads: seen.whole, checkpoints: seen.checkpoints }
    }

    /// Kills until there were enough; how many kills, and how many runs it took.
    fn kill_and_kill(&self, bench: &Bench, alone: f64) -> (u32, u32) {
        let start = Instant::now();
        let mut children: Vec<Child> = (0..self.renderers).map(|_| start_one(bench)).collect();
        let (mut kills, mut runs) = (0, self.renderers);
        let is_over = |kills: u32| self.time.map_or(kills >= self.kills, |time| start.elapsed() >= time);
        while !is_over(kills) {
            // A run alone takes `alone`; with so many at once each takes longer, and most die on the way.
            std::thread::sleep(Duration::from_secs_f64(alone * 0.5 * self.random(kills, "moment")));
            let victim = (self.random(kills, "victim") * f64::from(self.renderers)) as usize;
            let child = &mut children[victim.min(self.renderers as usize - 1)];
            let Some(status) = child.try_wait().unwrap() else {
                end(child);
                kills += 1;
                *child = start_one(bench);
                runs += 1;
                continue;
            };
            let mut words = String::new();
            child.stderr.as_mut().unwrap().read_to_string(&mut words).unwrap();
            assert!(status.success(), "a renderer gave up: {status}: {words}");
            // All is made. Once nobody is at it any more, a part of it goes, and all begin again.
            children.iter_mut().for_each(end);
            let frame = 1 + (self.random(kills, "frame") * f64::from(self.frames)) as u32;
            let _ = std::fs::remove_file(bench.out().join(format!("frames/frame.{frame:04}.exr")));
            children = (0..self.renderers).map(|_| start_one(bench)).collect();
            kills += self.renderers - 1;
            runs += self.renderers;
        }
        children.iter_mut().for_each(end);
        (kills + self.renderers, runs)
    }
}

/// With SIGKILL, if it has not ended.
fn end(child: &mut Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

fn start_one(bench: &Bench) -> Child {
    bench.command(&FLAGS).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

#[test]
fn killed_at_any_moment_and_never_part_of_a_file() {
    let storm = Storm { seed: 7, frames: 3, spp: 64, renderers: 3, kills: 24, time: None };
    let told = storm.rage();
    assert!(told.kills >= 24);
}

/// `CHAOS_MINUTES` minutes of it, from the seed `CHAOS_SEED`; `tests/chaos` starts it.
#[test]
#[ignore = "takes minutes; run tests/chaos"]
fn for_minutes() {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<f64>().ok());
    let minutes = number("CHAOS_MINUTES").unwrap_or(5.0);
    let first = number("CHAOS_SEED").unwrap_or(1.0) as u64;
    let start = Instant::now();
    let mut sum = Told { kills: 0, runs: 0, reads: 0, checkpoints: 0 };
    for round in 0.. {
        let storm = Storm {
            seed: first + round,
            frames: 4 + (round % 5) as u32,
            spp: [64, 160, 32][round as usize % 3],
            renderers: 2 + (round % 4) as u32,
            kills: 0,
            time: Some(Duration::from_secs(20)),
        };
        let told = storm.rage();
        sum.kills += told.kills;
        sum.runs += told.runs;
        sum.reads += told.reads;
        sum.checkpoints += told.checkpoints;
        say(&format!(
            "seed {}: {} renderers, {} kills, {} runs, {} files read whole",
            storm.seed, storm.renderers, told.kills, told.runs, told.reads
        ));
        if start.elapsed().as_secs_f64() > minutes * 60.0 {
            break;
        }
    }
    let Told { kills, runs, reads, checkpoints } = sum;
    let seconds = start.elapsed().as_secs_f64();
    say(&format!(
        "{kills} kills, {runs} runs, {reads} files read whole ({checkpoints} of them checkpoints), none broken, every \
         frame bit for bit as undisturbed, {seconds:.0} s"
    ));
}

/// On the real stderr: the test harness hides what `eprintln!` prints.
fn say(line: &str) {
    let _ = std::io::stderr().write_all(format!("{line}\n").as_bytes());
}
