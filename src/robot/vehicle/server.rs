//! A vehicle of this process offered to others by the protocol: our simulator, or a driver of a real one.

use std::io::{BufRead, BufReader, Read, Write};
use std::ops::ControlFlow;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread;

use crate::geometry::Ride;
use crate::map::World;
use crate::units::{Deg, Point, Stop};

use super::names::{Names, Wrong};
use super::protocol::{LONGEST_LINE, Message, Order, Saying, VERSION, Wish, door_state, point};
use super::{Failure, Moment, Notice, Unfinished, Vehicle, Watch};

/// How a conversation ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Served {
    /// The other side went away.
    Left,
    /// It wrote what the protocol does not know, and was told so.
    Rubbish(String),
}

/// An order as it was read, with what stops it.
type Given = Result<(Order, Stop), String>;

/// Orders that may wait.
const WAITING: usize = 16;

/// Offers a vehicle, in a world whose names both sides know, to one who speaks the protocol, until he goes away. `between`
/// is called on the way, with each moment that is told: a simulator that is to run at the pace of the clock sleeps there.
///
/// An order is carried out while the next line is read, so that it can be cancelled.
pub fn serve(
    vehicle: &mut dyn Vehicle,
    called: &str,
    world: &World,
    reader: impl Read + Send + 'static,
    mut writer: impl Write,
    between: &mut dyn FnMut(&Moment),
) -> Served {
    let names = Names::of(world);
    let (give, given) = sync_channel::<Given>(WAITING);
    thread::spawn(move || read_orders(BufReader::new(reader), &give));
    while let Ok(order) = given.recv() {
        let (order, stop) = match order {
            Ok(order) => order,
            Err(why) => {
                let failed = Saying::Failed { text: format!("not understood: {why}") };
                let _gone = say(&mut writer, &names, vehicle, 0, failed);
                return Served::Rubbish(why);
            }
        };
        let id = order.id;
        let mut desk = Desk { names: &names, id, writer: &mut writer, between };
        let said = desk.carry_out(vehicle, called, order.what, &stop);
        let said = said.unwrap_or_else(|name| Saying::Failed {
            text: format!("the map here has nothing such as \"{name}\""),
        });
        if say(&mut writer, &names, vehicle, id, said).is_err() {
            return Served::Left;
        }
    }
    Served::Left
}

fn say(
    writer: &mut impl Write,
    names: &Names,
    vehicle: &dyn Vehicle,
    id: u64,
    what: Saying,
) -> std::io::Result<()> {
    let at = names.stand(vehicle.pose());
    write(writer, &Message { id, time: vehicle.time(), at, what })
}

fn write(writer: &mut impl Write, message: &Message) -> std::io::Result<()> {
    let line = serde_json::to_string(message).map_err(std::io::Error::from)?;
    writer.write_all((line + "\n").as_bytes())?;
    writer.flush()
}

/// Where one order is carried out.
struct Desk<'d, W> {
    names: &'d Names,
    id: u64,
    writer: &'d mut W,
    between: &'d mut dyn FnMut(&Moment),
}

