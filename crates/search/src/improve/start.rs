//! The first run of a search: a population, and if all of its particles die, populations of other forms.
//!
//! Particles die if their present score leads them to a place from which every continuation breaks a constraint.
//! The remedy depends on the model, so each form is less greedy than those before it, or larger: weights that are tempered at
//! each resampling, a power that rises from zero, a power that is low throughout, futures in the order in which they
//! are created. Rounds of the search then use the declared power again.

use super::{Improve, population_seed};
use niwaki_particles::{Anneal, Progress, Result, Settings, smc};
use niwaki_run::failure::Attempt;
use niwaki_run::order::Order;
use niwaki_run::resampling::Resampling;
use niwaki_run::{Failure, Task};

/// A form of population.
struct Form {
    /// The name in reports.
    name: &'static str,
    /// Factor of the number of particles.
    times: usize,
    /// Factor of the declared power.
    power: f64,
    resampling: Resampling,
    anneal: Anneal,
    order: Order,
}

const USUAL: Form = Form {
    name: "as usual",
    times: 1,
    power: 1.0,
    resampling: Resampling::Systematic,
    anneal: Anneal::Constant,
    order: Order::Stochastic,
};

/// The forms, in the order in which they are tried.
const FORMS: [Form; 6] = [
    USUAL,
    Form { name: "tempered resampling", times: 2, resampling: Resampling::Tempered, ..USUAL },
    Form { name: "a power that rises", times: 2, anneal: Anneal::Adaptive(0.5), ..USUAL },
    Form { name: "a sixteenth of the power", times: 3, power: 1.0 / 16.0, ..USUAL },
    Form { name: "a hundredth of the power", times: 6, power: 0.01, ..USUAL },
    Form { name: "depth-first order", times: 6, power: 1.0 / 16.0, order: Order::DepthFirst, ..USUAL },
];

/// The first so many forms draw by the search's proposal. The prior draws the others, if the proposal leads to what is impossible.
const BY_PROPOSAL: usize = 1;

/// The number of the form by its name in reports; the first for an unknown name.
pub(super) fn number_of(form: &str) -> usize {
    FORMS.iter().position(|known| known.name == form).unwrap_or(0)
}

/// The name of a form in reports, as a static text.
pub(super) fn name_of(form: &str) -> &'static str {
    FORMS.iter().find(|known| known.name == form).map_or(USUAL.name, |known| known.name)
}

impl Improve {
    /// A surviving population, of the form with number `from` or a later one; `attempts` receives each population that was tried.
    /// `may_continue` decides before each further one.
    ///
    /// # Errors
    /// The failure of the first population, if all died.
    pub(super) fn start(
        &self,
        task: &Task,
        seed: u64,
        from: usize,
        attempts: &mut Vec<Attempt>,
        watch: &mut dyn FnMut(Progress) -> bool,
        may_continue: &dyn Fn() -> bool,
    ) -> std::result::Result<Result, Failure> {
        let mut first = None;
        for (number, form) in FORMS.iter().enumerate().skip(from) {
            let settings = Settings {
                particles: self.particles * form.times,
                power: self.power * form.power,
                resampling: form.resampling,
                anneal: form.anneal.clone(),
                order: form.order.clone(),
                seed: population_seed(seed, number as u64),
                proposal: self.drawn_by.clone().filter(|_| number < BY_PROPOSAL),
                ..Settings::default()
            };
            let attempt = |died_at| Attempt { form: form.name, particles: settings.particles, died_at };
            let failure = match smc(task, &settings, watch) {
                Ok(result) => {
                    attempts.push(attempt(None));
                    return Ok(result);
                }
                Err(failure) if failure.is_impossible() => failure,
                Err(failure) => return Err(failure),
            };
            let barrier = match &failure {
                Failure::Impossible { barrier, .. } => *barrier,
                _ => 0,
            };
            attempts.push(attempt(Some(barrier)));
            first.get_or_insert(failure);
            if !may_continue() {
                break;
            }
        }
        let mut first = first.unwrap_or_else(Failure::no_start);
        if let Failure::Impossible { attempts: tried, .. } = &mut first {
            tried.clone_from(attempts);
        }
        Err(first)
    }
}
