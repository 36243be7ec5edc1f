//! `lab trouser`: a sheet with two legs, torn on as the legs are pulled apart straight.
//!
//! Once the legs are long, nothing changes as the tear runs on but their length. So all work
//! of the pull goes into the tear: over a length a of it the grips move apart by 2 a, and
//! F 2 a = G h a. Here the sheet is a shell on a mesh that is torn edge by edge (Griffith):
//! its grips are moved apart, from equilibrium to equilibrium, until cutting an edge at the
//! tip of the tear would free as much energy as tearing takes.

use core::f64::consts::FRAC_PI_2;
use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use turnleaf_engine::{MeshSettings, MeshShell};

use crate::options::{between, make_folder, stock, stock_name};
use crate::report::{Lines, error};
use crate::table::Table;

/// Growth of cells from one to the next, away from the tear and from where the legs bend.
const GROWTH: f64 = 1.3;

/// Length of fine cells behind the tip at the start, over the length in which a leg bends:
/// beyond it a leg is straight, as it bends less by a factor of e in each such length.
const BEHIND: usize = 3;

/// How far a node may still move, over that length.
const TOLERANCE: f64 = 1e-6;

/// Most part by which the energy that a cut frees is off what tearing takes.
const ACCURACY: f64 = 1e-3;

/// Most pulls until an edge tears.
const PULLS: usize = 40;

/// Edges torn before the force is measured: from them on it repeats itself.
const RUN_IN: usize = 2;

/// Pulls in which the force at the grips is measured from one tear to the next, even.
const PARTS: usize = 8;

/// Rows of the table: stock, work of fracture, leg, its length, cells. Each differs from the
/// first in one thing.
const ROWS: [(&str, f64, f64, f64, usize); 12] = [
    ("book", 10.0, 10.0, 3.0, 4),
    ("book", 10.0, 10.0, 3.0, 2),
    ("book", 10.0, 10.0, 3.0, 3),
    ("book", 10.0, 10.0, 3.0, 6),
    ("book", 5.0, 10.0, 3.0, 4),
    ("book", 20.0, 10.0, 3.0, 4),
    ("book", 10.0, 5.0, 3.0, 4),
    ("book", 10.0, 20.0, 3.0, 4),
    ("book", 10.0, 10.0, 2.0, 4),
    ("book", 10.0, 10.0, 5.0, 4),
    ("office", 10.0, 10.0, 3.0, 4),
    ("card", 10.0, 10.0, 3.0, 4),
];

/// Options of `lab trouser`.
#[derive(Args)]
pub struct Options {
    /// The paper: its caliper and its stiffness across the grain.
    #[arg(long, default_value = "book", value_parser = stock_name())]
    stock: &'static str,
    /// Work of fracture, kJ/m^2.
    #[arg(long, default_value_t = 10.0, value_parser = between(1.0, 100.0))]
    fracture: f64,
    /// Width of a leg, mm.
    #[arg(long, default_value_t = 10.0, value_parser = between(2.0, 50.0))]
    leg: f64,
    /// Length of a leg at the start, over its width.
    #[arg(long, default_value_t = 3.0, value_parser = between(1.0, 10.0))]
    long: f64,
    /// Cells along the tear in the length in which a leg bends.
    #[arg(long, default_value_t = 4, value_parser = between(2usize, 12))]
    cells: usize,
    /// Edges that are torn.
    #[arg(long, default_value_t = 4, value_parser = between(RUN_IN + 1, 64))]
    edges: usize,
    /// Measure twelve settings in place of these, and write the table into a folder, as
    /// trouser.json.
    #[arg(long)]
    into: Option<PathBuf>,
}

/// A pull.
#[derive(Serialize)]
pub struct Pull {
    force_n: f64,
}

/// A part of a pull.
#[derive(Serialize)]
pub struct Off {
    force: f64,
}

