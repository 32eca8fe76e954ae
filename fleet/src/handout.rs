//! The centre's own map of a building, and how it goes to the building's robots.
//!
//! The map of robot 0 is the one that is handed out; it grows by revisions (see [`revise`](crate::revise)), as a robot's does. What both sides last agreed
//! on is noted as a pair of revisions: the centre's, and the robot's own in which it stood there then. A robot that has
//! changed its map since keeps it, the centre keeps its own, and what either changed is noted thing by thing (see
//! [`pull`](crate::pull)). A person settles it by making a revision of one of the two.
//!
//! **Invariant**: no record is made that neither side wrote.

use std::collections::BTreeSet;

use deadpool_postgres::Object;
use serde::{Deserialize, Serialize};

use crate::db::{Who, enter};
use crate::error::{FleetError, Result};
use crate::sheets::{revision, sheet};
use crate::store::Sheet;
use crate::store::shipping::pack_rows;
use crate::units::{Timestamp, said};

/// What a robot hears of the centre's map.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Handout {
    /// The centre's revision; 0 where it has no map of the building.
    pub centre: i64,
    /// The pair of revisions that were last the same.
    pub agreed_centre: i64,
    pub agreed_robot: i64,
    pub author: String,
    pub reason: String,
    /// Milliseconds since 1970.
    pub at: i64,
}

/// One thing that both sides may have changed, each change in words; an empty one is none.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Apart {
    pub thing: String,
    pub centre: String,
    pub robot: String,
}

/// Two maps that went apart.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Conflict {
    pub centre: i64,
    pub robot: i64,
    pub things: Vec<Apart>,
}

/// The centre's map for the robot of a key, with the packed rows; none where it has that revision already.
///
/// # Errors
/// [`FleetError::Key`], [`FleetError::Forbidden`], [`FleetError::Database`].
pub async fn handout(client: &mut Object, key: &str) -> Result<(Handout, Option<Vec<u8>>)> {
    let transaction = client.transaction().await?;
    let Who::Robot { building, robot } = enter(&transaction, key).await? else {
        return Err(FleetError::Forbidden);
    };
    let centre = revision(&transaction, building, 0).await?;
    let sql =
        "SELECT agreed_centre, agreed_robot FROM fleet.robot WHERE building = $1 AND robot = $2";
    let row = transaction.query_one(sql, &[&building, &robot]).await?;
    let sql = "SELECT \"RecUser\", \"Reason\", \"RecDate\" FROM log.\"Revisions\" \
               WHERE building = $1 AND robot = 0 AND \"Revision\" = $2";
    let made = transaction.query_opt(sql, &[&building, &centre]).await?;
    let (author, reason, at) = made.map_or_else(Default::default, |row| {
        (row.get(0), row.get(1), row.get::<_, crate::rows::At>(2).0)
    });
    let told =
        Handout { centre, agreed_centre: row.get(0), agreed_robot: row.get(1), author, reason, at };
    if centre == 0 || told.agreed_centre == centre {
        return Ok((told, None));
    }
    let map = sheet(&transaction, building, 0, centre).await?;
    transaction.commit().await?;
    Ok((told, Some(pack_rows(map.iter().map(|(table, _, row)| (table, row))))))
}

/// Notes that a robot's revision is the centre's.
///
/// # Errors
/// As [`handout`].
pub async fn agree(client: &mut Object, key: &str, centre: i64, robots: i64) -> Result<()> {
    let transaction = client.transaction().await?;
    let Who::Robot { building, robot } = enter(&transaction, key).await? else {
        return Err(FleetError::Forbidden);
    };
    let sql = "UPDATE fleet.robot SET agreed_centre = $3, agreed_robot = $4 WHERE building = $1 AND robot = $2";
    transaction.execute(sql, &[&building, &robot, &centre, &robots]).await?;
    let sql = "UPDATE fleet.conflict SET settled = now() WHERE building = $1 AND robot = $2 AND settled IS NULL";
    transaction.execute(sql, &[&building, &robot]).await?;
    transaction.commit().await?;
    Ok(())
}

/// Notes what went apart; what was noted of an older pair of revisions and is not settled gives way to it.
///
/// # Errors
/// As [`handout`].
pub async fn note_conflict(client: &mut Object, key: &str, conflict: &Conflict) -> Result<()> {
    let transaction = client.transaction().await?;
    let Who::Robot { building, robot } = enter(&transaction, key).await? else {
        return Err(FleetError::Forbidden);
    };
    let sql = "DELETE FROM fleet.conflict WHERE building = $1 AND robot = $2 AND settled IS NULL";
    transaction.execute(sql, &[&building, &robot]).await?;
    let sql = "INSERT INTO fleet.conflict (building, robot, centre_revision, robot_revision, thing, centre, robots) \
               SELECT $1, $2, $3, $4, u.* FROM unnest($5::text[], $6::text[], $7::text[]) AS u \
               ON CONFLICT DO NOTHING";
    let column = |told: fn(&Apart) -> &str| -> Vec<String> {
        conflict.things.iter().map(|apart| told(apart).replace('\0', "\u{2400}")).collect()
    };
    let (things, centre, robots) =
        (column(|a| &a.thing), column(|a| &a.centre), column(|a| &a.robot));
    transaction
        .execute(
            sql,
            &[&building, &robot, &conflict.centre, &conflict.robot, &things, &centre, &robots],
        )
        .await?;
    transaction.commit().await?;
    Ok(())
}

/// What either side changed since both were the same, thing by thing; without such a map, in what the two differ.
///
/// # Errors
/// [`FleetError::Store`].
pub fn apart(base: Option<&Sheet>, robots: &Sheet, centres: &Sheet) -> Result<Vec<Apart>> {
    use crate::store::Changes;
    use crate::units::Language::Russian;
    let (Some(mine), Some(theirs)) = (robots.world()?, centres.world()?) else {
        return Err(FleetError::content(said!("map-has-no-domain")));
    };
    let base = base.map(Sheet::world).transpose()?.flatten();
    let from = base.as_ref().unwrap_or(&mine);
    let by_robot = if base.is_some() { Changes::between(from, &mine)?.told() } else { Vec::new() };
    let by_centre = Changes::between(from, &theirs)?.told();
    let subjects: BTreeSet<&str> =
        by_robot.iter().chain(&by_centre).map(|d| d.subject.say(Russian)).collect();
    let told = |differences: &[crate::store::Difference], subject: &str| {
        let of = differences.iter().filter(|d| d.subject.say(Russian) == subject);
        of.map(|d| d.say(Russian)).collect::<Vec<_>>().join("; ")
    };
    Ok(subjects
        .into_iter()
        .map(|subject| Apart {
            thing: subject.to_owned(),
            centre: told(&by_centre, subject),
            robot: told(&by_robot, subject),
        })
        .collect())
}

/// The moment it is now.
#[must_use]
pub fn now() -> Timestamp {
    Timestamp::from(std::time::SystemTime::now())
}
