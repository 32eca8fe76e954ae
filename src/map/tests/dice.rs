//! Chance for tests that fails the same way again.

/// A row of numbers that looks like chance, each below what is asked for.
pub(crate) fn dice(mut state: u64) -> impl FnMut(usize) -> usize {
    move |below| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize % below
    }
}

/// The value under a random key.
macro_rules! any {
    ($throw:ident, $records:expr) => {{
        let keys: Vec<_> = $records.keys().copied().collect();
        let key = keys[$throw(keys.len())];
        $records.get_mut(&key).expect("chosen among them")
    }};
}

pub(crate) use any;
