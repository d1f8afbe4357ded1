//! Inference inside a model: `infer(model, method, ...)`, dissertation 2.3.1.
//!
//! For the run around it, an `infer` is a pure function of its model, its arguments and a seed. The seed is a choice of
//! that run, drawn at the call of `infer`. So a replay, a copy of a particle and a Markov chain treat it like
//! every choice. The choices, factors and shapes of the inner runs are not part of the outer run.
//!
//! The machine calls an `infer` by the question `host`, like any function that it cannot compute itself.

use crate::method::{Info, Inputs, Method, Mh};
use niwaki_chain::many::Chains;
use niwaki_run::Failure;
use niwaki_run::inside::{Inside, fault_of, limits_inside, too_long};
use niwaki_run::run::Run;
use niwaki_run::streams::Reserved;
use niwaki_run::task::{Hosts, Task};
use niwaki_run::weights::Normalised;
use niwaki_vm::code::{FunctionId, Program};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::{Limits, SharedSteps};
use niwaki_vm::value::{Closure, Value, identical};
use std::any::Any;
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex};

/// The part of a search's result that an `infer` returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// The value of a sample, drawn by weight.
    Sample,
    /// The value of the sample with the best log score.
    Best,
}

/// A method, and the part of its result to return.
#[derive(Clone, Debug)]
pub struct Inner {
    /// The method of the search.
    pub method: Method,
    /// The part of the result to return.
    pub keep: Keep,
}

impl Inner {
    /// Reads the constant of an inference: `("infer", keep, text of the method)`. `None` for any other
    /// constant.
    ///
    /// # Errors
    /// A text that is no method, or a setting that has no meaning inside a model.
    pub fn read(constant: &Value) -> Option<Result<Inner, Fault>> {
        let Value::Tuple(tuple) = constant else { return None };
        let [Value::Str(mark), Value::Str(keep), Value::Str(text)] = tuple.items() else { return None };
        let keep = match (&**mark, &**keep) {
            ("infer", "sample") => Keep::Sample,
            ("infer", "best") => Keep::Best,
            _ => return None,
        };
        let method = Method::read(text).and_then(|method| method.check_inside().map(|()| method));
        Some(method.map(|method| Inner { method, keep }))
    }

    /// Searches a task and returns the part of the result to keep.
    ///
    /// # Errors
    /// The failure of the search.
    pub fn value(&self, task: &Task, seed: u64) -> Result<Value, Failure> {
        let inputs = Inputs { seed, ..Inputs::default() };
        if let Method::Mh(mh) = &self.method {
            return self.of_chains(task, mh, &inputs);
        }
        let result = self.method.search(task, &inputs, &mut |_, _, _| true)?;
        match result.info {
            Info::Enumeration(exact) => {
                let probability = |(value, log): (Value, f64)| (value, (log - exact.log_evidence).exp());
                let mut pairs: Vec<(Value, f64)> = exact.outcomes.into_iter().map(probability).collect();
                // The sort is stable: equally probable values keep their order of appearance.
                pairs.sort_by(|a, b| b.1.total_cmp(&a.1));
                let pair = |(value, p): (Value, f64)| Value::tuple(vec![value, Value::Real(p)]);
                Ok(Value::list(pairs.into_iter().map(pair).collect()))
            }
            _ => self.pick(seed, result.runs),
        }
    }

    /// The last or the best state of Markov chains. The last state of a chain is a sample; the chains are equally good.
    fn of_chains(&self, task: &Task, mh: &Mh, inputs: &Inputs<'_>) -> Result<Value, Failure> {
        let settings = niwaki_chain::Settings { thin: 0, ..mh.settings(inputs)? };
        let mut search: Chains = Chains::start(task, &settings, mh.chains, None)?;
        search.advance(task, mh.steps, &|_, _| true)?;
        let score = |at: &usize| search.chains[*at].best_score();
        match self.keep {
            Keep::Sample => {
                let first = search.chains.first().and_then(|chain| chain.rungs.first());
                first.map(|rung| rung.now(&task.program).value).ok_or_else(impossible)
            }
            Keep::Best => {
                let best = (0..search.chains.len()).max_by(|a, b| score(a).total_cmp(&score(b)));
                let rung = best.and_then(|at| search.chains[at].best()).ok_or_else(impossible)?;
                Ok(rung.best.get(&rung.state, task)?.value)
            }
        }
    }

    /// The value of a run picked from weighted runs.
    fn pick(&self, seed: u64, mut runs: Vec<Run>) -> Result<Value, Failure> {
        runs.retain(|run| run.has_ended);
        let mut weights = Normalised::default();
        if !weights.read(runs.iter().map(|run| run.log_weight)) {
            return Err(impossible());
        }
        let at = match self.keep {
            Keep::Best => (0..runs.len())
                .fold(0, |best, at| if runs[at].log_score > runs[best].log_score { at } else { best }),
            Keep::Sample => weights.index(Reserved::Pick.stream(seed, 0, 0).uniform()),
        };
        Ok(runs.swap_remove(at).value)
    }
}

