//! The header of a PLY file: what elements there are and what properties they have.

use groom::UpAxis;

use crate::FormatError;

/// How numbers are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Storage {
    Ascii,
    Little,
    Big,
}

/// A number's type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Type {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Type {
    fn named(name: &str) -> Option<Type> {
        Some(match name {
            "char" | "int8" => Type::I8,
            "uchar" | "uint8" => Type::U8,
            "short" | "int16" => Type::I16,
            "ushort" | "uint16" => Type::U16,
            "int" | "int32" => Type::I32,
            "uint" | "uint32" => Type::U32,
            "float" | "float32" => Type::F32,
            "double" | "float64" => Type::F64,
            _ => return None,
        })
    }

    pub(crate) fn bytes(self) -> usize {
        match self {
            Type::I8 | Type::U8 => 1,
            Type::I16 | Type::U16 => 2,
            Type::I32 | Type::U32 | Type::F32 => 4,
            Type::F64 => 8,
        }
    }

    pub(crate) fn is_float(self) -> bool {
        matches!(self, Type::F32 | Type::F64)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Property {
    pub(crate) name: String,
    pub(crate) item: Type,
    /// The type of a list's length.
    pub(crate) list: Option<Type>,
}

#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub(crate) name: String,
    pub(crate) count: u64,
    pub(crate) properties: Vec<Property>,
    /// Its line in the header.
    pub(crate) line: usize,
}

impl Element {
    /// Bytes of a row at least.
    pub(crate) fn least_bytes(&self, storage: Storage) -> u64 {
        let bytes = |property: &Property| match storage {
            // A digit and what parts it from the next.
            Storage::Ascii => 2,
            _ => property.list.unwrap_or(property.item).bytes() as u64,
        };
        self.properties.iter().map(bytes).sum()
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        self.properties.iter().any(|property| property.name == name)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Header {
    pub(crate) storage: Storage,
    pub(crate) elements: Vec<Element>,
    pub(crate) up_axis: Option<UpAxis>,
    pub(crate) meters_per_unit: Option<f64>,
    /// Bytes of it: the first number follows.
    pub(crate) bytes: usize,
}

impl Header {
    pub(crate) fn read(bytes: &[u8], file: &str) -> Result<Header, FormatError> {
        let mut parser = Parser { file, line: 0, storage: None, header: None };
        let mut at = 0;
        while at < bytes.len() {
            let rest = &bytes[at..];
            let length = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
            at = bytes.len().min(at + length + 1);
            let line = &rest[..length];
            parser.line += 1;
            if parser.take(line.strip_suffix(b"\r").unwrap_or(line))? {
                return parser.finish(at);
            }
        }
        parser.line += 1;
        Err(parser.fault("the end of the file", if at == 0 { "`ply`" } else { "`end_header`" }))
    }
}

struct Parser<'a> {
    file: &'a str,
    line: usize,
    storage: Option<Storage>,
    header: Option<Header>,
}

impl Parser<'_> {
    /// One line; true when it is the last.
    fn take(&mut self, line: &[u8]) -> Result<bool, FormatError> {
        let Some(header) = &mut self.header else {
            if line != b"ply" {
                return Err(self.fault(quoted(line), "`ply`, the first line of a PLY file"));
            }
            let (elements, storage) = (Vec::new(), Storage::Ascii);
            self.header = Some(Header { storage, elements, up_axis: None, meters_per_unit: None, bytes: 0 });
            return Ok(false);
        };
        let text = String::from_utf8_lossy(line);
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        match words[..] {
            ["format", storage, _] => {
                self.storage = match storage {
                    "ascii" => Some(Storage::Ascii),
                    "binary_little_endian" => Some(Storage::Little),
                    "binary_big_endian" => Some(Storage::Big),
                    _ => {
                        let expected = "ascii, binary_little_endian or binary_big_endian";
                        return Err(self.fault(format!("the format `{storage}`"), expected));
                    }
                };
            }
            ["comment", "up_axis", axis] => {
                header.up_axis = match axis {
                    "y" => Some(UpAxis::Y),
                    "z" => Some(UpAxis::Z),
                    _ => None,
                };
            }
            ["comment", "meters_per_unit", unit] => {
                header.meters_per_unit =
                    unit.parse().ok().filter(|unit: &f64| unit.is_normal() && *unit > 0.0);
            }
            ["comment" | "obj_info", ..] | [] => {}
            ["element", name, count] => {
                let Ok(count) = count.parse() else {
                    return Err(self.fault(format!("`{count}` of the element `{name}`"), "a whole number"));
                };
                let line = self.line;
                header.elements.push(Element { name: name.to_owned(), count, properties: Vec::new(), line });
            }
            ["property", "list", length, item, name] => self.property(Some(length), item, name)?,
            ["property", item, name] => self.property(None, item, name)?,
            ["end_header"] => return Ok(true),
            _ => {
                let expected = "format, comment, element, property or end_header";
                return Err(self.fault(quoted(line), expected));
            }
        }
        Ok(false)
    }

    fn property(&mut self, list: Option<&str>, item: &str, name: &str) -> Result<(), FormatError> {
        let known = |name: &str| {
            Type::named(name).ok_or_else(|| {
                self.fault(
                    format!("the type `{name}`"),
                    "char, uchar, short, ushort, int, uint, float or double",
                )
            })
        };
        let list = list.map(known).transpose()?;
        let item = known(item)?;
        if list.is_some_and(Type::is_float) {
            return Err(self.fault("a list whose length is a float", "a length that is an integer"));
        }
        let element = self.header.as_mut().and_then(|header| header.elements.last_mut());
        match element {
            None => Err(self.fault(format!("the property `{name}`"), "an element before it")),
            Some(element) if element.has(name) => {
                Err(self.fault(format!("a second property `{name}`"), "names that differ"))
            }
            Some(element) => {
                element.properties.push(Property { name: name.to_owned(), item, list });
                Ok(())
            }
        }
    }

    fn finish(mut self, bytes: usize) -> Result<Header, FormatError> {
        match (self.header.take(), self.storage) {
            (Some(header), Some(storage)) => Ok(Header { storage, bytes, ..header }),
            _ => Err(self.fault("no format", "`format binary_little_endian 1.0`, or another")),
        }
    }

    fn fault(&self, found: impl Into<String>, expected: &str) -> FormatError {
        FormatError::invalid(self.file, format!("line {}", self.line), found, expected)
    }
}

/// A line for a message, cut when it is long; what cannot be seen is spelt out.
fn quoted(line: &[u8]) -> String {
    let cut = &line[..line.len().min(40)];
    let more = if cut.len() < line.len() { "..." } else { "" };
    format!("`{}`{more}", String::from_utf8_lossy(cut).escape_debug())
}
