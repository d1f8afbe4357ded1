//! Leapfrog steps as a loop of machine code, for a gradient of few coordinates that needs no call.
//!
//! A step of such a gradient takes less time than the transfer of its numbers through memory, from the integrator to
//! the gradient and back. Here position, momentum and slope stay in registers from one step to the next. Operations and
//! order equal those of the integrator that calls one gradient after another.

use super::code::Code;
use super::layout::Layout;
use super::write::{Writer, guards_hold};
use crate::graph::small;
use niwaki_native::CompileResult;
use niwaki_native::codegen::ir::condcodes::{FloatCC, IntCC};
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{BlockArg, InstBuilder, Value};
use niwaki_native::module::{FuncId, Module};

/// Most coordinates whose position, momentum and slope fit into registers.
const COORDINATES: usize = 4;

/// `(x, g, scratch, p, variance, [kick, step], n)`: makes up to `n >= 1` steps, and returns their number.
pub(super) type Entry =
    unsafe extern "C" fn(*mut f64, *mut f64, *mut f64, *mut f64, *const f64, *const [f64; 2], u64) -> u64;

impl Writer<'_> {
    /// The loop, if the gradient is small enough.
    pub(super) fn write_roll(&mut self) -> CompileResult<Option<FuncId>> {
        let (density, layout) = (self.density, self.layout);
        let program = &layout.slope;
        if density.dim() > COORDINATES || !program.batches.is_empty() || program.segments.len() > 1 {
            return Ok(None);
        }
        let pointer = self.module.target_config().pointer_type();
        let mut parameters = [pointer; 7];
        parameters[6] = I64;
        let id = self.function(&parameters, Some(I64), |code, parameters| write(code, parameters, layout))?;
        Ok(Some(id))
    }
}

fn write(code: &mut Code<'_, '_>, parameters: &[Value], layout: &Layout) {
    let &[x, g, _, p, variance, sizes, n] = parameters else { unreachable!("seven parameters") };
    let dim = code.density.dim();
    let read = |code: &mut Code<'_, '_>, at: Value| -> Vec<Value> {
        (0..small(dim)).map(|k| code.load(at, k)).collect()
    };
    let (kick, step) = (code.load(sizes, 0), code.load(sizes, 1));
    let scales: Vec<Value> = read(code, variance).into_iter().map(|s| code.b.ins().fmul(step, s)).collect();
    let zero = code.b.ins().iconst(I64, 0);
    let (body, next, stop, exit) =
        (code.b.create_block(), code.b.create_block(), code.b.create_block(), code.b.create_block());
    let count = code.b.append_block_param(body, I64);
    let this_kick = code.b.append_block_param(body, F64);
    let all = |code: &mut Code<'_, '_>, block| -> Vec<Value> {
        (0..3 * dim).map(|_| code.b.append_block_param(block, F64)).collect()
    };
    let before = all(code, body);
    let steps = code.b.append_block_param(exit, I64);
    let last = all(code, exit);

    let mut args = vec![zero, kick];
    for at in [x, p, g] {
        args.extend(read(code, at));
    }
    jump_with(code, body, &args);

    code.b.switch_to_block(body);
    let (mut here, mut momentum) = (Vec::new(), Vec::new());
    for k in 0..dim {
        let pushed = code.b.ins().fmul(this_kick, before[2 * dim + k]);
        momentum.push(code.b.ins().fadd(before[dim + k], pushed));
        let moved = code.b.ins().fmul(scales[k], momentum[k]);
        here.push(code.b.ins().fadd(before[k], moved));
    }
    code.inputs.clone_from(&here);
    for id in layout.slope.segments.iter().flat_map(|(_, ids)| ids) {
        code.compute(*id);
    }
    let slopes: Vec<Value> = code.density.gradient().iter().map(|id| code.read(*id)).collect();
    // A sum of zeros is zero only if every term was finite.
    let nought = code.b.ins().f64const(0.0);
    let mut sum = nought;
    for slope in &slopes {
        let flat = code.b.ins().fmul(*slope, nought);
        sum = code.b.ins().fadd(sum, flat);
    }
    if let Some(holds) = guards_hold(code, code.density.guards()) {
        let inside = code.b.create_block();
        code.b.ins().brif(holds, inside, &[], stop, &[]);
        code.b.switch_to_block(inside);
    }
    let finite = code.b.ins().fcmp(FloatCC::Equal, sum, nought);
    code.b.ins().brif(finite, next, &[], stop, &[]);

    code.b.switch_to_block(next);
    let done = code.b.ins().iadd_imm_u(count, 1);
    let more = code.b.ins().icmp(IntCC::UnsignedLessThan, done, n);
    let now: Vec<Value> = [here, momentum, slopes].concat();
    let (again, out) =
        (arguments(&[&[done, step], &now[..]].concat()), arguments(&[&[done], &now[..]].concat()));
    code.b.ins().brif(more, body, &again, exit, &out);

    code.b.switch_to_block(stop);
    jump_with(code, exit, &[&[count], &before[..]].concat());

    code.b.switch_to_block(exit);
    for (at, numbers) in [x, p, g].into_iter().zip(last.chunks(dim)) {
        for (k, number) in numbers.iter().enumerate() {
            code.store(*number, at, small(k));
        }
    }
    code.b.ins().return_(&[steps]);
}

fn arguments(values: &[Value]) -> Vec<BlockArg> {
    values.iter().map(|value| BlockArg::Value(*value)).collect()
}

fn jump_with(code: &mut Code<'_, '_>, to: niwaki_native::codegen::ir::Block, values: &[Value]) {
    code.b.ins().jump(to, &arguments(values));
}
