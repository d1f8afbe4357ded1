//! Exact sums of log scores of any size.
//!
//! Two runs that made the same choices in another order must have sums that agree in the last bit. A sum that is updated
//! (`total - old + new`) must return to its old value when a term is removed. `f64` ensures both only while every sum fits
//! into 53 bits. A [`Total`] holds terms on the [`grid`](crate::grid) of 2^-32 nats without loss:
//!
//! | sum | where |
//! | --- | --- |
//! | below 2^20 nats | one `f64`: 53 bits hold every multiple of 2^-32 of that size |
//! | larger, finite | an expansion on the heap: `f64` parts that do not overlap (Shewchuk 1997, theorem 10) |
//! | infinite terms | counted by sign, beside the expansion; a NaN counts as one of each sign, so the sum is NaN |

use std::fmt;

/// Bound in nats: a sum of multiples of 2^-32 whose result is below it was not rounded.
pub const NEAR: f64 = (1u64 << 20) as f64;
/// Factor of far terms, 2^-64, so that no partial sum overflows. All terms stay far above subnormal numbers.
const SCALE: f64 = 1.0 / (1u128 << 64) as f64;

/// An exact sum of terms, nats: multiples of 2^-32 of any size (see [`grid`](crate::grid)), and infinities.
///
/// ```
/// # use niwaki_math::Total;
/// let mut total = Total::default();
/// [1e300, 0.25, -1e17, f64::NEG_INFINITY].map(|term| total.add(term));
/// [f64::NEG_INFINITY, 1e300, -1e17].map(|term| total.remove(term));
/// assert_eq!(total.value(), 0.25);
/// ```
#[derive(Default)]
pub struct Total {
    /// The sum if it is below [`NEAR`], else NaN.
    near: f64,
    /// The sum if `near` is NaN; else a stale sum whose memory will be reused.
    far: Option<Box<Far>>,
}

/// A sum that is not below [`NEAR`].
#[derive(Clone, Default)]
struct Far {
    /// Sum of the finite terms, times [`SCALE`].
    finite: Expansion,
    /// Number of terms that are minus infinity and plus infinity; negative if more of them were removed than added.
    infinite: [i32; 2],
}

impl Total {
    /// Adds a term.
    #[inline(always)]
    pub fn add(&mut self, term: f64) {
        self.replace(0.0, term);
    }

    /// Removes a term.
    #[inline(always)]
    pub fn remove(&mut self, term: f64) {
        self.replace(term, 0.0);
    }

    /// Removes a term and adds another.
    #[inline(always)]
    pub fn replace(&mut self, old: f64, new: f64) {
        // A difference that was rounded is 2^21 at least, and then the sum is not near.
        let near = self.near + (new - old);
        if near.abs() < NEAR {
            self.near = near;
        } else {
            self.change(|far| {
                far.add(old, -1);
                far.add(new, 1);
            });
        }
    }

    /// Removes every term.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.near = 0.0;
    }

    /// The far sum, if the sum is not near.
    #[inline(always)]
    fn far(&self) -> Option<&Far> {
        self.near.is_nan().then_some(self.far.as_deref()).flatten()
    }

    /// Changes a sum that is far, or becomes far.
    #[cold]
    #[inline(never)]
    fn change(&mut self, change: impl FnOnce(&mut Far)) {
        let far = self.far.get_or_insert_default();
        if !self.near.is_nan() {
            far.infinite = [0; 2];
            far.finite.0.clear();
            far.finite.grow(self.near * SCALE);
        }
        change(far);
        let near = far.finite.rounded() / SCALE;
        self.near = if far.infinite == [0; 2] && near.abs() < NEAR { near } else { f64::NAN };
    }

    /// Adds every term of another sum.
    #[inline(always)]
    pub fn add_total(&mut self, other: &Total) {
        let near = self.near + other.near;
        if near.abs() < NEAR {
            self.near = near;
        } else {
            self.change(|far| far.add_total(other, 1));
        }
    }

    /// Removes every term of another sum.
    #[inline(always)]
    pub fn remove_total(&mut self, other: &Total) {
        let near = self.near - other.near;
        if near.abs() < NEAR {
            self.near = near;
        } else {
            self.change(|far| far.add_total(other, -1));
        }
    }

    /// The sum of two totals.
    #[inline(always)]
    #[must_use]
    pub fn plus(&self, other: &Total) -> Total {
        let mut sum = self.clone();
        sum.add_total(other);
        sum
    }

    /// This sum less another, exactly.
    #[inline(always)]
    #[must_use]
    pub fn less(&self, other: &Total) -> Total {
        let mut difference = self.clone();
        difference.remove_total(other);
        difference
    }

    /// Whether the sum is minus infinity because a term is.
    #[inline(always)]
    pub fn is_impossible(&self) -> bool {
        self.far().is_some_and(|far| far.infinite[0] > 0 && far.infinite[1] == 0)
    }

    /// The sum if it is below 2^20 nats and so exact as an `f64`; else NaN.
    #[inline(always)]
    pub fn near(&self) -> f64 {
        self.near
    }

    /// The nearest `f64`, ties to even; minus infinity with a term of minus infinity, NaN with terms of both signs.
    #[inline(always)]
    pub fn value(&self) -> f64 {
        self.far().map_or(self.near, Far::value)
    }
}

