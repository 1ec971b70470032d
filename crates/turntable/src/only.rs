//! Which variants are looked after.

use crate::{TurntableError, Variant};

/// Whether each variant is asked for by `only`, each `axis=name` or `axis=name,name`: of every axis that is named one
/// of its names.
pub(crate) fn asked(only: &[String], variants: &[Variant]) -> Result<Vec<bool>, TurntableError> {
    let mut wanted: Vec<(&str, Vec<&str>)> = Vec::new();
    for text in only {
        let fault = |reason: String| TurntableError::NoSuchVariant { asked: text.clone(), reason };
        let (axis, names) =
            text.split_once('=').ok_or_else(|| fault("expected AXIS=NAME or AXIS=NAME,NAME".into()))?;
        let axis = axis.trim();
        let all = names_of(axis, variants);
        if all.is_empty() {
            let axes: Vec<&str> =
                variants.iter().flat_map(|v| &v.axes).map(|(axis, _)| axis.as_str()).fold(Vec::new(), once);
            let known = if axes.is_empty() {
                "the pipeline has no `matrix`".to_owned()
            } else {
                format!("the pipeline's axes are {}", axes.join(", "))
            };
            return Err(fault(format!("there is no axis `{axis}`; {known}")));
        }
        for name in names.split(',').map(str::trim) {
            if !all.contains(&name) {
                return Err(fault(format!("`{axis}` has no `{name}`; it has {}", all.join(", "))));
            }
            match wanted.iter_mut().find(|(known, _)| *known == axis) {
                Some((_, names)) => names.push(name),
                None => wanted.push((axis, vec![name])),
            }
        }
    }
    let is_asked = |variant: &Variant| {
        let fits = |(axis, names): &(&str, Vec<&str>)| {
            variant.axes.iter().any(|(own, name)| own == axis && names.contains(&name.as_str()))
        };
        wanted.iter().all(fits)
    };
    Ok(variants.iter().map(is_asked).collect())
}

fn names_of<'a>(axis: &str, variants: &'a [Variant]) -> Vec<&'a str> {
    let own = variants.iter().flat_map(|v| &v.axes).filter(|(own, _)| own == axis);
    own.map(|(_, name)| name.as_str()).fold(Vec::new(), once)
}

fn once<'a>(mut all: Vec<&'a str>, one: &'a str) -> Vec<&'a str> {
    if !all.contains(&one) {
        all.push(one);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variants() -> Vec<Variant> {
        let pairs = [("smooth", "sky"), ("smooth", "lamp"), ("curly", "sky"), ("curly", "lamp")];
        let axes = |(hair, light): (&str, &str)| {
            vec![("hair".to_owned(), hair.to_owned()), ("light".to_owned(), light.to_owned())]
        };
        pairs.into_iter().map(|pair| Variant { axes: axes(pair), ..Variant::default() }).collect()
    }

    fn of(only: &[&str]) -> Result<Vec<bool>, TurntableError> {
        asked(&only.iter().map(|&text| text.to_owned()).collect::<Vec<_>>(), &variants())
    }

    #[test]
    fn names_of_an_axis_add_up_and_axes_narrow_down() {
        assert_eq!(of(&[]).unwrap(), [true; 4]);
        assert_eq!(of(&["hair=smooth"]).unwrap(), [true, true, false, false]);
        assert_eq!(of(&["hair=smooth", "light=sky"]).unwrap(), [true, false, false, false]);
        assert_eq!(of(&["hair=smooth,curly", "light = lamp"]).unwrap(), [false, true, false, true]);
        assert_eq!(of(&["hair=smooth", "hair=curly"]).unwrap(), [true; 4]);
    }

    #[test]
    fn unknown_names_are_told_with_the_known() {
        for (only, words) in [
            ("hair", "expected AXIS=NAME"),
            ("coat=red", "there is no axis `coat`; the pipeline's axes are hair, light"),
            ("hair=rough", "`hair` has no `rough`; it has smooth, curly"),
            ("hair=", "`hair` has no ``"),
        ] {
            let told = of(&[only]).unwrap_err().to_string();
            assert!(told.contains(words) && told.contains(only), "{told}");
        }
        let told = asked(&["a=b".to_owned()], &[Variant::default()]).unwrap_err().to_string();
        assert!(told.contains("no `matrix`"), "{told}");
    }
}
