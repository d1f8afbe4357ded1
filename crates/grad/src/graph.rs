//! The graph of operations, each stored once and simplified as it is added.
//!
//! Arguments come before the operations that use them, so the order of ids is an order of evaluation. Each node has
//! an interval that contains its values, which proves most guards.

use crate::operation::{Op, apply};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// A node of a [`Graph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id(pub(crate) u32);

impl Id {
    /// Position of the node in the order of evaluation.
    #[inline]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// An operation with its arguments: ids of nodes; the bits of a constant; the number of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Node {
    /// The operation.
    pub op: Op,
    args: [u32; 3],
}

impl Node {
    /// The arguments.
    #[inline]
    pub fn args(&self) -> impl Iterator<Item = Id> + '_ {
        self.args[..self.op.arity()].iter().map(|&arg| Id(arg))
    }

    /// Argument `k`.
    #[inline]
    pub fn arg(&self, k: usize) -> Id {
        Id(self.args[k])
    }

    /// The number of a constant.
    #[inline]
    pub fn constant(&self) -> Option<f64> {
        let [low, high, _] = self.args;
        (self.op == Op::Constant).then(|| f64::from_bits(u64::from(low) | u64::from(high) << 32))
    }

    /// The coordinate of an input.
    #[inline]
    pub fn input(&self) -> Option<usize> {
        (self.op == Op::Input).then_some(self.args[0] as usize)
    }
}

/// Known facts about a node's values: an interval, and whether zero is ruled out.
#[derive(Clone, Copy, Debug)]
pub struct Range {
    /// Lower bound of the values.
    pub lo: f64,
    /// Upper bound of the values.
    pub hi: f64,
    /// Whether no value is zero.
    pub nonzero: bool,
}

impl Range {
    const ALL: Range = Range { lo: f64::NEG_INFINITY, hi: f64::INFINITY, nonzero: false };

    fn new(lo: f64, hi: f64, nonzero: bool) -> Range {
        let lo = if lo.is_nan() { f64::NEG_INFINITY } else { lo };
        let hi = if hi.is_nan() { f64::INFINITY } else { hi };
        Range { lo, hi, nonzero: nonzero || lo > 0.0 || hi < 0.0 }
    }

    /// Whether all values are at least zero.
    pub fn is_not_negative(&self) -> bool {
        self.lo >= 0.0
    }

    /// Whether all values are above zero.
    pub fn is_positive(&self) -> bool {
        self.lo >= 0.0 && self.nonzero
    }
}

/// A hasher that multiplies words: the keys are small and come from this crate.
#[derive(Default)]
pub(crate) struct Mix(u64);

impl Hasher for Mix {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.write_u64(u64::from(*byte));
        }
    }
    fn write_u8(&mut self, x: u8) {
        self.write_u64(u64::from(x));
    }
    fn write_u32(&mut self, x: u32) {
        self.write_u64(u64::from(x));
    }
    fn write_u64(&mut self, x: u64) {
        self.0 = (self.0.rotate_left(23) ^ x).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        self.0 ^= self.0 >> 29;
    }
    fn write_usize(&mut self, x: usize) {
        self.write_u64(x as u64);
    }
    fn write_isize(&mut self, x: isize) {
        self.write_u64(x as u64);
    }
}

/// A count of operations, coordinates or places as 32 bits, the size in programs: 2^32 of them would take 160 GB.
#[inline]
pub(crate) fn small(n: usize) -> u32 {
    u32::try_from(n).expect("fewer than 2^32 operations")
}

