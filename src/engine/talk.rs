//! Questions in words: the engine is the senses of [`crate::language::question`], and the store its memory.

use crate::geometry::{Barrier, Method, NoRoute, Ride};
use crate::language::Language;
use crate::language::command::{Misheard, is_command, is_order_by, without_marks};
use crate::language::names::english_name;
use crate::language::question::{
    Answer, Asker, Corrected, Doubt, Fact, Memory, Mind, Misread, News, Noun, Past, Query,
    Resolved, Said, Senses, Sighting, Thing, Unanswered, Way, conditional, dashed, hinged,
    unaddressed,
};
use crate::language::report::Detail;
use crate::map::{DoorStatus, Entity, World};
use crate::meaning;
use crate::robot::{beyond_arm, starting_pose};
use crate::semantics::{Relations, Subject, robot_eye, things_in_view};
use crate::store::Seen;
use crate::units::{InOrder as _, MapId, Pose, ReplicaId, told};

use super::barriers::no_way_in_words;
use super::journey::Journey;
use super::known::Known;
use super::located::Located;
use super::position::describe;
use super::{Error, State};

impl State {
    /// Answers a question in Russian or English and remembers what it was about. What is remembered belongs to a state
    /// of the map: of what left it since, only that is said.
    ///
    /// The inner result is the answer, or why there is none: not understood, ambiguous, unknown to the map.
    ///
    /// # Errors
    /// There is no map, or its relations cannot be derived.
    pub fn ask(
        &self,
        question: &str,
        memory: &mut Memory,
    ) -> Result<Result<Answer, Unanswered>, Error> {
        self.catch_up(memory)?;
        let senses = RobotSenses { engine: self };
        let question = &*unaddressed(question);
        if let Some(answer) = self.ask_of_zones(question, &senses)? {
            memory.learn(&answer);
            return Ok(Ok(answer.of(memory)));
        }
        let answered = self.asker(&senses)?.ask(question, memory);
        let answered = match answered {
            // The grammar knows no tense.
            Err(unanswered)
                if !matches!(unanswered.doubt, Doubt::Past { .. })
                    && ["not_understood", "incomplete", "unknown"]
                        .contains(&unanswered.doubt.kind()) =>
            {
                let answer = self.ask_by_grammar(question)?;
                answer.inspect(|answer| memory.learn(answer)).ok_or(unanswered)
            }
            other => other,
        };
        Ok(answered.map(|answer| answer.of(memory)))
    }

