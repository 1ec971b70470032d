//! YAML into plain structs. Every fault has its line and plain words: an unknown key comes with the name
//! that may have been meant, a doubled key with its second place, a value of the wrong type with what was
//! found and expected; texts made to exhaust the reader end soon.
//!
//! ```
//! #[derive(Debug, Default, serde::Deserialize)]
//! #[serde(deny_unknown_fields, default)]
//! struct Picture {
//!     width: u32,
//! }
//!
//! let picture: Picture = strict_yaml::parse("width: 4\n")?;
//! assert_eq!(picture.width, 4);
//! let fault = strict_yaml::parse::<Picture>("# a picture\nwidht: 4\n").unwrap_err();
//! assert_eq!(fault.message, "unknown key `widht`, did you mean `width`?");
//! assert_eq!(fault.place.map(|place| place.line), Some(2));
//! # Ok::<(), strict_yaml::YamlFault>(())
//! ```

mod build;
mod document;
mod fault;
mod folders;
mod include;
mod letters;
mod locate;
mod nearest;
mod pieces;
mod read;
mod reading;
mod setting;
mod source;
mod tree;
mod twins;
mod typed;
mod variables;
mod variant;
mod words;
mod write;

pub use document::Document;
pub use fault::{DocumentError, Fault, Place, YamlFault};
pub use locate::locate;
pub use nearest::nearest;
pub use read::parse;
pub use reading::Reading;
pub use setting::Setting;
pub use tree::Node;
pub use write::{write, write_brief};
