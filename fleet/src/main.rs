//! `ortho-fleet`: the centre of many robots, and the robot's line to it.

#![expect(clippy::print_stdout, reason = "a command tells what it did")]

use std::net::SocketAddr;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::{Parser, Subcommand};
use orthoframe_fleet::push::Line;
use orthoframe_fleet::serve::{Tls, serve};
use orthoframe_fleet::{FleetError, Result, db, keys, migrate};

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
}

#[derive(clap::Args)]
struct ToCentre {
    /// The centre's address.
    #[arg(long, env = "ORTHO_FLEET_URL")]
    to: String,
    /// The robot's key.
    #[arg(long, env = "ORTHO_FLEET_KEY", hide_env_values = true)]
    key: String,
    /// The authority that signed the centre's certificate (PEM), where it is none of the usual ones.
    #[arg(long)]
    authority: Option<PathBuf>,
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
    },
    /// The keys of this name serve no more.
    Revoke {
        #[command(flatten)]
        database: Database,
        name: String,
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
        /// Connections to the database.
        #[arg(long, default_value_t = 16)]
        connections: usize,
    },
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(arguments.command) {
        Ok(()) => ExitCode::SUCCESS,
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
    use miette::Diagnostic;
    use orthoframe_units::InEnglish;
    if std::env::var("ORTHO_LANG").is_ok_and(|language| language == "en") {
        let help =
            error.english_help().map_or_else(String::new, |help| format!("\n  help: {help}"));
        format!("{}{help}", error.english())
    } else {
        let help = error.help().map_or_else(String::new, |help| format!("\n  help: {help}"));
        format!("{error}{help}")
    }
}

fn run(command: Command) -> Result<()> {
    let command = match command {
        Command::Push { centre, store, every } => return push(&centre, &store, every),
        Command::AtCentre(command) => command,
    };
    let runtime = tokio::runtime::Runtime::new()
        .map_err(|source| FleetError::Io { path: "tokio".to_owned(), source })?;
    runtime.block_on(at_the_centre(command))
}

async fn at_the_centre(command: AtCentre) -> Result<()> {
    match command {
        AtCentre::Migrate { database, undivided } => {
            let mut client = db::connect(&database.db).await?;
            for name in migrate::migrate(&mut client, undivided).await? {
                println!("{name}");
            }
        }
        AtCentre::Building { database, number, name } => {
            keys::add_building(&db::connect(&database.db).await?, number, &name).await?;
        }
        AtCentre::Robot { database, building, number, name } => {
            let client = db::connect(&database.db).await?;
            println!("{}", keys::add_robot(&client, building, number, &name).await?);
        }
        AtCentre::Key { database, name, building } => {
            let client = db::connect(&database.db).await?;
            println!("{}", keys::add_operator(&client, building, &name).await?);
        }
        AtCentre::Revoke { database, name } => {
            keys::revoke(&db::connect(&database.db).await?, &name).await?;
        }
        AtCentre::Serve { database, listen, cert, tls_key, connections } => {
            let tls = cert.zip(tls_key).map(|(certificate, key)| Tls { certificate, key });
            let scheme = if tls.is_some() { "https" } else { "http" };
            let pool = db::pool(&database.db, connections)?;
            serve(pool, listen, tls, |address| println!("{scheme}://{address}")).await?;
        }
    }
    Ok(())
}

fn push(centre: &ToCentre, store: &std::path::Path, every: Option<u64>) -> Result<()> {
    let line = Line::new(&centre.to, &centre.key, centre.authority.as_deref())?;
    loop {
        let done = line.push(store);
        match (&done, every) {
            (Ok(pushed), _) => {
                let whole = if pushed.whole { ", хранилище целиком" } else { "" };
                println!(
                    "Кадров отправлено: {}{whole}; в центре – до {}.",
                    pushed.frames, pushed.sequence
                );
            }
            // The line will come back; a key will not.
            (Err(error @ FleetError::Line { .. }), Some(_)) => eprintln!("{}", told(error)),
            (Err(_), _) => return done.map(|_| ()),
        }
        let Some(seconds) = every else { return Ok(()) };
        std::thread::sleep(Duration::from_secs(seconds.max(1)));
    }
}
