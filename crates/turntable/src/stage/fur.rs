//! Fur that is grown on the pipeline's mesh.

use std::path::Path;

use groom::{Groom, UpAxis};
use groom_samples::{FurOptions, FurSurface, fur_on};
use moving_mesh::{AnimationChoice, MeshOptions, MovingMesh, RestPose};

use super::hair::is_z;
use crate::TurntableError;
use crate::schema::{Pipeline, Rest, SampleSource};

/// A coat on the mesh as it stands where frames show it, or, where it is to be bound, in the pose it is bound in.
pub(super) fn grown(
    sample: &SampleSource,
    pipeline: &Pipeline,
    base: &Path,
) -> Result<Groom, TurntableError> {
    let Some(source) = &pipeline.mesh else {
        return Err(TurntableError::Sample(
            "`style: fur` grows on a mesh, and there is no `mesh`".to_owned(),
        ));
    };
    let (animation, rest) = match pipeline.bind.as_ref().map(|bind| bind.rest) {
        None | Some(Rest::Nodes) => (AnimationChoice::None, RestPose::Nodes),
        Some(Rest::Bind) => (AnimationChoice::None, RestPose::Bind),
        Some(Rest::Frame(_)) => {
            let words =
                "`style: fur` grows on a mesh at rest, and `bind.rest` is a frame; expected bind or nodes";
            return Err(TurntableError::Sample(words.to_owned()));
        }
    };
    let options = MeshOptions {
        animation,
        rest,
        z_up: source.up.map(is_z),
        meters_per_unit: source.meters_per_unit,
        ..MeshOptions::default()
    };
    let mesh = MovingMesh::open(base.join(&source.file), &options)?;
    let rest = mesh.rest();
    let surface = FurSurface {
        positions: &rest.positions,
        triangles: mesh.triangles(),
        normals: rest.normals.as_deref(),
    };
    let usual = FurOptions::default();
    let options = FurOptions {
        strands: sample.strands,
        points: sample.points,
        seed: sample.seed,
        length: sample.length.unwrap_or(usual.length),
        lean: sample.lean.unwrap_or(usual.lean),
        curl: sample.curl.unwrap_or(usual.curl),
        clump: sample.clump.unwrap_or(usual.clump),
        ..usual
    };
    let mut fur = fur_on(&surface, &options).map_err(|error| TurntableError::Sample(error.to_string()))?;
    fur.up_axis = if mesh.is_z_up() { UpAxis::Z } else { UpAxis::Y };
    fur.meters_per_unit = mesh.meters_per_unit();
    Ok(fur)
}
