//! The program as a shell meets it: exit codes, streams, and what it leaves on the disk.
#![allow(clippy::unwrap_used)] // also the helpers are test code

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples").join(name)
}

/// An empty folder of its own for each test.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fibre-check"));
    // Tables of fur go where tests may write.
    command.current_dir(folder).args(arguments).env("GROOMKIT_CACHE", env!("CARGO_TARGET_TMPDIR"));
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().unwrap()
}

fn words(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_report_is_a_page_and_json_and_the_same_whatever_the_threads() {
    let folder = folder("report");
    let quick = ["report", "--quick", "--samples", "20000", "--color", "0.5,0.3,0.1"];
    let done = run(&folder, &[&quick[..], &["-o", "a b.html", "--json", "-"]].concat());
    assert_eq!(done.status.code(), Some(0), "{}", words(&done));
    let report: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(report["schema"], "fibre-report/1");
    let checks = report["checks"].as_array().unwrap();
    assert!(checks.len() >= 12 && checks.iter().all(|check| check["verdict"] != "fail"));
    assert!(words(&done).contains("pass  White furnace, single precision"), "{}", words(&done));
    let page = std::fs::read_to_string(folder.join("a b.html")).unwrap();
    for part in ["<svg", "White furnace", "All ", "hair, changed on the command line"] {
        assert!(page.contains(part), "no {part}");
    }
    assert!(!page.contains("http") && !page.contains("<script"), "the page must stand alone");
    assert_eq!(names(&folder), ["a b.html"]);

    let mut again = command(&folder, &[&quick[..], &["--json", "-"]].concat());
    let again = again.env("RAYON_NUM_THREADS", "1").output().unwrap();
    let mut other: serde_json::Value = serde_json::from_slice(&again.stdout).unwrap();
    other["about"] = report["about"].clone();
    assert_eq!(other, report, "the number of threads must not show");
}

#[test]
fn a_material_file_and_a_preset_are_checked() {
    let folder = folder("material");
    std::fs::write(folder.join("a.yaml"), "color: [0.4, 0.2, 0.1]\n").unwrap();
    let listed = run(&folder, &["report", "--preset", "list"]);
    let listed = String::from_utf8(listed.stdout).unwrap();
    let preset = listed.lines().next().unwrap();
    for material in [["--material", "a.yaml"], ["--preset", preset]] {
        let done = run(&folder, &[&["report", "--quick", "--samples", "2000"], &material[..]].concat());
        assert_eq!(done.status.code(), Some(0), "{material:?}: {}", words(&done));
    }
}

#[test]
fn a_table_is_evaluated_from_a_file_or_a_pipe() {
    let folder = folder("eval");
    let grid = sample("scattering/grid.csv");
    let done = run(&folder, &["eval", "--csv", grid.to_str().unwrap(), "-o", "out.csv"]);
    assert_eq!(done.status.code(), Some(0), "{}", words(&done));
    let text = std::fs::read_to_string(folder.join("out.csv")).unwrap();
    let input = std::fs::read_to_string(&grid).unwrap();
    assert_eq!(text.lines().count(), input.lines().count());
    let headings: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let at = |name: &str| headings.iter().position(|heading| *heading == name).unwrap();
    for (line, before) in text.lines().zip(input.lines()).skip(1) {
        assert!(line.starts_with(before), "the input is kept as it is: {line}");
        let cells: Vec<&str> = line.split(',').collect();
        let number = |name: &str| cells[at(name)].parse::<f64>().unwrap();
        for what in ["r", "g", "b", "pdf"] {
            let (single, double) = (number(&format!("f32_{what}")), number(&format!("f64_{what}")));
            assert!((single - double).abs() <= 1e-4 * double + 1e-30, "{what}: {line}");
        }
        let lobes = ["R", "TT", "TRT", "residual", "scattered"].map(|lobe| number(&format!("f64_{lobe}_g")));
        let sum: f64 = lobes.iter().sum();
        assert!((sum - number("f64_g")).abs() <= 1e-12 * sum, "the lobes are the whole: {line}");
    }

    let mut piped = command(&folder, &["eval", "--csv", "-"]);
    let mut child = piped.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    let piped = child.wait_with_output().unwrap();
    assert_eq!(piped.stdout, text.as_bytes());
}

#[test]
fn bad_tables_are_told_by_line_and_column_and_leave_nothing() {
    let folder = folder("tables");
    for (number, (table, says)) in [
        ("h,theta_o_deg\n0.1,3\nx,4\n", &["line 3", "`h`", "found `x`", "expected a number"][..]),
        ("h\n2\n", &["line 2", "`h`", "found `2`", "-1..1"]),
        ("theta_i_deg\n91\n", &["line 2", "`theta_i_deg`", "-90..90"]),
        ("phi_deg\nnan\n", &["line 2", "`phi_deg`", "finite"]),
        ("beta_m\n0.3\n7\n", &["line 3", "beta_m", "found 7"]),
        ("eta,sigma_r\n1.5,-1\n", &["line 2", "sigma_a"]),
        ("kappa\n1\n", &["line 2", "kappa"]),
        ("h,wobble\n0,1\n", &["`wobble`", "is not known", "theta_o_deg"]),
        ("h,h\n0,1\n", &["`h`", "twice"]),
        ("h,eta\n0\n", &["line: 2"]),
    ]
    .into_iter()
    .enumerate()
    {
        let name = format!("{number}.csv");
        std::fs::write(folder.join(&name), table).unwrap();
        let refused = run(&folder, &["eval", "--csv", &name, "-o", "out.csv"]);
        let told = words(&refused);
        assert_eq!(refused.status.code(), Some(2), "{table:?}: {told}");
        assert!(told.contains(&name) && refused.stdout.is_empty(), "{table:?}: {told}");
        for part in says {
            assert!(told.contains(part), "{table:?}: no `{part}` in {told}");
        }
        std::fs::remove_file(folder.join(&name)).unwrap();
        assert!(names(&folder).is_empty(), "{table:?}");
    }
}

#[test]
fn what_cannot_be_done_is_refused_before_any_work() {
    let folder = folder("refused");
    for (arguments, says) in [
        (&["report", "-o", "no/such/a.html"][..], "no/such"),
        (&["report", "--preset", "no such hair"], "no such hair"),
        (&["report", "--material", "none.yaml"], "none.yaml"),
        (&["report", "--beta-m", "7"], "beta_m"),
        (&["report", "--beta-m", "nan"], "beta_m"),
        (&["report", "--kappa", "2"], "kappa"),
        (&["report", "--color", "1,2"], "3 numbers"),
        (&["report", "--samples", "0"], "--samples"),
        (&["stability", "-o", "a.png"], ".html"),
        (&["stability", "--only", "no such case"], "no such case"),
        (&["eval", "--csv", "none.csv"], "none.csv"),
        (&["eval"], "--csv"),
        (&["compare", "--csv", "none.csv", "--against", "mitsuba"], "none.csv"),
        (&["compare", "--csv", "none.csv", "--against", "teapot"], "teapot"),
        (&[], "Usage"),
    ] {
        let refused = run(&folder, arguments);
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}: {}", words(&refused));
        assert!(
            words(&refused).contains(says) && refused.stdout.is_empty(),
            "{arguments:?}: {}",
            words(&refused)
        );
        assert!(names(&folder).is_empty(), "{arguments:?}");
    }
}

