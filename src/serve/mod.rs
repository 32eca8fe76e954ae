//! The operator's console: the engine opened to a browser on this machine.
//!
//! [`run`] moves an [`Engine`] to a thread of its own and answers over HTTP: JSON of the library's shapes, events as they
//! happen, and a page that shows them. What may be asked stands in `routes::ROUTES`.
//!
//! # Invariants
//!
//! - Nothing here knows more than the engine tells: no word of a sentence is understood here, no distance measured.
//! - One thread writes (`desk`), one drives (`drive`); whoever asks reads a [`State`](crate::engine::State) that does not change.
//! - Whoever comes passes the `gate` first; the page asks nothing of any other machine.
//! - An edit names the revision that it was made on; where another came first, it is not written and comes back whole.

mod act;
mod assist;
mod book;
mod centre;
mod clearing;
mod desk;
mod drive;
mod events;
mod fault;
mod gate;
mod listen;
mod proposed;
mod queue;
mod read;
mod recorded;
mod replay;
mod routes;

use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use crate::engine::{Engine, Error};
use crate::recording::Played;
use crate::robot::{Address, Patience};
use crate::units::{Language, Stop, told};

pub use assist::run as run_for_assistant;
pub use gate::Role;
pub use listen::Bounds;

use assist::Assistant;
use desk::Desk;
use drive::{Tasks, Wheels};
use events::Events;
use fault::Fault;
use gate::Gate;
use proposed::Proposed;

/// What a server is to be.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Port 0 takes a free one.
    pub listen: SocketAddr,
    /// Further names of this machine, without the port.
    pub hosts: Vec<String>,
    /// A token that lasts, for a server that others reach.
    pub token: Option<String>,
    /// Whose acts they are, of who opens the printed address.
    pub user: String,
    pub rules: Option<PathBuf>,
    /// Where sessions outlive the program.
    pub sessions: Option<PathBuf>,
    /// The time of the simulator, or of what is played, times as fast as the clock.
    pub pace: f64,
    /// A folder in which each task that is driven is recorded.
    pub records: Option<PathBuf>,
    /// Is played before anything else is done.
    pub replay: Option<Played>,
    /// The robot that drives in place of the simulated one.
    pub vehicle: Option<(Address, Patience)>,
    pub is_demo: bool,
    pub bounds: Bounds,
    /// The store's folder, where it outlives the program.
    pub store: Option<PathBuf>,
    /// Programs that call as assistants ask their user by themselves before anything is done.
    pub trusts_host: bool,
}

/// All that answers share.
#[derive(Debug)]
struct House {
    gate: Gate,
    desk: Arc<Desk>,
    events: Arc<Events>,
    tasks: Arc<Tasks>,
    proposed: Proposed,
    rules: Option<PathBuf>,
    is_demo: bool,
}

impl House {
    /// Moves an engine into a house of its own, where nobody is inside yet.
    fn open(engine: Engine, settings: &Settings, at: SocketAddr) -> Result<Arc<Self>, ServeError> {
        let run = gate::random().map_err(|source| ServeError::Listen { at, source })?;
        let events = Arc::new(Events::new(&run[..8]));
        let desk = Desk::open(engine, Arc::clone(&events)).map_err(Box::new)?;
        let desk = Arc::new(desk);
        let wheels = match &settings.vehicle {
            Some((address, patience)) => {
                Wheels::Robot { address: address.clone(), patience: *patience }
            }
            None => Wheels::Simulated { pace: settings.pace },
        };
        let replay = settings.replay.clone().map(|played| (played, settings.pace));
        let records = settings.records.clone();
        let tasks = Tasks::begin(Arc::clone(&desk), Arc::clone(&events), wheels, records, replay);
        let gate = Gate::new(at, &settings.hosts, settings.sessions.clone());
        let (rules, is_demo) = (settings.rules.clone(), settings.is_demo);
        let beside = settings.store.as_deref().map(|store| beside(store, ".proposed"));
        let proposed = Proposed::in_folder(beside);
        Ok(Arc::new(Self { gate, desk, events, tasks, proposed, rules, is_demo }))
    }
}

/// Why nothing is served.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ServeError {
    #[error(transparent)]
    Engine(#[from] Box<Error>),
    #[error("{at}: {source}")]
    Listen { at: SocketAddr, source: std::io::Error },
    /// Whoever is on the net could drive the robot.
    #[error("{}", told!(Language::Russian, "seen-on-the-net", at = at.to_string()))]
    Open { at: SocketAddr },
}

/// The shortest token that lasts.
const SHORTEST: usize = 16;

/// `ortho-store` → `ortho-store.sessions`: beside the store, which is its own folder's master.
#[must_use]
pub fn beside(store: &Path, ending: &str) -> PathBuf {
    let mut name = store.as_os_str().to_owned();
    name.push(ending);
    PathBuf::from(name)
}

