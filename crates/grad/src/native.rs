//! Machine code of a density, by Cranelift.
//!
//! Straight-line code in functions of a few hundred operations: one block for all would take time that grows with the
//! square of its length to allocate registers for. Calls of `exp`, `log`, `pow` and the like are gathered level by
//! level: the operations that need no call yet, then every call whose arguments are ready, as one loop over many
//! numbers, then the operations that waited for them. A call for each would spill all registers each time.
//!
//! Numbers that cross from one function to another go through an array of scratch. There are two programs: a value
//! with its gradient, for the ends of a trajectory, and a gradient alone for its inside.
//!
//! Each operation is that of the tape, none fused and none re-ordered, so the numbers are the tape's to the bit.

#![allow(unsafe_code)] // Calls of the functions that were compiled here.

use crate::density::{Comparison, Density};
use crate::graph::Id;
use crate::kernels;
use crate::operation::Op;
use cranelift_codegen::ir::condcodes::FloatCC;
use cranelift_codegen::ir::types::{F64, I8, I64};
use cranelift_codegen::ir::{AbiParam, InstBuilder, MemFlagsData, Signature, UserFuncName, Value};
use cranelift_codegen::settings::{self, Configurable};
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{FuncId, Linkage, Module, default_libcall_names};
use std::sync::Arc;

/// Operations in one function of machine code.
const FUNCTION: usize = 600;

/// `(x, g, scratch)`.
type Entry = unsafe extern "C" fn(*const f64, *mut f64, *mut f64);

/// Machine code in memory, freed with its last user.
struct Memory(Option<JITModule>);

// SAFETY: the module is never touched again after compilation, except to be freed by its last owner; the code is only
// read.
unsafe impl Send for Memory {}
// SAFETY: as above.
unsafe impl Sync for Memory {}

impl Drop for Memory {
    fn drop(&mut self) {
        if let Some(module) = self.0.take() {
            // SAFETY: functions are called only by `Routine::run`, whose owner keeps this alive.
            unsafe { module.free_memory() };
        }
    }
}

#[derive(Clone, Copy)]
enum Step {
    Code(Entry),
    /// `n` numbers of each argument from `from` on, one argument after the other; results at `to`.
    Calls {
        op: Op,
        from: u32,
        to: u32,
        n: u32,
    },
}

/// One program: steps over an array of scratch.
struct Routine {
    steps: Vec<Step>,
    scratch: Vec<f64>,
    value: Option<u32>,
    /// Places that hold bits other than zero when guards hold.
    flags: Vec<u32>,
}

/// One program as machine code, with the memory that it works in.
#[derive(Clone)]
pub struct Part {
    routine: Arc<Routine>,
    scratch: Vec<f64>,
    dim: usize,
    _code: Arc<Memory>,
}

impl Part {
    /// Compiles the gradient of a density, with its value or without.
    ///
    /// # Errors
    /// A processor that Cranelift does not know, or memory that may not be executed: the tape serves then.
    pub fn compile(density: &Density, with_value: bool) -> Result<Part, String> {
        let mut flags = settings::builder();
        for (name, value) in [
            ("opt_level", "none"),
            ("enable_verifier", "false"),
            ("is_pic", "false"),
            ("use_colocated_libcalls", "false"),
        ] {
            flags.set(name, value).map_err(|e| e.to_string())?;
        }
        let isa = cranelift_native::builder()
            .map_err(str::to_string)?
            .finish(settings::Flags::new(flags))
            .map_err(|e| e.to_string())?;
        let module = JITModule::new(JITBuilder::with_isa(isa, default_libcall_names()));
        let values = vec![(0, Value::from_u32(0)); density.graph().len()];
        let context = FunctionBuilderContext::new();
        let mut writer = Writer { module, density, functions: 0, context, values };
        let layout = Layout::new(density, with_value);
        let plan = writer.write(&layout).map_err(|e| e.to_string())?;
        writer.module.finalize_definitions().map_err(|e| e.to_string())?;
        let routine = routine(&writer.module, layout, plan);
        let code = Arc::new(Memory(Some(writer.module)));
        let scratch = routine.scratch.clone();
        Ok(Part { routine: Arc::new(routine), scratch, dim: density.dim(), _code: code })
    }

