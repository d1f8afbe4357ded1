//! Functions of machine code: one for each segment of a program, and copies between them.

use super::Step;
use super::code::Code;
use super::layout::{Batch, FUNCTION, Layout, Program};
use crate::density::{Comparison, Density};
use crate::graph::small;
use crate::operation::Op;
use niwaki_native::codegen::ir::condcodes::FloatCC;
use niwaki_native::codegen::ir::types::I64;
use niwaki_native::codegen::ir::{AbiParam, InstBuilder, Signature, Type, UserFuncName, Value};
use niwaki_native::frontend::{FunctionBuilder, FunctionBuilderContext};
use niwaki_native::jit::JITModule;
use niwaki_native::module::{FuncId, Linkage, Module};
use niwaki_native::{CompileResult, Effort, Memory, module};

/// A step whose function has no address yet.
enum Planned {
    Code(FuncId),
    Calls(Step),
}

/// A module of machine code during its generation.
pub(super) struct Writer<'a> {
    pub(super) module: JITModule,
    pub(super) density: &'a Density,
    pub(super) layout: &'a Layout,
    functions: u32,
    context: FunctionBuilderContext,
    /// For each node, the function that computed it last (by number, from 1), and its value there.
    values: Vec<(u32, Value)>,
    plan: Vec<Planned>,
}

