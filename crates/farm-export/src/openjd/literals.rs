//! Texts of the job inside format strings.

use super::{FORMAT, MOST_VALUE, fits};
use crate::FarmError;
use crate::yaml::quoted;

/// A format string has no escape for `{{`. Texts that hold it become hidden parameters, whose values nobody reads
/// for braces, and stand in the template as references to them.
#[derive(Default)]
pub(super) struct Literals {
    hidden: Vec<String>,
}

impl Literals {
    /// `text` as a format string that resolves to it.
    pub fn say(&mut self, text: &str) -> Result<String, FarmError> {
        if !text.contains("{{") && !text.contains("}}") {
            return Ok(text.to_owned());
        }
        fits(&format!("the word `{text}`"), text, MOST_VALUE, "shorten it, or take the braces out of it")?;
        let known = self.hidden.iter().position(|hidden| hidden == text);
        let index = known.unwrap_or_else(|| {
            self.hidden.push(text.to_owned());
            self.hidden.len() - 1
        });
        Ok(format!("{{{{Param.Text{}}}}}", index + 1))
    }

    /// Several.
    pub fn say_all<'a>(
        &mut self,
        texts: impl IntoIterator<Item = &'a String>,
    ) -> Result<Vec<String>, FarmError> {
        texts.into_iter().map(|text| self.say(text)).collect()
    }

    /// The definitions of the hidden parameters.
    pub fn definitions(&self, room: usize) -> Result<String, FarmError> {
        if self.hidden.len() > room {
            return Err(FarmError::TooMany {
                what: "different texts with braces",
                found: self.hidden.len(),
                most: room,
                format: FORMAT,
                remedy: "take the braces out of some",
            });
        }
        let definition = |(index, text): (usize, &String)| {
            format!(
                "- name: Text{}\n  type: STRING\n  default: {}\n  userInterface: {{control: HIDDEN}}\n",
                index + 1,
                quoted(text)
            )
        };
        Ok(self.hidden.iter().enumerate().map(definition).collect())
    }
}
