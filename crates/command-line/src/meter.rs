//! How far the work is, told to a person or to a farm.

use std::io::Write;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use clap::ValueEnum;

use crate::progress::{Bar, progress_bar};

/// Whom progress is told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum ProgressStyle {
    /// A person: a bar on stderr, if that is a terminal.
    #[default]
    Bar,
    /// Tractor and what reads its lines: `ALF_PROGRESS 34%` on stdout.
    Alf,
    /// Open Job Description: `openjd_progress: 34.0` and `openjd_status: WORDS` on stdout.
    Openjd,
    /// A program: one JSON object a line on stdout.
    Json,
}

/// Farms read every line: at most one in this time.
const PAUSE: Duration = Duration::from_millis(500);

/// A bar's units.
const WHOLE: u64 = 10_000;

/// Progress of one run. May be told from any thread and out of order: what is passed on only rises, and not more
/// often than twice a second.
#[derive(Debug)]
pub struct Meter {
    style: ProgressStyle,
    bar: Bar,
    told: Mutex<Told>,
}

/// What was said last.
#[derive(Debug, Default)]
struct Told {
    /// 0..=1, as far as work went.
    share: f64,
    /// Of it, what the last line said.
    said: Option<f64>,
    at: Option<Instant>,
    status: String,
    left: Option<Duration>,
}

impl Meter {
    /// Nothing done yet of the work called `label`.
    #[must_use]
    pub fn new(style: ProgressStyle, label: &str) -> Meter {
        let told = Mutex::new(Told { status: label.to_owned(), ..Told::default() });
        Meter { style, bar: progress_bar(WHOLE, label), told }
    }

    /// Says that `share` (0..=1) of all work is done. Less than what was told before is ignored.
    pub fn advance(&self, share: f64) {
        // Held while the line goes out: another thread's must not come between.
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        print(&told.advance(self.style, share, Instant::now()));
        if self.style == ProgressStyle::Bar {
            self.bar.set((told.share * WHOLE as f64) as u64);
        }
    }

    /// Says what is being done now.
    pub fn status(&self, words: &str) {
        print(&self.told.lock().unwrap_or_else(PoisonError::into_inner).status(self.style, words));
        self.bar.set_label(words);
    }

    /// Says how long it is likely to take from here; told with the next line.
    pub fn left(&self, left: Duration) {
        self.told.lock().unwrap_or_else(PoisonError::into_inner).left = Some(left);
        self.bar.set_left(&format!(", about {} left", in_words(left)));
    }

    /// Prints a line for people, on stderr.
    pub fn say(&self, line: &str) {
        self.bar.say(line);
    }

    /// Says that the work failed, to whom a line on stderr says nothing.
    pub fn fail(&self, words: &str) {
        print(&failed(self.style, words));
    }

    /// Takes the bar off the terminal.
    pub fn finish(&self) {
        self.bar.finish();
    }
}

impl Told {
    fn advance(&mut self, style: ProgressStyle, share: f64, now: Instant) -> Vec<String> {
        if share > self.share {
            self.share = share.min(1.0); // never true of a NaN
        }
        let is_done = self.share == 1.0;
        let is_due = self.at.is_none_or(|at| now.saturating_duration_since(at) >= PAUSE);
        // Tractor knows whole percents only.
        let step = if style == ProgressStyle::Alf { 0.01 } else { 0.001 };
        let shown = |share: f64| (share / step + 1e-9).floor() as i64;
        if style == ProgressStyle::Bar
            || !(is_due || is_done)
            || self.said.is_some_and(|said| shown(said) == shown(self.share))
        {
            return Vec::new();
        }
        self.said = Some(self.share);
        self.at = Some(now);
        let percent = shown(self.share) as f64 * step * 100.0;
        vec![match style {
            ProgressStyle::Bar => return Vec::new(),
            ProgressStyle::Alf => format!("ALF_PROGRESS {percent:.0}%"),
            ProgressStyle::Openjd => format!("openjd_progress: {percent:.1}"),
            ProgressStyle::Json => {
                let mut line = serde_json::json!({ "progress": (percent * 10.0).round() / 10.0 });
                line["status"] = self.status.as_str().into();
                if let Some(left) = self.left {
                    line["seconds_left"] = left.as_secs().into();
                }
                line.to_string()
            }
        }]
    }

    fn status(&mut self, style: ProgressStyle, words: &str) -> Vec<String> {
        if self.status == words {
            return Vec::new();
        }
        words.clone_into(&mut self.status);
        match style {
            ProgressStyle::Openjd => vec![format!("openjd_status: {}", one_line(words))],
            // JSON lines carry it with the next figure, Tractor has no words for it.
            _ => Vec::new(),
        }
    }
}

