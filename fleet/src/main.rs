//! `ortho-fleet`: the centre of many robots, and the robot's line to it.

#![expect(clippy::print_stdout, reason = "a command tells what it did")]

use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::{Parser, Subcommand};
use orthoframe_fleet::pull::Pulled;
use orthoframe_fleet::push::Line;
use orthoframe_fleet::serve::{Tls, serve};
use orthoframe_fleet::{FleetError, Result, db, derive, handout, keys, migrate, revise};
use orthoframe_map::World;
use orthoframe_semantics::RelationRules;
use orthoframe_store::Change;
use orthoframe_units::{Bilingual, Fault as _, Language};

/// Many robots, many buildings: one centre on PostgreSQL.
#[derive(Parser)]
#[command(name = "ortho-fleet", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Args)]
struct Database {
    /// The database: `postgresql://user@host/name`, or `host=… dbname=…`.
    #[arg(long, env = "ORTHO_FLEET_DB", hide_env_values = true)]
    db: String,
    /// The authority that signed the database's certificate (PEM), where it is none of the usual ones.
    #[arg(long, env = "ORTHO_FLEET_DB_AUTHORITY")]
    db_authority: Option<PathBuf>,
}

impl Database {
    fn server(&self) -> Result<db::Server> {
        db::Server::new(&self.db, self.db_authority.as_deref())
    }
}

#[derive(clap::Args)]
struct ToCentre {
    /// The centre's address.
    #[arg(long, env = "ORTHO_FLEET_URL")]
    to: String,
    /// The key of the robot, or of the operator.
    #[arg(long, env = "ORTHO_FLEET_KEY", hide_env_values = true)]
    key: String,
    /// The authority that signed the centre's certificate (PEM), where it is none of the usual ones.
    #[arg(long)]
    authority: Option<PathBuf>,
}

#[derive(clap::Args)]
struct By {
    /// Who makes the revision.
    #[arg(long, default_value = "operator")]
    user: String,
    /// Why.
    #[arg(long, default_value = "")]
    reason: String,
}

impl By {
    fn change(self) -> Change {
        Change::new(self.user, handout::now(), self.reason)
    }
}

#[derive(Subcommand)]
enum Command {
    /// The robot: sends what the centre lacks of its store.
    Push {
        #[command(flatten)]
        centre: ToCentre,
        #[arg(long, env = "ORTHO_STORE", default_value = "ortho-store")]
        store: PathBuf,
        /// Goes on, with so many seconds between; a line that is cut is waited for.
        #[arg(long)]
        every: Option<u64>,
        /// Takes the centre's map each time, too; where `ortho serve` holds the store, through it, when the robot stands.
        #[arg(long)]
        pull: bool,
    },
    /// The robot: takes the centre's map, if its own was not changed meanwhile; else tells what went apart (exit code 1).
    Pull {
        #[command(flatten)]
        centre: ToCentre,
        #[arg(long, env = "ORTHO_STORE", default_value = "ortho-store")]
        store: PathBuf,
    },
    /// The operator: a question in words over all buildings.
    Ask {
        #[command(flatten)]
        centre: ToCentre,
        question: String,
    },
    /// The operator: a question in the rules' language over all buildings: '?- ON_TOP_OF(X, "Стол-1")'.
    Query {
        #[command(flatten)]
        centre: ToCentre,
        question: String,
    },
    #[command(flatten)]
    AtCentre(AtCentre),
}

