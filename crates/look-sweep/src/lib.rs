//! Rows of pictures in which one parameter of a fibre changes and nothing else.
//!
//! [`Row::all`] are the figure rows of "A User Friendly Hair Reflectance Model in Houdini" (2019), figures
//! 3.8 to 3.15 and 4.5, and two more (wet, far field). [`sweep`] renders them on a groom, a contact sheet a
//! row, and [`page`] shows the sheets with their captions. [`match_colors`] asks of one groom how far off the
//! colours are that were picked for it.

mod color_set;
mod error;
mod page;
mod row;
mod rows;
mod stage;
mod sweep;

pub use color_set::{NamedColor, NamedMatch, colors, match_colors};
pub use error::SweepError;
pub use page::page;
pub use row::{Cell, Row};
pub use stage::Stage;
pub use sweep::{CellReport, RowReport, SweepOptions, SweptRow, sweep};
