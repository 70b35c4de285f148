//! The interactive program of antumbra.

#[expect(dead_code, reason = "the interface that shows it comes next")]
mod reference;
