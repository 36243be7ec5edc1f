//! The air around a leaf: drag, the mass it carries along, wind.
//!
//! On an element of area A with unit normal n, moving at v in air that moves at
//! w, acts the drag -1/2 rho C A |vn| vn n with vn = (v - w).n, and the element
//! carries the mass of `added_mass` A along its normal. Both are laws of a flat
//! plate, taken element by element; wakes and the cushion of air under a
//! landing leaf are not resolved.

/// What surrounds a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Density, kg/m^3.
    pub density: f64,
    /// Drag coefficient of a plate across the stream, without unit.
    pub drag: f64,
    /// Mass that moves with a square metre of the leaf along its normal, kg/m^2.
    pub added_mass: f64,
    /// Velocity of the air, m/s.
    pub wind: [f64; 3],
}

impl Air {
    /// No air.
    pub const NONE: Air = Air {
        density: 0.0,
        drag: 0.0,
        added_mass: 0.0,
        wind: [0.0; 3],
    };

    /// Still air at room temperature around a leaf `width` metres wide: the drag
    /// of a square plate, and the added mass of a long plate swinging about its
    /// middle, pi/4 rho width (Lamb, Hydrodynamics, section 71).
    pub fn still(width: f64) -> Air {
        let density = 1.2;
        Air {
            density,
            drag: 1.2,
            added_mass: core::f64::consts::FRAC_PI_4 * density * width,
            wind: [0.0; 3],
        }
    }

    /// Speed at which a level sheet of `grammage` (kg/m^2) falls steadily, m/s;
    /// infinite where there is no air.
    pub fn terminal_speed(&self, grammage: f64) -> f64 {
        (2.0 * grammage * crate::stock::GRAVITY / (self.density * self.drag)).sqrt()
    }
}
