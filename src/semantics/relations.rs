//! Relations of a world, derived by the rule text from what was measured (SPEC R).

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;
use std::sync::Arc;

use foldhash::fast::RandomState;
use miette::Diagnostic;
use thiserror::Error;

use crate::facts::{
    Database, Derived, EvaluateError, FactError, Faults, Known, Live, Loader, Program, Proof,
    RelationId, RelationInfo, Value, WhyNot,
};
use crate::map::{Entity, World};
use crate::units::{AreaId, DoorId, ReplicaId, Source, name_key, nearest_name};

use super::feed::{Cell, Feed, Sink};
use super::measure::{Measurements, Reach};
use super::names::{Subject, Symbols};
use super::openings::{Opening, openings};

/// The rule text that the crate brings along.
pub const STANDARD: &str = include_str!("../../rules/relations.dl");
/// No rule file that a person wrote is longer.
const MAX_FILE_BYTES: u64 = 16 << 20;

/// OUTSIDE is derived for all things while there are no more pairs of thing and Area than this.
const MOST_OUTSIDE: usize = 100_000;

/// With more pairs than this, what updates need is prepared beforehand: deriving takes longer than that anyway.
const MANY_PAIRS: usize = 5_000;

/// Why there are no relations.
#[derive(Debug, Error, Diagnostic)]
pub enum RelationError {
    /// The file of rules could not be read.
    #[error("не удалось прочесть файл правил «{path}»: {message}")]
    #[diagnostic(
        code(semantics::unreadable),
        help("проверьте путь и права доступа; файл должен быть в UTF-8")
    )]
    Unreadable { path: String, message: String },
    /// Longer than what a person writes.
    #[error("файл правил «{path}» слишком велик: {bytes} байт, предел {MAX_FILE_BYTES}")]
    #[diagnostic(
        code(semantics::too_large),
        help("правила – это текст, написанный человеком; проверьте, тот ли это файл")
    )]
    TooLarge { path: String, bytes: u64 },
    /// Nothing but white space.
    #[error("файл правил «{path}» пуст")]
    #[diagnostic(
        code(semantics::empty),
        help("уберите его, и будут действовать правила, которые есть в самой программе")
    )]
    Empty { path: String },
    /// The rule text is at fault.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Rules(#[from] Faults),
    /// The rule text declares a measured relation otherwise than it is measured.
    #[error("{fault}")]
    #[diagnostic(
        code(semantics::schema),
        help(
            "измеряемые отношения объявлены в rules/relations.dl, раздел «Измерения»; их столбцы менять нельзя"
        )
    )]
    Schema { fault: FactError },
    /// Evaluation does not end within its limits.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Evaluate(#[from] EvaluateError),
    /// A name that no relation bears.
    #[error("нет отношения «{name}»")]
    #[diagnostic(code(semantics::unknown_relation), help("{}", nearest.as_ref().map_or_else(
        || "имена отношений стоят в rules/relations.dl".to_owned(), |n| format!("может быть, «{n}»?"))))]
    UnknownRelation { name: String, nearest: Option<String> },
}

/// How the Map came to be: thresholds differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Profile {
    /// Measured by people: what stands on something stands on it.
    #[default]
    Surveyed,
    /// Seen by the robot: boxes with some centimetres of error.
    Detected,
}

impl Profile {
    /// Its name in the rule text.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Surveyed => "surveyed",
            Self::Detected => "detected",
        }
    }
}

/// A rule text, read and found sound.
#[derive(Debug, Clone)]
pub struct RelationRules {
    program: Program,
    reach: Reach,
    /// How far a step through a door looks, in tenths of a millimetre.
    step: i64,
}

impl RelationRules {
    /// The rules that the crate brings along.
    ///
    /// # Panics
    /// Never: a test reads them.
    #[must_use]
    pub fn standard() -> Self {
        Self::parse(&[Source::new("rules/relations.dl", STANDARD)])
            .expect("the standard rules are sound")
    }

