//! Exports for the WASM benchmarks and for the golden test: leaves in mid-turn, a
//! hanging page, and hashes of whole turns. No book uses them.

use turnleaf_engine::trials::{frame, hanging, mid_turn, settle, tip};
use turnleaf_engine::{MassSpring, Settings, Sheet, Surface, TurnModel, turn_hash};

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
    Box::into_raw(Box::new(bench))
}

/// Frees it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_drop(bench: *mut Bench) {
    // SAFETY: a handle of `tl_bench_new`, not used again.
    drop(unsafe { Box::from_raw(bench) });
}

/// From mid-turn on, takes `steps` steps, and writes the surface after each if
/// `surfaces` is not 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_steps(bench: *mut Bench, steps: u32, surfaces: u32) {
    // SAFETY: a live handle of `tl_bench_new`.
    let bench = unsafe { &mut *bench };
    bench.leaf.clone_from(&bench.start);
    for _ in 0..steps {
        bench.leaf.step();
        if surfaces != 0 {
            bench.leaf.write_surface(&mut bench.surface);
        }
    }
}

/// Writes the surface `count` times.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_surfaces(bench: *mut Bench, count: u32) {
    // SAFETY: a live handle of `tl_bench_new`.
    let bench = unsafe { &mut *bench };
    for _ in 0..count {
        core::hint::black_box(&mut bench.leaf).write_surface(&mut bench.surface);
    }
}

/// Computes the normals `count` times.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_normals(bench: *mut Bench, count: u32) {
    // SAFETY: a live handle of `tl_bench_new`.
    let bench = unsafe { &mut *bench };
    for _ in 0..count {
        core::hint::black_box(&mut bench.surface).update_normals();
    }
}

/// Hash of all bits of a whole turn: preset (0 paper-2014, 1 book), gesture (0
/// column, 1 corner), its seconds, and those simulated after it.
#[unsafe(no_mangle)]
pub extern "C" fn tl_turn_hash(preset: u32, gesture: u32, seconds: f32, settle: f32) -> u64 {
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

/// Makes a leaf of `columns` x `rows` nodes in mid-turn, and a page that hangs
/// with `gamma`.
#[unsafe(no_mangle)]
pub extern "C" fn tl_bench_sheet_new(columns: usize, rows: usize, gamma: f64) -> *mut BenchSheet {
    Box::into_raw(Box::new(BenchSheet {
        sheet: mid_turn(columns, rows),
        surface: Surface::new(49, 25),
        hanging: hanging(columns, rows, gamma),
    }))
}

/// Frees it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_sheet_free(bench: *mut BenchSheet) {
    // SAFETY: a handle of `tl_bench_sheet_new`, not used again.
    drop(unsafe { Box::from_raw(bench) });
}

/// A frame at 60 Hz of the leaf in mid-turn: two steps, its surface, its normals.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_sheet_frame(bench: *mut BenchSheet) {
    // SAFETY: a live handle of `tl_bench_sheet_new`.
    let bench = unsafe { &mut *bench };
    frame(&mut bench.sheet, &mut bench.surface);
}

/// Drop of the tip of the hanging page over its width, once it hangs still.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_sheet_drop(bench: *mut BenchSheet) -> f64 {
    // SAFETY: a live handle of `tl_bench_sheet_new`.
    let bench = unsafe { &mut *bench };
    settle(&mut bench.hanging);
    tip(&bench.hanging)[1]
}

/// Reach of the tip of the hanging page over its width, as it hangs now.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_bench_sheet_reach(bench: *mut BenchSheet) -> f64 {
    // SAFETY: a live handle of `tl_bench_sheet_new`.
    tip(&unsafe { &*bench }.hanging)[0]
}

/// Hash of all bits of half a second of the sheet in mid-turn.
#[unsafe(no_mangle)]
pub extern "C" fn tl_sheet_hash() -> u64 {
    turn_hash(&mut mid_turn(12, 16), 60)
}
