//! The commands of a sentence: heard, their names found on the map, and what of them is so already.

use std::borrow::Cow;

use crate::engine::error::both;
use crate::engine::located::{nowhere_on, spot_in_words};
use crate::engine::{Error, RequestError, State};
use crate::language::command::{
    self, Command, Facing, Listener, Misheard, Placement, Pointed, Relation, pointed, preamble,
    with_names_marked, without_another, without_clock, without_marks,
};
use crate::language::question::{
    Answer, Conditional, Corrected, Memory, Thing, Unanswered, conditional, hinged, unaddressed,
};
use crate::language::{Language, word_ranges};
use crate::map::Entity;
use crate::units::Point;

impl State {
    /// The commands of a sentence, with everything that it names found on the map.
    ///
    /// # Errors
    /// What was not understood, which candidates there are, or what the map lacks.
    pub fn understand(&self, sentence: &str) -> Result<Vec<Command<Entity>>, Error> {
        self.understand_in(sentence, &mut Memory::default())
    }

    /// The commands of a sentence in a dialogue: «её» is what was spoken of last.
    ///
    /// # Errors
    /// As [`State::understand`].
    pub fn understand_in(
        &self,
        sentence: &str,
        memory: &mut Memory,
    ) -> Result<Vec<Command<Entity>>, Error> {
        let corrected = match self.corrected(sentence, memory)? {
            None => Cow::Borrowed(sentence),
            Some(Corrected::Meant(meant)) => Cow::Owned(meant),
            Some(Corrected::Cancelled) => return Ok(vec![Command::Stop]),
            Some(Corrected::Unclear(words)) => {
                let language = Language::of(sentence);
                let unclear = Unanswered::uncorrected(&words, language);
                return Err(Misheard::NoneSuch(Box::new(unclear)).into());
            }
        };
        let sentence = &*unaddressed(&corrected);
        self.without_another(sentence)?;
        if let Some(conditional) = conditional(sentence) {
            return self.understood_if(&conditional, memory);
        }
        if let Some(hinged) = hinged(sentence) {
            return match memory.is_so().map(|so| hinged.given(so)) {
                Some(Some(order)) => self.understand_in(order, memory),
                Some(None) => Ok(vec![Command::Wait]),
                None => Err(Misheard::NoneSuch(Box::new(Unanswered::unasked(sentence))).into()),
            };
        }
        let before = memory.clone();
        let whole = self.understood(sentence, memory);
        let (Err(Error::Misheard(misheard)), Some((told, order))) = (&whole, preamble(sentence))
        else {
            return whole;
        };
        // What asks is no telling.
        let asks = self.asks_something(told)?;
        if asks || matches!(misheard, Misheard::WhichOf(_) | Misheard::Ambiguous { .. }) {
            return whole;
        }
        // «Там темно, включи свет»: what is told is only what the order may speak of.
        let mut after = before;
        self.hear_of(told, &mut after)?;
        match self.understood(order, &mut after) {
            Err(Error::Misheard(Misheard::UnknownName { .. } | Misheard::NotUnderstood { .. })) => {
                whole
            }
            understood => {
                *memory = after;
                understood
            }
        }
    }

    /// Refuses what another is told to do: who is called by a name that is no name of the map.
    ///
    /// # Errors
    /// [`Misheard::NotMe`]
    pub(in crate::engine) fn without_another(&self, sentence: &str) -> Result<(), Error> {
        let forms = self.forms()?;
        let is_named = |name: &str| {
            let words = word_ranges(name);
            forms.length_at(name, &words, 0) == words.len()
        };
        Ok(without_another(sentence, is_named)?)
    }