    /// # Errors
    /// [`RelationError::Unreadable`], [`RelationError::TooLarge`], [`RelationError::Empty`],
    /// [`RelationError::Rules`] with all faults of the text, [`RelationError::Schema`].
    pub fn load(path: &Path) -> Result<Self, RelationError> {
        let name = || path.to_string_lossy().into_owned();
        let unreadable =
            |e: std::io::Error| RelationError::Unreadable { path: name(), message: e.to_string() };
        let bytes = std::fs::metadata(path).map_err(unreadable)?.len();
        if bytes > MAX_FILE_BYTES {
            return Err(RelationError::TooLarge { path: name(), bytes });
        }
        let source = Source::read(path).map_err(unreadable)?;
        if source.text().trim().is_empty() {
            return Err(RelationError::Empty { path: name() });
        }
        Self::parse(&[source])
    }

    /// The standard rules with more of one's own after them.
    ///
    /// # Errors
    /// [`RelationError::Rules`] with all faults of the text, [`RelationError::Schema`].
    pub fn with(text: &Source) -> Result<Self, RelationError> {
        Self::parse(&[Source::new("rules/relations.dl", STANDARD), text.clone()])
    }

    /// Several texts as one.
    ///
    /// # Errors
    /// [`RelationError::Rules`] with all faults of all texts, [`RelationError::Schema`].
    pub fn parse(texts: &[Source]) -> Result<Self, RelationError> {
        let program = Program::parse_all(texts)?;
        let empty = program.evaluate(&program.database())?;
        let mut rules = Self { program, reach: Reach::default(), step: 6_000 };
        let Ok(facts) = empty.tuples("reach") else { return Ok(rules) };
        for fact in facts {
            let (Some(name), Some(limit)) = (fact.symbol(0), fact.number(1)) else { continue };
            // Beyond a hundred metres nothing in a room is near.
            let limit = limit.clamp(0, 1_000_000);
            match name {
                "distance" => rules.reach.distance = limit,
                "beside" => rules.reach.beside = limit,
                "sector" => rules.reach.sector = limit,
                "sink" => rules.reach.sink = limit,
                "escape" => rules.reach.escape = limit,
                "outside" => rules.reach.outside = limit,
                "apart" => rules.reach.apart = limit,
                "step" => rules.step = limit,
                _ => {}
            }
        }
        Ok(rules)
    }

    /// How far measuring must look for these rules.
    #[must_use]
    pub fn reach(&self) -> Reach {
        self.reach
    }

    #[must_use]
    pub fn program(&self) -> &Program {
        &self.program
    }
}

/// How often a relation holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RelationCount {
    pub name: String,
    pub name_en: String,
    pub count: usize,
}

/// A door or passage with the Areas that it joins, once for each direction.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Join {
    /// Its name in the facts: the door's, or one made for a passage without a name.
    pub opening: String,
    pub door: Option<DoorId>,
    pub from: AreaId,
    pub to: AreaId,
}

/// Everything derived from one state of a world.
#[derive(Debug, Clone)]
pub struct Relations {
    rules: RelationRules,
    profile: Profile,
    symbols: Symbols,
    measured: Measurements,
    openings: Vec<Opening>,
    live: Live,
    /// Each thing with the Areas in which it is.
    areas: BTreeSet<(ReplicaId, AreaId)>,
    supports: BTreeMap<ReplicaId, ReplicaId>,
    /// What bears something, and what it bears.
    bearing: BTreeSet<(ReplicaId, ReplicaId)>,
}

/// Measures a world and derives its relations.
///
/// # Errors
/// [`RelationError::Schema`] when the rule text changed a measured relation, [`RelationError::Evaluate`] when a rule of
/// the user's own outgrows the memory.
pub fn derive(
    world: &World,
    rules: &RelationRules,
    profile: Profile,
) -> Result<Relations, RelationError> {
    let measured = Measurements::of(world, rules.reach);
    derive_from(world, rules, profile, measured)
}

/// Derives the relations of a world that was measured before.
///
/// # Errors
/// As [`derive()`].
pub fn derive_from(
    world: &World,
    rules: &RelationRules,
    profile: Profile,
    measured: Measurements,
) -> Result<Relations, RelationError> {
    let symbols = Symbols::of(world);
    let openings = openings(world, &measured, rules.step as f64 / 100.0, &symbols);
    let feed = Feed { world, symbols: &symbols, measured: &measured };
    let mut database = rules.program.database();
    let mut rows = Load::new(&rules.program, &mut database);
    rows.row("profile", &[Cell::Word(profile.name())]);
    feed.ground(&openings, &mut rows);
    feed.things(&mut rows);
    if measured.bodies.len() * measured.rooms.len() <= MOST_OUTSIDE {
        for body in measured.bodies.values() {
            let map = symbols.symbol(Subject::Entity(Entity::Map(body.map)));
            rows.row("asked", &[Cell::Name(symbols.replica(body.id)), Cell::Name(map)]);
        }
    }
    rows.finish().map_err(|fault| RelationError::Schema { fault })?;
    let mut live = Live::new(rules.program.clone(), database)?;
    if measured.pair_count() > MANY_PAIRS {
        live.prepare();
    }
    Ok(Relations::new(rules, profile, symbols, measured, openings, live))
}

