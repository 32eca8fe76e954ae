//! Things set down on what is beneath them: a box is off by some centimetres, and nothing hovers.

use crate::Feet;

use super::shape::{Build, Crate, Neighbours, SAME_LEVEL, STANDS, SUNK, around, holder, levels};

/// What hangs this far above a bed or sofa lies on its bedding, which the box leaves out, cm: as thick as bedding is.
const BEDDING: f64 = 25.0;

/// How near the feet of things are to what they stand on. What stands within a box is left out: where the surfaces of a
/// box are is only told by what stands in it.
pub(super) fn feet(things: &[Crate]) -> Feet {
    let near = Neighbours::of(things);
    let mut feet = Feet::default();
    for thing in things.iter().filter(|t| t.build != Build::Hung) {
        let around: Vec<usize> = around(things, &near, thing).collect();
        if holder(things, &around, thing).is_some() {
            continue;
        }
        let gaps = around.iter().filter(|&&i| things[i].bottom < thing.bottom);
        let gaps = gaps.map(|&i| (thing.bottom - things[i].top).abs());
        if let Some(least) = gaps.reduce(f64::min).filter(|least| *least <= STANDS) {
            feet.of += 1;
            feet.off += usize::from(least > SUNK);
        }
    }
    feet
}

/// By what a thing is taken along when it is set down.
#[derive(Debug, Clone, Copy)]
enum Rest {
    /// It stands on the top of another.
    On(usize),
    /// Its foot is within the box of another.
    With(usize),
}

/// The bottoms of all things after each was set down on what is beneath it, for nothing hovers and nothing sinks in:
/// a box is off by some centimetres. What stands within a box goes along with it.
pub(super) fn stacked(things: &[Crate]) -> Vec<f64> {
    let near = Neighbours::of(things);
    let rests: Vec<Option<Rest>> = things.iter().map(|t| rest(things, &near, t)).collect();
    let levels = levels(things);
    let mut bottoms: Vec<Option<f64>> = vec![None; things.len()];
    let mut is_waiting = vec![false; things.len()];
    for n in 0..things.len() {
        let mut waiting = vec![n];
        while let Some(&n) = waiting.last() {
            let own = things[n].bottom;
            let (on, height) = match rests[n] {
                Some(Rest::On(i)) => (i, things[i].top - own),
                Some(Rest::With(i)) => (i, -above_level(&levels[i], own - things[i].bottom)),
                None => (n, 0.0),
            };
            // Two that would carry one another stay where they are.
            is_waiting[n] = true;
            if bottoms[on].is_none() && !is_waiting[on] {
                waiting.push(on);
                continue;
            }
            let shift = bottoms[on].map_or(0.0, |b| b - things[on].bottom + height);
            bottoms[n].get_or_insert(own + shift);
            waiting.pop();
        }
    }
    bottoms.into_iter().zip(things).map(|(bottom, thing)| bottom.unwrap_or(thing.bottom)).collect()
}

/// How far a height is above the level which is one surface with it.
fn above_level(levels: &[f64], height: f64) -> f64 {
    let above = levels.iter().map(|level| height - level);
    above.filter(|d| (0.0..=SAME_LEVEL).contains(d)).reduce(f64::min).unwrap_or(0.0)
}

fn rest(things: &[Crate], near: &Neighbours, thing: &Crate) -> Option<Rest> {
    if thing.build == Build::Hung {
        return None;
    }
    let around: Vec<usize> = around(things, near, thing).collect();
    let gap = |i: usize| thing.bottom - things[i].top;
    let lower = || around.iter().copied().filter(|&i| things[i].bottom < thing.bottom);
    let highest = |is_wanted: &dyn Fn(usize) -> bool| {
        lower().filter(|&i| is_wanted(i)).min_by(|&i, &j| gap(i).total_cmp(&gap(j)))
    };
    let sunk = |&i: &usize| {
        let other = &things[i];
        other.bottom < thing.bottom
            && gap(i) < -SUNK
            && !other.bears(thing)
            && !other.is_over_floor(thing)
    };
    let nested = || around.iter().copied().filter(sunk).max_by(|&i, &j| gap(i).total_cmp(&gap(j)));
    if let Some(round) = holder(things, &around, thing).or_else(nested) {
        // Drawers one above another in a chest hang where they are.
        let on = highest(&|i| gap(i).abs() <= SUNK).filter(|&i| things[round].holds(&things[i]));
        return Some(on.map_or(Rest::With(round), Rest::On));
    }
    let bed = |&i: &usize| things[i].build == Build::Seat && thing.build == Build::Block;
    let on_bedding = || highest(&|i| (STANDS..=BEDDING).contains(&gap(i))).filter(bed);
    highest(&|i| things[i].bears(thing)).or_else(on_bedding).map(Rest::On)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Point;

    fn thing(build: Build, at: (f64, f64), half: f64, bottom: f64, top: f64) -> Crate {
        let at = Point::new(at.0, at.1);
        Crate { build, at, angle: 0.0, half: [half, half], bay: None, bottom, top }
    }

    #[test]
    fn nothing_hovers_and_nothing_sinks_in() {
        let things = [
            thing(Build::Table, (0.0, 0.0), 60.0, 0.0, 90.0),
            // A bowl that sinks into the table, with an apple in it that comes along.
            thing(Build::Bowl, (0.0, 0.0), 15.0, 88.5, 98.5),
            thing(Build::Block, (0.0, 0.0), 4.0, 89.5, 97.5),
            // A case on the floor under the table.
            thing(Build::Block, (30.0, 30.0), 10.0, 0.0, 60.0),
            // A pillow over the bedding of a bed, and a lamp that hangs higher.
            thing(Build::Seat, (300.0, 0.0), 90.0, 0.0, 50.0),
            thing(Build::Block, (300.0, 0.0), 20.0, 65.0, 80.0),
            thing(Build::Block, (340.0, 0.0), 5.0, 120.0, 140.0),
        ];
        assert_eq!(stacked(&things), [0.0, 90.0, 91.0, 0.0, 0.0, 50.0, 120.0]);
        assert!(levels(&things)[0].is_empty(), "nothing stands within the table");
    }

    #[test]
    fn what_is_fixed_or_nested_keeps_its_distance() {
        let things = [
            // A bowl 2.5 cm above a counter, and one nested in it.
            thing(Build::Block, (0.0, 0.0), 50.0, 0.0, 104.0),
            thing(Build::Bowl, (0.0, 0.0), 10.0, 106.5, 114.5),
            thing(Build::Bowl, (0.0, 0.0), 9.0, 109.0, 117.0),
            // A shelf on the wall above a bed.
            thing(Build::Seat, (500.0, 0.0), 90.0, 0.0, 30.0),
            thing(Build::Case, (540.0, 0.0), 15.0, 45.0, 60.0),
            // Two drawers of a closet with 3 cm between them.
            thing(Build::Case, (900.0, 0.0), 50.0, 0.0, 200.0),
            thing(Build::Case, (900.0, 0.0), 20.0, 14.0, 34.0),
            thing(Build::Case, (900.0, 0.0), 20.0, 37.0, 57.0),
        ];
        assert_eq!(stacked(&things), [0.0, 104.0, 106.5, 0.0, 45.0, 0.0, 14.0, 37.0]);
    }
}
