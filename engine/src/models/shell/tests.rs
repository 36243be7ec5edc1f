//! The shell against the exact solutions, and its two discretisations against
//! each other.

use super::vector::{cross, difference, dot, furthest, length};
use super::*;
use crate::anchors::{creased_strips, rows};
use crate::rigidity::Rigidity;
use crate::stock::{GRAVITY, Grain, Stock};

const BOTH: [Discretisation; 2] = [Discretisation::Grid, Discretisation::Triangles];

fn strip(discretisation: Discretisation, columns: usize, gamma: f64) -> Shell {
    Shell::new(ShellSettings {
        discretisation,
        ..ShellSettings::strip(columns, gamma)
    })
    .unwrap()
}

/// Place of the foot corner at the fore-edge.
fn tip(shell: &Shell) -> Vector {
    shell.x[shell.mesh.columns - 1]
}

#[test]
fn a_cantilever_hangs_as_the_heavy_elastica() {
    let anchors = rows(include_str!("../../../tests/anchors/heavy_elastica.csv"));
    for discretisation in BOTH {
        let (mut worst, mut strain) = (0.0f64, 0.0f64);
        for anchor in anchors.iter().filter(|a| (0.1..=1000.0).contains(&a[0])) {
            let mut shell = strip(discretisation, 65, anchor[0]);
            shell.settle(1e-9).unwrap();
            let [x, _, z] = tip(&shell);
            let error = (x - anchor[1]).abs().max((z + anchor[2]).abs());
            worst = worst.max(error);
            strain = strain.max(shell.max_edge_strain());
            assert!(error < 0.002, "{discretisation:?} {}: {error}", anchor[0]);
        }
        println!("{discretisation:?}: worst {worst:.2e}, strain {strain:.1e}");
        assert!(strain < 1e-4);
    }
}

#[test]
fn a_cantilever_clamped_at_an_angle_hangs_as_the_elastica() {
    let anchors = rows(include_str!(
        "../../../tests/anchors/heavy_elastica_clamp_angle.csv"
    ));
    for discretisation in BOTH {
        let mut worst = 0.0f64;
        // Upright sheets have two equilibria, one for either side.
        for anchor in anchors.iter().filter(|a| a[1] < 90.0) {
            let mut shell = Shell::new(ShellSettings {
                discretisation,
                spine: Edge::Clamped {
                    angle: anchor[1].to_radians(),
                },
                ..ShellSettings::strip(65, anchor[0])
            })
            .unwrap();
            shell.settle(1e-9).unwrap();
            let [x, _, z] = tip(&shell);
            let error = (x - anchor[2]).abs().max((z - anchor[3]).abs());
            worst = worst.max(error);
            assert!(error < 0.005, "{discretisation:?} {anchor:?}: {error}");
        }
        println!("{discretisation:?}: worst {worst:.2e}");
    }
}

#[test]
fn a_tip_load_bends_a_strip_as_bisshopp_and_drucker_found() {
    let anchors = rows(include_str!("../../../tests/anchors/bisshopp_drucker.csv"));
    for discretisation in BOTH {
        let mut worst = 0.0f64;
        for anchor in &anchors {
            let mut shell = strip(discretisation, 65, 1.0);
            shell.set_gravity([0.0; 3]);
            let settings = shell.settings().clone();
            let load = anchor[0] * settings.rigidity.d11 * settings.height;
            let (columns, rows) = (settings.columns, settings.rows);
            for row in 0..rows {
                let node = row * columns + columns - 1;
                shell.loads_mut()[3 * node + 2] = -load / rows as f64;
            }
            shell.settle(1e-9).unwrap();
            let [x, _, z] = tip(&shell);
            let error = (x - (1.0 - anchor[3])).abs().max((z + anchor[2]).abs());
            worst = worst.max(error);
            assert!(error < 0.005, "{discretisation:?} {anchor:?}: {error}");
        }
        println!("{discretisation:?}: worst {worst:.2e}");
    }
}

