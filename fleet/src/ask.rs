//! Questions in words over all buildings, in Russian and English.
//!
//! A question is one of a few forms; every word of it has its place in the form, or it is not understood. What is asked of
//! things becomes a question in the rules' language (see [`query`](crate::query)), and the rule that is shown is the rule
//! that ran. A kind of thing is known in every form of its name, from the maps' own lists of types.

use std::collections::BTreeMap;

use deadpool_postgres::Transaction;
use tokio_postgres::types::ToSql;

use crate::error::{FleetError, Result};
use crate::language::{NounPhrase, WordHints, english};
use crate::query::{Question, Table};
use crate::units::{Language, name_key, told};

/// What a question came to.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Answer {
    /// In the language of the question.
    pub text: String,
    /// The rule that ran; none where the tables were asked directly.
    pub rule: Option<String>,
    pub table: Table,
}

/// The forms of questions, by what they begin with; the rest of some names something.
const WHERE_ARE: &[&str] = &[
    "в каких корпусах есть",
    "в каких зданиях есть",
    "в каких домах есть",
    "в каком корпусе есть",
    "в каком здании есть",
    "в каких корпусах стоят",
    "в каких зданиях стоят",
    "где есть",
    "in which buildings are there",
    "in which building is there",
    "which buildings have",
    "where are there",
];
const WHO_SAW: &[&str] = &[
    "какой робот последним видел",
    "кто последним видел",
    "кто последний видел",
    "which robot last saw",
    "who last saw",
];
const WHAT_CHANGED: &[(&str, i64)] = &[
    ("что изменилось за неделю", 7),
    ("что изменилось на этой неделе", 7),
    ("что изменилось за сутки", 1),
    ("что изменилось за день", 1),
    ("что изменилось за месяц", 30),
    ("what changed this week", 7),
    ("what has changed this week", 7),
    ("what changed today", 1),
    ("what changed this month", 30),
];
const WHERE_APART: &[&str] = &[
    "где карты и представления расходятся больше всего",
    "где карты и представления расходятся сильнее всего",
    "где карты расходятся с увиденным",
    "where do maps and beliefs disagree most",
];
/// What is said of a thing on which and in which nothing is.
const FREE: &[&str] = &[
    "свободные",
    "свободный",
    "свободная",
    "свободное",
    "свободных",
    "пустые",
    "пустой",
    "пустая",
    "пустое",
    "free",
    "empty",
    "a free",
    "an empty",
    "any free",
];

/// Answers a question under what the transaction may see.
///
/// # Errors
/// [`FleetError::Content`]: not understood, or no such kind of thing; [`FleetError::Database`].
pub async fn ask(transaction: &Transaction<'_>, text: &str) -> Result<Answer> {
    let key = name_key(text.trim().trim_end_matches(['?', '.', '!', ' ']));
    let language = Language::of(text);
    let rest_of = |forms: &[&str]| {
        let found = forms.iter().find_map(|form| key.strip_prefix(&format!("{form} ")));
        found.map(str::to_owned)
    };
    if let Some(rest) = rest_of(WHERE_ARE) {
        return where_are(transaction, &rest, language).await;
    }
    if let Some(rest) = rest_of(WHO_SAW) {
        return who_saw(transaction, &rest, language).await;
    }
    if let Some((_, days)) = WHAT_CHANGED.iter().find(|(form, _)| *form == key) {
        return what_changed(transaction, *days, language).await;
    }
    if WHERE_APART.contains(&key.as_str()) {
        return where_apart(transaction, language).await;
    }
    Err(FleetError::content(told!(language, "question-not-understood")))
}

/// The forms of a name by which people may mean it.
fn forms(name: &str) -> Vec<String> {
    let phrase = NounPhrase::parse(name, &WordHints::default());
    let declined = phrase.all_forms().into_iter().map(|(_, _, form)| name_key(&form));
    let english = [
        name_key(&english::plural(name)),
        name_key(&english::with_article(name)),
        name_key(&english::a(name)),
    ];
    declined.chain(english).chain([name_key(name)]).collect()
}

async fn where_are(
    transaction: &Transaction<'_>,
    phrase: &str,
    language: Language,
) -> Result<Answer> {
    let free = FREE.iter().find_map(|word| phrase.strip_prefix(&format!("{word} ")));
    let noun = free.unwrap_or(phrase);
    let rows = transaction.query("SELECT DISTINCT kind FROM fleet.kind", &[]).await?;
    let kinds: Vec<String> = rows.iter().map(|row| row.get(0)).collect();
    let meant: Vec<&String> =
        kinds.iter().filter(|kind| forms(kind).iter().any(|form| form == noun)).collect();
    let Some(kind) = meant.first() else {
        let some: Vec<&str> = kinds.iter().take(5).map(String::as_str).collect();
        let some = some.join(", ");
        return Err(FleetError::content(told!(language, "no-such-kind", noun, some)));
    };
    // Spellings of one kind, such as Стул and стул, are asked for together.
    let mut table = Table::default();
    let mut rules = Vec::new();
    for kind in meant.iter().filter(|other| name_key(other) == name_key(kind)) {
        let mut rule = format!("?- IS_A(X, \"{kind}\")");
        if free.is_some() {
            rule += ", !ON_TOP_OF(_, X), !INSIDE(_, X)";
        }
        rule += ".";
        let found = Question::parse(&rule)?.run(transaction).await?;
        table.columns = found.columns;
        table.rows.extend(found.rows);
        rules.push(rule);
    }
    let names = buildings(transaction).await?;
    let mut by_building = BTreeMap::<&str, Vec<&str>>::new();
    for row in &table.rows {
        let name = names.get(&row[0]).map_or(row[0].as_str(), String::as_str);
        let things = by_building.entry(name).or_default();
        // Two robots of a building may both have it on their maps.
        if !things.contains(&row[2].as_str()) {
            things.push(&row[2]);
        }
    }
    let text = if by_building.is_empty() {
        told!(language, "in-none")
    } else {
        let told =
            by_building.iter().map(|(name, things)| format!("{name}: {}", things.join(", ")));
        told.collect::<Vec<_>>().join("\n")
    };
    Ok(Answer { text, rule: Some(rules.join("\n")), table })
}