    /// What a line says beside parts of it, as [`Asker::cores`].
    pub(super) fn cores<'t>(&self, text: &'t str) -> Result<Vec<(&'t str, String)>, Error> {
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.cores(text))
    }

    /// Brings what a dialogue remembers to the map as it now is.
    fn catch_up(&self, memory: &mut Memory) -> Result<(), Error> {
        let (now, world) = (self.changes.stamp(), self.world()?);
        let since = match memory.stamp() {
            Some(was) if was == now => return Ok(()),
            // Another map, or an older state of this one, which may lack what is remembered.
            Some(was) if was.map != now.map || was.change > now.change => {
                memory.forget();
                None
            }
            was => was,
        };
        if let Some(since) = since {
            let gone = |thing: Thing| self.changes.departed(thing, since, world);
            memory.outlive(&gone, self.changes.has_renamed_since(since));
        }
        memory.belongs_to(now);
        Ok(())
    }

    /// The answer by the grammar files, where these read a sentence in one way and whole: nothing in it was passed over
    /// but what they call void, and all that it could mean comes to the same.
    fn ask_by_grammar(&self, text: &str) -> Result<Option<Answer>, Error> {
        let now = self.around()?;
        let (world, relations, lexicon) = (now.world(), now.relations()?, &now.mind().lexicon);
        let map = meaning::Map { world, relations, lexicon, words: now.words() };
        let grammar = now.rules.grammar();
        let readings = grammar.read(&map, text);
        if readings.first().is_none_or(|cheapest| cheapest.cost > 0) {
            return Ok(None);
        }
        let outcome = grammar.answer(&map, readings, &mut |question| {
            self.query(question, false).map(|answer| answer.rows).map_err(|e| e.to_string())
        });
        let meaning::Outcome::Answered(read) = outcome else { return Ok(None) };
        // Of what is carried, or elsewhere than believed, the relations do not tell all.
        let is_doubted = |id: &ReplicaId| self.doubted(*id).is_some();
        if !now.holders.is_empty() || world.replicas.keys().any(is_doubted) {
            return Ok(None);
        }
        let language = Language::of(text);
        let (Some(words), 0) = (grammar.say(&map, &read, language), read.reading.cost) else {
            return Ok(None);
        };
        let rule = read.rules.last().cloned().unwrap_or_default();
        let query = Query::Ran { form: read.reading.form.word(), rule };
        let mut symbols = Vec::new();
        let mut number = None;
        let said = match read.found {
            Ok(meaning::Found::Truth(true)) => Said::Yes,
            Ok(meaning::Found::Truth(false)) => Said::No,
            Ok(meaning::Found::Things(all)) => {
                symbols = all;
                if symbols.is_empty() { Said::Nothing } else { Said::Found }
            }
            Ok(meaning::Found::Places(all)) => {
                symbols.extend(all.into_iter().map(|place| place.thing));
                Said::Found
            }
            Ok(meaning::Found::Number(n)) => {
                number = Some(n as f64);
                Said::Found
            }
            Ok(meaning::Found::Length(tenths)) => {
                number = Some(tenths as f64 / 100.0);
                Said::Found
            }
            Ok(meaning::Found::Area(square)) => {
                number = Some(square as f64);
                Said::Found
            }
            Ok(meaning::Found::Values(_)) => Said::Found,
            Ok(meaning::Found::Unknown) | Err(_) => Said::Unknown,
        };
        let thing = |symbol: &String| match relations.symbols().subject(symbol) {
            Some(Subject::Entity(entity)) => Some(Thing::Entity(entity)),
            _ => None,
        };
        let things = symbols.iter().filter_map(thing).collect();
        let answer = Answer::ran(query, language, said, text, words);
        Ok(Some(answer.of_things(things, symbols, number)))
    }

    /// The query of an answer as a Datalog rule; a remark where the map has become another since.
    ///
    /// # Errors
    /// As [`State::ask`].
    pub fn rule_of(&self, answer: &Answer) -> Result<String, Error> {
        if answer.stamp().is_some_and(|stamp| self.changes.has_renamed_since(stamp)) {
            return Ok(format!("// {}", told!(answer.language, "map-has-changed")));
        }
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.rule(&answer.query, answer.language))
    }

    /// The proof of a fact of an answer, or what it lacks, a premise a line.
    ///
    /// # Errors
    /// As [`State::ask`].
    pub fn proof_of(&self, fact: &Fact, language: Language) -> Result<Vec<String>, Error> {
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.proof(fact, language))
    }

    /// A command with its descriptions replaced by names: see [`Asker::resolve`].
    pub(super) fn resolve(&self, sentence: &str, memory: &mut Memory) -> Result<Resolved, Error> {
        self.catch_up(memory)?;
        let senses = RobotSenses { engine: self };
        let forms = self.forms()?;
        let strict = |text: &str| {
            let bare = text.strip_prefix("the ").or(text.strip_prefix("The ")).unwrap_or(text);
            match &forms.find(bare)[..] {
                [only] => Some(*only.id),
                _ => None,
            }
        };
        self.asker(&senses)?.resolve(sentence, memory, &strict).map_err(
            |Misread(mut unanswered)| {
                unanswered.text = without_marks(&unanswered.text).into_owned();
                let several = unanswered.doubt.kind() == "ambiguous";
                let misheard = if several { Misheard::WhichOf } else { Misheard::NoneSuch };
                misheard(unanswered).into()
            },
        )
    }

    /// A line that corrects itself, as it is meant: see [`Asker::corrected`].
    pub(super) fn corrected(
        &self,
        line: &str,
        memory: &Memory,
    ) -> Result<Option<Corrected>, Error> {
        if conditional(line).is_some() || hinged(line).is_some() {
            return Ok(None);
        }
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.corrected(&dashed(line), memory))
    }

    /// An order with the names of what it only points at: see [`Asker::with_pointed`].
    pub(super) fn with_pointed(
        &self,
        line: &str,
        memory: &Memory,
    ) -> Result<Result<Option<String>, Box<Unanswered>>, Error> {
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.with_pointed(line, memory))
    }

    /// Notes that an order came to nothing yet, as [`Asker::leave_open`].
    pub(super) fn leave_open(&self, order: &str, memory: &mut Memory) -> Result<(), Error> {
        let senses = RobotSenses { engine: self };
        self.asker(&senses)?.leave_open(order, memory);
        Ok(())
    }

    /// The things that come nearest to a description that nothing fits, as [`Asker::nearest`].
    pub(super) fn substitutes(
        &self,
        noun: &Noun,
        language: Language,
    ) -> Result<Vec<ReplicaId>, Error> {
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.nearest(noun, language))
    }

    /// Notes what a sentence speaks of that neither asks nor orders.
    pub(super) fn hear_of(&self, text: &str, memory: &mut Memory) -> Result<(), Error> {
        self.catch_up(memory)?;
        let senses = RobotSenses { engine: self };
        self.asker(&senses)?.hear_of(text, memory);
        Ok(())
    }

    /// A command that waited for an answer, with what these words choose; none where they choose nothing.
    ///
    /// # Errors
    /// As [`State::ask`].
    pub fn resumed(&self, text: &str, memory: &Memory) -> Result<Option<String>, Error> {
        let mut memory = memory.clone();
        self.catch_up(&mut memory)?;
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.resumed(text, &memory))
    }

    /// Whether a text asks or commands, by how it begins.
    ///
    /// # Errors
    /// As [`State::ask`].
    pub fn is_command(&self, text: &str) -> Result<bool, Error> {
        let senses = RobotSenses { engine: self };
        let asker = self.asker(&senses)?;
        let asks = asker.begins_as_question(text);
        let lines = &self.rules.paraphrases();
        // "Give me directions to the fridge" begins as an order does.
        Ok((!asks && is_command(text, lines))
            || (is_order_by(text, lines) && !asker.asks_to_tell(text)))
    }

    /// Whether a text asks behind what a person tells of itself, and is understood so: "I need the battery, where is it?"
    ///
    /// # Errors
    /// As [`State::ask`].
    pub(super) fn asks_behind_what_is_told(
        &self,
        text: &str,
        memory: &Memory,
    ) -> Result<bool, Error> {
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.asks_behind_what_is_told(text)
            && self.ask(text, &mut memory.clone())?.is_ok())
    }

    /// Whether a text asks by a word of its own, and so orders nothing.
    ///
    /// # Errors
    /// As [`State::ask`].
    pub(super) fn asks_by_a_word(&self, text: &str) -> Result<bool, Error> {
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.asks_by_a_word(text))
    }

    /// Whether a text begins as a question does.
    ///
    /// # Errors
    /// As [`State::ask`].
    pub(super) fn asks_something(&self, text: &str) -> Result<bool, Error> {
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.begins_as_question(text))
    }

    /// What is to be heard one after the other: «Скажи, где ваза, и принеси её» is a question and an order, "Go to the
    /// bedroom and tell me what you see" an order and a question. None where the text is one or the other.
    ///
    /// # Errors
    /// As [`State::ask`].
    pub fn orders_and_questions(
        &self,
        text: &str,
        memory: &Memory,
    ) -> Result<Option<Vec<String>>, Error> {
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.orders_and_questions(text, memory))
    }

    pub(super) fn sentences_that_order_and_ask(
        &self,
        text: &str,
    ) -> Result<Option<Vec<String>>, Error> {
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.sentences_that_order_and_ask(text))
    }

    /// Whether a text without a verb orders: «К холодильнику!», "The medicine, please".
    ///
    /// # Errors
    /// As [`State::ask`].
    pub fn orders_tersely(&self, text: &str) -> Result<bool, Error> {
        let senses = RobotSenses { engine: self };
        Ok(self.asker(&senses)?.orders_tersely(text))
    }

    pub(super) fn asker<'a>(&'a self, senses: &'a RobotSenses<'a>) -> Result<Asker<'a>, Error> {
        let now = self.around()?;
        Ok(Asker { world: now.world(), relations: now.relations()?, mind: now.mind(), senses })
    }

    /// The nouns of the map, read when first asked for.
    pub(super) fn mind(&self) -> Result<&Mind, Error> {
        Ok(self.surveyed()?.mind())
    }

    /// Names that a person may type.
    ///
    /// # Errors
    /// There is no map.
    pub fn names(&self) -> Result<Vec<String>, Error> {
        let world = self.world()?;
        let english = world.names().map(|(entity, _)| english_name(world, entity).to_owned());
        let mut names: Vec<String> = self.mind()?.lexicon.names().map(str::to_owned).collect();
        names.extend(english.filter(|name| !name.is_empty()));
        names.order();
        names.dedup();
        Ok(names)
    }

    /// Where the robot is known to stand: as the store noted it last, else where the map lets it begin.
    pub(super) fn robot_pose(&self) -> Option<(MapId, Pose)> {
        let told = self.robot.get().copied();
        let stored = told.or_else(|| self.memory().ok()?.pose);
        match stored {
            Some((map, pose)) => Some((map, pose)),
            None => starting_pose(self.world().ok()?),
        }
    }
}