    /// The commands of what is to be done as the world now is; to stay, where that is nothing.
    fn understood_if(
        &self,
        conditional: &Conditional,
        memory: &mut Memory,
    ) -> Result<Vec<Command<Entity>>, Error> {
        let mut commands = match &conditional.first {
            Some(first) => self.understood(first, memory)?,
            None => Vec::new(),
        };
        let holds = self
            .holds(conditional, memory)?
            .map_err(|unanswered| Error::from(Misheard::NoneSuch(Box::new(unanswered))))?;
        let order = if holds.0 { &conditional.then } else { &conditional.otherwise };
        match order {
            Some(order) => commands.extend(self.understand_in(order, memory)?),
            None if commands.is_empty() && conditional.also.is_none() => {
                commands.push(Command::Wait)
            }
            None => {}
        }
        if let Some(also) = &conditional.also {
            commands.extend(self.understand_in(also, memory)?);
        }
        Ok(commands)
    }

    /// Whether a condition holds, with the answer that says so; else why that is not known.
    ///
    /// # Errors
    /// As [`State::ask`].
    pub(in crate::engine) fn holds(
        &self,
        conditional: &Conditional,
        memory: &mut Memory,
    ) -> Result<Result<(bool, Answer), Unanswered>, Error> {
        if let Some(about) = &conditional.about {
            // What cannot be done may be spoken of all the same.
            let mut heard = memory.clone();
            match self.understood(about, &mut heard) {
                Ok(_) => *memory = heard,
                Err(_) => self.hear_of(about, memory)?,
            }
        }
        let answered = self.ask(&conditional.question, memory)?;
        let held = answered.and_then(|answer| match answer.is_so() {
            Some(holds) => Ok((holds, answer)),
            None => Err(Unanswered::undecided(&conditional.question, answer)),
        });
        Ok(held.map_err(|unanswered| conditional.unknown(unanswered)))
    }

    fn understood(
        &self,
        sentence: &str,
        memory: &mut Memory,
    ) -> Result<Vec<Command<Entity>>, Error> {
        without_clock(sentence)?;
        let (sentence, spots) = self.rooms_for_points(sentence)?;
        let resolved = self.resolve(&with_names_marked(&sentence, self.forms()?), memory)?;
        let entity = |thing| match thing {
            Thing::Entity(entity) => Some(entity),
            _ => None,
        };
        let last = resolved.last.iter().copied().filter_map(entity).collect();
        let nearest = |all: &[Entity]| self.nearest(all);
        let meant = resolved.meant.iter().copied().filter_map(entity).collect();
        let world = self.world()?;
        let fixed = |entity: &Entity| match entity {
            Entity::Replica(id) => !world.has_trait(*id, "portable"),
            _ => true,
        };
        let own = self.held()?.map(|replica| Entity::Replica(replica.id));
        let held = |entity: &Entity| Some(*entity) == own;
        let listener = Listener::new(self.forms()?)
            .remembering(last)
            .knowing(meant)
            .choosing(&nearest)
            .clearing(&fixed)
            .visiting(&|entity| matches!(entity, Entity::Area(_)))
            .holding(&held);
        let windows: Vec<(Entity, Option<u32>)> =
            resolved.meant.iter().filter_map(|thing| self.gone_to(*thing)).collect();
        let resolved =
            with_names_marked(&without_marks(&resolved.text), self.forms()?).into_owned();
        let mut commands = match listener.hear(&resolved) {
            Ok(commands) => commands,
            Err(misheard) => {
                self.wait_for_a_name(&misheard, &resolved, memory)?;
                // What was spoken of may have left the map.
                if let Misheard::Incomplete { .. } = &misheard
                    && let Some(gone) = memory.lost_topic(Language::of(&resolved))
                {
                    return Err(Misheard::NoneSuch(Box::new(gone)).into());
                }
                return Err(misheard.quoted_from(&sentence).into());
            }
        };
        commands = self.each_cleared(commands)?;
        self.check_places(&commands)?;
        place_windows(&mut commands, &windows);
        if let Some((_, x, y)) = place_spots(&mut commands, spots) {
            let at = spot_in_words(f64::from(x), f64::from(y), "; ");
            return Err(RequestError::OnlyGoneTo { at }.into());
        }
        if let Some(here) = self.place_of_robot() {
            memory.stand(Thing::Entity(here));
            let to_person = |c: &Command<Entity>| matches!(c, Command::Bring { to: None, .. });
            if commands.iter().any(to_person) {
                memory.bring_to(Thing::Entity(here));
            }
        }
        // Where who calls is, only he can tell; the robot need not be with him.
        if let ([Command::ComeHere], None) = (&commands[..], self.person) {
            let Some(Thing::Entity(anchor)) = memory.place_of_speaker() else {
                return Err(Misheard::person_unknown(&resolved).into());
            };
            let to = Placement::new(Relation::At, anchor);
            commands = vec![Command::GoTo { to, via: None, facing: None }];
        }
        if let [Command::ComeBack] = commands[..] {
            if let Some(gone) = memory.lost_place(Language::of(&resolved)) {
                return Err(Misheard::NoneSuch(Box::new(gone)).into());
            }
            if let Some(Thing::Entity(anchor)) = memory.place_left() {
                let to = Placement::new(Relation::At, anchor);
                commands = vec![Command::GoTo { to, via: None, facing: None }];
            }
        }
        let named: Vec<Thing> = commands.iter().filter_map(thing_of).map(Thing::Entity).collect();
        let going = |command: &&Command<Entity>| matches!(command, Command::GoTo { .. });
        let carried = commands.iter().filter(|command| !going(command));
        let places = carried.filter_map(Command::place).map(|place| Thing::Entity(place.anchor));
        if !named.is_empty() {
            // "What is left on that stand?" is asked when nothing of it lies there any more.
            let relations = self.around()?.relations()?;
            let support = |thing: &Thing| relations.support_of(thing.replica()?);
            let whence = named.iter().filter_map(support).map(Entity::Replica).map(Thing::Entity);
            let whence: Vec<Thing> = whence.collect();
            memory.order(&named, &whence, &places.collect::<Vec<_>>());
        }
        Ok(commands)
    }