async fn buildings(transaction: &Transaction<'_>) -> Result<BTreeMap<String, String>> {
    let rows = transaction.query("SELECT building::text, name FROM fleet.building", &[]).await?;
    Ok(rows.iter().map(|row| (row.get(0), row.get(1))).collect())
}

/// Rows of texts of a statement, whose columns are texts.
pub(crate) async fn rows(
    transaction: &Transaction<'_>,
    columns: &[&str],
    sql: &str,
    given: &[&(dyn ToSql + Sync)],
) -> Result<Table> {
    let statement = transaction.prepare_cached(sql).await?;
    let found = transaction.query(&statement, given).await?;
    let row = |row: &tokio_postgres::Row| {
        let cells = (0..columns.len()).map(|at| row.try_get::<_, Option<String>>(at));
        cells.map(|cell| Ok(cell?.unwrap_or_default())).collect::<Result<Vec<_>>>()
    };
    Ok(Table {
        columns: columns.iter().map(|&name| name.to_owned()).collect(),
        rows: found.iter().map(row).collect::<Result<_>>()?,
    })
}

fn lines(table: &Table, none: String, line: impl Fn(&[String]) -> String) -> String {
    if table.rows.is_empty() {
        return none;
    }
    table.rows.iter().map(|row| line(row)).collect::<Vec<_>>().join("\n")
}

async fn who_saw(
    transaction: &Transaction<'_>,
    phrase: &str,
    language: Language,
) -> Result<Answer> {
    // A form shares its beginning with the name; which of them it is a form of is then looked at closely. What is a small
    // letter the server knows only where its locale does.
    let first = phrase.chars().next().unwrap_or_default();
    let mut beginnings = vec![first];
    beginnings.extend(if first == 'е' { vec!['ё', 'Ё'] } else { Vec::new() });
    beginnings.extend(first.to_uppercase());
    let beginnings: Vec<String> = beginnings.iter().map(char::to_string).collect();
    let sql = "SELECT b.name, l.thing, l.robot_name, to_char(l.seen AT TIME ZONE 'UTC', 'YYYY-MM-DD HH24:MI'), l.area \
               FROM fleet.last_seen l JOIN fleet.building b USING (building) \
               WHERE left(l.thing, 1) = ANY ($1) ORDER BY l.seen DESC";
    let columns = ["building", "thing", "robot", "seen", "area"];
    let mut table = rows(transaction, &columns, sql, &[&beginnings]).await?;
    table.rows.retain(|row| forms(&row[1]).iter().any(|form| form == phrase));
    let text = lines(&table, told!(language, "seen-by-none"), |row| {
        format!("{}: {} – {}, {} UTC, {}", row[0], row[1], row[2], row[3], row[4])
    });
    Ok(Answer { text, rule: None, table })
}

async fn what_changed(
    transaction: &Transaction<'_>,
    days: i64,
    language: Language,
) -> Result<Answer> {
    let sql = "SELECT b.name, coalesce(nullif(r.name, ''), '–'), v.\"Revision\"::text, v.\"RecUser\", v.\"Reason\", \
                      to_char(v.\"RecDate\" AT TIME ZONE 'UTC', 'YYYY-MM-DD HH24:MI'), \
                      (v.\"CreatedCount\" + v.\"ChangedCount\" + v.\"DeletedCount\")::text \
               FROM log.\"Revisions\" v JOIN fleet.building b ON b.building = v.building \
               JOIN fleet.robot r ON r.building = v.building AND r.robot = v.robot \
               WHERE v.\"RecDate\" >= now() - $1 * interval '1 day' AND NOT v.\"Deleted\" \
               ORDER BY v.\"RecDate\" DESC LIMIT 1000";
    let columns = ["building", "robot", "revision", "author", "reason", "at", "records"];
    let table = rows(transaction, &columns, sql, &[&(days as f64)]).await?;
    let text = lines(&table, told!(language, "nothing-changed"), |row| {
        let [building, robot, _, author, reason, at, records] = row else { return String::new() };
        told!(language, "was-changed", at, building, reason, author, robot, records)
    });
    Ok(Answer { text, rule: None, table })
}

async fn where_apart(transaction: &Transaction<'_>, language: Language) -> Result<Answer> {
    let sql = "SELECT b.name, count(DISTINCT p.thing)::text, coalesce(round(max(p.apart))::text, '–') \
               FROM fleet.proposal p JOIN fleet.building b USING (building) \
               GROUP BY b.building, b.name ORDER BY count(DISTINCT p.thing) DESC, b.building LIMIT 20";
    let columns = ["building", "things", "farthest, cm"];
    let table = rows(transaction, &columns, sql, &[]).await?;
    let text = lines(&table, told!(language, "apart-nowhere"), |row| {
        let [building, things, farthest] = row else { return String::new() };
        told!(language, "apart-there", building, things, farthest)
    });
    Ok(Answer { text, rule: None, table })
}
