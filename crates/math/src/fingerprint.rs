//! A fingerprint of the bits that a machine computes. Two machines whose elementary functions differ in a last bit give
//! different results for the same seed, and must not share results.

/// A hash of the values of elementary functions at a few hundred points.
pub fn fingerprint() -> u128 {
    // FNV-1a of 128 bits over the bytes of every value.
    let (mut hash, prime) =
        (0x6c62_272e_07bb_0142_62b8_2175_6295_c58d_u128, 0x0100_0000_0000_0000_0000_013b_u128);
    let mut add = |x: f64| {
        for byte in x.to_bits().to_le_bytes() {
            hash = (hash ^ u128::from(byte)).wrapping_mul(prime);
        }
    };
    for k in 1..400_u32 {
        // Points of all sizes from 1e-6 to 1e6, away from round numbers.
        let x = 10f64.powf(f64::from(k) * 0.03 - 6.0) * 1.000_123;
        let share = x / (1.0 + x);
        for value in [x.exp(), x.ln(), x.sin(), x.cos(), x.tan(), x.atan(), x.tanh(), x.sqrt(), x.powf(0.37)]
        {
            add(value);
        }
        for value in [(-x).exp_m1(), x.ln_1p(), share.asin(), share.acos(), x.cbrt(), x.mul_add(share, -x)] {
            add(value);
        }
    }
    hash
}

#[cfg(test)]
mod tests {
    #[test]
    fn fingerprints_of_one_machine_are_equal() {
        assert_eq!(super::fingerprint(), super::fingerprint());
        assert_ne!(super::fingerprint(), 0);
    }
}
