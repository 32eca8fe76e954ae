//! What follows from each revision of each map, as rows that hold from one revision to another.
//!
//! Workers take a map from `fleet.work`, derive its relations with the rules that robots use, and write what came and what
//! went. Several may work at once, on several machines: a row that one has locked the others pass over, and of one robot
//! only the oldest revision that waits can be taken, so that revisions come one after the other. A worker that dies lets
//! its row go.

use std::collections::BTreeSet;

use deadpool_postgres::{Object, Transaction};

use crate::error::{FleetError, Result};
use crate::facts::Value;
use crate::map::World;
use crate::rows::At;
use crate::semantics::{RelationRules, derive};
use crate::sheets::sheet;
use crate::units::Bilingual;

/// The relation of a thing to its kind and its kind's type.
pub const IS_A: &str = "IS_A";
/// Before the name of a property.
pub const HAS: &str = "HAS:";
/// After so many failures a map is left alone; why stands beside it.
const TRIES: i64 = 3;

/// Relation, subject, object.
pub type Fact = (String, String, String);

/// All that follows from a world, between one or two names; an absent object is empty.
///
/// # Errors
/// [`FleetError::Content`] when the rules cannot be run.
pub fn facts(world: &World, rules: &RelationRules) -> Result<BTreeSet<Fact>> {
    let failed =
        |error: crate::semantics::RelationError| FleetError::content(Bilingual::of(&error));
    let relations = derive(world, rules, world.domain.profile).map_err(failed)?;
    let mut all = BTreeSet::new();
    for count in relations.counts() {
        let name = if count.name_en.is_empty() { &count.name } else { &count.name_en };
        for tuple in relations.tuples(&count.name).map_err(failed)? {
            let told = |value: &Value| match value {
                Value::Symbol(symbol) => symbol.replace('\0', "\u{2400}"),
                other => other.to_string(),
            };
            if let [subject, rest @ ..] = &tuple[..]
                && rest.len() < 2
            {
                let object = rest.first().map(told).unwrap_or_default();
                all.insert((name.clone(), told(subject), object));
            }
        }
    }
    let text = |text: &str| text.replace('\0', "\u{2400}");
    for replica in world.replicas.values() {
        let Some(object) = world.objects.get(&replica.object) else { continue };
        let kind = object.object_type.and_then(|id| world.types.object.entries.get(&id));
        let own = [&object.name, &object.name_en];
        let kinds =
            kind.into_iter().flat_map(|k| [&k.name, &k.name_en].into_iter().chain(&k.synonyms));
        for kind in own.into_iter().chain(kinds).filter(|kind| !kind.is_empty()) {
            all.insert((IS_A.to_owned(), text(&replica.name), text(kind)));
        }
        // What a replica does not have of its own it has of its Object.
        for (name, value) in object.properties.iter().chain(&replica.properties) {
            let is_own = replica.properties.get(name).is_none_or(|own| own == value);
            if is_own {
                all.insert((format!("{HAS}{}", text(name)), text(&replica.name), text(value)));
            }
        }
    }
    Ok(all)
}

