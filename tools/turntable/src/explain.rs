//! Saying what a run would do, and why.

use std::io::{BufWriter, Write};

use turntable::{Plan, Remark};

use crate::json;

/// Prints what a run would do: every step as JSON, or lines for people in which like steps stand together.
pub fn print(plan: &Plan, as_json: bool) -> anyhow::Result<()> {
    if as_json {
        return json::print(&plan.explain());
    }
    let remarks = plan.explain_grouped();
    let width = remarks.iter().map(|r| r.what.chars().count()).max().unwrap_or_default().min(60);
    let mut stdout = BufWriter::new(std::io::stdout().lock());
    for Remark { what, action, why } in &remarks {
        writeln!(stdout, "{action:<9}  {what:<width$}  {why}")?;
    }
    Ok(stdout.flush()?)
}
