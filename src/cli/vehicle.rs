//! Vehicles of the command line: the one that carries out a task, and the simulated one that is offered to others.

use std::io::{Read, Write};
use std::net::TcpListener;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use crate::engine::{Engine, Rules, World};
use crate::robot::{
    Address, Moment, Patience, RemoteVehicle, Senses, SensingRobot, Served, Simulator, Vehicle,
    serve, starting_pose,
};
use crate::units::{Language, told};

use super::Answer;
use super::args::Common;
use super::fault::Failure;
use super::notes::{note, warn};
use super::opened::rules_dir;

/// What carries out a task.
#[derive(Debug, Clone, Args)]
pub(super) struct VehicleArgs {
    /// Drive a robot that speaks the vehicle protocol (docs/vehicle.md) instead of the simulator: cmd:COMMAND or tcp:HOST:PORT; "simulator" where the settings name a robot
    #[arg(long, value_name = "ADDRESS", value_parser = wheels, conflicts_with_all = ["truth", "senses"])]
    vehicle: Option<Wheels>,
    /// How long that robot may keep silent while it owes an answer
    #[arg(long, value_name = "SECONDS", value_parser = seconds, requires = "vehicle")]
    silence: Option<Duration>,
    #[command(flatten)]
    senses: SensesArgs,
}

/// What the simulated robot knows its world by.
#[derive(Debug, Clone, Args)]
pub(super) struct SensesArgs {
    /// The simulated robot knows its world by its senses alone: wheels that slip, a laser that errs, a bumper; what is
    /// random is drawn from this number
    #[arg(long, value_name = "SEED")]
    senses: Option<u64>,
    /// So many people walk about
    #[arg(long, value_name = "N", requires = "senses", default_value_t = 0)]
    people: usize,
}

impl SensesArgs {
    fn senses(&self) -> Option<Senses> {
        self.senses.map(|seed| Senses { people: self.people, ..Senses::of_seed(seed) })
    }
}

/// What drives.
#[derive(Debug, Clone)]
pub(super) enum Wheels {
    /// Whatever the settings say.
    Simulator,
    At(Address),
}

pub(super) fn wheels(text: &str) -> Result<Wheels, String> {
    if text == "simulator" {
        return Ok(Wheels::Simulator);
    }
    address(text).map(Wheels::At)
}

pub(super) fn address(text: &str) -> Result<Address, String> {
    text.parse().map_err(|why: crate::units::Bilingual| why.say(Language::English).to_owned())
}

pub(super) fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().filter(|seconds| *seconds > 0.0);
    let duration = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    duration.ok_or_else(|| "a number of seconds is wanted, such as 10 or 0.5".to_owned())
}

impl VehicleArgs {
    /// The robot elsewhere that is to be driven; none, where that is the simulator.
    ///
    /// # Errors
    /// It does not answer, or is another than the map needs.
    pub(super) fn connect(
        &self,
        world: &World,
        truth: Option<&std::path::Path>,
    ) -> Result<Option<RemoteVehicle>, Failure> {
        // A robot of the settings yields to a world that only the simulator can be put into.
        let is_simulated = truth.is_some() || self.senses().is_some();
        let Some(Wheels::At(address)) = self.vehicle.as_ref().filter(|_| !is_simulated) else {
            return Ok(None);
        };
        Ok(Some(address.connect(world, patience(self.silence)).map_err(Box::new)?))
    }

    /// The senses by which alone the simulated robot is to know its world; none, where it is told.
    pub(super) fn senses(&self) -> Option<Senses> {
        self.senses.senses()
    }
}

#[derive(Debug, Args)]
pub(super) struct SimulateArgs {
    /// Map file: the world as it really is
    map: PathBuf,
    /// Wait for missions at this address, HOST:PORT, one after the other; port 0 takes a free one and tells it
    #[arg(long, value_name = "ADDR", required_unless_present = "stdio", conflicts_with = "stdio")]
    listen: Option<String>,
    /// Speak on standard input and output, with one mission
    #[arg(long)]
    stdio: bool,
    /// Run so many times as fast as the clock; at once when left out
    #[arg(long, value_name = "TIMES", value_parser = pace)]
    pace: Option<f64>,
    #[command(flatten)]
    senses: SensesArgs,
}

pub(super) fn pace(text: &str) -> Result<f64, String> {
    let pace = text.parse::<f64>().ok().filter(|pace| (1e-3..=1e6).contains(pace));
    pace.ok_or_else(|| "a number from 0.001 to 1000000 is wanted, such as 1".to_owned())
}

/// What the simulated robot calls itself.
const CALLED: &str = "ortho simulate";

/// How long a robot elsewhere is waited for.
pub(super) fn patience(silence: Option<Duration>) -> Patience {
    let usual = Patience::default();
    Patience { silence: silence.unwrap_or(usual.silence), ..usual }
}

/// The simulated robot at the map's start, for who speaks the protocol; between missions it stays as it was left.
pub(super) fn simulate(common: &Common, args: &SimulateArgs) -> Result<Answer, Failure> {
    let (world, warnings) = Engine::check_map(&args.map, rules_dir(common).as_deref())?;
    warn(&warnings, common.lang);
    let start = starting_pose(&world).ok_or(crate::engine::RequestError::RobotNowhere)?;
    let rules = Rules::read(rules_dir(common).as_deref())?.relations;
    let robot = Simulator::new(world.clone(), start.0, start.1).through_walls(rules.step_reach());
    let mut robot: Box<dyn Vehicle> = match args.senses.senses() {
        Some(senses) => Box::new(SensingRobot::new(robot, senses)),
        None => Box::new(robot),
    };
    let mut talk = |reader: Box<dyn Read + Send>, writer: Box<dyn Write>| {
        let mut told = robot.time();
        let mut wait = |moment: &Moment| {
            if let Some(pace) = args.pace {
                std::thread::sleep(Duration::from_secs_f64((moment.time - told).max(0.0) / pace));
            }
            told = moment.time;
        };
        serve(&mut *robot, CALLED, &world, reader, writer, &mut wait)
    };
    let Some(address) = &args.listen else {
        let served = talk(Box::new(std::io::stdin()), Box::new(std::io::stdout()));
        return Ok(tell(common, &served));
    };
    let fault = |error: &std::io::Error| Failure::file(address.as_ref(), error);
    let listener = TcpListener::bind(address).map_err(|error| fault(&error))?;
    let bound = listener.local_addr().map_err(|error| fault(&error))?;
    note(&format!("{} {bound}", told!(common.lang.language(), "the-robot-waits-at")));
    for stream in listener.incoming() {
        // A mission that went away before it was met is none.
        let Ok(stream) = stream else { continue };
        let Ok(reader) = stream.try_clone() else { continue };
        let _slower = stream.set_nodelay(true);
        let writer = stream.try_clone();
        let Ok(writer) = writer else { continue };
        tell(common, &talk(Box::new(reader), Box::new(writer)));
        let _already_gone = stream.shutdown(std::net::Shutdown::Both);
    }
    Ok(Answer::Yes)
}

fn tell(common: &Common, served: &Served) -> Answer {
    match served {
        Served::Left => Answer::Yes,
        Served::Rubbish(why) => {
            let told = told!(common.lang.language(), "order-not-understood");
            note(&format!("{told}: {why}"));
            Answer::Wrong
        }
    }
}
