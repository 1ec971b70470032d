//! The Curves object: its parts as they come, the tree at the end.

use std::io::{Seek, Write};

use glam::{DVec3, Vec3};
use groom::{Domain, Groom, UpAxis, Values, names};
use ogawa::{
    ArchiveWriter, Compound, DataType, Metadata, Object, OgawaError, Property, StoredSample, TimeSampling,
};

use super::attributes::{self, Parameters};
use super::fault;
use super::origin;
use super::space::Space;
use crate::alembic::schema;
use crate::{Dialect, Format, FormatError, Warning, WriteOptions};

/// The curves' object.
const OBJECT: &str = "groom";
/// `curveBasisAndType`: linear, not periodic, no basis, and the basis again.
const LINEAR: [u8; 4] = [1, 0, 0, 0];
const PROGRAM: &str = concat!("groomkit ", env!("CARGO_PKG_VERSION"));
/// The library whose layout is written.
const ALEMBIC: &str = "Alembic 1.8.8";

/// A groom on its way into an archive.
pub(super) struct CurvesWriter<'a, W> {
    pub(super) groom: &'a Groom,
    pub(super) archive: ArchiveWriter<W>,
    pub(super) space: Space,
    pub(super) dialect: Option<Dialect>,
    file: &'a str,
    /// Where the points are measured from, in the archive's space.
    origin: DVec3,
    parameters: Parameters,
    counts: StoredSample,
    /// Corners of the box around the points, a sample a frame.
    bounds: Vec<StoredSample>,
    /// The same, where the origin puts it.
    placed_bounds: Vec<StoredSample>,
    points: Vec<StoredSample>,
    velocities: Vec<StoredSample>,
    warnings: Vec<Warning>,
}

/// When frames were taken.
pub(super) struct Clock {
    pub(super) times: TimeSampling,
    pub(super) frame_rate: f64,
}

impl<'a, W: Write + Seek> CurvesWriter<'a, W> {
    /// Writes what does not move; with `velocities`, those the groom has.
    pub(super) fn new(
        groom: &'a Groom,
        stream: W,
        file: &'a str,
        options: &WriteOptions,
        origin: DVec3,
        velocities: bool,
    ) -> Result<Self, FormatError> {
        if groom.strand_count() == 0 {
            return Err(FormatError::Empty { file: file.to_owned(), format: Format::Alembic, points: 1 });
        }
        let archive = ArchiveWriter::new(stream).map_err(|e| fault(file, e))?;
        let space = Space::new(groom, options.dialect);
        let mut curves = CurvesWriter {
            groom,
            archive,
            space,
            dialect: options.dialect,
            file,
            origin: space.place(origin),
            parameters: Parameters::default(),
            counts: StoredSample::EMPTY,
            bounds: Vec::new(),
            placed_bounds: Vec::new(),
            points: Vec::new(),
            velocities: Vec::new(),
            warnings: Vec::new(),
        };
        curves.still_parts(velocities).map_err(|e| fault(file, e))?;
        Ok(curves)
    }

    fn still_parts(&mut self, velocities: bool) -> Result<(), OgawaError> {
        let counts: Vec<i32> = self.groom.strands().map(|points| points.len() as i32).collect();
        self.counts = self.archive.values(&counts)?;
        let mut warnings = Vec::new();
        self.parameters = attributes::write(self, &mut warnings)?;
        self.warnings = warnings;
        let velocity = self.groom.attribute(names::VELOCITY).filter(|a| a.domain == Domain::Vertex);
        if let Some(Values::Vec3(values)) = velocity.map(|a| &a.values).filter(|_| velocities) {
            let vectors = self.space.vectors(values);
            self.velocities = vec![self.archive.values(numbers(&vectors))?];
        }
        Ok(())
    }

    /// Writes where the points are at the next time.
    pub(super) fn positions(&mut self, positions: &[Vec3]) -> Result<(), FormatError> {
        let positions = self.space.vectors(positions);
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for &point in &*positions {
            (low, high) = (low.min(point), high.max(point));
        }
        let corners = |by: DVec3| {
            let [low, high] = [low.as_dvec3() + by, high.as_dvec3() + by];
            [low.x, low.y, low.z, high.x, high.y, high.z]
        };
        let mut write = || {
            self.bounds.push(self.archive.values(&corners(DVec3::ZERO))?);
            self.placed_bounds.push(self.archive.values(&corners(self.origin))?);
            self.points.push(self.archive.values(numbers(&positions))?);
            Ok(())
        };
        write().map_err(|e| fault(self.file, e))
    }

