//! A vehicle elsewhere, driven by lines of the protocol over anything that reads and writes.
//!
//! Reading and writing have threads of their own, so that neither a vehicle that says nothing nor one that reads nothing
//! holds up the mission longer than the caller's [`Patience`]. Nothing that the vehicle says is taken over before it was
//! checked; once it has failed, it is asked nothing more.

use std::fmt;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::process::{Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

use crate::geometry::Ride;
use crate::map::{DoorState, World};
use crate::units::{
    AreaId, Bilingual, Deg, DoorId, Frame, MapId, Point, Pose, ReplicaId, said, word,
};

use super::link::{Address, Link};
use super::names::{Names, Wrong};
use super::protocol::{LONGEST_LINE, Message, Order, Place, Saying, VERSION, Wish};
use super::{
    Bump, Done, Failure, Moment, Notice, Obstruction, Sighting, Unfinished, Vehicle, Watch,
};

/// How long a caller waits for a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Patience {
    /// The vehicle may say nothing for so long while it owes an answer.
    pub silence: Duration,
    /// And no order may take longer than this, however much it says.
    pub order: Duration,
}

impl Default for Patience {
    /// Ten seconds of silence, and half an hour for an order: a lift may be waited for.
    fn default() -> Self {
        Self { silence: Duration::from_secs(10), order: Duration::from_secs(1800) }
    }
}

/// What the reading thread hands on.
enum Heard {
    Line(Vec<u8>),
    /// A line of more bytes than are read.
    TooLong(Vec<u8>),
}

/// How often a stop is looked for while the vehicle says nothing.
const GLANCE: Duration = Duration::from_millis(20);
/// Lines that may wait to be heard; the vehicle is then read no further.
const WAITING: usize = 1024;
/// So much of a line is shown in a report, characters.
const SHOWN: usize = 120;

/// A vehicle that speaks the protocol.
#[derive(Debug)]
pub struct RemoteVehicle {
    names: Names,
    patience: Patience,
    to: Sender<String>,
    from: Receiver<Heard>,
    /// Of the last order.
    id: u64,
    called: String,
    is_by_odometry: bool,
    at: (MapId, Pose),
    time: f64,
    failed: Option<Failure>,
    /// The speed that it is to keep to on the next ways, cm/s.
    pace: Option<f64>,
    /// The process or the connection, which ends with it.
    _link: Option<Link>,
}

impl RemoteVehicle {
    /// Speaks with a vehicle over its two streams, about the things of this world.
    ///
    /// # Errors
    /// It does not greet back, or not as it should.
    pub fn over(
        reader: impl Read + Send + 'static,
        writer: impl Write + Send + 'static,
        world: &World,
        patience: Patience,
    ) -> Result<Self, Failure> {
        Self::linked(reader, writer, None, world, patience)
    }

    fn linked(
        reader: impl Read + Send + 'static,
        mut writer: impl Write + Send + 'static,
        link: Option<Link>,
        world: &World,
        patience: Patience,
    ) -> Result<Self, Failure> {
        let names = Names::of(world);
        let (heard, from) = sync_channel(WAITING);
        thread::spawn(move || read_lines(BufReader::new(reader), &heard));
        let (to, orders) = channel::<String>();
        thread::spawn(move || {
            // Who cannot be written to is noticed by its silence, or by its end.
            while let Ok(line) = orders.recv() {
                if writer.write_all(line.as_bytes()).and_then(|()| writer.flush()).is_err() {
                    break;
                }
            }
        });
        let domain = names.domain.clone();
        let start = (MapId(0), Pose { at: Point::origin(), heading: Deg::ZERO });
        let mut vehicle = Self {
            names,
            patience,
            to,
            from,
            id: 0,
            called: String::new(),
            is_by_odometry: false,
            at: start,
            time: 0.0,
            failed: None,
            pace: None,
            _link: link,
        };
        let hello = Wish::Hello { protocol: VERSION, domain };
        match vehicle.ask("hello", hello, &mut Watch::none())? {
            Saying::Ready { protocol, name, odometry } if protocol == VERSION => {
                vehicle.called = name;
                vehicle.is_by_odometry = odometry;
            }
            Saying::Ready { protocol, .. } => {
                return Err(Failure::Version { theirs: protocol, ours: VERSION });
            }
            other => return Err(vehicle.unfit("hello", &other)),
        }
        Ok(vehicle)
    }

