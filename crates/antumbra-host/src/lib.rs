//! antumbra-host
