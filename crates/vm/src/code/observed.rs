//! The check whether observations have the probability of a single value or a density, as far as it is known
//! without a run.
//!
//! A site with a known family has the kind of that family. A site whose distribution is a value can have the
//! kinds of all distributions that may come there. If the site has a constant, these are the constant's.
//! Otherwise they are all distributions that the program makes, or has in an argument or in a constant that
//! other instructions read. A function of the host may return any distribution.

use super::{Function, Op, Operand, Place, Program, Site, SiteKind, Source};
use crate::value::Value;
use niwaki_math::{Dist, Family};
use std::collections::{BTreeSet, HashMap};

/// The most values of constants and arguments that are visited; beyond this limit both kinds are assumed.
const VISITED_VALUES: usize = 100_000;

/// The kinds that a set of distributions may have.
#[derive(Clone, Copy, Default)]
struct Possible {
    probability: bool,
    density: bool,
}

impl Possible {
    const EITHER: Possible = Possible { probability: true, density: true };

    fn is_either(self) -> bool {
        self.probability && self.density
    }

    fn add(&mut self, is_density: bool) {
        *(if is_density { &mut self.density } else { &mut self.probability }) = true;
    }

    fn or(self, other: Possible) -> Possible {
        Possible {
            probability: self.probability || other.probability,
            density: self.density || other.density,
        }
    }

    /// The kinds of the distributions that values hold.
    fn of<'v>(values: impl IntoIterator<Item = &'v Value>) -> Possible {
        let (mut kinds, mut left, mut work) = (Possible::default(), VISITED_VALUES, Vec::from_iter(values));
        while let Some(value) = work.pop() {
            left = left.saturating_sub(1);
            if left == 0 || kinds.is_either() {
                return Possible::EITHER;
            }
            match value {
                Value::Dist(dist) => kinds.add(is_density(dist)),
                Value::Returned(items) | Value::Tuple(items) => work.extend(items.items()),
                Value::List(list) => work.extend(list.iter().filter(|item| !item.is_plain())),
                Value::Dict(dict) => work.extend(dict.keys().iter().chain(dict.values())),
                Value::Record(record) => work.extend(&record.fields),
                Value::Function(closure) => work.extend(&closure.captures),
                _ => {}
            }
        }
        kinds
    }
}

/// Whether a value of a distribution has a density, and not a probability.
pub fn is_density(dist: &Dist) -> bool {
    match dist {
        Dist::Mixture(mixture) => mixture.components.first().is_some_and(is_density),
        other => other.family().space().is_continuous(),
    }
}

/// The hash of the text that a site observes: within an activation, two sites with the same text observe the
/// same value.
pub fn subject(site: &Site) -> u128 {
    if site.subject == 0 { site.key } else { site.subject }
}

/// Whether a run of a program may observe the same text with both kinds. `outside` are the values that come
/// from outside: arguments, and captures of the model. `held` says whether choices may be held, which are then
/// observed.
pub fn may_mix<'v>(program: &'v Program, outside: &[&'v Value], held: bool) -> bool {
    let mut values = None;
    let mut of_values = || *values.get_or_insert_with(|| of_values(program, outside));
    program.functions.iter().any(|f| {
        let mut kinds: HashMap<u128, Possible> = HashMap::new();
        f.sites.iter().any(|site| {
            let source = match site.kind {
                SiteKind::Observe(source) => source,
                SiteKind::Sample(source) if held => source,
                _ => return false,
            };
            let known = kinds.entry(subject(site)).or_default();
            *known = known.or(of_site(f, site, source).unwrap_or_else(&mut of_values));
            known.is_either()
        })
    })
}

/// The kinds of the distributions that can come to a site, if the site alone determines them.
fn of_site(f: &Function, site: &Site, source: Source) -> Option<Possible> {
    let Source::Family(family) = source else {
        let from = f.operands[site.args.range()].first()?;
        return (from.place() == Place::Constant).then(|| Possible::of(f.constants.get(from.index())));
    };
    of_family(family)
}

/// The kind of a family's distributions; `None` for a mixture, which has the kinds of its components.
fn of_family(family: Family) -> Option<Possible> {
    let mut kinds = Possible::default();
    kinds.add(family.space().is_continuous());
    (family != Family::Mixture).then_some(kinds)
}

