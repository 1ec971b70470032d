//! What has to be made, what is up to date, and why.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::digest::{Digest, Ingredients};
use crate::expand::{Expanded, Variant, expand};
use crate::manifest::Manifest;
use crate::outputs::{self, Wanted};
use crate::stage::{ingredients, views};
use crate::{Fault, FrameRange, TurntableError, frame_file};

/// What the caller asks for beside the file.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Settings laid over the file's, each as `render.spp=4`.
    pub settings: Vec<String>,
    /// Values of variables, each as `quality=4`; laid over the file's.
    pub variables: Vec<String>,
    /// Output folder instead of the file's.
    pub output: Option<PathBuf>,
    /// Frames to look after; all when `None`.
    pub frames: Option<FrameRange>,
    /// Rendering threads; one a core when `None`. Changes no pixel.
    pub threads: Option<usize>,
    /// The command line, to be written into every frame.
    pub command: String,
}

/// Whether an output has to be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// It is there, whole, and made from what the pipeline says now.
    UpToDate,
    /// It is not there.
    Missing,
    /// It was made from something else, or its bytes are not those that were written.
    Stale,
    /// The same picture is there under another number, in this file.
    Elsewhere(PathBuf),
    /// Nobody asked for it.
    NotAsked,
}

/// What kind of output a step makes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepKind {
    /// The groom in another format.
    Convert,
    /// A rendered frame: its number, from 1, and its azimuth in degrees.
    Frame {
        /// Number, from 1.
        number: u32,
        /// Azimuth of the camera, degrees in 0..360.
        azimuth: f64,
    },
    /// A frame as a PNG.
    Preview {
        /// Number of the frame, from 1.
        number: u32,
    },
    /// The contact sheet.
    Sheet,
    /// A film: its place in `video`.
    Video {
        /// Which of the pipeline's films, from 0.
        index: usize,
    },
    /// The page that shows the result.
    Page,
}

/// One output.
#[derive(Clone, Debug)]
pub struct Step {
    /// Which variant it shows, as a place among [`Plan::variants`]; none for what shows several.
    pub variant: Option<usize>,
    /// What it is.
    pub kind: StepKind,
    /// Its path inside the output folder.
    pub output: PathBuf,
    /// Whether it has to be made.
    pub state: State,
    pub(crate) digest: Digest,
}

/// A pipeline, checked, with the state of everything it makes. Making it reads inputs only to digest
/// them: no groom is loaded and no scene built.
#[derive(Debug)]
pub struct Plan {
    pub(crate) base: PathBuf,
    pub(crate) output: PathBuf,
    pub(crate) options: Options,
    pub(crate) name: String,
    pub(crate) variants: Vec<Variant>,
    steps: Vec<Step>,
}

impl Plan {
    /// Reads and checks the pipeline in `file` and looks at what is there already.
    ///
    /// # Errors
    /// [`TurntableError::Pipeline`] with every fault of the file, [`TurntableError::NoSuchFrame`], or
    /// [`TurntableError::Io`] when an input cannot be read.
    pub fn new(file: &Path, options: Options) -> Result<Plan, TurntableError> {
        let Expanded { name, output, variants, inputs } = expand(file, &options)?;
        let base = file.parent().unwrap_or(Path::new("")).to_owned();
        let mut plan = Plan { base, output, options, name, variants, steps: Vec::new() };
        plan.steps = plan.look()?;
        plan.spare_inputs(file, inputs)?;
        Ok(plan)
    }

    /// Refuses a plan that would write over what it reads.
    fn spare_inputs(&self, file: &Path, mut inputs: Vec<PathBuf>) -> Result<(), TurntableError> {
        for variant in &self.variants {
            inputs.extend(ingredients::files(&variant.pipeline, &self.base)?);
        }
        let inputs: BTreeSet<PathBuf> = inputs.iter().filter_map(|input| input.canonicalize().ok()).collect();
        let own = [Path::new("manifest.json"), Path::new("report.json"), Path::new("report.html")];
        let outputs = self.steps.iter().map(|s| s.output.as_path()).chain(own);
        let faults: Vec<Fault> = outputs
            .filter(|output| self.output.join(output).canonicalize().is_ok_and(|o| inputs.contains(&o)))
            .map(|output| {
                let message =
                    format!("`{}` would be written over, and is read", self.output.join(output).display());
                Fault { file: file.to_owned(), place: None, key: "output".into(), message }
            })
            .collect();
        if faults.is_empty() { Ok(()) } else { Err(TurntableError::Pipeline(faults)) }
    }

    /// What is rendered: one for every combination of the pipeline's `matrix`, one where there is none.
    #[must_use]
    pub fn variants(&self) -> &[Variant] {
        &self.variants
    }

    /// What the pipeline is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The folder everything is written to.
    #[must_use]
    pub fn output(&self) -> &Path {
        &self.output
    }

    /// Everything the pipeline makes, in the order it is made, with its state.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Whether there is nothing to make.
    #[must_use]
    pub fn is_up_to_date(&self) -> bool {
        self.steps.iter().all(|s| matches!(s.state, State::UpToDate | State::NotAsked))
    }

