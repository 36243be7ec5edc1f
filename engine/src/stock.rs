//! What a leaf's paper is.
//!
//! The presets but board are the stocks of a page 148 mm wide whose grain runs
//! along the spine, so that turning it bends the soft direction. Grammage and caliper
//! are those printed on such papers; stiffness across the grain is a typical
//! figure for them, stiffness along it follows from the ratio of the moduli of
//! office paper, about 4.5 GPa along and 2.0 across the grain. All figures of
//! stiffness, friction and loss are typical, not measured on a named product.

/// Standard gravity, m/s^2.
pub const GRAVITY: f64 = 9.80665;

/// Stiffness along the grain over that across it: the moduli of office paper,
/// 4.5 and 2.0 GPa (typical).
const GRAIN_RATIO: f64 = 2.25;

/// Least bending stiffness that a stock may have, N m.
pub(crate) const SOFTEST: f64 = 1e-8;

/// Greatest bending stiffness that a stock may have, N m.
pub(crate) const STIFFEST: f64 = 10.0;

/// Which way the fibres of a leaf lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Grain {
    /// Along the spine, as in a well-made book: pages turn softly.
    #[default]
    AlongSpine,
    /// Across the spine: pages turn stiffly and stand up.
    AcrossSpine,
}

impl Grain {
    /// The grain of the same paper turned by a quarter.
    pub(crate) fn turned(self) -> Self {
        match self {
            Grain::AlongSpine => Grain::AcrossSpine,
            Grain::AcrossSpine => Grain::AlongSpine,
        }
    }
}

/// A paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stock {
    /// Mass of a square metre, kg/m^2.
    pub grammage: f64,
    /// Thickness of a sheet, m.
    pub caliper: f64,
    /// Bending stiffness along the grain, a moment per width and curvature, N m.
    pub stiffness_along: f64,
    /// Bending stiffness across the grain, N m.
    pub stiffness_across: f64,
    /// Geometric mean of the two Poisson ratios.
    pub poisson: f64,
    /// Coefficient of friction of the paper on itself, without unit.
    pub friction: f64,
    /// Loss tangent in bending: of the energy of a cycle, 2 pi times this is lost.
    pub loss: f64,
}

/// A stock that is no paper.
#[derive(Clone, Debug, PartialEq)]
pub struct InvalidStock {
    /// Which figure is wrong.
    pub figure: &'static str,
    /// Its unit, empty where it has none.
    pub unit: &'static str,
    /// What it is.
    pub value: f64,
    /// The least that it may be.
    pub least: f64,
    /// The most that it may be.
    pub most: f64,
}

impl core::fmt::Display for InvalidStock {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let InvalidStock {
            figure,
            unit,
            value,
            least,
            most,
        } = self;
        let space = if unit.is_empty() { "" } else { " " };
        write!(
            f,
            "The paper's {figure} is {value}; it must lie between {least} and {most}{space}{unit}."
        )
    }
}

impl core::error::Error for InvalidStock {}