fn failed(style: ProgressStyle, words: &str) -> Vec<String> {
    match style {
        ProgressStyle::Bar | ProgressStyle::Alf => Vec::new(),
        ProgressStyle::Openjd => vec![format!("openjd_fail: {}", one_line(words))],
        ProgressStyle::Json => vec![serde_json::json!({ "fail": words }).to_string()],
    }
}

/// A farm takes a second line for something else.
fn one_line(words: &str) -> String {
    words.lines().map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>().join("; ")
}

fn in_words(left: Duration) -> String {
    let seconds = left.as_secs();
    match seconds {
        0..100 => format!("{seconds} s"),
        100..6000 => format!("{} min", (seconds + 30) / 60),
        _ => format!("{:.1} h", seconds as f64 / 3600.0),
    }
}

fn print(lines: &[String]) {
    let mut stdout = std::io::stdout().lock();
    for line in lines {
        // A farm that does not listen any more is no reason to stop.
        let _ = writeln!(stdout, "{line}").and_then(|()| stdout.flush());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lines for shares told so many milliseconds after the first.
    fn lines(style: ProgressStyle, told: &[(u64, f64)]) -> Vec<String> {
        let (mut state, start) = (Told::default(), Instant::now());
        told.iter()
            .flat_map(|&(after, share)| state.advance(style, share, start + Duration::from_millis(after)))
            .collect()
    }

    #[test]
    fn every_style_says_it_as_its_readers_want_it() {
        let told = [(0, 0.0), (1000, 0.3456), (2000, 1.0)];
        assert!(lines(ProgressStyle::Bar, &told).is_empty());
        assert_eq!(
            lines(ProgressStyle::Alf, &told),
            ["ALF_PROGRESS 0%", "ALF_PROGRESS 34%", "ALF_PROGRESS 100%"]
        );
        assert_eq!(
            lines(ProgressStyle::Openjd, &told),
            ["openjd_progress: 0.0", "openjd_progress: 34.5", "openjd_progress: 100.0"]
        );
        let json = lines(ProgressStyle::Json, &told);
        let read =
            |line: &String| serde_json::from_str::<serde_json::Value>(line).unwrap()["progress"].clone();
        assert_eq!(json.iter().map(read).collect::<Vec<_>>(), [0.0, 34.5, 100.0]);
    }

    #[test]
    fn lines_rise_and_do_not_come_too_often() {
        let told: Vec<(u64, f64)> =
            (0..10_000).map(|i| (i, ((i * 7919) % 10_000) as f64 / 10_000.0)).collect();
        for style in [ProgressStyle::Alf, ProgressStyle::Openjd] {
            let lines = lines(style, &told);
            let number = |line: &String| {
                let digits: String = line.chars().filter(|c| c.is_ascii_digit() || *c == '.').collect();
                digits.parse::<f64>().unwrap()
            };
            let figures: Vec<f64> = lines.iter().map(number).collect();
            assert!(figures.windows(2).all(|w| w[0] < w[1]), "{figures:?}");
            assert!((2..=21).contains(&lines.len()), "{} lines in 10 s", lines.len());
        }
        // The end is told however soon it comes, and once.
        let ended =
            lines(ProgressStyle::Openjd, &[(0, 0.5), (1, 1.0), (2, 1.0), (900, 1.0), (901, f64::NAN)]);
        assert_eq!(ended, ["openjd_progress: 50.0", "openjd_progress: 100.0"]);
    }

    #[test]
    fn words_stay_on_one_line_and_are_not_repeated() {
        let mut told = Told::default();
        assert_eq!(told.status(ProgressStyle::Openjd, "frame\n 1/2"), ["openjd_status: frame; 1/2"]);
        assert!(told.status(ProgressStyle::Openjd, "frame\n 1/2").is_empty());
        assert!(told.status(ProgressStyle::Alf, "frame 2/2").is_empty());
        assert_eq!(failed(ProgressStyle::Openjd, "no\nlight"), ["openjd_fail: no; light"]);
        assert_eq!(failed(ProgressStyle::Json, "no\nlight"), [r#"{"fail":"no\nlight"}"#]);
    }

    #[test]
    fn times_are_told_as_people_do() {
        for (seconds, words) in [(0, "0 s"), (99, "99 s"), (100, "2 min"), (5999, "100 min"), (9000, "2.5 h")]
        {
            assert_eq!(in_words(Duration::from_secs(seconds)), words);
        }
    }
}
