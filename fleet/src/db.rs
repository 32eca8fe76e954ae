//! Connections, and in whose name a transaction works.
//!
//! **Invariant**: beyond this machine a connection to the database is encrypted, with a server whose certificate was
//! checked; or there is none.

use std::net::IpAddr;
use std::path::Path;

use deadpool_postgres::{Manager, ManagerConfig, Pool, RecyclingMethod, Transaction};
use tokio_postgres::Config;
use tokio_postgres::config::{Host, SslMode};

use crate::error::{FleetError, Result};
use crate::tls::Tls;

/// A database server: where it is, and who vouches for it.
#[derive(Clone)]
pub struct Server {
    config: Config,
    tls: Tls,
}

impl Server {
    /// By an address as `postgresql://user@host/name` or `host=… dbname=…`. `authority` is the PEM file of the authority that
    /// signed the server's certificate, where it is none of the usual ones.
    ///
    /// A socket and this machine's own addresses are spoken to plainly, unless the address says `sslmode=require`; all others
    /// with TLS alone.
    ///
    /// # Errors
    /// [`FleetError::Database`]: the address cannot be read. [`FleetError::PlainDatabase`]: it asks for a plain connection
    /// beyond this machine. [`FleetError::Io`], [`FleetError::Content`]: the authority cannot be read.
    pub fn new(address: &str, authority: Option<&Path>) -> Result<Self> {
        let mut config: Config = address.parse()?;
        let far = far_host(&config);
        let mode = match (far, config.get_ssl_mode()) {
            (Some(host), SslMode::Disable) => return Err(FleetError::PlainDatabase { host }),
            (Some(_), _) | (None, SslMode::Require) => SslMode::Require,
            (None, _) => SslMode::Disable,
        };
        config.ssl_mode(mode);
        Ok(Self { config, tls: Tls::new(authority)? })
    }

    /// A pool of connections, made when they are needed.
    ///
    /// # Errors
    /// [`FleetError::Database`].
    pub fn pool(&self, most: usize) -> Result<Pool> {
        let recycling = ManagerConfig { recycling_method: RecyclingMethod::Fast };
        let manager = Manager::from_config(self.config.clone(), self.tls.clone(), recycling);
        let built = Pool::builder(manager).max_size(most).build();
        built.map_err(|error| FleetError::Database { what: error.to_string().into() })
    }

    /// One connection of one's own, for migrations and other long work.
    ///
    /// # Errors
    /// [`FleetError::Database`].
    pub async fn connect(&self) -> Result<tokio_postgres::Client> {
        let (client, connection) = self.config.connect(self.tls.clone()).await?;
        tokio::spawn(async move {
            if let Err(error) = connection.await {
                tracing::warn!(%error, "the connection to the database ended");
            }
        });
        Ok(client)
    }
}

/// The first host that is not this machine. A name is what it says, whatever `hostaddr` stands beside it.
fn far_host(config: &Config) -> Option<String> {
    let is_here = |ip: &IpAddr| ip.is_loopback();
    let by_name = config.get_hosts().iter().find_map(|host| match host {
        Host::Tcp(name) => {
            let ip = name.trim_matches(['[', ']']).parse::<IpAddr>();
            let near = name.eq_ignore_ascii_case("localhost") || ip.is_ok_and(|ip| is_here(&ip));
            (!near).then(|| name.clone())
        }
        Host::Unix(_) => None,
    });
    let by_number = || config.get_hostaddrs().iter().find(|ip| !is_here(ip));
    by_name.or_else(|| by_number().map(IpAddr::to_string))
}

/// See [`Server::pool`].
///
/// # Errors
/// As [`Server::new`].
pub fn pool(address: &str, most: usize) -> Result<Pool> {
    Server::new(address, None)?.pool(most)
}

/// See [`Server::connect`].
///
/// # Errors
/// As [`Server::new`]; [`FleetError::Database`].
pub async fn connect(address: &str) -> Result<tokio_postgres::Client> {
    Server::new(address, None)?.connect().await
}

/// Whose name a key speaks in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Who {
    Robot {
        building: i64,
        robot: i64,
    },
    /// Of one building, or of all; who edits makes revisions at the centre.
    Operator {
        building: Option<i64>,
        edits: bool,
    },
}

/// From here to its end the transaction sees what the key may see, and does what it may do.
///
/// # Errors
/// [`FleetError::Key`], [`FleetError::Database`].
pub async fn enter(transaction: &Transaction<'_>, key: &str) -> Result<Who> {
    // A text with a zero is no key, and no text for the server.
    if key.is_empty() || key.contains('\0') {
        return Err(FleetError::Key);
    }
    let ask = "SELECT set_config('fleet.key', $1, true)";
    transaction.query_one(&transaction.prepare_cached(ask).await?, &[&key]).await?;
    let ask = "SELECT fleet.my_kind(), fleet.my_building(), fleet.my_robot(), fleet.may_edit()";
    let row = transaction.query_one(&transaction.prepare_cached(ask).await?, &[]).await?;
    let (kind, building, robot) =
        (row.get::<_, Option<&str>>(0), row.get::<_, Option<i64>>(1), row.get::<_, Option<i64>>(2));
    match (kind, building, robot) {
        (Some("robot"), Some(building), Some(robot)) => {
            // What a robot asks has one good plan whatever is asked for, and is planned once a connection: rows are sent by
            // the thousand, which planning anew would copy.
            let set = "SET LOCAL ROLE fleet_robot; SET LOCAL plan_cache_mode = force_generic_plan";
            transaction.batch_execute(set).await?;
            Ok(Who::Robot { building, robot })
        }
        (Some("operator"), building, _) => {
            transaction.batch_execute("SET LOCAL ROLE fleet_operator").await?;
            Ok(Who::Operator { building, edits: row.get(3) })
        }
        _ => Err(FleetError::Key),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mode(address: &str) -> Result<SslMode> {
        Ok(Server::new(address, None)?.config.get_ssl_mode())
    }

    #[test]
    fn beyond_this_machine_there_is_tls_or_nothing() {
        for near in [
            "host=/run/postgresql dbname=fleet",
            "host=localhost",
            "host=127.0.0.1 sslmode=disable",
            "postgresql://u@[::1]/fleet",
            "host=/run/postgresql,127.0.0.2",
        ] {
            assert_eq!(mode(near).expect("an address"), SslMode::Disable, "{near}");
        }
        assert_eq!(mode("host=127.0.0.1 sslmode=require").expect("one"), SslMode::Require);
        for far in [
            "host=db.example",
            "host=db.example sslmode=prefer",
            "postgresql://u@192.168.1.5/fleet",
            "host=127.0.0.1.evil.example",
            "host=db.example hostaddr=127.0.0.1",
            "hostaddr=10.0.0.1",
            "host=localhost,db.example",
        ] {
            assert_eq!(mode(far).expect("an address"), SslMode::Require, "{far}");
            let plain = match far.contains("://") {
                true => format!("{far}?sslmode=disable"),
                false => format!("{far} sslmode=disable"),
            };
            let refused = mode(&plain);
            assert!(matches!(refused, Err(FleetError::PlainDatabase { .. })), "{plain}");
        }
    }
}
