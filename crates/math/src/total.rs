//! Sums of log scores that are exact, whatever the sizes of their terms.
//!
//! A sum that is kept up to date (`total - old + new`) must come back to what it was when a term is taken away, and two
//! runs that made the same choices in another order must agree in the last bit. With `f64` that holds only while every
//! sum fits into 53 bits. A [`Total`] holds each term on the [`grid`](crate::grid) of 2^-32 nats without loss:
//!
//! | terms | where |
//! | --- | --- |
//! | below 2^30 nats | one integer, in steps of 2^-32 nats, as long as it has room for their sum |
//! | larger, finite; sums without room | an expansion: `f64` parts that do not overlap (Shewchuk 1997, theorem 10), on the heap while it is needed |
//! | infinite | counted by sign, beside the expansion; NaN is counted as one of each, and comes back as NaN |

use std::fmt;

/// 1.5 * 2^20: in the sum of it and a number below 2^19, the last bit is worth 2^-32.
const SHIFT: f64 = 1.5 * (1u64 << 20) as f64;
/// Terms below this size have the quick addition, nats.
const QUICK: f64 = (1u64 << 19) as f64;
/// Terms below this size go into the integer, nats.
const NEAR: f64 = (1u64 << 30) as f64;
/// Steps in a nat.
const STEPS: f64 = (1u64 << 32) as f64;
/// A step, nats.
const STEP: f64 = 1.0 / STEPS;
/// Far terms are held times 2^-64, so that no partial sum overflows. All stay far above subnormal numbers.
const SCALE: f64 = STEP * STEP;
/// 2^20 nats in steps.
const SMALL: i64 = 1 << 52;

/// An exact sum of terms, nats: finite terms of any size, and infinities. Each term is first rounded to the nearest
/// multiple of 2^-32.
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
    /// Sum of the near terms, steps of 2^-32 nats.
    near: i64,
    /// What is not in `near`, if anything.
    rest: Option<Box<Rest>>,
}

/// Terms that are not near.
#[derive(Clone, Default, PartialEq)]
struct Rest {
    /// Sum of the finite ones, times [`SCALE`].
    far: Expansion,
    /// How many terms are minus infinity, and plus infinity; below zero, where more of them were taken away.
    infinite: [i32; 2],
}

impl Total {
    /// Adds a term.
    #[inline(always)]
    pub fn add(&mut self, term: f64) {
        if term.abs() < QUICK {
            self.add_steps(quick_steps(term));
        } else {
            self.add_large(term, 1);
        }
    }

    /// Takes a term away.
    #[inline(always)]
    pub fn remove(&mut self, term: f64) {
        if term.abs() < QUICK {
            self.remove_steps(quick_steps(term));
        } else {
            self.add_large(term, -1);
        }
    }

    /// Takes a term away and adds another.
    #[inline(always)]
    pub fn replace(&mut self, old: f64, new: f64) {
        if old.abs() < QUICK && new.abs() < QUICK {
            self.add_steps(quick_steps(new) - quick_steps(old));
        } else {
            self.remove(old);
            self.add(new);
        }
    }

