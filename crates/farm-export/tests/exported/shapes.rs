//! What the files hold.

use std::collections::BTreeSet;

use farm_export::{BUNDLE_FILES, FarmJob, command_list, frames_a_task, openjd, range_text, slurm};
use proptest::prelude::*;
use serde_yaml::Value;

use crate::full_job;

fn template(job: &FarmJob) -> Value {
    serde_yaml::from_str(&openjd(job).unwrap()[3].1).unwrap()
}

#[test]
fn a_bundle_ends_with_its_template() {
    let bundle = openjd(&full_job()).unwrap();
    assert_eq!(bundle.each_ref().map(|(name, _)| *name), BUNDLE_FILES);
    assert_eq!(BUNDLE_FILES[3], "template.yaml");
    let assets: Value = serde_yaml::from_str(&bundle[0].1).unwrap();
    let assets = &assets["assetReferences"];
    assert_eq!(
        assets["inputs"]["filenames"],
        serde_yaml::from_str::<Value>("[/show/turn.yaml, /show/hair.usd]").unwrap()
    );
    assert_eq!(assets["inputs"]["directories"][0], "/show/obj");
    assert_eq!(assets["outputs"]["directories"][0], "/show/out");
    let values: Value = serde_yaml::from_str(&bundle[1].1).unwrap();
    let flat: Value = serde_yaml::from_str(&bundle[2].1).unwrap();
    let template = template(&full_job());
    let defined = template["parameterDefinitions"].as_sequence().unwrap();
    for value in values["parameterValues"].as_sequence().unwrap() {
        let definition = defined.iter().find(|d| d["name"] == value["name"]).unwrap();
        let is_path = definition["type"] == "PATH";
        assert_eq!(definition["default"].is_null(), is_path, "{definition:?}");
        assert_eq!(definition["dataFlow"].is_null(), !is_path);
        let given = if is_path { &flat[value["name"].as_str().unwrap()] } else { &definition["default"] };
        assert_eq!(given, &value["value"]);
    }
}