    /// Writes the gradient at `x` to `g`, and gives the value, or 0 for a program without; `None`, and NaN in `g`,
    /// outside the guards.
    ///
    /// # Panics
    /// When `x` or `g` has not one number for each coordinate.
    #[inline]
    pub fn inside(&mut self, x: &[f64], g: &mut [f64]) -> Option<f64> {
        assert!(x.len() == self.dim && g.len() == self.dim);
        self.routine.run(x, g, &mut self.scratch)
    }
}

/// A density as machine code.
#[derive(Clone)]
pub struct Native {
    both: Part,
    slope: Part,
}

impl Native {
    /// Compiles a density.
    ///
    /// # Errors
    /// As for [`Part::compile`].
    pub fn compile(density: &Density) -> Result<Native, String> {
        Ok(Native { slope: Part::compile(density, false)?, both: Part::compile(density, true)? })
    }

    /// How many coordinates there are.
    pub fn dim(&self) -> usize {
        self.both.dim
    }

    /// The log density at `x`, with its gradient in `g`; NaN outside the guards.
    ///
    /// # Panics
    /// When `x` or `g` has not one number for each coordinate.
    #[inline]
    pub fn value_and_gradient(&mut self, x: &[f64], g: &mut [f64]) -> f64 {
        self.inside(x, g).unwrap_or(f64::NAN)
    }

    /// The same; `None` outside the guards.
    ///
    /// # Panics
    /// As for [`Native::value_and_gradient`].
    #[inline]
    pub fn inside(&mut self, x: &[f64], g: &mut [f64]) -> Option<f64> {
        self.both.inside(x, g)
    }

    /// The gradient at `x`; false, and NaN, outside the guards.
    ///
    /// # Panics
    /// As for [`Native::value_and_gradient`].
    #[inline]
    pub fn gradient(&mut self, x: &[f64], g: &mut [f64]) -> bool {
        self.slope.inside(x, g).is_some()
    }
}

impl Routine {
    /// The value, or 0 for a program without; `None` outside the guards.
    #[inline]
    fn run(&self, x: &[f64], g: &mut [f64], scratch: &mut [f64]) -> Option<f64> {
        for step in &self.steps {
            match *step {
                // SAFETY: the code reads one number of `x` and writes one of `g` for each coordinate, which the
                // callers checked, and stays within the scratch that was laid out with it.
                Step::Code(entry) => unsafe { entry(x.as_ptr(), g.as_mut_ptr(), scratch.as_mut_ptr()) },
                Step::Calls { op, from, to, n } => {
                    let (before, to) = scratch.split_at_mut(to as usize);
                    let n = n as usize;
                    let arguments = &before[from as usize..];
                    let (a, b) = arguments.split_at(n);
                    kernels::apply_all(op, a, b, &[], &mut to[..n]);
                }
            }
        }
        if self.flags.iter().all(|&flag| scratch[flag as usize].to_bits() != 0) {
            return Some(self.value.map_or(0.0, |at| scratch[at as usize]));
        }
        g.fill(f64::NAN);
        None
    }
}

/// Calls of one operation at one level.
struct Batch {
    level: u32,
    op: Op,
    ids: Vec<Id>,
    from: u32,
    to: u32,
}

/// In which order operations run, and where in the scratch their numbers lie.
struct Layout {
    /// Operations that are instructions, ordered by level, cut into functions; the level of each.
    segments: Vec<(u32, Vec<Id>)>,
    batches: Vec<Batch>,
    /// Place in the scratch of a number that is read from there.
    place: Vec<u32>,
    /// Places of call arguments that a number must be written to.
    arguments: Vec<(Id, u32)>,
    /// Numbers in the scratch from the start.
    scratch: Vec<f64>,
    value: Option<u32>,
    flags: Vec<u32>,
}

