//! The offline shell under experiment: 65 columns of nodes unless set otherwise,
//! its equilibria solved for and not waited for.

use turnleaf_engine::{Air, Edge, Rigidity, Scheme, Shell, ShellSettings, Stock, TurnModel};

use super::piece::{Held, Piece, Specimen};

/// Columns of nodes.
const COLUMNS: usize = 65;

/// Rows of nodes.
const ROWS: usize = 9;

/// How far a node may still move in the last step to an equilibrium, m.
const TOLERANCE: f64 = 1e-10;

struct ShellPiece {
    shell: Shell,
}

/// A piece of the shell.
///
/// # Errors
/// Where its settings make no shell, in a sentence.
pub fn make(piece: &Piece) -> Result<Box<dyn Specimen>, String> {
    let leaf = ShellSettings::leaf(
        &Stock::BOOK,
        Default::default(),
        piece.length,
        piece.breadth,
    );
    let clamp = |angle| Edge::Clamped { angle };
    let undamped = piece.loss == Some(0.0) && !piece.air;
    let mut settings = ShellSettings {
        columns: piece.columns.unwrap_or(COLUMNS),
        rows: piece.rows.unwrap_or(ROWS),
        rigidity: Rigidity::isotropic(piece.stiffness, piece.poisson),
        areal_mass: piece.grammage,
        gravity: piece.gravity,
        spine: match piece.held {
            Held::Clamp(angle) | Held::TwoClamps(angle) => clamp(angle),
            Held::Nothing => Edge::Free,
        },
        fore_edge: match piece.held {
            Held::TwoClamps(angle) => clamp(angle),
            Held::Clamp(_) | Held::Nothing => Edge::Free,
        },
        loss: piece.loss.unwrap_or(leaf.loss),
        // What is undamped keeps its energy by the one scheme that does.
        scheme: if undamped {
            Scheme::ImplicitMidpoint
        } else {
            leaf.scheme
        },
        ..leaf
    };
    settings.time_step = piece.time_step.unwrap_or(settings.time_step);
    if !piece.air {
        settings.air = Air::NONE;
    }
    let places = piece.straight((settings.columns, settings.rows));
    let mut shell = Shell::new(settings).map_err(|error| error.to_string())?;
    let still = vec![0.0; 3 * places.len()];
    shell.write_nodes(places.as_flattened(), &still);
    Ok(Box::new(ShellPiece { shell }))
}

impl Specimen for ShellPiece {
    fn grid(&self) -> (usize, usize) {
        self.shell.grid_size()
    }

    fn place(&self, column: usize, row: usize) -> [f64; 3] {
        let node = row * self.grid().0 + column;
        self.shell.positions().as_chunks().0[node]
    }

    fn load(&mut self, column: usize, row: usize, force: [f64; 3]) -> Result<(), String> {
        let node = row * self.grid().0 + column;
        self.shell.loads_mut()[3 * node..3 * node + 3].copy_from_slice(&force);
        Ok(())
    }

    fn carry_end(&mut self, x: f64, z: f64, angle: f64) -> Result<(), String> {
        self.shell.hold_fore_edge(x, z, angle);
        Ok(())
    }

    fn rest(&mut self) -> Result<(), String> {
        self.shell
            .settle(TOLERANCE)
            .map_err(|error| error.to_string())
    }

    fn time_step(&self) -> f64 {
        self.shell.settings().time_step
    }

    fn step(&mut self) {
        self.shell.step();
    }

    fn edge_strain(&self) -> f64 {
        self.shell.max_edge_strain()
    }

    fn energy(&self) -> Option<f64> {
        Some(self.shell.energy().total())
    }

    fn frequencies(&mut self, count: usize) -> Option<Vec<f64>> {
        self.shell.frequencies(count)
    }

    fn is_stable(&mut self) -> Option<bool> {
        Some(self.shell.is_stable())
    }
}
