//! `lab`: experiments on the engine. Prints lines for people, and JSON with
//! `--json`.

mod agree;
mod buckling;
mod cantilever;
mod convergence;
mod crease;
mod creases;
mod d_cone;
mod drop_sheet;
mod energy;
mod exact;
mod fold;
mod gestures;
mod interpolation;
mod keyframes;
mod memory;
mod models;
mod options;
mod pear_loop;
mod picture;
mod report;
mod ridge;
mod simulate;
mod specimen;
mod synchronisation;
mod table;
mod table1;
mod trouser;
mod turn;
mod uses;
mod vibration;

use std::fmt::Display;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use serde::Serialize;

#[global_allocator]
static ALLOCATOR: memory::Counting = memory::Counting;

/// Experiments on the Turnleaf engine.
#[derive(Parser)]
#[command(
    name = "lab",
    disable_help_subcommand = true,
    arg_required_else_help = false
)]
struct Command {
    #[command(subcommand)]
    experiment: Experiment,
    /// Print JSON.
    #[arg(long, global = true)]
    json: bool,
    /// Print tables in Markdown.
    #[arg(long, global = true)]
    markdown: bool,
}

/// In experiments on a piece of paper lengths are over its length, loads over its
/// stiffness, and the exact value stands beside what was found.
#[derive(Subcommand)]
enum Experiment {
    /// Times a turn without and with key frames, as Table 1 of the paper.
    Table1(table1::Options),
    /// Compares both readings of the paper's synchronisation, and none, on the same turns.
    Synchronisation(synchronisation::Options),
    /// Measures one turn of the mass-spring leaf: strains over all steps, cost of a step and of a
    /// surface. For other models see `keyframes` and `models`.
    Turn(turn::Options),
    /// Draws a turn of the mass-spring leaf as a sequence of PNG pictures. For other models see
    /// `models --only NAME --pictures FOLDER`.
    Picture(picture::Options),
    /// Hangs a strip that is clamped at one end by its own weight.
    Cantilever(cantilever::Options),
    /// Hangs a weightless strip by a dead load at its tip.
    TipLoad(cantilever::TipLoadOptions),
    /// Hangs a strip with a crease by its own weight.
    Crease(crease::Options),
    /// Hangs creased strips of sheet and shell beside all exact ones that are known (some minutes).
    Creases(creases::Options),
    /// Pushes paper at a point into a funnel: the sector that is lifted, degrees.
    DCone(d_cone::Options),
    /// Finds how the energy of a stretching ridge grows with its length.
    Ridge(ridge::Options),
    /// Tears a sheet apart by two legs: the pulling force beside half the work of fracture.
    Trouser(trouser::Options),
    /// Folds a page on a table by its creases, as a picture.
    Fold(fold::Options),
    /// Bends a strip until both its ends are in one clamp.
    PearLoop(pear_loop::Options),
    /// Finds the first three roots of a strip clamped at one end, and the damping of the first.
    Vibration(vibration::Options),
    /// Finds the weight at which a strip falls over, clamped at the foot.
    Upright(buckling::UprightOptions),
    /// The same, clamped at one end of a plate in a vertical plane.
    LateralBuckling(buckling::LateralOptions),
    /// Measures the speed at which a sheet falls level in air, m/s.
    DropSheet(drop_sheet::Options),
    /// Measures what a strip loses as it swings undamped in a vacuum.
    Energy(energy::Options),
    /// Compares sheet and shell, turned by the same hand.
    Agree(agree::Options),
    /// Finds the orders by nodes and by step of a strip that hangs at Gamma 10.
    Convergence(convergence::Options),
    /// Compares every way of turning a page on the same three turns (some minutes).
    Models(models::Options),
    /// Compares ways from few nodes to many points: cost, and errors on shapes that are known.
    Interpolation(interpolation::Options),
    /// Plays random gestures on a book: strain, shear, penetration, frames, rest.
    Gestures(gestures::Options),
    /// Reads books as readers do: how often and for how long what is drawn is behind its paper.
    Uses(uses::Options),
    /// Records and condenses a turn: bytes, frames, error over the width.
    Keyframes(keyframes::Options),
}

impl Command {
    fn run(self) -> Result<(), String> {
        match &self.experiment {
            Experiment::Table1(options) => self.print(table1::run(options)?),
            Experiment::Synchronisation(options) => self.print(synchronisation::run(options)?),
            Experiment::Turn(options) => self.print(turn::run(options)?),
            Experiment::Picture(options) => self.print(picture::run(options)?),
            Experiment::Cantilever(options) => self.print(cantilever::run(options)?),
            Experiment::TipLoad(options) => self.print(cantilever::run_tip_load(options)?),
            Experiment::Crease(options) => self.print(crease::run(options)?),
            Experiment::Creases(options) => self.print(creases::run(options)?),
            Experiment::DCone(options) => self.print(d_cone::run(options)?),
            Experiment::Ridge(options) => self.print(ridge::run(options)?),
            Experiment::Trouser(options) => self.print(trouser::run(options)?),
            Experiment::Fold(options) => self.print(fold::run(options)?),
            Experiment::PearLoop(options) => self.print(pear_loop::run(options)?),
            Experiment::Vibration(options) => self.print(vibration::run(options)?),
            Experiment::Upright(options) => self.print(buckling::run_upright(options)?),
            Experiment::LateralBuckling(options) => self.print(buckling::run_lateral(options)?),
            Experiment::DropSheet(options) => self.print(drop_sheet::run(options)?),
            Experiment::Energy(options) => self.print(energy::run(options)?),
            Experiment::Agree(options) => self.print(agree::run(options)?),
            Experiment::Convergence(options) => self.print(convergence::run(options)?),
            Experiment::Models(options) => self.print(models::run(options)?),
            Experiment::Interpolation(options) => self.print(interpolation::run(options)?),
            Experiment::Gestures(options) => self.print(gestures::run(options)?),
            Experiment::Uses(options) => self.print(uses::run(options)?),
            Experiment::Keyframes(options) => self.print(keyframes::run(options)?),
        }
        Ok(())
    }

    /// Prints what an experiment found.
    fn print(&self, found: impl Serialize + Display) {
        match serde_json::to_string_pretty(&found) {
            Ok(text) if self.json => println!("{text}"),
            _ if self.markdown => print!("{found:#}"),
            _ => print!("{found}"),
        }
    }
}

fn main() -> ExitCode {
    let done = match Command::try_parse() {
        Ok(command) => command.run(),
        Err(error) if error.use_stderr() => Err(sentence(&error.to_string())),
        Err(help) => help.exit(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(sentence) => {
            eprintln!("lab: {sentence}");
            ExitCode::from(2)
        }
    }
}

/// What is wrong with a command line, in one sentence: the first paragraph of clap's
/// message.
fn sentence(message: &str) -> String {
    let fault = message.split("\n\n").next().unwrap_or_default();
    let words: Vec<&str> = fault.split_whitespace().skip(1).collect();
    format!("{}; --help lists all options.", words.join(" "))
}
