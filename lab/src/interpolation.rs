//! `lab interpolation`: the ways from few nodes to many points, the open problem
//! of the paper: what each costs, and what it makes of shapes that are known.
//!
//! The shapes are sheets of paper 148 x 210 mm: bent about an axis along the
//! spine through half a turn and through three quarters, and around a cone. None
//! is stretched, so every strain of the drawn mesh is the interpolation's, but
//! for that of straight edges over a curve, which is taken off.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fmt::{self, Display, Formatter};
use std::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use serde::Serialize;
use turnleaf_engine::shapes::Cone;
use turnleaf_engine::{Interpolation, Surface, lobatto_nodes, uniform_samples};

use crate::options::make_folder;
use crate::simulate::median;
use crate::specimen::{BREADTH, LENGTH};
use crate::table::Table;

/// Numbers of nodes and of points: the paper's, and those of a page in a book.
const GRIDS: [([usize; 2], [usize; 2]); 2] = [([6, 6], [26, 26]), ([12, 16], [49, 25])];

/// A way.
struct Way {
    name: &'static str,
    /// How often it can be differentiated everywhere.
    continuity: &'static str,
    /// Whether its nodes lie closer together toward the edges.
    graded: bool,
    make: fn(usize, usize, &[f32], &[f32]) -> Interpolation,
}

const WAYS: [Way; 5] = [
    Way {
        name: "lagrange",
        continuity: "all",
        graded: false,
        make: Interpolation::lagrange,
    },
    Way {
        name: "barycentric",
        continuity: "all",
        graded: true,
        make: Interpolation::barycentric,
    },
    Way {
        name: "spline",
        continuity: "2",
        graded: false,
        make: Interpolation::spline,
    },
    Way {
        name: "b-spline",
        continuity: "2",
        graded: false,
        make: Interpolation::b_spline,
    },
    Way {
        name: "hermite",
        continuity: "1",
        graded: false,
        make: Interpolation::hermite,
    },
];

/// A shape: where the place (x, y) of a flat sheet is, all in metres.
type Shape = (&'static str, fn([f64; 2]) -> [f64; 3]);

const SHAPES: [Shape; 3] = [
    ("half turn", |at| bend(at, PI)),
    ("three quarters", |at| bend(at, 1.5 * PI)),
    ("cone", |at| Cone::of(0.09, 0.5, 0.0).place(at)),
];

/// Bent about an axis along the spine.
fn bend([x, y]: [f64; 2], through: f64) -> [f64; 3] {
    let radius = LENGTH / through;
    let (sin, cos) = (x / radius).sin_cos();
    [radius * sin, y, radius * (1.0 - cos)]
}

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    /// Write the tables into a folder, as interpolation_NODES.json.
    #[arg(long)]
    into: Option<PathBuf>,
}

/// All ways on all grids.
#[derive(Serialize)]
pub struct Comparison {
    grids: Vec<Grid>,
}

#[derive(Serialize)]
struct Grid {
    nodes: [usize; 2],
    points: [usize; 2],
    ways: Vec<Found>,
}

/// What was found of a way.
#[derive(Serialize)]
struct Found {
    name: &'static str,
    differentiable: &'static str,
    us_per_surface: f64,
    overshoot: f64,
    curvature_jump: f64,
    shapes: BTreeMap<&'static str, Errors>,
}

#[derive(Serialize)]
struct Errors {
    position_error: f64,
    strain_error: f64,
}

/// Runs the experiment.
///
/// # Errors
/// Where a table cannot be written, in a sentence.
pub fn run(options: &Options) -> Result<Comparison, String> {
    options.into.as_deref().map_or(Ok(()), make_folder)?;
    let grids = GRIDS.map(|(nodes, points)| Grid {
        nodes,
        points,
        ways: { WAYS.iter() }
            .map(|way| measure(way, nodes, points))
            .collect(),
    });
    if let Some(folder) = &options.into {
        for grid in &grids {
            let [columns, rows] = grid.nodes;
            let name = format!("interpolation_{columns}x{rows}");
            grid.table().write(folder, &name)?;
        }
    }
    Ok(Comparison {
        grids: grids.into(),
    })
}

/// Places of the nodes along a side, 0 to 1.
fn nodes_of(way: &Way, count: usize) -> Vec<f32> {
    if way.graded {
        lobatto_nodes(count)
    } else {
        uniform_samples(count)
    }
}

/// x, y, z of a shape at every pair of places.
fn sampled(shape: Shape, u: &[f32], v: &[f32]) -> Vec<f32> {
    let place = |u: f32, v: f32| shape.1([f64::from(u) * LENGTH, f64::from(v) * BREADTH]);
    let row = |&v: &f32| u.iter().flat_map(move |&u| place(u, v));
    v.iter().flat_map(row).map(|x| x as f32).collect()
}

fn measure(way: &Way, [columns, rows]: [usize; 2], [across, up]: [usize; 2]) -> Found {
    let (at_u, at_v) = (nodes_of(way, columns), nodes_of(way, rows));
    let (u, v) = (uniform_samples(across), uniform_samples(up));
    let mut drawn = Surface::new(across, up);
    let mut exact = Surface::new(across, up);
    let mut interpolation = (way.make)(columns, rows, &u, &v);
    let mut shapes = BTreeMap::new();
    for shape in SHAPES {
        interpolation.apply_interleaved(&sampled(shape, &at_u, &at_v), &mut drawn.positions);
        exact.positions = sampled(shape, &u, &v);
        let (mut away, mut strain) = (0.0f64, 0.0f64);
        for (a, b) in drawn
            .positions
            .as_chunks::<3>()
            .0
            .iter()
            .zip(exact.positions.as_chunks::<3>().0)
        {
            away = away.max(distance(*a, *b) / LENGTH);
        }
        for (a, b, rest) in edges(across, up) {
            let length = |surface: &Surface| {
                let x = surface.positions.as_chunks::<3>().0;
                distance(x[a], x[b])
            };
            strain = strain.max((length(&drawn) - length(&exact)).abs() / rest);
        }
        let errors = Errors {
            position_error: away,
            strain_error: strain,
        };
        shapes.insert(shape.0, errors);
    }
    let bend = sampled(SHAPES[0], &at_u, &at_v);
    Found {
        name: way.name,
        differentiable: way.continuity,
        us_per_surface: cost(&mut interpolation, &bend, &mut drawn),
        overshoot: overshoot(way, columns, rows),
        curvature_jump: curvature_jump(way, columns, rows),
        shapes,
    }
}

