//! Conversion of a program to another scalar: the instructions stay the same, and constants become constants of
//! that scalar.

use super::entries::Entries;
use super::{Function, Program};
use crate::value::{Closure, Dict, Record, Text, Value, Vector};
use niwaki_math::Scalar;
use std::sync::Arc;

impl Program<f64> {
    /// The program over another scalar, such as the recording scalar.
    pub fn over<S: Scalar>(&self) -> Program<S> {
        let function = |f: &Function<f64>| Function {
            name: f.name.clone(),
            file: f.file,
            span: f.span,
            mode: f.mode,
            params: f.params,
            defaults: f.defaults.clone(),
            captures: f.captures,
            node_registers: f.node_registers,
            scratch_registers: f.scratch_registers,
            code: f.code.clone(),
            body: f.body,
            inputs: f.inputs.clone(),
            outers: f.outers.clone(),
            spans: f.spans.clone(),
            operands: f.operands.clone(),
            constants: f.constants.iter().map(|value| value.convert(&S::from_f64)).collect(),
            names: f.names.clone(),
            sites: f.sites.clone(),
            parameters: f.parameters.clone(),
            scope: f.scope.clone(),
            native: Entries::default(),
        };
        Program {
            files: self.files.clone(),
            classes: self.classes.clone(),
            functions: self.functions.iter().map(function).collect(),
            entry: self.entry,
            frames: self.frames,
            constants_of_copies: Vec::new(),
        }
    }
}

impl<S: Scalar> Program<S> {
    /// Copies of the program for threads. Each copy has its own classes and small constants, whose references
    /// are counted at every step, so that processors do not wait for each other's counts. Large constants are
    /// shared.
    pub fn copies_for_threads(&self, threads: usize) -> Vec<Program<S>> {
        let mut copies: Vec<Program<S>> = (0..threads).map(|_| self.copy()).collect();
        let small = |value: &&Value<S>| matches!(value, Value::Str(_) | Value::Dist(_) | Value::Function(_));
        let constants = copies.iter().chain([self]).flat_map(|program| &program.functions);
        let all: Vec<Value<S>> = constants.flat_map(|f| &f.constants).filter(small).cloned().collect();
        copies.iter_mut().for_each(|copy| copy.constants_of_copies.clone_from(&all));
        copies
    }

    fn copy(&self) -> Program<S> {
        let mut program = self.clone();
        program.classes.iter_mut().for_each(|class| *class = Arc::new((**class).clone()));
        for constant in program.functions.iter_mut().flat_map(|f| &mut f.constants) {
            match constant {
                Value::Str(text) => *text = Text::from(&**text),
                Value::Dist(dist) => *dist = Arc::new((**dist).clone()),
                Value::Function(f) if f.captures.is_empty() => {
                    *f = Arc::new(Closure { function: f.function, memo: None, captures: vec![] });
                }
                _ => {}
            }
        }
        program
    }
}

impl<S: Scalar> Value<S> {
    /// The value over another kind of number. For constants and arguments only: it recurses as deep as they
    /// nest.
    pub fn convert<T: Scalar>(&self, number: &impl Fn(S) -> T) -> Value<T> {
        let all = |items: &mut dyn Iterator<Item = &Value<S>>| {
            items.map(|item| item.convert(number)).collect::<Vec<_>>()
        };
        match self {
            Value::None => Value::None,
            Value::Bool(b) => Value::Bool(*b),
            Value::Int(n) => Value::Int(*n),
            Value::Real(x) => Value::Real(number(*x)),
            Value::Future(id) => Value::Future(*id),
            Value::Unset => Value::Unset,
            Value::Cell(cell) => Value::Cell(*cell),
            Value::Str(text) => Value::Str(text.clone()),
            Value::Returned(value) => Value::Returned(all(&mut value.items().iter()).into()),
            Value::Tuple(tuple) => Value::tuple(all(&mut tuple.items().iter())),
            Value::List(list) => Value::list(all(&mut list.iter())),
            Value::Dict(dict) => {
                let keys = all(&mut dict.keys().iter());
                Value::Dict(Arc::new(Dict::new(
                    keys.into_iter().zip(all(&mut dict.values().iter())).collect(),
                )))
            }
            Value::Record(record) => Value::Record(Arc::new(Record {
                class: record.class.clone(),
                fields: all(&mut record.fields.iter()),
            })),
            Value::Range(range) => Value::Range(range.clone()),
            Value::Vector(v) => {
                let parts: Vec<T> = v.components().iter().map(|x| number(*x)).collect();
                Value::Vector(Arc::new(Vector::new(&parts)))
            }
            Value::Rotation(r) => Value::Rotation(Arc::new(r.map(number))),
            Value::Shape(shape) => {
                // An earlier shape may have had the same address.
                T::note(shape.address(), Vec::new);
                Value::Shape(shape.clone())
            }
            Value::Dist(dist) => Value::Dist(Arc::new(dist.convert(number))),
            Value::Function(f) => Value::Function(Arc::new(Closure {
                function: f.function,
                memo: f.memo.clone(),
                captures: all(&mut f.captures.iter()),
            })),
        }
    }
}
