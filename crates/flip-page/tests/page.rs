//! The page in a browser: driven as a person would, its pixels held against `frame-comp`'s.
#![allow(clippy::unwrap_used, clippy::panic, clippy::explicit_write)]

use std::io::Write as _;
use std::path::Path;
use std::process::Command;

use error_report::{Point, Report, Series};
use flip_page::{Axis, Curve, Page, Shot, Tone, Variant};
use frame_comp::Weights;
use glam::Vec3;
use hair_render::{Aov, Backdrop, Frame, FrameReport, Preview, ToneMapping};
use serde_json::{Value, json};

const SIZE: (u32, u32) = (96, 72);
const BACKDROP: f32 = 0.18;
const PASSES: [Aov; 4] = [Aov::R, Aov::Tt, Aov::Trt, Aov::Residual];
/// What would run, load or break out if it were not escaped.
const EVIL: &str = "</script><img src=http://evil.test/x onerror=\"window.hit=1\">&amp;\u{2028}'\\\"";

/// Streaks as hair has them: bright and dark side by side, deep colours, thin coverage; residual is black.
fn frame(variant: usize, number: u32) -> Frame {
    let count = (SIZE.0 * SIZE.1) as usize;
    let wave = |i: usize, k: f32| {
        let (x, y) = ((i % SIZE.0 as usize) as f32, (i / SIZE.0 as usize) as f32);
        0.5 + 0.5 * ((x + number as f32 * 3.0) * (0.11 + 0.07 * k) + y * (0.4 - 0.1 * k) + k).sin()
    };
    let alpha: Vec<f32> = (0..count).map(|i| (wave(i, 3.0) * 1.5 - 0.2).clamp(0.0, 1.0)).collect();
    let colors = [Vec3::splat(1.5), Vec3::new(0.9, 0.3, 0.05), Vec3::new(0.5, 0.2, 0.01), Vec3::ZERO];
    let pass = |p: usize| -> Vec<Vec3> {
        let tint = colors[p] * (1.0 + 0.5 * variant as f32);
        let light = |i: usize| tint * wave(i, p as f32).powi(6) * alpha[i];
        (0..count).map(light).collect()
    };
    let passes: Vec<(Aov, Vec<Vec3>)> = PASSES.into_iter().zip((0..4).map(pass)).collect();
    let beauty = (0..count).map(|i| passes.iter().map(|(_, pixels)| pixels[i]).sum()).collect();
    let report = FrameReport::default();
    Frame { width: SIZE.0, height: SIZE.1, cutout: None, beauty, alpha, passes, report }
}

/// Exposure of each variant.
const EXPOSURES: [f32; 2] = [0.5, -0.25];
/// What the second variant's TT is weighed by.
const OWN_TT: f32 = 0.5;

fn mapping(variant: usize, stops: f32) -> ToneMapping {
    ToneMapping {
        exposure: EXPOSURES[variant] + stops,
        backdrop: Backdrop::Solid(Vec3::splat(BACKDROP)),
        ..Default::default()
    }
}

/// What `frame-comp` makes of it; what `weights` does not say is as the variant has it.
fn expected(variant: usize, number: u32, weights: &str, stops: f32) -> Preview {
    let own = if variant == 1 && !weights.contains("TT=") { format!("TT={OWN_TT}") } else { String::new() };
    let words: Vec<&str> = [weights, &own].into_iter().filter(|words| !words.is_empty()).collect();
    let weights: Weights = words.join(",").parse().unwrap();
    let weighed = frame_comp::reweigh(&frame(variant, number), &weights).unwrap();
    frame_comp::shown(&weighed, None, frame_comp::Fit::Fill, &mapping(variant, stops))
}

