//! Job bundles, as Open Job Description's own programs check and run them.

use std::path::Path;
use std::process::{Command, Output};

use end_to_end_tests::validators::python;
use farm_export::{FarmJob, JobVariant, When, openjd};

use crate::farm_files::Exported;

/// `openjd WORDS`, in a bundle's folder; its sessions' files go below `scratch`.
fn openjd_cli(python: &Path, bundle: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(python);
    command.args(["-m", "openjd"]).args(words).current_dir(bundle);
    command.env("TMPDIR", bundle).output().unwrap()
}

fn succeeds(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{text}\n{}", String::from_utf8_lossy(&output.stderr));
    text
}

#[test]
fn a_bundle_is_sound_and_running_it_makes_the_turntable() {
    let Some(python) = python() else { return };
    let exported = Exported::new(&["--openjd", "bundle", "--chunk", "3"]);
    let bundle = exported.file("bundle");
    let checked = succeeds(&openjd_cli(&python, &bundle, &["check", "template.yaml"]));
    assert!(checked.contains("passes validation"), "{checked}");
    let run = ["run", "template.yaml", "--step", "ContactSheet", "--run-dependencies"];
    let values = ["-p", "file://values.yaml", "-p", "Frames=1-5"];
    let told = succeeds(&openjd_cli(&python, &bundle, &[&run[..], &values].concat()));
    // One to prepare, two for each of two variants, one for the sheet.
    assert!(told.contains("Chunks run: 6"), "{told}");
    assert!(told.contains("openjd_progress: 100"), "progress is told: {told}");
    exported.assert_made();
}

#[test]
fn what_a_bundle_cannot_mean_its_reader_refuses() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let job = FarmJob::new("job", "/p.yaml", "/out", 1..=3);
    let [.., (name, template)] = openjd(&job).unwrap();
    // The check can fail: a name of the specification misspelt, a parameter that is not there.
    for (right, wrong) in [("CHUNK[INT]", "CHUNK[INTS]"), ("{{Param.Output}}", "{{Param.Outputs}}")] {
        assert!(template.contains(right));
        std::fs::write(folder.path().join(name), template.replace(right, wrong)).unwrap();
        let output = openjd_cli(&python, folder.path(), &["check", name]);
        assert!(!output.status.success(), "{wrong} was taken");
    }
}

/// Words that want quoting somewhere on the way: in YAML, in a format string, in the shell script the session writes.
const SPITEFUL: [&str; 16] = [
    "{{",
    "}}",
    "{{Param.Frames}}",
    "it's",
    "\"",
    "\\",
    "$HOME",
    "`id`",
    "a b",
    "-",
    "#",
    ": ",
    "髪 😀",
    "{",
    "%s",
    "'\\''",
];

#[test]
fn words_arrive_as_they_were_exported() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log");
    let recorder = folder.path().join("record it.py");
    std::fs::write(
        &recorder,
        "import json, sys\nopen(sys.argv[1], 'a').write(json.dumps(sys.argv[2:]) + '\\n')\n",
    )
    .unwrap();
    let text = |path: &Path| path.to_str().unwrap().to_owned();
    // Chosen by a hash, so that a failure comes again.
    let word = |id: u32| {
        let part = |k: u32| SPITEFUL[(groom::random(3, 8 * id + k, "word") * SPITEFUL.len() as f32) as usize];
        format!("w{}{}{}", part(0), part(1), part(2))
    };
    let words: Vec<String> = (0..24).map(word).collect();
    let variant = |id: u32| JobVariant {
        id: id.to_string(),
        axes: vec![("hair".into(), word(100 + id)), ("light".into(), word(200 + id))],
    };
    let job = FarmJob {
        command: vec![text(&python), text(&recorder), text(&log)],
        settings: words.clone(),
        variants: (0..3).map(variant).collect(),
        ..FarmJob::new(word(300), format!("/show/{}.yaml", word(301)), format!("/show/{}", word(302)), 1..=6)
    }
    .with_chunk(3)
    .with_after("Sheet", &["--last", &word(303)], When::AllDone);
    for (name, text) in openjd(&job).unwrap() {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let run = ["run", "template.yaml", "--step", "Sheet", "--run-dependencies", "-p", "file://values.yaml"];
    let told = succeeds(&openjd_cli(&python, folder.path(), &run));
    assert!(told.contains(&format!("Job: {}", job.name)), "{told}");

    let calls = std::fs::read_to_string(log).unwrap();
    let calls: Vec<Vec<String>> = calls.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let mut expected = Vec::new();
    let base = [vec![text(&job.pipeline), "--out".into(), text(&job.output)], words].concat();
    for variant in &job.variants {
        let axes = variant.axes.iter();
        let only: Vec<String> = axes.flat_map(|(a, n)| ["--only".to_owned(), format!("{a}={n}")]).collect();
        for frames in ["1-3", "4-6"] {
            let end = ["--progress", "openjd", "--frames", frames].map(str::to_owned);
            expected.push([&base[..], &only, &end].concat());
        }
    }
    let end = ["--last", &word(303), "--frames", "1-6"].map(str::to_owned);
    expected.push([&base[..], &end].concat());
    assert_eq!(calls, expected);
}
