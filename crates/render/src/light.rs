//! The studio: one soft sun from behind the camera, on its left, and a sky that is a gradient.
//!
//! Radiance is in units in which white paint under an irradiance of 1 has brightness 1. The sky is linear in the
//! height of its direction, so that its cosine-weighted mean about a normal is known exactly. Only *blocked* light is
//! sampled: open ground has no noise.

use super::v3::{V3, v3};

/// Rows and columns of the block of pixels that share one set of directions.
pub const TILE: usize = 4;

/// The lights of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    /// Unit vector towards the sun's centre.
    pub sun: V3,
    /// Tangent of the sun's angular radius: softness of shadows.
    pub spread: f32,
    /// Irradiance of the whole sun, facing it.
    pub strength: V3,
    /// Radiance of the sky straight up.
    pub zenith: V3,
    /// Radiance from straight below: the studio floor.
    pub nadir: V3,
}

impl Light {
    /// The studio as seen by a camera that looks along `forward`: the light turns with the camera, so that every
    /// view of a model is well lit.
    pub fn studio(forward: V3) -> Light {
        let level = v3(forward.x, 0.0, forward.z);
        let ahead = if level.norm() > 1e-3 { level.unit() } else { v3(0.0, 0.0, -1.0) };
        let right = ahead.cross(v3(0.0, 1.0, 0.0));
        Light {
            sun: (v3(0.0, 1.0, 0.0) * 1.05 - right * 0.72 - ahead * 0.30).unit(),
            spread: 0.11,
            strength: v3(2.45, 2.26, 2.00),
            zenith: v3(0.90, 0.97, 1.10),
            nadir: v3(0.36, 0.335, 0.31),
        }
    }

    /// Radiance of the sky in a unit direction.
    pub fn sky(&self, direction: V3) -> V3 {
        self.nadir.lerp(self.zenith, 0.5 + 0.5 * direction.y)
    }

    /// Irradiance of the whole unblocked sky on a surface: the cosine-weighted mean of `sky` about the normal
    /// (the mean of a unit direction is two thirds of the normal).
    pub fn open_sky(&self, normal: V3) -> V3 {
        self.nadir.lerp(self.zenith, 0.5 + normal.y / 3.0)
    }
}

/// Directions to sample: for each pixel of a tile, `count` points that fill the unit disc evenly; and the tile's
/// pixels together fill it `TILE * TILE` times more densely: smoothing over a tile averages these points.
#[derive(Debug)]
pub struct Directions {
    disc: Vec<[f32; 2]>,
    pixel: Vec<[f32; 2]>,
    turns: usize,
}

impl Directions {
    /// Points of Roberts' R2 lattice (2018), dealt out to the pixels of a tile in the order of a Bayer matrix.
    pub fn new(count: usize) -> Directions {
        const BAYER: [usize; TILE * TILE] = [0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5];
        let lattice = |k: usize| {
            let k = k as f64 + 0.5;
            [(0.754_877_666_246_692_7 * k).fract(), (0.569_840_290_998_053_2 * k).fract()]
        };
        let turns = count.div_ceil(2); // samples take turns at sky and sun
        let disc = BAYER
            .iter()
            .flat_map(|&turn| (0..turns).map(move |s| s * TILE * TILE + turn))
            .map(|k| concentric(lattice(k)))
            .collect();
        let pixel = (0..count).map(|k| lattice(k).map(|c| c as f32)).collect();
        Directions { disc, pixel, turns }
    }

    /// The place of sample `s` in the pixel, each coordinate in `[0, 1)`.
    pub fn in_pixel(&self, s: usize) -> [f32; 2] {
        self.pixel[s]
    }

    /// A point of the unit disc for a pixel's sample number `turn`.
    fn on_disc(&self, column: usize, row: usize, turn: usize) -> [f32; 2] {
        self.disc[((row % TILE) * TILE + column % TILE) * self.turns + turn]
    }

    /// A direction about `normal`, cosine-weighted.
    pub fn about(&self, normal: V3, column: usize, row: usize, turn: usize) -> V3 {
        let [x, y] = self.on_disc(column, row, turn);
        let (tangent, bitangent) = normal.frame();
        tangent * x + bitangent * y + normal * (1.0 - x * x - y * y).max(0.0).sqrt()
    }

    /// A direction towards the sun's disc.
    pub fn sunward(&self, light: &Light, column: usize, row: usize, turn: usize) -> V3 {
        let [x, y] = self.on_disc(column, row, turn);
        let (tangent, bitangent) = light.sun.frame();
        (light.sun + (tangent * x + bitangent * y) * light.spread).unit()
    }
}

/// The square mapped onto the disc with equal areas (Shirley & Chiu 1997). Numbers are `f64` and rounded once, so that the
/// last bit of a machine's sine does not matter.
fn concentric([u, v]: [f64; 2]) -> [f32; 2] {
    let (a, b) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    if a == 0.0 && b == 0.0 {
        return [0.0, 0.0];
    }
    let quarter = std::f64::consts::FRAC_PI_4;
    let (r, angle) = if a.abs() > b.abs() { (a, quarter * b / a) } else { (b, quarter * (2.0 - a / b)) };
    [(r * angle.cos()) as f32, (r * angle.sin()) as f32]
}

#[cfg(test)]
mod tests {
    //! Claim: the sampled mean of the sky is its closed form.
    use super::*;

    #[test]
    fn open_sky_is_the_mean_of_the_sky() {
        let light = Light::studio(v3(0.0, 0.0, -1.0));
        let directions = Directions::new(128);
        for normal in [v3(0., 1., 0.), v3(0.6, -0.8, 0.), v3(0.48, 0.6, -0.64)] {
            let mut sum = V3::ZERO;
            for k in 0..TILE * TILE {
                for s in 0..64 {
                    sum = sum + light.sky(directions.about(normal, k % TILE, k / TILE, s));
                }
            }
            let mean = sum / (64 * TILE * TILE) as f32;
            assert!((mean - light.open_sky(normal)).norm() < 2e-3, "{mean:?}");
        }
    }
}
