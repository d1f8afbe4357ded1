//! Ask and tell: which point is evaluated next.
//!
//! Points are proposed in batches. A batch depends on the evaluations of all batches before it, but for [`AHEAD`] points, and
//! on nothing else: neither on how many points are pending, nor on when they are told. So the points and their order are
//! the same for any number of workers.
//!
//! A batch has four kinds of picks among the candidates: the best predicted; the best if what is unknown turns out well; the
//! best of these with another structure; and one that no emulator has screened, for when it is wrong. After [`PATIENCE`]
//! evaluations without a gain the search starts afresh, with parents among the new points only; at the next such moment all
//! points are parents again.

use crate::archive::{Archive, Evaluation};
use crate::design;
use crate::dice::{Dice, Purpose};
use crate::emulator::Emulator;
use crate::kernel::Scales;
use crate::linear::{Cholesky, Matrix, dot};
use crate::moves::{Habits, Moves};
use crate::posterior::{Posterior, sample};
use crate::space::{Point, Space};
use std::collections::{HashSet, VecDeque};

/// Points of a batch, at first and after [`LATE`] evaluations.
const BATCH: [usize; 2] = [4, 8];
/// The number of evaluations after which batches are larger.
const LATE: usize = 300;
/// Candidates from parents; the best of them are changed in generations, less and less.
const POOL: usize = 240;
const KEPT: usize = 20;
/// Structures of which the best candidate is changed further, too.
const NICHES: usize = 12;
const GENERATIONS: [f64; 4] = [0.5, 0.25, 0.125, 0.1];
/// Candidates from which a descent starts, the stride of its slopes, and its dampings.
const DESCENTS: usize = 3;
const STRIDE: f64 = 0.02;
const DAMPINGS: [f64; 3] = [0.003, 0.03, 0.3];
/// How much of what is unknown an optimist hopes for, standard deviations.
const HOPE: f64 = 1.0;
/// Evaluations of a structure after which it must look twice as good to be picked as another one.
const OFTEN: f64 = 8.0;
/// Steps of the length scales for a batch: at the first, and later; and before questions.
const STEPS: [usize; 2] = [12, 3];
const CAREFUL: usize = 40;
/// Evaluations without a gain after which the search starts afresh, and the least gain, nats.
const PATIENCE: usize = 50;
const GAIN: f64 = 0.05;
/// The least squared distance of two picks of a batch, in length scales: early, and later.
const APART: [f64; 2] = [2e-3, 2e-4];
const EARLY: usize = 150;
/// Points of a batch that the next one does not wait for, so that workers need not wait for the slowest of a batch.
const AHEAD: usize = 2;
/// Draws of a new point that may all be known, after which the space counts as exhausted.
const DRAWS: usize = 300;

/// A point that was asked for, and whether no emulator chose it.
#[derive(Clone, Debug)]
struct Request {
    point: Point,
    is_plain: bool,
}

/// The search.
#[derive(Clone, Debug)]
pub struct Proposer {
    space: Space,
    seed: u64,
    archive: Archive,
    habits: Habits,
    scales: Scales,
    /// Points that were asked for, in order; the archive has the first of them.
    requests: Vec<Request>,
    /// Points of the batch that are not asked for yet.
    queue: VecDeque<Request>,
    keys: HashSet<Vec<u64>>,
    /// Evaluations that are told and not in the archive yet, with what they used.
    arrivals: VecDeque<(Evaluation, Option<Vec<bool>>)>,
    /// The number of features of an evaluation.
    features: Option<usize>,
    batches: u64,
    /// The first evaluation that may be a parent.
    epoch: usize,
    is_fresh: bool,
    /// The best evaluation, and when the best score of the epoch last rose.
    best: Option<usize>,
    rise: (usize, f64),
    is_exhausted: bool,
}

