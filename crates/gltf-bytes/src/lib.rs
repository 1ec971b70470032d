//! The bytes behind a glTF document: containers, buffers and accessors, every number checked.
