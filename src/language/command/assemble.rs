//! From clauses to commands: which argument is the thing, which the place, and whether each means one thing only.

use std::cell::RefCell;
use std::hash::Hash;
use std::ops::Range;

use super::clauses::{Clause, clauses};
use super::grammar::{Argument, Item, Reference, Sentence, items};
use super::misheard::WHITHER;
use super::roles::{cases_after, choose, direction, is_them, question, restores, within};
use super::vocabulary::{Haunt, Role, Verb};
use super::{Command, Facing, Listener, Misheard, Placement, Relation, Thing, gathered};
use crate::words::{Case, Hit, Language};

/// Reads a sentence into commands. See [`Listener::hear`].
pub(super) fn commands<T: Clone + Eq + Hash>(
    text: &str,
    listener: &Listener<'_, T>,
) -> Result<Vec<Command<T>>, Misheard> {
    let text = &gathered(text);
    let sentence = Sentence::new(text);
    if sentence.words.is_empty() {
        return Err(Misheard::Empty);
    }
    let items = items(&sentence, listener.index);
    let mut reader = Reader {
        sentence: &sentence,
        listener,
        last: listener.last.clone(),
        has_named: false,
        is_mass: false,
        open: RefCell::new(listener.meant.clone()),
    };
    // «Стоп, не едь!» must stop, whatever else is in the sentence; «подъедь к двери и остановись» only ends so, and what
    // is ordered behind it is an order of its own.
    let is_stop = |item: &Item<'_, T>| matches!(item, Item::Verb(Verb::Stop | Verb::Needless, _));
    let ends_so =
        matches!(&items[..], [first, .., Item::And, last] if is_stop(last) && !is_stop(first));
    if let Some(stop) = items.iter().rposition(is_stop).filter(|_| !ends_so) {
        // «Принеси чашки, а в гостиной не надо»: what is let be is no reason to let all be.
        if let [.., Item::Argument(_), Item::Verb(Verb::Needless, words)] = &items[..=stop]
            && items[..stop].iter().any(|item| matches!(item, Item::Verb(..)))
        {
            return Err(reader.apart(words));
        }
        let mut commands = vec![Command::Stop];
        commands.extend(reader.read(&items[stop + 1..]).unwrap_or_default());
        return Ok(commands);
    }
    let items = if ends_so { &items[..items.len() - 2] } else { &items[..] };
    reader.read(items)
}

