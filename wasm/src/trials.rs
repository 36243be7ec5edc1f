//! Exports for the WASM benchmarks and for the golden test: leaves in mid-turn, a
//! hanging page, and hashes of whole turns. No book uses them. Handles and numbers
//! that are none are rejected as those of a book are; a count is at most a million.

use turnleaf_engine::trials::{creased, frame, hanging, mid_turn, settle, tip};
use turnleaf_engine::{MassSpring, Settings, Sheet, Surface, TurnModel, turn_hash};

use crate::live::Live;

/// What is measured, and alive.
static BENCHES: Live<Bench> = Live::new();
static SHEETS: Live<BenchSheet> = Live::new();

/// Steps, or surfaces, of one call at most.
const MOST: u32 = 1_000_000;

/// Seconds of a turn that is hashed, and after it, at most.
const MOST_SECONDS: f32 = 60.0;

/// A leaf in mid-turn, and its surface.
pub struct Bench {
    start: MassSpring,
    leaf: MassSpring,
    surface: Surface,
}

/// Steps taken before measuring: a third of the way through the turn.
const MID_TURN: usize = 228;

fn settings(preset: u32) -> Settings {
    match preset {
        0 => Settings::paper_2014(),
        _ => Settings::book(0.140, 0.210, 0.070),
    }
}

/// Makes a leaf of a preset (0 paper-2014, 1 book), a third of the way through
/// its turn by the column; 0 if that cannot be.
#[unsafe(no_mangle)]
pub extern "C" fn tl_bench_new(preset: u32) -> *mut Bench {
    let Ok(mut leaf) = MassSpring::new(settings(preset)) else {
        return core::ptr::null_mut();
    };
    let seconds = if preset == 0 { 11.4 } else { 0.8 };
    let gesture = leaf.settings().column_gesture(seconds);
    leaf.play(gesture);
    for _ in 0..if preset == 0 { MID_TURN } else { 32 } {
        leaf.step();
    }
    let bench = Bench {
        start: leaf.clone(),
        leaf,
        surface: Surface::new(26, 26),
    };
    BENCHES.keep(bench)
}

/// Frees it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_drop(bench: *mut Bench) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    drop(unsafe { BENCHES.take(bench) });
}

/// From mid-turn on, takes `steps` steps, and writes the surface after each if
/// `surfaces` is not 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_steps(bench: *mut Bench, steps: u32, surfaces: u32) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    let Some(bench) = (unsafe { BENCHES.get(bench) }) else {
        return;
    };
    bench.leaf.clone_from(&bench.start);
    for _ in 0..steps.min(MOST) {
        bench.leaf.step();
        if surfaces != 0 {
            bench.leaf.write_surface(&mut bench.surface);
        }
    }
}

/// Writes the surface `count` times.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_surfaces(bench: *mut Bench, count: u32) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    let Some(bench) = (unsafe { BENCHES.get(bench) }) else {
        return;
    };
    for _ in 0..count.min(MOST) {
        core::hint::black_box(&mut bench.leaf).write_surface(&mut bench.surface);
    }
}

/// Computes the normals `count` times.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_normals(bench: *mut Bench, count: u32) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    let Some(bench) = (unsafe { BENCHES.get(bench) }) else {
        return;
    };
    for _ in 0..count.min(MOST) {
        core::hint::black_box(&mut bench.surface).update_normals();
    }
}

/// Hash of all bits of a whole turn: preset (0 paper-2014, 1 book), gesture (0
/// column, 1 corner), its seconds (0.01 to 60), and those simulated after it (0 to 60);
/// 0 where they are not such.
#[unsafe(no_mangle)]
pub extern "C" fn tl_turn_hash(preset: u32, gesture: u32, seconds: f32, settle: f32) -> u64 {
    if !(0.01..=MOST_SECONDS).contains(&seconds) || !(0.0..=MOST_SECONDS).contains(&settle) {
        return 0;
    }
    let Ok(mut leaf) = MassSpring::new(settings(preset)) else {
        return 0;
    };
    let path = match gesture {
        0 => leaf.settings().column_gesture(seconds),
        _ => leaf.settings().corner_gesture(seconds),
    };
    leaf.play(path);
    let steps = (f64::from(seconds) + f64::from(settle)) / f64::from(leaf.time_step());
    turn_hash(&mut leaf, (steps + 0.5) as usize)
}

/// A sheet to be timed, its surface, and the same grid as a hanging page.
pub struct BenchSheet {
    sheet: Sheet,
    surface: Surface,
    hanging: Sheet,
}

/// Makes a leaf of `columns` x `rows` nodes (4 to 64 each) in mid-turn, and a page that
/// hangs with `gamma` (0.001 to 10,000); 0 where they are not such.
#[unsafe(no_mangle)]
pub extern "C" fn tl_bench_sheet_new(columns: usize, rows: usize, gamma: f64) -> *mut BenchSheet {
    let are_nodes = [columns, rows].iter().all(|count| (4..=64).contains(count));
    if !are_nodes || !(1e-3..=1e4).contains(&gamma) {
        return core::ptr::null_mut();
    }
    SHEETS.keep(BenchSheet {
        sheet: mid_turn(columns, rows),
        surface: Surface::new(49, 25),
        hanging: hanging(columns, rows, gamma),
    })
}

/// Makes a leaf as a book has it in mid-turn with as many creases (0 to 3), beside the same
/// hanging page of a book's nodes.
#[unsafe(no_mangle)]
pub extern "C" fn tl_bench_creased_new(creases: usize) -> *mut BenchSheet {
    SHEETS.keep(BenchSheet {
        sheet: creased(creases),
        surface: Surface::new(49, 25),
        hanging: hanging(10, 14, 10.0),
    })
}

/// Frees it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_sheet_free(bench: *mut BenchSheet) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    drop(unsafe { SHEETS.take(bench) });
}

/// A frame at 60 Hz of the leaf in mid-turn: its steps, its surface, its normals.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_sheet_frame(bench: *mut BenchSheet) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    let Some(bench) = (unsafe { SHEETS.get(bench) }) else {
        return;
    };
    frame(&mut bench.sheet, &mut bench.surface);
}

/// Drop of the tip of the hanging page over its width, once it hangs still.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_sheet_drop(bench: *mut BenchSheet) -> f64 {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    let Some(bench) = (unsafe { SHEETS.get(bench) }) else {
        return 0.0;
    };
    settle(&mut bench.hanging);
    tip(&bench.hanging)[1]
}

/// Reach of the tip of the hanging page over its width, as it hangs now.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_sheet_reach(bench: *mut BenchSheet) -> f64 {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    unsafe { SHEETS.get(bench) }.map_or(0.0, |bench| tip(&bench.hanging)[0])
}

/// Hash of all bits of half a second of the sheet in mid-turn.
#[unsafe(no_mangle)]
pub extern "C" fn tl_sheet_hash() -> u64 {
    turn_hash(&mut mid_turn(12, 16), 60)
}

/// Hash of all bits of half a second of the creased leaf in mid-turn.
#[unsafe(no_mangle)]
pub extern "C" fn tl_creased_hash() -> u64 {
    turn_hash(&mut creased(3), 60)
}