impl Far {
    fn add(&mut self, term: f64, sign: i32) {
        if term.is_finite() {
            self.finite.grow(f64::from(sign) * term * SCALE);
        } else {
            let is = [term != f64::INFINITY, term != f64::NEG_INFINITY];
            (0..2).for_each(|end| self.infinite[end] += sign * i32::from(is[end]));
        }
    }

    fn add_total(&mut self, other: &Total, sign: i32) {
        match other.far() {
            None => self.add(other.near, sign),
            Some(far) => {
                far.finite.0.iter().for_each(|part| self.finite.grow(f64::from(sign) * part));
                (0..2).for_each(|end| self.infinite[end] += sign * far.infinite[end]);
            }
        }
    }

    #[cold]
    #[inline(never)]
    fn value(&self) -> f64 {
        let [lowest, highest] = self.infinite;
        // A term that was removed and never added counts as a term of the other sign.
        match (highest > 0 || lowest < 0, lowest > 0 || highest < 0) {
            (true, true) => f64::NAN,
            (true, false) => f64::INFINITY,
            (false, true) => f64::NEG_INFINITY,
            (false, false) => self.finite.rounded() / SCALE,
        }
    }
}

impl Clone for Total {
    #[inline(always)]
    fn clone(&self) -> Total {
        let mut copy = Total::default();
        copy.clone_from(self);
        copy
    }

    #[inline(always)]
    fn clone_from(&mut self, other: &Total) {
        self.near = other.near;
        if self.near.is_nan() {
            self.copy_far(other);
        }
    }
}

impl Total {
    #[cold]
    #[inline(never)]
    fn copy_far(&mut self, other: &Total) {
        self.far.clone_from(&other.far);
    }
}

impl PartialEq for Total {
    /// Whether the exact sums are equal; the terms may differ.
    fn eq(&self, other: &Total) -> bool {
        self.less(other).near == 0.0
    }
}

impl fmt::Debug for Total {
    /// The nearest `f64`, and the rest of the exact sum: equal sums have equal texts.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (mut rest, mut value) = (self.clone(), self.value());
        write!(f, "{value:?}")?;
        while value.is_finite() {
            rest.remove(value);
            value = rest.value();
            if value == 0.0 {
                break;
            }
            write!(f, " + {value:?}")?;
        }
        Ok(())
    }
}

/// A number as the sum of non-overlapping parts, none of them zero, the smallest first.
#[derive(Clone, Default)]
struct Expansion(Vec<f64>);

impl Expansion {
    /// Adds a number exactly.
    fn grow(&mut self, mut carry: f64) {
        self.0.retain_mut(|part| {
            let (sum, rest) = two_sum(carry, *part);
            (carry, *part) = (sum, rest);
            rest != 0.0
        });
        if carry != 0.0 {
            self.0.push(carry);
        }
    }

    /// The nearest `f64`, ties to even.
    fn rounded(&self) -> f64 {
        let mut parts = self.0.iter().rev().copied();
        let (mut sum, mut rest) = (0.0, 0.0);
        while rest == 0.0 {
            let Some(part) = parts.next() else { return sum };
            (sum, rest) = two_sum(sum, part);
        }
        // The parts below `rest` are smaller than its last bit. They decide where `rest` is half of the last bit of
        // `sum`: then twice `rest` added to `sum` is exact, and on the far side of the middle.
        let beyond = parts.next().unwrap_or(0.0);
        let next = sum + 2.0 * rest;
        let is_half = next - sum == 2.0 * rest;
        if is_half && beyond * rest > 0.0 { next } else { sum }
    }
}

/// The rounded sum of two numbers, and its rounding error (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

#[cfg(test)]
mod tests {
    //! A total is the nearest `f64` to the exact sum of its terms, in any order of additions and removals.
    use super::*;
    use crate::{Stream, grid};

    /// The reference: a whole number of steps of 2^-32 nats, in binary places of 32 bits each, and counts of
    /// infinities.
    #[derive(Clone)]
    struct Exact {
        places: [i128; 40],
        infinite: [i32; 2],
    }

