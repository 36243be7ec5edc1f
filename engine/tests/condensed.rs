//! A condensed turn is near its recording, the same bytes on every machine, and
//! nothing else is taken for one. Its fixtures are what the viewer's reader of key
//! frames is held to; `UPDATE_GOLDEN=1` writes them anew.

use std::f32::consts::PI;
use std::fs;
use std::path::PathBuf;

use turnleaf_engine::{
    BitHash, Blend, Condensed, FrameKind, Gesture, KeyFrameError, KeyFrames, LooseLeaf,
    LooseSettings, MassSpring, ModelKind, PaperMesh, Replay, Settings, Shape, Side, Stock, Surface,
    TurnModel, uniform_samples,
};

const PAGE: [f32; 2] = [0.14, 0.21];

fn fixture(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "tests/fixtures", name]
        .iter()
        .collect()
}

/// Turn of a leaf by its corner, every step of it.
fn recording(seconds: f32) -> KeyFrames {
    let mut leaf = MassSpring::new(Settings::book(PAGE[0], PAGE[1], 0.07)).unwrap();
    let even = uniform_samples(9);
    leaf.draw_samples(&even, &even);
    leaf.lay_flat(Side::Right);
    leaf.play(Gesture::corner(Side::Right, PAGE[0], seconds));
    let mut surface = Surface::new(9, 9);
    leaf.write_surface(&mut surface);
    let mut frames = KeyFrames::of_surface(ModelKind::MassSpring, PAGE, &surface);
    frames.take(0.0, &surface);
    for _ in 0..(seconds / leaf.time_step()).round() as usize {
        leaf.step();
        leaf.write_surface(&mut surface);
        frames.take(leaf.time(), &surface);
    }
    frames
}

fn condensed(tolerance: f32) -> (KeyFrames, Condensed) {
    let recording = recording(0.4);
    let even = uniform_samples(9);
    let condensed = Condensed::of(&recording, &even, &even, tolerance).unwrap();
    (recording, condensed)
}

/// A corner that is folded over in 0.4 s, at 60 Hz, and how what is drawn of it lies on the paper.
fn fold_recording() -> (KeyFrames, PaperMesh) {
    let page = PAGE.map(f64::from);
    let settings = LooseSettings {
        samples: [9, 9],
        ..LooseSettings::leaf(ModelKind::Sheet, page, Stock::BOOK)
    };
    let mut leaf = LooseLeaf::new(settings).unwrap();
    leaf.crease(&[([[0.5, 0.0], [1.0, 0.4]], 0.0)]).unwrap();
    let mut surface = Surface::new(9, 9);
    leaf.write_surface(&mut surface);
    let mut frames = KeyFrames::of_surface(ModelKind::Sheet, PAGE, &surface);
    frames.take(0.0, &surface);
    for frame in 1..=24 {
        leaf.press(0, frame as f32 / 24.0 * 2.6);
        leaf.advance(1.0 / 60.0);
        leaf.write_surface(&mut surface);
        frames.take(leaf.time(), &surface);
    }
    (frames, leaf.paper_mesh().unwrap())
}

fn condensed_fold() -> Condensed {
    let (frames, mesh) = fold_recording();
    let even = uniform_samples(9);
    let condensed = Condensed::of(&frames, &even, &even, 0.001).unwrap();
    condensed.with_mesh(&mesh).unwrap()
}

#[test]
fn a_fold_has_its_mesh_in_its_file() {
    let condensed = condensed_fold();
    let bytes = condensed.to_bytes();
    assert_eq!(bytes[4], 3);
    let read = Condensed::from_bytes(&bytes).unwrap();
    assert_eq!(read, condensed);
    assert_eq!(KeyFrames::from_bytes(&bytes).unwrap(), condensed.frames);
    let (_, mesh) = fold_recording();
    let kept = read.mesh.unwrap();
    assert_eq!(
        (&kept.triangles, &kept.parts),
        (&mesh.triangles, &mesh.parts)
    );
    for (a, b) in kept.places.iter().zip(&mesh.places) {
        assert!((0..2).all(|axis| (a[axis] - b[axis]).abs() < 1e-5));
    }
    let mut grid = condensed;
    grid.mesh = None;
    let more = bytes.len() - grid.to_bytes().len();
    println!("{} bytes, {more} of them the mesh", bytes.len());
    assert!(more < 1000, "{more} bytes");
}