/// Two variants of four frames, the last of which keeps no passes; the second is shown darker, and with less TT.
fn page() -> Page {
    let names = PASSES.map(Aov::name);
    let mut series = Series::cases(EVIL, "relative error", EVIL, 0.5);
    let mut page = Page::new(EVIL, &names)
        .with_axes(vec![Axis { name: EVIL.into(), settings: vec!["smooth".into(), EVIL.into()] }])
        .with_left_out(vec![(EVIL.into(), EVIL.into())])
        .with_about(vec![("command".into(), EVIL.into())]);
    for (index, setting) in ["smooth", EVIL].into_iter().enumerate() {
        let parameters = vec![
            ("render.spp".to_owned(), "16".to_owned()),
            ("material.beta_m".to_owned(), format!("0.{index}")),
            (EVIL.to_owned(), EVIL.to_owned()),
        ];
        let exposure = EXPOSURES[index];
        let tone = Tone { exposure, curve: Curve::Neutral, backdrop: [BACKDROP; 3], plate: None };
        let weights = (index == 1).then(|| ("TT".to_owned(), OWN_TT)).into_iter().collect();
        let settings = vec![setting.into()];
        let variant = page.variant(Variant { id: setting.into(), settings, weights, parameters }, tone);
        for number in 1..=4 {
            let frame = frame(index, number);
            let shown = expected(index, number, "", 0.0);
            let rgb: Vec<u8> = shown.rgba.chunks(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
            let layers: Vec<Vec<[f32; 3]>> =
                frame.passes.iter().map(|(_, pixels)| pixels.iter().map(Vec3::to_array).collect()).collect();
            let slices: Vec<&[[f32; 3]]> = layers.iter().map(Vec::as_slice).collect();
            let seconds = f64::from(number) * 1.5;
            series.points.push(Point::new(format!("{setting} {number}"), seconds, 0.1 / seconds));
            let shot = Shot {
                number,
                facts: vec![("error".into(), EVIL.into())],
                width: SIZE.0,
                height: SIZE.1,
                shown: &rgb,
                alpha: &frame.alpha,
                layers: (number < 4).then_some(&slices),
            };
            page.shot(variant, &shot).unwrap();
        }
    }
    page.with_report(Report::new("r").with_series(series))
}

/// What the browser says after `steps`; `None`, said aloud, where there is no browser or no node.
fn driven(html: &Path, folder: &Path, steps: &Value) -> Option<Value> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let file = folder.join("steps.json");
    std::fs::write(&file, steps.to_string()).unwrap();
    // The machine's node, else the one `cargo xtask setup` installs.
    let installed = root.join("target/venv/bin/node");
    let node = if installed.exists() { installed.as_os_str() } else { "node".as_ref() };
    let output = Command::new(node)
        .arg(root.join("tests/validators/drive_page.mjs"))
        .args([html, &file, &root.join("target/npm")])
        .output();
    let skip = |why: &str| {
        writeln!(std::io::stderr(), "skipped: {why}; `cargo xtask setup` installs one").unwrap();
        None
    };
    let output = match output {
        Err(_) => return skip("no node"),
        Ok(output) if output.status.code() == Some(3) => return skip("no chromium"),
        Ok(output) => output,
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["console"], json!([]), "the console stays empty");
    let requests = report["requests"].as_array().unwrap();
    assert!(requests.len() == 1 && requests[0].as_str().unwrap().starts_with("file:"), "{requests:?}");
    Some(report)
}

const PIXELS: &str = "[...canvas0.getContext('2d').getImageData(0,0,canvas0.width,canvas0.height).data]";

/// The largest difference of a channel, in steps of 255.
fn off(found: &Value, expected: &Preview) -> i64 {
    let found = found.as_array().unwrap();
    assert_eq!(found.len(), expected.rgba.len());
    let steps = found.iter().zip(&expected.rgba).map(|(a, &b)| (a.as_i64().unwrap() - i64::from(b)).abs());
    steps.max().unwrap()
}