impl Proposer {
    /// A search over a space.
    pub fn new(space: Space, seed: u64) -> Proposer {
        let (habits, scales) = (Habits::new(space.len()), Scales::start(&space));
        let mut out = Proposer {
            space,
            seed,
            archive: Archive::default(),
            habits,
            scales,
            requests: vec![],
            queue: VecDeque::new(),
            keys: HashSet::new(),
            arrivals: VecDeque::new(),
            features: None,
            batches: 0,
            epoch: 0,
            is_fresh: false,
            best: None,
            rise: (0, f64::NEG_INFINITY),
            is_exhausted: false,
        };
        out.design(0);
        out
    }

    /// The parameters, with what was learnt about their use.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// The evaluations that were learnt from.
    pub fn archive(&self) -> &Archive {
        &self.archive
    }

    /// Whether every point that could be found was asked for.
    pub fn is_exhausted(&self) -> bool {
        self.is_exhausted
    }

    /// Puts a point before all others that are not asked for yet.
    pub fn suggest(&mut self, row: &[f64]) {
        let point = self.space.snap(row);
        if self.keys.insert(point.key()) {
            self.queue.push_front(Request { point, is_plain: true });
        }
    }

    /// The next point; None if it depends on a point that is not told yet, or if the space is exhausted.
    pub fn ask(&mut self) -> Option<Point> {
        if self.queue.is_empty() {
            let needed = self.requests.len().saturating_sub(AHEAD);
            if self.archive.len() + self.arrivals.len() < needed {
                return None;
            }
            self.absorb(needed);
            self.fill();
        }
        let next = self.queue.pop_front()?;
        self.requests.push(next.clone());
        Some(next.point)
    }

    /// Stores the evaluation of the first point that is not told yet.
    ///
    /// * `used`: which parameters the evaluation used, if it knows
    ///
    /// # Errors
    /// A text, if all points that were asked for are told, or if features differ in number from those before.
    pub fn tell(&mut self, evaluation: Evaluation, used: Option<&[bool]>) -> Result<(), String> {
        let number = self.archive.len() + self.arrivals.len();
        if number >= self.requests.len() {
            return Err("every point that was asked for is told".into());
        }
        if let Some(features) = &evaluation.features {
            if *self.features.get_or_insert(features.len()) != features.len() {
                return Err(format!("{} features, as many as before expected", features.len()));
            }
            if features.iter().any(|x| !x.is_finite()) {
                return Err("features must be finite".into());
            }
        }
        self.arrivals.push_back((evaluation, used.map(<[bool]>::to_vec)));
        Ok(())
    }

    /// Moves evaluations that are told into the archive, until it has so many.
    fn absorb(&mut self, count: usize) {
        while self.archive.len() < count
            && let Some((evaluation, used)) = self.arrivals.pop_front()
        {
            self.learn(evaluation, used.as_deref());
        }
    }

    /// Learns from the next evaluation.
    fn learn(&mut self, evaluation: Evaluation, used: Option<&[bool]>) {
        let number = self.archive.len();
        let Request { mut point, is_plain } = self.requests[number].clone();
        if let Some(used) = used.filter(|used| **used != point.used) {
            self.space.learn(&point, used);
            for (axis, is_used) in used.iter().enumerate() {
                point.used[axis] &= is_used;
                if !point.used[axis] {
                    point.row[axis] = 0.5;
                }
            }
            self.keys.insert(point.key());
        }
        let score = if evaluation.score.is_nan() { f64::NEG_INFINITY } else { evaluation.score };
        self.archive.push(point.clone(), Evaluation { score, ..evaluation });
        let has_won = self.archive.is_seen(number)
            && self.best.is_none_or(|best| self.archive.compare(number, best).is_lt());
        if let Some(best) = self.best {
            let base = self.archive.point(best).clone();
            self.habits.learn(&self.space, &base, &point, has_won, is_plain);
        }
        if has_won {
            self.best = Some(number);
        }
    }

    /// The search with everything that was told in its archive, for questions.
    pub fn informed(&self) -> Proposer {
        let mut out = self.clone();
        out.absorb(usize::MAX);
        out
    }

