//! Training comes near the best possible loss, with equal bits on any number of threads, and stops at numbers that are not finite.
#![allow(clippy::unwrap_used)] // A test fails where it panics.

use niwaki_guide::{
    Diverged, Head, Lesson, Net, NetForm, Rows, Scratch, Stored, Trained, Training, Way, train, train_along,
};
use niwaki_math::{Dist, Draw, Stream};

const SHARE: f64 = 0.02;

/// Two sites. A coin whose probability of heads is 0.9 or 0.1, by the first number of the window; and an angle, whose mean
/// is a quarter turn times the feature, with deviation 0.2.
struct Toy {
    form: NetForm,
    coin: Dist,
    angle: Dist,
}

impl Toy {
    fn new() -> Toy {
        let coin = Dist::Bernoulli { p: 0.5 };
        let angle = Dist::Uniform { lo: -3.0, hi: 3.0 };
        let heads = [&coin, &angle].map(|d| Head::of(d, 4).unwrap());
        Toy { form: NetForm::new(3, 2, heads.into()), coin, angle }
    }

    fn rows(&self, count: usize, seed: u64) -> Rows {
        let mut rows = Rows::new(&self.form);
        let mut stream = Stream::new(seed, 0, 0, 0);
        for k in 0..count {
            if k % 50 == 0 {
                rows.trace();
            }
            let window = [stream.uniform() as f32, 0.25, stream.uniform() as f32];
            let value = stream.normal();
            if k % 2 == 0 {
                let heads = (stream.uniform() < 0.9) == (window[0] > 0.5);
                let lesson = self.form.heads[0].lesson(&self.coin, &Draw::Bool(heads)).unwrap();
                rows.push(0, &window, &[(1, 1e4 * value as f32)], &lesson);
            } else {
                let feature = stream.uniform() * 2.0 - 1.0;
                let x = (1.57 * feature + 0.2 * value).clamp(-3.0, 3.0);
                let lesson = self.form.heads[1].lesson(&self.angle, &Draw::Real(x)).unwrap();
                rows.push(1, &window, &[(0, 100.0 + feature as f32)], &lesson);
            }
        }
        rows
    }
}

fn settings(steps: u64) -> Training {
    Training { steps, every: 250, ..Training::new(1, 0) }
}

fn silent(toy: &Toy, with: &Training) -> Trained {
    let start: Net = Net::start(toy.form.clone(), 3);
    train(start, &toy.rows(20_000, 1), &toy.rows(4_000, 2), with, &mut |_| true).unwrap()
}

/// The best possible loss: minus the information about each site, with the share of the prior.
fn best_loss() -> f64 {
    let coin: f64 = [(0.9, 0.9 * 0.98 + 0.01), (0.1, 0.1 * 0.98 + 0.01)]
        .iter()
        .map(|(p, q): &(f64, f64)| p * (q / 0.5).ln())
        .sum();
    // The quotient of the angle's density to the uniform's 1/6, by the midpoint rule over deviations.
    let step = 1e-3;
    let angle: f64 = (-8000..8000)
        .map(|k| {
            let t = (f64::from(k) + 0.5) * step;
            let density = (-0.5 * t * t).exp() / std::f64::consts::TAU.sqrt();
            density * step * ((1.0 - SHARE) * density / 0.2 * 6.0 + SHARE).ln()
        })
        .sum();
    -0.5 * (coin + angle)
}

#[test]
fn training_comes_near_what_can_be_known() {
    let toy = Toy::new();
    let mut seen = Vec::new();
    let start: Net = Net::start(toy.form.clone(), 3);
    let with = settings(2_500);
    let got = train(start, &toy.rows(40_000, 1), &toy.rows(8_000, 2), &with, &mut |p| {
        seen.push(p);
        true
    })
    .unwrap();
    assert_eq!(seen, got.history);
    // The start is near the prior. The mean of 8,000 losses of deviation about 1 has deviation 0.011.
    assert!(seen[0].held_out.abs() < 0.02, "{:?}", seen[0]);
    let (best, limit) = (got.best.0, best_loss());
    assert!(best > limit - 0.05 && best < limit + 0.08, "{best} of {limit}");
    // Features far from zero, very large features and missing features do no harm.
    let (mut sums, mut scratch) = (Vec::new(), Scratch::default());
    got.net.see(&[0.9, 0.25, 0.5], &mut sums);
    let heads = |net: &Net, features: &[(u32, f32)], scratch: &mut Scratch| {
        let outputs = net.answer(&sums, features, 0, scratch);
        toy.form.heads[0].log_drawn(outputs, &toy.coin, SHARE, &Draw::Bool(true)).exp()
    };
    for features in [&[][..], &[(1, 0.0)], &[(1, f32::MAX)], &[(1, f32::NAN)]] {
        let p = heads(&got.net, features, &mut scratch);
        assert!((p - 0.9).abs() < 0.15, "{features:?}: {p}");
    }
    assert_eq!(heads(&got.net, &[], &mut scratch), heads(&got.net, &[(1, f32::NAN)], &mut scratch));
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let toy = Toy::new();
    let with = settings(60);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| silent(&toy, &with))
    };
    let alone = on(1);
    assert_eq!(niwaki_guide::write(&alone.net, ""), niwaki_guide::write(&on(2).net, ""));
    assert!(alone == on(3));
}