/// A tear, and the pull beside half the work of fracture.
#[derive(Serialize)]
pub struct Tear {
    stock: &'static str,
    fracture_kj_m2: f64,
    leg_mm: f64,
    leg_over_width: f64,
    cells: usize,
    nodes: usize,
    /// Edges torn in all, and those of them that lead to a side.
    edges: usize,
    aside: usize,
    /// Most energy a length that an edge to a side would have freed, over the work of fracture.
    freed_aside: f64,
    /// Force just before and just after an edge tears, N.
    highest_n: f64,
    lowest_n: f64,
    /// Mean of the force that the grips bear over the way from the last tear but one to the
    /// last, N.
    at_grips_n: f64,
    /// Mean over all ways but the first: what the paper gained in energy over the way.
    #[serde(flatten)]
    found: Pull,
    exact: Pull,
    error: Off,
}

/// One tear, or a table of them.
#[derive(Serialize)]
#[serde(untagged)]
pub enum Tears {
    One(Lines<Tear>),
    Many(Vec<Tear>),
}

/// Runs `lab trouser`.
///
/// # Errors
/// Where the paper finds no rest or the table cannot be written, in a sentence.
pub fn run(options: &Options) -> Result<Tears, String> {
    let Some(folder) = &options.into else {
        return tear(options).map(|tear| Tears::One(Lines(tear)));
    };
    make_folder(folder)?;
    let of = |(stock, fracture, leg, long, cells)| {
        tear(&Options {
            stock,
            fracture,
            leg,
            long,
            cells,
            edges: options.edges,
            into: None,
        })
    };
    let tears = ROWS.into_iter().map(of).collect::<Result<Vec<_>, _>>()?;
    table(&tears).write(folder, "trouser")?;
    Ok(Tears::Many(tears))
}

fn table(tears: &[Tear]) -> Table {
    let mut table = Table::new(&[
        "paper",
        "work of fracture, kJ/m²",
        "leg, mm",
        "length of a leg over its width",
        "cells",
        "G h / 2, N",
        "force, N",
        "off by",
        "at the grips, N",
        "just before and after a tear, N",
        "freed to a side, of G h",
    ]);
    for tear in tears {
        table.push(vec![
            tear.stock.to_owned(),
            tear.fracture_kj_m2.to_string(),
            tear.leg_mm.to_string(),
            tear.leg_over_width.to_string(),
            tear.cells.to_string(),
            format!("{:.3}", tear.exact.force_n),
            format!("{:.4}", tear.found.force_n),
            format!("{:.2} %", 100.0 * tear.error.force),
            format!("{:.4}", tear.at_grips_n),
            format!("{:.2}, {:.2}", tear.highest_n, tear.lowest_n),
            format!("{:.2}", tear.freed_aside),
        ]);
    }
    table
}

impl Display for Tears {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        match self {
            Self::One(tear) => tear.fmt(out),
            Self::Many(tears) => table(tears).fmt(out),
        }
    }
}

/// Tears a sheet as ordered.
fn tear(options: &Options) -> Result<Tear, String> {
    let work = 1e3 * options.fracture * stock(options.stock).caliper;
    let mut sheet = Trousers::new(options, work)?;
    let (mut aside, mut freed_aside) = (0, 0.0f64);
    let (mut gained, mut way) = (0.0, 0.0);
    let [mut lowest, mut highest, mut at_grips] = [0.0; 3];
    for edge in 0..options.edges {
        let (start, start_energy) = (sheet.apart, sheet.energy());
        let slack = sheet.clone();
        let torn = sheet.pull_until_torn(work)?;
        let mut ways = vec![(sheet.freed(&torn) / sheet.length_to(torn.tip), torn)];
        for to in sheet.to_the_sides() {
            let torn = sheet.torn(to)?;
            ways.push((sheet.freed(&torn) / sheet.length_to(to), torn));
            freed_aside = freed_aside.max(ways[ways.len() - 1].0 / work);
        }
        if edge >= RUN_IN {
            gained += sheet.energy() - start_energy;
            way += sheet.apart - start;
        }
        if edge + 1 == options.edges {
            lowest = slack.force();
            highest = sheet.force();
            at_grips = slack.mean_force(sheet.apart - start)?;
        }
        let ahead = sheet.tip + 1;
        let most = ways.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        sheet = most.expect("one way leads ahead").1;
        aside += usize::from(sheet.tip != ahead);
    }
    let (found, exact) = (gained / way, 0.5 * work);
    Ok(Tear {
        stock: options.stock,
        fracture_kj_m2: options.fracture,
        leg_mm: options.leg,
        leg_over_width: options.long,
        cells: options.cells,
        nodes: sheet.flat.len(),
        edges: options.edges,
        aside,
        freed_aside,
        highest_n: highest,
        lowest_n: lowest,
        at_grips_n: at_grips,
        found: Pull { force_n: found },
        exact: Pull { force_n: exact },
        error: Off {
            force: error(found, exact),
        },
    })
}

