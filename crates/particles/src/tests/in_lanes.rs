//! The claim: a population in lanes is the population of particles that run one by one, to the bit: values, choices, weights,
//! evidence, steps, losses and faults, on all programs of the tests here and on others whose particles part and meet.

use super::*;
use crate::population::Population;
use niwaki_run::Failure;

/// Programs in which all particles stay together, and what lanes do in them.
const TOGETHER: [(&str, &str); 6] = [
    (
        "numbers of all kinds, and functions of them",
        r#"(module (fn "bent" (params $x $k) (return (add (mul $k (sin $x)) (sqrt (add 1 (mul $x $x))))))
            (fn "step" (params $x $i)
              (set $dx (sample (dist gaussian 0.0 0.5)))
              (set $heads (sample (dist bernoulli 0.4)))
              (set $n (sample (dist poisson 2.0)))
              (set $y (call "bent" (add $x $dx) $n))
              (do (observe (dist gaussian $y 1.5) (mul 0.3 $i)))
              (do (factor (neg (mul 0.1 (abs (sub $y (max $n 1)))))))
              (return (tuple $y (not $heads))))
            (fn "m" (params) (set $x 0.5) (set $all (list))
              (for $i (range 12) (body
                (set $pair (call "step" $x $i)) (unpack ($x $flag) $pair)
                (set $all (add $all (list $x $flag)))))
              (return (tuple $x $all))) (entry "m"))"#,
    ),
    (
        "choices among distributions",
        r#"(module (const 0 (list (dist categorical (list 0.7 0.2 0.1)) (dist categorical (list 0.1 0.5 0.4))
              (dist categorical (list 0.3 0.3 0.4))))
            (const 1 (list (dist gaussian 0.0 1.0) (dist gaussian 2.0 0.5) (dist uniform -9.0 9.0)))
            (fn "m" (params) (set $s 0)
              (for $i (range 20) (body
                (set $s (sample (index (data 0) $s)))
                (do (observe (index (data 1) $s) (mod $i 3)))))
              (return $s)) (entry "m"))"#,
    ),
    (
        "a loop over a list that is carried, and one in it",
        r#"(module (fn "m" (params) (set $xs (list 0.0 1.0 2.0))
              (for $t (range 6) (body
                (set $ys (list))
                (for $x $xs (body
                  (set $y (sample (dist gaussian $x 0.3)))
                  (set $ys (append $ys $y))
                  (do (observe (dist gaussian $y 1.0) 0.7))))
                (set $xs $ys)))
              (return $xs)) (entry "m"))"#,
    ),
    (
        "recursion with closures",
        r#"(module (fn "go" (params $f $d $x)
              (set $y (add $x (sample (dist uniform -1.0 1.0))))
              (do (factor (neg (mul $y $y))))
              (if (lt $d 8) (then (return (call "go" $f (add $d 1) $y))))
              (return (apply $f $y)))
            (fn "double" (params $x) (return (mul 2 $x)))
            (fn "m" (params) (return (call "go" (closure "double") 0 0.0))) (entry "m"))"#,
    ),
    (
        "two choices before a barrier",
        r#"(module (fn "m" (params) (set $x (sample (dist gamma 2.0 1.0)))
              (set $y (sample (dist gaussian $x 1.0))) (do (observe (dist gaussian $y 0.1) 1.5)) (do (factor (neg $x))) (return (tuple $x $y)))
            (entry "m"))"#,
    ),
    (
        "a result that all share",
        r#"(module (fn "m" (params)
              (for $i (range 3) (body (set $x (sample (dist gaussian 0.0 1.0))) (do (factor (neg (abs $x))))))
              (return 7)) (entry "m"))"#,
    ),
];

