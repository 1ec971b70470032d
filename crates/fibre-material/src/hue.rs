//! Turning a colour's hue.

use glam::Vec3;

/// `color` with its hue turned by `turn` (a full circle is 1), its value and saturation kept: the hexcone
/// of Smith 1978, "Color Gamut Transform Pairs".
pub(crate) fn turned(color: Vec3, turn: f32) -> Vec3 {
    let (high, low) = (color.max_element(), color.min_element());
    let chroma = high - low;
    if chroma <= 0.0 {
        return color;
    }
    // Sixths of a circle from red.
    let hue = if high == color.x {
        (color.y - color.z) / chroma
    } else if high == color.y {
        2.0 + (color.z - color.x) / chroma
    } else {
        4.0 + (color.x - color.y) / chroma
    };
    let hue = hue + 6.0 * turn;
    let channel = |offset: f32| {
        let k = (offset + hue).rem_euclid(6.0);
        high - chroma * k.min(4.0 - k).clamp(0.0, 1.0)
    };
    Vec3::new(channel(5.0), channel(3.0), channel(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hues_turn_and_come_back() {
        let color = Vec3::new(0.8, 0.4, 0.1);
        assert!((turned(color, 0.0) - color).abs().max_element() < 1e-6);
        assert!((turned(color, 1.0) - color).abs().max_element() < 1e-5);
        let third = turned(color, 1.0 / 3.0);
        assert!((third - Vec3::new(0.1, 0.8, 0.4)).abs().max_element() < 1e-6, "{third}");
        assert_eq!(turned(Vec3::splat(0.3), 0.2), Vec3::splat(0.3));
        for i in 0..100 {
            let to = turned(color, i as f32 / 50.0 - 1.0);
            assert!((to.max_element() - 0.8).abs() < 1e-6 && (to.min_element() - 0.1).abs() < 1e-6, "{to}");
        }
    }
}
