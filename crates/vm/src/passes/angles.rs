//! Which values are angles: those that flow into an angle, and those that come from one.
//!
//! An angle is what `sin`, `cos`, `tan` and `degrees` take, what turns something (`ellipse`, `rotation`, `rotate`), and
//! what `atan2`, `atan`, `asin`, `acos`, `radians` and a von Mises distribution give. It stays one in sums, differences and
//! with the other sign, through parameters, captures, returned values and loops, and from the location of a distribution
//! to its draw. The elements of tuples, lists and records are not followed, nor are calls of function values.

use crate::builtins::builtin;
use crate::code::{Binary, Function, FunctionId, Loop, Mode, Op, Operand, Place, Program, SiteKind, Source};
use niwaki_math::{Family, Scalar};
use std::collections::{HashMap, HashSet};

/// A register of a function, or what it returns.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Spot {
    Register(u32, Operand),
    Returned(u32),
}

impl Spot {
    /// Constants are shared by what has nothing to do with each other.
    fn is_constant(self) -> bool {
        matches!(self, Spot::Register(_, o) if o.place() == Place::Constant)
    }
}

/// Builtins that take an angle: the place of the argument.
const TAKES: [(&str, usize); 7] =
    [("sin", 0), ("cos", 0), ("tan", 0), ("degrees", 0), ("ellipse", 3), ("rotation", 1), ("rotate", 2)];

/// Builtins that give an angle.
const GIVES: [&str; 5] = ["atan2", "atan", "asin", "acos", "radians"];

/// Builtins whose result is an angle where these arguments are.
const PASSES: [(&str, &[usize]); 8] = [
    ("pos", &[0]),
    ("float", &[0]),
    ("clip", &[0, 1, 2]),
    ("lerp", &[0, 1]),
    ("min", &[0, 1]),
    ("max", &[0, 1]),
    ("fmod", &[0, 1]),
    ("abs", &[0]),
];

/// What flows where.
#[derive(Default)]
struct Flows {
    flows: Vec<(Spot, Spot)>,
    taken: HashSet<Spot>,
    given: HashSet<Spot>,
}

/// Marks the angles among the variables that choices can read, and among the choices.
pub(super) fn mark<S: Scalar>(program: &mut Program<S>) {
    let mut flows = Flows::default();
    (0..).zip(&program.functions).for_each(|(number, f)| flows.function(program, number, f));
    let (forward, backward): (Vec<_>, Vec<_>) =
        flows.flows.iter().map(|(from, to)| ((*from, *to), (*to, *from))).unzip();
    let mut angles = closure(flows.given, &forward);
    angles.extend(closure(flows.taken, &backward));
    for (number, f) in (0..).zip(&mut program.functions) {
        f.scope.iter_mut().for_each(|x| x.is_angle = angles.contains(&Spot::Register(number, x.at)));
        f.sites.iter_mut().for_each(|site| {
            site.is_angle = angles.contains(&Spot::Register(number, site.to));
        });
    }
}

/// What can be reached from these.
fn closure(mut found: HashSet<Spot>, edges: &[(Spot, Spot)]) -> HashSet<Spot> {
    let mut next: HashMap<Spot, Vec<Spot>> = HashMap::new();
    edges.iter().for_each(|(from, to)| next.entry(*from).or_default().push(*to));
    let mut waiting: Vec<Spot> = found.iter().copied().collect();
    while let Some(spot) = waiting.pop() {
        for to in next.get(&spot).into_iter().flatten() {
            if found.insert(*to) {
                waiting.push(*to);
            }
        }
    }
    found
}

/// The arguments of a family that say where its values lie.
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
                    self.flow(Spot::Returned(u32::from(function)), at(to));
                }
                Op::Closure { function, args, .. } => {
                    let id = FunctionId(u32::from(function));
                    let captures = usize::from(program.function(id).params);
                    self.call(program, id, captures, number, &f.operands[args.range()]);
                }
                Op::Return { a } => self.flow(at(a), Spot::Returned(number)),
                Op::Site { site } => {
                    let site = &f.sites[site.0 as usize];
                    let args = &f.operands[site.args.range()];
                    match &site.kind {
                        SiteKind::Call { function } | SiteKind::Future { function, .. } => {
                            self.call(program, *function, 0, number, args);
                            self.flow(Spot::Returned(function.0), at(site.to));
                        }
                        SiteKind::Force | SiteKind::Memoise { .. } => self.flow(at(args[0]), at(site.to)),
                        SiteKind::Sample(Source::Family(family)) => {
                            if *family == Family::VonMises {
                                self.given.insert(at(site.to));
                                self.taken
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
            self.flows.push((from, to));
        }
    }

    /// One variable, in two functions.
    fn same(&mut self, outside: Spot, inside: Spot) {
        self.flow(outside, inside);
        if !outside.is_constant() {
            self.flow(inside, outside);
        }
    }

    fn builtin(&mut self, name: &str, to: Spot, arg: &dyn Fn(usize) -> Option<Spot>) {
        let taken = TAKES.iter().filter(|known| known.0 == name).filter_map(|known| arg(known.1));
        self.taken.extend(taken.filter(|spot| !spot.is_constant()));
        self.given.extend(GIVES.iter().filter(|known| **known == name).map(|_| to));
        for (_, places) in PASSES.iter().filter(|known| known.0 == name) {
            places.iter().filter_map(|place| arg(*place)).for_each(|from| self.flow(from, to));
        }
    }

    /// Arguments to the inputs of a function from that one on.
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
            if i < usize::from(callee.params) { self.flow(from, to) } else { self.same(from, to) }
        }
    }

    /// Values go into a loop, around it, and out of it.
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
            self.same(outside(*from), inside(Place::Outer, i + 1));
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
