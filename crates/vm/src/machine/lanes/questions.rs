//! Choices and factors of lanes: asked once, answered for every lane.

use super::Apart;
use super::column::{Column, Side};
use super::interpret::Run;
use crate::builtins::{make_dist, quick_dist};
use crate::code::{Args, Site, SiteId, SiteKind, Source};
use crate::machine::Stop;
use crate::machine::answers::{Answer, At, Factor};
use crate::machine::budget;
use crate::machine::keep::Dropped;
use crate::machine::outcome::After;
use crate::machine::question::{LOGGED, as_dist, as_real};
use crate::value::{Dist, Family, Value, index, log_density, ops};

/// The distributions of a choice, one for each lane.
#[derive(Clone, Copy)]
pub enum Dists<'a> {
    /// The same in every lane.
    Same(&'a Dist),
    /// One of a few, by number.
    Among(&'a [&'a Dist], &'a [u32]),
    /// Each its own.
    Each(&'a [Dist]),
}

impl<'a> Dists<'a> {
    /// That of a lane.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> &'a Dist {
        match *self {
            Dists::Same(dist) => dist,
            Dists::Among(all, which) => all[which[lane] as usize],
            Dists::Each(all) => &all[lane],
        }
    }

    /// Those that they share, and the number of each lane's, or no numbers where it is the same one; `None` where each lane has
    /// its own.
    pub fn shared(&self) -> Option<(&[&'a Dist], &[u32])> {
        match self {
            Dists::Same(dist) => Some((std::slice::from_ref(dist), &[])),
            Dists::Among(all, which) => Some((all, which)),
            Dists::Each(_) => None,
        }
    }
}

/// The log scores of a factor, nats.
#[derive(Clone, Copy)]
pub enum Logs<'a> {
    /// The same in every lane.
    Same(f64),
    /// Each its own.
    Each(&'a [f64]),
}

/// Answers the questions of lanes.
pub trait LaneAnswers {
    /// The values of a random choice, one for each lane: numbers or truth values.
    ///
    /// # Errors
    /// The lanes cannot go on together.
    fn choices(&mut self, at: &At<'_, f64>, dists: Dists<'_>) -> Result<Column, Apart>;

    /// A factor of the scores.
    ///
    /// # Errors
    /// The lanes cannot go on together.
    fn scores(&mut self, at: &At<'_, f64>, factor: Factor, logs: Logs<'_>) -> Result<Answer<()>, Apart>;
}

/// Distributions with what they are read from.
enum Found {
    /// Built once for all.
    One(Dist),
    /// Elements of a list that all share.
    Elements(Value, Vec<u32>),
    /// The one in a value that all share.
    Value(Value),
    Each(Vec<Dist>),
}

impl Run<'_, '_> {
    /// Carries out a site.
    pub fn site<A: LaneAnswers>(&mut self, number: SiteId, answers: &mut A) -> Result<After, Apart> {
        let f = self.f;
        let site = &f.sites[number.0 as usize];
        match &site.kind {
            SiteKind::Sample(source) => {
                self.choose(site, *source, answers)?;
                Ok(After::Next)
            }
            SiteKind::Observe(_) | SiteKind::Factor | SiteKind::Condition => {
                if self.factor(site, answers)? == Answer::Pause {
                    self.lanes.state.pause(self.future, self.node, site.resumes_at(self.pc));
                    return Ok(After::Stop(Stop::Paused));
                }
                Ok(After::Next)
            }
            _ => self.other(number, site),
        }
    }

    /// The distributions of a question.
    fn dists(&mut self, source: Source, args: Args) -> Result<Found, Apart> {
        let f = self.f;
        let operands = &f.operands[args.range()];
        if let Source::Family(family) = source
            && budget::has_rows(family)
        {
            if operands.iter().any(|o| self.column(*o).is_some()) {
                return Err(Apart);
            }
            let r = self.registers();
            self.machine.charge_rows(&mut self.lanes.state, &Dropped, r, args, family)?;
        }
        match (source, operands) {
            (Source::Value, [only, ..]) => match self.column(*only) {
                None => Ok(Found::Value(self.value(*only).clone())),
                Some(_) => Err(Apart),
            },
            (Source::Element, [list, at, ..]) => match (self.column(*list), self.column(*at)) {
                (None, None) => Ok(Found::Value(index::index(self.value(*list), self.value(*at))?)),
                (None, Some(Column::Ints(all))) => {
                    // None is negative, and none is large: one look at the bits of all.
                    if all.iter().fold(0, |bits, at| bits | at) >> 32 != 0 {
                        return Err(Apart);
                    }
                    let numbers = all.iter().map(|at| *at as u32).collect();
                    Ok(Found::Elements(self.value(*list).clone(), numbers))
                }
                _ => Err(Apart),
            },
            (Source::Family(family), operands) => {
                if operands.iter().all(|o| self.column(*o).is_none()) {
                    let values: Vec<Value> = operands.iter().map(|o| self.value(*o).clone()).collect();
                    return Ok(Found::One(dist_of(family, &values)?));
                }
                let sides: Vec<Side> = operands.iter().map(|o| self.side(*o)).collect();
                let mut values: Vec<Value> = vec![Value::None; sides.len()];
                let dist = |lane| {
                    values.iter_mut().zip(&sides).for_each(|(value, side)| *value = side.get(lane));
                    dist_of(family, &values)
                };
                Ok(Found::Each((0..self.lanes.count).map(dist).collect::<Result<_, _>>()?))
            }
            _ => Err(Apart),
        }
    }

    fn choose<A: LaneAnswers>(&mut self, site: &Site, source: Source, answers: &mut A) -> Result<(), Apart> {
        let found = self.dists(source, site.args)?;
        let at = self.at(site);
        let column = found.with(|dists| answers.choices(&at, dists))?;
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

    /// The result of a site.
    fn store_at(&mut self, site: &Site, side: Side) {
        let register = self.registers().own + site.to.index();
        self.store(register, side);
    }

    fn factor<A: LaneAnswers>(&mut self, site: &Site, answers: &mut A) -> Result<Answer<()>, Apart> {
        let f = self.f;
        let last = site.args.len as usize - 1;
        let value = self.side(f.operands[site.args.start as usize + last]);
        let lanes = self.lanes.count;
        let (mut each, mut same) = (Vec::new(), 0.0);
        macro_rules! logs {
            ($of:expr) => {
                match &value {
                    Side::All(value) => same = $of(value)?,
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
                let log = |value: &Value| as_real(value).map_err(Apart::from);
                logs!(log);
                Factor::Factor
            }
            SiteKind::Condition => {
                let log = |value: &Value| {
                    let holds = ops::truth(value).map_err(Apart::from)?;
                    Ok::<_, Apart>(if holds { 0.0 } else { f64::NEG_INFINITY })
                };
                logs!(log);
                Factor::Condition
            }
            SiteKind::Observe(source) => {
                let found = self.dists(source, Args { len: last as u16, ..site.args })?;
                found.with(|dists| {
                    if let (Dists::Same(dist), Side::All(value)) = (dists, &value) {
                        same = log_density(dist, value)?;
                        return Ok(());
                    }
                    if let (Dists::Among(all, which), Side::All(value)) = (dists, &value) {
                        let logs = all.iter().map(|dist| log_density(dist, value));
                        let logs: Vec<f64> = logs.collect::<Result<_, _>>()?;
                        each.extend(which.iter().map(|at| logs[*at as usize]));
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
            _ => return Err(Apart),
        };
        let logs = if each.is_empty() { Logs::Same(same) } else { Logs::Each(&each) };
        answers.scores(&self.at(site), factor, logs)
    }
}

/// A distribution from its parameters, as a single run makes it.
fn dist_of(family: Family, values: &[Value]) -> Result<Dist, Apart> {
    let quick = match values {
        [a, b] => quick_dist(family, a, b),
        _ => None,
    };
    match quick {
        Some(dist) => Ok(dist),
        None => Ok(make_dist(family, values)?),
    }
}

impl Found {
    /// Passes the distributions on.
    fn with<T>(&self, then: impl FnOnce(Dists<'_>) -> Result<T, Apart>) -> Result<T, Apart> {
        match self {
            Found::One(dist) => then(Dists::Same(dist)),
            Found::Value(value) => then(Dists::Same(as_dist(value)?)),
            Found::Each(all) => then(Dists::Each(all)),
            Found::Elements(list, which) => {
                let most = which.iter().copied().max().unwrap_or(0);
                let element = |at: u32| {
                    let element = index::index_ref(list, &Value::Int(i64::from(at))).ok_or(Apart)?;
                    Ok::<_, Apart>(as_dist(element)?)
                };
                // Of a long list only the elements that are wanted are looked at.
                if most as usize <= which.len() {
                    let all: Vec<&Dist> = (0..=most).map(element).collect::<Result<_, _>>()?;
                    return then(Dists::Among(&all, which));
                }
                let all: Vec<&Dist> = which.iter().map(|at| element(*at)).collect::<Result<_, _>>()?;
                let numbers: Vec<u32> = (0..which.len() as u32).collect();
                then(Dists::Among(&all, &numbers))
            }
        }
    }
}
