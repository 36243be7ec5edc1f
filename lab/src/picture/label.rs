//! Text in a picture.

use tiny_skia::{FillRule, Paint, PathBuilder, Pixmap, Transform};
use ttf_parser::{Face, OutlineBuilder};

/// Writes a text with its upper left corner at a pixel, its capitals `height` pixels high.
pub fn write(picture: &mut Pixmap, text: &str, at: (f32, f32), height: f32, paint: &Paint) {
    let face = Face::parse(dejavu::sans::regular(), 0).expect("the crate has a whole typeface");
    let capital = face
        .glyph_index('H')
        .and_then(|glyph| face.glyph_bounding_box(glyph))
        .expect("the typeface has capitals");
    let scale = height / f32::from(capital.y_max);
    let mut x = at.0;
    for character in text.chars() {
        let glyph = face.glyph_index(character).unwrap_or_default();
        let mut outline = Outline(PathBuilder::new());
        face.outline_glyph(glyph, &mut outline);
        if let Some(path) = outline.0.finish() {
            let place = Transform::from_scale(scale, -scale).post_translate(x, at.1 + height);
            picture.fill_path(&path, paint, FillRule::Winding, place, None);
        }
        x += scale * f32::from(face.glyph_hor_advance(glyph).unwrap_or(0));
    }
}

struct Outline(PathBuilder);

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.0.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.0.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.0.close();
    }
}
