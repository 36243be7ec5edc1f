//! The model against the paper's figures and against mechanics.

use super::*;
use crate::grid::Side;
use crate::random::{Random, for_seeds};
use crate::synchronise::Synchronise;

fn turn(settings: Settings, gesture: &str, seconds: f32, after: f32) -> (MassSpring, StrainRange) {
    let mut leaf = MassSpring::new(settings).unwrap();
    let gesture = leaf.settings().gesture(gesture, seconds).unwrap();
    leaf.play(gesture);
    let steps = ((seconds + after) / leaf.time_step()).round() as usize;
    let mut range = StrainRange::default();
    for _ in 0..steps {
        leaf.step();
        range = range.union(leaf.strain());
    }
    (leaf, range)
}

fn book() -> Settings {
    Settings::book(0.140, 0.210, 0.070)
}

/// The paper's sheet floating free of weight, drag and table, and not
/// synchronised: nothing but springs.
fn floating(integrator: Integrator, time_step: f32) -> Settings {
    Settings {
        masses: Masses::Equal {
            mass: 1.0,
            gravity: 0.0,
        },
        drag: 0.0,
        floor: false,
        synchronise: Synchronise::Off,
        integrator,
        time_step,
        ..Settings::paper_2014()
    }
}

/// Moves every node but the spine's by up to `amount` along each axis.
fn shake(leaf: &mut MassSpring, amount: f32, random: &mut Random) {
    for row in 0..leaf.grid.rows {
        for column in 1..leaf.grid.columns {
            let place = leaf.position(column, row);
            leaf.set_position(
                column,
                row,
                place.map(|x| x + random.between(-amount, amount)),
            );
        }
    }
}

// The paper's own sheet.

#[test]
fn six_by_six_nodes_have_158_springs() {
    assert_eq!(
        MassSpring::new(Settings::paper_2014())
            .unwrap()
            .spring_count(),
        158
    );
}

#[test]
fn the_paper_sheet_stretches_by_its_known_figures() {
    let (_, short) = turn(Settings::paper_2014(), "column", 11.4, 2.0);
    assert!((short.max - 1.00).abs() < 0.1, "{short:?}");
    let (_, long) = turn(Settings::paper_2014(), "column", 60.0, 2.0);
    assert!((long.max - 0.21).abs() < 0.03, "{long:?}");
    let (_, fast) = turn(Settings::paper_2014(), "column", 6.0, 2.0);
    assert!((fast.max - 2.17).abs() < 0.1, "{fast:?}");
}

#[test]
fn the_paper_sheet_turns_from_the_left_to_the_right() {
    let (leaf, _) = turn(Settings::paper_2014(), "column", 11.4, 60.0);
    assert_eq!(leaf.position(5, 0), [25.0, 0.0, 0.0]);
    assert_eq!(leaf.position(0, 5), [0.0, 25.0, 0.0]);
    let middle = leaf.position(3, 3);
    assert!(
        (middle[0] - 15.0).abs() < 1.5 && middle[2] < 3.0,
        "{middle:?}"
    );
}

#[test]
fn without_synchronisation_it_is_the_classic_model() {
    let settings = Settings {
        synchronise: Synchronise::Off,
        ..Settings::paper_2014()
    };
    let (leaf, range) = turn(settings, "column", 11.4, 2.0);
    assert!(leaf.is_finite() && range.max > 1.1, "{range:?}");
}

#[test]
fn provot_s_limit_shortens_what_is_too_long() {
    let limit = StrainLimit::Provot {
        limit: 0.1,
        passes: 30,
    };
    let settings = Settings {
        strain_limit: limit,
        ..Settings::paper_2014()
    };
    let (leaf, range) = turn(settings, "column", 11.4, 2.0);
    assert!(leaf.is_finite() && range.max < 0.15, "{range:?}");
}

