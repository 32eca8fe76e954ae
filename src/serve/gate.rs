//! Who may come in: hosts, origins, tokens, sessions and roles.
//!
//! A page of another site, another program's page on another port, and a name that was bent to this machine (DNS rebinding)
//! all reach a server on the loopback. So a request must name a host of ours before anything of it is looked at; one that
//! changes something must come from our own page by `Origin` and `Sec-Fetch-Site`; and whoever asks must bear the cookie
//! that the opened address was exchanged for.
//!
//! **Invariant.** A one-time token is good for one session, and secrets are compared in constant time.

use std::fmt::Write as _;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

use axum::http::header::{AUTHORIZATION, COOKIE, HOST, ORIGIN};
use axum::http::{HeaderMap, Method, Uri};
use serde::{Deserialize, Serialize};
use subtle::ConstantTimeEq as _;

use crate::units::write_file;

/// What whoever is connected may do; each may also do what the ones before it may.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Look, ask, and stop the robot.
    Look,
    /// Give the robot tasks.
    Drive,
    /// Change the map.
    Edit,
}

impl Role {
    /// As programs read it, and write it.
    pub(super) const fn word(self) -> &'static str {
        match self {
            Self::Look => "look",
            Self::Drive => "drive",
            Self::Edit => "edit",
        }
    }
}

/// One who came in.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Session {
    secret: String,
    /// Tells sessions apart in what others may see.
    pub number: u64,
    pub role: Role,
    /// The author of what is done here.
    pub name: String,
}

impl Session {
    /// One that came by no cookie.
    #[must_use]
    pub(super) fn of(number: u64, role: Role, name: &str) -> Self {
        Self { secret: String::new(), number, role, name: name.to_owned() }
    }
}

#[derive(Debug)]
struct Token {
    secret: String,
    role: Role,
    name: String,
    /// Given by whoever runs the server, and good until it ends.
    lasts: bool,
}

/// Why a request is not let in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Refused {
    /// It names no host of ours.
    Host,
    /// It changes something and does not come from our page.
    Origin,
    /// It bears no cookie of ours.
    Stranger,
}

/// See the head of this file.
#[derive(Debug)]
pub(super) struct Gate {
    /// As a browser writes them into `Host`.
    hosts: Vec<String>,
    /// Browsers send `Sec-Fetch-Site` to the loopback, and to nobody else over plain HTTP.
    is_loopback: bool,
    cookie: String,
    inside: Mutex<Inside>,
    /// Where sessions outlive the program.
    file: Option<PathBuf>,
}

#[derive(Debug, Default)]
struct Inside {
    tokens: Vec<Token>,
    sessions: Vec<Session>,
}

/// More than so many sessions nobody has; the oldest goes.
const MOST_SESSIONS: usize = 200;

impl Gate {
    /// A gate for a server that listens there. `names` are further names of this machine; sessions are kept in `file`.
    #[must_use]
    pub(super) fn new(listens: SocketAddr, names: &[String], file: Option<PathBuf>) -> Self {
        let port = listens.port();
        let mut called: Vec<String> = names.to_vec();
        if listens.ip().is_loopback() || listens.ip().is_unspecified() {
            called.extend(["127.0.0.1", "localhost", "[::1]"].map(str::to_owned));
        } else {
            let ip = listens.ip();
            called.push(if ip.is_ipv6() { format!("[{ip}]") } else { ip.to_string() });
        }
        let with_port = |name: &String| format!("{}:{port}", name.to_lowercase());
        let kept = file.as_ref().and_then(|file| std::fs::read(file).ok());
        let sessions = kept.and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default();
        Self {
            hosts: called.iter().map(with_port).collect(),
            is_loopback: listens.ip().is_loopback(),
            // Cookies of a host go to all its ports.
            cookie: format!("ortho-{port}"),
            inside: Mutex::new(Inside { tokens: Vec::new(), sessions }),
            file,
        }
    }

    fn inside(&self) -> MutexGuard<'_, Inside> {
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A new token for one session.
    ///
    /// # Errors
    /// The system gives no random numbers.
    pub(super) fn invite(&self, role: Role, name: &str) -> std::io::Result<String> {
        let secret = random()?;
        let token = Token { secret: secret.clone(), role, name: name.to_owned(), lasts: false };
        self.inside().tokens.push(token);
        Ok(secret)
    }

    /// A token that lasts, chosen by whoever runs the server.
    pub(super) fn trust(&self, secret: &str, role: Role, name: &str) {
        let (secret, name) = (secret.to_owned(), name.to_owned());
        self.inside().tokens.push(Token { secret, role, name, lasts: true });
    }