    /// "Clear the sofa onto the bed": what lies on the one is put on the other, each by itself.
    fn each_cleared(&self, commands: Vec<Command<Entity>>) -> Result<Vec<Command<Entity>>, Error> {
        if !commands.iter().any(|command| matches!(command, Command::Clear { to: Some(_), .. })) {
            return Ok(commands);
        }
        let around = self.around()?;
        let (world, relations) = (around.world(), around.relations()?);
        let mut told = Vec::new();
        for command in commands {
            let put = match &command {
                Command::Clear { from, to: Some(to) } => {
                    let names = self.lying_on(*from, relations)?;
                    let things = names.iter().flat_map(|name| world.find(name));
                    let put = |id| Command::Put {
                        what: command::Thing { id, at: None, toward: None },
                        to: to.clone(),
                    };
                    things.map(put).collect()
                }
                _ => Vec::new(),
            };
            if put.is_empty() {
                told.push(command);
            }
            told.extend(put);
        }
        Ok(told)
    }

    /// An order waits for the name that it lacks, and is what the next line amends: «На карте нет «лекарсво». Есть
    /// «Лекарство».» – «Да.»
    fn wait_for_a_name(
        &self,
        misheard: &Misheard,
        order: &str,
        memory: &mut Memory,
    ) -> Result<(), Error> {
        let world = self.world()?;
        let meant = match misheard {
            Misheard::UnknownName { near, at, .. } if near.len() == 1 => Some((near, at)),
            Misheard::Ambiguous { candidates, at, .. } => Some((candidates, at)),
            _ => None,
        };
        if let Some((names, at)) = meant {
            let named = |name: &String| match world.find(name)[..] {
                [only] => Some(Thing::Entity(only)),
                _ => None,
            };
            let at = at.offset()..at.offset() + at.len();
            if let Some(things) = names.iter().map(named).collect() {
                memory.wait(order, at, things, Language::of(order));
            }
        }
        self.leave_open(order, memory)
    }