impl<T: Clone + Eq + Hash> Reader<'_, '_, T> {
    /// What items order, clause by clause.
    fn read(&mut self, items: &[Item<'_, T>]) -> Result<Vec<Command<T>>, Misheard> {
        if let Some(Item::Not(words)) = items.iter().find(|item| matches!(item, Item::Not(_))) {
            let (_, at) = self.shown(words);
            return Err(Misheard::Forbidden { text: self.source(), at });
        }
        let mut commands = Vec::new();
        let mut fetched = Vec::new();
        for clause in clauses(self.sentence, items) {
            for command in self.clause(&clause)? {
                match (commands.last_mut(), command) {
                    // "Drive into the kitchen and face the window"
                    (Some(Command::GoTo { facing: facing @ None, .. }), Command::Face(seen)) => {
                        *facing = Some(seen);
                    }
                    (_, command) => {
                        let is_bare = match command {
                            Command::Bring { to: None, .. } => !clause.is_for_me(),
                            Command::PutAway(_) => true,
                            _ => false,
                        };
                        if is_bare {
                            fetched.push(commands.len());
                        }
                        commands.push(command);
                    }
                }
            }
        }
        // "Get the milk and put it in the fridge", "Clear the mug off the table and put it in the sink": it is got, or put
        // away, only to be put there.
        for at in fetched {
            let [command, later @ ..] = &mut commands[at..] else { continue };
            if let Command::Bring { what, .. } | Command::PutAway(what) = command
                && later.iter().any(|next| next.places(&what.id))
            {
                *command = Command::Take { what: what.clone() };
            }
        }
        Ok(commands)
    }
}

pub(super) struct Reader<'r, 't, T> {
    pub(super) sentence: &'r Sentence<'t>,
    pub(super) listener: &'r Listener<'r, T>,
    /// What a pronoun or an omitted object means.
    last: Vec<T>,
    /// Whether the sentence itself has named what they mean.
    has_named: bool,
    /// Whether one clause has named several, which "it" then means together: "Take everything off the table and put it on
    /// the counter". «Его» and «её» have a gender, and mean one.
    is_mass: bool,
    /// What is known to be meant, and was not found in the sentence yet.
    open: RefCell<Vec<T>>,
}

/// Arguments by the part that they play. A command takes out what it uses: what is left was said for nothing.
struct Roles<T> {
    objects: Vec<T>,
    at: Option<Placement<T>>,
    /// Whether that is where something comes from: «из кухни».
    whence: bool,
    to: Option<Placement<T>>,
    via: Option<T>,
    facing: Option<Facing<T>>,
    to_me: bool,
    on_floor: bool,
    with_key: bool,
    haunt: Option<Haunt>,
    listed: bool,
    /// Whether «всё» is all that was said of them, by a sentence that names nothing before.
    everything: bool,
    /// The words of the last argument of each part.
    said: Spans,
}

#[derive(Default)]
struct Spans {
    object: Range<usize>,
    at: Range<usize>,
    to: Range<usize>,
    via: Range<usize>,
    facing: Range<usize>,
}

impl<T> Roles<T> {
    /// The words of what no command has used; empty where only the verb can be blamed.
    fn left(&self) -> Option<Range<usize>> {
        let said = &self.said;
        let parts = [
            (!self.objects.is_empty(), &said.object),
            (self.at.is_some(), &said.at),
            (self.to.is_some(), &said.to),
            (self.via.is_some(), &said.via),
            (self.facing.is_some(), &said.facing),
            (self.on_floor || self.with_key || self.haunt.is_some(), &(0..0)),
        ];
        parts.into_iter().find(|(is_left, _)| *is_left).map(|(_, words)| words.clone())
    }
}

impl<T: Clone + Eq + Hash> Reader<'_, '_, T> {
    fn clause(&mut self, clause: &Clause<'_, '_, T>) -> Result<Vec<Command<T>>, Misheard> {
        let Some((verb, words)) = clause.verb else { return Err(self.no_verb(clause)) };
        if verb == Verb::Unable {
            return Err(self.unable(words));
        }
        if let Some(strange) =
            clause.before.iter().find(|a| matches!(a.reference, Reference::Unknown))
        {
            let known_later = clause.after.iter().any(|a| a.link.is_none());
            if known_later
                || clause.before.len() > 1
                || clause.after.is_empty() && strange.link.is_some()
            {
                return Err(self
                    .not_understood(&strange.words, "слово лишнее или написано с ошибкой".into()));
            }
        }
        if let Some(dangling) = clause.dangling {
            let question = ("где или куда", "where");
            return Err(self.incomplete(dangling, question));
        }
        let verb = if clause.with_key && verb == Verb::Close { Verb::Lock } else { verb };
        // «Вернись домой», "go to your charger"; «отнеси чашку домой» says no place that a thing is put.
        if let (Verb::GoTo | Verb::Return | Verb::Move | Verb::Get | Verb::Leave, Some(haunt)) =
            (verb, clause.haunt)
            && let Some(commands) = self.to_haunt(haunt, clause)?
        {
            return Ok(commands);
        }
        let arguments: Vec<&Argument<'_, T>> =
            clause.before.iter().chain(&clause.after).copied().collect();
        let mut roles = self.roles(verb, &arguments)?;
        // «Положи её к ним»: what "they" are was not said, where it is the thing itself.
        if let Some(to) = &roles.to
            && roles.objects.contains(&to.anchor)
        {
            return Err(self.incomplete(&roles.said.to, ("о чём речь", "what you mean")));
        }
        roles.on_floor = clause.on_floor;
        let locks = matches!(verb, Verb::Lock | Verb::Unlock | Verb::Open);
        roles.with_key = clause.with_key && !locks;
        roles.haunt = clause.haunt;
        roles.listed = clause.listed;
        // "Take the book to the kitchen, then here", "go to the kitchen, here": to two places at once.
        let goes = matches!(verb, Verb::GoTo | Verb::Leave);
        if let Some(me) = clause.me
            && roles.to.is_some()
            && (clause.me_joined || goes)
        {
            return Err(self.apart(me));
        }
        if clause.to_wall {
            if roles.facing.is_some() {
                return Err(self.apart(&roles.said.facing));
            }
            roles.facing = Some(Facing::Wall);
            roles.said.facing = words.clone();
        }
        let commands = self.command(verb, words, &mut roles)?;
        match roles.left() {
            None => Ok(commands),
            Some(left) if left.is_empty() => Err(self.apart(words)),
            Some(left) => Err(self.apart(&left)),
        }
    }

