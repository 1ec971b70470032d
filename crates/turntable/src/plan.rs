//! What has to be made, what is up to date, and why.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::digest::{Digest, Ingredients};
use crate::manifest::Manifest;
use crate::schema::Pipeline;
use crate::{Fault, FrameRange, TurntableError, check, frame_file, material, yaml};

/// What the caller asks for beside the file.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Settings laid over the file's, each as `render.spp=4`.
    pub settings: Vec<String>,
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
}

/// One output.
#[derive(Clone, Debug)]
pub struct Step {
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
    pub(crate) pipeline: Pipeline,
    pub(crate) base: PathBuf,
    pub(crate) output: PathBuf,
    pub(crate) options: Options,
    pub(crate) name: String,
    steps: Vec<Step>,
}

impl Plan {
    /// Reads and checks the pipeline in `file` and looks at what is there already.
    ///
    /// # Errors
    /// [`TurntableError::Pipeline`] with every fault of the file, [`TurntableError::NoSuchFrame`], or
    /// [`TurntableError::Io`] when an input cannot be read.
    pub fn new(file: &Path, options: Options) -> Result<Plan, TurntableError> {
        let text = text_of(file)?;
        let pipeline = yaml::parse_with(&text, &options.settings).map_err(|fault| {
            let place = fault.place.map(|p| (p.line, p.column));
            let (file, message) = (file.to_owned(), fault.message);
            TurntableError::Pipeline(vec![Fault { file, place, key: String::new(), message }])
        })?;
        let mut faults = check::faults(&pipeline, file, &text);
        faults.iter_mut().for_each(|fault| name_flag(fault, &options.settings));
        if !faults.is_empty() {
            return Err(TurntableError::Pipeline(faults));
        }
        let stem = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let name = pipeline.name.clone().unwrap_or_else(|| stem.clone());
        let asked = options.output.clone().or_else(|| pipeline.output.clone());
        let output = asked.unwrap_or_else(|| Path::new("out").join(stem));
        let base = file.parent().unwrap_or(Path::new("")).to_owned();
        let mut plan = Plan { pipeline, base, output, options, name, steps: Vec::new() };
        plan.steps = plan.look()?;
        plan.spare_inputs(file)?;
        Ok(plan)
    }

