//! What each shape promises: lengths kept, the spine kept, flat at both ends, the
//! hand followed.

use super::shapes::{Cone, Cylinder, Peel};
use super::*;
use crate::random::{Random, for_seeds};
use crate::stock::Stock;

const SIZE: [f64; 2] = [0.148, 0.21];

fn leaf(shape: Shape) -> Kinematic {
    Kinematic::new(KinematicSettings::leaf(
        shape,
        SIZE[0],
        SIZE[1],
        Stock::BOOK,
    ))
    .unwrap()
}

fn gestures(from: Side) -> [Gesture; 3] {
    let width = SIZE[0] as f32;
    let pulled = |gesture: Gesture| Gesture {
        pull: 0.12,
        ..gesture
    };
    [
        pulled(Gesture::column(from, width, 0.8)),
        pulled(Gesture::corner(from, width, 0.8)),
        Gesture {
            grip: Grip::FootCorner,
            rise: 0.02,
            ..pulled(Gesture::column(from, width, 0.8))
        },
    ]
}

fn surface(leaf: &mut Kinematic) -> Surface {
    let mut surface = Surface::new(2, 2);
    leaf.write_surface(&mut surface);
    surface
}

/// Greatest departure of the first fundamental form from that of the flat leaf,
/// by differences of the fourth order, where the pose is smooth.
fn stretch(pose: &Pose, at: [f64; 2]) -> f64 {
    let h = 2e-4;
    let tangent = |axis: usize| -> [f64; 3] {
        let at = |step: f64| {
            let mut place = at;
            place[axis] += step;
            pose.place(place)
        };
        let (a, b, c, d) = (at(-2.0 * h), at(-h), at(h), at(2.0 * h));
        core::array::from_fn(|k| (a[k] - d[k] + 8.0 * (c[k] - b[k])) / (12.0 * h))
    };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (u, v) = (tangent(0), tangent(1));
    let form = [dot(u, u) - 1.0, dot(v, v) - 1.0, dot(u, v)];
    form.into_iter().map(f64::abs).fold(0.0, f64::max)
}

fn inner(random: &mut Random) -> [f64; 2] {
    SIZE.map(|size| f64::from(random.between(0.01, 0.99)) * size)
}

#[test]
fn a_cone_keeps_all_lengths() {
    for_seeds(|random| {
        for _ in 0..50 {
            let apex = f64::from(random.between(0.07, 2.0));
            let least = libm::atan2(SIZE[0], apex) / (1.5 * PI);
            let half_angle = libm::asin(least) + f64::from(random.between(0.0, 0.6));
            let cone = Cone::of(apex, half_angle, f64::from(random.between(0.0, 3.0)));
            let found = stretch(&Pose::Cone(cone), inner(random));
            assert!(found < 1e-9, "{cone:?} {found:e}");
        }
    });
}

#[test]
fn a_cone_led_anywhere_keeps_all_lengths_and_the_spine() {
    for_seeds(|random| {
        for _ in 0..40 {
            let place = [SIZE[0], f64::from(random.between(0.0, 1.0)) * SIZE[1]];
            let at: [f64; 3] = core::array::from_fn(|_| f64::from(random.between(-0.3, 0.3)));
            let cone = Cone::toward(SIZE, place, at, None);
            let found = stretch(&Pose::Cone(cone), inner(random));
            assert!(found < 1e-9, "{cone:?} {found:e}");
            for y in [0.0, 0.1, SIZE[1]] {
                let [x, along, z] = cone.place([0.0, y]);
                assert!(x.abs() < 1e-12 && z.abs() < 1e-12 && (along - y).abs() < 1e-12);
            }
        }
    });
}

