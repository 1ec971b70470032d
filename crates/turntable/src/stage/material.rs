//! The pipeline's material: what is wrong with it, and what depends on it.

use std::path::{Path, PathBuf};

use fibre_material::{MaterialFile, Picture};
use hair_render::HairColor;

use crate::TurntableError;
use crate::digest::Ingredients;

/// Everything wrong with the material, by key.
pub(crate) fn faults(file: &MaterialFile, base: &Path) -> Vec<(String, String)> {
    let begins = match (&file.file, &file.preset) {
        (Some(_), _) => "material.file",
        (None, Some(_)) => "material.preset",
        (None, None) => "material",
    };
    let below = |(key, message): (String, String)| {
        let dot = if key.is_empty() { "" } else { "." };
        (format!("material{dot}{key}"), message)
    };
    match file.clone().resolved(base) {
        Err(error) => vec![(begins.to_owned(), error.to_string())],
        Ok(file) => {
            file.material(&Picture::unread).err().unwrap_or_default().into_iter().map(below).collect()
        }
    }
}

/// Adds to a digest what the material comes to, whatever files and presets it came by and whichever defaults
/// were stated, and the bytes of its picture, whose name and place do not count.
pub(crate) fn added(
    mut digest: Ingredients,
    file: &MaterialFile,
    base: &Path,
) -> Result<Ingredients, TurntableError> {
    let file = file.clone().resolved(base)?;
    if let Some(texture) = &file.texture {
        digest = digest.file(&texture.file)?;
    }
    let material = file.material(&Picture::unread).map(|mut material| {
        if let HairColor::Texture(texture) = &mut material.color {
            texture.file = PathBuf::new();
        }
        material
    });
    // Numbers are written in full, so that different materials have different words.
    Ok(digest.word(&format!("{material:?}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> MaterialFile {
        MaterialFile::from_yaml(text, "turn.yaml").unwrap()
    }

    #[test]
    fn what_the_material_comes_to_counts_and_not_how_it_is_said() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
        let digest = |text: &str| added(Ingredients::of("x"), &read(text), folder.path()).unwrap().finish();
        write("own.yaml", "preset: human-brown\nbeta_m: 0.2\n");
        let own = digest("file: own.yaml");
        assert_eq!(digest("{preset: human-brown, beta_m: 0.2}"), own);
        assert_eq!(digest("{eumelanin: 1.3, beta_m: 0.2, beta_n: 0.3}"), own);
        write("own.yaml", "# a word about it\npreset: human-brown\nbeta_m: 0.2\n");
        assert_eq!(digest("file: own.yaml"), own, "a remark changes no picture");
        for changed in ["{preset: human-brown, beta_m: 0.21}", "{preset: human-black, beta_m: 0.2}"] {
            write("own.yaml", changed);
            assert_ne!(digest("file: own.yaml"), own, "{changed}");
        }
        assert_ne!(digest("{preset: human-brown, beta_m: 0.2, variation: {white: 0.1}}"), own);
        // A picture counts by its bytes.
        for name in ["a.png", "b.png", "c.png"] {
            write(name, if name == "c.png" { "another picture" } else { "a picture" });
        }
        let of = |name: &str| digest(&format!("texture: {{file: {name}}}"));
        assert_eq!(of("a.png"), of("b.png"));
        assert_ne!(of("a.png"), of("c.png"));
    }

    #[test]
    fn faults_have_the_pipelines_keys() {
        let found = |text: &str| faults(&read(text), Path::new("")).remove(0);
        assert_eq!(found("beta_m: 2").0, "material.beta_m");
        assert_eq!(found("lobes: {TT: -1}").0, "material.lobes.TT");
        assert_eq!(found("file: none.yaml").0, "material.file");
        let (key, message) = found("preset: human-bron");
        assert_eq!(key, "material.preset");
        assert!(message.contains("did you mean `human-brown`?"), "{message}");
        assert!(faults(&read("preset: human-brown\nwet: true"), Path::new("")).is_empty());
    }
}
