//! What was found of a text, kept: a line is read in many ways, and most of them have words in common.
//!
//! Invariant: what is kept depends on the text alone, and is never more than [`MOST`] texts.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

/// Of more texts none is kept: a line has some dozens.
const MOST: usize = 512;

#[derive(Debug, Default)]
pub(super) struct Memo<T>(Mutex<HashMap<String, T>>);

impl<T: Clone> Memo<T> {
    /// What is found of a text, by looking where it is not kept.
    pub(super) fn of(&self, text: &str, find: impl FnOnce() -> T) -> T {
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = kept().get(text) {
            return found.clone();
        }
        let found = find();
        let mut kept = kept();
        if kept.len() >= MOST {
            kept.clear();
        }
        kept.insert(text.to_owned(), found.clone());
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_not_looked_for_again_and_has_a_bound() {
        let memo = Memo::default();
        assert_eq!(memo.of("a", || 1), 1);
        assert_eq!(memo.of("a", || 2), 1);
        for n in 0..2 * MOST {
            memo.of(&n.to_string(), || 3);
        }
        assert!(memo.0.lock().is_ok_and(|kept| kept.len() <= MOST));
    }
}