#[test]
fn a_roll_keeps_lengths_on_it_and_beside_it() {
    for_seeds(|random| {
        for _ in 0..50 {
            let angle = f64::from(random.between(-0.8, 0.8));
            let normal = [libm::cos(angle), libm::sin(angle)];
            let (line, radius) = (0.05, f64::from(random.between(0.02, 0.04)));
            let pose = Pose::Cylinder(Cylinder::of(normal, line, radius));
            let at = inner(random);
            let beyond = normal[0] * at[0] + normal[1] * at[1] - line;
            let edge = beyond.abs().min((beyond - PI * radius).abs());
            if edge > 1e-3 {
                assert!(stretch(&pose, at) < 1e-9);
            }
        }
    });
}

#[test]
fn a_roll_and_a_fold_bring_the_place_to_the_hand_where_the_spine_lets_them() {
    for_seeds(|random| {
        for _ in 0..50 {
            let place = [SIZE[0], f64::from(random.between(0.0, 0.3)) * SIZE[1]];
            let at = [
                f64::from(random.between(0.02, 0.9)) * SIZE[0],
                place[1] + f64::from(random.between(-0.01, 0.01)),
                f64::from(random.between(0.0, 0.02)),
            ];
            if at[0] + 2.0 * at[2] > SIZE[0] - 0.02 {
                continue;
            }
            let near = |found: [f64; 3], wanted: [f64; 3]| {
                (0..3).all(|axis| (found[axis] - wanted[axis]).abs() < 1e-9)
            };
            let roll = Cylinder::toward(SIZE, place, at);
            assert!(
                near(roll.place(place), at),
                "{at:?} {:?}",
                roll.place(place)
            );
            let fold = Peel::toward(SIZE, place, [at[0], at[1]]);
            let found = fold.place(place);
            assert!(near([found[0], found[1], 0.0], [at[0], at[1], 0.0]));
        }
    });
}

#[test]
fn a_cone_brings_the_corner_to_the_hand_over_the_page() {
    let corner = [SIZE[0], 0.0];
    for angle in [1.2, 1.5, 1.9, 2.4] {
        for (part, rise) in [(0.93, 0.002), (0.85, 0.006), (0.8, -0.004)] {
            let reach = part * SIZE[0];
            let at = [reach * libm::cos(angle), rise, reach * libm::sin(angle)];
            let found = Cone::toward(SIZE, corner, at, None).place(corner);
            let away = (0..3)
                .map(|axis| (found[axis] - at[axis]).powi(2))
                .sum::<f64>();
            assert!(away.sqrt() < 1e-6, "{at:?} {found:?}");
        }
    }
}

#[test]
fn timed_turns_begin_and_end_flat_and_never_leave_the_spine_or_pierce_the_table() {
    for &shape in Shape::ALL {
        for from in [Side::Left, Side::Right] {
            for gesture in gestures(from) {
                let mut leaf = leaf(shape);
                leaf.play(gesture);
                for step in 0..=120 {
                    let drawn = surface(&mut leaf);
                    let flat = match step {
                        0 => Some(from.sign()),
                        100.. => Some(-from.sign()),
                        _ => None,
                    };
                    for row in 0..26 {
                        let y = row as f32 / 25.0 * SIZE[1] as f32;
                        let spine = drawn.position(0, row);
                        assert!(spine[0].abs() < 1e-6 && (spine[1] - y).abs() < 1e-6);
                        for column in 0..26 {
                            let [x, along, z] = drawn.position(column, row);
                            assert!(z > -1e-6, "{shape:?} {step} {z}");
                            if let Some(sign) = flat {
                                let at = sign * column as f32 / 25.0 * SIZE[0] as f32;
                                assert!((x - at).abs() < 1e-6, "{shape:?} {step}");
                                assert!((along - y).abs() < 1e-6 && z < 1e-6);
                            }
                        }
                    }
                    leaf.step();
                }
                assert_eq!(leaf.resting(), Some(from.opposite()));
            }
        }
    }
}

