//! Kernels as data, the form in which they are written down and sent: a name, its settings, and the kernels in it.
//!
//! ```text
//! {"name": "on", "settings": {"sites": [["z"]]}, "parts": [{"name": "drift", "settings": {"step": 0.5, "target": 0.44}}]}
//! ```

use crate::kernel::Kernel;
use crate::leaf::Proposer;
use crate::leaf::guided::Guided;
use niwaki_propose::guide::bound::BoundGuide;
use niwaki_propose::proposal::Proposal;
use niwaki_propose::user::User;
use niwaki_run::select::Selection;
use niwaki_run::setting::{COUNT, POSITIVE, Range, Ranges, check};
use niwaki_vm::fault::Fault;
use niwaki_vm::refusal::Expected;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::sync::Arc;

/// A part of a kernel that is not data.
#[derive(Clone, Debug)]
pub enum Attached {
    /// A user's proposal.
    Function(Arc<User>),
    /// A guide.
    Guide(Arc<BoundGuide>),
}

/// A kernel as data.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Form {
    name: String,
    #[serde(default)]
    settings: Map<String, Value>,
    #[serde(default)]
    parts: Vec<Form>,
    /// The number of the kernel's proposal or guide among the attached parts.
    #[serde(default)]
    function: Option<usize>,
}

/// A chain's kernel, with the powers of tempering and the proposals between two exchanges.
pub struct Tempered {
    /// The kernel.
    pub kernel: Kernel,
    /// Powers of the score, falling from 1.
    pub powers: Vec<f64>,
    /// Proposals between two exchanges of states.
    pub every: u64,
}

impl Form {
    /// Ranges of the settings of a kernel, by its name.
    fn ranges(name: &str) -> Ranges {
        match name {
            "mixture" => &[("weights", Range::List(&POSITIVE))],
            "repeat" => &[("times", COUNT)],
            "anneal" => &[("start", POSITIVE), ("end", POSITIVE), ("steps", COUNT)],
            "tempering" => &[("powers", Range::List(&POSITIVE)), ("every", COUNT)],
            name => Proposer::ranges(name),
        }
    }

    /// Checks the settings of this kernel alone, without its parts.
    ///
    /// # Errors
    /// The first setting that has a value it cannot have.
    pub fn check(&self) -> Result<(), Fault> {
        check(Form::ranges(&self.name), &self.settings)?;
        match self.settings.get("powers") {
            Some(Value::Array(powers)) if self.name == "tempering" => {
                let powers: Vec<f64> = powers.iter().filter_map(Value::as_f64).collect();
                let is_falling = powers.is_sorted_by(|high, low| high >= low) && powers[0] == 1.0;
                let refusal = || {
                    let value = Value::from(powers.clone()).to_string();
                    Fault::refused("powers", value, Expected::Rule("powers-falling"))
                };
                is_falling.then_some(()).ok_or_else(refusal)
            }
            _ => Ok(()),
        }
    }

    /// Whether the kernel, or one in it, has one of these names.
    pub fn has(&self, names: &[&str]) -> bool {
        names.contains(&self.name.as_str()) || self.parts.iter().any(|part| part.has(names))
    }

    /// The kernel, and the powers of `tempering` where that is outermost.
    ///
    /// # Errors
    /// As for [`Form::kernel`].
    pub fn tempered(&self, attached: &[Attached]) -> Result<Tempered, Fault> {
        if self.name != "tempering" {
            return Ok(Tempered { kernel: self.kernel(attached)?, powers: vec![1.0], every: 100 });
        }
        self.check()?;
        let mut unread = self.unread();
        let (powers, every) = (unread.take("powers")?, unread.take("every")?);
        let kernel = unread.part(attached)?;
        unread.end(Tempered { kernel, powers, every })
    }

    /// The kernel; `attached` are users' proposals and guides, by number.
    ///
    /// # Errors
    /// An unknown name or setting, or nothing attached where it is needed.
    pub fn kernel(&self, attached: &[Attached]) -> Result<Kernel, Fault> {
        self.check()?;
        let mut unread = self.unread();
        let kernel = match self.name.as_str() {
            "proposal" => {
                let Some(Attached::Function(function)) = self.attached(attached) else {
                    return Err(unread.wrong("has no function here"));
                };
                Kernel::Leaf(Proposer::Proposal(function.clone()))
            }
            "guided" => {
                let Some(Attached::Guide(guide)) = self.attached(attached) else {
                    return Err(unread.wrong("has no guide here"));
                };
                Kernel::guided(guide.clone())
            }
            "cycle" => Kernel::Cycle(unread.parts(attached)?),
            "mixture" => {
                let (weights, parts) = (unread.take::<Vec<f64>>("weights")?, unread.parts(attached)?);
                if weights.len() != parts.len() {
                    return Err(unread.wrong("needs a weight for each part"));
                }
                Kernel::Mixture(weights.into_iter().zip(parts).collect())
            }
            "repeat" => Kernel::Repeat(unread.take("times")?, Box::new(unread.part(attached)?)),
            "on" => {
                let selection = Selection {
                    sites: unread.take("sites")?,
                    depth: unread.take("depth")?,
                    weights: unread.take("weights")?,
                    calls: unread.take("calls")?,
                };
                Kernel::On(selection, Box::new(unread.part(attached)?))
            }
            "anneal" => Kernel::Anneal {
                start: unread.take("start")?,
                end: unread.take("end")?,
                steps: unread.take("steps")?,
                kernel: Box::new(unread.part(attached)?),
            },
            "tempering" => return Err(unread.wrong("can only be outermost")),
            name => {
                let settings = Value::Object(std::mem::take(&mut unread.left));
                let leaf = Kernel::leaf(name, settings);
                let leaf = leaf.map_err(|reason| unread.wrong(&format!("cannot be read: {reason}")))?;
                match (self.function, self.attached(attached)) {
                    (None, _) => leaf,
                    (Some(_), Some(Attached::Guide(guide))) if name == "regrow" => {
                        leaf.drawn_by(Arc::new(Kernel::guided(guide.clone()).proposal()?))
                    }
                    (Some(_), _) => return Err(unread.wrong("has no guide here")),
                }
            }
        };
        unread.end(kernel)
    }

