//! Grabs on a sheet: several at once, none of which can tear it but those that pull
//! [firmly](super::Sheet::grab_firmly).
//!
//! A grab's target is followed at a bounded speed, and only to where the paper
//! reaches: no farther from the ends of the spine, nor from another grab, than
//! the same points are on the flat leaf.

use super::material::Material;
use super::settings::{Root, SheetSettings};
use super::system::System;
use crate::grab::{Pressed, bounded_stiffness, pad_over, stiffness_for, strongest};

/// Greatest speed of a held place, m/s.
const FASTEST: f32 = 3.0;

/// Part of what paper reaches that a grab may use: pulled quite taut, the last
/// of a leaf's curl would come out by force.
const REACH: f32 = 0.995;

/// Part of its greatest speed with which a grab begins, that it keeps when it
/// gives way, the least of it, and how much of it comes back in a second.
const FIRST: f32 = 0.1;
const HESITATION: f32 = 0.3;
const SLOWEST: f32 = 0.02;
const RECOVERY: f32 = 6.0;

/// A grab that holds a sheet.
#[derive(Clone, Debug)]
pub(super) struct Grab {
    /// The number by which it is commanded.
    pub id: u32,
    /// Place on the flat leaf, metres along u and v.
    place: [f32; 2],
    pad: Vec<Pressed<f32>>,
    /// Where the grab wants the place to be, and where it has come.
    wanted: [f32; 3],
    target: [f32; 3],
    /// Its stiffness, N/m, and its greatest force, N.
    stiffness: f32,
    strength: f32,
    /// Part of the greatest speed at which it goes on.
    pace: f32,
    /// Tangents along u and v at the place, of about unit length.
    frame: [[f32; 3]; 2],
}

impl Grab {
    /// A grab at (`u`, `v`), each 0 to 1 or the nearer of these, of a sheet whose nodes are at
    /// `positions` (x, y, z of each, metres), pulling to where it holds.
    pub fn new(
        id: u32,
        [u, v]: [f32; 2],
        settings: &SheetSettings,
        material: &Material,
        positions: &[f32],
    ) -> Grab {
        let size = material.paper(settings);
        let (u, v) = (u.clamp(0.0, 1.0), v.clamp(0.0, 1.0));
        let grid = (settings.columns, settings.rows);
        let strength =
            settings.grab_strength * strongest(settings.stock.grammage, size[0] * size[1]);
        let mut grab = Grab {
            id,
            place: [u * size[0] as f32, v * size[1] as f32],
            pad: pad_over(
                (f64::from(u), f64::from(v)),
                grid,
                [size, settings.cell()],
                |node| material.places[node],
            ),
            wanted: [0.0; 3],
            target: [0.0; 3],
            stiffness: stiffness_for(strength) as f32,
            strength: strength as f32,
            pace: FIRST,
            frame: [[0.0; 3]; 2],
        };
        grab.tilt(positions);
        grab.target = grab.held_place(positions);
        grab.wanted = grab.target;
        grab
    }

    /// Goes on at its full speed.
    pub fn hasten(&mut self) {
        self.pace = 1.0;
    }

    /// The same grab with another stiffness, N/m, and greatest force, N.
    pub fn pulling(self, stiffness: f32, strength: f32) -> Grab {
        Grab {
            stiffness,
            strength,
            ..self
        }
    }

    /// Takes hold anew of the same place, where the nodes lie otherwise on the sheet.
    pub fn take_anew(&mut self, settings: &SheetSettings, material: &Material, positions: &[f32]) {
        let size = material.paper(settings).map(|side| side as f32);
        let at = [0, 1].map(|axis| self.place[axis] / size[axis]);
        let pulled = (self.wanted, self.target, self.pace);
        let new = Grab::new(self.id, at, settings, material, positions);
        *self = Grab {
            stiffness: self.stiffness,
            strength: self.strength,
            ..new
        };
        (self.wanted, self.target, self.pace) = pulled;
    }

    /// The place that it holds on the flat leaf, metres along u and v.
    pub fn place(&self) -> [f64; 2] {
        self.place.map(f64::from)
    }

    /// Pulls toward a place, metres; one that is no number is ignored.
    pub fn pull(&mut self, to: [f32; 3]) {
        if to.iter().all(|x| x.is_finite()) {
            self.wanted = to.map(|x| x.clamp(-1e3, 1e3));
        }
    }

    /// Paper that lies in its way does not let the grab through: it goes on from
    /// where the leaf is, slower.
    pub fn give_way(&mut self, positions: &[f32]) {
        self.target = self.held_place(positions);
        self.pace = (self.pace * HESITATION).max(SLOWEST);
    }

    /// Where the pad's middle is on the leaf, metres, whose nodes are at `positions`.
    pub fn held_place(&self, positions: &[f32]) -> [f32; 3] {
        let x = positions.as_chunks::<3>().0;
        let mut sum = [0.0; 3];
        for spot in &self.pad {
            let offset = self.offset(spot);
            for axis in 0..3 {
                sum[axis] += spot.weight * (x[spot.node][axis] - offset[axis]);
            }
        }
        sum
    }

