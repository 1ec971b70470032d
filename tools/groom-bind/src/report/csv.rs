//! A row a strand.

use anyhow::Result;

use super::Distances;

/// RFC 4180: `strand,id,triangle,u,v,height,distance,beyond`; `u` and `v` are the weights of the triangle's second
/// and third vertex.
pub(super) fn strands(distances: &Distances) -> Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(["strand", "id", "triangle", "u", "v", "height", "distance", "beyond"])?;
    for (strand, (root, id)) in distances.binding.roots().iter().zip(&distances.ids).enumerate() {
        let distance = root.height.abs();
        let is_beyond = distances.limit.is_some_and(|limit| distance > limit);
        writer.write_record([
            strand.to_string(),
            id.to_string(),
            root.triangle.to_string(),
            root.barycentrics.y.to_string(),
            root.barycentrics.z.to_string(),
            root.height.to_string(),
            distance.to_string(),
            u8::from(is_beyond).to_string(),
        ])?;
    }
    Ok(writer.into_inner().map_err(|error| error.into_error())?)
}
