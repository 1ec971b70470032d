//! Taking the time: by criterion, and once more as the least of many short rounds, which a busy machine
//! disturbs least.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::Criterion;
use glam::Vec3;

use crate::inputs::Inputs;

/// What a model does: a hit of it, and three things done with one.
pub struct Operations<A, E, P, S> {
    pub at: A,
    pub evaluate: E,
    pub pdf: P,
    pub sample: S,
}

/// Operations by their columns in the summary.
const OPERATIONS: [&str; 4] = ["at", "evaluate_with_pdf", "pdf", "sample"];

pub struct Measures {
    criterion: Criterion,
    least: Vec<(String, [Option<f64>; 4])>,
}

impl Measures {
    pub fn new() -> Measures {
        let criterion = Criterion::default()
            .warm_up_time(Duration::from_millis(200))
            .measurement_time(Duration::from_millis(800))
            .without_plots()
            .configure_from_args();
        Measures { criterion, least: Vec::new() }
    }

    /// Every operation of a model, over evenly spread directions, offsets and numbers.
    pub fn take<H, V, D, X>(
        &mut self,
        name: &str,
        operations: Operations<
            impl Fn(Vec3, f32) -> H,
            impl Fn(&H, Vec3) -> V,
            impl Fn(&H, Vec3) -> D,
            impl Fn(&H, [f32; 4]) -> X,
        >,
    ) {
        let Operations { at, evaluate, pdf, sample } = operations;
        let mut inputs = Inputs::new();
        let hits = inputs.hits(&at);
        self.at(name, at);
        self.one(1, name, || {
            let (wi, _, _, hit) = inputs.next();
            black_box(evaluate(&hits[hit], black_box(wi)));
        });
        self.one(2, name, || {
            let (wi, _, _, hit) = inputs.next();
            black_box(pdf(&hits[hit], black_box(wi)));
        });
        self.one(3, name, || {
            let (_, _, u, hit) = inputs.next();
            black_box(sample(&hits[hit], black_box(u)));
        });
    }

    /// Preparing a hit alone.
    pub fn at<H>(&mut self, name: &str, at: impl Fn(Vec3, f32) -> H) {
        let mut inputs = Inputs::new();
        self.least.push((name.to_owned(), [None; 4]));
        self.one(0, name, || {
            let (wo, h, ..) = inputs.next();
            black_box(at(black_box(wo), black_box(h)));
        });
    }

    fn one(&mut self, operation: usize, name: &str, mut call: impl FnMut()) {
        let mut ran = false;
        self.criterion.benchmark_group(OPERATIONS[operation]).bench_function(name, |bencher| {
            ran = true;
            bencher.iter(&mut call);
        });
        if let (true, Some((_, row))) = (ran, self.least.last_mut()) {
            row[operation] = Some(least(call));
        }
    }

    /// The least of each, in columns.
    pub fn summary(&mut self) {
        self.criterion.final_summary();
        println!(
            "\n{:<36}{:>8}{:>20}{:>8}{:>8}",
            "least ns per call", "at", "evaluate_with_pdf", "pdf", "sample"
        );
        for (name, [at, evaluate, pdf, sample]) in &self.least {
            let text = |ns: &Option<f64>| ns.map_or_else(|| "-".to_owned(), |ns| format!("{ns:.0}"));
            let [at, evaluate, pdf, sample] = [text(at), text(evaluate), text(pdf), text(sample)];
            println!("{name:<36}{at:>8}{evaluate:>20}{pdf:>8}{sample:>8}");
        }
    }
}

/// Nanoseconds per call in the quickest of many rounds, each shorter than what interrupts it.
fn least(mut call: impl FnMut()) -> f64 {
    const CALLS: u32 = 1024;
    (0..800).fold(f64::INFINITY, |least, _| {
        let start = Instant::now();
        (0..CALLS).for_each(|_| call());
        least.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS))
    })
}
