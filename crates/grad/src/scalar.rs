//! The number that records its operations.
//!
//! A [`Var`] holds its value at the recorded point and the node that computes it; a number that does not vary has no
//! node. Operations go to the sheet of the recording thread ([`with_sheet`]); comparisons become guards. A machine
//! or a density over `Var` instead of `f64` is recorded as it runs: the non-standard interpretation of dissertation
//! 7.2.1.

use crate::density::{Comparison, Density, Guard};
use crate::graph::{Graph, Id, Mix};
use crate::operation::Op;
use niwaki_math::Scalar;
use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::{HashMap, HashSet};
use std::hash::BuildHasherDefault;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The record of a run.
#[derive(Default)]
pub struct Sheet {
    /// The operations.
    pub graph: Graph,
    /// The comparisons on which the run branched, each stored once, in order.
    pub guards: Vec<Guard>,
    /// Whether a comparison met a NaN: the run branches on it, and no guard can express that branch.
    pub met_nan: bool,
    /// The numbers of objects by their addresses ([`Scalar::note`]), if the recording needs them.
    notes: Option<HashMap<usize, Vec<Var>>>,
    met: HashSet<Guard, BuildHasherDefault<Mix>>,
}

thread_local! {
    static SHEET: RefCell<Option<Sheet>> = const { RefCell::new(None) };
}

/// Records the operations of `f`. A nested recording has its own sheet.
pub fn with_sheet<R>(f: impl FnOnce() -> R) -> (R, Sheet) {
    on_sheet(Sheet::default(), f)
}

/// Records the operations of `f`, and the numbers that it notes: see [`Scalar::noted`].
pub fn with_notes<R>(f: impl FnOnce() -> R) -> (R, Sheet) {
    on_sheet(Sheet { notes: Some(HashMap::new()), ..Sheet::default() }, f)
}

fn on_sheet<R>(sheet: Sheet, f: impl FnOnce() -> R) -> (R, Sheet) {
    /// Puts the outer sheet back, also when `f` panics.
    struct Outer(Option<Sheet>);
    impl Drop for Outer {
        fn drop(&mut self) {
            let outer = self.0.take();
            SHEET.with_borrow_mut(|sheet| *sheet = outer);
        }
    }
    let outer = Outer(SHEET.replace(Some(sheet)));
    let result = f();
    let sheet = SHEET.take().unwrap_or_default();
    drop(outer);
    (result, sheet)
}

const FIXED: u32 = u32::MAX;

/// A real number that may vary with the coordinates of a recording.
#[derive(Clone, Copy, Debug)]
pub struct Var {
    value: f64,
    node: u32,
}

impl Var {
    /// The next coordinate, with this value at the recorded point. Outside a recording, a plain number.
    pub fn input(value: f64) -> Var {
        Var::on_graph(value, |sheet| sheet.graph.input())
    }

    /// The node that computes the number; a constant gets one.
    pub fn id(self, graph: &mut Graph) -> Id {
        if self.node == FIXED { graph.constant(self.value) } else { Id(self.node) }
    }

    /// The number, known to lie between two bounds, so that guards need not test it.
    #[must_use]
    pub fn within(self, lo: f64, hi: f64) -> Var {
        if self.node != FIXED {
            SHEET.with_borrow_mut(|sheet| {
                if let Some(sheet) = sheet {
                    sheet.graph.narrow(Id(self.node), lo, hi);
                }
            });
        }
        self
    }

    /// The number, with its value at the recorded point replaced by `value`, which equals it up to rounding.
    #[must_use]
    pub fn at(self, value: f64) -> Var {
        Var { value, ..self }
    }

    /// The derivatives of the number by the coordinates of the recording so far, at `x`; none for a number that does not vary.
    /// A call takes as long as the whole recording, so it is for messages.
    pub fn slopes(self, x: &[f64]) -> Vec<f64> {
        let mut slopes = vec![0.0; x.len()];
        SHEET.with_borrow(|sheet| {
            if let (Some(sheet), true) = (sheet, self.varies()) {
                Density::new(sheet.graph.clone(), Id(self.node), &[]).interpret(x, &mut slopes);
            }
        });
        slopes
    }