fn impossible() -> Failure {
    Failure::impossible(0, std::iter::empty())
}

/// The host functions and the inferences of a program.
#[derive(Clone)]
pub struct Inferences {
    /// The program whose functions are the inner models.
    pub program: Arc<Program>,
    /// The methods, by the number of the constant.
    pub methods: Arc<HashMap<u16, Inner>>,
    /// The other host functions.
    pub hosts: Arc<dyn Hosts>,
    /// The limits of an inner run.
    pub limits: Limits,
    /// The number of `infer` calls around this one.
    pub depth: usize,
    /// The latest answers.
    pub known: Arc<Known>,
}

/// Number of answers that are remembered.
const REMEMBERED: usize = 16;

/// Most bytes of a remembered answer with its arguments.
const REMEMBERED_BYTES: usize = 1 << 20;

/// The latest answers. If a call is run again (in a replay, or after another choice of its activation changed), its answer is
/// looked up and not searched again. An inner search is a function of its inputs, so this changes no result.
///
/// No thread waits for this lock: while another thread holds it, a call is searched again. After a fork that thread may not
/// exist.
#[derive(Default)]
pub struct Known(Mutex<VecDeque<Answered>>);

/// The constant, the arguments, the answer, and its number of steps.
type Answered = (u16, Vec<Value>, Value, u64);

impl Known {
    fn find(&self, constant: u16, args: &[Value]) -> Option<(Value, u64)> {
        let known = self.0.try_lock().ok()?;
        let matches = |(c, stored, ..): &&Answered| {
            *c == constant
                && stored.len() == args.len()
                && stored.iter().zip(args).all(|(a, b)| identical(a, b))
        };
        known.iter().find(matches).map(|(_, _, answer, steps)| (answer.clone(), *steps))
    }

    fn remember(&self, constant: u16, args: &[Value], (answer, steps): (&Value, u64)) {
        if let Ok(mut known) = self.0.try_lock() {
            known.truncate(REMEMBERED - 1);
            known.push_front((constant, args.to_vec(), answer.clone(), steps));
        }
    }
}

impl Hosts for Inferences {
    fn raised(&self) -> Option<Box<dyn Any + Send>> {
        self.hosts.raised()
    }

    fn inference(&self, constant: u16) -> Option<Inside> {
        self.methods.get(&constant).map(|inner| match inner.method {
            Method::EnumerateAll { max_runs, .. } => Inside::Enumeration { max_runs },
            _ => Inside::Random,
        })
    }

    fn call(&self, constant: u16, args: &[Value], steps: &mut u64) -> Result<Value, Fault> {
        let Some(method) = self.methods.get(&constant) else {
            return self.hosts.call(constant, args, steps);
        };
        if let Some((answer, answer_steps)) = self.known.find(constant, args) {
            // The call takes the steps of its search, so that limits do not depend on what is remembered.
            *steps = steps.saturating_add(answer_steps);
            return Ok(answer);
        }
        let all_args = args;
        let [model, args @ .., seed] = args else {
            return Err(Fault::argument_count("`infer` takes a model, its arguments and a seed"));
        };
        match (model, seed) {
            (Value::Function(model), Value::Int(seed)) => {
                let together = Arc::new(SharedSteps::new(self.limits.steps.saturating_sub(*steps)));
                let answer = self.infer(method, model, args, *seed as u64, &together)?;
                let answer_steps = together.used();
                *steps = steps.saturating_add(answer_steps);
                if all_args.iter().chain([&answer]).map(Value::own_bytes).sum::<usize>() <= REMEMBERED_BYTES {
                    self.known.remember(constant, all_args, (&answer, answer_steps));
                }
                Ok(answer)
            }
            _ => Err(Fault::not_callable(format!("`infer` runs a model, found {}", model.described()))),
        }
    }
}

