//! Making what is missing or out of date.

use anyhow::ensure;
use command_line::{Outcome, ProgressStyle, snapshot_asked};
use turntable::{FrameLine, Plan, Summary, TurntableError};

use crate::args::RunArgs;
use crate::progress::Teller;
use crate::{explain, json};

/// Runs a pipeline, or says what a run would do.
pub fn run(args: &RunArgs) -> anyhow::Result<Outcome> {
    let makes_nothing = args.explain || args.check;
    ensure!(
        makes_nothing || !args.tell.json || args.tell.progress == ProgressStyle::Bar,
        "--json and --progress would both write to stdout"
    );
    if !makes_nothing {
        // From here on a signal is answered where the work can be kept, and with the exit code that asks for more.
        command_line::on_interrupt_ask();
        command_line::on_snapshot_ask();
    }
    let plan = Plan::new(&args.pipeline(), args.options())?;
    if makes_nothing {
        explain::print(&plan, args.tell.json)?;
        let wanting = args.check && !plan.is_up_to_date();
        return Ok(if wanting { Outcome::Wanting } else { Outcome::Good });
    }
    let _ = snapshot_asked(); // whoever asked before there was anything to see
    let teller = Teller::new(&args.tell, plan.name());
    let result = plan.run(&teller);
    teller.meter.finish();
    match result {
        Ok(summary) => {
            for failure in &summary.failed {
                teller.meter.say(&format!("error: {failure}"));
            }
            teller.meter.say(&closing_words(&summary));
            if args.tell.json {
                json::print(&summary)?;
            }
            if summary.failed.is_empty() {
                return Ok(Outcome::Good);
            }
            teller.meter.fail(&summary.failed.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "));
            Ok(Outcome::Failed)
        }
        Err(TurntableError::Interrupted) => {
            teller.meter.say("stopped, with its work kept; run the same command again to go on");
            Ok(Outcome::TryAgain)
        }
        Err(error) => {
            teller.meter.fail(&error.to_string());
            Err(error.into())
        }
    }
}

fn closing_words(summary: &Summary) -> String {
    let rendered: Vec<&FrameLine> = summary.frames.iter().filter(|f| f.rendered).collect();
    let folder = summary.output.display();
    let failed = match summary.failed.len() {
        0 => String::new(),
        count => format!(", {count} failed"),
    };
    let worst = rendered.iter().filter_map(|f| f.relative_error).fold(0.0, f64::max);
    let errors =
        if worst > 0.0 { format!(", relative error at most {:.1} %", 100.0 * worst) } else { String::new() };
    let (made, kept, seconds) = (summary.made.len(), summary.up_to_date, summary.seconds);
    let made = match rendered.len() {
        _ if made == 0 => "nothing made".to_owned(),
        count => format!("{made} files made ({count} frames rendered{errors})"),
    };
    format!("{folder}: {made}, {kept} up to date{failed}, {seconds:.1} s")
}
