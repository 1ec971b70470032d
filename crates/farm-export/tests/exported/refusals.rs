//! What no format can say is refused by name.

use std::path::PathBuf;

use farm_export::{FarmError, FarmJob, JobVariant, When, command_list, openjd, slurm};

use crate::full_job;

fn of(change: impl FnOnce(&mut FarmJob)) -> FarmJob {
    let mut job = full_job();
    change(&mut job);
    job
}

fn all_refuse(job: &FarmJob, words: &str) {
    let told = [openjd(job).unwrap_err(), slurm(job).unwrap_err(), command_list(job).unwrap_err()];
    for error in told {
        assert!(error.to_string().contains(words), "`{words}` is not in `{error}`");
    }
}

#[test]
fn what_is_missing_or_contradicts_itself_is_refused_everywhere() {
    all_refuse(&of(|job| job.name.clear()), "no name");
    all_refuse(&of(|job| job.command.clear()), "no command");
    all_refuse(&of(|job| job.frames.clear()), "no frames");
    all_refuse(&of(|job| job.frames = vec![3, 3]), "3 after 3");
    all_refuse(&of(|job| job.chunk = 0), "frames a task is 0");
    for seconds in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        all_refuse(&of(|job| job.seconds_a_frame = Some(seconds)), "seconds a frame");
    }
    all_refuse(&of(|job| job.pipeline = "turn.yaml".into()), "`turn.yaml` is relative");
    all_refuse(&of(|job| job.output = "out".into()), "`out` is relative");
    all_refuse(&of(|job| job.inputs.push("hair.usd".into())), "`hair.usd` is relative");
    all_refuse(&of(|job| drop(job.variants[1].axes.pop())), "other axes");
    all_refuse(&of(|job| job.variants[0].axes[0].1.clear()), "without a name");
    all_refuse(&of(|job| job.variants.iter_mut().for_each(|v| v.axes.clear())), "told apart");
    all_refuse(&of(|job| job.after[1].name = "Frames".into()), "`Frames` is empty or taken");
    all_refuse(&of(|job| job.after[1].name = "ContactSheet".into()), "taken");
}

type Place = fn(&mut FarmJob, String);

#[test]
fn control_characters_are_refused_wherever_they_stand() {
    let places: [(&str, Place); 7] = [
        ("the job's name", |job, text| job.name = text),
        ("the word", |job, text| job.command.push(text)),
        ("the word", |job, text| job.settings.push(text)),
        ("the output folder", |job, text| job.output = PathBuf::from(format!("/out/{text}"))),
        ("the setting", |job, text| job.variants[1].axes[0].1 = text),
        ("the step", |job, text| job.after[0].name = text),
        ("the word", |job, text| job.after[1].words.push(text)),
    ];
    for (what, place) in places {
        for character in ['\n', '\0', '\t', '\u{1b}', '\u{7f}', '\u{85}', '\u{2028}'] {
            let job = of(|job| place(job, format!("a{character}b")));
            all_refuse(&job, what);
            assert!(matches!(openjd(&job), Err(FarmError::Control { character: c, .. }) if c == character));
        }
    }
}

#[cfg(unix)]
#[test]
fn paths_that_are_not_unicode_are_refused() {
    use std::os::unix::ffi::OsStringExt;
    let path: PathBuf = std::ffi::OsString::from_vec(b"/show/\xff.yaml".to_vec()).into();
    all_refuse(&of(|job| job.pipeline = path), "not Unicode");
}

#[test]
fn what_only_openjd_cannot_say_is_refused_there() {
    let long = |n: usize| "x".repeat(n);
    let jobs = [
        (of(|job| job.name = long(129)), "128"),
        (of(|job| job.after[0].name = long(65)), "64"),
        (of(|job| job.output = format!("/{}", long(1024)).into()), "1024"),
        (of(|job| job.variants[0].axes[0].1 = long(1025)), "1024"),
        (of(|job| job.settings.push(format!("{{{{{}", long(1024)))), "1024"),
        // Squares: no two gaps are alike, so that no run can be said shortly.
        (of(|job| job.frames = (1..=400).map(|i| i * i).collect()), "the range of frames"),
        (
            of(|job| job.settings.extend((0..60).map(|i| format!("{{{{{i}")))),
            "60 different texts with braces",
        ),
    ];
    for (job, words) in jobs {
        let error = openjd(&job).unwrap_err().to_string();
        assert!(error.contains(words) && error.contains("OpenJD"), "`{words}` is not in `{error}`");
        assert!(slurm(&job).is_ok() && command_list(&job).is_ok());
    }
    let wide = |axes: usize, variants: usize| {
        of(|job| {
            let variant = |v: usize| JobVariant {
                id: v.to_string(),
                axes: (0..axes).map(|a| (format!("a{a}"), format!("n{v}"))).collect(),
            };
            job.variants = (0..variants).map(variant).collect();
        })
    };
    assert!(openjd(&wide(16, 2)).unwrap_err().to_string().contains("16 axes"));
    assert!(openjd(&wide(1, 1025)).unwrap_err().to_string().contains("1025 variants"));
    assert!(openjd(&wide(15, 1024)).is_ok());
}

#[test]
fn nothing_a_job_can_hold_makes_it_panic() {
    let huge = of(|job| {
        job.frames = vec![0, u32::MAX];
        job.chunk = u32::MAX;
        job.seconds_a_frame = Some(f64::MAX);
        job.variants = vec![JobVariant { id: String::new(), axes: Vec::new() }];
        job.after.push(farm_export::AfterStep { name: "x".into(), words: Vec::new(), when: When::Ended });
    });
    assert!(openjd(&huge).is_ok() && slurm(&huge).is_ok() && command_list(&huge).is_ok());
}
