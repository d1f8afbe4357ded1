//! Proposals for the choices of new runs: users' functions and guides, as a chooser.

use crate::foresight::Foresight;
use crate::guide::bound::{BoundGuide, Sight};
use crate::look_ahead::Forecast;
use crate::user::User;
use niwaki_math::{Dist, StreamKey};
use niwaki_run::chooser::{Chooser, Chosen, Context};
use niwaki_run::glob::{last, matches};
use niwaki_run::select::Selection;
use niwaki_run::select::{labels, no_choice};
use niwaki_vm::code::Program;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use niwaki_vm::value::{Value, log_density, repr};
use std::sync::Arc;

/// Chooser that draws from a proposal; another chooser has the choices that the proposal does not cover.
pub struct ByProposal<'a, C> {
    /// The proposal.
    pub proposal: &'a Proposal,
    /// The stream of its random bits.
    pub stream: StreamKey,
    /// The views of the guides since the last barrier of the run.
    pub sight: &'a mut Sight,
    /// The chooser of all remaining choices.
    pub fallback: C,
}

impl<C: Chooser> Chooser for ByProposal<'_, C> {
    fn looks(&self) -> bool {
        self.proposal.looks()
    }

    fn choose(&mut self, at: &At<'_, f64>, dist: &Dist, seen: Context<'_>) -> Result<Option<Chosen>, Fault> {
        match self.proposal.draw(at, dist, seen, self.sight, self.stream)? {
            None => self.fallback.choose(at, dist, seen),
            Some(chosen) if self.proposal.is_unweighed => {
                Ok(Some(Chosen { log_drawn: chosen.log_prior, ..chosen }))
            }
            chosen => Ok(chosen),
        }
    }
}

/// Score a known value as if a proposal, or otherwise the prior, had drawn it.
///
/// # Errors
/// The errors of [`Proposal::log_drawn`].
pub fn as_if_drawn(
    proposal: Option<&Proposal>,
    at: &At<'_, f64>,
    dist: &Dist,
    value: &Value,
    seen: Context<'_>,
    sight: &mut Sight,
) -> Result<Chosen, Fault> {
    let mut chosen = Chosen::given(value.clone(), dist)?;
    let proposal = proposal.filter(|_| chosen.log_prior > f64::NEG_INFINITY);
    let drawn = match proposal {
        None => None,
        Some(proposal) => proposal.log_drawn(at, dist, value, seen, sight)?,
    };
    chosen.log_drawn = drawn.unwrap_or(chosen.log_prior);
    Ok(chosen)
}

/// The source of a proposal.
#[derive(Clone, Debug)]
enum Drawer {
    User(Arc<User>),
    Guide(Arc<BoundGuide>),
}

/// Proposals for the choices of new runs. The first proposal whose patterns match the address of a choice draws it.
#[derive(Clone, Debug, Default)]
pub struct Proposal {
    parts: Vec<(Selection, Drawer)>,
    /// Whether weights leave its densities out, as in a search for the best.
    is_unweighed: bool,
}

impl Proposal {
    /// Add a user's function for the choices of a selection by patterns.
    ///
    /// # Errors
    /// A function that needs the previous value, which a new run does not have.
    pub fn add_user(&mut self, selection: Selection, user: Arc<User>) -> Result<(), Fault> {
        if user.needs_old() {
            let name = user.name();
            let message =
                format!("the proposal `{name}` asks for `old`, the value before, which a new run has not");
            return Err(Fault::new("bad-proposal", message)
                .with_help("name variables of the model instead, or nothing; `old` is for `mh`"));
        }
        self.parts.push((selection, Drawer::User(user)));
        Ok(())
    }

    /// Add a guide for the choices of a selection by patterns.
    pub fn add_guide(&mut self, selection: Selection, guide: Arc<BoundGuide>) {
        self.parts.push((selection, Drawer::Guide(guide)));
    }

    /// Return the same proposal with values that count as if the prior had drawn them. Runs are then no weighted sample of any law: it is
    /// for searches for the best.
    #[must_use]
    pub fn unweighed(&self) -> Proposal {
        Proposal { is_unweighed: true, ..self.clone() }
    }

    /// Check that each pattern can match a choice of the program.
    ///
    /// # Errors
    /// A pattern that cannot; the message names the nearest choices.
    pub fn check(&self, program: &Program) -> Result<(), Fault> {
        let labels = labels(program);
        let patterns = self.parts.iter().flat_map(|(selection, _)| selection.sites.iter().flatten());
        for pattern in patterns.filter(|pattern| !pattern.contains("**")) {
            if !labels.iter().any(|label| matches(last(pattern), label)) {
                return Err(no_choice(pattern, &labels));
            }
        }
        Ok(())
    }

