//! The loss of a row, and its derivatives by all weights.

use super::rows::Rows;
use crate::net::{LANES, Layout, Net, Real, Scratch};

/// Memory for the passes of a thread.
#[derive(Clone, Debug, Default)]
pub(super) struct Work<T: Real> {
    window: Vec<T>,
    features: Vec<(u32, T)>,
    sums: Vec<T>,
    scratch: Scratch<T>,
    outputs: Vec<f64>,
    slopes: Vec<f64>,
    back: [Vec<T>; 3],
}

/// Adds `scale` times `row` to `sums`.
#[inline(always)]
pub(crate) fn add_scaled<T: Real>(sums: &mut [T], row: &[T], scale: T) {
    for (sum, x) in sums.iter_mut().zip(row) {
        *sum += *x * scale;
    }
}

/// The sum of products, in lanes that are added up at the end, in an order that is equal on every machine.
#[inline(always)]
pub(crate) fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    let mut lanes = [T::ZERO; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for lane in 0..LANES {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// Propagates derivatives one layer back: writes those by the inputs `hidden` (values of tanh) from those by the outputs, and adds
/// those by the weights `rows` to `slope`.
#[inline(always)]
pub(crate) fn back_through<T: Real>(
    rows: &[T],
    slope: &mut [T],
    hidden: &[T],
    outputs: &[T],
    inputs: &mut [T],
) {
    let width = outputs.len();
    let each = rows.chunks_exact(width).zip(slope.chunks_exact_mut(width));
    for (((row, slope), h), input) in each.zip(hidden).zip(inputs) {
        add_scaled(slope, outputs, *h);
        *input = (T::ONE - *h * *h) * dot(row, outputs);
    }
}

impl<T: Real> Work<T> {
    /// The loss of a row, nats. If the weights are for standardised windows, `scaling` has mean and one over deviation of each number
    /// of a window. With `slope`, the derivatives times its factor are added to it.
    pub(super) fn loss(
        &mut self,
        net: &Net<T>,
        scaling: Option<&[(T, T)]>,
        rows: &Rows,
        row: usize,
        share: f64,
        slope: Option<(&mut [T], f64)>,
    ) -> f64 {
        let Work { window, features, sums, scratch, outputs, slopes, back } = self;
        let (layout, site) = (&net.layout, rows.site(row));
        window.clear();
        window.extend(rows.window(row).iter().map(|x| T::from_f64(f64::from(*x))));
        if let Some(scaling) = scaling {
            window.iter_mut().zip(scaling).for_each(|(x, (mean, scale))| *x = (*x - *mean) * *scale);
        }
        features.clear();
        features.extend(rows.features(row).iter().map(|(k, x)| (*k, T::from_f64(f64::from(*x)))));
        net.see(window, sums);
        let answer = net.answer(sums, features, site, scratch);
        outputs.clear();
        outputs.extend(answer.iter().map(|x| x.to_f64()));
        let Some((slope, times)) = slope else {
            return -rows.lesson(row).log_quotient(outputs, share, None);
        };
        slopes.clear();
        slopes.resize(outputs.len(), 0.0);
        let loss = -rows.lesson(row).log_quotient(outputs, share, Some(slopes));

        let [last, second, first] = back;
        let (head, constants, width) = layout.heads[site];
        last.clear();
        last.extend(slopes.iter().map(|x| T::from_f64(-x * times)));
        last.resize(width, T::ZERO);
        second.clear();
        second.resize(layout.width[1], T::ZERO);
        let block = head..constants;
        back_through(&net.weights[block.clone()], &mut slope[block], &scratch.second, last, second);
        add_scaled(&mut slope[constants..constants + width], last, T::ONE);

        first.clear();
        first.resize(layout.width[0], T::ZERO);
        let block = layout.second..layout.second_constants;
        back_through(&net.weights[block.clone()], &mut slope[block], &scratch.first, second, first);
        let constants = layout.second_constants;
        add_scaled(&mut slope[constants..constants + second.len()], second, T::ONE);

        let width = layout.width[0];
        for (row, x) in slope[layout.windows..layout.features].chunks_exact_mut(width).zip(&*window) {
            add_scaled(row, first, *x);
        }
        for (k, x) in &*features {
            let row = Layout::row(layout.features, *k as usize, width);
            add_scaled(&mut slope[row], first, net.standardised(*k, *x));
        }
        add_scaled(&mut slope[Layout::row(layout.sites, site, width)], first, T::ONE);
        add_scaled(&mut slope[layout.first..layout.first + width], first, T::ONE);
        loss
    }
}

/// The mean loss of all rows, nats per choice; NaN if a loss is NaN.
pub fn loss<T: Real>(net: &Net<T>, rows: &Rows, share: f64) -> f64 {
    let mut work = Work::default();
    let sum: f64 = (0..rows.len()).map(|row| work.loss(net, None, rows, row, share, None)).sum();
    sum / rows.len().max(1) as f64
}

/// The mean loss of all rows, and its derivative by each weight, in the order of the file's `weights`.
pub fn loss_and_slope<T: Real>(net: &Net<T>, rows: &Rows, share: f64) -> (f64, Vec<T>) {
    let mut work = Work::default();
    let mut slope = vec![T::ZERO; net.weights.len()];
    let sum: f64 =
        (0..rows.len()).map(|row| work.loss(net, None, rows, row, share, Some((&mut slope, 1.0)))).sum();
    let share = T::from_f64(1.0 / rows.len().max(1) as f64);
    slope.iter_mut().for_each(|x| *x *= share);
    (sum / rows.len().max(1) as f64, slope)
}

#[cfg(test)]
mod tests {
    //! Derivatives by weights agree with differences, and a folded network answers as the trained one.
    use super::super::scaling;
    use super::*;
    use crate::heads::{Head, Lesson};
    use crate::net::NetForm;
    use niwaki_math::Stream;

    /// A small network with heads of all kinds, and rows that reach all of its weights.
    fn example() -> (Net<f64>, Rows) {
        let heads =
            vec![Head::Normal { components: 3 }, Head::Finite { values: 3 }, Head::Count { components: 2 }];
        let form = NetForm { windows: 4, features: 3, hidden: [5, 9], heads };
        let mut net: Net<f64> = Net::start(form.clone(), 8);
        let mut stream = Stream::new(4, 0, 0, 0);
        // Weights of heads begin at zero, so that nothing reaches the other layers.
        for (rows, constants, width) in net.layout.heads.clone() {
            for row in net.weights[rows..constants].chunks_exact_mut(width) {
                row[..4].iter_mut().for_each(|w| *w = 0.5 * stream.normal());
            }
        }
        net.features = vec![(0.5, 2.0), (-1.0, 0.7), (0.0, 0.0)];
        let mut rows = Rows::new(&form);
        for k in 0..30 {
            let mut number = || stream.normal() as f32;
            let window = [number(), number(), number(), number()];
            let some = [(0, number()), (1, number()), (2, number())];
            let lesson = match k % 3 {
                0 => Lesson::Normal { z: f64::from(number()), log_prior: -1.2, limits: (-2.0, 6.0) },
                1 => Lesson::Finite { value: k % 2, log_priors: [-1.0, -0.9, -1.5].into() },
                _ => Lesson::Count { between: (-0.3, f64::from(number()).abs()), log_prior: -1.0 },
            };
            rows.push(k % 3, &window, &some[k % 2..k % 4], &lesson);
        }
        (net, rows)
    }

    #[test]
    fn derivatives_by_weights_agree_with_differences() {
        let (mut net, rows) = example();
        let (_, slope) = loss_and_slope(&net, &rows, 0.1);
        let mut reached = 0;
        for (k, exact) in slope.iter().enumerate() {
            let at = net.weights[k];
            let mut moved = |step: f64| {
                net.weights[k] = at + step;
                loss(&net, &rows, 0.1)
            };
            let h = 1e-3;
            let numeric = (8.0 * (moved(h) - moved(-h)) - (moved(2.0 * h) - moved(-2.0 * h))) / (12.0 * h);
            moved(0.0);
            // Padding is not reached, and must not move. Its effect on the loss does not matter.
            if *exact != 0.0 {
                reached += 1;
                assert!((numeric - exact).abs() < 1e-6 * exact.abs().max(1e-3), "{k}: {numeric} {exact}");
            }
        }
        // Every weight is reached except the row of the constant feature.
        assert_eq!(reached, net.size() - 5);
    }

    #[test]
    fn folded_networks_answer_as_trained_ones() {
        let (net, rows) = example();
        let windows: Vec<(f64, f64)> = scaling::of_windows(&rows, 4);
        let mut work = Work::default();
        let (mut folded, mut back) = (net.clone(), net.clone());
        scaling::fold(&mut folded, &windows);
        scaling::unfold(&mut back, &windows);
        for row in 0..rows.len() {
            let trained = work.loss(&net, Some(&windows), &rows, row, 0.1, None);
            let from_folded = work.loss(&folded, None, &rows, row, 0.1, None);
            assert!((trained - from_folded).abs() < 1e-12, "{trained} {from_folded}");
            let from_unfolded = work.loss(&back, Some(&windows), &rows, row, 0.1, None);
            let raw = work.loss(&net, None, &rows, row, 0.1, None);
            assert!((from_unfolded - raw).abs() < 1e-12, "{from_unfolded} {raw}");
        }
    }
}
