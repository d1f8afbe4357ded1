//! Inference inside a model: `infer(model, method, ...)`, dissertation 2.3.1.
//!
//! To the run around it an `infer` is a pure function of its model, its arguments and a seed: the seed is a choice of
//! that run, drawn where `infer` stands, so that a replay, a copy of a particle and a Markov chain treat it as they treat
//! every choice. The choices, factors and shapes of the inner runs are their own.
//!
//! The machine asks for it with the question `host`, as for any function that it cannot compute itself.

use crate::Failure;
use crate::chain;
use crate::chain::many::Chains;
use crate::enumeration::enumerate;
use crate::forward::forward;
use crate::importance::importance;
use crate::particles::{Order, Resampling, Settings, Weights, When, smc};
use crate::record::Record;
use crate::rejection::rejection;
use crate::task::{Hosts, Task};
use niwaki_math::Stream;
use niwaki_vm::code::{FunctionId, Program};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::Limits;
use niwaki_vm::machine::kept::Strategy;
use niwaki_vm::value::{Closure, Value, same};
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex, PoisonError};

/// The stream of the draw among weighted samples: no run and no lineage has this number.
const PICK: u64 = u64::MAX - 1;

/// How many `infer` may be inside one another. Each takes some of the host's stack.
const DEPTH: usize = 16;

/// What an `infer` gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// The value of one sample, drawn by weight.
    Sample,
    /// The value of the sample with the best log score.
    Best,
}

/// How an `infer` searches.
#[derive(Clone, Debug)]
pub enum Search {
    /// Every run: gives the list of the pairs (value, probability), most probable first.
    Enumerate {
        /// Most runs.
        max_runs: usize,
    },
    /// Rejection sampling.
    Rejection {
        /// How many samples.
        n: usize,
        /// No run scores above it, nats.
        bound: f64,
        /// Most runs.
        max_tries: u64,
    },
    /// Likelihood weighting.
    Importance {
        /// How many runs.
        n: usize,
    },
    /// Runs of the prior.
    Forward {
        /// How many runs.
        n: u64,
    },
    /// Particles.
    Smc(Settings),
    /// Markov chains.
    Mh {
        /// Proposals of each.
        steps: u64,
        /// How many.
        chains: usize,
        /// Their settings.
        settings: chain::Settings,
    },
}

/// A method and what is kept of its result.
#[derive(Clone, Debug)]
pub struct Method {
    /// How it searches.
    pub search: Search,
    /// What it gives.
    pub keep: Keep,
}

impl Method {
    /// Reads the constant that stands for a method: `("infer", keep, name, settings ...)`, the settings in the order of
    /// the Python class. `None` for any other constant.
    pub fn read(constant: &Value) -> Option<Method> {
        let Value::Tuple(tuple) = constant else { return None };
        let [mark, keep, name, settings @ ..] = tuple.items() else { return None };
        let text = |value: &Value| match value {
            Value::Str(text) => Some(text.to_string()),
            _ => None,
        };
        if text(mark)? != "infer" {
            return None;
        }
        let keep = match text(keep)?.as_str() {
            "sample" => Keep::Sample,
            "best" => Keep::Best,
            _ => return None,
        };
        let search = match (text(name)?.as_str(), settings) {
            ("enumerate", [Value::Int(max_runs)]) => {
                Search::Enumerate { max_runs: usize::try_from(*max_runs).ok()? }
            }
            ("rejection", [Value::Int(n), Value::Real(bound), Value::Int(max_tries)]) => Search::Rejection {
                n: usize::try_from(*n).ok()?,
                bound: *bound,
                max_tries: u64::try_from(*max_tries).ok()?,
            },
            ("importance", [Value::Int(n)]) => Search::Importance { n: usize::try_from(*n).ok()? },
            ("forward", [Value::Int(n)]) => Search::Forward { n: u64::try_from(*n).ok()? },
            ("mh", [Value::Int(steps), strategy, Value::Int(chains), Value::Int(tries)]) => Search::Mh {
                steps: u64::try_from(*steps).ok()?,
                chains: usize::try_from(*chains).ok()?,
                settings: chain::Settings {
                    strategy: match text(strategy)?.as_str() {
                        "rerun" => Strategy::Rerun,
                        "resume" => Strategy::Resume,
                        "cache" => Strategy::Cache,
                        "c3" => Strategy::C3,
                        _ => return None,
                    },
                    thin: 0,
                    tries: u64::try_from(*tries).ok()?,
                    ..chain::Settings::default()
                },
            },
            ("smc", [Value::Int(particles), order, weights, Value::Real(temper), resampling, ess]) => {
                Search::Smc(Settings {
                    particles: usize::try_from(*particles).ok()?,
                    order: Order::from_name(&text(order)?)?,
                    weights: Weights::from_name(&text(weights)?)?,
                    temper: *temper,
                    resampling: Resampling::from_name(&text(resampling)?)?,
                    when: match ess {
                        Value::None => When::Always,
                        Value::Real(share) => When::EffectiveBelow(*share),
                        Value::Int(share) => When::EffectiveBelow(*share as f64),
                        _ => return None,
                    },
                    ..Settings::default()
                })
            }
            _ => return None,
        };
        Some(Method { search, keep })
    }

