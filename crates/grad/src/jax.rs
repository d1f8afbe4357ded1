//! A recorded density as the text of a JAX function.
//!
//! The function holds on the recorded path. Outside the guards it is NaN, so that a sampler rejects the point instead
//! of using a wrong density. JAX differentiates the function.

use crate::density::{Comparison, Density};
use crate::graph::Id;
use crate::operation::Op;
use std::fmt::Write;

/// Functions that JAX lacks or names differently.
const HEAD: &str = r#"import jax
import jax.numpy as jnp
import jax.scipy.special as special

jax.config.update("jax_enable_x64", True)


def _erfcx(x):
    far = jnp.where(x > 25.0, x, 25.0)
    near = jnp.where(x > 25.0, 0.0, x)
    tail = (1.0 - 0.5 / far**2 + 0.75 / far**4) / (far * 1.7724538509055159)
    return jnp.where(x > 25.0, tail, jnp.exp(near**2) * special.erfc(near))

"#;

/// The text of a module with one function, `log_density(x)`, for `x` of shape `(dim,)`.
pub fn source(density: &Density) -> String {
    let graph = density.graph();
    let roots = density.guards().iter().flat_map(|g| [g.a, g.b]).chain([density.value()]);
    let name = |id: Id| match (graph.node(id).constant(), graph.node(id).input()) {
        (Some(x), _) => number(x),
        (_, Some(k)) => format!("x[{k}]"),
        _ => format!("v{}", id.0),
    };
    let mut out = format!(
        "\"\"\"A log density of {} unconstrained coordinates, recorded from a Niwaki model.\"\"\"\n\n{HEAD}\n\
         def log_density(x):\n    \"\"\"Nats; NaN where the model would take another path.\"\"\"\n",
        density.dim()
    );
    let mut line = |text: String| {
        // Writing to a string does not fail.
        let _ = writeln!(out, "    {text}");
    };
    for id in graph.needed(roots) {
        let node = graph.node(id);
        if node.op.arity() == 0 {
            continue;
        }
        let args: Vec<String> = node.args().map(name).collect();
        let [a, b, c] = std::array::from_fn(|k| args.get(k).map_or("", String::as_str));
        let text = match node.op {
            Op::Constant | Op::Input => continue,
            Op::Add => format!("{a} + {b}"),
            Op::Sub => format!("{a} - {b}"),
            Op::Mul => format!("{a} * {b}"),
            Op::Div => format!("{a} / {b}"),
            Op::Neg => format!("-{a}"),
            Op::Less => format!("{a} < {b}"),
            Op::Select => format!("jnp.where({a}, {b}, {c})"),
            Op::Min => format!("jnp.minimum({a}, {b})"),
            Op::Max => format!("jnp.maximum({a}, {b})"),
            Op::Pow => format!("jnp.power({a}, {b})"),
            Op::Atan2 => format!("jnp.arctan2({a}, {b})"),
            Op::LnBesselI0e => format!("jnp.log(special.i0e({a}))"),
            Op::BesselRatio => format!("special.i1e({a}) / special.i0e({a})"),
            Op::Sqrt => format!("jnp.sqrt({a})"),
            Op::Round => format!("jnp.round({a})"),
            Op::Abs => format!("jnp.abs({a})"),
            Op::Exp => format!("jnp.exp({a})"),
            Op::Log => format!("jnp.log({a})"),
            Op::Log1p => format!("jnp.log1p({a})"),
            Op::Expm1 => format!("jnp.expm1({a})"),
            Op::Sin => format!("jnp.sin({a})"),
            Op::Cos => format!("jnp.cos({a})"),
            Op::Tan => format!("jnp.tan({a})"),
            Op::Asin => format!("jnp.arcsin({a})"),
            Op::Acos => format!("jnp.arccos({a})"),
            Op::Atan => format!("jnp.arctan({a})"),
            Op::Sinh => format!("jnp.sinh({a})"),
            Op::Cosh => format!("jnp.cosh({a})"),
            Op::Tanh => format!("jnp.tanh({a})"),
            Op::LnGamma => format!("special.gammaln({a})"),
            Op::Digamma => format!("special.digamma({a})"),
            Op::Erf => format!("special.erf({a})"),
            Op::Erfcx => format!("_erfcx({a})"),
        };
        line(format!("v{} = {text}", id.0));
    }
    let value = name(density.value());
    if density.guards().is_empty() {
        line(format!("return jnp.asarray({value})"));
        return out;
    }
    line("inside = True".to_string());
    for guard in density.guards() {
        let sign = match guard.comparison {
            Comparison::Less => "<",
            Comparison::LessOrEqual => "<=",
            Comparison::Equal => "==",
            Comparison::NotEqual => "!=",
        };
        line(format!("inside &= {} {sign} {}", name(guard.a), name(guard.b)));
    }
    line(format!("return jnp.where(inside, {value}, jnp.nan)"));
    out
}

/// A number as Python reads it, with brackets around negative numbers.
fn number(x: f64) -> String {
    if x.is_nan() {
        "jnp.nan".into()
    } else if x.is_infinite() {
        if x > 0.0 { "jnp.inf".into() } else { "(-jnp.inf)".into() }
    } else if x < 0.0 {
        format!("({x:?})")
    } else {
        format!("{x:?}")
    }
}
