//! The best of every kind: a search for several results that differ, around an archive of the best runs of each niche.
//!
//! 1. The search for the best is made as it is alone, so that the best result is no worse than without the archive.
//! 2. A population of low power and runs of the prior show the structure of the model: which finite choices and calls tell kinds apart (`structure`).
//!    It is fixed then. What tells niches apart follows from it, or from the names that a user gave (`niche`).
//! 3. Generations of short searches, side by side. Some turn one choice of a good run so that a niche comes that was never met, and
//!    grow what it brings; others improve the run of a promising niche with its choices held; where there are fewer niches
//!    than results, and a result may not be far below the best, others start from a population of their own. They end before
//!    three times the work of the first search, but there is at least one generation.
//! 4. The results are chosen by niche, then by look (`choose`, `look`).
//!
//! A generation is planned from the archive alone, and its searches are counted, so the bits do not depend on threads. The archive is
//! stored between two generations.

use super::choose::{ALIKE, Candidate, Rule, choose};
use super::look::{Cells, bounds, cells_of, grid};
use super::niche::Niches;
use super::rounds::{Learnt, PER_POPULATION, Search, best_of};
use super::structure::{Kind, Structure, below, steps, traced, turned};
use super::{Improve, Improved, Outputs, part_seed};
use niwaki_chain::walk::state::State;
use niwaki_chain::walk::streams::Streams;
use niwaki_geom::sketch::product::Sketches;
use niwaki_geom::{Aabb, Grid, vec3};
use niwaki_math::Stream;
use niwaki_particles::distinct::Choices;
use niwaki_particles::rejuvenation::spreads;
use niwaki_particles::{Progress, Settings, Watch, side_by_side, smc};
use niwaki_run::checkpoint::unfit;
use niwaki_run::hold::hold;
use niwaki_run::log::Log;
use niwaki_run::replay::{Choice, Trace, by_address};
use niwaki_run::run::{Run, Shown};
use niwaki_run::streams::Reserved;
use niwaki_run::{Failure, Task};
use niwaki_vm::machine::invalid::Counts;
use niwaki_vm::value::Value;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::time::{Duration, Instant};

/// The work of the whole search, in that of the search for the single best.
const TIMES: u64 = 4;
/// The least work of a first search without a number of rounds, in populations.
const LEAST: u64 = 4;
/// The number of short searches that are made side by side.
const GENERATION: usize = 8;
/// Most searches of a generation for new niches while there are fewer than results, and after that.
const NEW_FIRST: usize = 6;
const NEW_LATER: usize = 4;
/// Most searches for a niche that found no possible run; fewer than there are forms of populations.
const TRIES: u32 = 3;
/// Most turns that are tried for each search for a new niche.
const TURNS: usize = 8;
/// The number of rounds of a short search.
const ROUNDS: u64 = 2;
/// Most forward runs for the first state of a search.
const STARTS: u64 = 20;
/// The share of the particles of a population from which a short search starts.
const FRESH: f64 = 0.5;
/// The cost of a search without a gain, in nats, where a result may be any number of nats below the best.
const UNLIMITED: f64 = 3.0;
/// Least gain that counts, nats.
const LEAST_GAIN: f64 = 0.01;
/// Most niches of an archive.
const MOST: usize = 1000;
/// The part of a checkpoint that has the archive; the search for the best is part 0.
const PART: u64 = 1;

/// A run of the archive.
struct Entry {
    run: Run,
    kind: Kind,
    cells: Cells,
    /// Its choices that tell niches apart.
    features: Vec<Choice>,
    /// The gains that its search has learnt.
    learnt: Option<Learnt>,
}

/// The runs of a niche, best first.
struct Niche {
    entries: Vec<Entry>,
    /// The number of searches in it, and of those since the last gain.
    searches: u64,
    idle: u64,
}

/// A run of the archive as data.
#[derive(Serialize, Deserialize)]
struct StoredEntry<R> {
    run: R,
    learnt: Option<Learnt>,
}

/// A niche as data: its runs, the number of searches, and of those since the last gain.
type StoredNiche<R> = (Vec<StoredEntry<R>>, u64, u64);