#[test]
fn a_strip_with_its_ends_together_makes_a_pear_loop() {
    for discretisation in BOTH {
        let mut shell = Shell::new(ShellSettings {
            discretisation,
            fore_edge: Edge::Clamped { angle: 0.0 },
            gravity: [0.0; 3],
            ..ShellSettings::strip(65, 1.0)
        })
        .unwrap();
        for part in 1..=20 {
            let part = f64::from(part) / 20.0;
            let angle = part * core::f64::consts::FRAC_PI_2;
            shell.set_clamp_angle(angle);
            shell.hold_fore_edge(1.0 - part, 0.0, -angle);
            shell.settle(1e-9).unwrap();
        }
        let range = |axis: usize| {
            let of = shell.x.iter().map(|x| x[axis]);
            of.clone().fold(f64::MIN, f64::max) - of.fold(f64::MAX, f64::min)
        };
        let (height, width) = (range(2), range(0));
        let strain = shell.max_edge_strain();
        println!("{discretisation:?}: {height} {width}, strain {strain:.1e}");
        assert!(strain < 1e-3, "{strain}");
        assert!((height / 0.424308 - 1.0).abs() < 0.005, "{height}");
        assert!((width / 0.204214 - 1.0).abs() < 0.005, "{width}");
    }
}

/// A strip with one crease, folded to its rest angle.
fn creased(columns: usize, gamma: f64, crease: Crease) -> Shell {
    Shell::new(ShellSettings {
        discretisation: Discretisation::Triangles,
        creases: vec![crease],
        ..ShellSettings::strip(columns, gamma)
    })
    .unwrap()
}

#[test]
fn a_creased_strip_hangs_as_the_creased_elastica() {
    hang_creased_strips(5);
}

#[test]
#[ignore = "long: make test-long"]
fn every_creased_strip_hangs_as_the_creased_elastica() {
    hang_creased_strips(1);
}

/// Hangs one strip in so many, in the order of the table.
fn hang_creased_strips(one_in: usize) {
    let anchors = creased_strips();
    let (mut tips, mut tip_angles, mut crease_angles) = (0.0f64, 0.0f64, 0.0f64);
    for anchor in anchors.iter().step_by(one_in) {
        let &[
            gamma,
            at,
            rest,
            stiffness,
            reach,
            drop,
            tip_angle,
            crease_angle,
        ] = &anchor[..]
        else {
            panic!("{anchor:?}");
        };
        let d = ShellSettings::strip(65, gamma).rigidity.d11;
        let crease = Crease::elastic((64.0 * at) as usize, rest.to_radians(), stiffness * d);
        let mut shell = creased(65, gamma, crease);
        // The equilibrium that grows out of the weightless one.
        for part in 1..=20 {
            shell.set_gravity([0.0, 0.0, -GRAVITY * f64::from(part) / 20.0]);
            shell.settle(1e-9).unwrap();
        }
        let nodes = &shell.x[..65];
        let [end, before, third] = [64, 63, 62].map(|column| nodes[column]);
        let slope = [0, 2].map(|axis| 3.0 * end[axis] - 4.0 * before[axis] + third[axis]);
        let turned = libm::atan2(slope[1], slope[0]).to_degrees() - tip_angle;
        let off = (end[0] - reach).abs().max((end[2] + drop).abs());
        let tip_off = (turned - 360.0 * libm::round(turned / 360.0)).abs();
        let crease_off = (shell.crease_angle(0).unwrap().to_degrees() - crease_angle).abs();
        assert!(off < 0.002, "{anchor:?}: tip {off}");
        assert!(tip_off < 0.2, "{anchor:?}: tip {tip_off} degrees");
        assert!(crease_off < 0.2, "{anchor:?}: crease {crease_off} degrees");
        tips = tips.max(off);
        tip_angles = tip_angles.max(tip_off);
        crease_angles = crease_angles.max(crease_off);
    }
    println!("worst {tips:.1e}, {tip_angles:.3} and {crease_angles:.3} degrees");
}

#[test]
fn a_crease_without_stiffness_beside_the_paper_takes_all_of_the_turn() {
    let crease = Crease::elastic(16, 0.0, 1e-3);
    let mut shell = creased(33, 0.1, crease);
    shell.settle(1e-9).unwrap();
    let turned = shell.crease_angle(0).unwrap().to_degrees();
    assert!((turned + 90.0).abs() < 1.0, "{turned} degrees");
}

