//! Sets up, tests and benchmarks groomkit.

fn main() {}
