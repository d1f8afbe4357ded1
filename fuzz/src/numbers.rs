//! Numbers from bytes: ordinary ones, and those at which arithmetic changes.

use arbitrary::Unstructured;
use niwaki_geom::{Vec3, vec3};

/// Real numbers at which something changes.
const REALS: [f64; 32] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    1e-6,
    1e-9,
    1e-12,
    5e-324,
    -5e-324,
    f64::MIN_POSITIVE,
    2.220446049250313e-16,
    0.9999999999999999,
    1.0000000000000002,
    1e-300,
    1e-150,
    1e6,
    1e11,
    1e12,
    1.0000001e12,
    9007199254740992.0,
    1e18,
    9.3e18,
    1e150,
    1e155,
    1e300,
    -1e300,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// Whole numbers at which something changes.
const WHOLES: [i64; 16] = [
    0,
    1,
    -1,
    2,
    3,
    63,
    64,
    65,
    i64::MAX,
    i64::MIN,
    i64::MAX - 1,
    1 << 31,
    1 << 32,
    -(1 << 31),
    (1 << 53) + 1,
    1 << 62,
];

/// A byte; zero when there are no more.
pub fn byte(u: &mut Unstructured<'_>) -> u8 {
    u.arbitrary().unwrap_or(0)
}

/// A number below `n`, which is at most 256.
pub fn below(u: &mut Unstructured<'_>, n: usize) -> usize {
    usize::from(byte(u)) % n
}

/// Any real number: three in four are hundredths near zero, the others extreme, or any bits.
pub fn real(u: &mut Unstructured<'_>) -> f64 {
    match byte(u) {
        0..192 => ordinary(u),
        192..240 => REALS[below(u, REALS.len())],
        _ => f64::from_bits(u.arbitrary().unwrap_or(0)),
    }
}

/// A hundredth between -3.28 and 3.27, or a neighbour of it in `f64`.
pub fn ordinary(u: &mut Unstructured<'_>) -> f64 {
    let x = f64::from(u.arbitrary::<u16>().unwrap_or(0) % 656) / 100.0 - 3.28;
    if below(u, 32) == 0 { x.next_up() } else { x }
}

/// A number that is positive and finite, seldom extreme.
pub fn size(u: &mut Unstructured<'_>) -> f64 {
    let x = real(u).abs();
    if x > 0.0 && x.is_finite() && (x < 1e6 || below(u, 8) == 0) { x } else { 0.5 }
}

/// Any whole number: half of them small.
pub fn whole(u: &mut Unstructured<'_>) -> i64 {
    match byte(u) {
        0..128 => i64::from(byte(u)) - 100,
        128..240 => WHOLES[below(u, WHOLES.len())],
        _ => u.arbitrary().unwrap_or(0),
    }
}

/// A point of any numbers.
pub fn point(u: &mut Unstructured<'_>) -> Vec3 {
    vec3(real(u), real(u), real(u))
}

/// A point near the origin.
pub fn near(u: &mut Unstructured<'_>) -> Vec3 {
    vec3(ordinary(u), ordinary(u), ordinary(u))
}
