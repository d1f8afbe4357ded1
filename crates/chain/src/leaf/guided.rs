//! A guide as the proposal of a chain: one choice, from what the guide sees around it.
//!
//! A run that begins sees only what was made before. A chain's run is complete, so what a guide sees of it has to be
//! said. For a choice `c` of an activation `A`:
//!
//! - of the program, what is in scope at `c`, the parameters of its prior, and the last part on the call path of `c`;
//! - of the scene, all but the parts at and below `A`, and what `A` itself emitted before `c`. Iterations of a loop after
//!   that of `A` are below it, as in the recursion that the loop could be.
//!
//! With `S` for that scene, the densities of going there and back are
//!
//! ```text
//! forward = q(x' | scope, S(run))        backward = q(x | scope, S(proposed run))
//! ```
//!
//! Nothing in scope was made after `c`, so a change of `c` leaves it and the prior as they are. The two scenes differ only
//! by parts outside of `A` that moved with what `A` returned. Mostly there are none: then the network's outputs serve both
//! directions, and the parts of `A` are taken out once. New choices come from their priors, and so do choices that the
//! guide does not draw.
//!
//! A scene that a sketch forbids shows nothing: which sketches have seen all of it depends on how it came about.

use crate::walk::proposal::{FromPrior, Move};
use crate::walk::state::State;
use crate::walk::{ChainMove, Proposing};
use niwaki_geom::sketch::product::Sketches;
use niwaki_geom::{Aabb, Primitive};
use niwaki_math::{Dist, Draw, Stream, grid};
use niwaki_propose::guide::bound::{BoundGuide, Sight};
use niwaki_run::Failure;
use niwaki_run::chooser::Context;
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::machine::kept::{Proposed, Trace};
use niwaki_vm::value::Value;
use std::sync::Arc;

/// A guide that proposes for chains.
#[derive(Debug)]
pub struct Guided {
    /// The guide.
    pub guide: Arc<BoundGuide>,
    sight: Sight,
    /// What it sees of the scene, where it looks.
    scene: Option<Scene>,
    /// The last part on the choice's call path.
    part: Option<Aabb>,
    /// The site in the guide, the prior and the value before, where the guide drew.
    drew: Option<(usize, Dist, Draw)>,
}

impl Guided {
    /// A guide that has not proposed.
    pub fn new(guide: Arc<BoundGuide>) -> Guided {
        Guided { guide, sight: Sight::default(), scene: None, part: None, drew: None }
    }
}

impl Clone for Guided {
    fn clone(&self) -> Guided {
        Guided::new(self.guide.clone())
    }
}

/// The scene without what a choice leads to.
struct Scene {
    sketches: Sketches,
    /// Numbers of the primitives that are left out, ascending.
    left_out: Vec<u32>,
}

impl std::fmt::Debug for Scene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Scene without {:?}", self.left_out)
    }
}

/// The primitives with these numbers.
fn numbered<'a>(trace: &'a Trace, numbers: &'a [u32]) -> impl Iterator<Item = &'a Primitive> + Clone {
    numbers.iter().filter_map(|number| trace.primitive(*number))
}

impl Scene {
    /// Of a run, for one of its choices.
    fn of(state: &State, program: &Program, choice: usize) -> Scene {
        let mut scene =
            Scene { sketches: state.sketches.fork(), left_out: state.trace.emits_below(program, choice) };
        if !scene.left_out.is_empty() {
            let kept = scene.sketches.exchange(numbered(&state.trace, &scene.left_out), std::iter::empty());
            debug_assert!(kept, "the sketches and the trace hold the same scene");
        }
        scene
    }

    /// Follows the open transaction; whether that changes it.
    fn follow(&mut self, trace: &Trace, program: &Program, choice: usize) -> bool {
        let outside = |numbers: &[u32], inside: &[u32]| -> Vec<u32> {
            numbers.iter().copied().filter(|number| inside.binary_search(number).is_err()).collect()
        };
        let (gone, come) = trace.exchanged();
        let gone = outside(gone, &self.left_out);
        let come = if come.is_empty() { vec![] } else { outside(come, &trace.emits_below(program, choice)) };
        if gone.is_empty() && come.is_empty() {
            return false;
        }
        let kept = self.sketches.exchange(numbered(trace, &gone), numbered(trace, &come));
        debug_assert!(kept, "the sketches and the trace hold the same scene");
        true
    }

    /// The sketches, of a scene that is allowed.
    fn seen(&self) -> Option<&Sketches> {
        Some(&self.sketches).filter(|sketches| sketches.forbidden_by().is_none())
    }
}

impl Move for Guided {
    fn look(&mut self, state: &State, program: &Program, choice: usize) {
        self.sight.forget();
        let (function, site) = state.trace.site_of(choice);
        let key = program.function(function).sites[site as usize].key;
        let looks = self.guide.looks() && self.guide.knows(key);
        self.scene = looks.then(|| Scene::of(state, program, choice));
        self.part = state.trace.part(program, choice);
    }

    fn propose(
        &mut self,
        at: &At<'_, f64>,
        site: usize,
        dist: &Dist,
        old: &Value,
        log_density: f64,
        rng: &mut Stream,
    ) -> Result<Proposed<f64>, Fault> {
        let sketches = self.scene.as_ref().and_then(Scene::seen);
        let seen = Context { address: at.address(), sketches, primitives: 0, part: self.part };
        let draw = old.draw().filter(|_| !matches!(dist, Dist::Delta(_)));
        let guided = draw.as_ref().and_then(|_| self.guide.look(at, dist, seen, &mut self.sight, 0));
        self.drew = None;
        let (Some(site), Some(old)) = (guided, draw) else {
            return FromPrior.propose(at, site, dist, old, log_density, rng);
        };
        let drawn = self.guide.answer(site, dist, &mut self.sight, rng);
        let backward = self.guide.log_of(site, dist, &old, &mut self.sight);
        self.drew = Some((site, dist.clone(), old));
        Ok(Proposed { value: drawn.value, forward: grid(drawn.log_drawn), backward: grid(backward) })
    }

    fn look_back(&mut self, state: &State, program: &Program, choice: usize) -> Option<f64> {
        let (site, dist, old) = self.drew.take()?;
        let scene = self.scene.as_mut()?;
        if !scene.follow(&state.trace, program, choice) {
            return None;
        }
        self.guide.look_again(scene.seen(), &mut self.sight);
        Some(grid(self.guide.log_of(site, &dist, &old, &mut self.sight)))
    }
}

impl ChainMove for Guided {
    fn apply(&mut self, proposing: Proposing<'_, '_>) -> Result<(), Failure> {
        let Proposing { chain, task, machine, table, beta } = proposing;
        let done = chain.single(task, machine, self, table, beta);
        // Copies of sketches share what neither changes, as long as both exist.
        self.scene = None;
        done
    }
}