#[test]
fn a_mesh_that_is_none_of_its_points_is_rejected() {
    let (frames, mesh) = fold_recording();
    let even = uniform_samples(9);
    let condensed = Condensed::of(&frames, &even, &even, 0.01).unwrap();
    let mut beyond = mesh.clone();
    beyond.triangles[5][1] = 81;
    let mut outside = mesh.clone();
    outside.places[3][0] = 1.1;
    let mut fewer = mesh.clone();
    fewer.places.pop();
    let mut none = mesh;
    none.triangles.clear();
    none.parts.clear();
    for bad in [beyond, outside, fewer, none] {
        let error = condensed.clone().with_mesh(&bad).unwrap_err();
        assert_eq!(error, KeyFrameError::BadMesh);
    }
}

/// How far a replay is at most from a recording, over the width.
fn error(recording: &KeyFrames, frames: KeyFrames) -> f32 {
    let replay = Replay::new(frames, Blend::Hermite, 1.0);
    let mut here = vec![0.0; recording.frame_length()];
    let mut rate = here.clone();
    let mut worst = 0.0f32;
    for (at, time) in recording.times.iter().enumerate() {
        replay.read_nodes_at(*time, &mut here, &mut rate);
        for (a, b) in here.chunks(3).zip(recording.frame(at).chunks(3)) {
            let square: f32 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
            worst = worst.max(square.sqrt());
        }
    }
    worst / recording.size[0]
}

#[test]
fn the_error_is_what_is_stated_and_within_the_tolerance() {
    let mut before = usize::MAX;
    for tolerance in [0.0003, 0.001, 0.01] {
        let (recording, condensed) = condensed(tolerance);
        let read = Condensed::from_bytes(&condensed.to_bytes()).unwrap();
        let found = error(&recording, read.frames.clone());
        assert!(read.error <= tolerance);
        assert!((found - read.error).abs() < 1e-6, "{found} {}", read.error);
        assert!(read.frames.len() < before && read.frames.len() > 3);
        before = read.frames.len();
    }
}

#[test]
fn bytes_and_back_are_the_same_and_plain_readers_read_them() {
    let (_, condensed) = condensed(0.001);
    let bytes = condensed.to_bytes();
    let read = Condensed::from_bytes(&bytes).unwrap();
    assert_eq!(read, condensed);
    assert_eq!(read.to_bytes(), bytes);
    assert_eq!(KeyFrames::from_bytes(&bytes).unwrap(), condensed.frames);
    assert_eq!(read.frames.kind, FrameKind::Surface);
    let whole = condensed.frames.to_bytes();
    assert!(bytes.len() * 8 < whole.len());
    let error = Condensed::from_bytes(&whole).unwrap_err();
    assert_eq!(
        error.to_string(),
        "The version of these key frames cannot be 1."
    );
}

#[test]
fn a_leaf_that_lies_still_is_two_frames_of_next_to_nothing() {
    let mut recording = recording(0.4);
    let first = recording.frame(0).to_vec();
    recording.positions = first.repeat(recording.len());
    let even = uniform_samples(9);
    let still = Condensed::of(&recording, &even, &even, 0.001).unwrap();
    assert_eq!(still.frames.len(), 2);
    assert!(still.to_bytes().len() < 200);
}

#[test]
fn crowded_columns_are_kept_as_they_lie() {
    let (recording, _) = condensed(0.001);
    let crowded: Vec<f32> = uniform_samples(9).iter().map(|u| u * u).collect();
    let even = uniform_samples(9);
    let condensed = Condensed::of(&recording, &crowded, &even, 0.001).unwrap();
    let read = Condensed::from_bytes(&condensed.to_bytes()).unwrap();
    assert_eq!((read.u, read.v), (crowded, even));
    assert!(read.error <= 0.001);
}

#[test]
fn what_cannot_be_condensed_is_rejected() {
    let recording = recording(0.1);
    let even = uniform_samples(9);
    let rejected =
        |u: &[f32], tolerance: f32| Condensed::of(&recording, u, &even, tolerance).unwrap_err();
    let mut backward = even.clone();
    backward.swap(3, 4);
    assert!(matches!(
        rejected(&backward, 0.001),
        KeyFrameError::BadHeader {
            field: "place of columns",
            ..
        }
    ));
    for tolerance in [1e-12, 1e8, f32::INFINITY] {
        assert!(matches!(
            rejected(&even, tolerance),
            KeyFrameError::BadHeader {
                field: "tolerance",
                ..
            }
        ));
    }
}

#[test]
fn every_truncation_and_every_flipped_byte_is_rejected() {
    for bytes in [condensed(0.01).1.to_bytes(), condensed_fold().to_bytes()] {
        reject_truncated_and_flipped(&bytes);
    }
}