    /// Exchanges a token for a session; gives the value of `Set-Cookie`.
    ///
    /// # Errors
    /// The system gives no random numbers. A token that is none gives none.
    pub(super) fn enter(&self, token: &str) -> std::io::Result<Option<String>> {
        let mut inside = self.inside();
        let Some(at) = inside.tokens.iter().position(|t| is_same(&t.secret, token)) else {
            return Ok(None);
        };
        let secret = random()?;
        let (role, name) = (inside.tokens[at].role, inside.tokens[at].name.clone());
        if !inside.tokens[at].lasts {
            inside.tokens.swap_remove(at);
        }
        let number = inside.sessions.iter().map(|s| s.number).max().unwrap_or(0) + 1;
        let cookie = format!("{}={secret}; HttpOnly; SameSite=Strict; Path=/", self.cookie);
        inside.sessions.push(Session { secret, number, role, name });
        if inside.sessions.len() > MOST_SESSIONS {
            inside.sessions.remove(0);
        }
        self.keep(&inside.sessions);
        Ok(Some(cookie))
    }

    /// Ends a session: its cookie is worth nothing from now on.
    pub(super) fn leave(&self, session: &Session) {
        let mut inside = self.inside();
        inside.sessions.retain(|s| s.number != session.number);
        self.keep(&inside.sessions);
    }

    /// The file is readable by its owner alone. A disk that refuses costs a new address after the next start, no more.
    fn keep(&self, sessions: &[Session]) {
        let Some(file) = &self.file else { return };
        let text = serde_json::to_vec(sessions).expect("sessions are plain values");
        if let Err(error) = write_file(file, &text).and_then(|()| only_for_owner(file)) {
            tracing::warn!(%error, "sessions are not kept");
        }
    }

    /// Whether a request names a host of ours, once, and in no other way.
    ///
    /// # Errors
    /// [`Refused::Host`].
    pub(super) fn check_host(&self, uri: &Uri, headers: &HeaderMap) -> Result<(), Refused> {
        let ours = |host: &str| self.hosts.contains(&host.to_lowercase());
        let mut named = headers.get_all(HOST).iter();
        let host = named.next().and_then(|host| host.to_str().ok());
        let in_line = uri.authority().is_none_or(|authority| ours(authority.as_str()));
        match (host, named.next()) {
            (Some(host), None) if ours(host) && in_line => Ok(()),
            _ => Err(Refused::Host),
        }
    }

    /// Whether a request comes from our own page, as far as it must: one that changes something must say so.
    ///
    /// # Errors
    /// [`Refused::Origin`].
    pub(super) fn check_origin(&self, method: &Method, headers: &HeaderMap) -> Result<(), Refused> {
        let all = |name: &str| headers.get_all(name).iter().map(|v| v.to_str().unwrap_or("?"));
        let site: Vec<&str> = all("sec-fetch-site").collect();
        if *method == Method::GET || *method == Method::HEAD {
            let is_ours = site.iter().all(|site| ["same-origin", "none"].contains(site));
            return if is_ours { Ok(()) } else { Err(Refused::Origin) };
        }
        let host = headers.get(HOST).and_then(|host| host.to_str().ok()).unwrap_or("?");
        let origin: Vec<&str> = all(ORIGIN.as_str()).collect();
        let is_from_here =
            matches!(origin[..], [one] if one.eq_ignore_ascii_case(&format!("http://{host}")));
        let is_same_site = match site[..] {
            [] => !self.is_loopback,
            [one] => one == "same-origin",
            _ => false,
        };
        if is_from_here && is_same_site { Ok(()) } else { Err(Refused::Origin) }
    }

    /// Whoever bears a token that lasts (`Authorization: Bearer …`). A page of another site cannot say this header without
    /// being asked first, so a request that bears one needs no `Origin`; one that names a foreign one is refused.
    ///
    /// # Errors
    /// [`Refused::Stranger`], [`Refused::Origin`].
    pub(super) fn bearer(&self, headers: &HeaderMap) -> Result<Session, Refused> {
        let own = |origin: &str| {
            let host = headers.get(HOST).and_then(|host| host.to_str().ok()).unwrap_or("?");
            origin.eq_ignore_ascii_case(&format!("http://{host}"))
        };
        if !headers.get_all(ORIGIN).iter().all(|origin| origin.to_str().is_ok_and(own)) {
            return Err(Refused::Origin);
        }
        let told = headers.get(AUTHORIZATION).and_then(|value| value.to_str().ok());
        let told = told.and_then(|value| value.strip_prefix("Bearer ")).ok_or(Refused::Stranger)?;
        let inside = self.inside();
        let lasting = inside.tokens.iter().filter(|token| token.lasts);
        let found = lasting.into_iter().find(|token| is_same(&token.secret, told.trim()));
        let found = found.ok_or(Refused::Stranger)?;
        Ok(Session::of(0, found.role, &found.name))
    }

