//! `cyhair-convert --formats`.

use anyhow::Result;
use groom_formats::Format;
use serde_json::json;

use crate::report;

pub(crate) fn run(as_json: bool) -> Result<()> {
    if as_json {
        let formats: Vec<_> = Format::ALL
            .into_iter()
            .map(|format| {
                json!({
                    "name": format.name(),
                    "title": format.title(),
                    "read": format.can_read(),
                    "written": format.can_write(),
                    "built": format.is_built(),
                    "feature": format.feature(),
                    "holds": format.holds(),
                })
            })
            .collect();
        return report::print_json(&json!(formats));
    }
    let word = |yes: bool| if yes { "yes" } else { "-" };
    let mut table = format!("{:9} {:5} {:8} {:28} {}\n", "format", "read", "written", "what it is", "holds");
    for format in Format::ALL {
        let (read, written) = (word(format.can_read()), word(format.can_write()));
        let title = if format.is_built() { format.title() } else { "not built into this program" };
        let line = format!("{:9} {read:5} {written:8} {title:28} {}", format.name(), format.holds());
        table.push_str(line.trim_end());
        table.push('\n');
    }
    report::print(&table)
}
