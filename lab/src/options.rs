//! Options that experiments share, each wrong value refused in one sentence.

use std::str::FromStr;

use lexopt::{Arg, Parser};
use turnleaf_engine::{Gesture, Grip, Integrator, MassSpring, Preset, Settings, Synchronise};

/// Which turn to simulate.
pub struct Scene {
    /// The named preset.
    pub preset: Preset,
    /// `column`, `corner` or `corner-alone`.
    pub gesture: String,
    seconds: Option<f32>,
    settle: Option<f32>,
    integrator: Option<Integrator>,
    sync: Sync,
    /// Draw the masses themselves.
    pub no_interpolation: bool,
}

/// Which reading of synchronisation a mass-spring leaf follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sync {
    /// The preset's own.
    #[default]
    Preset,
    /// The paper's, word for word.
    Paper,
    /// None.
    Off,
}

impl Sync {
    /// Reads the option's value.
    pub fn read(parser: &mut Parser, option: &str) -> Result<Self, String> {
        let all = [Self::Preset, Self::Paper, Self::Off];
        Ok(all[choice(parser, option, &["preset", "paper", "off"])?])
    }

    /// Puts it into the settings of a leaf.
    pub fn set(self, settings: &mut Settings) {
        match self {
            Self::Preset => {}
            Self::Paper => settings.synchronise = Synchronise::Literal,
            Self::Off => settings.synchronise = Synchronise::Off,
        }
    }
}

/// Page of the preset `book` where no other is named: metres, and kilograms a
/// square metre.
const PAGE: (f32, f32, f32) = (0.140, 0.210, 0.070);

impl Default for Scene {
    fn default() -> Self {
        Self {
            preset: Preset::Paper2014,
            gesture: "column".into(),
            seconds: None,
            settle: None,
            integrator: None,
            sync: Sync::default(),
            no_interpolation: false,
        }
    }
}

impl Scene {
    /// Takes one option; says no when it is not one of a scene's.
    pub fn take(&mut self, option: &str, parser: &mut Parser) -> Result<bool, String> {
        match option {
            "model" => {
                choice(parser, option, &["mass-spring"])?;
            }
            "preset" => {
                let presets = [Preset::Paper2014, Preset::Book];
                self.preset = presets[choice(parser, option, &presets.map(Preset::name))?];
            }
            "gesture" => {
                let names = ["column", "corner", "corner-alone"];
                self.gesture = names[choice(parser, option, &names)?].into();
            }
            "seconds" => self.seconds = Some(seconds(parser, option, 0.05)?),
            "settle" => self.settle = Some(seconds(parser, option, 0.0)?),
            "integrator" => {
                let kinds = [
                    ("explicit-euler", Integrator::ExplicitEuler),
                    ("semi-implicit-euler", Integrator::SemiImplicitEuler),
                    ("runge-kutta-4", Integrator::RungeKutta4),
                ];
                self.integrator = Some(kinds[choice(parser, option, &kinds.map(|kind| kind.0))?].1);
            }
            "sync" => self.sync = Sync::read(parser, option)?,
            "no-interpolation" => self.no_interpolation = true,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Duration of the gesture.
    pub fn seconds(&self) -> f32 {
        self.seconds.unwrap_or(if self.preset == Preset::Book {
            0.8
        } else {
            11.4
        })
    }

    /// Time simulated after it.
    pub fn settle(&self) -> f32 {
        self.settle.unwrap_or(if self.preset == Preset::Book {
            1.0
        } else {
            2.0
        })
    }

    /// The settings of the leaf.
    pub fn settings(&self) -> Settings {
        let mut settings = match self.preset {
            Preset::Book => Settings::book(PAGE.0, PAGE.1, PAGE.2),
            _ => Settings::paper_2014(),
        };
        if let Some(integrator) = self.integrator {
            settings.integrator = integrator;
        }
        self.sync.set(&mut settings);
        settings
    }

    /// The leaf, at rest, its gesture about to start.
    pub fn leaf(&self) -> Result<MassSpring, String> {
        let mut leaf = MassSpring::new(self.settings()).map_err(|error| error.to_string())?;
        if self.no_interpolation {
            leaf.draw_nodes();
        }
        leaf.play(self.path());
        Ok(leaf)
    }

    /// The gesture.
    pub fn path(&self) -> Gesture {
        let settings = self.settings();
        match self.gesture.as_str() {
            "corner" => settings.corner_gesture(self.seconds()),
            "corner-alone" => Gesture {
                grip: Grip::FootCorner,
                ..settings.column_gesture(self.seconds())
            },
            _ => settings.column_gesture(self.seconds()),
        }
    }
}

/// Reads all options by a function that says no to those it does not know;
/// `--json` is everyone's. Returns whether JSON is wanted.
pub fn read(
    parser: &mut Parser,
    mut take: impl FnMut(&str, &mut Parser) -> Result<bool, String>,
) -> Result<bool, String> {
    let mut json = false;
    while let Some(argument) = parser.next().map_err(|error| error.to_string())? {
        let name = match argument {
            Arg::Long(name) => name.to_owned(),
            Arg::Short(letter) => {
                return Err(format!("There is no option -{letter}; --help lists all."));
            }
            Arg::Value(value) => {
                return Err(format!(
                    "\"{}\" is one argument too many.",
                    value.to_string_lossy()
                ));
            }
        };
        if name == "json" {
            json = true;
        } else if !take(&name, parser)? {
            return Err(format!(
                "This experiment has no option --{name}; --help lists all."
            ));
        }
    }
    Ok(json)
}

/// The option's value as text.
pub fn text(parser: &mut Parser, option: &str) -> Result<String, String> {
    let value = parser
        .value()
        .map_err(|_| format!("--{option} needs a value."))?;
    value
        .into_string()
        .map_err(|_| format!("The value of --{option} is not text."))
}

/// Position of the option's value among the names that it may have.
pub fn choice(parser: &mut Parser, option: &str, names: &[&str]) -> Result<usize, String> {
    let value = text(parser, option)?;
    names
        .iter()
        .position(|name| *name == value)
        .ok_or_else(|| format!("--{option} is {}, not \"{value}\".", names.join(" or ")))
}

/// The option's value as a number between bounds.
pub fn number<T: FromStr + PartialOrd + std::fmt::Display>(
    parser: &mut Parser,
    option: &str,
    least: T,
    most: T,
) -> Result<T, String> {
    let value = text(parser, option)?;
    match value.parse::<T>() {
        Ok(number) if number >= least && number <= most => Ok(number),
        _ => Err(format!(
            "--{option} is a number from {least} to {most}, not \"{value}\"."
        )),
    }
}

fn seconds(parser: &mut Parser, option: &str, least: f32) -> Result<f32, String> {
    number(parser, option, least, 3600.0)
}