    /// The session whose cookie a request bears.
    ///
    /// # Errors
    /// [`Refused::Stranger`].
    pub(super) fn session(&self, headers: &HeaderMap) -> Result<Session, Refused> {
        let cookies = headers.get_all(COOKIE).iter().filter_map(|value| value.to_str().ok());
        let mut pairs = cookies.flat_map(|text| text.split(';')).filter_map(|c| c.split_once('='));
        let borne = pairs.find(|(name, _)| name.trim() == self.cookie);
        let borne = borne.map(|(_, value)| value.trim()).ok_or(Refused::Stranger)?;
        let inside = self.inside();
        let found = inside.sessions.iter().find(|session| is_same(&session.secret, borne));
        found.cloned().ok_or(Refused::Stranger)
    }
}

fn is_same(secret: &str, given: &str) -> bool {
    secret.as_bytes().ct_eq(given.as_bytes()).into()
}

/// 256 random bits, in hexadecimal digits.
pub(super) fn random() -> std::io::Result<String> {
    let mut bytes = [0_u8; 32];
    getrandom::fill(&mut bytes).map_err(std::io::Error::other)?;
    let mut text = String::with_capacity(64);
    for byte in bytes {
        let _ = write!(text, "{byte:02x}");
    }
    Ok(text)
}

#[cfg(unix)]
fn only_for_owner(file: &std::path::Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt as _;
    std::fs::set_permissions(file, std::fs::Permissions::from_mode(0o600))
}

#[cfg(not(unix))]
fn only_for_owner(_: &std::path::Path) -> std::io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gate() -> Gate {
        Gate::new(([127, 0, 0, 1], 80).into(), &[], None)
    }

    fn headers(of: &[(&'static str, &str)]) -> HeaderMap {
        let mut headers = HeaderMap::new();
        for (name, value) in of {
            headers.append(*name, value.parse().expect("a header value"));
        }
        headers
    }

    #[test]
    fn a_token_is_good_once_and_a_left_session_is_over() {
        let gate = gate();
        let token = gate.invite(Role::Drive, "Анна").expect("random numbers");
        let cookie = gate.enter(&token).expect("random numbers").expect("it is the token");
        assert_eq!(gate.enter(&token).expect("random numbers"), None);
        let pair = cookie.split(';').next().expect("a pair");
        let borne = headers(&[("cookie", pair)]);
        let session = gate.session(&borne).expect("it is the cookie");
        assert_eq!((session.role, session.name.as_str()), (Role::Drive, "Анна"));
        gate.leave(&session);
        assert_eq!(gate.session(&borne), Err(Refused::Stranger));
    }

    #[test]
    fn what_changes_something_must_say_that_it_comes_from_here() {
        let gate = gate();
        let check = |more: &[(&'static str, &str)]| {
            let host = [("host", "localhost:80")];
            gate.check_origin(&Method::POST, &headers(&[&host, more].concat())).is_ok()
        };
        let (origin, site) = (("origin", "http://localhost:80"), ("sec-fetch-site", "same-origin"));
        assert!(check(&[origin, site]));
        for wrong in [
            &[origin][..],
            &[site],
            &[("origin", "null"), site],
            &[("origin", "http://localhost:81"), site],
            &[("origin", "https://localhost:80"), site],
            &[origin, origin, site],
            &[origin, ("sec-fetch-site", "same-site")],
            &[origin, ("sec-fetch-site", "none")],
        ] {
            assert!(!check(wrong), "{wrong:?}");
        }
    }

    #[test]
    fn only_hosts_of_ours_are_known() {
        let gate = gate();
        let check = |uri: &str, of: &[(&'static str, &str)]| {
            gate.check_host(&uri.parse().expect("a URI"), &headers(of)).is_ok()
        };
        assert!(check("/", &[("host", "127.0.0.1:80")]));
        assert!(check("/", &[("host", "LOCALHOST:80")]));
        assert!(!check("/", &[]));
        assert!(!check("/", &[("host", "localhost")]));
        assert!(!check("/", &[("host", "evil.example:80")]));
        assert!(!check("/", &[("host", "localhost:80"), ("host", "evil.example")]));
        assert!(!check("http://evil.example/", &[("host", "localhost:80")]));
    }
}
