//! YAML to [`Pipeline`] and places in the text; the only module that knows the YAML library.

use std::collections::BTreeSet;

use serde::de::{DeserializeSeed, Deserializer, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_yaml::Value;

use crate::schema::Pipeline;
use crate::yaml_words;

/// A place in a text, both counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub line: usize,
    pub column: usize,
}

/// Why a text is no pipeline.
#[derive(Debug)]
pub(crate) struct YamlFault {
    pub place: Option<Place>,
    pub message: String,
}

/// Reads a pipeline, refusing keys it does not know.
pub(crate) fn parse(text: &str) -> Result<Pipeline, YamlFault> {
    // An empty document is a pipeline that says nothing; the checks name what it lacks.
    if text.lines().all(|line| line.trim().is_empty() || line.trim_start().starts_with('#')) {
        return Ok(Pipeline::default());
    }
    check_nesting(text)?;
    let fault = |error: &serde_yaml::Error| YamlFault { place: place_of(error), message: in_words(error) };
    serde_yaml::from_str(text).map_err(|error| match second_of_a_pair(text) {
        // The library places a doubled key at the beginning of the mapping it is in.
        Some(place) if error.to_string().contains("duplicate field") => {
            YamlFault { place: Some(place), ..fault(&error) }
        }
        _ => fault(&error),
    })
}

/// The library's message without its place, which is told apart, in plain words.
fn in_words(error: &serde_yaml::Error) -> String {
    let full = error.to_string();
    let cut = full.rfind(" at line ").filter(|_| error.location().is_some());
    yaml_words::plain(&full[..cut.unwrap_or(full.len())])
}

fn place_of(error: &serde_yaml::Error) -> Option<Place> {
    error.location().map(|l| Place { line: l.line(), column: l.column() })
}

/// Brackets deeper than this are an attack: the library takes quadratic time for them.
const DEEPEST: usize = 128;

fn check_nesting(text: &str) -> Result<(), YamlFault> {
    let mut depth = 0_usize;
    for (index, line) in text.lines().enumerate() {
        for (column, c) in line.chars().enumerate() {
            match c {
                '[' | '{' => depth += 1,
                ']' | '}' => depth = depth.saturating_sub(1),
                _ => {}
            }
            if depth > DEEPEST {
                let place = Some(Place { line: index + 1, column: column + 1 });
                return Err(YamlFault { place, message: format!("more than {DEEPEST} brackets are open") });
            }
        }
    }
    Ok(())
}

/// The same pipeline with `path=value` settings laid over it, each as `render.spp=4`.
pub(crate) fn parse_with(text: &str, settings: &[String]) -> Result<Pipeline, YamlFault> {
    // The text alone first: its faults have places, those of the laid-over tree do not.
    let pipeline = parse(text)?;
    if settings.is_empty() {
        return Ok(pipeline);
    }
    let place_of_none = |message| YamlFault { place: None, message };
    let mut tree: Value = serde_yaml::from_str(text).map_err(|e| place_of_none(e.to_string()))?;
    let mut pipeline = pipeline;
    for setting in settings {
        let fault = |message: String| place_of_none(format!("--set {setting}: {message}"));
        let (path, value) =
            setting.split_once('=').ok_or_else(|| fault("expected `key.key=value`".into()))?;
        check_nesting(value).map_err(|f| fault(f.message))?;
        let value: Value = serde_yaml::from_str(value).map_err(|e| fault(in_words(&e)))?;
        lay(&mut tree, path.trim(), value).map_err(fault)?;
        pipeline = serde_yaml::from_value(tree.clone()).map_err(|e| fault(in_words(&e)))?;
    }
    Ok(pipeline)
}

fn lay(tree: &mut Value, path: &str, value: Value) -> Result<(), String> {
    let mut here = tree;
    for key in path.split('.') {
        if key.is_empty() {
            return Err("a key is empty".into());
        }
        if here.is_null() {
            *here = Value::Mapping(serde_yaml::Mapping::new());
        }
        here = match here {
            Value::Mapping(map) => map.entry(Value::from(key)).or_insert(Value::Null),
            Value::Sequence(list) => {
                let count = list.len();
                let index = key.parse::<usize>().ok().filter(|&i| i < count);
                let index =
                    index.ok_or_else(|| format!("`{key}` is none of the {count} entries (0, 1, ...)"))?;
                &mut list[index]
            }
            _ => return Err(format!("there are no keys below the one before `{key}`")),
        };
    }
    *here = value;
    Ok(())
}

