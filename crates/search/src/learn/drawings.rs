//! Training of guides of the dissertation's architecture: their traces, and a new network.

use super::lessons::{Example, Making, Taught, follow, of_another};
use niwaki_guide::filtered::{Choice, Trace};
use niwaki_guide::heads::natural;
use niwaki_guide::{Filtered, FilteredForm, FilteredTraining, Progress, Way, train_filtered_along};
use niwaki_propose::guide::bound::{BoundGuide, Sight};
use niwaki_propose::guide::form::{GuideForm, ImageForm};
use niwaki_propose::guide::images::OF_PLACE;
use niwaki_propose::guide::{Guide, Network, bad};
use niwaki_run::{Failure, Task};
use niwaki_vm::fault::Fault;
use rayon::prelude::*;
use std::sync::Arc;

/// Steps of a training without a number of steps, as in the dissertation.
const STEPS: u64 = 20_000;
/// Number of looks at the traces held out.
const LOOKS: u64 = 20;

/// A new network of the dissertation's architecture; writes its inputs into the form of its guide.
///
/// # Errors
/// A score that draws nothing on a page.
pub(super) fn network(form: &mut GuideForm, making: &Making, task: &Task) -> Result<Filtered, Fault> {
    let shown = task.sketches.iter().find(|sketch| sketch.image().is_some()).ok_or_else(|| {
        Fault::new("guide-score", "the dissertation's architecture looks at a page, and the score has none")
            .with_help(
                "score by `match_drawing` or `fill_drawing`, or train a guide of the usual architecture",
            )
    })?;
    form.image = Some(ImageForm { sketch: shown.name().to_string() });
    form.part = None;
    for site in &mut form.sites {
        site.parameters = (0, 0);
    }
    let of_variables = form.features() as u32;
    let local = making.reads.any();
    let place = of_variables..if local { of_variables + OF_PLACE } else { of_variables };
    let sees = |site: &niwaki_propose::guide::form::SiteForm| {
        let variable_inputs = site.variables.iter().flat_map(|v| {
            let variable = &form.variables[*v as usize];
            variable.first..variable.first + variable.kind.len() as u32
        });
        place.clone().chain(variable_inputs).collect()
    };
    let filtered_form = FilteredForm {
        target: making.looks.target(),
        scene: making.looks.scene(),
        features: place.end as usize,
        sees: form.sites.iter().map(sees).collect(),
        heads: form.sites.iter().map(|site| site.head).collect(),
    };
    Ok(Filtered::start(filtered_form, making.seed))
}

/// Traces as inputs of the network; in order, on all threads.
fn traces(examples: &[&Example], guide: &Arc<Guide>) -> Result<Vec<Trace>, Failure> {
    let trace_of = |example: &&Example| -> Result<Trace, Failure> {
        let bound = BoundGuide::new(guide.clone(), &example.task)?;
        let Some(images) = bound.images() else { return Err(bad("it sees no page".into()).into()) };
        let mut trace = Trace {
            size: images.page.size(),
            target: images.bits.clone(),
            images: Vec::new(),
            choices: Vec::new(),
        };
        let mut sight = Sight::default();
        follow(example, &mut |at, dist, context, value| {
            let Some(site) = bound.look(at, dist, context, &mut sight, 0) else { return Ok(()) };
            if let Some(lesson) = bound.lesson(site, dist, value) {
                if trace.images.last() != Some(&sight.bits) {
                    trace.images.push(sight.bits.clone());
                }
                trace.choices.push(Choice {
                    site,
                    image: trace.images.len() - 1,
                    at: sight.at,
                    features: sight.features.clone(),
                    unit: natural::unit(dist),
                    lesson,
                });
            }
            Ok(())
        })?;
        Ok(trace)
    };
    examples.par_iter().map(trace_of).collect()
}

/// Trains a network of the dissertation's architecture on traces.
///
/// # Errors
/// A trace that cannot be followed; a loss that is not a number in the first step.
pub(super) fn train(
    examples: &[Example],
    making: &Making,
    form: GuideForm,
    net: Filtered,
    watch: &mut dyn FnMut(Progress) -> bool,
    way: Way<'_>,
) -> Result<Taught, Failure> {
    let blank = Arc::new(Guide { form, net: Network::Filtered(net.clone()) });
    let (judging, learning): (Vec<&Example>, Vec<&Example>) =
        examples.iter().partition(|example| example.held_out);
    let (learned, held_out) = (traces(&learning, &blank)?, traces(&judging, &blank)?);
    let steps = making.steps.unwrap_or(STEPS);
    let with = FilteredTraining {
        rate: making.rate,
        decays: making.decays,
        batch: making.batch,
        averaging: making.averaging,
        steps,
        every: steps.div_ceil(LOOKS).max(1),
        share: making.share,
        seed: making.seed,
    };
    let trained = train_filtered_along(net, &learned, &held_out, &with, watch, way).map_err(of_another)?;
    let form = GuideForm { share: making.share, ..blank.form.clone() };
    let label = |site: usize| form.sites[site].label.clone();
    let diverged = trained.diverged.map(|(step, site)| (step, site.map(label)));
    let bytes = |trace: &Trace| {
        let words: usize = trace.images.iter().map(Vec::len).sum();
        8 * words
            + trace
                .choices
                .iter()
                .map(|choice| size_of::<Choice>() + 8 * choice.features.len())
                .sum::<usize>()
    };
    Ok(Taught {
        guide: Guide { form, net: Network::Filtered(trained.net) },
        rows: learned.iter().map(|trace| trace.choices.len()).sum(),
        bytes: learned.iter().chain(&held_out).map(bytes).sum(),
        history: trained.history,
        diverged,
    })
}
