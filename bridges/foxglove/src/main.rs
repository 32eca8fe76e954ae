//! `ortho-foxglove FILE`: a recording shown to Foxglove and Lichtblick by their websocket while it is being written.
//!
//! Speaks `foxglove.sdk.v1` and its forerunner `foxglove.websocket.v1`, as a server: server info, channels, and messages to
//! whoever subscribed. Who comes later is told the last message of every topic first, which is all that a picture needs.
//!
//! **Invariant.** Whoever looks on changes nothing: the file is only read, and a viewer that is slow or speaks nonsense is
//! let go alone.

use std::collections::{BTreeMap, BTreeSet};
use std::io::ErrorKind;
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use clap::Parser;
use orthoframe_recording::{Followed, Follower};
use serde_json::{Value, json};
use tungstenite::handshake::server::{ErrorResponse, Request, Response};
use tungstenite::http::HeaderValue;
use tungstenite::{Message, WebSocket, accept_hdr};

/// The protocols that are spoken, the newest first.
const SPOKEN: [&str; 2] = ["foxglove.sdk.v1", "foxglove.websocket.v1"];
/// Between two looks at the file, and at what a viewer says.
const GLANCE: Duration = Duration::from_millis(50);
/// A viewer that takes nothing for so long is let go.
const PATIENCE: Duration = Duration::from_secs(10);

#[derive(Debug, Parser)]
#[command(
    name = "ortho-foxglove",
    version,
    about = "Shows a recording to Foxglove and Lichtblick while it is being written"
)]
struct Arguments {
    /// The file of `ortho do --record`; it may not be there yet
    file: PathBuf,
    /// Where viewers connect: ws://HOST:PORT
    #[arg(long, default_value = "127.0.0.1:8765", value_name = "HOST:PORT")]
    listen: SocketAddr,
}

#[derive(Debug, Clone)]
struct Channel {
    topic: String,
    schema: String,
    text: String,
}

/// All that was read so far, as far as a viewer needs it.
#[derive(Debug, Default)]
struct Board {
    schemas: BTreeMap<u16, (String, String)>,
    channels: BTreeMap<u16, Channel>,
    /// Of each channel the last message, with its number over all.
    last: BTreeMap<u16, Said>,
    /// The newest messages, for those who were there.
    recent: std::collections::VecDeque<Said>,
    number: u64,
}

#[derive(Debug, Clone)]
struct Said {
    number: u64,
    channel: u16,
    time: u64,
    data: Arc<[u8]>,
}

/// So many messages wait for a viewer that is slow.
const KEPT: usize = 4096;

impl Board {
    fn hear(&mut self, found: Vec<Followed>) {
        for one in found {
            match one {
                Followed::Schema { id, name, text } => {
                    self.schemas.insert(id, (name, text));
                }
                Followed::Channel { id, schema, topic } => {
                    let (schema, text) = self.schemas.get(&schema).cloned().unwrap_or_default();
                    self.channels.insert(id, Channel { topic, schema, text });
                }
                Followed::Message { channel, time, data } => {
                    self.number += 1;
                    let said = Said { number: self.number, channel, time, data: data.into() };
                    self.last.insert(channel, said.clone());
                    self.recent.push_back(said);
                    if self.recent.len() > KEPT {
                        self.recent.pop_front();
                    }
                }
                Followed::End => {}
            }
        }
    }
}

type Shared = Arc<Mutex<Board>>;

fn board(shared: &Shared) -> MutexGuard<'_, Board> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

fn main() -> ExitCode {
    match serve(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("ortho-foxglove: {why}");
            ExitCode::from(3)
        }
    }
}

fn serve(arguments: &Arguments) -> Result<(), String> {
    let at = arguments.listen;
    let listener = TcpListener::bind(at).map_err(|error| format!("{at}: {error}"))?;
    let at = listener.local_addr().map_err(|error| format!("{at}: {error}"))?;
    eprintln!("ws://{at}");
    let shared = Shared::default();
    let (file, read) = (arguments.file.clone(), Arc::clone(&shared));
    std::thread::spawn(move || follow(&file, &read));
    for stream in listener.incoming() {
        // One that went away before it was met is none.
        let Ok(stream) = stream else { continue };
        let shared = Arc::clone(&shared);
        std::thread::spawn(move || {
            // Why one viewer is let go does not matter to the others.
            if let Some(why) = attend(stream, &shared).err() {
                eprintln!("ortho-foxglove: a viewer is gone: {why}");
            }
        });
    }
    Ok(())
}

/// Reads the file, and the one that is written in its place, as long as the program runs.
fn follow(path: &Path, shared: &Shared) {
    loop {
        let Ok(mut follower) = Follower::open(path) else {
            std::thread::sleep(GLANCE);
            continue;
        };
        loop {
            match follower.look() {
                Ok(found) => board(shared).hear(found),
                Err(why) => {
                    eprintln!("ortho-foxglove: {}: {why}", path.display());
                    break;
                }
            }
            std::thread::sleep(GLANCE);
        }
        // A new recording has channels of its own, and none of the old.
        let number = board(shared).number;
        *board(shared) = Board { number, ..Board::default() };
        std::thread::sleep(GLANCE);
    }
}

