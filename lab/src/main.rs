//! `lab`: experiments on the engine. Prints tables for people, and JSON with
//! `--json`.

mod exact;
mod options;
mod picture;
mod simulate;
mod table1;
mod turn;

use std::process::ExitCode;

const USAGE: &str = "\
Experiments on the Turnleaf engine.

Usage: lab EXPERIMENT [options]

  table1    time of a turn without and with key frames, as Table 1 of the paper
              --runs N              rows of the table (10)
              --frames masses|surface  what the key frames hold (masses)
              --blend linear|hermite   how the replay blends them (linear)
              --interpolate key-frame|frame  when a replay of masses interpolates (key-frame)
  turn      one turn: strains over all steps, cost of a step and of a surface
  picture   a turn as a sequence of PNG pictures
              --out DIR             folder for the pictures (pictures)
              --frames N            number of pictures (6)
              --size PIXELS         width of a picture (960)
  turn and picture take:
              --model mass-spring   (the only one so far)
              --preset paper-2014|book  (paper-2014)
              --gesture column|corner   (column)
              --seconds T           duration of the gesture (11.4; book: 0.8)
              --settle T            time simulated after it (2; book: 1)
              --integrator explicit-euler|semi-implicit-euler|runge-kutta-4
              --no-sync             without synchronisation
              --no-interpolation    draw the masses themselves
  all take    --json                print JSON
";

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(sentence) => {
            eprintln!("lab: {sentence}");
            ExitCode::from(2)
        }
    }
}

fn run() -> Result<(), String> {
    let mut parser = lexopt::Parser::from_env();
    let name = match parser.next().map_err(|error| error.to_string())? {
        Some(lexopt::Arg::Value(name)) => name.to_string_lossy().into_owned(),
        Some(lexopt::Arg::Long("help") | lexopt::Arg::Short('h')) => {
            print!("{USAGE}");
            return Ok(());
        }
        _ => {
            return Err(
                "Name an experiment first: table1, turn or picture; --help lists all options."
                    .into(),
            );
        }
    };
    match name.as_str() {
        "table1" => table1::run(&mut parser),
        "turn" => turn::run(&mut parser),
        "picture" => picture::run(&mut parser),
        _ => Err(format!(
            "There is no experiment \"{name}\"; there are table1, turn and picture."
        )),
    }
}
