//! What contact looks up in the drawn mesh of a creased leaf.

use crate::contact::mesh::{find_beyond, find_falling};
use crate::paper_mesh::PaperMesh;

/// The drawn mesh of a creased leaf, and what contact looks up in it.
#[derive(Clone, Debug)]
pub(super) struct CreasedMesh {
    /// How the drawn points lie on the flat paper.
    pub paper: PaperMesh,
    /// See [`Folds::of`](crate::contact::mesh::Folds::of).
    pub falling: Vec<bool>,
    /// Whether each point lies beyond a crease as seen from the spine.
    pub beyond: Vec<bool>,
}

impl CreasedMesh {
    /// That of a mesh of so many columns.
    pub fn of(paper: PaperMesh, columns: usize) -> CreasedMesh {
        let points = paper.places.len();
        CreasedMesh {
            falling: find_falling(paper.parted_triangles(), columns, points),
            beyond: find_beyond(paper.parted_triangles(), points),
            paper,
        }
    }
}