/// A sheet with two legs whose ends are gripped, one above the other.
#[derive(Clone)]
struct Trousers {
    shell: MeshShell,
    /// Places of the nodes on the flat paper: the tear leads along u, legs lie beside v = 0.
    flat: Vec<[f64; 2]>,
    /// Of each node, 1 on the leg that is pulled up and on its side, else -1.
    side: Vec<f64>,
    /// Distance of the grips, m.
    apart: f64,
    /// The node at the end of the tear.
    tip: usize,
    /// Nodes from one end of the sheet to the other.
    columns: usize,
    /// How far a node may still move, m.
    tolerance: f64,
}

impl Trousers {
    /// A sheet at rest, its legs bent up and down where they begin.
    fn new(options: &Options, work: f64) -> Result<Self, String> {
        let paper = stock(options.stock);
        let leg = 1e-3 * options.leg;
        // Of the elastica, sqrt(D leg / F).
        let bend = (2.0 * paper.stiffness_across * leg / work).sqrt();
        let cell = bend / options.cells as f64;
        let fine = vec![cell; BEHIND * options.cells + options.edges];
        let behind = growing(cell, options.long * leg - BEHIND as f64 * bend);
        let start = behind.len() + BEHIND * options.cells;
        let across = growing(cell, leg);
        let sizes = behind.iter().rev().chain(&fine).chain(&across);
        let edge = sums(across.iter())[across.len()];
        let up = sums(across.iter()).into_iter().map(|v| v * leg / edge);
        let down = up.clone().skip(1).map(|v| -v).rev();
        let (us, vs): (Vec<f64>, Vec<f64>) = (sums(sizes), down.chain(up).collect());
        let columns = us.len();
        let flat: Vec<[f64; 2]> = (0..columns * vs.len())
            .map(|node| [us[node % columns], vs[node / columns]])
            .collect();
        let corners = 0..(vs.len() - 1) * columns;
        let corners = corners.filter(|foot| foot % columns + 1 != columns);
        let shell = MeshShell::new(MeshSettings {
            cells: corners
                .map(|foot| vec![foot, foot + 1, foot + columns + 1, foot + columns])
                .collect(),
            places: flat.clone(),
            bending: paper.stiffness_across,
            membrane: 12.0 * paper.stiffness_across / (paper.caliper * paper.caliper),
        })
        .map_err(|error| error.to_string())?;
        let mut sheet = Self {
            shell,
            side: flat.iter().map(|[_, v]| v.signum()).collect(),
            flat,
            apart: 0.0,
            tip: across.len() * columns,
            columns,
            tolerance: TOLERANCE * bend,
        };
        for _ in 0..start {
            sheet.cut(sheet.tip + 1)?;
        }
        let places: Vec<[f64; 3]> = (0..sheet.flat.len())
            .map(|node| sheet.bent(node, us[start], bend))
            .collect();
        sheet.apart = 2.0 * places[0][2].abs();
        sheet.shell.place(&places);
        for (node, place) in places.iter().enumerate() {
            if sheet.flat[node][0] == 0.0 {
                sheet.shell.pin(node, Some(*place));
            }
        }
        sheet.settle()?;
        Ok(sheet)
    }

    /// Where a node is if the legs are arcs of a quarter turn and straight from there on.
    fn bent(&self, node: usize, tip: f64, radius: f64) -> [f64; 3] {
        let [u, v] = self.flat[node];
        let along = (tip - u).max(0.0);
        let angle = (along / radius).min(FRAC_PI_2);
        let straight = along - angle * radius;
        let high = radius * (1.0 - angle.cos()) + straight;
        let from = tip.max(u) - radius * angle.sin();
        [from, v, self.side[node] * high]
    }

