//! Roughness that changes only the shading: the gradient of a smooth random field in space.
//!
//! Value noise on the integer lattice with quintic interpolation (Perlin 2002), two octaves. The lattice's values are a
//! hash of its integers, so that a surface looks the same in every picture.

use super::v3::{V3, v3};

/// The field at `p` in `[-1, 1]`, and its gradient.
pub fn field(p: V3) -> (f32, V3) {
    let (a, da) = octave(p);
    // The second octave is turned and moved, so that the two lattices never line up.
    let q = v3(0.8 * p.x + 0.6 * p.z, p.y, 0.8 * p.z - 0.6 * p.x) * 2.17 + v3(11.3, 5.7, 3.1);
    let (b, db) = octave(q);
    let db = v3(0.8 * db.x - 0.6 * db.z, db.y, 0.6 * db.x + 0.8 * db.z);
    ((a + 0.5 * b) / 1.5, (da + db * (0.5 * 2.17)) / 1.5)
}

fn octave(p: V3) -> (f32, V3) {
    let base = v3(p.x.floor(), p.y.floor(), p.z.floor());
    let f = p - base;
    let (i, j, k) = (base.x as i32, base.y as i32, base.z as i32);
    let ease = |t: f32| (t * t * t * (t * (t * 6.0 - 15.0) + 10.0), 30.0 * t * t * (t * (t - 2.0) + 1.0));
    let ((u, du), (v, dv), (w, dw)) = (ease(f.x), ease(f.y), ease(f.z));
    let at = |dx: i32, dy: i32, dz: i32| {
        value(i.wrapping_add(dx) as u32, j.wrapping_add(dy) as u32, k.wrapping_add(dz) as u32)
    };
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    // Along x first, on the four edges of the cell.
    let (a, b, c, d) = (at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(1, 1, 0));
    let (e, g, h, l) = (at(0, 0, 1), at(1, 0, 1), at(0, 1, 1), at(1, 1, 1));
    let (low0, high0, low1, high1) = (mix(a, b, u), mix(c, d, u), mix(e, g, u), mix(h, l, u));
    let (near, far) = (mix(low0, high0, v), mix(low1, high1, v));
    let slope_x = mix(mix(b - a, d - c, v), mix(g - e, l - h, v), w) * du;
    let slope_y = mix(high0 - low0, high1 - low1, w) * dv;
    (mix(near, far, w), v3(slope_x, slope_y, (far - near) * dw))
}

/// A number in `[-1, 1)` for a lattice point (the finaliser of murmur3 over a product of odd constants).
fn value(x: u32, y: u32, z: u32) -> f32 {
    let mut h = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77) ^ z.wrapping_mul(0xc2b2_ae3d);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    ((h ^ (h >> 16)) >> 8) as f32 / (1 << 23) as f32 - 1.0
}

#[cfg(test)]
mod tests {
    //! Claim: the gradient is the field's own, and the field stays in range.
    use super::*;

    #[test]
    fn gradient_agrees_with_differences() {
        for k in 0..50 {
            let p = v3(0.37 * k as f32 - 7.0, 0.21 * k as f32, 3.3 - 0.11 * k as f32);
            let (value, gradient) = field(p);
            assert!(value.abs() <= 1.0);
            let h = 2e-3;
            let slope = |d: V3| (field(p + d * h).0 - field(p - d * h).0) / (2.0 * h);
            let numeric = v3(slope(v3(1., 0., 0.)), slope(v3(0., 1., 0.)), slope(v3(0., 0., 1.)));
            assert!((numeric - gradient).norm() < 2e-2, "{numeric:?} {gradient:?}");
        }
    }
}