/// A program that takes its memory between barriers.
const BETWEEN: (&str, &str) = (
    "a list of what differs, that is gone at the barrier",
    r#"(module (fn "m" (params)
          (for $i (range 4) (body
            (set $x (sample (dist gaussian 0.0 1.0))) (set $xs (list))
            (for $k (range 500) (body (set $xs (append $xs (mul $x $k)))))
            (do (factor (mul -0.01 (abs (index $xs 3)))))))
          (return 7)) (entry "m"))"#,
);

/// Programs whose particles part: at a jump, by a fault of some, by a score of minus infinity, at what lanes do not do.
const APART: [(&str, &str); 8] = [
    (
        "a jump between barriers that some take",
        r#"(module (fn "m" (params) (set $x 0.0)
              (for $i (range 30) (body
                (set $x (add $x (sample (dist gaussian 0.0 0.4))))
                (if (and (gt $i 10) (gt $x 0.5)) (then (set $x (sub $x (sample (dist uniform 0.0 1.0))))))
                (do (observe (dist gaussian $x 1.0) (mul 0.05 $i)))))
              (return $x)) (entry "m"))"#,
    ),
    (
        "impossible particles at some barriers",
        r#"(module (fn "m" (params) (set $x 0.0)
              (for $i (range 25) (body
                (set $x (sample (dist gaussian $x 1.0)))
                (do (factor (mul -0.1 (abs $x))))
                (do (condition (or (lt (mod $i 7) 5) (gt $x -1.0))))))
              (return $x)) (entry "m"))"#,
    ),
    (
        "barriers at two places",
        r#"(module (fn "m" (params) (set $x 0.0)
              (for $i (range 40) (body
                (set $b (sample (dist bernoulli 0.5)))
                (if (and (gt $i 5) $b)
                  (then (do (factor (mul -0.01 (abs $x)))) (set $x (add $x 1)))
                  (else (do (factor (mul -0.02 (abs $x)))) (set $x (sub $x 2))))))
              (return $x)) (entry "m"))"#,
    ),
    (
        "an observation that is impossible for some",
        r#"(module (fn "m" (params) (set $x 0.0)
              (for $i (range 15) (body
                (set $x (sample (dist gaussian $x 0.3)))
                (do (observe (dist uniform -1.5 1.5) $x))))
              (return $x)) (entry "m"))"#,
    ),
    (
        "a distribution that is invalid for some",
        r#"(module (fn "m" (params) (set $x 1.0)
              (for $i (range 15) (body
                (set $x (sample (dist gaussian $x 0.5)))
                (do (factor (mul 0.05 $x)))
                (do (observe (dist gaussian 0.0 (add $x 0.4)) 1.0))))
              (return $x)) (entry "m"))"#,
    ),
    (
        "shapes between the barriers",
        r#"(module (fn "m" (params) (set $x 1.0)
              (for $i (range 12) (body
                (set $x (sample (dist gaussian $x 0.5)))
                (do (observe (dist gaussian $x 1.0) 1.0))
                (if (eq (mod $i 4) 3) (then (do (emit (box (vec $x 0 0) (vec 1 1 1))))))))
              (return $x)) (entry "m"))"#,
    ),
    (
        "a division by zero of some, whose result is bounded",
        r#"(module (fn "m" (params) (set $n 3)
              (for $i (range 12) (body
                (set $n (add $n (sample (dist discrete_uniform -1 1))))
                (do (factor (min 0.5 (div 1.0 (mul 1.0 $n)))))))
              (return $n)) (entry "m"))"#,
    ),
    (
        "a fault of some",
        r#"(module (fn "m" (params) (set $n 4)
              (for $i (range 12) (body
                (set $n (add $n (sample (dist discrete_uniform -1 1))))
                (do (factor (div 1 (add $n 1))))))
              (return $n)) (entry "m"))"#,
    ),
];

