//! The robot's side: its journal is read and sent, when there is a line.
//!
//! It runs beside the robot's own program and only reads its store. What it sends is told by what the centre has, so it
//! keeps nothing of its own, and may be killed at any moment.

use std::io::{Read, Write};
use std::path::Path;
use std::time::Duration;

use crate::ask::Answer;
use crate::error::{FleetError, Result};
use crate::handout::{Conflict, Handout};
use crate::ingest::Position;
use crate::query::Table;
use crate::serve::Refusal;
use crate::store::shipping::{Following, Frame, frames_after, whole};
use crate::units::{Bilingual, Language, said, told};

/// Frames of one request, before they are packed.
const BATCH_BYTES: usize = 4 << 20;

/// Bytes of a map, unpacked.
const MOST_MAP: u64 = 1 << 30;

/// A line to a centre.
pub struct Line {
    agent: ureq::Agent,
    url: String,
    key: String,
}

/// What a push came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Pushed {
    /// Transactions sent as frames.
    pub frames: u64,
    /// Whether the store was sent as a whole.
    pub whole: bool,
    /// The last transaction that is at the centre.
    pub sequence: i64,
}

impl Pushed {
    /// How much was sent.
    #[must_use]
    pub fn in_words(&self, language: Language) -> String {
        let Self { frames, whole, sequence } = self;
        told!(language, "frames-sent", frames, whole, sequence)
    }
}

impl Line {
    /// A line to the centre at an address such as `https://fleet.example:7433`, in the name of a key. `authority` is the
    /// PEM file of the authority that signed the centre's certificate, where it is none of the usual ones.
    ///
    /// # Errors
    /// [`FleetError::Plain`] for `http://` beyond this machine, where the key could be overheard; [`FleetError::Io`].
    pub fn new(url: &str, key: &str, authority: Option<&Path>) -> Result<Self> {
        let url = url.trim_end_matches('/').to_owned();
        if !url.starts_with("https://") && !is_loopback(&url) {
            return Err(FleetError::Plain { address: url });
        }
        let mut config = ureq::Agent::config_builder()
            .http_status_as_error(false)
            .timeout_connect(Some(Duration::from_secs(10)))
            .timeout_global(Some(Duration::from_secs(300)));
        if let Some(path) = authority {
            let failed = |source| FleetError::Io { path: path.display().to_string(), source };
            let pem = std::fs::read(path).map_err(failed)?;
            let certificate = ureq::tls::Certificate::from_pem(&pem)
                .map_err(|error| FleetError::content(error.to_string()))?;
            let roots = ureq::tls::RootCerts::from(vec![certificate]);
            config = config.tls_config(ureq::tls::TlsConfig::builder().root_certs(roots).build());
        }
        Ok(Self { agent: config.build().into(), url, key: key.trim().to_owned() })
    }

    fn fault(&self, what: impl std::fmt::Display) -> FleetError {
        self.fault_of(what.to_string().into())
    }

    fn fault_of(&self, what: Bilingual) -> FleetError {
        FleetError::Line { url: self.url.clone(), what }
    }

    fn bearer(&self) -> String {
        format!("Bearer {}", self.key)
    }

    /// # Errors
    /// [`FleetError::Line`], and whatever the centre refuses.
    pub fn position(&self) -> Result<Position> {
        let told = self.get("/v1/position")?;
        serde_json::from_slice(&told).map_err(|error| self.fault(error))
    }

    /// Sends frames and hears how far the journal is there then.
    ///
    /// # Errors
    /// [`FleetError::Gap`], [`FleetError::Diverged`], [`FleetError::Line`], and whatever else the centre refuses.
    pub fn send(&self, frames: &[Frame]) -> Result<Position> {
        self.post("/v1/frames", &packed(frames)?)
    }

    fn post<T: serde::de::DeserializeOwned>(&self, path: &str, body: &[u8]) -> Result<T> {
        let request = self.agent.post(format!("{}{path}", self.url));
        let request = request
            .header("Authorization", self.bearer())
            .header("Content-Type", "application/octet-stream")
            .header("Content-Encoding", "gzip");
        self.heard(request.send(body))
    }

    fn heard<T: serde::de::DeserializeOwned>(
        &self,
        answer: Result<ureq::http::Response<ureq::Body>, ureq::Error>,
    ) -> Result<T> {
        serde_json::from_slice(&self.heard_bytes(answer)?).map_err(|error| self.fault(error))
    }

    fn heard_bytes(
        &self,
        answer: Result<ureq::http::Response<ureq::Body>, ureq::Error>,
    ) -> Result<Vec<u8>> {
        let mut answer = answer.map_err(|error| self.fault(error))?;
        let status = answer.status();
        let body = answer.body_mut().with_config().limit(1 << 30).read_to_vec();
        let body = body.map_err(|error| self.fault(error))?;
        if status.is_success() {
            return Ok(body);
        }
        let Ok(refusal) = serde_json::from_slice::<Refusal>(&body) else {
            return Err(self.fault(status));
        };
        let what = match refusal.what_en.is_empty() {
            true => refusal.what.into(),
            false => Bilingual::new(refusal.what, refusal.what_en),
        };
        Err(match (refusal.fault.as_str(), refusal.position) {
            ("gap", Some(at)) => {
                FleetError::Gap { have: at.sequence, checksum: at.checksum, came: 0 }
            }
            ("diverged", _) => FleetError::Diverged { sequence: 0 },
            ("key", _) => FleetError::Key,
            ("forbidden", _) => FleetError::Forbidden,
            ("unknown", _) => FleetError::Unknown { what },
            ("content", _) => FleetError::Content { what },
            _ => self.fault(status),
        })
    }

