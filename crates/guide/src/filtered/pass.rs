//! A filtered network's way from inputs to outputs.

use super::form::{FilteredForm, Layout, Site};
use super::levels::{FILTERS, LEVELS, Levels};
use crate::heads::natural::{self, Natural};
use crate::net::{Real, add_rows, squash};
use niwaki_math::{Dist, Stream};

/// Largest distance of a feature from its middle, in half ranges.
const FARTHEST: f64 = 10.0;

/// A network.
#[derive(Clone, Debug, PartialEq)]
pub struct Filtered<T: Real = f32> {
    pub(super) form: FilteredForm,
    pub(super) layout: Layout,
    pub(super) weights: Vec<T>,
    /// Middle of each feature's range, and one over half the range; zero for a feature that never changed in training.
    pub(super) features: Vec<(T, T)>,
    /// Whether the network was never trained.
    pub(super) fresh: bool,
}

/// The images that a choice sees, and memory for an answer.
#[derive(Clone, Debug, Default)]
pub struct View<T: Real = f32> {
    /// The scene, if the network sees it.
    pub scene: Levels<T>,
    pub(super) inputs: Vec<T>,
    pub(super) hidden: Vec<T>,
    pub(super) outputs: Vec<T>,
    translated: Vec<f64>,
    answer: Vec<f32>,
}

impl<T: Real> Filtered<T> {
    /// A network before training, as in the dissertation's code: the numbers of each tensor, constants too, are
    /// Gaussian with one over their count as deviation.
    pub fn start(form: FilteredForm, seed: u64) -> Filtered<T> {
        let layout = form.layout();
        let mut weights = vec![T::ZERO; layout.len];
        let mut stream = Stream::new(seed, 0, 0, 0);
        let mut fill = |weights: &mut [T], count: usize| {
            weights.iter_mut().for_each(|w| *w = T::from_f64(stream.normal() / count as f64));
        };
        for filters in weights[..form.images() * FILTERS].chunks_exact_mut(FILTERS) {
            let (levels, outside) = filters.split_at_mut(FILTERS - LEVELS);
            for level in levels.chunks_exact_mut(FILTERS / LEVELS - 1) {
                let (filter, constant) = level.split_at_mut(FILTERS / LEVELS - 2);
                fill(filter, filter.len());
                fill(constant, 1);
            }
            fill(outside, LEVELS);
        }
        for site in &layout.sites {
            for row in weights[site.first..site.first_constants].chunks_exact_mut(site.width[0].max(1)) {
                fill(&mut row[..site.hidden], site.inputs * site.hidden);
            }
            fill(&mut weights[site.first_constants..][..site.hidden], site.hidden);
            for row in weights[site.second..site.constants].chunks_exact_mut(site.width[1]) {
                fill(&mut row[..site.outputs], site.hidden * site.outputs);
            }
            fill(&mut weights[site.constants..][..site.outputs], site.outputs);
        }
        let features = vec![(T::ZERO, T::ZERO); form.features];
        Filtered { form, layout, weights, features, fresh: true }
    }

    /// The form: inputs and outputs.
    pub fn form(&self) -> &FilteredForm {
        &self.form
    }

    /// The number of weights, without padding.
    pub fn size(&self) -> usize {
        self.form.images() * FILTERS + self.layout.sites.iter().map(Site::size).sum::<usize>()
    }

    /// The number of weights in the net of a site, without those of filters.
    pub fn size_of(&self, site: usize) -> usize {
        self.layout.sites[site].size()
    }

    /// The filters of the target, which come first, or of the scene.
    pub(super) fn filters(&self, scene: bool) -> &[T] {
        let number = usize::from(scene && self.form.target);
        &self.weights[number * FILTERS..(number + 1) * FILTERS]
    }

    /// Filters a target of these columns and rows: a bit for each filled pixel, row by row from the top, each row in
    /// words of its own.
    pub fn see_target(&self, size: [usize; 2], bits: &[u64], to: &mut Levels<T>) {
        if self.form.target {
            to.see(size, bits, self.filters(false));
        }
    }