#[test]
fn extreme_cases_pass_and_are_written_in_three_formats() {
    let folder = folder("stability");
    let outputs = ["-o", "t.html", "-o", "t.json", "-o", "t.csv", "--json"];
    let done = run(&folder, &[&["stability", "--quick"], &outputs[..]].concat());
    assert_eq!(done.status.code(), Some(0), "{}", words(&done));
    assert_eq!(names(&folder), ["t.csv", "t.html", "t.json"]);
    let shared: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(shared["schema"], "error-report/1");
    let table = std::fs::read(folder.join("t.json")).unwrap();
    let table: serde_json::Value = serde_json::from_slice(&table).unwrap();
    let rows = table["rows"].as_array().unwrap();
    assert!(rows.len() >= 15 && rows.iter().all(|row| row["not_numbers"] == 0), "{}", rows.len());
    let page = std::fs::read_to_string(folder.join("t.html")).unwrap();
    assert!(page.contains("<svg") && page.contains("cases pass") && !page.contains("http"));
}

#[test]
fn answers_that_nothing_explains_are_found_wanting() {
    let folder = folder("compare");
    let head = "set,theta_o_deg,h,theta_i_deg,phi_deg,f_r,f_g,f_b,pdf,exact_r,exact_g,exact_b\n";
    std::fs::write(folder.join("a.csv"), format!("{head}x,0,0,0,0,1,1,1,1,1,1,1\n")).unwrap();
    let wanting = run(&folder, &["compare", "--csv", "a.csv", "--against", "mitsuba"]);
    assert_eq!(wanting.status.code(), Some(1), "{}", words(&wanting));
    assert!(String::from_utf8_lossy(&wanting.stdout).contains("x (1 rows): NOT EXPLAINED"));
}

