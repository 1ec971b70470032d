//! Settings of a command line, laid over a document.

/// A setting: a way as `render.spp` and a value in YAML.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    flag: &'static str,
    text: String,
}

impl Setting {
    /// `render.spp=4`, as it follows `--set`.
    #[must_use]
    pub fn set(text: &str) -> Setting {
        Setting { flag: "--set", text: text.to_owned() }
    }

    /// `quality=4`, as it follows `-D`: the value of a variable.
    #[must_use]
    pub fn variable(text: &str) -> Setting {
        Setting { flag: "-D", text: text.to_owned() }
    }

    /// What was written, with its flag.
    #[must_use]
    pub fn words(&self) -> String {
        format!("{} {}", self.flag, self.text)
    }

    /// The first key of its way.
    #[must_use]
    pub fn begins(&self) -> &str {
        if self.flag == "-D" {
            return "variables";
        }
        self.text.split(['.', '=']).next().unwrap_or_default().trim()
    }

    /// The way, step by step, and the value.
    pub(crate) fn parts(&self) -> Result<(Vec<&str>, &str), String> {
        let expected = if self.flag == "-D" { "`name=value`" } else { "`key.key=value`" };
        let (path, value) = self.text.split_once('=').ok_or_else(|| format!("expected {expected}"))?;
        let mut steps: Vec<&str> = path.trim().split('.').collect();
        if steps.iter().any(|step| step.is_empty()) {
            return Err("a key is empty".into());
        }
        if steps.len() > DEEPEST {
            return Err(format!("more than {DEEPEST} keys below each other"));
        }
        if self.flag == "-D" {
            steps.insert(0, "variables");
        }
        Ok((steps, value))
    }
}

/// No document is as deep.
const DEEPEST: usize = 64;
