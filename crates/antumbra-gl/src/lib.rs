//! antumbra-gl
