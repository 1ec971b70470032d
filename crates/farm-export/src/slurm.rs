//! A Slurm script that submits itself.

use crate::commands::after_words;
use crate::job::{Task, only_words};
use crate::shell::{sh_line, sh_quoted};
use crate::{FarmError, FarmJob, When, range_text};

const FORMAT: &str = "a Slurm script";

/// Tasks of one array that run at the same time.
const AT_ONCE: u32 = 100;

/// Seconds before the end of its time at which a task is told, so that it can write its checkpoint.
const NOTICE: u32 = 60;

/// What Slurm allows in one array unless its `MaxArraySize` says otherwise.
const USUAL_ARRAY: usize = 1001;

/// One file: `sh FILE` submits the whole job (prepare, then the array of frames, then the steps after them),
/// `sbatch FILE` the frames alone.
///
/// # Errors
/// [`FarmError`] when the job is incomplete or holds what a script cannot.
pub fn slurm(job: &FarmJob) -> Result<String, FarmError> {
    job.check(FORMAT)?;
    let common = job.common_words()?;
    let tasks = job.tasks();
    let last = tasks.len() - 1;
    let mut script = format!(
        "#!/bin/sh\n{}\n\
         #SBATCH --job-name={}\n\
         #SBATCH --array=0-{last}%{AT_ONCE}\n\
         #SBATCH --requeue\n\
         #SBATCH --open-mode=append\n\
         #SBATCH --signal=B:TERM@{NOTICE}\n\n",
        head(job, tasks.len()),
        label(&job.name),
    );
    script += &submission(job, &common)?;
    script += "\ncase $SLURM_ARRAY_TASK_ID in\n";
    for (index, task) in tasks.iter().enumerate() {
        script += &format!("{index}) {} ;;\n", task_words(task));
    }
    script += "*) echo \"no task $SLURM_ARRAY_TASK_ID in this script\" >&2; exit 2 ;;\nesac\n\n";
    script += "# In place of this shell, so that Slurm's signals reach the renderer.\n";
    script += &format!(
        "exec {} --threads \"${{SLURM_CPUS_ON_NODE:-1}}\" \"$@\" --frames \"$frames\"\n",
        sh_line(common.iter().chain(&job.render))
    );
    Ok(script)
}

fn task_words(task: &Task) -> String {
    let only = only_words(task.variant);
    let only = if only.is_empty() { "set --".to_owned() } else { format!("set -- {}", sh_line(&only)) };
    format!("{only}; frames={}", range_text(task.frames))
}

/// What the reader of the file should know.
fn head(job: &FarmJob, tasks: usize) -> String {
    let mut lines = vec![
        format!("# {}: {tasks} tasks of up to {} frames.", job.name, job.chunk),
        "#".to_owned(),
        "#     sh THIS_FILE [OPTIONS OF sbatch]     submits everything, in order".to_owned(),
        "#     sbatch THIS_FILE                     the frames alone".to_owned(),
        "#".to_owned(),
        "# May be submitted again at any time: frames that are done are skipped, one that was begun goes on where".to_owned(),
        "# its checkpoint stands. A task on a node that dies is queued again by Slurm (--requeue).".to_owned(),
        "# Taken for granted:".to_owned(),
        format!("# - every node finds `{}` and sees the same files under the same names;", job.command.join(" ")),
        "# - `RequeueExit=75` stands in slurm.conf: a task that was stopped (its time was up, scancel --batch --signal=TERM)"
            .to_owned(),
        "#   writes a checkpoint and exits with 75, which asks for another try. Without that line it counts as failed,"
            .to_owned(),
        "#   and `sh THIS_FILE` goes on;".to_owned(),
        "# - partition, account, time and memory are the cluster's defaults; others are options of sbatch, as above."
            .to_owned(),
    ];
    if tasks > USUAL_ARRAY {
        lines.push(format!(
            "# - MaxArraySize in slurm.conf is above {tasks}; it usually is {USUAL_ARRAY} (more frames a task make fewer tasks)."
        ));
    }
    lines.join("\n")
}

/// What runs when the file is started by hand: outside an array there is no task number.
fn submission(job: &FarmJob, common: &[String]) -> Result<String, FarmError> {
    let mut lines = vec![
        "if [ -z \"${SLURM_ARRAY_TASK_ID:-}\" ]; then".to_owned(),
        "    set -eu".to_owned(),
        "    id() { echo \"${1%%;*}\"; }     # sbatch --parsable says JOB;CLUSTER where there are several"
            .to_owned(),
        "    after=".to_owned(),
    ];
    let step = |name: &str, first: &str, words: &[String]| {
        let command = format!(
            "{first}exec {} --threads \"${{SLURM_CPUS_ON_NODE:-1}}\"",
            sh_line(common.iter().chain(words))
        );
        let name = label(&format!("{}-{name}", job.name));
        format!(
            "--job-name={name} --requeue --open-mode=append --signal=B:TERM@{NOTICE} \"$@\" --wrap={}",
            sh_quoted(&command)
        )
    };
    if let Some(words) = &job.prepare {
        lines.push(format!("    prepare=$(sbatch --parsable {})", step("Prepare", "", words)));
        lines.push("    prepare=$(id \"$prepare\")".to_owned());
        lines.push("    echo \"Prepare: job $prepare\"".to_owned());
        lines.push("    after=\"--dependency=afterok:$prepare --kill-on-invalid-dep=yes\"".to_owned());
    }
    // `$after` is two words or none.
    lines.push("    frames=$(sbatch --parsable $after \"$@\" \"$0\")".to_owned());
    lines.push("    frames=$(id \"$frames\")".to_owned());
    lines.push("    echo \"Frames: job $frames\"".to_owned());
    lines.push("    ended=$frames".to_owned());
    for after in &job.after {
        // What is to run in any case comes last, or two would do the same work side by side.
        let (dependency, first) = match (after.when, &job.done) {
            // `afterok` never comes true of an array with a task that exited with 75, though it was queued again and
            // ended well.
            (When::AllDone, Some(done)) => {
                let done = after_words(job, done);
                ("afterany:$frames\"", format!("{} && ", sh_line(common.iter().chain(&done))))
            }
            (When::AllDone, None) => ("afterok:$frames\" --kill-on-invalid-dep=yes", String::new()),
            (When::Ended, _) => ("afterany:$ended\"", String::new()),
        };
        let step = step(&after.name, &first, &after_words(job, &after.words));
        lines.push(format!("    step=$(sbatch --parsable --dependency=\"{dependency} {step})"));
        lines.push("    step=$(id \"$step\")".to_owned());
        lines.push("    ended=$ended:$step".to_owned());
        lines.push(format!("    echo {}\": job $step\"", sh_quoted(&after.name)));
    }
    lines.extend(["    exit".to_owned(), "fi\n".to_owned()]);
    Ok(lines.join("\n"))
}

/// A job's name as sbatch takes it on a `#SBATCH` line, whose own quoting is no shell's: other characters become
/// `_`. It is a label and nothing is found by it.
fn label(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() || "-._".contains(c) { c } else { '_' }).collect()
}
