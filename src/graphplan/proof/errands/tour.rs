//! How long a walk is that does all errands, by the distances between their ends alone: two bounds from below, and a short
//! order.

use super::Errand;

/// The least that it costs to come to the beginning of each errand, each from the start or from the end of another or
/// of itself (H. Kuhn, 1955, by shortest augmenting paths).
pub(super) fn assignment(distance: &[Vec<usize>], errands: &[Errand]) -> usize {
    let (rows, columns) = (errands.len(), errands.len() + 1);
    let cost = |row: usize, column: usize| -> i64 {
        let from = if column == errands.len() { 0 } else { errands[column].to };
        distance[from][errands[row].from] as i64
    };
    let (mut by_row, mut by_column) = (vec![0_i64; rows + 1], vec![0_i64; columns + 1]);
    // The row that has the column, counted from one; none is zero.
    let mut has = vec![0_usize; columns + 1];
    for row in 1..=rows {
        has[0] = row;
        let mut at = 0;
        let (mut least, mut way) = (vec![i64::MAX; columns + 1], vec![0; columns + 1]);
        let mut used = vec![false; columns + 1];
        loop {
            used[at] = true;
            let (here, mut delta, mut next) = (has[at], i64::MAX, 0);
            for column in (1..=columns).filter(|&column| !used[column]) {
                let reduced = cost(here - 1, column - 1) - by_row[here] - by_column[column];
                if reduced < least[column] {
                    (least[column], way[column]) = (reduced, at);
                }
                if least[column] < delta {
                    (delta, next) = (least[column], column);
                }
            }
            for column in 0..=columns {
                if used[column] {
                    by_row[has[column]] += delta;
                    by_column[column] -= delta;
                } else if least[column] < i64::MAX {
                    least[column] -= delta;
                }
            }
            at = next;
            if has[at] == 0 {
                break;
            }
        }
        while at != 0 {
            has[at] = has[way[at]];
            at = way[at];
        }
    }
    (1..=columns).filter(|&c| has[c] != 0).map(|c| cost(has[c] - 1, c - 1) as usize).sum()
}

/// A walk from the first point through all is no shorter: a spanning tree, raised by prices at the points. A price goes
/// up where the tree branches and down at its leaves; the walk uses each point twice, but its two ends once, and the
/// sum of what the prices add to it is taken off again.
pub(super) fn walk(distance: &[Vec<usize>], points: &[usize]) -> usize {
    const ROUNDS: usize = 200;
    /// Prices are whole numbers of this part of a step.
    const PART: i64 = 64;
    let count = points.len();
    if count < 2 {
        return 0;
    }
    let length = |a: usize, b: usize| {
        let (a, b) = (points[a], points[b]);
        distance[a][b].min(distance[b][a]) as i64 * PART
    };
    // The end may be any point, so a way home that costs nothing closes the walk: a point of its own, next to all.
    let (home, all) = (count, count + 1);
    let mut price = vec![0_i64; all];
    let mut best = 0_i64;
    let mut pace = PART;
    for round in 0..ROUNDS {
        let weight = |a: usize, b: usize| {
            let own = if a == home || b == home { 0 } else { length(a, b) };
            own + price[a] + price[b]
        };
        // A tree on the points without home, and home's way to the start and to its cheapest other point.
        let mut degree = vec![0_i64; all];
        let mut near = vec![(i64::MAX, 0); count];
        let mut is_in = vec![false; count];
        let (mut sum, mut at) = (0, 0);
        for _ in 1..count {
            is_in[at] = true;
            for other in (0..count).filter(|&other| !is_in[other]) {
                near[other] = near[other].min((weight(at, other), at));
            }
            let next = (0..count).filter(|&other| !is_in[other]).min_by_key(|&other| near[other].0);
            let next = next.expect("the tree lacks points still");
            sum += near[next].0;
            degree[next] += 1;
            degree[near[next].1] += 1;
            at = next;
        }
        let end = (1..count).min_by_key(|&end| weight(home, end)).expect("there are two points");
        sum += weight(home, 0) + weight(home, end);
        degree[home] = 2;
        degree[0] += 1;
        degree[end] += 1;
        best = best.max(sum - 2 * price.iter().sum::<i64>());
        if degree.iter().all(|&degree| degree == 2) {
            break;
        }
        price.iter_mut().zip(&degree).for_each(|(price, degree)| *price += pace * (degree - 2));
        if round % 20 == 19 {
            pace = (pace * 2 / 3).max(1);
        }
    }
    (best.max(0) as usize).div_ceil(PART as usize)
}