    /// Runs the search of a task and gives what it keeps.
    ///
    /// # Errors
    /// What the search itself meets.
    pub fn value(&self, task: &Task, seed: u64) -> Result<Value, Failure> {
        match &self.search {
            Search::Enumerate { max_runs } => {
                let found = enumerate(task, *max_runs, &mut |_| true)?;
                if found.log_evidence == f64::NEG_INFINITY {
                    return Err(impossible());
                }
                let mut pairs: Vec<(Value, f64)> = found
                    .outcomes
                    .into_iter()
                    .map(|(value, log)| (value, (log - found.log_evidence).exp()))
                    .collect();
                // Stable: equally probable values keep their order of appearance.
                pairs.sort_by(|a, b| b.1.total_cmp(&a.1));
                let pair = |(value, p): (Value, f64)| Value::tuple(vec![value, Value::Real(p)]);
                Ok(Value::list(pairs.into_iter().map(pair).collect()))
            }
            Search::Forward { n } => {
                let runs =
                    (0..*n).map(|stream| forward(task, seed, stream, true)).collect::<Result<Vec<_>, _>>()?;
                self.kept(seed, runs.into_iter().map(|s| (s.value, s.record, 0.0)).collect())
            }
            Search::Rejection { n, bound, max_tries } => {
                let found = rejection(task, *n, *bound, *max_tries, seed, &mut |_| true)?;
                self.kept(seed, found.samples.into_iter().map(|s| (s.value, s.record, 0.0)).collect())
            }
            Search::Importance { n } => {
                let found = importance(task, *n, seed, &mut |_| true)?;
                let weighted = |s: crate::forward::Sample| {
                    let log_weight = s.record.log_score();
                    (s.value, s.record, log_weight)
                };
                self.kept(seed, found.samples.into_iter().map(weighted).collect())
            }
            Search::Mh { steps, chains, settings } => {
                let settings = chain::Settings { seed, ..settings.clone() };
                let mut found: Chains = Chains::start(task, &settings, *chains, None)?;
                found.advance(task, *steps, &|_, _| true)?;
                let score = |at: &usize| found.chains[*at].best_score();
                // The last state of a chain is a sample; one chain is as good as another.
                let chain = match self.keep {
                    Keep::Sample => found.chains.first(),
                    Keep::Best => (0..found.chains.len())
                        .max_by(|a, b| score(a).total_cmp(&score(b)))
                        .map(|at| &found.chains[at]),
                };
                let rung = chain.and_then(|chain| match self.keep {
                    Keep::Sample => chain.rungs.first(),
                    Keep::Best => chain.best(),
                });
                let Some(rung) = rung else { return Err(impossible()) };
                Ok(match self.keep {
                    Keep::Sample => rung.now(&task.program).facts.value,
                    Keep::Best => rung.best.get(&rung.state, task)?.facts.value,
                })
            }
            Search::Smc(settings) => {
                let found = smc(task, &Settings { seed, ..settings.clone() }, &mut |_| true)?;
                let samples = found.particles.into_iter().filter(|p| p.has_ended);
                self.kept(seed, samples.map(|p| (p.value, p.record, p.log_weight)).collect())
            }
        }
    }