#[test]
fn training_in_two_parts_is_training_in_one() {
    let toy = Toy::new();
    let (rows, held_out) = (toy.rows(20_000, 1), toy.rows(4_000, 2));
    let whole = silent(&toy, &Training { every: 20, ..settings(60) });
    let half = silent(&toy, &Training { every: 20, ..settings(40) });
    assert_eq!(half.state.step(), 40);
    let with = Training { every: 20, ..settings(60) };
    let both = niwaki_guide::resume(half.state, &rows, &held_out, &with, &mut |_| true).unwrap();
    assert!(both.net == whole.net && both.state == whole.state);
}

/// A training that is stored in any step and resumed has equal bits and an equal history.
#[test]
fn a_stored_training_goes_on() {
    let toy = Toy::new();
    let (rows, held_out) = (toy.rows(20_000, 1), toy.rows(4_000, 2));
    let with = Training { every: 20, ..settings(60) };
    let along = |left: Option<Stored>, until: usize| {
        let (mut borders, mut stored) = (0, None);
        let mut border = |content: &dyn Fn() -> Stored| {
            borders += 1;
            if borders == until {
                stored = Some(serde_json::to_string(&content()).unwrap());
            }
        };
        let way = Way { left, border: &mut border };
        let start: Net = Net::start(toy.form.clone(), 3);
        let trained = train_along(start, &rows, &held_out, &with, &mut |_| true, way).unwrap().unwrap();
        (trained, stored)
    };
    let whole = along(None, 0).0;
    for until in [1, 20, 21, 47] {
        let text = along(None, until).1.unwrap();
        let again = along(Some(serde_json::from_str(&text).unwrap()), 0).0;
        assert!(again == whole, "from step {until}");
    }
    let small: Stored = serde_json::from_str(&along(None, 1).1.unwrap().replacen(',', ",0,", 1)).unwrap();
    let way = Way { left: Some(small), border: &mut |_| {} };
    let start: Net = Net::start(toy.form.clone(), 3);
    assert!(train_along(start, &rows, &held_out, &with, &mut |_| true, way).is_err());
}

/// Training from a trained network keeps its knowledge, for any means and deviations of the new rows.
#[test]
fn a_trained_network_is_a_start() {
    let toy = Toy::new();
    let first = silent(&toy, &settings(500));
    let again =
        train(first.net, &toy.rows(900, 5), &toy.rows(4_000, 2), &settings(0), &mut |_| true).unwrap();
    assert!((again.best.0 - first.best.0).abs() < 0.01, "{} {}", again.best.0, first.best.0);
}

#[test]
fn watching_can_end_the_training() {
    let toy = Toy::new();
    let start: Net = Net::start(toy.form.clone(), 3);
    let got =
        train(start, &toy.rows(900, 1), &toy.rows(900, 2), &settings(5_000), &mut |p| p.step < 500).unwrap();
    assert_eq!(got.state.step(), 500);
    assert_eq!(got.best, got.history.last().unwrap().best);
}

#[test]
fn no_rows_leave_the_start() {
    let toy = Toy::new();
    let start: Net = Net::start(toy.form.clone(), 3);
    let none = Rows::new(&toy.form);
    let got = train(start, &none, &none, &settings(100), &mut |_| true).unwrap();
    assert_eq!(got.state.step(), 0);
}

/// A loss that is NaN stops the training, and the message names the site; the network still works.
#[test]
fn training_that_diverges_says_where() {
    let toy = Toy::new();
    let mut rows = toy.rows(900, 1);
    let broken = Lesson::Normal { z: 0.0, log_prior: f64::NAN, limits: (-7.0, 7.0) };
    rows.push(1, &[0.0; 3], &[], &broken);
    let start: Net = Net::start(toy.form.clone(), 3);
    let Err(stopped) = train(start, &rows, &toy.rows(900, 2), &settings(1_000), &mut |_| true) else {
        panic!("trained on NaN")
    };
    let Diverged { step, site, loss, net } = *stopped;
    assert!(step > 0 && site == Some(1) && loss.is_nan());
    let text = Diverged { step: 7, site, loss, net: net.clone() }.to_string();
    assert_eq!(text, "in step 7 the loss is not a finite number, at a choice of site 1 (loss NaN)");
    let (mut sums, mut scratch) = (Vec::new(), Scratch::default());
    net.see(&[0.1, 0.2, 0.3], &mut sums);
    assert!(net.answer(&sums, &[], 1, &mut scratch).iter().all(|x| x.is_finite()));
}
