//! Elementary functions with the same bits on every machine.
//!
//! The functions of the standard library are those of the platform, which may differ in the last bit. These are made of
//! additions, multiplications, divisions and square roots alone, which IEEE 754 defines to the bit. A fused
//! multiplication and addition is never used: Rust makes none on its own.

/// 1.5 * 2^52: adding it rounds a number below 2^51 to a whole one, whose bits are then the lowest.
const SHIFT: f64 = 6_755_399_441_055_744.0;
/// ln 2 in two parts; products of the first with whole numbers below 2^11 are exact.
const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];
/// 1 / k! for k from 2 to 12.
const TAYLOR: [f64; 11] = [
    0.5,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
];

/// `e^x` for `x` from -700 to 0, with a relative error below 1e-15; smaller numbers are treated as -700.
///
/// Without branches: a loop over it becomes vector instructions, with the same bits.
///
/// ```
/// assert!((niwaki_math::portable::exp_falling(-1.0) - 1.0 / std::f64::consts::E).abs() < 1e-16);
/// ```
#[inline(always)]
pub fn exp_falling(x: f64) -> f64 {
    let x = if x < -700.0 { -700.0 } else { x };
    let shifted = x * std::f64::consts::LOG2_E + SHIFT;
    let whole = shifted - SHIFT;
    let r = (x - whole * LN_2[0]) - whole * LN_2[1];
    let mut sum = TAYLOR[10];
    for k in (0..10).rev() {
        sum = sum * r + TAYLOR[k];
    }
    let power = f64::from_bits((shifted.to_bits().wrapping_add(1023)) << 52);
    (1.0 + r + r * r * sum) * power
}

/// `e^x`.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// The natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

#[cfg(test)]
mod tests {
    //! The functions agree with those of the standard library, up to rounding.
    use super::*;

    #[test]
    fn falling_powers_agree_with_the_standard_library() {
        for k in 0..70_000 {
            let x = -0.01 * f64::from(k);
            let (value, expected) = (exp_falling(x), x.exp());
            assert!((value / expected - 1.0).abs() < 1e-15, "{x}: {value} {expected}");
        }
        assert_eq!(exp_falling(0.0), 1.0);
        assert_eq!(exp_falling(-1e300), exp_falling(-700.0));
    }

    #[test]
    fn bits_are_those_of_the_table() {
        // These bits hold on every machine.
        assert_eq!(exp_falling(-1.234_567).to_bits(), 0x3FD2_9F19_B75F_99C4);
        assert_eq!(exp(1.5).to_bits(), 0x4011_ED3F_E64F_C541);
        assert_eq!(ln(10.0).to_bits(), 0x4002_6BB1_BBB5_5516);
    }
}
