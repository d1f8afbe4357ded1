//! Choices and factors of lanes: asked once, and answered for all lanes.

use super::Divergence;
use super::column::{Column, Side};
use super::interpret::Run;
use crate::builtins::{make_dist, quick_dist};
use crate::code::{Args, Site, SiteId, SiteKind, Source};
use crate::machine::Stop;
use crate::machine::answers::{Answer, At, Factor};
use crate::machine::budget;
use crate::machine::keep::Dropped;
use crate::machine::outcome::Continuation;
use crate::machine::question::{LOGGED, as_dist, as_real};
use crate::value::{Dist, Family, Value, index, log_density, ops};

/// The distributions of a choice, one for each lane.
#[derive(Clone, Copy)]
pub enum Dists<'a> {
    /// One distribution, which all lanes share.
    Shared(&'a Dist),
    /// A few distributions, and the number of each lane's distribution among them.
    Among(&'a [&'a Dist], &'a [u32]),
    /// A distribution for each lane.
    Each(&'a [Dist]),
}

impl<'a> Dists<'a> {
    /// The distribution of a lane.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> &'a Dist {
        match *self {
            Dists::Shared(dist) => dist,
            Dists::Among(all, numbers) => all[numbers[lane] as usize],
            Dists::Each(all) => &all[lane],
        }
    }

    /// The distributions that lanes share, and the number of each lane's distribution. There are no numbers if
    /// all lanes share one distribution; `None` if each lane has its own.
    pub fn shared(&self) -> Option<(&[&'a Dist], &[u32])> {
        match self {
            Dists::Shared(dist) => Some((std::slice::from_ref(dist), &[])),
            Dists::Among(all, numbers) => Some((all, numbers)),
            Dists::Each(_) => None,
        }
    }
}

/// The log scores of a factor, in nats.
#[derive(Clone, Copy)]
pub enum Logs<'a> {
    /// One score, which all lanes share.
    Shared(f64),
    /// A score for each lane.
    Each(&'a [f64]),
}

/// The answers to the questions of lanes.
pub trait LaneAnswers {
    /// The values of a random choice, one for each lane: numbers or truth values.
    ///
    /// # Errors
    /// The lanes cannot continue together.
    fn choices(&mut self, at: &At<'_, f64>, dists: Dists<'_>) -> Result<Column, Divergence>;

    /// A factor of the scores.
    ///
    /// # Errors
    /// The lanes cannot continue together.
    fn scores(&mut self, at: &At<'_, f64>, factor: Factor, logs: Logs<'_>) -> Result<Answer<()>, Divergence>;
}

/// The distributions of a question, with the data that they refer to.
enum DistColumn {
    /// One distribution, which was built for all lanes.
    Shared(Dist),
    /// Elements of a list that all lanes share.
    Elements(Value, Vec<u32>),
    /// The distribution in a value that all lanes share.
    Value(Value),
    Each(Vec<Dist>),
}

impl Run<'_, '_> {
    /// Runs a site.
    pub fn site<A: LaneAnswers>(
        &mut self,
        number: SiteId,
        answers: &mut A,
    ) -> Result<Continuation, Divergence> {
        let f = self.f;
        let site = &f.sites[number.0 as usize];
        match &site.kind {
            SiteKind::Sample(source) => {
                self.choose(site, *source, answers)?;
                Ok(Continuation::Next)
            }
            SiteKind::Observe(_) | SiteKind::Factor | SiteKind::Condition => {
                if self.factor(site, answers)? == Answer::Pause {
                    self.lanes.state.pause(self.future, self.node, site.resumes_at(self.pc));
                    return Ok(Continuation::Stop(Stop::Paused));
                }
                Ok(Continuation::Next)
            }
            _ => self.other(number, site),
        }
    }

    /// The distributions of a question.
    fn dists(&mut self, source: Source, args: Args) -> Result<DistColumn, Divergence> {
        let f = self.f;
        let operands = &f.operands[args.range()];
        if let Source::Family(family) = source
            && budget::has_rows(family)
        {
            if operands.iter().any(|o| self.column(*o).is_some()) {
                return Err(Divergence);
            }
            let r = self.registers();
            self.machine.charge_rows(&mut self.lanes.state, &Dropped, r, args, family)?;
        }
        match (source, operands) {
            (Source::Value, [only, ..]) => match self.column(*only) {
                None => Ok(DistColumn::Value(self.value(*only).clone())),
                Some(_) => Err(Divergence),
            },
            (Source::Element, [list, at, ..]) => match (self.column(*list), self.column(*at)) {
                (None, None) => Ok(DistColumn::Value(index::index(self.value(*list), self.value(*at))?)),
                (None, Some(Column::Ints(all))) => {
                    // No number is negative, and none is large: one test of the bits of all numbers.
                    if all.iter().fold(0, |bits, at| bits | at) >> 32 != 0 {
                        return Err(Divergence);
                    }
                    let numbers = all.iter().map(|at| *at as u32).collect();
                    Ok(DistColumn::Elements(self.value(*list).clone(), numbers))
                }
                _ => Err(Divergence),
            },
            (Source::Family(family), operands) => {
                if operands.iter().all(|o| self.column(*o).is_none()) {
                    let values: Vec<Value> = operands.iter().map(|o| self.value(*o).clone()).collect();
                    return Ok(DistColumn::Shared(dist_of(family, &values)?));
                }
                let sides: Vec<Side> = operands.iter().map(|o| self.side(*o)).collect();
                let mut values: Vec<Value> = vec![Value::None; sides.len()];
                let dist = |lane| {
                    values.iter_mut().zip(&sides).for_each(|(value, side)| *value = side.get(lane));
                    dist_of(family, &values)
                };
                Ok(DistColumn::Each((0..self.lanes.count).map(dist).collect::<Result<_, _>>()?))
            }
            _ => Err(Divergence),
        }
    }

    fn choose<A: LaneAnswers>(
        &mut self,
        site: &Site,
        source: Source,
        answers: &mut A,
    ) -> Result<(), Divergence> {
        let dists = self.dists(source, site.parameters())?;
        let at = self.at(site);
        let column = dists.with(|dists| answers.choices(&at, dists))?;
        self.lanes.state.logged += LOGGED;
        self.store_at(site, Side::Each(column));
        Ok(())
    }

    fn at<'a>(&'a self, site: &'a Site) -> At<'a, f64> {
        At {
            site,
            function: self.f,
            node: self.node,
            state: &self.lanes.state,
            program: self.machine.program,
        }
    }

    /// Stores the result of a site.
    fn store_at(&mut self, site: &Site, side: Side) {
        let register = self.registers().base + site.to.index();
        self.store(register, side);
    }

    fn factor<A: LaneAnswers>(&mut self, site: &Site, answers: &mut A) -> Result<Answer<()>, Divergence> {
        let f = self.f;
        let last = site.args.len as usize - 1;
        let value = self.side(f.operands[site.args.start as usize + last]);
        let lanes = self.lanes.count;
        let (mut each, mut shared) = (Vec::new(), 0.0);
        macro_rules! logs {
            ($of:expr) => {
                match &value {
                    Side::All(value) => shared = $of(value)?,
                    Side::Each(column) => {
                        each.reserve(lanes);
                        for lane in 0..lanes {
                            each.push($of(&column.get(lane))?);
                        }
                    }
                }
            };
        }
        let factor = match site.kind {
            SiteKind::Factor => {
                let log = |value: &Value| as_real(value).map_err(Divergence::from);
                logs!(log);
                Factor::Factor
            }
            SiteKind::Condition => {
                let log = |value: &Value| {
                    let holds = ops::truth(value).map_err(Divergence::from)?;
                    Ok::<_, Divergence>(if holds { 0.0 } else { f64::NEG_INFINITY })
                };
                logs!(log);
                Factor::Condition
            }
            SiteKind::Observe(source) => {
                let dists = self.dists(source, site.parameters())?;
                dists.with(|dists| {
                    if let (Dists::Shared(dist), Side::All(value)) = (dists, &value) {
                        shared = log_density(dist, value)?;
                        return Ok(());
                    }
                    if let (Dists::Among(all, numbers), Side::All(value)) = (dists, &value) {
                        let logs = all.iter().map(|dist| log_density(dist, value));
                        let logs: Vec<f64> = logs.collect::<Result<_, _>>()?;
                        each.extend(numbers.iter().map(|at| logs[*at as usize]));
                        return Ok(());
                    }
                    each.reserve(lanes);
                    for lane in 0..lanes {
                        let dist = dists.get(lane);
                        each.push(match &value {
                            Side::All(value) => log_density(dist, value)?,
                            Side::Each(column) => log_density(dist, &column.get(lane))?,
                        });
                    }
                    Ok(())
                })?;
                if site.is_read {
                    self.store_at(site, value);
                }
                Factor::Observe
            }
            _ => return Err(Divergence),
        };
        let logs = if each.is_empty() { Logs::Shared(shared) } else { Logs::Each(&each) };
        answers.scores(&self.at(site), factor, logs)
    }
}

/// Builds a distribution from its parameters, as a single run does.
fn dist_of(family: Family, values: &[Value]) -> Result<Dist, Divergence> {
    let quick = match values {
        [a, b] => quick_dist(family, a, b),
        _ => None,
    };
    match quick {
        Some(dist) => Ok(dist),
        None => Ok(make_dist(family, values)?),
    }
}

impl DistColumn {
    /// Passes the distributions to a function.
    fn with<T>(&self, then: impl FnOnce(Dists<'_>) -> Result<T, Divergence>) -> Result<T, Divergence> {
        match self {
            DistColumn::Shared(dist) => then(Dists::Shared(dist)),
            DistColumn::Value(value) => then(Dists::Shared(as_dist(value)?)),
            DistColumn::Each(all) => then(Dists::Each(all)),
            DistColumn::Elements(list, wanted_elements) => {
                let most = wanted_elements.iter().copied().max().unwrap_or(0);
                let element = |at: u32| {
                    let element = index::index_ref(list, &Value::Int(i64::from(at))).ok_or(Divergence)?;
                    Ok::<_, Divergence>(as_dist(element)?)
                };
                // Of a long list, only the required elements are read.
                if most as usize <= wanted_elements.len() {
                    let all: Vec<&Dist> = (0..=most).map(element).collect::<Result<_, _>>()?;
                    return then(Dists::Among(&all, wanted_elements));
                }
                let all: Vec<&Dist> =
                    wanted_elements.iter().map(|at| element(*at)).collect::<Result<_, _>>()?;
                let numbers: Vec<u32> = (0..wanted_elements.len() as u32).collect();
                then(Dists::Among(&all, &numbers))
            }
        }
    }
}
