//! Every technique against the ray tracer, which shares no visibility code with it.

#[path = "common/classify.rs"]
mod classify;
mod common;

#[path = "techniques/volume.rs"]
mod volume;