/// Operations, each stored once.
#[derive(Clone, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    ranges: Vec<Range>,
    ids: HashMap<Node, u32, BuildHasherDefault<Mix>>,
    inputs: usize,
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Graph {
        Graph::default()
    }

    /// The number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are no nodes.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The number of inputs.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// A node.
    #[inline]
    pub fn node(&self, id: Id) -> &Node {
        &self.nodes[id.index()]
    }

    /// Every node, in an order of evaluation.
    pub fn nodes(&self) -> impl Iterator<Item = (Id, &Node)> {
        self.nodes.iter().enumerate().map(|(at, node)| (Id(small(at)), node))
    }

    /// Declares that a node's values are between two numbers.
    pub fn narrow(&mut self, id: Id, lo: f64, hi: f64) {
        let range = &mut self.ranges[id.index()];
        *range = Range::new(range.lo.max(lo), range.hi.min(hi), range.nonzero);
    }

    /// The range of a node's values.
    pub fn range(&self, id: Id) -> Range {
        self.ranges[id.index()]
    }

    /// The number of a constant node.
    #[inline]
    pub fn constant_of(&self, id: Id) -> Option<f64> {
        self.node(id).constant()
    }

    /// The nodes that the roots depend on, with the roots, in an order of evaluation.
    pub fn needed(&self, roots: impl Iterator<Item = Id>) -> Vec<Id> {
        let mut marked = vec![false; self.nodes.len()];
        roots.for_each(|id| marked[id.index()] = true);
        for at in (0..marked.len()).rev() {
            if marked[at] {
                self.nodes[at].args().for_each(|arg| marked[arg.index()] = true);
            }
        }
        (0..marked.len()).filter(|&at| marked[at]).map(|at| Id(small(at))).collect()
    }

    fn intern(&mut self, op: Op, args: [u32; 3]) -> Id {
        let node = Node { op, args };
        let next = small(self.nodes.len());
        let id = *self.ids.entry(node).or_insert(next);
        if id == next {
            let range = self.range_of(&node);
            self.nodes.push(node);
            self.ranges.push(range);
        }
        Id(id)
    }

    /// A constant.
    #[expect(clippy::cast_possible_truncation, reason = "the two halves of the bits")]
    pub fn constant(&mut self, x: f64) -> Id {
        let bits = x.to_bits();
        self.intern(Op::Constant, [bits as u32, (bits >> 32) as u32, 0])
    }

    /// The next input.
    pub fn input(&mut self) -> Id {
        self.inputs += 1;
        self.intern(Op::Input, [small(self.inputs) - 1, 0, 0])
    }

    /// An operation of one argument.
    pub fn unary(&mut self, op: Op, a: Id) -> Id {
        debug_assert_eq!(op.arity(), 1);
        if let Some(x) = self.constant_of(a) {
            return self.constant(apply(op, x, 0.0, 0.0));
        }
        let node = *self.node(a);
        match (op, node.op) {
            (Op::Neg, Op::Neg) => return node.arg(0),
            (Op::Neg, Op::Sub) => return self.sub(node.arg(1), node.arg(0)),
            (Op::Abs, Op::Neg) => return self.unary(Op::Abs, node.arg(0)),
            (Op::Abs, _) if self.range(a).is_not_negative() => return a,
            (Op::Log, Op::Exp) => return node.arg(0),
            (Op::Exp, Op::Log) if self.range(node.arg(0)).is_positive() => return node.arg(0),
            _ => {}
        }
        self.intern(op, [a.0, 0, 0])
    }

    /// An operation of two arguments.
    pub fn binary(&mut self, op: Op, a: Id, b: Id) -> Id {
        match op {
            Op::Add => self.add(a, b),
            Op::Sub => self.sub(a, b),
            Op::Mul => self.mul(a, b),
            Op::Div => self.div(a, b),
            Op::Pow => self.pow(a, b),
            _ => {
                debug_assert_eq!(op.arity(), 2);
                if let (Some(x), Some(y)) = (self.constant_of(a), self.constant_of(b)) {
                    return self.constant(apply(op, x, y, 0.0));
                }
                let (of_a, of_b) = (self.range(a), self.range(b));
                match op {
                    Op::Min | Op::Max if a == b => return a,
                    Op::Min if of_a.hi <= of_b.lo => return a,
                    Op::Min if of_b.hi < of_a.lo => return b,
                    Op::Max if of_a.lo >= of_b.hi => return a,
                    Op::Max if of_b.lo > of_a.hi => return b,
                    Op::Less if of_a.hi < of_b.lo => return self.constant(1.0),
                    Op::Less if of_a.lo >= of_b.hi => return self.constant(0.0),
                    _ => {}
                }
                self.intern(op, [a.0, b.0, 0])
            }
        }
    }

    /// `a + b`.
    pub fn add(&mut self, a: Id, b: Id) -> Id {
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => return self.constant(x + y),
            (Some(0.0), _) => return b,
            (_, Some(0.0)) => return a,
            _ => {}
        }
        let (na, nb) = (*self.node(a), *self.node(b));
        if nb.op == Op::Neg {
            return self.sub(a, nb.arg(0));
        }
        if na.op == Op::Neg {
            return self.sub(b, na.arg(0));
        }
        self.intern(Op::Add, [a.0.min(b.0), a.0.max(b.0), 0])
    }

    /// `a - b`.
    pub fn sub(&mut self, a: Id, b: Id) -> Id {
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => return self.constant(x - y),
            (Some(0.0), _) => return self.neg(b),
            (_, Some(0.0)) => return a,
            _ if a == b => return self.constant(0.0),
            _ => {}
        }
        let (na, nb) = (*self.node(a), *self.node(b));
        if nb.op == Op::Neg {
            return self.add(a, nb.arg(0));
        }
        if na.op == Op::Neg {
            let sum = self.add(na.arg(0), b);
            return self.neg(sum);
        }
        self.intern(Op::Sub, [a.0, b.0, 0])
    }

    /// `-a`.
    pub fn neg(&mut self, a: Id) -> Id {
        self.unary(Op::Neg, a)
    }

    /// The constant factor of a product, and the other factor.
    fn scaled(&self, id: Id) -> Option<(f64, Id)> {
        let node = self.node(id);
        match node.op {
            Op::Mul => self.constant_of(node.arg(0)).map(|c| (c, node.arg(1))),
            Op::Neg => Some((-1.0, node.arg(0))),
            _ => None,
        }
    }

    /// A [`Graph::scaled`] whose factor may be multiplied by others of its size. The square of an extreme factor would be zero or
    /// infinite, while the product itself is not.
    fn scaled_mildly(&self, id: Id) -> Option<(f64, Id)> {
        const MOST: f64 = 1e60;
        self.scaled(id).filter(|(c, _)| (1.0 / MOST..=MOST).contains(&c.abs()))
    }

    /// `a * b`. Zero times any number is zero, as derivatives need it.
    pub fn mul(&mut self, a: Id, b: Id) -> Id {
        let (ca, cb) = (self.constant_of(a), self.constant_of(b));
        match (ca, cb) {
            (Some(x), Some(y)) => return self.constant(x * y),
            (None, Some(_)) => return self.mul(b, a),
            (Some(0.0), None) => return a,
            (Some(1.0), None) => return b,
            (Some(-1.0), None) => return self.neg(b),
            (Some(x), None) => {
                // A constant times a scaled value is a value with a single scale.
                if let Some((y, rest)) = self.scaled(b)
                    && (x * y).is_normal()
                {
                    let c = self.constant(x * y);
                    return self.mul(c, rest);
                }
                return self.intern(Op::Mul, [a.0, b.0, 0]);
            }
            (None, None) => {}
        }
        // Constants move outwards: (c z) w = c (z w), so that (c z) z contains a square.
        if let Some((c, rest)) = self.scaled_mildly(a) {
            let (c, product) = (self.constant(c), self.mul(rest, b));
            return self.mul(c, product);
        }
        if let Some((c, rest)) = self.scaled_mildly(b) {
            let (c, product) = (self.constant(c), self.mul(a, rest));
            return self.mul(c, product);
        }
        if a == b {
            let node = *self.node(a);
            match node.op {
                // The square of a norm has a derivative at zero, while the norm has none.
                Op::Sqrt if self.range(node.arg(0)).is_not_negative() => return node.arg(0),
                Op::Div if self.node(node.arg(0)).op == Op::Sqrt => {
                    let (root, by) = (node.arg(0), node.arg(1));
                    let (square, below) = (self.mul(root, root), self.mul(by, by));
                    return self.div(square, below);
                }
                Op::Abs => return self.mul(node.arg(0), node.arg(0)),
                _ => {}
            }
        }
        self.intern(Op::Mul, [a.0.min(b.0), a.0.max(b.0), 0])
    }

    /// `a / b`. A constant divisor becomes a factor.
    pub fn div(&mut self, a: Id, b: Id) -> Id {
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => return self.constant(x / y),
            (Some(0.0), None) => return a,
            (None, Some(y)) if y != 0.0 && (1.0 / y).is_normal() => {
                let factor = self.constant(1.0 / y);
                return self.mul(factor, a);
            }
            _ => {}
        }
        if let Some((c, rest)) = self.scaled_mildly(a) {
            let (c, quotient) = (self.constant(c), self.div(rest, b));
            return self.mul(c, quotient);
        }
        if let Some((c, rest)) = self.scaled_mildly(b) {
            let (c, quotient) = (self.constant(1.0 / c), self.div(a, rest));
            return self.mul(c, quotient);
        }
        self.intern(Op::Div, [a.0, b.0, 0])
    }

    /// `a` to the power `b`.
    #[expect(clippy::cast_possible_truncation, reason = "a whole number of at most 64")]
    pub fn pow(&mut self, a: Id, b: Id) -> Id {
        if let Some(y) = self.constant_of(b) {
            if y == 0.5 {
                return self.unary(Op::Sqrt, a);
            }
            if y == y.trunc() && y.abs() <= 64.0 {
                return self.powi(a, y as i32);
            }
        }
        if let (Some(x), Some(y)) = (self.constant_of(a), self.constant_of(b)) {
            return self.constant(libm::pow(x, y));
        }
        self.intern(Op::Pow, [a.0, b.0, 0])
    }

    /// `a` to a whole power, by squaring.
    pub fn powi(&mut self, a: Id, n: i32) -> Id {
        let (mut result, mut square, mut rest) = (self.constant(1.0), a, n.unsigned_abs());
        while rest > 0 {
            if rest & 1 == 1 {
                result = self.mul(result, square);
            }
            rest >>= 1;
            if rest > 0 {
                square = self.mul(square, square);
            }
        }
        if n < 0 {
            let unity = self.constant(1.0);
            return self.div(unity, result);
        }
        result
    }

    /// `yes` if `test` is not zero, else `no`.
    pub fn select(&mut self, test: Id, yes: Id, no: Id) -> Id {
        match self.constant_of(test) {
            _ if yes == no => yes,
            Some(0.0) => no,
            Some(_) => yes,
            None => self.intern(Op::Select, [test.0, yes.0, no.0]),
        }
    }

    /// The interval of an operation's values.
    fn range_of(&self, node: &Node) -> Range {
        let r = |k: usize| self.ranges[node.args[k] as usize];
        let products = |a: Range, b: Range| {
            // Zero times an infinite end is zero here, since the end is never reached.
            let by = |x: f64, y: f64| if x == 0.0 || y == 0.0 { 0.0 } else { x * y };
            let all = [by(a.lo, b.lo), by(a.lo, b.hi), by(a.hi, b.lo), by(a.hi, b.hi)];
            (all.into_iter().fold(f64::INFINITY, f64::min), all.into_iter().fold(f64::NEG_INFINITY, f64::max))
        };
        match node.op {
            Op::Constant => match node.constant() {
                Some(x) if !x.is_nan() => Range::new(x, x, x != 0.0),
                _ => Range::ALL,
            },
            Op::Add => {
                let (a, b) = (r(0), r(1));
                let no_cancellation = a.lo >= 0.0 && b.lo >= 0.0 || a.hi <= 0.0 && b.hi <= 0.0;
                Range::new(a.lo + b.lo, a.hi + b.hi, no_cancellation && (a.nonzero || b.nonzero))
            }
            Op::Sub => {
                let (a, b) = (r(0), r(1));
                let no_cancellation = a.lo >= 0.0 && b.hi <= 0.0 || a.hi <= 0.0 && b.lo >= 0.0;
                Range::new(a.lo - b.hi, a.hi - b.lo, no_cancellation && (a.nonzero || b.nonzero))
            }
            Op::Mul => {
                let (a, b) = (r(0), r(1));
                let (lo, hi) = products(a, b);
                let lo = if node.args[0] == node.args[1] { lo.max(0.0) } else { lo };
                Range::new(lo, hi, a.nonzero && b.nonzero)
            }
            Op::Div => {
                let (a, b) = (r(0), r(1));
                if b.lo < 0.0 && b.hi > 0.0 || !b.nonzero {
                    return Range { nonzero: a.nonzero, ..Range::ALL };
                }
                let inverse = if b.lo >= 0.0 {
                    Range::new(1.0 / b.hi, if b.lo == 0.0 { f64::INFINITY } else { 1.0 / b.lo }, true)
                } else {
                    Range::new(if b.hi == 0.0 { f64::NEG_INFINITY } else { 1.0 / b.hi }, 1.0 / b.lo, true)
                };
                let (lo, hi) = products(a, inverse);
                Range::new(lo, hi, a.nonzero)
            }
            Op::Neg => Range::new(-r(0).hi, -r(0).lo, r(0).nonzero),
            Op::Sqrt => Range::new(r(0).lo.max(0.0).sqrt(), r(0).hi.max(0.0).sqrt(), r(0).nonzero),
            Op::Round => Range::new(r(0).lo.round_ties_even(), r(0).hi.round_ties_even(), false),
            Op::Abs => {
                let a = r(0);
                let lo = if a.lo > 0.0 { a.lo } else { (-a.hi).max(0.0) };
                Range::new(lo, a.hi.max(-a.lo), a.nonzero)
            }
            Op::Min => Range::new(r(0).lo.min(r(1).lo), r(0).hi.min(r(1).hi), r(0).nonzero && r(1).nonzero),
            Op::Max => Range::new(r(0).lo.max(r(1).lo), r(0).hi.max(r(1).hi), r(0).nonzero && r(1).nonzero),
            Op::Less => Range::new(0.0, 1.0, false),
            Op::Select => {
                Range::new(r(1).lo.min(r(2).lo), r(1).hi.max(r(2).hi), r(1).nonzero && r(2).nonzero)
            }
            Op::Exp => Range::new(r(0).lo.exp(), r(0).hi.exp(), true),
            Op::Log => Range::new(r(0).lo.max(0.0).ln(), r(0).hi.max(0.0).ln(), false),
            Op::Log1p => Range::new(r(0).lo.max(-1.0).ln_1p(), r(0).hi.max(-1.0).ln_1p(), r(0).nonzero),
            Op::Expm1 => Range::new(r(0).lo.exp_m1(), r(0).hi.exp_m1(), r(0).nonzero),
            Op::Sin | Op::Cos => Range::new(-1.0, 1.0, false),
            Op::Tanh => Range::new(r(0).lo.tanh(), r(0).hi.tanh(), r(0).nonzero),
            Op::Erf => Range::new(libm::erf(r(0).lo), libm::erf(r(0).hi), r(0).nonzero),
            Op::Atan => Range::new(r(0).lo.atan(), r(0).hi.atan(), r(0).nonzero),
            Op::Acos => Range::new(0.0, std::f64::consts::PI, false),
            Op::Cosh => Range::new(1.0, f64::INFINITY, true),
            Op::Erfcx => Range::new(0.0, f64::INFINITY, true),
            Op::BesselRatio => Range::new(-1.0, 1.0, r(0).nonzero),
            Op::Atan2 => Range::new(-std::f64::consts::PI, std::f64::consts::PI, false),
            Op::Pow => Range::new(0.0, f64::INFINITY, r(0).nonzero),
            Op::Input | Op::Tan | Op::Asin | Op::Sinh | Op::LnGamma | Op::Digamma | Op::LnBesselI0e => {
                Range::ALL
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_operations_are_one_node_and_constants_fold() {
        let mut g = Graph::new();
        let (x, y) = (g.input(), g.input());
        assert_eq!(g.add(x, y), g.add(y, x));
        let (two, three) = (g.constant(2.0), g.constant(3.0));
        let product = g.mul(two, three);
        assert_eq!(g.constant_of(product), Some(6.0));
        let scaled = g.mul(two, x);
        let again = g.mul(three, scaled);
        let six = g.mul(product, x);
        assert_eq!(again, six);
        let zero = g.sub(x, x);
        assert_eq!(g.constant_of(zero), Some(0.0));
    }

    #[test]
    fn extreme_factors_stay_with_their_values() {
        for c in [-997.0_f64, 997.0].map(f64::exp2) {
            let mut g = Graph::new();
            let (x, scale) = (g.input(), g.constant(c));
            let small = g.mul(scale, x);
            // If the factor moved out, it would be squared: zero, or infinite.
            let square = g.mul(small, small);
            let expected = g.intern(Op::Mul, [small.0, small.0, 0]);
            assert_eq!(square, expected);
            // The inverse scale and the factor become a single factor.
            let back = g.div(small, scale);
            assert_eq!(back, x);
        }
    }

    #[test]
    fn squares_of_norms_have_no_root() {
        let mut g = Graph::new();
        let (x, y, s) = (g.input(), g.input(), g.input());
        let (xx, yy) = (g.mul(x, x), g.mul(y, y));
        let sum = g.add(xx, yy);
        let norm = g.unary(Op::Sqrt, sum);
        assert_eq!(g.mul(norm, norm), sum);
        let half = g.constant(-0.5);
        let scaled = g.div(norm, s);
        let once = g.mul(half, scaled);
        let square = g.mul(once, scaled);
        assert!(g.node(g.node(square).arg(1)).op == Op::Div, "{:?}", g.node(square));
        let below = g.mul(s, s);
        let expected = g.div(sum, below);
        assert_eq!(g.node(square).arg(1), expected);
    }

    #[test]
    fn ranges_of_logistics_lie_between_zero_and_one() {
        let mut g = Graph::new();
        let x = g.input();
        let unity = g.constant(1.0);
        let minus = g.neg(x);
        let e = g.unary(Op::Exp, minus);
        let below = g.add(unity, e);
        let s = g.div(unity, below);
        let range = g.range(s);
        assert!(range.lo == 0.0 && range.hi == 1.0 && range.is_positive(), "{range:?}");
        let less = g.binary(Op::Less, s, minus);
        assert!(g.constant_of(less).is_none());
        let two = g.constant(2.0);
        let sure = g.binary(Op::Less, s, two);
        assert_eq!(g.constant_of(sure), Some(1.0));
    }
}