impl Stock {
    /// The presets with their names, from the lightest to the heaviest. The last one is board, of which
    /// single leaves can be, and no book is as a whole.
    pub const PRESETS: [(&'static str, Stock); 6] = [
        ("bible", Self::BIBLE),
        ("book", Self::BOOK),
        ("office", Self::OFFICE),
        ("coated", Self::COATED),
        ("card", Self::CARD),
        ("board", Self::BOARD),
    ];

    /// Their names.
    pub const NAMES: [&'static str; Self::PRESETS.len()] = {
        let mut names = [""; Self::PRESETS.len()];
        let mut k = 0;
        while k < names.len() {
            names[k] = Self::PRESETS[k].0;
            k += 1;
        }
        names
    };

    /// Bible paper, 30 g/m^2: it floats.
    pub const BIBLE: Stock = typical(0.030, 40e-6, 0.011e-3, 0.5);
    /// Book paper, 70 g/m^2.
    pub const BOOK: Stock = typical(0.070, 90e-6, 0.12e-3, 0.5);
    /// Office paper, 80 g/m^2.
    pub const OFFICE: Stock = typical(0.080, 104e-6, 0.19e-3, 0.5);
    /// Coated paper of magazines and art books, 170 g/m^2.
    pub const COATED: Stock = typical(0.170, 140e-6, 0.80e-3, 0.4);
    /// Card, 250 g/m^2: it snaps.
    pub const CARD: Stock = typical(0.250, 300e-6, 4.5e-3, 0.45);
    /// Grey board of hard covers and board books, 1000 g/m^2 and 1.6 mm: it stays flat.
    /// Of the modulus of card: 12 D over the cube of the caliper is 2.0 GPa for both.
    pub const BOARD: Stock = typical(1.0, 1.6e-3, 0.68, 0.45);

    /// The preset of a name, None where there is none.
    pub fn named(name: &str) -> Option<Stock> {
        let found = Self::PRESETS.iter().find(|(known, _)| *known == name);
        found.map(|(_, stock)| *stock)
    }

    /// A paper of grammage kg/m^2, caliper m and bending stiffness along and
    /// across the grain, N m, with the Poisson ratio, friction and loss of book
    /// paper.
    ///
    /// # Errors
    /// Where a figure is no number or beyond what is made of paper.
    pub fn new(
        grammage: f64,
        caliper: f64,
        stiffness_along: f64,
        stiffness_across: f64,
    ) -> Result<Stock, InvalidStock> {
        let stock = Stock {
            grammage,
            caliper,
            stiffness_along,
            stiffness_across,
            ..Self::BOOK
        };
        stock.check()?;
        Ok(stock)
    }

    /// Says which figure, if any, no sheet could have.
    ///
    /// # Errors
    /// Names the first such figure.
    pub fn check(&self) -> Result<(), InvalidStock> {
        let figures = [
            ("grammage", "kg/m^2", self.grammage, 1e-3, 5.0),
            ("caliper", "m", self.caliper, 1e-6, 0.01),
            (
                "stiffness along the grain",
                "N m",
                self.stiffness_along,
                SOFTEST,
                STIFFEST,
            ),
            (
                "stiffness across the grain",
                "N m",
                self.stiffness_across,
                SOFTEST,
                STIFFEST,
            ),
            ("Poisson ratio", "", self.poisson, 0.0, 0.499),
            ("friction", "", self.friction, 0.0, 2.0),
            ("loss tangent", "", self.loss, 0.0, 1.0),
        ];
        for (figure, unit, value, least, most) in figures {
            if !(least..=most).contains(&value) {
                return Err(InvalidStock {
                    figure,
                    unit,
                    value,
                    least,
                    most,
                });
            }
        }
        Ok(())
    }

    /// Bending stiffness of a leaf across the spine (as it turns) and along it, N m.
    pub fn stiffness(&self, grain: Grain) -> (f64, f64) {
        match grain {
            Grain::AlongSpine => (self.stiffness_across, self.stiffness_along),
            Grain::AcrossSpine => (self.stiffness_along, self.stiffness_across),
        }
    }

    /// Gamma, the weight of a leaf `width` metres wide over its stiffness as it
    /// turns: (grammage g) width^3 / D. It alone decides how a page hangs.
    pub fn heaviness(&self, width: f64, grain: Grain) -> f64 {
        self.grammage * GRAVITY * width * width * width / self.stiffness(grain).0
    }
}

const fn typical(grammage: f64, caliper: f64, across: f64, friction: f64) -> Stock {
    Stock {
        grammage,
        caliper,
        stiffness_along: GRAIN_RATIO * across,
        stiffness_across: across,
        poisson: 0.29,
        friction,
        loss: 0.03,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_papers_of_the_heaviness_that_they_should_have() {
        for (name, gamma) in Stock::NAMES.iter().zip([89.0, 18.0, 13.6, 6.8, 1.8, 0.047]) {
            let stock = Stock::named(name).unwrap();
            stock.check().unwrap();
            let own = stock.heaviness(0.148, Grain::AlongSpine);
            assert!((own / gamma - 1.0).abs() < 0.04, "{name}: {own}");
        }
        assert_eq!(Stock::named("vellum"), None);
    }

    #[test]
    fn a_stock_in_figures_is_checked() {
        assert_eq!(Stock::new(0.07, 90e-6, 0.27e-3, 0.12e-3), Ok(Stock::BOOK));
        let error = Stock::new(f64::NAN, 90e-6, 0.27e-3, 0.12e-3).unwrap_err();
        let sentence = "The paper's grammage is NaN; it must lie between 0.001 and 5 kg/m^2.";
        assert_eq!(error.to_string(), sentence);
        assert!(Stock::new(0.07, 90e-6, 0.27e-3, -1.0).is_err());
    }
}
