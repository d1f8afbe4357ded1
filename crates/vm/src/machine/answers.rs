//! The machine's questions, and the trait of those who answer them.
//!
//! The machine runs a program up to its next question and knows neither random numbers nor algorithms. An
//! inference algorithm is the set of answers that it gives.

use super::address::join;
use super::registers::Registers;
use super::state::{NodeId, State};
use crate::builtins::placed::placement;
use crate::code::{Function, Mode, Program, Site, Visible};
use crate::fault::Fault;
use crate::value::{Record, Value};
use niwaki_geom::{Aabb, Placement, Shape};
use niwaki_math::{Dist, LastLogs, Scalar};

/// An answer: continue, or pause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer<T> {
    /// Continue with this value.
    Go(T),
    /// Stop the run. A resumed run repeats a choice; any other question counts as answered.
    Pause,
}

/// The kind of factor that a score comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// `observe`: the log density of a distribution at a value.
    Observe,
    /// `factor`: a number of nats.
    Factor,
    /// `condition`: zero or minus infinity.
    Condition,
    /// A held choice: the log density of its distribution at the held value.
    Held,
}

/// The place that a question comes from.
pub struct At<'a, S: Scalar> {
    /// The site.
    pub site: &'a Site,
    /// The function that contains the site.
    pub function: &'a Function<S>,
    pub(crate) node: NodeId,
    pub(crate) state: &'a State<S>,
    pub(crate) program: &'a Program<S>,
}

impl<S: Scalar> At<'_, S> {
    /// The address of the question: a hash of the path of sites.
    #[inline]
    pub fn address(&self) -> u128 {
        join(self.state.nodes[self.node.0 as usize].path, self.site.key)
    }

    /// The hash of the path of the activation.
    #[inline]
    pub fn activation(&self) -> u128 {
        self.state.nodes[self.node.0 as usize].path
    }

    /// The readable address. It visits all ancestors: use it for records and messages, not for every choice.
    ///
    /// Under a stochastic order a future does not know its ancestors; its path then starts at the future.
    pub fn path(&self) -> String {
        let mut path = self.state.path(self.program, self.node);
        if !path.is_empty() {
            path.push('/');
        }
        path + &self.site.label
    }

    /// The value of a variable in scope, by its name in the model's source, if the program was compiled to keep
    /// the variable ([`compile_with_scope`](crate::passes::compile_with_scope)).
    pub fn scope(&self, name: &str) -> Option<Value<S>> {
        self.visible().find(|(x, _, _)| *x == name).map(|(_, _, value)| value.clone())
    }

    /// The variables in scope that the program was compiled to keep, in the order in which they were last
    /// assigned: the name, whether its value is an angle ([`Visible::is_angle`]), and the value. In a kept run
    /// a list may hold [`Value::Cell`]s ([`At::element`]).
    #[inline]
    pub fn visible(&self) -> impl Iterator<Item = (&str, bool, &Value<S>)> {
        self.variables().filter(|(x, _)| !x.name.is_empty()).map(|(x, value)| (&*x.name, x.is_angle, value))
    }

    /// The value of an element of a list. In a kept run the list may hold cells; elsewhere the element is the
    /// value itself.
    #[inline]
    pub fn element<'v>(&'v self, element: &'v Value<S>) -> &'v Value<S> {
        match element {
            Value::Cell(cell) => &self.state.registers[cell.register as usize],
            other => other,
        }
    }

    /// The place that the program looks from. It is the value of the variable that was last assigned, among the
    /// variables in scope that hold a frame ([`Class::is_frame`](crate::value::Class::is_frame)).
    pub fn look(&self) -> Option<&Record<S>> {
        self.variables().rev().find_map(|(_, value)| match value {
            Value::Record(record) if record.class.is_frame() => Some(&**record),
            _ => None,
        })
    }

    /// The frame in which the function is placed, if it is. Its matrix is a rotation, or one after a reflection.
    pub fn frame(&self) -> Option<Placement> {
        // The other variable without a name is a record: the place that the program looks from.
        let unnamed = self.variables().filter(|(x, _)| x.name.is_empty());
        unnamed.map(|(_, value)| value).find_map(placement)
    }

    /// The box of the part that was emitted last on the call path: by the activation itself (with the
    /// iterations of its loops), or else by its caller before the call. A future has the part that its creator
    /// had then; a call that has returned leaves none. `None` if there is no part, and in a run that does not
    /// record parts ([`State::note_parts`]).
    #[inline]
    pub fn part(&self) -> Option<&Aabb> {
        self.state.part(self.node)
    }

    /// The variables that are kept for the site, with their values.
    #[inline]
    fn variables(&self) -> impl DoubleEndedIterator<Item = (&Visible, &Value<S>)> {
        let registers = self.registers();
        let (from, to) = self.site.visible;
        // Kept variables are never in scratch.
        let visible = self.function.scope[from as usize..to as usize].iter();
        visible.map(move |x| (x, registers.get(self.state, &[], x.at)))
    }

    /// The registers of the activation; those of scratch cannot be read.
    #[inline]
    pub(super) fn registers(&self) -> Registers<'_, S> {
        let node = &self.state.nodes[self.node.0 as usize];
        let outer = match self.function.mode {
            Mode::Iteration => self.state.nodes[node.parent.0 as usize].registers as usize,
            _ => 0,
        };
        Registers { f: self.function, base: node.registers as usize, outer, scratch: 0 }
    }
}

