//! Every model, turned by the same grabs.

use super::*;
use crate::random::for_seeds;
use crate::stock::Stock;
use crate::synchronise::Synchronise;

const SIZE: [f64; 2] = [0.148, 0.21];

/// The settings of every model, a shell small enough to be quick.
fn all() -> Vec<LooseSettings> {
    let plain = |kind| LooseSettings::leaf(kind, SIZE, Stock::BOOK);
    let mut all: Vec<LooseSettings> = ModelKind::ALL.iter().copied().map(plain).collect();
    for settings in &mut all {
        if settings.kind == ModelKind::Shell {
            settings.nodes = Some([7, 5]);
            settings.time_step = Some(1.0 / 180.0);
        }
    }
    all.push(LooseSettings {
        preset: Preset::Book,
        interpolate: true,
        ..plain(ModelKind::MassSpring)
    });
    all.push(LooseSettings {
        synchronise: Synchronise::Columns,
        interpolate: true,
        ..plain(ModelKind::MassSpring)
    });
    all
}

fn drawn(leaf: &mut LooseLeaf) -> Surface {
    let mut surface = Surface::new(2, 2);
    leaf.write_surface(&mut surface);
    surface
}

#[test]
fn every_model_turns_from_either_side_to_the_other() {
    for settings in all() {
        for by in TurnBy::ALL {
            for from in [Side::Right, Side::Left] {
                let mut leaf = LooseLeaf::new(settings.clone()).unwrap();
                leaf.play(by, from, 1.2);
                let start = drawn(&mut leaf);
                let (columns, rows) = (start.columns, start.rows);
                let x = start.position(columns - 1, rows / 2)[0] * from.sign();
                assert!((x - SIZE[0] as f32).abs() < 1e-6, "{:?}", settings.kind);
                leaf.advance(2.4);
                assert!(!leaf.is_playing());
                let end = drawn(&mut leaf);
                let [x, _, z] = end.position(columns - 1, rows / 2);
                let across = -x * from.sign();
                // Let go by its corner, the paper's leaf floats: its drag holds it up.
                let floats = settings.kind == ModelKind::MassSpring
                    && settings.preset == Preset::Paper2014
                    && by != TurnBy::Edge;
                assert!(
                    floats || across > 0.75 * SIZE[0] as f32 && z < 0.04,
                    "{:?} {:?} {by:?} {from:?} {across} {z}",
                    settings.kind,
                    settings.preset
                );
                for row in 0..rows {
                    let [x, y, z] = end.position(0, row);
                    let rest = row as f32 / (rows - 1) as f32 * SIZE[1] as f32;
                    assert!(x.abs() < 1e-5 && (y - rest).abs() < 1e-5 && z.abs() < 1e-5);
                }
            }
        }
    }
}

#[test]
fn wild_hands_leave_every_number_finite() {
    for settings in all() {
        if settings.kind == ModelKind::Shell {
            continue;
        }
        for_seeds(|random| {
            let mut leaf = LooseLeaf::new(settings.clone()).unwrap();
            for _ in 0..60 {
                match random.below(8) {
                    0 => leaf.grab(random.between(-0.2, 1.2), random.between(-0.2, 1.2)),
                    1 => leaf.release(),
                    2 => leaf.play(TurnBy::Corner, Side::Left, 0.4),
                    3 => leaf.pull([f32::NAN; 3]),
                    _ => leaf.pull(core::array::from_fn(|_| random.between(-0.4, 0.4))),
                }
                leaf.advance(1.0 / 60.0);
                let surface = drawn(&mut leaf);
                assert!(surface.positions.iter().all(|x| x.is_finite()));
                let energies = leaf.energies();
                assert!((energies.kinetic + energies.bending + energies.gravity).is_finite());
            }
        });
    }
}

#[test]
fn a_record_holds_what_was_drawn() {
    let mut leaf =
        LooseLeaf::new(LooseSettings::leaf(ModelKind::Sheet, SIZE, Stock::BOOK)).unwrap();
    leaf.play(TurnBy::Corner, Side::Right, 0.5);
    leaf.record(0.05);
    leaf.advance(0.5);
    let now = drawn(&mut leaf);
    let frames = leaf.finish_record().unwrap();
    assert_eq!((frames.len(), frames.model), (11, ModelKind::Sheet));
    assert_eq!(frames.frame(10), &now.positions[..]);
    assert!((frames.times[10] - 0.5).abs() < 1e-5);
    assert!(leaf.finish_record().is_none());
}

#[test]
fn a_leaf_is_drawn_where_it_is_asked_to_be() {
    let (u, v) = ([0.0, 0.1, 0.7, 1.0], [0.0, 0.4, 1.0]);
    for settings in all() {
        let mut leaf = LooseLeaf::new(settings.clone()).unwrap();
        leaf.draw_samples(&u, &v).unwrap();
        let surface = drawn(&mut leaf);
        if settings.kind != ModelKind::MassSpring || settings.interpolate {
            assert_eq!((surface.columns, surface.rows), (4, 3));
            let [x, y, _] = surface.position(2, 1);
            assert!((f64::from(x) - 0.7 * SIZE[0]).abs() < 1e-6);
            assert!((f64::from(y) - 0.4 * SIZE[1]).abs() < 1e-6);
        }
        for bad in [&[0.0][..], &[0.5, 0.5], &[0.0, 1.5], &[f32::NAN, 1.0]] {
            assert!(leaf.draw_samples(bad, &v).is_err());
        }
    }
}

#[test]
fn a_flat_leaf_has_no_energy_and_no_strain() {
    for settings in all() {
        let leaf = LooseLeaf::new(settings).unwrap();
        let energies = leaf.energies();
        assert!(energies.kinetic == 0.0 && energies.gravity.abs() < 1e-12);
        assert!(energies.bending < 1e-9, "{energies:?}");
        let strain = leaf.strain();
        assert!(strain.max < 1e-4 && strain.min > -1e-4);
    }
}

#[test]
fn settings_that_make_no_leaf_are_rejected_in_one_sentence() {
    for settings in all() {
        for bad in [
            LooseSettings {
                size: [0.0, 0.2],
                ..settings.clone()
            },
            LooseSettings {
                size: [0.1, f64::NAN],
                ..settings.clone()
            },
            LooseSettings {
                samples: [1, 5],
                ..settings.clone()
            },
            LooseSettings {
                air: -1.0,
                ..settings.clone()
            },
            LooseSettings {
                time_step: Some(-1.0),
                ..settings.clone()
            },
        ] {
            let sentence = LooseLeaf::new(bad).unwrap_err().to_string();
            assert!(
                sentence.ends_with('.') && !sentence.contains('\n'),
                "{sentence}"
            );
        }
    }
}
