//! Which formats there are and what each can do.

use std::fmt;
use std::path::Path;

use groom::Groom;

/// A file format that holds strands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// Yuksel's HAIR, `.hair`.
    Hair,
    /// Plain text, `.txt`; see [`text`](crate::text).
    Text,
    /// glTF with its bytes in a `.bin` beside it, `.gltf`.
    Gltf,
    /// glTF in one binary file, `.glb`.
    Glb,
    /// USD as text, `.usda`.
    Usda,
    /// USD as a binary crate, `.usdc`; also what `.usd` is written as.
    Usdc,
    /// USD in a package, `.usdz`.
    Usdz,
    /// Alembic, `.abc`, with Unreal's groom schema.
    Alembic,
    /// Stanford polygons holding strands, `.ply`.
    Ply,
    /// USC's hair data, `.data`.
    Data,
    /// Wavefront OBJ with its lines, `.obj`.
    Obj,
    /// pbrt's curves, `.pbrt`.
    Pbrt,
    /// AMD's TressFX, `.tfx`.
    Tfx,
    /// MonoHair's own layout, which also ends in `.hair`.
    MonoHair,
    /// CT2Hair's strands, `.bin`.
    Ct2Hair,
}

/// What there is to say about a format.
struct Facts {
    /// The name, which is also the ending of its files.
    name: &'static str,
    title: &'static str,
    feature: &'static str,
    built: bool,
    reads: bool,
    writes: bool,
}

impl Format {
    /// Every format, in the order the documentation lists them.
    pub const ALL: [Format; 15] = [
        Format::Hair,
        Format::Text,
        Format::Usda,
        Format::Usdc,
        Format::Usdz,
        Format::Alembic,
        Format::Gltf,
        Format::Glb,
        Format::Ply,
        Format::Data,
        Format::Obj,
        Format::Pbrt,
        Format::Tfx,
        Format::MonoHair,
        Format::Ct2Hair,
    ];

    fn facts(self) -> Facts {
        let facts =
            |name, title, feature, built, reads, writes| Facts { name, title, feature, built, reads, writes };
        match self {
            Format::Hair => facts("hair", "cyHair by Cem Yuksel", "hair", cfg!(feature = "hair"), true, true),
            Format::Text => {
                facts("txt", "text, as Mitsuba reads it", "text", cfg!(feature = "text"), true, true)
            }
            Format::Usda => facts("usda", "USD as text", "usda", cfg!(feature = "usda"), true, true),
            Format::Usdc => facts("usdc", "USD, binary", "usdc", cfg!(feature = "usdc"), true, true),
            Format::Usdz => facts("usdz", "USD, packaged", "usdz", cfg!(feature = "usdz"), true, true),
            Format::Alembic => facts("abc", "Alembic", "alembic", cfg!(feature = "alembic"), true, true),
            Format::Gltf => facts("gltf", "glTF", "gltf", cfg!(feature = "gltf"), true, true),
            Format::Glb => facts("glb", "glTF, binary", "gltf", cfg!(feature = "gltf"), true, true),
            Format::Ply => facts("ply", "PLY strands", "ply", cfg!(feature = "ply"), true, true),
            Format::Data => facts("data", "USC hair", "data", cfg!(feature = "data"), true, true),
            Format::Obj => facts("obj", "Wavefront lines", "obj", cfg!(feature = "obj"), true, true),
            Format::Pbrt => facts("pbrt", "pbrt curves", "pbrt", cfg!(feature = "pbrt"), false, true),
            Format::Tfx => facts("tfx", "TressFX 3 and 4", "tfx", cfg!(feature = "tfx"), true, false),
            Format::MonoHair => facts(
                "monohair",
                "MonoHair, files end in .hair",
                "monohair",
                cfg!(feature = "monohair"),
                true,
                false,
            ),
            Format::Ct2Hair => facts("bin", "CT2Hair", "ct2hair", cfg!(feature = "ct2hair"), true, false),
        }
    }