/// The archive between two generations, as data. The number of searches, the work, the time.
#[derive(Serialize, Deserialize)]
struct Stored<R> {
    rules: Niches,
    bounds: Option<[[u64; 3]; 2]>,
    niches: Vec<StoredNiche<R>>,
    tried: BTreeMap<String, u32>,
    searches: u64,
    #[serde(default)]
    generations: u64,
    work: u64,
    #[serde(default)]
    last: u64,
    time: Duration,
    invalid: Counts,
}

/// A short search.
struct Job {
    /// Its number, from which its random streams follow.
    number: u64,
    /// The niche whose run it improves.
    niche: Option<Kind>,
    /// The choices that it holds.
    hold: Vec<Choice>,
    /// The values of other choices; `None` to start from a population.
    known: Option<HashMap<u128, Value>>,
    learnt: Option<Learnt>,
    /// The number of the form of its population; each further search for a niche takes another one.
    form: usize,
    /// The score below which the known values are no place to begin, nats: half of what a good run had is lost.
    least: f64,
}

/// The results of a short search: its best runs in order, with what it had learnt then, and its work.
type Outcome = Result<(Vec<(Run, Learnt)>, u64), Failure>;

/// The archive of a search.
struct Archive<'a> {
    improve: &'a Improve,
    task: &'a Task,
    /// The task without sketches, in which runs are replayed.
    bare: Task,
    seed: u64,
    count: usize,
    rules: Niches,
    bounds: Option<Aabb>,
    grid: Option<Grid>,
    niches: BTreeMap<Kind, Niche>,
    /// The number of searches that were made for a new niche, by its text.
    tried: BTreeMap<String, u32>,
    searches: u64,
    generations: u64,
    work: u64,
    /// The work of the last generation.
    last: u64,
}

/// Several results that differ, best first; a search for the best as it is alone comes first. Of a time it has its share of the work.
///
/// # Errors
/// A fault of the program, a name that the model does not have, or first populations that all died.
pub(super) fn search(
    improve: &Improve,
    task: &Task,
    seed: u64,
    count: usize,
    outputs: Outputs<'_>,
    watch: &mut Watch<'_>,
) -> Result<(Vec<Run>, Improved), Failure> {
    let seconds = improve.seconds.map(|seconds| seconds / TIMES as f64);
    let single = Improve { diverse: None, keeps_all: true, seconds, ..improve.clone() };
    let (mut best, mut info) = single.single(task, seed, 0, outputs, &mut |progress| watch(progress))?;
    let population = info.rounds.first().map_or(1, |round| round.work).max(1);
    let slice = (population / PER_POPULATION).max(1);
    // A search that ended at once, as nothing could be better, leaves other kinds the work of a few populations.
    let least = if improve.rounds.is_none() { LEAST * population } else { 0 };
    let first = info.rounds.iter().map(|round| round.work).sum::<u64>().max(least);
    if info.interrupted {
        // The best of the restarts so far.
        best.sort_by(|a, b| b.log_score.total_cmp(&a.log_score));
        best.truncate(count);
        return Ok((best, info));
    }
    // The count of invalid runs is separate, so that the archive is stored with its own count.
    let uncounted = &task.uncounted();
    let began = Instant::now();
    let stored: Option<Stored<Run>> =
        outputs.checkpoint.map_or(Ok(None), |checkpoint| checkpoint.left(PART))?;
    let before = stored.as_ref().map_or(Duration::ZERO, |stored| stored.time);
    let of_best = info.rounds.last().map_or(Duration::ZERO, |round| round.time);
    let time = improve.time();
    let mut archive = match stored {
        Some(stored) => Archive::restored(&single, uncounted, seed, count, stored)?,
        None => Archive::begin(&single, uncounted, seed, count, best, watch, &mut info.interrupted)?,
    };
    let spread = spreads(uncounted, seed)?;
    // A generation is given the time or the work of the last.
    let mut last = Duration::ZERO;
    while !info.interrupted {
        let elapsed = of_best + before + began.elapsed();
        let is_over = match (improve.generations, time) {
            (None, None) => archive.generations > 0 && archive.work + archive.last >= (TIMES - 1) * first,
            (most, time) => {
                most.is_some_and(|most| archive.generations >= most)
                    || time.is_some_and(|time| elapsed + last >= time)
            }
        };
        if is_over {
            break;
        }
        let store = || archive.stored(before + began.elapsed());
        outputs.checkpoint.inspect(|checkpoint| checkpoint.at_border(PART, store));
        let so_far = archive.work;
        let jobs = archive.plan()?;
        let shared = uncounted.shared_by(jobs.len());
        let (results, is_stopped) = side_by_side(jobs.len(), watch, |number, watch| {
            run(&single, &shared, seed, slice, &jobs[number], &spread, watch)
        });
        // A generation that was stopped is made again after a resume.
        info.interrupted |= is_stopped;
        for (job, result) in jobs.into_iter().zip(results) {
            archive.take(job, result)?;
        }
        archive.generations += u64::from(!is_stopped);
        archive.last = archive.work - so_far;
        last = (of_best + before + began.elapsed()).saturating_sub(elapsed);
        outputs.shown.inspect(|shown| archive.show(shown));
    }
    if let Some(checkpoint) = outputs.checkpoint.filter(|_| !info.interrupted) {
        checkpoint.store(PART, || archive.stored(before + began.elapsed()));
    }
    task.invalid.add(uncounted.invalid.counts());
    info.searches = 1 + archive.searches as usize;
    (info.niches, info.other_work, info.generations) =
        (archive.niches.len(), archive.work, archive.generations);
    let (runs, kinds): (Vec<Run>, Vec<Kind>) = archive.chosen().into_iter().unzip();
    info.kinds = kinds;
    Ok((runs, info))
}