impl Inferences {
    /// The value of an `infer` of this model with these arguments. All of its runs together take their steps from the rest in
    /// `together`; they have a quarter of the memory of the run around them, or `SMALLEST`.
    ///
    /// # Errors
    /// The failure of the search, as a fault of the run around it.
    pub fn infer(
        &self,
        method: &Inner,
        model: &Arc<Closure>,
        args: &[Value],
        seed: u64,
        together: &Arc<SharedSteps>,
    ) -> Result<Value, Fault> {
        Value::Function(Arc::clone(model)).refuse_memoised()?;
        args.iter().try_for_each(Value::refuse_memoised)?;
        let limits = limits_inside(self.limits, self.depth)?;
        let task = Task {
            program: Arc::clone(&self.program),
            model: Some(Arc::clone(model)),
            args: args.to_vec(),
            sketches: vec![],
            held: None,
            hosts: Arc::new(Inferences {
                depth: self.depth + 1,
                known: Arc::default(),
                limits,
                ..self.clone()
            }),
            limits,
            together: Some(together.clone()),
            invalid: Arc::default(),
        };
        let name = &self.program.function(FunctionId(model.function)).name;
        method.value(&task, seed).map_err(|failure| {
            // Any of the parallel runs may be the one that meets the bound, but the message is always equal.
            if together.is_spent() { too_long(name, self.limits.steps) } else { fault_of(name, failure) }
        })
    }
}

#[cfg(test)]
mod tests {
    //! With every method, an `infer` gives a draw from the inner posterior, and equal draws for equal seeds. A failure
    //! inside is a fault outside.
    //!
    //! The inner model is a coin with p = 0.3 whose tails cost 1.5 nats: p(heads) = 0.3 / (0.3 + 0.7 exp(-1.5)). Each share
    //! is over 4,000 seeds and within 4.9 standard errors (one false alarm in a million). The bias of 200 weighted runs is
    //! below a tenth of a standard error. A mutant that forgets the weights gives 0.3 and is rejected.

    use super::*;
    use niwaki_run::forward::forward;
    use niwaki_run::task::NoHosts;
    use niwaki_vm::core::parse::parse;
    use niwaki_vm::passes::compile;
    use niwaki_vm::value::repr;

    const SEEDS: u64 = 4000;

    fn posterior() -> f64 {
        0.3 / (0.3 + 0.7 * (-1.5f64).exp())
    }

