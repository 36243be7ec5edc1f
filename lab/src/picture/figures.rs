//! Counterparts of figures 1 to 5 of Shangguan and Zeng 2014, from the engine's own
//! leaf with the paper's constants: the mass-spring system, the three kinds of
//! springs, bent paper, the dog-ear line and the lines parallel to it, and the flow
//! of a step. Their figures 6 and 7 are what `lab picture` draws of a whole turn.

use std::f32::consts::FRAC_PI_4;
use std::path::Path;

use tiny_skia::{Paint, PathBuilder, Pixmap, PixmapPaint, Stroke, Transform};
use turnleaf_engine::{
    Gesture, Grip, Integrator, MassSpring, PAPER_INTERVAL, Settings, Synchronise, TurnModel,
};

use super::camera::Camera;
use super::moment::Moment;
use super::{draw, label};

/// Duration of the turns.
const SECONDS: f32 = 11.4;
/// Side of the square page whose corner is lifted, metres.
const PAGE: f32 = 0.14;
const INK: [f32; 3] = [64.0, 58.0, 52.0];
const RED: [f32; 3] = [181.0, 72.0, 47.0];
const BLUE: [f32; 3] = [44.0, 92.0, 140.0];

/// Writes figure-1.png to figure-4.png and figure-5.svg into a folder; returns their
/// paths.
///
/// # Errors
/// Where a leaf cannot be made or a picture cannot be written, in a sentence.
pub fn write(out: &Path, size: u32) -> Result<Vec<String>, String> {
    let pictures = [
        masses_and_springs(size)?,
        kinds_of_springs(size)?,
        bent(size)?,
        dog_ear(size)?,
    ];
    let mut files = Vec::new();
    for (index, picture) in pictures.iter().enumerate() {
        files.push(draw::save(
            picture,
            out,
            &format!("figure-{}.png", index + 1),
        )?);
    }
    let path = out.join("figure-5.svg").display().to_string();
    std::fs::write(&path, flow()?)
        .map_err(|error| format!("{path} cannot be written: {error}."))?;
    files.push(path);
    Ok(files)
}

/// The paper's leaf after a part of a turn.
fn leaf_at(synchronise: Synchronise, grip: Grip, part: f32) -> Result<MassSpring, String> {
    let settings = Settings {
        synchronise,
        ..Settings::paper_2014()
    };
    let gesture = Gesture {
        grip,
        ..settings.column_gesture(SECONDS)
    };
    let mut leaf = MassSpring::new(settings).map_err(|error| error.to_string())?;
    leaf.play(gesture);
    let steps = (part * SECONDS / leaf.time_step()).round() as usize;
    (0..steps).for_each(|_| leaf.step());
    Ok(leaf)
}

/// Figure 1: masses joined by springs, in the middle of a turn, without paper.
fn masses_and_springs(size: u32) -> Result<Pixmap, String> {
    let all = Moment::of(&mut leaf_at(Synchronise::Columns, Grip::ForeEdge, 0.36)?);
    let camera = Camera::around(std::slice::from_ref(&all), 1.0, size);
    let bare = Moment {
        mesh: (1, 1),
        ..all
    };
    Ok(draw::moment(&bare, 1.0, &camera))
}

/// Figure 2: structural, shear and bend springs of the same masses, side by side.
fn kinds_of_springs(size: u32) -> Result<Pixmap, String> {
    let leaf = leaf_at(Synchronise::Off, Grip::ForeEdge, 0.0)?;
    let (columns, rows) = leaf.grid_size();
    let side = size / 3;
    let mut picture = Pixmap::new(3 * side, side).ok_or("The pictures are too small.")?;
    picture.fill(draw::paper());
    let width = leaf.settings().width;
    let room = 0.76 * side as f32;
    let ball = one_ball(side)?;
    for panel in 0..3 {
        let place = |column: usize, row: usize| {
            let [x, y, _] = leaf.position(column, row);
            let left = panel as f32 * side as f32 + 0.12 * side as f32;
            (
                left + room * (1.0 + x / width),
                0.88 * side as f32 - room * y / width,
            )
        };
        for row in 0..rows {
            for column in 0..columns {
                let ends: &[(usize, i32)] = match panel {
                    0 => &[(1, 0), (0, 1)],
                    1 => &[(1, 1), (1, -1)],
                    _ => &[(2, 0), (0, 2)],
                };
                for &(right, up) in ends {
                    let (to_column, to_row) = (column + right, row as i32 + up);
                    if to_column >= columns || !(0..rows as i32).contains(&to_row) {
                        continue;
                    }
                    // A bend spring passes its middle mass: drawn as a bow beside it,
                    // every other one on the other side.
                    let along = if right > 0 { column } else { row };
                    let lean = if along % 2 == 0 { 0.028 } else { -0.028 };
                    let bow = if panel == 2 { lean * side as f32 } else { 0.0 };
                    let colour = [INK, BLUE, RED][panel];
                    let (from, to) = (place(column, row), place(to_column, to_row as usize));
                    bowed(&mut picture, from, to, bow, &draw::solid(colour, 0.9), side);
                }
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let (x, y) = place(column, row);
                let half = ball.width() as i32 / 2;
                let paint = PixmapPaint::default();
                let (x, y) = (x.round() as i32 - half, y.round() as i32 - half);
                let still = Transform::identity();
                picture.draw_pixmap(x, y, ball.as_ref(), &paint, still, None);
            }
        }
    }
    Ok(picture)
}

