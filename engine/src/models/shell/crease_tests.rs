//! Creases that yield and creep, against what they come to by hand.

use super::*;
use crate::stock::GRAVITY;

const COLUMNS: usize = 17;

/// Seconds.
const STEP: f64 = 0.02;

/// A strip whose paper hardly bends beside a crease across its middle, and is flat at first.
fn strip(crease: Crease, fore_edge: Edge) -> Shell {
    let settings = ShellSettings::strip(COLUMNS, 0.01);
    let d = settings.rigidity.d11;
    Shell::new(ShellSettings {
        discretisation: Discretisation::Triangles,
        creases: vec![Crease {
            column: COLUMNS / 2,
            stiffness: crease.stiffness * d,
            ..crease
        }],
        gravity: [0.0; 3],
        fore_edge,
        time_step: STEP,
        ..settings
    })
    .unwrap()
}

/// Its outer half, of mass 1/2, hangs on the crease: with a moment a length of k y there, it has
/// drooped to where its weight's moment is that.
#[test]
fn a_crease_that_yields_gives_way_until_it_bears_the_weight() {
    let (yields, droops) = (0.3f64, 60.0f64.to_radians());
    let moment = GRAVITY * 0.5 * 0.25 * libm::cos(droops);
    let d = ShellSettings::strip(COLUMNS, 0.01).rigidity.d11;
    let crease = Crease {
        yields,
        ..Crease::elastic(0, 0.0, moment / yields / d)
    };
    let mut shell = strip(crease, Edge::Free);
    for step in 0..1200 {
        // Slowly, so that it does not swing.
        let part = (f64::from(step) / 1000.0).min(1.0);
        shell.set_gravity([0.0, 0.0, -GRAVITY * part]);
        shell.step();
    }
    let angle = shell.crease_angle(0).unwrap();
    let rest = shell.crease_rest(0).unwrap();
    assert!((angle + droops).abs() < 0.02, "{angle}");
    assert!((rest + droops - yields).abs() < 0.02, "{rest}");
    // Nearly unloaded it is at its rest, which it keeps.
    shell.set_gravity([0.0, 0.0, -1e-3 * GRAVITY]);
    shell.settle(1e-9).unwrap();
    let sprung = shell.crease_angle(0).unwrap();
    assert!((sprung - rest).abs() < 1e-3, "{sprung} of {rest}");
}

#[test]
fn a_crease_that_is_held_creeps_with_the_logarithm_of_time() {
    let (yields, creep, held) = (0.5f64, 0.03f64, 0.48f64);
    let crease = Crease {
        yields,
        creep,
        ..Crease::elastic(0, 0.0, 1e-3)
    };
    let mut shell = strip(crease, Edge::Clamped { angle: 0.0 });
    let (sin, cos) = libm::sincos(held);
    let mut places = shell.positions().to_vec();
    for place in places.as_chunks_mut::<3>().0 {
        let beyond = (place[0] - 0.5).max(0.0);
        place[0] += beyond * (cos - 1.0);
        place[2] = beyond * sin;
    }
    let still = vec![0.0; places.len()];
    shell.write_nodes(&places, &still);
    shell.hold_fore_edge(0.5 + 0.5 * cos, 0.5 * sin, held);
    let from = libm::exp((yields - held) / creep);
    for step in 1..=500 {
        shell.step();
        if [50, 500].contains(&step) {
            let seconds = f64::from(step) * STEP;
            let off = yields - creep * libm::log(from + seconds);
            let rest = shell.crease_rest(0).unwrap();
            assert!((held - rest - off).abs() < 1e-3, "{rest} after {seconds} s");
        }
    }
}

#[test]
fn an_elastic_crease_keeps_its_rest() {
    let mut shell = strip(Crease::elastic(0, 0.0, 2e-3), Edge::Free);
    shell.set_gravity([0.0, 0.0, -GRAVITY]);
    for _ in 0..100 {
        shell.step();
    }
    assert!(shell.crease_angle(0).unwrap() < -0.1);
    assert_eq!(shell.crease_rest(0), Some(0.0));
}
