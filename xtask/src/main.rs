//! What people and continuous integration both run.
fn main() {}