    /// A part of a sentence that its command has no use for: it is not passed over.
    fn apart(&self, words: &Range<usize>) -> Misheard {
        self.not_understood(words, "скажите это отдельно".into())
    }

    /// To a place of the robot's own, through what is named; none where another place is named.
    fn to_haunt(
        &self,
        haunt: Haunt,
        clause: &Clause<'_, '_, T>,
    ) -> Result<Option<Vec<Command<T>>>, Misheard> {
        let mut commands = Vec::new();
        for argument in clause.before.iter().chain(&clause.after) {
            match (argument.link, &argument.reference) {
                (_, Reference::Me) => {}
                (Some(link), _) if link.role == Role::Via => {
                    let place = self.resolve(argument, cases_after(link))?;
                    commands.push(Command::GoThrough(place));
                }
                (Some(link), _) if link.role != Role::Whither => {
                    return Err(self.apart(&argument.words));
                }
                _ => return Ok(None),
            }
        }
        commands.push(match haunt {
            Haunt::Charger => Command::Charge,
            Haunt::Home => Command::GoHome,
        });
        Ok(Some(commands))
    }

    fn command(
        &mut self,
        verb: Verb,
        words: &Range<usize>,
        roles: &mut Roles<T>,
    ) -> Result<Vec<Command<T>>, Misheard> {
        let to_me = roles.to_me;
        let placed = roles.to.is_some() || roles.at.is_some();
        let on_floor = roles.on_floor
            && matches!(verb, Verb::Put | Verb::Move | Verb::Clear | Verb::Leave | Verb::SetDown);
        roles.on_floor &= !on_floor;
        let named = !roles.objects.is_empty();
        let clears = verb == Verb::Clear;
        let fixed = |thing: &T| self.listener.fixed.is_some_and(|fixed| fixed(thing));
        // «Обойди стол» goes around it.
        let is_room = |thing: &T| self.listener.rooms.is_some_and(|is_room| is_room(thing));
        if verb == Verb::Visit && (!roles.objects.iter().all(is_room) || !named || placed) {
            return Err(self.unable(words));
        }
        let verb = match verb {
            Verb::Visit => Verb::GoTo,
            // «Верни всё на место», «убери всё»: whatever is not where it belongs.
            _ if roles.everything => Verb::Tidy,
            Verb::Put | Verb::Move | Verb::Clear | Verb::Leave if on_floor => Verb::SetDown,
            // «Подожди в коридоре»
            Verb::Wait if placed => Verb::GoTo,
            Verb::SetDown if !on_floor && placed => Verb::Put,
            Verb::Move | Verb::Get if !named => Verb::GoTo,
            Verb::Move => Verb::Put,
            Verb::Get => Verb::Bring,
            // "Return the book to the shelf", «верни книгу»; "return to the kitchen", «вернись».
            Verb::Return if !named && placed => Verb::GoTo,
            Verb::Return if to_me && named => Verb::Bring,
            Verb::Return | Verb::PutBack if roles.to.is_some() && named => Verb::Put,
            Verb::Return if named => Verb::PutBack,
            Verb::Return => return Ok(vec![Command::ComeBack]),
            // «Выйди в коридор»; "leave the book on the table"
            Verb::Leave if roles.to.is_some() && !named => Verb::GoTo,
            Verb::Leave if placed && named => Verb::Put,
            // What is put away without a place goes to where it is kept; what stays is cleared of what is on it.
            Verb::Clear if roles.to.is_none() && named => {
                if roles.objects.iter().all(fixed) {
                    Verb::Tidy
                } else {
                    Verb::Clear
                }
            }
            verb => verb,
        };
        // "Take me to the kitchen": a person is nothing to be carried.
        if to_me
            && !named
            && roles.to.is_some()
            && matches!(verb, Verb::Bring | Verb::Take | Verb::Put)
        {
            return Err(self.unable(words));
        }
        // «Позови оператора на кухню»: from there. What else is named with such a verb says something that it does not do.
        let alone = match verb {
            Verb::CallOperator => Some(Command::CallOperator),
            Verb::Report => Some(Command::Report),
            Verb::CallLift => Some(Command::CallLift),
            _ => None,
        };
        if let Some(command) = alone {
            let there = match verb {
                Verb::CallLift => None,
                _ => roles.to.take().or_else(|| roles.at.take()),
            };
            let there = there.map(|to| Command::GoTo {
                to,
                via: roles.via.take(),
                facing: roles.facing.take(),
            });
            return Ok(there.into_iter().chain([command]).collect());
        }
        let carried = |thing: &T| self.listener.fixed.is_some() && !fixed(thing);
        // "Clear the sofa onto the bed"
        if clears
            && roles.to.is_some()
            && roles.objects.iter().all(fixed)
            && (named || roles.whence)
        {
            let to = roles.to.take();
            let at = if named { None } else { roles.at.take() };
            let objects = at.into_iter().map(|place| place.anchor).chain(roles.objects.drain(..));
            return Ok(objects.map(|from| Command::Clear { from, to: to.clone() }).collect());
        }
        match verb {
            Verb::Stop | Verb::Needless => return Ok(vec![Command::Stop]),
            Verb::Face => {
                let facing = roles.facing.take();
                let facing = facing.ok_or_else(|| self.incomplete(words, question(verb)))?;
                return Ok(vec![Command::Face(facing)]);
            }
            Verb::Charge => return Ok(vec![Command::Charge]),
            // "Leave the cup": nothing carried is left by driving out of it.
            Verb::Leave if roles.objects.iter().any(carried) => {
                return Err(self.incomplete(words, ("где это оставить", "where to leave it")));
            }
            Verb::Leave => {
                let place = roles.at.take().map(|place| place.anchor);
                return Ok(vec![Command::Leave(place.or_else(|| roles.objects.pop()))]);
            }
            Verb::Wait => return Ok(vec![Command::Wait]),
            Verb::Tidy | Verb::Clean | Verb::Clear
                if roles.to.is_none() && (verb != Verb::Clear || !named) =>
            {
                let done = |place: Option<T>| match (verb, place) {
                    (Verb::Clean, place) => Command::Clean(place),
                    (_, Some(place)) if clears && (named || roles.whence) => {
                        Command::Clear { from: place, to: None }
                    }
                    (_, place) => Command::Tidy(place),
                };
                // "Tidy the table in the kitchen": the place tells which.
                let at = if named { None } else { roles.at.take() };
                let at = at.map(|place| place.anchor);
                let objects = std::mem::take(&mut roles.objects);
                let places: Vec<_> = at.into_iter().chain(objects).map(Some).map(done).collect();
                return Ok(if places.is_empty() { vec![done(None)] } else { places });
            }
            // «Съезди на кухню и в спальню» is two verbs; «на кухню и спальню» has one preposition.
            // "Visit the kitchen, the bath and the hall": one after the other.
            Verb::GoTo
                if named
                    && roles.listed
                    && roles.via.is_none()
                    && (roles.to.is_some() || roles.objects.len() > 1 && !placed) =>
            {
                let facing = roles.facing.take();
                let objects = std::mem::take(&mut roles.objects).into_iter();
                let to = roles.to.take().into_iter().chain(objects.map(|anchor| {
                    let relation = Relation::At;
                    Placement::new(relation, anchor)
                }));
                let to = to.map(|to| Command::GoTo { to, via: None, facing: facing.clone() });
                return Ok(to.collect());
            }
            Verb::GoTo if roles.to.is_some() && named => {
                let hint = "эта команда ничего с собой не везёт; может быть, «отвези … в …»?";
                return Err(self.not_understood(words, hint.into()));
            }
            Verb::GoTo => {
                // "Stand in the corridor between the doors": the first place tells where the second is.
                if !roles.whence
                    && let Some(outer) = roles.at.take_if(|_| roles.to.is_some())
                {
                    let anchor = outer.anchor;
                    within(&mut roles.to, anchor).ok_or_else(|| self.apart(&roles.said.at))?;
                }
                // "Go Room-Y", «Езжай Комната-Y», «Поезжай в Комнате-Y»: no other reading, so it is no guess.
                let bare = |anchor: T| Placement::new(Relation::At, anchor);
                let to = roles.to.take().or_else(|| roles.at.take());
                let to = to.or_else(|| roles.objects.pop().map(bare));
                let (via, facing) = (roles.via.take(), roles.facing.take());
                let seen = match &facing {
                    Some(Facing::Thing(thing)) => Some(bare(thing.clone())),
                    _ => None,
                };
                let to = to.or(seen);
                if let (None, None, Some(facing)) = (&to, &via, &facing) {
                    return Ok(vec![Command::Face(facing.clone())]);
                }
                return match (to, via) {
                    (Some(to), via) => {
                        // "Go to the fridge and open it"; the book of «Возьми книгу, поезжай на кухню и положи её» stays.
                        if !self.has_named {
                            self.last = vec![to.anchor.clone()];
                        }
                        Ok(vec![Command::GoTo { to, via, facing }])
                    }
                    (None, Some(door)) => Ok(vec![Command::GoThrough(door)]),
                    (None, None) if to_me => Ok(vec![Command::ComeHere]),
                    (None, None) => Err(self.incomplete(words, ("куда ехать", "where to go"))),
                };
            }
            _ => {}
        }
        let mut objects = std::mem::take(&mut roles.objects);
        if objects.is_empty() {
            let spoken = if self.has_named { 0 } else { self.last.len().saturating_sub(1) };
            objects.extend(self.last[spoken..].iter().cloned());
        }
        if objects.is_empty() {
            return Err(self.incomplete(words, question(verb)));
        }
        self.last.clone_from(&objects);
        self.has_named = true;
        self.is_mass = objects.len() > 1;
        if verb == Verb::SetDown {
            let within = roles.to.take().or_else(|| roles.at.take()).map(|place| place.anchor);
            let down = |id| Command::SetDown {
                what: Thing { id, at: None, toward: None },
                within: within.clone(),
            };
            return Ok(objects.into_iter().map(down).collect());
        }
        if verb == Verb::Put && roles.to.is_none() {
            // "Put the book on the table": on and in are whither here.
            roles.to = roles.at.take();
        }
        let (at, to) = (roles.at.take(), roles.to.take());
        objects
            .into_iter()
            .map(|id| {
                self.one(verb, words, Thing { id, at: at.clone(), toward: None }, to.clone(), to_me)
            })
            .collect()
    }