    /// Takes every term away.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.near = 0;
        if self.rest.is_some() {
            self.copy_rest(&Total::default());
        }
    }

    #[inline(always)]
    fn add_steps(&mut self, steps: i64) {
        match self.near.checked_add(steps) {
            Some(near) => self.near = near,
            None => self.make_room(steps, 1.0),
        }
    }

    #[inline(always)]
    fn remove_steps(&mut self, steps: i64) {
        match self.near.checked_sub(steps) {
            Some(near) => self.near = near,
            None => self.make_room(steps, -1.0),
        }
    }

    /// Moves the near sum, and steps for which it has no room, to the far one.
    #[cold]
    #[inline(never)]
    fn make_room(&mut self, steps: i64, sign: f64) {
        let near = std::mem::take(&mut self.near);
        self.change_rest(|rest| {
            parts(near).into_iter().for_each(|part| rest.far.grow(part));
            parts(steps).into_iter().for_each(|part| rest.far.grow(sign * part));
        });
    }

    #[cold]
    #[inline(never)]
    fn add_large(&mut self, term: f64, sign: i32) {
        let signed = f64::from(sign) * term;
        if term.abs() < NEAR {
            self.add_steps((signed * STEPS).round_ties_even() as i64);
        } else if term.is_finite() {
            self.change_rest(|rest| rest.far.grow(signed * SCALE));
        } else {
            let is = [term != f64::INFINITY, term != f64::NEG_INFINITY];
            self.change_rest(|rest| (0..2).for_each(|end| rest.infinite[end] += sign * i32::from(is[end])));
        }
    }

    /// Changes what is not near. What has become small is moved to the near sum, and nothing is held where nothing is left.
    fn change_rest(&mut self, change: impl FnOnce(&mut Rest)) {
        let mut rest = self.rest.take().unwrap_or_default();
        change(&mut rest);
        if let Some(near) = rest.far.steps().and_then(|steps| self.near.checked_add(steps)) {
            (self.near, rest.far) = (near, Expansion::default());
        }
        self.rest = (*rest != Rest::default()).then_some(rest);
    }

    #[cold]
    #[inline(never)]
    fn add_rest(&mut self, other: &Rest, sign: i32) {
        self.change_rest(|rest| {
            other.far.0.iter().for_each(|part| rest.far.grow(f64::from(sign) * part));
            (0..2).for_each(|end| rest.infinite[end] += sign * other.infinite[end]);
        });
    }

    /// Adds every term of another sum.
    #[inline(always)]
    pub fn add_total(&mut self, other: &Total) {
        self.add_steps(other.near);
        if let Some(rest) = &other.rest {
            self.add_rest(rest, 1);
        }
    }

    /// Takes every term of another sum away.
    #[inline(always)]
    pub fn remove_total(&mut self, other: &Total) {
        self.remove_steps(other.near);
        if let Some(rest) = &other.rest {
            self.add_rest(rest, -1);
        }
    }

    /// The sum of both.
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

    /// Whether the sum is minus infinity, as a term is.
    #[inline]
    pub fn is_impossible(&self) -> bool {
        self.rest.as_ref().is_some_and(|rest| rest.infinite[0] > 0 && rest.infinite[1] == 0)
    }

    /// The sum, where it is below 2^20 nats: it is then exact as an `f64`, and so is the sum of two such.
    #[inline(always)]
    pub fn small(&self) -> Option<f64> {
        let fits = (self.near.wrapping_add(SMALL) as u64) < 2 * SMALL as u64;
        (fits && self.rest.is_none()).then_some(self.near as f64 * STEP)
    }

    /// The nearest `f64`, ties to even. A term of minus infinity makes it minus infinity, and a term of each sign NaN.
    #[inline(always)]
    pub fn value(&self) -> f64 {
        match &self.rest {
            None => self.near as f64 * STEP,
            Some(rest) => self.large_value(rest),
        }
    }

    #[cold]
    #[inline(never)]
    fn large_value(&self, rest: &Rest) -> f64 {
        let [lowest, highest] = rest.infinite;
        // A term that was only taken away is one of the other sign.
        match (highest > 0 || lowest < 0, lowest > 0 || highest < 0) {
            (true, true) => return f64::NAN,
            (true, false) => return f64::INFINITY,
            (false, true) => return f64::NEG_INFINITY,
            (false, false) => {}
        }
        let mut sum = rest.far.clone();
        parts(self.near).into_iter().for_each(|part| sum.grow(part));
        sum.rounded() / SCALE
    }
}

impl Clone for Total {
    #[inline(always)]
    fn clone(&self) -> Total {
        let mut copy = Total { near: self.near, rest: None };
        if self.rest.is_some() {
            copy.copy_rest(self);
        }
        copy
    }

    #[inline(always)]
    fn clone_from(&mut self, other: &Total) {
        self.near = other.near;
        if self.rest.is_some() || other.rest.is_some() {
            self.copy_rest(other);
        }
    }
}

impl Total {
    #[cold]
    #[inline(never)]
    fn copy_rest(&mut self, other: &Total) {
        self.rest.clone_from(&other.rest);
    }
}

/// Steps of 2^-32 nats in a term below 2^19 nats, to the nearest one: the last bits of its sum with [`SHIFT`].
#[inline(always)]
fn quick_steps(term: f64) -> i64 {
    (term + SHIFT).to_bits() as i64 - SHIFT.to_bits() as i64
}

