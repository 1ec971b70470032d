//! Layers to bytes.
