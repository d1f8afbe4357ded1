//! The values that are angles: values that flow into an angle, and values that come from one.
//!
//! Some functions take an angle: `sin`, `cos`, `tan`, `degrees`, and functions that turn something (`ellipse`,
//! `rotation`, `rotate`). Others return one: `atan2`, `atan`, `asin`, `acos`, `radians` and a von Mises
//! distribution. A value stays an angle in sums and differences and with the opposite sign; through parameters,
//! captures, returned values and loops; and from the location of a distribution to its draw. Elements of
//! tuples, lists and records are not followed, and calls of function values are not.

use crate::builtins::builtin;
use crate::code::{Binary, Function, FunctionId, Loop, Mode, Op, Operand, Place, Program, SiteKind, Source};
use niwaki_math::{Family, Scalar};
use std::collections::{HashMap, HashSet};

/// A register of a function, or the function's result.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Spot {
    Register(u32, Operand),
    Result(u32),
}

impl Spot {
    /// Whether the spot is a constant: unrelated instructions share constants.
    fn is_constant(self) -> bool {
        matches!(self, Spot::Register(_, o) if o.place() == Place::Constant)
    }
}

/// The built-in functions that take an angle, and the number of that argument.
const ANGLE_ARGUMENTS: [(&str, usize); 7] =
    [("sin", 0), ("cos", 0), ("tan", 0), ("degrees", 0), ("ellipse", 3), ("rotation", 1), ("rotate", 2)];

/// The built-in functions that return an angle.
const ANGLE_RESULTS: [&str; 5] = ["atan2", "atan", "asin", "acos", "radians"];

/// The built-in functions that return an angle if these arguments are angles.
const ANGLE_PRESERVING: [(&str, &[usize]); 8] = [
    ("pos", &[0]),
    ("float", &[0]),
    ("clip", &[0, 1, 2]),
    ("lerp", &[0, 1]),
    ("min", &[0, 1]),
    ("max", &[0, 1]),
    ("fmod", &[0, 1]),
    ("abs", &[0]),
];

/// The flow of values between spots.
#[derive(Default)]
struct Flows {
    edges: Vec<(Spot, Spot)>,
    sinks: HashSet<Spot>,
    sources: HashSet<Spot>,
}

/// Marks the angles among the variables that choices can read, and among the choices.
pub(super) fn mark<S: Scalar>(program: &mut Program<S>) {
    let mut flows = Flows::default();
    (0..).zip(&program.functions).for_each(|(number, f)| flows.function(program, number, f));
    let (forward, backward): (Vec<_>, Vec<_>) =
        flows.edges.iter().map(|(from, to)| ((*from, *to), (*to, *from))).unzip();
    let mut angles = reachable(flows.sources, &forward);
    angles.extend(reachable(flows.sinks, &backward));
    for (number, f) in (0..).zip(&mut program.functions) {
        f.scope.iter_mut().for_each(|x| x.is_angle = angles.contains(&Spot::Register(number, x.at)));
        f.sites.iter_mut().for_each(|site| {
            site.is_angle = angles.contains(&Spot::Register(number, site.to));
        });
    }
}

/// The spots that can be reached from some spots.
fn reachable(mut spots: HashSet<Spot>, edges: &[(Spot, Spot)]) -> HashSet<Spot> {
    let mut next: HashMap<Spot, Vec<Spot>> = HashMap::new();
    edges.iter().for_each(|(from, to)| next.entry(*from).or_default().push(*to));
    let mut frontier: Vec<Spot> = spots.iter().copied().collect();
    while let Some(spot) = frontier.pop() {
        for to in next.get(&spot).into_iter().flatten() {
            if spots.insert(*to) {
                frontier.push(*to);
            }
        }
    }
    spots
}

/// The arguments of a family that determine the location of its values.
fn locations(family: Family) -> &'static [usize] {
    match family {
        Family::Gaussian | Family::Laplace | Family::Cauchy | Family::VonMises => &[0],
        Family::Uniform => &[0, 1],
        _ => &[],
    }
}

