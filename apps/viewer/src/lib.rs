//! The interactive program of antumbra.
