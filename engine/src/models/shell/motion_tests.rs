//! The potential of a step against differences, and the leaf in motion.

use super::motion::Stage;
use super::newton::Potential;
use super::vector::{Vector, advance, difference, dot, furthest, scale};
use super::*;
use crate::random::for_seeds;
use crate::stock::{GRAVITY, Grain, Stock};
use core::f64::consts::PI;

/// A small crumpled leaf on which everything acts at once.
fn busy(discretisation: Discretisation, jitter: &mut impl FnMut() -> f64) -> Shell {
    let mut shell = Shell::new(ShellSettings {
        discretisation,
        columns: 6,
        rows: 5,
        membrane: 10.0,
        table: Some(Table { friction: 0.5 }),
        ..ShellSettings::leaf(&Stock::BOOK, Grain::AlongSpine, 0.148, 0.210)
    })
    .unwrap();
    shell.grab(0.8, 0.3);
    shell.pull([0.1, 0.05, 0.03]);
    for node in 0..shell.x.len() {
        if !shell.system.held[node] {
            for axis in 0..3 {
                shell.x[node][axis] += 0.004 * jitter();
            }
            // Away from where the table begins to push.
            shell.x[node][2] += 1e-4 * shell.x[node][2].signum();
        }
    }
    shell
}

#[test]
fn derivatives_of_a_step_are_those_of_differences() {
    for_seeds(|random| {
        let mut jitter = || f64::from(random.between(-1.0, 1.0));
        for discretisation in [Discretisation::Grid, Discretisation::Triangles] {
            let mut shell = busy(discretisation, &mut jitter);
            let ways: Vec<Vector> = shell.x.iter().map(|_| [(); 3].map(|()| jitter())).collect();
            let free = |way: (&Vector, &bool)| if *way.1 { [0.0; 3] } else { *way.0 };
            let ways: Vec<Vector> = ways.iter().zip(&shell.system.held).map(free).collect();
            let from: Vec<Vector> = shell
                .x
                .iter()
                .zip(&ways)
                .map(|(x, w)| advance(*x, 1e-4 * (2.0 + jitter()), *w))
                .collect();
            shell.forces.bending.damp(0.3, &from, &shell.forces.clamps);
            let stage = Stage {
                span: 1e-3,
                aim: from
                    .iter()
                    .map(|x| advance(*x, 1e-3, [0.1, 0.2, -0.3]))
                    .collect(),
                from,
                air: shell.settings.air,
                areas: &shell.areas,
                normals: shell.mesh.normals(&shell.x),
                friction: vec![0.02; shell.x.len()],
                forces: &shell.forces,
            };
            let system = &mut shell.system;
            let moved = |h: f64| -> Vec<Vector> {
                shell
                    .x
                    .iter()
                    .zip(&ways)
                    .map(|(x, w)| advance(*x, h, *w))
                    .collect()
            };
            let mut gradient = |x: &[Vector]| {
                system.clear();
                stage.add_to(x, true, system);
                system.gradient()
            };
            let h = 1e-7;
            let slope = (stage.value(&moved(h)) - stage.value(&moved(-h))) / (2.0 * h);
            let exact: f64 = gradient(&shell.x)
                .iter()
                .zip(&ways)
                .map(|(g, w)| dot(*g, *w))
                .sum();
            let (more, less) = (gradient(&moved(h)), gradient(&moved(-h)));
            let bend: Vec<Vector> = more
                .iter()
                .zip(&less)
                .map(|(m, l)| scale(0.5 / h, difference(*m, *l)))
                .collect();
            gradient(&shell.x);
            assert!(system.factorise());
            let way = system.solve(&bend);
            let apart = furthest(&way, &ways);
            assert!((slope - exact).abs() < 1e-5 * exact.abs().max(1e-3));
            assert!(apart < 1e-7, "{apart}");
        }
    });
}

/// A page turned to the left by a hand in 0.8 s and let go, for 1.5 s: the places
/// of its nodes in the middle of it and at the end.
fn turned(discretisation: Discretisation) -> [Vec<Vector>; 2] {
    const STEPS: usize = 180;
    let mut shell = Shell::new(ShellSettings {
        discretisation,
        columns: 13,
        rows: 17,
        time_step: 1.0 / 120.0,
        table: Some(Table { friction: 0.5 }),
        ..ShellSettings::leaf(&Stock::BOOK, Grain::AlongSpine, 0.148, 0.210)
    })
    .unwrap();
    shell.grab(0.97, 0.06);
    let reach = 0.97 * 0.148;
    let mut middle = Vec::new();
    for step in 1..=STEPS {
        let part = step as f64 / 96.0;
        let eased = part.min(1.0) * part.min(1.0) * (3.0 - 2.0 * part.min(1.0));
        let angle = PI * eased;
        shell.pull([
            reach * libm::cos(angle),
            0.0126,
            0.8 * reach * libm::sin(angle),
        ]);
        shell.set_clamp_angle(PI * (part / 1.3).min(1.0));
        if part >= 1.0 {
            shell.release();
        }
        shell.step();
        let strain = shell.max_edge_strain();
        assert!(strain < 1e-3, "{discretisation:?}, step {step}: {strain}");
        if step == 60 {
            middle.clone_from(&shell.x);
        }
    }
    assert_eq!(shell.unsolved_steps(), 0);
    [middle, shell.x]
}

