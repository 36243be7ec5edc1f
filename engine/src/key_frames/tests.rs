//! The file format rejects what is not whole; a replay is what was recorded.

use super::*;
use crate::models::mass_spring::{MassSpring, Settings};
use crate::random::for_seeds;
use crate::surface::Surface;
use crate::turn::TurnModel;

fn record(
    settings: Settings,
    seconds: f32,
    kind: FrameKind,
    interval: f32,
) -> (MassSpring, KeyFrames) {
    let mut leaf = MassSpring::new(settings).unwrap();
    leaf.play(leaf.settings().column_gesture(seconds));
    let mut recorder = Recorder::new(&mut leaf, kind, interval);
    let steps = (seconds / leaf.time_step()).round() as usize;
    for _ in 0..steps {
        leaf.step();
        recorder.observe(&mut leaf);
    }
    let frames = recorder.finish(&mut leaf);
    (leaf, frames)
}

fn short_record() -> KeyFrames {
    record(Settings::paper_2014(), 0.5, FrameKind::Masses, 0.1).1
}

#[test]
fn a_turn_is_recorded_every_tenth_of_a_second() {
    let frames = record(
        Settings::paper_2014(),
        11.4,
        FrameKind::Masses,
        PAPER_INTERVAL,
    )
    .1;
    assert_eq!(frames.len(), 115);
    for (index, time) in frames.times.iter().enumerate() {
        assert!((time - 0.1 * index as f32).abs() < 1e-4);
    }
    assert_eq!(frames.frame_length(), 108);
    let drawn = record(
        Settings::paper_2014(),
        1.0,
        FrameKind::Surface,
        PAPER_INTERVAL,
    )
    .1;
    assert_eq!((drawn.len(), drawn.frame_length()), (11, 2028));
}

#[test]
fn bytes_and_back_are_the_same_bits() {
    for kind in [FrameKind::Masses, FrameKind::Surface] {
        let frames = record(Settings::book(0.14, 0.21, 0.07), 0.3, kind, 0.05).1;
        let bytes = frames.to_bytes();
        let read = KeyFrames::from_bytes(&bytes).unwrap();
        assert_eq!(read, frames);
        assert_eq!(read.to_bytes(), bytes);
    }
}

#[test]
fn every_truncation_and_any_addition_is_rejected() {
    let mut bytes = short_record().to_bytes();
    for length in 0..bytes.len() {
        assert!(KeyFrames::from_bytes(&bytes[..length]).is_err(), "{length}");
    }
    bytes.push(0);
    assert!(matches!(
        KeyFrames::from_bytes(&bytes),
        Err(KeyFrameError::WrongLength { .. })
    ));
}

#[test]
fn every_flipped_byte_is_rejected() {
    let bytes = short_record().to_bytes();
    for at in 0..bytes.len() {
        let mut flipped = bytes.clone();
        flipped[at] ^= 0x10;
        assert!(KeyFrames::from_bytes(&flipped).is_err(), "{at}");
    }
}

#[test]
fn noise_is_rejected_and_never_panics() {
    for_seeds(|random| {
        let mut bytes: Vec<u8> = (0..random.below(200))
            .map(|_| random.below(256) as u8)
            .collect();
        assert!(KeyFrames::from_bytes(&bytes).is_err());
        bytes.splice(0..0, *b"TLKF\x01\x00\x00\x00");
        assert!(KeyFrames::from_bytes(&bytes).is_err());
    });
}

