//! What is to be rendered, before any farm's words for it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::FarmError;

/// A turntable to be rendered in pieces by many machines that see the same files.
#[derive(Clone, Debug, PartialEq)]
pub struct FarmJob {
    /// What people call it.
    pub name: String,
    /// The program and what comes before the pipeline: `turntable`, or `apptainer exec hair.sif turntable`.
    pub command: Vec<String>,
    /// The pipeline, from the root.
    pub pipeline: PathBuf,
    /// The output folder, from the root; every machine must see it there.
    pub output: PathBuf,
    /// Words that every step gets: `--set`, `render.spp=64`.
    pub settings: Vec<String>,
    /// What is rendered of every frame; empty when there is but one thing.
    pub variants: Vec<JobVariant>,
    /// Frame numbers, rising.
    pub frames: Vec<u32>,
    /// Files that tasks read beside the pipeline, from the root.
    pub inputs: Vec<PathBuf>,
    /// Folders whose files they read, from the root.
    pub input_folders: Vec<PathBuf>,
    /// Words of the step that runs once before all frames, if there is one.
    pub prepare: Option<Vec<String>>,
    /// Words of every task of frames.
    pub render: Vec<String>,
    /// Words by which the program ends well only when all frames are there, where it has such: it knows better than
    /// the scheduler.
    pub done: Option<Vec<String>>,
    /// What runs when the frames are there, each once.
    pub after: Vec<AfterStep>,
    /// Frames a task. A task loads the groom and builds its trees once; [`frames_a_task`] picks one.
    pub chunk: u32,
    /// Seconds a frame takes, where it is known.
    pub seconds_a_frame: Option<f64>,
}

/// One combination of the settings of a pipeline's axes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JobVariant {
    /// What it is called: `smooth/sky`.
    pub id: String,
    /// Axis and setting, in the order of the axes.
    pub axes: Vec<(String, String)>,
}

/// A step after the frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AfterStep {
    /// What farms show: `ContactSheet`.
    pub name: String,
    /// Its words, after the settings that every step gets.
    pub words: Vec<String>,
    /// When it runs.
    pub when: When,
}

/// When a step after the frames runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// When every frame is there.
    AllDone,
    /// When the frames and the steps before it have ended, well or not. Open Job Description has no such
    /// dependency and is not told of these.
    Ended,
}

/// The most frames that [`frames_a_task`] puts into one task.
pub const MOST_FRAMES_A_TASK: u32 = 10;

/// What a task should take, seconds: far more than it takes to start one (0.02 to 0.4 s on the engines that were
/// tried) and to load a groom, far less than people wait for.
const TASK_SECONDS: f64 = 300.0;

/// Frames a task, 2 to 10: as many as five minutes hold, or 4 where nobody knows how long a frame takes.
#[must_use]
pub fn frames_a_task(seconds_a_frame: Option<f64>) -> u32 {
    let fitting =
        |seconds: f64| (TASK_SECONDS / seconds.max(0.001)).min(f64::from(MOST_FRAMES_A_TASK)) as u32;
    seconds_a_frame.map_or(4, |seconds| fitting(seconds).max(2))
}

/// One task: a variant and some of its frames.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Task<'a> {
    pub variant: Option<&'a JobVariant>,
    pub frames: &'a [u32],
}

impl FarmJob {
    /// A job of one variant, rendered by `turntable`, with nothing before or after its frames.
    pub fn new(
        name: impl Into<String>,
        pipeline: impl Into<PathBuf>,
        output: impl Into<PathBuf>,
        frames: impl IntoIterator<Item = u32>,
    ) -> FarmJob {
        FarmJob {
            name: name.into(),
            command: vec!["turntable".into()],
            pipeline: pipeline.into(),
            output: output.into(),
            settings: Vec::new(),
            variants: Vec::new(),
            frames: frames.into_iter().collect(),
            inputs: Vec::new(),
            input_folders: Vec::new(),
            prepare: None,
            render: Vec::new(),
            done: None,
            after: Vec::new(),
            chunk: frames_a_task(None),
            seconds_a_frame: None,
        }
    }

    /// The same with `chunk` frames a task.
    #[must_use]
    pub fn with_chunk(self, chunk: u32) -> FarmJob {
        FarmJob { chunk, ..self }
    }

    /// The same with one more step after the frames.
    #[must_use]
    pub fn with_after(mut self, name: &str, words: &[&str], when: When) -> FarmJob {
        let words = words.iter().map(|&word| word.to_owned()).collect();
        self.after.push(AfterStep { name: name.to_owned(), words, when });
        self
    }

