//! From light to bytes: a filmic curve, and the sRGB encoding in both directions.

use super::v3::{V3, v3};

/// Scale between scene light and the curve's input.
const EXPOSURE: f32 = 0.62;

/// A filmic curve: a gentle toe, a shoulder that lets highlights keep their colour (the rational fit of
/// Narkowicz 2015). Linear in, linear out, in `[0, 1]`.
pub fn film(light: V3) -> V3 {
    let curve = |x: f32| {
        let x = x.max(0.0) * EXPOSURE;
        (x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)).clamp(0.0, 1.0)
    };
    v3(curve(light.x), curve(light.y), curve(light.z))
}

/// sRGB in `[0, 1]` to linear.
pub fn linear(colour: [f32; 3]) -> V3 {
    let decode = |c: f32| {
        let c = f64::from(c.clamp(0.0, 1.0));
        (if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }) as f32
    };
    v3(decode(colour[0]), decode(colour[1]), decode(colour[2]))
}

/// Linear in `[0, 1]` to a byte of sRGB.
pub fn byte(c: f32) -> u8 {
    let c = f64::from(c.clamp(0.0, 1.0));
    let encoded = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0 + 0.5) as u8
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
