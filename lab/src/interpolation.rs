//! `lab interpolation`: the ways from few nodes to many points, the open problem
//! of the paper: what each costs, and what it makes of shapes that are known.
//!
//! The shapes are sheets of paper 148 x 210 mm: bent about an axis along the
//! spine through half a turn and through three quarters, and around a cone. None
//! is stretched, so every strain of the drawn mesh is the interpolation's, but
//! for that of straight edges over a curve, which is taken off.

use std::f64::consts::PI;
use std::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;

use serde_json::{Value, json};
use turnleaf_engine::{Cone, Interpolation, Surface, lobatto_nodes, uniform_samples};

use crate::options;
use crate::simulate::median;
use crate::specimen::{BREADTH, LENGTH};

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

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let (mut markdown, mut into) = (false, None);
    let json = options::read(parser, |option, parser| {
        match option {
            "markdown" => markdown = true,
            "into" => into = Some(PathBuf::from(options::text(parser, option)?)),
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    let grids: Vec<Value> = GRIDS
        .iter()
        .map(|&(nodes, points)| {
            let ways: Vec<Value> = WAYS.iter().map(|way| measure(way, nodes, points)).collect();
            json!({ "nodes": nodes, "points": points, "ways": ways })
        })
        .collect();
    let figures = json!({ "grids": grids });
    if let Some(path) = into {
        crate::report::insert(&path, "interpolation", &table(&figures, true))?;
    }
    if json {
        println!("{figures:#}");
    } else {
        print!("{}", table(&figures, markdown));
    }
    Ok(())
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

fn measure(way: &Way, [columns, rows]: [usize; 2], [across, up]: [usize; 2]) -> Value {
    let (at_u, at_v) = (nodes_of(way, columns), nodes_of(way, rows));
    let (u, v) = (uniform_samples(across), uniform_samples(up));
    let mut drawn = Surface::new(across, up);
    let mut exact = Surface::new(across, up);
    let mut interpolation = (way.make)(columns, rows, &u, &v);
    let mut shapes = serde_json::Map::new();
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
        shapes.insert(
            shape.0.into(),
            json!({ "position_error": away, "strain_error": strain }),
        );
    }
    json!({
        "name": way.name,
        "differentiable": way.continuity,
        "us_per_surface": cost(&mut interpolation, &sampled(SHAPES[0], &at_u, &at_v), &mut drawn),
        "overshoot": overshoot(way, columns, rows),
        "curvature_jump": curvature_jump(way, columns, rows),
        "shapes": shapes,
    })
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

fn table(figures: &Value, markdown: bool) -> String {
    let mut text = String::new();
    for grid in figures["grids"].as_array().into_iter().flatten() {
        let count = |of: &str, k: usize| grid[of][k].as_u64().unwrap_or(0);
        text.push_str(&format!(
            "From {} x {} nodes to {} x {} points\n\n",
            count("nodes", 0),
            count("nodes", 1),
            count("points", 0),
            count("points", 1)
        ));
        let mut rows = vec![HEADINGS.map(String::from).to_vec()];
        for way in grid["ways"].as_array().into_iter().flatten() {
            let part = |value: &Value| format!("{:.3}", 100.0 * value.as_f64().unwrap_or(f64::NAN));
            let mut row = vec![
                way["name"].as_str().unwrap_or_default().to_string(),
                format!("{:.2}", way["us_per_surface"].as_f64().unwrap_or(f64::NAN)),
            ];
            for figure in ["strain_error", "position_error"] {
                for (shape, _) in SHAPES {
                    row.push(part(&way["shapes"][shape][figure]));
                }
            }
            row.push(part(&way["overshoot"]));
            row.push(part(&way["curvature_jump"]));
            row.push(
                way["differentiable"]
                    .as_str()
                    .unwrap_or_default()
                    .to_string(),
            );
            rows.push(row);
        }
        text.push_str(&crate::report::table(&rows, markdown));
        text.push('\n');
    }
    text
}