    /// One of weighted samples.
    fn kept(&self, seed: u64, mut samples: Vec<(Value, Record, f64)>) -> Result<Value, Failure> {
        let score = |sample: &(Value, Record, f64)| sample.1.log_score();
        let most = samples.iter().map(|s| s.2).fold(f64::NEG_INFINITY, f64::max);
        if most == f64::NEG_INFINITY {
            return Err(impossible());
        }
        let at = match self.keep {
            Keep::Best => (0..samples.len())
                .fold(0, |best, at| if score(&samples[at]) > score(&samples[best]) { at } else { best }),
            Keep::Sample => {
                let weights: Vec<f64> = samples.iter().map(|s| (s.2 - most).exp()).collect();
                let mut left = Stream::new(seed, PICK, 0, 0).uniform() * weights.iter().sum::<f64>();
                let passed = weights.iter().position(|w| {
                    left -= w;
                    left < 0.0
                });
                // By rounding nothing may be left over at the end: then the last that is possible.
                passed.or_else(|| weights.iter().rposition(|w| *w > 0.0)).unwrap_or(0)
            }
        };
        Ok(samples.swap_remove(at).0)
    }
}

fn impossible() -> Failure {
    Failure::Impossible { barrier: 0, causes: vec![] }
}

/// Host functions and the inferences inside of a program.
#[derive(Clone)]
pub struct Inferences {
    /// The program whose functions are the inner models.
    pub program: Arc<Program>,
    /// Its methods, by the number of the constant.
    pub methods: Arc<HashMap<u16, Method>>,
    /// Its other host functions.
    pub hosts: Arc<dyn Hosts>,
    /// How much one inner run may use.
    pub limits: Limits,
    /// How many `infer` this one is inside of.
    pub depth: usize,
    /// The latest answers.
    pub known: Arc<Known>,
}

/// How many answers are remembered.
const REMEMBERED: usize = 16;

/// The latest answers, so that a call that is merely run again (a replay, a changed choice elsewhere in the same
/// activation) is not searched again. An inner search is a function of what it is given, so this changes no result.
#[derive(Default)]
pub struct Known(Mutex<VecDeque<Answered>>);

/// The constant, the arguments, the answer.
type Answered = (u16, Vec<Value>, Value);

impl Known {
    fn find(&self, constant: u16, args: &[Value]) -> Option<Value> {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let is_it = |(c, given, _): &&Answered| {
            *c == constant && given.len() == args.len() && given.iter().zip(args).all(|(a, b)| same(a, b))
        };
        known.iter().find(is_it).map(|(_, _, answer)| answer.clone())
    }

    fn remember(&self, constant: u16, args: &[Value], answer: &Value) {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.truncate(REMEMBERED - 1);
        known.push_front((constant, args.to_vec(), answer.clone()));
    }
}

impl Hosts for Inferences {
    fn call(&self, constant: u16, args: &[Value]) -> Result<Value, Fault> {
        let Some(method) = self.methods.get(&constant) else { return self.hosts.call(constant, args) };
        if let Some(answer) = self.known.find(constant, args) {
            return Ok(answer);
        }
        let given = args;
        let [model, args @ .., seed] = args else {
            return Err(Fault::argument_count("`infer` takes a model, its arguments and a seed"));
        };
        match (model, seed) {
            (Value::Function(model), Value::Int(seed)) => {
                let answer = self.infer(method, model, args, *seed as u64)?;
                self.known.remember(constant, given, &answer);
                Ok(answer)
            }
            _ => Err(Fault::not_callable(format!("`infer` runs a model, found {}", model.described()))),
        }
    }
}

