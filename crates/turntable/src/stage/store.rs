//! What variants have in common, made once: grooms by what they were made from, and the last scene.

use std::sync::Arc;

use groom::Groom;
use hair_render::Scene;

use crate::digest::Digest;

/// Bytes of grooms that are kept for the next variant, about.
const MOST_BYTES: usize = 512 << 20;

/// Things that the next variant may want again. Of grooms those used last are kept; a scene is kept until the next.
#[derive(Debug, Default)]
pub(crate) struct Store {
    /// The one used last comes last.
    grooms: Vec<(Digest, Arc<Groom>)>,
    scene: Option<(Digest, Arc<Scene>)>,
}

impl Store {
    /// The groom of this digest, made where it is not there.
    pub fn groom<E>(
        &mut self,
        digest: Digest,
        make: impl FnOnce() -> Result<Groom, E>,
    ) -> Result<Arc<Groom>, E> {
        let groom = match self.grooms.iter().position(|(known, _)| *known == digest) {
            Some(place) => self.grooms.remove(place).1,
            None => Arc::new(make()?),
        };
        self.grooms.push((digest, Arc::clone(&groom)));
        while self.grooms.len() > 1
            && self.grooms.iter().map(|(_, groom)| bytes(groom)).sum::<usize>() > MOST_BYTES
        {
            self.grooms.remove(0);
        }
        Ok(groom)
    }

    /// The scene of this digest, built where it is not the last.
    pub fn scene<E>(
        &mut self,
        digest: Digest,
        build: impl FnOnce() -> Result<Scene, E>,
    ) -> Result<Arc<Scene>, E> {
        if let Some((_, scene)) = self.scene.as_ref().filter(|(known, _)| *known == digest) {
            return Ok(Arc::clone(scene));
        }
        // Two at a time are one too many.
        self.scene = None;
        let scene = Arc::new(build()?);
        self.scene = Some((digest, Arc::clone(&scene)));
        Ok(scene)
    }
}

/// About how much memory a groom takes.
fn bytes(groom: &Groom) -> usize {
    let attributes: usize = groom.attributes().map(|(_, attribute)| 12 * attribute.values.len()).sum();
    12 * groom.point_count() + 4 * groom.strand_count() + attributes
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::digest::Ingredients;

    fn strand() -> Result<Groom, ()> {
        Ok(Groom::new(vec![0, 2], vec![Vec3::ZERO, Vec3::Y]).unwrap())
    }

    #[test]
    fn a_groom_is_made_once_and_the_last_scene_is_kept() {
        let mut store = Store::default();
        let digest = |word: &str| Ingredients::of(word).finish();
        let first = store.groom(digest("a"), strand).unwrap();
        store.groom(digest("b"), strand).unwrap();
        let again = store.groom(digest("a"), || Err(())).unwrap();
        assert!(Arc::ptr_eq(&first, &again));
        assert!(store.groom(digest("c"), || Err(())).is_err());

        let build = || Scene::build(hair_render::SceneDescription::default()).map_err(|_| ());
        let scene = store.scene(digest("a"), build).unwrap();
        assert!(Arc::ptr_eq(&scene, &store.scene(digest("a"), || Err(())).unwrap()));
        store.scene(digest("b"), build).unwrap();
        assert!(store.scene(digest("a"), || Err(())).is_err(), "one scene is kept");
    }
}
