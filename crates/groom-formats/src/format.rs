//! Which formats there are and what each can do.

use std::fmt;
use std::path::Path;

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
}

impl Format {
    /// Every format, in the order the documentation lists them.
    pub const ALL: [Format; 5] = [Format::Hair, Format::Text, Format::Gltf, Format::Glb, Format::Usda];

    /// The name, which is also the file ending: `hair`, `txt`, `gltf`, `glb`, `usda`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Format::Hair => "hair",
            Format::Text => "txt",
            Format::Gltf => "gltf",
            Format::Glb => "glb",
            Format::Usda => "usda",
        }
    }

    /// The format called `name`, in any case; `text` is taken for `txt`.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Format> {
        let name = name.to_ascii_lowercase();
        if name == "text" {
            return Some(Format::Text);
        }
        Format::ALL.into_iter().find(|format| format.name() == name)
    }

    /// The format a path's ending stands for.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Format> {
        path.extension().and_then(|ending| ending.to_str()).and_then(Format::from_name)
    }

    /// Whether grooms can be read from this format by this build.
    #[must_use]
    pub fn can_read(self) -> bool {
        self.is_built() && matches!(self, Format::Hair | Format::Text)
    }

    /// Whether grooms can be written in this format by this build.
    #[must_use]
    pub fn can_write(self) -> bool {
        self.is_built()
    }

    /// Whether a file of this format is one stream of bytes, fit for a pipe.
    #[must_use]
    pub fn streams(self) -> bool {
        self != Format::Gltf
    }

    /// Whether the cargo feature of this format is on.
    fn is_built(self) -> bool {
        match self {
            Format::Hair => cfg!(feature = "hair"),
            Format::Text => cfg!(feature = "text"),
            Format::Gltf | Format::Glb => cfg!(feature = "gltf"),
            Format::Usda => cfg!(feature = "usda"),
        }
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
        for path in ["hair", "a.obj", "a.usdc", ".hair", "a."] {
            assert_eq!(Format::from_path(Path::new(path)), None, "{path}");
        }
    }
}
