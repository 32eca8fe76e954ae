//! Who may ask from a browser, and how.
//!
//! Programs bear a key in `Authorization`, which a page of another site cannot say without being asked first; if they name an
//! origin, it is ours. A browser bears a cookie, which it sends by itself: so it has to name a host of ours, which a name bent
//! to this machine (DNS rebinding) is not, and what it asks for has to come from our own page by `Origin` and
//! `Sec-Fetch-Site`.
//!
//! **Invariant**: a request with a cookie that does not come from our page is refused before anything of it is looked at.

use std::net::SocketAddr;
use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::header::{
    AUTHORIZATION, CACHE_CONTROL, CONTENT_SECURITY_POLICY, COOKIE, HOST, HeaderName, HeaderValue,
    ORIGIN, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{HeaderMap, Method, StatusCode, Uri};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

/// See the head of this file.
#[derive(Debug)]
pub struct Gate {
    /// As a browser writes them into `Host`.
    hosts: Vec<String>,
    scheme: &'static str,
    cookie: String,
}

impl Gate {
    /// A gate for a server that listens there; `names` are what it is called elsewhere, with a port where that is another.
    #[must_use]
    pub fn new(listens: SocketAddr, is_tls: bool, names: &[String]) -> Self {
        let scheme = if is_tls { "https" } else { "http" };
        let usual = if is_tls { ":443" } else { ":80" };
        let mut called = names.to_vec();
        let ip = listens.ip();
        if ip.is_loopback() || ip.is_unspecified() {
            called.extend(["127.0.0.1", "localhost", "[::1]"].map(str::to_owned));
        }
        if !ip.is_loopback() && !ip.is_unspecified() {
            called.push(if ip.is_ipv6() { format!("[{ip}]") } else { ip.to_string() });
        }
        let mut hosts = Vec::new();
        for name in called.iter().map(|name| name.to_lowercase()) {
            let has_port =
                name.rsplit_once(':').is_some_and(|(_, port)| port.parse::<u16>().is_ok())
                    && !name.ends_with(']');
            let name = if has_port { name } else { format!("{name}:{}", listens.port()) };
            // A browser leaves out the port that is the usual one.
            hosts.extend(name.strip_suffix(usual).map(str::to_owned));
            hosts.push(name);
        }
        // Cookies of a host go to all its ports; with this prefix a browser takes them from this very host, over TLS, alone.
        let prefix = if is_tls { "__Host-" } else { "" };
        Self { hosts, scheme, cookie: format!("{prefix}ortho-fleet-{}", listens.port()) }
    }

    /// `Set-Cookie` for a session; an empty one ends it.
    #[must_use]
    pub(crate) fn cookie(&self, session: &str) -> String {
        let secure = if self.scheme == "https" { "; Secure" } else { "" };
        let end = if session.is_empty() { "; Max-Age=0" } else { "" };
        format!("{}={session}; HttpOnly; SameSite=Strict; Path=/{secure}{end}", self.cookie)
    }

    /// The session that a request bears.
    pub(crate) fn session(&self, headers: &HeaderMap) -> Option<String> {
        let cookies = headers.get_all(COOKIE).iter().filter_map(|value| value.to_str().ok());
        let mut pairs = cookies.flat_map(|text| text.split(';')).filter_map(|c| c.split_once('='));
        let borne = pairs.find(|(name, _)| name.trim() == self.cookie);
        borne.map(|(_, value)| value.trim().to_owned())
    }

    /// # Errors
    /// With what a request that may not come in is answered.
    fn check(&self, method: &Method, uri: &Uri, headers: &HeaderMap) -> Result<(), StatusCode> {
        let all = |name: &HeaderName| -> Vec<&str> {
            headers.get_all(name).iter().map(|v| v.to_str().unwrap_or("?")).collect()
        };
        let (hosts, origins) = (all(&HOST), all(&ORIGIN));
        let is_ours = |host: &str| self.hosts.contains(&host.to_lowercase());
        let from_here = |origin: &&str| {
            let host = origin.strip_prefix(self.scheme).and_then(|rest| rest.strip_prefix("://"));
            host.is_some_and(is_ours)
        };
        if headers.contains_key(AUTHORIZATION) {
            return if origins.iter().all(from_here) { Ok(()) } else { Err(StatusCode::FORBIDDEN) };
        }
        let in_line = uri.authority().is_none_or(|authority| is_ours(authority.as_str()));
        if !matches!(hosts[..], [one] if is_ours(one)) || !in_line {
            return Err(StatusCode::MISDIRECTED_REQUEST);
        }
        let sites = all(&HeaderName::from_static("sec-fetch-site"));
        let is_read = *method == Method::GET || *method == Method::HEAD;
        let comes_from_here = if is_read {
            // The page itself shows nothing without a cookie that other sites do not send.
            uri.path() == "/" || sites.iter().all(|site| ["same-origin", "none"].contains(site))
        } else {
            // Browsers tell the site to what is encrypted or on this machine: to us, always.
            matches!(origins[..], [one] if from_here(&one)) && sites == ["same-origin"]
        };
        if comes_from_here { Ok(()) } else { Err(StatusCode::FORBIDDEN) }
    }
}

/// Lets in whom the gate lets in, and says with every answer what a browser may do with it.
pub(crate) async fn guard(State(gate): State<Arc<Gate>>, request: Request, next: Next) -> Response {
    let checked = gate.check(request.method(), request.uri(), request.headers());
    let mut response = match checked {
        Ok(()) => next.run(request).await,
        Err(status) => status.into_response(),
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

#[cfg(test)]
mod tests {
    use super::*;

    fn check(gate: &Gate, method: &Method, uri: &str, of: &[(&'static str, &str)]) -> bool {
        let mut headers = HeaderMap::new();
        for (name, value) in of {
            headers.append(*name, value.parse().expect("a header value"));
        }
        gate.check(method, &uri.parse().expect("a URI"), &headers).is_ok()
    }

    #[test]
    fn only_hosts_of_ours_are_known() {
        let gate = Gate::new(([127, 0, 0, 1], 81).into(), false, &["fleet.example:80".into()]);
        let get = |uri: &str, of: &[(&'static str, &str)]| check(&gate, &Method::GET, uri, of);
        assert!(get("/", &[("host", "127.0.0.1:81")]));
        assert!(get("/", &[("host", "LOCALHOST:81")]));
        assert!(get("/", &[("host", "fleet.example")]));
        assert!(get("/", &[("host", "fleet.example:80")]));
        for wrong in ["localhost", "evil.example:81", "fleet.example:81", "localhost:80"] {
            assert!(!get("/", &[("host", wrong)]), "{wrong}");
        }
        assert!(!get("/", &[]));
        assert!(!get("/", &[("host", "localhost:81"), ("host", "evil.example")]));
        assert!(!get("http://evil.example/", &[("host", "localhost:81")]));
    }

    #[test]
    fn what_bears_a_cookie_comes_from_our_page() {
        let gate = Gate::new(([0, 0, 0, 0], 7433).into(), true, &["fleet.example".into()]);
        let host = ("host", "fleet.example:7433");
        let origin = ("origin", "https://fleet.example:7433");
        let site = ("sec-fetch-site", "same-origin");
        assert!(check(&gate, &Method::POST, "/v1/ask", &[host, origin, site]));
        assert!(check(&gate, &Method::GET, "/v1/fleet", &[host, site]));
        for wrong in [
            &[host, origin][..],
            &[host, site],
            &[host, site, ("origin", "null")],
            &[host, site, ("origin", "http://fleet.example:7433")],
            &[host, site, ("origin", "https://evil.example")],
            &[host, site, origin, origin],
            &[host, origin, ("sec-fetch-site", "same-site")],
            &[host, origin, ("sec-fetch-site", "none")],
        ] {
            assert!(!check(&gate, &Method::POST, "/v1/ask", wrong), "{wrong:?}");
        }
        let cross = [host, ("sec-fetch-site", "cross-site")];
        assert!(!check(&gate, &Method::GET, "/v1/fleet", &cross));
        assert!(check(&gate, &Method::GET, "/", &cross), "the page itself is opened from anywhere");
        // A key needs no host, and no origin but ours.
        let key = ("authorization", "Bearer x");
        assert!(check(&gate, &Method::POST, "/v1/frames", &[("host", "10.0.0.9:1"), key]));
        assert!(!check(
            &gate,
            &Method::POST,
            "/v1/ask",
            &[host, key, ("origin", "https://evil.example")]
        ));
        assert!(
            gate.cookie("x")
                .contains("__Host-ortho-fleet-7433=x; HttpOnly; SameSite=Strict; Path=/; Secure")
        );
    }
}
