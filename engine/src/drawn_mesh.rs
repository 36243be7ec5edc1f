//! How the drawn surface of a leaf lies on its flat paper, if that is not a grid.

/// How the drawn surface of a creased leaf lies on its flat paper: its points are moved onto
/// its creases, and its cells are cut along them.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnMesh {
    /// u and v of each point, 0 to 1, row by row from the foot.
    pub places: Vec<[f32; 2]>,
    /// The points of each triangle, around as u to v goes; none reaches over a crease.
    pub triangles: Vec<[u32; 3]>,
    /// The part of the leaf that each triangle belongs to: a set of bits, one for each crease
    /// that it lies beyond as seen from the spine.
    pub parts: Vec<u16>,
}
