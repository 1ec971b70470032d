//! Rows of a table, each cell checked.

use std::io::Read;

use csv::StringRecord;
use fibre_scattering::{FurParameters, HairParameters, Medulla, RoughnessScales, WaterFilm};
use glam::Vec3;

use super::columns::{COLUMNS, REFERENCES};
use crate::error::VerificationError;

/// What a positive `alpha_deg` means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Tilt {
    /// R is tilted to the root: Marschner, Cycles, this project.
    #[default]
    ToRoot,
    /// R is tilted to the end the tangent points to: pbrt, Mitsuba, RenderMan.
    ToTip,
}

/// One fibre, seen and lit from one direction each.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Line of the file, from 1.
    pub line: u64,
    /// The cells as they were written.
    pub cells: StringRecord,
    /// Name of the set it belongs to; empty without such a column.
    pub set: String,
    /// The fibre.
    pub parameters: FurParameters,
    /// Inclination and azimuth of the viewer, radians.
    pub outgoing: (f64, f64),
    /// Of the light; its azimuth is counted from the viewer's.
    pub incoming: (f64, f64),
    /// Offset across the fibre.
    pub h: f64,
    /// What another renderer answered, where all such columns are there.
    pub reference: Option<Reference>,
}

/// What another renderer answered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// f cos(theta_i) of the renderer.
    pub value: [f64; 3],
    /// Its density.
    pub pdf: f64,
    /// f cos(theta_i) of an exact evaluation of the same formulas.
    pub exact: [f64; 3],
}

/// Reads a whole table: its headings and its rows.
///
/// # Errors
/// [`VerificationError`]: the first heading that is not known, cell that is no number, fibre that cannot be.
pub fn rows(input: impl Read, tilt: Tilt) -> Result<(StringRecord, Vec<Row>), VerificationError> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(input);
    let headings = reader.headers()?.clone();
    check_headings(&headings)?;
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record?;
        let line = record.position().map_or(0, csv::Position::line);
        rows.push(row(&headings, record, line, tilt)?);
    }
    Ok((headings, rows))
}

fn check_headings(headings: &StringRecord) -> Result<(), VerificationError> {
    for (place, name) in headings.iter().enumerate() {
        let known = name == "set" || REFERENCES.contains(&name) || COLUMNS.iter().any(|c| c.name == name);
        let fault = if !known {
            let names = COLUMNS.map(|column| column.name).join(", ");
            format!("is not known; there are: set, {names}, {}", REFERENCES.join(", "))
        } else if headings.iter().take(place).any(|before| before == name) {
            "is there twice".to_owned()
        } else {
            continue;
        };
        return Err(VerificationError::Heading { column: name.to_owned(), fault });
    }
    Ok(())
}

/// The cells of one row by the names of their columns.
struct Cells<'a> {
    headings: &'a StringRecord,
    record: &'a StringRecord,
    line: u64,
}

impl Cells<'_> {
    fn text(&self, name: &str) -> Option<&str> {
        let place = self.headings.iter().position(|heading| heading == name)?;
        self.record.get(place)
    }

    /// The number of a column; its default where it is missing.
    fn number(&self, name: &'static str, low: f64, high: f64) -> Result<f64, VerificationError> {
        let default = COLUMNS.iter().find(|column| column.name == name).and_then(|column| column.default);
        Ok(self.optional(name, low, high)?.or(default).unwrap_or_default())
    }

    fn optional(&self, name: &str, low: f64, high: f64) -> Result<Option<f64>, VerificationError> {
        let Some(text) = self.text(name) else { return Ok(None) };
        let fault = |expected| VerificationError::Cell {
            line: self.line,
            column: name.to_owned(),
            found: text.to_owned(),
            expected,
        };
        let number: f64 = text.parse().map_err(|_| fault("a number"))?;
        if !number.is_finite() {
            return Err(fault("a finite number"));
        }
        if number < low || number > high {
            return Err(fault(if high == 90.0 { "-90..90" } else { "-1..1" }));
        }
        Ok(Some(number))
    }

    fn free(&self, name: &'static str) -> Result<f64, VerificationError> {
        self.number(name, f64::NEG_INFINITY, f64::INFINITY)
    }

    fn single(&self, name: &'static str) -> Result<f32, VerificationError> {
        Ok(self.free(name)? as f32)
    }

    fn rgb(&self, names: [&'static str; 3]) -> Result<Vec3, VerificationError> {
        let [r, g, b] = names;
        Ok(Vec3::new(self.single(r)?, self.single(g)?, self.single(b)?))
    }
}