    /// Every task, variant by variant.
    pub(crate) fn tasks(&self) -> Vec<Task<'_>> {
        let chunks = |variant| {
            let size = self.chunk.max(1) as usize;
            self.frames.chunks(size).map(move |frames| Task { variant, frames })
        };
        match self.variants.as_slice() {
            [] => chunks(None).collect(),
            variants => variants.iter().flat_map(|variant| chunks(Some(variant))).collect(),
        }
    }

    /// The words that begin every step: `COMMAND.. PIPELINE --out OUTPUT SETTINGS..`.
    pub(crate) fn common_words(&self) -> Result<Vec<String>, FarmError> {
        let mut words = self.command.clone();
        words.push(unicode("the pipeline", &self.pipeline)?.to_owned());
        words.extend(["--out".to_owned(), unicode("the output folder", &self.output)?.to_owned()]);
        words.extend(self.settings.iter().cloned());
        Ok(words)
    }

    /// What must hold in every format.
    pub(crate) fn check(&self, format: &'static str) -> Result<(), FarmError> {
        let incomplete = |text: &str| Err(FarmError::Incomplete(text.to_owned()));
        if self.name.is_empty() {
            return incomplete("the job has no name");
        }
        if self.command.first().is_none_or(String::is_empty) {
            return incomplete("the job has no command to run");
        }
        if self.chunk == 0 {
            return number("frames a task", "0", "1 or more");
        }
        if let Some(seconds) = self.seconds_a_frame.filter(|s| !(s.is_finite() && *s > 0.0)) {
            return number("seconds a frame", &seconds.to_string(), "more than 0");
        }
        self.check_frames()?;
        self.check_variants()?;
        self.check_steps()?;
        self.check_paths()?;
        self.texts().try_for_each(|(what, text)| refuse_control(what, text, format))
    }

    fn check_frames(&self) -> Result<(), FarmError> {
        if self.frames.is_empty() {
            return Err(FarmError::Incomplete("the job has no frames".to_owned()));
        }
        match self.frames.windows(2).find(|pair| pair[0] >= pair[1]) {
            Some(pair) => {
                number("a frame", &format!("{} after {}", pair[1], pair[0]), "higher than the one before it")
            }
            None => Ok(()),
        }
    }

    fn check_variants(&self) -> Result<(), FarmError> {
        let axes = |v: &JobVariant| v.axes.iter().map(|(axis, _)| axis.clone()).collect::<Vec<_>>();
        let Some(first) = self.variants.first() else { return Ok(()) };
        for variant in &self.variants {
            let id = &variant.id;
            if axes(variant) != axes(first) {
                let text = format!("variant `{id}` has other axes than variant `{}`", first.id);
                return Err(FarmError::Incomplete(text));
            }
            if variant.axes.iter().any(|(axis, name)| axis.is_empty() || name.is_empty()) {
                return Err(FarmError::Incomplete(format!("variant `{id}` has an axis without a name")));
            }
        }
        if self.variants.len() > 1 && first.axes.is_empty() {
            let text = format!("{} variants without axes cannot be told apart", self.variants.len());
            return Err(FarmError::Incomplete(text));
        }
        Ok(())
    }

    fn check_steps(&self) -> Result<(), FarmError> {
        let mut names = BTreeSet::from(["Prepare", "Frames"]);
        match self.after.iter().find(|step| step.name.is_empty() || !names.insert(&step.name)) {
            Some(step) => {
                Err(FarmError::Incomplete(format!("a step's name `{}` is empty or taken", step.name)))
            }
            None => Ok(()),
        }
    }

    fn check_paths(&self) -> Result<(), FarmError> {
        for (what, path) in self.paths() {
            if !path.has_root() {
                return Err(FarmError::Relative { what, path: path.to_owned() });
            }
            unicode(what, path)?;
        }
        Ok(())
    }

    /// Every path of the job with what it is.
    fn paths(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let inputs = self.inputs.iter().chain(&self.input_folders).map(|path| ("the input", path.as_path()));
        [("the pipeline", self.pipeline.as_path()), ("the output folder", &self.output)]
            .into_iter()
            .chain(inputs)
    }

    /// Every text of the job with what it is; paths are Unicode by now.
    fn texts(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let words = self.command.iter().chain(&self.settings).chain(self.prepare.iter().flatten());
        let words = words.chain(&self.render).chain(self.done.iter().flatten());
        let words = words.chain(self.after.iter().flat_map(|step| &step.words));
        let names = self.after.iter().map(|step| ("the step", step.name.as_str()));
        let axes = self.variants.iter().flat_map(|v| &v.axes);
        [("the job's name", self.name.as_str())]
            .into_iter()
            .chain(self.paths().filter_map(|(what, path)| path.to_str().map(|text| (what, text))))
            .chain(words.map(|word| ("the word", word.as_str())))
            .chain(names)
            .chain(
                axes.flat_map(|(axis, name)| [("the axis", axis.as_str()), ("the setting", name.as_str())]),
            )
    }
}

/// The words that pick a variant: `--only AXIS=NAME` for every axis.
pub(crate) fn only_words(variant: Option<&JobVariant>) -> Vec<String> {
    let axes = variant.iter().flat_map(|v| &v.axes);
    axes.flat_map(|(axis, name)| ["--only".to_owned(), format!("{axis}={name}")]).collect()
}

fn unicode<'a>(what: &'static str, path: &'a Path) -> Result<&'a str, FarmError> {
    path.to_str().ok_or_else(|| FarmError::NotUnicode { what, path: path.to_owned() })
}

fn number(what: &'static str, found: &str, right: &str) -> Result<(), FarmError> {
    Err(FarmError::Number { what, found: found.to_owned(), right: right.to_owned() })
}

/// No line of any of the formats survives a line break, and no person reads the other control characters.
fn refuse_control(what: &'static str, text: &str, format: &'static str) -> Result<(), FarmError> {
    match text.chars().find(|c| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}')) {
        Some(character) => Err(FarmError::Control { what, text: text.to_owned(), character, format }),
        None => Ok(()),
    }
}
