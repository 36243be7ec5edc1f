//! Any numbers at every exported function: nothing panics, hangs, or makes what
//! is drawn anything but numbers. A hang shows as more ticks than a call may take:
//! what a call of any count did is compared with one of the most that counts.

use turnleaf_engine::book::Book;

use crate::books::*;
use crate::*;

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    /// A number between `low` and `high`, or in one of three cases any number at all.
    fn float(&mut self, low: f64, high: f64) -> f64 {
        let strange = [
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            0.0,
            -0.0,
            -1.0,
            1e-300,
            -1e300,
            f64::MAX,
            1e30,
            f64::from(f32::MIN_POSITIVE),
            f64::from(f32::MAX),
        ];
        match self.below(6) {
            0 => strange[self.below(strange.len())],
            1 => f64::from_bits(self.next()),
            _ => low + (high - low) * (self.next() >> 11) as f64 / (1u64 << 53) as f64,
        }
    }

    fn single(&mut self, low: f64, high: f64) -> f32 {
        self.float(low, high) as f32
    }

    /// A number below `count`, or in one of four cases any number at all.
    fn whole(&mut self, count: u32) -> u32 {
        let strange = [u32::MAX, u32::MAX - 1, 1 << 31, 1 << 16, 0];
        match self.below(8) {
            0 => strange[self.below(strange.len())],
            1 => self.next() as u32,
            _ => self.below(count as usize) as u32,
        }
    }
}