fn row(
    headings: &StringRecord,
    record: StringRecord,
    line: u64,
    tilt: Tilt,
) -> Result<Row, VerificationError> {
    let cells = Cells { headings, record: &record, line };
    let parameters = parameters(&cells, tilt)?;
    parameters.check().map_err(|fault| VerificationError::Row { line, fault: Box::new(fault.into()) })?;
    let inclination = |name| cells.number(name, -90.0, 90.0).map(f64::to_radians);
    let outgoing = (inclination("theta_o_deg")?, cells.free("phi_o_deg")?.to_radians());
    let incoming = (inclination("theta_i_deg")?, cells.free("phi_deg")?.to_radians());
    let h = cells.number("h", -1.0, 1.0)?;
    let (set, reference) = (cells.text("set").unwrap_or_default().to_owned(), reference(&cells)?);
    Ok(Row { line, set, parameters, outgoing, incoming, h, reference, cells: record })
}

fn parameters(cells: &Cells<'_>, tilt: Tilt) -> Result<FurParameters, VerificationError> {
    let any = |name| cells.optional(name, f64::NEG_INFINITY, f64::INFINITY);
    let film = any("film_eta")?.map(|eta| WaterFilm { eta: eta as f32, ..WaterFilm::default() });
    let film = match (film, any("film_roughness")?) {
        (Some(film), Some(roughness)) => Some(WaterFilm { roughness: roughness as f32, ..film }),
        (film, _) => film,
    };
    let sign = if tilt == Tilt::ToTip { -1.0 } else { 1.0 };
    let hair = HairParameters {
        beta_m: cells.single("beta_m")?,
        beta_n: cells.single("beta_n")?,
        alpha: (sign * cells.free("alpha_deg")?.to_radians()) as f32,
        eta: cells.single("eta")?,
        sigma_a: cells.rgb(["sigma_r", "sigma_g", "sigma_b"])?,
        lobe_weights: [
            cells.single("lobe_r")?,
            cells.single("lobe_tt")?,
            cells.single("lobe_trt")?,
            1.0,
            1.0,
        ],
        roughness_scales: RoughnessScales { tt: cells.single("scale_tt")?, trt: cells.single("scale_trt")? },
        cuticle_layers: any("cuticle_layers")?.map(|layers| layers as f32),
        film,
        aspect: cells.single("aspect")?,
    };
    let medulla = Medulla {
        kappa: cells.single("kappa")?,
        sigma_s: cells.single("medulla_sigma_s")?,
        sigma_a: cells.rgb(["medulla_sigma_r", "medulla_sigma_g", "medulla_sigma_b"])?,
        g: cells.single("g")?,
    };
    Ok(FurParameters { hair, medulla })
}

fn reference(cells: &Cells<'_>) -> Result<Option<Reference>, VerificationError> {
    let mut numbers = [0.0; 7];
    for (number, name) in numbers.iter_mut().zip(REFERENCES) {
        let Some(found) = cells.optional(name, f64::NEG_INFINITY, f64::INFINITY)? else { return Ok(None) };
        *number = found;
    }
    let [r, g, b, pdf, x, y, z] = numbers;
    Ok(Some(Reference { value: [r, g, b], pdf, exact: [x, y, z] }))
}