/// A mass as the other pictures have it, on nothing.
fn one_ball(side: u32) -> Result<Pixmap, String> {
    let across = (side / 16).max(3);
    let mut ball = Pixmap::new(across, across).ok_or("The pictures are too small.")?;
    draw::ball(
        &mut ball,
        (0.5 * across as f32, 0.5 * across as f32),
        0.46 * across as f32,
    );
    Ok(ball)
}

/// A line that leans aside by `bow` pixels.
fn bowed(picture: &mut Pixmap, a: (f32, f32), b: (f32, f32), bow: f32, paint: &Paint, side: u32) {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length = dx.hypot(dy);
    let middle = (
        0.5 * (a.0 + b.0) + 2.0 * bow * dy / length,
        0.5 * (a.1 + b.1) - 2.0 * bow * dx / length,
    );
    let mut path = PathBuilder::new();
    path.move_to(a.0, a.1);
    path.quad_to(middle.0, middle.1, b.0, b.1);
    let stroke = Stroke {
        width: 0.006 * side as f32,
        ..Stroke::default()
    };
    if let Some(path) = path.finish() {
        picture.stroke_path(&path, paint, &stroke, Transform::identity(), None);
    }
}

/// Figure 3: bent paper lies as on a tube: straight lines along it stay straight.
fn bent(size: u32) -> Result<Pixmap, String> {
    let all = Moment::of(&mut leaf_at(Synchronise::Columns, Grip::ForeEdge, 0.42)?);
    let camera = Camera::around(std::slice::from_ref(&all), 1.0, size);
    let paper = Moment {
        grid: (0, 0),
        masses: Vec::new(),
        ..all
    };
    let mut picture = draw::moment(&paper, 1.0, &camera);
    let (columns, rows) = paper.mesh;
    let ink = draw::solid(INK, 0.75);
    for column in (0..columns).step_by(5) {
        let line: Vec<[f32; 3]> = (0..rows)
            .map(|row| paper.points[row * columns + column])
            .collect();
        draw::stroke(&mut picture, &line, false, &ink, 0.0018, &camera);
    }
    Ok(picture)
}

/// Figure 4: the dog-ear line SR, and a line BE parallel to it that comes to QT.
fn dog_ear(size: u32) -> Result<Pixmap, String> {
    let mut settings = Settings::book(PAGE, PAGE, 0.070);
    settings.synchronise = Synchronise::DogEar { angle: FRAC_PI_4 };
    let gesture = settings.corner_gesture(1.0);
    let mut leaf = MassSpring::new(settings).map_err(|error| error.to_string())?;
    leaf.play(gesture);
    let steps = (0.22 / leaf.time_step()).round() as usize;
    (0..steps).for_each(|_| leaf.step());
    let width = leaf.settings().width;
    let (columns, rows) = leaf.grid_size();
    let apart = leaf.settings().height / (rows - 1) as f32;
    let now = |leaf: &MassSpring, at: (usize, usize)| leaf.position(at.0, at.1).map(|x| x / width);
    let sign = leaf.settings().side.sign();
    let rest = |at: (usize, usize)| {
        let x = sign * at.0 as f32 / (columns - 1) as f32;
        [x, at.1 as f32 * apart / width, 0.0]
    };
    let corner = columns - 1;
    // Masses on the foot and on the fore-edge, two and four from the corner.
    let [b, e] = [(corner - 2, 0), (corner, 2)];
    let [s, r] = [(corner - 4, 0), (corner, 4)];
    let [q, t] = [now(&leaf, b), now(&leaf, e)];
    let [sn, rn] = [now(&leaf, s), now(&leaf, r)];
    let all = Moment::of(&mut leaf);
    let camera = Camera::around(std::slice::from_ref(&all), 1.0, size);
    let paper = Moment {
        grid: (0, 0),
        masses: Vec::new(),
        ..all
    };
    let mut picture = draw::moment(&paper, 1.0, &camera);
    let [red, blue, ink] = [RED, BLUE, INK].map(|colour| draw::solid(colour, 1.0));
    let lines = [
        ([sn, rn], &red, 0.0034),
        ([q, t], &blue, 0.0034),
        ([rest(b), rest(e)], &blue, 0.0020),
        ([rest(b), q], &ink, 0.0012),
        ([rest(e), t], &ink, 0.0012),
    ];
    for (line, paint, wide) in lines {
        draw::stroke(&mut picture, &line, false, paint, wide, &camera);
    }
    let high = 0.026 * size as f32;
    let letters = [
        ("S", sn, (-1.3, 0.3)),
        ("R", rn, (-1.5, -0.6)),
        ("B", rest(b), (-0.3, 0.4)),
        ("E", rest(e), (-1.2, 0.1)),
        ("Q", q, (0.5, -0.2)),
        ("T", t, (-0.3, -1.5)),
    ];
    for (letter, place, (right, down)) in letters {
        let (x, y, _) = camera.see(place);
        label::write(
            &mut picture,
            letter,
            (x + right * high, y + down * high),
            high,
            &ink,
        );
    }
    Ok(picture)
}

