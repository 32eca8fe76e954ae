//! Connections within limits: of their number, of the time in which a request must be told, of its size.
//!
//! A connection that says nothing costs whoever holds it open nothing; so, where all places are taken, the one that has been
//! silent longest loses its place.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use axum::Router;
use axum::body::Body;
use axum::http::{Request, Response};
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::{Service as _, service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::TcpListener;
use tokio::task::AbortHandle;

/// How much is borne of whoever is connected.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    pub connections: usize,
    /// From the connection, or the answer before, to the end of the head of a request.
    pub head: Duration,
    /// Bytes of a request's head.
    pub head_bytes: usize,
}

impl Default for Bounds {
    fn default() -> Self {
        Self { connections: 512, head: Duration::from_secs(10), head_bytes: 16 << 10 }
    }
}

/// The connections, by the order in which they came.
#[derive(Default)]
struct Table {
    next: u64,
    open: BTreeMap<u64, Connection>,
}

struct Connection {
    task: Option<AbortHandle>,
    has_asked: bool,
}

type Shared = Arc<Mutex<Table>>;

fn locked(table: &Shared) -> MutexGuard<'_, Table> {
    table.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Leaves the table when its connection ends, however that is.
struct Seat(u64, Shared);

impl Drop for Seat {
    fn drop(&mut self) {
        locked(&self.1).open.remove(&self.0);
    }
}

/// Serves whoever connects, for ever.
pub(super) async fn serve(listener: TcpListener, app: Router, bounds: Bounds) -> Infallible {
    let table = Shared::default();
    loop {
        let Ok((stream, _)) = listener.accept().await else {
            // Out of files: there will be some when others have left.
            tokio::time::sleep(Duration::from_millis(50)).await;
            continue;
        };
        let Some(number) = seat(&table, bounds.connections) else { continue };
        let seat = Seat(number, Arc::clone(&table));
        let inner = TowerToHyperService::new(app.clone());
        let serving = async move {
            let seat = seat;
            let (number, table) = (seat.0, Arc::clone(&seat.1));
            let service = service_fn(move |request: Request<Incoming>| {
                if let Some(connection) = locked(&table).open.get_mut(&number) {
                    connection.has_asked = true;
                }
                let answer = inner.call(request);
                async move { answer.await as Result<Response<Body>, Infallible> }
            });
            let mut http = http1::Builder::new();
            http.timer(TokioTimer::new())
                .header_read_timeout(bounds.head)
                .max_buf_size(bounds.head_bytes);
            if let Err(error) = http.serve_connection(TokioIo::new(stream), service).await {
                tracing::debug!(%error, "a connection ended");
            }
        };
        let task = tokio::spawn(serving).abort_handle();
        if let Some(connection) = locked(&table).open.get_mut(&number) {
            connection.task = Some(task);
        }
    }
}

/// A place for one more; none where all are taken by those who have asked something.
fn seat(table: &Shared, most: usize) -> Option<u64> {
    let mut table = locked(table);
    if table.open.len() >= most {
        let silent = table.open.iter().find(|(_, c)| !c.has_asked && c.task.is_some());
        let (&number, connection) = silent?;
        if let Some(task) = &connection.task {
            task.abort();
        }
        table.open.remove(&number);
    }
    let number = table.next;
    table.next += 1;
    table.open.insert(number, Connection { task: None, has_asked: false });
    Some(number)
}
