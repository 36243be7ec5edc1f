//! One moment of a turn as a picture, painted from far to near.

use std::path::Path as FilePath;

use tiny_skia::{
    Color, FillRule, GradientStop, LineCap, Paint, Path, PathBuilder, Pixmap, PixmapPaint, Point,
    RadialGradient, SpreadMode, Stroke, Transform,
};

use super::camera::{Camera, dot};
use super::label;
use super::moment::Moment;

/// Direction to the light, of length 1.
const LIGHT: [f32; 3] = [-0.42, -0.38, 0.824];
/// The two sides of the paper, in linear parts of 255.
const RECTO: [f32; 3] = [252.0, 247.0, 236.0];
const VERSO: [f32; 3] = [231.0, 234.0, 240.0];
/// How much nearer springs and masses count than the paper that they lie in.
const LIFT: f32 = 0.06;

/// Writes a picture into a folder; returns its path.
///
/// # Errors
/// Where it cannot be written, in a sentence.
pub fn save(picture: &Pixmap, folder: &FilePath, name: &str) -> Result<String, String> {
    let path = folder.join(name).display().to_string();
    match picture.save_png(&path) {
        Ok(()) => Ok(path),
        Err(error) => Err(format!("{path} cannot be written: {error}.")),
    }
}

/// Background of a picture.
pub fn paper() -> Color {
    Color::from_rgba8(244, 242, 238, 255)
}

/// What is painted, and how far from the eye it lies.
enum Piece {
    Cell([[f32; 3]; 4], [f32; 3]),
    Triangle([[f32; 3]; 3]),
    Spring([[f32; 3]; 2], bool),
    Mass([f32; 3]),
}

/// Paints a moment.
pub fn moment(moment: &Moment, page: f32, camera: &Camera) -> Pixmap {
    let mut picture = Pixmap::new(camera.size.0, camera.size.1).expect("a picture has a size");
    picture.fill(paper());
    table(&mut picture, page, camera);
    shadow(&mut picture, moment, camera);
    let mut pieces = pieces(moment, camera);
    pieces.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (_, piece) in &pieces {
        match piece {
            Piece::Cell(corners, normal) => {
                let paint = face(&mut picture, corners, *normal, camera);
                stroke(&mut picture, corners, true, &paint, 0.0007, camera);
            }
            Piece::Triangle(corners) => {
                face(&mut picture, corners, across(corners), camera);
            }
            Piece::Spring(ends, shear) => spring(&mut picture, ends, *shear, camera),
            Piece::Mass(centre) => mass(&mut picture, *centre, camera),
        }
    }
    let unit = camera.size.0 as f32;
    let text = format!("t = {:.2} s", moment.time);
    label::write(
        &mut picture,
        &text,
        (0.035 * unit, 0.035 * unit),
        0.024 * unit,
        &solid([92.0, 86.0, 80.0], 1.0),
    );
    picture
}

/// The two pages' places on the table, and the spine.
fn table(picture: &mut Pixmap, page: f32, camera: &Camera) {
    let both = [
        [-1.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, page, 0.0],
        [-1.0, page, 0.0],
    ];
    fill(picture, &both, solid([233.0, 229.0, 222.0], 1.0), camera);
    let line = solid([196.0, 189.0, 180.0], 1.0);
    stroke(picture, &both, true, &line, 0.0014, camera);
    stroke(
        picture,
        &[[0.0, 0.0, 0.0], [0.0, page, 0.0]],
        false,
        &line,
        0.0022,
        camera,
    );
}

