//! Every mistake a scene file can hold, and what the reader says: where, what, and what to write.

mod check;
mod scene;
mod things;
