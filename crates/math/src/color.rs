//! Colours: sRGB as it is displayed, HSV, CIELAB, and how different two colours look.
//!
//! A colour is three numbers; the function's name gives the colour space. sRGB components are in `[0, 1]` (IEC
//! 61966-2-1, white point D65); hue, saturation and value are in `[0, 1]`, the hue in turns; CIELAB has L in `[0,
//! 100]`. Nothing is clamped: a CIELAB colour that no screen can show has sRGB components outside `[0, 1]`, and converts
//! back to the same CIELAB colour.

use crate::Scalar;
use std::f64::consts::TAU;

/// Linear sRGB to CIE XYZ.
const TO_XYZ: [[f64; 3]; 3] =
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]];

/// The inverse of [`TO_XYZ`].
const FROM_XYZ: [[f64; 3]; 3] = [
    [3.2404548360214087, -1.5371388501025751, -0.498531546868481],
    [-0.9692663898756538, 1.876010928842491, 0.041556082346673545],
    [0.05564341960421367, -0.20402585426769818, 1.057225162457929],
];

/// XYZ of white: the sums of the rows of [`TO_XYZ`], so that a grey has a = b = 0.
const WHITE: [f64; 3] = [0.95047, 1.0000001, 1.08883];

fn product<S: Scalar>(matrix: &[[f64; 3]; 3], v: [S; 3]) -> [S; 3] {
    matrix.map(|row| S::from_f64(row[0]) * v[0] + S::from_f64(row[1]) * v[1] + S::from_f64(row[2]) * v[2])
}

/// sRGB from hue (turns; whole turns make no difference), saturation and value.
///
/// `f(n) = v - v s max(0, min(k, 4 - k, 1))` with `k = (n + 6 h) mod 6`, at n = 5, 3, 1.
pub fn srgb_from_hsv<S: Scalar>([h, s, v]: [S; 3]) -> [S; 3] {
    let (zero, unity) = (S::from_f64(0.0), S::from_f64(1.0));
    [5.0, 3.0, 1.0].map(|n| {
        let k = S::from_f64(n) + S::from_f64(6.0) * h;
        let k = k - S::from_f64(6.0) * (k / S::from_f64(6.0)).floor();
        v - v * s * k.min(S::from_f64(4.0) - k).min(unity).max(zero)
    })
}

/// Hue (turns, in `[0, 1)`), saturation and value of an sRGB colour. A grey has hue 0; black has saturation 0.
pub fn hsv_from_srgb<S: Scalar>([r, g, b]: [S; 3]) -> [S; 3] {
    let zero = S::from_f64(0.0);
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    let chroma = most - least;
    if chroma == zero {
        return [zero, zero, most];
    }
    let (sector, difference) = if most == r {
        (0.0, g - b)
    } else if most == g {
        (2.0, b - r)
    } else {
        (4.0, r - g)
    };
    let hue = (S::from_f64(sector) + difference / chroma) / S::from_f64(6.0);
    let hue = (-hue).above(0.0, || hue + S::from_f64(1.0), || hue);
    [hue, if most == zero { zero } else { chroma / most }, most]
}

/// An sRGB component as linear light.
fn linear<S: Scalar>(c: S) -> S {
    c.above(
        0.04045,
        || ((c + S::from_f64(0.055)) / S::from_f64(1.055)).powf(S::from_f64(2.4)),
        || c / S::from_f64(12.92),
    )
}

fn displayed<S: Scalar>(light: S) -> S {
    light.above(
        0.0031308,
        || S::from_f64(1.055) * light.powf(S::from_f64(1.0 / 2.4)) - S::from_f64(0.055),
        || light * S::from_f64(12.92),
    )
}

/// Bound below which CIELAB replaces the cube root by a straight line.
const DELTA: f64 = 6.0 / 29.0;

fn root<S: Scalar>(t: S) -> S {
    t.above(
        DELTA * DELTA * DELTA,
        || t.powf(S::from_f64(1.0 / 3.0)),
        || t / S::from_f64(3.0 * DELTA * DELTA) + S::from_f64(4.0 / 29.0),
    )
}

