//! What was lost or odd on the way, without stopping it.

use groom::UpAxis;

use crate::Format;

/// Something a format cannot hold, or something odd in a file that was read all the same.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Warning {
    /// The HAIR file is odd.
    #[cfg(feature = "hair")]
    #[error("{0}")]
    Hair(cyhair::Warning),
    /// Lines of a text file have more numbers than there are meanings for.
    #[error("{found} numbers a line (from line {line}); those after the first {used} are not read")]
    ExtraColumns {
        /// First line with them.
        line: u64,
        /// Numbers on it.
        found: usize,
        /// Numbers that were read.
        used: usize,
    },
    /// Lines of a text file have a position and nothing else.
    #[error("no radius in the file; {radius} is used")]
    NoRadius {
        /// The radius every strand got.
        radius: f32,
    },
    /// An attribute of the file has no place in a groom.
    #[error("the attribute `{name}` is not read: {why}")]
    AttributeNotRead {
        /// Its name in the file.
        name: String,
        /// Why not.
        why: String,
    },
    /// A USD layer pulls in other layers or prims, which are not read.
    #[error(
        "{prims} references, payloads or sublayers are not followed; flatten the stage first: tools/usd/bake.py"
    )]
    CompositionNotFollowed {
        /// How many prims and sublayers.
        prims: usize,
    },
    /// What moves the strands of a file is not followed.
    #[error("{by} of the file move the strands; they are read as modelled, where nothing moves them{remedy}")]
    StillAsModelled {
        /// `joints` or `morph targets`.
        by: &'static str,
        /// What to do about it, after a semicolon; empty where there is nothing.
        remedy: &'static str,
    },
    /// Cubic curves became lines with a larger error than is usual, for the sake of memory.
    #[error(
        "the curves become lines within {error:.1e} of their length, not 1e-3: nearer ones would take more than \
         four times their points; a curve error that is asked for is kept"
    )]
    CurvesCoarser {
        /// The error, in lengths of a curve.
        error: f64,
    },
    /// The format has no place for an attribute.
    #[error("{format} cannot hold the attribute `{name}`; it is left out")]
    AttributeLeftOut {
        /// The format written.
        format: Format,
        /// The attribute's name.
        name: String,
    },
    /// The attribute is written under another name.
    #[error("{format} calls the attribute `{name}` `{written}`")]
    AttributeRenamed {
        /// The format written.
        format: Format,
        /// The attribute's name in the groom.
        name: String,
        /// Its name in the file.
        written: String,
    },
    /// The columns of the format come in an order, and an earlier one had to be made up.
    #[error("{format} cannot hold transparency without colour; white is written")]
    ColorMadeUp {
        /// The format written.
        format: Format,
    },
    /// The format has no up axis, and readers take another one for granted.
    #[error("{format} does not say which way is up, and {} is taken for granted; this groom is {}-up", name(.usual), name(.groom))]
    UpAxisNotStored {
        /// The format written.
        format: Format,
        /// What readers assume.
        usual: UpAxis,
        /// What the groom is.
        groom: UpAxis,
    },
    /// The format has no unit, and the groom's is not the metre.
    #[error("{format} cannot say that a unit is {meters_per_unit} m; keep it beside the file")]
    UnitNotStored {
        /// The format written.
        format: Format,
        /// The groom's unit in metres.
        meters_per_unit: f64,
    },
    /// Strands without a point are no strands; the others keep their index in the file as `id`.
    #[error(
        "{strands} strands of the {format} file have no point and are left out; the others keep their index as `id`"
    )]
    EmptyStrandsLeftOut {
        /// The format read.
        format: Format,
        /// How many.
        strands: usize,
    },
    /// Neighbouring points of a strand are the same.
    #[error("{count} segments have no length (the first ends at point {first_point})")]
    ZeroLengthSegments {
        /// How many.
        count: usize,
        /// Index of the point the first of them ends at.
        first_point: usize,
    },
    /// The file goes on after what it says it holds.
    #[error("{bytes} bytes from byte {offset} on belong to nothing; they are not read")]
    TrailingBytes {
        /// Where they start.
        offset: u64,
        /// How many.
        bytes: u64,
    },
    /// Parts of a file that are no strands, or say nothing that is understood.
    #[error("{count} of {what} in the {format} file are not read")]
    NotRead {
        /// The format read.
        format: Format,
        /// What they are called in the file.
        what: String,
        /// How many.
        count: u64,
    },
    /// The format holds one value where the groom has many.
    #[error("{format} holds one {name} for all strands; the mean is written")]
    Averaged {
        /// The format written.
        format: Format,
        /// The attribute's name.
        name: &'static str,
    },
    /// Strands of one point have no line to draw.
    #[error("{format} cannot hold strands of one point; {strands} are left out")]
    OnePointStrandsLeftOut {
        /// The format written.
        format: Format,
        /// How many.
        strands: usize,
    },
    /// Values outside what the format can hold were moved to its ends.
    #[error("{format} holds {name} from 0 to 1; {values} values are clamped")]
    Clamped {
        /// The format written.
        format: Format,
        /// The attribute's name.
        name: &'static str,
        /// How many points it happened to.
        values: usize,
    },
    /// Values were rounded to fewer bits than the groom has.
    #[error("{format} holds {name} in 8 bits; it is off by up to {error:.1e}")]
    Rounded {
        /// The format written.
        format: Format,
        /// The attribute's name.
        name: &'static str,
        /// The largest difference, on the attribute's own scale.
        error: f32,
    },
    /// Triangles or points among the lines.
    #[error("{primitives} primitives of the {format} file are no lines; they are skipped")]
    PrimitivesSkipped {
        /// The format read.
        format: Format,
        /// How many, each time a mesh is shown.
        primitives: usize,
    },
    /// Only some of the strands have the attribute.
    #[error("only some strands of the {format} file have `{name}`; elsewhere it is 0, or white")]
    AttributePartly {
        /// The format read.
        format: Format,
        /// The attribute's name in the groom.
        name: String,
    },
    /// More frames than viewers like as morph targets.
    #[error(
        "{format} holds every frame as a morph target: {targets} of them are {} MB, and many viewers are slow or \
         refuse beyond some dozens; joints are smaller",
        .bytes / 1_000_000
    )]
    ManyMorphTargets {
        /// The format written.
        format: Format,
        /// How many.
        targets: usize,
        /// Their bytes.
        bytes: u64,
    },
    /// A joint does what translation, rotation and scale cannot: it shears, or its scale has more digits than the
    /// format keeps.
    #[error(
        "{format} keeps translation, rotation and scale of joints: at frame {time} the strands of `{joint}` are off \
         by up to {:.2e} of the groom's size, the most of all",
        .part
    )]
    JointsApproximated {
        /// The format written.
        format: Format,
        /// The joint whose strands are off most.
        joint: String,
        /// When.
        time: f64,
        /// The distance, in sizes of the groom.
        part: f64,
    },
    /// Positions were rounded to a grid, as was asked.
    #[error("{format} holds positions in {bits} bits; they are off by up to {error:.1e} m")]
    PositionsRounded {
        /// The format written.
        format: Format,
        /// Bits of a coordinate.
        bits: u32,
        /// The largest distance between a point and where it is written, metres.
        error: f32,
    },
}

fn name(axis: &UpAxis) -> &'static str {
    match axis {
        UpAxis::Y => "y",
        UpAxis::Z => "z",
    }
}