impl<'a> Archive<'a> {
    /// The archive of a first population and of the best runs of the restarts.
    fn begin(
        improve: &'a Improve,
        task: &'a Task,
        seed: u64,
        count: usize,
        best: Vec<Run>,
        watch: &mut Watch<'_>,
        interrupted: &mut bool,
    ) -> Result<Archive<'a>, Failure> {
        let bare = Task { sketches: vec![], ..task.clone() };
        let settings = Settings {
            particles: improve.particles,
            seed: part_seed(seed, 0, 4),
            power: improve.power.min(1.0),
            proposal: improve.drawn_by.clone(),
            ..Settings::default()
        };
        let (mut runs, mut work) = (best, 0);
        match smc(task, &settings, watch) {
            Ok(result) => {
                work += result.steps;
                *interrupted |= result.interrupted;
                runs.extend(result.particles.into_iter().filter(|run| run.has_ended && run.cause.is_none()));
            }
            Err(failure) if failure.is_impossible() => {}
            Err(failure) => return Err(failure),
        }
        // The particles are akin; runs of the prior are not, and show what the model has.
        for number in 0..improve.particles.div_ceil(2) {
            let streams = Streams::new(part_seed(seed, number as u64, 8), 0);
            match State::tried(task, streams, 1, None) {
                Ok((state, ..)) => runs.push(state.run(&task.program, 0)),
                Err(Failure::NoStart { .. }) => {}
                Err(failure) if failure.is_impossible() => {}
                Err(failure) => return Err(failure),
            }
            work += runs.last().map_or(1, |run| run.primitives as u64 + 1);
        }
        let mut seen = HashSet::new();
        runs.retain(|run| seen.insert((run.log_score.to_bits(), run.log_prior.to_bits(), run.primitives)));
        runs.sort_by(|a, b| b.log_score.total_cmp(&a.log_score));
        let traces = runs.iter().map(|run| traced(&bare, known_of(run), 0)).collect::<Result<Vec<_>, _>>()?;
        work += traces.iter().map(steps).sum::<u64>();
        let all: Vec<&Trace> = traces.iter().collect();
        let around = bounds(traces.iter().flat_map(|trace| &trace.parts));
        let grid = grid(&around);
        let structure = match &grid {
            Some(grid) => {
                let mut rng = Reserved::Improve.stream(seed, 0, 5);
                let (structure, steps) = Structure::measured(&bare, &all, grid, &mut rng)?;
                work += steps;
                structure
            }
            None => Structure::of_choices(traces.iter()),
        };
        let rules = Niches::of(&improve.by, improve.bins, structure, &all)?;
        let bounds = grid.is_some().then_some(around);
        let mut archive = Archive {
            improve,
            task,
            bare,
            seed,
            count,
            rules,
            bounds,
            grid,
            niches: BTreeMap::new(),
            tried: BTreeMap::new(),
            searches: 0,
            generations: 0,
            work,
            last: 0,
        };
        for (run, trace) in runs.into_iter().zip(&traces) {
            archive.insert(run, trace, None);
        }
        Ok(archive)
    }

    /// The archive as data.
    fn stored(&self, time: Duration) -> Stored<&Run> {
        let niches = self.niches.values().map(|niche| {
            let entries = niche
                .entries
                .iter()
                .map(|entry| StoredEntry { run: &entry.run, learnt: entry.learnt.clone() });
            (entries.collect(), niche.searches, niche.idle)
        });
        let bits = |at: niwaki_geom::Vec3| at.to_array().map(f64::to_bits);
        Stored {
            rules: self.rules.clone(),
            bounds: self.bounds.map(|bounds| [bits(bounds.low), bits(bounds.high)]),
            niches: niches.collect(),
            tried: self.tried.clone(),
            searches: self.searches,
            generations: self.generations,
            work: self.work,
            last: self.last,
            time,
            invalid: self.task.invalid.counts(),
        }
    }

    /// The archive from its data.
    ///
    /// # Errors
    /// Data of another model.
    fn restored(
        improve: &'a Improve,
        task: &'a Task,
        seed: u64,
        count: usize,
        stored: Stored<Run>,
    ) -> Result<Archive<'a>, Failure> {
        let point = |bits: [u64; 3]| {
            let [x, y, z] = bits.map(f64::from_bits);
            vec3(x, y, z)
        };
        let bounds = stored.bounds.map(|[low, high]| Aabb { low: point(low), high: point(high) });
        task.invalid.add(stored.invalid);
        let mut archive = Archive {
            improve,
            task,
            bare: Task { sketches: vec![], ..task.uncounted() },
            seed,
            count,
            rules: stored.rules,
            bounds,
            grid: bounds.as_ref().and_then(grid),
            niches: BTreeMap::new(),
            tried: stored.tried,
            searches: stored.searches,
            generations: stored.generations,
            work: stored.work,
            last: stored.last,
        };
        for (entries, searches, idle) in stored.niches {
            let mut niche = Niche { entries: vec![], searches, idle };
            let mut key = None;
            for StoredEntry { run, learnt } in entries {
                let trace = traced(&archive.bare, known_of(&run), 0)?;
                key = Some(archive.rules.niche(&trace));
                let run = Run { value: trace.run.value.clone(), is_bare: false, ..run };
                niche.entries.push(archive.entry(run, &trace, learnt));
            }
            let key = key.ok_or_else(|| unfit("a niche without runs"))?;
            archive.niches.insert(key, niche);
        }
        Ok(archive)
    }

    /// A run with what the archive knows of it.
    fn entry(&self, run: Run, trace: &Trace, learnt: Option<Learnt>) -> Entry {
        let is_free = |choice: &&Choice| {
            let is_held = |held: &niwaki_vm::machine::held::Held| held.find(choice.address).is_some();
            self.rules.has(choice) && !self.task.held.as_deref().is_some_and(is_held)
        };
        Entry {
            run,
            kind: self.rules.niche(trace),
            cells: self.grid.as_ref().map_or_else(Cells::default, |grid| cells_of(&trace.parts, grid)),
            features: trace.choices.iter().filter(is_free).cloned().collect(),
            learnt,
        }
    }

    /// Adds a run, unless a better one of its niche looks the same.
    fn insert(&mut self, run: Run, trace: &Trace, learnt: Option<Learnt>) {
        let entry = self.entry(run, trace, learnt);
        let (results, niches) = (2 * self.count, self.niches.len().max(1));
        let room = results.div_ceil(niches).max(2);
        let fresh = Niche { entries: vec![], searches: 0, idle: 0 };
        let niche = self.niches.entry(entry.kind.clone()).or_insert(fresh);
        let better = |other: &Entry| other.run.log_score >= entry.run.log_score;
        if niche.entries.iter().any(|other| better(other) && are_alike(other, &entry)) {
            return;
        }
        niche.entries.retain(|other| better(other) || !are_alike(other, &entry));
        let place = niche.entries.partition_point(better);
        niche.entries.insert(place, entry);
        niche.entries.truncate(room);
        if self.niches.len() > MOST.max(2 * self.count) {
            let score = |niche: &Niche| niche.entries.first().map_or(f64::NEG_INFINITY, |e| e.run.log_score);
            let worst = self.niches.iter().min_by(|a, b| score(a.1).total_cmp(&score(b.1)));
            if let Some(worst) = worst.map(|(key, _)| key.clone()) {
                self.niches.remove(&worst);
            }
        }
    }

    /// Shows the best run.
    fn show(&mut self, shown: &Shown) {
        let score = |niche: &Niche| niche.entries[0].run.log_score;
        let best = self.niches.values_mut().max_by(|a, b| score(a).total_cmp(&score(b)));
        best.into_iter().for_each(|niche| niche.entries[0].run.show(shown));
    }

    /// The niches by the score of their best run.
    fn ranked(&self) -> Vec<(&Kind, &Niche)> {
        let mut ranked: Vec<_> = self.niches.iter().collect();
        ranked.sort_by(|a, b| b.1.entries[0].run.log_score.total_cmp(&a.1.entries[0].run.log_score));
        ranked
    }

    /// The searches of the next generation.
    ///
    /// # Errors
    /// A fault of the program.
    fn plan(&mut self) -> Result<Vec<Job>, Failure> {
        let mut rng = Reserved::Improve.stream(self.seed, u128::from(self.searches), 6);
        let (mut jobs, few) = (vec![], self.niches.len() < self.count);
        let new_searches = if few { NEW_FIRST } else { NEW_LATER };
        let (mut tried, mut work) = (vec![], 0);
        let ranked = self.ranked();
        for _ in 0..TURNS * new_searches {
            if jobs.len() == new_searches {
                break;
            }
            let (turn, steps) = self.turned(&ranked, &mut rng)?;
            work += steps;
            let Some((job, key)) = turn else { continue };
            let name = format!("{key:?}");
            if self.niches.contains_key(&key) || tried.contains(&name) || self.tries(&name) >= TRIES {
                continue;
            }
            let form = self.tries(&name) as usize;
            tried.push(name);
            jobs.push(Job { form, ..job });
        }
        // Where no turn brings a new niche, second runs of the best niches; none where every niche counts, however far below the best.
        let margin = self.improve.margin;
        let has_seconds = few && margin.is_some();
        let seconds = if has_seconds { new_searches.saturating_sub(jobs.len()) } else { 0 };
        for (key, niche) in ranked.iter().cycle().take(seconds) {
            let (niche, hold) = (Some((*key).clone()), niche.entries[0].features.clone());
            jobs.push(Job {
                number: 0,
                niche,
                hold,
                known: None,
                learnt: None,
                least: f64::NEG_INFINITY,
                form: 0,
            });
        }
        // Half of the others, or all where every niche counts, go to those of the best niches that had the fewest searches, the rest to the
        // most promising ones: a search without a gain counts as `margin` nats.
        let room = GENERATION.saturating_sub(jobs.len());
        let mut neglected: Vec<_> = ranked.iter().copied().take(self.count).collect();
        neglected.sort_by_key(|(_, niche)| niche.searches);
        neglected.truncate(if margin.is_some() { room / 2 } else { room });
        let mut promising = ranked;
        let margin = margin.unwrap_or(UNLIMITED);
        let promise = |niche: &Niche| niche.entries[0].run.log_score - margin * niche.idle as f64;
        promising.sort_by(|a, b| promise(b.1).total_cmp(&promise(a.1)));
        promising.retain(|(key, _)| neglected.iter().all(|(other, _)| other != key));
        for (key, niche) in neglected.into_iter().chain(promising).take(room) {
            let runs = if has_seconds { niche.entries.len() } else { 1 };
            let entry = &niche.entries[niche.searches as usize % runs];
            jobs.push(Job {
                number: 0,
                niche: Some(key.clone()),
                hold: entry.features.clone(),
                known: Some(known_of(&entry.run)),
                learnt: entry.learnt.clone(),
                least: f64::NEG_INFINITY,
                form: 0,
            });
        }
        for job in &mut jobs {
            job.number = self.searches;
            self.searches += 1;
        }
        for name in tried {
            if self.tried.len() < MOST || self.tried.contains_key(&name) {
                *self.tried.entry(name).or_default() += 1;
            }
        }
        // Work is counted even where a plan has no search, so that every search ends.
        self.work += work.max(1);
        Ok(jobs)
    }

    /// The number of searches for a new niche.
    fn tries(&self, name: &str) -> u32 {
        self.tried.get(name).copied().unwrap_or(0)
    }

    /// A search in the niche of a good run with one choice turned, and that niche; `None` if the run has no such choice, or
    /// takes no other value. Also returns the work of the turn.
    ///
    /// # Errors
    /// A fault of the program.
    fn turned(
        &self,
        ranked: &[(&Kind, &Niche)],
        rng: &mut Stream,
    ) -> Result<(Option<(Job, Kind)>, u64), Failure> {
        // Better niches are turned more often.
        let place = below(rng, ranked.len()).min(below(rng, ranked.len()));
        let Some(entry) = ranked.get(place).and_then(|(_, niche)| niche.entries.first()) else {
            return Ok((None, 0));
        };
        if entry.features.is_empty() {
            return Ok((None, 0));
        }
        let choice = &entry.features[below(rng, entry.features.len())];
        let mut rest = known_of(&entry.run);
        let (trace, replays) = turned(&self.bare, &rest, choice, rng)?;
        let work = replays * (entry.run.primitives as u64 + 1);
        let Some(trace) = trace else { return Ok((None, work)) };
        rest.remove(&choice.address);
        let hold = self.entry(Run::default(), &trace, None).features;
        let empty = Sketches::start(&self.task.sketches).total().value();
        let least = 0.5 * (entry.run.log_score + empty);
        let job = Job { number: 0, niche: None, hold, known: Some(rest), learnt: None, least, form: 0 };
        Ok((Some((job, self.rules.niche(&trace))), work))
    }

    /// Takes the results of a search.
    ///
    /// # Errors
    /// A fault of the program.
    fn take(&mut self, job: Job, result: Outcome) -> Result<(), Failure> {
        let (runs, work) = result?;
        self.work += work;
        let best = |archive: &Archive<'_>, key: &Kind| {
            archive.niches.get(key).map_or(f64::NEG_INFINITY, |niche| niche.entries[0].run.log_score)
        };
        let before = job.niche.as_ref().map(|key| best(self, key));
        for (run, learnt) in runs {
            let trace = traced(&self.bare, known_of(&run), 0)?;
            self.work += steps(&trace);
            self.insert(run, &trace, Some(learnt));
        }
        if let (Some(key), Some(before)) = (job.niche, before) {
            let gain = best(self, &key) - before;
            if let Some(niche) = self.niches.get_mut(&key) {
                niche.searches += 1;
                niche.idle = if gain < LEAST_GAIN { niche.idle + 1 } else { 0 };
            }
        }
        Ok(())
    }

    /// The results, best first, and their niches.
    fn chosen(self) -> Vec<(Run, Kind)> {
        let mut all: Vec<(usize, Entry)> = vec![];
        for (number, niche) in self.niches.into_values().enumerate() {
            all.extend(niche.entries.into_iter().map(|entry| (number, entry)));
        }
        all.sort_by(|a, b| b.1.run.log_score.total_cmp(&a.1.run.log_score));
        let candidates: Vec<Candidate<'_>> = all
            .iter()
            .map(|(niche, entry)| Candidate {
                score: entry.run.log_score,
                niche: *niche,
                cells: &entry.cells,
            })
            .collect();
        let by = &self.improve.by;
        let rule = Rule {
            count: self.count,
            margin: self.improve.margin.unwrap_or(f64::INFINITY),
            by_look: by.is_look(),
            each: by.is_named(),
        };
        let choices = Choices::of(all.iter().map(|(_, entry)| &entry.run.log));
        let places = choose(&candidates, &rule, &|a, b| choices.differ(a, b));
        let runs = all.into_iter().enumerate().filter(|(place, _)| places.binary_search(place).is_ok());
        runs.map(|(_, (_, entry))| (entry.run, entry.kind)).collect()
    }
}

