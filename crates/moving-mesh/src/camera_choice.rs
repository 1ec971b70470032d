//! Which camera is meant.

use crate::error::Fault;

/// One of a file's cameras.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum CameraChoice {
    /// The first of the file.
    #[default]
    First,
    /// The first of this name: as [`crate::CameraFile::names`] has it; in glTF also the camera's own beside its node's,
    /// in USD also the last name of its path.
    Name(String),
    /// By number, counted from 0.
    Index(usize),
}

impl CameraChoice {
    /// Its number among those there are; each may have two names.
    pub(crate) fn among(
        &self,
        names: &[String],
        also: impl Fn(usize) -> Option<String>,
    ) -> Result<usize, Fault> {
        let found = match self {
            CameraChoice::First => (!names.is_empty()).then_some(0),
            CameraChoice::Index(index) => Some(*index).filter(|&index| index < names.len()),
            CameraChoice::Name(name) => {
                let by_other = || (0..names.len()).find(|&i| also(i).as_deref() == Some(name));
                names.iter().position(|n| n == name).or_else(by_other)
            }
        };
        found.ok_or_else(|| {
            let asked = match self {
                CameraChoice::First => String::new(),
                CameraChoice::Index(index) => format!(" number {index}"),
                CameraChoice::Name(name) => format!(" {name:?}"),
            };
            Fault::NoCamera { asked, known: listed(names) }
        })
    }
}

/// Names, with their numbers.
fn listed(names: &[String]) -> String {
    /// More than these help nobody.
    const MOST: usize = 20;
    if names.is_empty() {
        return "none".to_owned();
    }
    let mut words: Vec<String> =
        names.iter().take(MOST).enumerate().map(|(i, n)| format!("{i} {n:?}")).collect();
    if names.len() > MOST {
        words.push(format!("{} more", names.len() - MOST));
    }
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_finds_by_either_name_or_tells_what_there_is() {
        let names: Vec<String> = ["/A/Cam", "/B/Cam", "/B/Side"].map(str::to_owned).to_vec();
        let last = |i: usize| names[i].rsplit('/').next().map(str::to_owned);
        let among = |choice: CameraChoice| choice.among(&names, last);
        assert_eq!(among(CameraChoice::First).unwrap(), 0);
        assert_eq!(among(CameraChoice::Name("Side".into())).unwrap(), 2);
        assert_eq!(among(CameraChoice::Name("Cam".into())).unwrap(), 0);
        assert_eq!(among(CameraChoice::Name("/B/Cam".into())).unwrap(), 1);
        let told = |choice: CameraChoice| among(choice).unwrap_err().in_file("s.usda".as_ref()).to_string();
        let known = r#"it has 0 "/A/Cam", 1 "/B/Cam", 2 "/B/Side""#;
        assert_eq!(told(CameraChoice::Name("Sid".into())), format!("s.usda: no camera \"Sid\"; {known}"));
        assert_eq!(told(CameraChoice::Index(3)), format!("s.usda: no camera number 3; {known}"));
        let none = CameraChoice::First.among(&[], |_| None).unwrap_err().in_file("s.usda".as_ref());
        assert_eq!(none.to_string(), "s.usda: no camera; it has none");
    }
}
