//! Griffith's rule: paper parts when what holds it has the energy that a new edge takes.

/// Work of fracture of paper, J/m^2: typical of 5 to 20 kJ/m^2.
const FRACTURE: f64 = 1e4;

/// Of the distance between nodes, how far paper opens before it parts there: a tear is no sharper
/// than they are apart.
const OPENING: f64 = 0.5;

/// Work of tearing a length of paper of a caliper, both in metres, J.
pub(super) fn work_of(caliper: f64, length: f64) -> f64 {
    FRACTURE * caliper * length
}

/// Stiffness of a spring that holds so much work, J, where it has opened as far as paper does whose
/// nodes are so far apart, metres: N/m.
pub(super) fn stiffness_of(work: f64, spacing: f64) -> f32 {
    let opening = OPENING * spacing;
    (2.0 * work / (opening * opening)) as f32
}
