//! A log density as a graph: its value, its gradient, and the guards within which both are valid.

use crate::graph::{Graph, Id};
use crate::operation::{Op, apply};
use crate::reverse;

/// A comparison of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Comparison {
    /// `a < b`.
    Less,
    /// `a <= b`.
    LessOrEqual,
    /// `a == b`.
    Equal,
    /// `a != b`.
    NotEqual,
}

impl Comparison {
    /// Whether the comparison holds. For a NaN only [`Comparison::NotEqual`] holds.
    #[inline]
    pub fn holds(self, a: f64, b: f64) -> bool {
        match self {
            Comparison::Less => a < b,
            Comparison::LessOrEqual => a <= b,
            Comparison::Equal => a == b,
            Comparison::NotEqual => a != b,
        }
    }
}

/// A comparison on which the run branched: if it does not hold, the run takes another path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Guard {
    /// The comparison.
    pub comparison: Comparison,
    /// The left number.
    pub a: Id,
    /// The right number.
    pub b: Id,
}

/// A log density over unconstrained coordinates with its gradient.
#[derive(Clone)]
pub struct Density {
    graph: Graph,
    value: Id,
    gradient: Vec<Id>,
    guards: Vec<Guard>,
}

impl Density {
    /// Differentiates `value`; guards that always hold are omitted.
    pub fn new(graph: Graph, value: Id, guards: &[Guard]) -> Density {
        let moves = vec![true; graph.inputs()];
        Density::along(graph, value, guards, &moves)
    }

    /// Differentiates `value` by the coordinates that move; the other derivatives are zeros.
    pub fn along(mut graph: Graph, value: Id, guards: &[Guard], moves: &[bool]) -> Density {
        let mut gradient = reverse::gradient(&mut graph, value);
        let zero = graph.constant(0.0);
        gradient.iter_mut().zip(moves).filter(|(_, moves)| !**moves).for_each(|(slope, _)| *slope = zero);
        let mut open: Vec<Guard> = Vec::new();
        for guard in guards {
            if !is_sure(&graph, guard) {
                open.push(*guard);
            }
        }
        Density { graph, value, gradient, guards: open }
    }

    /// The operations.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// The number of coordinates.
    pub fn dim(&self) -> usize {
        self.gradient.len()
    }

    /// The node of the log density.
    pub fn value(&self) -> Id {
        self.value
    }

    /// The nodes of the derivatives, one for each coordinate.
    pub fn gradient(&self) -> &[Id] {
        &self.gradient
    }

    /// The guards.
    pub fn guards(&self) -> &[Guard] {
        &self.guards
    }

    /// The number of operations of a value with its gradient, and of a gradient alone.
    pub fn operations(&self) -> (usize, usize) {
        let guards = || self.guards.iter().flat_map(|g| [g.a, g.b]).chain(self.gradient.iter().copied());
        let count = |ids: Vec<Id>| ids.iter().filter(|id| self.graph.node(**id).op.arity() > 0).count();
        (count(self.graph.needed(guards().chain([self.value]))), count(self.graph.needed(guards())))
    }

    /// The value, with the gradient in `g`, by plain interpretation: the reference for the tape and the machine code.
    ///
    /// Outside the guards all numbers are NaN.
    ///
    /// # Panics
    /// If `x` or `g` does not have one number for each coordinate.
    pub fn interpret(&self, x: &[f64], g: &mut [f64]) -> f64 {
        let values = self.values(x);
        if self
            .guards
            .iter()
            .all(|guard| guard.comparison.holds(values[guard.a.index()], values[guard.b.index()]))
        {
            for (g, id) in g.iter_mut().zip(&self.gradient) {
                *g = values[id.index()];
            }
            values[self.value.index()]
        } else {
            g.fill(f64::NAN);
            f64::NAN
        }
    }

    /// The first guard that does not hold at `x`.
    pub fn broken(&self, x: &[f64]) -> Option<Guard> {
        let values = self.values(x);
        let holds = |g: &&Guard| !g.comparison.holds(values[g.a.index()], values[g.b.index()]);
        self.guards.iter().find(holds).copied()
    }

    fn values(&self, x: &[f64]) -> Vec<f64> {
        assert_eq!(x.len(), self.dim(), "one number for each coordinate");
        let mut values: Vec<f64> = Vec::with_capacity(self.graph.len());
        for (_, node) in self.graph.nodes() {
            let value = match (node.constant(), node.input()) {
                (Some(c), _) => c,
                (_, Some(k)) => x[k],
                _ => {
                    let mut args = [0.0; 3];
                    for (slot, arg) in args.iter_mut().zip(node.args()) {
                        *slot = values[arg.index()];
                    }
                    apply(node.op, args[0], args[1], args[2])
                }
            };
            values.push(value);
        }
        values
    }
}

/// Whether a guard holds for all coordinates.
fn is_sure(graph: &Graph, guard: &Guard) -> bool {
    let (a, b) = (graph.range(guard.a), graph.range(guard.b));
    let numbers = graph.constant_of(guard.a).zip(graph.constant_of(guard.b));
    if let Some((x, y)) = numbers {
        return guard.comparison.holds(x, y);
    }
    match guard.comparison {
        Comparison::Less => {
            a.hi < b.lo || a.hi <= b.lo && (a.hi == 0.0 && b.nonzero || b.lo == 0.0 && a.nonzero)
        }
        Comparison::LessOrEqual => a.hi <= b.lo || guard.a == guard.b,
        Comparison::Equal => guard.a == guard.b && graph.node(guard.a).op != Op::Constant,
        Comparison::NotEqual => {
            let zero = |id| graph.constant_of(id) == Some(0.0);
            a.hi < b.lo || b.hi < a.lo || zero(guard.a) && b.nonzero || zero(guard.b) && a.nonzero
        }
    }
}