#[test]
fn settings_of_a_crease_that_is_none_are_rejected_each_by_its_error() {
    let wrong = |crease: Crease, discretisation| {
        let settings = ShellSettings {
            discretisation,
            creases: vec![crease],
            ..ShellSettings::strip(33, 1.0)
        };
        Shell::new(settings).unwrap_err().to_string()
    };
    let crease = Crease::elastic(16, 1.0, 1.0);
    let triangles = Discretisation::Triangles;
    let sentences = [
        wrong(crease, Discretisation::Grid),
        wrong(
            Crease {
                column: 0,
                ..crease
            },
            triangles,
        ),
        wrong(
            Crease {
                column: 32,
                ..crease
            },
            triangles,
        ),
        wrong(
            Crease {
                rest: 4.0,
                ..crease
            },
            triangles,
        ),
        wrong(
            Crease {
                rest: f64::NAN,
                ..crease
            },
            triangles,
        ),
        wrong(
            Crease {
                stiffness: 0.0,
                ..crease
            },
            triangles,
        ),
        wrong(
            Crease {
                yields: 0.0,
                ..crease
            },
            triangles,
        ),
        wrong(
            // From no yield.
            Crease {
                creep: 0.01,
                ..crease
            },
            triangles,
        ),
    ];
    for sentence in sentences {
        assert!(
            sentence.contains("crease") && sentence.ends_with('.'),
            "{sentence}"
        );
    }
}

/// The heaviness up to which a leaf of unit length and mass is stable, to 1e-4,
/// found by bisection within a fifth of `about`. `down` is the direction of
/// gravity.
fn critical(shell: &mut Shell, down: Vector, about: f64) -> f64 {
    let (mut low, mut high) = (about / 1.2, about * 1.2);
    while high - low > 1e-4 * high {
        let gamma = 0.5 * (low + high);
        shell.set_gravity(scale(gamma * shell.settings.rigidity.d11, down));
        shell.settle(1e-9).unwrap();
        if shell.is_stable() {
            low = gamma;
        } else {
            high = gamma;
        }
    }
    0.5 * (low + high)
}

#[test]
fn an_upright_strip_buckles_under_its_own_weight() {
    for discretisation in BOTH {
        let mut shell = Shell::new(ShellSettings {
            discretisation,
            spine: Edge::Clamped {
                angle: core::f64::consts::FRAC_PI_2,
            },
            ..ShellSettings::strip(33, 1.0)
        })
        .unwrap();
        let gamma = critical(&mut shell, [0.0, 0.0, -1.0], 7.837347);
        println!("{discretisation:?}: {gamma}");
        assert!((gamma / 7.837347 - 1.0).abs() < 0.005, "{gamma}");
    }
}

#[test]
fn a_plate_on_edge_buckles_sideways() {
    let anchors = rows(include_str!("../../../tests/anchors/lateral_buckling.csv"));
    for discretisation in BOTH {
        for anchor in anchors.iter().filter(|a| a[0] == 0.3) {
            let (nu, height) = (anchor[0], anchor[1]);
            let settings = ShellSettings {
                discretisation,
                rows: if height < 0.2 { 7 } else { 13 },
                height,
                rigidity: Rigidity::isotropic(1.0, nu),
                membrane: 1e6,
                ..ShellSettings::strip(25, 1.0)
            };
            let mut shell = Shell::new(settings).unwrap();
            let gamma = critical(&mut shell, [0.0, -1.0, 0.0], anchor[2]);
            println!("{discretisation:?} {anchor:?}: {gamma}");
            assert!((gamma / anchor[2] - 1.0).abs() < 0.01, "{gamma}");
        }
    }
}