/// The sheet's shadow from straight above, softened by laying it down often.
fn shadow(picture: &mut Pixmap, moment: &Moment, camera: &Camera) {
    let mut layer = Pixmap::new(picture.width(), picture.height()).expect("a picture has a size");
    let black = solid([58.0, 46.0, 34.0], 1.0);
    for corners in cells(moment.mesh) {
        let flat = corners.map(|i| {
            let p = moment.points[i];
            [p[0] + 0.10 * p[2], p[1] + 0.10 * p[2], 0.0]
        });
        fill(&mut layer, &flat, black.clone(), camera);
        stroke(&mut layer, &flat, true, &black, 0.001, camera);
    }
    let reach = 0.012 * picture.width() as f32;
    for ring in 0..24 {
        let angle = ring as f32 * 2.399_963;
        let radius = reach * ((ring as f32 + 0.5) / 24.0).sqrt();
        let place = Transform::from_translate(radius * angle.cos(), 0.5 * radius * angle.sin());
        let paint = PixmapPaint {
            opacity: 0.011,
            ..PixmapPaint::default()
        };
        picture.draw_pixmap(0, 0, layer.as_ref(), &paint, place, None);
    }
}

/// Corners of each cell of a mesh.
fn cells(mesh: (usize, usize)) -> impl Iterator<Item = [usize; 4]> {
    let (columns, rows) = mesh;
    (0..rows - 1).flat_map(move |row| {
        (0..columns - 1).map(move |column| {
            let a = row * columns + column;
            [a, a + 1, a + 1 + columns, a + columns]
        })
    })
}

fn pieces(moment: &Moment, camera: &Camera) -> Vec<(f32, Piece)> {
    let mut pieces = Vec::new();
    for corners in &moment.triangles {
        let points = corners.map(|i| moment.points[i]);
        let depth = points.map(|p| camera.see(p).2).iter().sum::<f32>() / 3.0;
        pieces.push((depth, Piece::Triangle(points)));
    }
    if !pieces.is_empty() {
        return pieces;
    }
    for corners in cells(moment.mesh) {
        let points = corners.map(|i| moment.points[i]);
        let normals = corners.map(|i| moment.normals[i]);
        let depth = points.map(|p| camera.see(p).2).iter().sum::<f32>() / 4.0;
        let normal = [0, 1, 2].map(|axis| normals.iter().map(|n| n[axis]).sum::<f32>() / 4.0);
        pieces.push((depth, Piece::Cell(points, normal)));
    }
    let (columns, rows) = moment.grid;
    let mass = |column: usize, row: usize| moment.masses[row * columns + column];
    let mut join = |a: [f32; 3], b: [f32; 3], shear: bool| {
        // In short parts, each at its own depth.
        for part in 0..4 {
            let at =
                |part: i32| [0, 1, 2].map(|axis| a[axis] + (b[axis] - a[axis]) * part as f32 / 4.0);
            let ends = [at(part), at(part + 1)];
            let depth = (camera.see(ends[0]).2 + camera.see(ends[1]).2) / 2.0;
            pieces.push((depth - LIFT, Piece::Spring(ends, shear)));
        }
    };
    for row in 0..rows {
        for column in 0..columns {
            let (right, up) = (column + 1 < columns, row + 1 < rows);
            if right {
                join(mass(column, row), mass(column + 1, row), false);
            }
            if up {
                join(mass(column, row), mass(column, row + 1), false);
            }
            if right && up {
                join(mass(column, row), mass(column + 1, row + 1), true);
                join(mass(column + 1, row), mass(column, row + 1), true);
            }
        }
    }
    for &centre in &moment.masses {
        pieces.push((camera.see(centre).2 - 2.0 * LIFT, Piece::Mass(centre)));
    }
    pieces
}

/// Unit normal of a triangle.
fn across([a, b, c]: &[[f32; 3]; 3]) -> [f32; 3] {
    let [u, v] = [b, c].map(|p| [0, 1, 2].map(|axis| p[axis] - a[axis]));
    let n = [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ];
    let length = dot(n, n).sqrt().max(1e-12);
    n.map(|x| x / length)
}