#[test]
fn each_rejection_names_its_reason() {
    let good = short_record();
    let bytes = good.to_bytes();
    let with = |at: usize, value: &[u8]| {
        let mut bytes = bytes.clone();
        bytes[at..at + value.len()].copy_from_slice(value);
        KeyFrames::from_bytes(&bytes).unwrap_err()
    };
    assert_eq!(with(0, b"GLTF"), KeyFrameError::NotKeyFrames);
    assert_eq!(with(4, &[9, 0]), KeyFrameError::FutureVersion(9));
    let header = [
        (4, "version", 0u32),
        (6, "kind of frame", 7),
        (8, "model", 99),
        (12, "preset", 77),
        (16, "width", f32::NAN.to_bits()),
        (20, "height", (-1.0f32).to_bits()),
        (24, "number of columns", u32::MAX),
        (28, "number of rows", 1),
        (32, "number of frames", 0),
        (32, "number of frames", u32::MAX),
    ];
    for (at, name, value) in header {
        let bytes = value.to_le_bytes();
        let value = if at < 8 { &bytes[..2] } else { &bytes[..] };
        match with(at, value) {
            KeyFrameError::BadHeader { field, .. } => assert_eq!(field, name),
            other => panic!("{name}: {other:?}"),
        }
    }
    assert_eq!(with(100, &[1, 2, 3, 4]), KeyFrameError::Damaged);
    let broken = |change: fn(&mut KeyFrames)| {
        let mut frames = good.clone();
        change(&mut frames);
        KeyFrames::from_bytes(&frames.to_bytes()).unwrap_err()
    };
    let bad_position = KeyFrameError::BadPosition { frame: 2 };
    assert_eq!(
        broken(|frames| frames.positions[250] = f32::NAN),
        bad_position
    );
    assert_eq!(
        broken(|frames| frames.positions[250] = f32::INFINITY),
        bad_position
    );
    assert_eq!(
        broken(|frames| frames.times[3] = frames.times[2]),
        KeyFrameError::BadTime { frame: 3 }
    );
    assert_eq!(
        broken(|frames| frames.times[0] = f32::NAN),
        KeyFrameError::BadTime { frame: 0 }
    );
}

#[test]
fn rejections_are_one_sentence() {
    let all = [
        KeyFrameError::NotKeyFrames,
        KeyFrameError::FutureVersion(4),
        KeyFrameError::WrongLength {
            expected: 100,
            found: 7,
        },
        KeyFrameError::Damaged,
        KeyFrameError::BadMesh,
        KeyFrameError::BadHeader {
            field: "width",
            value: -1.0,
        },
        KeyFrameError::BadTime { frame: 3 },
        KeyFrameError::BadPosition { frame: 3 },
    ];
    for error in all {
        let sentence = error.to_string();
        assert!(
            sentence.ends_with('.') && !sentence.contains('\n'),
            "{sentence}"
        );
        assert_eq!(sentence.matches(". ").count(), 0, "{sentence}");
    }
}

/// Greatest distance of replayed masses from live ones over a turn, as part of
/// the leaf's width.
fn replay_error(seconds: f32, blend: Blend) -> f32 {
    let (leaf, frames) = record(
        Settings::paper_2014(),
        seconds,
        FrameKind::Masses,
        PAPER_INTERVAL,
    );
    let mut live = MassSpring::new(Settings::paper_2014()).unwrap();
    live.play(live.settings().column_gesture(seconds));
    let mut replay = Replay::new(frames, blend, leaf.time_step());
    let (mut a, mut b, mut rate) = (vec![0.0; 108], vec![0.0; 108], vec![0.0; 108]);
    let mut worst = 0.0f32;
    for _ in 0..(seconds / leaf.time_step()).round() as usize {
        live.step();
        replay.step();
        live.read_nodes(&mut a, &mut rate);
        replay.read_nodes(&mut b, &mut rate);
        worst = a
            .iter()
            .zip(&b)
            .map(|(a, b)| (a - b).abs())
            .fold(worst, f32::max);
    }
    worst / live.settings().width
}

#[test]
fn a_slow_turn_replays_nearly_exactly_by_either_blend() {
    assert!(replay_error(11.4, Blend::Linear) < 1e-3);
    assert!(replay_error(11.4, Blend::Hermite) < 1e-4);
}

#[test]
fn in_a_fast_turn_hermite_is_many_times_nearer_than_linear() {
    let (linear, hermite) = (
        replay_error(0.6, Blend::Linear),
        replay_error(0.6, Blend::Hermite),
    );
    assert!(linear > 0.05 && linear < 0.12, "{linear}");
    assert!(hermite < linear / 2.5, "{hermite} {linear}");
    assert!(replay_error(2.0, Blend::Hermite) < replay_error(2.0, Blend::Linear) / 15.0);
}