    /// What the vehicle calls itself.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.called
    }

    /// Gives an order and waits for what it comes to.
    fn ask(
        &mut self,
        asked: &'static str,
        what: Wish,
        watch: &mut Watch<'_>,
    ) -> Result<Saying, Failure> {
        if let Some(failure) = &self.failed {
            return Err(failure.clone());
        }
        let said = self.converse(asked, what, watch);
        if let Err(failure) = &said {
            self.failed = Some(failure.clone());
        }
        said
    }

    fn converse(
        &mut self,
        asked: &'static str,
        what: Wish,
        watch: &mut Watch<'_>,
    ) -> Result<Saying, Failure> {
        self.id += 1;
        let id = self.id;
        self.tell(asked, &Order { id, what })?;
        let late = |limit: Duration| Failure::TimedOut { asked, seconds: limit.as_secs_f64() };
        let begun = Instant::now();
        let (mut last, mut cancelled) = (begun, None);
        loop {
            if cancelled.is_none() && watch.is_stopped() {
                self.id += 1;
                self.tell(asked, &Order { id: self.id, what: Wish::Cancel { order: id } })?;
                cancelled = Some(Instant::now());
            }
            // Who was told to stop has no longer than it may be silent, whatever it says.
            let since = cancelled.unwrap_or(last);
            let (silent, taken) = (since.elapsed(), begun.elapsed());
            if silent >= self.patience.silence {
                return Err(late(self.patience.silence));
            }
            if taken >= self.patience.order {
                return Err(late(self.patience.order));
            }
            let left = (self.patience.silence - silent).min(self.patience.order - taken);
            match self.from.recv_timeout(left.min(GLANCE)) {
                Ok(Heard::Line(line)) => {
                    last = Instant::now();
                    if let Some(said) = self.hear(asked, id, &line, watch)? {
                        return Ok(said);
                    }
                }
                Ok(Heard::TooLong(line)) => {
                    let why = word!("a-line-that-is-too-long");
                    return Err(rubbish(asked, &line, why.into()));
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Err(Failure::Lost { asked }),
            }
        }
    }

    fn tell(&self, asked: &'static str, order: &Order) -> Result<(), Failure> {
        let line = serde_json::to_string(order).expect("an order is made of numbers and names");
        self.to.send(line + "\n").map_err(|_gone| Failure::Lost { asked })
    }

    /// Takes over one line; what ends the order is handed back.
    fn hear(
        &mut self,
        asked: &'static str,
        id: u64,
        line: &[u8],
        watch: &mut Watch<'_>,
    ) -> Result<Option<Saying>, Failure> {
        let wrong = |why: Bilingual| rubbish(asked, line, why);
        let message: Message = serde_json::from_slice(line).map_err(|error| {
            let why = error.to_string();
            wrong(Bilingual::new(why.clone(), why))
        })?;
        let Message { id: of, time, at, what } = message;
        let ends = !matches!(what, Saying::Going | Saying::Saw { .. } | Saying::Scan(_));
        if of > self.id || (of != id && ends) {
            let why = said!("it-answers-order-and-order-was-given", of, id);
            return Err(wrong(why));
        }
        let unknown = |name: Wrong| wrong(said!("the-map-has-no", name));
        if let Saying::Failed { text } = what {
            return Err(Failure::OwnFault { text: shown(text.as_bytes()) });
        }
        if time < self.time {
            return Err(Failure::NoNumber);
        }
        let map = self.names.map(&at.map).map_err(unknown)?;
        let pose = at.pose().ok_or(Failure::NoNumber)?;
        let has_moved = self.time < time || self.at != (map, pose);
        (self.time, self.at) = (time, (map, pose));
        // Every line tells where the vehicle is, and a scan was taken there.
        let is_on_way = matches!(what, Saying::Saw { .. } | Saying::Scan(_));
        if matches!(what, Saying::Going) || (is_on_way && has_moved) {
            watch.notice(&Notice::Moved(Moment { time, map, pose }));
        }
        match what {
            Saying::Going => {}
            Saying::Saw { sighting } => {
                let seen = self.names.sighting(&sighting).map_err(unknown)?;
                watch.notice(&Notice::Saw(seen));
            }
            Saying::Scan(scan) => watch.notice(&Notice::Scanned(scan)),
            other => return Ok(Some(other)),
        }
        Ok(None)
    }

    /// It answered with what is no answer to this.
    fn unfit(&mut self, asked: &'static str, said: &Saying) -> Failure {
        let line = serde_json::to_string(said).unwrap_or_default();
        let why = word!("it-is-no-answer-to-such-an");
        let failure = rubbish(asked, line.as_bytes(), why.into());
        self.failed = Some(failure.clone());
        failure
    }

    /// An order that is carried out, refused or stopped.
    fn act(&mut self, asked: &'static str, wish: Wish, watch: &mut Watch<'_>) -> Done {
        watch.check()?;
        match self.ask(asked, wish, watch).map_err(Unfinished::Failed)? {
            Saying::Done => Ok(()),
            Saying::Stopped => Err(Unfinished::Stopped),
            Saying::Refused { why } => match self.names.refusal(&why) {
                Ok(refusal) => Err(Unfinished::Met(refusal)),
                Err(_unknown) => {
                    Err(Unfinished::Failed(self.unfit(asked, &Saying::Refused { why })))
                }
            },
            other => Err(Unfinished::Failed(self.unfit(asked, &other))),
        }
    }

    fn look(&mut self, asked: &'static str, wish: Wish) -> Result<Option<Sighting>, Failure> {
        match self.ask(asked, wish, &mut Watch::none())? {
            Saying::Seen { sighting: None } => Ok(None),
            Saying::Seen { sighting: Some(sight) } => match self.names.sighting(&sight) {
                Ok(seen) => Ok(Some(seen)),
                Err(_unknown) => Err(self.unfit(asked, &Saying::Seen { sighting: Some(sight) })),
            },
            other => Err(self.unfit(asked, &other)),
        }
    }
}