impl Inferences {
    /// What an `infer` of that model with these arguments gives.
    ///
    /// # Errors
    /// Whatever keeps the search from finding anything, as a fault of the run around it.
    pub fn infer(
        &self,
        method: &Method,
        model: &Arc<Closure>,
        args: &[Value],
        seed: u64,
    ) -> Result<Value, Fault> {
        if args.iter().chain(&model.captures).any(holds_future) {
            return Err(Fault::type_mismatch("an argument of `infer` holds a future")
                .with_help("`force` it first: the inner run cannot wait for the outer one"));
        }
        if self.depth == DEPTH {
            return Err(Fault::new(
                "infer-failed",
                format!("more than {DEPTH} `infer` are inside one another"),
            ));
        }
        let task = Task {
            program: Arc::clone(&self.program),
            model: Some(Arc::clone(model)),
            args: args.to_vec(),
            sketches: vec![],
            hosts: Arc::new(Inferences { depth: self.depth + 1, known: Arc::default(), ..self.clone() }),
            limits: self.limits,
            invalid: Arc::default(),
        };
        let name = &self.program.function(FunctionId(model.function)).name;
        method.value(&task, seed).map_err(|failure| told(name, failure))
    }
}

/// The failure of an inner search as a fault of the run around it.
fn told(name: &str, failure: Failure) -> Fault {
    match failure {
        Failure::Run(inner) => {
            let line = inner.stack.last().map_or(0, |call| call.span.line);
            let message = format!("inside `infer` of `{name}`, at line {line}: {}", inner.fault.message);
            let fault = Fault::new(inner.fault.code, message);
            match &inner.fault.help {
                Some(help) => fault.with_help(help.clone()),
                None => fault,
            }
        }
        Failure::Setting(fault) if fault.code == "wrong-arity" => fault,
        Failure::Setting(fault) => {
            Fault::new("infer-failed", format!("`infer` of `{name}`: {}", fault.message))
        }
        Failure::Impossible { causes, .. } | Failure::NoStart { causes, .. } => {
            let causes: Vec<String> = causes.iter().map(|(cause, n)| format!("{cause} ({n})")).collect();
            let causes = if causes.is_empty() { String::new() } else { format!(": {}", causes.join(", ")) };
            Fault::new("infer-failed", format!("every run of `{name}` is impossible{causes}"))
        }
    }
}

/// Whether a value holds the handle of a future. A work list: values may be nested as deep as memory allows.
fn holds_future(value: &Value) -> bool {
    let mut open = vec![value];
    while let Some(value) = open.pop() {
        match value {
            Value::Future(_) => return true,
            Value::Tuple(tuple) => open.extend(tuple.items()),
            Value::List(list) => {
                open.extend(list.iter().filter(|item| !item.is_plain() || matches!(item, Value::Future(_))))
            }
            Value::Dict(dict) => open.extend(dict.values()),
            Value::Record(record) => open.extend(&record.fields),
            Value::Function(closure) => open.extend(&closure.captures),
            _ => {}
        }
    }
    false
}

#[cfg(test)]
mod tests {
    //! The claim: an `infer` gives a draw from the inner posterior, whatever the method, and the same draw for the same
    //! seed; what goes wrong inside is a fault outside.
    //!
    //! The inner model is a coin with p = 0.3 whose tails cost 1.5 nats: p(heads) = 0.3 / (0.3 + 0.7 exp(-1.5)). Each share
    //! is over 4,000 seeds and within 4.9 standard errors (one false alarm in a million); the bias of 200 weighted runs is
    //! below a tenth of one. The mutant that forgets the weights gives 0.3 and is rejected.

    use super::*;
    use crate::task::NoHosts;
    use niwaki_vm::core::parse::parse;
    use niwaki_vm::passes::compile;
    use niwaki_vm::value::repr;

    const SEEDS: u64 = 4000;

    fn posterior() -> f64 {
        0.3 / (0.3 + 0.7 * (-1.5f64).exp())
    }

