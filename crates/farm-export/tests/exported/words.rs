//! Words come back as they went in: from `sh`, from a script that Slurm would run, from YAML and format strings.

use std::collections::BTreeMap;
use std::process::Command;

use farm_export::{FarmJob, JobVariant, When, command_list, openjd, sh_quoted, slurm};
use proptest::prelude::*;
use serde_yaml::Value;

/// What breaks quoting, more often than chance would have it.
fn word() -> BoxedStrategy<String> {
    let spiteful = prop::sample::select(vec![
        "'",
        "\"",
        "\\",
        "$",
        "`",
        "{{",
        "}}",
        "{{Param.Frames}}",
        "{",
        "}",
        " ",
        "  ",
        "#",
        "!",
        "~",
        "*",
        "?",
        "[",
        "]",
        "&",
        "|",
        ";",
        "<",
        ">",
        "(",
        ")",
        "=",
        "%",
        "%s",
        "-",
        "--",
        ": ",
        "- ",
        "$(id)",
        "${HOME}",
        "é",
        "髪",
        "😀",
        "\u{a0}",
        "\u{ad}",
        "\u{200b}",
        "EOF",
        "'\\''",
        "\\n",
        "no",
        "1e3",
        "null",
    ]);
    prop::collection::vec(
        prop_oneof![2 => spiteful.prop_map(str::to_owned), 1 => "[a-zA-Z0-9._/-]{1,6}"],
        0..6,
    )
    .prop_map(|parts| parts.concat())
    .boxed()
}

/// A job in which every name is a spiteful word.
fn job() -> impl Strategy<Value = FarmJob> {
    let words = || prop::collection::vec(word(), 0..4);
    let axes = prop::collection::vec(("[a-z]{1,4}", word(), word()), 0..3);
    (words(), words(), word(), word(), axes, 1u32..9).prop_map(|(settings, last, name, path, axes, count)| {
        let name_of = |text: &str| format!("n{text}");
        let variant = |second: bool| JobVariant {
            id: String::new(),
            axes: axes
                .iter()
                .map(|(axis, a, b)| (axis.clone() + a, name_of(if second { b } else { a })))
                .collect(),
        };
        let variants = if axes.is_empty() { Vec::new() } else { vec![variant(false), variant(true)] };
        let last: Vec<&str> = last.iter().map(String::as_str).collect();
        FarmJob {
            command: vec!["printf".into(), "%s\\0".into()],
            settings,
            render: vec!["--steps".into(), "fra mes".into()],
            variants,
            ..FarmJob::new(name_of(&name), format!("/in/{path}.yaml"), format!("/out/{path}"), 1..=count)
        }
        .with_chunk(3)
        .with_after("Sheet", &last, When::AllDone)
    })
}

/// What each task must be called with, in order.
fn expected(job: &FarmJob) -> Vec<Vec<String>> {
    let variants = if job.variants.is_empty() { vec![None] } else { job.variants.iter().map(Some).collect() };
    let mut tasks = Vec::new();
    for variant in variants {
        for frames in job.frames.chunks(job.chunk as usize) {
            let mut words = base(job);
            words.extend(job.render.iter().cloned());
            for (axis, name) in variant.iter().flat_map(|v: &&JobVariant| &v.axes) {
                words.extend(["--only".to_owned(), format!("{axis}={name}")]);
            }
            words.extend(["--frames".to_owned(), farm_export::range_text(frames)]);
            tasks.push(words);
        }
    }
    tasks
}

fn base(job: &FarmJob) -> Vec<String> {
    let path = |path: &std::path::Path| path.to_str().unwrap().to_owned();
    let mut words = vec![path(&job.pipeline), "--out".to_owned(), path(&job.output)];
    words.extend(job.settings.iter().cloned());
    words
}

/// What a program is called with when `sh` reads `script`; the program is `printf '%s\0'`.
fn read_by_sh(script: &str, environment: &[(&str, &str)]) -> Vec<String> {
    let mut sh = Command::new("sh");
    sh.arg("-c").arg(script).env_remove("SLURM_CPUS_ON_NODE").envs(environment.iter().copied());
    let output = sh.output().unwrap();
    assert!(output.status.success(), "{}\n{script}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    text.split_terminator('\0').map(str::to_owned).collect()
}

/// `text` as Open Job Description resolves it: the innermost pairs of double braces hold a name.
fn resolved(text: &str, values: &BTreeMap<String, String>) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").unwrap_or_else(|| panic!("`{text}` does not close"));
        out += before;
        out += values.get(name.trim()).unwrap_or_else(|| panic!("`{name}` in `{text}` is nothing"));
        rest = after;
    }
    assert!(!rest.contains("}}"), "`{text}` closes what was not opened");
    out + rest
}

