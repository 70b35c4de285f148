//! antumbra-testkit
