//! Which arrays a file gets.

use std::str::FromStr;

/// Which of the format's five arrays to write.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Arrays {
    /// Segments of each strand.
    pub segments: bool,
    /// Points.
    pub points: bool,
    /// Thickness at each point.
    pub thickness: bool,
    /// Transparency at each point.
    pub transparency: bool,
    /// Colour at each point.
    pub colors: bool,
}

impl FromStr for Arrays {
    type Err = String;

    fn from_str(list: &str) -> Result<Self, String> {
        let mut arrays = Arrays::default();
        for name in list.split(',').map(str::trim).filter(|name| !name.is_empty()) {
            match name {
                "segments" => arrays.segments = true,
                "points" => arrays.points = true,
                "thickness" => arrays.thickness = true,
                "transparency" => arrays.transparency = true,
                "colors" => arrays.colors = true,
                "none" => arrays = Arrays::default(),
                "all" => {
                    arrays = Arrays {
                        segments: true,
                        points: true,
                        thickness: true,
                        transparency: true,
                        colors: true,
                    };
                }
                other => {
                    return Err(format!(
                        "`{other}` is no array; expected segments, points, thickness, transparency, colors, none or all"
                    ));
                }
            }
        }
        Ok(arrays)
    }
}