const NOWHERE: u32 = u32::MAX;

/// Arguments as the code reads them: a select on `a < b` compares for itself.
fn reads(density: &Density, id: Id) -> impl Iterator<Item = Id> {
    let graph = density.graph();
    let node = *graph.node(id);
    let test = (node.op == Op::Select).then(|| *graph.node(node.arg(0))).filter(|test| test.op == Op::Less);
    let fused = test.is_some();
    let test_args = test.map(|test| [test.arg(0), test.arg(1)]);
    let own = (usize::from(fused)..node.op.arity()).map(move |k| node.arg(k));
    test_args.into_iter().flatten().chain(own)
}

impl Layout {
    fn new(density: &Density, with_value: bool) -> Layout {
        let graph = density.graph();
        let mut needed = vec![false; graph.len()];
        let outputs = density.gradient().iter().copied().chain(with_value.then_some(density.value()));
        let guards = density.guards().iter().flat_map(|g| [g.a, g.b]);
        for id in outputs.chain(guards) {
            needed[id.index()] = true;
        }
        for at in (0..needed.len()).rev() {
            if needed[at] {
                reads(density, Id(at as u32)).for_each(|arg| needed[arg.index()] = true);
            }
        }
        // Levels: how many calls must have run before.
        let mut level = vec![0_u32; graph.len()];
        let mut plain: Vec<Id> = Vec::new();
        let mut calls: Vec<Id> = Vec::new();
        for (id, node) in graph.nodes().filter(|(id, _)| needed[id.index()]) {
            let after = |arg: Id| level[arg.index()] + u32::from(graph.node(arg).op.is_call());
            level[id.index()] = reads(density, id).map(after).max().unwrap_or(0);
            if node.op.is_call() {
                calls.push(id);
            } else if node.op.arity() > 0 {
                plain.push(id);
            }
        }
        plain.sort_by_key(|id| (level[id.index()], *id));
        calls.sort_by_key(|id| (level[id.index()], graph.node(*id).op, *id));
        let mut layout = Layout {
            segments: vec![],
            batches: vec![],
            place: vec![NOWHERE; graph.len()],
            arguments: vec![],
            scratch: vec![],
            value: None,
            flags: vec![],
        };
        for id in calls {
            let op = graph.node(id).op;
            match layout.batches.last_mut() {
                Some(batch) if batch.op == op && batch.level == level[id.index()] => batch.ids.push(id),
                _ => {
                    layout.batches.push(Batch { level: level[id.index()], op, ids: vec![id], from: 0, to: 0 })
                }
            }
        }
        let mut segment_of = vec![NOWHERE; graph.len()];
        for id in plain {
            let at = level[id.index()];
            match layout.segments.last_mut() {
                Some((l, ids)) if *l == at && ids.len() < FUNCTION => ids.push(id),
                _ => layout.segments.push((at, vec![id])),
            }
            segment_of[id.index()] = layout.segments.len() as u32 - 1;
        }
        let mut size = 0_u32;
        for batch in &mut layout.batches {
            let n = batch.ids.len() as u32;
            batch.from = size;
            batch.to = size + n * batch.op.arity() as u32;
            size = batch.to + n;
            for (k, id) in batch.ids.iter().enumerate() {
                layout.place[id.index()] = batch.to + k as u32;
                for (j, arg) in graph.node(*id).args().enumerate() {
                    layout.arguments.push((arg, batch.from + j as u32 * n + k as u32));
                }
            }
        }
        let mut put = |place: &mut u32| {
            if *place == NOWHERE {
                *place = size;
                size += 1;
            }
        };
        let instruction = |id: Id| segment_of[id.index()] != NOWHERE;
        for (at, (_, ids)) in layout.segments.iter().enumerate() {
            for id in ids {
                for arg in reads(density, *id) {
                    if instruction(arg) && segment_of[arg.index()] != at as u32 {
                        put(&mut layout.place[arg.index()]);
                    }
                }
            }
        }
        for guard in density.guards() {
            for id in [guard.a, guard.b] {
                if instruction(id) {
                    put(&mut layout.place[id.index()]);
                }
            }
        }
        if with_value {
            put(&mut layout.place[density.value().index()]);
            layout.value = Some(layout.place[density.value().index()]);
        }
        for _ in density.guards().chunks(FUNCTION) {
            layout.flags.push(size);
            size += 1;
        }
        layout.scratch = vec![0.0; size as usize];
        for (arg, place) in &layout.arguments {
            if let Some(x) = graph.constant_of(*arg) {
                layout.scratch[*place as usize] = x;
            }
        }
        if let (Some(at), Some(x)) = (layout.value, graph.constant_of(density.value())) {
            layout.scratch[at as usize] = x;
        }
        layout
    }
}