    fn one(
        &self,
        verb: Verb,
        words: &Range<usize>,
        what: Thing<T>,
        to: Option<Placement<T>>,
        to_me: bool,
    ) -> Result<Command<T>, Misheard> {
        Ok(match (verb, to) {
            (Verb::Bring | Verb::Need, to) => Command::Bring { what, to },
            (Verb::Take, to @ Some(_)) => Command::Bring { what, to },
            (Verb::Take, None) if to_me => Command::Bring { what, to: None },
            (Verb::Take, None) => Command::Take { what },
            (Verb::Put | Verb::Clear | Verb::ThrowAway, Some(to)) => Command::Put { what, to },
            (Verb::ThrowAway, None) => Command::ThrowAway(what),
            (Verb::Put, None) if to_me => Command::Bring { what, to: None },
            (Verb::PutBack, _) => Command::PutBack(what),
            (Verb::Clear, None) => Command::PutAway(what),
            // «Возьми чашку. – Поставь её»: what is in the hand can be set down.
            (Verb::Put, None) if self.listener.held.is_some_and(|held| held(&what.id)) => {
                Command::SetDown { what, within: None }
            }
            (Verb::Put, None) => {
                return Err(self.incomplete(words, WHITHER));
            }
            // «дверь из кухни в коридор»: the place belongs to the thing.
            (Verb::Open, toward) => Command::Open(Thing { toward, ..what }),
            (Verb::Close, toward) => Command::Close(Thing { toward, ..what }),
            (Verb::Lock, toward) => Command::Lock(Thing { toward, ..what }),
            (Verb::Unlock, toward) => Command::Unlock(Thing { toward, ..what }),
            (Verb::SwitchOn, toward) => Command::SwitchOn(Thing { toward, ..what }),
            (Verb::SwitchOff, toward) => Command::SwitchOff(Thing { toward, ..what }),
            (Verb::Find, toward) => Command::Find(Thing { toward, ..what }),
            _ => return Err(self.incomplete(words, question(verb))),
        })
    }

