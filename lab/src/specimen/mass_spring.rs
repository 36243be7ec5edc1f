//! The paper's masses and springs under experiment, by the preset `book`. They
//! have no clamp, only a spine that turns freely: here the second column of
//! nodes is held too, which is a clamp of the first order.

use turnleaf_engine::{MassSpring, Masses, Plate, Settings, TurnModel};

use super::piece::{Held, Piece, Specimen, swing_to_rest};

struct Springs {
    leaf: MassSpring,
}

/// A piece of masses and springs.
///
/// # Errors
/// Where it is held elsewhere than at the spine, weighs sideward, or its settings make no leaf, in
/// a sentence.
pub fn make(piece: &Piece) -> Result<Box<dyn Specimen>, String> {
    let Held::Clamp(angle) = piece.held else {
        return Err("Masses and springs are always held at the spine, and only there.".into());
    };
    if piece.gravity[0] != 0.0 || piece.gravity[1] != 0.0 {
        return Err("Masses and springs know no weight but downward.".into());
    }
    let sizes = [piece.length, piece.breadth, piece.grammage];
    let [width, height, grammage] = sizes.map(|size| size as f32);
    let mut settings = Settings::book(width, height, grammage);
    settings.columns = piece.columns.unwrap_or(settings.columns);
    settings.rows = piece.rows.unwrap_or(settings.rows);
    settings.plate = Plate {
        u: piece.stiffness as f32,
        v: piece.stiffness as f32,
        twist: (0.5 * (1.0 - piece.poisson) * piece.stiffness) as f32,
        loss: piece.loss.map_or(settings.plate.loss, |loss| loss as f32),
    };
    settings.floor = false;
    settings.time_step = piece
        .time_step
        .map_or(settings.time_step, |step| step as f32);
    if let Masses::ByArea { air, gravity, .. } = &mut settings.masses {
        *gravity = -piece.gravity[2] as f32;
        if !piece.air {
            (*air, settings.air_drag) = (0.0, 0.0);
        }
    }
    let grid = (settings.columns, settings.rows);
    let mut leaf = MassSpring::new(settings).map_err(|error| error.to_string())?;
    put(&mut leaf, &piece.straight(grid));
    let along = piece.length / (grid.0 - 1) as f64;
    for row in 0..grid.1 {
        let across = f64::from(leaf.position(0, row)[1]);
        let tangent = [along * angle.cos(), across, along * angle.sin()];
        leaf.hold(1, row, tangent.map(|x| x as f32));
    }
    Ok(Box::new(Springs { leaf }))
}

/// Puts the nodes at places, not moving.
fn put(leaf: &mut MassSpring, places: &[[f64; 3]]) {
    let positions: Vec<f32> = places.as_flattened().iter().map(|x| *x as f32).collect();
    leaf.write_nodes(&positions, &vec![0.0; positions.len()]);
}

impl Specimen for Springs {
    fn grid(&self) -> (usize, usize) {
        self.leaf.grid_size()
    }

    fn place(&self, column: usize, row: usize) -> [f64; 3] {
        self.leaf.position(column, row).map(f64::from)
    }

    fn load(&mut self, _: usize, _: usize, _: [f64; 3]) -> Result<(), String> {
        Err("Masses and springs bear no load but their weight.".into())
    }

    fn carry_end(&mut self, _: f64, _: f64, _: f64) -> Result<(), String> {
        Err("Masses and springs have no clamp at the far end.".into())
    }

    fn rest(&mut self) -> Result<(), String> {
        let length = f64::from(self.leaf.settings().width);
        swing_to_rest(self, length, |piece, places| put(&mut piece.leaf, places))
    }

    fn time_step(&self) -> f64 {
        f64::from(TurnModel::time_step(&self.leaf))
    }

    fn step(&mut self) {
        self.leaf.step();
    }

    fn edge_strain(&self) -> f64 {
        let strain = self.leaf.strain();
        f64::from(strain.max.abs().max(strain.min.abs()))
    }

    fn energy(&self) -> Option<f64> {
        Some(self.leaf.kinetic_energy() + self.leaf.potential_energy())
    }
}
