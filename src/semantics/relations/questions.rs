//! What is asked of derived relations.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::asked::{Around, ROBOT, on_demand};
use crate::facts::{
    AskError, Computed, Database, Derived, Kind, Limits, Live, Proof, RelationId, RelationInfo,
    Value, WhyNot,
};
use crate::geometry::Openings;
use crate::map::{Entity, Profile, World};
use crate::measure::Measurements;
use crate::measured::{MEASURED, Made};
use crate::names::{Subject, Symbols};
use crate::openings::by_name;
use crate::thresholds::Thresholds;
use crate::units::{
    AreaId, Gather as _, Language, MapId, ReplicaId, Source, name_key, nearest_name,
};

use super::{Join, RelationCount, RelationError, RelationRules, Relations};

impl Relations {
    /// Every relation that the rule text puts out and names in both languages, in its order there; those that are derived
    /// when asked hold of nothing before.
    #[must_use]
    pub fn counts(&self) -> Vec<RelationCount> {
        let asked = self.derived_when_asked();
        self.public()
            .filter(|(id, _)| !asked.contains(id))
            .map(|(id, info)| RelationCount {
                name: info.name.clone(),
                name_en: info.second_name.clone().unwrap_or_default(),
                count: self.derived().len(id).unwrap_or(0),
            })
            .collect()
    }

    fn derived_when_asked(&self) -> Vec<RelationId> {
        let program = self.rules.program();
        let asked = MEASURED.iter().filter(|measured| measured.made == Made::WhenAsked);
        program.depend_on(asked.filter_map(|measured| program.relation(measured.name)))
    }

    /// The question for all tuples of a relation that is derived when asked; none of one whose tuples are there.
    #[must_use]
    pub fn asked_by(&self, name: &str) -> Option<String> {
        let program = self.rules.program();
        let relation =
            program.relation(name).filter(|id| self.derived_when_asked().contains(id))?;
        let columns = &program.info(relation).columns;
        let variables: Vec<String> = (0..columns.len()).map(|n| format!("V{n}")).collect();
        Some(format!("?- {name}({})", variables.join(", ")))
    }