    /// Refuses a plan that would write over what it reads.
    fn spare_inputs(&self, file: &Path) -> Result<(), TurntableError> {
        let pipeline = &self.pipeline;
        let named = [
            pipeline.groom.file.as_ref(),
            pipeline.mesh.as_ref().map(|m| &m.file),
            pipeline.lights.environment.as_ref().and_then(|e| e.file.as_ref()),
        ];
        let material = pipeline.material.files(&self.base)?;
        let inputs = named.into_iter().flatten().map(|input| self.base.join(input)).chain([file.to_owned()]);
        let inputs = inputs.chain(material);
        let inputs: Vec<PathBuf> = inputs.filter_map(|input| input.canonicalize().ok()).collect();
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

    /// Azimuth of frame `number` (from 1) in degrees, 0..360.
    pub(crate) fn azimuth(&self, number: u32) -> f64 {
        let turn = &self.pipeline.turntable;
        // A full circle ends where it began, an arc shows both its ends.
        let full = turn.degrees.abs() == 360.0;
        let gaps = if full { turn.frames } else { turn.frames.saturating_sub(1).max(1) };
        (turn.start + turn.degrees * f64::from(number - 1) / f64::from(gaps)).rem_euclid(360.0)
    }

    fn look(&self) -> Result<Vec<Step>, TurntableError> {
        let manifest = Manifest::open(&self.output);
        let groom = self.groom_digest()?;
        let scene = self.scene_digest(&groom)?;
        let made = |output: PathBuf, kind: StepKind, digest: Digest| {
            let state = match manifest.holds(&output, &digest) {
                _ if !self.output.join(&output).exists() => State::Missing,
                Some(true) => State::UpToDate,
                _ => State::Stale,
            };
            Step { kind, output, state, digest }
        };
        let convert = self.pipeline.convert.iter().map(|path| {
            let digest = Ingredients::of("convert").digest(&groom).word(&path.to_string_lossy()).finish();
            made(path.clone(), StepKind::Convert, digest)
        });
        let mut steps: Vec<Step> = convert.collect();
        let frames = self.look_at_frames(&scene, &manifest)?;
        let tone = |step: &str| Ingredients::of(step).settings(&self.pipeline.tone);
        let mut after = Vec::new();
        if self.pipeline.tone.frames {
            after.extend(frames.iter().filter(|f| f.state != State::NotAsked).map(|frame| {
                let digest = tone("preview").digest(&frame.digest).finish();
                let StepKind::Frame { number, .. } = frame.kind else { return frame.clone() };
                made(frame.output.with_extension("png"), StepKind::Preview { number }, digest)
            }));
        }
        if let Some(sheet) = &self.pipeline.sheet {
            let digest =
                frames.iter().fold(tone("sheet").settings(sheet), |i, f| i.digest(&f.digest)).finish();
            let mut step = made(sheet.file.clone(), StepKind::Sheet, digest);
            let is_there =
                |f: &Step| self.sound_frame(&f.output, &manifest).is_some_and(|d| d == f.digest.as_str());
            let lacking = |f: &Step| f.state == State::NotAsked && !is_there(f);
            if step.state != State::UpToDate && frames.iter().any(lacking) {
                step.state = State::NotAsked;
            }
            after.push(step);
        }
        steps.extend(frames);
        steps.extend(after);
        Ok(steps)
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

    fn look_at_frames(&self, scene: &Digest, manifest: &Manifest) -> Result<Vec<Step>, TurntableError> {
        let count = self.pipeline.turntable.frames;
        if let Some(asked) = &self.options.frames
            && !asked.iter().any(|number| (1..=count).contains(&number))
        {
            return Err(TurntableError::NoSuchFrame { asked: asked.to_string(), count });
        }
        let there = self.sound_frames(manifest);
        let by_digest: BTreeMap<&str, &PathBuf> =
            there.iter().map(|(path, digest)| (digest.as_str(), path)).collect();
        let step = |number: u32| {
            let azimuth = self.azimuth(number);
            let digest = self.frame_digest(scene, azimuth);
            let output = Path::new("frames").join(format!("frame.{number:04}.exr"));
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
            Step { kind: StepKind::Frame { number, azimuth }, output, state, digest }
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

    /// The EXR files of the output folder's `frames`, as paths inside the output folder.
    fn frame_files(&self) -> BTreeSet<PathBuf> {
        let Ok(entries) = std::fs::read_dir(self.output.join("frames")) else { return BTreeSet::new() };
        let names = entries.flatten().map(|e| Path::new("frames").join(e.file_name()));
        names.filter(|p| p.extension().is_some_and(|e| e == "exr") && !is_hidden(p)).collect()
    }

    /// Frames in the output folder that are none of this turntable's: left from a longer one.
    #[must_use]
    pub fn left_over(&self) -> Vec<PathBuf> {
        let own: BTreeSet<&Path> = self.steps.iter().map(|s| s.output.as_path()).collect();
        self.frame_files().into_iter().filter(|path| !own.contains(path.as_path())).collect()
    }

    fn groom_digest(&self) -> Result<Digest, TurntableError> {
        let source = &self.pipeline.groom;
        let mut digest = Ingredients::of("groom");
        if let Some(file) = &source.file {
            let ending = file.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
            digest = digest.word(&ending).file(&self.base.join(file))?;
        }
        let settings = (&source.sample, source.up, source.meters_per_unit, source.repair);
        Ok(digest.settings(&settings).settings(&self.pipeline.attributes).finish())
    }

    fn scene_digest(&self, groom: &Digest) -> Result<Digest, TurntableError> {
        let mut digest =
            material::added(Ingredients::of("scene").digest(groom), &self.pipeline.material, &self.base)?;
        if let Some(mesh) = &self.pipeline.mesh {
            digest = digest.file(&self.base.join(&mesh.file))?;
            digest = digest.settings(&(mesh.up, mesh.meters_per_unit, mesh.albedo));
        }
        digest = digest.settings(&self.pipeline.lights.area);
        if let Some(environment) = &self.pipeline.lights.environment {
            if let Some(file) = &environment.file {
                digest = digest.file(&self.base.join(file))?;
            }
            let e = environment;
            digest = digest.settings(&(e.constant, e.studio, e.rotation, e.intensity));
        }
        Ok(digest.finish())
    }

    /// The azimuth counts, the frame's number and how many there are do not: the same view is the
    /// same picture in a turntable of 4 and of 8.
    fn frame_digest(&self, scene: &Digest, azimuth: f64) -> Digest {
        let digest = Ingredients::of("frame").digest(scene);
        let digest = digest.settings(&self.pipeline.camera).settings(&self.pipeline.render);
        digest.settings(&(azimuth, self.pipeline.turntable.turn)).finish()
    }
}

/// The text of a pipeline file.
fn text_of(file: &Path) -> Result<String, TurntableError> {
    let bytes = std::fs::read(file).map_err(|e| TurntableError::io(file, "read", e))?;
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let lines = before.split(|&b| b == b'\n');
        let column = |last| String::from_utf8_lossy(last).chars().count() + 1;
        let place = lines.clone().next_back().map(|last| (lines.count(), column(last)));
        let message = format!("byte {} is not UTF-8, as YAML has to be", before.len());
        TurntableError::Pipeline(vec![Fault { file: file.to_owned(), place, key: String::new(), message }])
    })
}

/// Names the flag that brought a fault in: the file is not to blame, and its place would mislead.
fn name_flag(fault: &mut Fault, settings: &[String]) {
    let within = |inner: &str, outer: &str| {
        inner.strip_prefix(outer).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    let path = |setting: &str| setting.split('=').next().unwrap_or_default().trim().to_owned();
    // The last one laid over counts.
    let Some(setting) = settings.iter().rev().find(|s| {
        let path = path(s);
        within(&fault.key, &path) || within(&path, &fault.key)
    }) else {
        return;
    };
    if within(&fault.key, &path(setting)) {
        fault.place = None;
    }
    fault.message += &format!(" (from `--set {setting}`)");
}

fn is_hidden(path: &Path) -> bool {
    path.file_name().is_none_or(|name| name.to_string_lossy().starts_with('.'))
}
