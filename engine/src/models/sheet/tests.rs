use super::*;
use crate::random::for_seeds;
use crate::stock::{GRAVITY, Stock};
use crate::trials::{PAGE, hanging, settle, tip};

#[test]
fn a_hanging_page_hangs_as_it_should() {
    let table = include_str!("../../../tests/anchors/heavy_elastica.csv");
    for line in table.lines().skip(1) {
        let values: Vec<f64> = line.trim().split(',').map(|x| x.parse().unwrap()).collect();
        let [gamma, reach, drop] = [values[0], values[1], values[2]];
        if !(0.1..=1000.0).contains(&gamma) {
            continue;
        }
        let mut sheet = hanging(12, 16, gamma);
        settle(&mut sheet);
        let [w, h] = tip(&sheet);
        let error = (w - reach).hypot(h - drop);
        let allowed = if gamma <= 100.0 { 0.004 } else { 0.02 };
        assert!(error < allowed, "Gamma {gamma}: off by {error}");
        assert!(sheet.max_edge_strain() < 1e-4);
    }
}

/// Limp and light, in air and with nothing else to slow it.
#[test]
fn a_limp_page_settles() {
    for gamma in [100.0, 20.0] {
        let hanging = hanging(10, 14, gamma);
        let paper = crate::book::Paper {
            stock: hanging.settings().stock,
            ..Default::default()
        };
        let mut sheet = Sheet::new(SheetSettings {
            root: Root::Clamped,
            ..paper.sheet(PAGE)
        })
        .unwrap();
        let mut fastest = |seconds: f32| {
            let steps = (seconds / sheet.time_step()) as usize;
            let speeds = (0..steps).map(|_| {
                sheet.step();
                sheet.greatest_speed()
            });
            speeds.fold(0.0, f32::max)
        };
        let first = fastest(1.0);
        fastest(14.0);
        let [early, _, late] = [2.0, 26.0, 2.0].map(&mut fastest);
        // Drag in proportion to the square of the speed: it falls as one over time.
        assert!(
            late < 2e-3 || late < 0.5 * early && early < 0.1 * first,
            "Gamma {gamma}: {first}, {early}, {late} m/s"
        );
    }
}

#[test]
fn a_level_sheet_falls_at_its_terminal_speed() {
    for name in Stock::NAMES {
        let stock = Stock::named(name).unwrap();
        let settings = SheetSettings {
            root: Root::Free,
            ..SheetSettings::leaf(PAGE[0], PAGE[1], stock)
        };
        let terminal = settings.air.terminal_speed(stock.grammage);
        let mut sheet = Sheet::new(settings).unwrap();
        // So far down that a force which grew with the sheet's place would tell.
        for _ in 0..360 {
            sheet.step();
        }
        let speeds = sheet.velocities().chunks_exact(3).map(|v| f64::from(-v[2]));
        let falls = speeds.sum::<f64>() / 192.0;
        assert!(
            (falls / terminal - 1.0).abs() < 0.01,
            "{name}: {falls} for {terminal}"
        );
    }
}

#[test]
fn wind_carries_a_free_sheet_along() {
    let mut settings = SheetSettings::leaf(PAGE[0], PAGE[1], Stock::BIBLE);
    settings.root = Root::Free;
    settings.gravity = [0.0; 3];
    settings.air.wind = [0.0, 0.0, 2.0];
    let mut sheet = Sheet::new(settings).unwrap();
    for _ in 0..600 {
        sheet.step();
    }
    let speed = sheet.velocities()[2];
    assert!((1.8..2.01).contains(&speed), "{speed}");
}

#[test]
fn a_pinned_node_stays() {
    let mut sheet = hanging(12, 16, 10.0);
    let place = [0.148, 0.0, 0.0];
    sheet.pin(11, 0, Some(place));
    settle(&mut sheet);
    let at = sheet.positions().as_chunks::<3>().0[11];
    let away = [0, 1, 2].map(|axis| (at[axis] - place[axis]).abs());
    assert!(away.iter().all(|d| *d < 5e-5), "{away:?}");
    sheet.pin(11, 0, None);
    settle(&mut sheet);
    assert!(sheet.positions()[3 * 11 + 2] < -0.05);
}