/// Numbers of a seed, which is printed where the test fails; `SEED=n` repeats it.
fn random() -> Random {
    let seed = std::env::var("SEED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    let seed = seed.unwrap_or(20_260_729);
    println!("SEED={seed}");
    Random(seed)
}

/// Whether all that is drawn of a book is a number.
fn is_finite(book: *mut Book) -> bool {
    // SAFETY: a handle of this thread.
    let (book, count) = unsafe { (BOOKS.get(book).expect("it is alive"), tl_book_flights(book)) };
    (0..count).all(|index| {
        let surface = book.surface(index).expect("it flies");
        let all = surface.positions.iter().chain(&surface.normals);
        { all }.all(|x| x.is_finite())
    })
}

#[test]
fn a_book_takes_any_number() {
    let mut random = random();
    for _ in 0..40 {
        let [width, height] = [0, 1].map(|_| random.float(0.02, 0.4));
        let (leaves, thickness) = (random.whole(300), random.float(0.0, 0.03));
        let book = tl_book_new(width, height, leaves, thickness);
        let usual = tl_book_new(0.14, 0.21, 40, 0.004);
        for _ in 0..60 {
            let book = if book.is_null() || random.below(2) == 0 {
                usual
            } else {
                book
            };
            // SAFETY: handles of this thread, or none.
            unsafe { any_call(&mut random, book) };
            assert!(is_finite(book));
        }
        // SAFETY: as above.
        unsafe {
            tl_book_drop(book);
            tl_book_drop(usual);
        }
    }
}

/// Calls any function of a book with any numbers.
unsafe fn any_call(random: &mut Random, book: *mut Book) {
    let r = random;
    // SAFETY: handles of this thread.
    unsafe {
        let (id, index) = (r.whole(20), r.whole(4) as usize);
        match r.below(25) {
            0 => drop(tl_book_set_stock(book, r.whole(6) as usize)),
            1 => {
                let grammage = r.float(0.02, 0.3);
                let caliper = r.float(1e-5, 1e-3);
                let (along, across) = (r.float(1e-6, 1e-2), r.float(1e-6, 1e-2));
                tl_book_set_figures(book, grammage, caliper, along, across);
            }
            2 => drop(tl_book_set_binding(book, r.whole(2), r.float(0.0, 1.0))),
            3 => {
                let [x, y, z] = [0; 3].map(|_| r.float(-5.0, 5.0));
                tl_book_set_wind(book, x, y, z);
            }
            4 => tl_book_set_assist(book, r.whole(2)),
            5 => tl_book_lay(book, r.whole(300)),
            6 | 7 => {
                let low = tl_book_read(book).wrapping_add(r.whole(3));
                tl_book_lift(book, r.whole(2), low, low.wrapping_add(r.whole(3)));
            }
            8 | 9 => {
                let (u, v) = (r.single(0.0, 1.0), r.single(0.0, 1.0));
                tl_book_grab(book, id, r.whole(4), u, v);
            }
            10 | 11 => {
                let [x, y, z] = [0; 3].map(|_| r.single(-0.3, 0.3));
                tl_book_hold(book, id, r.whole(4), x, y, z);
            }
            12 => tl_book_release(book, id, r.whole(4)),
            13 => tl_book_play(book, id, r.whole(2), r.single(0.1, 2.0)),
            14 => tl_book_step(book, r.whole(30)),
            15 => tl_book_update(book),
            16 => drop(tl_book_phase(book, id)),
            17 => {
                let points = tl_book_dress(book, index);
                let count = 3 * tl_book_columns(book) * tl_book_rows(book);
                assert_eq!(points.is_null(), index >= tl_book_flights(book));
                if !points.is_null() {
                    let points = core::slice::from_raw_parts_mut(points, count);
                    points[r.below(count)] = r.single(-0.2, 0.2);
                }
                tl_book_update(book);
            }
            18 => {
                let surface = tl_book_surface(book, index);
                assert_eq!(surface.is_null(), index >= tl_book_flights(book));
                assert!(surface.is_null() || (*surface).caliper > 0.0);
            }
            19 => tl_board_hold(book, r.whole(2), r.single(0.0, 3.2)),
            20 => tl_board_play(book, r.whole(2), r.whole(2), r.single(0.05, 2.0)),
            21 => {
                let (first, end) = (r.whole(40), r.whole(40));
                tl_book_set_leaf_stock(book, first, end, r.whole(6) as usize);
            }
            22 => {
                let (grammage, caliper) = (r.float(0.02, 2.0), r.float(1e-5, 2e-3));
                let (along, across) = (r.float(1e-6, 1.0), r.float(1e-6, 1.0));
                let (first, end) = (r.whole(40), r.whole(40));
                tl_book_set_leaf_figures(book, first, end, grammage, caliper, along, across);
            }
            23 => {
                assert!(tl_book_asleep(book) < 2);
            }
            _ => {
                tl_board_release(book, r.whole(2));
                tl_board_step(book, r.whole(2), r.whole(200));
                assert!(tl_board_angle(book, r.whole(2)).is_finite());
                tl_board_lay(book, r.whole(2), r.whole(2));
            }
        }
    }
}

/// The bits of a leaf that is played on in mid-turn as in a turn of so many seconds, after so many ticks.
fn played_for(seconds: f32, ticks: &[u32]) -> Vec<u32> {
    let book = tl_book_new(0.14, 0.21, 40, 0.004);
    // SAFETY: a handle of this thread.
    unsafe {
        // Else the cover lies on the leaf.
        tl_board_lay(book, 0, 1);
        let id = tl_book_lift(book, 0, 0, 1);
        tl_book_play(book, id, 1, 1.0);
        tl_book_step(book, 60);
        tl_book_play(book, id, 1, seconds);
        ticks.iter().for_each(|ticks| tl_book_step(book, *ticks));
        tl_book_update(book);
        let surface = BOOKS.get(book).and_then(|book| book.surface(0).cloned());
        tl_book_drop(book);
        let surface = surface.expect("it is in flight");
        surface.positions.iter().map(|x| x.to_bits()).collect()
    }
}

#[test]
fn a_call_steps_by_a_minute_at_most() {
    assert!(played_for(600.0, &[u32::MAX]) == played_for(600.0, &[MOST_TICKS]));
    let book = tl_book_new(0.14, 0.21, 40, 0.004);
    // SAFETY: a handle of this thread.
    unsafe {
        tl_board_hold(book, 0, 1.0);
        assert_eq!(tl_board_step(book, 0, u32::MAX), 2);
        assert!((tl_board_angle(book, 0) - 1.0).abs() < 1e-5);
        // A swing of no length that is one ends within the longest.
        tl_board_play(book, 0, 1, f32::MAX);
        for _ in 0..11 {
            tl_board_step(book, 0, u32::MAX);
        }
        assert_eq!(tl_board_step(book, 0, 0), 1);
        tl_book_drop(book);
    }
}

#[test]
#[ignore = "long: make test-long"]
fn a_call_steps_by_a_minute_at_most_whatever_it_asks_for() {
    let most = played_for(600.0, &[MOST_TICKS]);
    assert!(played_for(600.0, &[MOST_TICKS / 2; 2]) == most);
    assert!(played_for(600.0, &[MOST_TICKS - 1]) != most);
    for ticks in [u32::MAX - 1, 1 << 31, MOST_TICKS + 1] {
        assert!(played_for(600.0, &[ticks]) == most, "{ticks}");
    }
}

#[test]
fn a_turn_of_any_length_ends() {
    end_turns(&[f32::INFINITY, f32::NAN, -1.0, 0.0, 1e-40]);
    // The longest takes ten minutes, of which these are two seconds.
    let two_seconds = |of: f32| played_for(of, &[240]);
    assert!(two_seconds(f32::MAX) == two_seconds(600.0));
    assert!(two_seconds(500.0) != two_seconds(600.0));
}

#[test]
#[ignore = "long: make test-long"]
fn the_longest_turn_ends() {
    end_turns(&[f32::MAX]);
}

fn end_turns(lengths: &[f32]) {
    let book = tl_book_new(0.14, 0.21, 40, 0.004);
    for &seconds in lengths {
        // SAFETY: a handle of this thread.
        unsafe {
            tl_book_lay(book, 0);
            let id = tl_book_lift(book, 0, 0, 1);
            tl_book_play(book, id, 1, seconds);
            (0..11).for_each(|_| tl_book_step(book, u32::MAX));
            assert_eq!(tl_book_phase(book, id), OVER, "{seconds} s");
        }
    }
    // SAFETY: as above.
    unsafe { tl_book_drop(book) };
}

#[test]
fn a_book_of_any_size_is_made_or_rejected() {
    for (width, is_book) in [
        (0.0, false),
        (1e-6, false),
        (0.0009, false),
        (0.001, true),
        (10.0, true),
        (10.1, false),
        (f64::NAN, false),
        (f64::INFINITY, false),
        (-0.1, false),
    ] {
        let [a, b] = [(width, 0.2), (0.2, width)].map(|(w, h)| tl_book_new(w, h, 10, 0.001));
        for book in [a, b] {
            assert_eq!(!book.is_null(), is_book, "{width}");
            // SAFETY: handles of this thread, or none.
            unsafe {
                let id = tl_book_lift(book, 0, 0, 1);
                tl_book_grab(book, id, 0, 1.0, 0.5);
                tl_book_hold(book, id, 0, -0.5 * width as f32, 0.0, width as f32);
                tl_book_step(book, 200);
                tl_book_update(book);
                assert!(!is_book || is_finite(book), "{width}");
                tl_book_drop(book);
            }
        }
    }
}

#[test]
fn a_handle_that_is_none_does_nothing() {
    let book = tl_book_new(0.14, 0.21, 40, 0.004);
    // SAFETY: handles of this thread, or none.
    unsafe {
        tl_book_drop(book);
        for none in [0, 1, usize::MAX, book as usize, 0x1000] {
            let none = none as *mut Book;
            tl_book_drop(none);
            tl_book_step(none, 5);
            tl_book_update(none);
            tl_book_lay(none, 3);
            assert_eq!(tl_book_lift(none, 0, 0, 1), 0);
            assert_eq!(tl_book_flights(none), 0);
            assert!(tl_book_surface(none, 0).is_null());
            assert!(tl_book_u(none).is_null());
            assert_eq!(tl_board_angle(none, 0), 0.0);
            let leaf = none.cast::<models::Loose>();
            models::tl_leaf_drop(leaf);
            models::tl_leaf_advance(leaf, 1.0);
            assert!(models::tl_leaf_surface(leaf).is_null());
            assert!(models::tl_leaf_new(none.cast()).is_null());
            trials::tl_bench_steps(none.cast(), 5, 1);
            assert_eq!(trials::tl_bench_sheet_drop(none.cast()), 0.0);
        }
    }
}

#[test]
fn a_torn_leaf_takes_any_number() {
    use crate::torn_leaves::*;
    let mut random = random();
    for _ in 0..200 {
        let book = tl_book_new(0.148, 0.21, 40, 0.004);
        // SAFETY: handles of this thread, or none.
        unsafe {
            tl_book_lay(book, 20);
            let id = tl_book_lift(book, 0, 20, 21);
            let id = if random.below(8) == 0 {
                random.whole(4)
            } else {
                id
            };
            let (low, high) = (random.whole(3) as usize, 11 + random.whole(5) as usize);
            let (table, rim) = (random.single(-0.01, 0.0), random.single(0.0, 0.01));
            let leaf = tl_torn_new(book, id, random.whole(4), low, high, table, rim);
            let books = [book, core::ptr::null_mut(), leaf.cast()];
            let other = tl_torn_blank(book, table, rim);
            for _ in 0..60 {
                let [x, y, z] = [0, 1, 2].map(|_| random.single(-0.5, 0.5));
                let grab = random.below(3);
                match random.below(11) {
                    7 => tl_torn_grab(other, grab, x + 0.5, y + 0.5),
                    8 => {
                        let all = [leaf as usize, other as usize, 0, leaf as usize];
                        for (k, address) in all.into_iter().enumerate() {
                            *tl_torn_sheets().add(k) = address;
                        }
                        let (count, on) = (random.below(20), books[random.below(books.len())]);
                        tl_torn_wake_upon(count, random.below(20), on);
                        tl_torn_step_together(count, on, random.whole(20).min(40));
                    }
                    0 => tl_torn_grab(leaf, grab, x + 0.5, y + 0.5),
                    1 => tl_torn_release(leaf),
                    2 if random.below(8) == 0 => tl_torn_cut(leaf),
                    3 | 4 => tl_torn_pull(leaf, grab, x, y, z),
                    6 => {
                        let [u0, v0, u1, v1] = [0; 4].map(|_| random.float(-0.2, 1.2));
                        tl_torn_across(leaf, u0, v0, u1, v1, random.below(2) as u32);
                        tl_torn_drop(tl_torn_part(leaf));
                    }
                    5 => assert!(tl_torn_work(leaf) >= 0.0),
                    _ => {
                        let on = books[random.below(books.len())];
                        tl_torn_step(leaf, on, random.whole(20).min(40));
                    }
                }
                if let Some(torn) = TORN.get(leaf) {
                    let surface = torn.surface();
                    let mut numbers = surface.positions.iter().chain(&surface.normals);
                    assert!(numbers.all(|x| x.is_finite()));
                    assert!(tl_torn_bound_low(leaf) <= tl_torn_bound_high(leaf));
                    assert!(tl_torn_opened(leaf) >= 0.0);
                    let drawn = *tl_torn_surface(leaf);
                    assert!(drawn.caliper > 0.0);
                    assert_eq!(drawn.places.is_null(), drawn.triangles == 0);
                    let points = torn.paper_mesh().map(|mesh| 3 * mesh.places.len());
                    assert!(points.is_none_or(|points| points == surface.positions.len()));
                }
            }
            tl_torn_drop(other);
            tl_torn_drop(leaf);
            assert_eq!(tl_torn_asleep(leaf), 0);
            assert!(tl_torn_surface(leaf).is_null());
            tl_book_drop(book);
        }
    }
}

#[test]
fn a_flap_takes_any_number() {
    use crate::fold_outs::*;
    let mut random = random();
    for _ in 0..100 {
        let book = tl_book_new(0.148, 0.21, 40, 0.004);
        // SAFETY: handles of this thread, or none.
        unsafe {
            tl_book_lay(book, random.whole(41));
            let (fold, width) = (random.single(0.4, 1.1), random.single(0.0, 3.3));
            let panels = random.below(5);
            let (table, rim) = (random.single(-0.01, 0.0), random.single(0.0, 0.01));
            let on = random.whole(2);
            let flap = tl_flap_new(book, on, fold.into(), width.into(), panels, table, rim);
            let panel = width / panels as f32;
            let is_place = (0.5..=1.0).contains(&fold) && (0.05..=fold).contains(&panel);
            assert!(is_place || flap.is_null());
            let books = [book, core::ptr::null_mut(), flap.cast()];
            for _ in 0..60 {
                let [x, y, z] = [0, 1, 2].map(|_| random.single(-0.5, 0.5));
                match random.below(8) {
                    0 => tl_flap_grab(flap, x + 0.5, y + 0.5),
                    1 => tl_flap_release(flap),
                    2 => tl_flap_turn(flap, random.below(2) as u32),
                    3 | 4 => tl_flap_pull(flap, x, y, z),
                    5 => assert!(tl_flap_angle(flap).is_finite()),
                    _ => {
                        let on = books[random.below(books.len())];
                        tl_flap_step(flap, on, random.whole(20).min(40));
                    }
                }
                if let Some(alive) = FLAPS.get(flap) {
                    let surface = alive.surface();
                    let mut numbers = surface.positions.iter().chain(&surface.normals);
                    assert!(numbers.all(|x| x.is_finite()));
                    let drawn = *tl_flap_surface(flap);
                    assert!(drawn.caliper > 0.0);
                    assert_eq!(drawn.places.is_null(), drawn.triangles == 0);
                }
            }
            tl_flap_drop(flap);
            assert_eq!(tl_flap_asleep(flap), 0);
            assert!(tl_flap_surface(flap).is_null());
            tl_book_drop(book);
        }
    }
}

/// The figures of a leaf by `tl_leaf_new`: kind, size, stock and so on, each right or any.
fn figures(random: &mut Random) -> [f64; 21] {
    let mut usual = [
        1.0 + random.below(7) as f64,
        0.148,
        0.21,
        0.07,
        90e-6,
        0.27e-3,
        0.12e-3,
        random.below(2) as f64,
        turnleaf_engine::GRAVITY,
        1.0,
        0.0,
        0.0,
        0.0,
        9.0,
        7.0,
        random.below(2) as f64,
        random.below(3) as f64,
        0.6,
        random.below(2) as f64,
        random.below(2) as f64,
        0.5,
    ];
    if usual[0] == 3.0 {
        (usual[10], usual[11], usual[12]) = (7.0, 5.0, 1.0 / 60.0);
    }
    for _ in 0..random.below(3) {
        let at = random.below(usual.len());
        let near = usual[at];
        usual[at] = random.float(0.3 * near, 3.0 * near);
    }
    usual
}

#[test]
fn a_loose_leaf_takes_any_number() {
    use models::*;
    let mut random = random();
    let (mut made, mut creased) = (0, 0);
    for _ in 0..600 {
        let room = tl_leaf_figures();
        let figures = figures(&mut random);
        // SAFETY: a room of this thread.
        let leaf = unsafe {
            *room = figures;
            tl_leaf_new(room)
        };
        if leaf.is_null() {
            assert!(tl_leaf_error_length() > 10);
            continue;
        }
        made += 1;
        let r = &mut random;
        for _ in 0..8 {
            // SAFETY: a handle of this thread.
            unsafe {
                match r.below(11) {
                    0 => tl_leaf_lay(leaf, r.whole(2)),
                    1 => {
                        let (columns, rows) = (r.whole(9) as usize, r.whole(9) as usize);
                        let room = tl_leaf_samples(leaf, columns, rows);
                        assert_eq!(room.is_null(), columns > 1024 || rows > 1024);
                        if !room.is_null() {
                            for at in 0..columns + rows {
                                *room.add(at) = r.single(0.0, 1.0);
                            }
                        }
                        tl_leaf_draw(leaf, r.whole(9) as usize);
                    }
                    2 => tl_leaf_play(leaf, r.whole(3), r.whole(2), r.single(0.1, 2.0)),
                    3 => tl_leaf_grab(leaf, r.single(0.0, 1.0), r.single(0.0, 1.0)),
                    4 => {
                        let [x, y, z] = [0; 3].map(|_| r.single(-0.3, 0.3));
                        tl_leaf_hold(leaf, x, y, z);
                    }
                    5 => tl_leaf_release(leaf),
                    6 => tl_leaf_record(leaf, r.float(0.01, 0.1)),
                    7 => drop(tl_leaf_finish_record(leaf)),
                    8 => {
                        let count = r.whole(3) as usize;
                        let usual = [0.62, 0.0, 1.0, 0.27, 1.5, 0.3, 1.0, 0.4, 0.0, -1.0];
                        for at in 0..5 * count.min(16) {
                            let is_usual = r.below(16) > 0;
                            let near = usual[at % usual.len()];
                            let number = if is_usual { near } else { r.float(0.0, 1.0) };
                            *tl_leaf_creases(leaf).add(at) = number;
                        }
                        creased += u32::from(tl_leaf_crease(leaf, count) * count as u32 > 0);
                        let drawn = *tl_leaf_surface(leaf);
                        assert_eq!(drawn.places.is_null(), drawn.triangles == 0);
                    }
                    9 => tl_leaf_press(leaf, r.whole(4) as usize, r.single(-3.0, 3.0)),
                    _ => {
                        let step = f64::from(tl_leaf_step(leaf));
                        let seconds = r.float(0.0, 4.0 * step);
                        // A minute of each is more than a test has.
                        let is_short = seconds.is_nan() || seconds < 20.0 * step;
                        tl_leaf_advance(leaf, if is_short { seconds } else { step });
                    }
                }
                tl_leaf_update(leaf);
                tl_leaf_measure(leaf);
                let drawn = *tl_leaf_surface(leaf);
                let count = 3 * drawn.columns * drawn.rows;
                let points = core::slice::from_raw_parts(drawn.positions, count as usize);
                assert!(points.iter().all(|x| x.is_finite()));
            }
        }
        // SAFETY: as above.
        unsafe { tl_leaf_drop(leaf) };
    }
    assert!(made > 100, "{made} leaves");
    assert!(creased > 0, "none was creased");
}

#[test]
fn a_leaf_is_advanced_by_a_bounded_number_of_steps() {
    use models::*;
    let mut usual = figures(&mut Random(1));
    usual[..3].copy_from_slice(&[4.0, 0.148, 0.21]);
    usual[12] = 1e-6;
    let room = tl_leaf_figures();
    // SAFETY: a room, then a handle, of this thread.
    unsafe {
        *room = usual;
        let leaf = tl_leaf_new(room);
        tl_leaf_advance(leaf, 1e300);
        let steps = tl_leaf_time(leaf) / tl_leaf_step(leaf);
        assert!((35_990.0..36_010.0).contains(&steps), "{steps}");
        tl_leaf_advance(leaf, -1.0);
        tl_leaf_advance(leaf, f64::NAN);
        assert_eq!(tl_leaf_time(leaf) / tl_leaf_step(leaf), steps);
        tl_leaf_drop(leaf);
    }
}

#[test]
fn what_would_take_all_memory_or_time_is_rejected() {
    use models::*;
    let usual = figures(&mut Random(1));
    let figures = |changes: &[(usize, f64)]| {
        let mut figures = usual;
        (figures[1], figures[2], figures[12]) = (0.148, 0.21, 0.0);
        changes.iter().for_each(|(at, value)| figures[*at] = *value);
        let room = tl_leaf_figures();
        // SAFETY: a room, then a handle, of this thread.
        unsafe {
            *room = figures;
            let leaf = tl_leaf_new(room);
            tl_leaf_drop(leaf);
            leaf.is_null()
        }
    };
    // A shell of which a matrix has gigabytes; springs that need a million substeps.
    assert!(figures(&[(0, 3.0), (10, 513.0), (11, 513.0)]));
    assert!(figures(&[(0, 3.0), (10, 1e300), (11, 1e300)]));
    assert!(figures(&[(0, 1.0), (1, 0.001), (2, 0.001), (15, 1.0)]));
    assert!(figures(&[(0, 2.0), (8, 1e300)]));
    assert!(figures(&[(0, 3.0), (20, f64::NAN)]));
}

#[test]
fn benches_take_any_number() {
    use trials::*;
    for (columns, rows, gamma) in [
        (3, 8, 10.0),
        (usize::MAX, 8, 10.0),
        (8, 8, f64::NAN),
        (8, 8, -1.0),
    ] {
        assert!(tl_bench_sheet_new(columns, rows, gamma).is_null());
    }
    for seconds in [f32::INFINITY, f32::NAN, -1.0, 1e30] {
        assert_eq!(tl_turn_hash(0, 0, seconds, 0.0), 0);
        assert_eq!(tl_turn_hash(0, 0, 1.0, seconds), 0);
    }
}

#[test]
fn a_leaf_has_its_own_stock_until_all_have_one() {
    let book = tl_book_new(0.14, 0.21, 40, 0.004);
    // SAFETY: a handle of this thread.
    unsafe {
        let caliper = |leaf: u32| {
            tl_book_lay(book, leaf);
            tl_book_lift(book, 0, leaf, leaf + 1);
            (*tl_book_surface(book, 0)).caliper
        };
        assert_eq!(tl_book_set_leaf_stock(book, 3, 5, 5), 1);
        assert_eq!([2, 3, 4, 5].map(caliper), [90e-6, 1.6e-3, 1.6e-3, 90e-6]);
        assert_eq!(
            tl_book_set_leaf_figures(book, 4, 6, 0.2, 2e-4, 1e-3, 1e-3),
            1
        );
        assert_eq!([3, 4, 5].map(caliper), [1.6e-3, 2e-4, 2e-4]);
        // No such leaves, no such stock, no figures of paper.
        for (first, end, number) in [(3, 3, 0), (5, 3, 0), (39, 41, 0), (0, 1, 6), (0, 1, 99)] {
            assert_eq!(tl_book_set_leaf_stock(book, first, end, number), 0);
        }
        assert_eq!(
            tl_book_set_leaf_figures(book, 0, 1, f64::NAN, 2e-4, 1e-3, 1e-3),
            0
        );
        // Other properties of the paper leave it; another stock of all leaves does not.
        assert_eq!(tl_book_set_wind(book, 0.0, 1.0, 0.0), 1);
        assert_eq!(caliper(3), 1.6e-3);
        assert_eq!(tl_book_set_stock(book, 9), 0);
        assert_eq!(caliper(3), 1.6e-3);
        assert_eq!(tl_book_set_stock(book, 0), 1);
        assert_eq!([3, 4].map(caliper), [40e-6; 2]);
        tl_book_drop(book);
    }
}