#[test]
fn drawn_without_interpolation_the_surface_is_the_nodes() {
    let (mut leaf, _) = turn(Settings::paper_2014(), "corner", 4.0, 0.0);
    leaf.draw_nodes();
    let mut surface = Surface::new(2, 2);
    leaf.write_surface(&mut surface);
    let (mut nodes, mut velocities) = (vec![0.0; 108], vec![0.0; 108]);
    leaf.read_nodes(&mut nodes, &mut velocities);
    assert_eq!((surface.columns, surface.rows), (6, 6));
    assert_eq!(surface.positions, nodes);
}

// A page of a book.

#[test]
fn a_book_page_keeps_its_lengths_within_one_per_cent() {
    for gesture in ["column", "corner"] {
        let (leaf, range) = turn(book(), gesture, 0.8, 1.0);
        assert!(leaf.is_finite());
        assert!(
            range.max <= 0.01 && range.min >= -0.01,
            "{gesture}: {range:?}"
        );
    }
}

#[test]
fn a_book_page_lands_flat_and_still_on_the_other_side() {
    for gesture in ["column", "corner"] {
        let (leaf, _) = turn(book(), gesture, 0.8, 1.0);
        assert!(
            leaf.greatest_speed() < 0.03,
            "{gesture}: {}",
            leaf.greatest_speed()
        );
        for row in 0..6 {
            for column in 0..6 {
                let rest = [-0.028 * column as f32, 0.042 * row as f32, 0.0];
                let place = leaf.position(column, row);
                let off = (0..3)
                    .map(|axis| (place[axis] - rest[axis]).abs())
                    .fold(0.0, f32::max);
                assert!(off < 2e-3, "{gesture} {column} {row}: {place:?}");
            }
        }
    }
}

#[test]
fn a_book_page_bows_in_mid_turn() {
    let mut leaf = MassSpring::new(book()).unwrap();
    leaf.play(leaf.settings().column_gesture(0.8));
    (0..60).for_each(|_| leaf.step());
    let (root, middle, edge) = (
        leaf.position(0, 2),
        leaf.position(3, 2),
        leaf.position(5, 2),
    );
    // Distance of the middle from the straight line between root and edge.
    let (x, z) = (edge[0] - root[0], edge[2] - root[2]);
    let off = (middle[0] * z - middle[2] * x).abs() / (x * x + z * z).sqrt();
    assert!(off > 0.01 && off < 0.06, "{off}");
}

#[test]
fn the_head_lags_in_a_corner_turn() {
    let mut leaf = MassSpring::new(book()).unwrap();
    leaf.play(leaf.settings().corner_gesture(0.8));
    (0..48).for_each(|_| leaf.step());
    let (foot, head) = (leaf.position(5, 0), leaf.position(5, 5));
    assert!(head[0] > foot[0] + 0.03, "{foot:?} {head:?}");
}

#[test]
fn any_paper_of_any_size_stays_whole() {
    for (width, height) in [(0.10, 0.15), (0.21, 0.297), (0.30, 0.20)] {
        for grammage in [0.03, 0.07, 0.25] {
            for gesture in ["column", "corner"] {
                let (leaf, range) =
                    turn(Settings::book(width, height, grammage), gesture, 0.6, 0.5);
                assert!(leaf.is_finite());
                let worst = range.max.max(-range.min);
                assert!(
                    worst < 0.012,
                    "{width} x {height}, {grammage}, {gesture}: {worst}"
                );
            }
        }
    }
}

#[test]
fn wild_hands_neither_tear_nor_explode_a_page() {
    for_seeds(|random| {
        let mut leaf = MassSpring::new(book()).unwrap();
        let (column, row) = (3 + random.below(3), random.below(6));
        let mut place = leaf.position(column, row);
        for _ in 0..8 {
            let target = [
                random.between(-0.15, 0.15),
                random.between(0.0, 0.25),
                random.between(0.0, 0.15),
            ];
            for _ in 0..30 {
                let wanted = leaf.within_reach(column, row, target);
                let d = [0, 1, 2].map(|axis| wanted[axis] - place[axis]);
                let distance = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt().max(1e-9);
                let part = (2.5 * leaf.time_step() / distance).min(1.0);
                place = [0, 1, 2].map(|axis| place[axis] + part * d[axis]);
                leaf.hold(column, row, place);
                leaf.step();
                assert!(leaf.is_finite());
                let range = leaf.strain();
                assert!(range.max.max(-range.min) < 0.12, "{range:?}");
            }
        }
        leaf.release_all();
        (0..360).for_each(|_| leaf.step());
        assert!(leaf.strain().max < 0.01 && leaf.strain().min > -0.01);
    });
}

