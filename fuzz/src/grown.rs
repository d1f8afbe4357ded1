//! Programs grown from bytes by a small grammar: they always compile, and reach choices, loops, futures and shapes.

use crate::core_text::on_stack_for;
use crate::numbers::{below, byte};
use crate::programs;
use arbitrary::Unstructured;
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;
use std::fmt::Write;

/// Functions beside the entry; each calls only those before it, so that programs end.
const FUNCTIONS: usize = 3;

/// Grows a program and runs it.
///
/// # Panics
/// When it does not compile, and as [`programs::check`].
pub fn check(bytes: &[u8]) {
    let Some((head, rest)) = bytes.split_at_checked(programs::HEAD) else { return };
    let text = text(&mut Unstructured::new(rest));
    on_stack_for(&text, || {
        let module = parse(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        if let Err(error) = compile::<f64>(&module, vec![]) {
            panic!("{error}\n{text}");
        }
    });
    programs::check(&[head, text.as_bytes()].concat());
}

/// The text of a program.
pub fn text(u: &mut Unstructured<'_>) -> String {
    let mut grower =
        Grower { out: String::from("(module (class 0 \"Part\" (\"a\" \"b\"))"), functions: 0, names: 0 };
    for _ in 0..FUNCTIONS {
        grower.function(u, &format!("f{}", grower.functions), &["n", "x"]);
        grower.functions += 1;
    }
    grower.function(u, "m", &[]);
    grower.out + " (entry \"m\"))"
}

struct Grower {
    out: String,
    /// Functions that can be called: `f0` to the last.
    functions: usize,
    /// Names that were given so far.
    names: usize,
}

/// The variables that are assigned at a place: numbers, truth values, and futures of numbers.
#[derive(Clone, Default)]
struct Scope {
    numbers: Vec<String>,
    truths: Vec<String>,
    futures: Vec<String>,
}

impl Grower {
    fn function(&mut self, u: &mut Unstructured<'_>, name: &str, params: &[&str]) {
        let vars: String = params.iter().map(|param| format!(" ${param}")).collect();
        let _ = write!(self.out, " (fn \"{name}\" (params{vars})");
        let mut scope =
            Scope { numbers: params.iter().map(|param| format!("${param}")).collect(), ..Scope::default() };
        if name == "m" {
            self.out += " (set $n 2) (set $x 0.5)";
            scope.numbers = vec!["$n".into(), "$x".into()];
        }
        let statements = 2 + below(u, 5);
        self.block(u, &mut scope, statements, 2, false);
        let result = self.number(u, &scope, 2);
        let _ = write!(self.out, " (return (tuple {result})))");
        // A function gives a tuple of one, so that aggregates cross calls.
    }

    fn block(
        &mut self,
        u: &mut Unstructured<'_>,
        scope: &mut Scope,
        statements: usize,
        deep: usize,
        loops: bool,
    ) {
        for _ in 0..statements {
            self.statement(u, scope, deep, loops);
        }
    }

    /// A name of its own, or again one that is assigned.
    fn name(&mut self, u: &mut Unstructured<'_>, known: &[String]) -> String {
        if !known.is_empty() && below(u, 4) == 0 {
            return known[below(u, known.len())].clone();
        }
        self.names += 1;
        format!("$v{}", self.names)
    }

    fn statement(&mut self, u: &mut Unstructured<'_>, scope: &mut Scope, deep: usize, loops: bool) {
        match below(u, 14) {
            0 | 1 => {
                let (value, name) = (self.number(u, scope, 2), self.name(u, &scope.numbers));
                self.set(&name, &value);
                push(&mut scope.numbers, name);
            }
            2 => {
                let (value, name) = (self.choice(u, scope), self.name(u, &scope.numbers));
                self.set(&name, &value);
                push(&mut scope.numbers, name);
            }
            3 => {
                let (value, name) = (self.truth(u, scope), self.name(u, &scope.truths));
                self.set(&name, &value);
                push(&mut scope.truths, name);
            }
            4 => {
                let (x, sd) = (self.number(u, scope, 1), 0.5 + f64::from(byte(u)) / 64.0);
                let _ = write!(self.out, " (do (observe (dist gaussian {x} {sd:?}) 0.3))");
            }
            5 => {
                let x = self.number(u, scope, 1);
                let _ = write!(self.out, " (do (factor (sub 0.0 (abs (mul 0.1 (tanh {x}))))))");
            }
            6 if deep > 0 => {
                let test = self.truth(u, scope);
                let _ = write!(self.out, " (if {test} (then");
                let sizes = [1 + below(u, 3), below(u, 3)];
                self.block(u, &mut scope.clone(), sizes[0], deep - 1, loops);
                self.out += ") (else";
                self.block(u, &mut scope.clone(), sizes[1], deep - 1, loops);
                self.out += "))";
            }
            7 if deep > 0 => {
                self.names += 1;
                let i = format!("$i{}", self.names);
                let count = if below(u, 2) == 0 {
                    format!("{}", below(u, 4))
                } else {
                    small(&self.number(u, scope, 0))
                };
                let _ = write!(self.out, " (for {i} (range {count}) (body");
                let (mut inner, statements) = (scope.clone(), 1 + below(u, 3));
                inner.numbers.push(i);
                self.block(u, &mut inner, statements, deep - 1, true);
                self.out += "))";
            }
            8 if self.functions > 0 => {
                let (call, name) = (self.call(u, scope, "call"), self.name(u, &scope.numbers));
                let _ = write!(self.out, " (unpack ({name}) {call})");
                push(&mut scope.numbers, name);
            }
            9 if self.functions > 0 => {
                self.names += 1;
                let (name, call) = (format!("$w{}", self.names), self.call(u, scope, "future"));
                self.set(&name, &call);
                scope.futures.push(name);
            }
            10 if !scope.futures.is_empty() => {
                let future = scope.futures[below(u, scope.futures.len())].clone();
                let name = self.name(u, &scope.numbers);
                let _ = write!(self.out, " (unpack ({name}) (force {future}))");
                push(&mut scope.numbers, name);
            }
            11 => {
                let (x, y) = (self.number(u, scope, 1), self.number(u, scope, 1));
                let size = format!("(vec 0.3 (add 0.1 (abs (tanh {y}))) 0.3)");
                let _ = write!(self.out, " (do (emit (box (vec (tanh {x}) 0.0 0.2) {size})))");
            }
            12 if loops => {
                let test = self.truth(u, scope);
                let how = if byte(u) & 1 == 1 { "break" } else { "continue" };
                let _ = write!(self.out, " (if {test} (then ({how})) (else))");
            }
            _ => {
                // A list that is built and read, or a record.
                let (a, b) = (self.number(u, scope, 1), self.number(u, scope, 1));
                let name = self.name(u, &scope.numbers);
                let value = match below(u, 4) {
                    0 => format!("(field (record 0 {a} {b}) \"b\")"),
                    1 => format!("(index (append (list {a}) {b}) {})", below(u, 2)),
                    2 => format!("(sum (list {a} {b}))"),
                    _ => format!("(index (sorted (list {a} {b} 0)) 0)"),
                };
                self.set(&name, &value);
                push(&mut scope.numbers, name);
            }
        }
    }

    fn set(&mut self, name: &str, value: &str) {
        let _ = write!(self.out, " (set {name} {value})");
    }

    fn call(&mut self, u: &mut Unstructured<'_>, scope: &Scope, how: &str) -> String {
        let (n, x) = (self.number(u, scope, 1), self.number(u, scope, 1));
        format!("({how} \"f{}\" {n} {x})", below(u, self.functions))
    }

    fn number(&mut self, u: &mut Unstructured<'_>, scope: &Scope, deep: usize) -> String {
        match below(u, if deep == 0 { 4 } else { 9 }) {
            0 | 1 => scope.numbers[below(u, scope.numbers.len())].clone(),
            2 => format!("{}", i64::from(byte(u) % 7) - 2),
            3 => format!("{:?}", f64::from(byte(u)) / 32.0 - 2.0),
            4 => format!("(add {} {})", self.number(u, scope, deep - 1), self.number(u, scope, deep - 1)),
            5 => format!("(mul 0.5 {})", self.number(u, scope, deep - 1)),
            6 => format!("(mod {} 3)", self.number(u, scope, deep - 1)),
            7 => format!("(max {} {})", self.number(u, scope, deep - 1), self.number(u, scope, deep - 1)),
            _ => {
                let test = self.truth(u, scope);
                format!(
                    "(cond {test} {} {})",
                    self.number(u, scope, deep - 1),
                    self.number(u, scope, deep - 1)
                )
            }
        }
    }

    fn truth(&mut self, u: &mut Unstructured<'_>, scope: &Scope) -> String {
        match below(u, 5) {
            0 => "(sample (dist bernoulli 0.4))".into(),
            1 if !scope.truths.is_empty() => scope.truths[below(u, scope.truths.len())].clone(),
            2 => format!("(and (lt {} 1) (sample (dist bernoulli 0.6)))", self.number(u, scope, 1)),
            3 => format!("(not (eq {} 0))", self.number(u, scope, 1)),
            _ => format!("(lt {} {})", self.number(u, scope, 1), self.number(u, scope, 1)),
        }
    }

    fn choice(&mut self, u: &mut Unstructured<'_>, scope: &Scope) -> String {
        let x = self.number(u, scope, 1);
        let dist = match below(u, 7) {
            0 => format!("gaussian {x} 0.8"),
            1 => format!("uniform -1.0 (add 0.5 (abs (tanh {x})))"),
            2 => "categorical (list 0.2 0.3 0.5)".into(),
            3 => "discrete_uniform -1 2".into(),
            4 => format!("poisson (add 0.1 (abs (tanh {x})))"),
            5 => format!("delta {x}"),
            _ => "gaussian 0.0 1.0".into(),
        };
        format!("(sample (dist {dist}))")
    }
}

fn push(names: &mut Vec<String>, name: String) {
    if !names.contains(&name) {
        names.push(name);
    }
}

/// At most three of a number.
fn small(number: &str) -> String {
    format!("(int (clip {number} 0 3))")
}