#[test]
fn a_turn_from_the_left_is_the_mirror_image_of_one_from_the_right() {
    for &shape in Shape::ALL {
        for (right, left) in gestures(Side::Right).into_iter().zip(gestures(Side::Left)) {
            let mut leaves = [leaf(shape), leaf(shape)];
            leaves[0].play(right);
            leaves[1].play(left);
            for _ in 0..50 {
                let [a, b] = leaves.each_mut().map(|leaf| {
                    leaf.step();
                    surface(leaf)
                });
                let (a, b) = (
                    a.positions.as_chunks::<3>().0,
                    b.positions.as_chunks::<3>().0,
                );
                for (a, b) in a.iter().zip(b) {
                    assert!((a[0] + b[0]).abs() < 1e-7 && a[1] == b[1] && a[2] == b[2]);
                }
            }
        }
    }
}

#[test]
fn a_leaf_let_go_comes_to_rest_on_the_side_its_swing_takes_it_to() {
    for &shape in Shape::ALL {
        for (until, side) in [(30, Side::Right), (48, Side::Left)] {
            let mut leaf = leaf(shape);
            leaf.play(gestures(Side::Right)[1]);
            (0..until).for_each(|_| leaf.step());
            if side == Side::Right {
                // Held still for a while, it has no swing.
                leaf.grab(1.0, 0.0);
                (0..3).for_each(|_| leaf.step());
            }
            leaf.release();
            (0..600).for_each(|_| leaf.step());
            assert_eq!(leaf.resting(), Some(side), "{shape:?}");
        }
    }
}

#[test]
fn a_new_hand_in_the_middle_of_a_turn_does_not_make_the_leaf_jump() {
    for &shape in Shape::ALL {
        let mut leaf = leaf(shape);
        leaf.play(gestures(Side::Right)[0]);
        (0..40).for_each(|_| leaf.step());
        let before = surface(&mut leaf);
        leaf.grab(0.6, 0.8);
        leaf.step();
        let after = surface(&mut leaf);
        let most = before
            .positions
            .iter()
            .zip(&after.positions)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f32::max);
        assert!(most < 1e-5, "{shape:?} {most}");
    }
}

#[test]
fn wild_hands_leave_every_leaf_whole() {
    for_seeds(|random| {
        for &shape in Shape::ALL {
            let mut leaf = leaf(shape);
            for step in 0..300 {
                match random.below(12) {
                    0 => leaf.grab(random.between(-0.2, 1.2), random.between(-0.2, 1.2)),
                    1 => leaf.release(),
                    2 => leaf.play(gestures(Side::Left)[random.below(3)]),
                    3 => leaf.pull([f32::NAN, 0.0, f32::INFINITY]),
                    4 => leaf.pull([1e30, -1e30, 1e30]),
                    5 => leaf.pull([0.0; 3]),
                    _ => leaf.pull(core::array::from_fn(|_| random.between(-0.4, 0.4))),
                }
                leaf.step();
                let drawn = surface(&mut leaf);
                for (index, point) in drawn.positions.as_chunks::<3>().0.iter().enumerate() {
                    let near = point.iter().all(|x| x.abs() < 0.6);
                    assert!(near, "{shape:?} {step} {index} {point:?}");
                    assert!(point[2] > -1e-5, "{shape:?} {step} {index} {point:?}");
                }
                let mut nodes = vec![0.0; drawn.positions.len()];
                let mut speeds = nodes.clone();
                leaf.read_nodes(&mut nodes, &mut speeds);
                assert_eq!(nodes, drawn.positions);
                assert!(speeds.iter().all(|v| v.is_finite()));
            }
        }
    });
}

#[test]
fn settings_that_make_no_leaf_are_rejected_in_one_sentence() {
    let good = KinematicSettings::leaf(Shape::Cone, 0.1, 0.2, Stock::BOOK);
    for bad in [
        KinematicSettings {
            width: 0.0,
            ..good.clone()
        },
        KinematicSettings {
            height: f64::NAN,
            ..good.clone()
        },
        KinematicSettings {
            time_step: -1.0,
            ..good.clone()
        },
        KinematicSettings { rows: 1, ..good },
    ] {
        let sentence = Kinematic::new(bad).unwrap_err().to_string();
        assert!(
            sentence.ends_with('.') && !sentence.contains('\n'),
            "{sentence}"
        );
    }
}