/// Pairs of neighbouring points, and how far apart they rest.
fn edges(columns: usize, rows: usize) -> impl Iterator<Item = (usize, usize, f64)> {
    let (du, dv) = (LENGTH / (columns - 1) as f64, BREADTH / (rows - 1) as f64);
    (0..columns * rows).flat_map(move |point| {
        let right = (point % columns + 1 < columns).then_some((point, point + 1, du));
        let above = (point / columns + 1 < rows).then_some((point, point + columns, dv));
        right.into_iter().chain(above)
    })
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f64 {
    let square = |axis: usize| (f64::from(a[axis]) - f64::from(b[axis])).powi(2);
    (square(0) + square(1) + square(2)).sqrt()
}

/// Microseconds of a surface.
fn cost(interpolation: &mut Interpolation, nodes: &[f32], surface: &mut Surface) -> f64 {
    let rounds = (0..41).map(|_| {
        let clock = Instant::now();
        for _ in 0..500 {
            black_box(&mut *interpolation)
                .apply_interleaved(black_box(nodes), &mut surface.positions);
            black_box(&*surface);
        }
        clock.elapsed().as_secs_f64() * 1e6 / 500.0
    });
    median(rounds.collect())
}

/// How far the curve through nodes that are 0 up to the middle and 1 from there
/// on swings beyond these.
fn overshoot(way: &Way, columns: usize, rows: usize) -> f64 {
    let u = uniform_samples(401);
    let mut interpolation = (way.make)(columns, rows, &u, &[0.0, 1.0]);
    let step = |column: usize| if 2 * column < columns { 0.0 } else { 1.0 };
    let nodes: Vec<f32> = (0..columns * rows)
        .flat_map(|node| [0.0, 0.0, step(node % columns)])
        .collect();
    let mut points = vec![0.0; 3 * 401 * 2];
    interpolation.apply_interleaved(&nodes, &mut points);
    let beyond = |z: f32| f64::from((z - 1.0).max(-z));
    points
        .chunks_exact(3)
        .map(|p| beyond(p[2]))
        .fold(0.0, f64::max)
}

/// Greatest change of the second derivative of a bend of half a turn from one of
/// 400 places to the next, as part of the greatest second derivative: on the
/// bend itself 0.8 %.
fn curvature_jump(way: &Way, columns: usize, rows: usize) -> f64 {
    let count = 401;
    let u = uniform_samples(count);
    let nodes = sampled(SHAPES[0], &nodes_of(way, columns), &nodes_of(way, rows));
    let mut interpolation = (way.make)(columns, rows, &u, &[0.0, 1.0]);
    let mut points = vec![0.0; 3 * count * 2];
    interpolation.apply_interleaved(&nodes, &mut points);
    let x = |k: usize, axis: usize| f64::from(points[3 * k + axis]);
    let second = |k: usize| [0, 2].map(|axis| x(k + 1, axis) - 2.0 * x(k, axis) + x(k - 1, axis));
    let (mut most, mut jump) = (0.0f64, 0.0f64);
    // Over eight places, so that single precision does not show.
    let mean = |k: usize| {
        let mut sum = [0.0; 2];
        for place in k..k + 8 {
            let second = second(place);
            sum = [sum[0] + second[0] / 8.0, sum[1] + second[1] / 8.0];
        }
        sum
    };
    for k in 1..count - 17 {
        let (a, b) = (mean(k), mean(k + 8));
        most = most.max(a[0].hypot(a[1]));
        jump = jump.max((b[0] - a[0]).hypot(b[1] - a[1]));
    }
    jump / most
}

const HEADINGS: [&str; 11] = [
    "way",
    "µs a surface",
    "strain %: half turn",
    "three quarters",
    "cone",
    "place %: half turn",
    "three quarters",
    "cone",
    "overshoot %",
    "curvature jumps %",
    "differentiable",
];

impl Grid {
    fn table(&self) -> Table {
        let mut table = Table::new(&HEADINGS);
        let percent = |part: f64| format!("{:.3}", 100.0 * part);
        for way in &self.ways {
            let errors = || SHAPES.map(|(shape, _)| &way.shapes[shape]).into_iter();
            let mut row = vec![way.name.into(), format!("{:.2}", way.us_per_surface)];
            row.extend(errors().map(|errors| percent(errors.strain_error)));
            row.extend(errors().map(|errors| percent(errors.position_error)));
            row.extend([way.overshoot, way.curvature_jump].map(percent));
            row.push(way.differentiable.into());
            table.push(row);
        }
        table
    }
}

impl Display for Comparison {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        for grid in &self.grids {
            let ([columns, rows], [across, up]) = (grid.nodes, grid.points);
            writeln!(
                out,
                "From {columns} x {rows} nodes to {across} x {up} points\n"
            )?;
            grid.table().fmt(out)?;
            writeln!(out)?;
        }
        Ok(())
    }
}
