//! Options that experiments share, and how options with names or bounds are read.

use std::fmt::Display;
use std::path::Path;
use std::str::FromStr;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use turnleaf_engine::{
    Gesture, Grip, Integrator, MassSpring, ModelKind, Preset, Settings, Stock, Synchronise, TurnBy,
};

/// A parser of an option whose value is one of some names.
fn one_of<T: Copy + Send + Sync>(
    all: &'static [T],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.iter().map(|one| name(*one))).map(move |given| {
        let found = all.iter().find(|one| name(**one) == given);
        *found.expect("the parser has checked the name")
    })
}

/// The same, or none for another word.
fn one_of_or<T: Copy + Send + Sync>(
    all: &'static [T],
    name: fn(T) -> &'static str,
    other: &'static str,
) -> impl TypedValueParser<Value = Option<T>> {
    let names = all.iter().map(|one| name(*one)).chain([other]);
    PossibleValuesParser::new(names)
        .map(move |given| all.iter().copied().find(|one| name(*one) == given))
}

/// The name of a preset stock.
pub fn stock_name() -> impl TypedValueParser<Value = &'static str> {
    one_of(&Stock::NAMES, |name| name)
}

/// A stock's name; none for all of them. clap takes no `Option` itself for a value.
pub type StockOrAll = Option<&'static str>;

/// The name of a preset stock, or `all`.
pub fn stock_name_or_all() -> impl TypedValueParser<Value = StockOrAll> {
    one_of_or(&Stock::NAMES, |name| name, "all")
}

/// The stock of a preset's name.
pub fn stock(name: &str) -> Stock {
    Stock::named(name).expect("the parser has checked the name")
}

/// A model of loose leaves.
pub fn model_kind() -> impl TypedValueParser<Value = ModelKind> {
    one_of(ModelKind::ALL, ModelKind::name)
}

/// A model of loose leaves; none for the paper's own leaf.
pub type ModelOrPaper = Option<ModelKind>;

/// A model of loose leaves, or `paper`.
pub fn model_kind_or_paper() -> impl TypedValueParser<Value = ModelOrPaper> {
    one_of_or(ModelKind::ALL, ModelKind::name, "paper")
}

/// A gesture of a loose leaf.
pub fn turn_by() -> impl TypedValueParser<Value = TurnBy> {
    one_of(&TurnBy::ALL, TurnBy::name)
}

/// A number between bounds.
pub fn between<T>(least: T, most: T) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: FromStr + PartialOrd + Display + Copy,
{
    move |text| match text.parse::<T>() {
        Ok(number) if number >= least && number <= most => Ok(number),
        _ => Err(format!("it is a number from {least} to {most}")),
    }
}

/// Makes a folder that a command is to write into, so that one that cannot be made is
/// reported before anything is measured.
///
/// # Errors
/// Where it cannot be made, in a sentence.
pub fn make_folder(folder: &Path) -> Result<(), String> {
    std::fs::create_dir_all(folder)
        .map_err(|error| format!("The folder {} cannot be made: {error}.", folder.display()))
}

/// Makes the folder of a file that a command is to write.
///
/// # Errors
/// Where it cannot be made, in a sentence.
pub fn make_folder_of(file: &Path) -> Result<(), String> {
    file.parent().map_or(Ok(()), make_folder)
}

/// Which turn of the mass-spring leaf to simulate.
#[derive(Args)]
pub struct Scene {
    /// The leaf's model; for others see `lab keyframes` and `lab models`.
    #[arg(long, default_value = "mass-spring", value_parser = ["mass-spring"])]
    model: String,
    /// The leaf's constants: the paper's, or those of a page of a book.
    #[arg(long, default_value = "paper-2014", value_parser = one_of(&[Preset::Paper2014, Preset::Book], Preset::name))]
    pub preset: Preset,
    /// What is moved: the control column, the column with its foot first, or the foot corner alone.
    #[arg(long, default_value = "column", value_parser = ["column", "corner", "corner-alone"])]
    pub gesture: String,
    /// Duration of the gesture, s [default: 11.4, of a book 0.8]
    #[arg(long, value_parser = between(0.05f32, 3600.0))]
    seconds: Option<f32>,
    /// Time simulated after it, s [default: 2, of a book 1]
    #[arg(long, value_parser = between(0.0f32, 3600.0))]
    settle: Option<f32>,
    /// The integrator [default: the preset's]
    #[arg(long, value_parser = one_of(&[Integrator::ExplicitEuler, Integrator::SemiImplicitEuler, Integrator::RungeKutta4], integrator_name))]
    integrator: Option<Integrator>,
    #[command(flatten)]
    sync: Synchronisation,
    /// Draw the masses themselves.
    #[arg(long)]
    pub no_interpolation: bool,
}

fn integrator_name(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::ExplicitEuler => "explicit-euler",
        Integrator::SemiImplicitEuler => "semi-implicit-euler",
        Integrator::RungeKutta4 => "runge-kutta-4",
    }
}

/// How a mass-spring leaf is synchronised.
#[derive(Args)]
pub struct Synchronisation {
    /// Synchronisation: the preset's reading, the paper's word for word, or none.
    #[arg(long, default_value = "preset", value_parser = ["preset", "paper", "off"])]
    sync: String,
}

impl Synchronisation {
    /// Whether it is the preset's own.
    pub fn is_preset(&self) -> bool {
        self.sync == "preset"
    }

    /// Puts it into the settings of a leaf.
    pub fn set(&self, settings: &mut Settings) {
        match &self.sync[..] {
            "paper" => settings.synchronise = Synchronise::Literal,
            "off" => settings.synchronise = Synchronise::Off,
            _ => {}
        }
    }
}

/// Page of the preset `book` where no other is named: metres, and kilograms a
/// square metre.
const PAGE: (f32, f32, f32) = (0.140, 0.210, 0.070);

impl Scene {
    /// Duration of the gesture.
    pub fn seconds(&self) -> f32 {
        let is_book = self.preset == Preset::Book;
        self.seconds.unwrap_or(if is_book { 0.8 } else { 11.4 })
    }

    /// Time simulated after it.
    pub fn settle(&self) -> f32 {
        let is_book = self.preset == Preset::Book;
        self.settle.unwrap_or(if is_book { 1.0 } else { 2.0 })
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
    ///
    /// # Errors
    /// Where its settings make none, in a sentence.
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
        let column = settings.column_gesture(self.seconds());
        match &self.gesture[..] {
            "corner" => settings.corner_gesture(self.seconds()),
            "corner-alone" => Gesture {
                grip: Grip::FootCorner,
                ..column
            },
            _ => column,
        }
    }
}
