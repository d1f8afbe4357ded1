//! The loss of a trace, and its derivatives by all weights.

use super::levels::{FILTERS, Levels};
use super::pass::Filtered;
use crate::heads::natural::{self, Natural};
use crate::heads::{Known, Lesson};
use crate::learn::{add_scaled, back_through, dot};
use crate::net::Real;
use std::sync::Arc;

/// The choices of a run, with the images that they saw.
#[derive(Clone, Debug)]
pub struct Trace {
    /// Columns and rows of the images.
    pub size: [usize; 2],
    /// The target: a bit for each filled pixel, row by row from the top, each row in words of its own.
    pub target: Arc<[u64]>,
    /// The scene at different times, in the form of the target.
    pub images: Vec<Vec<u64>>,
    /// The choices, in order.
    pub choices: Vec<Choice>,
}

/// A choice of a trace.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The site.
    pub site: usize,
    /// The number of the scene's image at the choice; it never falls from choice to choice.
    pub image: usize,
    /// The place, in shares of the page from its upper left corner.
    pub at: [f64; 2],
    /// Features: number and raw value.
    pub features: Vec<(u32, f32)>,
    /// Mean and deviation of a Gaussian prior; 0 and 1 of another prior.
    pub unit: (f64, f64),
    /// Prior and value.
    pub lesson: Lesson,
}

/// Memory for the passes of a thread.
#[derive(Clone, Debug, Default)]
pub(super) struct Work<T: Real> {
    target: Levels<T>,
    scene: Levels<T>,
    back: [Levels<T>; 2],
    inputs: Vec<T>,
    hidden: Vec<T>,
    outputs: Vec<T>,
    features: Vec<(u32, T)>,
    raw: Vec<f64>,
    translated: Vec<f64>,
    slopes: Vec<f64>,
    raw_slopes: Vec<f64>,
    last: Vec<T>,
    first: Vec<T>,
    of_inputs: Vec<T>,
}

impl<T: Real> Work<T> {
    /// The sum of the losses of a trace's choices, nats, and the site of the first loss that is not finite. With
    /// `slope`, the derivatives are added to it.
    pub(super) fn loss(
        &mut self,
        net: &Filtered<T>,
        trace: &Trace,
        share: f64,
        mut slope: Option<&mut [T]>,
    ) -> (f64, Option<usize>) {
        net.see_target(trace.size, &trace.target, &mut self.target);
        if net.form.target {
            self.back[0].clear(&self.target);
        }
        let (mut sum, mut fault) = (0.0, None);
        for choices in trace.choices.chunk_by(|a, b| a.image == b.image) {
            if net.form.scene {
                net.see_scene(trace.size, &trace.images[choices[0].image], &mut self.scene);
                self.back[1].clear(&self.scene);
            }
            for choice in choices {
                let loss = self.choice(net, choice, share, slope.as_deref_mut());
                if !loss.is_finite() {
                    fault = fault.or(Some(choice.site));
                }
                sum += loss;
            }
            if let (true, Some(slope)) = (net.form.scene, slope.as_deref_mut()) {
                let start = usize::from(net.form.target) * FILTERS;
                self.back[1].back(&self.scene, net.filters(true), &mut slope[start..start + FILTERS]);
            }
        }
        if let (true, Some(slope)) = (net.form.target, slope) {
            self.back[0].back(&self.target, net.filters(false), &mut slope[..FILTERS]);
        }
        (sum, fault)
    }

    /// The loss of a choice. Derivatives by the cells of windows go to `back`.
    fn choice(&mut self, net: &Filtered<T>, choice: &Choice, share: f64, slope: Option<&mut [T]>) -> f64 {
        let Work { target, scene, inputs, hidden, outputs, features, raw, translated, slopes, .. } = self;
        features.clear();
        features.extend(choice.features.iter().map(|(k, x)| (*k, T::from_f64(f64::from(*x)))));
        net.inputs(target, scene, choice.at, features, choice.site, inputs);
        net.pass(choice.site, inputs, hidden, outputs);
        raw.clear();
        raw.extend(outputs.iter().map(|x| x.to_f64()));
        let known = choice.lesson.known();
        let natural = match &known {
            Known::Finite { log_priors, .. } => Natural::Values(log_priors),
            _ => Natural::Line { mean: choice.unit.0, sd: choice.unit.1 },
        };
        natural::translate(raw, natural, translated);
        let Some(slope) = slope else { return -known.log_quotient(translated, share, None) };
        slopes.clear();
        slopes.resize(translated.len(), 0.0);
        let loss = -known.log_quotient(translated, share, Some(slopes));
        natural::back(raw, natural, slopes, &mut self.raw_slopes);

        let site = net.layout.sites[choice.site];
        let Work { last, first, of_inputs, .. } = self;
        last.clear();
        last.extend(self.raw_slopes.iter().map(|x| T::from_f64(-x)));
        last.resize(site.width[1], T::ZERO);
        first.clear();
        first.resize(site.width[0], T::ZERO);
        let block = site.second..site.constants;
        back_through(&net.weights[block.clone()], &mut slope[block], &self.hidden, last, first);
        add_scaled(&mut slope[site.constants..][..last.len()], last, T::ONE);
        add_scaled(&mut slope[site.first_constants..][..first.len()], first, T::ONE);

        let window = net.form.window();
        of_inputs.clear();
        of_inputs.resize(window, T::ZERO);
        for (k, x) in self.inputs.iter().enumerate() {
            let row = site.first + k * site.width[0]..site.first + (k + 1) * site.width[0];
            if let Some(slope_of_input) = of_inputs.get_mut(k) {
                *slope_of_input = dot(&net.weights[row.clone()], first);
            }
            add_scaled(&mut slope[row], first, *x);
        }
        let images = net.form.images();
        let is_seen = [net.form.target, net.form.scene];
        for (number, (_, back)) in
            is_seen.iter().zip(&mut self.back).filter(|(is_seen, _)| **is_seen).enumerate()
        {
            let filters = &mut slope[number * FILTERS..(number + 1) * FILTERS];
            back.add_window(choice.at, |cell| of_inputs[cell * images + number], filters);
        }
        loss
    }
}

