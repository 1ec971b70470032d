//! The passes a picture can be taken apart into.

/// One pass. The seven light passes add up to the beauty.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Aov {
    /// Light whose first scattering seen by the camera was reflection off a fibre's surface.
    R,
    /// ... transmission through a fibre.
    Tt,
    /// ... one internal reflection.
    Trt,
    /// ... two and more internal reflections.
    Residual,
    /// ... scattering in the medulla.
    Scattered,
    /// ... reflection off a mesh.
    Surface,
    /// Light seen directly: the environment (unless the background is transparent), and area lights that the camera
    /// sees.
    Background,
}

impl Aov {
    /// All of them, in the order they are stored.
    pub const ALL: [Aov; 7] =
        [Aov::R, Aov::Tt, Aov::Trt, Aov::Residual, Aov::Scattered, Aov::Surface, Aov::Background];

    /// The layer's name in files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Aov::R => "R",
            Aov::Tt => "TT",
            Aov::Trt => "TRT",
            Aov::Residual => "residual",
            Aov::Scattered => "scattered",
            Aov::Surface => "surface",
            Aov::Background => "background",
        }
    }

    /// The pass of that name, letter case aside.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Aov> {
        Aov::ALL.into_iter().find(|aov| aov.name().eq_ignore_ascii_case(name))
    }
}

/// A set of passes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct AovSet(u8);

impl AovSet {
    /// No pass beside beauty and alpha.
    #[must_use]
    pub fn none() -> Self {
        AovSet(0)
    }

    /// Every pass.
    #[must_use]
    pub fn all() -> Self {
        Aov::ALL.into_iter().collect()
    }

    /// Adds a pass.
    pub fn insert(&mut self, aov: Aov) {
        self.0 |= 1 << aov as u8;
    }

    /// Whether the pass is in the set.
    #[must_use]
    pub fn contains(self, aov: Aov) -> bool {
        self.0 & (1 << aov as u8) != 0
    }

    /// The passes in the set, in their order.
    pub fn iter(self) -> impl Iterator<Item = Aov> {
        Aov::ALL.into_iter().filter(move |&aov| self.contains(aov))
    }
}

impl FromIterator<Aov> for AovSet {
    fn from_iter<I: IntoIterator<Item = Aov>>(aovs: I) -> Self {
        let mut set = AovSet::none();
        aovs.into_iter().for_each(|aov| set.insert(aov));
        set
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back_to_their_pass() {
        for aov in Aov::ALL {
            assert_eq!(Aov::from_name(&aov.name().to_lowercase()), Some(aov));
            assert!(AovSet::all().contains(aov) && !AovSet::none().contains(aov));
        }
        assert_eq!(Aov::from_name("beauty"), None);
        assert_eq!([Aov::Trt, Aov::R].into_iter().collect::<AovSet>().iter().count(), 2);
    }
}
