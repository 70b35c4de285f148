//! The interactive program of antumbra.

#[expect(dead_code, reason = "the interface that shows it comes next")]
mod reference;
#[cfg_attr(not(test), expect(dead_code, reason = "the interface that draws it comes next"))]
mod teach;
