//! A sheet laid folded: turned about its creases, its parts upon each other.

use super::Sheet;
use super::crease::SheetCrease;
use super::material::{Material, cut};
use super::sweep::TOLERANCE;
use crate::grid::Side;
use core::f64::consts::PI;

/// Part of its weight and of its stiffness that is left to paper that is carried by other paper.
const CARRIED: f32 = 0.02;

impl Sheet {
    /// Lays the sheet still on a side, nothing holding it, turned about each crease to the
    /// angle at which that rests: what lies beyond a crease as seen from the spine turns. Where
    /// parts of it would lie under the table, the sheet is raised about the spine until none
    /// do. Creases that cross each other are turned one after the other, as if they did not.
    pub fn lay_folded(&mut self, side: Side) {
        self.turn_about(side, &self.creases(), true);
        self.expect_rests();
    }

    /// Lays the sheet still on a side as it lies under others, pressed flat: creases that rest
    /// beyond a right angle are shut, but for those that no paper could be with others that it
    /// crosses, or that would have a part lie below the rest and reach to the spine, and others flat. `heights` say how high each node lies, the
    /// sheet's recto up, metres. Those at the spine stay on the table. Returns the angle at which
    /// each crease then is, radians as [`SheetCrease::rest`].
    pub fn lay_pressed(&mut self, side: Side, heights: &[f32]) -> Vec<f32> {
        let rests = self.creases();
        let flat = |crease: &SheetCrease| SheetCrease {
            rest: 0.0,
            ..*crease
        };
        let mut creases: Vec<SheetCrease> = rests.iter().map(flat).collect();
        for (crease, SheetCrease { rest, .. }) in rests.iter().enumerate() {
            if rest.abs() > 0.5 * PI {
                creases[crease].rest = PI.copysign(*rest);
                self.turn_about(side, &creases, false);
                if self.max_edge_strain() > TOLERANCE {
                    creases[crease].rest = 0.0;
                }
            }
        }
        self.turn_about(side, &creases, false);
        // Only once all are shut is it known what reaches where.
        for crease in 0..creases.len() {
            if !self.reaches_spine_below(side, heights) {
                break;
            }
            let shut = core::mem::replace(&mut creases[crease].rest, 0.0);
            self.turn_about(side, &creases, false);
            if self.reaches_spine_below(side, heights) || self.max_edge_strain() > TOLERANCE {
                creases[crease].rest = shut;
                self.turn_about(side, &creases, false);
            }
        }
        let columns = self.settings.columns;
        let highest = heights
            .iter()
            .fold(0.0f32, |most, height| most.max(*height));
        let nodes = self.positions.chunks_exact_mut(3).zip(heights);
        for (_, (own, height)) in nodes.enumerate().filter(|(node, _)| node % columns > 0) {
            // The sheet's recto faces down on the left.
            own[2] = match side {
                Side::Right => *height,
                Side::Left => highest - height,
            };
        }
        // Between parts at different heights edges are longer than they were on the flat.
        self.restore_lengths();
        self.expect_rests();
        creases.iter().map(|crease| crease.rest as f32).collect()
    }

    /// Where its nodes and its drawn points lie in the plane of the flat sheet, metres, with creases
    /// of a set of bits shut and the others flat. None of a sheet that is not creased.
    pub(crate) fn folded_flat(&self, shut: u16) -> Option<[Vec<[f32; 2]>; 2]> {
        let creased = self.creased()?;
        let drawn = &creased.patches.as_ref()?.drawn;
        let lines = creased.lines.iter().enumerate();
        let lines: Vec<SheetCrease> = lines
            .map(|(crease, line)| SheetCrease {
                rest: if shut >> crease & 1 == 1 { PI } else { 0.0 },
                ..*line
            })
            .collect();
        Some([&self.material, drawn].map(|material| {
            let places = fold_flat(material, &lines).into_iter();
            places.map(|[x, y, _]| [x as f32, y as f32]).collect()
        }))
    }

