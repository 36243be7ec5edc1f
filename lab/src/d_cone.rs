//! `lab d-cone`: paper pushed at a point into a funnel, which becomes a developable cone
//! that lies on the funnel but for one lifted sector.
//!
//! On a ring the cone's generators would lie as they do on the funnel through the ring.
//! Theory has no thickness: the shell is therefore as thin as paper is on a ring of 0.1 m and
//! more, and what lies near the tip, where paper stretches, is a few cells of straight edges.

use core::f64::consts::PI;

use clap::Args;
use serde::Serialize;
use turnleaf_engine::{
    Air, Contact, HalfSpace, MeshSettings, MeshShell, Root, Sheet, SheetSettings, Stock, TurnModel,
};

use crate::exact::DevelopableCone;
use crate::options::between;
use crate::report::Lines;
use crate::specimen::{Label, Model, ModelOptions};

/// Radii of the shell's rings of nodes over that of the funnel's rim: each cell about
/// as long as wide.
const INNERMOST: f64 = 0.5;
const RINGS: usize = 4;

/// Thickness over the radius.
const THICKNESS: f64 = 5e-4;

/// Half of the sector that is lifted at the start.
const START: f64 = PI / 3.0;

/// Stiffness of the funnel, of a node over the bending stiffness at a radius of 1.
const FUNNEL: f64 = 1e4;

/// How far a node may still move, over the radius.
const TOLERANCE: f64 = 1e-5;

/// Lifts over the funnel's height from which it follows where the paper takes off: near
/// there the lift grows with the third power of the angle.
const LIFTS: core::ops::Range<f64> = 0.02..0.25;

/// Radius of the interactive sheet's funnel, m: a square of book paper of twice that.
const RADIUS: f64 = 0.1;

/// Most seconds that the sheet is simulated for, and speed at which it is at rest, m/s.
const SECONDS: f64 = 4.0;
const STILL: f32 = 1e-3;

/// Options of `lab d-cone`.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Slope of the funnel.
    #[arg(long, default_value_t = 0.1, value_parser = between(0.02, 0.3))]
    slope: f64,
    /// Angle from the rows of the sheet at which it is lifted at the start, degrees; the shell has none.
    #[arg(long, default_value_t = 0.0, value_parser = between(-180.0, 180.0))]
    turn: f64,
    /// Let the sheet crumple: its cells may fold along either diagonal; the shell does not.
    #[arg(long)]
    crumples: bool,
    /// Nodes of the shell around the tip, or of the sheet along each side [default: 192, 25]
    #[arg(long, value_parser = between(24usize, 256))]
    nodes: Option<usize>,
}

/// The lifted sector.
#[derive(Serialize)]
pub struct Lifted {
    sector_deg: f64,
}

/// A developable cone beside the exact one.
#[derive(Serialize)]
pub struct Cone {
    #[serde(flatten)]
    of: Label,
    slope: f64,
    /// Whether it is of a sheet that crumples.
    crumples: bool,
    nodes: usize,
    #[serde(flatten)]
    found: Lifted,
    exact: Lifted,
    error: Lifted,
}