    impl Exact {
        fn add(&mut self, term: f64, sign: i32) {
            if term.is_infinite() {
                self.infinite[usize::from(term > 0.0)] += sign;
                return;
            }
            let (bits, size) = (term.to_bits(), (term.to_bits() >> 52 & 0x7FF) as i32);
            let digits = u128::from(bits & ((1 << 52) - 1) | u64::from(size > 0) << 52);
            // The term is `digits` steps, `shift` binary places up: down only where the last places are zero.
            let shift = size.max(1) - 1075 + 32;
            let (digits, shift) = if shift >= 0 {
                (digits, shift as usize)
            } else {
                (digits.checked_shr(-shift as u32).unwrap_or(0), 0)
            };
            let signed =
                (digits << (shift % 32)) as i128 * i128::from(sign) * if term < 0.0 { -1 } else { 1 };
            for place in 0..3 {
                self.places[shift / 32 + place] +=
                    (signed.abs() >> (32 * place) & 0xFFFF_FFFF) * signed.signum();
            }
        }

        fn value(&self) -> f64 {
            match self.infinite.map(|count| count > 0) {
                [true, true] => return f64::NAN,
                [true, false] => return f64::NEG_INFINITY,
                [false, true] => return f64::INFINITY,
                _ => {}
            }
            // Every place from 0 to 2^32 - 1, of the sum or of its opposite.
            let carried = |sign: i128| {
                let mut carry = 0;
                let places = self.places.map(|place| {
                    let sum = sign * place + carry;
                    carry = sum >> 32;
                    (sum & 0xFFFF_FFFF) as u64
                });
                (carry == 0).then_some(places)
            };
            let (sign, places) =
                carried(1).map_or_else(|| (-1.0, carried(-1).unwrap()), |places| (1.0, places));
            let bit = |at: usize| places[at / 32] >> (at % 32) & 1;
            let Some(top) = (0..40 * 32).rev().find(|at| bit(*at) == 1) else { return 0.0 };
            if top < 53 {
                return sign * (places[1] << 32 | places[0]) as f64 * STEP;
            }
            let mut digits = (top - 52..=top).rev().fold(0, |digits, at| digits << 1 | bit(at));
            let (half, rest) = (bit(top - 53), (0..top - 53).any(|at| bit(at) == 1));
            digits += u64::from(half == 1 && (rest || digits % 2 == 1));
            // `digits` is exact; the power of two may overflow only together with the sum.
            sign * digits as f64 * 2f64.powi((top - 52) as i32 - 64) * 2f64.powi(32)
        }
    }

    const STEP: f64 = 1.0 / (1u64 << 32) as f64;
    const EMPTY: Exact = Exact { places: [0; 40], infinite: [0; 2] };

    /// Terms of every size; among them powers of two, whose sums lie half way between two numbers.
    fn term(random: &mut Stream) -> f64 {
        let sign = if random.uniform() < 0.5 { -1.0 } else { 1.0 };
        let (kind, u) = ((random.uniform() * 9.0) as u32, random.uniform());
        grid(
            sign * match kind {
                0 => u * 10.0,
                1 => 10f64.powf(u * 27.0 - 9.0),
                2 => 2f64.powi((u * 1056.0) as i32 - 32),
                3 => 2f64.powi((u * 96.0) as i32 - 32),
                4 => [0.5 * NEAR, NEAR, 2.0 * NEAR, NEAR - STEP, NEAR + STEP, f64::MAX, 1e300]
                    [(u * 7.0) as usize],
                5 => (u + 0.5) * [0.5 * NEAR, NEAR, 1e9, 1e300][(u * 4.0) as usize],
                6 => 10f64.powf(u * 600.0 - 300.0),
                7 if u < 0.3 => f64::INFINITY,
                _ => u * 1e18,
            },
        )
    }

