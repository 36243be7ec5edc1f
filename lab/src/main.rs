//! `lab`: experiments on the engine. Prints lines for people, and JSON with
//! `--json`.

mod agree;
mod buckling;
mod cantilever;
mod convergence;
mod drop_sheet;
mod energy;
mod exact;
mod gestures;
mod interpolation;
mod keyframes;
mod memory;
mod models;
mod options;
mod pear_loop;
mod picture;
mod report;
mod simulate;
mod specimen;
mod synchronisation;
mod table1;
mod turn;
mod vibration;

use std::process::ExitCode;

#[global_allocator]
static ALLOCATOR: memory::Counting = memory::Counting;

const USAGE: &str = "\
Experiments on the Turnleaf engine.

Usage: lab EXPERIMENT [options]

  table1    time of a turn without and with key frames, as Table 1 of the paper
              --runs N              rows of the table (10)
              --frames masses|surface  what the key frames hold (masses)
              --blend linear|hermite   how the replay blends them (linear)
              --interpolate key-frame|frame  when a replay of masses interpolates (key-frame)
              --model paper|sheet|...  the paper's, or a loose leaf of any model, whose
                                    key frames hold the surface (paper)
              --keys even|condensed    of a loose leaf: every 0.1 s, or within 0.1 % (even)
              --seconds T              duration of the turn (11.4)
              --sync preset|paper|off  synchronisation of the paper's leaf (preset)
  synchronisation   both readings of the paper's synchronisation, and none, on
            the same turns: strains, departures from the spine and the hand
              --seconds T           duration of a turn (11.4)
              --markdown            print a table in Markdown
              --into FILE           put the table between its lines in a page of Markdown
  turn      one turn: strains over all steps, cost of a step and of a surface
  picture   a turn as a sequence of PNG pictures
              --out DIR             folder for the pictures (pictures)
              --frames N            number of pictures (6)
              --size PIXELS         width of a picture (960)
              --figures             counterparts of the paper's figures 1 to 5 instead
  turn and picture take:
              --model mass-spring   (the only one so far)
              --preset paper-2014|book  (paper-2014)
              --gesture column|corner|corner-alone   (column)
              --seconds T           duration of the gesture (11.4; book: 0.8)
              --settle T            time simulated after it (2; book: 1)
              --integrator explicit-euler|semi-implicit-euler|runge-kutta-4
              --sync preset|paper|off   synchronisation: the preset's reading, the paper's
                                    word for word, or none (preset)
              --no-interpolation    draw the masses themselves

Experiments on a piece of paper; lengths are over its length, loads over its
stiffness, and the exact answer stands beside what was found:

  cantilever        clamped at one end it hangs by its own weight
                      --gamma G       weight x length^3 / stiffness
                      --clamp-angle DEG  upward from level (0)
                      --nodes N       from the clamp to the tip
  tip-load          the same, weightless, by a dead load P L^2 / stiffness
                      --load P  --nodes N
  pear-loop         its two ends in one clamp; --nodes N
  vibration         first three roots, clamped at one end, and damping of the first
                      --stock bible|book|office|coated|card  (book)
                      --nodes N
  upright           weight at which it falls over, clamped at the foot; --nodes N
  lateral-buckling  the same, clamped at one end of a plate in a vertical plane
                      --nu NU         Poisson's ratio
                      --aspect B      height over length
                      --nodes N
  drop-sheet        speed at which it falls level in air, m/s
                      --stock bible|book|office|coated|card
  energy            what it loses as it swings undamped in a vacuum
                      --periods N     (10)
  agree             sheet against shell, turned by the same hand
                      --stock bible|book|office|coated|card|all  (book)
                      --jobs N        turns computed at once (1)
                      --into FILE     put a table between its lines in a page of Markdown
  convergence       orders by nodes and by step, hanging at Gamma 10
  all take          --model sheet|shell|mass-spring  (sheet; agree: no other)
                    --settings book|lab  of the sheet: a book's leaf, or one on its own (book)

Every way of turning a page:

  models            on the same three turns: cost, memory, distance from the shell,
                    strain, area, angles, creases, spine, drags (some minutes)
                      --stock bible|book|office|coated|card  (book)
                      --nodes N       columns of nodes of the shell (17)
                      --markdown      print a table in Markdown
                      --plot FILE     write cost against fidelity as SVG
                      --pictures DIR  write each at five moments as PNG
                      --into FILE     put the table between its lines in a page of Markdown

  interpolation     from few nodes to many points: cost of a surface, and errors on
                    shapes that are known
                      --markdown      print tables in Markdown
                      --into FILE     put them between their lines in a page of Markdown

Experiments on a book:

  gestures          random hands on its leaves: strain, shear, penetration, frames, rest
                      --count N       gestures (1000)
                      --seed S        seed of the first; each has the next one (1)
                      --stock bible|book|office|coated|card|custom|extreme|presets|all
                                      each in turn; custom: figures as of paper, extreme: any
                                      that a book takes (all)
                      --kind hands|riffle|teleport|circle|pin|apart|mixed|all  what hands do (all)
                      --page any|usual   usual: 140 x 210 mm, still air, the usual binding and
                                      frames; any: all of them at random (any)
                      --worst N       lists the seeds of the N worst (0)
                      --jobs N        played at once (1); times of a frame are then longer
                      --into FILE     put a table between its lines in a page of Markdown
                      --model sheet   there is no other in a book

Key frames to be handed out:

  keyframes         a turn recorded and condensed: bytes, frames, error over the width
                      --model mass-spring|sheet|shell|rigid|peel|cylinder|cone  (sheet)
                      --gesture edge|corner|let-go  (corner)
                      --stock bible|book|office|coated|card  (book)
                      --seconds T     duration of the gesture (0.8)
                      --settle T      time recorded after it (0)
                      --nodes N       columns of the model's nodes (the model's own)
                      --tolerance E   largest error over the width (0.001)
                      --out FILE      writes the file

All take      --json                print JSON
";

const NAMES: &str = "table1, synchronisation, turn, picture, cantilever, tip-load, pear-loop, vibration, upright, lateral-buckling, drop-sheet, energy, convergence, agree, models, interpolation, gestures and keyframes";

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
            return Err(format!(
                "Name an experiment first: {NAMES}; --help lists all options."
            ));
        }
    };
    match name.as_str() {
        "cantilever" => cantilever::run(&mut parser),
        "tip-load" => cantilever::run_tip_load(&mut parser),
        "pear-loop" => pear_loop::run(&mut parser),
        "drop-sheet" => drop_sheet::run(&mut parser),
        "upright" => buckling::run_upright(&mut parser),
        "lateral-buckling" => buckling::run_lateral(&mut parser),
        "vibration" => vibration::run(&mut parser),
        "energy" => energy::run(&mut parser),
        "convergence" => convergence::run(&mut parser),
        "table1" => table1::run(&mut parser),
        "synchronisation" => synchronisation::run(&mut parser),
        "turn" => turn::run(&mut parser),
        "picture" => picture::run(&mut parser),
        "agree" => agree::run(&mut parser),
        "models" => models::run(&mut parser),
        "interpolation" => interpolation::run(&mut parser),
        "gestures" => gestures::run(&mut parser),
        "keyframes" => keyframes::run(&mut parser),
        _ => Err(format!(
            "There is no experiment \"{name}\"; there are {NAMES}."
        )),
    }
}
