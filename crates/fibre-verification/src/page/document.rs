//! The frame of a page, headings, paragraphs and tables.

use std::fmt::Write as _;

use error_report::escape;

const STYLE: &str = "\
body{font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:64rem;padding:0 1rem;color:#222;background:#fff}\
h1{margin-bottom:.3rem}h2{margin-top:2.2rem;border-bottom:1px solid #ccc;padding-bottom:.2rem}\
svg{max-width:100%;height:auto}\
figure{margin:0 0 1rem}figcaption,.note{color:#555;max-width:46rem}\
.grid{stroke:#ddd;fill:none}.guide{stroke:#888;stroke-dasharray:6 4}svg .note{fill:#666}\
.row{display:grid;grid-template-columns:repeat(4,1fr);gap:.5rem}@media screen and (max-width:50rem){.row{grid-template-columns:repeat(2,1fr)}}\
.scroll{overflow-x:auto}\
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:14px}\
th,td{padding:.18rem .6rem;border-bottom:1px solid #ddd;text-align:right;vertical-align:top}\
th{border-bottom:1px solid #888}th:first-child,td:first-child,td.word,th.word{text-align:left}\
td,th.word{hyphens:manual}td.small{color:#555;font-size:13px;text-align:left}\
.pass{color:#00623f;font-weight:600}.FAIL{color:#fff;background:#b00020;font-weight:700;padding:0 .35rem}\
.told,.unjudged{color:#666}\
.banner{padding:.5rem .9rem;border-left:.35rem solid;margin:1rem 0;font-size:1.1rem}\
.banner.good{border-color:#009e73;background:#eef8f4}.banner.bad{border-color:#b00020;background:#fcecef}\
.chip{display:inline-block;width:1.1em;height:1.1em;vertical-align:-.2em;border:1px solid #999}\
@media print{body{margin:0;max-width:none;font-size:12px}h2{break-after:avoid}figure,tr,.row svg{break-inside:avoid}\
.FAIL,.banner,.chip{-webkit-print-color-adjust:exact;print-color-adjust:exact}}";

/// A page in the making.
pub(crate) struct Document {
    out: String,
}

impl Document {
    /// A page with its title as the first heading.
    pub fn new(title: &str) -> Document {
        let title = escape(title);
        Document {
            out: format!(
                "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width\"/>\n<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
            ),
        }
    }

    pub fn heading(&mut self, text: &str) {
        let _ = writeln!(self.out, "<h2>{}</h2>", escape(text));
    }

    pub fn note(&mut self, text: &str) {
        let _ = writeln!(self.out, "<p class=\"note\">{}</p>", escape(text));
    }

    /// The result in a line, green or red.
    pub fn banner(&mut self, good: bool, text: &str) {
        let class = if good { "good" } else { "bad" };
        let _ = writeln!(self.out, "<p class=\"banner {class}\">{}</p>", escape(text));
    }

    /// Markup made here: a plot.
    pub fn raw(&mut self, markup: &str) {
        self.out.push_str(markup);
    }

    /// A table; cells are markup (see [`cell`] and [`word`]), headings are text; one that begins with `<` stands
    /// to the left.
    pub fn table(&mut self, headings: &[&str], rows: impl IntoIterator<Item = Vec<String>>) {
        self.out.push_str("<div class=\"scroll\"><table>\n<tr>");
        for heading in headings {
            let _ = match heading.strip_prefix('<') {
                Some(heading) => write!(self.out, "<th class=\"word\">{}</th>", escape(heading)),
                None => write!(self.out, "<th>{}</th>", escape(heading)),
            };
        }
        self.out.push_str("</tr>\n");
        for row in rows {
            let _ = writeln!(self.out, "<tr>{}</tr>", row.concat());
        }
        self.out.push_str("</table></div>\n");
    }

    pub fn finish(mut self) -> String {
        self.out.push_str("</body>\n</html>\n");
        self.out
    }
}

/// A cell with a number or a few words.
pub(crate) fn cell(text: &str) -> String {
    format!("<td>{}</td>", escape(text))
}

/// A cell with words, to the left.
pub(crate) fn word(text: &str) -> String {
    format!("<td class=\"word\">{}</td>", escape(text))
}

/// A cell with an explanation.
pub(crate) fn small(text: &str) -> String {
    format!("<td class=\"small\">{}</td>", escape(text))
}

/// A cell with a word that has a colour of its own class.
pub(crate) fn marked(class: &str) -> String {
    format!("<td class=\"word\"><span class=\"{0}\">{0}</span></td>", escape(class))
}

/// A cell with a patch of a linear Rec. 709 colour.
pub(crate) fn chip(rgb: [f64; 3]) -> String {
    let [r, g, b] = rgb.map(|x| (255.0 * encoded(x.clamp(0.0, 1.0))).round() as u8);
    format!("<td><span class=\"chip\" style=\"background:#{r:02x}{g:02x}{b:02x}\"></span></td>")
}

/// sRGB's curve (IEC 61966-2-1).
fn encoded(x: f64) -> f64 {
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}
