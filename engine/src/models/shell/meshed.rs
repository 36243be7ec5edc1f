//! The shell on a mesh of any flat cells: for shapes that no grid of rows and columns fits,
//! and for paper that is cut.
//!
//! Equilibria only. Stretch is that of edges, shear that between the middle lines of
//! four-sided cells, as on the grid; bending is by the hinges of triangles, over both
//! diagonals of a cell. Poisson's ratio is 0.

use core::cell::Cell;

use super::bending::Bending;
use super::cells::MeshSettings;
use super::clamp::Clamps;
use super::membrane::Membrane;
use super::newton::{Potential, minimise};
use super::settings::InvalidShell;
use super::system::System;
use super::triangles::TriangleBending;
use super::vector::{Vector, advance, along, difference, dot, furthest, scale};

/// Most Newton steps from one place to the next on the way to an equilibrium.
const NEWTON_STEPS: usize = 60;

/// Most of those places.
const ROUNDS: usize = 400;

/// Factors of the tether after a round that took few Newton steps, and after one that found
/// no minimum.
const LOOSER: f64 = 0.1;
const TIGHTER: f64 = 10.0;

/// No edge is clamped.
const FREE: Clamps = Clamps {
    spine: None,
    fore_edge: None,
};

/// A half-space that a node is kept in by a spring: the points x with
/// normal . x >= offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Unit normal, pointing to where the node may be.
    pub normal: [f64; 3],
    /// Metres.
    pub offset: f64,
    /// Stiffness of the spring, N/m: the node sinks in by its force over this.
    pub stiffness: f64,
}

impl HalfSpace {
    /// Force that pushes a node at a place back, N; 0 where it is inside.
    pub fn force(&self, place: [f64; 3]) -> f64 {
        self.stiffness * (self.offset - dot(self.normal, place)).max(0.0)
    }
}

/// Energies of a [`MeshShell`], J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshEnergies {
    /// Of bending and twist.
    pub bending: f64,
    /// Of stretch and shear.
    pub membrane: f64,
}

/// Paper on a mesh of flat cells.
#[derive(Clone, Debug)]
pub struct MeshShell {
    settings: MeshSettings,
    membrane: Membrane,
    bending: TriangleBending,
    held: Vec<bool>,
    x: Vec<Vector>,
    half_spaces: Vec<(usize, HalfSpace)>,
}

impl MeshShell {
    /// Paper that lies flat in the plane z = 0.
    ///
    /// # Errors
    /// Where a cell has not three or four nodes of the mesh counterclockwise, or a stiffness
    /// is not above 0, in a sentence.
    pub fn new(settings: MeshSettings) -> Result<Self, InvalidShell> {
        settings.check()?;
        let flat = settings.places.iter().map(|[u, v]| [*u, *v, 0.0]);
        Ok(Self {
            x: flat.collect(),
            held: vec![false; settings.places.len()],
            membrane: Membrane::of_cells(&settings),
            bending: TriangleBending::of_cells(&settings),
            half_spaces: Vec::new(),
            settings,
        })
    }

    /// A system for the nodes, those held or not.
    fn system(&self, held: Vec<bool>) -> System {
        System::coupling(held, self.bending.couplings())
    }