fn strings(list: &Value) -> Vec<String> {
    list.as_sequence().unwrap().iter().map(|v| v.as_str().unwrap().to_owned()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn sh_reads_back_what_was_quoted(words in prop::collection::vec(word(), 1..20)) {
        let line: Vec<String> = words.iter().map(|w| sh_quoted(w)).collect();
        prop_assert_eq!(read_by_sh(&format!("printf '%s\\0' {}", line.join(" ")), &[]), words);
    }

    #[test]
    fn lines_are_read_back(job in job()) {
        let list = command_list(&job).unwrap();
        let lines: Vec<&str> = list.lines().collect();
        let expected = expected(&job);
        let tasks: Vec<&&str> = lines.iter().filter(|line| !line.starts_with('#')).collect();
        prop_assert_eq!(tasks.len(), expected.len());
        // The whole file at once, comments and all.
        prop_assert_eq!(read_by_sh(&list, &[]), expected.concat());
    }

    #[test]
    fn every_task_of_the_script_is_read_back(job in job()) {
        let script = slurm(&job).unwrap();
        for (index, mut words) in expected(&job).into_iter().enumerate() {
            let at = base(&job).len() + job.render.len();
            words.splice(at..at, ["--threads".to_owned(), "1".to_owned()]);
            let task = index.to_string();
            prop_assert_eq!(read_by_sh(&script, &[("SLURM_ARRAY_TASK_ID", &task)]), words);
        }
    }

    #[test]
    fn what_the_script_submits_is_read_back(job in job()) {
        // In place of sbatch, a function that runs what it would wrap and says a job's number.
        let sbatch = "sbatch() { for w; do case $w in --wrap=*) (eval \"${w#--wrap=}\") >&3 ;; esac; done; echo '7;far'; }\n";
        let script = format!("exec 3>&1 >&2; {sbatch}{}", slurm(&job).unwrap());
        let mut words = base(&job);
        words.extend(job.after[0].words.iter().cloned());
        words.extend(["--frames".to_owned(), farm_export::range_text(&job.frames)]);
        words.extend(["--threads".to_owned(), "1".to_owned()]);
        prop_assert_eq!(read_by_sh(&script, &[]), words);
    }

    #[test]
    fn what_is_asked_first_is_read_back(job in job(), done in prop::collection::vec(word(), 0..3)) {
        let sbatch = "sbatch() { for w; do case $w in --wrap=*) (eval \"${w#--wrap=}\") >&3 ;; esac; done; echo 7; }\n";
        let job = FarmJob { done: Some(done.clone()), ..job };
        let script = format!("exec 3>&1 >&2; {sbatch}{}", slurm(&job).unwrap());
        let frames = ["--frames".to_owned(), farm_export::range_text(&job.frames)];
        let first = [base(&job), done, frames.to_vec()].concat();
        let second = [base(&job), job.after[0].words.clone(), frames.to_vec(), vec!["--threads".into(), "1".into()]];
        prop_assert_eq!(read_by_sh(&script, &[]), [first, second.concat()].concat());
    }

    #[test]
    fn format_strings_resolve_to_what_went_in(job in job()) {
        let [.., (_, flat), (_, template)] = openjd(&job).unwrap();
        let template: Value = serde_yaml::from_str(&template).unwrap();
        let mut values: BTreeMap<String, String> = serde_yaml::from_str(&flat).unwrap();
        values = values.into_iter().map(|(name, value)| (format!("Param.{name}"), value)).collect();
        for parameter in template["parameterDefinitions"].as_sequence().unwrap() {
            let default = &parameter["default"];
            if default.is_null() {
                continue; // a path, whose value came from the other file
            }
            let text = default.as_str().map_or_else(|| default.as_i64().unwrap().to_string(), str::to_owned);
            values.insert(format!("Param.{}", parameter["name"].as_str().unwrap()), text);
        }
        prop_assert_eq!(resolved(template["name"].as_str().unwrap(), &values), job.name.clone());
        let steps = template["steps"].as_sequence().unwrap();
        let words_of = |step: &Value, values: &BTreeMap<String, String>| {
            let run = &step["script"]["actions"]["onRun"];
            let mut words = vec![resolved(run["command"].as_str().unwrap(), values)];
            words.extend(strings(&run["args"]).iter().map(|arg| resolved(arg, values)));
            words
        };
        let mut sheet = job.command.clone();
        sheet.extend(base(&job));
        sheet.extend(job.after[0].words.iter().cloned());
        sheet.extend(["--frames".to_owned(), farm_export::range_text(&job.frames)]);
        prop_assert_eq!(words_of(&steps[1], &values), sheet);
        // Every variant: the axes go hand in hand.
        let defined = steps[0]["parameterSpace"]["taskParameterDefinitions"].as_sequence().unwrap();
        for (index, variant) in job.variants.iter().enumerate() {
            for (axis, (_, name)) in defined.iter().zip(&variant.axes) {
                let setting = resolved(&strings(&axis["range"])[index], &values);
                prop_assert_eq!(&setting, name);
                values.insert(format!("Task.Param.{}", axis["name"].as_str().unwrap()), setting);
            }
            values.insert("Task.Param.Frame".to_owned(), "1,3".to_owned());
            let mut words = job.command.clone();
            words.extend(base(&job));
            words.extend(job.render.iter().cloned());
            for (axis, name) in &variant.axes {
                words.extend(["--only".to_owned(), format!("{axis}={name}")]);
            }
            words.extend(["--progress", "openjd", "--frames", "1,3"].map(str::to_owned));
            prop_assert_eq!(words_of(&steps[0], &values), words);
        }
    }
}