/// Where the value at `path` (keys and list indices) stands in `text`.
///
/// The parser itself is asked: it is sent down the path and refused there, and it says where.
pub(crate) fn locate(text: &str, path: &[&str]) -> Option<Place> {
    let error = Descent { path }.deserialize(serde_yaml::Deserializer::from_str(text)).err()?;
    let arrived = error.to_string().contains(ARRIVED);
    place_of(&error).filter(|_| arrived)
}

const ARRIVED: &str = "\u{1}arrived";

/// Goes down one path, fails at its end and ignores everything else.
struct Descent<'p> {
    path: &'p [&'p str],
}

impl<'de> DeserializeSeed<'de> for Descent<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Descent<'_> {
    type Value = ();

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(if self.path.is_empty() { ARRIVED } else { "a key or entry on the way" })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Some((first, rest)) = self.path.split_first() else { return Err(A::Error::custom(ARRIVED)) };
        while let Some(key) = map.next_key::<String>()? {
            if key == *first {
                map.next_value_seed(Descent { path: rest })?;
            } else {
                map.next_value::<IgnoredAny>()?;
            }
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let Some((first, rest)) = self.path.split_first() else { return Err(A::Error::custom(ARRIVED)) };
        let wanted = first.parse::<usize>().unwrap_or(usize::MAX);
        let mut index = 0;
        loop {
            if index == wanted {
                if list.next_element_seed(Descent { path: rest })?.is_none() {
                    return Ok(());
                }
            } else if list.next_element::<IgnoredAny>()?.is_none() {
                return Ok(());
            }
            index += 1;
        }
    }
}

/// Where a key stands that its mapping has already.
fn second_of_a_pair(text: &str) -> Option<Place> {
    let error = Twins.deserialize(serde_yaml::Deserializer::from_str(text)).err()?;
    let found = error.to_string().contains(ARRIVED);
    place_of(&error).filter(|_| found)
}

/// Goes through everything and fails at the first key that comes twice.
struct Twins;

impl<'de> DeserializeSeed<'de> for Twins {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Twins {
    type Value = ();

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("anything")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let mut seen = BTreeSet::new();
        while map.next_key_seed(NewKey(&mut seen))?.is_some() {
            map.next_value_seed(Twins)?;
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        while list.next_element_seed(Twins)?.is_some() {}
        Ok(())
    }

    fn visit_bool<E: serde::de::Error>(self, _: bool) -> Result<(), E> {
        Ok(())
    }

    fn visit_i64<E: serde::de::Error>(self, _: i64) -> Result<(), E> {
        Ok(())
    }

    fn visit_u64<E: serde::de::Error>(self, _: u64) -> Result<(), E> {
        Ok(())
    }

    fn visit_f64<E: serde::de::Error>(self, _: f64) -> Result<(), E> {
        Ok(())
    }

    fn visit_str<E: serde::de::Error>(self, _: &str) -> Result<(), E> {
        Ok(())
    }

    fn visit_unit<E: serde::de::Error>(self) -> Result<(), E> {
        Ok(())
    }
}

/// A key, if its mapping does not have it yet.
struct NewKey<'s>(&'s mut BTreeSet<String>);

