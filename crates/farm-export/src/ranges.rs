//! Frame numbers as Open Job Description writes them.

/// `frames` (rising) as a range expression: `1-5`, `1-10:2`, `1,3,7-9`.
///
/// Runs of three or more at one step become a range; none overlap, as the specification asks.
///
/// ```
/// assert_eq!(farm_export::range_text(&[1, 2, 3, 5, 7, 9, 20]), "1-3,5-9:2,20");
/// ```
#[must_use]
pub fn range_text(frames: &[u32]) -> String {
    let mut parts = Vec::new();
    let mut rest = frames;
    while let Some(&first) = rest.first() {
        let run = run_length(rest);
        let last = rest.get(run - 1).copied().unwrap_or(first);
        let step = (last - first).checked_div(run as u32 - 1).unwrap_or(1);
        // Two frames that are no neighbours are shorter said one by one, and the second may begin a run.
        let (taken, text) = match (run, step) {
            (1, _) => (1, first.to_string()),
            (_, 1) => (run, format!("{first}-{last}")),
            (2, _) => (1, first.to_string()),
            _ => (run, format!("{first}-{last}:{step}")),
        };
        parts.push(text);
        rest = rest.get(taken..).unwrap_or_default();
    }
    parts.join(",")
}

/// How many frames from the first on lie at the step between the first two.
fn run_length(frames: &[u32]) -> usize {
    let [first, second, ..] = frames else { return frames.len() };
    let step = second - first;
    1 + frames.windows(2).take_while(|pair| pair[1] - pair[0] == step).count()
}