    fn look(&self) -> Result<Vec<Step>, TurntableError> {
        let manifest = Manifest::open(&self.output);
        let there = self.sound_frames(&manifest);
        let mut converts = Vec::new();
        let mut frames = Vec::new();
        for index in 0..self.variants.len() {
            let pipeline = &self.variants[index].pipeline;
            let groom = ingredients::groom(pipeline, &self.base)?;
            for path in &pipeline.convert {
                let digest = Ingredients::of("convert").digest(&groom).word(&path.to_string_lossy()).finish();
                let output = Path::new(&self.variants[index].id).join(path);
                converts.push(self.made(&manifest, Some(index), StepKind::Convert, output, digest));
            }
            frames.extend(self.look_at_frames(index, &groom, &there)?);
        }
        let is_there = |f: &Step| there.get(&f.output).is_some_and(|d| d == f.digest.as_str());
        let after = outputs::wanted(&self.variants, &frames).into_iter().map(|wanted| {
            let Wanted { variant, kind, output, digest, needs } = wanted;
            let mut step = self.made(&manifest, variant, kind, output, digest);
            // What needs frames that nobody asked for, and that are not there, waits for them.
            let lacking = |&i: &usize| frames[i].state == State::NotAsked && !is_there(&frames[i]);
            if step.state != State::UpToDate && needs.iter().any(lacking) {
                step.state = State::NotAsked;
            }
            step
        });
        let after: Vec<Step> = after.collect();
        Ok(converts.into_iter().chain(frames).chain(after).collect())
    }

    /// A step whose output the manifest answers for.
    fn made(
        &self,
        manifest: &Manifest,
        variant: Option<usize>,
        kind: StepKind,
        output: PathBuf,
        digest: Digest,
    ) -> Step {
        let state = match manifest.holds(&output, &digest) {
            _ if !self.output.join(&output).exists() => State::Missing,
            Some(true) => State::UpToDate,
            _ => State::Stale,
        };
        Step { variant, kind, output, state, digest }
    }

    /// The digest of a frame that is whole and undamaged.
    ///
    /// Its bytes are compared with those written down in the manifest; frames that others made and
    /// nobody wrote down are unpacked instead, which takes longer.
    fn sound_frame(&self, output: &Path, manifest: &Manifest) -> Option<String> {
        let path = self.output.join(output);
        let digest = frame_file::whole_header(&path)?.digest;
        let sound = manifest.vouches(output, &digest).unwrap_or_else(|| frame_file::unpacks(&path));
        sound.then_some(digest)
    }

    fn look_at_frames(
        &self,
        variant: usize,
        groom: &Digest,
        there: &BTreeMap<PathBuf, String>,
    ) -> Result<Vec<Step>, TurntableError> {
        let Variant { id, pipeline, .. } = &self.variants[variant];
        let count = pipeline.turntable.frames;
        if let Some(asked) = &self.options.frames
            && !asked.iter().any(|number| (1..=count).contains(&number))
        {
            return Err(TurntableError::NoSuchFrame { asked: asked.to_string(), count });
        }
        let scene = ingredients::scene(pipeline, groom, &self.base)?;
        let by_digest: BTreeMap<&str, &PathBuf> =
            there.iter().map(|(path, digest)| (digest.as_str(), path)).collect();
        let step = |number: u32| {
            let azimuth = views::azimuth(&pipeline.turntable, number);
            let digest = ingredients::frame(pipeline, &scene, number);
            let output = Path::new("frames").join(id).join(format!("frame.{number:04}.exr"));
            let path = self.output.join(&output);
            let state = if self.options.frames.as_ref().is_some_and(|asked| !asked.contains(number)) {
                State::NotAsked
            } else if there.get(&output).is_some_and(|found| found == digest.as_str()) {
                State::UpToDate
            } else if let Some(other) = by_digest.get(digest.as_str()) {
                State::Elsewhere(self.output.join(other))
            } else if path.exists() {
                State::Stale
            } else {
                State::Missing
            };
            Step { variant: Some(variant), kind: StepKind::Frame { number, azimuth }, output, state, digest }
        };
        Ok((1..=count).map(step).collect())
    }

    /// The sound frames in the output folder, whatever their number, with their digests.
    fn sound_frames(&self, manifest: &Manifest) -> BTreeMap<PathBuf, String> {
        let outputs = self.frame_files().into_iter();
        outputs
            .filter_map(|output| self.sound_frame(&output, manifest).map(|digest| (output, digest)))
            .collect()
    }

    /// The EXR files of the output folder's `frames` and the folders in it, as paths inside the output folder.
    fn frame_files(&self) -> BTreeSet<PathBuf> {
        let mut found = BTreeSet::new();
        let mut folders = vec![PathBuf::from("frames")];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(self.output.join(&folder)).into_iter().flatten().flatten() {
                let path = folder.join(entry.file_name());
                if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                    folders.push(path);
                } else if path.extension().is_some_and(|e| e == "exr") && !is_hidden(&path) {
                    found.insert(path);
                }
            }
        }
        found
    }

    /// Frames in the output folder that are none of this turntable's: left from a longer one.
    #[must_use]
    pub fn left_over(&self) -> Vec<PathBuf> {
        let own: BTreeSet<&Path> = self.steps.iter().map(|s| s.output.as_path()).collect();
        self.frame_files().into_iter().filter(|path| !own.contains(path.as_path())).collect()
    }
}

fn is_hidden(path: &Path) -> bool {
    path.file_name().is_none_or(|name| name.to_string_lossy().starts_with('.'))
}