    fn offset(&self, spot: &Pressed<f32>) -> [f32; 3] {
        let [u, v] = self.frame;
        core::array::from_fn(|axis| spot.apart[0] * u[axis] + spot.apart[1] * v[axis])
    }

    /// Finds the tangents under the pad: the linear map that takes its places on
    /// the flat leaf to where its nodes are, by least squares.
    fn tilt(&mut self, positions: &[f32]) {
        let x = positions.as_chunks::<3>().0;
        let (mut mean, mut apart) = ([0.0f32; 3], [0.0f32; 2]);
        for spot in &self.pad {
            for axis in 0..3 {
                mean[axis] += spot.weight * x[spot.node][axis];
            }
            apart[0] += spot.weight * spot.apart[0];
            apart[1] += spot.weight * spot.apart[1];
        }
        let (mut uu, mut uv, mut vv) = (1e-12f32, 0.0f32, 1e-12f32);
        let (mut xu, mut xv) = ([0.0f32; 3], [0.0f32; 3]);
        for spot in &self.pad {
            let (u, v) = (spot.apart[0] - apart[0], spot.apart[1] - apart[1]);
            uu += spot.weight * u * u;
            uv += spot.weight * u * v;
            vv += spot.weight * v * v;
            for axis in 0..3 {
                let d = spot.weight * (x[spot.node][axis] - mean[axis]);
                xu[axis] += d * u;
                xv[axis] += d * v;
            }
        }
        let determinant = uu * vv - uv * uv;
        if determinant.is_nan() || determinant <= 1e-18 {
            return;
        }
        let inverse = 1.0 / determinant;
        self.frame = [
            core::array::from_fn(|axis| (vv * xu[axis] - uv * xv[axis]) * inverse),
            core::array::from_fn(|axis| (uu * xv[axis] - uv * xu[axis]) * inverse),
        ];
    }

    /// Adds the pad's springs.
    pub fn add_to(&mut self, system: &mut System, positions: &[f32]) {
        self.tilt(positions);
        let held = self.held_place(positions);
        let away = distance(held, self.target);
        let k = bounded_stiffness(self.stiffness, away, self.strength);
        let x = positions.as_chunks::<3>().0;
        for spot in &self.pad {
            let (offset, k) = (self.offset(spot), k * spot.weight);
            let pull = |axis: usize| k * (self.target[axis] + offset[axis] - x[spot.node][axis]);
            system.push(spot.node, core::array::from_fn(pull));
            system.add_diagonal(spot.node, k);
        }
    }
}

/// Moves the grabs' targets toward where they are wanted, for the `h` seconds of the
/// first of `count` steps in which they shall come there. Where the paper between them tears they
/// go as far apart as they want.
pub(super) fn follow(
    grabs: &mut [Grab],
    settings: &SheetSettings,
    h: f32,
    count: u32,
    tears: bool,
) {
    for grab in grabs.iter_mut() {
        let away = distance(grab.wanted, grab.target);
        let part = (grab.pace * FASTEST * h / away.max(1e-9)).min(1.0 / count as f32);
        grab.pace = (grab.pace + RECOVERY * h).min(1.0);
        for axis in 0..3 {
            grab.target[axis] += part * (grab.wanted[axis] - grab.target[axis]);
        }
    }
    // Each limit may undo another a little; two rounds settle them.
    for _ in 0..2 {
        if !tears {
            for i in 1..grabs.len() {
                for k in 0..i {
                    draw_together(grabs, k, i);
                }
            }
        }
        if settings.root != Root::Free {
            for grab in grabs.iter_mut() {
                let ends = [0.0, settings.height as f32];
                for end in ends {
                    let [u, v] = grab.place;
                    let reach = REACH * (u * u + (v - end) * (v - end)).sqrt();
                    pull_within(&mut grab.target, [0.0, end, 0.0], reach);
                }
            }
        }
    }
}

/// Brings two grabs no farther apart than the paper between them is long.
fn draw_together(grabs: &mut [Grab], k: usize, i: usize) {
    let (a, b) = (&grabs[k], &grabs[i]);
    let [u, v] = [0, 1].map(|axis| a.place[axis] - b.place[axis]);
    let reach = REACH * (u * u + v * v).sqrt();
    let away = distance(a.target, b.target);
    if away <= reach {
        return;
    }
    let part = 0.5 * (1.0 - reach / away);
    for axis in 0..3 {
        let d = part * (grabs[i].target[axis] - grabs[k].target[axis]);
        grabs[k].target[axis] += d;
        grabs[i].target[axis] -= d;
    }
}

fn pull_within(point: &mut [f32; 3], middle: [f32; 3], reach: f32) {
    let away = distance(*point, middle);
    if away > reach {
        for axis in 0..3 {
            point[axis] = middle[axis] + (point[axis] - middle[axis]) * (reach / away);
        }
    }
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
}