    /// The tuples of a relation, by either of its names, sorted. What is derived when asked is not there: see
    /// [`Relations::asked_by`].
    ///
    /// # Errors
    /// [`RelationError::UnknownRelation`] with the nearest name.
    pub fn tuples(&self, name: &str) -> Result<Vec<Vec<Value>>, RelationError> {
        let relation = self.rules.program().relation(name).ok_or_else(|| self.unknown(name))?;
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

    /// A relation's name in a language, whichever of its names is given.
    #[must_use]
    pub fn display_name(&self, name: &str, language: Language) -> String {
        let key = name_key(name);
        let is_it = |info: &RelationInfo| {
            name_key(&info.name) == key
                || info.second_name.as_deref().is_some_and(|n| name_key(n) == key)
        };
        let mut relations = self.derived().relations();
        let Some((_, info)) = relations.find(|(_, info)| is_it(info)) else {
            return name.to_owned();
        };
        let english = info.second_name.as_ref().filter(|_| language == Language::English);
        english.unwrap_or(&info.name).clone()
    }

    /// Whether a tuple of symbols holds.
    #[must_use]
    pub fn holds(&self, name: &str, symbols: &[&str]) -> bool {
        let tuple: Vec<Value> = symbols.iter().map(|&s| Value::from(s)).collect();
        self.derived().contains(name, &tuple).unwrap_or(false)
    }

    /// Whether anything is called so: a subject of the facts, in any spelling, a word that some fact has, or the robot's.
    #[must_use]
    pub fn knows(&self, name: &str) -> bool {
        let wanted = Value::from(name);
        let says = |(id, _)| {
            let tuples = self.derived().sorted(id).unwrap_or_default();
            tuples.iter().any(|tuple| tuple.contains(&wanted))
        };
        name == ROBOT || self.symbols.find(name).is_some() || self.derived().relations().any(says)
    }

    /// Why a tuple holds: its rules and premises, down to what was measured. None when it does not hold.
    ///
    /// # Errors
    /// [`RelationError::UnknownRelation`], [`RelationError::Schema`] for too many or too few names.
    pub fn why(
        &self,
        around: &Around<'_>,
        name: &str,
        symbols: &[&str],
    ) -> Result<Option<Proof>, RelationError> {
        let (relation, tuple) = self.question(name, symbols)?;
        let told = self.told_of(around, relation, &tuple)?;
        let derived = told.as_ref().map_or(self.derived(), Live::derived);
        derived.why(relation, &tuple).map_err(|fault| RelationError::Schema { fault })
    }

    /// Why a tuple does not hold: the rule that came closest and the premise that failed, with its numbers.
    ///
    /// # Errors
    /// As [`Relations::why`].
    pub fn why_not(
        &self,
        around: &Around<'_>,
        name: &str,
        symbols: &[&str],
    ) -> Result<WhyNot, RelationError> {
        let (relation, tuple) = self.question(name, symbols)?;
        let told = self.told_of(around, relation, &tuple)?;
        let derived = told.as_ref().map_or(self.derived(), Live::derived);
        let answer = derived.explain().why_not(relation, &tuple);
        answer.map_err(|fault| RelationError::Schema { fault })
    }

    /// A copy that is told what is measured when this tuple is asked of; none where its rules read nothing of the kind.
    fn told_of(
        &self,
        around: &Around<'_>,
        relation: RelationId,
        tuple: &[Value],
    ) -> Result<Option<Live>, RelationError> {
        let program = self.rules.program();
        let measured = on_demand(around, self);
        let by_relation =
            measured.iter().filter_map(|one| Some((program.relation(one.name())?, one)));
        let measured: BTreeMap<RelationId, &dyn Computed> =
            by_relation.map(|(relation, one)| (relation, one as &dyn Computed)).collect();
        let of: Vec<RelationId> = measured.keys().copied().collect();
        let schema = |fault| RelationError::Schema { fault };
        let calls = program.calls(relation, tuple, &of).map_err(schema)?;
        if calls.is_empty() {
            return Ok(None);
        }
        let (mut live, mut fault) = (self.live.clone(), None);
        for (relation, known) in &calls {
            let by = measured[relation];
            let can = |needs: u32| {
                known.iter().enumerate().all(|(n, k)| needs >> n & 1 == 0 || k.is_some())
            };
            if by.ways().iter().any(|(needs, _)| can(*needs)) {
                by.rows(known, &mut |row| {
                    if let Err(e) = live.insert(*relation, row) {
                        fault.get_or_insert(e);
                    }
                });
            }
        }
        if let Some(fault) = fault {
            return Err(RelationError::Schema { fault });
        }
        live.update()?;
        Ok(Some(live))
    }

    /// The answers to a question in the rules' own language, with what is measured when asked.
    ///
    /// # Errors
    /// [`AskError`]: the rule text lacks what the question reads, or a limit was reached.
    pub fn ask(&self, around: &Around<'_>, question: &str) -> Result<Vec<Vec<Value>>, AskError> {
        let measured = on_demand(around, self);
        let computed: Vec<&dyn Computed> =
            measured.iter().map(|one| one as &dyn Computed).collect();
        self.ask_of(&computed, question)
    }

    /// As [`Relations::ask`], for questions of the program's own: a rule text that goes without a relation says it of
    /// nothing.
    #[must_use]
    pub fn found(&self, around: &Around<'_>, question: &str) -> Vec<Vec<Value>> {
        let found = self.ask(around, question);
        debug_assert!(matches!(found, Ok(_) | Err(AskError::Faults(_))), "{question}: {found:?}");
        found.unwrap_or_default()
    }

    /// As [`Relations::ask`], of measurements that are made elsewhere.
    ///
    /// # Errors
    /// As [`Relations::ask`].
    pub fn ask_of(
        &self,
        computed: &[&dyn Computed],
        question: &str,
    ) -> Result<Vec<Vec<Value>>, AskError> {
        let question = Source::new("?", question);
        let answers = self.derived().ask_with(&question, computed, Limits::default())?;
        Ok(answers.rows().to_vec())
    }

    /// A tuple as people spell it.
    fn question(
        &self,
        name: &str,
        symbols: &[&str],
    ) -> Result<(RelationId, Vec<Value>), RelationError> {
        let relation = self.rules.program().relation(name).ok_or_else(|| self.unknown(name))?;
        let columns = &self.rules.program().info(relation).columns;
        let value = |(n, &s): (usize, &&str)| {
            let is_number = columns.get(n).is_some_and(|column| column.kind == Kind::Number);
            match (s.parse(), self.symbols.find(s)) {
                (Ok(number), _) if is_number => Value::Number(number),
                (_, Some(subject)) => Value::Symbol(Arc::clone(self.symbols.symbol(subject))),
                (_, None) => Value::from(s),
            }
        };
        Ok((relation, symbols.iter().enumerate().map(value).collect()))
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

    /// What stands on a thing or lies in it, by itself, in the order of ids.
    pub fn borne_by(&self, id: ReplicaId) -> impl Iterator<Item = ReplicaId> + '_ {
        let all = self.loads.range((id, ReplicaId(0))..);
        all.take_while(move |(support, _)| *support == id).map(|(_, load)| *load)
    }

    /// Whether something stands on a thing.
    #[must_use]
    pub fn bears_something(&self, id: ReplicaId) -> bool {
        self.bearing.range((id, ReplicaId(0))..).next().is_some_and(|(lower, _)| *lower == id)
    }

    /// What directly holds a thing: its support, else the tightest of what it lies in.
    #[must_use]
    pub fn lies_on_or_in(&self, id: ReplicaId) -> Option<ReplicaId> {
        self.second_of("LIES_ON_OR_IN", id).next()
    }

    /// What shut thing a thing is in.
    #[must_use]
    pub fn shut_in(&self, id: ReplicaId) -> Option<ReplicaId> {
        let all: BTreeSet<ReplicaId> = self.second_of("SHUT_IN", id).collect();
        let holds = |outer: ReplicaId, inner: ReplicaId| {
            inner != outer && self.second_of("SHUT_IN", inner).any(|around| around == outer)
        };
        let innermost = |one: &ReplicaId| !all.iter().any(|other| holds(*one, *other));
        all.iter().copied().find(innermost).or(all.first().copied())
    }

    /// Whether a thing is in another.
    #[must_use]
    pub fn is_inside(&self, id: ReplicaId, around: ReplicaId) -> bool {
        self.second_of("INSIDE", id).any(|other| other == around)
    }

    /// All that is in something shut.
    #[must_use]
    pub fn all_shut_in(&self) -> BTreeSet<ReplicaId> {
        let tuples = self.derived().tuples("SHUT_IN").into_iter().flatten();
        tuples.filter_map(|t| self.symbols.replica_of(t.symbol(0))).gather()
    }

    /// All that is carried along with a thing.
    #[must_use]
    pub fn goes_with(&self, carrier: ReplicaId) -> BTreeSet<ReplicaId> {
        let Ok(tuples) = self.derived().tuples("GOES_WITH") else { return BTreeSet::new() };
        let pairs = tuples.filter_map(|t| {
            let replica = |column| self.symbols.replica_of(t.symbol(column));
            replica(0).zip(replica(1))
        });
        pairs.filter(|(_, with)| *with == carrier).map(|(thing, _)| thing).gather()
    }

    /// The thresholds of the rule text, of this profile.
    #[must_use]
    pub fn thresholds(&self) -> &Thresholds {
        &self.thresholds
    }

    /// By how much the Domain places a storey above another, cm; none where both stand at one height, or it places either
    /// nowhere.
    #[must_use]
    pub fn rise(&self, world: &World, from: MapId, to: MapId) -> Option<f64> {
        let height = |map: MapId| {
            world.domain.maps.iter().find(|placed| placed.map == map).map(|m| m.frame.z.get())
        };
        let rise = height(to)? - height(from)?;
        Some(rise).filter(|rise| rise.abs() > self.thresholds.level_equal)
    }

    /// The Areas of other storeys that lie over an Area, or under it; in the order of their ids. Storeys that the Domain
    /// does not place at heights of their own lie neither over nor under each other.
    #[must_use]
    pub fn on_other_storeys(&self, world: &World, area: AreaId, is_over: bool) -> Vec<AreaId> {
        let near = &self.thresholds;
        let others = self.measurements().on_other_storeys(world, area).into_iter();
        let lies_so = others.filter(|other| {
            let rise = if is_over { other.rise } else { -other.rise };
            rise > near.level_equal && other.shared > near.storey_share
        });
        lies_so.map(|other| other.area).collect()
    }

    /// What stands on the floor of an Area, in the order of ids.
    #[must_use]
    pub fn on_floor_of(&self, area: AreaId) -> Vec<ReplicaId> {
        let all = self.on_floor.range((area, ReplicaId(0))..);
        all.take_while(|(of, _)| *of == area).map(|(_, id)| *id).collect()
    }

    /// Whether a thing stands on the floor of an Area.
    #[must_use]
    pub fn stands_on_floor(&self, thing: ReplicaId, area: AreaId) -> bool {
        self.on_floor.contains(&(area, thing))
    }

    /// The other ends of the pairs in which a thing stands first.
    fn second_of(&self, relation: &'static str, id: ReplicaId) -> impl Iterator<Item = ReplicaId> {
        let tuples = self.derived().tuples(relation).into_iter().flatten();
        let of = tuples.filter(move |t| self.symbols.replica_of(t.symbol(0)) == Some(id));
        of.filter_map(|t| self.symbols.replica_of(t.symbol(1)))
    }

    /// Doors and passages between Areas, both ways.
    #[must_use]
    pub fn joins(&self) -> Vec<Join> {
        let Ok(tuples) = self.derived().tuples("JOINS") else { return Vec::new() };
        let ids = by_name(&self.openings);
        let mut joins: Vec<Join> = tuples
            .filter_map(|t| {
                let opening = t.symbol(0)?.to_owned();
                let door = match self.symbols.subject(&opening) {
                    Some(Subject::Entity(Entity::Door(id))) => Some(id),
                    _ => None,
                };
                Some(Join {
                    id: ids.get(&*opening).and_then(|ids| ids.first()).copied(),
                    opening,
                    door,
                    from: self.symbols.area_of(t.symbol(1))?,
                    to: self.symbols.area_of(t.symbol(2))?,
                })
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

    /// All doors and passages, each once, with what the rules let them join.
    #[must_use]
    pub fn openings(&self) -> &Arc<Openings> {
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
        self.derived().relations().filter(|(_, i)| !i.outputs.is_empty() && i.second_name.is_some())
    }
}
