//! What will be in the file, known before the first byte is written.

use std::io::{self, Write};

use glam::{DVec3, Vec3};
use gltf::json::Value;
use groom::{FloatView, Groom, names};

use super::colors::Colors;
use super::grid::Grid;
use super::moving::Moving;
use super::runs::runs;
use super::space::Space;
use super::surface::{self, Surface};
use super::tail::Tail;
use super::views::{self, View};
use super::{bytes, document, extra};
use crate::drawable::Drawable;
use crate::{Format, FormatError, Warning, WriteOptions, unstored};

/// Vertex index that glTF keeps for restarting primitives.
const RESTART: u64 = u32::MAX as u64;

/// A groom turned into the numbers a glTF file asks for.
pub(crate) struct Plan<'a> {
    pub(super) drawable: Drawable<'a>,
    pub(super) space: Space,
    /// Exact bounds of the vertices, y-up and in metres, before they are rounded to the grid.
    pub(super) bounds: [Vec3; 2],
    pub(super) grid: Option<Grid>,
    pub(super) colors: Option<Colors<'a>>,
    /// Whether any point as written lets light through.
    pub(super) is_clear: bool,
    /// `None` for lines.
    pub(super) surface: Option<Surface<'a>>,
    pub(super) views: Vec<View<'a>>,
    /// The `extras` of the mesh.
    pub(super) marks: Option<Value>,
    /// Arrays behind those of the mesh.
    pub(super) tail: Tail,
    pub(super) moving: Moving<'a>,
    pub(super) warnings: Vec<Warning>,
}

impl<'a> Plan<'a> {
    pub(crate) fn new(
        groom: &'a Groom,
        format: Format,
        file: &str,
        options: &WriteOptions,
    ) -> Result<Self, FormatError> {
        let mut warnings = Vec::new();
        let drawable = Drawable::new(groom, format, file, &mut warnings)?;
        let space = Space::of(groom);
        let surface = Surface::of(groom, options);
        let bounds = match &surface {
            Some(surface) => surface::bounds(surface, drawable, space),
            None => space.bounds(drawable),
        };
        let mut held = vec![names::RADIUS, names::COLOR, names::TRANSPARENCY];
        // Tubes and ribbons have it as their texture coordinate.
        held.extend(surface.as_ref().map(|_| names::ROOT_UV).filter(|_| !options.all_attributes));
        let extras = if options.all_attributes {
            extra::extras(groom, format, &held, &mut warnings)
        } else {
            unstored::left_out(groom, format, &held, &mut warnings);
            Vec::new()
        };
        let colors = Colors::of(groom);
        let is_clear = colors.is_some_and(|colors| colors.judge(drawable, format, &mut warnings));
        let mut plan = Plan {
            drawable,
            space,
            bounds,
            grid: None,
            colors,
            is_clear,
            surface,
            views: Vec::new(),
            marks: None,
            tail: Tail::default(),
            moving: Moving::Nothing,
            warnings,
        };
        plan.refuse_infinite(format, file, options.quantize.is_some())?;
        plan.round_positions(format, options.quantize);
        plan.views = match &plan.surface {
            Some(surface) => views::of_surface(&plan, surface, &extras),
            None => views::of_lines(&plan, &extras),
        };
        if options.all_attributes {
            plan.marks = Some(plan.marks_of(groom, &extras));
        }
        plan.refuse_too_large(format, file)?;
        Ok(plan)
    }

    /// Adds what moves the mesh; its arrays are in the tail.
    pub(super) fn follow(
        &mut self,
        moving: Moving<'a>,
        format: Format,
        file: &str,
    ) -> Result<(), FormatError> {
        if let Moving::Skin(skin) = &moving {
            let vertices = self.drawable.points * self.surface.as_ref().map_or(1, Surface::per_point);
            self.views.extend(views::of_skin(skin, vertices));
        }
        self.moving = moving;
        self.refuse_too_large(format, file)
    }

    pub(crate) fn into_warnings(self) -> Vec<Warning> {
        self.warnings
    }