    /// Queues the first points of an epoch.
    fn design(&mut self, epoch: u64) {
        let mut dice = Dice::new(self.seed, Purpose::Design, epoch);
        for point in design::points(&self.space, design::size(&self.space), &mut dice) {
            if self.keys.insert(point.key()) {
                self.queue.push_back(Request { point, is_plain: true });
            }
        }
    }

    /// Queues the next batch.
    fn fill(&mut self) {
        self.batches += 1;
        if self.is_stuck() {
            self.is_fresh = !self.is_fresh;
            self.epoch = if self.is_fresh { self.requests.len() } else { 0 };
            self.rise = (self.archive.len(), f64::NEG_INFINITY);
            if self.is_fresh {
                self.design(self.batches);
                if !self.queue.is_empty() {
                    return;
                }
            }
        }
        let mut dice = Dice::new(self.seed, Purpose::Candidates, self.batches);
        let count = BATCH[usize::from(self.archive.len() > LATE)];
        let ranked = self.archive.ranked(self.epoch.min(self.archive.len()));
        for Request { point, is_plain } in self.batch(&ranked, count, &mut dice) {
            if self.keys.insert(point.key()) {
                self.queue.push_back(Request { point, is_plain });
            }
        }
        // A batch of known points alone: any new point.
        for _ in 0..DRAWS {
            if !self.queue.is_empty() {
                return;
            }
            let point = self.space.draw_point(&mut dice);
            if self.keys.insert(point.key()) {
                self.queue.push_back(Request { point, is_plain: true });
            }
        }
        self.is_exhausted = self.queue.is_empty();
    }

    /// Whether the best score of the epoch has not risen for long; stores when it rises.
    fn is_stuck(&mut self) -> bool {
        let best =
            (self.epoch..self.archive.len()).map(|k| self.archive.score(k)).fold(f64::NEG_INFINITY, f64::max);
        if best > self.rise.1 + GAIN || (self.rise.1.is_infinite() && best.is_finite()) {
            self.rise = (self.archive.len(), best);
        }
        self.archive.len() - self.rise.0 >= PATIENCE
    }

    /// The points of a batch.
    fn batch(&mut self, ranked: &[usize], count: usize, dice: &mut Dice) -> Vec<Request> {
        let plain = |point| Request { point, is_plain: true };
        if ranked.is_empty() {
            // No scene yet.
            return (0..count).map(|_| plain(self.space.draw_point(dice))).collect();
        }
        let steps = STEPS[usize::from(self.batches > 1)];
        let emulator = Emulator::train(&self.space, &self.archive, ranked, &self.scales, steps);
        let moves = Moves::new(&self.space, &self.archive, &self.habits, ranked);
        let mut out: Vec<Request> = vec![];
        let mut known_keys = self.keys.clone();
        if let Some(emulator) = &emulator {
            let unscreened = (count / 4).max(1);
            let least = APART[usize::from(self.archive.len() >= EARLY)];
            let pending: Vec<Point> =
                self.requests[self.archive.len()..].iter().map(|request| request.point.clone()).collect();
            for point in pick(&moves, emulator, count - unscreened, &known_keys, &pending, least, dice) {
                known_keys.insert(point.key());
                out.push(Request { point, is_plain: false });
            }
        }
        for _ in 0..DRAWS {
            if out.len() >= count {
                break;
            }
            let point = moves.propose(dice);
            if known_keys.insert(point.key()) {
                out.push(plain(point));
            }
        }
        if let Some(emulator) = emulator {
            self.scales = emulator.scales().clone();
        }
        out
    }

    /// The emulator of everything that was told, for questions about it; None before two scenes are seen.
    pub fn emulator(&self) -> Option<Emulator> {
        let ranked = self.archive.ranked(0);
        (ranked.len() >= 2)
            .then(|| Emulator::train(&self.space, &self.archive, &ranked, &self.scales, CAREFUL))?
    }

