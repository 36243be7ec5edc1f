//! What is drawn of a leaf, as the viewer reads it: one record for books, torn leaves, flaps and
//! loose leaves (`engine/drawn_leaf.ts`).

use turnleaf_engine::{PaperMesh, Surface};

/// What is drawn of a leaf: numbers, and addresses that stay until the leaf is next stepped, drawn or
/// changed. The viewer reads it as so many 32-bit numbers, in this order.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Drawn {
    /// Points along a row.
    pub columns: u32,
    /// Rows, from the foot.
    pub rows: u32,
    /// x, y, z of each point in metres, f32, row by row from the foot.
    pub positions: *const f32,
    /// x, y, z of each point's unit normal, f32.
    pub normals: *const f32,
    /// Rises whenever the positions change.
    pub version: u32,
    /// Rises whenever the mesh itself changes.
    pub topology: u32,
    /// Thickness of the paper, metres.
    pub caliper: f32,
    /// Number of triangles; 0 where the points are a plain grid, and nothing follows.
    pub triangles: u32,
    /// u and v of each point on the flat paper, 0 to 1, f32.
    pub places: *const f32,
    /// The points of each triangle, u32.
    pub corners: *const u32,
    /// The part that each triangle belongs to, u16.
    pub parts: *const u16,
    /// Of a sheet that is torn across, three numbers of each point (`PaperMesh::tears`), f32; else 0.
    pub tears: *const f32,
}

impl Drawn {
    const NONE: Drawn = Drawn {
        columns: 0,
        rows: 0,
        positions: core::ptr::null(),
        normals: core::ptr::null(),
        version: 0,
        topology: 0,
        caliper: 0.0,
        triangles: 0,
        places: core::ptr::null(),
        corners: core::ptr::null(),
        parts: core::ptr::null(),
        tears: core::ptr::null(),
    };
}

/// The record that was asked for last.
static mut DRAWN: Drawn = Drawn::NONE;

/// Writes what is drawn of a leaf. Returns where, until the next record is written.
pub(crate) fn drawn(surface: &Surface, mesh: Option<&PaperMesh>, caliper: f32) -> *const Drawn {
    let whole = Drawn {
        columns: surface.columns as u32,
        rows: surface.rows as u32,
        positions: surface.positions.as_ptr(),
        normals: surface.normals.as_ptr(),
        version: surface.version,
        topology: surface.topology,
        caliper,
        ..Drawn::NONE
    };
    let record = mesh.map_or(whole, |mesh| Drawn {
        triangles: mesh.triangles.len() as u32,
        places: mesh.places.as_flattened().as_ptr(),
        corners: mesh.triangles.as_flattened().as_ptr(),
        parts: mesh.parts.as_ptr(),
        tears: if mesh.tears.is_empty() {
            core::ptr::null()
        } else {
            mesh.tears.as_flattened().as_ptr()
        },
        ..whole
    });
    // SAFETY: from one thread by the crate's contract, so that nothing else uses it.
    unsafe { DRAWN = record };
    (&raw const DRAWN).cast()
}