/// A step whose function has no address yet.
enum Planned {
    Code(FuncId),
    Calls(Step),
}

struct Writer<'a> {
    module: JITModule,
    density: &'a Density,
    functions: u32,
    context: FunctionBuilderContext,
    /// What each node is in the function, by its number from 1, that computed it last.
    values: Vec<(u32, Value)>,
}

type Written<T> = Result<T, Box<dyn std::error::Error>>;

impl Writer<'_> {
    fn write(&mut self, layout: &Layout) -> Written<Vec<Planned>> {
        let graph = self.density.graph();
        let mut plan = Vec::new();
        let mut segments = layout.segments.iter().peekable();
        let mut batches = layout.batches.iter().peekable();
        let mut stores: Vec<Vec<u32>> = vec![Vec::new(); graph.len()];
        let mut early = Vec::new();
        for &(arg, place) in &layout.arguments {
            let node = graph.node(arg);
            if node.op.is_call() || node.op == Op::Input {
                early.push((arg, place));
            } else if node.op != Op::Constant {
                stores[arg.index()].push(place);
            }
        }
        let mut outputs: Vec<Vec<u32>> = vec![Vec::new(); graph.len()];
        let mut late = Vec::new();
        for (k, id) in self.density.gradient().iter().enumerate() {
            let node = graph.node(*id);
            if node.op.arity() == 0 || node.op.is_call() {
                late.push((*id, k as u32));
            } else {
                outputs[id.index()].push(k as u32);
            }
        }
        // Arguments that no instruction computes are copied: inputs at once, results of calls before the next level.
        early.sort_by_key(|(_, place)| *place);
        loop {
            let level = match (segments.peek(), batches.peek()) {
                (Some((a, _)), Some(b)) => (*a).min(b.level),
                (Some((a, _)), None) => *a,
                (None, Some(b)) => b.level,
                (None, None) => break,
            };
            let level_batches: Vec<&Batch> =
                std::iter::from_fn(|| batches.next_if(|b| b.level == level)).collect();
            let copies: Vec<(Id, u32)> = early
                .iter()
                .copied()
                .filter(|(_, place)| level_batches.iter().any(|b| (b.from..b.to).contains(place)))
                .collect();
            for chunk in copies.chunks(FUNCTION) {
                plan.push(Planned::Code(self.function(layout, |code| {
                    for (id, place) in chunk {
                        let x = code.read(*id);
                        code.keep(x, *place);
                    }
                })?));
            }
            while let Some((_, ids)) = segments.next_if(|(l, _)| *l == level) {
                let (stores, outputs) = (&stores, &outputs);
                plan.push(Planned::Code(self.function(layout, |code| {
                    for id in ids {
                        let x = code.compute(*id);
                        if layout.place[id.index()] != NOWHERE {
                            code.keep(x, layout.place[id.index()]);
                        }
                        stores[id.index()].iter().for_each(|place| code.keep(x, *place));
                        outputs[id.index()].iter().for_each(|k| code.give(x, *k));
                    }
                })?));
            }
            for b in level_batches {
                let n = b.ids.len() as u32;
                plan.push(Planned::Calls(Step::Calls { op: b.op, from: b.from, to: b.to, n }));
            }
        }
        for chunk in late.chunks(FUNCTION) {
            plan.push(Planned::Code(self.function(layout, |code| {
                for (id, k) in chunk {
                    let x = code.read(*id);
                    code.give(x, *k);
                }
            })?));
        }
        for (guards, flag) in self.density.guards().chunks(FUNCTION).zip(&layout.flags) {
            plan.push(Planned::Code(self.function(layout, |code| {
                let mut all: Option<Value> = None;
                for guard in guards {
                    let (a, b) = (code.read(guard.a), code.read(guard.b));
                    let condition = match guard.comparison {
                        Comparison::Less => FloatCC::LessThan,
                        Comparison::LessOrEqual => FloatCC::LessThanOrEqual,
                        Comparison::Equal => FloatCC::Equal,
                        Comparison::NotEqual => FloatCC::NotEqual,
                    };
                    let holds = code.b.ins().fcmp(condition, a, b);
                    all = Some(match all {
                        None => holds,
                        Some(before) => code.b.ins().band(before, holds),
                    });
                }
                if let Some(all) = all {
                    debug_assert_eq!(code.b.func.dfg.value_type(all), I8);
                    let wide = code.b.ins().uextend(I64, all);
                    let (at, to) = (code.scratch, offset(*flag));
                    code.b.ins().store(MemFlagsData::trusted(), wide, at, to);
                }
            })?));
        }
        // A value that is an input or the result of a call lies there already, or is copied.
        if let Some(at) = layout.value
            && graph.node(self.density.value()).op == Op::Input
        {
            let id = self.density.value();
            plan.push(Planned::Code(self.function(layout, |code| {
                let x = code.read(id);
                code.keep(x, at);
            })?));
        }
        Ok(plan)
    }

    fn function(&mut self, layout: &Layout, body: impl FnOnce(&mut Code<'_, '_>)) -> Written<FuncId> {
        let place = &layout.place;
        let pointer = self.module.target_config().pointer_type();
        let mut signature = Signature::new(self.module.target_config().default_call_conv);
        signature.params.extend([AbiParam::new(pointer); 3]);
        let name = format!("f{}", self.functions);
        let id = self.module.declare_function(&name, Linkage::Local, &signature)?;
        let mut context = self.module.make_context();
        context.func.signature = signature;
        context.func.name = UserFuncName::user(0, self.functions);
        self.functions += 1;
        let mut b = FunctionBuilder::new(&mut context.func, &mut self.context);
        let block = b.create_block();
        b.switch_to_block(block);
        b.append_block_params_for_function_params(block);
        let [x, g, scratch] = *b.block_params(block) else { return Err("three parameters".into()) };
        let (values, function) = (&mut self.values, self.functions);
        let mut code = Code { b, density: self.density, x, g, scratch, place, values, function };
        body(&mut code);
        let Code { mut b, .. } = code;
        b.ins().return_(&[]);
        b.seal_all_blocks();
        b.finalize(self.module.target_config());
        self.module.define_function(id, &mut context)?;
        Ok(id)
    }
}