/// The answers to the machine's questions. By default, factors, primitives and queries do not stop a run.
pub trait Answers<S: Scalar> {
    /// Whether the answers record the choices of a run: then a run that makes choices without end takes memory.
    const LOGS: bool = false;

    /// Whether the answers need the distributions of observations ([`Answers::observes`]).
    const WATCHES: bool = false;

    /// Whether machine code may ask ([`Answers::drawn`], [`Answers::scored`]).
    const DRAWS: bool = false;

    /// The run meets an observation of this distribution, or a held choice. Called before its score.
    fn observes(&mut self, _: &At<'_, S>, _: &Dist<S>) {}

    /// The value of a random choice.
    ///
    /// # Errors
    /// A fault ends the run; it is reported with the model's call stack.
    fn choice(&mut self, at: &At<'_, S>, dist: &Dist<S>) -> Result<Answer<Value<S>>, Fault>;

    /// The value of a random choice whose address and distribution are all that the answer depends on: what
    /// [`Answers::choice`] would do. `None` if that has to be asked. The distribution draws single numbers.
    #[inline]
    fn drawn(&mut self, _: u128, _: &Dist<S>, _: &mut LastLogs<S>) -> Option<Value<S>> {
        None
    }

    /// A factor of the score, in nats.
    ///
    /// # Errors
    /// As for [`Answers::choice`].
    #[inline]
    fn score(&mut self, _: &At<'_, S>, _: Factor, _: S) -> Result<Answer<()>, Fault> {
        Ok(Answer::Go(()))
    }

    /// A `factor` of finitely many nats: what [`Answers::score`] would do.
    #[inline]
    fn scored(&mut self, _: S) -> Answer<()> {
        Answer::Go(())
    }

    /// A held choice has its value, which has this log density, in nats.
    ///
    /// # Errors
    /// As for [`Answers::choice`].
    #[inline]
    fn held(&mut self, at: &At<'_, S>, _: &Dist<S>, _: &Value<S>, log: S) -> Result<Answer<()>, Fault> {
        self.score(at, Factor::Held, log)
    }

    /// The run can no longer meet the held choice with this readable address, so it is impossible. If the run
    /// is to stop, the next answer says so. A kept run is reported as
    /// [`Change::Impossible`](super::kept::Change) at its end instead.
    fn unmet(&mut self, _: &str) {}

    /// A primitive for the scene.
    ///
    /// # Errors
    /// As for [`Answers::choice`].
    #[inline]
    fn emit(&mut self, _: &At<'_, S>, _: &[Shape]) -> Result<Answer<()>, Fault> {
        Ok(Answer::Go(()))
    }

    /// A write to the query table.
    ///
    /// # Errors
    /// As for [`Answers::choice`].
    #[inline]
    fn query(&mut self, _: &At<'_, S>, _: &Value<S>, _: &Value<S>) -> Result<(), Fault> {
        Ok(())
    }

    /// A call of a pure host function. `steps` are the run's steps so far; the function may add to them.
    ///
    /// # Errors
    /// As for [`Answers::choice`].
    fn host(&mut self, constant: u16, args: &[Value<S>], steps: &mut u64) -> Result<Value<S>, Fault>;
}