#[test]
fn the_steps_wait_for_each_other() {
    let template = template(&full_job());
    assert_eq!(template["specificationVersion"], "jobtemplate-2023-09");
    assert_eq!(template["extensions"][0], "TASK_CHUNKING");
    let steps = template["steps"].as_sequence().unwrap();
    let names: Vec<&str> = steps.iter().map(|s| s["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["Prepare", "Frames", "ContactSheet"]);
    let below: Vec<Option<&str>> = steps.iter().map(|s| s["dependencies"][0]["dependsOn"].as_str()).collect();
    assert_eq!(below, [None, Some("Prepare"), Some("Frames")]);
    for step in steps {
        let run = &step["script"]["actions"]["onRun"];
        assert_eq!(run["command"], "{{Param.Program}}");
        assert_eq!(run["cancelation"]["mode"], "NOTIFY_THEN_TERMINATE");
    }
    let space = &steps[1]["parameterSpace"];
    let defined = space["taskParameterDefinitions"].as_sequence().unwrap();
    assert_eq!(defined[2]["type"], "CHUNK[INT]");
    assert_eq!(defined[2]["range"], "{{Param.Frames}}");
    assert_eq!(defined[2]["chunks"]["rangeConstraint"], "NONCONTIGUOUS");
    assert_eq!(space["combination"], "(Axis1_groom, Axis2_light) * Frame");
    // 3 frames of 12.5 s each.
    let seconds = template["parameterDefinitions"]
        .as_sequence()
        .unwrap()
        .iter()
        .find(|p| p["name"] == "SecondsPerTask");
    assert_eq!(seconds.unwrap()["default"], 38);
}

#[test]
fn a_job_of_one_variant_has_no_axes() {
    let plain = FarmJob::new("plain", "/p.yaml", "/out", 1..=3);
    let template = template(&plain);
    let space = &template["steps"][0]["parameterSpace"];
    assert_eq!(space["taskParameterDefinitions"].as_sequence().unwrap().len(), 1);
    assert!(space["combination"].is_null());
    assert!(!slurm(&plain).unwrap().contains("--only"));
}

#[test]
fn the_script_has_what_slurm_needs() {
    let script = slurm(&full_job()).unwrap();
    for line in [
        "#!/bin/sh",
        "#SBATCH --job-name=two_lights",
        "#SBATCH --array=0-5%100",
        "#SBATCH --requeue",
        "#SBATCH --open-mode=append",
        "#SBATCH --signal=B:TERM@60",
        "0) set -- --only 'groom=smooth' --only 'light=sky'; frames=1-3 ;;",
        "5) set -- --only 'groom=smooth' --only 'light=studio'; frames=7 ;;",
    ] {
        assert!(script.lines().any(|l| l == line), "no line `{line}` in\n{script}");
    }
    let last = script.lines().last().unwrap();
    assert!(
        last.starts_with("exec turntable /show/turn.yaml --out /show/out --set 'render.spp=4' "),
        "{last}"
    );
    assert!(last.ends_with("\"$@\" --frames \"$frames\""), "{last}");
    assert!(script.contains("afterok:$prepare") && script.contains("afterok:$frames"));
    assert!(script.contains("afterany:$ended"));
    // Where the program can tell whether all is done, it is asked, not Slurm.
    let told = slurm(&FarmJob { done: Some(vec!["--is it".into()]), ..full_job() }).unwrap();
    assert!(!told.contains("afterok:$frames") && told.contains("afterany:$frames"), "{told}");
    let many = FarmJob::new("many", "/p.yaml", "/out", 1..=5000).with_chunk(2);
    assert!(slurm(&many).unwrap().contains("MaxArraySize"), "an unusual array is told");
}

#[test]
fn frames_a_task_are_two_to_ten() {
    let cases =
        [(None, 4), (Some(0.001), 10), (Some(20.0), 10), (Some(60.0), 5), (Some(140.0), 2), (Some(1e6), 2)];
    for (seconds, expect) in cases {
        assert_eq!(frames_a_task(seconds), expect, "{seconds:?}");
    }
}

/// What a range expression means, as the specification says it.
fn meaning(text: &str) -> Vec<u32> {
    let mut frames = Vec::new();
    for part in text.split(',') {
        let (range, step) = part.split_once(':').unwrap_or((part, "1"));
        let (first, last) = range.split_once('-').unwrap_or((range, range));
        let number = |text: &str| text.parse::<u32>().unwrap();
        frames.extend((number(first)..=number(last)).step_by(number(step) as usize));
    }
    frames
}

proptest! {
    #[test]
    fn a_range_means_its_frames_each_once(frames in prop::collection::btree_set(0u32..300, 1..80)) {
        let frames: Vec<u32> = frames.into_iter().collect();
        prop_assert_eq!(meaning(&range_text(&frames)), frames);
    }

    #[test]
    fn an_even_step_is_said_shortly(first in 0u32..1000, count in 3u32..400, step in 1u32..40) {
        let frames: Vec<u32> = (0..count).map(|i| first + i * step).collect();
        let text = range_text(&frames);
        prop_assert!(!text.contains(','), "{}", text);
        prop_assert_eq!(meaning(&text), frames);
    }

    /// Every variant gets every frame in exactly one task, whatever the size of the tasks.
    #[test]
    fn tasks_share_out_the_work(count in 1u32..60, chunk in 1u32..12) {
        let job = FarmJob { frames: (1..=count).collect(), chunk, ..full_job() };
        let list = command_list(&job).unwrap();
        let mut seen = BTreeSet::new();
        for line in list.lines().filter(|line| !line.starts_with('#')) {
            let (rest, frames) = line.rsplit_once(" --frames ").unwrap();
            let light = rest.rsplit_once("light=").unwrap().1.trim_end_matches('\'');
            let frames = meaning(frames);
            prop_assert!(frames.len() <= chunk as usize);
            for frame in frames {
                prop_assert!(seen.insert((light.to_owned(), frame)), "twice: {} {}", light, frame);
            }
        }
        prop_assert_eq!(seen.len(), 2 * count as usize);
        let script = slurm(&job).unwrap();
        let tasks = 2 * count.div_ceil(chunk);
        let array = format!("#SBATCH --array=0-{}%100", tasks - 1);
        prop_assert!(script.lines().any(|line| line == array), "{}", array);
    }
}
