//! A network's way from inputs to outputs.

use super::form::{LANES, Layout, NetForm};
use super::real::Real;
use niwaki_math::Stream;

/// Largest distance of a feature from its mean, in deviations.
const FARTHEST: f64 = 10.0;

/// A network.
#[derive(Clone, Debug, PartialEq)]
pub struct Net<T: Real = f32> {
    pub(crate) form: NetForm,
    pub(crate) layout: Layout,
    /// All weights, in the order of [`Layout`]. The weights of windows apply to windows without standardisation.
    pub(crate) weights: Vec<T>,
    /// Mean of each feature, and one over its deviation: zero for a feature that never changed in training.
    pub(crate) features: Vec<(T, T)>,
    /// Whether the network was never trained.
    pub(crate) fresh: bool,
}

/// Memory for an answer.
#[derive(Clone, Debug, Default)]
pub struct Scratch<T: Real = f32> {
    /// First hidden layer.
    pub(crate) first: Vec<T>,
    /// Second hidden layer.
    pub(crate) second: Vec<T>,
    /// Outputs.
    pub(crate) outputs: Vec<T>,
}

/// Adds to `sums` the rows times the inputs, the first input first: the order of additions is equal in every lane
/// and on every machine.
#[inline(always)]
pub(crate) fn add_rows<T: Real>(sums: &mut [T], rows: &[T], inputs: &[T]) {
    let width = sums.len();
    let mut at = 0;
    while at + 2 * LANES <= width {
        add_block::<T, { 2 * LANES }>(sums, rows, inputs, at, width);
        at += 2 * LANES;
    }
    while at + LANES <= width {
        add_block::<T, LANES>(sums, rows, inputs, at, width);
        at += LANES;
    }
}

/// Computes `N` lanes of [`add_rows`], held in registers.
#[inline(always)]
fn add_block<T: Real, const N: usize>(sums: &mut [T], rows: &[T], inputs: &[T], at: usize, width: usize) {
    let mut lanes = [T::ZERO; N];
    lanes.copy_from_slice(&sums[at..at + N]);
    for (row, x) in rows.chunks_exact(width).zip(inputs) {
        let row = &row[at..at + N];
        for lane in 0..N {
            lanes[lane] += row[lane] * *x;
        }
    }
    sums[at..at + N].copy_from_slice(&lanes);
}

/// The hyperbolic tangent of each number.
#[inline(always)]
pub(crate) fn squash<T: Real>(numbers: &mut [T]) {
    for block in numbers.chunks_exact_mut(LANES) {
        for x in block {
            *x = x.tanh();
        }
    }
}

impl<T: Real> Net<T> {
    /// A network before training: for any input, the guide equals the prior, or nearly so for mixtures of Gaussians.
    ///
    /// # Panics
    ///
    /// If a hidden layer is empty, or a head has no outputs or more than 64.
    pub fn start(form: NetForm, seed: u64) -> Net<T> {
        assert!(form.hidden.iter().all(|n| *n > 0), "a hidden layer is empty");
        assert!(form.heads.iter().all(|h| h.is_sound()), "a head has no outputs, or too many");
        let layout = Layout::new(&form);
        let mut weights = vec![T::ZERO; layout.len];
        let mut stream = Stream::new(seed, 0, 0, 0);
        // Gaussian weights whose sum over standardised inputs has variance 1; the constants of sites are smaller.
        let mut fill = |block: usize, rows: usize, used: usize, width: usize, sd: f64| {
            for k in 0..rows {
                let row = &mut weights[Layout::row(block, k, width)][..used];
                row.iter_mut().for_each(|w| *w = T::from_f64(sd * stream.normal()));
            }
        };
        let [first, second] = form.hidden;
        let inputs = ((form.windows + form.features).max(1) as f64).sqrt();
        fill(layout.windows, form.windows, first, layout.width[0], 1.0 / inputs);
        fill(layout.features, form.features, first, layout.width[0], 1.0 / inputs);
        fill(layout.sites, form.heads.len(), first, layout.width[0], 0.5);
        fill(layout.second, first, second, layout.width[1], 1.0 / (first as f64).sqrt());
        for (head, (_, constants, _)) in form.heads.iter().zip(&layout.heads) {
            for (w, x) in weights[*constants..].iter_mut().zip(head.start()) {
                *w = T::from_f64(x);
            }
        }
        let features = vec![(T::ZERO, T::ZERO); form.features];
        Net { form, layout, weights, features, fresh: true }
    }

