//! Makes straight, wavy and curly heads of hair.

fn main() {}
