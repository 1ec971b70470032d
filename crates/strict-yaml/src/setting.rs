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

    /// Whether it lies at or below `key`, the first of its way.
    #[must_use]
    pub fn is_below(&self, key: &str) -> bool {
        self.parts().is_ok_and(|(steps, _)| steps.first() == Some(&key))
    }

    /// The name of the variable it gives a value to, if that is what it does.
    #[must_use]
    pub fn variable_name(&self) -> Option<&str> {
        match *self.parts().ok()?.0 {
            ["variables", name, ..] => Some(name),
            _ => None,
        }
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