    /// Filters a scene on the page of a target.
    pub fn see_scene(&self, size: [usize; 2], bits: &[u64], to: &mut Levels<T>) {
        if self.form.scene {
            to.see(size, bits, self.filters(true));
        }
    }

    /// A feature in its range, from -1 to 1.
    fn ranged(&self, feature: u32, value: T) -> T {
        let (middle, scale) = self.features[feature as usize];
        let bound = T::from_f64(FARTHEST);
        let x = (value - middle) * scale;
        if x.to_f64().is_nan() { T::ZERO } else { x.clamp(-bound, bound) }
    }

    /// The inputs of a site's net: windows of both images at a place, in shares of the page from its upper left corner;
    /// then the site's features, zero for a missing one.
    pub(super) fn inputs(
        &self,
        target: &Levels<T>,
        scene: &Levels<T>,
        at: [f64; 2],
        features: &[(u32, T)],
        site: usize,
        to: &mut Vec<T>,
    ) {
        let sees = &self.form.sees[site];
        let (window, images) = (self.form.window(), self.form.images());
        to.clear();
        to.resize(window + sees.len(), T::ZERO);
        let images_used = [(self.form.target, target), (self.form.scene, scene)];
        for (number, (_, levels)) in
            images_used.into_iter().filter(|(images_used, _)| *images_used).enumerate()
        {
            let filters = &self.weights[number * FILTERS..];
            levels.window(at, filters, |cell, x| to[cell * images + number] = x);
        }
        for (feature, value) in features {
            if let Some(place) = sees.iter().position(|known| known == feature) {
                to[window + place] = self.ranged(*feature, *value);
            }
        }
    }

    /// Hidden units and outputs of a site's net.
    pub(super) fn pass(&self, site: usize, inputs: &[T], hidden: &mut Vec<T>, outputs: &mut Vec<T>) {
        let (site, weights) = (self.layout.sites[site], &self.weights);
        hidden.clear();
        hidden.extend_from_slice(&weights[site.first_constants..][..site.width[0]]);
        add_rows(hidden, &weights[site.first..site.first_constants], inputs);
        squash(hidden);
        outputs.clear();
        outputs.extend_from_slice(&weights[site.constants..][..site.width[1]]);
        add_rows(outputs, &weights[site.second..site.constants], &hidden[..site.hidden]);
        outputs.truncate(site.outputs);
    }

    /// Outputs for a site's head at a choice with this prior. `view.scene` is the scene before the choice.
    ///
    /// # Panics
    ///
    /// If there is no such site or feature.
    #[expect(clippy::cast_possible_truncation, reason = "rounded to the precision of the network")]
    pub fn answer<'v>(
        &self,
        target: &Levels<T>,
        at: [f64; 2],
        features: &[(u32, T)],
        site: usize,
        dist: &Dist,
        view: &'v mut View<T>,
    ) -> &'v [f32] {
        self.inputs(target, &view.scene, at, features, site, &mut view.inputs);
        self.pass(site, &view.inputs, &mut view.hidden, &mut view.outputs);
        let mut logs = [0.0; 64];
        let natural = match self.form.heads[site].log_priors(dist, &mut logs) {
            Some(logs) => Natural::Values(logs),
            None => {
                let (mean, sd) = natural::unit(dist);
                Natural::Line { mean, sd }
            }
        };
        view.answer.clear();
        view.answer.extend(view.outputs.iter().map(|x| x.to_f64() as f32));
        natural::translate(&view.answer, natural, &mut view.translated);
        // If a categorical has fewer values than the head, the other values get an output of zero.
        view.translated.resize(self.form.heads[site].outputs(), 0.0);
        view.answer.clear();
        view.answer.extend(view.translated.iter().map(|x| *x as f32));
        &view.answer
    }
}
