//! What has to be made, what is up to date, and why.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::digest::{Digest, Ingredients, Memory};
use crate::expand::{Expanded, Variant, expand};
use crate::manifest::{self, Manifest};
use crate::outputs::{self, Asked, Wanted};
use crate::stage::{ingredients, views};
use crate::stamp::Stamp;
use crate::there::There;
use crate::{Fault, Options, Phase, State, Step, StepKind, TurntableError, only};

/// A pipeline, checked, with the state of everything it makes. Making it reads inputs only to digest
/// them: no groom is loaded and no scene built.
#[derive(Debug)]
pub struct Plan {
    pub(crate) base: PathBuf,
    pub(crate) output: PathBuf,
    pub(crate) options: Options,
    pub(crate) name: String,
    pub(crate) variants: Vec<Variant>,
    /// Whether each variant is asked for.
    pub(crate) asked: Vec<bool>,
    pub(crate) there: There,
    /// Outputs that are up to date, which only reading them could tell.
    pub(crate) read: Vec<(PathBuf, String)>,
    /// What the inputs hold.
    pub(crate) inputs: Vec<(PathBuf, Stamp, Digest)>,
    files: Vec<PathBuf>,
    steps: Vec<Step>,
}

impl Plan {
    /// Reads and checks the pipeline in `file` and looks at what is there already.
    ///
    /// # Errors
    /// [`TurntableError::Pipeline`] with every fault of the file, [`TurntableError::NoSuchFrame`],
    /// [`TurntableError::NoSuchVariant`], or [`TurntableError::Io`] when an input cannot be read.
    pub fn new(file: &Path, options: Options) -> Result<Plan, TurntableError> {
        let Expanded { name, output, variants, inputs: mut files } = expand(file, &options)?;
        let base = file.parent().unwrap_or(Path::new("")).to_owned();
        let asked = only::asked(&options.only, &variants)?;
        let manifest = Manifest::open(&output, options.verify);
        let there = There::look(&output, &manifest);
        for variant in &variants {
            files.extend(ingredients::files(&variant.pipeline, &base)?);
        }
        let (read, inputs, steps) = (Vec::new(), Vec::new(), Vec::new());
        let mut plan =
            Plan { base, output, options, name, variants, asked, there, read, inputs, files, steps };
        plan.look(&manifest)?;
        plan.spare_inputs(file)?;
        Ok(plan)
    }