impl Address {
    /// Speaks with the vehicle that is there, about the things of this world.
    ///
    /// # Errors
    /// Nobody is there, or it does not greet back as it should.
    pub fn connect(&self, world: &World, patience: Patience) -> Result<RemoteVehicle, Failure> {
        let none = |why: &dyn fmt::Display| Failure::NoConnection {
            address: self.to_string(),
            why: why.to_string(),
        };
        match self {
            Self::Program(words) => {
                let mut command = Command::new(&words[0]);
                command.args(&words[1..]).stdin(Stdio::piped()).stdout(Stdio::piped());
                // Ctrl-C is for the mission, which then tells the vehicle to stop.
                #[cfg(unix)]
                std::os::unix::process::CommandExt::process_group(&mut command, 0);
                let mut child = command.spawn().map_err(|error| none(&error))?;
                let reader = child.stdout.take().expect("asked for above");
                let writer: Box<dyn Write + Send> =
                    Box::new(child.stdin.take().expect("asked for above"));
                let link = Some(Link::Program(child));
                RemoteVehicle::linked(reader, writer, link, world, patience)
            }
            Self::Tcp(address) => {
                let mut reason = None;
                for at in address.to_socket_addrs().map_err(|error| none(&error))? {
                    match TcpStream::connect_timeout(&at, patience.silence) {
                        Ok(stream) => {
                            let parts = || Ok((stream.try_clone()?, stream.try_clone()?));
                            let (reader, writer) =
                                parts().map_err(|error: std::io::Error| none(&error))?;
                            // Lines are short, and each is waited for.
                            let _slower = stream.set_nodelay(true);
                            let link = Some(Link::Tcp(stream));
                            return RemoteVehicle::linked(reader, writer, link, world, patience);
                        }
                        Err(error) => reason = Some(error),
                    }
                }
                Err(match reason {
                    Some(error) => none(&error),
                    None => none(&"no address"),
                })
            }
        }
    }
}