/// Fills a face of the paper. Returns what lines on it are drawn with.
fn face(
    picture: &mut Pixmap,
    corners: &[[f32; 3]],
    normal: [f32; 3],
    camera: &Camera,
) -> Paint<'static> {
    let facing = camera.faces(corners[0], normal);
    let (side, n) = if facing {
        (RECTO, normal)
    } else {
        (VERSO, normal.map(|value| -value))
    };
    let light = dot(n, LIGHT);
    // Some light comes through the sheet from behind.
    let shade = 0.70
        + if light > 0.0 {
            0.30 * light
        } else {
            0.10 * light
        };
    let paint = solid(side.map(|value| value * shade), 1.0);
    fill(picture, corners, paint.clone(), camera);
    stroke(picture, corners, true, &paint, 0.0006, camera);
    solid(side.map(|value| value * shade * 0.80), 1.0)
}

fn spring(picture: &mut Pixmap, ends: &[[f32; 3]; 2], shear: bool, camera: &Camera) {
    let (colour, width) = if shear {
        ([150.0, 160.0, 176.0], 0.0010)
    } else {
        ([78.0, 92.0, 116.0], 0.0017)
    };
    stroke(picture, ends, false, &solid(colour, 0.9), width, camera);
}

fn mass(picture: &mut Pixmap, centre: [f32; 3], camera: &Camera) {
    let (x, y, depth) = camera.see(centre);
    ball(picture, (x, y), 0.021 * camera.pixels(depth));
}

/// A red ball, pixels.
pub(super) fn ball(picture: &mut Pixmap, (x, y): (f32, f32), radius: f32) {
    let Some(ball) = PathBuilder::from_circle(x, y, radius) else {
        return;
    };
    let light = Point::from_xy(x - 0.35 * radius, y - 0.42 * radius);
    let stops = vec![
        GradientStop::new(0.0, Color::from_rgba8(255, 156, 138, 255)),
        GradientStop::new(0.45, Color::from_rgba8(214, 52, 44, 255)),
        GradientStop::new(1.0, Color::from_rgba8(128, 18, 22, 255)),
    ];
    let shader = RadialGradient::new(
        light,
        light,
        1.35 * radius,
        stops,
        SpreadMode::Pad,
        Transform::identity(),
    );
    let Some(shader) = shader else { return };
    let paint = Paint {
        shader,
        anti_alias: true,
        ..Paint::default()
    };
    picture.fill_path(
        &ball,
        &paint,
        FillRule::Winding,
        Transform::identity(),
        None,
    );
}

fn outline(points: &[[f32; 3]], closed: bool, camera: &Camera) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (index, &point) in points.iter().enumerate() {
        let (x, y, _) = camera.see(point);
        if index == 0 {
            path.move_to(x, y)
        } else {
            path.line_to(x, y)
        }
    }
    if closed {
        path.close();
    }
    path.finish()
}

fn fill(picture: &mut Pixmap, points: &[[f32; 3]], paint: Paint, camera: &Camera) {
    if let Some(path) = outline(points, true, camera) {
        picture.fill_path(
            &path,
            &paint,
            FillRule::Winding,
            Transform::identity(),
            None,
        );
    }
}

/// Strokes a line, `width` as part of the picture's width.
pub(super) fn stroke(
    picture: &mut Pixmap,
    points: &[[f32; 3]],
    closed: bool,
    paint: &Paint,
    width: f32,
    camera: &Camera,
) {
    let width = width * camera.size.0 as f32;
    let stroke = Stroke {
        width,
        line_cap: LineCap::Round,
        ..Stroke::default()
    };
    if let Some(path) = outline(points, closed, camera) {
        picture.stroke_path(&path, paint, &stroke, Transform::identity(), None);
    }
}

/// A paint of a colour (red, green and blue, 0 to 1) and an opacity, 0 to 1.
pub(super) fn solid<'a>(colour: [f32; 3], opacity: f32) -> Paint<'a> {
    let [r, g, b] = colour.map(|value| value.clamp(0.0, 255.0) as u8);
    let mut paint = Paint {
        anti_alias: true,
        ..Paint::default()
    };
    paint.set_color_rgba8(r, g, b, (opacity * 255.0) as u8);
    paint
}
