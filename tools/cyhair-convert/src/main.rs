//! Converts hair and fur grooms between formats.

fn main() {}