impl Vehicle for RemoteVehicle {
    fn pose(&self) -> (MapId, Pose) {
        self.at
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn tells_odometry(&self) -> bool {
        self.is_by_odometry
    }

    fn follow(
        &mut self,
        path: &[Point],
        heading: Option<Deg>,
        watch: &mut Watch<'_>,
    ) -> Result<(), Unfinished<Bump>> {
        const ASKED: &str = "follow";
        watch.check()?;
        let path = path.iter().map(|p| [p.x, p.y]).collect();
        let wish = Wish::Follow { path, heading: heading.map(Deg::get), speed: self.pace };
        match self.ask(ASKED, wish, watch).map_err(Unfinished::Failed)? {
            Saying::Done => Ok(()),
            Saying::Stopped => Err(Unfinished::Stopped),
            Saying::Bumped { against } => {
                let against = self.names.obstruction(&against);
                Err(Unfinished::Met(Bump { at: self.at.1, against }))
            }
            other => Err(Unfinished::Failed(self.unfit(ASKED, &other))),
        }
    }

    fn keep_to(&mut self, pace: Option<f64>) {
        self.pace = pace;
    }

    fn set_door(&mut self, door: DoorId, state: DoorState, watch: &mut Watch<'_>) -> Done {
        let (door, status) = (self.names.door_name(door), state.status.into());
        self.act("set_door", Wish::SetDoor { door, status, opening: state.opening }, watch)
    }

    fn call_lift(&mut self, door: Option<DoorId>, watch: &mut Watch<'_>) -> Done {
        let door = door.map(|id| self.names.door_name(id));
        self.act("call_lift", Wish::CallLift { door }, watch)
    }

    fn ride(
        &mut self,
        ride: &Ride,
        door: Option<DoorId>,
        arrival: (MapId, Pose),
        watch: &mut Watch<'_>,
    ) -> Done {
        let names = &self.names;
        let wish = Wish::Ride {
            lift: names.lift_name(ride.lift),
            from: names.area_name(ride.from),
            to: names.area_name(ride.to),
            rise: ride.rise,
            door: door.map(|id| names.door_name(id)),
            arrival: names.stand(arrival),
        };
        self.act("ride", wish, watch)
    }

    fn set_open(&mut self, thing: ReplicaId, open: bool, watch: &mut Watch<'_>) -> Done {
        let thing = self.names.thing_name(thing);
        self.act("set_open", Wish::SetOpen { thing, open }, watch)
    }

    fn push(
        &mut self,
        thing: ReplicaId,
        area: AreaId,
        frame: Frame,
        watch: &mut Watch<'_>,
    ) -> Done {
        let thing = self.names.thing_name(thing);
        let place = Place::new(&self.names.area_name(area), frame);
        self.act("push", Wish::Push { thing, place }, watch)
    }

    fn take(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        let thing = self.names.thing_name(thing);
        self.act("take", Wish::Take { thing }, watch)
    }

    fn put(&mut self, thing: ReplicaId, area: AreaId, frame: Frame, watch: &mut Watch<'_>) -> Done {
        let thing = self.names.thing_name(thing);
        let place = Place::new(&self.names.area_name(area), frame);
        self.act("put", Wish::Put { thing, place }, watch)
    }

    fn hand_over(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        let thing = self.names.thing_name(thing);
        self.act("hand_over", Wish::HandOver { thing }, watch)
    }

    fn take_back(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        let thing = self.names.thing_name(thing);
        self.act("take_back", Wish::TakeBack { thing }, watch)
    }

    fn switch(&mut self, device: ReplicaId, on: bool, watch: &mut Watch<'_>) -> Done {
        let device = self.names.thing_name(device);
        self.act("switch", Wish::Switch { device, on }, watch)
    }

    fn call(&mut self, person: &str, watch: &mut Watch<'_>) -> Done {
        self.act("call", Wish::Call { person: person.to_owned() }, watch)
    }

    fn look_round(&mut self, watch: &mut Watch<'_>) -> Done {
        self.act("look_round", Wish::LookRound, watch)
    }

    fn sees(&mut self, thing: ReplicaId) -> Result<Option<Sighting>, Failure> {
        let thing = self.names.thing_name(thing);
        self.look("sees", Wish::Sees { thing })
    }

    fn look_at(&mut self, what: Obstruction) -> Result<Option<Sighting>, Failure> {
        let what = self.names.told(what);
        self.look("look_at", Wish::LookAt { what })
    }
}

/// Reads lines until the stream ends or nobody listens.
fn read_lines(mut from: impl BufRead, heard: &SyncSender<Heard>) {
    loop {
        let mut line = Vec::new();
        let limit = LONGEST_LINE as u64 + 1;
        match from.by_ref().take(limit).read_until(b'\n', &mut line) {
            Ok(0) | Err(_) => return,
            Ok(_) => {}
        }
        let is_whole = line.len() <= LONGEST_LINE;
        // What the stream ends within was never said.
        if is_whole && !line.ends_with(b"\n") {
            return;
        }
        if line.iter().all(u8::is_ascii_whitespace) && is_whole {
            continue;
        }
        let told = heard.send(if is_whole { Heard::Line(line) } else { Heard::TooLong(line) });
        if told.is_err() || !is_whole {
            return;
        }
    }
}

fn rubbish(asked: &'static str, line: &[u8], why: Bilingual) -> Failure {
    Failure::Rubbish { asked, said: shown(line), why }
}

/// The beginning of what was said, on one line, without what would move a terminal's cursor.
fn shown(line: &[u8]) -> String {
    let text = String::from_utf8_lossy(line);
    let text = text.trim();
    let clean = |c: char| if c.is_control() { ' ' } else { c };
    let mut shown: String = text.chars().take(SHOWN).map(clean).collect();
    if text.chars().nth(SHOWN).is_some() {
        shown.push('…');
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::shown;

    #[test]
    fn what_was_said_is_shown_on_one_line() {
        assert_eq!(shown(b"{\"a\":\n1}\x1b[2J\n"), "{\"a\": 1} [2J");
        assert_eq!(shown("я".repeat(200).as_bytes()).chars().count(), 121);
    }
}