    /// Gives every argument its part. Places first, since they narrow what the thing may be.
    fn roles(&self, verb: Verb, arguments: &[&Argument<'_, T>]) -> Result<Roles<T>, Misheard> {
        let mut roles = Roles {
            objects: vec![],
            at: None,
            whence: false,
            to: None,
            via: None,
            facing: None,
            to_me: false,
            on_floor: false,
            with_key: false,
            haunt: None,
            listed: true,
            everything: false,
            said: Spans::default(),
        };
        let mut latest_is_to = None;
        let mut others: Vec<T> = Vec::new();
        let mut seconds: Vec<usize> = Vec::new();
        for (n, argument) in arguments.iter().enumerate() {
            let Some(link) = argument.link else {
                roles.to_me |= matches!(argument.reference, Reference::Me);
                continue;
            };
            if matches!(argument.reference, Reference::Me) {
                roles.to_me = true;
                continue;
            }
            // "Go to them": to each, one after the other.
            if verb == Verb::GoTo
                && link.relation == Relation::At
                && is_them(argument, link, &self.sentence.text[self.sentence.span(&argument.words)])
                && let [before @ .., _] = &self.last[..]
            {
                others.extend_from_slice(before);
            }
            let anchor = match self.resolve(argument, cases_after(link)) {
                // «Выйди из комнаты»: whichever it is, the robot is in it.
                Err(Misheard::Ambiguous { .. })
                    if verb == Verb::Leave && link.role == Role::Whence =>
                {
                    continue;
                }
                resolved => resolved?,
            };
            // Of two of one part the first would be forgotten.
            let again = || self.apart(&argument.words);
            let mut place = Placement::new(link.relation, anchor);
            match link.relation {
                Relation::Facing => {
                    if roles.facing.replace(Facing::Thing(place.anchor)).is_some() {
                        return Err(again());
                    }
                    roles.said.facing = argument.words.clone();
                    continue;
                }
                // «между столом и диваном»: the second has no preposition of its own.
                Relation::Between => {
                    let second = arguments.get(n + 1).filter(|second| second.link.is_none());
                    let second = second.ok_or_else(|| {
                        self.incomplete(
                            &argument.words,
                            ("между чем ещё", "what else it is between"),
                        )
                    })?;
                    place.and = Some(self.resolve(second, cases_after(link))?);
                    seconds.push(second.words.start);
                }
                _ => {}
            }
            let role = direction(verb, link, argument);
            match (role, latest_is_to) {
                (Role::Via, _) => {
                    if roles.via.replace(place.anchor).is_some() {
                        return Err(again());
                    }
                    roles.said.via = argument.words.clone();
                    continue;
                }
                // «со стола в кухне»: a place said after a place is where that place is.
                (Role::Where | Role::Whither, Some(true)) => {
                    within(&mut roles.to, place.anchor).ok_or_else(again)?;
                }
                (Role::Where | Role::Whence, Some(false)) => {
                    within(&mut roles.at, place.anchor).ok_or_else(again)?;
                }
                (Role::Where | Role::Whence | Role::WhereOrWhither, _) => {
                    if roles.at.replace(place).is_some() {
                        return Err(again());
                    }
                    roles.said.at = argument.words.clone();
                    roles.whence = role == Role::Whence;
                    latest_is_to = Some(false);
                }
                (Role::Whither, _) => {
                    if roles.to.replace(place).is_some() {
                        return Err(again());
                    }
                    roles.said.to = argument.words.clone();
                    latest_is_to = Some(true);
                }
            }
        }
        let named = |a: &&&Argument<'_, T>| {
            let second = seconds.contains(&a.words.start);
            a.link.is_none() && !second && !matches!(a.reference, Reference::Me)
        };
        let objects: Vec<_> = arguments.iter().filter(named).collect();
        let is_everything = |a: &&&Argument<'_, T>| matches!(a.reference, Reference::Everything);
        let says_whither = roles.to.is_some() || roles.to_me;
        if restores(verb)
            && !self.has_named
            && !says_whither
            && !objects.is_empty()
            && objects.iter().all(is_everything)
        {
            roles.everything = true;
            return Ok(roles);
        }
        for argument in objects {
            roles.said.object = argument.words.clone();
            let cases = [Case::Accusative, Case::Genitive, Case::Nominative];
            let objects = match &argument.reference {
                Reference::Known(hits) if argument.all => choose(hits, &cases),
                Reference::Known(hits) if verb == Verb::Find => {
                    let ids = choose(hits, &cases);
                    match self.listener.any.and_then(|any| any(&ids)) {
                        Some(chosen) => vec![chosen],
                        None => vec![self.resolve(argument, &cases)?],
                    }
                }
                // "Leave the room": whichever it is. What is left somewhere must be known.
                Reference::Known(_)
                    if verb == Verb::Leave && roles.at.is_none() && roles.to.is_none() =>
                {
                    self.resolve(argument, &cases).into_iter().collect()
                }
                Reference::Them | Reference::Everything if !self.last.is_empty() => {
                    self.last.clone()
                }
                Reference::Pronoun
                    if self.is_mass
                        && Language::of(
                            &self.sentence.text[self.sentence.span(&argument.words)],
                        ) == Language::English =>
                {
                    self.last.clone()
                }
                _ => vec![self.resolve(argument, &cases)?],
            };
            // "them both" is said twice of the same.
            let new = |id: &T| !roles.objects.contains(id);
            let objects: Vec<T> = objects.into_iter().filter(new).collect();
            roles.objects.extend(objects);
        }
        roles.objects.extend(others);
        Ok(roles)
    }