/// Runs `lab d-cone`.
///
/// # Errors
/// Where the paper finds no rest, in a sentence.
pub fn run(options: &Options) -> Result<Lines<Cone>, String> {
    let model = options.model.model()?;
    let slope = options.slope;
    let crumples = options.crumples && matches!(model, Model::Sheet(_));
    let (nodes, places) = match model {
        Model::Shell => {
            let around = options.nodes.unwrap_or(192);
            (around, by_shell(around, slope)?)
        }
        Model::Sheet(settings) => {
            let paper = Stock {
                stiffness_along: Stock::BOOK.stiffness_across,
                poisson: 0.0,
                ..Stock::BOOK
            };
            let columns = options.nodes.unwrap_or(25).min(64) | 1;
            let settings = SheetSettings {
                columns,
                rows: columns,
                root: Root::Free,
                air: Air::NONE,
                gravity: [0.0; 3],
                ..settings.sheet([2.0 * RADIUS; 2], paper)
            };
            let mut sheet = Sheet::new(settings).map_err(|error| error.to_string())?;
            if crumples {
                sheet.crumple();
            }
            let turn = options.turn.to_radians();
            (columns, by_sheet(sheet, slope, turn))
        }
        Model::MassSpring => return Err("Masses and springs are not pushed into a funnel.".into()),
    };
    let found = sector(&places, slope)?.to_degrees();
    let exact = DevelopableCone::new().sector.to_degrees();
    let lifted = |sector_deg| Lifted { sector_deg };
    Ok(Lines(Cone {
        of: model.label(),
        slope,
        crumples,
        nodes,
        found: lifted(found),
        exact: lifted(exact),
        error: lifted(found - exact),
    }))
}

/// Directions from the tip of a cone without stretch that lies on the funnel but for a bump
/// about the x axis, by the angle on the flat paper: from -pi to pi.
struct Start {
    directions: Vec<[f64; 3]>,
}

impl Start {
    /// The cone whose bump has the width meant.
    fn new(slope: f64) -> Self {
        const PARTS: usize = 3600;
        let curve = |bump: f64| -> Vec<[f64; 3]> {
            let at = |i: usize| {
                let phi = PI * (2.0 * i as f64 / PARTS as f64 - 1.0);
                let lift = if phi.abs() < START {
                    bump * (1.0 + (PI * phi / START).cos())
                } else {
                    0.0
                };
                let z = slope * (1.0 + lift);
                let long = (1.0 + z * z).sqrt();
                [phi.cos() / long, phi.sin() / long, z / long]
            };
            (0..=PARTS).map(at).collect()
        };
        let lengths = |curve: &[[f64; 3]]| -> Vec<f64> {
            let mut sum = 0.0;
            let mut lengths = vec![0.0];
            for pair in curve.windows(2) {
                let way: [f64; 3] = core::array::from_fn(|axis| pair[1][axis] - pair[0][axis]);
                sum += way.iter().map(|w| w * w).sum::<f64>().sqrt();
                lengths.push(sum);
            }
            lengths
        };
        // The bump takes up what the paper around the tip is longer than the funnel.
        let (mut low, mut high) = (0.0, 10.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if lengths(&curve(middle))[PARTS] > 2.0 * PI {
                high = middle;
            } else {
                low = middle;
            }
        }
        let curve = curve(low);
        let lengths = lengths(&curve);
        let mut part = 0;
        let directions = (0..=PARTS).map(|i| {
            let along = lengths[PARTS] * i as f64 / PARTS as f64;
            while part + 2 < lengths.len() && lengths[part + 1] < along {
                part += 1;
            }
            let ahead = (along - lengths[part]) / (lengths[part + 1] - lengths[part]);
            between_places(&curve[part], &curve[part + 1], ahead)
        });
        Self {
            directions: directions.collect(),
        }
    }

    /// Where a place of the flat paper is, its tip at the origin.
    fn place(&self, [u, v]: [f64; 2]) -> [f64; 3] {
        let parts = self.directions.len() - 1;
        let part = (v.atan2(u) + PI) / (2.0 * PI) * parts as f64;
        let below = (part as usize).min(parts - 1);
        let [from, to] = [below, below + 1].map(|i| &self.directions[i]);
        between_places(from, to, part - below as f64).map(|x| x * u.hypot(v))
    }
}

fn between_places(from: &[f64; 3], to: &[f64; 3], part: f64) -> [f64; 3] {
    core::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]))
}

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

/// Unit normal of the funnel under a place.
fn normal(place: [f64; 3], slope: f64) -> [f64; 3] {
    let radius = place[0].hypot(place[1]).max(1e-9);
    let long = slope.hypot(1.0);
    [
        -slope * place[0] / radius / long,
        -slope * place[1] / radius / long,
        1.0 / long,
    ]
}

