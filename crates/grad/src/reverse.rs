//! Reverse-mode differentiation: the gradient of a node, as more nodes of the same graph.
//!
//! Griewank & Walther, "Evaluating derivatives" (2008), chapter 3. If a function has no derivative (the corner of
//! `abs`, a tie of `min`), the gradient uses the slope of one side. The other branch of a select gets the adjoint zero
//! from another select, never from a product: zero times infinity is NaN.

use crate::graph::{Graph, Id, small};
use crate::operation::Op;
use std::f64::consts::FRAC_2_SQRT_PI;

/// The derivatives of `root` by each of the graph's inputs.
pub fn gradient(graph: &mut Graph, root: Id) -> Vec<Id> {
    let end = root.index() + 1;
    let first = Id(small(graph.len()));
    let depends = depends_on_inputs(graph, end);
    let mut adjoint: Vec<Option<Id>> = vec![None; end];
    adjoint[root.index()] = Some(graph.constant(1.0));
    let mut inputs = vec![None; graph.inputs()];
    for at in (0..end).rev() {
        let Some(out) = adjoint[at] else { continue };
        if !depends[at] {
            continue;
        }
        let id = Id(small(at));
        let node = *graph.node(id);
        if let Some(k) = node.input() {
            inputs[k] = Some(out);
            continue;
        }
        for k in 0..node.op.arity() {
            let arg = node.arg(k);
            if !depends[arg.index()] {
                continue;
            }
            let Some(part) = part(graph, id, k, out) else { continue };
            let slot = &mut adjoint[arg.index()];
            *slot = Some(match *slot {
                None => part,
                Some(sum) => add(graph, sum, part, first),
            });
        }
    }
    let zero = graph.constant(0.0);
    inputs.into_iter().map(|slope| slope.unwrap_or(zero)).collect()
}

fn depends_on_inputs(graph: &Graph, end: usize) -> Vec<bool> {
    let mut depends = vec![false; end];
    for (id, node) in graph.nodes().take(end) {
        depends[id.index()] = node.op == Op::Input || node.args().any(|arg| depends[arg.index()]);
    }
    depends
}

/// A product as its constant and one or two factors.
fn factors(graph: &Graph, id: Id) -> (f64, Id, Option<Id>) {
    let node = graph.node(id);
    if node.op == Op::Neg {
        let (c, a, b) = factors(graph, node.arg(0));
        return (-c, a, b);
    }
    if node.op != Op::Mul {
        return (1.0, id, None);
    }
    match graph.constant_of(node.arg(0)) {
        Some(c) => {
            let rest = graph.node(node.arg(1));
            if rest.op == Op::Mul { (c, rest.arg(0), Some(rest.arg(1))) } else { (c, node.arg(1), None) }
        }
        None => (1.0, node.arg(0), Some(node.arg(1))),
    }
}

/// The sum of two parts of an adjoint, `a + b`. If one is a multiple of a factor of the other, both become one product:
/// `c u v + d u = u (c v + d)`. Then `v`, which is often known long before `u`, waits for nothing. Only nodes of
/// the gradient, from `first` on, are split, since no other node needs them.
fn add(graph: &mut Graph, a: Id, b: Id, first: Id) -> Id {
    if a < first || b < first {
        return graph.add(a, b);
    }
    let (whole, part) = match (factors(graph, a), factors(graph, b)) {
        ((c, u, Some(v)), (d, w, None)) | ((d, w, None), (c, u, Some(v))) => ((c, u, v), (d, w)),
        _ => return graph.add(a, b),
    };
    let ((c, u, v), (d, w)) = (whole, part);
    let other = match w {
        w if w == u => v,
        w if w == v => u,
        _ => return graph.add(a, b),
    };
    let (c, d) = (graph.constant(c), graph.constant(d));
    let scaled = graph.mul(c, other);
    let sum = graph.add(scaled, d);
    graph.mul(w, sum)
}