/// Byte offset of a number.
fn offset(place: u32) -> i32 {
    i32::try_from(u64::from(place) * 8).unwrap_or(i32::MAX)
}

/// One function while it is written.
struct Code<'a, 'b> {
    b: FunctionBuilder<'a>,
    density: &'b Density,
    x: Value,
    g: Value,
    scratch: Value,
    place: &'b [u32],
    /// See [`Writer`].
    values: &'b mut [(u32, Value)],
    function: u32,
}

impl Code<'_, '_> {
    /// A number, from where it lies. Loads are not kept: loading again costs less than a register.
    fn read(&mut self, id: Id) -> Value {
        if let (function, value) = self.values[id.index()]
            && function == self.function
        {
            return value;
        }
        let node = self.density.graph().node(id);
        let flags = MemFlagsData::trusted();
        match (node.constant(), node.input()) {
            (Some(x), _) => self.b.ins().f64const(x),
            (_, Some(k)) => self.b.ins().load(F64, flags, self.x, offset(k as u32)),
            _ => self.b.ins().load(F64, flags, self.scratch, offset(self.place[id.index()])),
        }
    }

    /// Writes to the scratch.
    fn keep(&mut self, x: Value, place: u32) {
        let at = self.scratch;
        self.b.ins().store(MemFlagsData::trusted(), x, at, offset(place));
    }