/// Serves until it is told to stop; `tell` gets the address to be opened.
///
/// # Errors
/// The address cannot be taken, or what follows from the map cannot be derived.
pub fn run(
    engine: Engine,
    settings: &Settings,
    stop: &Stop,
    tell: impl FnOnce(&str),
) -> Result<(), ServeError> {
    let at = settings.listen;
    let failed = |source| ServeError::Listen { at, source };
    let lasting = settings.token.as_deref().filter(|token| token.len() >= SHORTEST);
    if !at.ip().is_loopback() && lasting.is_none() {
        return Err(ServeError::Open { at });
    }
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    let runtime = runtime.map_err(failed)?;
    let bound = runtime.block_on(async {
        let listener = tokio::net::TcpListener::bind(at).await?;
        listener.local_addr().map(|at| (listener, at))
    });
    let (listener, at) = bound.map_err(failed)?;
    let house = House::open(engine, settings, at)?;
    let tasks = Arc::clone(&house.tasks);
    let served = runtime.block_on(async {
        if let Some(token) = lasting {
            house.gate.trust(token, Role::Edit, &settings.user);
        }
        let store = settings.store.as_deref();
        let _note = store.and_then(|s| centre::Note::leave(s, at, &house.gate, &settings.user));
        let token = house.gate.invite(Role::Edit, &settings.user).map_err(failed)?;
        tell(&format!("http://{at}/?token={token}"));
        let assistant =
            Assistant::new(Arc::clone(&house), settings.store.as_deref(), settings.trusts_host);
        let app = routes::router(&house, &assistant);
        tokio::select! {
            never = listen::serve(listener, app, settings.bounds) => match never {},
            () = raised(stop) => Ok(()),
        }
    });
    tasks.close();
    runtime.shutdown_timeout(Duration::from_secs(1));
    served
}

async fn raised(stop: &Stop) {
    while !stop.is_raised() {
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
}

/// Does what takes time, apart from the thread that answers.
async fn apart<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, Error> + Send + 'static,
) -> Result<T, Fault> {
    match tokio::task::spawn_blocking(work).await {
        Ok(done) => Ok(done?),
        Err(_) => Err(desk::Gone.into()),
    }
}

/// The same for what is only asked: it ends when nobody waits for the answer any more, since the client has left or taken
/// the call back.
async fn asked<T: Send + 'static>(
    work: impl FnOnce(&Stop) -> Result<T, Error> + Send + 'static,
) -> Result<T, Fault> {
    struct Awaited(Stop);
    impl Drop for Awaited {
        fn drop(&mut self) {
            self.0.raise();
        }
    }
    let stop = Stop::new();
    let _awaited = Awaited(stop.clone());
    apart(move || work(&stop)).await
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;

    use super::*;
    use crate::engine::Dialogue;
    use crate::units::Language;

    #[test]
    fn what_nobody_waits_for_any_more_ends() {
        let (began, has_begun) = tokio::sync::oneshot::channel();
        let (ended, has_ended) = mpsc::channel();
        let asked = asked(move |stop| {
            let _ = began.send(());
            while !stop.is_raised() {
                std::thread::yield_now();
            }
            let _ = ended.send(());
            Ok(())
        });
        let runtime = tokio::runtime::Builder::new_current_thread().build().expect("a runtime");
        runtime.block_on(async {
            tokio::select! {
                _ = asked => unreachable!("it goes on until it is left"),
                begun = has_begun => begun.expect("it begins"),
            }
        });
        // Without an end this would wait for ever.
        has_ended.recv().expect("it ends");
    }

    /// As many orders, one behind the other, as one line may hold.
    fn long_day() -> String {
        let places = ["Стол-1", "Обеденный стол"].into_iter().cycle().take(6);
        let orders = places.map(|place| format!("отнеси все книги на {place}"));
        orders.collect::<Vec<_>>().join(", потом ")
    }

    /// A client that leaves at any moment of what would take long: how much was planned tells that it ended, not when.
    #[test]
    fn a_plan_that_nobody_waits_for_any_more_is_not_planned_to_its_end() {
        let world = crate::map::World::load("maps/rb2.toml").expect("a map");
        let engine = Engine::in_memory(world, None).expect("an engine");
        let state = engine.state().expect("a state");
        let planned = |text: &str| {
            let heard = state.rehearse(&Dialogue::new(Language::Russian), text).expect("a map");
            heard.plan.expect("a plan")["events"].clone()
        };
        let short = planned("Поезжай к Точке-К");
        let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build();
        let runtime = runtime.expect("a runtime");
        for moment in [0, 1, 3, 10, 30, 80] {
            let (ended, has_ended) = mpsc::channel();
            let state = Arc::clone(&state);
            let plan = asked(move |stop| {
                let state = Arc::new(state.heeding(stop));
                let heard = state.rehearse(&Dialogue::new(Language::Russian), &long_day())?;
                let _ = ended.send(heard);
                Ok(())
            });
            let left = runtime.block_on(async {
                tokio::time::timeout(Duration::from_millis(moment), plan).await
            });
            assert!(left.is_err(), "it is planned within {moment} ms");
            let heard = has_ended.recv().expect("it ends");
            let outcome = match &heard.plan {
                Some(plan) => &plan["outcome"],
                None => &heard.replies.last().expect("a reply")["outcome"],
            };
            assert_eq!(outcome, "stopped", "left after {moment} ms");
            assert_eq!(planned("Поезжай к Точке-К"), short);
        }
    }
}