#[test]
fn the_page_shows_what_the_pngs_show_however_it_is_turned_and_weighed() {
    let folder = tempfile::tempdir().unwrap();
    let html = folder.path().join("page.html");
    let bytes = page().write(&html).unwrap();
    assert_eq!(bytes, std::fs::metadata(&html).unwrap().len());
    let input = |id: &str, value: f64| json!({ "eval": format!("{id}.value={value},{id}.dispatchEvent(new Event('input',{{bubbles:true}})),0") });
    let eval = |script: &str| json!({ "eval": script });
    let pick = |id: &str, value: u32| json!({ "eval": format!("(m=>(m.value={value},m.dispatchEvent(new Event('change'))))(document.getElementById('{id}'))&&0") });
    let steps = json!([
        eval(PIXELS),                                     // 0: beauty, frame 1
        input("frame", 2.0),                              // 1
        eval(PIXELS),                                     // 2: frame 3
        { "key": "2" },                                   // TT alone
        eval(PIXELS),                                     // 3
        { "key": "0" },
        input("weight1", 0.5),                            // 4
        input("weight2", 2.0),                            // 5
        input("stops", -1.0),                             // 6
        eval(PIXELS),                                     // 7: weighed and exposed
        eval("location.hash"),                            // 8
        { "key": "ArrowLeft" },
        eval(PIXELS),                                     // 9: frame 2
        eval("reset.click()"),                            // 10
        pick("axis0-0", 1),                               // 11
        eval(PIXELS),                                     // 12: the other variant, frame 2
        eval("document.querySelectorAll('tr.differs').length"), // 13
        { "key": "c" },
        eval("[side1.hidden, canvas1.dataset.shown]"),    // 14
        eval("document.querySelectorAll('#passes .pass').length"), // 15
        { "key": "End" },
        eval("[canvas0.dataset.shown, caption0.textContent]"), // 16: no passes kept
        { "key": "ArrowRight" },
        eval("said0.textContent && document.getElementById('said-frame').textContent"), // 17: round
        eval("[window.hit, document.images.length, document.title, fault.textContent]"), // 18
        { "drag": [0.2, 0.5, 0.7, 0.5], "on": "canvas0" },
        eval("document.getElementById('said-frame').textContent"), // 19
        eval("new Promise(d=>{play.click();setTimeout(()=>{play.click();d(1)},400)})"), // 20
        eval("fetch('http://evil.test/').then(()=>'out',()=>'held')"), // 21, last: it is told on the console
    ]);
    let mut steps = steps;
    let fetch = steps.as_array_mut().unwrap().pop().unwrap();
    let Some(report) = driven(&html, folder.path(), &steps) else { return };
    let result = &report["results"];
    let near = |index: usize, variant: usize, number: u32, weights: &str, stops: f32| {
        let off = off(&result[index], &expected(variant, number, weights, stops));
        assert!(off <= 2, "result {index}: {off} steps off");
    };
    near(0, 0, 1, "", 0.0);
    near(2, 0, 3, "", 0.0);
    near(3, 0, 3, "R=0,TRT=0,residual=0", 0.0);
    near(7, 0, 3, "TT=0.5,TRT=2", -1.0);
    near(9, 0, 2, "TT=0.5,TRT=2", -1.0);
    near(12, 1, 2, "", 0.0);
    // It must be able to fail: another frame is far off.
    assert!(off(&result[0], &expected(0, 2, "", 0.0)) > 20);
    let hash = result[8].as_str().unwrap();
    for part in ["frame=3", "w.TT=0.5", "w.TRT=2", "stops=-1"] {
        assert!(hash.contains(part), "{hash}");
    }
    assert_eq!(result[13], json!(1), "one parameter differs");
    assert_eq!(result[14], json!([false, "exact"]));
    assert_eq!(result[15], json!(4), "beauty and three passes: the black one is left out");
    assert_eq!(result[16][0], json!("ready-made"));
    assert_eq!(result[17], json!("1 / 4"));
    assert_eq!(result[18], json!([null, 0, EVIL, ""]), "nothing broke out");
    assert_eq!(result[19], json!("3 / 4"), "half across the picture is half around");

    // Its own policy holds even what somebody types into the console.
    let held = json!([fetch]);
    std::fs::write(folder.path().join("held.json"), held.to_string()).unwrap();
    let again = folder.path().join("again.html");
    std::fs::copy(&html, &again).unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let installed = root.join("target/venv/bin/node");
    let node = if installed.exists() { installed.as_os_str() } else { "node".as_ref() };
    let output = Command::new(node)
        .arg(root.join("tests/validators/drive_page.mjs"))
        .args([&again, &folder.path().join("held.json"), &root.join("target/npm")])
        .output()
        .unwrap();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["results"], json!(["held"]));
    assert!(!report["requests"].to_string().contains("evil"), "{report}");
}

