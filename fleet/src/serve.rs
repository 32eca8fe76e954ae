//! The centre over HTTP.
//!
//! | path | who | does |
//! |---|---|---|
//! | `GET /v1/position` | robot | how far its journal is here |
//! | `POST /v1/frames` | robot | frames after that, one after the other, compressed as `Content-Encoding` says |
//! | `POST /v1/whole?sequence=N&checksum=C` | robot | the whole store in the place of what was here |
//! | `GET /v1/map` | robot | the centre's newest map: a line of JSON, then its rows, packed |
//! | `POST /v1/agreed?centre=N&robot=M` | robot | its revision is the centre's |
//! | `POST /v1/conflict` | robot | what both changed, thing by thing |
//! | `GET /` | anybody | the page of the fleet, which asks for an operator's key |
//! | `POST /v1/enter`, `/v1/leave` | operator | a browser's session, as a cookie |
//! | `GET /v1/fleet`, `/v1/building`, `/v1/plan`, `POST /v1/ask`, `/v1/query` | operator | what the page shows; questions |
//! | `POST /v1/edit`, `/v1/revise`, `/v1/adopt`, `/v1/insist` | operator who edits | revisions at the centre |
//!
//! A key comes as `Authorization: Bearer …`, or as the cookie of a session; see [`gate`](crate::gate). Beyond this machine
//! there is no connection without TLS.

use std::io::Read;
use std::net::{SocketAddr, TcpListener};
use std::path::PathBuf;
use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::{DefaultBodyLimit, FromRequestParts, Query, State};
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Json, Router};
use deadpool_postgres::{Object, Pool};
use serde::{Deserialize, Serialize};

use crate::error::{FleetError, Result};
use crate::gate::{Gate, guard};
use crate::handout::{Conflict, agree, handout, note_conflict};
use crate::ingest::{Position, position, take_frames, take_whole};
use crate::lists::Kept;
use crate::push::gzip;
use crate::store::shipping::{Frame, Whole, split_frames};
use crate::units::{InEnglish as _, said};

/// Bytes of one request as they come.
const MOST_BYTES: usize = 256 << 20;
/// Bytes of one request when they are unpacked.
const MOST_UNPACKED: u64 = 1 << 30;

/// What a fault is called on the line.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Refusal {
    /// `gap`, `diverged`, `key`, `forbidden`, `content`, `moved`, `unknown`, `database`.
    pub fault: String,
    /// In Russian, then in English.
    pub what: String,
    #[serde(default)]
    pub what_en: String,
    /// With `gap`: how far the journal is here.
    pub position: Option<Position>,
}

impl IntoResponse for FleetError {
    fn into_response(self) -> Response {
        let (status, fault) = match &self {
            Self::Key => (StatusCode::UNAUTHORIZED, "key"),
            Self::Forbidden => (StatusCode::FORBIDDEN, "forbidden"),
            Self::Gap { .. } => (StatusCode::CONFLICT, "gap"),
            Self::Diverged { .. } => (StatusCode::CONFLICT, "diverged"),
            Self::Moved { .. } => (StatusCode::CONFLICT, "moved"),
            Self::Unknown { .. } => (StatusCode::NOT_FOUND, "unknown"),
            Self::Content { .. } | Self::Store(_) => (StatusCode::BAD_REQUEST, "content"),
            Self::Database { .. }
            | Self::Line { .. }
            | Self::Plain { .. }
            | Self::PlainDatabase { .. }
            | Self::Held { .. }
            | Self::Io { .. } => {
                tracing::error!(error = %self, "a request failed");
                (StatusCode::SERVICE_UNAVAILABLE, "database")
            }
        };
        let position = match &self {
            Self::Gap { have, checksum, .. } => {
                Some(Position { sequence: *have, checksum: *checksum })
            }
            _ => None,
        };
        // What the database says of itself is not for the line.
        let [what, what_en] = match fault {
            "database" => Default::default(),
            _ => [self.to_string(), self.english()],
        };
        let refusal = Refusal { fault: fault.to_owned(), what, what_en, position };
        (status, Json(refusal)).into_response()
    }
}

/// The key of a request.
pub struct Key(pub String);

impl FromRequestParts<Centre> for Key {
    type Rejection = FleetError;

    async fn from_request_parts(parts: &mut Parts, centre: &Centre) -> Result<Self> {
        let Some(told) = parts.headers.get(header::AUTHORIZATION) else {
            return centre.gate.session(&parts.headers).map(Self).ok_or(FleetError::Key);
        };
        let key = told.to_str().ok().and_then(|value| value.strip_prefix("Bearer "));
        Ok(Self(key.ok_or(FleetError::Key)?.trim().to_owned()))
    }
}

/// What all requests share.
#[derive(Clone)]
pub struct Centre {
    pool: Pool,
    pub(crate) gate: Arc<Gate>,
    pub(crate) kept: Arc<Kept>,
}

impl Centre {
    pub(crate) async fn client(&self) -> Result<Object> {
        Ok(self.pool.get().await?)
    }
}

/// All paths of the centre.
pub fn router(pool: Pool, gate: Gate) -> Router {
    let gate = Arc::new(gate);
    Router::new()
        .route("/v1/position", get(where_is))
        .route("/v1/frames", post(frames))
        .route("/v1/whole", post(whole))
        .route("/v1/map", get(map))
        .route("/v1/agreed", post(agreed))
        .route("/v1/conflict", post(conflict))
        .merge(crate::console::router())
        .layer(DefaultBodyLimit::max(MOST_BYTES))
        .layer(axum::middleware::from_fn_with_state(Arc::clone(&gate), guard))
        .with_state(Centre { pool, gate, kept: Arc::default() })
}

