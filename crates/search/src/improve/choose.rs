//! The choice of results from an archive: the best of different niches, then runs that look different.

use super::look::Cells;

/// Runs whose scenes have more than this share of their cells in common look alike.
pub(super) const ALIKE: f64 = 0.8;

/// The knowledge of a run.
pub(super) struct Candidate<'a> {
    pub score: f64,
    /// The number of its niche.
    pub niche: usize,
    pub cells: &'a Cells,
}

/// The rule of a choice.
pub(super) struct Rule {
    pub count: usize,
    /// The most nats below the best for a run of another niche to come before a second run of one niche.
    pub margin: f64,
    /// Whether only looks count.
    pub by_look: bool,
    /// Whether a run of every niche comes before any second run.
    pub each: bool,
}

/// How different two runs look, 0 to 1; `differ` decides for scenes without cells.
fn distance(a: usize, b: usize, of: &[Candidate<'_>], differ: &dyn Fn(usize, usize) -> bool) -> f64 {
    let (first, second) = (of[a].cells, of[b].cells);
    match (first.count(), second.count()) {
        (0, 0) => f64::from(u8::from(differ(a, b))),
        _ => 1.0 - first.in_common(second),
    }
}

/// Places of up to `rule.count` candidates, which are ranked by score; the places are in this order.
pub(super) fn choose(
    candidates: &[Candidate<'_>],
    rule: &Rule,
    differ: &dyn Fn(usize, usize) -> bool,
) -> Vec<usize> {
    let Some(best) = candidates.first() else { return vec![] };
    let is_good = |place: usize| candidates[place].score >= best.score - rule.margin;
    let mut chosen: Vec<usize> = vec![];
    let new_niches = |chosen: &mut Vec<usize>, is_in: &dyn Fn(usize) -> bool| {
        for place in 0..candidates.len() {
            let is_new = chosen.iter().all(|other| candidates[*other].niche != candidates[place].niche);
            if chosen.len() < rule.count && is_new && is_in(place) {
                chosen.push(place);
            }
        }
    };
    if rule.by_look {
        chosen.push(0);
    } else {
        new_niches(&mut chosen, &|place| rule.each || is_good(place));
    }
    // The farthest from those that are chosen, as long as it looks different.
    let mut away = vec![f64::INFINITY; candidates.len()];
    let mut counted = 0;
    let mut farthest = |chosen: &mut Vec<usize>, is_in: &dyn Fn(usize) -> bool| {
        while chosen.len() < rule.count {
            for other in &chosen[counted..] {
                for (place, least) in away.iter_mut().enumerate() {
                    *least = least.min(distance(place, *other, candidates, differ));
                }
            }
            counted = chosen.len();
            let free = (0..candidates.len()).filter(|place| is_in(*place) && away[*place] >= 1.0 - ALIKE);
            let next = free.reduce(|a, b| if away[b] > away[a] { b } else { a });
            let Some(next) = next else { break };
            chosen.push(next);
        }
    };
    farthest(&mut chosen, &is_good);
    if rule.by_look {
        farthest(&mut chosen, &|_| true);
    } else {
        new_niches(&mut chosen, &|_| true);
        farthest(&mut chosen, &|_| true);
    }
    chosen.sort_unstable();
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places of the chosen among runs given as (score, niche, cells).
    fn chosen(runs: &[(f64, usize, &[u32])], count: usize, margin: f64, by_look: bool) -> Vec<usize> {
        let cells: Vec<Cells> = runs.iter().map(|run| Cells::of(run.2)).collect();
        let candidates: Vec<Candidate<'_>> = runs
            .iter()
            .zip(&cells)
            .map(|(run, cells)| Candidate { score: run.0, niche: run.1, cells })
            .collect();
        choose(&candidates, &Rule { count, margin, by_look, each: false }, &|_, _| true)
    }

    const RUNS: [(f64, usize, &[u32]); 5] = [
        (-1.0, 0, &[1, 2, 3, 4]),
        (-1.5, 0, &[1, 2, 3, 4]),
        (-2.0, 1, &[1, 2, 3, 9]),
        (-2.5, 0, &[5, 6, 7, 8]),
        (-9.0, 2, &[1, 2, 7, 8]),
    ];

    #[test]
    fn the_best_of_each_kind_comes_first() {
        assert_eq!(chosen(&RUNS, 1, 3.0, false), [0]);
        assert_eq!(chosen(&RUNS, 2, 3.0, false), [0, 2]);
        // A second look of the first kind is better than a kind that is far below the best.
        assert_eq!(chosen(&RUNS, 3, 3.0, false), [0, 2, 3]);
        assert_eq!(chosen(&RUNS, 3, 10.0, false), [0, 2, 4]);
        assert_eq!(chosen(&RUNS, 4, 3.0, false), [0, 2, 3, 4]);
        // The second run is the first again.
        assert_eq!(chosen(&RUNS, 5, 3.0, false), [0, 2, 3, 4]);
    }

    #[test]
    fn by_look_kinds_do_not_count() {
        assert_eq!(chosen(&RUNS, 2, 3.0, true), [0, 3]);
        assert_eq!(chosen(&RUNS, 3, 2.0, true), [0, 2, 3]);
        assert_eq!(chosen(&RUNS, 3, 0.5, true), [0, 3, 4]);
    }
}