/// The kinds of all distributions that are values in a run.
fn of_values(program: &Program, outside: &[&Value]) -> Possible {
    let written = program.functions.iter().flat_map(|f| &f.code).map(|op| match op {
        Op::Dist { family, .. } => of_family(*family).unwrap_or_default(),
        Op::Host { .. } => Possible::EITHER,
        _ => Possible::default(),
    });
    let known = program.functions.iter().flat_map(values_in).chain(outside.iter().copied());
    written.fold(Possible::default(), Possible::or).or(Possible::of(known))
}

/// The constants of a function that may reach any site: all except those that a site uses directly as its
/// distribution.
fn values_in(f: &Function) -> impl Iterator<Item = &Value> {
    let takes_distribution = |op: &Op| match op {
        Op::Site { site } => matches!(
            f.sites[site.0 as usize].kind,
            SiteKind::Sample(Source::Value | Source::Element)
                | SiteKind::Observe(Source::Value | Source::Element)
        ),
        _ => false,
    };
    let mut read: BTreeSet<usize> = BTreeSet::new();
    for op in &f.code {
        let operands = f.reads(op).into_iter().skip(takes_distribution(op) as usize);
        read.extend(operands.filter(|o| o.place() == Place::Constant).map(Operand::index));
    }
    let defaults = f.defaults.iter().filter(|o| o.place() == Place::Constant).map(|o| o.index());
    read.extend(defaults);
    read.into_iter().filter_map(|index| f.constants.get(index))
}

#[cfg(test)]
mod tests {
    //! The claim: a program passes the check only if no run can observe the same text with both kinds.

    use super::*;
    use crate::core::parse::parse;
    use crate::passes::compile;
    use niwaki_math::Param;
    use std::sync::Arc;

    const DELTA: &str = "(dist delta 1)";
    const NORMAL: &str = "(dist gaussian 0.0 1.0)";

    fn program(body: &str) -> Program {
        let text = format!(
            "(module (const 0 (list {NORMAL} {NORMAL})) (const 1 (list {DELTA} {DELTA}))
               (const 2 (list 1 (tuple {DELTA} (list {NORMAL}))))
               (fn \"m\" (params $d) (set $s (sample (dist bernoulli 0.5))) {body}) (entry \"m\"))"
        );
        compile(&parse(&text).unwrap(), vec![]).unwrap()
    }

    #[test]
    fn a_program_that_observes_one_kind_cannot_mix() {
        for body in [
            format!("(do (observe {NORMAL} 1.0)) (do (observe {DELTA} 1))"),
            "(do (observe (index (data 0) $s) 1.0)) (do (observe (index (data 1) $s) 2))".to_string(),
            format!("(set $d (cond $s {NORMAL} (dist uniform 0.0 1.0))) (do (observe $d 0.5))"),
            format!("(set $d (sample {DELTA}))"),
        ] {
            assert!(!may_mix(&program(&body), &[&Value::None], false), "{body}");
        }
    }

    #[test]
    fn a_program_that_may_observe_both_kinds_may_mix() {
        for body in [
            format!("(set $d (cond $s {NORMAL} {DELTA})) (do (observe $d 1))"),
            format!("(set $x 1) (if $s (then (do (observe {NORMAL} $x))) (else (do (observe {DELTA} $x))))"),
            format!("(do (observe (index (list {NORMAL} {DELTA}) $s) 1))"),
            "(do (observe (index (index (data 2) 1) 0) 1))".to_string(),
            "(do (observe (host 0 $s) 1))".to_string(),
            format!("(do (observe (dist mixture (list 1.0) (list (cond $s {NORMAL} {DELTA}))) 1))"),
        ] {
            assert!(may_mix(&program(&body), &[&Value::None], false), "{body}");
        }
    }

    #[test]
    fn arguments_and_held_choices_count() {
        let compiled = program(&format!("(set $n {NORMAL}) (do (observe $d 1)) (return $n)"));
        assert!(!may_mix(&compiled, &[&Value::None], false));
        let counts = Dist::new(Family::Poisson, &[Param::Real(2.0)]).unwrap();
        assert!(may_mix(&compiled, &[&Value::list(vec![Value::Dist(Arc::new(counts))])], false));

        let held = program(&format!("(set $x (sample (cond $s {NORMAL} {DELTA})))"));
        assert!(!may_mix(&held, &[&Value::None], false));
        assert!(may_mix(&held, &[&Value::None], true));
    }
}
