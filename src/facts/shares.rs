//! Work that is shared out among threads, of which the caller's is one.

use std::thread;

/// What comes of each share, in their order: the first is this thread's, each other one's a thread of its own.
pub(super) fn shared_out<I: Send, R: Send>(
    shares: impl IntoIterator<Item = I>,
    work: impl Fn(I) -> R + Sync,
) -> Vec<R> {
    let mut shares = shares.into_iter();
    let Some(own) = shares.next() else { return Vec::new() };
    let work = &work;
    thread::scope(|scope| {
        let others: Vec<_> = shares.map(|share| scope.spawn(move || work(share))).collect();
        let own = work(own);
        let joined = others
            .into_iter()
            .map(|other| other.join().unwrap_or_else(|fault| std::panic::resume_unwind(fault)));
        std::iter::once(own).chain(joined).collect()
    })
}
