//! Connections, and in whose name a transaction works.

use deadpool_postgres::{Manager, ManagerConfig, Pool, RecyclingMethod, Transaction};
use tokio_postgres::{Config, NoTls};

use crate::error::{FleetError, Result};

/// A pool of connections to a database, by an address as `postgresql://user@host/name` or `host=… dbname=…`.
///
/// # Errors
/// [`FleetError::Database`]: the address cannot be read. Connections are made when they are needed.
pub fn pool(address: &str, most: usize) -> Result<Pool> {
    let config: Config = address.parse()?;
    let recycling = ManagerConfig { recycling_method: RecyclingMethod::Fast };
    let manager = Manager::from_config(config, NoTls, recycling);
    let built = Pool::builder(manager).max_size(most).build();
    built.map_err(|error| FleetError::Database { what: error.to_string() })
}

/// One connection of one's own, for migrations and other long work.
///
/// # Errors
/// [`FleetError::Database`].
pub async fn connect(address: &str) -> Result<tokio_postgres::Client> {
    let (client, connection) = tokio_postgres::connect(address, NoTls).await?;
    tokio::spawn(async move {
        if let Err(error) = connection.await {
            tracing::warn!(%error, "the connection to the database ended");
        }
    });
    Ok(client)
}

/// Whose name a key speaks in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Who {
    Robot {
        building: i64,
        robot: i64,
    },
    /// Of one building, or of all.
    Operator {
        building: Option<i64>,
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
    let ask = "SELECT fleet.my_kind(), fleet.my_building(), fleet.my_robot()";
    let row = transaction.query_one(&transaction.prepare_cached(ask).await?, &[]).await?;
    let (kind, building, robot) =
        (row.get::<_, Option<&str>>(0), row.get::<_, Option<i64>>(1), row.get::<_, Option<i64>>(2));
    match (kind, building, robot) {
        (Some("robot"), Some(building), Some(robot)) => {
            transaction.batch_execute("SET LOCAL ROLE fleet_robot").await?;
            Ok(Who::Robot { building, robot })
        }
        (Some("operator"), building, _) => {
            transaction.batch_execute("SET LOCAL ROLE fleet_operator").await?;
            Ok(Who::Operator { building })
        }
        _ => Err(FleetError::Key),
    }
}