/// BDF2 remembers the fall, and threw it up again by centimetres.
#[test]
fn a_leaf_let_go_upright_slaps_down_and_stays_there() {
    let mut shell = Shell::new(ShellSettings {
        columns: 9,
        rows: 7,
        time_step: 1.0 / 240.0,
        table: Some(Table { friction: 0.5 }),
        ..ShellSettings::leaf(&Stock::BOOK, Grain::AlongSpine, 0.148, 0.210)
    })
    .unwrap();
    shell.grab(1.0, 0.5);
    for step in 1..=150 {
        let angle = 0.6 * PI * f64::from(step) / 150.0;
        shell.pull([0.14 * libm::cos(angle), 0.105, 0.14 * libm::sin(angle)]);
        shell.set_clamp_angle(angle);
        shell.step();
    }
    shell.release();
    let mut has_landed = false;
    for step in 0..240 {
        let angle = PI * (0.6 + 0.4 * (f64::from(step) / 72.0).min(1.0));
        shell.set_clamp_angle(angle);
        shell.step();
        let fore_edge = shell.x.chunks_exact(9).map(|row| row[8][2]);
        let highest = fore_edge.fold(0.0, f64::max);
        has_landed |= highest < 1e-3;
        assert!(!has_landed || highest < 2e-3, "step {step}: {highest} m");
    }
    assert!(has_landed);
}

#[test]
fn a_hand_turns_a_page_and_it_comes_to_lie_flat() {
    let [grid, triangles] = [Discretisation::Grid, Discretisation::Triangles].map(turned);
    let apart = furthest(&grid[0], &triangles[0]);
    println!("{apart:.1e} m apart in the middle of the turn");
    assert!(apart < 5e-3);
    for end in [&grid[1], &triangles[1]] {
        let flat = |(node, _): (usize, &Vector)| {
            [
                -0.148 * (node % 13) as f64 / 12.0,
                0.210 * (node / 13) as f64 / 16.0,
                0.0,
            ]
        };
        let flat: Vec<Vector> = end.iter().enumerate().map(flat).collect();
        assert!(furthest(end, &flat) < 1e-3, "{:e}", furthest(end, &flat));
    }
}

#[test]
fn a_sheet_falls_no_faster_than_its_terminal_speed() {
    let stock = &Stock::BOOK;
    let mut shell = Shell::new(ShellSettings {
        columns: 6,
        rows: 4,
        spine: Edge::Free,
        time_step: 0.01,
        ..ShellSettings::leaf(stock, Grain::AlongSpine, 0.148, 0.210)
    })
    .unwrap();
    for _ in 0..300 {
        shell.step();
    }
    let terminal = shell.settings.air.terminal_speed(stock.grammage);
    for v in &shell.v {
        assert!((v[2] / -terminal - 1.0).abs() < 1e-3, "{v:?}, {terminal}");
    }
}

/// A strip let go in the shape of its first mode, after part of that mode's
/// period, in `steps` steps of BDF2.
fn vibrated(part: f64, steps: usize, loss: f64) -> Shell {
    const ROOT: f64 = 1.875_104_068_7;
    let mut shell = Shell::new(ShellSettings {
        time_step: part * 2.0 * PI / (ROOT * ROOT) / steps as f64,
        loss,
        ..ShellSettings::strip(17, GRAVITY)
    })
    .unwrap();
    shell.set_gravity([0.0; 3]);
    let ratio = (libm::cosh(ROOT) + libm::cos(ROOT)) / (libm::sinh(ROOT) + libm::sin(ROOT));
    let shape = |at: f64| {
        let odd = ratio * (libm::sinh(at) - libm::sin(at));
        1e-3 * (libm::cosh(at) - libm::cos(at) - odd)
    };
    let du = shell.mesh.du;
    for row in 0..2 {
        for column in 1..17 {
            let last = shell.x[17 * row + column - 1];
            let z = shape(ROOT * column as f64 * du);
            let x = last[0] + (du * du - (z - last[2]) * (z - last[2])).sqrt();
            shell.x[17 * row + column] = [x, last[1], z];
        }
    }
    for _ in 0..steps {
        shell.step();
    }
    shell
}

#[test]
fn backward_differences_are_of_second_order_in_time() {
    let tip = |steps| vibrated(0.25, steps, 0.1).x[16][2];
    let tips = [50, 100, 200].map(tip);
    // Damped, so that the modes beyond the steps are soon gone.
    let order = ((tips[1] - tips[0]) / (tips[2] - tips[1])).log2();
    println!("order {order:.2}");
    assert!((order - 2.0).abs() < 0.2, "{order}");
}

#[test]
fn loss_takes_its_part_of_the_energy_of_a_swing() {
    let kept = |loss| vibrated(1.0, 1000, loss).energy().total();
    // A loss tangent t takes 2 pi t of the energy at hand.
    let part = kept(0.03) / kept(0.0);
    println!("{part}");
    assert!(
        (part / libm::exp(-2.0 * PI * 0.03) - 1.0).abs() < 0.03,
        "{part}"
    );
}

#[test]
fn a_hinge_gives_way_at_the_spine() {
    for discretisation in [Discretisation::Grid, Discretisation::Triangles] {
        let mut shell = Shell::new(ShellSettings {
            discretisation,
            spine: Edge::Hinged {
                angle: 0.0,
                stiffness: 2.0,
            },
            ..ShellSettings::strip(33, GRAVITY)
        })
        .unwrap();
        shell.set_gravity([0.0, 0.0, -1e-3]);
        shell.settle(1e-12).unwrap();
        // The bow of a beam, weight length^4 / 8 D, and the turn of the hinge by
        // the moment weight length^2 / 2 at it; D is 1.
        let drop = 1e-3 * (1.0 / 8.0 + 0.5 / 2.0);
        let own = -shell.x[32][2];
        assert!(
            (own / drop - 1.0).abs() < 0.002,
            "{discretisation:?}: {own} {drop}"
        );
    }
}
