//! How the page shows a variant's light.

use flip_page::{Curve, Plate, Tone};
use frame_comp::{Background, Fit, Meaning};
use hair_render::{Backdrop, Frame};

use crate::TurntableError;
use crate::outputs::look::Look;
use crate::schema::{Pipeline, ToneCurve};

/// The tone of a variant, with what is behind its frames where that is to be seen as it is; `size` is theirs.
pub(super) fn tone(pipeline: &Pipeline, look: &Look, size: (u32, u32)) -> Result<Tone, TurntableError> {
    let plate = match look.plate.as_deref() {
        Some(background @ Background::Plate(plate)) if plate.meaning() == Meaning::Display => {
            let empty = Frame::empty(size.0, size.1);
            let rgba = frame_comp::shown(&empty, Some(background), Fit::Fill, &look.mapping).rgba;
            Some(Plate::new(size.0, size.1, &without_alpha(&rgba))?)
        }
        _ => None,
    };
    let backdrop = match look.mapping.backdrop {
        Backdrop::Solid(color) => color.to_array(),
        Backdrop::Transparent => [0.0; 3],
    };
    let curve = match pipeline.tone.curve {
        ToneCurve::Neutral => Curve::Neutral,
        ToneCurve::Clip => Curve::Clip,
    };
    Ok(Tone { exposure: look.mapping.exposure, curve, backdrop, plate })
}

/// Red, green and blue alone.
pub(super) fn without_alpha(rgba: &[u8]) -> Vec<u8> {
    rgba.as_chunks::<4>().0.iter().flat_map(|[red, green, blue, _]| [*red, *green, *blue]).collect()
}