/// Steps as nats times [`SCALE`], exactly.
fn parts(steps: i64) -> [f64; 2] {
    [(steps >> 32) as f64 * SCALE, (steps & 0xFFFF_FFFF) as f64 * STEP * SCALE]
}

impl PartialEq for Total {
    /// Whether the exact sums are equal, whatever terms they were made of.
    fn eq(&self, other: &Total) -> bool {
        let infinite = |of: &Total| of.rest.as_ref().map_or([0; 2], |rest| rest.infinite);
        match (&self.rest, &other.rest) {
            (None, None) => self.near == other.near,
            _ => infinite(self) == infinite(other) && self.less(other).value() == 0.0,
        }
    }
}

impl fmt::Debug for Total {
    /// The nearest `f64`, and what it lacks of the exact sum: equal sums have equal texts.
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

/// A number as the sum of parts that do not overlap, none zero, smallest first.
#[derive(Clone, Default, PartialEq)]
struct Expansion(Vec<f64>);

impl Expansion {
    /// Adds a number exactly.
    fn grow(&mut self, mut carried: f64) {
        self.0.retain_mut(|part| {
            let (sum, rest) = two_sum(carried, *part);
            (carried, *part) = (sum, rest);
            rest != 0.0
        });
        if carried != 0.0 {
            self.0.push(carried);
        }
    }

    /// As steps, where it is small enough for the near sum.
    fn steps(&self) -> Option<i64> {
        let is_near = self.rounded().abs() < NEAR * SCALE;
        is_near.then(|| self.0.iter().map(|part| (part / SCALE * STEPS) as i64).sum())
    }

    /// The nearest `f64`, ties to even.
    fn rounded(&self) -> f64 {
        let mut parts = self.0.iter().rev().copied();
        let (mut sum, mut rest) = (0.0, 0.0);
        while rest == 0.0 {
            let Some(part) = parts.next() else { return sum };
            (sum, rest) = two_sum(sum, part);
        }
        // The parts below `rest` are smaller than its last bit. They decide where `rest` is half of the last bit of `sum`:
        // then twice `rest` added to `sum` is exact, and on the far side of the middle.
        let beyond = parts.next().unwrap_or(0.0);
        let next = sum + 2.0 * rest;
        let is_half = next - sum == 2.0 * rest;
        if is_half && beyond * rest > 0.0 { next } else { sum }
    }
}

/// The sum of two numbers, rounded, and what the rounding lost (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

#[cfg(test)]
mod tests {
    //! A total is the nearest `f64` to the exact sum, whatever was added and taken away before, and in any order.
    use super::*;
    use crate::{Stream, grid};

