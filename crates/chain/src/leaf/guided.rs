//! Guides as proposals of chains: a guide draws a single choice from its view of the run.
//!
//! A new run contains only earlier choices and parts. The run of a chain is complete, so the view of a guide needs a
//! definition. For a choice `c` of an activation `A` a guide sees:
//!
//! - the variables in scope at `c`, the parameters of its prior, and the last part on the call path of `c`;
//! - the scene without the parts at and below `A`, but with the parts that `A` itself emitted before `c`. Later iterations of a
//!   loop count as below an earlier iteration, as in a recursion.
//!
//! With `S` for that scene, the densities of the move and of its reverse are
//!
//! ```text
//! forward = q(x' | scope, S(run))        backward = q(x | scope, S(proposed run))
//! ```
//!
//! Variables in scope are older than `c`, so a change of `c` does not change them or the prior. The two scenes differ only by parts
//! outside of `A` that depend on the result of `A`. Usually there are no such parts: then the outputs of the network serve both
//! directions, and the parts of `A` are removed once. New choices, and choices that the guide does not draw, come from their
//! priors.
//!
//! A forbidden scene is invisible to guides, because its sketches depend on the order in which it was built.

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
    /// The visible scene, if the guide uses the scene.
    scene: Option<Scene>,
    /// The last part on the choice's call path.
    part: Option<Aabb>,
    /// The site in the guide, the prior and the previous value, if the guide drew.
    drew: Option<(usize, Dist, Draw)>,
}

impl Guided {
    /// Create a proposal from a guide.
    pub fn new(guide: Arc<BoundGuide>) -> Guided {
        Guided { guide, sight: Sight::default(), scene: None, part: None, drew: None }
    }
}

impl Clone for Guided {
    fn clone(&self) -> Guided {
        Guided::new(self.guide.clone())
    }
}

/// The scene without the parts that a choice leads to.
struct Scene {
    sketches: Sketches,
    /// The numbers of the omitted primitives, ascending.
    omitted: Vec<u32>,
}

impl std::fmt::Debug for Scene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Scene without {:?}", self.omitted)
    }
}

/// The primitives with these numbers.
fn numbered<'a>(trace: &'a Trace, numbers: &'a [u32]) -> impl Iterator<Item = &'a Primitive> + Clone {
    numbers.iter().filter_map(|number| trace.primitive(*number))
}

impl Scene {
    /// The visible scene of a run for a choice.
    fn of(state: &State, program: &Program, choice: usize) -> Scene {
        let mut scene =
            Scene { sketches: state.sketches.fork(), omitted: state.trace.emits_below(program, choice) };
        if !scene.omitted.is_empty() {
            let kept = scene.sketches.exchange(numbered(&state.trace, &scene.omitted), std::iter::empty());
            debug_assert!(kept, "the sketches and the trace hold the same scene");
        }
        scene
    }

    /// Apply the open transaction; return whether the scene changes.
    fn follow(&mut self, trace: &Trace, program: &Program, choice: usize) -> bool {
        let outside = |numbers: &[u32], inside: &[u32]| -> Vec<u32> {
            numbers.iter().copied().filter(|number| inside.binary_search(number).is_err()).collect()
        };
        let (removed, added) = trace.exchanged();
        let removed = outside(removed, &self.omitted);
        let added =
            if added.is_empty() { vec![] } else { outside(added, &trace.emits_below(program, choice)) };
        if removed.is_empty() && added.is_empty() {
            return false;
        }
        let kept = self.sketches.exchange(numbered(trace, &removed), numbered(trace, &added));
        debug_assert!(kept, "the sketches and the trace hold the same scene");
        true
    }

    /// The sketches; `None` for a forbidden scene.
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