    /// The nearest whole number, with the slope zero.
    #[must_use]
    pub fn round(self) -> Var {
        self.unary(Op::Round, self.value.round_ties_even())
    }

    /// `yes` if the number is at most the bound, else `no`: a single operation, without a guard.
    #[must_use]
    pub fn below_or(self, bound: f64, yes: Var, no: Var) -> Var {
        let branch = if self.value <= bound { yes } else { no };
        if self.node == FIXED {
            return branch;
        }
        Var::on_graph(branch.value, |sheet| {
            let g = &mut sheet.graph;
            let (bound, yes, no) = (g.constant(bound), yes.id(g), no.id(g));
            let above = g.binary(Op::Less, bound, Id(self.node));
            g.select(above, no, yes)
        })
    }

    fn on_graph(value: f64, write: impl FnOnce(&mut Sheet) -> Id) -> Var {
        SHEET.with_borrow_mut(|sheet| match sheet {
            Some(sheet) => {
                let id = write(sheet);
                let node = if sheet.graph.constant_of(id).is_some() { FIXED } else { id.0 };
                // An operation may turn out constant (`x - x`); then its value is the graph's.
                let value = sheet.graph.constant_of(id).unwrap_or(value);
                Var { value, node }
            }
            None => Var { value, node: FIXED },
        })
    }

    #[inline]
    fn unary(self, op: Op, value: f64) -> Var {
        if self.node == FIXED {
            return Var { value, node: FIXED };
        }
        Var::on_graph(value, |sheet| sheet.graph.unary(op, Id(self.node)))
    }

    #[inline]
    fn binary(self, op: Op, other: Var, value: f64) -> Var {
        if self.node == FIXED && other.node == FIXED {
            return Var { value, node: FIXED };
        }
        Var::on_graph(value, |sheet| {
            let (a, b) = (self.id(&mut sheet.graph), other.id(&mut sheet.graph));
            sheet.graph.binary(op, a, b)
        })
    }

    /// Whether a comparison of the recording so far met a NaN.
    pub fn met_nan() -> bool {
        SHEET.with_borrow(|sheet| sheet.as_ref().is_some_and(|sheet| sheet.met_nan))
    }

    /// Notes that a comparison holds.
    fn guard(comparison: Comparison, a: Var, b: Var) {
        if a.node == FIXED && b.node == FIXED {
            return;
        }
        SHEET.with_borrow_mut(|sheet| {
            if let Some(sheet) = sheet {
                if a.value.is_nan() || b.value.is_nan() {
                    sheet.met_nan = true;
                    return;
                }
                let (a, b) = (a.id(&mut sheet.graph), b.id(&mut sheet.graph));
                let guard = Guard { comparison, a, b };
                if sheet.met.insert(guard) {
                    sheet.guards.push(guard);
                }
            }
        });
    }
}

impl PartialEq for Var {
    fn eq(&self, other: &Var) -> bool {
        let equal = self.value == other.value;
        Var::guard(if equal { Comparison::Equal } else { Comparison::NotEqual }, *self, *other);
        equal
    }
}

impl PartialOrd for Var {
    fn partial_cmp(&self, other: &Var) -> Option<Ordering> {
        let Some(order) = self.value.partial_cmp(&other.value) else {
            Var::guard(Comparison::NotEqual, *self, *other);
            return None;
        };
        match order {
            Ordering::Less => Var::guard(Comparison::Less, *self, *other),
            Ordering::Equal => Var::guard(Comparison::Equal, *self, *other),
            Ordering::Greater => Var::guard(Comparison::Less, *other, *self),
        }
        Some(order)
    }
    fn lt(&self, other: &Var) -> bool {
        let holds = self.value < other.value;
        if holds {
            Var::guard(Comparison::Less, *self, *other);
        } else {
            Var::guard(Comparison::LessOrEqual, *other, *self);
        }
        holds
    }
    fn le(&self, other: &Var) -> bool {
        let holds = self.value <= other.value;
        if holds {
            Var::guard(Comparison::LessOrEqual, *self, *other);
        } else {
            Var::guard(Comparison::Less, *other, *self);
        }
        holds
    }
    fn gt(&self, other: &Var) -> bool {
        other.lt(self)
    }
    fn ge(&self, other: &Var) -> bool {
        other.le(self)
    }
}

