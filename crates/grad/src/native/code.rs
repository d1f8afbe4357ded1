//! The instructions of a function, during its generation.

use super::layout::{Layout, test_of};
use crate::density::Density;
use crate::graph::{Id, small};
use crate::operation::Op;
use niwaki_native::codegen::ir::condcodes::FloatCC;
use niwaki_native::codegen::ir::types::{F64, F64X2};
use niwaki_native::codegen::ir::{Endianness, InstBuilder, MemFlagsData, Value};
use niwaki_native::frontend::FunctionBuilder;

/// A function during its generation.
pub(super) struct Code<'a, 'b> {
    pub b: FunctionBuilder<'a>,
    pub density: &'b Density,
    layout: &'b Layout,
    /// Addresses.
    x: Value,
    g: Value,
    scratch: Value,
    /// Coordinates in registers; other coordinates are read from `x`.
    pub inputs: Vec<Value>,
    /// For each node, the function that computed it last (by number), and its value there.
    values: &'b mut [(u32, Value)],
    function: u32,
    /// Comparisons that were compiled for selects.
    masks: Vec<(Id, Value)>,
}

/// Byte offset of a number.
fn offset(place: u32) -> i32 {
    i32::try_from(u64::from(place) * 8).expect("`Native::compile` refuses what is further on")
}

/// Flags of valid, aligned memory.
const PLAIN: MemFlagsData = MemFlagsData::trusted();

impl<'a, 'b> Code<'a, 'b> {
    pub(super) fn new(
        b: FunctionBuilder<'a>,
        density: &'b Density,
        layout: &'b Layout,
        [x, g, scratch]: [Value; 3],
        (values, function): (&'b mut [(u32, Value)], u32),
    ) -> Code<'a, 'b> {
        Code { b, density, layout, x, g, scratch, inputs: vec![], values, function, masks: vec![] }
    }

    /// A number, read from its place. Loads are not reused, since a load costs less than a register. A constant is
    /// loaded too: ten bytes of constant in the code, and a move from one kind of register to another, would cost more.
    pub(super) fn read(&mut self, id: Id) -> Value {
        if let (function, value) = self.values[id.index()]
            && function == self.function
        {
            return value;
        }
        let node = self.density.graph().node(id);
        match (node.constant(), node.input()) {
            (Some(x), _) if x.to_bits() == 0 => self.b.ins().f64const(0.0),
            (_, Some(k)) => match self.inputs.get(k) {
                Some(x) => *x,
                None => self.load(self.x, small(k)),
            },
            _ => self.load(self.scratch, self.layout.place[id.index()]),
        }
    }

    /// The number at a place relative to an address.
    pub(super) fn load(&mut self, at: Value, place: u32) -> Value {
        self.b.ins().load(F64, PLAIN, at, offset(place))
    }

    /// Writes to the scratch.
    pub(super) fn keep(&mut self, x: Value, place: u32) {
        self.store(x, self.scratch, place);
    }

    /// Writes to the gradient.
    pub(super) fn give(&mut self, x: Value, k: u32) {
        self.store(x, self.g, k);
    }

    /// Writes to a place relative to an address.
    pub(super) fn store(&mut self, x: Value, at: Value, place: u32) {
        self.b.ins().store(PLAIN, x, at, offset(place));
    }

    fn wide(&mut self, x: Value) -> Value {
        self.b.ins().scalar_to_vector(F64X2, x)
    }

    fn narrow(&mut self, x: Value) -> Value {
        self.b.ins().extractlane(x, 0)
    }

    /// All bits if the comparison holds, else none. A select by masks is three short instructions; by flags it
    /// would be a jump.
    fn mask(&mut self, condition: FloatCC, a: Value, b: Value) -> Value {
        let (a, b) = (self.wide(a), self.wide(b));
        let mask = self.b.ins().fcmp(condition, a, b);
        self.b.ins().bitcast(F64X2, MemFlagsData::new().with_endianness(Endianness::Little), mask)
    }

    /// `yes` if the mask is set, else `no`.
    fn choose(&mut self, mask: Value, yes: Value, no: Value) -> Value {
        let (yes, no) = (self.wide(yes), self.wide(no));
        let selected = self.b.ins().bitselect(mask, yes, no);
        self.narrow(selected)
    }

    fn is_zero(&self, id: Id) -> bool {
        self.density.graph().constant_of(id).is_some_and(|x| x.to_bits() == 0)
    }

    fn select(&mut self, id: Id) -> Value {
        let graph = self.density.graph();
        let node = *graph.node(id);
        let (test, yes, no) = (node.arg(0), node.arg(1), node.arg(2));
        let mask = match self.masks.iter().rev().find(|(known, _)| *known == test) {
            Some((_, mask)) => *mask,
            None => {
                let mask = if test_of(self.density, id).is_some() {
                    let test = *graph.node(test);
                    let (a, b) = (self.read(test.arg(0)), self.read(test.arg(1)));
                    self.mask(FloatCC::LessThan, a, b)
                } else {
                    let (a, zero) = (self.read(test), self.b.ins().f64const(0.0));
                    self.mask(FloatCC::NotEqual, a, zero)
                };
                self.masks.push((test, mask));
                mask
            }
        };
        if self.is_zero(no) {
            let yes = self.read(yes);
            let yes = self.wide(yes);
            let masked = self.b.ins().band(mask, yes);
            return self.narrow(masked);
        }
        if self.is_zero(yes) {
            let no = self.read(no);
            let no = self.wide(no);
            let masked = self.b.ins().band_not(no, mask);
            return self.narrow(masked);
        }
        let (yes, no) = (self.read(yes), self.read(no));
        self.choose(mask, yes, no)
    }

    /// Computes the value of an instruction for later uses.
    pub(super) fn compute(&mut self, id: Id) -> Value {
        let node = *self.density.graph().node(id);
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
            Op::Select => self.select(id),
            op => {
                let (a, b) = (arg(self, 0), arg(self, 1));
                match op {
                    Op::Add => self.b.ins().fadd(a, b),
                    Op::Sub => self.b.ins().fsub(a, b),
                    Op::Mul => self.b.ins().fmul(a, b),
                    Op::Div => self.b.ins().fdiv(a, b),
                    Op::Min | Op::Max => {
                        // As `operation::min` and `max`, down to the sign of a zero: one instruction, except for a second argument
                        // that is NaN.
                        let (less, more) = if op == Op::Min { (b, a) } else { (a, b) };
                        let beyond = self.b.ins().fcmp(FloatCC::LessThan, less, more);
                        let number = self.b.ins().select(beyond, b, a);
                        let nan = self.mask(FloatCC::Unordered, b, b);
                        self.choose(nan, b, number)
                    }
                    _ => {
                        let (mask, unity) = (self.mask(FloatCC::LessThan, a, b), self.b.ins().f64const(1.0));
                        let unity = self.wide(unity);
                        let masked = self.b.ins().band(mask, unity);
                        self.narrow(masked)
                    }
                }
            }
        };
        self.values[id.index()] = (self.function, value);
        value
    }
}