    fn inferences(search: Search) -> Inferences {
        let text = r#"(module
            (fn "inner" (params $cost) (captures $p)
              (set $a (sample (dist bernoulli $p)))
              (do (factor (cond $a 0.0 $cost)))
              (return $a))
            (fn "never" (params) (do (condition (sample (dist bernoulli 0.0)))) (return none))
            (fn "broken" (params) (set $a (sample (dist bernoulli 0.5))) (return (div 1 0)))
            (fn "deep" (params) (return (host 0 (closure "deep") 1)))
            (fn "m" (params) (return (tuple (closure "inner" 0.3) (closure "never") (closure "broken") (closure "deep"))))
            (entry "m"))"#;
        let program = Arc::new(compile(&parse(text).unwrap(), vec![]).unwrap());
        Inferences {
            program,
            methods: Arc::new(HashMap::from([(0, Method { search, keep: Keep::Sample })])),
            hosts: Arc::new(NoHosts),
            limits: Limits::default(),
            depth: 0,
            known: Arc::default(),
        }
    }

    /// The function values that the program returns.
    fn models(inferences: &Inferences) -> Vec<Value> {
        let task = Task::new(Arc::clone(&inferences.program));
        let Value::Tuple(models) = forward(&task, 0, 0, true).unwrap().value else { panic!("not a tuple") };
        models.items().to_vec()
    }

    fn share(search: Search) -> f64 {
        let inferences = inferences(search);
        let inner = models(&inferences)[0].clone();
        let heads = (0..SEEDS).filter(|seed| {
            let args = [inner.clone(), Value::Real(-1.5), Value::Int(*seed as i64)];
            let value = inferences.call(0, &args).unwrap();
            assert_eq!(inferences.call(0, &args).unwrap(), value);
            value == Value::Bool(true)
        });
        heads.count() as f64 / SEEDS as f64
    }

    #[test]
    fn every_method_draws_from_the_inner_posterior() {
        let p = posterior();
        let error = 4.9 * (p * (1.0 - p) / SEEDS as f64).sqrt();
        let chain = chain::Settings { thin: 0, ..chain::Settings::default() };
        let methods = [
            Search::Rejection { n: 3, bound: 0.0, max_tries: 1000 },
            Search::Importance { n: 200 },
            Search::Smc(Settings { particles: 200, ..Settings::default() }),
            Search::Mh { steps: 60, chains: 2, settings: chain },
        ];
        for search in methods {
            let found = share(search.clone());
            assert!((found - p).abs() < error, "{search:?}: {found} for {p}");
        }
        // The prior, which is what a draw without weights would give.
        let prior = share(Search::Forward { n: 200 });
        assert!((prior - 0.3).abs() < error && (prior - p).abs() > error, "{prior}");
    }

    #[test]
    fn enumeration_gives_every_value() {
        let inferences = inferences(Search::Enumerate { max_runs: 10 });
        let inner = models(&inferences)[0].clone();
        let found = inferences.call(0, &[inner, Value::Real(-1.5), Value::Int(0)]).unwrap();
        let Value::List(pairs) = &found else { panic!("{found:?}") };
        assert!(repr(&found).unwrap().starts_with("[(True, "));
        let Value::Tuple(first) = pairs.get(0).unwrap() else { panic!("not a pair") };
        let Value::Real(p) = first.items()[1] else { panic!("not a number") };
        assert!((p - posterior()).abs() < 1e-9);
    }

    #[test]
    fn what_goes_wrong_inside_is_a_fault_outside() {
        let inferences = inferences(Search::Importance { n: 5 });
        let [inner, never, broken, deep] = &models(&inferences)[..] else { panic!("four models") };
        let code = |args: &[Value]| inferences.call(0, args).unwrap_err().code;
        assert_eq!(code(&[never.clone(), Value::Int(1)]), "infer-failed");
        assert_eq!(code(&[broken.clone(), Value::Int(1)]), "division-by-zero");
        assert_eq!(code(&[deep.clone(), Value::Int(1)]), "infer-failed");
        assert_eq!(code(&[inner.clone(), Value::Int(1)]), "wrong-arity");
        assert_eq!(code(&[Value::Int(3), Value::Int(1)]), "not-callable");
        let held = Value::list(vec![Value::Future(0)]);
        assert_eq!(code(&[inner.clone(), held, Value::Int(1)]), "type-mismatch");
        assert_eq!(inferences.call(7, &[]).unwrap_err().code, "host-function");
    }
}