#[test]
fn a_hand_that_stays_within_reach_is_obeyed() {
    let mut leaf = MassSpring::new(book()).unwrap();
    let target = leaf.within_reach(5, 0, [0.5, 0.0, 0.03]);
    let start = leaf.position(5, 0);
    for k in 0..240 {
        let part = (k as f32 / 120.0).min(1.0);
        let place = [0, 1, 2].map(|axis| start[axis] + part * (target[axis] - start[axis]));
        leaf.hold(5, 0, place);
        leaf.step();
    }
    let place = leaf.position(5, 0);
    for axis in 0..3 {
        assert!(
            (place[axis] - target[axis]).abs() < 1e-3,
            "{place:?} {target:?}"
        );
    }
    assert!(leaf.is_held(5, 0));
    leaf.release(5, 0);
    assert!(!leaf.is_held(5, 0));
}

#[test]
fn a_falling_page_reaches_about_its_terminal_speed() {
    // Let go upright-ish, the free edge falls; air keeps it slower than free fall.
    let mut leaf = MassSpring::new(book()).unwrap();
    leaf.play(leaf.settings().column_gesture(1.0));
    (0..70).for_each(|_| leaf.step());
    leaf.release_all();
    let mut fastest = 0.0f32;
    for _ in 0..240 {
        leaf.step();
        fastest = fastest.max(leaf.greatest_speed());
    }
    assert!(fastest > 0.2 && fastest < 2.0, "{fastest}");
    assert!(leaf.position(3, 3)[2] < 0.01);
}

// Mechanics.

/// Random positions and velocities, and the forces that springs and bending
/// alone exert in them.
fn internal_forces(random: &mut Random) -> (MassSpring, [Vec<f32>; 3]) {
    let mut settings = floating(Integrator::SemiImplicitEuler, 0.01);
    settings.springs.damping = 0.3;
    settings.plate = Plate {
        u: 20.0,
        v: 10.0,
        twist: 5.0,
        loss: 0.0,
    };
    let mut leaf = MassSpring::new(settings).unwrap();
    shake(&mut leaf, 1.0, random);
    for row in 0..6 {
        for column in 1..6 {
            let velocity = [(); 3].map(|()| random.between(-1.0, 1.0));
            leaf.set_velocity(column, row, velocity);
        }
    }
    let mut force = leaf.grid.zeros3();
    let (position, velocity) = (&leaf.motion.position, &leaf.motion.velocity);
    leaf.forces.compute(position, velocity, &mut force);
    (leaf, force)
}

#[test]
fn internal_forces_carry_neither_momentum_nor_spin() {
    for_seeds(|random| {
        let (leaf, force) = internal_forces(random);
        let x = &leaf.motion.position;
        for axis in 0..3 {
            let (next, after) = ((axis + 1) % 3, (axis + 2) % 3);
            let (mut sum, mut turn, mut size) = (0.0f64, 0.0f64, 0.0f64);
            for lane in leaf.grid.node_lanes() {
                let of = |array: &[Vec<f32>; 3], axis: usize| f64::from(array[axis][lane]);
                sum += of(&force, axis);
                turn += of(x, next) * of(&force, after) - of(x, after) * of(&force, next);
                size += of(&force, axis).abs();
            }
            assert!(size > 10.0 && sum.abs() < 1e-4 * size, "{sum}");
            assert!(turn.abs() < 2e-3 * size, "{turn}");
        }
    });
}

