//! Path-traces a groom to a multi-layer EXR.

fn main() {}