impl Flows {
    fn function<S: Scalar>(&mut self, program: &Program<S>, number: u32, f: &Function<S>) {
        let at = |o: Operand| Spot::Register(number, o);
        for op in &f.code[..f.body as usize] {
            match *op {
                Op::Move { to, from } | Op::Neg { to, a: from } => self.flow(at(from), at(to)),
                Op::Add { to, a, b } | Op::Sub { to, a, b } | Op::Binary { op: Binary::Mod, to, a, b } => {
                    [a, b].into_iter().for_each(|from| self.flow(at(from), at(to)));
                }
                Op::Builtin { to, id, args } => self.builtin(builtin::<S>(id).name, at(to), &|i| {
                    f.operands[args.range()].get(i).map(|o| at(*o))
                }),
                Op::CallPure { to, function, args } => {
                    self.call(program, FunctionId(u32::from(function)), 0, number, &f.operands[args.range()]);
                    self.flow(Spot::Result(u32::from(function)), at(to));
                }
                Op::Closure { function, args, .. } => {
                    let id = FunctionId(u32::from(function));
                    let captures = usize::from(program.function(id).params);
                    self.call(program, id, captures, number, &f.operands[args.range()]);
                }
                Op::Return { a } => self.flow(at(a), Spot::Result(number)),
                Op::Site { site } => {
                    let site = &f.sites[site.0 as usize];
                    let args = &f.operands[site.args.range()];
                    match &site.kind {
                        SiteKind::Call { function } | SiteKind::Future { function, .. } => {
                            self.call(program, *function, 0, number, args);
                            self.flow(Spot::Result(function.0), at(site.to));
                        }
                        SiteKind::Force | SiteKind::Memoise { .. } => self.flow(at(args[0]), at(site.to)),
                        SiteKind::Sample(Source::Family(family)) => {
                            if *family == Family::VonMises {
                                self.sources.insert(at(site.to));
                                self.sinks
                                    .extend(args.first().map(|mean| at(*mean)).filter(|x| !x.is_constant()));
                            }
                            for place in locations(*family) {
                                args.get(*place).into_iter().for_each(|a| self.flow(at(*a), at(site.to)));
                            }
                        }
                        SiteKind::Loop(l) => self.lifted(program, number, l),
                        _ => {}
                    }
                }
                _ => {}
            }
        }
    }

    fn flow(&mut self, from: Spot, to: Spot) {
        if !from.is_constant() {
            self.edges.push((from, to));
        }
    }

    /// Links two spots that are one variable in two functions.
    fn alias(&mut self, outside: Spot, inside: Spot) {
        self.flow(outside, inside);
        if !outside.is_constant() {
            self.flow(inside, outside);
        }
    }

    fn builtin(&mut self, name: &str, to: Spot, arg: &dyn Fn(usize) -> Option<Spot>) {
        let sinks = ANGLE_ARGUMENTS.iter().filter(|known| known.0 == name).filter_map(|known| arg(known.1));
        self.sinks.extend(sinks.filter(|spot| !spot.is_constant()));
        self.sources.extend(ANGLE_RESULTS.iter().filter(|known| **known == name).map(|_| to));
        for (_, places) in ANGLE_PRESERVING.iter().filter(|known| known.0 == name) {
            places.iter().filter_map(|place| arg(*place)).for_each(|from| self.flow(from, to));
        }
    }

    /// The flow from arguments to the inputs of a function, from the input `first` on.
    fn call<S: Scalar>(
        &mut self,
        program: &Program<S>,
        function: FunctionId,
        first: usize,
        number: u32,
        args: &[Operand],
    ) {
        let callee = program.function(function);
        let place = if callee.mode == Mode::Pure { Place::Scratch } else { Place::Node };
        for (i, from) in (first..).zip(args) {
            let (from, to) =
                (Spot::Register(number, *from), Spot::Register(function.0, Operand::new(place, i)));
            if i < usize::from(callee.params) { self.flow(from, to) } else { self.alias(from, to) }
        }
    }

    /// The flow of values into a loop, around it, and out of it.
    fn lifted<S: Scalar>(&mut self, program: &Program<S>, number: u32, l: &Loop) {
        let (f, body) = (&program.functions[number as usize], program.function(l.body));
        let outside = |o: Operand| Spot::Register(number, o);
        let inside = |place, i| Spot::Register(l.body.0, Operand::new(place, i));
        let first = usize::from(l.over.is_some());
        let returned = l.exit.map(|exit| exit.1);
        let out: Vec<Operand> = f.operands[l.out.range()].iter().copied().chain(returned).collect();
        for (i, from) in f.operands[l.carried.range()].iter().enumerate() {
            self.flow(outside(*from), inside(Place::Node, first + i));
        }
        for (i, from) in f.operands[l.captures.range()].iter().enumerate() {
            self.alias(outside(*from), inside(Place::Outer, i + 1));
        }
        for op in &body.code[..body.body as usize] {
            let Op::ReturnIteration { args, .. } = *op else { continue };
            for (i, from) in body.operands[args.range()].iter().enumerate() {
                let from = Spot::Register(l.body.0, *from);
                out.get(i).into_iter().for_each(|to| self.flow(from, outside(*to)));
                if i < usize::from(l.carried.len) {
                    self.flow(from, inside(Place::Node, first + i));
                }
            }
        }
    }
}