/// The addend of argument `k` of a node to the argument's adjoint, where `out` is the node's adjoint; `None` for zero.
fn part(g: &mut Graph, id: Id, k: usize, out: Id) -> Option<Id> {
    let node = *g.node(id);
    let (a, b) = (node.arg(0), node.arg(1));
    let unity = |g: &mut Graph| g.constant(1.0);
    let square = |g: &mut Graph, x: Id| g.mul(x, x);
    Some(match (node.op, k) {
        (Op::Add, _) | (Op::Sub, 0) => out,
        (Op::Sub, _) | (Op::Neg, _) => g.neg(out),
        (Op::Mul, _) if a == b => {
            if k == 1 {
                return None;
            }
            let two = g.constant(2.0);
            let slope = g.mul(two, a);
            g.mul(out, slope)
        }
        (Op::Mul, 0) => g.mul(out, b),
        (Op::Mul, _) => g.mul(out, a),
        (Op::Div, 0) => g.div(out, b),
        (Op::Div, _) => {
            let share = g.div(out, b);
            let product = g.mul(share, id);
            g.neg(product)
        }
        (Op::Sqrt, _) => {
            let half = g.constant(0.5);
            let share = g.div(out, id);
            g.mul(half, share)
        }
        (Op::Abs, _) => {
            let zero = g.constant(0.0);
            let (below, minus) = (g.binary(Op::Less, a, zero), g.neg(out));
            g.select(below, minus, out)
        }
        (Op::Min, _) | (Op::Max, _) => {
            // In a tie the first argument counts, as in Python's `min` and `max`.
            let second = if node.op == Op::Min { g.binary(Op::Less, b, a) } else { g.binary(Op::Less, a, b) };
            let zero = g.constant(0.0);
            if k == 0 { g.select(second, zero, out) } else { g.select(second, out, zero) }
        }
        (Op::Less | Op::Round, _) | (Op::Select, 0) => return None,
        (Op::Select, _) => {
            let zero = g.constant(0.0);
            if k == 1 { g.select(a, out, zero) } else { g.select(a, zero, out) }
        }
        (Op::Exp, _) => g.mul(out, id),
        (Op::Log, _) => g.div(out, a),
        (Op::Log1p, _) => {
            let unity = unity(g);
            let below = g.add(unity, a);
            g.div(out, below)
        }
        (Op::Expm1, _) => {
            let unity = unity(g);
            let slope = g.add(unity, id);
            g.mul(out, slope)
        }
        (Op::Sin, _) => {
            let slope = g.unary(Op::Cos, a);
            g.mul(out, slope)
        }
        (Op::Cos, _) => {
            let sin = g.unary(Op::Sin, a);
            let product = g.mul(out, sin);
            g.neg(product)
        }
        (Op::Tan, _) => {
            let (unity, square) = (unity(g), square(g, id));
            let slope = g.add(unity, square);
            g.mul(out, slope)
        }
        (Op::Asin, _) | (Op::Acos, _) => {
            let (unity, square) = (unity(g), square(g, a));
            let rest = g.sub(unity, square);
            let root = g.unary(Op::Sqrt, rest);
            let share = g.div(out, root);
            if node.op == Op::Asin { share } else { g.neg(share) }
        }
        (Op::Atan, _) => {
            let (unity, square) = (unity(g), square(g, a));
            let below = g.add(unity, square);
            g.div(out, below)
        }
        (Op::Sinh, _) => {
            let slope = g.unary(Op::Cosh, a);
            g.mul(out, slope)
        }
        (Op::Cosh, _) => {
            let slope = g.unary(Op::Sinh, a);
            g.mul(out, slope)
        }
        (Op::Tanh, _) => {
            let (unity, square) = (unity(g), square(g, id));
            let slope = g.sub(unity, square);
            g.mul(out, slope)
        }
        (Op::LnGamma, _) => {
            let slope = g.unary(Op::Digamma, a);
            g.mul(out, slope)
        }
        (Op::Erf, _) => {
            let square = square(g, a);
            let minus = g.neg(square);
            let bell = g.unary(Op::Exp, minus);
            let c = g.constant(FRAC_2_SQRT_PI);
            let slope = g.mul(c, bell);
            g.mul(out, slope)
        }
        (Op::Erfcx, _) => {
            let two = g.constant(2.0);
            let c = g.constant(FRAC_2_SQRT_PI);
            let product = g.mul(a, id);
            let twice = g.mul(two, product);
            let slope = g.sub(twice, c);
            g.mul(out, slope)
        }
        (Op::LnBesselI0e, _) => {
            let ratio = g.unary(Op::BesselRatio, a);
            let (zero, plus, minus) = (g.constant(0.0), g.constant(1.0), g.constant(-1.0));
            let below = g.binary(Op::Less, a, zero);
            let sign = g.select(below, minus, plus);
            let slope = g.sub(ratio, sign);
            g.mul(out, slope)
        }
        (Op::Pow, 0) => {
            let slope = if g.range(a).is_positive() {
                let product = g.mul(b, id);
                g.div(product, a)
            } else {
                let unity = unity(g);
                let less = g.sub(b, unity);
                let power = g.pow(a, less);
                g.mul(b, power)
            };
            g.mul(out, slope)
        }
        (Op::Pow, _) => {
            let log = g.unary(Op::Log, a);
            let product = g.mul(id, log);
            let zero = g.constant(0.0);
            let above = g.binary(Op::Less, zero, a);
            let slope = g.select(above, product, zero);
            g.mul(out, slope)
        }
        (Op::Atan2, _) => {
            let (aa, bb) = (square(g, a), square(g, b));
            let below = g.add(aa, bb);
            let share = g.div(out, below);
            if k == 0 {
                g.mul(share, b)
            } else {
                let product = g.mul(share, a);
                g.neg(product)
            }
        }
        // These operations are only in gradients, which are not differentiated again.
        (Op::Digamma | Op::BesselRatio, _) => g.constant(f64::NAN),
        (Op::Constant | Op::Input, _) => return None,
    })
}