/// All that a search says, as text with the bits of its numbers.
fn transcript(task: &Task, settings: &Settings) -> String {
    let task = task.uncounted();
    match smc(&task, settings, &mut |_| true) {
        Err(Failure::Run(met)) => format!("{:?} {:?}", met.fault, met.stack),
        Err(other) => format!("{other:?}"),
        Ok(result) => {
            let bits = |x: Option<f64>| x.map(f64::to_bits);
            let counts = (result.barriers, result.steps, result.resampled, result.ancestors);
            let mut text = format!(
                "{:?} {:?} {counts:?} {:?} {:?}\n",
                bits(result.log_normaliser),
                bits(result.log_evidence),
                result.powers,
                result.losses,
            );
            for p in &result.particles {
                let choices: Vec<_> = p.log.entries().iter().map(|e| (e.address(), written(e))).collect();
                let sums = [p.log_weight, p.log_prior, p.log_score];
                let value = repr(&p.value).unwrap();
                let record = (&p.cause, p.invalid.is_some(), p.primitives);
                text +=
                    &format!("{value} {:?} {} {choices:?} {record:?}\n", sums.map(f64::to_bits), p.has_ended);
            }
            text
        }
    }
}

fn settings() -> Vec<Settings> {
    let plain = Settings { particles: 40, order: Order::DepthFirst, ..Settings::default() };
    let mut all = vec![plain.clone()];
    all.extend(Resampling::ALL.map(|resampling| Settings { resampling, seed: 3, ..plain.clone() }));
    all.push(Settings {
        when: When::EffectiveBelow(0.5),
        order: Order::Stochastic,
        seed: 1,
        ..plain.clone()
    });
    all.push(Settings { power: 0.5, seed: 2, ..plain.clone() });
    all.push(Settings { anneal: Anneal::Schedule(vec![0.1, 0.5, 1.0]), seed: 4, ..plain.clone() });
    all.push(Settings { particles: 200, seed: 5, ..plain });
    all
}

fn agree(name: &str, task: &Task) {
    for options in settings() {
        let [alone, together] =
            [false, true].map(|lanes| transcript(task, &Settings { lanes, ..options.clone() }));
        let other = alone.lines().zip(together.lines()).find(|(a, b)| a != b);
        assert!(alone == together, "{name}, {options:?}: {other:#?}");
    }
}

#[test]
fn lanes_say_what_particles_say() {
    let programs = PROGRAMS.iter().chain(&TOGETHER).chain(&APART);
    programs.for_each(|(name, text)| agree(name, &task(text)));
}

/// Limits are met at the same step, and with the same words.
#[test]
fn limits_stop_lanes_as_they_stop_particles() {
    for (name, text) in TOGETHER.iter().chain([&BETWEEN]) {
        for (steps, bytes) in
            [(7, 1 << 30), (20, 1 << 30), (100_000, 40 << 10), (100_000, 200 << 10), (100_000, 300 << 10)]
        {
            let mut limited = task(text);
            (limited.limits.steps, limited.limits.bytes) = (steps, bytes);
            agree(name, &limited);
        }
    }
}

/// The programs do what they are for.
#[test]
fn particles_stay_together_where_nothing_parts_them() {
    let barriers_in_lanes = |text: &str| {
        let (task, settings) =
            (task(text), Settings { particles: 40, order: Order::DepthFirst, ..Settings::default() });
        let mut population = Population::start(&task, &settings, true).unwrap();
        let (mut in_lanes, mut all) = (0, 0);
        while population.running() > 0 && population.advance(None).is_ok() && population.weigh().is_ok() {
            in_lanes += usize::from(population.swarm.lanes.is_some());
            all += 1;
            population.resample(None).unwrap();
        }
        (in_lanes, all + usize::from(population.running() > 0))
    };
    for (name, text) in TOGETHER {
        let (in_lanes, all) = barriers_in_lanes(text);
        assert!(in_lanes == all && all > 1, "{name}: {in_lanes} of {all}");
    }
    for (name, text) in APART {
        let (in_lanes, all) = barriers_in_lanes(text);
        assert!(in_lanes < all && in_lanes > 1, "{name}: {in_lanes} of {all}");
    }
}
