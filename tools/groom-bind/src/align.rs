//! Bringing the groom into the mesh's numbers.

use anyhow::Result;
use groom::Groom;
use groom_binding::{Alignment, BindingError, Space};
use groom_formats::Format;

use crate::args::Aligning;

/// Does what the options ask for, in the order of `--help`; the groom is in the mesh's numbers then.
pub(crate) fn align(groom: &mut Groom, format: Format, space: Space, args: &Aligning) -> Result<()> {
    let alignment = Alignment {
        up: args.up.map(Into::into),
        unit_is_said: args.meters_per_unit.is_some() || format.says_unit(groom),
        scale: args.scale,
        translate: args.translate,
        matrix: args.matrix,
    };
    alignment.apply(groom, space).map_err(|error| match error {
        BindingError::Alignment { .. } => anyhow::anyhow!("--{error}"),
        other => other.into(),
    })
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use glam::Vec3;
    use groom::UpAxis;

    use super::*;
    use crate::args::Args;

    fn aligned(options: &str, format: Format, space: Space) -> Groom {
        let line = format!("groom-bind a --mesh b -o c.usdc {options}");
        let args = Args::try_parse_from(line.split_whitespace()).unwrap();
        let mut groom = Groom::new(vec![0, 1], vec![Vec3::new(1.0, 2.0, 3.0)]).unwrap();
        groom.up_axis = UpAxis::Z;
        groom.meters_per_unit = args.aligning.meters_per_unit.unwrap_or(0.01);
        align(&mut groom, format, space, &args.aligning).unwrap();
        groom
    }

    const METRES: Space = Space { up_axis: UpAxis::Y, meters_per_unit: 1.0, unit_is_said: true };

    #[test]
    fn units_are_taken_where_both_say_and_axes_turned() {
        let root = |groom: &Groom| groom.positions()[0];
        let turned = Vec3::new(1.0, 3.0, -2.0);
        assert_eq!(root(&aligned("", Format::Usdc, METRES)), turned * 0.01);
        assert_eq!(root(&aligned("", Format::Hair, METRES)), turned);
        assert_eq!(root(&aligned("--meters-per-unit 2", Format::Hair, METRES)), turned * 2.0);
        let unsaid = Space { unit_is_said: false, ..METRES };
        assert_eq!(root(&aligned("", Format::Usdc, unsaid)), turned);
        assert_eq!(aligned("", Format::Usdc, unsaid).meters_per_unit, 0.01);
        assert_eq!(root(&aligned("--up y", Format::Hair, METRES)), Vec3::new(1.0, 2.0, 3.0));
        assert_eq!(
            root(&aligned("--scale 2 --translate 0,0,1", Format::Hair, METRES)),
            Vec3::new(2.0, 6.0, -3.0)
        );
    }

    #[test]
    fn a_matrix_says_everything() {
        let groom = aligned("--matrix 0,1,0,0,0,0,1,0,1,0,0,9,0,0,0,1", Format::Usdc, METRES);
        assert_eq!(groom.positions()[0], Vec3::new(2.0, 3.0, 10.0));
        assert_eq!((groom.up_axis, groom.meters_per_unit), (UpAxis::Y, 1.0));
    }
}
