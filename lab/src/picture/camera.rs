//! Where the pictures are seen from.

use super::moment::Moment;

/// A perspective camera, fitted to all moments of a turn.
pub struct Camera {
    right: [f32; 3],
    up: [f32; 3],
    toward: [f32; 3],
    centre: [f32; 3],
    distance: f32,
    scale: f32,
    shift: (f32, f32),
    /// Width and height of a picture in pixels.
    pub size: (u32, u32),
}

/// Direction of view: radians about the vertical, and above the table.
const AZIMUTH: f32 = -0.30;
const ELEVATION: f32 = 0.46;
/// Part of a picture left free on each side, of its width.
const MARGIN: f32 = 0.05;

impl Camera {
    /// A camera from which all moments, and the table under them, are seen.
    pub fn around(moments: &[Moment], page: f32, width: u32) -> Self {
        let (sin, cos) = AZIMUTH.sin_cos();
        let (rise, level) = ELEVATION.sin_cos();
        let toward = [sin * level, -cos * level, rise];
        let mut camera = Self {
            right: [cos, sin, 0.0],
            up: [-sin * rise, cos * rise, level],
            toward,
            centre: [0.0, page / 2.0, 0.3],
            distance: 6.0 * page.max(1.0),
            scale: 1.0,
            shift: (0.0, 0.0),
            size: (width, width),
        };
        let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        let corners = [
            [-1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [-1.0, page, 0.0],
            [1.0, page, 0.0],
        ];
        for point in moments
            .iter()
            .flat_map(|moment| &moment.points)
            .chain(&corners)
        {
            let (x, y, _) = camera.see(*point);
            low = [low[0].min(x), low[1].min(y)];
            high = [high[0].max(x), high[1].max(y)];
        }
        let room = width as f32 * (1.0 - 2.0 * MARGIN);
        camera.scale = room / (high[0] - low[0]);
        let margin = width as f32 * MARGIN;
        camera.shift = (
            margin - low[0] * camera.scale,
            1.6 * margin - low[1] * camera.scale,
        );
        let height = (high[1] - low[1]) * camera.scale + 2.6 * margin;
        camera.size.1 = (height.ceil() as u32).max(64);
        camera
    }

    /// Pixel, and distance from the eye, of a point.
    pub fn see(&self, point: [f32; 3]) -> (f32, f32, f32) {
        let d = [0, 1, 2].map(|axis| point[axis] - self.centre[axis]);
        let depth = self.distance - dot(d, self.toward);
        let near = self.distance / depth;
        let (x, y) = (dot(d, self.right) * near, -dot(d, self.up) * near);
        (
            x * self.scale + self.shift.0,
            y * self.scale + self.shift.1,
            depth,
        )
    }

    /// Pixels of one unit of length at a depth.
    pub fn pixels(&self, depth: f32) -> f32 {
        self.scale * self.distance / depth
    }

    /// Whether the side of a surface to which `normal` points is seen at `point`.
    pub fn faces(&self, point: [f32; 3], normal: [f32; 3]) -> bool {
        let eye = [0, 1, 2]
            .map(|axis| self.centre[axis] + self.distance * self.toward[axis] - point[axis]);
        dot(eye, normal) > 0.0
    }
}

/// The scalar product.
pub fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