#[test]
fn a_strip_vibrates_at_the_roots_of_a_beam() {
    for discretisation in BOTH {
        let mut shell = strip(discretisation, 65, GRAVITY);
        shell.set_gravity([0.0; 3]);
        let found = shell.frequencies(3).unwrap();
        let roots: Vec<f64> = found.iter().map(|rate| rate.sqrt()).collect();
        println!("{discretisation:?}: {roots:?}");
        for (root, exact) in roots.iter().zip([1.875104, 4.694091, 7.854757]) {
            assert!((root / exact - 1.0).abs() < 0.01, "{root} for {exact}");
        }
    }
}

#[test]
fn an_undamped_strip_keeps_its_energy() {
    for discretisation in BOTH {
        let period = 2.0 * core::f64::consts::PI / 3.516015;
        let mut shell = Shell::new(ShellSettings {
            discretisation,
            scheme: Scheme::ImplicitMidpoint,
            time_step: period / 100.0,
            ..ShellSettings::strip(33, GRAVITY)
        })
        .unwrap();
        shell.settle(1e-10).unwrap();
        shell.set_gravity([0.0; 3]);
        let start = shell.energy().total();
        let mut drift = 0.0f64;
        for _ in 0..1000 {
            shell.step();
            drift = drift.max((shell.energy().total() / start - 1.0).abs());
        }
        println!("{discretisation:?}: {drift:.1e}");
        assert!(drift < 0.01 && shell.unsolved_steps() == 0);
    }
}

#[test]
fn a_cantilever_converges_at_second_order() {
    for discretisation in BOTH {
        let error = |columns: usize| {
            let mut shell = strip(discretisation, columns, 10.0);
            shell.settle(1e-10).unwrap();
            let [x, _, z] = tip(&shell);
            ((x - 0.6563537612).powi(2) + (z + 0.7001997155).powi(2)).sqrt()
        };
        let errors = [9, 17, 33, 65].map(error);
        let orders: Vec<f64> = errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect();
        println!("{discretisation:?}: {errors:.5?}, orders {orders:.2?}");
        assert!(orders.iter().all(|order| *order > 1.8));
    }
}

/// A page whose corner a hand holds up.
fn held(discretisation: Discretisation, refine: usize) -> Shell {
    let mut shell = Shell::new(ShellSettings {
        discretisation,
        columns: 8 * refine + 1,
        rows: 12 * refine + 1,
        ..ShellSettings::leaf(&Stock::BOOK, Grain::AlongSpine, 0.148, 0.210)
    })
    .unwrap();
    shell.grab(1.0, 0.0);
    shell.pull([0.08, 0.03, 0.07]);
    shell.settle(1e-9).unwrap();
    shell
}

#[test]
fn both_discretisations_tend_to_the_same_developable_shape() {
    let (mut apart, mut defects) = (f64::INFINITY, [f64::INFINITY; 2]);
    for refine in [1, 2, 3] {
        let shells = BOTH.map(|d| held(d, refine));
        let distance = furthest(&shells[0].x, &shells[1].x);
        let now = shells.each_ref().map(angle_defect);
        println!("refined {refine}: {distance:.1e} m apart, defects {now:.5?}");
        assert!(distance < 0.7 * apart);
        assert!((0..2).all(|i| now[i] < 0.6 * defects[i]));
        assert!(shells.iter().all(|shell| shell.max_edge_strain() < 1e-3));
        (apart, defects) = (distance, now);
    }
}

/// Largest |2 pi - sum of the angles between the four edges| at an inner node.
fn angle_defect(shell: &Shell) -> f64 {
    let mesh = &shell.mesh;
    let between = |a: Vector, b: Vector| libm::atan2(length(cross(a, b)), dot(a, b));
    let mut worst = 0.0f64;
    for (column, row) in mesh.places() {
        if column == 0 || row == 0 || column + 1 == mesh.columns || row + 1 == mesh.rows {
            continue;
        }
        let here = mesh.node(column, row);
        let around = [here + 1, here + mesh.columns, here - 1, here - mesh.columns];
        let arms = around.map(|node| difference(shell.x[node], shell.x[here]));
        let sum: f64 = (0..4).map(|i| between(arms[i], arms[(i + 1) % 4])).sum();
        worst = worst.max((2.0 * core::f64::consts::PI - sum).abs());
    }
    worst
}