/// Derives one map that waits; false when none does.
///
/// # Errors
/// [`FleetError::Database`]. A map that cannot be derived is no error here: why stands in `fleet.work`.
pub async fn work_once(client: &mut Object, rules: &RelationRules) -> Result<bool> {
    let transaction = client.transaction().await?;
    transaction.batch_execute("SET LOCAL ROLE fleet_worker").await?;
    let sql = "SELECT building, robot, revision, anew FROM fleet.work w WHERE tries < $1 AND NOT EXISTS \
               (SELECT FROM fleet.work o WHERE o.building = w.building AND o.robot = w.robot AND o.tries < $1 \
                AND (o.revision, o.anew) < (w.revision, w.anew)) \
               ORDER BY asked LIMIT 1 FOR UPDATE OF w SKIP LOCKED";
    let Some(row) = transaction.query_opt(sql, &[&TRIES]).await? else { return Ok(false) };
    let (building, robot, revision, anew): (i64, i64, i64, bool) =
        (row.get(0), row.get(1), row.get(2), row.get(3));
    let records = sheet(&transaction, building, robot, revision).await?;
    let derived = tokio::task::block_in_place(|| -> Result<BTreeSet<Fact>> {
        records.world()?.map_or_else(|| Ok(BTreeSet::new()), |world| facts(&world, rules))
    });
    match derived {
        Ok(derived) => {
            put_facts(&transaction, building, robot, revision, anew, derived).await?;
            let done = "DELETE FROM fleet.work WHERE building = $1 AND robot = $2 AND revision = $3 AND anew = $4";
            transaction.execute(done, &[&building, &robot, &revision, &anew]).await?;
        }
        Err(error) => {
            let note = "UPDATE fleet.work SET tries = tries + 1, fault = $5 \
                        WHERE building = $1 AND robot = $2 AND revision = $3 AND anew = $4";
            let told = error.to_string().replace('\0', "\u{2400}");
            transaction.execute(note, &[&building, &robot, &revision, &anew, &told]).await?;
        }
    }
    transaction.commit().await?;
    Ok(true)
}

async fn put_facts(
    transaction: &Transaction<'_>,
    building: i64,
    robot: i64,
    revision: i64,
    anew: bool,
    derived: BTreeSet<Fact>,
) -> Result<()> {
    if anew {
        let sql = "DELETE FROM fleet.fact WHERE building = $1 AND robot = $2";
        transaction.execute(sql, &[&building, &robot]).await?;
    }
    let sql = "SELECT relation, subject, object FROM fleet.fact \
               WHERE building = $1 AND robot = $2 AND revision_to IS NULL";
    let rows = transaction.query(sql, &[&building, &robot]).await?;
    let before: BTreeSet<Fact> =
        rows.iter().map(|row| (row.get(0), row.get(1), row.get(2))).collect();
    let sql = "SELECT \"RecDate\" FROM log.\"Revisions\" WHERE building = $1 AND robot = $2 AND \"Revision\" = $3";
    let made = transaction.query_opt(sql, &[&building, &robot, &revision]).await?;
    let at = made.map_or(At(0), |row| row.get(0));
    let columns = |facts: Vec<&Fact>| -> [Vec<String>; 3] {
        [
            facts.iter().map(|f| f.0.clone()).collect(),
            facts.iter().map(|f| f.1.clone()).collect(),
            facts.iter().map(|f| f.2.clone()).collect(),
        ]
    };
    let [r, s, o] = columns(before.difference(&derived).collect());
    if !r.is_empty() {
        let sql = "UPDATE fleet.fact f SET revision_to = $3, until = $4 \
                   FROM unnest($5::text[], $6::text[], $7::text[]) AS u (r, s, o) \
                   WHERE building = $1 AND robot = $2 AND revision_to IS NULL \
                   AND relation = u.r AND subject = u.s AND object = u.o";
        transaction.execute(sql, &[&building, &robot, &revision, &at, &r, &s, &o]).await?;
    }
    let [r, s, o] = columns(derived.difference(&before).collect());
    if !r.is_empty() {
        let sql = "INSERT INTO fleet.fact (building, robot, relation, subject, object, revision, since) \
                   SELECT $1, $2, unnest($5::text[]), unnest($6::text[]), unnest($7::text[]), $3, $4";
        transaction.execute(sql, &[&building, &robot, &revision, &at, &r, &s, &o]).await?;
        let kinds =
            r.iter().zip(&o).filter(|(relation, _)| *relation == IS_A).map(|(_, kind)| kind);
        let kinds: Vec<&String> = kinds.collect::<BTreeSet<_>>().into_iter().collect();
        let sql = "INSERT INTO fleet.kind (building, kind) SELECT $1, u FROM unnest($2::text[]) AS u ON CONFLICT DO NOTHING";
        transaction.execute(sql, &[&building, &kinds]).await?;
    }
    Ok(())
}