    /// Places of the nodes, m.
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.x
    }

    /// Moves every node to a place, m.
    ///
    /// # Panics
    /// If there are not as many places as nodes.
    pub fn place(&mut self, positions: &[[f64; 3]]) {
        self.x.copy_from_slice(positions);
    }

    /// Holds a node at a place, m, or lets it go again (None).
    ///
    /// # Panics
    /// If there is no such node.
    pub fn pin(&mut self, node: usize, place: Option<[f64; 3]>) {
        self.held[node] = place.is_some();
        if let Some(place) = place {
            self.x[node] = place;
        }
    }

    /// Keeps nodes in half-spaces, in place of those of before. A node may be in any number
    /// of them.
    ///
    /// # Panics
    /// If there is no such node.
    pub fn keep_in(&mut self, half_spaces: Vec<(usize, HalfSpace)>) {
        assert!(half_spaces.iter().all(|(node, _)| *node < self.x.len()));
        self.half_spaces = half_spaces;
    }

    /// Cuts an edge: from then on nothing is bent or held together over it. A node that the
    /// paper hangs together at no longer becomes two in one place, both held if it was.
    /// Returns the nodes that were doubled; their doubles are the last ones, in the same order.
    ///
    /// # Errors
    /// Where the edge is not between two cells, or neither of its ends is at the paper's edge
    /// or at the end of another cut, in a sentence.
    pub fn cut(&mut self, from: usize, to: usize) -> Result<Vec<usize>, InvalidShell> {
        let doubled = self.settings.cut(from, to)?;
        for node in &doubled {
            let double = self.x.len();
            self.x.push(self.x[*node]);
            self.held.push(self.held[*node]);
            let kept = self.half_spaces.iter().filter(|(kept, _)| kept == node);
            let copies: Vec<_> = kept.map(|(_, half_space)| (double, *half_space)).collect();
            self.half_spaces.extend(copies);
        }
        self.membrane = Membrane::of_cells(&self.settings);
        self.bending = TriangleBending::of_cells(&self.settings);
        Ok(doubled)
    }

    /// Force with which the paper pulls at each node, N: what holds a node bears it, and at
    /// a free one it is 0 in equilibrium.
    pub fn forces(&self) -> Vec<[f64; 3]> {
        let mut system = self.system(vec![false; self.x.len()]);
        self.membrane.add_to(&self.x, true, &mut system);
        self.bending.add_to(&self.x, &FREE, true, &mut system);
        let slopes = system.gradient().into_iter();
        slopes.map(|slope| scale(-1.0, slope)).collect()
    }

    /// Energies now.
    pub fn energy(&self) -> MeshEnergies {
        MeshEnergies {
            bending: self.bending.energy(&self.x, &FREE),
            membrane: self.membrane.energy(&self.x),
        }
    }

    /// Brings the paper to rest in an equilibrium downhill: minima of energy with a tether
    /// to where it was, which grows looser from minimum to minimum (the proximal point
    /// method), until no node moves further than `tolerance` metres in a round.
    ///
    /// # Errors
    /// Where no equilibrium is found, in a sentence. The paper is then where the search
    /// ended.
    pub fn settle(&mut self, tolerance: f64) -> Result<(), InvalidShell> {
        let mut system = self.system(self.held.clone());
        let mut tether = 1e-4 * self.settings.membrane;
        let loosest = 1e-6 * self.settings.bending / self.settings.area();
        for _ in 0..ROUNDS {
            let from = self.x.clone();
            let evaluations = Cell::new(0);
            let potential = Tethered {
                shell: self.parts(),
                from: &from,
                stiffness: tether,
                evaluations: &evaluations,
            };
            let mut x = from.clone();
            let accuracy = 0.1 * tolerance;
            let found = minimise(&potential, &mut x, &mut system, accuracy, NEWTON_STEPS);
            let way = furthest(&from, &x);
            self.x = x;
            if !found {
                tether *= TIGHTER;
            } else if way < tolerance && tether <= loosest {
                return Ok(());
            } else if evaluations.get() < 12 {
                tether = (LOOSER * tether).max(loosest);
            }
        }
        Err(InvalidShell("The paper found no equilibrium.".to_owned()))
    }

    fn parts(&self) -> Parts<'_> {
        Parts {
            membrane: &self.membrane,
            bending: &self.bending,
            half_spaces: &self.half_spaces,
        }
    }
}

/// What has a potential.
#[derive(Clone, Copy)]
struct Parts<'a> {
    membrane: &'a Membrane,
    bending: &'a TriangleBending,
    half_spaces: &'a [(usize, HalfSpace)],
}

/// The potential of the paper, and of springs from each node to where it was.
struct Tethered<'a> {
    shell: Parts<'a>,
    from: &'a [Vector],
    stiffness: f64,
    /// How many Hessians were formed.
    evaluations: &'a Cell<usize>,
}

