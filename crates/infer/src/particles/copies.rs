//! Copies at a resampling: survivors stay where they are, their further copies take the places of those that get
//! none. Families are copied side by side, and a large family by its own members.

use super::advance::Particle;

/// Copies of one parent that one task makes, one after the other.
const ONE_BY_ONE: usize = 4;

/// A parent and the places of its further copies, each with the lineage that it gets.
type Family<'a> = (&'a mut Particle, Vec<(u64, &'a mut Particle)>);

/// Makes row `i` survive `copies[i]` times. `ancestor` becomes that of the new rows; `lineages` counts those given out.
pub(super) fn copy(
    particles: &mut [Particle],
    copies: &[usize],
    ancestor: &mut [usize],
    lineages: &mut u64,
    seed: u64,
    parallel: bool,
) {
    let mut free = copies.iter().enumerate().filter(|(_, c)| **c == 0).map(|(row, _)| row);
    // Parent and place, parents ascending; lineages are given out in this order, whatever thread copies.
    let mut moves: Vec<(usize, usize)> = Vec::new();
    for (row, &count) in copies.iter().enumerate() {
        moves.extend((1..count).map_while(|_| free.next().map(|to| (row, to))));
    }
    let first = *lineages;
    *lineages += moves.len() as u64;
    for &(row, to) in &moves {
        ancestor[to] = ancestor[row];
    }
    if !parallel {
        for (i, &(row, to)) in moves.iter().enumerate() {
            let [parent, child] = pair(particles, row, to);
            child.copy_from(parent, first + i as u64, seed);
        }
        return;
    }
    let mut rows: Vec<Option<&mut Particle>> = particles.iter_mut().map(Some).collect();
    let mut families: Vec<Family<'_>> = Vec::new();
    let mut last = usize::MAX;
    for (i, &(row, to)) in moves.iter().enumerate() {
        if row != last {
            families.extend(rows[row].take().map(|parent| (parent, Vec::new())));
            last = row;
        }
        if let (Some(family), Some(child)) = (families.last_mut(), rows[to].take()) {
            family.1.push((first + i as u64, child));
        }
    }
    rayon::scope(|scope| {
        for (parent, mut children) in families {
            scope.spawn(move |_| spread(parent, &mut children, seed));
        }
    });
}

/// Copies a parent to all places; half of them from its first copy, side by side.
fn spread(parent: &mut Particle, children: &mut [(u64, &mut Particle)], seed: u64) {
    if children.len() <= ONE_BY_ONE {
        for (lineage, child) in children {
            child.copy_from(parent, *lineage, seed);
        }
        return;
    }
    if let [(lineage, first), rest @ ..] = children {
        first.copy_from(parent, *lineage, seed);
        let (left, right) = rest.split_at_mut(rest.len() / 2);
        rayon::join(|| spread(parent, left, seed), || spread(first, right, seed));
    }
}

/// Two different rows.
pub(super) fn pair(particles: &mut [Particle], a: usize, b: usize) -> [&mut Particle; 2] {
    if a < b {
        let (left, right) = particles.split_at_mut(b);
        [&mut left[a], &mut right[0]]
    } else {
        let (left, right) = particles.split_at_mut(a);
        [&mut right[0], &mut left[b]]
    }
}