    /// Has the part next to the spine weigh and bend as all that lies upon it while creases of a set
    /// of bits are shut, and that hardly at all: it goes where the part next to the spine goes.
    /// `carried` are the nodes there, each with the nodes and the weights by which it is carried.
    pub(crate) fn stack(
        &mut self,
        shut: u16,
        carried: impl Iterator<Item = (usize, [usize; 3], [f32; 3])>,
    ) {
        for (node, by, weights) in carried {
            let mass = (1.0 - CARRIED) * self.mass[node];
            self.mass[node] -= mass;
            for (by, weight) in by.into_iter().zip(weights) {
                self.mass[by] += weight * mass;
            }
            (self.air_mass[node], self.drag_mass[node]) = (0.0, 0.0);
            self.sweep.lighten(node, 1.0 / CARRIED);
        }
        self.weigh_masses();
        let material = &self.material;
        if let Some(creased) = self.creased.as_mut() {
            let layers = layers(material, &creased.lines, shut);
            creased.hinges.stiffen(|corners| match layers(corners) {
                0 => CARRIED,
                layers => layers as f32,
            });
        }
    }

    /// Has each part weigh and bend by itself again.
    pub(crate) fn unstack(&mut self) {
        self.weigh();
        for node in 0..self.mass.len() {
            self.sweep.release(&self.settings, &self.material, node);
        }
        if let Some(creased) = self.creased.as_mut() {
            creased.hinges.relieve();
        }
    }

    /// Whether some of it that lies below what is next to the spine, as `heights` say with the
    /// recto up, reaches beyond the spine or as near to it as the leaf is high: there it has no room.
    fn reaches_spine_below(&self, side: Side, heights: &[f32]) -> bool {
        let (columns, sign) = (self.settings.columns, side.sign());
        let highest = heights
            .iter()
            .fold(0.0f32, |most, height| most.max(*height));
        let nodes = self.positions.as_chunks::<3>().0.iter().zip(heights);
        nodes.enumerate().any(|(node, ([x, ..], height))| {
            let beside_spine = heights[node - node % columns + 1];
            node % columns > 1 && sign * x < highest && sign * (height - beside_spine) < 0.0
        })
    }

    /// Lays the sheet still on a side, turned about each crease to the angle of the crease, and raised
    /// about the spine or not until no part lies under the table.
    fn turn_about(&mut self, side: Side, creases: &[SheetCrease], is_raised: bool) {
        self.lay_flat(side);
        if !self.is_creased() {
            return;
        }
        let mut places = fold_flat(&self.material, creases);
        let sign = f64::from(side.sign());
        // The sheet's recto faces down on the left.
        for [_, _, z] in &mut places {
            *z *= sign;
        }
        let sunken = places.iter().filter(|[_, _, z]| is_raised && *z < 0.0);
        let raised = sunken.fold(0.0, |most: f64, [x, _, z]| {
            most.max(libm::atan2(-z, x.max(0.0)))
        });
        let (sin, cos) = libm::sincos(raised);
        for (own, [x, y, z]) in self.positions.chunks_exact_mut(3).zip(places) {
            let raised = [sign * (x * cos - z * sin), y, x * sin + z * cos];
            own.copy_from_slice(&raised.map(|x| x as f32));
        }
    }

    /// As [`place`](Self::place), for one that is folded there as its creases rest.
    pub(crate) fn place_folded(&mut self, positions: impl Iterator<Item = f32>) {
        self.place(positions);
        self.expect_rests();
    }

    /// Takes the creases' angles for those next to their rests: whole turns more look the same.
    fn expect_rests(&mut self) {
        let (positions, tangents) = (&self.positions, &self.tangents);
        if let Some(creased) = self.creased.as_mut() {
            creased.hinges.expect_rests();
            creased.hinges.settle(positions, tangents, 0.0);
        }
    }
}

/// Where a sheet's nodes are that lies flat on the right but for its creases, each turned to
/// its rest angle, metres. Of two creases the one that lies beyond the other turns first.
fn fold_flat(material: &Material, creases: &[SheetCrease]) -> Vec<[f64; 3]> {
    let mut turns = turns(material, creases);
    turns.sort_by_key(|turn| turn.beyond);
    let places = material.places.iter().map(|place| {
        let mut at = [place[0], place[1], 0.0];
        for turn in turns.iter().filter(|turn| turn.reach(*place) > 0.0) {
            let [cos, sin] = turn.rest;
            let far = turn.reach([at[0], at[1]]);
            let out = far * cos - at[2] * sin - far;
            at[2] = far * sin + at[2] * cos;
            for axis in 0..2 {
                at[axis] += out * turn.outward[axis];
            }
        }
        at
    });
    places.collect()
}

