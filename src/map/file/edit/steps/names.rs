//! What the names in a step mean: records of the world, found as the map or the edits spell them, or in another form.

use std::cell::OnceCell;
use std::collections::HashMap;

use super::super::kind::names_of;
use super::{Kind, MapError, Outcome, Record, Span, Step, Steps, misprint};
use crate::file::decode::{likely, shortened};
use crate::file::read::{Behind, Names};
use crate::units::{
    AreaId, Bilingual, DoorId, MapId, ObjectId, OrFrId, PlaceId, ReplicaId, name_key, word,
};
use crate::{TypeKind, World};

/// Keys of the map as names are compared, each kind when it is first asked for. Of what [`crate::NameIndex`] does not know,
/// the names as well.
#[derive(Default)]
pub(super) struct Keys([OnceCell<HashMap<String, Vec<Record>>>; Kind::ALL.len()]);

impl Keys {
    fn find(&self, world: &World, name: &str, kind: Kind) -> &[Record] {
        if kind.is_line() {
            return &[];
        }
        let all = self.0[kind as usize].get_or_init(|| {
            let mut all = HashMap::<String, Vec<Record>>::new();
            let told = if matches!(kind, Kind::Object | Kind::Orthoframe) { 3 } else { 1 };
            for record in kind.records(world) {
                let names = names_of(world, record).expect("it is one of the world's");
                for name in names[..told].iter().filter(|name| !name.is_empty()) {
                    let of = all.entry(name_key(name)).or_default();
                    if of.last() != Some(&record) {
                        of.push(record);
                    }
                }
            }
            all
        });
        all.get(name).map_or(&[], Vec::as_slice)
    }
}

