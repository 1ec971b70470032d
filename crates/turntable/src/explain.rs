//! What a plan will do, what it leaves out, and why.

use std::path::Path;

use serde::Serialize;

use crate::left_out::left_out;
use crate::{Plan, State, StepKind};

/// One line of an explanation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Remark {
    /// What it is about: an output or a part of the work.
    pub what: String,
    /// `make`, `keep`, `move`, `leave` (alone) or `leave out`.
    pub action: &'static str,
    /// Why.
    pub why: String,
}

impl Plan {
    /// What [`Plan::run`] would do and leave out. Reads nothing more than the plan has.
    #[must_use]
    pub fn explain(&self) -> Vec<Remark> {
        let mut remarks: Vec<Remark> =
            self.steps().iter().map(|s| of_state(&s.output.to_string_lossy(), &s.state)).collect();
        remarks.extend(self.left_over().iter().map(|path| Remark {
            what: path.to_string_lossy().into_owned(),
            action: "leave",
            why: "none of this turntable's frames; nothing uses it".into(),
        }));
        remarks.extend(self.left_out());
        remarks
    }

    /// The same, with steps that stand one after another and have the same said of them told as one.
    #[must_use]
    pub fn explain_grouped(&self) -> Vec<Remark> {
        let mut grouped: Vec<(Remark, usize)> = Vec::new();
        for remark in self.explain() {
            let is_like = |first: &Remark| {
                first.action == remark.action
                    && first.why == remark.why
                    && is_beside(&first.what, &remark.what)
            };
            match grouped.last_mut().filter(|(first, _)| is_like(first)) {
                Some((_, count)) => *count += 1,
                None => grouped.push((remark, 1)),
            }
        }
        let tell = |(remark, count): (Remark, usize)| match count {
            1 => remark,
            _ => Remark { what: format!("{} and {} more", remark.what, count - 1), ..remark },
        };
        grouped.into_iter().map(tell).collect()
    }

    fn left_out(&self) -> Vec<Remark> {
        let due = |kind: fn(&StepKind) -> bool| {
            self.steps().iter().any(|s| kind(&s.kind) && matches!(s.state, State::Missing | State::Stale))
        };
        let frames = due(|kind| matches!(kind, StepKind::Frame { .. }));
        let converts = due(|kind| *kind == StepKind::Convert);
        let unneeded = [
            (!frames && !converts, "loading the groom", "nothing that is made needs it"),
            (!frames, "building the scene", "no frame has to be rendered"),
        ];
        let unneeded = unneeded.into_iter().filter(|(is_left_out, ..)| *is_left_out);
        let asked = self.variants.iter().zip(&self.asked).filter(|(_, asked)| **asked);
        unneeded
            .map(|(_, what, why)| (what, why))
            .chain(left_out(asked.map(|(variant, _)| &variant.pipeline)))
            .map(|(what, why)| Remark { what: what.into(), action: "leave out", why: why.into() })
            .collect()
    }
}

/// Whether two files are of one kind and in one folder.
fn is_beside(one: &str, other: &str) -> bool {
    let (one, other) = (Path::new(one), Path::new(other));
    one.extension().is_some() && one.extension() == other.extension() && one.parent() == other.parent()
}

/// Why something that is made of frames waits.
pub(crate) fn waits(count: usize) -> String {
    let (frames, are) = if count == 1 { ("frame", "is") } else { ("frames", "are") };
    format!("{count} {frames} it is made of {are} neither there nor asked for")
}

fn of_state(what: &str, state: &State) -> Remark {
    let (action, why) = match state {
        State::UpToDate => ("keep", "up to date".to_owned()),
        State::Missing => ("make", "not there".to_owned()),
        State::Stale => ("make", "inputs, settings or the file itself changed".to_owned()),
        State::Elsewhere(path) => ("move", format!("the same view is there as {}", path.display())),
        State::NotAsked => ("leave out", "not asked for".to_owned()),
        State::Waiting(count) => ("leave out", waits(*count)),
    };
    Remark { what: what.to_owned(), action, why }
}
