//! The page of one material.

use error_report::{Curve, Plot, escape, plot_svg};
use fibre_scattering::Lobe;

use super::document::{Document, cell, chip, marked, small, word};
use super::{Chart, LOBE_COLORS, Line, figure, polar};
use crate::report::{LobeCurve, Report};
use crate::verdict::{Check, Verdict};

/// The report as a page.
pub(crate) fn html(report: &Report) -> String {
    let mut page = Document::new(&format!("Fibre check: {}", report.title));
    banner(&mut page, report);
    checks(&mut page, &report.checks);
    material(&mut page, report);
    lobes(&mut page, report);
    albedo(&mut page, report);
    sampling(&mut page, report);
    light(&mut page, report);
    far_field(&mut page, report);
    five_lobe(&mut page, report);
    page.finish()
}

fn banner(page: &mut Document, report: &Report) {
    let of = |verdict| report.checks.iter().filter(|check| check.verdict == verdict).count();
    let (passed, failed, told) =
        (of(Verdict::Pass), of(Verdict::Fail), of(Verdict::Told) + of(Verdict::Unjudged));
    let words = if failed == 0 {
        format!("All {passed} checks pass; {told} figures are told without a promise.")
    } else {
        format!("{failed} of {} checks fail.", passed + failed)
    };
    page.banner(failed == 0, &words);
}

pub(super) fn checks(page: &mut Document, checks: &[Check]) {
    let row = |check: &Check| {
        let bound = match check.bound {
            Some(bound) if check.above => format!("≥ {}", figure(bound)),
            Some(bound) => format!("≤ {}", figure(bound)),
            None => String::new(),
        };
        vec![
            word(&check.name),
            marked(check.verdict.word()),
            cell(&format!("{} = {}", check.measure, figure(check.figure))),
            cell(&bound),
            word(&check.at),
            small(&check.words),
        ]
    };
    page.table(&["law", "<verdict", "worst figure", "bound", "<at", "<how"], checks.iter().map(row));
}

fn material(page: &mut Document, report: &Report) {
    page.heading("Material");
    page.table(
        &["parameter", "value"],
        report.parameters.iter().map(|(name, value)| vec![word(name), cell(value)]),
    );
    let about = report.about.iter().map(|(key, value)| format!("{key}: {value}"));
    page.note(&about.collect::<Vec<_>>().join("; "));
}

fn lobes(page: &mut Document, report: &Report) {
    page.heading("Lobes");
    let azimuthal = &report.curves.azimuthal;
    legend(page, azimuthal.iter().map(|(_, curve)| curve));
    let peak = |curve: &LobeCurve| curve.lobes.iter().flatten().copied().fold(0.0, f64::max);
    page.raw("<figure><div class=\"row\">\n");
    for (h, curve) in azimuthal {
        let title = if azimuthal.len() > 1 { format!("h = {h}") } else { "from afar".to_owned() };
        page.raw(&polar::svg(&title, curve, peak(curve).max(1e-12)));
    }
    page.raw("</div><figcaption>Around the fibre: light per radian of azimuth, seen from the right (arrow), outgoing inclination 0°. The radius is the root of it, so that areas are shares of the light within a plot; each plot has its own scale.</figcaption></figure>\n");
    let curve = &report.curves.longitudinal;
    let lines = Lobe::ALL.into_iter().enumerate().filter(|(p, _)| curve.lobes[*p].iter().any(|&v| v > 0.0));
    let chart = Chart {
        root: true,
        x_label: "inclination of the incoming direction, degrees (root on the left)",
        y_label: "light per radian (root scale)",
        x: (-90.0, 90.0),
        x_step: 30.0,
        lines: lines
            .map(|(p, lobe)| Line {
                label: lobe.name(),
                color: LOBE_COLORS[p],
                points: curve.angles.iter().copied().zip(curve.lobes[p].iter().copied()).collect(),
                filled: true,
            })
            .collect(),
    };
    page.raw(&format!(
        "<figure>{}<figcaption>Along the fibre: outgoing inclination {}°, offset 0.3; a mirror would send all light to {}°.</figcaption></figure>\n",
        chart.svg(),
        report.curves.theta_o,
        -report.curves.theta_o
    ));
    let degrees = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.2}°"));
    page.table(
        &[
            "lobe",
            "lies about theta",
            "about phi",
            "deviation along",
            "scale around",
            "red",
            "green",
            "blue",
            "",
        ],
        report.lobes.iter().map(|row| {
            let mut cells = vec![word(row.lobe)];
            let shape = [row.inclination, row.azimuth, row.deviation, row.scale];
            cells.extend(shape.map(|value| cell(&degrees(value))));
            cells.extend(row.share.map(|share| cell(&figure(share))));
            cells.push(chip(row.share));
            cells
        }),
    );
    page.note(
        "The share of light each lobe scatters, seen from 30° at the offset 0.3; a patch shows its colour.",
    );
}

fn legend<'a>(page: &mut Document, curves: impl Iterator<Item = &'a LobeCurve>) {
    let mut there = [false; 5];
    for curve in curves {
        for (there, lobe) in there.iter_mut().zip(&curve.lobes) {
            *there |= lobe.iter().any(|&value| value > 0.0);
        }
    }
    let names = Lobe::ALL.into_iter().zip(LOBE_COLORS).zip(there).filter(|(_, there)| *there);
    let words: Vec<String> = names
        .map(|((lobe, color), _)| {
            let name = escape(lobe.name());
            format!("<span class=\"chip\" style=\"background:{color}\"></span> {name}")
        })
        .collect();
    page.raw(&format!("<p>{}</p>\n", words.join(" &#160; ")));
}

