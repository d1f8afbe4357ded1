//! From light to bytes: a filmic curve, and the sRGB encoding in both directions.

use super::v3::{V3, v3};
use std::sync::LazyLock;

/// Brightness that becomes paper white.
const WHITE: f32 = 2.9;
/// Strength of the toe: 0 leaves the shadows unchanged.
const TOE: f32 = 0.35;

/// A filmic curve: the shoulder of Reinhard et al. 2002, eq. 4, then a gentle S in the square root, where the eye sees
/// steps as equal. Input and output are linear; the output is in `[0, 1]`.
pub fn film(light: V3) -> V3 {
    let curve = |x: f32| {
        let x = x.max(0.0);
        let root = (x * (1.0 + x / (WHITE * WHITE)) / (1.0 + x)).min(1.0).sqrt();
        let curved = root * root * (3.0 - 2.0 * root);
        let root = root + TOE * (curved - root);
        root * root
    };
    v3(curve(light.x), curve(light.y), curve(light.z))
}

/// sRGB in `[0, 1]` to linear.
pub fn linear(colour: [f32; 3]) -> V3 {
    v3(decode(colour[0]), decode(colour[1]), decode(colour[2]))
}

fn decode(c: f32) -> f32 {
    let c = f64::from(c.clamp(0.0, 1.0));
    (if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }) as f32
}

/// Linear in `[0, 1]` to the nearest byte of sRGB: the number of steps below it.
pub fn byte(c: f32) -> u8 {
    static STEPS: LazyLock<[f32; 255]> =
        LazyLock::new(|| std::array::from_fn(|k| decode((k as f32 + 0.5) / 255.0)));
    STEPS.partition_point(|&step| step <= c) as u8
}

#[cfg(test)]
mod tests {
    //! Claim: encoding undoes decoding for every byte; the curve rises and keeps black black.
    use super::*;

    #[test]
    fn bytes_survive() {
        for b in 0..=255u8 {
            assert_eq!(byte(linear([f32::from(b) / 255.0; 3]).y), b);
        }
    }

    #[test]
    fn the_curve_rises() {
        assert_eq!(film(V3::ZERO), V3::ZERO);
        let steps: Vec<f32> = (0..100).map(|k| film(V3::splat(k as f32 * 0.05)).x).collect();
        assert!(steps.windows(2).all(|w| w[0] <= w[1]));
    }
}