/// How many layers lie at a triangle of a creased material whose creases of a set of bits are shut,
/// it among them; 0 where it lies upon another.
fn layers<'a>(
    material: &'a Material,
    creases: &[SheetCrease],
    shut: u16,
) -> impl Fn([usize; 3]) -> usize + 'a {
    let rest = |crease: usize| if shut >> crease & 1 == 1 { PI } else { 0.0 };
    let lines = creases.iter().enumerate();
    let lines: Vec<SheetCrease> = lines
        .map(|(crease, line)| SheetCrease {
            rest: rest(crease),
            ..*line
        })
        .collect();
    let places = fold_flat(material, &lines);
    let turns = turns(material, &lines);
    let over = triangles(material, &lines).into_iter();
    let over: Vec<[[f64; 3]; 3]> = over
        .filter(|(_, part)| part & shut != 0)
        .map(|(corners, _)| corners.map(|corner| places[corner]))
        .collect();
    move |corners| {
        let of = corners.map(|corner| material.places[corner]);
        let middle = [0, 1].map(|axis| (of[0][axis] + of[1][axis] + of[2][axis]) / 3.0);
        let mut beyond = turns.iter().filter(|turn| turn.reach(middle) > 0.0);
        if beyond.any(|turn| shut >> turn.crease & 1 == 1) {
            return 0;
        }
        let covers = |corners: &&[[f64; 3]; 3]| {
            let [a, b, c] = [0, 1, 2].map(|k| {
                let [from, to] = [corners[k], corners[(k + 1) % 3]];
                (to[0] - from[0]) * (middle[1] - from[1])
                    > (to[1] - from[1]) * (middle[0] - from[0])
            });
            a == b && b == c
        };
        1 + over.iter().filter(covers).count()
    }
}

/// The triangles of a creased material, each with the creases that it lies beyond.
pub(super) fn triangles(material: &Material, creases: &[SheetCrease]) -> Vec<([usize; 3], u16)> {
    let turns = turns(material, creases);
    let triangles = material.cells().flat_map(|foot| cut(material, foot, true));
    let parts = triangles.map(|corners| {
        let of = corners.map(|corner| material.places[corner]);
        let middle = [0, 1].map(|axis| (of[0][axis] + of[1][axis] + of[2][axis]) / 3.0);
        let beyond = turns.iter().filter(|turn| turn.reach(middle) > 0.0);
        let part = beyond.fold(0, |part, turn| part | 1 << turn.crease);
        (corners, part)
    });
    parts.collect()
}

/// How the parts of a sheet beyond creases turn about them.
pub(super) fn turns(material: &Material, creases: &[SheetCrease]) -> Vec<Turn> {
    let creases = creases.iter().enumerate();
    let turns = creases.filter_map(|(number, crease)| Turn::of(material, number, crease));
    turns.collect()
}

/// How the part of a sheet beyond a crease turns about it.
pub(super) struct Turn {
    /// Number of the crease.
    pub crease: usize,
    /// A place on the crease, metres, and the direction across it away from the spine.
    from: [f64; 2],
    outward: [f64; 2],
    /// Cosine and sine of its rest angle.
    rest: [f64; 2],
    /// How many nodes lie beyond it.
    beyond: usize,
}

impl Turn {
    fn of(material: &Material, number: usize, crease: &SheetCrease) -> Option<Turn> {
        let line = material.line(crease)?;
        let [along, up] = [line.to[0] - line.from[0], line.to[1] - line.from[1]];
        let length = libm::hypot(along, up);
        let mut turn = Turn {
            crease: number,
            from: line.from,
            outward: [up / length, -along / length],
            rest: [libm::cos(crease.rest), libm::sin(crease.rest)],
            beyond: 0,
        };
        // Away from the middle of the spine.
        if turn.reach([0.0, 0.5 * material.size[1]]) > 0.0 {
            turn.outward = turn.outward.map(|x| -x);
        }
        let beyond = material
            .places
            .iter()
            .filter(|place| turn.reach(**place) > 0.0);
        turn.beyond = beyond.count();
        Some(turn)
    }

    /// Distance of a place from the crease, away from the spine, metres.
    pub fn reach(&self, place: [f64; 2]) -> f64 {
        (place[0] - self.from[0]) * self.outward[0] + (place[1] - self.from[1]) * self.outward[1]
    }
}