impl<W: Write> Desk<'_, W> {
    fn carry_out(
        &mut self,
        vehicle: &mut dyn Vehicle,
        called: &str,
        wish: Wish,
        stop: &Stop,
    ) -> Result<Saying, Wrong> {
        let names = self.names;
        let mut last = (vehicle.time(), vehicle.pose());
        let mut tell = |notice: &Notice| {
            let what = match notice {
                Notice::Moved(moment) => {
                    last = (moment.time, (moment.map, moment.pose));
                    (self.between)(moment);
                    Saying::Going
                }
                Notice::Saw(seen) => Saying::Saw { sighting: names.sight(*seen) },
                Notice::Scanned(scan) => Saying::Scan(scan.clone()),
                Notice::Found(moment) => {
                    last = (moment.time, (moment.map, moment.pose));
                    Saying::Going
                }
            };
            let message = Message { id: self.id, time: last.0, at: names.stand(last.1), what };
            match write(self.writer, &message) {
                Ok(()) => ControlFlow::Continue(()),
                // Nobody listens any more: the vehicle is not to drive on alone.
                Err(_gone) => ControlFlow::Break(()),
            }
        };
        let watch = &mut Watch::new(stop.clone(), &mut tell);
        let done = match wish {
            Wish::Hello { .. } => {
                return Ok(Saying::Ready {
                    protocol: VERSION,
                    name: called.to_owned(),
                    odometry: vehicle.tells_odometry(),
                });
            }
            Wish::Report => Ok(()),
            // The order that it speaks of was stopped when this line was read.
            Wish::Cancel { .. } => return Err("cancel".to_owned()),
            Wish::Follow { path, heading, speed } => {
                if speed.is_some_and(|speed| !(speed.is_finite() && speed > 0.0)) {
                    return Err("speed".to_owned());
                }
                vehicle.keep_to(speed);
                let path: Option<Vec<Point>> = path.into_iter().map(point).collect();
                let path = path.ok_or_else(|| "path".to_owned())?;
                let driven = vehicle.follow(&path, heading.map(Deg::of), watch);
                return Ok(match driven {
                    Ok(()) => Saying::Done,
                    Err(Unfinished::Met(bump)) => {
                        Saying::Bumped { against: names.told(bump.against) }
                    }
                    Err(Unfinished::Stopped) => Saying::Stopped,
                    Err(Unfinished::Failed(failure)) => failed(&failure),
                });
            }
            Wish::SetDoor { door, status, opening } => {
                let state =
                    door_state(status, opening).ok_or_else(|| format!("opening = {opening}"))?;
                vehicle.set_door(names.door(&door)?, state, watch)
            }
            Wish::CallLift { door } => {
                let door = door.map(|door| names.door(&door)).transpose()?;
                vehicle.call_lift(door, watch)
            }
            Wish::Ride { lift, from, to, rise, door, arrival } => {
                let (from, to) = (names.area(&from)?, names.area(&to)?);
                let ride = Ride { lift: names.lift(&lift)?, from, to, rise };
                let door = door.map(|door| names.door(&door)).transpose()?;
                let pose = arrival.pose().ok_or_else(|| "arrival".to_owned())?;
                let arrival = (names.map(&arrival.map)?, pose);
                vehicle.ride(&ride, door, arrival, watch)
            }
            Wish::SetOpen { thing, open } => vehicle.set_open(names.thing(&thing)?, open, watch),
            Wish::Push { thing, place } => {
                let frame = place.frame().ok_or_else(|| format!("{place:?}"))?;
                vehicle.push(names.thing(&thing)?, names.area(&place.area)?, frame, watch)
            }
            Wish::Take { thing } => vehicle.take(names.thing(&thing)?, watch),
            Wish::Put { thing, place } => {
                let frame = place.frame().ok_or_else(|| format!("{place:?}"))?;
                vehicle.put(names.thing(&thing)?, names.area(&place.area)?, frame, watch)
            }
            Wish::HandOver { thing } => vehicle.hand_over(names.thing(&thing)?, watch),
            Wish::TakeBack { thing } => vehicle.take_back(names.thing(&thing)?, watch),
            Wish::Switch { device, on } => vehicle.switch(names.thing(&device)?, on, watch),
            Wish::Call { person } => vehicle.call(&person, watch),
            Wish::LookRound => vehicle.look_round(watch),
            // What is not in this world is not seen in it.
            Wish::Sees { thing } => {
                let seen = names.thing(&thing).map_or(Ok(None), |thing| vehicle.sees(thing));
                return Ok(seen_or_failed(names, seen));
            }
            Wish::LookAt { what } => {
                return Ok(seen_or_failed(names, vehicle.look_at(names.obstruction(&what))));
            }
        };
        Ok(match done {
            Ok(()) => Saying::Done,
            Err(Unfinished::Met(refusal)) => Saying::Refused { why: names.no(refusal) },
            Err(Unfinished::Stopped) => Saying::Stopped,
            Err(Unfinished::Failed(failure)) => failed(&failure),
        })
    }
}

fn seen_or_failed(names: &Names, seen: Result<Option<super::Sighting>, Failure>) -> Saying {
    match seen {
        Ok(seen) => Saying::Seen { sighting: seen.map(|seen| names.sight(seen)) },
        Err(failure) => failed(&failure),
    }
}

fn failed(failure: &Failure) -> Saying {
    Saying::Failed { text: failure.say(crate::units::Language::English) }
}

/// Reads orders until the stream ends. A `cancel` stops the order that it names, which may be under way or wait still;
/// when the stream ends, what is under way is stopped too.
fn read_orders(mut from: impl BufRead, give: &SyncSender<Given>) {
    let mut last: Option<(u64, Stop)> = None;
    loop {
        let mut line = Vec::new();
        let limit = LONGEST_LINE as u64 + 1;
        match from.by_ref().take(limit).read_until(b'\n', &mut line) {
            Ok(0) | Err(_) => break,
            Ok(_) if line.len() > LONGEST_LINE => {
                let _gone = give.send(Err("a line that is too long".to_owned()));
                break;
            }
            Ok(_) if line.iter().all(u8::is_ascii_whitespace) => continue,
            Ok(_) => {}
        }
        let order: Order = match serde_json::from_slice(&line) {
            Ok(order) => order,
            Err(error) => {
                let _gone = give.send(Err(error.to_string()));
                break;
            }
        };
        if let Wish::Cancel { order } = order.what {
            if let Some((id, stop)) = &last
                && *id == order
            {
                stop.raise();
            }
            continue;
        }
        let stop = Stop::new();
        last = Some((order.id, stop.clone()));
        if give.send(Ok((order, stop))).is_err() {
            return;
        }
    }
    if let Some((_, stop)) = last {
        stop.raise();
    }
}
