//! The claim: a chooser gets the scene so far at every choice of a forward run and of a particle, also after the particle
//! became a copy. For a task without sketches it gets none.

use super::*;
use niwaki_geom::sketch::product::Sketches;
use niwaki_geom::{Aabb, Primitive, no_overshoot, vec3};
use niwaki_math::{Dist, StreamKey};
use niwaki_run::chooser::{Chooser, Chosen, Context, Prior};
use niwaki_run::forward::forward_by;
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;

/// A choice before, between and after two parts; the first part depends on the first choice.
const PARTS: &str = r#"(module (fn "m" (params)
    (set $a (sample (dist bernoulli 0.5)))
    (do (emit (box (tuple 0.0 0.0 0.0) (tuple (cond $a 1.0 0.8) 0.2 1.0))))
    (set $b (sample (dist bernoulli 0.5)))
    (do (emit (box (tuple 0.0 0.5 0.0) (tuple 0.2 1.0 0.2))))
    (return (tuple $a $b (sample (dist bernoulli 0.5))))) (entry "m"))"#;

/// Draws from the prior, and notes the score of the sketches that it sees.
struct Noting<'a> {
    prior: Prior,
    seen: &'a mut Vec<Option<f64>>,
}

impl Chooser for Noting<'_> {
    fn choose(
        &mut self,
        at: &At<'_, f64>,
        dist: &Dist,
        seen: Context<'_>,
    ) -> std::result::Result<Option<Chosen>, Fault> {
        self.seen.push(seen.sketches.map(|sketches| sketches.total().value()));
        self.prior.choose(at, dist, seen)
    }
}

#[test]
fn a_chooser_sees_the_scene_so_far() {
    let domain = Aabb { low: vec3(-0.3, -0.3, -0.3), high: vec3(0.3, 0.3, 0.3) };
    let task = Task { sketches: vec![no_overshoot(domain, 2.0).unwrap()], ..task(PARTS) };
    let prior = |stream| Prior(StreamKey::new(7, stream, 0));
    let forward = |task: &Task, stream| {
        let mut seen = vec![];
        let sample = forward_by(task, Noting { prior: prior(stream), seen: &mut seen }, false).unwrap();
        (seen, sample)
    };
    // By hand, for both values of the first choice.
    let score = |parts: &[Primitive]| {
        let mut sketches = Sketches::start(&task.sketches);
        parts.iter().for_each(|part| assert!(sketches.add(part).is_none()));
        Some(sketches.total().value())
    };
    let mut expected: HashMap<String, Vec<Option<f64>>> = HashMap::new();
    for stream in 0..20 {
        let (seen, sample) = forward(&task, stream);
        let trace = niwaki_run::replay::replay(
            &task,
            niwaki_run::replay::Source::Addresses(niwaki_run::replay::by_address(&sample.log.entries())),
            niwaki_run::replay::Missing::Refuse,
        );
        let parts: Vec<Primitive> =
            trace.unwrap().parts.iter().map(|part| Primitive::new(&part.shapes)).collect();
        let by_hand: Vec<_> = (0..3).map(|n| score(&parts[..n])).collect();
        assert!(by_hand[0] != by_hand[1] && by_hand[1] != by_hand[2], "{by_hand:?}");
        assert_eq!(seen, by_hand);
        expected.insert(repr(&sample.value).unwrap()[..5].to_string(), by_hand);
        assert_eq!(forward(&super::task(PARTS), stream).0, [None; 3]);
    }
    assert_eq!(expected.len(), 2, "both values were drawn");

    // A particle that became a copy of another sees the parts of that one.
    let settings = Settings { particles: 20, ..Settings::default() };
    let mut population = Population::start(&task, &settings, true).unwrap();
    let mut machine = task.machine();
    let mut next = |p: &mut Particle, seen: &mut Vec<Option<f64>>| {
        let chooser = Noting { prior: Prior(p.stream), seen };
        p.advance_by(&mut machine, &task, |_, _| Some(0), chooser).unwrap();
    };
    let mut seen = vec![vec![]; 20];
    for (p, seen) in population.swarm.alone().iter_mut().zip(&mut seen) {
        next(p, seen);
    }
    let scores: Vec<f64> = population.swarm.alone().iter().map(|p| p.record.log_score()).collect();
    let other = scores.iter().position(|score| *score != scores[0]).expect("both values");
    let (first, rest) = population.swarm.alone().split_at_mut(1);
    rest[other - 1].copy_from(&mut first[0], 99, 7);
    seen[other] = seen[0].clone();
    for (p, seen) in population.swarm.alone().iter_mut().zip(&mut seen) {
        next(p, seen);
        next(p, seen);
        assert!(p.state.has_ended());
        let expected = &expected[&repr(&p.state.result()).unwrap()[..5]];
        assert_eq!(seen, expected);
    }
}