fn albedo(page: &mut Document, report: &Report) {
    page.heading("Albedo by angle");
    page.note("The share of light one fibre scatters, by quadrature over all directions in single precision. White: the same fibre without absorption.");
    let near = report.albedo.iter().any(|row| row.h != 0.0);
    let row = |row: &crate::report::AlbedoRow| {
        let mut cells = vec![cell(&format!("{}°", row.theta_o))];
        if near {
            cells.push(cell(&row.h.to_string()));
        }
        cells.push(chip(row.total));
        cells.extend(row.total.map(|value| cell(&format!("{value:.4}"))));
        cells.extend(row.lobes.map(|lobe| cell(&format!("{:.4}", lobe.iter().sum::<f64>() / 3.0))));
        cells.push(cell(&format!("{:.7}", row.white)));
        cells.push(cell(&row.white_double.map_or(String::new(), |white| format!("{white:.9}"))));
        cells
    };
    let mut headings = vec!["theta"];
    if near {
        headings.push("h");
    }
    headings.extend([
        "",
        "red",
        "green",
        "blue",
        "R",
        "TT",
        "TRT",
        "residual",
        "scattered",
        "white f32",
        "white f64",
    ]);
    page.table(&headings, report.albedo.iter().map(row));
}

fn sampling(page: &mut Document, report: &Report) {
    page.heading("Samples against the density");
    page.note("Pearson's chi-square: directions drawn, counted in cells that are dense where lobes are, against the integral of the density over each cell (double precision where there is such a path). p is the chance of so large a difference by accident: the least of the chances of the cells, of their sums along the fibre and of their sums around it, made right for being the least of three.");
    page.table(
        &["view", "samples", "cells", "chi-square", "p"],
        report.goodness.iter().map(|row| {
            let cells = (row.degrees + 1.0).to_string();
            let chi_square = format!("{:.1}", row.chi_square);
            vec![
                word(&row.view),
                cell(&row.samples.to_string()),
                cell(&cells),
                cell(&chi_square),
                cell(&figure(row.p)),
            ]
        }),
    );
    page.heading("Weights of samples");
    page.note("Value over density. No channel may pass 1, and the mean must be the albedo.");
    page.table(
        &["view", "largest", "mean r", "g", "b", "albedo r", "g", "b", "standard error (worst)", "p"],
        report.weights.iter().map(|row| {
            let mut cells = vec![word(&row.view), cell(&format!("{:.6}", row.largest))];
            cells.extend(row.mean.iter().chain(&row.albedo).map(|value| cell(&format!("{value:.5}"))));
            let error = row.standard_error.into_iter().fold(0.0, f64::max);
            cells.extend([cell(&figure(error)), cell(&figure(row.p))]);
            cells
        }),
    );
}

fn light(page: &mut Document, report: &Report) {
    page.heading("One light, four ways");
    page.note("A soft sky of four lights on one fibre. Estimate and its standard error with directions from the light alone, from the fibre alone, and from both by the balance and power heuristics; z is the difference from quadrature in standard errors. No bias: z stays within a few.");
    let row = |row: &crate::report::LightRow| {
        let mut cells = vec![word(&row.view), cell(&format!("{:.6}", row.exact))];
        for (_, mean, error, z) in &row.ways {
            cells.push(cell(&format!("{mean:.6} ± {}", figure(*error))));
            cells.push(cell(&format!("{z:+.1}")));
        }
        cells
    };
    page.table(
        &["view", "quadrature", "light", "z", "fibre", "z", "balance", "z", "power", "z"],
        report.light.iter().map(row),
    );
}

fn far_field(page: &mut Document, report: &Report) {
    if report.far_field.is_empty() {
        return;
    }
    page.heading("Seen from afar: error against time");
    page.note("The offset integrated out by so many nodes, against the near field averaged over it: mean difference over mean, on the mirror cone from 0° and 50°. The time is that of one preparation and one evaluation.");
    let label: Vec<String> = report.far_field.iter().map(|far| format!("{} nodes", far.nodes)).collect();
    let points = report.far_field.iter().zip(&label);
    let points = points.map(|(far, label)| (label.as_str(), far.nanoseconds * 1e-9, far.error)).collect();
    let curve = Curve { label: "far field", joined: true, points };
    page.raw(&plot_svg(&Plot {
        x_label: "seconds",
        y_label: "relative error",
        slope: 0.0,
        curves: vec![curve],
    }));
    page.table(
        &["nodes", "error", "ns"],
        report.far_field.iter().map(|far| {
            vec![
                cell(&far.nodes.to_string()),
                cell(&figure(far.error)),
                cell(&format!("{:.0}", far.nanoseconds)),
            ]
        }),
    );
}

fn five_lobe(page: &mut Document, report: &Report) {
    if report.five_lobe.is_empty() {
        return;
    }
    page.heading("The five-lobe model of Yan et al. 2017 beside the whole fibre");
    page.note("Albedo averaged over the offset. Without absorption it must be 1. The five-lobe model leaves out that a fifth to a half of the scattered light is reflected back inside on its way out, so with pigment it is brighter than a fibre is.");
    page.table(
        &["model", "theta", "without absorption", "red", "green", "blue", ""],
        report.five_lobe.iter().map(|row| {
            let mut cells = vec![
                word(&row.model),
                cell(&format!("{}°", row.theta_o)),
                cell(&format!("{:.4}", row.white)),
            ];
            cells.extend(row.albedo.map(|value| cell(&format!("{value:.4}"))));
            cells.push(chip(row.albedo));
            cells
        }),
    );
}
