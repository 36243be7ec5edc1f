//! The interactive sheet under experiment: at its own nodes and step unless set
//! otherwise, and brought to rest by nothing but its own steps.

use turnleaf_engine::{Air, Root, Sheet, Stock, TurnModel};

use super::piece::{Held, Piece, Specimen, swing_to_rest};
use super::settings::Settings;

struct SheetPiece {
    sheet: Sheet,
    length: f64,
}

/// The stock of a piece.
pub fn stock(piece: &Piece) -> Stock {
    Stock {
        grammage: piece.grammage,
        stiffness_along: piece.stiffness,
        stiffness_across: piece.stiffness,
        poisson: piece.poisson,
        loss: piece.loss.unwrap_or(Stock::BOOK.loss),
        ..Stock::BOOK
    }
}

/// A piece of the sheet with such settings.
///
/// # Errors
/// Where its settings make no sheet, in a sentence.
pub fn make(piece: &Piece, settings: Settings) -> Result<Box<dyn Specimen>, String> {
    let mut settings = settings.sheet([piece.length, piece.breadth], stock(piece));
    settings.columns = piece.columns.unwrap_or(settings.columns);
    // As on a page cells are about square, and no more of them.
    let cells = piece.breadth / piece.length * (settings.columns - 1) as f64;
    let square = (cells.round() as usize + 1).clamp(4, settings.rows);
    settings.rows = piece.rows.unwrap_or(square);
    settings.gravity = piece.gravity;
    settings.time_step = piece.time_step.unwrap_or(settings.time_step);
    if !piece.air {
        settings.air = Air::NONE;
    }
    if let Held::TwoClamps(_) = piece.held {
        // The far clamp lies midway between the last two nodes, which it holds.
        let columns = settings.columns as f64;
        settings.width *= (columns - 1.0) / (columns - 1.5);
    }
    settings.root = match piece.held {
        Held::Nothing => Root::Free,
        Held::Clamp(_) | Held::TwoClamps(_) => Root::Clamped,
    };
    let long = Piece {
        length: settings.width,
        ..piece.clone()
    };
    let places = long.straight((settings.columns, settings.rows));
    let mut sheet = Sheet::new(settings).map_err(|error| error.to_string())?;
    put(&mut sheet, &places);
    if let Held::Clamp(angle) | Held::TwoClamps(angle) = piece.held {
        sheet.set_clamp_angle(angle as f32);
    }
    Ok(Box::new(SheetPiece {
        sheet,
        length: piece.length,
    }))
}

/// Puts the nodes at places, not moving.
fn put(sheet: &mut Sheet, places: &[[f64; 3]]) {
    let positions: Vec<f32> = places.as_flattened().iter().map(|x| *x as f32).collect();
    sheet.write_nodes(&positions, &vec![0.0; positions.len()]);
}

impl Specimen for SheetPiece {
    fn grid(&self) -> (usize, usize) {
        self.sheet.grid_size()
    }

    fn place(&self, column: usize, row: usize) -> [f64; 3] {
        let node = row * self.grid().0 + column;
        core::array::from_fn(|axis| f64::from(self.sheet.positions()[3 * node + axis]))
    }

    fn load(&mut self, column: usize, row: usize, force: [f64; 3]) -> Result<(), String> {
        let node = row * self.grid().0 + column;
        for axis in 0..3 {
            self.sheet.loads_mut()[3 * node + axis] = force[axis] as f32;
        }
        Ok(())
    }

    fn carry_end(&mut self, x: f64, z: f64, angle: f64) -> Result<(), String> {
        let (columns, rows) = self.grid();
        let settings = self.sheet.settings();
        let half = 0.5 * settings.width / (columns - 1) as f64;
        let apart = settings.height / (rows - 1) as f64;
        let (sin, cos) = angle.sin_cos();
        for row in 0..rows {
            for (column, along) in [(columns - 2, -half), (columns - 1, half)] {
                let place = [x + along * cos, row as f64 * apart, z + along * sin];
                let place = place.map(|x| x as f32);
                self.sheet.pin(column, row, Some(place));
            }
        }
        Ok(())
    }

    fn put(&mut self, places: &[[f64; 3]]) -> Result<(), String> {
        put(&mut self.sheet, places);
        Ok(())
    }

    fn rest(&mut self) -> Result<(), String> {
        let length = self.length;
        swing_to_rest(self, length, |piece, places| put(&mut piece.sheet, places))
    }

    fn time_step(&self) -> f64 {
        self.sheet.settings().time_step
    }

    fn step(&mut self) {
        self.sheet.step();
    }

    fn edge_strain(&self) -> f64 {
        f64::from(self.sheet.max_edge_strain())
    }

    fn energy(&self) -> Option<f64> {
        None
    }
}
