//! The densities that chains of gradients are measured on, as targets of chains: see `crates/grad/tests/peers`.

#[path = "../../../grad/tests/peers/mod.rs"]
pub mod peers;

use niwaki_continuous::hamiltonian::{Cause, Potential, Stop};
use niwaki_grad::{Compiled, Density, Rolling};

/// A recorded density as a target.
pub struct Target(pub Compiled);

const OUTSIDE: Stop = Stop { cause: Cause::Guard, place: 0 };

impl Potential for Target {
    fn dim(&self) -> usize {
        self.0.density().dim()
    }
    fn value_and_gradient(&mut self, x: &[f64], g: &mut [f64]) -> Result<f64, Stop> {
        self.0.inside(x, g).ok_or(OUTSIDE)
    }
    fn gradient(&mut self, x: &[f64], g: &mut [f64]) -> Result<(), Stop> {
        if self.0.gradient(x, g) { Ok(()) } else { Err(OUTSIDE) }
    }
    fn roll(&mut self, at: Rolling<'_>, kick: f64, step: f64, steps: u32) -> u32 {
        self.0.roll(at, kick, step, steps)
    }
}

/// The number of blocks of a stack.
fn blocks(model: &str) -> usize {
    model.strip_prefix("stack").and_then(|n| n.parse().ok()).unwrap_or(6)
}

/// A point where the density of a model is not zero.
pub fn first_point(model: &str) -> Vec<f64> {
    match model {
        "ring" | "coloring" => peers::known().into_iter().find(|k| k.name == model).expect("a known point").x,
        _ => peers::stack_start(blocks(model)),
    }
}

/// A model's density: ring, coloring, stack, or stackN of N blocks.
pub fn density(model: &str) -> Density {
    let x = first_point(model);
    match model {
        "ring" => peers::recorded(&x, peers::ring),
        "coloring" => {
            let drawing = peers::drawing();
            peers::recorded(&x, |x| peers::coloring(&drawing, x, niwaki_grad::Var::below_or))
        }
        _ => peers::recorded(&x, |x| peers::stack(blocks(model), x)),
    }
}