/// The choices of a run by address.
fn known_of(run: &Run) -> HashMap<u128, Value> {
    by_address(&run.log.entries())
}

/// Whether two runs look the same; for scenes without cells, whether they share most of their choices.
fn are_alike(a: &Entry, b: &Entry) -> bool {
    if a.cells.count() + b.cells.count() > 0 {
        return a.cells.in_common(&b.cells) > ALIKE;
    }
    let logs: [&Log; 2] = [&a.run.log, &b.run.log];
    !Choices::of(logs.into_iter()).differ(0, 1)
}

/// Makes a short search: from known values or from a population, with choices held.
fn run(
    improve: &Improve,
    task: &Task,
    seed: u64,
    slice: u64,
    job: &Job,
    spreads: &HashMap<u128, f64>,
    watch: &mut dyn FnMut(Progress) -> bool,
) -> Outcome {
    let seed = part_seed(seed, job.number, 7);
    let mut choices = task.held.as_deref().map_or_else(Vec::new, |held| held.choices().to_vec());
    choices.extend(job.hold.iter().map(|choice| (choice.path.clone(), choice.value.clone())));
    let held = hold(task, choices)?;
    let mut work = 0;
    let known = job.known.as_ref();
    let state = match known.map(|known| State::tried(&held, Streams::new(seed, 0), STARTS, Some(known))) {
        Some(Ok((state, _, tries))) => {
            work += tries * state.primitives as u64;
            Some(state)
        }
        Some(Err(Failure::NoStart { .. })) | None => None,
        Some(Err(failure)) if failure.is_impossible() => None,
        Some(Err(failure)) => return Err(failure),
    };
    let turned = state.map(|state| (state.run(&held.program, 0), state));
    let start = match turned {
        Some(turned) if turned.0.log_score >= job.least => turned,
        turned => {
            let particles = (FRESH * improve.particles as f64).ceil() as usize;
            let (fewer, mut attempts) = (Improve { particles, ..improve.clone() }, vec![]);
            match fewer
                .start(&held, seed, job.form, &mut attempts, &mut |progress| watch(progress), &|| false)
            {
                Ok(result) => {
                    work += result.steps;
                    if result.interrupted {
                        return Ok((vec![], work));
                    }
                    let grown = best_of(&held, result)?;
                    turned.into_iter().fold(grown, |a, b| if b.0.log_score > a.0.log_score { b } else { a })
                }
                Err(failure) if failure.is_impossible() => match turned {
                    Some(turned) => turned,
                    None => return Ok((vec![], work + slice)),
                },
                Err(failure) => return Err(failure),
            }
        }
    };
    let mut search = Search::at(improve, &held, seed, slice, start, job.learnt.clone(), spreads.clone());
    let (mut runs, mut shown) = (vec![], None);
    for number in 0..=ROUNDS {
        let score = search.best.log_score;
        if shown.is_none_or(|shown| score > shown) {
            shown = Some(score);
            work += search.best.primitives as u64 + 1;
            if let Some(run) = scored(task, job, &search.best)? {
                runs.push((run, search.learnt()));
            }
        }
        if number < ROUNDS {
            let mut may_continue =
                |best: f64| watch(Progress { barriers: job.number as usize, ended: 1, best });
            let (_, spent, _) = search.round(number, &mut may_continue)?;
            work += spent;
        }
    }
    Ok((runs, work.max(1)))
}

/// A run of a search with held choices, scored without them. `None` if it is impossible without them.
fn scored(task: &Task, job: &Job, run: &Run) -> Result<Option<Run>, Failure> {
    let mut known = known_of(run);
    known.extend(job.hold.iter().map(|choice| (choice.address, choice.value.clone())));
    match State::start(task, Streams::new(0, 0), 1, Some(&known)) {
        Ok((state, _)) => Ok(Some(state.run(&task.program, 0))),
        Err(Failure::NoStart { .. }) => Ok(None),
        Err(failure) if failure.is_impossible() => Ok(None),
        Err(failure) => Err(failure),
    }
}
