//! Whole turns against recorded bits: of the mass-spring model preset, gesture,
//! seconds, seconds after, hash; of the sheet half a second of its mid-turn, and of a creased one; of
//! a book a riffle of a stock; of every model, in their order, a loose leaf turned by
//! its corner. A change of these is a change of every recorded turn, so it is made on
//! purpose: `UPDATE_GOLDEN=1 cargo test -p turnleaf-engine --test golden`.

use turnleaf_engine::trials::{creased, loose_hash, mid_turn, riffle_hash};
use turnleaf_engine::{MassSpring, ModelKind, Settings, TurnModel, turn_hash};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/turns.golden");

fn hash(line: &[&str]) -> u64 {
    match line[0] {
        "sheet" => turn_hash(&mut mid_turn(12, 16), 60),
        "creased" => turn_hash(&mut creased(3), 60),
        "riffle" => riffle_hash(line[1]).unwrap(),
        _ => mass_spring(line),
    }
}

fn mass_spring(line: &[&str]) -> u64 {
    let settings = match line[0] {
        "paper-2014" => Settings::paper_2014(),
        "book" => Settings::book(0.140, 0.210, 0.070),
        other => panic!("no preset {other}"),
    };
    let (seconds, settle): (f32, f32) = (line[2].parse().unwrap(), line[3].parse().unwrap());
    let mut leaf = MassSpring::new(settings).unwrap();
    let gesture = leaf.settings().gesture(line[1], seconds).unwrap();
    leaf.play(gesture);
    let steps = (f64::from(seconds) + f64::from(settle)) / f64::from(leaf.time_step());
    turn_hash(&mut leaf, steps.round() as usize)
}

#[test]
fn whole_turns_have_their_recorded_bits() {
    let golden = std::fs::read_to_string(FILE).unwrap();
    let mut found = String::new();
    for line in golden.lines().filter(|line| !line.starts_with("loose ")) {
        let words: Vec<&str> = line.split(' ').collect();
        let scene = words[..words.len() - 1].join(" ");
        found.push_str(&format!("{scene} {:016x}\n", hash(&words)));
    }
    for &kind in ModelKind::ALL {
        found.push_str(&format!(
            "loose {} {:016x}\n",
            kind.name(),
            loose_hash(kind)
        ));
    }
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(FILE, &found).unwrap();
    } else {
        assert_eq!(found, golden, "{FILE}");
    }
}
