//! How long a search for the best goes on: a floor of work, patience in work, restarts, and an end where nothing can rise.
//!
//! The host knows two hills, of which the higher one is narrow. A call of it is dear, so that few calls are a floor.

use super::stopped::stopped;
use niwaki_geom::{Aabb, no_overshoot, vec3};
use niwaki_run::Task;
use niwaki_run::task::Hosts;
use niwaki_search::improve::{Improved, Step};
use niwaki_search::method::Info;
use niwaki_vm::core::parse::parse;
use niwaki_vm::fault::Fault;
use niwaki_vm::passes::compile;
use niwaki_vm::value::Value;
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Instructions of the floor, and of a call of the host.
const FLOOR: u64 = 3_000_000_000;
const HOST: u64 = FLOOR / 1000;

/// Two hills, with the number of calls.
#[derive(Default)]
struct Hills(AtomicU64);

impl Hosts for Hills {
    fn call(&self, _: u16, args: &[Value], _: &mut u64) -> Result<Value, Fault> {
        self.0.fetch_add(1, Ordering::Relaxed);
        let [Value::Real(x)] = args else { return Err(Fault::new("host-function", "a place is a number")) };
        Ok(Value::Real((1.0 - (x - 0.2).abs()).max(3.0 - 40.0 * (x - 0.9).abs())))
    }
}

fn task_of(body: &str, hosts: Arc<dyn Hosts>) -> Task {
    let text = format!(r#"(module (fn "m" (params) {body}) (entry "m"))"#);
    Task {
        hosts,
        ..Task::new(Arc::new(compile(&parse(&text).expect("core form"), vec![]).expect("a program")))
    }
}

fn hills() -> Task {
    task_of(
        r#"(set $x (sample (dist uniform 0.0 1.0))) (set $y (sample (dist uniform 0.0 1.0)))
           (do (factor (sub (mul 4.0 (host 0 $x)) $y))) (return $x)"#,
        Arc::new(Hills::default()),
    )
}

/// The report of a search and its best run, and the parts that it stored; it is stopped after `looks` looks.
fn searched(
    task: &Task,
    limit: &str,
    left: HashMap<u64, String>,
    looks: u64,
) -> (Improved, String, HashMap<u64, String>) {
    let method = format!(
        r#"{{"method": "improve", "particles": 20, "regrow": 4, "power": 1.0, {limit}, "seconds": null,
            "diverse": null, "proposal": null}}"#
    );
    let (result, stored) = stopped(task, &method, left, looks);
    let Info::Improved(info) = result.info else { panic!("of improve") };
    let best = &result.runs[0];
    let text = format!("{} {:?} {:?}", best.log_score.to_bits(), best.log, best.value);
    (info, text, stored)
}

fn whole(task: &Task, limit: &str) -> (Improved, String) {
    let (info, best, _) = searched(task, limit, HashMap::new(), u64::MAX);
    (info, best)
}

fn rounds(info: &Improved) -> Vec<(Step, u64, u64, u64)> {
    info.rounds.iter().map(|round| (round.step, round.work, round.parts, round.best.to_bits())).collect()
}

fn restarts(info: &Improved) -> usize {
    info.rounds.iter().filter(|round| round.step == Step::RESTART).count()
}

/// The first number of rounds after which a search has spent its floor and stands still.
fn end(info: &Improved, effort: f64) -> Option<usize> {
    let (mut total, mut idle) = (info.rounds[0].work, 0);
    for (number, pair) in info.rounds.windows(2).enumerate() {
        total += pair[1].work;
        let has_gained = pair[1].best - pair[0].best >= 0.01;
        idle = if has_gained || pair[1].step == Step::RESTART { 0 } else { idle + pair[1].work };
        let patience = (2 * info.rounds[0].work).max(FLOOR / 4 / info.price) as f64;
        let spent = (total * info.price) as f64;
        if number + 1 >= (15.0 * effort) as usize
            && spent >= FLOOR as f64 * effort
            && idle as f64 >= patience * effort
        {
            return Some(number + 1);
        }
    }
    None
}