    fn attached<'a>(&self, attached: &'a [Attached]) -> Option<&'a Attached> {
        self.function.and_then(|number| attached.get(number))
    }

    fn unread(&self) -> Unread<'_> {
        Unread { form: self, left: self.settings.clone() }
    }
}

impl Kernel {
    /// The proposals of a kernel that consists of `proposal` and `guided`, of `on` around them, and of `cycle` around those: for
    /// runs that begin.
    ///
    /// # Errors
    /// Any other kernel; a function that needs the value before, which a new run does not have.
    pub fn proposal(&self) -> Result<Proposal, Fault> {
        let mut proposal = Proposal::default();
        self.add_to(&mut proposal, &Selection::default())?;
        Ok(proposal)
    }

    fn add_to(&self, proposal: &mut Proposal, selection: &Selection) -> Result<(), Fault> {
        match self {
            Kernel::Leaf(Proposer::Proposal(user)) => proposal.add_user(selection.clone(), user.clone()),
            Kernel::Leaf(Proposer::Guided(guide)) => {
                proposal.add_guide(selection.clone(), guide.guide.clone());
                Ok(())
            }
            Kernel::On(patterns, inner) if patterns.is_by_pattern() => inner.add_to(proposal, &selection.and(patterns)),
            Kernel::Cycle(parts) => parts.iter().try_for_each(|part| part.add_to(proposal, selection)),
            _ => Err(Fault::new("bad-proposal", "a run that begins cannot be proposed by this kernel")
                .with_help(
                    "use `guided(guide)`, `proposal(function)`, `on(pattern, ...)` around them, or a `cycle` of those",
                )),
        }
    }

    /// The leaf of a guide.
    pub fn guided(guide: Arc<BoundGuide>) -> Kernel {
        Kernel::Leaf(Proposer::Guided(Box::new(Guided::new(guide))))
    }

    /// Regrowth whose values a proposal draws; any other kernel is as before.
    pub fn drawn_by(mut self, proposal: Arc<Proposal>) -> Kernel {
        if let Kernel::Leaf(Proposer::Regrow(regrow)) = &mut self {
            regrow.draw_by(proposal);
        }
        self
    }

    /// A leaf by its name and settings.
    ///
    /// # Errors
    /// An unknown name; a setting that is missing, unknown or has a value that it cannot have.
    pub fn leaf(name: &str, settings: Value) -> Result<Kernel, serde_json::Error> {
        Proposer::deserialize(Value::Object(Map::from_iter([(name.into(), settings)]))).map(Kernel::Leaf)
    }
}

/// The settings of a form that have not been read.
struct Unread<'a> {
    form: &'a Form,
    left: Map<String, Value>,
}

impl Unread<'_> {
    fn wrong(&self, problem: &str) -> Fault {
        Fault::new("bad-kernel", format!("the kernel `{}` {problem}", self.form.name))
            .with_help("see `niwaki.kernels`")
    }

    fn take<T: DeserializeOwned>(&mut self, name: &str) -> Result<T, Fault> {
        let value = self.left.remove(name).ok_or_else(|| self.wrong(&format!("needs `{name}`")))?;
        T::deserialize(value).map_err(|error| self.wrong(&format!("cannot have this `{name}`: {error}")))
    }

    fn parts(&self, attached: &[Attached]) -> Result<Vec<Kernel>, Fault> {
        self.form.parts.iter().map(|part| part.kernel(attached)).collect()
    }

    fn part(&self, attached: &[Attached]) -> Result<Kernel, Fault> {
        let [part] = &self.form.parts[..] else { return Err(self.wrong("has one part")) };
        part.kernel(attached)
    }

    fn end<T>(self, kernel: T) -> Result<T, Fault> {
        match self.left.keys().next() {
            None => Ok(kernel),
            Some(name) => Err(self.wrong(&format!("has no setting `{name}`"))),
        }
    }
}
