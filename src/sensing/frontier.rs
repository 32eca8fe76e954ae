//! What a search still has to look at, by how much it promises.

/// A turn, and a cell of some level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Place {
    pub(crate) turn: u16,
    pub(crate) column: u32,
    pub(crate) row: u32,
}

/// Cells from one on, at a turn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Strip {
    pub(crate) level: u8,
    pub(crate) place: Place,
    /// Which of its cells come to what is needed.
    pub(crate) passed: u32,
}

/// Strips that are still to be opened, and poses, by the most that any pose in them can explain. Most end below what is needed
/// and are never looked at again.
#[derive(Default)]
pub(crate) struct Open {
    by_bound: Vec<Promise>,
}

#[derive(Default)]
pub(crate) struct Promise {
    pub(crate) strips: Vec<Strip>,
    pub(crate) poses: Vec<Place>,
}

impl Open {
    pub(crate) fn at(&mut self, bound: u16) -> &mut Promise {
        let bound = usize::from(bound);
        if bound >= self.by_bound.len() {
            self.by_bound.resize_with(bound + 1, Promise::default);
        }
        &mut self.by_bound[bound]
    }

    /// Takes all in that another has.
    pub(crate) fn take_in(&mut self, other: Self) {
        for (bound, mut promise) in other.by_bound.into_iter().enumerate() {
            if !promise.strips.is_empty() || !promise.poses.is_empty() {
                let own = self.at(bound as u16);
                own.strips.append(&mut promise.strips);
                own.poses.append(&mut promise.poses);
            }
        }
    }

    /// Some strips that promise most, none less than `needed` nor than a pose comes to. Where there are none, the poses that
    /// come to most of all, and to how much.
    pub(crate) fn next(&mut self, needed: u16, some: usize) -> Next {
        let mut strips = Vec::new();
        while let Some(bound) = self.by_bound.len().checked_sub(1) {
            let promise = &mut self.by_bound[bound];
            if bound < usize::from(needed) || strips.len() >= some {
                break;
            }
            strips.append(&mut promise.strips);
            if promise.poses.is_empty() {
                self.by_bound.pop();
            } else if strips.is_empty() {
                return Next::Poses(bound as u16, std::mem::take(&mut promise.poses));
            } else {
                break;
            }
        }
        if strips.is_empty() { Next::Nothing } else { Next::Strips(strips) }
    }
}

/// What is to be looked at next.
pub(crate) enum Next {
    Strips(Vec<Strip>),
    Poses(u16, Vec<Place>),
    Nothing,
}