/// A groom of a few strands, in the text format.
fn few_strands() -> String {
    let strand = |k: u32| {
        let points = (0..3).map(move |i| format!("{} 0 {} 0.004\n", f64::from(k) * 0.01, f64::from(i) * 0.1));
        points.collect::<String>()
    };
    (0..20).map(strand).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_sweep_is_a_folder_of_sheets_with_their_page() {
    let folder = folder("sweep");
    std::fs::write(folder.join("few.txt"), few_strands()).unwrap();
    let small =
        ["sweep", "--groom", "few.txt", "--size", "16", "--spp", "2", "--only", "wet", "--only", "alpha"];
    let done = run(&folder, &[&small[..], &["-o", "a/b", "--json"]].concat());
    assert_eq!(done.status.code(), Some(0), "{}", words(&done));
    assert_eq!(names(&folder.join("a/b")), ["alpha.png", "sweeps.html", "sweeps.json", "wet.png"]);
    assert_eq!(done.stdout, std::fs::read(folder.join("a/b/sweeps.json")).unwrap());
    let rows: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    let cells = |row: usize| rows[row]["cells"].as_array().unwrap();
    assert_eq!((rows[0]["name"].as_str(), cells(0).len()), (Some("alpha"), 2));
    assert!(cells(1).iter().all(|cell| cell["mean"][0].as_f64().unwrap() > 0.0), "{rows}");

    let again = run(&folder, &[&small[..], &["-o", "one", "--threads", "1"]].concat());
    assert!(again.status.success() && again.stdout.is_empty(), "{}", words(&again));
    let sheet = |place: &str| std::fs::read(folder.join(place)).unwrap();
    assert!(sheet("a/b/wet.png") == sheet("one/wet.png"), "the number of threads must not show");
}

#[test]
fn colours_are_matched_on_a_groom_and_told() {
    let folder = folder("colors");
    std::fs::write(folder.join("few.txt"), few_strands()).unwrap();
    let small = ["colors", "--groom", "few.txt", "--size", "8", "--spp", "8", "--tolerance", "0.1"];
    let done = run(&folder, &[&small[..], &["--json"]].concat());
    assert!(matches!(done.status.code(), Some(0 | 1)), "{}", words(&done));
    let lines: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    let lines = lines.as_array().unwrap();
    let undecided = lines.iter().any(|line| line["reach"].as_array().unwrap().iter().any(|r| r == "not_yet"));
    assert_eq!(done.status.code() == Some(1), undecided, "wanting where a channel is undecided");
    let table = run(&folder, &small);
    let table = String::from_utf8(table.stdout).unwrap();
    assert_eq!(table.lines().count(), lines.len() + 1);
    for line in lines {
        assert!(table.contains(line["name"].as_str().unwrap()), "{table}");
    }
    assert_eq!(names(&folder), ["few.txt"]);
}

#[test]
fn sweeps_and_colours_that_cannot_be_leave_nothing() {
    let folder = folder("no-sweep");
    std::fs::write(folder.join("few.txt"), few_strands()).unwrap();
    std::fs::write(folder.join("bad.txt"), "1\n3\n0 0 0\n0 nan\n").unwrap();
    std::fs::write(folder.join("no.hair"), "HAIR").unwrap();
    let kept = names(&folder);
    // So many samples that a test which waited for them would not end.
    let forever = ["--spp", "40000000"];
    for (arguments, says) in [
        (&["sweep", "-o", "out", "--groom", "bad.txt"][..], "bad.txt"),
        (&["sweep", "-o", "out", "--groom", "no.hair"], "no.hair"),
        (&["sweep", "-o", "out", "--groom", "none.hair"], "none.hair"),
        (&["sweep", "-o", "out", "--only", "glint"], "beta-m"),
        (&["sweep", "-o", "out", "--groom", "few.txt", "--size", "8"], "16..=4096"),
        (&["sweep", "-o", "few.txt", "--groom", "few.txt"], "few.txt is a file"),
        (&["sweep", "-o", "few.txt/out", "--groom", "few.txt"], "few.txt is a file"),
        (&["colors", "--groom", "bad.txt"], "bad.txt"),
        (&["colors", "--groom", "none.hair"], "none.hair"),
        (&["colors", "--groom", "few.txt", "--size", "7"], "8..=1024"),
        (&["colors", "--groom", "few.txt", "--tolerance", "nan"], "tolerance"),
    ] {
        let refused = run(&folder, &[arguments, &forever].concat());
        let told = words(&refused);
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}: {told}");
        assert!(told.contains(says) && refused.stdout.is_empty(), "{arguments:?}: {told}");
        assert_eq!(names(&folder), kept, "{arguments:?}");
    }
}