    /// Points that the evaluations leave possible for the target, or for a pseudo-target: the scene of an evaluation, which
    /// is then not learnt from. Neither are those that are nearer to it than the best evaluation is to the target, so that
    /// both questions are equally hard. None before enough scenes are seen, and for a pseudo-target without a scene.
    ///
    /// * `scales`: the length scales of [`Proposer::emulator`]
    pub fn posterior(
        &self,
        scales: &Scales,
        pseudo: Option<usize>,
        settings: Posterior,
    ) -> Option<Vec<Point>> {
        let shifted;
        let archive = match pseudo {
            None => &self.archive,
            Some(number) if number < self.archive.len() && self.archive.is_seen(number) => {
                let least = self.best.map_or(0.0, |best| self.archive.square(best));
                shifted = self.archive.about(number, least);
                &shifted
            }
            Some(_) => return None,
        };
        let ranked = archive.ranked(0);
        if ranked.len() < 2 {
            return None;
        }
        let emulator = Emulator::train(&self.space, archive, &ranked, scales, 0)?;
        let starts: Vec<Point> =
            ranked.iter().take(settings.chains).map(|number| archive.point(*number).clone()).collect();
        Some(sample(&self.space, &emulator, &starts, settings))
    }
}

/// A candidate with its predicted length, the length that an optimist hopes for, and a length for the choice of another
/// structure, which grows with the evaluations that the structure has had.
struct Candidate {
    point: Point,
    length: f64,
    hoped: f64,
    fresh: f64,
}

/// The candidates that an emulator finds most promising, of three kinds in turn.
fn pick(
    moves: &Moves<'_>,
    emulator: &Emulator,
    count: usize,
    known: &HashSet<Vec<u64>>,
    pending: &[Point],
    least: f64,
    dice: &mut Dice,
) -> Vec<Point> {
    let candidates = candidates(moves, emulator, dice);
    let order = |key: fn(&Candidate) -> f64| {
        let mut order: Vec<usize> = (0..candidates.len()).collect();
        order.sort_by(|a, b| key(&candidates[*a]).total_cmp(&key(&candidates[*b])).then(a.cmp(b)));
        VecDeque::from(order)
    };
    let mut orders = [order(|c| c.length), order(|c| c.hoped), order(|c| c.fresh)];
    let mut picked: Vec<Point> = vec![];
    let mut first = None;
    while picked.len() < count {
        let turn = picked.len() % 3;
        let from = &mut orders[turn];
        let Some(next) = from.pop_front() else { break };
        let rest = from.len();
        let point = &candidates[next].point;
        if known.contains(&point.key()) {
            continue;
        }
        let structure = moves.space.structure(point);
        let has_levels = structure.iter().any(Option::is_some);
        if turn == 2 && has_levels && first.as_ref() == Some(&structure) && rest > 3 {
            continue;
        }
        if picked.iter().chain(pending).any(|other| moves.are_close(emulator.scales(), point, other, least)) {
            continue;
        }
        first.get_or_insert(structure);
        picked.push(point.clone());
    }
    picked
}