    /// Refuses a plan that would write over what it reads.
    fn spare_inputs(&self, file: &Path) -> Result<(), TurntableError> {
        let inputs: BTreeSet<PathBuf> =
            self.files.iter().filter_map(|input| input.canonicalize().ok()).collect();
        let own = [manifest::FILE, "report.json", "report.html"].map(Path::new);
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

    /// What it reads: its files, those they include, and what they name; some of them more than once.
    #[must_use]
    pub fn inputs(&self) -> &[PathBuf] {
        &self.files
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
        self.steps.iter().all(|s| matches!(s.state, State::UpToDate | State::NotAsked | State::Waiting(_)))
    }

    /// Whether this kind of work is asked for, of this variant or of all together.
    fn is_asked(&self, phase: Phase, variant: Option<usize>) -> bool {
        let variant_asked = variant.is_none_or(|index| self.asked.get(index).is_some_and(|&asked| asked));
        self.options.wants(phase) && variant_asked
    }

    fn look(&mut self, manifest: &Manifest) -> Result<(), TurntableError> {
        self.check_frames_asked()?;
        let memory = Memory::of(manifest.inputs());
        let mut converts = Vec::new();
        let mut frames = Vec::new();
        for (index, Variant { id, pipeline, .. }) in self.variants.iter().enumerate() {
            let groom = ingredients::groom(pipeline, &self.base)?;
            for path in &pipeline.convert {
                let digest = Ingredients::of("convert").digest(&groom).word(&path.to_string_lossy()).finish();
                let output = Path::new(id).join(path);
                let asked = self.is_asked(Phase::Prepare, Some(index));
                converts.push(self.made(manifest, Some(index), StepKind::Convert, output, digest, asked));
            }
            frames.extend(self.look_at_frames(index, &groom)?);
        }
        let of = Asked { base: &self.base, variants: &self.variants, frames: &frames };
        let wanted = outputs::wanted(&of)?;
        self.inputs = memory.inputs();
        drop(memory);
        let is_there = |f: &Step| self.there.digest(&f.output) == Some(f.digest.as_str());
        let after = wanted.into_iter().map(|wanted| {
            let Wanted { variant, kind, output, digest, needs } = wanted;
            let asked = self.is_asked(Phase::Outputs, variant);
            let mut step = self.made(manifest, variant, kind, output, digest, asked);
            // What needs frames that nobody asked for, and that are not there, waits for them.
            let lacking = |&&i: &&usize| frames[i].state == State::NotAsked && !is_there(&frames[i]);
            let lacking = needs.iter().filter(lacking).count();
            if matches!(step.state, State::Missing | State::Stale) && lacking > 0 {
                step.state = State::Waiting(lacking);
            }
            step.needs = needs;
            step
        });
        let after: Vec<Step> = after.collect();
        let kept = converts.iter().chain(&after).filter(|step| step.state == State::UpToDate);
        let read = kept.filter(|step| manifest.has_to_read(&step.output));
        let read = read.map(|step| (step.output.clone(), step.digest.as_str().to_owned()));
        self.read = read.chain(self.there.read()).collect();
        self.steps = converts.into_iter().chain(frames).chain(after).collect();
        Ok(())
    }

    /// A step whose output the manifest answers for.
    fn made(
        &self,
        manifest: &Manifest,
        variant: Option<usize>,
        kind: StepKind,
        output: PathBuf,
        digest: Digest,
        asked: bool,
    ) -> Step {
        let state = if !asked {
            State::NotAsked
        } else if manifest.digest_of(&output) == Some(digest.as_str()) {
            State::UpToDate
        } else if self.output.join(&output).exists() {
            State::Stale
        } else {
            State::Missing
        };
        Step { variant, kind, output, state, digest, needs: Vec::new() }
    }

    /// Some variant has to have one of the frames that are asked for.
    fn check_frames_asked(&self) -> Result<(), TurntableError> {
        let Some(asked) = &self.options.frames else { return Ok(()) };
        let most = self.variants.iter().map(|v| v.pipeline.turntable.frames).max().unwrap_or_default();
        if asked.iter().any(|number| (1..=most).contains(&number)) {
            return Ok(());
        }
        Err(TurntableError::NoSuchFrame { asked: asked.to_string(), count: most })
    }

    fn look_at_frames(&self, variant: usize, groom: &Digest) -> Result<Vec<Step>, TurntableError> {
        let Variant { id, pipeline, .. } = &self.variants[variant];
        let scene = ingredients::scene(pipeline, groom, &self.base)?;
        let is_asked = self.is_asked(Phase::Frames, Some(variant));
        let step = |number: u32| {
            let azimuth = views::azimuth(&pipeline.turntable, number);
            let digest = ingredients::frame(pipeline, &scene, number);
            let output = Path::new("frames").join(id).join(format!("frame.{number:04}.exr"));
            let state =
                if !is_asked || self.options.frames.as_ref().is_some_and(|asked| !asked.contains(number)) {
                    State::NotAsked
                } else if self.there.digest(&output) == Some(digest.as_str()) {
                    State::UpToDate
                } else if let Some(other) = self.there.place(digest.as_str()) {
                    State::Elsewhere(self.output.join(other))
                } else if self.there.has_file(&output) {
                    State::Stale
                } else {
                    State::Missing
                };
            let kind = StepKind::Frame { number, azimuth };
            Step { variant: Some(variant), kind, output, state, digest, needs: Vec::new() }
        };
        Ok((1..=pipeline.turntable.frames).map(step).collect())
    }

    /// Frames in the output folder that are none of this turntable's: left from a longer one.
    #[must_use]
    pub fn left_over(&self) -> Vec<PathBuf> {
        let own: BTreeSet<&Path> = self.steps.iter().map(|s| s.output.as_path()).collect();
        self.there.files().iter().filter(|path| !own.contains(path.as_path())).cloned().collect()
    }
}
