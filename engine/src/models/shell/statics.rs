//! Equilibria, whether they are stable, and small vibrations about them.

use super::newton::{Potential, minimise};
use super::vector::{Vector, advance, dot, furthest, scale};
use super::{InvalidShell, Shell};

/// Most Newton steps to an equilibrium, at each softness.
const NEWTON_STEPS: usize = 400;

/// Stiffness in stretch over that in bending of a cell with which a search for an
/// equilibrium begins.
const SOFT: f64 = 30.0;

/// Factor by which the leaf then stiffens.
const STIFFEN: f64 = 20.0;

/// Most rounds of inverse iteration for a mode, and of turning a hand's pad.
const ROUNDS: usize = 500;

/// A mode of vibration.
struct Mode {
    shape: Vec<Vector>,
    /// Mass times shape, node by node.
    momentum: Vec<Vector>,
    /// Square of its angular frequency.
    square: f64,
}

impl Shell {
    /// Brings the leaf to rest in the equilibrium next downhill, without air and
    /// friction: Newton's method, first on a leaf soft in stretch, which can
    /// swing far without straining, then on stiffer ones up to its own.
    /// `tolerance` is how far a node may still move in a Newton step, m.
    ///
    /// # Errors
    /// Where no equilibrium is found, in a sentence. The leaf is then where the
    /// search ended.
    pub fn settle(&mut self, tolerance: f64) -> Result<(), InvalidShell> {
        self.v.fill([0.0; 3]);
        self.before = None;
        let (mesh, settings) = (&self.mesh, &self.settings);
        let cell = mesh.du.max(mesh.dv);
        let mut softness = SOFT * settings.rigidity.d11 / (cell * cell) / settings.membrane;
        while softness < 1.0 {
            self.relax(softness, tolerance);
            softness *= STIFFEN;
        }
        // The pad of a hand lies as the leaf under it did before each round.
        for _ in 0..ROUNDS {
            let before = self.x.clone();
            if !self.relax(1.0, tolerance) {
                break;
            }
            if self.forces.hand.is_none() || furthest(&before, &self.x) < tolerance {
                return Ok(());
            }
        }
        Err(InvalidShell(
            "The leaf found no equilibrium: something must hold it.".to_owned(),
        ))
    }

    /// One search at a softness in stretch. Returns whether it ended.
    fn relax(&mut self, softness: f64, tolerance: f64) -> bool {
        if let Some(hand) = &mut self.forces.hand {
            hand.follow(&self.mesh, &self.x);
        }
        self.forces.membrane.softness = softness;
        let (forces, system) = (&self.forces, &mut self.system);
        let found = minimise(forces, &mut self.x, system, tolerance, NEWTON_STEPS);
        self.forces.membrane.softness = 1.0;
        found
    }

    /// Whether the present places are a stable equilibrium, if they are one:
    /// whether the exact second derivative of energy is positive definite.
    pub fn is_stable(&mut self) -> bool {
        self.system.clear();
        self.forces.add_to(&self.x, true, &mut self.system);
        self.system.factorise()
    }

    /// The lowest angular frequencies of small vibrations about the present
    /// equilibrium, rad/s, rising, with the air's added mass and without its
    /// drag: inverse iteration, each mode kept apart from those before. None
    /// where the equilibrium is not stable.
    pub fn frequencies(&mut self, count: usize) -> Option<Vec<f64>> {
        if !self.is_stable() {
            return None;
        }
        let normals = self.mesh.normals(&self.x);
        let mut modes: Vec<Mode> = Vec::new();
        for number in 0..count {
            let guess = self.first_guess(number, &normals);
            modes.push(self.mode_beside(&modes, guess, &normals));
        }
        Some(modes.iter().map(|mode| mode.square.sqrt()).collect())
    }

    /// The lowest mode that has no part in the others, of the factorised Hessian.
    fn mode_beside(&self, others: &[Mode], guess: Vec<Vector>, normals: &[Vector]) -> Mode {
        let mut mode = self.mode_of(guess, normals);
        for _ in 0..ROUNDS {
            let mut shape = self.system.solve(&mode.momentum);
            for other in others {
                let part = product(&shape, &other.momentum);
                for (s, o) in shape.iter_mut().zip(&other.shape) {
                    *s = advance(*s, -part, *o);
                }
            }
            let square = 1.0 / product(&shape, &mode.momentum);
            let settled = (square - mode.square).abs() < 1e-12 * square;
            mode = Mode {
                square,
                ..self.mode_of(shape, normals)
            };
            if settled {
                break;
            }
        }
        mode
    }

    /// A shape at the size at which it and its momentum have the product 1.
    fn mode_of(&self, mut shape: Vec<Vector>, normals: &[Vector]) -> Mode {
        let of = |(node, shape): (usize, &Vector)| {
            let carried = self.settings.air.added_mass * self.areas[node];
            let across = carried * dot(*shape, normals[node]);
            advance(
                scale(self.forces.masses[node], *shape),
                across,
                normals[node],
            )
        };
        let mut momentum: Vec<Vector> = shape.iter().enumerate().map(of).collect();
        let size = 1.0 / product(&shape, &momentum).sqrt();
        for vector in shape.iter_mut().chain(&mut momentum) {
            *vector = scale(size, *vector);
        }
        Mode {
            shape,
            momentum,
            square: 0.0,
        }
    }

    /// A shape in which any mode may have a part.
    fn first_guess(&self, mode: usize, normals: &[Vector]) -> Vec<Vector> {
        let bent = |(node, (column, row)): (usize, (usize, usize))| {
            let u = column as f64 / (self.mesh.columns - 1) as f64;
            let v = row as f64 / (self.mesh.rows - 1) as f64;
            let ripple = libm::cos(core::f64::consts::PI * mode as f64 * u);
            scale(u * (ripple + 0.3 * v), normals[node])
        };
        let mut guess: Vec<Vector> = self.mesh.places().enumerate().map(bent).collect();
        for (shape, held) in guess.iter_mut().zip(&self.system.held) {
            if *held {
                *shape = [0.0; 3];
            }
        }
        guess
    }
}

fn product(a: &[Vector], b: &[Vector]) -> f64 {
    a.iter().zip(b).map(|(a, b)| dot(*a, *b)).sum()
}