    fn settle(&mut self) -> Result<(), String> {
        let rest = self.shell.settle(self.tolerance);
        rest.map_err(|error| error.to_string())
    }

    fn energy(&self) -> f64 {
        let energy = self.shell.energy();
        energy.bending + energy.membrane
    }

    /// Force with which the grips pull apart, the mean of both.
    fn force(&self) -> f64 {
        let forces = self.shell.forces();
        let grips = (0..self.flat.len()).filter(|node| self.flat[*node][0] == 0.0);
        let pulls = grips.map(|node| -0.5 * self.side[node] * forces[node][2]);
        pulls.sum()
    }

    /// Moves the grips apart, and the legs with them, as far as they are long.
    fn pull(&mut self, by: f64) -> Result<(), String> {
        self.apart += by;
        let tip = self.flat[self.tip][0];
        let mut places = self.shell.positions().to_vec();
        for (node, place) in places.iter_mut().enumerate() {
            let part = (1.0 - self.flat[node][0] / tip).max(0.0);
            place[2] += 0.5 * by * part * self.side[node];
        }
        self.shell.place(&places);
        self.settle()
    }

    /// Pulls until the energy that tearing the edge ahead frees is what that takes, by
    /// Newton's method: what a pull adds to it is the difference of the forces. Returns the
    /// sheet after the tear.
    fn pull_until_torn(&mut self, work: f64) -> Result<Self, String> {
        let ahead = self.tip + 1;
        let mut torn = self.torn(ahead)?;
        let cell = self.length_to(ahead);
        for pull in 0..PULLS {
            let short = work * cell - self.freed(&torn);
            // An edge that would have torn at the start tears there.
            if short.abs() < ACCURACY * work * cell || (pull == 0 && short < 0.0) {
                return Ok(torn);
            }
            let by = short / (self.force() - torn.force());
            let by = by.clamp(-cell, cell);
            self.pull(by)?;
            torn.pull(by)?;
        }
        Err("The sheet does not tear.".to_owned())
    }

    /// The sheet at rest once the edge from the tip to a node is torn.
    fn torn(&self, to: usize) -> Result<Self, String> {
        let mut torn = self.clone();
        torn.cut(to)?;
        torn.settle()?;
        Ok(torn)
    }

    fn cut(&mut self, to: usize) -> Result<(), String> {
        let doubled = self.shell.cut(self.tip, to);
        for node in doubled.map_err(|error| error.to_string())? {
            self.flat.push(self.flat[node]);
            self.side.push(1.0);
            self.side[node] = -1.0;
        }
        self.tip = to;
        Ok(())
    }

    fn freed(&self, torn: &Self) -> f64 {
        self.energy() - torn.energy()
    }

    fn length_to(&self, to: usize) -> f64 {
        let ([u, v], [u_to, v_to]) = (self.flat[self.tip], self.flat[to]);
        (u_to - u).hypot(v_to - v)
    }

    fn to_the_sides(&self) -> [usize; 2] {
        [self.tip + self.columns, self.tip - self.columns]
    }

    /// Mean of the force over a way of the grips, by Simpson's rule.
    fn mean_force(mut self, way: f64) -> Result<f64, String> {
        let mut sum = self.force();
        for part in 1..=PARTS {
            self.pull(way / PARTS as f64)?;
            let weight = [2.0, 4.0][part % 2] - f64::from(u8::from(part == PARTS));
            sum += weight * self.force();
        }
        Ok(sum / (3.0 * PARTS as f64))
    }
}

/// Sizes of cells from one on, each larger than the one before, that together reach a length.
fn growing(first: f64, length: f64) -> Vec<f64> {
    let mut sizes = Vec::new();
    let (mut size, mut sum) = (first, 0.0);
    while sum < length {
        sizes.push(size);
        sum += size;
        size *= GROWTH;
    }
    sizes
}

/// 0 and what the sizes add up to, one after the other.
fn sums<'a>(sizes: impl Iterator<Item = &'a f64>) -> Vec<f64> {
    let mut sums = vec![0.0];
    sums.extend(sizes.scan(0.0, |sum, size| {
        *sum += size;
        Some(*sum)
    }));
    sums
}
