//! The bending of a leaf as an orthotropic plate.

use crate::stock::{Grain, Stock};

/// First root of cos(x) cosh(x) = -1: the first mode of a strip clamped at one end.
const FIRST_ROOT: f64 = 1.875_104_068_7;

/// The four constants of the bending energy of a nearly inextensible sheet,
///
/// ```text
/// E = 1/2 Int (D11 |x_uu|^2 + D22 |x_vv|^2 + 2 D12 x_uu.x_vv + 4 D66 |x_uv|^2) du dv
/// ```
///
/// quadratic in positions, u across the spine and v along it in metres. All in
/// N m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigidity {
    /// Against bending as the leaf turns, N m.
    pub d11: f64,
    /// Against bending along the spine, N m.
    pub d22: f64,
    /// Between the two (Poisson's effect), N m.
    pub d12: f64,
    /// Against twist, N m.
    pub d66: f64,
}

impl Rigidity {
    /// A stock's, bound with its grain in a direction. D12 and D66 follow from the
    /// geometric means of stiffness and Poisson ratio (Huber 1923), which is
    /// close for paper and exact for an isotropic sheet.
    pub fn of(stock: &Stock, grain: Grain) -> Rigidity {
        let (d11, d22) = stock.stiffness(grain);
        let mean = (d11 * d22).sqrt();
        Rigidity {
            d11,
            d22,
            d12: stock.poisson * mean,
            d66: (1.0 - stock.poisson) * mean / 2.0,
        }
    }

    /// An isotropic sheet's of stiffness `d` (N m) and Poisson ratio `poisson`.
    pub fn isotropic(d: f64, poisson: f64) -> Rigidity {
        Rigidity {
            d11: d,
            d22: d,
            d12: poisson * d,
            d66: (1.0 - poisson) * d / 2.0,
        }
    }

    /// Angular frequency in a vacuum, rad/s, of the first mode of a leaf `width`
    /// metres wide and of `areal_mass` kg/m^2, clamped at the spine.
    pub fn first_frequency(&self, areal_mass: f64, width: f64) -> f64 {
        FIRST_ROOT * FIRST_ROOT * (self.d11 / areal_mass).sqrt() / (width * width)
    }

    /// D11 of a strip across the spine whose long edges are free to curl.
    pub fn free_d11(&self) -> f64 {
        self.d11 - self.d12 * self.d12 / self.d22
    }

    /// D22 of a strip along the spine whose long edges are free to curl.
    pub fn free_d22(&self) -> f64 {
        self.d22 - self.d12 * self.d12 / self.d11
    }

    /// The same where a hinge takes all but a `fraction` of the bending across the spine.
    pub(crate) fn behind_hinge(&self, fraction: f64) -> Rigidity {
        let Rigidity { d11, d22, d12, d66 } = *self;
        Rigidity {
            d11: fraction * d11,
            d12: fraction * d12,
            d22: d22 - (1.0 - fraction) * d12 * d12 / d11,
            d66,
        }
    }

    /// Moments by curvatures along u and v and by twice the twist, where those across `free`
    /// edges, along u and along v, are left to themselves.
    pub(crate) fn moments(&self, free: [bool; 2]) -> [[f64; 3]; 3] {
        let Rigidity { d11, d22, d12, d66 } = *self;
        let (uu, vv, uv) = match free {
            [false, false] => (d11, d22, d12),
            [true, false] => (0.0, d22 - d12 * d12 / d11, 0.0),
            [false, true] => (d11 - d12 * d12 / d22, 0.0, 0.0),
            [true, true] => (0.0, 0.0, 0.0),
        };
        [[uu, uv, 0.0], [uv, vv, 0.0], [0.0, 0.0, d66]]
    }
}
