//! Groom files: one module and one feature per format, bytes to Groom and back.