    /// Writes to the gradient.
    fn give(&mut self, x: Value, k: u32) {
        let at = self.g;
        self.b.ins().store(MemFlagsData::trusted(), x, at, offset(k));
    }

    fn compute(&mut self, id: Id) -> Value {
        let graph = self.density.graph();
        let node = *graph.node(id);
        let arg = |code: &mut Self, k: usize| code.read(node.arg(k));
        let value = match node.op {
            Op::Neg | Op::Sqrt | Op::Abs | Op::Round => {
                let a = arg(self, 0);
                match node.op {
                    Op::Neg => self.b.ins().fneg(a),
                    Op::Sqrt => self.b.ins().sqrt(a),
                    Op::Round => self.b.ins().nearest(a),
                    _ => self.b.ins().fabs(a),
                }
            }
            Op::Select => {
                let test = *graph.node(node.arg(0));
                let holds = if test.op == Op::Less {
                    let (a, b) = (self.read(test.arg(0)), self.read(test.arg(1)));
                    self.b.ins().fcmp(FloatCC::LessThan, a, b)
                } else {
                    let (a, zero) = (arg(self, 0), self.b.ins().f64const(0.0));
                    self.b.ins().fcmp(FloatCC::NotEqual, a, zero)
                };
                let (yes, no) = (arg(self, 1), arg(self, 2));
                self.b.ins().select(holds, yes, no)
            }
            op => {
                let (a, b) = (arg(self, 0), arg(self, 1));
                match op {
                    Op::Add => self.b.ins().fadd(a, b),
                    Op::Sub => self.b.ins().fsub(a, b),
                    Op::Mul => self.b.ins().fmul(a, b),
                    Op::Div => self.b.ins().fdiv(a, b),
                    Op::Min | Op::Max => {
                        // As `operation::min` and `max`, to the sign of a zero.
                        let (less, more) = if op == Op::Min { (b, a) } else { (a, b) };
                        let beyond = self.b.ins().fcmp(FloatCC::LessThan, less, more);
                        let nan = self.b.ins().fcmp(FloatCC::Unordered, b, b);
                        let second = self.b.ins().bor(beyond, nan);
                        self.b.ins().select(second, b, a)
                    }
                    _ => {
                        let holds = self.b.ins().fcmp(FloatCC::LessThan, a, b);
                        let (one, zero) = (self.b.ins().f64const(1.0), self.b.ins().f64const(0.0));
                        self.b.ins().select(holds, one, zero)
                    }
                }
            }
        };
        self.values[id.index()] = (self.function, value);
        value
    }
}

fn routine(module: &JITModule, layout: Layout, plan: Vec<Planned>) -> Routine {
    let steps = plan
        .into_iter()
        .map(|step| match step {
            Planned::Calls(step) => step,
            Planned::Code(id) => {
                let code = module.get_finalized_function(id);
                // SAFETY: a function of that signature was compiled under this id.
                Step::Code(unsafe { std::mem::transmute::<*const u8, Entry>(code) })
            }
        })
        .collect();
    Routine { steps, scratch: layout.scratch, value: layout.value, flags: layout.flags }
}