/// Places of the nodes of the shell in the funnel, a disc of radius 1 and the tip.
fn by_shell(around: usize, slope: f64) -> Result<Vec<[f64; 3]>, String> {
    let ratio = (1.0 / INNERMOST).powf(1.0 / (RINGS - 1) as f64);
    let number = |ring: usize, k: usize| 1 + ring * around + k % around;
    let mut flat = vec![[0.0; 2]];
    let mut cells = Vec::new();
    for ring in 0..RINGS {
        let radius = INNERMOST * ratio.powi(ring as i32);
        for k in 0..around {
            let (sin, cos) = (2.0 * PI * k as f64 / around as f64).sin_cos();
            flat.push([radius * cos, radius * sin]);
            cells.push(match ring {
                0 => vec![0, number(0, k), number(0, k + 1)],
                _ => {
                    let [low, high] = [ring - 1, ring];
                    let corners = [(low, k), (high, k), (high, k + 1), (low, k + 1)];
                    corners.map(|(ring, k)| number(ring, k)).to_vec()
                }
            });
        }
    }
    let start = Start::new(slope);
    let places: Vec<[f64; 3]> = flat.iter().map(|place| start.place(*place)).collect();
    let mut shell = MeshShell::new(MeshSettings {
        places: flat,
        cells,
        bending: 1.0,
        membrane: 12.0 / (THICKNESS * THICKNESS),
    })
    .map_err(|error| error.to_string())?;
    shell.place(&places);
    shell.pin(0, Some([0.0; 3]));
    let half_space = |node, normal| {
        let half_space = HalfSpace {
            normal,
            offset: 0.0,
            stiffness: FUNNEL * 64.0 / around as f64,
        };
        (node, half_space)
    };
    // It may not turn about the tip.
    let keel = number(RINGS - 1, 0);
    let mut kept = vec![
        half_space(keel, [0.0, 1.0, 0.0]),
        half_space(keel, [0.0, -1.0, 0.0]),
    ];
    for (node, place) in places.iter().enumerate().skip(1) {
        kept.push(half_space(node, normal(*place, slope)));
    }
    shell.keep_in(kept);
    shell.settle(TOLERANCE).map_err(|error| error.to_string())?;
    Ok(shell.positions().to_vec())
}

/// Places of the nodes of a square sheet in the funnel, over its radius, which is lifted at first
/// at an angle from its rows.
fn by_sheet(mut sheet: Sheet, slope: f64, turn: f64) -> Vec<[f64; 3]> {
    let count = sheet.settings().columns;
    let steps = (SECONDS / sheet.settings().time_step) as usize;
    let start = Start::new(slope);
    let cell = 2.0 * RADIUS / (count - 1) as f64;
    let flat = (0..count * count).map(|node| {
        let [column, row] = [node % count, node / count];
        [column, row].map(|i| i as f64 * cell - RADIUS)
    });
    let places = flat.flat_map(|place| {
        let [x, y, z] = start.place(turned(place, -turn));
        let [x, y] = turned([x, y], turn);
        [x, y, z]
    });
    let places: Vec<f32> = places.map(|x| x as f32).collect();
    sheet.write_nodes(&places, &vec![0.0; places.len()]);
    sheet.pin(count / 2, count / 2, Some([0.0; 3]));
    let places = |sheet: &Sheet| -> Vec<[f64; 3]> {
        let (nodes, _) = sheet.positions().as_chunks::<3>();
        nodes.iter().map(|node| node.map(f64::from)).collect()
    };
    for step in 0..steps {
        let under: Vec<[f64; 3]> = places(&sheet);
        for (contacts, place) in sheet.contacts_mut().iter_mut().zip(under) {
            contacts[0] = Contact {
                normal: normal(place, slope).map(|n| n as f32),
                firmness: 1.0,
                ..Contact::default()
            };
        }
        sheet.step();
        sheet.slow(0.98);
        if step > 100 && sheet.greatest_speed() < STILL {
            break;
        }
    }
    let places = places(&sheet).into_iter();
    places.map(|place| place.map(|x| x / RADIUS)).collect()
}