impl Add for Var {
    type Output = Var;
    fn add(self, other: Var) -> Var {
        self.binary(Op::Add, other, self.value + other.value)
    }
}
impl Sub for Var {
    type Output = Var;
    fn sub(self, other: Var) -> Var {
        self.binary(Op::Sub, other, self.value - other.value)
    }
}
impl Mul for Var {
    type Output = Var;
    fn mul(self, other: Var) -> Var {
        self.binary(Op::Mul, other, self.value * other.value)
    }
}
impl Div for Var {
    type Output = Var;
    fn div(self, other: Var) -> Var {
        self.binary(Op::Div, other, self.value / other.value)
    }
}
impl Neg for Var {
    type Output = Var;
    fn neg(self) -> Var {
        self.unary(Op::Neg, -self.value)
    }
}

macro_rules! unary {
    ($($name:ident $op:ident)*) => { $( fn $name(self) -> Var { self.unary(Op::$op, Scalar::$name(self.value)) } )* };
}
macro_rules! binary {
    ($($name:ident $op:ident)*) => { $(
        fn $name(self, other: Var) -> Var { self.binary(Op::$op, other, Scalar::$name(self.value, other.value)) }
    )* };
}

impl Scalar for Var {
    #[inline]
    fn from_f64(x: f64) -> Var {
        Var { value: x, node: FIXED }
    }
    #[inline]
    fn value(self) -> f64 {
        self.value
    }
    unary! {
        sqrt Sqrt exp Exp ln Log ln_1p Log1p exp_m1 Expm1 sin Sin cos Cos tan Tan asin Asin acos Acos atan Atan
        sinh Sinh cosh Cosh tanh Tanh abs Abs ln_gamma LnGamma erf Erf erfcx Erfcx ln_bessel_i0e LnBesselI0e
    }
    binary! { atan2 Atan2 powf Pow min Min max Max }
    fn powi(self, n: i32) -> Var {
        if self.node == FIXED {
            return Var::from_f64(self.value.powi(n));
        }
        Var::on_graph(self.value.powi(n), |sheet| sheet.graph.powi(Id(self.node), n))
    }
    fn floor(self) -> Var {
        if self.node == FIXED {
            Var::from_f64(self.value.floor())
        } else {
            (self - Var::from_f64(0.5)).round()
        }
    }
    fn above(self, bound: f64, over: impl FnOnce() -> Var, under: impl FnOnce() -> Var) -> Var {
        if self.node == FIXED {
            return if self.value > bound { over() } else { under() };
        }
        let (over, under) = (over(), under());
        let branch = if self.value > bound { over } else { under };
        Var::on_graph(branch.value, |sheet| {
            let g = &mut sheet.graph;
            let (bound, over, under) = (g.constant(bound), over.id(g), under.id(g));
            let test = g.binary(Op::Less, bound, Id(self.node));
            g.select(test, over, under)
        })
    }
    fn is_finite(self) -> bool {
        self.value.is_finite()
    }
    fn varies(self) -> bool {
        self.node != FIXED
    }
    fn note(address: usize, numbers: impl FnOnce() -> Vec<Var>) {
        let is_wanted = SHEET.with_borrow(|sheet| sheet.as_ref().is_some_and(|sheet| sheet.notes.is_some()));
        if is_wanted {
            let numbers = numbers();
            SHEET.with_borrow_mut(|sheet| {
                if let Some(notes) = sheet.as_mut().and_then(|sheet| sheet.notes.as_mut()) {
                    notes.insert(address, numbers);
                }
            });
        }
    }
    fn noted(address: usize) -> Vec<Var> {
        SHEET.with_borrow(|sheet| {
            let notes = sheet.as_ref().and_then(|sheet| sheet.notes.as_ref());
            notes.and_then(|notes| notes.get(&address)).cloned().unwrap_or_default()
        })
    }
}