    /// The first guide that has learned to look ahead.
    pub fn forecast(&self) -> Option<Arc<dyn Forecast>> {
        self.parts.iter().enumerate().find_map(|(owner, (_, drawer))| match drawer {
            Drawer::Guide(guide) if guide.looks_ahead() => {
                Some(Arc::new(Foresight { guide: guide.clone(), owner }) as Arc<dyn Forecast>)
            }
            _ => None,
        })
    }

    /// Whether a proposal uses the scene.
    pub fn looks(&self) -> bool {
        self.parts.iter().any(|(_, drawer)| matches!(drawer, Drawer::Guide(_)))
    }

    /// Whether a pattern uses more of an address than its last component; futures must then remember their origin.
    pub fn needs_origins(&self) -> bool {
        self.parts.iter().any(|(selection, _)| selection.sites.iter().flatten().any(|p| is_deep(p)))
    }

    /// Draw a value for a choice, with its densities; `None` where no proposal covers the choice.
    ///
    /// # Errors
    /// A fault of the proposal.
    pub fn draw(
        &self,
        at: &At<'_, f64>,
        dist: &Dist,
        seen: Context<'_>,
        sight: &mut Sight,
        stream: StreamKey,
    ) -> Result<Option<Chosen>, Fault> {
        match self.drawer(at, dist) {
            None => Ok(None),
            Some((number, Drawer::Guide(guide))) => {
                Ok(guide.draw(at, dist, seen, sight, number, &mut stream.at(seen.address)))
            }
            Some((_, Drawer::User(user))) => {
                let proposed = of_user(user, at, dist)?;
                let (draw, log_drawn) = proposed.sample_and_score(&mut stream.at(seen.address));
                Ok(Some(Chosen { log_drawn, ..Chosen::given(draw.into(), dist)? }))
            }
        }
    }

    /// The log density with which the proposal draws a value, nats; `None` where no proposal covers the choice.
    ///
    /// # Errors
    /// A fault of the proposal; a value that the proposal never draws.
    pub fn log_drawn(
        &self,
        at: &At<'_, f64>,
        dist: &Dist,
        value: &Value,
        seen: Context<'_>,
        sight: &mut Sight,
    ) -> Result<Option<f64>, Fault> {
        let proposed = match self.drawer(at, dist) {
            None => return Ok(None),
            Some((number, Drawer::Guide(guide))) => {
                return Ok(guide.log_drawn(at, dist, value, seen, sight, number));
            }
            Some((_, Drawer::User(user))) => of_user(user, at, dist)?,
        };
        let log = log_density(&proposed, value)?;
        if log == f64::NEG_INFINITY {
            let message =
                format!("the proposal of the choice `{}` never draws the value {}", at.path(), repr(value)?);
            return Err(Fault::new("proposal-support", message).with_help(WIDER));
        }
        Ok(Some(log))
    }

    /// The drawer of a choice, with its number; `None` where no proposal covers the choice, or where it has a single value.
    fn drawer(&self, at: &At<'_, f64>, dist: &Dist) -> Option<(usize, &Drawer)> {
        if matches!(dist, Dist::Delta(_)) {
            return None;
        }
        let number = self.parts.iter().position(|(selection, _)| takes(selection, at))?;
        Some((number, &self.parts[number].1))
    }
}

/// The distribution that a user's proposal gives for a choice.
fn of_user(user: &User, at: &At<'_, f64>, dist: &Dist) -> Result<Arc<Dist>, Fault> {
    let proposed = user.dist(at, None)?;
    let (name, site, family) = (user.name(), at.path(), dist.family());
    if !proposed.compares_with(dist) {
        let message = format!(
            "the proposal `{name}` draws from `{}` for the choice `{site}`, which draws from `{family}`: values of \
                 another kind",
            proposed.family()
        );
        return Err(Fault::new("proposal-kind", message)
            .with_help("propose values of the kind that the choice's own distribution draws"));
    }
    if let Some(missing) = proposed.lacks(dist) {
        let message = format!(
            "the proposal `{name}` of the choice `{site}` never draws {missing}, which its `{family}` does"
        );
        return Err(Fault::new("proposal-support", message).with_help(WIDER));
    }
    Ok(proposed)
}

/// The help for a proposal that leaves values out.
const WIDER: &str = "propose from a distribution that reaches all values of the choice's own";

/// Whether a pattern uses more of an address than its last component.
fn is_deep(pattern: &str) -> bool {
    pattern.contains('/') || pattern.contains("**")
}

/// Whether a selection by patterns takes the choice. The whole address is built only where a pattern needs it.
fn takes(selection: &Selection, at: &At<'_, f64>) -> bool {
    let mut path = None;
    selection.sites.iter().all(|patterns| {
        patterns.iter().any(|pattern| {
            if is_deep(pattern) {
                matches(pattern, path.get_or_insert_with(|| at.path()))
            } else {
                matches(pattern, &at.site.label)
            }
        })
    })
}
