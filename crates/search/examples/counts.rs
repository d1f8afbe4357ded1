//! Paths whose instructions `make counts` counts, under callgrind: one path, repeated.
//!
//!     counts PATH REPEATS [FOLDER]     prints the number of units of work
//!
//! Two counts of instructions with different repeats give the cost of a unit: start and compilation cancel. The program runs
//! on one thread. Paths that grow a gallery model read it from FOLDER, into which `benches/counts.py` has written it.

mod programs;

#[path = "programs/densities.rs"]
mod densities;
#[path = "../tests/guided/guides.rs"]
#[allow(dead_code)] // One of its guides is used.
mod guides;

use niwaki_chain::kernel::Kernel;
use niwaki_continuous::hamiltonian;
use niwaki_continuous::hamiltonian::chains::{Length, run};
use niwaki_geom::{
    Bark, Frame, Look, Mat3, Primitive, Rule, Shape, Sketches, Target, TriMesh, match_volume,
    no_self_intersection, vec3,
};
use niwaki_grad::Compiled;
use niwaki_propose::importance::importance;
use niwaki_run::Task;
use niwaki_search::method::{Inputs, Method};
use niwaki_vm::core::parse::parse;
use niwaki_vm::passes::compile;
use niwaki_vm::value::{List, Value};
use serde_json::Value as Json;
use std::path::Path;
use std::sync::Arc;

/// Runs a path and returns the units of work in these repeats.
fn work(path: &str, repeats: u64, folder: &Path) -> u64 {
    match path.split_once(' ').expect("two words") {
        ("step", "hmm") => steps(&programs::hmm(), 1000, repeats),
        ("step", "branching") => steps(programs::BRANCHING, 300, repeats),
        ("proposal", name) => proposals(name, repeats),
        ("leapfrog", model) => leapfrogs(model, repeats),
        ("part", kind) => parts(kind, repeats),
        ("choice", "guided") => guided(repeats),
        ("grow", model) => grow(model, repeats, folder),
        _ => panic!("no path `{path}`"),
    }
}

/// Steps of particles, depth first.
fn steps(text: &str, particles: usize, runs: u64) -> u64 {
    let task = programs::task(text);
    (0..runs).map(|seed| programs::particle_steps(&task, particles, seed) as u64).sum()
}

/// Proposals of a chain of 100 observations.
fn proposals(name: &str, count: u64) -> u64 {
    let all = programs::of_chains(100);
    let (_, text) = all.iter().find(|(known, _)| *known == name).expect("a known program");
    let task = programs::task(text);
    programs::chain(name, &task).advance(&task, count, &mut |_, _| true).expect("proposals");
    count
}

/// Leapfrog steps over a stack of blocks or a colouring, in machine code.
fn leapfrogs(model: &str, draws: u64) -> u64 {
    let mut compiled = Compiled::new(Arc::new(densities::density(model)));
    compiled.finish();
    let settings = hamiltonian::Settings {
        length: Length::Fixed { steps: 20, jitter: 0.0 },
        warmup: 0,
        draws: draws as u32,
        shape: hamiltonian::Shape::Unit,
        step_size: Some(1e-3),
        ..hamiltonian::Settings::hmc()
    };
    let target = densities::Target(compiled);
    let chain = hamiltonian::Chain::new(target, &densities::first_point(model), &settings, 1, 0);
    run(chain.expect("a point of it"), &settings, &|_| true).gradients
}

