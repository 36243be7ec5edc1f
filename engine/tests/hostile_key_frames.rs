//! Key-frame files that state far more than they hold are rejected before anything
//! is allocated, and what is read takes memory in proportion.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use turnleaf_engine::{BitHash, Condensed, FrameKind, KeyFrameError, KeyFrames};

/// The system's allocator, counting what each thread holds, and held at most.
struct Counting;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

thread_local! {
    static HELD: Cell<isize> = const { Cell::new(0) };
    static MOST: Cell<isize> = const { Cell::new(0) };
}

fn count(bytes: isize) {
    HELD.with(|held| {
        held.set(held.get() + bytes);
        MOST.with(|most| most.set(most.get().max(held.get())));
    });
}

// SAFETY: every call goes to the system's allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        // SAFETY: as the caller promised.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        // SAFETY: as the caller promised.
        unsafe { System.dealloc(block, layout) }
    }
}

/// What work returns, and the bytes that it held at most.
fn held_at_most<T>(work: impl FnOnce() -> T) -> (T, usize) {
    let before = HELD.get();
    MOST.set(before);
    let result = work();
    (result, (MOST.get() - before) as usize)
}

/// A sealed file of version 2 with these counts, whose coefficients are `packed`.
fn file(columns: u32, rows: u32, frames: u32, packed: &[u8]) -> Vec<u8> {
    let mut bytes = b"TLKF\x02\x00\x01\x00".to_vec();
    bytes.extend([2u32, 0].iter().flat_map(|word| word.to_le_bytes()));
    bytes.extend([0.14f32, 0.21].iter().flat_map(|size| size.to_le_bytes()));
    bytes.extend([columns, rows, frames].iter().flat_map(|n| n.to_le_bytes()));
    bytes.extend([0.001f32, 0.0].iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend((packed.len() as u32).to_le_bytes());
    for count in [columns, rows] {
        for i in 0..count {
            bytes.extend((i as f32 / (count - 1) as f32).to_le_bytes());
        }
    }
    (0..frames).for_each(|i| bytes.extend((i as f32).to_le_bytes()));
    bytes.extend(packed);
    sealed(bytes)
}

fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    let mut hash = BitHash::new();
    hash.bytes(&bytes);
    bytes.extend(hash.value().to_le_bytes());
    bytes
}

#[test]
fn a_million_frames_of_nothing_take_memory_in_proportion() {
    let frames = 1 << 20;
    let bytes = file(2, 2, frames, &vec![0; 9 * frames as usize]);
    let (read, held) = held_at_most(|| KeyFrames::from_bytes(&bytes));
    assert_eq!(read.expect("a sound file").len(), frames as usize);
    // A point's position and its multiples are 12 bytes each; a frame's time is 4.
    let least = (2 * 12 * 4 + 4) * frames as usize;
    assert!(
        held < least + least / 2,
        "{held} bytes, and {least} at least"
    );
}

#[test]
fn more_frames_than_the_packed_bytes_hold_are_rejected_before_anything_is_allocated() {
    for (side, frames) in [(2, 1 << 20), (256, 64)] {
        let bytes = file(side, side, frames, &vec![0; 9 * frames as usize - 1]);
        let (read, held) = held_at_most(|| Condensed::from_bytes(&bytes));
        let error = read.expect_err("too short");
        assert!(
            matches!(error, KeyFrameError::BadPosition { .. }),
            "{error}"
        );
        assert!(held < 1000, "{held} bytes");
    }
}

#[test]
fn counts_beyond_the_bytes_are_rejected_before_anything_is_allocated() {
    let small = file(2, 2, 1, &[0; 9]);
    for version in [1u8, 2] {
        for at in [24, 28, 32, 44] {
            for count in [0, 3, 256, 4096, 1 << 20, 1 << 22, u32::MAX] {
                let mut bytes = small[..small.len() - 8].to_vec();
                bytes[4] = version;
                bytes[at..at + 4].copy_from_slice(&count.to_le_bytes());
                let bytes = sealed(bytes);
                let (read, held) = held_at_most(|| KeyFrames::from_bytes(&bytes));
                assert!(read.is_err(), "version {version}, {count} at {at}");
                assert!(
                    held < 1000,
                    "version {version}, {count} at {at}: {held} bytes"
                );
            }
        }
    }
}

/// A version 3 file of 2 x 2 points, and what it says of its mesh.
fn mesh_file(triangles: u32, packed_mesh: u32) -> Vec<u8> {
    let grid = file(2, 2, 1, &[0; 9]);
    let mut bytes = grid[..48].to_vec();
    bytes[4] = 3;
    bytes.extend(
        [triangles, packed_mesh]
            .iter()
            .flat_map(|n| n.to_le_bytes()),
    );
    bytes.extend(&grid[48..grid.len() - 8 - 9]);
    // Six runs of nothing: a grid's own mesh.
    bytes.extend([0; 17]);
    bytes.extend([0; 9]);
    sealed(bytes)
}

#[test]
fn a_mesh_beyond_its_points_or_bytes_is_rejected_before_anything_is_allocated() {
    let grid = Condensed::from_bytes(&mesh_file(2, 17)).expect("a sound file");
    let mesh = grid.mesh.expect("a mesh");
    assert_eq!(mesh.triangles, [[0, 1, 3], [0, 3, 2]]);
    assert_eq!(mesh.places[1], [1.0, 0.0]);
    for (triangles, packed) in [
        (0, 17),
        (3, 17),
        (u32::MAX, 17),
        (2, 16),
        (2, 18),
        (2, 0),
        (2, u32::MAX),
    ] {
        let bytes = mesh_file(triangles, packed);
        let (read, held) = held_at_most(|| KeyFrames::from_bytes(&bytes));
        assert!(read.is_err(), "{triangles} triangles in {packed} bytes");
        assert!(held < 2000, "{held} bytes");
    }
}

