//! Everything, for programs.

use serde_json::{Value, json};

use super::Distances;
use super::histogram::histogram;
use crate::events::FrameEvents;

/// The report; `about` says of what.
pub(super) fn report(distances: &Distances, frames: &[FrameEvents], about: Value) -> Value {
    let Distances { ids, binding, report, limit } = distances;
    let roots = binding.roots();
    let bins: Vec<Value> = histogram(&report.distances)
        .iter()
        .map(|bin| json!({"to": bin.to, "strands": bin.strands}))
        .collect();
    json!({
        "about": about,
        "mesh_size": report.mesh_size,
        "distance": summary(report),
        "histogram": bins,
        "limit": limit,
        "beyond": report.beyond,
        "ambiguous": report.ambiguous,
        "outside": report.outside,
        "without_frame": report.without_frame,
        "frames": frames.iter().map(FrameEvents::json).collect::<Vec<_>>(),
        "strands": {
            "id": ids,
            "triangle": roots.iter().map(|root| root.triangle).collect::<Vec<_>>(),
            "u": roots.iter().map(|root| root.barycentrics.y).collect::<Vec<_>>(),
            "v": roots.iter().map(|root| root.barycentrics.z).collect::<Vec<_>>(),
            "height": roots.iter().map(|root| root.height).collect::<Vec<_>>(),
        },
    })
}

/// Least, middle and greatest distances.
pub(crate) fn summary(report: &groom_binding::BindReport) -> Value {
    json!({
        "min": report.distance_at(0.0),
        "median": report.distance_at(0.5),
        "mean": report.mean_distance,
        "p95": report.distance_at(0.95),
        "max": report.distance_at(1.0),
    })
}