    /// The document; `bytes_name` is the file of bytes beside it, `None` stands for the second chunk of a `.glb`.
    pub(crate) fn json(&self, bytes_name: Option<&[u8]>) -> io::Result<Vec<u8>> {
        document::json(self, bytes_name)
    }

    /// The buffer the document describes.
    pub(crate) fn write_bytes(&self, stream: &mut impl Write) -> io::Result<()> {
        bytes::write(self, stream)?;
        self.tail.write(stream)
    }

    /// Bytes of the whole buffer.
    pub(super) fn buffer_bytes(&self) -> u64 {
        self.views.iter().map(View::bytes).sum::<u64>() + self.tail.bytes()
    }

    /// The diameter for a radius, in the mesh's units.
    #[inline]
    pub(super) fn width(&self, radius: f32) -> f32 {
        self.space.width(radius) / self.mesh_unit()
    }

    /// A velocity in the mesh's axes and units per second.
    #[inline]
    pub(super) fn velocity(&self, velocity: Vec3) -> Vec3 {
        self.space.vector(velocity) / self.mesh_unit()
    }

    /// Metres in one unit of the mesh.
    #[inline]
    fn mesh_unit(&self) -> f32 {
        match self.grid {
            Some(grid) if grid.is_stored() => grid.scale(),
            _ => 1.0,
        }
    }

    fn marks_of(&self, groom: &Groom, extras: &[(String, extra::Extra<'_>)]) -> Value {
        let standard =
            [("COLOR_0", names::COLOR), (extra::WIDTH, names::RADIUS), ("ALPHA", names::TRANSPARENCY)];
        let standard = standard
            .into_iter()
            .filter_map(|(written, name)| groom.attribute(name).map(|attribute| (written, name, attribute)));
        let names = groom.attributes().filter_map(|(name, attribute)| {
            let (written, _) = extras.iter().find(|(_, extra)| std::ptr::eq(extra.attribute, attribute))?;
            Some((written.as_str(), name, attribute))
        });
        extra::marks(standard.chain(names))
    }

    fn round_positions(&mut self, format: Format, bits: Option<u32>) {
        let Some(bits) = bits else { return };
        let [min, max] = self.bounds;
        let grid = Grid::new(min, max, bits);
        let mut error = 0.0_f64;
        for run in runs(self.drawable) {
            for &point in self.drawable.groom.positions().get(run.vertices).unwrap_or_default() {
                let point = self.space.vector(point);
                let off = DVec3::from(grid.rounded(point)) - DVec3::from(point);
                error = error.max(off.length_squared());
            }
        }
        self.grid = Some(grid);
        let error = error.sqrt() as f32;
        self.warnings.push(Warning::PositionsRounded { format, bits: grid.bits(), error });
    }

    /// A grid also needs the size of the box to be a float.
    fn refuse_infinite(&self, format: Format, file: &str, has_grid: bool) -> Result<(), FormatError> {
        let widest = match self.drawable.groom.radii() {
            FloatView::Constant(radius) => radius,
            FloatView::Strand(radii) | FloatView::Vertex(radii) => radii.iter().copied().fold(0.0, f32::max),
        };
        let [min, max] = self.bounds;
        let is_finite = min.is_finite() && max.is_finite() && (!has_grid || (max - min).is_finite());
        let is_finite = is_finite && self.space.width(widest).is_finite();
        if is_finite {
            return Ok(());
        }
        let what = "is in metres, and this groom's points or widths leave 32-bit floats there";
        Err(FormatError::Unsupported { file: file.to_owned(), format, what })
    }

    fn refuse_too_large(&self, format: Format, file: &str) -> Result<(), FormatError> {
        let points = self.views.iter().skip(1).map(|view| view.count as u64).max().unwrap_or(0);
        // Leaves room for the document and the headers of a .glb.
        let bytes_limit = u64::from(u32::MAX) - (1 << 16);
        let counts = [("points", points, RESTART), ("bytes", self.buffer_bytes(), bytes_limit)];
        for (what, found, limit) in counts {
            if found > limit {
                return Err(FormatError::TooLarge { file: file.to_owned(), format, what, found, limit });
            }
        }
        Ok(())
    }
}