impl Relations {
    /// What was derived as bytes, for [`Relations::restore`].
    #[must_use]
    pub fn save(&self) -> Option<Vec<u8>> {
        let mut bytes = saved_head(self.profile);
        bytes.extend(self.live.save()?);
        Some(bytes)
    }

    /// What [`Relations::save`] saved of the same world under the same rules, derived no more; none where the bytes are
    /// of other rules, or broken. Whoever keeps the bytes knows of which state of the world they are.
    #[must_use]
    pub fn restore(
        world: &World,
        rules: &RelationRules,
        profile: Profile,
        bytes: &[u8],
    ) -> Option<Self> {
        let live = Live::restore(&rules.program, bytes.strip_prefix(&*saved_head(profile))?)?;
        let symbols = Symbols::of(world);
        let measured = Measurements::of_things(world, rules.reach);
        let openings = openings(world, &measured, rules.step as f64 / 100.0, &symbols);
        Some(Self::new(rules, profile, symbols, measured, openings, live))
    }

    fn new(
        rules: &RelationRules,
        profile: Profile,
        symbols: Symbols,
        measured: Measurements,
        openings: Vec<Opening>,
        live: Live,
    ) -> Self {
        let mut relations = Self {
            rules: rules.clone(),
            profile,
            symbols,
            measured,
            openings,
            live,
            areas: BTreeSet::new(),
            supports: BTreeMap::new(),
            bearing: BTreeSet::new(),
        };
        relations.index();
        relations
    }
}

/// What stands before saved relations: another version of this crate may measure otherwise.
fn saved_head(profile: Profile) -> Vec<u8> {
    format!("{} {}\n", env!("CARGO_PKG_VERSION"), profile.name()).into_bytes()
}

fn tuple(cells: &[Cell<'_>]) -> Vec<Value> {
    cells.iter().map(|&c| c.into()).collect()
}

/// Keeps the first fault. A rule text may do without a measurement.
fn note(kept: &mut Option<FactError>, fault: FactError) {
    if !matches!(fault, FactError::UnknownRelation { .. }) {
        kept.get_or_insert(fault);
    }
}

/// Rows on their way into the database; the first that does not fit is kept.
pub(super) struct Rows {
    pub(super) database: Database,
    pub(super) fault: Option<FactError>,
}

impl Rows {
    pub(super) fn insert(&mut self, relation: &'static str, cells: &[Cell<'_>]) {
        if let Err(fault) = self.database.insert(relation, &tuple(cells)) {
            note(&mut self.fault, fault);
        }
    }
}

/// Rows on their way into the database, all at once. Names are looked up by where they stand, each but once.
struct Load<'a> {
    program: &'a Program,
    loader: Loader<'a>,
    relations: HashMap<(*const u8, usize), Option<RelationId>, RandomState>,
    names: HashMap<*const u8, Known, RandomState>,
    row: Vec<Known>,
    fault: Option<FactError>,
}

impl<'a> Load<'a> {
    fn new(program: &'a Program, database: &'a mut Database) -> Self {
        Self {
            program,
            loader: database.load(),
            relations: HashMap::default(),
            names: HashMap::default(),
            row: Vec::new(),
            fault: None,
        }
    }

    fn finish(self) -> Result<(), FactError> {
        self.loader.finish();
        self.fault.map_or(Ok(()), Err)
    }
}

