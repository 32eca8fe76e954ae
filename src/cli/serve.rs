//! `ortho serve`: the operator's console in the browser; `ortho mcp`: the same house for an assistant.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;

use crate::engine::{Engine, Recording, change_now};
use crate::robot::Address;
use crate::serve::{Bounds, ServeError, Settings, beside, run as serve, run_for_assistant};
use crate::units::told;

use super::args::Common;
use super::demo::Scratch;
use super::fault::Failure;
use super::notes::{note_cut, note_repairs};
use super::opened::{rules_dir, store_dir};
use super::signals::stopped_by_signals;
use super::{Answer, say};

/// What is opened, and how its robot drives.
#[derive(Debug, Args)]
pub(super) struct Opened {
    /// Serve this map file, in a store that lasts as long as the program
    #[arg(long, value_name = "FILE", conflicts_with = "demo")]
    map: Option<PathBuf>,
    /// The papers' flat with the simulated robot, in a store that lasts as long as the program unless --store names one
    #[arg(long)]
    demo: bool,
    /// The simulated robot drives, or a recording is played, so many times as fast as the clock
    #[arg(long, default_value_t = 1.0, value_name = "TIMES", value_parser = super::vehicle::pace)]
    pace: f64,
    /// Record each task that is driven in a file of this folder, as "do --record" does
    #[arg(long, value_name = "DIR")]
    record: Option<PathBuf>,
    /// Drive a robot that speaks the vehicle protocol (docs/vehicle.md) instead of the simulator: cmd:COMMAND or tcp:HOST:PORT
    #[arg(long, value_name = "ADDRESS", value_parser = super::vehicle::address, conflicts_with = "pace")]
    vehicle: Option<Address>,
    /// How long that robot may keep silent while it owes an answer
    #[arg(long, value_name = "SECONDS", value_parser = super::vehicle::seconds, requires = "vehicle")]
    silence: Option<Duration>,
    /// An assistant that cannot ask its user is taken to do so by itself before each call that acts
    #[arg(long)]
    trust_client: bool,
}

#[derive(Debug, Args)]
pub(super) struct McpArgs {
    #[command(flatten)]
    opened: Opened,
}

#[derive(Debug, Args)]
pub(super) struct ServeArgs {
    #[command(flatten)]
    opened: Opened,
    /// Play a recording of "do --record", on the map with which it began
    #[arg(long, value_name = "FILE", conflicts_with_all = ["map", "demo", "vehicle"])]
    replay: Option<PathBuf>,
    /// Port; 0 takes a free one
    #[arg(long, default_value_t = 8430, value_name = "PORT")]
    port: u16,
    /// Be reached from other machines at this address of this one; needs --token
    #[arg(long, value_name = "IP", requires = "token")]
    listen: Option<IpAddr>,
    /// Whoever opens http://HOST:PORT/?token=TOKEN may edit and drive; 16 characters or more
    #[arg(long, env = "ORTHO_TOKEN", hide_env_values = true, value_name = "TOKEN")]
    token: Option<String>,
    /// A further name of this machine by which browsers may call it
    #[arg(long = "host", value_name = "NAME")]
    hosts: Vec<String>,
}

/// The engine, and what both faces need of it. The folder lasts as long as the [`Scratch`].
fn open(
    common: &Common,
    args: &Opened,
    replay: Option<&Path>,
) -> Result<(Engine, Settings, Scratch), Failure> {
    let replay =
        replay.map(|file| Recording::read(file).map(|played| (file, played))).transpose()?;
    if let Some((_, played)) = &replay {
        note_cut(common, played);
    }
    let begins_anew = args.map.is_some() || args.demo;
    // What is played leaves every store as it is.
    let lasts = replay.is_none() && (common.store.is_some() || !begins_anew);
    let scratch = Scratch::new().map_err(|e| Failure::file(&std::env::temp_dir(), &e))?;
    let store = if lasts { store_dir(common) } else { scratch.store.clone() };
    let rules = rules_dir(common);
    let mut engine = match begins_anew || replay.is_some() {
        true => Engine::open(&store, rules.as_deref())?,
        false => Engine::open_existing(&store, rules.as_deref())?,
    };
    note_repairs(&engine, common.lang);
    // What a store that lasts has become is not overwritten by what it once began with.
    if engine.world().is_err() && (begins_anew || replay.is_some()) {
        let map = match (&args.map, &replay) {
            (Some(map), _) => map.clone(),
            (None, Some((file, played))) => scratch.map_of(file, played)?,
            (None, None) => scratch.map()?,
        };
        engine.import(&map, &change_now(&common.user, "serve"))?;
    }
    let settings = Settings {
        listen: SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 0),
        hosts: Vec::new(),
        token: None,
        user: common.user.clone(),
        rules,
        sessions: lasts.then(|| beside(&store, ".sessions")),
        pace: args.pace,
        records: args.record.clone(),
        replay: replay.map(|(_, played)| played),
        vehicle: args
            .vehicle
            .clone()
            .map(|address| (address, super::vehicle::patience(args.silence))),
        is_demo: args.demo,
        bounds: Bounds::default(),
        store: lasts.then_some(store),
        trusts_host: args.trust_client,
    };
    Ok((engine, settings, scratch))
}

pub(super) fn run(common: &Common, args: &ServeArgs) -> Result<Answer, Failure> {
    let (engine, settings, _scratch) = open(common, &args.opened, args.replay.as_deref())?;
    let ip = args.listen.unwrap_or(settings.listen.ip());
    let settings = Settings {
        listen: SocketAddr::new(ip, args.port),
        hosts: args.hosts.clone(),
        token: args.token.clone(),
        ..settings
    };
    let told = |address: &str| {
        let text = told!(common.lang.language(), "open-in-a-browser");
        // Whoever reads no output can still be served.
        let _ = say(&format!("{text} {address}"));
    };
    came_to(serve(engine, &settings, &stopped_by_signals(), told))
}

/// Speaks the Model Context Protocol on the standard streams.
pub(super) fn assist(common: &Common, args: &McpArgs) -> Result<Answer, Failure> {
    let (engine, settings, _scratch) = open(common, &args.opened, None)?;
    came_to(run_for_assistant(engine, &settings, &stopped_by_signals()))
}

fn came_to(served: Result<(), ServeError>) -> Result<Answer, Failure> {
    match served {
        Ok(()) => Ok(Answer::Yes),
        Err(ServeError::Engine(error)) => Err((*error).into()),
        Err(error) => Err(Failure::output(&std::io::Error::other(error.to_string()))),
    }
}
