//! A population from the start.

use super::{Arm, Form, Improve, Step};
use niwaki_particles::Settings;

pub(crate) const POPULATION: Arm =
    Arm { step: Step("population"), suits: |_, _| true, form: Form::Population(settings), rarity: 1 };

fn settings(improve: &Improve) -> Settings {
    let proposal = improve.drawn_by.clone();
    Settings { particles: improve.particles, power: improve.power, proposal, ..Settings::default() }
}