/// Points from a step of Gauss and Newton towards features of zero through the emulator, for each damping (Levenberg 1944).
///
/// With many real parameters at once, changes at random seldom improve all of them.
fn descend(space: &Space, emulator: &Emulator, point: &Point) -> Vec<Point> {
    let reals: Vec<usize> =
        (0..space.len()).filter(|axis| point.used[*axis] && !space.has_levels(*axis)).collect();
    let mean = |row: &[f64]| emulator.mean(&emulator.kernel(row));
    let here = mean(&point.row);
    let mut slopes = Matrix::zeros(reals.len(), here.len());
    for (k, axis) in reals.iter().enumerate() {
        let mut row = point.row.clone();
        let ends = [(row[*axis] - STRIDE).max(0.0), (row[*axis] + STRIDE).min(1.0)];
        let [low, high] = ends.map(|x| {
            row[*axis] = x;
            mean(&row)
        });
        for (slope, (a, b)) in slopes.row_mut(k).iter_mut().zip(low.iter().zip(&high)) {
            *slope = (b - a) / (ends[1] - ends[0]);
        }
    }
    let mut products = Matrix::zeros(reals.len(), reals.len());
    let mut trace = 0.0;
    for i in 0..reals.len() {
        for j in 0..=i {
            products.row_mut(i)[j] = dot(slopes.row(i), slopes.row(j));
        }
        trace += products.row(i)[i];
    }
    let mut out = vec![];
    for damping in DAMPINGS {
        let mut damped = products.clone();
        for i in 0..reals.len() {
            let alone = damped.row(i)[i];
            damped.row_mut(i)[i] += damping * (alone + 0.05 * trace / reals.len() as f64 + 1e-9);
        }
        let Some(factor) = Cholesky::of(damped) else { continue };
        let mut step: Vec<f64> = (0..reals.len()).map(|k| dot(slopes.row(k), &here)).collect();
        factor.solve_lower(&mut step);
        factor.solve_upper(&mut step);
        let mut row = point.row.clone();
        for (axis, step) in reals.iter().zip(&step) {
            row[*axis] = (row[*axis] - step).clamp(0.0, 1.0);
        }
        out.push(space.snap(&row));
    }
    out
}

/// The candidates that are changed further, of a pool that is sorted: the best, and the best of each of some other structures.
/// Without these a structure is judged by parameters that suit another.
fn survivors(space: &Space, pool: &[(Point, f64, Vec<f64>)]) -> Vec<usize> {
    let mut structures = vec![];
    let mut out = vec![];
    for (place, (point, ..)) in pool.iter().enumerate() {
        let structure = space.structure(point);
        let is_new = !structures.contains(&structure);
        if place < KEPT || (is_new && structures.len() < NICHES) {
            out.push(place);
        }
        if is_new {
            structures.push(structure);
        }
    }
    out
}

/// New points from parents, and generations of changes to the most promising of them.
fn candidates(moves: &Moves<'_>, emulator: &Emulator, dice: &mut Dice) -> Vec<Candidate> {
    let predicted = |point: Point| {
        let kernel = emulator.kernel(&point.row);
        let length = emulator.length(&point.row, &kernel);
        (point, length, kernel)
    };
    let mut pool: Vec<_> = (0..POOL).map(|_| predicted(moves.propose(dice))).collect();
    for wide in GENERATIONS {
        pool.sort_by(|a, b| a.1.total_cmp(&b.1));
        let parents = survivors(moves.space, &pool);
        for parent in &parents {
            for _ in 0..2 {
                pool.push(predicted(moves.mutant(&pool[*parent].0, wide, dice)));
            }
            if dice.chance(0.5) {
                let (a, b) = (parents[dice.below(parents.len())], parents[dice.below(parents.len())]);
                pool.push(predicted(moves.shifted(&pool[*parent].0, &pool[a].0, &pool[b].0, 0.7)));
            }
        }
    }
    pool.sort_by(|a, b| a.1.total_cmp(&b.1));
    for place in 0..DESCENTS.min(pool.len()) {
        for point in descend(moves.space, emulator, &pool[place].0) {
            pool.push(predicted(point));
        }
    }
    let tried: Vec<_> =
        (0..moves.archive.len()).map(|number| moves.space.structure(moves.archive.point(number))).collect();
    let hope = |(point, length, kernel): (Point, f64, Vec<f64>)| {
        let hoped = length - HOPE * emulator.doubt(kernel);
        let structure = moves.space.structure(&point);
        let times = tried.iter().filter(|other| **other == structure).count() as f64;
        let fresh = (hoped.max(0.0) + 0.1 * length.max(0.0)) * (1.0 + times / OFTEN);
        Candidate { point, length, hoped, fresh }
    };
    pool.into_iter().map(hope).collect()
}
