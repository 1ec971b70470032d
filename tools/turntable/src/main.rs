//! Runs scripted turntables from YAML pipelines.

fn main() {}