fn reject_truncated_and_flipped(bytes: &[u8]) {
    for length in 0..bytes.len() {
        assert!(Condensed::from_bytes(&bytes[..length]).is_err(), "{length}");
    }
    for at in 0..bytes.len() {
        let mut flipped = bytes.to_vec();
        flipped[at] ^= 0x10;
        assert!(Condensed::from_bytes(&flipped).is_err(), "{at}");
    }
}

/// Changes whose checksum fits: rejected, or read as something that can be played.
#[test]
fn forged_files_never_panic_and_yield_finite_numbers() {
    forge(&condensed(0.01).1.to_bytes());
    forge(&condensed_fold().to_bytes());
}

fn forge(bytes: &[u8]) {
    let mut state = 1u64;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    let mut read = 0;
    for _ in 0..3000 {
        let mut forged = bytes[..bytes.len() - 8].to_vec();
        for _ in 0..1 + random(3) {
            // Most of them behind the header, which rejects nearly everything.
            let first = if random(4) == 0 { 4 } else { 36 };
            let at = first + random(forged.len() - first);
            forged[at] = random(256) as u8;
        }
        let mut hash = BitHash::new();
        hash.bytes(&forged);
        forged.extend(hash.value().to_le_bytes());
        if let Ok(condensed) = Condensed::from_bytes(&forged) {
            assert!(condensed.frames.positions.iter().all(|x| x.is_finite()));
            if let Some(mesh) = condensed.mesh {
                let points = condensed.u.len() * condensed.v.len();
                assert!(
                    mesh.triangles
                        .iter()
                        .flatten()
                        .all(|at| (*at as usize) < points)
                );
                assert!(
                    mesh.places
                        .iter()
                        .flatten()
                        .all(|at| (0.0..=1.0).contains(at))
                );
            }
            read += 1;
        }
    }
    assert!(read > 100, "{read}");
}

/// A file that the viewer's recorder wrote of a page that swings over and bends.
#[test]
fn what_a_script_recorded_is_read() {
    let bytes = fs::read(fixture("recorded-in-script.tlkf")).unwrap();
    let read = Condensed::from_bytes(&bytes).unwrap();
    assert_eq!(read.frames.model, ModelKind::Kinematic(Shape::Cone));
    assert_eq!((read.u.len(), read.v.len()), (26, 26));
    assert!(bytes.len() < 20_000 && read.error <= 0.001);
    let replay = Replay::new(read.frames, Blend::Hermite, 1.0);
    let (mut here, mut rate) = (vec![0.0; 2028], vec![0.0; 2028]);
    for step in 0..=96 {
        let time = step as f32 / 96.0;
        replay.read_nodes_at(0.8 * time, &mut here, &mut rate);
        for (at, point) in here.chunks(3).enumerate() {
            let [u, v] = [at % 26, at / 26].map(|place| place as f32 / 25.0);
            let bent = 0.5 * u * u * (PI * time).sin() * (1.0 - 0.3 * v);
            let (sin, cos) = (PI * time + bent).sin_cos();
            let apart = [0.14 * u * cos, 0.21 * v, 0.14 * u * sin];
            let apart: f32 = (0..3).map(|k| (apart[k] - point[k]).powi(2)).sum();
            assert!(apart.sqrt() <= 0.00101 * 0.14, "{step} {at}");
        }
    }
}

#[test]
fn the_fixtures_are_what_the_engine_writes_and_replays() {
    let (recording, condensed) = condensed(0.001);
    let replay = Replay::new(condensed.frames.clone(), Blend::Hermite, 1.0);
    let mut samples = String::from("[\n");
    let times = [-0.1, 0.0, 0.013, 0.1, 0.17, 0.2345, 0.31, 0.399, 0.4, 1.0];
    let (mut here, mut rate) = (
        vec![0.0; recording.frame_length()],
        vec![0.0; recording.frame_length()],
    );
    for (at, time) in times.into_iter().enumerate() {
        replay.read_nodes_at(time, &mut here, &mut rate);
        let end = if at + 1 < times.len() { "," } else { "" };
        samples += &format!("{{\"time\": {time:?}, \"positions\": {here:?}}}{end}\n");
    }
    samples += "]\n";
    let files = [
        ("corner.tlkf", condensed.to_bytes()),
        ("corner-whole.tlkf", recording.to_bytes()),
        ("corner.samples", samples.into_bytes()),
        ("folded.tlkf", condensed_fold().to_bytes()),
        ("folded-whole.tlkf", fold_recording().0.to_bytes()),
    ];
    for (name, bytes) in files {
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            fs::create_dir_all(fixture("")).unwrap();
            fs::write(fixture(name), &bytes).unwrap();
        }
        assert!(fs::read(fixture(name)).unwrap() == bytes, "{name}");
    }
}