/// Figure 5: the flow of the method, with this leaf's own numbers.
fn flow() -> Result<String, String> {
    let leaf = leaf_at(Synchronise::Columns, Grip::ForeEdge, 0.0)?;
    let settings = leaf.settings();
    let (columns, rows) = leaf.grid_size();
    let mut surface = turnleaf_engine::Surface::new(2, 2);
    let mut drawn = leaf.clone();
    drawn.write_surface(&mut surface);
    let integrator = match settings.integrator {
        Integrator::ExplicitEuler => "explicit Euler",
        Integrator::SemiImplicitEuler => "semi-implicit Euler",
        Integrator::RungeKutta4 => "Runge-Kutta",
    };
    let boxes = [
        format!(
            "Set up {} masses and {} springs",
            columns * rows,
            leaf.spring_count()
        ),
        format!("Move the {rows} masses of the control column"),
        "Compute forces: springs, gravity, damping".into(),
        format!("Compute velocities: {integrator}"),
        format!("Compute places, after 1/{:.0} s", 1.0 / settings.time_step),
        "Synchronise by the distance from the dog-ear line".into(),
        format!("Record a key frame every {PAPER_INTERVAL} s"),
        format!(
            "Interpolate {} points (Lagrange) and draw",
            surface.columns * surface.rows
        ),
    ];
    let (wide, high, gap, left, top) = (400.0, 38.0, 22.0, 60.0, 16.0);
    let bottom = |index: usize| top + index as f64 * (high + gap) + high;
    let height = bottom(boxes.len() - 1) + 16.0;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 520 {height}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\" fill=\"#403c36\">\n<title>The flow of the method</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#f4f2ee\"/>\n"
    );
    let middle = left + 0.5 * wide;
    for (index, text) in boxes.iter().enumerate() {
        let y = bottom(index) - high;
        // What the paper adds to the classic method.
        let fill = if index >= 5 { "#f6ddd3" } else { "#ffffff" };
        svg.push_str(&format!(
            "<rect x=\"{left}\" y=\"{y}\" width=\"{wide}\" height=\"{high}\" rx=\"6\" fill=\"{fill}\" stroke=\"#403c36\"/>\n<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">{text}</text>\n",
            y + 24.0
        ));
        if index > 0 {
            svg.push_str(&arrow(
                &format!("M{middle} {}V{y}", y - gap),
                [middle, y],
                [0.0, 1.0],
            ));
        }
    }
    // From the drawn frame back to the control column.
    let (from, to) = (bottom(boxes.len() - 1) - 0.5 * high, bottom(1) - 0.5 * high);
    let right = left + wide;
    let way = format!("M{right} {from}H{}V{to}H{right}", right + 34.0);
    svg.push_str(&arrow(&way, [right, to], [-1.0, 0.0]));
    svg.push_str("</svg>\n");
    Ok(svg)
}

/// A way that ends in a point, to which it comes along a direction.
fn arrow(way: &str, [x, y]: [f64; 2], [along, down]: [f64; 2]) -> String {
    let (back, wide) = (9.0, 4.5);
    let (ax, ay) = (x - back * along, y - back * down);
    format!(
        "<path d=\"{way}\" fill=\"none\" stroke=\"#403c36\"/>\n<path d=\"M{x} {y}L{} {}L{} {}Z\"/>\n",
        ax - wide * down,
        ay - wide * along,
        ax + wide * down,
        ay + wide * along
    )
}
