//! Values that are made when they are first asked for.

use std::sync::OnceLock;

use super::kept::Kept;

/// A value that follows from what it stands beside: made when first asked for, neither compared nor kept.
#[derive(Debug, Clone)]
pub(super) struct OnDemand<T>(OnceLock<T>);

impl<T> OnDemand<T> {
    pub(super) fn get(&self, make: impl FnOnce() -> T) -> &T {
        self.0.get_or_init(make)
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
