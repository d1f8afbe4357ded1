//! Cameras, and the three-quarter view of a whole box.
//!
//! Right-handed, y up; lengths in scene units, angles in degrees.

use super::v3::{V3, v3};

/// A perspective camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The position of the camera.
    pub eye: [f32; 3],
    /// The point at the centre of the picture.
    pub target: [f32; 3],
    /// Approximate upward direction in the picture.
    pub up: [f32; 3],
    /// Vertical field of view in degrees.
    pub fov_y: f32,
}

/// The direction of view when a camera is placed automatically.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Degrees about +y; 0 looks from +z, 90 from +x.
    pub azimuth: f32,
    /// Degrees above the horizon.
    pub elevation: f32,
    /// Vertical field of view in degrees; larger values give more perspective.
    pub fov_y: f32,
    /// Empty border as a share of the picture, on each side.
    pub margin: f32,
}

impl Default for View {
    fn default() -> View {
        View { azimuth: 38.0, elevation: 24.0, fov_y: 26.0, margin: 0.07 }
    }
}

/// The camera's axes and the half-extents of its picture at distance one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lens {
    pub eye: V3,
    pub forward: V3,
    pub right: V3,
    pub up: V3,
    pub half_width: f32,
    pub half_height: f32,
}

impl Camera {
    pub(super) fn lens(&self, aspect: f32) -> Lens {
        let (eye, target) = (V3::from(self.eye), V3::from(self.target));
        let forward = (target - eye).unit();
        let mut up = V3::from(self.up);
        if forward.cross(up).norm() < 1e-5 {
            up = v3(0.0, 0.0, -1.0); // looking straight down: the picture's top is away from +z
        }
        let right = forward.cross(up).unit();
        let half_height = (0.5 * self.fov_y.to_radians()).tan();
        Lens { eye, forward, right, up: right.cross(forward), half_width: half_height * aspect, half_height }
    }

    /// The camera that sees all `points` as large as the margin allows, centred in the picture.
    ///
    /// Give the corners of a box or, for a tighter picture, the vertices themselves. `aspect` is width over height.
    pub fn framing(points: &[[f32; 3]], view: View, aspect: f32) -> Camera {
        let (azimuth, elevation) = (view.azimuth.to_radians(), view.elevation.to_radians());
        let back = v3(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos());
        let up = if back.y.abs() > 0.999 { [0.0, 0.0, -back.y.signum()] } else { [0.0, 1.0, 0.0] };
        let lens = Camera { eye: [0.0; 3], target: (-back).into(), up, fov_y: view.fov_y }.lens(aspect);
        let share = 1.0 - 2.0 * view.margin.clamp(0.0, 0.45);
        let (w, h) = (lens.half_width * share, lens.half_height * share);
        // In camera coordinates a point is inside when |x - cx| <= w (z_eye - z) and likewise for y. Each of the four
        // planes is pushed against the points; the sums of opposite planes give the distance, the differences the
        // centre.
        let mut reach = [f32::NEG_INFINITY; 4];
        for &p in points {
            let p = V3::from(p);
            let (x, y, z) = (p.dot(lens.right), p.dot(lens.up), p.dot(back));
            for (r, value) in reach.iter_mut().zip([x + w * z, -x + w * z, y + h * z, -y + h * z]) {
                *r = r.max(value);
            }
        }
        if points.is_empty() {
            reach = [w, w, h, h];
        }
        let distance = ((reach[0] + reach[1]) / (2.0 * w)).max((reach[2] + reach[3]) / (2.0 * h));
        let (x, y) = (0.5 * (reach[0] - reach[1]), 0.5 * (reach[2] - reach[3]));
        let eye = lens.right * x + lens.up * y + back * distance;
        let middle = points.iter().fold(V3::ZERO, |sum, &p| sum + V3::from(p)) / points.len().max(1) as f32;
        let ahead = (eye - middle).dot(back).max(1e-3);
        Camera { eye: eye.into(), target: (eye - back * ahead).into(), up, fov_y: view.fov_y }
    }
}

impl Lens {
    /// Direction (not unit) through picture position `x`, `y` in `[-1, 1]`, y up.
    pub fn direction(&self, x: f32, y: f32) -> V3 {
        self.forward + self.right * (x * self.half_width) + self.up * (y * self.half_height)
    }
}

impl From<V3> for [f32; 3] {
    fn from(v: V3) -> [f32; 3] {
        [v.x, v.y, v.z]
    }
}

#[cfg(test)]
mod tests {
    //! Claim: a framed box touches the margin on two opposite sides and crosses it nowhere.
    use super::*;

    /// Picture position of a point, in `[-1, 1]` when visible, and its depth along the view.
    fn project(lens: &Lens, p: V3) -> (f32, f32, f32) {
        let d = p - lens.eye;
        let depth = d.dot(lens.forward);
        (d.dot(lens.right) / (depth * lens.half_width), d.dot(lens.up) / (depth * lens.half_height), depth)
    }

    #[test]
    fn framing_is_tight_and_complete() {
        let corners: Vec<[f32; 3]> = (0..8)
            .map(|k| {
                [
                    if k & 1 == 0 { -9.0 } else { 9.0 },
                    if k & 2 == 0 { -1.0 } else { 2.0 },
                    if k & 4 == 0 { -10.0 } else { 5.0 },
                ]
            })
            .collect();
        for (azimuth, elevation, aspect) in
            [(38.0, 24.0, 1.33), (200.0, 60.0, 0.5), (0.0, 90.0, 1.0), (90.0, 0.0, 2.0)]
        {
            let view = View { azimuth, elevation, ..View::default() };
            let lens = Camera::framing(&corners, view, aspect).lens(aspect);
            let seen: Vec<_> = corners.iter().map(|&c| project(&lens, c.into())).collect();
            let most = seen.iter().map(|&(x, y, _)| x.abs().max(y.abs())).fold(0.0, f32::max);
            assert!(seen.iter().all(|&(_, _, depth)| depth > 0.0));
            assert!((most - 0.86).abs() < 1e-3, "{azimuth} {elevation}: {most}");
        }
    }
}