#[test]
fn forces_are_the_slope_of_the_energy() {
    for_seeds(|random| {
        let (mut leaf, _) = internal_forces(random);
        leaf.motion
            .velocity
            .iter_mut()
            .for_each(|axis| axis.fill(0.0));
        let mut force = leaf.grid.zeros3();
        leaf.forces
            .compute(&leaf.motion.position, &leaf.motion.velocity, &mut force);
        for _ in 0..5 {
            let (column, row, axis) = (1 + random.below(5), random.below(6), random.below(3));
            let lane = leaf.grid.lane(column, row);
            let place = leaf.motion.position[axis][lane];
            let mut energy = |offset: f32| {
                leaf.motion.position[axis][lane] = place + offset;
                leaf.potential_energy()
            };
            let h = 1.0 / 256.0;
            let slope = (energy(h) - energy(-h)) / f64::from(2.0 * h);
            energy(0.0);
            let exact = -f64::from(force[axis][lane]);
            assert!(
                (slope - exact).abs() < 2e-3 * (1.0 + exact.abs()),
                "{slope} {exact}"
            );
        }
    });
}

#[test]
fn a_rolled_sheet_has_the_bending_energy_of_a_plate() {
    let stiffness = 3.0;
    let plate = Plate {
        u: stiffness,
        ..Plate::default()
    };
    let springs = Springs {
        structural: 0.0,
        shear: 0.0,
        bend: 0.0,
        damping: 0.0,
    };
    let settings = Settings {
        plate,
        springs,
        columns: 16,
        ..floating(Integrator::RungeKutta4, 0.01)
    };
    let mut leaf = MassSpring::new(settings).unwrap();
    let radius = 10.0f32;
    for row in 0..6 {
        for column in 0..16 {
            let angle = column as f32 / 15.0 * 25.0 / radius;
            let place = [
                radius * angle.sin(),
                row as f32 * 5.0,
                radius * (1.0 - angle.cos()),
            ];
            leaf.set_position(column, row, place);
        }
    }
    // Curvature acts on all but half a cell at either edge, which are straight.
    let area = 25.0 * 25.0 * 14.0 / 15.0;
    let exact = 0.5 * f64::from(stiffness) * area / f64::from(radius * radius);
    let found = leaf.potential_energy();
    assert!((found / exact - 1.0).abs() < 0.01, "{found} {exact}");
}

/// Energy after 200 s of a shaken floating sheet over that before.
fn energy_ratio(integrator: Integrator, time_step: f32) -> f64 {
    let mut leaf = MassSpring::new(floating(integrator, time_step)).unwrap();
    with_one_seed(|random| shake(&mut leaf, 0.3, random));
    let total = |leaf: &MassSpring| leaf.kinetic_energy() + leaf.potential_energy();
    let before = total(&leaf);
    for _ in 0..(200.0 / time_step) as usize {
        leaf.step();
    }
    total(&leaf) / before
}

/// One fixed seed, for what is no property of all.
fn with_one_seed(work: impl FnOnce(&mut Random)) {
    work(&mut Random::new(7));
}

#[test]
fn explicit_euler_gains_energy_and_the_others_keep_it() {
    let explicit = energy_ratio(Integrator::ExplicitEuler, 0.01);
    assert!(explicit > 3.0, "{explicit}");
    let semi_implicit = energy_ratio(Integrator::SemiImplicitEuler, 0.02);
    assert!((semi_implicit - 1.0).abs() < 0.05, "{semi_implicit}");
    let runge_kutta = energy_ratio(Integrator::RungeKutta4, 0.02);
    assert!((runge_kutta - 1.0).abs() < 1e-3, "{runge_kutta}");
}

#[test]
fn drag_takes_energy_at_every_step() {
    let settings = Settings {
        drag: 0.7125,
        ..floating(Integrator::SemiImplicitEuler, 0.01)
    };
    let mut leaf = MassSpring::new(settings).unwrap();
    with_one_seed(|random| shake(&mut leaf, 0.3, random));
    let mut before = f64::INFINITY;
    for _ in 0..400 {
        (0..10).for_each(|_| leaf.step());
        let energy = leaf.kinetic_energy() + leaf.potential_energy();
        assert!(energy <= before * 1.001, "{energy} {before}");
        before = energy;
    }
}

