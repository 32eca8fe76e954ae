//! Values that are made, or unfolded, when they are first asked for.

use std::sync::OnceLock;

use super::kept_value::Kept;

/// A value that follows from what it stands beside: made when first asked for, neither compared nor kept.
#[derive(Debug, Clone)]
pub(super) struct OnDemand<T>(OnceLock<T>);

impl<T> OnDemand<T> {
    pub(super) fn get(&self, make: impl FnOnce() -> T) -> &T {
        self.0.get_or_init(make)
    }
}

/// A value that few ask for: kept as bytes, and taken out of them when first asked for.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Folded<T> {
    bytes: Box<[u8]>,
    value: OnDemand<T>,
}

impl<T: Kept> Folded<T> {
    pub(super) fn of(value: &T) -> Self {
        let mut bytes = Vec::new();
        value.put(&mut bytes);
        Self { bytes: bytes.into(), value: OnDemand::default() }
    }

    pub(super) fn get(&self) -> &T {
        let take = || T::take(&mut &self.bytes[..]).expect("what was put in is there");
        self.value.get(take)
    }
}

impl<T: Kept> Kept for Folded<T> {
    fn put(&self, out: &mut Vec<u8>) {
        out.extend(&self.bytes);
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        let all = *bytes;
        T::take(bytes)?;
        let own = &all[..all.len() - bytes.len()];
        Some(Self { bytes: own.into(), value: OnDemand::default() })
    }
}

impl<T> Default for OnDemand<T> {
    fn default() -> Self {
        Self(OnceLock::new())
    }
}

impl<T> PartialEq for OnDemand<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl<T> Kept for OnDemand<T> {
    fn put(&self, _: &mut Vec<u8>) {}

    fn take(_: &mut &[u8]) -> Option<Self> {
        Some(Self::default())
    }
}
