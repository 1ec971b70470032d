//! `turntable farm export`: scripts and lists are run, here, and make what the turntable makes.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use end_to_end_tests::{program, run};

use crate::turntable_bench::{Bench, assert_same, contents};

/// Two variants, and a name that wants quoting.
pub const PIPELINE: &str = "version: 1
name: it's \"two\" lights
matrix:
  light:
    warm: {lights: {environment: {constant: [1, 0.9, 0.8]}}}
    cold: {lights: {environment: {constant: [0.7, 0.8, 1]}}}
groom: {sample: {style: wavy, strands: 40, points: 6}}
convert: [groom.txt]
lights: {environment: {constant: [1, 1, 1]}}
turntable: {frames: 5}
render: {width: 16, height: 16, spp: 2, max_bounces: 4}
sheet: {columns: 3, gap: 2}
";

/// The export of a turntable next to it, and the turntable itself, undisturbed.
pub struct Exported {
    pub bench: Bench,
    pub undisturbed: Bench,
}

impl Exported {
    /// A folder whose name wants quoting, exported to.
    pub fn new(flags: &[&str]) -> Exported {
        let undisturbed = Bench::new(PIPELINE);
        undisturbed.make(&[]);
        let bench = Bench::new(PIPELINE);
        let exported = Exported { bench, undisturbed };
        let output = exported.export(flags);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        exported
    }

    pub fn export(&self, flags: &[&str]) -> Output {
        let mut command = Command::new(program("turntable"));
        command.args(["farm", "export"]).arg(self.bench.pipeline()).arg("--out").arg(self.bench.out());
        command.arg("--program").arg(program("turntable")).args(flags);
        command.current_dir(self.bench.folder.path()).output().unwrap()
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.bench.folder.path().join(name)
    }

    /// Everything is there, as an undisturbed run makes it.
    pub fn assert_made(&self) {
        assert_same(&contents(&self.bench.out()), &contents(&self.undisturbed.out()));
        let check = self.bench.command(&["--check"]).output().unwrap();
        assert_eq!(check.status.code(), Some(0), "everything is up to date");
    }
}

fn succeeds(command: &mut Command) -> String {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
#[cfg(unix)]
fn a_list_of_commands_makes_the_frames_line_by_line() {
    let exported = Exported::new(&["--commands", "commands of it", "--chunk", "2"]);
    let text = std::fs::read_to_string(exported.file("commands of it")).unwrap();
    let mut lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    assert_eq!(lines.len(), 2 * 3, "{text}");
    // In another order, and one of them twice.
    lines.reverse();
    lines.push(lines[0]);
    for line in lines {
        succeeds(Command::new("sh").args(["-c", line]));
    }
    // What is to come before and after stands in the comments.
    let quoted: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("#     ")).collect();
    let own: Vec<&&str> = quoted.iter().filter(|line| line.contains("--out")).collect();
    assert_eq!(own.len(), 3, "prepare, contact sheet and report: {quoted:?}");
    for line in own {
        succeeds(Command::new("sh").args(["-c", line]));
    }
    exported.assert_made();
}