fn cube<S: Scalar>(t: S) -> S {
    t.above(DELTA, || t * t * t, || S::from_f64(3.0 * DELTA * DELTA) * (t - S::from_f64(4.0 / 29.0)))
}

/// CIELAB (L, a, b) of an sRGB colour.
pub fn lab_from_srgb<S: Scalar>(rgb: [S; 3]) -> [S; 3] {
    let [x, y, z] = product(&TO_XYZ, rgb.map(linear));
    let [x, y, z] =
        [(x, WHITE[0]), (y, WHITE[1]), (z, WHITE[2])].map(|(c, white)| root(c / S::from_f64(white)));
    [S::from_f64(116.0) * y - S::from_f64(16.0), S::from_f64(500.0) * (x - y), S::from_f64(200.0) * (y - z)]
}

/// sRGB of a CIELAB colour.
pub fn srgb_from_lab<S: Scalar>([l, a, b]: [S; 3]) -> [S; 3] {
    let y = (l + S::from_f64(16.0)) / S::from_f64(116.0);
    let (x, z) = (y + a / S::from_f64(500.0), y - b / S::from_f64(200.0));
    let xyz = [(x, WHITE[0]), (y, WHITE[1]), (z, WHITE[2])].map(|(c, white)| cube(c) * S::from_f64(white));
    product(&FROM_XYZ, xyz).map(displayed)
}

/// Perceived difference of two CIELAB colours: the CIEDE2000 difference with all three weights 1. About 1 is the
/// smallest difference that a person sees. Sharma, Wu & Dalal 2005, equations 2 to 22.
pub fn difference<S: Scalar>([l1, a1, b1]: [S; 3], [l2, a2, b2]: [S; 3]) -> S {
    let number = S::from_f64;
    let (half, unity, two) = (number(0.5), number(1.0), number(2.0));
    let pull = |c: S| {
        let c7 = c.powi(7);
        (c7 / (c7 + number(25f64.powi(7)))).sqrt()
    };
    let length =
        |a: S, b: S| if a == number(0.0) && b == number(0.0) { number(0.0) } else { (a * a + b * b).sqrt() };
    // Equations 2 to 7: a stretched near the grey axis, then chroma and hue (radians, in [0, tau)).
    let g = half * (unity - pull((length(a1, b1) + length(a2, b2)) * half));
    let (a1, a2) = ((unity + g) * a1, (unity + g) * a2);
    let (c1, c2) = (length(a1, b1), length(a2, b2));
    let hue = |a: S, b: S, c: S| {
        if c == number(0.0) {
            return number(0.0);
        }
        let h = b.atan2(a);
        (-h).above(0.0, || h + number(TAU), || h)
    };
    let (h1, h2) = (hue(a1, b1, c1), hue(a2, b2, c2));
    // Equations 8 to 11.
    let grey = c1 == number(0.0) || c2 == number(0.0);
    let hue_difference = h2 - h1;
    let back = || (-hue_difference).above(TAU / 2.0, || hue_difference + number(TAU), || hue_difference);
    let turn = if grey {
        number(0.0)
    } else {
        hue_difference.above(TAU / 2.0, || hue_difference - number(TAU), back)
    };
    let (dl, dc) = (l2 - l1, c2 - c1);
    let dh = if grey { number(0.0) } else { two * (c1 * c2).sqrt() * (turn * half).sin() };
    // Equations 12 to 14: the means.
    let (l, c) = ((l1 + l2) * half, (c1 + c2) * half);
    let sum = h1 + h2;
    let around = || (-sum).above(-TAU, || (sum + number(TAU)) * half, || (sum - number(TAU)) * half);
    let h = if grey { sum } else { hue_difference.abs().above(TAU / 2.0, around, || sum * half) };
    // Equations 15 to 21.
    let degrees = |x: f64| number(x.to_radians());
    let t = unity - number(0.17) * (h - degrees(30.0)).cos()
        + number(0.24) * (two * h).cos()
        + number(0.32) * (number(3.0) * h + degrees(6.0)).cos()
        - number(0.20) * (number(4.0) * h - degrees(63.0)).cos();
    let bump = (h - degrees(275.0)) / degrees(25.0);
    let twist = degrees(60.0) * (-(bump * bump)).exp();
    let l50 = (l - number(50.0)) * (l - number(50.0));
    let sl = unity + number(0.015) * l50 / (number(20.0) + l50).sqrt();
    let sc = unity + number(0.045) * c;
    let sh = unity + number(0.015) * c * t;
    let rotation = -(two * pull(c) * twist.sin());
    // Equation 22.
    let (dl, dc, dh) = (dl / sl, dc / sc, dh / sh);
    (dl * dl + dc * dc + dh * dh + rotation * dc * dh).max(number(0.0)).sqrt()
}