    /// Where a thing or a place is said to be, there it must be: what no other part of a command has used is compared
    /// with the world as it is now, unless the sentence has moved the thing before.
    fn check_places(&self, commands: &[Command<Entity>]) -> Result<(), Error> {
        for (n, command) in commands.iter().enumerate() {
            let mut said: Vec<(Entity, Entity)> = Vec::new();
            if let Some(what) = command.what() {
                let moved = |c: &Command<Entity>| c.what().is_some_and(|w| w.id == what.id);
                let places = what.at.iter().chain(&what.toward);
                if !commands[..n].iter().any(moved) {
                    said.extend(places.map(|place| (what.id, place.anchor)));
                }
            }
            let place = command.place();
            said.extend(place.and_then(|place| Some((place.anchor, place.within?))));
            for (thing, place) in said {
                if !self.is_there(thing, place)? {
                    let world = self.world()?;
                    let both = |entity| both(world, entity);
                    let (thing, place) = (both(thing), both(place));
                    return Err(RequestError::NotThere { thing, place }.into());
                }
            }
        }
        Ok(())
    }

    /// Whether a thing or a place is in a room, or on or in another thing; a door is in the rooms that it joins.
    fn is_there(&self, thing: Entity, place: Entity) -> Result<bool, Error> {
        let around = self.around()?;
        let (world, relations) = (around.world(), around.relations()?);
        let on_map = |area| world.placement(area).map(|(map, _)| Entity::Map(map));
        let area = match thing {
            Entity::Replica(id) => {
                let mut below = relations.support_of(id);
                while let Some(support) = below {
                    if Entity::Replica(support) == place {
                        return Ok(true);
                    }
                    below = relations.support_of(support);
                }
                relations.area_of(id)
            }
            Entity::Place(id) => world.places.get(&id).map(|place| place.area),
            Entity::Area(area) => Some(area),
            Entity::Door(door) => {
                let joins = relations.joins();
                let joined = joins.iter().filter(|join| join.door == Some(door));
                let sides = joined.flat_map(|join| [join.from, join.to]);
                return Ok(sides
                    .into_iter()
                    .any(|side| Entity::Area(side) == place || on_map(side) == Some(place)));
            }
            Entity::Map(_) | Entity::Zone(_) => None,
        };
        Ok(area.is_some_and(|area| Entity::Area(area) == place || on_map(area) == Some(place)))
    }

