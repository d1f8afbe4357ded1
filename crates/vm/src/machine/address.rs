//! Addresses: 128-bit hashes of the path of sites from the root.
//!
//! A node carries the hash of its path; a choice's address is its node's hash joined with its site's key. So
//! the same choice has the same address in any order of execution, and no ancestors are visited to compute it.

/// The address of the root activation.
pub const ROOT: u128 = 0x9E37_79B9_7F4A_7C15_F39C_C060_5CED_C834;

/// Folds both halves of a 64 by 64 bit product.
#[inline]
fn fold(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    (product as u64) ^ (product >> 64) as u64
}

/// Extends `path` by `key`.
#[inline]
pub fn join(path: u128, key: u128) -> u128 {
    let (lo, hi) = (path as u64 ^ key as u64, (path >> 64) as u64 ^ (key >> 64) as u64);
    let a = fold(lo ^ 0xA076_1D64_78BD_642F, hi ^ 0xE703_7ED1_A0B4_28DB);
    let b = fold(hi ^ 0x8EBC_6AF0_9C88_C6E3, lo.rotate_left(32) ^ 0x5899_65CC_7537_4CC3);
    u128::from(a ^ hi) | u128::from(b ^ lo) << 64
}

/// The key of iteration `i` of a loop.
#[inline]
pub fn iteration_key(i: u32) -> u128 {
    (u128::from(i) + 1).wrapping_mul(0x2545_F491_4F6C_DD1D_D1B5_4A32_D192_ED03)
}

/// The key of a site, from a text that describes it and the number of equal texts before it.
pub fn site_key(text: &str, occurrence: u32) -> u128 {
    let mut state = 0x6C62_272E_07BB_0142_62B8_2175_6295_C58Du128;
    for byte in text.bytes() {
        state = (state ^ u128::from(byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013B);
    }
    join(state, iteration_key(occurrence))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn paths_do_not_collide_and_low_bits_are_mixed() {
        let mut seen = HashSet::new();
        let mut low = [0u32; 16];
        for site in 0..64 {
            let key = site_key("f|gaussian|x", site);
            let mut path = join(ROOT, key);
            for i in 0..1000 {
                path = join(path, iteration_key(i));
                assert!(seen.insert(path));
                assert!(seen.insert(join(path, key)));
                low[(path & 15) as usize] += 1;
            }
        }
        // Chi-square with 15 degrees of freedom: the probability of more than 44.3 is 1e-4.
        let expected = 64_000.0 / 16.0;
        let chi: f64 = low.iter().map(|n| (f64::from(*n) - expected).powi(2) / expected).sum();
        assert!(chi < 44.3, "{chi}");
    }
}