#[test]
fn a_search_ends_when_the_floor_is_spent_and_the_best_stands_still() {
    for effort in [0.4, 0.5, 0.6] {
        let (info, _) = whole(&hills(), &format!(r#""rounds": null, "effort": {effort}"#));
        assert_eq!(end(&info, effort), Some(info.rounds.len() - 1), "{:?}", rounds(&info));
    }
}

/// Starts of equal work come first; then the search goes on from the best of them.
#[test]
fn a_search_goes_on_from_the_best_of_its_starts() {
    let (info, _) = whole(&hills(), r#""rounds": null, "effort": 0.5"#);
    let rounds = &info.rounds;
    let at: Vec<usize> = (0..rounds.len()).filter(|k| rounds[*k].step == Step::RESTART).collect();
    let starts = at.len().min(8);
    assert!(starts >= 3, "{at:?}");
    let works: Vec<u64> = std::iter::once(0)
        .chain(at[..starts].iter().copied())
        .zip(&at[..starts])
        .map(|(from, to)| rounds[from..*to].iter().map(|round| round.work).sum())
        .collect();
    // A start ends with the round in which it has had its work.
    let (least, most) = (works.iter().min().unwrap(), works.iter().max().unwrap());
    assert!(most < &(2 * least), "{works:?}");
    // The last of these rounds only takes up the best run: it has no population.
    assert!(rounds[at[starts - 1]].work < 10 && rounds[at[0]].work > 10, "{:?}", rounds[at[starts - 1]].work);
}

#[test]
fn a_thousand_calls_of_the_host_are_a_floor() {
    let hosts = Arc::new(Hills::default());
    let task = Task { hosts: hosts.clone(), ..hills() };
    let (info, _) = whole(&task, r#""rounds": null, "effort": 1.0"#);
    let calls = hosts.0.load(Ordering::Relaxed);
    assert!((400..4000).contains(&calls), "{calls} calls");
    assert!((HOST..2 * HOST).contains(&info.price), "{}", info.price);
    // Without dear calls, there is much more work in a floor.
    let plain = task_of(
        r#"(set $x (sample (dist uniform 0.0 1.0))) (do (factor $x)) (return $x)"#,
        Arc::new(Hills::default()),
    );
    let (cheap, _) = whole(&plain, r#""rounds": 1, "effort": 1.0"#);
    assert!(cheap.price < HOST / 100, "{}", cheap.price);
}

#[test]
fn restarts_follow_from_work_and_keep_the_best() {
    let (info, best) = whole(&hills(), r#""rounds": null, "effort": 8.0"#);
    assert!(restarts(&info) >= 2, "{:?}", rounds(&info));
    assert!(info.rounds.windows(2).all(|pair| pair[0].best <= pair[1].best));
    assert!(best.starts_with(&info.rounds[info.rounds.len() - 1].best.to_bits().to_string()));
    let (again, best_again) =
        whole(&hills(), &format!(r#""rounds": {}, "effort": 1.0"#, info.rounds.len() - 1));
    assert_eq!((rounds(&again), best_again), (rounds(&info), best));
}

#[test]
fn a_search_goes_on_after_its_restarts_with_the_same_bits() {
    let (info, best) = whole(&hills(), r#""rounds": 500, "effort": 1.0"#);
    assert!(restarts(&info) >= 2, "{}", restarts(&info));
    let (mut left, mut stops) = (HashMap::new(), 0);
    loop {
        let (part, text, stored) =
            searched(&hills(), r#""rounds": 500, "effort": 1.0"#, left.clone(), 120 * (1 + stops));
        left.extend(stored);
        stops += 1;
        if !part.interrupted {
            assert_eq!((rounds(&part), text), (rounds(&info), best));
            break;
        }
    }
    assert!(stops > 2, "{stops} pieces");
}

#[test]
fn a_search_ends_where_no_run_can_be_better() {
    let domain = Aabb { low: vec3(-2.0, -2.0, -2.0), high: vec3(2.0, 2.0, 2.0) };
    let within = |factor: &str| Task {
        sketches: vec![no_overshoot(domain, 2.0).expect("a sketch")],
        ..task_of(
            &format!(
                r#"(set $x (sample (dist uniform 0.1 4.0))) {factor}
                   (do (emit (box (tuple 0.0 0.0 0.0) (tuple $x 1.0 1.0)))) (return $x)"#
            ),
            Arc::new(Hills::default()),
        )
    };
    let (info, _) = whole(&within(""), r#""rounds": 12, "effort": 1.0"#);
    assert_eq!(info.rounds.len(), 1);
    // A factor may be higher in another run.
    let (info, _) = whole(&within("(do (factor 0.0))"), r#""rounds": 12, "effort": 1.0"#);
    assert_eq!(info.rounds.len(), 13);
}
