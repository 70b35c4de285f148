//! antumbra-reference
