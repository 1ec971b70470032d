//! Guides that strands follow, as Unreal's schema names them.

use ogawa::{CompoundReader, DataType, OgawaError};

use super::values::Samples;
use crate::alembic::schema;

/// The one guide every strand follows: three times the same id, of which only the first has a weight. `None` where
/// there is anything else, which is then read as what it is.
pub(super) fn closest(
    arbitrary: &CompoundReader<'_>,
    samples: &Samples,
) -> Result<Option<Vec<i32>>, OgawaError> {
    let of_type = |name, data_type| -> Result<_, OgawaError> {
        let property = arbitrary.find(name)?;
        Ok(property.filter(|p| p.data_type() == Some(data_type) && p.sample_count() > 0))
    };
    let guides = of_type(schema::CLOSEST_GUIDES, schema::THREE_GUIDES)?;
    let weights = of_type(schema::GUIDE_WEIGHTS, DataType::F32X3)?;
    let (Some(guides), Some(weights)) = (guides, weights) else { return Ok(None) };
    let (guides, weights) = (samples.held(&guides)?, samples.held(&weights)?);
    if guides.len() != weights.len() {
        return Ok(None);
    }
    samples.spend(guides.bytes().len() + weights.bytes().len(), schema::CLOSEST_GUIDES)?;
    let (guides, weights) = (guides.to_i32()?, weights.to_f32()?);
    let (guides, weights) = (guides.as_chunks::<3>().0, weights.as_chunks::<3>().0);
    if weights.iter().any(|weights| *weights != schema::ONE_GUIDE) {
        return Ok(None);
    }
    Ok(guides.iter().map(|&[a, b, c]| (a == b && b == c).then_some(a)).collect())
}
