//! Every address that is answered, with who may ask it; `openapi.json` describes them, and a test holds it to this table.

use std::sync::Arc;
use std::time::Duration;

use axum::extract::{DefaultBodyLimit, Query, Request, State as Of};
use axum::http::header::{
    CACHE_CONTROL, CONTENT_LENGTH, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HeaderName, HeaderValue,
    LOCATION, REFERRER_POLICY, SET_COOKIE, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{HeaderMap, StatusCode, Uri};
use axum::middleware::{Next, from_fn, from_fn_with_state};
use axum::response::sse::Sse;
use axum::response::{IntoResponse, Response};
use axum::routing::{MethodRouter, get, post};
use axum::{Extension, Router};

use rmcp::transport::streamable_http_server::session::local::LocalSessionManager;
use rmcp::transport::{StreamableHttpServerConfig, StreamableHttpService};

use super::assist::Assistant;
use super::fault::Fault;
use super::gate::{Refused, Role, Session};
use super::{House, act, centre, events, read};
use crate::units::{Carried, carried, said};

/// Bytes of a request's body.
const BODY: usize = 1 << 20;
/// Until an answer must be there, its request's body included.
const PATIENCE: Duration = Duration::from_secs(120);

type Routes = MethodRouter<Arc<House>>;

/// A list of addresses and what answers them, of the same lines: who looks at the list alone need not have the answers.
macro_rules! routes {
    ($(($method:ident, $path:literal, $needs:ident, $answer:path)),+ $(,)?) => {
        /// All that is answered under `/api`: method, path, and who may ask.
        pub(super) const ROUTES: &[(&str, &str, Role)] =
            &[$((stringify!($method), $path, Role::$needs)),+];

        /// What answers under every path of [`ROUTES`].
        fn answers() -> Vec<Routes> {
            vec![$($method($answer)),+]
        }
    };
}

routes![
    (get, "/api/state", Look, read::state),
    (get, "/api/drawing", Look, read::drawing),
    (get, "/api/floor", Look, read::floor),
    (get, "/api/svg", Look, read::svg),
    (get, "/api/thing", Look, read::thing),
    (get, "/api/why", Look, read::why),
    (get, "/api/kinds", Look, read::kinds),
    (get, "/api/route", Look, read::route),
    (get, "/api/complete", Look, read::complete),
    (get, "/api/history", Look, read::history),
    (get, "/api/diff", Look, read::diff),
    (get, "/api/proposals", Look, read::proposals),
    (get, "/api/tasks", Look, act::tasks),
    (get, "/api/events", Look, happens),
    (get, "/api/openapi.json", Look, described),
    (post, "/api/say", Look, act::say),
    (post, "/api/stop", Look, act::stop),
    (post, "/api/pause", Look, act::pause),
    (post, "/api/resume", Drive, act::resume),
    (post, "/api/later", Drive, act::later),
    (post, "/api/shortest", Drive, act::sort),
    (post, "/api/leave", Look, act::leave),
    (post, "/api/lease", Drive, act::lease),
    (post, "/api/reset", Drive, act::reset),
    (post, "/api/tasks/{id}/confirm", Drive, act::confirm),
    (post, "/api/tasks/{id}/cancel", Drive, act::cancel),
    (post, "/api/tasks/{id}/cleared", Drive, act::cleared),
    (post, "/api/tasks/{id}/move", Drive, act::reorder),
    (get, "/api/edits", Look, act::proposed),
    (post, "/api/edits/{id}", Edit, act::judge),
    (post, "/api/edits", Edit, act::edit),
    (post, "/api/undo", Edit, act::undo),
    (post, "/api/redo", Edit, act::redo),
    (post, "/api/restore", Edit, act::restore),
    (post, "/api/proposals/{name}", Edit, act::decide),
    (post, "/api/invite", Edit, act::invite),
];

/// The description of [`ROUTES`].
static OPENAPI: Carried = carried!("openapi.json");

const JS: &str = "text/javascript; charset=utf-8";

/// The page: path, kind, text.
static PAGE: [(&str, &str, Carried); 13] = [
    ("/", "text/html; charset=utf-8", carried!("page/index.html")),
    ("/style.css", "text/css; charset=utf-8", carried!("page/style.css")),
    ("/icon.svg", "image/svg+xml", carried!("page/icon.svg")),
    ("/app.js", JS, carried!("page/app.js")),
    ("/base.js", JS, carried!("page/base.js")),
    ("/changes.js", JS, carried!("page/changes.js")),
    ("/edit.js", JS, carried!("page/edit.js")),
    ("/link.js", JS, carried!("page/link.js")),
    ("/map.js", JS, carried!("page/map.js")),
    ("/panels.js", JS, carried!("page/panels.js")),
    ("/picture.js", JS, carried!("page/picture.js")),
    ("/talk.js", JS, carried!("page/talk.js")),
    ("/tools.js", JS, carried!("page/tools.js")),
];

/// Its letters, which their own format has compressed.
const FONTS: [(&str, &[u8]); 4] = [
    ("/fonts/plex-sans-cyrillic.woff2", include_bytes!("page/fonts/plex-sans-cyrillic.woff2")),
    ("/fonts/plex-sans-latin.woff2", include_bytes!("page/fonts/plex-sans-latin.woff2")),
    ("/fonts/plex-mono-cyrillic.woff2", include_bytes!("page/fonts/plex-mono-cyrillic.woff2")),
    ("/fonts/plex-mono-latin.woff2", include_bytes!("page/fonts/plex-mono-latin.woff2")),
];

/// The server's answers, behind its gate.
pub(super) fn router(house: &Arc<House>, assistant: &Assistant) -> Router {
    let mut api = Router::new();
    for ((_, path, needs), answer) in ROUTES.iter().zip(answers()) {
        let needs = *needs;
        let check = from_fn(move |session: Extension<Session>, request: Request, next: Next| {
            may(needs, session, request, next)
        });
        api = api.route(path, answer.route_layer(check));
    }
    let api = api.route_layer(from_fn_with_state(Arc::clone(house), known));
    let mut all = api.merge(assistants(house, assistant)).merge(of_centre(house));
    for (path, kind, text) in &PAGE {
        all = all.route(path, get(move || async move { ([(CONTENT_TYPE, *kind)], **text) }));
    }
    for (path, font) in FONTS {
        all = all.route(path, get(move || async move { ([(CONTENT_TYPE, "font/woff2")], font) }));
    }
    all.layer(DefaultBodyLimit::max(BODY))
        .layer(from_fn_with_state(Arc::clone(house), guard))
        .with_state(Arc::clone(house))
}

/// Where assistants call, by the Model Context Protocol; let in by a token that lasts.
const ASSISTANTS: &str = "/mcp";

fn assistants(house: &Arc<House>, assistant: &Assistant) -> Router<Arc<House>> {
    let assistant = assistant.clone();
    // Hosts and origins are the gate's business.
    let config = StreamableHttpServerConfig::default().disable_allowed_hosts();
    let sessions = Arc::new(LocalSessionManager::default());
    let service = StreamableHttpService::new(move || Ok(assistant.clone()), sessions, config);
    let bears = from_fn_with_state(Arc::clone(house), bears);
    Router::new().route_service(ASSISTANTS, service).route_layer(bears)
}

/// Where the centre's map is brought, by who bears the token that lies beside the store.
fn of_centre(house: &Arc<House>) -> Router<Arc<House>> {
    let taking = post(centre::take).layer(DefaultBodyLimit::max(centre::MAP));
    let bears = from_fn_with_state(Arc::clone(house), bears);
    Router::new().route(centre::CENTRE, taking).route_layer(bears)
}

/// Programs come here, which have no page and bear a token that lasts.
fn is_of_programs(path: &str) -> bool {
    [ASSISTANTS, centre::CENTRE].contains(&path)
}

/// Lets pass who bears a token.
async fn bears(Of(house): Of<Arc<House>>, mut request: Request, next: Next) -> Response {
    match house.gate.bearer(request.headers()) {
        Ok(session) => {
            request.extensions_mut().insert(session);
            next.run(request).await
        }
        Err(refused) => refused.into_response(),
    }
}

impl IntoResponse for Refused {
    fn into_response(self) -> Response {
        let (status, code, said) = match self {
            Self::Host => {
                (StatusCode::MISDIRECTED_REQUEST, "serve::host", said!("another-machines-name"))
            }
            Self::Origin => (StatusCode::FORBIDDEN, "serve::origin", said!("from-another-page")),
            Self::Stranger => {
                (StatusCode::UNAUTHORIZED, "serve::stranger", said!("open-the-printed-address"))
            }
        };
        Fault::new(status, code, said).into_response()
    }
}

/// What every request passes first, and every answer bears.
async fn guard(Of(house): Of<Arc<House>>, request: Request, next: Next) -> Response {
    let checked = house
        .gate
        .check_host(request.uri(), request.headers())
        .and_then(|()| came_from(&house, &request));
    let mut response = match checked {
        Err(refused) => refused.into_response(),
        // What says that it is too large is not waited for.
        Ok(()) if says_too_much(request.uri().path(), request.headers()) => {
            StatusCode::PAYLOAD_TOO_LARGE.into_response()
        }
        // A drive may take longer than any other answer, and tells of itself meanwhile.
        Ok(()) if request.uri().path() == ASSISTANTS => next.run(request).await,
        Ok(()) => match token(request.uri()) {
            Some(token) => enter(&house, &token),
            None => match tokio::time::timeout(PATIENCE, next.run(request)).await {
                Ok(response) => response,
                Err(_) => StatusCode::REQUEST_TIMEOUT.into_response(),
            },
        },
    };
    let headers = response.headers_mut();
    let mut say = |name: HeaderName, value: &'static str| {
        headers.insert(name, HeaderValue::from_static(value));
    };
    say(
        CONTENT_SECURITY_POLICY,
        "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    );
    say(X_CONTENT_TYPE_OPTIONS, "nosniff");
    say(REFERRER_POLICY, "no-referrer");
    say(HeaderName::from_static("cross-origin-opener-policy"), "same-origin");
    say(HeaderName::from_static("cross-origin-resource-policy"), "same-origin");
    say(CACHE_CONTROL, "no-store");
    response
}

fn says_too_much(path: &str, headers: &HeaderMap) -> bool {
    let most = if path == centre::CENTRE { centre::MAP } else { BODY };
    let length = headers.get(CONTENT_LENGTH).and_then(|length| length.to_str().ok());
    length.is_some_and(|length| length.parse().map_or(true, |bytes: usize| bytes > most))
}

/// The page itself may be opened from anywhere: it shows nothing without a cookie that other sites do not send.
fn came_from(house: &House, request: &Request) -> Result<(), Refused> {
    let opens_page = request.method() == axum::http::Method::GET && request.uri().path() == "/";
    // They bear a token, which `bears` looks at.
    if opens_page || is_of_programs(request.uri().path()) {
        return Ok(());
    }
    house.gate.check_origin(request.method(), request.headers())
}

/// The token in the address that was opened.
fn token(uri: &Uri) -> Option<String> {
    let token = uri.query()?.split('&').find_map(|pair| pair.strip_prefix("token="));
    token.filter(|_| uri.path() == "/").map(str::to_owned)
}

fn enter(house: &House, token: &str) -> Response {
    match house.gate.enter(token) {
        Ok(Some(cookie)) => {
            (StatusCode::SEE_OTHER, [(LOCATION, "/".to_owned()), (SET_COOKIE, cookie)])
                .into_response()
        }
        // Opened again by who has come in already, it is the page; to any other it says what to do.
        Ok(None) => (StatusCode::SEE_OTHER, [(LOCATION, "/")]).into_response(),
        Err(error) => {
            tracing::error!(%error, "no random numbers");
            StatusCode::INTERNAL_SERVER_ERROR.into_response()
        }
    }
}

/// Lets pass who has a session, when it is known what other programs wrote.
async fn known(Of(house): Of<Arc<House>>, mut request: Request, next: Next) -> Response {
    match house.gate.session(request.headers()) {
        Ok(session) => {
            // A stop waits for nothing.
            if !["/api/stop", "/api/pause"].contains(&request.uri().path())
                && let Err(gone) = house.desk.fresh().await
            {
                return Fault::from(gone).into_response();
            }
            request.extensions_mut().insert(session);
            next.run(request).await
        }
        Err(refused) => refused.into_response(),
    }
}

/// Lets pass whose role is enough.
async fn may(
    needs: Role,
    Extension(session): Extension<Session>,
    request: Request,
    next: Next,
) -> Response {
    if session.role >= needs {
        return next.run(request).await;
    }
    Fault::of_role().into_response()
}

async fn described() -> impl IntoResponse {
    ([(CONTENT_TYPE, "application/json")], *OPENAPI)
}

/// After which event: a browser that resumes says it in a header, a page that begins anew in its address.
#[derive(Debug, serde::Deserialize)]
struct After {
    after: Option<String>,
}

async fn happens(
    Of(house): Of<Arc<House>>,
    Query(asked): Query<After>,
    headers: HeaderMap,
) -> Response {
    let last = headers.get("last-event-id").and_then(|id| id.to_str().ok()).map(str::to_owned);
    let last = last.or(asked.after).filter(|id| !id.is_empty());
    let events = Arc::clone(&house.events);
    Sse::new(events::stream(events, last.as_deref())).into_response()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use serde_json::Value;

    use super::*;

    #[test]
    fn the_description_names_what_is_answered_and_no_more() {
        let described: Value = serde_json::from_str(&OPENAPI).expect("it is JSON");
        let paths = described["paths"].as_object().expect("it has paths");
        let mut told = BTreeSet::new();
        for (path, methods) in paths {
            for (method, operation) in methods.as_object().expect("methods") {
                told.insert((method.clone(), path.clone()));
                let role = operation["x-role"].as_str().expect("who may ask").to_owned();
                let route = ROUTES.iter().find(|(m, p, _)| m == method && p == path);
                let (_, _, needs) = route.unwrap_or_else(|| panic!("{method} {path}"));
                assert_eq!(serde_json::json!(needs), role, "{method} {path}");
                assert!(operation["summary"].is_string(), "{method} {path}");
                let named = path.matches('{').count();
                let all = operation["parameters"].as_array().map_or(&[][..], Vec::as_slice);
                let in_path = all.iter().filter(|p| p["in"] == "path").count();
                assert_eq!(named, in_path, "{method} {path}: parameters in the path");
            }
        }
        let answered: BTreeSet<(String, String)> =
            ROUTES.iter().map(|(m, p, _)| ((*m).to_owned(), (*p).to_owned())).collect();
        assert_eq!(told, answered);
    }
}