    /// A sentence with the rooms in place of the points that it names by coordinates, and these in their order.
    fn rooms_for_points<'s>(&self, sentence: &'s str) -> Result<(Cow<'s, str>, Spots), Error> {
        let (mut told, mut rest, mut spots) = (String::new(), sentence, Spots::new());
        while let Some(Pointed { at, x, y, storey }) = pointed(rest) {
            let map = match (&storey, self.robot_pose()) {
                (None, Some((map, _))) => map,
                (storey, _) => self.map_named(storey.as_deref())?,
            };
            let point = Point::new(f64::from(x), f64::from(y));
            let around = self.around()?;
            let (world, floor) = (around.world(), around.floor(map)?);
            let area = floor.scene().area_at(point);
            let area = area.ok_or_else(|| nowhere_on(world, floor, point))?;
            let room = Entity::Area(area);
            spots.push((room, x, y));
            told.push_str(&rest[..at.start]);
            let name = world.name(room);
            told.push_str(&match Language::of(sentence) {
                Language::Russian => format!("в «{name}»"),
                Language::English => format!("to \"{name}\""),
            });
            rest = &rest[at.end..];
        }
        if spots.is_empty() {
            return Ok((Cow::Borrowed(sentence), spots));
        }
        told.push_str(rest);
        Ok((Cow::Owned(told), spots))
    }

    /// Of what a command means, a room, or the room of a window with the window's number.
    fn gone_to(&self, thing: Thing) -> Option<(Entity, Option<u32>)> {
        match thing {
            Thing::Entity(room @ Entity::Area(_)) => Some((room, None)),
            Thing::Window(n) => {
                let window = self.mind().ok()?.lexicon.windows.get(n as usize)?;
                Some((Entity::Area(window.area), Some(n)))
            }
            _ => None,
        }
    }

    /// Where the robot is, by what one can send it back to: a place of the map, else its room.
    fn place_of_robot(&self) -> Option<Entity> {
        let (map, pose) = self.robot_pose()?;
        let world = self.world().ok()?;
        let at = self.relations().ok()?.thresholds().robot_place;
        let place = world.places.values().find(|place| {
            let placed = world.placement(place.area);
            placed.is_some_and(|(on, frame)| {
                on == map && (frame.apply(place.at) - pose.at).norm() <= at
            })
        });
        let area = || self.relations().ok()?.measurements().area_at(map, pose.at);
        place.map(|p| Entity::Place(p.id)).or_else(|| area().map(Entity::Area))
    }

    /// Of several things the one nearest to the robot, in its own room before all others; the first where it is not
    /// known how far they are.
    fn nearest(&self, all: &[Entity]) -> Option<Entity> {
        let relations = self.around().ok()?.relations().ok()?;
        let (map, pose) = self.robot_pose()?;
        let here = relations.measurements().area_at(map, pose.at);
        let away = |entity: &Entity| match entity {
            Entity::Replica(id) => {
                let far = relations.distance_to_point(*id, map, pose.at).unwrap_or(f64::INFINITY);
                (relations.area_of(*id) != here, far)
            }
            _ => (true, f64::INFINITY),
        };
        let order = |a: &&Entity, b: &&Entity| {
            let ((here_a, far_a), (here_b, far_b)) = (away(a), away(b));
            here_a.cmp(&here_b).then(far_a.total_cmp(&far_b))
        };
        all.iter().min_by(order).copied()
    }
}

/// Points told by coordinates, each with the room in which it lies.
type Spots = Vec<(Entity, i32, i32)>;

/// A command that names a room for a point in it gets that back, in the order of the sentence; the first point that is left.
fn place_spots(commands: &mut [Command<Entity>], spots: Spots) -> Option<(Entity, i32, i32)> {
    let mut left = spots.into_iter().peekable();
    for command in commands {
        if let Command::GoTo { to, .. } = command
            && let Some((_, x, y)) = left.next_if(|(room, ..)| *room == to.anchor)
        {
            to.relation = Relation::Spot(x, y);
        }
    }
    left.next()
}

/// Windows have no names: a command that names a room for its window gets it back, in the order of the sentence.
fn place_windows(commands: &mut [Command<Entity>], meant: &[(Entity, Option<u32>)]) {
    let mut left = meant.to_vec();
    let mut window = |place: Entity, inside: bool| {
        let own = |(room, window): &(Entity, Option<u32>)| {
            *room == place && !(inside && window.is_some())
        };
        left.remove(left.iter().position(own)?).1
    };
    for command in commands {
        let facing = match command {
            Command::GoTo { to, facing, .. } => {
                if let Some(window) = window(to.anchor, to.relation == Relation::In) {
                    to.relation = Relation::AtWindow(window);
                }
                facing.as_mut()
            }
            Command::Face(facing) => Some(facing),
            _ => None,
        };
        if let Some(facing) = facing
            && let Facing::Thing(room) = facing
            && let Some(window) = window(*room, false)
        {
            *facing = Facing::Window(window);
        }
    }
}

/// What a command is about.
pub(in crate::engine) fn thing_of(command: &Command<Entity>) -> Option<Entity> {
    match command {
        Command::GoTo { to, .. } => Some(to.anchor),
        _ => command.what().map(|what| what.id),
    }
}
