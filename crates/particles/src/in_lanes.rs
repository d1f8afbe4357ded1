//! A population in lanes: particles at the same place run together ([`Lanes`]), and are weighed and copied as columns.
//!
//! It does what particles do one by one, to the bit: choices by the stream of each lineage at the choice's address, sums on the
//! grid of log densities, weights in the order of the particles. Where lanes go apart (a jump that some take, a score of minus
//! infinity, a fault), the particles run to that barrier by themselves, from the last one, and may line up again after it.
//!
//! The choices are kept as columns, too, a *segment* from one resampling to the next. A segment knows from which lane of
//! the one before each of its lanes came, so a choice is stored once, and rows that no particle descends from are dropped
//! now and then.

use crate::copies::Copies;
use crate::resident::{Growth, values_to_recount};
use niwaki_math::distributions::Tables;
use niwaki_math::total::NEAR;
use niwaki_math::{Draw, StreamKey, grid};
use niwaki_propose::particle::Particle;
use niwaki_run::log::Log;
use niwaki_run::weights::near_log_step;
use niwaki_vm::machine::Machine;
use niwaki_vm::machine::answers::{Answer, At, Factor};
use niwaki_vm::machine::lanes::{Column, Dists, Divergence, LaneAnswers, Lanes, Logs};
use std::sync::Arc;

/// Fewer particles than this run one by one.
pub(super) const LEAST: usize = 16;

/// Tables of the distributions that lanes share pay where each is drawn from this many times.
const REPEATS: usize = 4;

/// Choices that are stored before those that no particle descends from are looked for.
const STORED: usize = 1 << 16;

/// Particles as columns.
pub(super) struct InLanes {
    lanes: Lanes,
    streams: Vec<StreamKey>,
    lineages: Vec<u64>,
    /// Sums of the log densities of the choices, and of the factors, nats.
    log_prior: Vec<f64>,
    log_factors: Vec<f64>,
    /// `log_prior` at the last barrier.
    prior_before: Vec<f64>,
    /// As [`Particle::weighed`] and [`Particle::log_weight`], nats.
    weighed: Vec<f64>,
    pub log_weight: Vec<f64>,
    past: Choices,
    /// Bytes of each one's activations when they were counted last.
    bytes: isize,
}

/// The choices of the particles.
struct Choices {
    /// Those that they had made one by one.
    before: Vec<Log>,
    segments: Vec<Segment>,
    /// Values in the segments, and how many were left when rows were last dropped.
    stored: usize,
    left: usize,
}

/// Choices from one resampling to the next.
struct Segment {
    /// From which row of the segment before (of `before`) each row came.
    from: Vec<u32>,
    choices: Vec<(u128, Column)>,
}

impl InLanes {
    /// The particles, where they are at the same place. What they hold is then here until [`InLanes::part`].
    pub fn line_up(particles: &mut [Particle]) -> Option<InLanes> {
        let near =
            |p: &Particle| !p.record.log_prior.near().is_nan() && !p.record.log_factors.near().is_nan();
        let counts = |p: &Particle| (p.picks, p.record.primitives, p.bytes);
        let first = counts(particles.first()?);
        if !particles.iter().all(|p| p.is_running() && near(p) && counts(p) == first) {
            return None;
        }
        let lanes = Lanes::line_up(particles.iter().map(|p| &p.state))?;
        let before = particles.iter_mut().map(|p| std::mem::take(&mut p.record.log)).collect();
        let of = |f: fn(&Particle) -> f64| particles.iter().map(f).collect::<Vec<f64>>();
        let first_segment = Segment { from: (0..particles.len() as u32).collect(), choices: vec![] };
        Some(InLanes {
            lanes,
            streams: particles.iter().map(|p| p.stream).collect(),
            lineages: particles.iter().map(|p| p.lineage).collect(),
            log_prior: of(|p| p.record.log_prior.near()),
            log_factors: of(|p| p.record.log_factors.near()),
            prior_before: vec![0.0; particles.len()],
            weighed: of(|p| p.weighed.near()),
            log_weight: of(|p| p.log_weight),
            past: Choices { before, segments: vec![first_segment], stored: 0, left: 0 },
            bytes: first.2,
        })
    }

    /// The particles go on one by one.
    pub fn part(mut self, particles: &mut [Particle]) {
        let logs = self.past.logs();
        for (lane, (p, log)) in particles.iter_mut().zip(logs).enumerate() {
            p.state = self.lanes.state_of(lane);
            (p.stream, p.lineage) = (self.streams[lane], self.lineages[lane]);
            p.record.log = log;
            for (total, sum) in [
                (&mut p.record.log_prior, self.log_prior[lane]),
                (&mut p.record.log_factors, self.log_factors[lane]),
                (&mut p.weighed, self.weighed[lane]),
            ] {
                total.clear();
                total.add(sum);
            }
            p.log_weight = self.log_weight[lane];
            p.was_ended = false;
            p.bytes = self.bytes;
        }
    }

    /// Whether they have ended.
    pub fn have_ended(&self) -> bool {
        self.lanes.shared().has_ended()
    }

