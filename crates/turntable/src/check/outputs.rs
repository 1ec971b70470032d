//! The names of what is made, and what it is like.

use std::collections::BTreeSet;
use std::ops::Bound;
use std::path::{Component, Path};

use groom_formats::Format;

use super::Check;
use crate::outputs::sheet_layout;
use crate::schema::{Codec, Page, Pipeline, Sheet, Video};

/// What the program writes by itself.
const OWN: [&str; 3] = ["manifest.jsonl", "report.json", "report.html"];

impl Check<'_> {
    pub(super) fn outputs(&mut self, pipeline: &Pipeline) {
        let mut seen: BTreeSet<&Path> = BTreeSet::new();
        for (i, path) in pipeline.convert.iter().enumerate() {
            let key = format!("convert.{i}");
            self.output(&key, path, &mut seen);
            if !Format::from_path(path).is_some_and(Format::can_write) {
                let known: Vec<&str> =
                    Format::ALL.into_iter().filter(|f| f.can_write()).map(Format::name).collect();
                let (shown, known) = (path.display(), known.join(", ."));
                self.fault(key, format!("`{shown}` has no ending that can be written (.{known})"));
            }
        }
        if let Some(sheet) = &pipeline.sheet {
            self.output("sheet.file", &sheet.file, &mut seen);
            self.sheet(sheet, pipeline);
        }
        for (i, video) in pipeline.video.iter().enumerate() {
            self.output(&format!("video.{i}.file"), &video.file, &mut seen);
            self.video(&format!("video.{i}"), video);
        }
        if let Some(page) = &pipeline.page {
            self.output("page.file", &page.file, &mut seen);
            self.page(page);
        }
    }

    fn output<'p>(&mut self, key: &str, path: &'p Path, seen: &mut BTreeSet<&'p Path>) {
        let shown = path.display();
        // An output that climbs out of its folder would overwrite what the pipeline does not own.
        let inside = path.components().all(|c| matches!(c, Component::Normal(_)));
        if !inside || path.as_os_str().is_empty() {
            return self.fault(key, format!("`{shown}` must be a path inside the output folder"));
        }
        if path.starts_with("frames") || OWN.iter().any(|own| path == Path::new(own)) {
            self.fault(key, format!("`{shown}` is a place of the program's own"));
        }
        let after = (Bound::Excluded(path), Bound::Unbounded);
        let is_above = seen.range::<Path, _>(after).next().is_some_and(|next| next.starts_with(path));
        if is_above || path.ancestors().skip(1).any(|above| seen.contains(above)) {
            self.fault(key, format!("`{shown}` and another output are a file and its folder"));
        }
        if !seen.insert(path) {
            self.fault(key, format!("`{shown}` is made twice"));
        }
    }

    fn sheet(&mut self, sheet: &Sheet, pipeline: &Pipeline) {
        let png = sheet.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
        self.need(png, "sheet.file", sheet.file.display().to_string(), "a name that ends in .png");
        self.need(sheet.columns != Some(0), "sheet.columns", 0, "at least 1");
        self.need(sheet.gap <= 1024, "sheet.gap", sheet.gap, "at most 1024 pixels");
        for (i, caption) in sheet.captions.iter().enumerate() {
            if sheet.captions.iter().take(i).any(|before| before == caption) {
                self.fault(format!("sheet.captions.{i}"), "is there twice");
            }
        }
        let (width, height) = sheet_layout(sheet, &pipeline.render).size(pipeline.turntable.frames);
        self.pixels("sheet", width, height);
    }

    fn video(&mut self, key: &str, video: &Video) {
        let is = |ending: &str| video.file.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
        let shown = video.file.display().to_string();
        self.need(is("mp4") || is("mov"), &format!("{key}.file"), shown, "a name that ends in .mp4 or .mov");
        if video.codec == Some(Codec::Prores4444) && is("mp4") {
            self.fault(format!("{key}.codec"), "ProRes goes into a .mov file");
        }
        let fps = video.fps;
        self.need(
            fps > 0.0 && fps <= 1000.0,
            &format!("{key}.fps"),
            fps,
            "above 0, at most 1000 frames a second",
        );
        self.need(video.crf <= 51, &format!("{key}.crf"), video.crf, "0..=51");
    }

    fn page(&mut self, page: &Page) {
        let html = page.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("html"));
        self.need(html, "page.file", page.file.display().to_string(), "a name that ends in .html");
        self.need((16..=4096).contains(&page.size), "page.size", page.size, "16..=4096 pixels");
    }
}
