//! The page's skeleton: what stands still, its script and its style.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use error_report::{Curve, Plot, Point, Report, Series, escape, plot_svg};

use crate::sha256::sha256;
use crate::{Bytes, Page};

const STYLE: &str = include_str!("page/page.css");

/// One script, in a scope of its own.
const SCRIPT: &str = concat!(
    "(()=>{\"use strict\";\n",
    include_str!("page/light.js"),
    include_str!("page/state.js"),
    include_str!("page/stage.js"),
    include_str!("page/compare.js"),
    include_str!("page/controls.js"),
    include_str!("page/tables.js"),
    include_str!("page/main.js"),
    "})();\n"
);

/// The page around `data`, a JSON text.
pub(crate) fn write(page: &Page, data: &str) -> String {
    let title = escape(&page.title);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; \
         script-src '{}'; style-src '{}'; base-uri 'none'; form-action 'none'\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"/>\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n",
        hash(SCRIPT),
        hash(STYLE)
    );
    push_header(&mut out, page, &title);
    out.push_str("<main>\n");
    out.push_str(LOOK);
    out.push_str("<div class=\"below\">\n");
    out.push_str(PARAMETERS);
    if let Some(report) = &page.report {
        push_report(&mut out, report);
    }
    push_pairs(&mut out, "Left out", &page.left_out);
    let mut about = page.about.clone();
    about.push(("this page".into(), size_in_words(page.bytes, data.len() + STYLE.len() + SCRIPT.len())));
    push_pairs(&mut out, "Made with", &about);
    out.push_str(KEYS);
    out.push_str("</div>\n</main>\n");
    // A text in JSON never needs these letters themselves; written so, no text can end the element.
    let data = data.replace('&', "\\u0026").replace('<', "\\u003c").replace('>', "\\u003e");
    let _ = writeln!(out, "<script type=\"application/json\" id=\"data\">{data}</script>");
    let _ = writeln!(out, "<script>{SCRIPT}</script>\n</body>\n</html>");
    out
}

fn hash(text: &str) -> String {
    format!("sha256-{}", STANDARD.encode(sha256(text.as_bytes())))
}

fn push_header(out: &mut String, page: &Page, title: &str) {
    let (frames, variants) = (page.bytes.frames, page.variants.len());
    let variants = if variants > 1 { format!("{variants} variants, ") } else { String::new() };
    let _ = writeln!(
        out,
        "<header><h1>{title}</h1><span class=\"soft\">{variants}{frames} frames</span></header>"
    );
    if let Some(first) = page.variants.iter().flat_map(|filled| &filled.frames).next() {
        let _ = writeln!(
            out,
            "<noscript><main><p>Frames are turned and passes weighed by a script, which does not run here. The \
             first frame:</p><img alt=\"frame {}\" src=\"data:image/jpeg;base64,{}\"/></main></noscript>",
            first.number, first.jpeg
        );
    }
}

/// Pictures and what is turned about them.
const LOOK: &str = r#"<div class="look">
<section aria-label="Pictures">
<div class="stage" id="stage">
<figure id="side0"><canvas id="canvas0" role="img" tabindex="0" width="16" height="9"></canvas><figcaption id="caption0"></figcaption></figure>
<figure id="side1" hidden="hidden"><canvas id="canvas1" role="img" tabindex="0" width="16" height="9"></canvas><figcaption id="caption1"></figcaption></figure>
</div>
<div class="readout" id="readout"></div>
<div class="bar"><button type="button" id="play" aria-pressed="false">Play</button><label for="frame">Frame</label><input type="range" id="frame" min="0" max="0" value="0" step="1"/><output for="frame" id="said-frame"></output></div>
<p class="fault" id="fault" role="status"></p>
</section>
<aside aria-label="Controls">
<div class="variants" id="variants"><h2>Variant</h2><div class="menu" id="menu0"></div>
<div class="views" role="group" aria-label="Compare with another variant"><span class="soft">Compare</span><button type="button" data-view="beside" aria-pressed="false">Side by side</button><button type="button" data-view="wipe" aria-pressed="false">Wipe</button><button type="button" data-view="difference" aria-pressed="false">Difference</button></div>
<div class="menu" id="menu1" hidden="hidden"></div></div>
<div id="weigh"><h2>Passes</h2><div id="passes"></div>
<div class="pass exposure"><label for="stops">stops</label><input type="range" id="stops" min="-4" max="4" step="0.1"/><output for="stops" id="said-stops"></output></div>
<p><button type="button" id="reset">Reset</button></p></div>
</aside>
</div>
"#;