/// Speaks with one viewer until it goes.
fn attend(stream: TcpStream, shared: &Shared) -> Result<(), tungstenite::Error> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let mut socket = accept_hdr(stream, agree).map_err(|refused| match refused {
        tungstenite::HandshakeError::Failure(error) => error,
        tungstenite::HandshakeError::Interrupted(_) => {
            tungstenite::Error::Io(std::io::Error::from(ErrorKind::TimedOut))
        }
    })?;
    socket.get_ref().set_read_timeout(Some(GLANCE))?;
    let info = json!({
        "op": "serverInfo", "name": "orthoframe", "capabilities": [], "supportedEncodings": ["json"],
        "metadata": {}, "sessionId": std::process::id().to_string(),
    });
    socket.send(Message::text(info.to_string()))?;
    let mut viewer = Viewer::default();
    loop {
        match socket.read() {
            Ok(Message::Text(text)) => viewer.heed(text.as_str(), &mut socket, shared)?,
            Ok(Message::Close(_)) => return Ok(()),
            // No capability was offered that would bring anything else.
            Ok(_) => {}
            Err(tungstenite::Error::Io(error))
                if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
            Err(tungstenite::Error::ConnectionClosed | tungstenite::Error::AlreadyClosed) => {
                return Ok(());
            }
            Err(error) => return Err(error),
        }
        viewer.tell(&mut socket, shared)?;
    }
}

/// Chooses a protocol that both speak.
#[expect(clippy::result_large_err, reason = "tungstenite asks for this type")]
fn agree(request: &Request, mut response: Response) -> Result<Response, ErrorResponse> {
    const PROTOCOL: &str = "Sec-WebSocket-Protocol";
    let asked = request.headers().get_all(PROTOCOL).iter().filter_map(|value| value.to_str().ok());
    let asked: Vec<&str> = asked.flat_map(|list| list.split(',').map(str::trim)).collect();
    let Some(spoken) = SPOKEN.iter().find(|name| asked.contains(name)) else {
        let mut refused =
            ErrorResponse::new(Some(format!("one of these is spoken: {}", SPOKEN.join(", "))));
        *refused.status_mut() = tungstenite::http::StatusCode::BAD_REQUEST;
        return Err(refused);
    };
    response.headers_mut().insert(PROTOCOL, HeaderValue::from_static(spoken));
    Ok(response)
}

/// What one viewer was told.
#[derive(Debug, Default)]
struct Viewer {
    advertised: BTreeSet<u16>,
    /// Channel → subscription.
    subscribed: BTreeMap<u16, u32>,
    /// The last message that it was told or came too late for.
    number: u64,
}

impl Viewer {
    fn heed(
        &mut self,
        text: &str,
        socket: &mut WebSocket<TcpStream>,
        shared: &Shared,
    ) -> Result<(), tungstenite::Error> {
        let said: Value = serde_json::from_str(text).unwrap_or(Value::Null);
        let number = |value: &Value| value.as_u64().and_then(|number| u32::try_from(number).ok());
        match said["op"].as_str() {
            Some("subscribe") => {
                for one in said["subscriptions"].as_array().into_iter().flatten() {
                    let (Some(id), Some(channel)) = (number(&one["id"]), number(&one["channelId"]))
                    else {
                        continue;
                    };
                    let Ok(channel) = u16::try_from(channel) else { continue };
                    self.subscribed.insert(channel, id);
                    // What was said before counts still.
                    let last = board(shared)
                        .last
                        .get(&channel)
                        .filter(|said| said.number <= self.number)
                        .cloned();
                    if let Some(said) = last {
                        socket.send(binary(id, &said))?;
                    }
                }
            }
            Some("unsubscribe") => {
                let ids: Vec<u32> = said["subscriptionIds"]
                    .as_array()
                    .into_iter()
                    .flatten()
                    .filter_map(number)
                    .collect();
                self.subscribed.retain(|_, id| !ids.contains(id));
            }
            _ => {
                let told =
                    json!({ "op": "status", "level": 1, "message": "this was not understood" });
                socket.send(Message::text(told.to_string()))?;
            }
        }
        Ok(())
    }

    /// New channels, and new messages to whoever wants them.
    fn tell(
        &mut self,
        socket: &mut WebSocket<TcpStream>,
        shared: &Shared,
    ) -> Result<(), tungstenite::Error> {
        let (new, gone, messages) = {
            let board = board(shared);
            let known = |id: &&u16| !self.advertised.contains(*id);
            let new: Vec<(u16, Channel)> = board
                .channels
                .keys()
                .filter(known)
                .map(|id| (*id, board.channels[id].clone()))
                .collect();
            let gone: Vec<u16> = self
                .advertised
                .iter()
                .filter(|id| !board.channels.contains_key(id))
                .copied()
                .collect();
            let messages: Vec<Said> =
                board.recent.iter().filter(|said| said.number > self.number).cloned().collect();
            (new, gone, messages)
        };
        if !gone.is_empty() {
            self.advertised.retain(|id| !gone.contains(id));
            self.subscribed.retain(|id, _| !gone.contains(id));
            let told = json!({ "op": "unadvertise", "channelIds": gone });
            socket.send(Message::text(told.to_string()))?;
        }
        if !new.is_empty() {
            let view = |(id, channel): &(u16, Channel)| {
                json!({
                    "id": id, "topic": channel.topic, "encoding": "json", "schemaName": channel.schema,
                    "schemaEncoding": "jsonschema", "schema": channel.text,
                })
            };
            let told =
                json!({ "op": "advertise", "channels": new.iter().map(view).collect::<Vec<_>>() });
            socket.send(Message::text(told.to_string()))?;
            self.advertised.extend(new.iter().map(|(id, _)| *id));
        }
        for said in messages {
            self.number = said.number;
            if let Some(id) = self.subscribed.get(&said.channel) {
                socket.send(binary(*id, &said))?;
            }
        }
        Ok(())
    }
}

/// Opcode 1: a message of a subscription.
fn binary(subscription: u32, said: &Said) -> Message {
    let mut bytes = vec![1];
    bytes.extend(subscription.to_le_bytes());
    bytes.extend(said.time.to_le_bytes());
    bytes.extend(&*said.data);
    Message::binary(bytes)
}
