//! The paper's leaf beside an account of its method that was written anew from its text, in
//! JavaScript, and has no code in common with the engine.

use std::process::Command;
use turnleaf_engine::{MassSpring, Settings, TurnModel};

/// What single precision leaves of a place on a leaf 25 wide after 700 steps.
const SINGLE: f64 = 2e-4;

#[test]
fn the_papers_leaf_moves_as_its_text_says() {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/paper_2014.mjs");
    let run = Command::new("node")
        .arg(script)
        .output()
        .expect("node is installed");
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    let text = String::from_utf8(run.stdout).expect("JSON is text");
    let numbers: Vec<f64> = text
        .split(['[', ']', ',', '\n'])
        .filter(|number| !number.is_empty())
        .map(|number| number.parse().expect("a number"))
        .collect();

    let mut leaf = MassSpring::new(Settings::paper_2014()).expect("the preset makes a leaf");
    let gesture = leaf.settings().column_gesture(11.4);
    leaf.play(gesture);
    let (mut places, mut velocities) = (vec![0.0f32; 3 * 36], vec![0.0f32; 3 * 36]);
    let moments = numbers.chunks_exact(places.len());
    assert_eq!(moments.len(), 12);
    for (second, moment) in (1..).zip(moments) {
        for _ in 0..60 {
            leaf.step();
        }
        leaf.read_nodes(&mut places, &mut velocities);
        let apart = places.iter().zip(moment);
        let most = apart.fold(0.0, |most, (own, other)| {
            f64::max(most, (f64::from(*own) - other).abs())
        });
        assert!(most < SINGLE, "{most} apart after {second} s");
    }
}