    /// The form: inputs and outputs.
    pub fn form(&self) -> &NetForm {
        &self.form
    }

    /// The number of weights, without padding.
    pub fn size(&self) -> usize {
        let [first, second] = self.form.hidden;
        let inputs = self.form.windows + self.form.features + self.form.heads.len();
        let heads: usize = self.form.heads.iter().map(|h| (second + 1) * h.outputs()).sum();
        (inputs + 1) * first + (first + 1) * second + heads
    }

    /// Converts the network to another type of numbers.
    pub fn convert<U: Real>(&self) -> Net<U> {
        let number = |x: &T| U::from_f64(x.to_f64());
        Net {
            form: self.form.clone(),
            layout: self.layout.clone(),
            weights: self.weights.iter().map(number).collect(),
            features: self.features.iter().map(|(mean, scale)| (number(mean), number(scale))).collect(),
            fresh: self.fresh,
        }
    }

    /// Writes the first layer's sums over a window to `sums`; computed once while place and scene stay unchanged.
    ///
    /// # Panics
    ///
    /// If the length of the window is not that of the form.
    pub fn see(&self, window: &[T], sums: &mut Vec<T>) {
        assert_eq!(window.len(), self.form.windows, "numbers of a window");
        let (layout, width) = (&self.layout, self.layout.width[0]);
        sums.clear();
        sums.extend_from_slice(&self.weights[layout.first..layout.first + width]);
        add_rows(sums, &self.weights[layout.windows..layout.features], window);
    }

    /// A feature's standardised value: zero if the value is not finite.
    #[inline(always)]
    pub(crate) fn standardised(&self, feature: u32, value: T) -> T {
        let (mean, scale) = self.features[feature as usize];
        let bound = T::from_f64(FARTHEST);
        let x = (value - mean) * scale;
        if x.to_f64().is_nan() { T::ZERO } else { x.clamp(-bound, bound) }
    }

    /// Outputs of a site's head. `sums` are the sums from [`Net::see`]; `features` are (number, raw value), and
    /// a missing feature counts as its mean.
    ///
    /// # Panics
    ///
    /// If there is no such site or feature, or `sums` come from another network.
    #[inline]
    pub fn answer<'s>(
        &self,
        sums: &[T],
        features: &[(u32, T)],
        site: usize,
        scratch: &'s mut Scratch<T>,
    ) -> &'s [T] {
        let second = self.hidden(sums, features, site, scratch).len();
        let Scratch { second: hidden, outputs, .. } = scratch;
        let (rows, constants, width) = self.layout.heads[site];
        outputs.clear();
        outputs.extend_from_slice(&self.weights[constants..constants + width]);
        add_rows(outputs, &self.weights[rows..constants], &hidden[..second]);
        &outputs[..self.form.heads[site].outputs()]
    }

    /// The second hidden layer at a site, each number between -1 and 1; parameters as for [`Net::answer`].
    ///
    /// # Panics
    ///
    /// See [`Net::answer`].
    #[inline]
    pub fn hidden<'s>(
        &self,
        sums: &[T],
        features: &[(u32, T)],
        site: usize,
        scratch: &'s mut Scratch<T>,
    ) -> &'s [T] {
        let (layout, weights) = (&self.layout, &self.weights);
        let [width, second_width] = layout.width;
        let Scratch { first, second, .. } = scratch;
        first.clear();
        first.extend_from_slice(sums);
        let first = &mut first[..width];
        add_rows(first, &weights[Layout::row(layout.sites, site, width)], &[T::ONE]);
        for (k, value) in features {
            let row = &weights[Layout::row(layout.features, *k as usize, width)];
            add_rows(first, row, &[self.standardised(*k, *value)]);
        }
        squash(first);
        second.clear();
        second.extend_from_slice(&weights[layout.second_constants..layout.second_constants + second_width]);
        let rows = &weights[layout.second..layout.second_constants];
        add_rows(second, rows, &first[..self.form.hidden[0]]);
        squash(second);
        &second[..self.form.hidden[1]]
    }
}