    /// The plain way: a whole number of steps of 2^-32 nats, in binary places of 32 bits each, and counts of infinities.
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
            // The term is `digits` steps, `shift` binary places up.
            let shift = size.max(1) - 1075 + 32;
            let (digits, shift) = if shift >= 0 {
                (digits, shift as usize)
            } else if shift < -60 {
                (0, 0)
            } else {
                let (whole, rest, half) = (digits >> -shift, digits & ((1 << -shift) - 1), 1 << (-shift - 1));
                (whole + u128::from(rest > half || (rest == half && whole % 2 == 1)), 0)
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
                return sign * (places[1] << 32 | places[0]) as f64 / STEPS;
            }
            let mut digits = (top - 52..=top).rev().fold(0, |digits, at| digits << 1 | bit(at));
            let (half, rest) = (bit(top - 53), (0..top - 53).any(|at| bit(at) == 1));
            digits += u64::from(half == 1 && (rest || digits % 2 == 1));
            // `digits` is exact; the power of two may overflow only together with the sum.
            sign * digits as f64 * 2f64.powi((top - 52) as i32 - 64) * 2f64.powi(32)
        }
    }

    const NOTHING: Exact = Exact { places: [0; 40], infinite: [0; 2] };

    /// Terms of every size; of powers of two too, whose sums lie half way between two numbers.
    fn term(random: &mut Stream) -> f64 {
        let sign = if random.uniform() < 0.5 { -1.0 } else { 1.0 };
        let (kind, u) = ((random.uniform() * 9.0) as u32, random.uniform());
        sign * match kind {
            0 => u * 10.0,
            1 => 10f64.powf(u * 27.0 - 9.0),
            2 => 2f64.powi((u * 1056.0) as i32 - 32),
            3 => 2f64.powi((u * 96.0) as i32 - 32),
            4 => [524_288.0, 1_048_576.0, NEAR, f64::MAX, 1e300][(u * 5.0) as usize],
            5 => (u + 0.5) * [524_288.0, 1_048_576.0, NEAR, 1e300][(u * 4.0) as usize],
            6 => 10f64.powf(u * 600.0 - 300.0),
            7 if u < 0.3 => f64::INFINITY,
            _ => u * 1e18,
        }
    }

    #[test]
    fn a_total_is_the_exact_sum_rounded_once() {
        let (mut plain_fails, chains) = (0, 500);
        for chain in 0..chains {
            let mut random = Stream::new(1, 0, 0, chain);
            let (mut total, mut exact, mut plain, mut terms) = (Total::default(), NOTHING, 0.0, vec![]);
            for step in 0..60 {
                if !terms.is_empty() && (step >= 40 || random.uniform() < 0.4) {
                    let gone = terms.swap_remove((random.uniform() * terms.len() as f64) as usize);
                    total.remove(gone);
                    exact.add(gone, -1);
                    plain -= grid(gone);
                } else {
                    let come = term(&mut random);
                    terms.push(come);
                    total.add(come);
                    exact.add(come, 1);
                    plain += grid(come);
                }
                let (found, right) = (total.value(), exact.value());
                assert!(
                    found == right || found.is_nan() && right.is_nan(),
                    "{found} is not {right}: {terms:?}"
                );
            }
            // One term for another, and back.
            if let Some(old) = terms.first() {
                let (mut other, new) = (total.clone(), term(&mut random));
                other.replace(*old, new);
                exact.add(*old, -1);
                exact.add(new, 1);
                let (found, right) = (other.value(), exact.value());
                assert!(found == right || found.is_nan() && right.is_nan());
                exact.add(new, -1);
                exact.add(*old, 1);
                other.replace(new, *old);
                assert_eq!(other, total);
                other.clear();
                assert!(other == Total::default() && other.rest.is_none());
            }
            // The same terms in another order, and their difference from others.
            let (mut other, mut rest) = (Total::default(), exact.clone());
            terms.iter().rev().for_each(|term| other.add(*term));
            assert_eq!(total, other);
            assert_eq!(format!("{total:?}"), format!("{other:?}"));
            let half = &terms[..terms.len() / 2];
            let mut part = Total::default();
            half.iter().for_each(|term| part.add(*term));
            half.iter().for_each(|term| rest.add(*term, -1));
            let (found, right) = (total.less(&part).value(), rest.value());
            assert!(found == right || found.is_nan() && right.is_nan());
            assert_eq!(total.less(&part).plus(&part), total);
            assert!(terms.is_empty() || total != total.plus(&Total { near: 1, rest: None }));
            // A mutant: a sum of `f64` on the grid.
            plain_fails += u64::from(plain != exact.value());
            // With everything gone, nothing is left.
            terms.iter().for_each(|term| total.remove(*term));
            assert!(total == Total::default() && total.rest.is_none());
        }
        assert!(plain_fails > chains / 2, "a plain sum was right {} times", chains - plain_fails);
    }

    #[test]
    fn ties_go_to_even_unless_something_is_left() {
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
    fn sums_without_room_in_the_integer_are_exact_and_come_back() {
        for sign in [1.0, -1.0] {
            let (term, count) = (sign * 500_000.25, 20_000);
            let mut total = Total::default();
            (0..count).for_each(|_| total.add(term));
            assert_eq!(total.value(), term * f64::from(count));
            assert!(total.rest.is_some());
            let mut twice = total.plus(&total);
            assert_eq!(twice.value(), 2.0 * total.value());
            twice.remove_total(&total);
            assert_eq!(twice, total);
            (0..count).for_each(|_| total.remove(term));
            assert_eq!(total.value(), 0.0);
            let most = Total { near: i64::MIN, rest: None };
            assert_eq!(Total::default().less(&most).value(), 2f64.powi(31));
        }
    }

    #[test]
    fn infinities_and_nan_come_back() {
        let mut total = Total::default();
        total.add(0.1);
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
