//! Sets up, tests and benchmarks groomkit: `cargo xtask help`.

mod bench;
mod gate;
mod setup;
mod shell;

use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask COMMAND

  setup   install what the tests use into target/ (usd-core, openjd-cli, ffmpeg, a browser, the Khronos glTF validator)
  test    everything a change must pass: setup, format, lints, tests, docs, features, fuzz targets, licences
  bench   print speed and memory figures (release build; the machine should be idle)
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match words[..] {
        ["setup"] => setup::validators().map(drop),
        ["test"] => gate::test(),
        ["bench"] => bench::all(),
        ["help" | "--help" | "-h"] => {
            shell::say(USAGE);
            Ok(())
        }
        _ => Err(anyhow::anyhow!("unknown command {words:?}\n\n{USAGE}")),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            shell::say(&format!("error: {error:#}"));
            ExitCode::from(2)
        }
    }
}