impl Potential for Tethered<'_> {
    fn value(&self, x: &[Vector]) -> f64 {
        let Parts {
            membrane,
            bending,
            half_spaces,
        } = self.shell;
        let kept = half_spaces.iter().map(|(node, half_space)| {
            let force = half_space.force(x[*node]);
            0.5 * force * force / half_space.stiffness
        });
        let tethers = x.iter().zip(self.from).map(|(x, from)| {
            let way = difference(*x, *from);
            0.5 * self.stiffness * dot(way, way)
        });
        let elastic = membrane.energy(x) + bending.energy(x, &FREE);
        elastic + kept.sum::<f64>() + tethers.sum::<f64>()
    }

    fn add_to(&self, x: &[Vector], exact: bool, system: &mut System) {
        self.evaluations.set(self.evaluations.get() + 1);
        self.shell.membrane.add_to(x, exact, system);
        self.shell.bending.add_to(x, &FREE, exact, system);
        for (node, half_space) in self.shell.half_spaces {
            let force = half_space.force(x[*node]);
            if force > 0.0 {
                system.add_gradient(*node, scale(-force, half_space.normal));
                let block = along(0.0, half_space.stiffness, half_space.normal);
                system.add_block(*node, *node, block);
            }
        }
        for (node, (x, from)) in x.iter().zip(self.from).enumerate() {
            let way = advance(*x, -1.0, *from);
            system.add_gradient(node, scale(self.stiffness, way));
            system.add_scalar(node, node, self.stiffness);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Paper of 17 x 17 nodes, 1 m wide, whose inner nodes lie a little beside a grid: on cells
    /// that are no parallelograms bending is some hundredths off.
    fn uneven() -> MeshSettings {
        const N: usize = 17;
        let cell = 1.0 / (N - 1) as f64;
        let place = |node: usize| {
            let [column, row] = [node % N, node / N];
            let is_inside = |i: usize| i > 0 && i + 1 < N;
            let beside = if is_inside(column) && is_inside(row) {
                0.05 * cell * libm::sin(3.0 * row as f64)
            } else {
                0.0
            };
            [column as f64 * cell + beside, row as f64 * cell - beside]
        };
        let corner = |cell: usize| cell / (N - 1) * N + cell % (N - 1);
        let around = |foot: usize| vec![foot, foot + 1, foot + N + 1, foot + N];
        MeshSettings {
            places: (0..N * N).map(place).collect(),
            cells: (0..(N - 1) * (N - 1))
                .map(|cell| around(corner(cell)))
                .collect(),
            bending: 2.0,
            membrane: 1e6,
        }
    }

    #[test]
    fn rolled_paper_has_the_energy_of_its_curvature() {
        for (sin, cos) in [(0.0, 1.0), (1.0, 0.0), (0.6, 0.8)] {
            let mut shell = MeshShell::new(uneven()).unwrap();
            let radius = 3.0;
            let rolled: Vec<Vector> = uneven()
                .places
                .iter()
                .map(|[u, v]| {
                    let (along, across) = (v * cos - u * sin, u * cos + v * sin);
                    let (high, far) = (libm::sin(across / radius), libm::cos(across / radius));
                    [radius * high, along, radius * (1.0 - far)]
                })
                .collect();
            shell.place(&rolled);
            let energy = shell.energy();
            let exact = 0.5 * 2.0 / (radius * radius);
            // Free edges have no hinge, so half a cell there does not bend in full.
            assert!((energy.bending / exact - 1.0).abs() < 0.08, "{energy:?}");
            assert!(energy.membrane < 0.01 * energy.bending, "{energy:?}");
        }
    }

    #[test]
    fn a_bent_strip_comes_to_rest_where_a_half_space_keeps_its_end() {
        let mut shell = MeshShell::new(uneven()).unwrap();
        for row in 0..17 {
            for column in 0..2 {
                let node = 17 * row + column;
                let [u, v] = uneven().places[node];
                shell.pin(node, Some([u, v, 0.0]));
            }
        }
        let up = |node| {
            let half_space = HalfSpace {
                normal: [0.0, 0.0, 1.0],
                offset: 0.1,
                stiffness: 1e6,
            };
            (node, half_space)
        };
        shell.keep_in((0..17).map(|row| up(17 * row + 16)).collect());
        shell.settle(1e-7).unwrap();
        let lifted = shell.positions()[16][2];
        assert!((lifted - 0.1).abs() < 1e-4, "{lifted}");
        // A cantilever of unit width from the second column on, 3 D w^2 / (2 L^3).
        let beam = 1.5 * 2.0 * 0.01 / (15.0f64 / 16.0).powi(3);
        let energy = shell.energy();
        let part = (energy.bending + energy.membrane) / beam;
        assert!((0.85..1.1).contains(&part), "{part}");
    }

    /// Forces by differences of energy, on paper that is bent and strained.
    #[test]
    fn forces_are_the_slopes_of_energy() {
        let mut shell = MeshShell::new(uneven()).unwrap();
        shell.cut(8, 8 + 17).unwrap();
        let rippled = shell.positions().iter().map(|[u, v, _]| {
            let high = 0.1 * libm::sin(5.0 * u + 3.0 * v);
            [1.001 * u, *v, high]
        });
        let places: Vec<Vector> = rippled.collect();
        shell.place(&places);
        let forces = shell.forces();
        for (node, axis) in [(8, 0), (8 + 17, 2), (17 * 17, 1), (100, 2)] {
            let at = |by: f64| {
                let mut moved = places.clone();
                moved[node][axis] += by;
                let mut shell = shell.clone();
                shell.place(&moved);
                let energy = shell.energy();
                energy.bending + energy.membrane
            };
            let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
            let error = (forces[node][axis] + slope).abs() / slope.abs();
            assert!(error < 1e-5, "{node} {axis}: {error}");
        }
    }

    #[test]
    fn paper_that_is_cut_through_comes_apart() {
        let mut shell = MeshShell::new(uneven()).unwrap();
        let up = HalfSpace {
            normal: [0.0, 0.0, 1.0],
            offset: 0.0,
            stiffness: 1.0,
        };
        shell.keep_in(vec![(8, up)]);
        shell.pin(8, Some([0.5, 0.0, 0.0]));
        let mut doubled = Vec::new();
        for row in 0..16 {
            doubled.extend(shell.cut(17 * row + 8, 17 * row + 25).unwrap());
        }
        let column: Vec<usize> = (0..17).map(|row| 17 * row + 8).collect();
        assert_eq!(doubled, column);
        assert_eq!(shell.positions().len(), 17 * 18);
        assert!(shell.held[17 * 17] && !shell.held[17 * 17 + 1]);
        assert_eq!(shell.half_spaces, [(8, up), (17 * 17, up)]);
        // The doubles belong to what is on the left of the way up.
        let mut places = shell.positions().to_vec();
        for (node, place) in places.iter_mut().enumerate() {
            if node >= 17 * 17 || node % 17 < 8 {
                place[2] += 1.0;
            }
        }
        shell.place(&places);
        let energy = shell.energy();
        assert!(energy.bending + energy.membrane < 1e-20, "{energy:?}");
    }

    #[test]
    fn a_cut_begins_at_an_edge_or_a_cut() {
        let mut shell = MeshShell::new(uneven()).unwrap();
        let error = |shell: &mut MeshShell, from, to| shell.cut(from, to).unwrap_err().to_string();
        assert!(error(&mut shell, 25, 42).contains("at the paper's edge"));
        for (from, to) in [(0, 1), (0, 18), (0, 400), (5, 5)] {
            assert!(error(&mut shell, from, to).contains("between two cells"));
        }
        assert_eq!(shell.cut(8, 25), Ok(vec![8]));
        assert_eq!(shell.cut(25, 26), Ok(vec![25]));
    }

    #[test]
    fn a_cell_of_the_wrong_turn_is_rejected() {
        let mut settings = uneven();
        settings.cells[3].reverse();
        assert!(MeshShell::new(settings).is_err());
    }
}
