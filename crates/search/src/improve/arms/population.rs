//! A population from the start.

use super::{Arm, Form, Sizes, Step};
use niwaki_particles::Settings;

pub(crate) const POPULATION: Arm = Arm {
    step: Step("population"),
    suits: |_, _| true,
    most_reals: usize::MAX,
    form: Form::Population(settings),
};

fn settings(sizes: &Sizes) -> Settings {
    let proposal = sizes.drawn_by.clone();
    Settings { particles: sizes.particles, power: sizes.power, proposal, ..Settings::default() }
}