impl Steps<'_> {
    /// The key of a record and its two names, as far as it has any; none where it stands no more.
    fn names_of(&self, record: Record) -> Option<[&str; 3]> {
        if let Record::Zone(id) = record
            && let Some(draft) = self.zones.get(&id)
        {
            return Some(draft.names());
        }
        match self.coming.get(&record) {
            Some(key) => Some([key, "", ""]),
            None => names_of(&self.world, record),
        }
    }

    /// The word by which other records refer to this one.
    pub(super) fn reference(&self, record: Record) -> String {
        self.names_of(record).map_or_else(String::new, |[key, ..]| key.to_owned())
    }

    /// The record of a kind with keys that has just this key.
    pub(super) fn keyed(&self, key: &str, kind: Kind) -> Option<Record> {
        macro_rules! keyed {
            ($records:ident, $record:ident) => {
                self.world.$records.values().find(|r| r.key == key).map(|r| Record::$record(r.id))
            };
        }
        let found = match kind {
            Kind::Replica | Kind::Place => return None,
            Kind::Area => keyed!(areas, Area),
            Kind::Door => keyed!(doors, Door),
            Kind::Map => keyed!(maps, Map),
            Kind::Object => keyed!(objects, Object),
            Kind::Orthoframe => keyed!(orthoframes, Orthoframe),
            Kind::Zone => {
                let draft = self.zones.iter().find(|(_, draft)| draft.names()[0] == key);
                draft.map(|(id, _)| Record::Zone(*id)).or_else(|| keyed!(zones, Zone))
            }
        };
        found.or_else(|| {
            let coming = self.coming_keys.get(&(kind, key.to_owned())).copied();
            coming.filter(|record| self.coming.contains_key(record))
        })
    }

    /// Makes a name known.
    pub(super) fn note(&mut self, name: &str, record: Record) {
        let all = self.given.entry(name_key(name)).or_default();
        if !name.is_empty() && !all.contains(&record) {
            all.push(record);
        }
    }

    /// All of a kind that bear a name. A key is exact: it goes before a name that looks like it.
    pub(super) fn bearers(&self, name: &str, kind: Kind) -> Vec<Record> {
        if let Some(exact) = self.keyed(name, kind) {
            return vec![exact];
        }
        let key = name_key(name);
        let by_name = self.naming.exact.find(self.start, name).into_iter().map(Record::from);
        let by_key = self.keys.find(self.start, &key, kind).iter().copied();
        let given = self.given.get(&key).into_iter().flatten().copied();
        let of_kind = |record: &Record| Kind::of(*record) == Some(kind);
        let mut all: Vec<Record> = by_name.chain(by_key).chain(given).filter(of_kind).collect();
        all.retain(|record| self.names_of(*record).is_some());
        // In the order of a map file.
        all.sort_by_key(|record| (self.area_of(*record), *record));
        all.dedup();
        all
    }

    /// What bears a name among some kinds: all of the first kind in which there is any.
    pub(super) fn all_named(&self, name: &str, kinds: &[Kind]) -> Vec<Record> {
        let all = kinds.iter().map(|kind| self.bearers(name, *kind));
        all.into_iter().find(|found| !found.is_empty()).unwrap_or_default()
    }

    fn area_of(&self, record: Record) -> Option<AreaId> {
        match record {
            Record::Replica(id) => self.world.replicas.get(&id).map(|r| r.area),
            Record::Place(id) => self.world.places.get(&id).map(|p| p.area),
            _ => None,
        }
    }

    /// What a name means among some kinds: as the map or the edits spell it, else in another form.
    pub(super) fn find(&self, name: &str, at: &Span, kinds: &[Kind]) -> Outcome<Record> {
        let mut found = self.all_named(name, kinds);
        if found.is_empty() {
            let in_other_words = (self.naming.in_other_words)(name).into_iter().map(Record::from);
            let is_meant = |record: &Record| {
                Kind::of(*record).is_some_and(|kind| kinds.contains(&kind))
                    && self.names_of(*record).is_some()
            };
            found = in_other_words.filter(is_meant).collect();
        }
        match found[..] {
            [only] => Ok(only),
            [] => {
                if let Some(error) = self.of_another_kind(name, kinds) {
                    return Err(misprint(error, at));
                }
                let what = if let [kind] = kinds { kind.title() } else { word!("name") };
                let (what, nearest) = (what.into(), self.nearest(name, kinds));
                let error = MapError::UnknownReference { what, name: shortened(name), nearest };
                Err(misprint(error, at))
            }
            _ => {
                let candidates: Vec<String> =
                    found.iter().map(|record| format!("«{}»", self.reference(*record))).collect();
                let (name, candidates) = (shortened(name), candidates.join(", "));
                Err(misprint(MapError::AmbiguousName { name, candidates }, at))
            }
        }
    }

    /// What bears a name is there, and is nothing of which this can be said.
    fn of_another_kind(&self, name: &str, kinds: &[Kind]) -> Option<MapError> {
        let other = Kind::ALL.into_iter().find(|kind| !self.bearers(name, *kind).is_empty())?;
        let found = Bilingual::named(other.noun(), &shortened(name));
        let wanted: Vec<Bilingual> = kinds.iter().map(|kind| kind.noun().into()).collect();
        let either = |language| {
            let all: Vec<&str> = wanted.iter().map(|one| one.say(language)).collect();
            all.join(&word!("or").say(language))
        };
        Some(MapError::WrongKind { found, expected: Bilingual::both(either) })
    }

    /// The likeliest name among some kinds.
    pub(super) fn nearest(&self, name: &str, kinds: &[Kind]) -> Option<String> {
        self.guesses_left.set(self.guesses_left.get().checked_sub(1)?);
        let of_kind = |kind: &Kind| {
            let drafts = self.zones.keys().map(|id| Record::Zone(*id));
            let more = drafts.chain(self.coming.keys().copied());
            let more: Vec<_> = more.filter(|r| Kind::of(*r) == Some(*kind)).collect();
            kind.records(&self.world).into_iter().chain(more)
        };
        let records = kinds.iter().flat_map(of_kind);
        let names: Vec<&str> = records.filter_map(|r| self.names_of(r)).flatten().collect();
        likely(name, &names)
    }

    /// The kinds that a step may speak of: all of these, or the one that it names.
    pub(super) fn kinds(
        &self,
        step: &Step<'_>,
        kind: Option<&str>,
        all: &[Kind],
    ) -> Outcome<Vec<Kind>> {
        let Some(word) = kind else { return Ok(all.to_vec()) };
        let words: Vec<&str> = all.iter().map(|k| k.word()).collect();
        match all.iter().find(|k| k.word() == word) {
            Some(kind) => Ok(vec![*kind]),
            None => Err(misprint(
                MapError::UnknownWord {
                    word: shortened(word),
                    nearest: likely(word, &words),
                    expected: words.join(", "),
                },
                step.at("kind"),
            )),
        }
    }

    /// What the words of a map file may name in this world.
    pub(super) fn names(&self) -> Names<'_> {
        macro_rules! index {
            ($kind:ident, $id:ident, $records:ident) => {{
                let all = &self.world.$records;
                let only = all.keys().next().copied().filter(|_| all.len() == 1);
                let find = |name: &str| match self.bearers(name, Kind::$kind).first() {
                    Some(Record::$kind(id)) => Some($id::clone(id)),
                    _ => None,
                };
                let nearest = |name: &str| self.nearest(name, &[Kind::$kind]);
                Behind { find: Box::new(find), nearest: Box::new(nearest), only }.into()
            }};
        }
        Names {
            types: TypeKind::ALL.map(|kind| (kind, self.types_named(kind).into())).into(),
            orthoframes: index!(Orthoframe, OrFrId, orthoframes),
            doors: index!(Door, DoorId, doors),
            objects: index!(Object, ObjectId, objects),
            areas: index!(Area, AreaId, areas),
            maps: index!(Map, MapId, maps),
            replicas: index!(Replica, ReplicaId, replicas),
            places: index!(Place, PlaceId, places),
        }
    }

    fn types_named(&self, kind: TypeKind) -> Behind<'_, crate::units::TypeId> {
        let list = self.world.types.list(kind);
        let nearest = |name: &str| {
            let names = list.entries.values().flat_map(|entry| [&*entry.name, &*entry.name_en]);
            likely(name, &names.filter(|name| !name.is_empty()).collect::<Vec<_>>())
        };
        let find = |name: &str| list.named(name).map(|entry| entry.id);
        Behind { find: Box::new(find), nearest: Box::new(nearest), only: None }
    }
}
