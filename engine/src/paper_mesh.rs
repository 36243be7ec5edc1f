//! How the drawn points of a leaf lie on its flat paper, and how they hang together, where that is
//! not the plain grid that they are counted by.

/// The drawn mesh of a leaf that is creased, crumpled or torn across, on its flat paper: a creased
/// leaf's points are moved onto its creases, and its cells are cut along them; a torn sheet's run
/// along its path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PaperMesh {
    /// u and v of each point, 0 to 1, row by row from the foot.
    pub places: Vec<[f32; 2]>,
    /// The points of each triangle, around as u to v goes; none reaches over a crease.
    pub triangles: Vec<[u32; 3]>,
    /// The part of the leaf that each triangle belongs to: a set of bits, one for each crease
    /// that it lies beyond as seen from the spine. Of a crumpled sheet, the number of its facet, from 1.
    pub parts: Vec<u16>,
    /// Of a sheet that is torn across, for each point how far it lies on its own side of the path,
    /// and how far along it from where the tear begins, metres; then 1 for the piece on the left of
    /// the path, and -1. Empty of any other.
    pub tears: Vec<[f32; 3]>,
}

impl PaperMesh {
    /// The points of each triangle, and the part that it belongs to.
    pub(crate) fn parted_triangles(&self) -> impl Iterator<Item = ([usize; 3], u16)> {
        let triangles = self.triangles.iter().zip(&self.parts);
        triangles.map(|(corners, part)| (corners.map(|corner| corner as usize), *part))
    }
}
