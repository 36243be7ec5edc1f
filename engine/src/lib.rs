//! Turnleaf engine.
