//! What can be said of time on the command line.

use std::str::FromStr;

use clap::ValueEnum;
use hair_render::{Blur, RenderError, Shutter, ShutterOffset, ShutterShape};
use moving_scene::Exposure;

use crate::args::Numbers;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Motion")]
pub struct MotionArgs {
    /// Which frame of an animated groom or mesh; need not be whole [default: the groom's first; meshes beside a
    /// still groom stay as their file stands]
    #[arg(long, value_name = "F", allow_hyphen_values = true)]
    pub frame: Option<f64>,
    /// Frames a second [default: what the groom says, else the first mesh that does, else 24]; the frames of a
    /// .usd* or .abc file stay at its own rate
    #[arg(long, value_name = "RATE")]
    pub fps: Option<f64>,
    /// When light is let in: OPEN:CLOSE in frames relative to the frame, or a length in frames, placed by
    /// --shutter-offset; nothing comes of it where nothing moves
    #[arg(long, value_name = "OPEN:CLOSE", default_value = "-0.25:0.25", allow_hyphen_values = true)]
    pub shutter: Span,
    /// Where a shutter that was given as a length sits about the frame
    #[arg(long, value_enum, default_value_t = Offset::Centre)]
    pub shutter_offset: Offset,
    /// How the shutter opens and closes: box, triangle, cosine, trapezoid:OPENING,CLOSING (shares of the time)
    /// or curve:HEIGHT,HEIGHT,...
    #[arg(long, value_name = "SHAPE", default_value = "box")]
    pub shutter_shape: ShutterShape,
    /// Times at which the shape of what moves is held, 2..=1025 [default: 2; 3 with accelerations]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=1025))]
    pub motion_samples: Option<u16>,
    /// What strands are blurred by [default: the best that the file has, the last of these]
    #[arg(long, value_enum)]
    pub blur: Option<BlurBy>,
    /// Which animation moves the meshes, by name or number from 0 (glTF) [default: the first]
    #[arg(long, value_name = "NAME")]
    pub mesh_animation: Option<String>,

    /// Where the camera is when the shutter closes, by azimuth: it turns on its arc, from --azimuth
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, conflicts_with_all = ["from"])]
    pub azimuth_to: Option<f64>,
    /// By elevation
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, conflicts_with_all = ["from"])]
    pub elevation_to: Option<f64>,
    /// By distance
    #[arg(long, value_name = "METRES", conflicts_with_all = ["from"])]
    pub distance_to: Option<f64>,
    /// By field of view
    #[arg(long, value_name = "DEGREES")]
    pub fov_to: Option<f64>,
    /// By what it looks at
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub look_at_to: Option<Numbers<3>>,
    /// By where it stands: it goes straight, from --from
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, requires = "from")]
    pub from_to: Option<Numbers<3>>,
}

/// A shutter as it is said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Span {
    /// From when to when.
    Ends(f64, f64),
    /// For how long.
    Length(f64),
}

impl FromStr for Span {
    type Err = String;

    fn from_str(words: &str) -> Result<Self, String> {
        let number = |word: &str| {
            word.trim().parse::<f64>().map_err(|_| {
                format!("`{words}` is no shutter; expected OPEN:CLOSE or a length, in frames, as -0.25:0.25 or 0.5")
            })
        };
        match words.split_once(':') {
            Some((open, close)) => Ok(Span::Ends(number(open)?, number(close)?)),
            None => Ok(Span::Length(number(words)?)),
        }
    }
}

/// Where a shutter sits.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Offset {
    /// It opens at the frame
    Start,
    /// The frame is its middle
    Centre,
    /// It closes at the frame
    End,
}

/// What strands are blurred by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BlurBy {
    /// Nothing is: strands, meshes and camera stand still
    Off,
    /// The positions that the file has at different times
    Positions,
    /// Positions at the frame, and velocities
    Velocities,
    /// Velocities and accelerations
    Accelerations,
}

impl From<BlurBy> for Blur {
    fn from(by: BlurBy) -> Self {
        match by {
            BlurBy::Off => Blur::Off,
            BlurBy::Positions => Blur::Positions,
            BlurBy::Velocities => Blur::Velocities,
            BlurBy::Accelerations => Blur::Accelerations,
        }
    }
}

impl MotionArgs {
    /// The shutter that was asked for.
    fn shutter(&self) -> Result<Shutter, RenderError> {
        let shape = self.shutter_shape.clone();
        let offset = match self.shutter_offset {
            Offset::Start => ShutterOffset::Start,
            Offset::Centre => ShutterOffset::Centre,
            Offset::End => ShutterOffset::End,
        };
        match self.shutter {
            Span::Ends(open, close) => Shutter::new(open, close, shape),
            Span::Length(length) => Shutter::placed(length, offset, shape),
        }
    }

    /// How the picture is exposed.
    pub fn exposure(&self) -> Result<Exposure, RenderError> {
        Ok(Exposure {
            shutter: self.shutter()?,
            blur: self.blur.map(Blur::from),
            samples: self.motion_samples.map(usize::from),
            frame_rate: self.fps,
        })
    }

    /// Whether anything is to be blurred.
    pub fn blurs(&self) -> bool {
        self.blur != Some(BlurBy::Off)
    }

    /// The first option that moves the camera, if any was given.
    pub fn camera_moves(&self) -> Option<&'static str> {
        let given = [
            ("--azimuth-to", self.azimuth_to.is_some()),
            ("--elevation-to", self.elevation_to.is_some()),
            ("--distance-to", self.distance_to.is_some()),
            ("--fov-to", self.fov_to.is_some()),
            ("--look-at-to", self.look_at_to.is_some()),
            ("--from-to", self.from_to.is_some()),
        ];
        given.into_iter().find(|&(_, given)| given).map(|(name, _)| name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shutters_are_read_or_refused() {
        assert_eq!("-0.25:0.25".parse(), Ok(Span::Ends(-0.25, 0.25)));
        assert_eq!("0.5".parse(), Ok(Span::Length(0.5)));
        for words in ["", "a:b", "1:", "1:2:3", "half"] {
            assert!(words.parse::<Span>().unwrap_err().contains("OPEN:CLOSE"), "{words}");
        }
    }
}