    /// What the centre has to hand out, with the packed rows of its map where it is newer.
    ///
    /// # Errors
    /// [`FleetError::Line`], and whatever the centre refuses.
    pub(crate) fn handout(&self) -> Result<(Handout, Option<Vec<u8>>)> {
        let body = self.get("/v1/map")?;
        let end = body.iter().position(|byte| *byte == b'\n').unwrap_or(body.len());
        let told = serde_json::from_slice(&body[..end]).map_err(|error| self.fault(error))?;
        let packed = body.get(end + 1..).filter(|rest| !rest.is_empty());
        let rows = packed.map(|packed| -> Result<Vec<u8>> {
            let mut rows = Vec::new();
            let mut unpacking = flate2::read::GzDecoder::new(packed).take(MOST_MAP);
            unpacking.read_to_end(&mut rows).map_err(|error| self.fault(error))?;
            Ok(rows)
        });
        Ok((told, rows.transpose()?))
    }

    pub(crate) fn agree(&self, centre: i64, robots: u64) -> Result<()> {
        self.post(&format!("/v1/agreed?centre={centre}&robot={robots}"), &gzip(b"")?)
    }

    pub(crate) fn note_conflict(&self, conflict: &Conflict) -> Result<()> {
        self.post_json("/v1/conflict", conflict)
    }

    fn post_json<T: serde::de::DeserializeOwned>(
        &self,
        path: &str,
        body: &impl serde::Serialize,
    ) -> Result<T> {
        let told = serde_json::to_vec(body).map_err(|error| self.fault(error))?;
        let request = self.agent.post(format!("{}{path}", self.url));
        let request = request.header("Authorization", self.bearer());
        self.heard(request.header("Content-Type", "application/json").send(&told[..]))
    }

    /// What stands at a path of the centre.
    ///
    /// # Errors
    /// [`FleetError::Line`], and whatever the centre refuses.
    pub fn get(&self, path: &str) -> Result<Vec<u8>> {
        let request = self.agent.get(format!("{}{path}", self.url));
        self.heard_bytes(request.header("Authorization", self.bearer()).call())
    }

    /// A question in words, in an operator's name.
    ///
    /// # Errors
    /// [`FleetError::Content`] where it is not understood; [`FleetError::Line`], [`FleetError::Forbidden`].
    pub fn ask(&self, question: &str) -> Result<Answer> {
        self.post_json("/v1/ask", &serde_json::json!({ "question": question }))
    }

    /// A question in the rules' language, in an operator's name.
    ///
    /// # Errors
    /// As [`Line::ask`].
    pub fn query(&self, question: &str) -> Result<Table> {
        self.post_json("/v1/query", &serde_json::json!({ "question": question }))
    }

    /// Sends all that the centre lacks of a store.
    ///
    /// # Errors
    /// [`FleetError::Line`] and what else cuts it short: what was acknowledged until then is at the centre.
    pub fn push(&self, store: &Path) -> Result<Pushed> {
        let mut at = self.position()?;
        let mut pushed = Pushed { sequence: at.sequence, ..Pushed::default() };
        loop {
            let sent = match frames_after(store, sequence(at)?, at.checksum, BATCH_BYTES)? {
                Following::Frames(frames) if frames.is_empty() => return Ok(pushed),
                Following::Frames(frames) => {
                    let sent = self.send(&frames);
                    pushed.frames += if sent.is_ok() { frames.len() as u64 } else { 0 };
                    sent
                }
                Following::Broken => {
                    pushed.whole = true;
                    self.send_whole(store)
                }
            };
            at = match sent {
                Ok(now) if now == at => return Err(self.fault_of(said!("centre-does-not-go-on"))),
                Ok(now) => now,
                // Somebody else has sent some meanwhile, or the centre was put back.
                Err(FleetError::Gap { have, checksum, .. }) => {
                    Position { sequence: have, checksum }
                }
                Err(FleetError::Diverged { .. }) => {
                    pushed.whole = true;
                    self.send_whole(store)?
                }
                Err(error) => return Err(error),
            };
            pushed.sequence = at.sequence;
        }
    }

    fn send_whole(&self, store: &Path) -> Result<Position> {
        let whole = whole(store)?;
        let mut path = format!("/v1/whole?sequence={}", whole.sequence);
        if let Some(checksum) = whole.checksum {
            path += &format!("&checksum={checksum}");
        }
        self.post(&path, &packed(&whole.pieces)?)
    }
}

fn sequence(at: Position) -> Result<u64> {
    u64::try_from(at.sequence)
        .map_err(|_negative| FleetError::content(said!("frame-numbered", sequence = at.sequence)))
}

fn is_loopback(url: &str) -> bool {
    let Ok(uri) = url.parse::<ureq::http::Uri>() else { return false };
    let Some(host) = uri.host() else { return false };
    let ip = host.trim_matches(['[', ']']).parse::<std::net::IpAddr>();
    host == "localhost" || ip.is_ok_and(|ip| ip.is_loopback())
}

fn packed(frames: &[Frame]) -> Result<Vec<u8>> {
    let all: Vec<u8> = frames.iter().flat_map(|frame| &frame.bytes).copied().collect();
    gzip(&all)
}

pub(crate) fn gzip(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut out = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    let failed = |source| FleetError::Io { path: "gzip".to_owned(), source };
    out.write_all(bytes).map_err(failed)?;
    out.finish().map_err(failed)
}