/// An order of the errands in which the walk is short: up to a dozen the shortest (R. Bellman, 1962, M. Held, R. Karp,
/// 1962), beyond that the nearest first, mended and then stirred up and mended again, until it is as short as any can be
/// or much was tried.
pub(super) fn order(
    distance: &[Vec<usize>],
    errands: &[Errand],
    shortest_possible: usize,
) -> Vec<usize> {
    const EXACT: usize = 12;
    let count = errands.len();
    let way = |from: usize, errand: usize| distance[from][errands[errand].from];
    if count <= EXACT {
        // For each set of errands done and the last of them the shortest walk, and the one before.
        let mut least = vec![vec![(usize::MAX, usize::MAX); count]; 1 << count];
        for set in 1_usize..1 << count {
            for last in (0..count).filter(|last| set >> last & 1 == 1) {
                let before = set & !(1 << last);
                let own = distance[errands[last].from][errands[last].to];
                least[set][last] = if before == 0 {
                    (way(0, last) + own, usize::MAX)
                } else {
                    let come = (0..count).filter(|one| before >> one & 1 == 1);
                    let come = come
                        .map(|one| (least[before][one].0 + way(errands[one].to, last) + own, one));
                    come.min().expect("some errand came before")
                };
            }
        }
        let mut order = Vec::new();
        let mut set = (1 << count) - 1;
        let mut last = (0..count).min_by_key(|&last| least[set][last].0);
        while let Some(errand) = last {
            order.push(errand);
            let before = least[set][errand].1;
            set &= !(1 << errand);
            last = (before < usize::MAX).then_some(before);
        }
        order.reverse();
        return order;
    }
    let mut left: Vec<usize> = (0..count).collect();
    let mut order = Vec::new();
    let mut at = 0;
    while let Some(nearest) = (0..left.len()).min_by_key(|&one| way(at, left[one])) {
        let errand = left.remove(nearest);
        at = errands[errand].to;
        order.push(errand);
    }
    mend(distance, errands, &mut order);
    stir(distance, errands, &mut order, shortest_possible);
    order
}

fn length(distance: &[Vec<usize>], errands: &[Errand], order: &[usize]) -> usize {
    let mut at = 0;
    let walked = order.iter().map(|&one| {
        let Errand { from, to, .. } = errands[one];
        distance[std::mem::replace(&mut at, to)][from] + distance[from][to]
    });
    walked.sum()
}

/// Two pieces of an order that follow one another change places, here and there in turn, and the order is mended again;
/// it is kept where it got no longer (O. Martin, S. Otto, E. Felten, 1991).
fn stir(
    distance: &[Vec<usize>],
    errands: &[Errand],
    order: &mut Vec<usize>,
    shortest_possible: usize,
) {
    /// Changes of the order that are judged.
    const MOST_WORK: usize = 1 << 23;
    const LONGEST_PIECE: usize = 8;
    let count = order.len();
    let mut least = length(distance, errands, order);
    let mut work = 0;
    // Numbers that look drawn by lot, the same each time (D. Knuth).
    let mut drawn = 1_u64;
    let mut below = |bound: usize| {
        drawn = drawn.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (drawn >> 33) as usize % bound
    };
    while least > shortest_possible && work < MOST_WORK {
        let longest = LONGEST_PIECE.min(count / 2);
        let (one, other) = (1 + below(longest), 1 + below(longest));
        let at = below(count + 1 - one - other);
        let mut stirred = order.clone();
        stirred[at..at + one + other].rotate_left(one);
        work += mend(distance, errands, &mut stirred) * count * count;
        let own = length(distance, errands, &stirred);
        if own <= least {
            (least, *order) = (own, stirred);
        }
    }
}