    /// The name, which is also the file ending: `hair`, `txt`, `usdc` and so on.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// A few words on what it is.
    #[must_use]
    pub fn title(self) -> &'static str {
        self.facts().title
    }

    /// What of a groom it can hold, in a few words.
    #[must_use]
    pub fn holds(self) -> &'static str {
        match self {
            Format::Hair => "points, width, transparency, colour by vertex",
            Format::Text => "points, width, colour, transparency by vertex",
            Format::Usda | Format::Usdc | Format::Usdz => {
                "everything: all attributes, unit, up axis, motion, velocities, material"
            }
            Format::Alembic => "all attributes, unit and up axis (as properties of ours), motion, velocities",
            Format::Gltf | Format::Glb => {
                "lines with width and colour in 8 bits; all attributes if asked; tubes, ribbons; metres, y up"
            }
            Format::Ply => "points, width, colour and other attributes by vertex",
            Format::Data => "points",
            Format::Obj => "points, colour by vertex",
            Format::Pbrt => "cubic curves with width, a hair material",
            Format::Tfx | Format::MonoHair => "points",
            Format::Ct2Hair => "points and four more numbers a point",
        }
    }

    /// The cargo feature it is built with.
    #[must_use]
    pub fn feature(self) -> &'static str {
        self.facts().feature
    }

    /// The format called `name`, in any case; `text` is taken for `txt`, `usd` for `usdc`, and the names
    /// of the features for what they name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Format> {
        match name.to_ascii_lowercase().as_str() {
            "text" => Some(Format::Text),
            "usd" => Some(Format::Usdc),
            "alembic" => Some(Format::Alembic),
            "ct2hair" => Some(Format::Ct2Hair),
            name => Format::ALL.into_iter().find(|format| format.name() == name),
        }
    }

    /// The format a path's ending stands for; [`Format::sniff`] tells those apart that share one.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Format> {
        path.extension().and_then(|ending| ending.to_str()).and_then(Format::from_name)
    }

    /// The format of a file whose name promises `self`, after a look at its first bytes: `.usd` is text or a
    /// crate, and a `.hair` without Yuksel's magic is MonoHair's.
    #[must_use]
    pub fn sniff(self, head: &[u8]) -> Format {
        match self {
            Format::Usda | Format::Usdc if head.starts_with(b"PXR-USDC") => Format::Usdc,
            Format::Usda | Format::Usdc if head.starts_with(b"#usda") => Format::Usda,
            Format::Usda | Format::Usdc if head.starts_with(b"PK\x03\x04") => Format::Usdz,
            Format::Gltf if head.starts_with(b"glTF") => Format::Glb,
            Format::Hair if crate::look_alike::is_monohair(head) => Format::MonoHair,
            other => other,
        }
    }

    /// Whether grooms can be read from this format by this build.
    #[must_use]
    pub fn can_read(self) -> bool {
        let facts = self.facts();
        facts.built && facts.reads
    }

    /// Whether grooms can be written in this format by this build.
    #[must_use]
    pub fn can_write(self) -> bool {
        let facts = self.facts();
        facts.built && facts.writes
    }

    /// Whether the file that `groom` was read from says how large its unit is.
    #[must_use]
    pub fn says_unit(self, groom: &Groom) -> bool {
        match self {
            Format::Usda | Format::Usdc | Format::Usdz | Format::Gltf | Format::Glb => true,
            // Only Alembic files of ours say it; 1 is what a reader takes where nothing is said.
            Format::Alembic => groom.meters_per_unit != 1.0,
            _ => false,
        }
    }

    /// Whether the cargo feature of this format is on.
    #[must_use]
    pub fn is_built(self) -> bool {
        self.facts().built
    }

    /// Whether a file of this format is one stream of bytes, fit for a pipe.
    #[must_use]
    pub fn streams(self) -> bool {
        self != Format::Gltf
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_name_formats() {
        for format in Format::ALL {
            let path = format!("a folder/head.v2.{}", format.name().to_uppercase());
            assert_eq!(Format::from_path(Path::new(&path)), Some(format));
            assert_eq!(Format::from_name(&format.to_string()), Some(format));
        }
        assert_eq!(Format::from_name("text"), Some(Format::Text));
        assert_eq!(Format::from_name("usd"), Some(Format::Usdc));
        for path in ["hair", "a.fbx", "a.mp4", ".hair", "a."] {
            assert_eq!(Format::from_path(Path::new(path)), None, "{path}");
        }
    }
}