#[derive(Subcommand)]
enum AtCentre {
    /// Makes or renews the schema.
    Migrate {
        #[command(flatten)]
        database: Database,
        /// For a server that divides tables itself: without partitions.
        #[arg(long)]
        undivided: bool,
    },
    /// Notes a building.
    Building {
        #[command(flatten)]
        database: Database,
        number: i64,
        name: String,
    },
    /// Notes a robot of a building and prints its key, once.
    Robot {
        #[command(flatten)]
        database: Database,
        building: i64,
        number: i64,
        name: String,
    },
    /// Makes a key for an operator, of one building or of all, and prints it, once.
    Key {
        #[command(flatten)]
        database: Database,
        name: String,
        #[arg(long)]
        building: Option<i64>,
        /// May make revisions at the centre from the fleet's page, too.
        #[arg(long)]
        edits: bool,
    },
    /// The keys of this name serve no more.
    Revoke {
        #[command(flatten)]
        database: Database,
        name: String,
    },
    /// Makes the centre's map of a building that of a map file; prints its revision.
    Revise {
        #[command(flatten)]
        database: Database,
        building: i64,
        #[arg(long)]
        map: PathBuf,
        #[command(flatten)]
        by: By,
    },
    /// Makes the centre's map of a building that of one of its robots; prints its revision.
    Adopt {
        #[command(flatten)]
        database: Database,
        building: i64,
        robot: i64,
        #[command(flatten)]
        by: By,
    },
    /// Settles a conflict for the centre's map: the robot takes it, unless it changes its own once more.
    Insist {
        #[command(flatten)]
        database: Database,
        building: i64,
        robot: i64,
    },
    /// A worker: derives what follows from maps that came, until it is stopped; several may work, on several machines.
    Work {
        #[command(flatten)]
        database: Database,
        /// Ends when nothing waits any more.
        #[arg(long)]
        once: bool,
    },
    /// The centre: takes what robots send.
    Serve {
        #[command(flatten)]
        database: Database,
        #[arg(long, default_value = "127.0.0.1:7433")]
        listen: SocketAddr,
        /// Certificate, PEM; needed beyond this machine.
        #[arg(long, requires = "tls_key")]
        cert: Option<PathBuf>,
        /// The certificate's key, PEM.
        #[arg(long, requires = "cert")]
        tls_key: Option<PathBuf>,
        /// What browsers call this server, as `fleet.example`, or `fleet.example:443` where the port is another.
        #[arg(long = "name")]
        names: Vec<String>,
        /// Connections to the database.
        #[arg(long, default_value_t = 16)]
        connections: usize,
    },
}

/// What a command came to: the answer may be "no".
enum Came {
    Through,
    No,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(arguments.command) {
        Ok(Came::Through) => ExitCode::SUCCESS,
        Ok(Came::No) => ExitCode::from(1),
        Err(error) => {
            eprintln!("{}", told(&error));
            ExitCode::from(match error {
                FleetError::Database { .. } | FleetError::Line { .. } | FleetError::Io { .. } => 3,
                _ => 2,
            })
        }
    }
}

fn told(error: &FleetError) -> String {
    let help = error.remedy(language());
    let help = help.map_or_else(String::new, |help| format!("\n  help: {help}"));
    format!("{}{help}", error.tell(language()))
}

fn language() -> Language {
    let is_english = std::env::var("ORTHO_LANG").is_ok_and(|language| language == "en");
    if is_english { Language::English } else { Language::Russian }
}

fn run(command: Command) -> Result<Came> {
    let command = match command {
        Command::Push { centre, store, every, pull } => {
            return push(&line(&centre)?, &store, every, pull);
        }
        Command::Pull { centre, store } => return pull(&line(&centre)?, &store),
        Command::Ask { centre, question } => {
            let answer = line(&centre)?.ask(&question)?;
            println!("{}", answer.text);
            if let Some(rule) = answer.rule {
                println!("\n{rule}");
            }
            return Ok(Came::Through);
        }
        Command::Query { centre, question } => {
            let table = line(&centre)?.query(&question)?;
            println!("{}", table.columns.join("\t"));
            table.rows.iter().for_each(|row| println!("{}", row.join("\t")));
            return Ok(if table.rows.is_empty() { Came::No } else { Came::Through });
        }
        Command::AtCentre(command) => command,
    };
    let runtime = tokio::runtime::Runtime::new()
        .map_err(|source| FleetError::Io { path: "tokio".to_owned(), source })?;
    runtime.block_on(at_the_centre(command))
}

