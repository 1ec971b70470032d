//! One command a line.

use crate::job::only_words;
use crate::shell::sh_line;
use crate::{FarmError, FarmJob, When, range_text};

const FORMAT: &str = "a list of commands";

/// One line for every task, to be run in any order, by any number of machines, as often as one likes.
///
/// What runs before and after stands in comments, which `sh` does nothing for.
///
/// # Errors
/// [`FarmError`] when the job is incomplete or holds what no line can.
pub fn command_list(job: &FarmJob) -> Result<String, FarmError> {
    job.check(FORMAT)?;
    let common = job.common_words()?;
    let tasks = job.tasks();
    let mut lines = vec![
        format!("# {}: {} tasks, a line each. For example:", job.name, tasks.len()),
        "#     parallel --jobs 1 --joblog jobs.log --retries 3 < THIS_FILE".to_owned(),
        "#     hq submit --cpus=all --each-line THIS_FILE sh -c 'eval \"$HQ_ENTRY\"'".to_owned(),
        "#     xargs -d '\\n' -n 1 sh -c < THIS_FILE".to_owned(),
        "# One task at a time on each machine: it takes all cores that it may use.".to_owned(),
        "# Every line may be run again, twice at once, or be killed: frames that are done are skipped, one that was"
            .to_owned(),
        "# begun goes on where its checkpoint stands. Exit code 75 asks for another try.".to_owned(),
        format!(
            "# Taken for granted: every machine finds `{}` and sees the same files under the same names,",
            job.command.join(" ")
        ),
        "# and commands are read by sh or bash.".to_owned(),
    ];
    if let Some(words) = &job.prepare {
        lines.push("# Before all of them, once:".to_owned());
        lines.push(format!("#     {}", sh_line(common.iter().chain(words))));
    }
    for step in &job.after {
        let when = match step.when {
            When::AllDone => "When all of them are done",
            When::Ended => "When all of them have ended, well or not",
        };
        lines.push(format!("# {when} ({}):", step.name));
        lines.push(format!("#     {}", sh_line(common.iter().chain(&after_words(job, &step.words)))));
    }
    for task in tasks {
        let mut words = common.clone();
        words.extend(job.render.iter().cloned().chain(only_words(task.variant)));
        words.extend(["--frames".to_owned(), range_text(task.frames)]);
        lines.push(sh_line(&words));
    }
    Ok(lines.join("\n") + "\n")
}

/// A step after the frames looks after the frames of this job and no others.
pub(crate) fn after_words(job: &FarmJob, words: &[String]) -> Vec<String> {
    let mut all = words.to_vec();
    all.extend(["--frames".to_owned(), range_text(&job.frames)]);
    all
}
