//! The template: parameters and steps.

use super::literals::Literals;
use super::{FORMAT, MOST_VALUE, fits, frames};
use crate::yaml::{list, quoted};
use crate::{FarmError, FarmJob, When};

/// The most characters of a job's name, and of a step's.
const MOST_NAME: usize = 128;
const MOST_STEP_NAME: usize = 64;

/// The most parameters of a job, task parameters of a step, and values of one of those.
const MOST_PARAMETERS: usize = 50;
const MOST_TASK_PARAMETERS: usize = 16;
const MOST_VALUES: usize = 1024;

/// Seconds between the word to stop and the end: enough to write the checkpoint of a large frame.
const NOTICE: u32 = 60;

/// One parameter that people may set.
pub(super) struct Parameter {
    pub name: &'static str,
    /// Its value, as YAML.
    pub value: String,
    /// Whether the template may hold that value; no path may stand there.
    pub has_default: bool,
    /// The rest of its definition, line by line.
    rest: Vec<String>,
}

/// What a person may change without knowing the pipeline.
pub(super) fn parameters(job: &FarmJob) -> Vec<Parameter> {
    let parameter = |name, value: String, rest: &[&str]| {
        let rest: Vec<String> = rest.iter().map(|&line| line.to_owned()).collect();
        Parameter { name, value, has_default: !rest.iter().any(|line| line == "type: PATH"), rest }
    };
    let path = |path: &std::path::Path| quoted(&path.to_string_lossy());
    let program = job.command.first().map(|word| quoted(word)).unwrap_or_default();
    // A scheduler that knows how long a frame takes may make larger or smaller tasks; 0 lets it keep to the number.
    let target = job.seconds_a_frame.map_or(0.0, |s| (s * f64::from(job.chunk)).ceil().min(86400.0));
    vec![
        parameter(
            "Frames",
            quoted(&frames(job)),
            &["type: STRING", "description: \"Frames to render: 1-5, 1-10:2 or 1,3,7-9\""],
        ),
        parameter(
            "FramesPerTask",
            job.chunk.to_string(),
            &["type: INT", "minValue: 1", "description: \"Frames of one task, which loads the scene once\""],
        ),
        parameter(
            "SecondsPerTask",
            (target as u32).to_string(),
            &[
                "type: INT",
                "minValue: 0",
                "description: \"What a task should take; 0 leaves tasks at that many frames\"",
            ],
        ),
        parameter("Pipeline", path(&job.pipeline), &["type: PATH", "objectType: FILE", "dataFlow: IN"]),
        parameter("Output", path(&job.output), &["type: PATH", "objectType: DIRECTORY", "dataFlow: OUT"]),
        parameter(
            "Program",
            program,
            &[
                "type: STRING",
                "description: \"The program, by the name that the farm's machines know it by\"",
            ],
        ),
    ]
}

pub(super) fn template(job: &FarmJob) -> Result<String, FarmError> {
    check(job)?;
    let mut literals = Literals::default();
    let name = literals.say(&job.name)?;
    let mut words = literals.say_all(job.command.iter().skip(1))?;
    words.extend(["{{Param.Pipeline}}".to_owned(), "--out".to_owned(), "{{Param.Output}}".to_owned()]);
    words.extend(literals.say_all(&job.settings)?);

    let mut steps = String::new();
    let mut below = None;
    if let Some(prepare) = &job.prepare {
        let prepare = literals.say_all(prepare)?;
        steps += &step("Prepare", None, "", words.iter().chain(&prepare));
        below = Some("Prepare");
    }
    let render = literals.say_all(&job.render)?;
    let space = Space::of(job, &mut literals)?;
    let frame = ["--progress", "openjd", "--frames", "{{Task.Param.Frame}}"].map(str::to_owned);
    steps +=
        &step("Frames", below, &space.text, words.iter().chain(&render).chain(&space.words).chain(&frame));
    for after in job.after.iter().filter(|after| after.when == When::AllDone) {
        let mut rest = literals.say_all(&after.words)?;
        rest.extend(["--frames".to_owned(), "{{Param.Frames}}".to_owned()]);
        steps += &step(&after.name, Some("Frames"), "", words.iter().chain(&rest));
    }
    let known = parameters(job);
    let hidden = literals.definitions(MOST_PARAMETERS - known.len())?;
    let definitions: String = known.iter().map(definition).collect();
    Ok(format!(
        "{}specificationVersion: jobtemplate-2023-09\nextensions: [TASK_CHUNKING]\nname: {}\n\
         parameterDefinitions:\n{definitions}{hidden}steps:\n{steps}",
        head(job),
        quoted(&name)
    ))
}

fn check(job: &FarmJob) -> Result<(), FarmError> {
    fits("the job's name", &job.name, MOST_NAME, "shorten it")?;
    fits("the range of frames", &frames(job), MOST_VALUE, "export fewer, or frames at an even step")?;
    let words = [&job.pipeline, &job.output];
    for path in words {
        fits("the path", &path.to_string_lossy(), MOST_VALUE, "shorten it")?;
    }
    if let Some(program) = job.command.first() {
        fits("the program", program, MOST_VALUE, "shorten it")?;
    }
    job.after.iter().try_for_each(|after| fits("a step's name", &after.name, MOST_STEP_NAME, "shorten it"))
}