async fn at_the_centre(command: AtCentre) -> Result<Came> {
    match command {
        AtCentre::Migrate { database, undivided } => {
            let mut client = database.server()?.connect().await?;
            for name in migrate::migrate(&mut client, undivided).await? {
                println!("{name}");
            }
        }
        AtCentre::Building { database, number, name } => {
            keys::add_building(&database.server()?.connect().await?, number, &name).await?;
        }
        AtCentre::Robot { database, building, number, name } => {
            let client = database.server()?.connect().await?;
            println!("{}", keys::add_robot(&client, building, number, &name).await?);
        }
        AtCentre::Key { database, name, building, edits } => {
            let client = database.server()?.connect().await?;
            let key = match edits {
                true => keys::add_editor(&client, building, &name).await?,
                false => keys::add_operator(&client, building, &name).await?,
            };
            println!("{key}");
        }
        AtCentre::Revoke { database, name } => {
            keys::revoke(&database.server()?.connect().await?, &name).await?;
        }
        AtCentre::Revise { database, building, map, by } => {
            let world =
                World::load(&map).map_err(|faults| FleetError::content(Bilingual::of(&faults)))?;
            let mut client = database.server()?.pool(1)?.get().await?;
            let transaction = client.transaction().await?;
            let revision =
                revise::revise(&transaction, building, None, &world, &by.change()).await?;
            transaction.commit().await?;
            println!("{revision}");
        }
        AtCentre::Adopt { database, building, robot, by } => {
            let mut client = database.server()?.pool(1)?.get().await?;
            let transaction = client.transaction().await?;
            let revision = revise::adopt(&transaction, building, robot, &by.change()).await?;
            transaction.commit().await?;
            println!("{revision}");
        }
        AtCentre::Insist { database, building, robot } => {
            let mut client = database.server()?.pool(1)?.get().await?;
            let transaction = client.transaction().await?;
            revise::insist(&transaction, building, robot).await?;
            transaction.commit().await?;
        }
        AtCentre::Work { database, once } => {
            let pool = database.server()?.pool(1)?;
            let rules = RelationRules::standard();
            loop {
                match derive::work_once(&mut pool.get().await?, &rules).await {
                    Ok(true) => continue,
                    Ok(false) if once => break,
                    Ok(false) => {}
                    // The server may come back.
                    Err(error @ FleetError::Database { .. }) if !once => {
                        eprintln!("{}", told(&error))
                    }
                    Err(error) => return Err(error),
                }
                tokio::time::sleep(Duration::from_secs(1)).await;
            }
        }
        AtCentre::Serve { database, listen, cert, tls_key, names, connections } => {
            let tls = cert.zip(tls_key).map(|(certificate, key)| Tls { certificate, key });
            let scheme = if tls.is_some() { "https" } else { "http" };
            let pool = database.server()?.pool(connections)?;
            serve(pool, listen, tls, &names, |address| println!("{scheme}://{address}")).await?;
        }
    }
    Ok(Came::Through)
}

fn line(centre: &ToCentre) -> Result<Line> {
    Line::new(&centre.to, &centre.key, centre.authority.as_deref())
}

fn push(line: &Line, store: &Path, every: Option<u64>, pulls: bool) -> Result<Came> {
    loop {
        let done = line.push(store).and_then(|pushed| {
            if !pulls {
                return Ok((pushed, Came::Through));
            }
            match pull(line, store) {
                // The robot works; when it has ended what it does, there will be room.
                Err(held @ FleetError::Held { .. }) => {
                    eprintln!("{}", told(&held));
                    Ok((pushed, Came::Through))
                }
                pulled => Ok((pushed, pulled?)),
            }
        });
        match (&done, every) {
            (Ok((pushed, _)), _) => {
                println!("{}", pushed.in_words(language()));
            }
            // The line will come back; a key will not.
            (Err(error @ FleetError::Line { .. }), Some(_)) => eprintln!("{}", told(error)),
            (Err(_), _) => return done.map(|(_, came)| came),
        }
        let Some(seconds) = every else { return done.map(|(_, came)| came) };
        std::thread::sleep(Duration::from_secs(seconds.max(1)));
    }
}

fn pull(line: &Line, store: &Path) -> Result<Came> {
    let pulled = line.pull(store)?;
    println!("{}", pulled.in_words(language()));
    Ok(if matches!(pulled, Pulled::Apart(_)) { Came::No } else { Came::Through })
}