/// The summed loss of a trace's choices, nats.
pub fn trace_loss<T: Real>(net: &Filtered<T>, trace: &Trace, share: f64) -> f64 {
    Work::default().loss(net, trace, share, None).0
}

/// The summed loss of a trace's choices, and its derivative by each weight, in the order of the file's `weights`.
pub fn trace_loss_and_slope<T: Real>(net: &Filtered<T>, trace: &Trace, share: f64) -> (f64, Vec<T>) {
    let mut slope = vec![T::ZERO; net.weights.len()];
    (Work::default().loss(net, trace, share, Some(&mut slope)).0, slope)
}

#[cfg(test)]
mod tests {
    //! Sizes equal those of the dissertation, and derivatives by weights agree with differences.
    use super::*;
    use crate::filtered::FilteredForm;
    use crate::heads::Head;
    use niwaki_math::Stream;
    use niwaki_math::streams::RngCore;

    const REAL: Head = Head::Normal { components: 4 };
    const FLIP: Head = Head::Finite { values: 2 };
    const LEAF: Head = Head::Finite { values: 3 };

    /// The network of the vines, with sites startAngle, angle, leaf, leafAngle, flower, terminate, branch1, branch2.
    fn vines(target: bool, scene: bool, features: usize) -> Filtered<f32> {
        let heads = vec![REAL, REAL, LEAF, REAL, FLIP, FLIP, FLIP, FLIP];
        let sees = vec![(0..features as u32).collect(); heads.len()];
        Filtered::start(FilteredForm { target, scene, features, sees, heads }, 1)
    }

    #[test]
    fn sizes_are_those_of_the_dissertation() {
        let full = vines(true, true, 4);
        let sizes = [0, 2, 4].map(|site| full.size_of(site));
        assert_eq!((sizes, full.size()), ([3394, 3043, 2965], 25_173));
        assert_eq!(vines(false, false, 4).size_of(0), 182);
        // The network of the circuit, which has no target.
        assert_eq!(vines(false, true, 4).size(), 7507);
        assert_eq!(vines(false, false, 0).size_of(0), 12);
    }

    /// A small network with outputs of all kinds, and a trace that reaches all of its weights.
    fn example() -> (Filtered<f64>, Trace) {
        let heads = vec![Head::Normal { components: 2 }, FLIP, LEAF, Head::Count { components: 2 }];
        let sees = vec![vec![0, 1], vec![1], vec![], vec![0]];
        let mut net: Filtered<f64> =
            Filtered::start(FilteredForm { target: true, scene: true, features: 2, sees, heads }, 5);
        net.features = vec![(0.3, 0.8), (-1.0, 1.5)];
        let mut stream = Stream::new(4, 0, 0, 0);
        for site in net.layout.sites.clone() {
            for row in net.weights[site.second..site.constants].chunks_exact_mut(site.width[1]) {
                row[..site.outputs].iter_mut().for_each(|w| *w = 0.3 * stream.normal());
            }
            for row in net.weights[site.first..site.first_constants].chunks_exact_mut(site.width[0]) {
                row[..site.hidden].iter_mut().for_each(|w| *w = 0.2 * stream.normal());
            }
        }
        let size = [19, 17];
        let mut image = || -> Vec<u64> { (0..size[1]).map(|_| stream.next_u64()).collect() };
        let (target, images) = (image().into(), vec![image(), image()]);
        let choices = (0..24).map(|k| {
            let lesson = match k % 4 {
                0 => Lesson::Normal { z: stream.normal(), log_prior: -1.2, limits: (-2.0, 6.0) },
                1 => Lesson::Finite { value: k / 4 % 2, log_priors: [-0.4, -1.1].into() },
                2 => Lesson::Finite { value: k / 4 % 3, log_priors: [-1.0, -0.9, -1.5].into() },
                _ => Lesson::Count { between: (-0.3, stream.normal().abs()), log_prior: -1.0 },
            };
            Choice {
                site: k % 4,
                image: k / 12,
                at: [1.2 * stream.uniform() - 0.1, 1.2 * stream.uniform() - 0.1],
                features: vec![(0, stream.normal() as f32), (1, stream.normal() as f32)],
                unit: if k % 4 == 0 { (0.4, 0.7) } else { (0.0, 1.0) },
                lesson,
            }
        });
        let choices = choices.collect();
        (net, Trace { size, target, images, choices })
    }

    #[test]
    fn derivatives_by_weights_agree_with_differences() {
        let (mut net, trace) = example();
        let (_, slope) = trace_loss_and_slope(&net, &trace, 0.1);
        let mut reached = 0;
        for (k, exact) in slope.iter().enumerate().filter(|(_, exact)| **exact != 0.0) {
            let at = net.weights[k];
            let mut moved = |step: f64| {
                net.weights[k] = at + step;
                trace_loss(&net, &trace, 0.1)
            };
            let h = 1e-3;
            let numeric = (8.0 * (moved(h) - moved(-h)) - (moved(2.0 * h) - moved(-2.0 * h))) / (12.0 * h);
            moved(0.0);
            reached += 1;
            assert!((numeric - exact).abs() < 1e-6 * exact.abs().max(1e-2), "{k}: {numeric} {exact}");
        }
        assert_eq!(reached, net.size());
    }
}