/// What the reader of the file should know.
fn head(job: &FarmJob) -> String {
    let last = job.after.iter().rev().find(|step| step.when == When::AllDone);
    let mut text = format!(
        "# {}: check with `openjd check template.yaml`, run here with\n\
         #     openjd run template.yaml --step {} --run-dependencies -p file://values.yaml -p Frames={}\n\
         # or hand the folder to a farm that takes job bundles.\n\
         #\n\
         # Tasks may be run again, twice at once, or be killed: frames that are done are skipped, one that was begun goes\n\
         # on where its checkpoint stands. Taken for granted:\n\
         # - every machine finds the program, and sees the same files under the same names or maps them;\n\
         # - the farm tries tasks again that fail: exit code 75 asks for it, 2 says that it would be in vain;\n\
         # - a task has its machine to itself (the renderer takes all cores that it may use).\n",
        job.name,
        last.map_or("Frames".to_owned(), |step| crate::sh_quoted(&step.name)),
        frames(job),
    );
    for step in job.after.iter().filter(|step| step.when == When::Ended) {
        text += &format!(
            "# `{}` is no step here: a step waits until those before it are done well, and it is for those that are not.\n",
            step.name
        );
    }
    text
}

fn definition(parameter: &Parameter) -> String {
    let rest: String = parameter.rest.iter().map(|line| format!("  {line}\n")).collect();
    let default =
        if parameter.has_default { format!("  default: {}\n", parameter.value) } else { String::new() };
    format!("- name: {}\n{rest}{default}", parameter.name)
}

/// A step that runs the program with `words`; `space` is its parameter space, indented.
fn step<'a>(
    name: &str,
    below: Option<&str>,
    space: &str,
    words: impl IntoIterator<Item = &'a String>,
) -> String {
    let dependencies =
        below.map_or(String::new(), |below| format!("  dependencies:\n  - dependsOn: {}\n", quoted(below)));
    format!(
        "- name: {}\n{dependencies}{space}  script:\n    actions:\n      onRun:\n        \
         command: \"{{{{Param.Program}}}}\"\n        args: {}\n        \
         cancelation: {{mode: NOTIFY_THEN_TERMINATE, notifyPeriodInSeconds: {NOTICE}}}\n",
        quoted(name),
        list(words)
    )
}

/// The parameter space of the frames, and the words that pick a variant in it.
struct Space {
    text: String,
    words: Vec<String>,
}

impl Space {
    fn of(job: &FarmJob, literals: &mut Literals) -> Result<Space, FarmError> {
        let mut text = "  parameterSpace:\n    taskParameterDefinitions:\n".to_owned();
        let (mut words, mut names) = (Vec::new(), Vec::new());
        let axes = job.variants.first().map_or(&[][..], |variant| &variant.axes);
        // The frames are a task parameter too.
        at_most("axes", axes.len(), MOST_TASK_PARAMETERS - 1, "join some")?;
        at_most("variants", job.variants.len(), MOST_VALUES, "export some of them at a time")?;
        for (index, (axis, _)) in axes.iter().enumerate() {
            let name = identifier(index, axis);
            let settings = job.variants.iter().filter_map(|variant| variant.axes.get(index));
            let settings: Vec<String> =
                settings.map(|(_, setting)| literals.say(setting)).collect::<Result<_, _>>()?;
            for setting in &settings {
                fits("a setting's name", setting, MOST_VALUE, "shorten it")?;
            }
            text += &format!("    - name: {name}\n      type: STRING\n      range: {}\n", list(&settings));
            words.extend(["--only".to_owned(), format!("{}={{{{Task.Param.{name}}}}}", literals.say(axis)?)]);
            names.push(name);
        }
        text += "    - name: Frame\n      type: \"CHUNK[INT]\"\n      range: \"{{Param.Frames}}\"\n      chunks:\n        \
                 defaultTaskCount: \"{{Param.FramesPerTask}}\"\n        \
                 targetRuntimeSeconds: \"{{Param.SecondsPerTask}}\"\n        rangeConstraint: NONCONTIGUOUS\n";
        // The axes go hand in hand, variant by variant, and every variant has all frames.
        match names.as_slice() {
            [] => {}
            [one] => text += &format!("    combination: \"{one} * Frame\"\n"),
            several => text += &format!("    combination: \"({}) * Frame\"\n", several.join(", ")),
        }
        Ok(Space { text, words })
    }
}

/// A task parameter's name that farms show: the axis's, as far as a name may hold it.
fn identifier(index: usize, axis: &str) -> String {
    let plain: String =
        axis.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).take(40).collect();
    format!("Axis{}_{plain}", index + 1)
}

fn at_most(what: &'static str, found: usize, most: usize, remedy: &'static str) -> Result<(), FarmError> {
    if found > most { Err(FarmError::TooMany { what, found, most, format: FORMAT, remedy }) } else { Ok(()) }
}