/// Unpacks a body and cuts it into frames, on a thread where that harms nobody.
async fn frames_of(headers: &HeaderMap, body: Bytes) -> Result<Vec<Frame>> {
    let packed = headers.get(header::CONTENT_ENCODING).and_then(|value| value.to_str().ok());
    let is_packed = match packed {
        None | Some("identity") => false,
        Some("gzip") => true,
        Some(other) => return Err(FleetError::content(said!("packing-unknown", packing = other))),
    };
    let cut = move || {
        let unpacked = if is_packed {
            let mut out = Vec::new();
            let mut unpacking = flate2::read::GzDecoder::new(&body[..]).take(MOST_UNPACKED + 1);
            let read = unpacking.read_to_end(&mut out);
            read.map_err(|error| FleetError::content(said!("packed-unreadable", why = error)))?;
            if out.len() as u64 > MOST_UNPACKED {
                return Err(FleetError::content(said!("too-much-at-once")));
            }
            out
        } else {
            body.to_vec()
        };
        split_frames(&unpacked).ok_or_else(|| FleetError::content(said!("these-are-no-frames")))
    };
    tokio::task::spawn_blocking(cut)
        .await
        .map_err(|error| FleetError::content(error.to_string()))?
}

async fn where_is(State(centre): State<Centre>, key: Key) -> Result<Json<Position>> {
    Ok(Json(position(&mut centre.client().await?, &key.0).await?))
}

async fn frames(
    State(centre): State<Centre>,
    key: Key,
    headers: HeaderMap,
    body: Bytes,
) -> Result<Json<Position>> {
    // A key that does not fit need not have its bytes unpacked.
    let mut client = centre.client().await?;
    position(&mut client, &key.0).await?;
    let frames = frames_of(&headers, body).await?;
    Ok(Json(take_frames(&mut client, &key.0, frames).await?))
}

async fn whole(
    State(centre): State<Centre>,
    key: Key,
    Query(told): Query<Told>,
    headers: HeaderMap,
    body: Bytes,
) -> Result<Json<Position>> {
    let mut client = centre.client().await?;
    position(&mut client, &key.0).await?;
    let pieces = frames_of(&headers, body).await?;
    let whole = Whole { sequence: told.sequence, checksum: told.checksum, pieces };
    Ok(Json(take_whole(&mut client, &key.0, whole).await?))
}

async fn map(State(centre): State<Centre>, key: Key) -> Result<Response> {
    let (told, rows) = handout(&mut centre.client().await?, &key.0).await?;
    let mut body = serde_json::to_vec(&told).map_err(|e| FleetError::content(e.to_string()))?;
    body.push(b'\n');
    if let Some(rows) = rows {
        body.extend(gzip(&rows)?);
    }
    Ok(([(header::CONTENT_TYPE, "application/octet-stream")], body).into_response())
}

async fn agreed(
    State(centre): State<Centre>,
    key: Key,
    Query(pair): Query<Pair>,
) -> Result<Json<()>> {
    agree(&mut centre.client().await?, &key.0, pair.centre, pair.robot).await?;
    Ok(Json(()))
}

async fn conflict(
    State(centre): State<Centre>,
    key: Key,
    Json(told): Json<Conflict>,
) -> Result<Json<()>> {
    note_conflict(&mut centre.client().await?, &key.0, &told).await?;
    Ok(Json(()))
}

#[derive(Deserialize)]
struct Pair {
    centre: i64,
    robot: i64,
}

#[derive(Deserialize)]
struct Told {
    sequence: u64,
    checksum: Option<u32>,
}

/// Certificate and key, as PEM files.
#[derive(Debug, Clone)]
pub struct Tls {
    pub certificate: PathBuf,
    pub key: PathBuf,
}

/// Serves until the process ends; `ready` hears the address that is listened to. `names` are what browsers call this server,
/// where that is not this machine's own name or its number.
///
/// # Errors
/// [`FleetError::Plain`], [`FleetError::Io`].
pub async fn serve(
    pool: Pool,
    listen: SocketAddr,
    tls: Option<Tls>,
    names: &[String],
    ready: impl FnOnce(SocketAddr),
) -> Result<()> {
    if tls.is_none() && !listen.ip().is_loopback() {
        return Err(FleetError::Plain { address: listen.to_string() });
    }
    let failed = |source| FleetError::Io { path: listen.to_string(), source };
    let listener = TcpListener::bind(listen).map_err(failed)?;
    listener.set_nonblocking(true).map_err(failed)?;
    let address = listener.local_addr().map_err(failed)?;
    let gate = Gate::new(address, tls.is_some(), names);
    let service = router(pool, gate).into_make_service();
    match tls {
        None => {
            ready(address);
            axum_server::from_tcp(listener).map_err(failed)?.serve(service).await.map_err(failed)
        }
        Some(tls) => {
            // Chosen once; that another part of the program chose before does no harm.
            let _ = rustls::crypto::ring::default_provider().install_default();
            let config =
                axum_server::tls_rustls::RustlsConfig::from_pem_file(&tls.certificate, &tls.key)
                    .await
                    .map_err(|source| FleetError::Io {
                        path: tls.certificate.display().to_string(),
                        source,
                    })?;
            ready(address);
            let server = axum_server::from_tcp_rustls(listener, config).map_err(failed)?;
            server.serve(service).await.map_err(failed)
        }
    }
}
