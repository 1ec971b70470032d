//! A row of pictures, before it is rendered.

use fibre_material::Material;
use hair_render::HairMaterial;

/// One row: one parameter at several values.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The row's name, also that of its file: letters, digits and `-`.
    pub name: &'static str,
    /// What changes, for people.
    pub title: &'static str,
    /// The figure of the thesis it stands for; `None` for rows the thesis does not have.
    pub figure: Option<&'static str>,
    /// What is to be seen.
    pub shows: &'static str,
    /// The pictures, left to right.
    pub cells: Vec<Cell>,
}

/// One picture of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// What is written under it.
    pub caption: String,
    /// What the hair is made of.
    pub material: HairMaterial,
}

impl Cell {
    /// A cell of `fibre`.
    pub(crate) fn new(caption: impl Into<String>, fibre: Material) -> Cell {
        Cell { caption: caption.into(), material: HairMaterial { fibre, ..HairMaterial::default() } }
    }
}