/// The place of the table that the script fills.
const PARAMETERS: &str = r#"<section><h2>Parameters</h2><p><label><input type="checkbox" id="only-differing"/> only what differs between variants</label></p><div class="scroll"><table id="parameters"></table></div></section>
"#;

const KEYS: &str = r#"<section><h2>Keys</h2><dl><dt><kbd>&#8592;</kbd> <kbd>&#8594;</kbd></dt><dd>frame by frame; drag on the picture does the same</dd><dt><kbd>Home</kbd> <kbd>End</kbd></dt><dd>first and last frame</dd><dt><kbd>Space</kbd></dt><dd>play and pause</dd><dt><kbd>1</kbd> ... <kbd>9</kbd></dt><dd>one pass alone; <kbd>0</kbd> the beauty</dd><dt><kbd>c</kbd></dt><dd>two variants side by side; <kbd>x</kbd> swaps them</dd><dt><kbd>w</kbd></dt><dd>one left, the other right of a line, which the pointer drags; <kbd>[</kbd> <kbd>]</kbd> do too</dd><dt><kbd>d</kbd></dt><dd>how far apart they are, channel by channel as they are shown, four times as bright</dd></dl></section>
"#;

/// Plots of error against seconds, one for each metric.
fn push_report(out: &mut String, report: &Report) {
    let mut metrics: Vec<&str> = Vec::new();
    for series in &report.series {
        if !metrics.contains(&series.metric.as_str()) {
            metrics.push(&series.metric);
        }
    }
    let seconds = |point: &Point| point.seconds;
    for metric in metrics {
        let all: Vec<&Series> = report.series.iter().filter(|series| series.metric == metric).collect();
        let curves = all.iter().map(|series| Curve {
            label: &series.label,
            joined: series.joined,
            points: series.points.iter().map(|p| (p.label.as_str(), seconds(p), p.error)).collect(),
        });
        let slope = -all.first().map_or(0.0, |series| series.order);
        let plot = Plot { x_label: "seconds a frame", y_label: metric, slope, curves: curves.collect() };
        let reference = all.first().map_or(String::new(), |series| escape(&series.reference));
        let _ = writeln!(
            out,
            "<section><h2>{} against seconds</h2><div class=\"plot\">{}</div><p class=\"soft\">against {reference}</p></section>",
            escape(metric),
            plot_svg(&plot)
        );
    }
}

fn push_pairs(out: &mut String, heading: &str, pairs: &[(String, String)]) {
    if pairs.is_empty() {
        return;
    }
    let _ = write!(out, "<section><h2>{}</h2><dl>", escape(heading));
    for (key, value) in pairs {
        let _ = write!(out, "<dt>{}</dt><dd>{}</dd>", escape(key), escape(value));
    }
    out.push_str("</dl></section>\n");
}

fn size_in_words(bytes: Bytes, whole: usize) -> String {
    let Bytes { pictures, layers, frames, with_layers } = bytes;
    let mb = |bytes: u64| format!("{:.1} MB", bytes as f64 / 1e6);
    let mut words = format!("{} in one file: {frames} pictures {}", mb(whole as u64), mb(pictures));
    if with_layers > 0 {
        let _ = write!(words, ", passes of {with_layers} frames {}", mb(layers));
    }
    words
}