pub(super) struct RobotSenses<'e> {
    pub(super) engine: &'e State,
}

impl RobotSenses<'_> {
    fn world(&self) -> Option<&World> {
        self.engine.world_now().ok()
    }

    fn relations(&self) -> Option<&Relations> {
        self.engine.around().ok()?.relations().ok()
    }

    /// Where a thing is now, as an end of a way; the robot without one.
    fn located(&self, thing: Option<Thing>) -> Result<Option<Located>, Error> {
        let (engine, around) = (self.engine, self.engine.around()?);
        Ok(Some(match thing {
            Some(Thing::Entity(Entity::Door(door))) => {
                // Where the robot cannot stand before a door, the door's room is as far as it goes.
                let room = around.world().door_areas(door).first().copied();
                match (around.locate_entity(Entity::Door(door)), room) {
                    (Err(_), Some(room)) => around.locate_entity(Entity::Area(room))?,
                    (located, _) => located?,
                }
            }
            Some(Thing::Entity(entity)) => around.locate_entity(entity)?,
            Some(Thing::Robot) | None => match engine.robot_pose() {
                Some((map, pose)) => around.locate_point(map, pose.at)?,
                None => return Ok(None),
            },
            Some(Thing::Opening(id)) => {
                let openings = around.relations()?.openings();
                let Some(opening) = openings.opening(id) else { return Ok(None) };
                let Some(side) = opening.sides.iter().min_by_key(|side| side.area) else {
                    return Ok(None);
                };
                around.locate_point(opening.map, side.middle())?
            }
            Some(Thing::Window(_)) => return Ok(None),
        }))
    }

    fn journey(
        &self,
        around: &Known,
        from: Option<Thing>,
        to: Thing,
    ) -> Result<Option<Journey>, Error> {
        if let Thing::Entity(Entity::Map(map)) = to {
            return self.to_storey(around, from, map);
        }
        let (Some(start), Some(goal)) = (self.located(from)?, self.located(Some(to))?) else {
            return Ok(None);
        };
        let goal = (self.called(to), goal);
        around.journey_between(("", start), (&goal.0, goal.1), Method::Shortest).map(Some)
    }

    /// The shortest way to where a lift or stairs arrive on a storey.
    fn to_storey(
        &self,
        around: &Known,
        from: Option<Thing>,
        map: MapId,
    ) -> Result<Option<Journey>, Error> {
        let (world, Some(start)) = (around.world(), self.located(from)?) else {
            return Ok(None);
        };
        let stops = world.domain.lifts.iter().flat_map(|(_, stops)| stops);
        let here = stops.filter(|s| world.placement(s.area).is_some_and(|(m, _)| m == map));
        let mut best: Option<(f64, Journey)> = None;
        for stop in here {
            let goal = around.locate_entity(Entity::Area(stop.area))?;
            let name = world.name(Entity::Area(stop.area));
            let way = around.journey_between(("", start), (name, goal), Method::Shortest)?;
            let lengths: Option<f64> =
                way.legs.iter().map(|leg| leg.route.as_ref().ok().map(|r| r.length)).sum();
            let length = lengths.unwrap_or(f64::INFINITY);
            if best.as_ref().is_none_or(|(shortest, _)| length < *shortest) {
                best = Some((length, way));
            }
        }
        Ok(best.map(|(_, journey)| journey))
    }

    /// A way over what is known, or why there is none, in words.
    fn way_around(
        &self,
        around: &Known,
        from: Option<Thing>,
        to: Thing,
        language: Language,
        detail: Detail,
    ) -> Result<Way, String> {
        // From a storey one starts where one is on it.
        let here = self.engine.robot_pose().map(|(map, _)| Thing::Entity(Entity::Map(map)));
        let from = from.filter(|start| Some(*start) != here);
        if let Thing::Entity(Entity::Map(map)) = to
            && self.engine.robot_pose().is_some_and(|(here, _)| here == map)
            && from.is_none()
        {
            return Err(told!(language, "on-that-floor-already"));
        }
        if to.replica().is_some_and(|id| self.holder(id).is_some_and(|h| h.is_empty())) {
            return Err(told!(language, "it-is-in-my-hands"));
        }
        let journey = self.journey(around, from, to).map_err(|error| match (language, error) {
            (Language::English, Error::Request(_)) => {
                "the robot cannot stand at that place".to_owned()
            }
            (_, error) => error.to_string(),
        })?;
        let unknown = || told!(language, "the-place-is-unknown");
        let journey = journey.ok_or_else(unknown)?;
        let mut length = 0.0;
        for leg in &journey.legs {
            match &leg.route {
                Ok(route) => length += route.length,
                Err(no) => {
                    let world = around.world();
                    let why = no_way_in_words(world, no, language);
                    // A door that is shut and no more can be opened.
                    return Err(match only_shut(no) {
                        true => format!("{why}, {}", told!(language, "but-not-locked")),
                        false => why,
                    });
                }
            }
        }
        // Only of itself does the robot know how it stands.
        let own = matches!(from, None | Some(Thing::Robot));
        let heading = self.engine.robot_pose().filter(|_| own).map(|(_, pose)| pose.heading);
        let sentences = around.journey_in_words(&journey, heading, language, detail);
        let riding = journey.rides.iter().map(Ride::seconds).sum();
        let sentences = sentences.map_err(|e| e.to_string())?;
        let rooms = around.rooms_of(&journey).map_err(|e| e.to_string())?.ok_or_else(unknown)?;
        Ok(Way { length, riding, sentences, rooms })
    }

    fn called(&self, thing: Thing) -> String {
        match (thing, self.world()) {
            (Thing::Entity(entity), Some(world)) => world.name(entity).to_owned(),
            _ => String::new(),
        }
    }
}