/// Positions after 2 s of a sheet that starts smoothly deformed.
fn after_two_seconds(integrator: Integrator, steps: usize) -> Vec<f32> {
    let mut leaf = MassSpring::new(floating(integrator, 2.0 / steps as f32)).unwrap();
    for row in 0..6 {
        for column in 1..6 {
            let [x, y, z] = leaf.position(column, row);
            let bump = 0.4 * (x * 0.2).sin() * (y * 0.15 + 0.3).cos();
            leaf.set_position(column, row, [x * 1.1, y + 0.3 * bump, z + bump]);
        }
    }
    (0..steps).for_each(|_| leaf.step());
    let (mut nodes, mut velocities) = (vec![0.0; 108], vec![0.0; 108]);
    leaf.read_nodes(&mut nodes, &mut velocities);
    nodes
}

#[test]
fn integrators_converge_at_their_orders() {
    let exact = after_two_seconds(Integrator::RungeKutta4, 200);
    let error = |integrator, steps| {
        let found = after_two_seconds(integrator, steps);
        found
            .iter()
            .zip(&exact)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f32::max)
    };
    for integrator in [Integrator::ExplicitEuler, Integrator::SemiImplicitEuler] {
        let order = (error(integrator, 200) / error(integrator, 400)).log2();
        assert!((order - 1.0).abs() < 0.15, "{integrator:?}: {order}");
    }
    let order = (error(Integrator::RungeKutta4, 5) / error(Integrator::RungeKutta4, 10)).log2();
    assert!((order - 4.0).abs() < 0.6, "{order}");
}

#[test]
fn wind_carries_a_sheet_that_is_dragged_along() {
    let settings = Settings {
        wind: [0.0, 0.0, 1.0],
        drag: 0.7125,
        ..floating(Integrator::SemiImplicitEuler, 0.02)
    };
    let mut leaf = MassSpring::new(settings).unwrap();
    (0..500).for_each(|_| leaf.step());
    assert!(leaf.position(5, 3)[2] > 1.0);
}

#[test]
fn the_table_holds() {
    let (leaf, _) = turn(Settings::paper_2014(), "column", 6.0, 4.0);
    assert!(leaf.motion.position[2].iter().all(|&z| z >= 0.0));
    let mut page = MassSpring::new(book()).unwrap();
    (0..240).for_each(|_| page.step());
    assert!(page.motion.position[2].iter().all(|&z| z.abs() < 1e-4));
}

#[test]
fn laid_flat_again_a_turn_repeats_its_bits() {
    let (mut leaf, _) = turn(book(), "corner", 0.8, 0.2);
    let first = leaf.position(4, 4);
    leaf.lay_flat(Side::Right);
    leaf.play(leaf.settings().corner_gesture(0.8));
    (0..120).for_each(|_| leaf.step());
    assert_eq!(leaf.position(4, 4), first);
}

#[test]
fn settings_that_make_no_leaf_are_rejected_in_one_sentence() {
    let rejected: [fn(&mut Settings); 8] = [
        |s| s.columns = 2,
        |s| s.rows = 17,
        |s| s.width = 0.0,
        |s| s.height = f32::NAN,
        |s| s.time_step = -1.0,
        |s| s.springs.shear = f32::INFINITY,
        |s| s.substeps = 0,
        |s| {
            s.masses = Masses::Equal {
                mass: 0.0,
                gravity: 1.0,
            }
        },
    ];
    for (index, change) in rejected.iter().enumerate() {
        let mut settings = Settings::paper_2014();
        change(&mut settings);
        let sentence = MassSpring::new(settings)
            .expect_err(&index.to_string())
            .to_string();
        assert!(
            sentence.ends_with('.') && !sentence.contains('\n'),
            "{sentence}"
        );
    }
}
