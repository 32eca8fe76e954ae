//! Work that is shared out among threads, of which the caller's is one. A panic is handed on.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// What comes of the same work in so many threads.
pub(crate) fn side_by_side<R: Send>(threads: usize, work: &(impl Fn() -> R + Sync)) -> Vec<R> {
    thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
        let mut made = vec![work()];
        for other in others {
            made.push(other.join().unwrap_or_else(|fault| std::panic::resume_unwind(fault)));
        }
        made
    })
}

/// What comes of each, in their order.
pub(crate) fn apart<I: Sync, R: Send>(
    threads: usize,
    of: &[I],
    work: impl Fn(&I) -> R + Sync,
) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let some = || {
        let mut made = Vec::new();
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(one) = of.get(number) else { return made };
            made.push((number, work(one)));
        }
    };
    let made = side_by_side(threads.min(of.len()), &some);
    let mut made: Vec<(usize, R)> = made.into_iter().flatten().collect();
    made.sort_by_key(|(number, _)| *number);
    made.into_iter().map(|(_, made)| made).collect()
}
