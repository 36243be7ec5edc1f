//! What a picture shows.

use turnleaf_engine::{MassSpring, Sheet, Surface, TurnModel};

/// One moment of the turn, in units of the leaf's width.
pub struct Moment {
    /// Seconds since the start.
    pub time: f32,
    /// Columns and rows of masses, and their positions.
    pub grid: (usize, usize),
    /// x, y, z of each mass.
    pub masses: Vec<[f32; 3]>,
    /// Columns and rows of the mesh.
    pub mesh: (usize, usize),
    /// x, y, z of each point.
    pub points: Vec<[f32; 3]>,
    /// Unit normal of each point.
    pub normals: Vec<[f32; 3]>,
    /// The points of each triangle where the mesh is drawn as triangles; none where as cells.
    pub triangles: Vec<[usize; 3]>,
}

impl Moment {
    /// A leaf of the paper's model as it is now.
    pub fn of(leaf: &mut MassSpring) -> Self {
        let width = leaf.settings().width;
        Self::of_width(leaf, width)
    }

    /// A sheet as it is now, without its nodes.
    pub fn of_sheet(sheet: &mut Sheet) -> Self {
        let width = sheet.settings().width as f32;
        let triangles = sheet
            .paper_mesh()
            .map_or_else(Vec::new, |mesh| mesh.triangles);
        Self {
            grid: (0, 0),
            masses: Vec::new(),
            triangles: triangles
                .iter()
                .map(|corners| corners.map(|corner| corner as usize))
                .collect(),
            ..Self::of_width(sheet, width)
        }
    }

    fn of_width(leaf: &mut impl TurnModel, width: f32) -> Self {
        let scale = 1.0 / width;
        let mut surface = Surface::new(2, 2);
        leaf.write_surface(&mut surface);
        surface.update_normals();
        let (columns, rows) = leaf.grid_size();
        let mut masses = vec![0.0; 3 * columns * rows];
        let mut velocities = masses.clone();
        leaf.read_nodes(&mut masses, &mut velocities);
        let points = |flat: &[f32], scale: f32| {
            let (points, _) = flat.as_chunks::<3>();
            points
                .iter()
                .map(|point| point.map(|value| value * scale))
                .collect()
        };
        Self {
            time: leaf.time(),
            grid: (columns, rows),
            masses: points(&masses, scale),
            mesh: (surface.columns, surface.rows),
            points: points(&surface.positions, scale),
            normals: points(&surface.normals, 1.0),
            triangles: Vec::new(),
        }
    }
}