    #[test]
    fn a_total_is_the_exact_sum_rounded_once() {
        let (mut plain_fails, chains) = (0, 500);
        for chain in 0..chains {
            let mut random = Stream::new(1, 0, 0, chain);
            let (mut total, mut exact, mut plain, mut terms) = (Total::default(), EMPTY, 0.0, vec![]);
            for step in 0..60 {
                if !terms.is_empty() && (step >= 40 || random.uniform() < 0.4) {
                    let old = terms.swap_remove((random.uniform() * terms.len() as f64) as usize);
                    total.remove(old);
                    exact.add(old, -1);
                    plain -= old;
                } else {
                    let new = term(&mut random);
                    terms.push(new);
                    total.add(new);
                    exact.add(new, 1);
                    plain += new;
                }
                let (value, expected) = (total.value(), exact.value());
                assert!(
                    value == expected || value.is_nan() && expected.is_nan(),
                    "{value} is not {expected}: {terms:?}"
                );
            }
            // One term replaces another, and back.
            if let Some(old) = terms.first() {
                let (mut other, new) = (total.clone(), term(&mut random));
                other.replace(*old, new);
                exact.add(*old, -1);
                exact.add(new, 1);
                let (value, expected) = (other.value(), exact.value());
                assert!(value == expected || value.is_nan() && expected.is_nan());
                exact.add(new, -1);
                exact.add(*old, 1);
                other.replace(new, *old);
                assert_eq!(other, total);
                other.clear();
                assert!(other == Total::default() && other.near == 0.0);
            }
            // The terms in another order have an equal sum; then a difference of sums.
            let (mut other, mut rest) = (Total::default(), exact.clone());
            terms.iter().rev().for_each(|term| other.add(*term));
            assert_eq!(total, other);
            assert_eq!(format!("{total:?}"), format!("{other:?}"));
            let half = &terms[..terms.len() / 2];
            let mut part = Total::default();
            half.iter().for_each(|term| part.add(*term));
            half.iter().for_each(|term| rest.add(*term, -1));
            let (sum, expected) = (total.less(&part).value(), rest.value());
            assert!(sum == expected || sum.is_nan() && expected.is_nan());
            assert_eq!(total.less(&part).plus(&part), total);
            assert!(terms.is_empty() || total != total.plus(&Total { near: STEP, far: None }));
            // A mutant: a sum of `f64`.
            plain_fails += u64::from(plain != exact.value());
            // After removal of every term the total is zero.
            terms.iter().for_each(|term| total.remove(*term));
            assert!(total == Total::default() && total.near == 0.0);
        }
        assert!(plain_fails > chains / 2, "a plain sum was right {} times", chains - plain_fails);
    }

    #[test]
    fn ties_go_to_even_unless_a_rest_decides() {
        let (large, half, step) = (2f64.powi(100), 2f64.powi(47), 2f64.powi(-32));
        for (terms, right) in [
            (vec![large, half], large),
            (vec![large, half, step], large + 2.0 * half),
            (vec![large, half, -step], large),
            (vec![large, 3.0 * half], large + 4.0 * half),
            (vec![large, 3.0 * half, -step], large + 2.0 * half),
            (vec![large, -0.5 * half], large),
            (vec![large, -0.5 * half, -step], large - half),
            (vec![f64::MAX, f64::MAX, f64::MAX, -f64::MAX, -f64::MAX], f64::MAX),
            (vec![f64::MAX, f64::MAX], f64::INFINITY),
        ] {
            for sign in [1.0, -1.0] {
                let mut total = Total::default();
                terms.iter().for_each(|term| total.add(sign * term));
                assert_eq!(total.value(), sign * right, "{terms:?}");
            }
        }
    }

    #[test]
    fn far_sums_are_exact_and_reversible() {
        for sign in [1.0, -1.0] {
            let (term, count) = (sign * 500_000.25, 20_000);
            let mut total = Total::default();
            (0..count).for_each(|_| total.add(term));
            assert_eq!(total.value(), term * f64::from(count));
            assert!(total.near.is_nan());
            let mut twice = total.plus(&total);
            assert_eq!(twice.value(), 2.0 * total.value());
            twice.remove_total(&total);
            assert_eq!(twice, total);
            (0..count).for_each(|_| total.remove(term));
            assert_eq!(total.value(), 0.0);
            let mut most = Total::default();
            most.add(sign * (NEAR - STEP));
            assert!(!most.near.is_nan() && most.plus(&most).near.is_nan());
            assert_eq!(most.plus(&most).value(), sign * 2.0 * (NEAR - STEP));
        }
    }

    #[test]
    fn infinities_and_nan_are_reversible() {
        let mut total = Total::default();
        total.add(grid(0.1));
        let before = total.clone();
        for terms in
            [vec![f64::NEG_INFINITY; 3], vec![f64::NEG_INFINITY, f64::INFINITY], vec![f64::NAN, 1e300]]
        {
            terms.iter().for_each(|term| total.add(*term));
            assert_eq!(total.is_impossible(), terms[1] == f64::NEG_INFINITY);
            assert_eq!(total.value().is_nan(), terms[1] != f64::NEG_INFINITY);
            terms.iter().for_each(|term| total.remove(*term));
            assert_eq!(total, before);
            assert_eq!(total.value(), grid(0.1));
        }
        total.remove(f64::NEG_INFINITY);
        assert_eq!(total.value(), f64::INFINITY);
    }
}
