//! C face.
