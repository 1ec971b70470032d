//! Where the bytes of an image are.

use std::path::{Path, PathBuf};

use gltf::Image;
use gltf::image::Source;

use crate::buffers::{beside, decode};
use crate::{Buffers, GltfError};

/// An image as it is encoded (PNG or JPEG by glTF 2.0), not decoded and, where it is a file, not loaded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ImageBytes {
    /// Held by the document itself.
    Held(Vec<u8>),
    /// A file beside the document.
    File(PathBuf),
}

impl ImageBytes {
    /// Those of `image`; `folder` is where relative addresses start.
    ///
    /// # Errors
    /// [`GltfError`]: a view outside its buffer, a data URI that is not base64, an address that is no relative
    /// path inside `folder`.
    pub fn of(image: &Image<'_>, buffers: &Buffers<'_>, folder: Option<&Path>) -> Result<Self, GltfError> {
        let place = format!("images[{}]", image.index());
        match image.source() {
            Source::View { view, .. } => Ok(ImageBytes::Held(buffers.view(&view, &place)?.to_vec())),
            Source::Uri { uri, .. } => match uri.strip_prefix("data:") {
                Some(data) => decode(data).map(ImageBytes::Held).ok_or_else(|| {
                    let found = "a data URI that cannot be decoded";
                    GltfError::invalid(place, found, "data:TYPE;base64,CONTENT")
                }),
                None => {
                    folder.and_then(|folder| beside(folder, uri)).map(ImageBytes::File).ok_or_else(|| {
                        GltfError::Unsupported {
                            what: format!("the image address {uri:?}"),
                            remedy: "put the file beside the glTF and name it by a relative path",
                        }
                    })
                }
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_are_views_data_or_files_beside() {
        let json = r#"{"asset":{"version":"2.0"},"images":[{"bufferView":0},{"uri":"data:image/png;base64,AAEC"},
            {"uri":"skin%201.png"},{"uri":"../skin.png"},{"uri":"data:image/png,AA"},{}],
            "bufferViews":[{"buffer":0,"byteLength":2}],"buffers":[{"byteLength":2,"uri":"data:;base64,CQk="}]}"#;
        let document = crate::document::parse(json.as_bytes()).unwrap();
        let buffers = Buffers::load(&document, None, None).unwrap();
        let found: Vec<_> = document
            .images()
            .map(|image| ImageBytes::of(&image, &buffers, Some("here".as_ref())).map_err(|e| e.to_string()))
            .collect();
        assert_eq!(found[0], Ok(ImageBytes::Held(vec![9, 9])));
        assert_eq!(found[1], Ok(ImageBytes::Held(vec![0, 1, 2])));
        assert_eq!(found[2], Ok(ImageBytes::File(Path::new("here").join("skin 1.png"))));
        assert!(found[3].as_ref().unwrap_err().contains("relative path"));
        assert!(found[4].as_ref().unwrap_err().starts_with("images[4]: found a data URI"));
        assert!(found[5].as_ref().unwrap_err().contains("relative path"));
    }
}