/// Makes an order shorter by moving one errand or turning a piece around, whatever wins most, and tells how often all of
/// these were judged.
fn mend(distance: &[Vec<usize>], errands: &[Errand], order: &mut Vec<usize>) -> usize {
    let count = order.len();
    let way = |from: usize, errand: usize| distance[from][errands[errand].from];
    let mut rounds = 0;
    loop {
        rounds += 1;
        // What comes to lie next to what is all that changes: with the ways summed up forward and backward, each change
        // is judged at once.
        let come = |before: Option<usize>, at: usize| match order.get(at) {
            Some(&one) => way(before.map_or(0, |before| errands[order[before]].to), one),
            None => 0,
        };
        let forward: Vec<usize> = (0..=count).map(|at| come(at.checked_sub(1), at)).collect();
        let (mut there, mut back) = (vec![0; count + 1], vec![0; count + 1]);
        for at in 0..count {
            there[at + 1] = there[at] + forward[at];
            back[at + 1] = back[at] + if at == 0 { 0 } else { come(Some(at), at - 1) };
        }
        let moved = |from: usize, to: usize| {
            let (before, after) =
                if from < to { (Some(to), to + 1) } else { (to.checked_sub(1), to) };
            let new =
                come(from.checked_sub(1), from + 1) + come(before, from) + come(Some(from), after);
            (new, forward[from] + forward[from + 1] + forward[after])
        };
        let turned = |from: usize, to: usize| {
            let new = come(from.checked_sub(1), to) + back[to + 1] - back[from + 1]
                + come(Some(from), to + 1);
            (new, there[to + 1] - there[from] + forward[to + 1])
        };
        let mut best = (0, None);
        for from in 0..count {
            for to in (0..count).filter(|&to| to != from) {
                let turn = (turned(from.min(to), from.max(to)), true);
                for ((new, old), turns) in [(moved(from, to), false), turn] {
                    if old.saturating_sub(new) > best.0 {
                        best = (old - new, Some((from, to, turns)));
                    }
                }
            }
        }
        match best.1 {
            Some((from, to, true)) => order[from.min(to)..=from.max(to)].reverse(),
            Some((from, to, false)) => {
                let one = order.remove(from);
                order.insert(to, one);
            }
            None => return rounds,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;
    use crate::strips::FactId;

    #[test]
    fn no_errand_moved_and_no_piece_turned_around_makes_the_order_shorter() {
        for seed in 1..=20 {
            let (mut random, count) = (Random(seed), 13 + seed as usize % 5);
            let mut row = || (0..=count).map(|_| random.below(50)).collect();
            let distance: Vec<Vec<usize>> = (0..=count).map(|_| row()).collect();
            let errands: Vec<Errand> = (0..count)
                .map(|one| Errand { goal: FactId(0), from: one + 1, to: (7 * one) % count + 1 })
                .collect();
            let length = |order: &[usize]| length(&distance, &errands, order);
            let found = order(&distance, &errands, 0);
            let mut all = found.clone();
            all.sort_unstable();
            assert!(all.into_iter().eq(0..count), "seed {seed}");
            for (from, to) in (0..count).flat_map(|from| (0..count).map(move |to| (from, to))) {
                let mut moved = found.clone();
                let one = moved.remove(from);
                moved.insert(to, one);
                let mut turned = found.clone();
                turned[from.min(to)..=from.max(to)].reverse();
                assert!(length(&found) <= length(&moved).min(length(&turned)), "seed {seed}");
            }
        }
    }
}