    fn inferences(method: &str) -> Inferences {
        let text = r#"(module
            (fn "inner" (params $cost) (captures $p)
              (set $a (sample (dist bernoulli $p)))
              (do (factor (cond $a 0.0 $cost)))
              (return $a))
            (fn "never" (params) (do (condition (sample (dist bernoulli 0.0)))) (return none))
            (fn "broken" (params) (set $a (sample (dist bernoulli 0.5))) (return (div 1 0)))
            (fn "deep" (params) (return (host 0 (closure "deep") 1)))
            (fn "flat" (params) (return (sample (dist gaussian 0.0 -1.0))))
            (fn "m" (params) (return (tuple
              (closure "inner" 0.3) (closure "never") (closure "broken") (closure "deep") (closure "flat"))))
            (entry "m"))"#;
        let program = Arc::new(compile(&parse(text).unwrap(), vec![]).unwrap());
        Inferences {
            program,
            methods: Arc::new(HashMap::from([(0, inner(method).unwrap().unwrap())])),
            hosts: Arc::new(NoHosts),
            limits: Limits::default(),
            depth: 0,
            known: Arc::default(),
        }
    }

    fn inner(method: &str) -> Option<Result<Inner, Fault>> {
        Inner::read(&Value::tuple(vec![Value::str("infer"), Value::str("sample"), Value::str(method)]))
    }

    /// The function values that the program returns.
    fn models(inferences: &Inferences) -> Vec<Value> {
        let task = Task::new(Arc::clone(&inferences.program));
        let Value::Tuple(models) = forward(&task, 0, 0, true).unwrap().value else { panic!("not a tuple") };
        models.items().to_vec()
    }

    /// The share of heads; equal seeds give equal values.
    fn share(method: &str) -> f64 {
        let inferences = inferences(method);
        let inner = models(&inferences)[0].clone();
        let heads = (0..SEEDS).filter(|seed| {
            let args = [inner.clone(), Value::Real(-1.5), Value::Int(*seed as i64)];
            let value = inferences.call(0, &args, &mut 0).unwrap();
            assert!(*seed > 100 || inferences.call(0, &args, &mut 0).unwrap() == value);
            value == Value::Bool(true)
        });
        heads.count() as f64 / SEEDS as f64
    }

    #[test]
    fn every_method_draws_from_the_inner_posterior() {
        let p = posterior();
        let error = 4.9 * (p * (1.0 - p) / SEEDS as f64).sqrt();
        let smc = |more: &str| {
            let plain = r#""populations": null, "diverse": null, "seconds": null, "chains": 1,
                "order": "stochastic", "weights": "ratio", "power": 1, "resampling": "residual", "ess": 0.5"#;
            format!(r#"{{"method": "smc", {plain}, {more}}}"#)
        };
        let mh = |kernel: &str, warmup: u32| {
            let plain =
                r#""steps": 60, "strategy": "c3", "chains": 2, "thin": null, "keep": null, "tries": 1000"#;
            format!(r#"{{"method": "mh", {plain}, "kernel": {kernel}, "warmup": {warmup}}}"#)
        };
        let methods = [
            r#"{"method": "rejection", "n": 3, "bound": 0.0, "max_tries": 1000}"#.to_string(),
            r#"{"method": "importance", "n": 200}"#.to_string(),
            smc(r#""particles": 200, "rejuvenate": null, "moves": 1, "at": 1, "draws": null, "anneal": null"#),
            smc(r#""particles": [150, 150], "rejuvenate": null, "moves": 1, "at": 1, "draws": null, "anneal": [0.5, 1]"#),
            smc(r#""particles": 200, "rejuvenate": {"name": "prior"}, "moves": 2, "at": "end", "draws": 4, "anneal": null"#),
            mh("null", 10),
            mh(r#"{"name": "repeat", "settings": {"times": 2}, "parts": [{"name": "by_family"}, {"name": "prior"}]}"#, 0)
                .replace(r#", {"name": "prior"}"#, ""),
            r#"{"method": "pimh", "particles": 20, "sweeps": 20, "order": "stochastic", "power": 1.0, "ess": null,
                "anneal": null, "resampling": "systematic"}"#.to_string(),
            r#"{"method": "particle_gibbs", "particles": 20, "sweeps": 20, "order": "depth-first", "power": 1.0,
                "ess": null, "anneal": null, "ancestors": true}"#.to_string(),
        ];
        // On a single thread, since small searches gain nothing from more.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        for method in methods {
            let heads = pool.install(|| share(&method));
            assert!((heads - p).abs() < error, "{method}: {heads} for {p}");
        }
        // The prior is the result of a draw without weights.
        let prior = share(r#"{"method": "forward", "n": 200}"#);
        assert!((prior - 0.3).abs() < error && (prior - p).abs() > error, "{prior}");
    }

    #[test]
    fn enumeration_gives_every_value() {
        let inferences =
            inferences(r#"{"method": "enumerate_all", "max_runs": 10, "likely": false, "rest": 0}"#);
        let inner = models(&inferences)[0].clone();
        let value = inferences.call(0, &[inner, Value::Real(-1.5), Value::Int(0)], &mut 0).unwrap();
        let Value::List(pairs) = &value else { panic!("{value:?}") };
        assert!(repr(&value).unwrap().starts_with("[(True, "));
        let Value::Tuple(first) = pairs.get(0).unwrap() else { panic!("not a pair") };
        let Value::Real(p) = first.items()[1] else { panic!("not a number") };
        assert!((p - posterior()).abs() < 1e-9);
    }

    #[test]
    fn failures_inside_are_faults_outside() {
        let inferences = inferences(r#"{"method": "importance", "n": 5}"#);
        let [inner, never, broken, deep, flat] = &models(&inferences)[..] else { panic!("five models") };
        let code = |args: &[Value]| inferences.call(0, args, &mut 0).unwrap_err().code;
        // The run around is invalid only if all of the inner runs are invalid.
        let is_invalid = |model: &Value| {
            inferences.call(0, &[model.clone(), Value::Int(1)], &mut 0).unwrap_err().invalid.is_some()
        };
        assert_eq!([flat, never, broken, deep].map(is_invalid), [true, false, false, false]);
        assert_eq!(code(&[never.clone(), Value::Int(1)]), "infer-failed");
        assert_eq!(code(&[broken.clone(), Value::Int(1)]), "division-by-zero");
        assert_eq!(code(&[deep.clone(), Value::Int(1)]), "infer-failed");
        assert_eq!(code(&[inner.clone(), Value::Int(1)]), "wrong-arity");
        assert_eq!(code(&[Value::Int(3), Value::Int(1)]), "not-callable");
        assert_eq!(inferences.call(7, &[], &mut 0).unwrap_err().code, "host-function");
    }

    #[test]
    fn settings_without_meaning_inside_are_refused() {
        let mh = |thin: &str, keep: &str| {
            let plain =
                r#""steps": 9, "strategy": "c3", "chains": 1, "warmup": 0, "tries": 9, "kernel": null"#;
            inner(&format!(r#"{{"method": "mh", {plain}, "thin": {thin}, "keep": {keep}}}"#)).unwrap()
        };
        assert!(mh("null", "null").is_ok());
        for refused in [mh("2", "null"), mh("null", "5"), inner(r#"{"method": "walk"}"#).unwrap()] {
            assert!(matches!(refused.unwrap_err().code, "infer-method" | "bad-setting"));
        }
        let more = r#"{"method": "importance", "n": 5, "m": 6}"#;
        assert!(inner(more).unwrap().unwrap_err().message.contains("`m`"));
        assert!(Inner::read(&Value::Int(3)).is_none());
    }
}