    /// How many they are.
    pub fn len(&self) -> usize {
        self.lineages.len()
    }

    /// Counts their scores in the weights: a step from one power to the `next`. Returns the best score, nats.
    pub fn weigh(&mut self, next: f64, power: f64) -> f64 {
        let mut best = f64::NEG_INFINITY;
        let weights = self.log_weight.iter_mut().zip(&self.weighed);
        for ((weight, weighed), score) in weights.zip(&self.log_factors) {
            best = best.max(*score);
            *weight += near_log_step(next, *score, power, *weighed);
        }
        self.weighed.copy_from_slice(&self.log_factors);
        best
    }

    /// Runs them to the next barrier, or to the end; false, and they are at the last barrier, where they cannot go on together,
    /// or where they have grown by more than fits.
    pub fn advance(&mut self, machine: &mut Machine<'_>, fits: impl FnOnce(Growth) -> bool) -> bool {
        let before = self.lanes.clone();
        self.prior_before.copy_from_slice(&self.log_prior);
        let choices = self.past.segments.last().map_or(0, |last| last.choices.len());
        let done = self.with(|lanes, answers| machine.resume_lanes(lanes, answers));
        let growth = done.and_then(|_| self.growth(before.shared().value_bytes()));
        let done = growth.is_ok_and(fits);
        if done {
            self.bytes = self.lanes.shared().own_bytes() as isize;
        } else {
            self.lanes = before;
            self.log_prior.copy_from_slice(&self.prior_before);
            // The score at the last barrier is the one that was weighed.
            self.log_factors.copy_from_slice(&self.weighed);
            if let Some(last) = self.past.segments.last_mut() {
                last.choices.truncate(choices);
            }
        }
        done
    }

    /// By how much they have grown together, as [`counted`](crate::resident::counted) one by one.
    fn growth(&self, values: usize) -> Result<Growth, Divergence> {
        let (n, state) = (self.len(), self.lanes.shared());
        if state.value_bytes() > values_to_recount(values) {
            return Err(Divergence);
        }
        let grown = state.own_bytes() as isize - self.bytes;
        Ok(Growth::of(n, grown, state.value_bytes().saturating_sub(values)))
    }

    /// Makes the copies of a resampling.
    pub fn copy(&mut self, copies: &Copies, seed: u64) {
        let mut from: Vec<u32> = (0..self.len() as u32).collect();
        for (parent, to, lineage) in copies.with_lineages() {
            from[to] = parent as u32;
            self.lineages[to] = lineage;
            self.streams[to] = StreamKey::new(seed, lineage, 0);
        }
        self.lanes.pick(&from);
        for column in [&mut self.log_prior, &mut self.log_factors, &mut self.log_weight] {
            *column = from.iter().map(|lane| column[*lane as usize]).collect();
        }
        self.weighed.copy_from_slice(&self.log_factors);
        self.past.pick(from);
    }
}

impl Choices {
    fn pick(&mut self, from: Vec<u32>) {
        self.segments.push(Segment { from, choices: vec![] });
        if self.stored > 2 * self.left + STORED {
            self.drop_rows();
        }
    }

    /// Drops the rows that no particle descends from.
    fn drop_rows(&mut self) {
        self.stored = 0;
        let mut used_rows: Option<Vec<u32>> = None;
        for segment in self.segments.iter_mut().rev() {
            if let Some(rows) = &used_rows {
                segment.from = rows.iter().map(|row| segment.from[*row as usize]).collect();
                segment.choices.iter_mut().for_each(|(_, column)| *column = column.picked(rows));
            }
            self.stored += segment.choices.len() * segment.from.len();
            used_rows = Some(only_used(&mut segment.from));
        }
        if let Some(rows) = used_rows {
            self.before = rows.iter().map(|row| std::mem::take(&mut self.before[*row as usize])).collect();
        }
        self.left = self.stored;
    }

    /// The choices of each particle.
    fn logs(&mut self) -> Vec<Log> {
        self.drop_rows();
        let before = std::mem::take(&mut self.before);
        // In boxes, because each moves from segment to segment; none is left out.
        let mut logs: Vec<Option<Box<Log>>> = before.into_iter().map(|log| Some(Box::new(log))).collect();
        for segment in std::mem::take(&mut self.segments) {
            let mut uses = vec![0u32; logs.len()];
            segment.from.iter().for_each(|row| uses[*row as usize] += 1);
            let mut inherit = |row: &u32| {
                let (uses, log) = (&mut uses[*row as usize], &mut logs[*row as usize]);
                *uses -= 1;
                if *uses == 0 { log.take() } else { log.as_mut().map(|log| Box::new(log.fork())) }
            };
            let mut next: Vec<Option<Box<Log>>> = segment.from.iter().map(&mut inherit).collect();
            for (row, log) in next.iter_mut().flatten().enumerate() {
                for (address, column) in &segment.choices {
                    log.push(*address, column.get(row));
                }
            }
            logs = next;
        }
        logs.into_iter().flatten().map(|log| *log).collect()
    }
}