impl<'de> DeserializeSeed<'de> for NewKey<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for NewKey<'_> {
    type Value = ();

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E: serde::de::Error>(self, key: &str) -> Result<(), E> {
        if self.0.insert(key.to_owned()) { Ok(()) } else { Err(E::custom(ARRIVED)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> (usize, String) {
        let fault = parse(text).unwrap_err();
        (fault.place.unwrap().line, fault.message)
    }

    #[test]
    fn unknown_keys_are_named_with_line_and_nearest_name() {
        for (text, line, name, meant) in [
            ("version: 1\ngrom: {file: a}\n", 2, "grom", "groom"),
            ("render:\n  width: 4\n  heigth: 4\n", 3, "heigth", "height"),
            (
                "# x\n\nlights:\n  area:\n    - size: [1, 1]\n      postion: [0, 0, 0]\n",
                6,
                "postion",
                "position",
            ),
            ("groom:\n  sample:\n    stile: wavy\n", 3, "stile", "style"),
            ("groom:\n  sample:\n    style: wafy\n", 3, "wafy", "wavy"),
        ] {
            let (found, message) = fault(text);
            assert_eq!(found, line, "{message}");
            assert!(message.contains(&format!("`{name}`, did you mean `{meant}`?")), "{message}");
        }
        assert!(fault("render:\n  zzzzz: 1\n").1.contains("expected one of `width`, `height`"));
    }

    #[test]
    fn wrong_types_and_doubled_keys_have_a_line() {
        assert_eq!(fault("render:\n  width: 4\n  spp: many\n").0, 3);
        assert_eq!(fault("render:\n  width: 4\n  spp: -1\n").0, 3);
        assert_eq!(fault("material:\n  color: [1, 2]\n").0, 2);
        let (line, words) = fault("render:\n  spp: 4\n  seed: 1\n  spp: 5\n");
        assert_eq!((line, &*words), (4, "render: the key `spp` is there twice"));
        assert_eq!(fault("render: 1.5\n").1, "render: is a number `1.5`, expected keys and values");
        assert_eq!(
            fault("render: {spp: -4}\n").1,
            "render.spp: is a whole number `-4`, expected a whole number in 0..=4294967295"
        );
        assert!(fault("render: [\n").0 <= 2);
    }

    #[test]
    fn places_are_those_of_the_values() {
        let text =
            "version: 1\nlights:\n  area:\n    - azimuth: 1\n    - azimuth:   7\nconvert: [a.txt, b.txt]\n";
        let at = |path: &[&str]| locate(text, path).map(|p| (p.line, p.column));
        assert_eq!(at(&["version"]), Some((1, 10)));
        assert_eq!(at(&["lights", "area", "1", "azimuth"]), Some((5, 18)));
        assert_eq!(at(&["convert", "1"]), Some((6, 18)));
        assert_eq!(at(&["convert", "2"]), None);
        assert_eq!(at(&["render"]), None);
        assert_eq!(at(&["lights"]).map(|p| p.0), Some(3));
    }

    #[test]
    fn settings_lie_over_the_text() {
        let text = "render: {spp: 64}\nlights: {area: [{size: [1, 1]}]}\n";
        let with = |s: &str| parse_with(text, &[s.to_owned()]);
        assert_eq!(with("render.spp=4").unwrap().render.spp, 4);
        assert_eq!(with("lights.area.0.size.1=9").unwrap().lights.area[0].size, [1.0, 9.0]);
        assert_eq!(with("material.color=[1, 0.5, 0]").unwrap().material.color, Some([1.0, 0.5, 0.0]));
        assert_eq!(with("groom.file=a/b.hair").unwrap().groom.file, Some("a/b.hair".into()));
        for (setting, words) in [
            ("render.sppp=4", "did you mean `spp`?"),
            ("render.spp=x", "render.spp"),
            ("render.spp", "expected `key.key=value`"),
            ("lights.area.3.size=1", "none of the 1 entries"),
            ("render.spp.x=1", "no keys below"),
            ("=1", "a key is empty"),
        ] {
            let message = with(setting).unwrap_err().message;
            assert!(message.contains(words) && message.contains(&format!("--set {setting}")), "{message}");
        }
    }

    #[test]
    fn hostile_texts_end_soon() {
        assert!(fault(&format!("convert: {}", "[".repeat(100_000))).1.contains("brackets are open"));
        assert!(fault(&format!("convert: {}a", "- ".repeat(100_000))).0 == 1);
        let mut bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n".to_owned();
        for i in 1..30 {
            bomb += &format!("a{i}: &a{i} [{}]\n", vec![format!("*a{}", i - 1); 10].join(", "));
        }
        // Under a known key too: the library counts what aliases repeat.
        assert!(parse(&bomb).is_err());
        assert!(parse_with("version: 1\n", &[format!("convert={}", "[".repeat(100_000))]).is_err());
        let aliases = "lights: {area: [&a {size: [1, 2]}, *a]}\n";
        assert_eq!(parse(aliases).unwrap().lights.area[1].size, [1.0, 2.0]);
    }

    #[test]
    fn an_empty_text_is_a_pipeline_that_says_nothing() {
        assert_eq!(parse("").unwrap(), Pipeline::default());
        assert_eq!(parse("# only a comment\n").unwrap(), Pipeline::default());
        assert_eq!(parse("---\n").unwrap(), Pipeline::default());
        assert_eq!(parse("render:\nlights:\n  # nothing\n").unwrap(), Pipeline::default());
    }
}
