//! Work that is shared out among threads, of which the caller's is one.
//!
//! What begins threads stands here once: of each kind of work a copy of it was a thirtieth of the crate's machine code.

use std::thread;

/// What one thread does.
pub(super) type Task<'t> = Box<dyn FnOnce() + Send + 't>;

/// Does tasks side by side: the first in this thread, each other one in a thread of its own. A panic is handed on.
pub(super) fn apart(tasks: Vec<Task<'_>>) {
    let mut tasks = tasks.into_iter();
    let Some(own) = tasks.next() else { return };
    thread::scope(|scope| {
        let others: Vec<_> = tasks.map(|task| scope.spawn(task)).collect();
        own();
        for other in others {
            other.join().unwrap_or_else(|fault| std::panic::resume_unwind(fault));
        }
    });
}

/// Has so many threads do the same work until nothing of it is left.
pub(super) fn worked_off(threads: usize, work: &(dyn Fn() + Sync)) {
    apart((0..threads.max(1)).map(|_| Box::new(work) as Task<'_>).collect());
}

/// What comes of each share, in their order: the first is this thread's, each other one's a thread of its own.
pub(super) fn shared_out<I: Send, R: Send>(
    shares: impl IntoIterator<Item = I>,
    work: impl Fn(I) -> R + Sync,
) -> Vec<R> {
    let work = &work;
    let shares: Vec<I> = shares.into_iter().collect();
    let mut made: Vec<Option<R>> = shares.iter().map(|_| None).collect();
    let tasks = shares.into_iter().zip(&mut made);
    apart(
        tasks
            .map(|(share, made)| Box::new(move || *made = Some(work(share))) as Task<'_>)
            .collect(),
    );
    made.into_iter().flatten().collect()
}
