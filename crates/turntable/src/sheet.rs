//! How the frames of a pipeline stand on its contact sheet.

use hair_render::SheetLayout;

use crate::schema::{Render, Sheet};

/// The layout `sheet` asks for, of frames as `render` makes them.
pub(crate) fn layout(sheet: &Sheet, render: &Render) -> SheetLayout {
    let Sheet { columns, gap, labels, .. } = *sheet;
    SheetLayout { cell: (render.width, render.height), columns, gap, labels }
}