impl<'a> Writer<'a> {
    pub(super) fn new(density: &'a Density, layout: &'a Layout) -> CompileResult<Writer<'a>> {
        Ok(Writer {
            module: module(Effort::Plain)?,
            density,
            layout,
            functions: 0,
            context: FunctionBuilderContext::new(),
            values: vec![(0, Value::from_u32(0)); density.graph().len()],
            plan: vec![],
        })
    }

    /// The gradient, with the guards.
    pub(super) fn write_slope(&mut self) -> CompileResult<()> {
        let (density, layout) = (self.density, self.layout);
        let graph = density.graph();
        let mut outputs: Vec<Vec<u32>> = vec![Vec::new(); graph.len()];
        let mut late = Vec::new();
        for (k, id) in density.gradient().iter().enumerate() {
            if layout.is_instruction(*id) {
                outputs[id.index()].push(small(k));
            } else {
                late.push((*id, small(k)));
            }
        }
        self.write_program(&layout.slope, &outputs)?;
        for chunk in late.chunks(FUNCTION) {
            self.plan_code(|code| {
                for (id, k) in chunk {
                    let x = code.read(*id);
                    code.give(x, *k);
                }
            })?;
        }
        for (guards, flag) in density.guards().chunks(FUNCTION).zip(&layout.flags) {
            self.plan_code(|code| {
                if let Some(all) = guards_hold(code, guards) {
                    let wide = code.b.ins().uextend(I64, all);
                    code.keep(wide, *flag);
                }
            })?;
        }
        Ok(())
    }

    /// The operations that the value needs besides the gradient.
    pub(super) fn write_rest(&mut self) -> CompileResult<()> {
        let (density, layout) = (self.density, self.layout);
        self.write_program(&layout.rest, &vec![Vec::new(); density.graph().len()])?;
        let value = density.value();
        if density.graph().node(value).op == Op::Input {
            self.plan_code(|code| {
                let x = code.read(value);
                code.keep(x, layout.value);
            })?;
        }
        Ok(())
    }

    fn write_program(&mut self, program: &'a Program, outputs: &[Vec<u32>]) -> CompileResult<()> {
        let (density, layout) = (self.density, self.layout);
        let graph = density.graph();
        let mut mine = vec![false; graph.len()];
        program.segments.iter().flat_map(|(_, ids)| ids).for_each(|id| mine[id.index()] = true);
        let mut stores: Vec<Vec<u32>> = vec![Vec::new(); graph.len()];
        let mut early = Vec::new();
        for &(arg, place) in &program.arguments {
            if mine[arg.index()] {
                stores[arg.index()].push(place);
            } else if graph.node(arg).op != Op::Constant && layout.place[arg.index()] != place {
                early.push((arg, place));
            }
        }
        // Arguments that no instruction of this program computes are copied: inputs at once, results of calls before
        // the next level.
        early.sort_by_key(|(_, place)| *place);
        let mut segments = program.segments.iter().peekable();
        let mut batches = program.batches.iter().peekable();
        loop {
            let level = match (segments.peek(), batches.peek()) {
                (Some((a, _)), Some(b)) => (*a).min(b.level),
                (Some((a, _)), None) => *a,
                (None, Some(b)) => b.level,
                (None, None) => return Ok(()),
            };
            let now: Vec<&Batch> = std::iter::from_fn(|| batches.next_if(|b| b.level == level)).collect();
            let is_now = |place: &u32| now.iter().any(|b| (b.from..b.to).contains(place));
            let copies: Vec<_> = early.iter().copied().filter(|(_, place)| is_now(place)).collect();
            for chunk in copies.chunks(FUNCTION) {
                self.plan_code(|code| {
                    for (id, place) in chunk {
                        let x = code.read(*id);
                        code.keep(x, *place);
                    }
                })?;
            }
            while let Some((_, ids)) = segments.next_if(|(l, _)| *l == level) {
                self.plan_code(|code| {
                    for id in ids {
                        let x = code.compute(*id);
                        let place = layout.place_of(*id);
                        place.iter().chain(&stores[id.index()]).for_each(|place| code.keep(x, *place));
                        outputs[id.index()].iter().for_each(|k| code.give(x, *k));
                    }
                })?;
            }
            for b in now {
                let n = small(b.ids.len());
                self.plan.push(Planned::Calls(Step::Calls { op: b.op, from: b.from, to: b.to, n }));
            }
        }
    }

    /// Plans a function of `(x, g, scratch)` as the next step.
    fn plan_code(&mut self, body: impl FnOnce(&mut Code<'_, '_>)) -> CompileResult<()> {
        let pointer = self.module.target_config().pointer_type();
        let id = self.function(&[pointer; 3], None, |code, _| {
            body(code);
            code.b.ins().return_(&[]);
        })?;
        self.plan.push(Planned::Code(id));
        Ok(())
    }

    /// A function whose first three parameters are `(x, g, scratch)`.
    pub(super) fn function(
        &mut self,
        parameters: &[Type],
        result: Option<Type>,
        body: impl FnOnce(&mut Code<'_, '_>, &[Value]),
    ) -> CompileResult<FuncId> {
        let mut signature = Signature::new(self.module.target_config().default_call_conv);
        signature.params.extend(parameters.iter().map(|ty| AbiParam::new(*ty)));
        signature.returns.extend(result.map(AbiParam::new));
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
        let values = b.block_params(block).to_vec();
        let [x, g, scratch, ..] = values[..] else { return Err("three parameters".into()) };
        let mut code =
            Code::new(b, self.density, self.layout, [x, g, scratch], (&mut self.values, self.functions));
        body(&mut code, &values);
        let Code { mut b, .. } = code;
        b.seal_all_blocks();
        b.finalize(self.module.target_config());
        self.module.define_function(id, &mut context)?;
        Ok(id)
    }

    /// The steps and their memory, with the address of one more function.
    pub(super) fn finish(
        self,
        other: Option<FuncId>,
    ) -> CompileResult<(Vec<Step>, Memory, Option<*const u8>)> {
        let Writer { module, plan, .. } = self;
        let code = Memory::finish(module)?;
        let steps = plan.into_iter().map(|step| match step {
            Planned::Calls(step) => step,
            Planned::Code(id) => Step::code(code.address(id)),
        });
        let steps = steps.collect();
        let other = other.map(|id| code.address(id));
        Ok((steps, code, other))
    }
}

/// Code that tests whether all guards hold; `None` without guards.
pub(super) fn guards_hold(code: &mut Code<'_, '_>, guards: &[crate::density::Guard]) -> Option<Value> {
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
    all
}
