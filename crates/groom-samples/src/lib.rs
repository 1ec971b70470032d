//! Procedural heads of hair: straight, wavy and curly.