/// Shapes of one kind, each made, added to a copy of both sketches, and scored.
fn parts(kind: &str, count: u64) -> u64 {
    let look = Look::default();
    let block = Shape::cuboid(vec3(0.0, 0.0, 0.0), vec3(12.0, 4.0, 12.0), &look).expect("a block");
    let target = Target::new(block.world_mesh().clone(), 0.25).expect("a target");
    let specs = [no_self_intersection(Rule::Solid), match_volume(Arc::new(target), 0.02).expect("a sketch")];
    let mut sketches = Sketches::start(&specs);
    for k in 0..count {
        // A lattice without common points, in its order again and again.
        if k % 64 == 0 {
            sketches = Sketches::start(&specs);
        }
        let [i, j] = [k % 8, k / 8 % 8].map(|n| n as f64 * 1.4 - 4.9);
        let (at, along) = (vec3(i, 0.1, j), vec3(0.3, 1.0, 0.2));
        let end = vec3(i + 0.2, 1.3, j + 0.1);
        let shape = match kind {
            "box" => Shape::cuboid(at, vec3(1.1, 1.3, 0.9), &look),
            "turned box" => {
                let rotation = Mat3::rotation(vec3(0.6, 0.8, 0.0), 0.4);
                let look = Look { rotation: Some(rotation), ..look.clone() };
                Shape::cuboid(at, vec3(0.8, 0.9, 0.7), &look)
            }
            "tapered box" => Shape::tapered_box(at, vec3(1.1, 1.3, 0.9), 0.6, 1, &look),
            "cylinder" => Shape::cylinder(at, 0.5, 1.3, vec3(0.0, 1.0, 0.0), None, &look),
            "limb" => Shape::limb(at, end, (0.5, 0.3), (None, Some(along)), &look),
            "segment" => {
                let ring = |t: f64, radius| Frame {
                    center: vec3(i + 0.1 * t, 0.1 + 1.2 * t, j),
                    forward: vec3(0.0, 1.0, 0.0),
                    up: vec3(1.0, 0.0, 0.0),
                    radius,
                };
                Shape::segment([ring(0.0, 0.5), ring(0.5, 0.4), ring(1.0, 0.3)], None::<Bark>, &look)
            }
            _ => panic!("no shape `{kind}`"),
        };
        let mut next = sketches.fork();
        next.add(&Primitive::new(vec![shape.expect("a shape")]));
        std::hint::black_box(next.log_score());
        sketches = next;
    }
    count
}

/// Choices that a guide draws in runs of the branching program.
fn guided(runs: u64) -> u64 {
    let task = programs::task(programs::BRANCHING);
    let guide = Kernel::guided(guides::random(&task, 1, guides::MILD));
    let proposal = guide.proposal().expect("a proposal");
    let result = importance(&task, Some(&proposal), runs as usize, 1, &mut |_| true).expect("runs");
    result.runs.iter().map(|run| run.log.entries().len() as u64).sum()
}

/// A constant of a model: a number, or the name of a kind with its parts.
fn value(data: &Json) -> Value {
    let parts = |list: &Json| list.as_array().expect("a list").iter().map(value).collect::<Vec<Value>>();
    match data {
        Json::Number(number) => {
            number.as_i64().map_or_else(|| Value::Real(number.as_f64().expect("a number")), Value::Int)
        }
        Json::Object(kind) => match kind.iter().next().expect("a kind") {
            (name, list) if name == "tuple" => Value::tuple(parts(list)),
            (name, list) if name == "list" => Value::List(List::from_vec(parts(list))),
            (_, list) => Value::vector(&serde_json::from_value::<Vec<f64>>(list.clone()).expect("numbers")),
        },
        _ => panic!("no constant {data}"),
    }
}

/// Searches of a gallery model by the usual method.
fn grow(model: &str, seeds: u64, folder: &Path) -> u64 {
    let read = |ending: &str| {
        let place = folder.join(format!("{model}.{ending}"));
        std::fs::read_to_string(&place).unwrap_or_else(|error| panic!("{}: {error}", place.display()))
    };
    let (mut vertices, mut triangles, mut voxel) = (vec![], vec![], 0.25);
    for line in read("mesh").lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let number = |k: usize| words[k].parse::<f64>().expect("a number");
        match words[0] {
            "voxel" => voxel = number(1),
            "v" => vertices.push(vec3(number(1), number(2), number(3))),
            _ => triangles.push([1, 2, 3].map(|k| number(k) as u32)),
        }
    }
    let target = Target::new(TriMesh::new(vertices, triangles).expect("a mesh"), voxel).expect("a target");
    let module = parse(&read("core")).expect("core form");
    let constants: Vec<Json> = serde_json::from_str(&read("constants")).expect("a list");
    let program = compile(&module, constants.iter().map(value).collect()).expect("a program");
    let mut task = Task::new(Arc::new(program));
    task.sketches =
        vec![no_self_intersection(Rule::Solid), match_volume(Arc::new(target), 0.02).expect("a sketch")];
    let method = Method::read(&read("method")).expect("a method");
    for seed in 0..seeds {
        let inputs = Inputs { seed, ..Inputs::default() };
        method.search(&task, &inputs, &mut |_, _, _| true).expect("results");
    }
    seeds
}

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("one pool");
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [path, repeats, rest @ ..] = &args[..] else { panic!("usage: counts PATH REPEATS [FOLDER]") };
    let folder = rest.first().map_or("", String::as_str);
    println!("{}", work(path, repeats.parse().expect("a count"), Path::new(folder)));
}