/// Xorshift (Marsaglia 2003).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) % bound
    }
}

/// The number in an environment variable, if there is one.
fn number_of(variable: &str) -> Option<u64> {
    let text = std::env::var(variable).ok()?;
    Some(text.parse().expect("a number"))
}

/// How many times as many rounds as usual a random test goes.
fn fuzz() -> u64 {
    number_of("TURNLEAF_FUZZ").unwrap_or(1)
}

/// Set `TURNLEAF_SEED` to play one seed again.
#[test]
fn random_files_are_rejected_in_one_sentence_or_hold_finite_numbers() {
    let fixture = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/corner.tlkf");
    let sound = std::fs::read(fixture).expect("a fixture");
    let seeds = match number_of("TURNLEAF_SEED") {
        Some(seed) => seed..=seed,
        None => 1u64..=5,
    };
    let (mut read, mut rejected) = (0, 0);
    for seed in seeds {
        println!("TURNLEAF_SEED={seed}");
        let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        for round in 0..200 * fuzz() {
            let bytes = if round % 2 == 0 {
                let mut side = || [2, 3, 9, 26, 256][random.below(5) as usize];
                let (columns, rows) = (side(), side());
                let most = if random.below(2) == 0 { 3 } else { 60 };
                let frames = 1 + random.below(most) as u32;
                // Mostly noughts, as noise seldom makes a run.
                let noughts = random.below(8);
                let packed: Vec<u8> = (0..random.below(4000))
                    .map(|_| {
                        if random.below(8) < noughts {
                            0
                        } else {
                            random.below(256) as u8
                        }
                    })
                    .collect();
                file(columns, rows, frames, &packed)
            } else {
                let mut changed = sound[..sound.len() - 8].to_vec();
                if random.below(8) == 0 {
                    changed.truncate(random.below(changed.len() as u64) as usize);
                }
                for _ in 0..random.below(6) {
                    if changed.is_empty() {
                        break;
                    }
                    let at = random.below(changed.len() as u64) as usize;
                    changed[at] = random.below(256) as u8;
                }
                sealed(changed)
            };
            match KeyFrames::from_bytes(&bytes) {
                Ok(frames) => {
                    assert!(frames.positions.iter().all(|value| value.is_finite()));
                    read += 1;
                }
                Err(error) => {
                    let sentence = error.to_string();
                    assert!(sentence.ends_with('.') && !sentence.contains('\n'));
                    rejected += 1;
                }
            }
        }
    }
    println!("{read} read, {rejected} rejected");
    assert!(read > 0 && rejected > 0);
}

/// Numbers by the generator of Numerical Recipes, which the viewer's tests have as well.
struct Congruential(u32);

impl Congruential {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        ((u64::from(self.0) * bound as u64) >> 32) as usize
    }
}

/// A sound file with some bytes changed, cut or added, mostly with a checksum that
/// fits. `mutated` in packages/turnleaf/src/key_frames/verdicts.test.ts is the same.
fn mutated(files: &[Vec<u8>], random: &mut Congruential) -> Vec<u8> {
    let mut bytes = files[random.below(files.len())].clone();
    let way = random.below(8);
    if way == 0 {
        bytes.truncate(random.below(bytes.len()));
    } else if way == 1 {
        for _ in 0..1 + random.below(16) {
            bytes.push(random.below(256) as u8);
        }
    }
    for _ in 0..random.below(4) {
        if bytes.is_empty() {
            break;
        }
        let within = if random.below(2) == 0 {
            64
        } else {
            bytes.len()
        };
        let at = random.below(within.min(bytes.len()));
        bytes[at] = match random.below(4) {
            0 => bytes[at] ^ (1 << random.below(8)),
            1 => 0,
            2 => 255,
            _ => random.below(256) as u8,
        };
    }
    if random.below(8) > 0 && bytes.len() >= 8 {
        bytes.truncate(bytes.len() - 8);
        bytes = sealed(bytes);
    }
    bytes
}

/// `UPDATE_GOLDEN=1` writes the verdicts anew; `TURNLEAF_VERDICTS` names a file
/// for those of another seed or of more rounds, for the viewer's test to read.
#[test]
fn mutated_files_get_the_verdicts_that_the_viewer_gives() {
    let fixtures = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures");
    let files = ["corner", "corner-whole", "recorded-in-script", "folded"]
        .map(|name| std::fs::read(format!("{fixtures}/{name}.tlkf")).expect("a fixture"));
    let seed = number_of("TURNLEAF_SEED").unwrap_or(1);
    println!("TURNLEAF_SEED={seed}");
    let mut random = Congruential(seed as u32);
    let verdicts: String = (0..2000 * fuzz())
        .map(|_| {
            let read = KeyFrames::from_bytes(&mutated(&files, &mut random));
            // Masses alone cannot be played without the engine.
            let plays = read.is_ok_and(|frames| frames.kind == FrameKind::Surface);
            if plays { '1' } else { '0' }
        })
        .collect();
    let golden = format!("{fixtures}/mutated.verdicts");
    if let Ok(path) = std::env::var("TURNLEAF_VERDICTS") {
        std::fs::write(path, verdicts).expect("a file to write");
    } else if std::env::var("UPDATE_GOLDEN").is_ok() {
        std::fs::write(golden, verdicts).expect("a file to write");
    } else if seed == 1 && fuzz() == 1 {
        let expected = std::fs::read_to_string(golden).expect("a fixture");
        assert!(verdicts == expected, "other verdicts than before");
    }
}