/// Whether one closed door that is not locked is all that shuts a way off.
fn only_shut(no: &NoRoute) -> bool {
    let NoRoute::Blocked { barriers, .. } = no else { return false };
    matches!(&barriers[..], [Barrier::Door { status: DoorStatus::Closed, .. }])
}

impl Senses for RobotSenses<'_> {
    fn robot(&self) -> Option<(MapId, Pose)> {
        self.engine.robot_pose()
    }

    fn position(&self, language: Language, detail: Detail) -> Option<String> {
        let (map, pose) = self.engine.robot_pose()?;
        let facing = detail == Detail::Heading;
        let found = describe(self.world()?, self.relations()?, map, pose, facing)?;
        Some(found.position.say_in(language, detail))
    }

    fn way(
        &self,
        from: Option<Thing>,
        to: Thing,
        language: Language,
        detail: Detail,
    ) -> Result<Way, String> {
        let around = self.engine.around().map_err(|e| e.to_string())?;
        self.way_around(around, from, to, language, detail)
    }

    fn way_without(
        &self,
        from: Option<Thing>,
        to: Thing,
        avoided: &[Thing],
        language: Language,
    ) -> Result<Way, String> {
        let around = self.engine.around().map_err(|e| e.to_string())?;
        let without = around.without(avoided, to.area()).map_err(|e| e.to_string())?;
        self.way_around(&without, from, to, language, Detail::Region)
    }

    fn round(&self, things: &[Thing]) -> Vec<Thing> {
        let entity = |thing: &Thing| match thing {
            Thing::Entity(entity) => Some(*entity),
            _ => None,
        };
        let all: Option<Vec<Entity>> = things.iter().map(entity).collect();
        let order = all.and_then(|all| self.engine.round(&all));
        order
            .map_or_else(|| things.to_vec(), |order| order.into_iter().map(|n| things[n]).collect())
    }

    fn beyond_arm(&self, thing: ReplicaId) -> Option<f64> {
        let around = self.engine.around().ok()?;
        let (map, pose) = self.engine.robot_pose()?;
        let goal = around.locate_entity(Entity::Replica(thing)).ok()?;
        let floor = around.floor(goal.map).ok().filter(|_| goal.map == map)?;
        let world = around.uncarried();
        let way = floor.route(world, pose.at, goal.target, Method::Shortest).ok()?;
        let placed = floor.scene().replicas.get(&thing)?;
        let beyond = beyond_arm(placed, *way.points.last()?, world.robot.radius.get());
        Some(beyond).filter(|beyond| *beyond > 0.0)
    }

    fn visible(&self) -> Vec<ReplicaId> {
        let Some((map, pose)) = self.engine.robot_pose() else { return Vec::new() };
        let Ok(around) = self.engine.around() else { return Vec::new() };
        let world = around.world();
        let Ok(floor) = around.floor(map) else { return Vec::new() };
        let Ok(near) = around.relations().map(Relations::thresholds) else { return Vec::new() };
        things_in_view(world, floor, &robot_eye(world, floor, pose, near), near)
    }

    fn holder(&self, thing: ReplicaId) -> Option<String> {
        self.engine.around().ok()?.holders.get(&thing).cloned()
    }

    fn carrier(&self, thing: ReplicaId) -> Option<ReplicaId> {
        self.engine.around().ok()?.carriers.get(&thing).copied()
    }

    fn doubted(&self, thing: ReplicaId) -> Option<f64> {
        self.holder(thing).is_none().then(|| self.engine.doubted(thing)).flatten()
    }

    fn held(&self) -> Vec<ReplicaId> {
        let Ok(now) = self.engine.around() else { return Vec::new() };
        let own = now.holders.iter().filter(|(_, holder)| holder.is_empty());
        own.map(|(id, _)| *id).collect()
    }

    fn sightings(&self, thing: ReplicaId) -> Vec<Sighting> {
        let Some(reader) = &self.engine.reader else { return Vec::new() };
        let all = reader.observations(thing).unwrap_or_default();
        let sighting = |o: crate::store::Observation| Sighting {
            at: o.at.in_words(),
            place: o.seen.map(|Seen { area, .. }| area),
        };
        all.into_iter().map(sighting).collect()
    }

    fn changed(&self) -> Vec<News> {
        self.engine.news(std::time::SystemTime::now().into()).unwrap_or_default()
    }

    fn unseen(&self) -> (Vec<ReplicaId>, usize) {
        self.engine.unseen().unwrap_or_default()
    }

    fn sureness(&self, language: Language) -> Option<String> {
        self.engine.sureness(language).ok().flatten()
    }

    fn past(&self, thing: ReplicaId) -> Vec<Past> {
        self.engine.past(thing).unwrap_or_default()
    }
}