/// The sector that is lifted off the funnel about where most is, radians: on each side the angle
/// at which the third root of the lift, which falls evenly there, would be 0, of the outer half of
/// the disc. What is lifted beyond where the paper first lies on the funnel does not count.
fn sector(places: &[[f64; 3]], slope: f64) -> Result<f64, String> {
    let lift = |[x, y, z]: [f64; 3]| z / (slope * x.hypot(y)) - 1.0;
    let outer: Vec<[f64; 3]> = places
        .iter()
        .copied()
        .filter(|[x, y, _]| (0.99 * INNERMOST..1.01).contains(&x.hypot(*y)))
        .collect();
    // The middle of what is lifted.
    let mut lifted = [0.0; 2];
    for place in &outer {
        for axis in 0..2 {
            lifted[axis] += lift(*place).max(0.0) * place[axis] / place[0].hypot(place[1]);
        }
    }
    let [cos, sin] = lifted;
    let angle = |[x, y, _]: [f64; 3]| (y * cos - x * sin).atan2(x * cos + y * sin);
    let mut sector = 0.0;
    for side in [1.0, -1.0] {
        let mut beside: Vec<[f64; 2]> = outer
            .iter()
            .map(|place| [lift(*place), side * angle(*place)])
            .filter(|[_, angle]| (0.0..0.5 * PI).contains(angle))
            .collect();
        beside.sort_by(|[_, a], [_, b]| a.total_cmp(b));
        let lifted = beside.iter().take_while(|[lift, _]| *lift > LIFTS.start);
        let points: Vec<[f64; 2]> = lifted
            .filter(|[lift, _]| LIFTS.contains(lift))
            .map(|[lift, angle]| [lift.cbrt(), *angle])
            .collect();
        if points.len() < 2 {
            return Err("The paper is not lifted as a cone.".into());
        }
        let count = points.len() as f64;
        let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / count;
        let [root, at] = [mean(0), mean(1)];
        let (mut products, mut squares) = (0.0, 0.0);
        for [x, y] in points {
            products += (x - root) * (y - at);
            squares += (x - root) * (x - root);
        }
        sector += at - products / squares * root;
    }
    Ok(sector)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring of paper that is lifted about an angle by the third power of how far a place is
    /// within half of a sector, and ripples by 0.04 of the funnel's height a right angle away.
    fn rippled(about: f64, half: f64, slope: f64) -> Vec<[f64; 3]> {
        let place = |k: usize| {
            let off = PI * (k as f64 / 180.0 - 1.0);
            let cubic = (1.0 - off.abs() / half).max(0.0).powi(3);
            let is_ripple = (off.abs() - 0.5 * PI).abs() < 0.1 && k.is_multiple_of(2);
            let lift = 2.8 * cubic + if is_ripple { 0.04 } else { 0.0 };
            let [x, y] = turned([0.75, 0.0], about + off);
            [x, y, slope * 0.75 * (1.0 + lift)]
        };
        (0..360).map(place).collect()
    }

    #[test]
    fn ripples_beside_the_lifted_sector_do_not_count() {
        for about in [0.0, 1.0, -2.5] {
            let half = 69.5f64.to_radians();
            let found = sector(&rippled(about, half, 0.1), 0.1).unwrap();
            assert!((found - 2.0 * half).abs() < 0.01, "{}", found.to_degrees());
        }
    }

    #[test]
    fn paper_that_lies_on_the_funnel_has_no_sector() {
        assert!(sector(&rippled(0.0, 0.01, 0.1), 0.1).is_err());
    }
}
