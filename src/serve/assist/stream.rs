//! The input of a client over the standard streams: where it ends, the robot stops.

use std::io::Result;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use tokio::io::{AsyncRead, ReadBuf};

use super::super::drive::Tasks;

/// Closes the tasks when its client leaves. The protocol's own service notices that too, but first it waits for the calls
/// that are open, and a drive is one.
pub(super) struct Watched<R> {
    input: R,
    /// None when they are closed.
    tasks: Option<Arc<Tasks>>,
}

impl<R> Watched<R> {
    pub(super) fn new(input: R, tasks: Arc<Tasks>) -> Self {
        Self { input, tasks: Some(tasks) }
    }
}

impl<R: AsyncRead + Unpin> AsyncRead for Watched<R> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<Result<()>> {
        let before = buffer.filled().len();
        let read = Pin::new(&mut self.input).poll_read(context, buffer);
        let has_room = buffer.capacity() > before;
        let is_over = match &read {
            Poll::Ready(Ok(())) => has_room && buffer.filled().len() == before,
            Poll::Ready(Err(_)) => true,
            Poll::Pending => false,
        };
        if is_over && let Some(tasks) = self.tasks.take() {
            // It waits until the robot stands.
            tokio::task::spawn_blocking(move || tasks.close());
        }
        read
    }
}