#[test]
fn a_half_space_holds_a_sheet_up_and_friction_holds_it_back() {
    let mut settings = SheetSettings::leaf(PAGE[0], PAGE[1], Stock::OFFICE);
    settings.root = Root::Free;
    // A table tilted by 20 degrees: friction of 0.5 holds up to 26.
    let (sin, cos) = libm::sincosf(0.35);
    let tan = f64::from(sin / cos);
    for (friction, slides) in [(0.5, false), (0.2, true)] {
        let mut sheet = Sheet::new(settings.clone()).unwrap();
        let tilted: Vec<f32> = sheet
            .positions()
            .chunks_exact(3)
            .flat_map(|x| [x[0] * cos, x[1], x[0] * sin])
            .collect();
        let still = vec![0.0; tilted.len()];
        sheet.write_nodes(&tilted, &still);
        for contacts in sheet.contacts_mut() {
            contacts[0] = Contact {
                normal: [-sin, 0.0, cos],
                offset: 0.0,
                velocity: [0.0; 3],
                friction,
                firmness: 1.0,
            };
        }
        for _ in 0..(1.0 / sheet.time_step()) as usize {
            sheet.step();
        }
        let at = sheet.positions().as_chunks().0[50];
        let depth = sheet.contacts_mut()[50][0].depth(at);
        assert!(depth < 1e-4, "{depth} m deep");
        let slid = f64::from(sheet.positions()[0].hypot(sheet.positions()[2]));
        if slides {
            let free = 0.5 * GRAVITY * f64::from(cos) * (tan - 0.2);
            assert!((slid / free - 1.0).abs() < 0.12, "{slid} m for {free}");
        } else {
            // Below the rounded-off Coulomb law it creeps at a few mm a second.
            assert!(slid < 0.025, "{slid} m");
        }
    }
}

#[test]
fn any_stock_at_any_size_stays_finite_under_any_hand() {
    for_seeds(|random| {
        let stock = Stock::PRESETS[random.below(Stock::PRESETS.len() - 1)].1;
        let (columns, rows) = (4 + random.below(12), 4 + random.below(14));
        let settings = SheetSettings {
            columns,
            rows,
            ..SheetSettings::leaf(
                f64::from(random.between(0.05, 0.4)),
                f64::from(random.between(0.05, 0.5)),
                stock,
            )
        };
        let mut sheet = Sheet::new(settings).unwrap();
        sheet.grab(0, random.between(0.0, 1.0), random.between(0.0, 1.0));
        sheet.grab(1, random.between(0.0, 1.0), random.between(0.0, 1.0));
        for _ in 0..10 {
            for grab in 0..2 {
                sheet.pull(grab, [(); 3].map(|()| random.between(-1.0, 1.0)));
            }
            for _ in 0..8 {
                sheet.step();
            }
        }
        assert!(sheet.positions().iter().all(|x| x.is_finite()));
        assert!(
            sheet.max_edge_strain() < 0.05,
            "{}",
            sheet.max_edge_strain()
        );
    });
}

#[test]
fn synchronised_columns_stay_parallel() {
    let settings = SheetSettings {
        synchronise: Synchronise::Columns,
        ..SheetSettings::leaf(PAGE[0], PAGE[1], Stock::BOOK)
    };
    let mut sheet = Sheet::new(settings).unwrap();
    sheet.grab(0, 1.0, 0.0);
    sheet.pull(0, [0.1, 0.0, 0.06]);
    for _ in 0..120 {
        sheet.step();
    }
    let x = sheet.positions().as_chunks::<3>().0;
    let (foot, head) = (x[11], x[15 * 12 + 11]);
    assert!(
        foot[2] > 0.01 && (foot[2] - head[2]).abs() < 1e-5,
        "{foot:?} {head:?}"
    );
}

#[test]
fn what_makes_no_sheet_is_rejected_in_a_sentence() {
    let good = SheetSettings::leaf(PAGE[0], PAGE[1], Stock::BOOK);
    let mut bad = [(); 5].map(|()| good.clone());
    bad[0].columns = 3;
    bad[1].width = f64::NAN;
    bad[2].stock.grammage = 0.0;
    bad[3].gravity[1] = f64::INFINITY;
    bad[4].root = Root::Hinged(-1.0);
    for settings in bad {
        let error = Sheet::new(settings).unwrap_err();
        let sentence = error.to_string();
        assert!(sentence.ends_with('.') && sentence.len() > 20, "{sentence}");
    }
}