#[cfg(test)]
mod tests {
    //! Conversions to a colour space and back give the colour, known colours have their known numbers, and differences
    //! are those that the paper prints.

    use super::*;

    fn near(a: [f64; 3], b: [f64; 3], within: f64) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < within)
    }

    fn grid() -> impl Iterator<Item = [f64; 3]> {
        let parts = [0.0, 0.02, 0.3, 0.5, 0.99, 1.0];
        parts
            .into_iter()
            .flat_map(move |r| parts.into_iter().flat_map(move |g| parts.map(move |b| [r, g, b])))
    }

    #[test]
    fn conversions_there_and_back_give_the_colour() {
        for c in grid() {
            assert!(near(srgb_from_hsv(hsv_from_srgb(c)), c, 1e-12), "{c:?}");
            assert!(near(srgb_from_lab(lab_from_srgb(c)), c, 1e-12), "{c:?}");
        }
        // Outside of the range of a screen, and back.
        let vivid = [50.0, 120.0, -110.0];
        assert!(near(lab_from_srgb(srgb_from_lab(vivid)), vivid, 1e-9));
    }

    #[test]
    fn colours_have_their_known_numbers() {
        assert_eq!(srgb_from_hsv([0.0, 1.0, 1.0]), [1.0, 0.0, 0.0]);
        assert_eq!(srgb_from_hsv([1.0 / 3.0, 1.0, 0.5]), [0.0, 0.5, 0.0]);
        assert_eq!(srgb_from_hsv([-1.0 / 3.0, 0.5, 1.0]), [0.5, 0.5, 1.0]);
        assert_eq!(hsv_from_srgb([0.25, 0.25, 0.25]), [0.0, 0.0, 0.25]);
        assert!(near(lab_from_srgb([1.0, 1.0, 1.0]), [100.0, 0.0, 0.0], 1e-9));
        assert!(near(lab_from_srgb([1.0, 0.0, 0.0]), [53.2408, 80.0925, 67.2032], 1e-3));
        assert!(near(lab_from_srgb([0.0, 0.0, 1.0]), [32.2970, 79.1875, -107.8602], 1e-3));
    }

    /// Rows of table 1 of Sharma, Wu & Dalal 2005: the cases that wrong implementations miss.
    #[test]
    fn differences_match_the_published_table() {
        let blue = [50.0, 0.0, -82.7485];
        let rows = [
            ([50.0, 2.6772, -79.7751], blue, 2.0425),
            ([50.0, 3.1571, -77.2803], blue, 2.8615),
            ([50.0, 2.8361, -74.0200], blue, 3.4412),
            ([50.0, -1.3802, -84.2814], blue, 1.0000),
            ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
            ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0009], 7.1792),
            ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0011], 7.2195),
            ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
            ([50.0, 2.5, 0.0], [61.0, -5.0, 29.0], 22.8977),
            ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
            ([2.0776, 0.0795, -1.1350], [0.9033, -0.0636, -0.5514], 0.9082),
        ];
        for (first, second, expected) in rows {
            assert!((difference(first, second) - expected).abs() < 5.1e-5, "{first:?} {second:?}");
            assert!((difference(second, first) - expected).abs() < 5.1e-5, "{second:?} {first:?}");
            assert_eq!(difference(first, first), 0.0);
        }
    }
}
