//! `fibre-check eval`: a table of fibres and directions in, values out.

use std::fs::File;
use std::io::{Read, stdin};
use std::path::{Path, PathBuf};

use anyhow::Context;
use command_line::Outcome;
use fibre_verification::{COLUMNS, Tilt};

use crate::output;

/// Evaluates a table of fibres and directions, to compare with another renderer
///
/// CSV with a line of headings in any order; missing columns take their defaults (see --columns). Out come the
/// columns of the input and f cos(theta_i), density and every lobe in single and in double precision. A fault is
/// told with its line and column, and nothing is written.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The table to read (.csv); `-` is stdin
    #[arg(long, value_name = "FILE", required_unless_present = "columns")]
    pub csv: Option<PathBuf>,
    /// The table to write (.csv) [default: stdout]
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub output: PathBuf,
    /// A positive alpha_deg tilts R to the tip, as in pbrt, Mitsuba and RenderMan, and not to the root
    #[arg(long)]
    pub tilt_to_tip: bool,
    /// Print the columns with their ranges and defaults, and do nothing else
    #[arg(long)]
    pub columns: bool,
}

pub fn run(args: &Args) -> anyhow::Result<Outcome> {
    let Some(path) = args.csv.as_ref().filter(|_| !args.columns) else {
        output::write(Path::new("-"), &columns())?;
        return Ok(Outcome::Good);
    };
    output::check(&args.output)?;
    let tilt = if args.tilt_to_tip { Tilt::ToTip } else { Tilt::ToRoot };
    let mut table = Vec::new();
    let named = || path.display().to_string();
    fibre_verification::eval(open(path)?, &mut table, tilt).with_context(named)?;
    output::write(&args.output, &String::from_utf8(table)?)?;
    Ok(Outcome::Good)
}

/// Opens a table; `-` is stdin.
pub fn open(path: &Path) -> anyhow::Result<Box<dyn Read>> {
    if path.as_os_str() == "-" {
        return Ok(Box::new(stdin().lock()));
    }
    let file = File::open(path).with_context(|| path.display().to_string())?;
    Ok(Box::new(std::io::BufReader::new(file)))
}

/// The columns as a table of words.
fn columns() -> String {
    let mut text = String::from("column            default  what it is\n");
    text += "set                        any name\n";
    for column in COLUMNS {
        let default = column.default.map_or(String::new(), |default| default.to_string());
        text += &format!("{:<16}  {default:>7}  {}\n", column.name, column.about);
    }
    text + "f_r f_g f_b pdf exact_r exact_g exact_b: answers of another renderer, for `fibre-check compare`\n"
}