#[test]
fn at_its_key_frames_a_replay_has_the_recorded_bits() {
    let (leaf, frames) = record(Settings::paper_2014(), 1.0, FrameKind::Masses, 0.1);
    for blend in [Blend::Linear, Blend::Hermite] {
        let step = leaf.time_step();
        let mut replay = Replay::new(frames.clone(), blend, step);
        let (mut nodes, mut rate) = (vec![0.0; 108], vec![0.0; 108]);
        for count in 0..=60 {
            if let Some(frame) = frames.times.iter().position(|&time| time == replay.time()) {
                replay.read_nodes(&mut nodes, &mut rate);
                assert_eq!(nodes, frames.frame(frame), "{blend:?} {count}");
            }
            replay.step();
        }
    }
}

#[test]
fn surfaces_are_the_same_whichever_way_they_are_interpolated() {
    let (leaf, masses) = record(Settings::paper_2014(), 2.0, FrameKind::Masses, 0.1);
    let drawn = record(Settings::paper_2014(), 2.0, FrameKind::Surface, 0.1).1;
    for blend in [Blend::Linear, Blend::Hermite] {
        let step = leaf.time_step();
        let mut once = Replay::new(masses.clone(), blend, step);
        let mut each = Replay::new(masses.clone(), blend, step);
        each.interpolate_each_frame(true);
        let mut recorded = Replay::new(drawn.clone(), blend, step);
        let mut surfaces = [(); 3].map(|()| Surface::new(26, 26));
        for _ in 0..130 {
            for (replay, surface) in [&mut once, &mut each, &mut recorded]
                .into_iter()
                .zip(&mut surfaces)
            {
                replay.step();
                replay.write_surface(surface);
            }
            let [once, each, recorded] = &surfaces;
            for i in 0..once.positions.len() {
                assert!((once.positions[i] - each.positions[i]).abs() < 5e-5);
                assert_eq!(once.positions[i], recorded.positions[i]);
            }
        }
    }
}

#[test]
fn after_its_end_a_replay_stands_still_and_can_start_anew() {
    let mut replay = Replay::new(short_record(), Blend::Hermite, 1.0 / 60.0);
    let mut surface = Surface::new(26, 26);
    replay.write_surface(&mut surface);
    let first = surface.positions.clone();
    (0..100).for_each(|_| replay.step());
    let (mut nodes, mut rate) = (vec![0.0; 108], vec![1.0; 108]);
    replay.read_nodes(&mut nodes, &mut rate);
    assert_eq!(nodes, replay.frames().frame(replay.frames().len() - 1));
    assert!(rate.iter().all(|rate| *rate == 0.0));
    replay.rewind();
    replay.write_surface(&mut surface);
    assert_eq!(surface.positions, first);
}

#[test]
fn a_replay_that_is_caught_goes_on_live() {
    let settings = Settings::book(0.14, 0.21, 0.07);
    let (mut leaf, frames) = record(settings, 0.8, FrameKind::Masses, 0.05);
    let mut replay = Replay::new(frames, Blend::Hermite, leaf.time_step());
    (0..40).for_each(|_| replay.step());
    let (mut nodes, mut rate) = (vec![0.0; 108], vec![0.0; 108]);
    replay.read_nodes(&mut nodes, &mut rate);
    leaf.release_all();
    leaf.write_nodes(&nodes, &rate);
    assert!(leaf.greatest_speed() > 0.1);
    let before = leaf.position(5, 0);
    leaf.step();
    let after = leaf.position(5, 0);
    let moved = (0..3)
        .map(|axis| (after[axis] - before[axis]).abs())
        .fold(0.0, f32::max);
    assert!(moved > 1e-4 && moved < 0.02, "{moved}");
    assert!(leaf.strain().max < 0.01);
}

#[test]
fn a_file_says_its_model() {
    for &model in ModelKind::ALL {
        let mut frames = short_record();
        frames.model = model;
        assert_eq!(KeyFrames::from_bytes(&frames.to_bytes()).unwrap(), frames);
    }
}