/// Stands in for `sbatch`: runs what is submitted at once, every task of an array in turn, and notes how it was called.
#[cfg(unix)]
const SBATCH: &str = r#"#!/bin/sh
echo "$@" >> "$JOBS"
for word do
    case $word in --wrap=*) wrap=${word#--wrap=} ;; esac
    script=$word
done
if [ -n "${wrap-}" ]; then
    sh -c "$wrap" >&2 || exit
else
    last=$(sed -n 's/^#SBATCH --array=0-\([0-9]*\)%.*/\1/p' "$script")
    task=0
    while [ "$task" -le "$last" ]; do
        SLURM_ARRAY_TASK_ID=$task SLURM_CPUS_ON_NODE=2 sh "$script" >&2 || exit
        task=$((task + 1))
    done
fi
wc -l < "$JOBS"
"#;

#[test]
#[cfg(unix)]
fn a_slurm_script_submits_itself_and_its_tasks_make_the_frames() {
    use std::os::unix::fs::PermissionsExt;
    let exported = Exported::new(&["--slurm", "job.sbatch", "--chunk", "2"]);
    let (folder, jobs) = (exported.file("bin"), exported.file("jobs"));
    std::fs::create_dir(&folder).unwrap();
    std::fs::write(folder.join("sbatch"), SBATCH).unwrap();
    std::fs::set_permissions(folder.join("sbatch"), std::fs::Permissions::from_mode(0o755)).unwrap();
    let path = std::env::join_paths(
        [folder].into_iter().chain(std::env::split_paths(&std::env::var_os("PATH").unwrap())),
    )
    .unwrap();
    let mut sh = Command::new("sh");
    sh.arg("job.sbatch").arg("--partition=short").current_dir(exported.bench.folder.path());
    let said = succeeds(sh.env("PATH", path).env("JOBS", &jobs).env_remove("SLURM_ARRAY_TASK_ID"));
    assert_eq!(said, "Prepare: job 1\nFrames: job 2\nContactSheet: job 3\nReport: job 4\n");
    let calls = std::fs::read_to_string(jobs).unwrap();
    let calls: Vec<&str> = calls.lines().collect();
    assert!(
        calls.iter().all(|call| call.contains("--parsable") && call.contains("--partition=short")),
        "{calls:?}"
    );
    assert!(calls[1].contains("--dependency=afterok:1"), "{calls:?}");
    assert!(calls[2].contains("--dependency=afterany:2 ") && calls[2].contains(" --check "), "{calls:?}");
    assert!(calls[3].contains("--dependency=afterany:2:3"), "{calls:?}");
    exported.assert_made();
}

#[test]
fn one_variant_and_some_frames_can_be_exported_alone() {
    let exported = Exported::new(&[
        "--commands",
        "list",
        "--only",
        "light=cold",
        "--frames",
        "2,4",
        "--spp",
        "3",
        "--set",
        "tone.exposure=1",
    ]);
    let text = std::fs::read_to_string(exported.file("list")).unwrap();
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    assert_eq!(lines.len(), 1, "{text}");
    for words in ["--only 'light=cold'", "--frames 2,4", "--set 'tone.exposure=1'", "--set 'render.spp=3'"] {
        assert!(lines[0].contains(words), "`{words}` is not in {}", lines[0]);
    }
    assert!(!text.contains("light=warm"), "{text}");
}

#[test]
fn slips_are_told_and_write_nothing() {
    let exported = Exported::new(&["--commands", "list"]);
    let told = |flags: &[&str], words: &str| {
        let output = exported.export(flags);
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{flags:?}: {text}");
        assert!(text.contains(words), "`{words}` is not in {text}");
    };
    told(&[], "--openjd");
    told(&["--commands", "new", "--chunk", "0"], "--chunk");
    told(&["--commands", "new", "--seconds", "0"], "seconds a frame is 0");
    told(&["--commands", "new", "--frames", "7-9"], "7-9");
    told(&["--commands", "new", "--only", "light=blue"], "blue");
    told(&["--commands", "new", "--steps", "frames"], "--steps");
    told(&["--commands", "new", "--set", "render.spp=four"], "render.spp");
    told(&["--commands", "turn.yaml"], "turn.yaml would be written over");
    told(&["--commands", "no/such/folder/list"], "list");
    // One that cannot be said keeps the others from being written.
    told(&["--commands", "new", "--openjd", "bundle", "--program", "a\nb"], "control character");
    assert!(!exported.file("new").exists() && !exported.file("bundle").exists());
    let help = run("turntable", &["farm", "export", "--help"]);
    assert!(help.status.success());
    assert!(String::from_utf8_lossy(&help.stdout).contains("--slurm"));
}

/// Whatever is there already is replaced whole.
#[test]
fn an_export_replaces_the_one_before_it() {
    let exported = Exported::new(&["--openjd", "bundle", "--slurm", "job", "--commands", "list"]);
    let read = |name: &str| std::fs::read_to_string(exported.file(name)).unwrap();
    let names = [
        "bundle/template.yaml",
        "bundle/parameter_values.yaml",
        "bundle/asset_references.yaml",
        "job",
        "list",
    ];
    let before = names.map(read);
    let again = |flags: &[&str]| {
        let all = [&["--openjd", "bundle", "--slurm", "job", "--commands", "list"], flags].concat();
        assert!(exported.export(&all).status.success());
        names.map(read)
    };
    assert_eq!(again(&[]), before, "the same pipeline, the same files");
    assert_ne!(again(&["--frames", "1-2"])[0], before[0]);
    let left = crate::turntable_bench::files_below(exported.bench.folder.path());
    let left: Vec<&Path> =
        left.iter().map(PathBuf::as_path).filter(|p| crate::turntable_bench::is_hidden(p)).collect();
    assert!(left.is_empty(), "{left:?}");
}
