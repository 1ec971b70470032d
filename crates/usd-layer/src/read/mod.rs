//! Layers from bytes.