    /// The one thing that an argument means.
    fn resolve(&self, argument: &Argument<'_, T>, cases: &[Case]) -> Result<T, Misheard> {
        let hits = match &argument.reference {
            Reference::Known(hits) => hits,
            Reference::Pronoun | Reference::Them | Reference::Everything => {
                return self.last.last().cloned().ok_or_else(|| {
                    self.incomplete(&argument.words, ("о чём речь", "what you mean"))
                });
            }
            Reference::Unknown | Reference::Me => return Err(self.unknown(argument)),
        };
        let ids = choose(hits, cases);
        if let [only] = &ids[..] {
            return Ok(only.clone());
        }
        let mut open = self.open.borrow_mut();
        if let Some(at) = open.iter().position(|meant| ids.contains(meant)) {
            return Ok(open.remove(at));
        }
        // «чашка или чашка?» tells nothing: then each by its title.
        let meant: Vec<&Hit<'_, T>> = hits.iter().filter(|hit| ids.contains(hit.id)).collect();
        let alike = meant.iter().any(|hit| hit.name == meant[0].name && hit.id != meant[0].id);
        let candidates =
            meant.iter().map(|hit| if alike { hit.title } else { hit.name }.to_owned()).collect();
        let (reference, at) = self.shown(&argument.words);
        Err(Misheard::Ambiguous { reference, candidates, text: self.source(), at })
    }
}
