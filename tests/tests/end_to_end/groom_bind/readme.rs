//! The command that the README shows, from the root of a checkout.

use std::process::Command;

use end_to_end_tests::{program, workspace};

use super::support::frames;

#[test]
fn the_commands_of_the_readme_that_need_samples_only_run() {
    let read = |name: &str| std::fs::read_to_string(workspace().join(name)).unwrap();
    let readme = read("README.md") + &read("samples/README.md");
    let lines = readme.lines().filter_map(|line| line.strip_prefix("groom-bind samples/"));
    let folder = tempfile::tempdir().unwrap();
    let mut count = 0;
    for line in lines {
        let line = line.split_once(" # ").map_or(line, |(line, _)| line.trim_end());
        let mut arguments = vec![];
        for word in format!("samples/{line}").split_whitespace() {
            let target =
                word.strip_prefix("target/").map(|name| folder.path().join(name).display().to_string());
            arguments.push(target.unwrap_or_else(|| word.to_owned()));
        }
        let run =
            Command::new(program("groom-bind")).args(&arguments).current_dir(workspace()).output().unwrap();
        let words = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(0), "{line}: {words}");
        assert!(!words.contains("warning"), "{line}: {words}");
        if let Some(output) = arguments.iter().find(|word| word.ends_with("nod.usdc")) {
            assert_eq!(frames(output.as_ref()).1.len(), 25, "{line}");
        }
        count += 1;
    }
    assert!(count > 0, "the README shows no command on samples");
}