#[test]
fn two_variants_are_compared_by_a_wipe_and_by_their_difference() {
    let folder = tempfile::tempdir().unwrap();
    let html = folder.path().join("page.html");
    page().write(&html).unwrap();
    let eval = |script: &str| json!({ "eval": script });
    let both = "[canvas0, canvas1].map(c=>[...c.getContext('2d').getImageData(0,0,c.width,c.height).data])";
    let steps = json!([
        { "key": "c" },
        eval(both), // 0
        { "key": "w" },
        eval(PIXELS), // 1
        { "drag": [0.5, 0.5, 0.25, 0.5], "on": "canvas0" },
        eval(PIXELS), // 2
        eval("[location.hash, side1.hidden, canvas0.dataset.shown]"), // 3
        { "key": "d" },
        eval(PIXELS), // 4
        eval("[location.hash, caption0.textContent]"), // 5
        { "key": "d" },
        eval("[location.hash, side1.hidden]"), // 6
    ]);
    let Some(report) = driven(&html, folder.path(), &steps) else { return };
    let result = &report["results"];
    let (a, b) = (&result[0][0], &result[0][1]);
    assert!(off(a, &expected(0, 1, "", 0.0)) <= 2 && off(b, &expected(1, 1, "", 0.0)) <= 2);
    let values =
        |of: &Value| -> Vec<i64> { of.as_array().unwrap().iter().map(|v| v.as_i64().unwrap()).collect() };
    let (a, b) = (values(a), values(b));
    let wiped = |of: &Value, cut: usize| {
        for (index, value) in values(of).into_iter().enumerate() {
            let column = index / 4 % SIZE.0 as usize;
            let wanted = if column < cut { a[index] } else { b[index] };
            assert!(value == wanted || column == cut, "column {column}, line {cut}: {value}, not {wanted}");
        }
    };
    wiped(&result[1], SIZE.0 as usize / 2);
    let hash = result[3][0].as_str().unwrap();
    let cut = hash.split("cut=").nth(1).unwrap().split('&').next().unwrap().parse::<f64>().unwrap();
    assert!((cut - 0.25).abs() < 0.02 && hash.contains("view=wipe"), "{hash}");
    wiped(&result[2], (cut * f64::from(SIZE.0)).round() as usize);
    assert_eq!((&result[3][1], &result[3][2]), (&json!(true), &json!("exact")));
    for (index, value) in values(&result[4]).into_iter().enumerate() {
        let apart = if index % 4 == 3 { 255 } else { (4 * (a[index] - b[index]).abs()).min(255) };
        assert_eq!(value, apart, "{index}");
    }
    assert!(values(&result[4]).iter().any(|&v| v > 40 && v < 255), "they differ");
    assert!(result[5][0].as_str().unwrap().contains("view=difference"));
    assert!(result[5][1].as_str().unwrap().ends_with("\u{d7}  4"), "{}", result[5][1]);
    assert!(!result[6][0].as_str().unwrap().contains("view=") && result[6][1] == json!(true));
}

#[test]
fn an_address_opens_what_it_says() {
    let folder = tempfile::tempdir().unwrap();
    let html = folder.path().join("page.html");
    page().write(&html).unwrap();
    let address = format!("file://{}#frame=2&pass=TRT&stops=1&a=smooth&w.R=x&frame=9", html.display());
    let steps = json!([{ "eval": PIXELS }]);
    let Some(report) = driven(Path::new(&address), folder.path(), &steps) else { return };
    let expected = expected(0, 2, "R=0,TT=0,residual=0", 1.0);
    assert!(off(&report["results"][0], &expected) <= 2);
}

#[test]
fn the_same_page_has_the_same_bytes_and_no_raw_text() {
    let html = page().to_html().unwrap();
    assert_eq!(html, page().to_html().unwrap());
    assert!(!html.contains("<img src=http"), "escaped everywhere");
    let scripts = html.matches("<script").count();
    assert_eq!((scripts, html.matches("</script").count()), (2, 2));
    let outside: Vec<&str> = html.matches("http").collect();
    // What is left of addresses is the policy's own name and the escaped text.
    assert!(outside.len() < 40 && !html.contains("src=\"http") && !html.contains("href"));
    for part in ["default-src 'none'", "img-src data:", "script-src 'sha256-", "MB in one file: 8 pictures"] {
        assert!(html.contains(part), "no {part}");
    }
}

#[test]
fn pictures_of_the_wrong_size_are_refused() {
    let tone = Tone { exposure: 0.0, curve: Curve::Clip, backdrop: [0.0; 3], plate: None };
    let mut page = Page::new("x", &["R"]);
    let shot =
        |shown, alpha| Shot { number: 7, facts: vec![], width: 1, height: 1, shown, alpha, layers: None };
    assert!(page.shot(0, &shot(&[0; 3], &[1.0])).unwrap_err().to_string().contains("the page has 0"));
    let variant = page.variant(Variant::default(), tone);
    assert!(page.shot(variant, &shot(&[0; 3], &[1.0])).is_ok());
    let error = page.shot(variant, &shot(&[0; 4], &[1.0])).unwrap_err().to_string();
    assert!(error.contains("frame 7") && error.contains("expected 3"), "{error}");
    assert!(page.shot(variant, &shot(&[0; 3], &[])).is_err());
    assert!(page.to_html().unwrap().contains("<noscript>"));
}
