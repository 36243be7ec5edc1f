//! A time in strokes, so that no font is needed.

use tiny_skia::{LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

/// Strokes of a character in a box 4 wide and 6 high, y down; and its width.
fn strokes(character: char) -> (&'static [&'static [(f32, f32)]], f32) {
    match character {
        '0' => (
            &[&[
                (1.0, 0.0),
                (3.0, 0.0),
                (4.0, 1.2),
                (4.0, 4.8),
                (3.0, 6.0),
                (1.0, 6.0),
                (0.0, 4.8),
                (0.0, 1.2),
                (1.0, 0.0),
            ]],
            4.0,
        ),
        '1' => (&[&[(0.6, 1.4), (2.2, 0.0), (2.2, 6.0)]], 4.0),
        '2' => (
            &[&[
                (0.0, 1.3),
                (1.0, 0.0),
                (3.0, 0.0),
                (4.0, 1.3),
                (3.7, 2.6),
                (0.0, 6.0),
                (4.0, 6.0),
            ]],
            4.0,
        ),
        '3' => (
            &[
                &[
                    (0.1, 0.8),
                    (1.1, 0.0),
                    (3.0, 0.0),
                    (3.9, 1.0),
                    (3.7, 2.2),
                    (2.6, 2.8),
                    (1.5, 2.8),
                ],
                &[
                    (2.6, 2.8),
                    (4.0, 3.7),
                    (4.0, 5.0),
                    (3.0, 6.0),
                    (1.0, 6.0),
                    (0.0, 5.1),
                ],
            ],
            4.0,
        ),
        '4' => (&[&[(3.1, 6.0), (3.1, 0.0), (0.0, 4.2), (4.2, 4.2)]], 4.2),
        '5' => (
            &[&[
                (3.7, 0.0),
                (0.6, 0.0),
                (0.3, 2.8),
                (1.3, 2.3),
                (2.8, 2.3),
                (4.0, 3.4),
                (4.0, 4.8),
                (2.9, 6.0),
                (1.0, 6.0),
                (0.0, 5.2),
            ]],
            4.0,
        ),
        '6' => (
            &[&[
                (3.4, 0.2),
                (2.2, 0.0),
                (0.6, 1.4),
                (0.0, 3.6),
                (0.2, 5.0),
                (1.2, 6.0),
                (2.9, 6.0),
                (4.0, 4.8),
                (3.9, 3.5),
                (2.8, 2.5),
                (1.3, 2.6),
                (0.1, 3.8),
            ]],
            4.0,
        ),
        '7' => (&[&[(0.0, 0.0), (4.0, 0.0), (1.5, 6.0)]], 4.0),
        '8' => (
            &[&[
                (1.2, 2.8),
                (0.3, 1.9),
                (0.3, 0.9),
                (1.2, 0.0),
                (2.8, 0.0),
                (3.7, 0.9),
                (3.7, 1.9),
                (2.8, 2.8),
                (1.2, 2.8),
                (0.0, 3.9),
                (0.0, 5.0),
                (1.1, 6.0),
                (2.9, 6.0),
                (4.0, 5.0),
                (4.0, 3.9),
                (2.8, 2.8),
            ]],
            4.0,
        ),
        '9' => (
            &[&[
                (0.6, 5.8),
                (1.8, 6.0),
                (3.4, 4.6),
                (4.0, 2.4),
                (3.8, 1.0),
                (2.8, 0.0),
                (1.1, 0.0),
                (0.0, 1.2),
                (0.1, 2.5),
                (1.2, 3.5),
                (2.7, 3.4),
                (3.9, 2.2),
            ]],
            4.0,
        ),
        '.' => (&[&[(0.3, 5.9), (0.4, 6.0)]], 0.8),
        't' => (
            &[
                &[(1.1, 0.6), (1.1, 5.2), (1.8, 6.0), (2.7, 5.8)],
                &[(0.0, 2.2), (2.6, 2.2)],
            ],
            2.8,
        ),
        '=' => (&[&[(0.0, 2.6), (3.4, 2.6)], &[(0.0, 4.4), (3.4, 4.4)]], 3.4),
        's' => (
            &[&[
                (3.0, 2.7),
                (2.2, 2.1),
                (0.9, 2.1),
                (0.1, 2.8),
                (0.3, 3.6),
                (2.8, 4.4),
                (3.1, 5.2),
                (2.3, 6.0),
                (0.8, 6.0),
                (0.0, 5.4),
            ]],
            3.1,
        ),
        _ => (&[], 1.2),
    }
}

/// Writes a text with its upper left corner at a pixel, `height` pixels high.
pub fn write(picture: &mut Pixmap, text: &str, at: (f32, f32), height: f32, paint: &Paint) {
    let unit = height / 6.0;
    let mut x = at.0;
    let stroke = Stroke {
        width: 0.72 * unit,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        ..Stroke::default()
    };
    for character in text.chars() {
        let (lines, width) = strokes(character);
        if let Some(path) = outline(lines, (x, at.1), unit) {
            picture.stroke_path(&path, paint, &stroke, Transform::identity(), None);
        }
        x += (width + 1.4) * unit;
    }
}

fn outline(lines: &[&[(f32, f32)]], at: (f32, f32), unit: f32) -> Option<Path> {
    let mut path = PathBuilder::new();
    for line in lines {
        for (index, (x, y)) in line.iter().enumerate() {
            let (x, y) = (at.0 + x * unit, at.1 + y * unit);
            if index == 0 {
                path.move_to(x, y)
            } else {
                path.line_to(x, y)
            }
        }
    }
    path.finish()
}
