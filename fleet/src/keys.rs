//! Buildings, robots and their keys; a browser's session is a key that ends by itself.

use tokio_postgres::Client;

use crate::error::{FleetError, Result};
use crate::units::said;

/// Notes a building under a number of its own.
///
/// # Errors
/// [`FleetError::Database`]: the number is taken, for one.
pub async fn add_building(client: &Client, building: i64, name: &str) -> Result<()> {
    client.execute("INSERT INTO fleet.building VALUES ($1, $2)", &[&building, &name]).await?;
    let centre = "INSERT INTO fleet.robot (building, robot, name) VALUES ($1, 0, '')";
    client.execute(centre, &[&building]).await?;
    Ok(())
}

/// Notes a robot of a building and returns its key, which is not kept.
///
/// # Errors
/// [`FleetError::Database`]: there is such a robot already, for one.
pub async fn add_robot(client: &Client, building: i64, robot: i64, name: &str) -> Result<String> {
    if robot <= 0 {
        return Err(FleetError::content(said!("robot-numbers-begin-at-one")));
    }
    let add = "INSERT INTO fleet.robot (building, robot, name) VALUES ($1, $2, $3)";
    client.execute(add, &[&building, &robot, &name]).await?;
    add_key(client, "robot", Some(building), Some(robot), name).await
}

/// A key of an operator of one building, or of all, who looks and asks.
///
/// # Errors
/// [`FleetError::Database`].
pub async fn add_operator(client: &Client, building: Option<i64>, name: &str) -> Result<String> {
    add_key(client, "operator", building, None, name).await
}

/// A key of an operator who makes revisions at the centre, too.
///
/// # Errors
/// [`FleetError::Database`].
pub async fn add_editor(client: &Client, building: Option<i64>, name: &str) -> Result<String> {
    let key = add_operator(client, building, name).await?;
    let sql = "UPDATE fleet.key SET edits = true WHERE hash = sha256(convert_to($1, 'UTF8'))";
    client.execute(sql, &[&key]).await?;
    Ok(key)
}

/// A session of an operator's key: a key of its own, of the same name and rights, good for twelve hours.
///
/// # Errors
/// [`FleetError::Key`]: it is no operator's, or a session itself. [`FleetError::Database`].
pub async fn enter(client: &Client, key: &str) -> Result<String> {
    if key.contains('\0') {
        return Err(FleetError::Key);
    }
    let session = secret()?;
    let sql = "INSERT INTO fleet.key (hash, kind, building, name, edits, until) \
               SELECT sha256(convert_to($2, 'UTF8')), kind, building, name, edits, now() + interval '12 hours' FROM fleet.key \
               WHERE hash = sha256(convert_to($1, 'UTF8')) AND kind = 'operator' AND revoked IS NULL AND until IS NULL";
    if client.execute(sql, &[&key, &session]).await? == 0 {
        return Err(FleetError::Key);
    }
    client.execute("DELETE FROM fleet.key WHERE until < now()", &[]).await?;
    Ok(session)
}

/// Ends a session; a key that is none stays.
///
/// # Errors
/// [`FleetError::Database`].
pub async fn leave(client: &Client, session: &str) -> Result<()> {
    let sql =
        "DELETE FROM fleet.key WHERE hash = sha256(convert_to($1, 'UTF8')) AND until IS NOT NULL";
    client.execute(sql, &[&session.replace('\0', "")]).await?;
    Ok(())
}

/// No key of this name serves any more.
///
/// # Errors
/// [`FleetError::Database`]; [`FleetError::Unknown`] when there is none.
pub async fn revoke(client: &Client, name: &str) -> Result<()> {
    let sql = "UPDATE fleet.key SET revoked = now() WHERE name = $1 AND revoked IS NULL";
    match client.execute(sql, &[&name]).await? {
        0 => Err(FleetError::unknown(said!("key-named", name))),
        _ => Ok(()),
    }
}

async fn add_key(
    client: &Client,
    kind: &str,
    building: Option<i64>,
    robot: Option<i64>,
    name: &str,
) -> Result<String> {
    let key = secret()?;
    let sql = "INSERT INTO fleet.key (hash, kind, building, robot, name) \
               VALUES (sha256(convert_to($1, 'UTF8')), $2, $3, $4, $5)";
    client.execute(sql, &[&key, &kind, &building, &robot, &name]).await?;
    Ok(key)
}

/// 256 random bits, in hexadecimal digits.
fn secret() -> Result<String> {
    let mut bytes = [0_u8; 32];
    getrandom::fill(&mut bytes).map_err(|error| {
        FleetError::content(said!("no-random-numbers", why = error.to_string()))
    })?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}
