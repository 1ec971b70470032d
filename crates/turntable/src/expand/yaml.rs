//! YAML to [`Pipeline`].

use strict_yaml::YamlFault;

use crate::schema::Pipeline;

/// Reads a pipeline, refusing keys it does not know.
#[cfg(test)]
pub(crate) fn parse(text: &str) -> Result<Pipeline, YamlFault> {
    strict_yaml::parse(text)
}

/// The same pipeline with `path=value` settings laid over it, each as `render.spp=4`.
pub(crate) fn parse_with(text: &str, settings: &[String]) -> Result<Pipeline, YamlFault> {
    strict_yaml::parse_with(text, settings)
}

#[cfg(test)]
mod tests {
    use strict_yaml::locate;

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