/// The numbers in a list, ascending and each once. The list then has their places.
fn only_used(list: &mut [u32]) -> Vec<u32> {
    let count = list.iter().max().map_or(0, |most| *most as usize + 1);
    let mut places = vec![0; count];
    list.iter().for_each(|number| places[*number as usize] = 1);
    // Without a jump that depends on what is used: what is written too early is written again.
    let (mut used, mut length) = (vec![0; count + 1], 0);
    for (number, place) in places.iter_mut().enumerate() {
        used[length] = number as u32;
        let is_used = std::mem::replace(place, length as u32);
        length += is_used as usize;
    }
    used.truncate(length);
    list.iter_mut().for_each(|number| *number = places[*number as usize]);
    used
}

/// Answers the questions of all particles.
struct Drawing<'a> {
    streams: &'a [StreamKey],
    log_prior: &'a mut [f64],
    log_factors: &'a mut [f64],
    past: &'a mut Choices,
}

impl InLanes {
    /// Runs `f` with the lanes and with what answers them.
    fn with<T>(&mut self, f: impl FnOnce(&mut Lanes, &mut Drawing<'_>) -> T) -> T {
        let InLanes { lanes, streams, log_prior, log_factors, past, .. } = self;
        f(lanes, &mut Drawing { streams, log_prior, log_factors, past })
    }
}

/// Adds to a sum that must stay exact.
fn add(sum: &mut f64, log: f64) -> bool {
    *sum += log;
    sum.abs() < NEAR
}

/// Draws from tables, by the first uniform of each stream.
fn draw_from(
    tables: &Tables,
    table_of_lane: &[u32],
    uniforms: impl Iterator<Item = f64>,
    log_prior: &mut [f64],
) -> Result<Vec<i64>, Divergence> {
    let (mut drawn, mut exact) = (Vec::with_capacity(log_prior.len()), true);
    let mut sums = log_prior.iter_mut();
    let mut take = |k, log| {
        drawn.push(k);
        exact &= sums.next().is_some_and(|sum| add(sum, log));
    };
    if table_of_lane.is_empty() {
        tables.draw(uniforms.map(|u| (0, u)), &mut take);
    } else {
        tables.draw(table_of_lane.iter().map(|row| *row as usize).zip(uniforms), &mut take);
    }
    if exact { Ok(drawn) } else { Err(Divergence) }
}

impl Drawing<'_> {
    /// Stores the values of a choice.
    fn note(&mut self, address: u128, column: Column) -> Column {
        if let Some(last) = self.past.segments.last_mut() {
            last.choices.push((address, column.clone()));
            self.past.stored += self.streams.len();
        }
        column
    }
}

impl LaneAnswers for Drawing<'_> {
    fn choices(&mut self, at: &At<'_, f64>, dists: Dists<'_>) -> Result<Column, Divergence> {
        let (address, lanes) = (at.address(), self.streams.len());
        if let Some((all, table_of_lane)) = dists.shared()
            && all.len() * REPEATS <= lanes
            && let Some(tables) = Tables::of(all)
        {
            let uniforms = self.streams.iter().map(|key| key.at(address).uniform());
            let column = draw_from(&tables, table_of_lane, uniforms, self.log_prior)?;
            return Ok(self.note(address, Column::Ints(Arc::new(column))));
        }
        let (streams, sums) = (self.streams, &mut *self.log_prior);
        let mut exact = true;
        let mut draw = |lane: usize| {
            let (draw, log) = dists.get(lane).sample_and_score(&mut streams[lane].at(address));
            exact &= add(&mut sums[lane], grid(log));
            draw
        };
        macro_rules! column {
            ($draw:path, $column:path, $first:expr) => {{
                let mut all = Vec::with_capacity(lanes);
                all.push($first);
                for lane in 1..lanes {
                    let $draw(x) = draw(lane) else { return Err(Divergence) };
                    all.push(x);
                }
                $column(Arc::new(all))
            }};
        }
        let column = match draw(0) {
            Draw::Real(x) => column!(Draw::Real, Column::Reals, x),
            Draw::Int(x) => column!(Draw::Int, Column::Ints, x),
            Draw::Bool(x) => column!(Draw::Bool, Column::Truths, x),
            _ => return Err(Divergence),
        };
        if !exact {
            return Err(Divergence);
        }
        Ok(self.note(address, column))
    }

    fn scores(&mut self, _: &At<'_, f64>, _: Factor, logs: Logs<'_>) -> Result<Answer<()>, Divergence> {
        // A score of minus infinity, or one that is none, is for single runs.
        let is_usual = |log: f64| log.abs() < NEAR;
        let exact = match logs {
            Logs::Shared(log) => {
                let log = grid(log);
                is_usual(log) && self.log_factors.iter_mut().all(|sum| add(sum, log))
            }
            Logs::Each(all) => {
                let both = self.log_factors.iter_mut().zip(all);
                both.fold(true, |exact, (sum, log)| exact & is_usual(*log) & add(sum, grid(*log)))
            }
        };
        if exact { Ok(Answer::Pause) } else { Err(Divergence) }
    }
}
