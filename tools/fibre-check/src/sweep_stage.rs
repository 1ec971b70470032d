//! What sweeps and colours are looked at on, and how they tell how far they are.

use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};

use anyhow::Result;
use command_line::Bar;
use groom_formats::ReadOptions;
use groom_samples::{Options, Style};
use hair_render::Progress;
use look_sweep::Stage;

/// Strands of the built-in groom: enough that it is a sheet of hair and not a veil.
const STRANDS: u32 = 20_000;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Groom")]
pub struct GroomArgs {
    /// The groom to look at: any format groomkit reads [default: the built-in straight sample]
    #[arg(long, value_name = "FILE")]
    pub groom: Option<PathBuf>,
}

impl GroomArgs {
    /// What is looked at, in words.
    pub fn title(&self) -> String {
        match &self.groom {
            Some(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            None => format!("Built-in straight hair, {STRANDS} strands"),
        }
    }

    /// The groom in the studio.
    pub fn stage(&self) -> Result<Stage> {
        let groom = match &self.groom {
            Some(path) => groom_formats::read(path, &ReadOptions::default())?.groom,
            None => groom_samples::hair(&Options {
                style: Style::Straight,
                strands: STRANDS,
                points: 24,
                ..Options::default()
            })?,
        };
        Ok(Stage::new(groom)?)
    }
}

/// Shows work of several parts on one bar, and stops on Ctrl-C.
pub struct OnBar {
    bar: Bar,
    whole: AtomicU64,
}

/// Units of the bar each part takes.
const PART: u64 = 1000;

impl OnBar {
    /// A bar for `parts` parts.
    pub fn new(label: &str, parts: u64) -> OnBar {
        OnBar { bar: command_line::progress_bar(parts * PART, label), whole: AtomicU64::new(0) }
    }

    pub fn label(&self, label: &str) {
        self.bar.set_label(label);
    }

    pub fn finish(&self) {
        self.bar.finish();
    }
}

impl Progress for OnBar {
    fn advance(&self, done: u64, total: u64) {
        let whole = if done >= total {
            self.whole.fetch_add(1, Ordering::Relaxed) + 1
        } else {
            self.whole.load(Ordering::Relaxed)
        };
        let part = if done >= total { 0 } else { done * PART / total.max(1) };
        self.bar.set(whole * PART + part);
    }

    fn cancelled(&self) -> bool {
        command_line::interrupted()
    }
}