impl Sink for Load<'_> {
    fn row(&mut self, relation: &'static str, cells: &[Cell<'_>]) {
        // A rule text may do without a measurement.
        let known = self.relations.entry((relation.as_ptr(), relation.len()));
        let Some(relation) = *known.or_insert_with(|| self.program.relation(relation)) else {
            return;
        };
        self.row.clear();
        for cell in cells {
            self.row.push(match cell {
                // The Map's own symbols outlive the loading, so that a place stands for one name.
                Cell::Name(name) => {
                    *self.names.entry(name.as_ptr()).or_insert_with(|| self.loader.symbol(name))
                }
                Cell::Word(word) => self.loader.symbol(word),
                Cell::Number(number) => self.loader.number(*number),
            });
        }
        if let Err(fault) = self.loader.push(relation, &self.row) {
            self.fault.get_or_insert(fault);
        }
    }
}

impl Relations {
    /// Follows a move of one replica: measures it anew and derives what follows, with the same result as [`derive()`].
    ///
    /// A replica that was added, removed, renamed or made of another Object needs [`derive()`]; `false` says so, and
    /// nothing is changed.
    ///
    /// # Errors
    /// As [`derive()`].
    pub fn update(&mut self, world: &World, moved: ReplicaId) -> Result<bool, RelationError> {
        let known = self.measured.of_thing(moved).map(|s| s.object);
        let now = world.replicas.get(&moved);
        let same_name =
            now.is_some_and(|r| r.name.as_str() == self.symbols.replica(moved).as_ref());
        if known.is_none() || known != now.map(|r| r.object) || !same_name {
            return Ok(false);
        }
        let change = self.measured.update(world, moved);
        let feed = Feed { world, symbols: &self.symbols, measured: &self.measured };
        let (live, mut fault) = (&mut self.live, None);
        let mut take = |relation: &'static str, cells: &[Cell<'_>]| {
            if let Err(e) = live.remove(relation, &tuple(cells)) {
                note(&mut fault, e);
            }
        };
        change.single_before.iter().for_each(|s| feed.single(moved, s, &mut take));
        change.removed.iter().for_each(|(&key, pair)| feed.pair(key, pair, &mut take));
        let mut put = |relation: &'static str, cells: &[Cell<'_>]| {
            if let Err(e) = live.insert(relation, &tuple(cells)) {
                note(&mut fault, e);
            }
        };
        change.single_after.iter().for_each(|s| feed.single(moved, s, &mut put));
        for key in &change.added {
            if let Some(pair) = self.measured.pairs().get(key) {
                feed.pair(*key, pair, &mut put);
            }
        }
        if let Some(fault) = fault {
            return Err(RelationError::Schema { fault });
        }
        self.live.update()?;
        self.follow();
        Ok(true)
    }

    /// Every relation that the rule text puts out and names in both languages, in its order there.
    #[must_use]
    pub fn counts(&self) -> Vec<RelationCount> {
        self.public()
            .map(|(id, info)| RelationCount {
                name: info.name.clone(),
                name_en: info.second_name.clone().unwrap_or_default(),
                count: self.derived().len(id).unwrap_or(0),
            })
            .collect()
    }

    /// The tuples of a relation, by either of its names, sorted.
    ///
    /// # Errors
    /// [`RelationError::UnknownRelation`] with the nearest name.
    pub fn tuples(&self, name: &str) -> Result<Vec<Vec<Value>>, RelationError> {
        let relation = self.rules.program.relation(name).ok_or_else(|| self.unknown(name))?;
        self.derived().sorted(relation).map_err(|fault| RelationError::Schema { fault })
    }

    /// Every tuple that speaks of a thing, with its relation. What is true of its Object as a kind counts too.
    #[must_use]
    pub fn of(&self, name: &str) -> Vec<(String, Vec<Value>)> {
        let Some(subject) = self.symbols.find(name) else { return Vec::new() };
        let mut wanted = vec![Value::Symbol(Arc::clone(self.symbols.symbol(subject)))];
        if let Subject::Entity(Entity::Replica(id)) = subject
            && let Some(body) = self.measured.bodies.get(&id)
        {
            wanted.push(Value::Symbol(Arc::clone(self.symbols.object(body.object))));
        }
        let mut found = Vec::new();
        for (id, info) in self.public() {
            let kinds = matches!(info.second_name.as_deref(), Some(n) if n.ends_with("PART_OF") || n == "CONSISTS_OF");
            let wanted = if kinds { wanted.as_slice() } else { &wanted[..1] };
            let tuples = self.derived().sorted(id).unwrap_or_default();
            let about = tuples.into_iter().filter(|t| t.iter().any(|v| wanted.contains(v)));
            found.extend(about.map(|t| (info.name.clone(), t)));
        }
        found
    }

    /// A relation's first name, whichever of its names is given.
    #[must_use]
    pub fn display_name(&self, name: &str) -> String {
        let key = name_key(name);
        let is_it = |info: &RelationInfo| {
            name_key(&info.name) == key
                || info.second_name.as_deref().is_some_and(|n| name_key(n) == key)
        };
        let mut relations = self.derived().relations();
        relations
            .find(|(_, info)| is_it(info))
            .map_or_else(|| name.to_owned(), |(_, info)| info.name.clone())
    }

    /// Whether a tuple of symbols holds.
    #[must_use]
    pub fn holds(&self, name: &str, symbols: &[&str]) -> bool {
        let tuple: Vec<Value> = symbols.iter().map(|&s| Value::from(s)).collect();
        self.derived().contains(name, &tuple).unwrap_or(false)
    }

    /// Why a tuple holds: its rules and premises, down to what was measured. None when it does not hold.
    ///
    /// # Errors
    /// [`RelationError::UnknownRelation`], [`RelationError::Schema`] for too many or too few names.
    pub fn why(&self, name: &str, symbols: &[&str]) -> Result<Option<Proof>, RelationError> {
        let (relation, tuple) = self.question(name, symbols)?;
        self.derived().why(relation, &tuple).map_err(|fault| RelationError::Schema { fault })
    }

    /// Why a tuple does not hold: the rule that came closest and the premise that failed, with its numbers.
    ///
    /// # Errors
    /// As [`Relations::why`].
    pub fn why_not(&self, name: &str, symbols: &[&str]) -> Result<WhyNot, RelationError> {
        let (relation, tuple) = self.question(name, symbols)?;
        let answer = self.derived().explain().why_not(relation, &tuple);
        answer.map_err(|fault| RelationError::Schema { fault })
    }

    /// A tuple as people spell it.
    fn question(
        &self,
        name: &str,
        symbols: &[&str],
    ) -> Result<(RelationId, Vec<Value>), RelationError> {
        let relation = self.rules.program.relation(name).ok_or_else(|| self.unknown(name))?;
        let symbol = |&s: &&str| match self.symbols.find(s) {
            Some(subject) => Value::Symbol(Arc::clone(self.symbols.symbol(subject))),
            None => Value::from(s),
        };
        Ok((relation, symbols.iter().map(symbol).collect()))
    }

    fn unknown(&self, name: &str) -> RelationError {
        let names = self
            .public()
            .flat_map(|(_, i)| std::iter::once(i.name.as_str()).chain(i.second_name.as_deref()));
        let nearest = nearest_name(name, names).map(str::to_owned);
        RelationError::UnknownRelation { name: name.to_owned(), nearest }
    }

    /// The Area in which a thing is.
    #[must_use]
    pub fn area_of(&self, id: ReplicaId) -> Option<AreaId> {
        self.areas
            .range((id, AreaId(0))..)
            .next()
            .filter(|(of, _)| *of == id)
            .map(|(_, area)| *area)
    }

    /// What a thing stands on or lies in.
    #[must_use]
    pub fn support_of(&self, id: ReplicaId) -> Option<ReplicaId> {
        self.supports.get(&id).copied()
    }

    /// Whether something stands on a thing.
    #[must_use]
    pub fn bears_something(&self, id: ReplicaId) -> bool {
        self.bearing.range((id, ReplicaId(0))..).next().is_some_and(|(lower, _)| *lower == id)
    }

    /// Doors and passages between Areas, both ways.
    #[must_use]
    pub fn joins(&self) -> Vec<Join> {
        let Ok(tuples) = self.derived().tuples("JOINS") else { return Vec::new() };
        let area = |symbol: Option<&str>| match self.symbols.subject(symbol?)? {
            Subject::Entity(Entity::Area(id)) => Some(id),
            _ => None,
        };
        let mut joins: Vec<Join> = tuples
            .filter_map(|t| {
                let opening = t.symbol(0)?.to_owned();
                let door = match self.symbols.subject(&opening) {
                    Some(Subject::Entity(Entity::Door(id))) => Some(id),
                    _ => None,
                };
                Some(Join { opening, door, from: area(t.symbol(1))?, to: area(t.symbol(2))? })
            })
            .collect();
        joins.sort_unstable();
        joins
    }

    #[must_use]
    pub fn symbols(&self) -> &Symbols {
        &self.symbols
    }

    #[must_use]
    pub fn measurements(&self) -> &Measurements {
        &self.measured
    }

    /// Doors and passages in the sides of all Areas.
    #[must_use]
    pub fn openings(&self) -> &[Opening] {
        &self.openings
    }

    #[must_use]
    pub fn derived(&self) -> &Derived {
        self.live.derived()
    }

    /// The input facts: what was measured.
    #[must_use]
    pub fn database(&self) -> &Database {
        self.live.database()
    }

    #[must_use]
    pub fn profile(&self) -> Profile {
        self.profile
    }

    #[must_use]
    pub fn rules(&self) -> &RelationRules {
        &self.rules
    }

    /// Relations that people ask for: put out, and named in both languages.
    fn public(&self) -> impl Iterator<Item = (RelationId, &RelationInfo)> {
        self.derived().relations().filter(|(_, i)| i.output.is_some() && i.second_name.is_some())
    }

    /// Brings what was looked up to the last update.
    fn follow(&mut self) {
        let program = &self.rules.program;
        let find = |name: &str| program.relation(name);
        let symbols = &self.symbols;
        let replica = |symbol: Option<&str>| match symbols.subject(symbol?)? {
            Subject::Entity(Entity::Replica(id)) => Some(id),
            _ => None,
        };
        let area = |symbol: Option<&str>| match symbols.subject(symbol?)? {
            Subject::Entity(Entity::Area(id)) => Some(id),
            _ => None,
        };
        if let Some(contains) = find("CONTAINS") {
            for tuple in self.live.removed(contains) {
                let (Some(area), Some(id)) = (area(tuple.symbol(0)), replica(tuple.symbol(1)))
                else {
                    continue;
                };
                self.areas.remove(&(id, area));
            }
            for tuple in self.live.added(contains) {
                self.areas.extend(replica(tuple.symbol(1)).zip(area(tuple.symbol(0))));
            }
        }
        if let Some(rests_on) = find("RESTS_ON") {
            for tuple in self.live.removed(rests_on) {
                replica(tuple.symbol(0)).map(|id| self.supports.remove(&id));
            }
            for tuple in self.live.added(rests_on) {
                self.supports.extend(replica(tuple.symbol(0)).zip(replica(tuple.symbol(1))));
            }
        }
        if let Some(on_top) = find("ON_TOP_OF") {
            for tuple in self.live.removed(on_top) {
                if let Some((upper, lower)) = replica(tuple.symbol(0)).zip(replica(tuple.symbol(1)))
                {
                    self.bearing.remove(&(lower, upper));
                }
            }
            for tuple in self.live.added(on_top) {
                self.bearing.extend(replica(tuple.symbol(1)).zip(replica(tuple.symbol(0))));
            }
        }
    }

    /// Looks up once what others ask for often.
    fn index(&mut self) {
        let replica = |symbol: Option<&str>| match self.symbols.subject(symbol?)? {
            Subject::Entity(Entity::Replica(id)) => Some(id),
            _ => None,
        };
        let area = |symbol: Option<&str>| match self.symbols.subject(symbol?)? {
            Subject::Entity(Entity::Area(id)) => Some(id),
            _ => None,
        };
        let pairs = |name: &'static str| self.derived().tuples(name).into_iter().flatten();
        let areas =
            pairs("CONTAINS").filter_map(|t| Some((replica(t.symbol(1))?, area(t.symbol(0))?)));
        let supports =
            pairs("RESTS_ON").filter_map(|t| Some((replica(t.symbol(0))?, replica(t.symbol(1))?)));
        let bearing =
            pairs("ON_TOP_OF").filter_map(|t| Some((replica(t.symbol(1))?, replica(t.symbol(0))?)));
        let (areas, supports, bearing) = (areas.collect(), supports.collect(), bearing.collect());
        (self.areas, self.supports, self.bearing) = (areas, supports, bearing);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_standard_rules_are_sound() {
        let rules = RelationRules::standard();
        let warnings: Vec<String> = rules
            .program()
            .warnings()
            .iter()
            .flat_map(|file| file.placed())
            .map(|(line, column, warning)| format!("{line}:{column} {warning}"))
            .collect();
        assert_eq!(warnings, Vec::<String>::new());
        assert_eq!(rules.reach, Reach::default());
    }
}
