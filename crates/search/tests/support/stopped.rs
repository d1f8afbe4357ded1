//! Searches that are stopped, and go on from what they stored.

use niwaki_run::Task;
use niwaki_run::checkpoint::Checkpoint;
use niwaki_search::improve::Outputs;
use niwaki_search::method::{Inputs, Method, Results};
use std::collections::HashMap;

/// The result of a method and the parts that it stored; it is stopped after `looks` looks, and stored in each round.
pub fn stopped(
    task: &Task,
    method: &str,
    left: HashMap<u64, String>,
    looks: u64,
) -> (Results, HashMap<u64, String>) {
    let method = Method::read(method).expect("a method");
    let checkpoint = Checkpoint::of(left);
    let outputs = Outputs { checkpoint: Some(&checkpoint), ..Outputs::default() };
    let mut looked = 0;
    let inputs = Inputs { seed: 3, outputs, ..Inputs::default() };
    let result = method.search(&task.uncounted(), &inputs, &mut |_, _, _| {
        checkpoint.ask();
        looked += 1;
        looked <= looks
    });
    (result.expect("a search"), checkpoint.collect().0)
}
