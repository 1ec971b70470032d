//! USD layers to the byte: `.usda`, `.usdc` and `.usdz`, read and written, without OpenUSD.

pub mod read;
pub mod write;