    /// Writes how fast the points are at the time of the positions before.
    pub(super) fn velocities(&mut self, velocities: &[Vec3]) -> Result<(), FormatError> {
        let velocities = self.space.vectors(velocities);
        let sample = self.archive.values(numbers(&velocities)).map_err(|e| fault(self.file, e))?;
        self.velocities.push(sample);
        Ok(())
    }

    /// Writes the tree.
    pub(super) fn finish(mut self, clock: Option<Clock>) -> Result<Vec<Warning>, FormatError> {
        let (file, warnings) = (self.file, std::mem::take(&mut self.warnings));
        self.tree(clock).map_err(|e| fault(file, e))?;
        Ok(warnings)
    }

    fn tree(mut self, clock: Option<Clock>) -> Result<(), OgawaError> {
        let mut about = Metadata::new().with("_ai_AlembicVersion", ALEMBIC).with("_ai_Application", PROGRAM);
        let mut times = 0;
        if let Some(clock) = clock {
            about.set(schema::FRAME_RATE, &clock.frame_rate.to_string());
            times = self.archive.add_times(clock.times);
        }
        let kind = self.archive.values(&LINEAR)?;
        let user = self.user_properties()?;
        let frames = self.points.len();
        let moving = |property: Property, samples: &[StoredSample]| {
            samples.iter().fold(property.at(times), |property, &sample| property.with(sample))
        };
        let bounds = || Property::scalar(schema::SELF_BOUNDS, DataType::BOX, meaning("box"));
        let points =
            Property::array(schema::POINTS, DataType::F32X3, meaning("point").with("geoScope", "vtx"));
        let counts = Property::array(schema::COUNTS, DataType::I32, Metadata::new());
        let basis = Property::scalar(schema::KIND, DataType::new(ogawa::Pod::U8, 4), Metadata::new());
        let mut geometry = Compound::new();
        geometry.push(moving(bounds(), &self.bounds));
        geometry.push(moving(points, &self.points));
        geometry.push(moving(counts, &vec![self.counts; frames]));
        geometry.push(moving(basis, &vec![kind; frames]));
        if !self.velocities.is_empty() {
            let property = Property::array(schema::VELOCITIES, DataType::F32X3, meaning("vector"));
            geometry.push(moving(property, &self.velocities));
        }
        self.parameters.native.into_iter().for_each(|property| geometry.push(property));
        if !self.parameters.arbitrary.is_empty() {
            let parameters = self.parameters.arbitrary;
            geometry.push(Property::compound(schema::ARBITRARY, Metadata::new(), parameters));
        }
        geometry.push(Property::compound(schema::USER, Metadata::new(), user));
        let (of_object, of_geometry) = schema::curves();
        let mut object = Object::new(OBJECT, of_object);
        object.properties.push(Property::compound(schema::GEOMETRY, of_geometry, geometry));
        let mut top = Object::top();
        let box_of_all = Property::scalar(schema::CHILD_BOUNDS, DataType::BOX, meaning("box"));
        top.properties.push(moving(box_of_all, &self.placed_bounds));
        top.children.push(origin::place(object, self.origin, &mut self.archive)?);
        self.archive.finish(&top, &about)?;
        Ok(())
    }

    fn user_properties(&mut self) -> Result<Compound, OgawaError> {
        let mut user = Compound::new();
        let archive = &mut self.archive;
        for (name, number) in [schema::VERSION_MAJOR, schema::VERSION_MINOR] {
            let sample = archive.values(&[number])?;
            user.push(Property::scalar(name, DataType::I16, Metadata::new()).with(sample));
        }
        let unit = archive.values(&[self.space.meters_per_unit])?;
        user.push(Property::scalar(schema::METERS_PER_UNIT, DataType::F64, Metadata::new()).with(unit));
        let domains: Vec<String> = self.parameters.domains.iter().map(spread_from).collect();
        let domains = domains.join(",");
        let axis = if self.space.up_axis == UpAxis::Z { "z" } else { "y" };
        let mut texts = vec![(schema::TOOL, PROGRAM), (schema::UP_AXIS, axis)];
        if !domains.is_empty() {
            texts.push((schema::DOMAINS, &domains));
        }
        for (name, text) in texts {
            let sample = archive.texts(&[text])?;
            user.push(Property::scalar(name, DataType::STRING, Metadata::new()).with(sample));
        }
        Ok(user)
    }
}

/// Only standard attributes are spread: their names hold no `=` or `,`.
fn spread_from((name, domain): &(String, Domain)) -> String {
    let domain = if *domain == Domain::Strand { "strand" } else { "groom" };
    format!("{name}={domain}")
}

fn meaning(interpretation: &str) -> Metadata {
    Metadata::new().with("interpretation", interpretation)
}

fn numbers(vectors: &[Vec3]) -> &[f32] {
    bytemuck::cast_slice(vectors)
}
