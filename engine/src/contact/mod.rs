//! How paper meets paper: shapes and lengths of contact, the side on which the parts of a folded
//! leaf lie, whether leaves go through each other, and what is drawn of them kept apart.
//!
//! It knows meshes and sheets, and no book: which leaves may meet, and in which order, its callers
//! say.

pub mod aabb;
pub mod crossing;
pub mod drawn_parts;
pub mod flap_order;
pub mod flaps;
pub mod mesh;
pub mod parted_leaf;
pub mod relief;
pub mod separate;
pub mod separate_folded;
pub mod separate_parts;
pub mod slab;
pub mod tolerance;
pub mod work;
