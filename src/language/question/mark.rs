//! What the words of a question do in it, whichever words they are.

use super::query::{Closeness, Courtesy, Dimension, Extreme, Quantity, Rel};
use crate::report::Detail;

/// What a word or phrase does in a question.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    Where,
    /// «что», "what"
    What,
    /// «какой», "which"; in Russian also «каких», «каком».
    Which,
    HowMany,
    HowFar,
    /// «сколько времени», "how long does it take"
    HowLong,
    /// «как проехать», "how do I get"
    HowGet,
    How,
    /// «попасть», "get"
    Move,
    /// «куда»
    Whither,
    /// «откуда»
    Whence,
    /// "anything"
    Anything,
    As,
    /// «чем к», "than to"
    ThanTo,
    /// "nearest to"
    BestTo(Extreme),
    When,
    Why,
    WhyNot,
    Who,
    /// «каких размеров», "how tall"
    HowBig(Dimension),
    /// «есть», "is there"
    Exists,
    /// "is", "are", «находится», «стоит»
    Be,
    /// "have", «имеет»
    Have,
    /// «ведёт», "lead"
    Lead,
    /// «состоит из», "parts of"
    Parts,
    /// «сделан из», "made of"
    MadeOf,
    /// «расскажи про», "describe"
    Describe,
    /// «перечисли», "list"
    List,
    /// «посчитай», "count"
    Count,
    /// «видишь», "see"
    See,
    /// «видел в последний раз», "last seen"
    LastSeen,
    /// "last", of whatever was done.
    Last,
    /// «раньше», "before"
    Before,
    /// «свободно», «свободное место», "free space"
    Free,
    /// «сесть», "sit"
    Sit,
    /// «лечь», "lie down"
    LieDown,
    /// «положить», "put": where can one
    PutDown,
    /// «почитать», "drink from": what is done with things, by its number in `uses`
    Activity(u16),
    /// "can I", «можно»
    Can,
    /// «держишь», "holding"
    Hold,
    /// «взять в руку», "take in hand"
    Take,
    You,
    Me,
    Not,
    /// «без», "without": not having.
    Without,
    /// «не заходя в», "avoiding": not through.
    Avoiding,
    /// «не открывая дверей», "without opening a door"
    Unopened,
    /// «придётся открывать двери», "have to open any doors"
    MustOpen,
    /// «с какой стороны от», "which side of"
    Side,
    /// «придётся ли», "have to"
    Must,
    /// «нельзя»: not and can.
    Cannot,
    /// «отличаются», "differ"
    Differ,
    /// «общего», "in common"
    Alike,
    /// «сразу», "directly": from room to room.
    Directly,
    /// «чем занят»: what is on it or in it
    OccupiedBy,
    /// «взял», "took"
    Took,
    /// «переставили», "was moved"
    Moved,
    /// «не меньше», "at least": before a number
    Number(Quantity),
    /// «только один», "only one"
    OnlyOne,
    And,
    /// «но», "but", between what is said and what is otherwise
    But,
    Or,
    Than,
    All,
    /// «каждый», "every": of a kind, never the whole of one thing, as «вся» is.
    Each,
    /// «другой», "other"
    Other,
    /// «кроме», "except"
    Except,
    Link(Rel),
    Nearer(Closeness),
    Best(Extreme),
    /// «большой», "the big": of several the one that is most so.
    Grade(Extreme),
    /// «вторая» before «по величине», "second" before "biggest"
    Rank(u64),
    /// «что ты умеешь», "what can you do"
    Help,
    /// «что ты сделал», "what did you do"
    Did,
    /// «что изменилось», "what has changed"
    Changed,
    /// «что ты ещё не видел», "what have you not seen yet"
    Unseen,
    /// «насколько ты уверен, где ты», "how sure are you where you are"
    Sureness,
    /// «куда ты смотришь», "what are you facing"
    Heading,
    /// «подробно», "in detail"
    Detail(Detail),
    /// «больше», "bigger": of two
    More(Extreme),
    /// «снизу», "from the bottom": from where an ordinal counts.
    CountedFrom(Extreme),
    /// «если стоять к нему лицом», "when facing it": the thing of whose side is asked.
    FacingIt,
    /// «такого же цвета», "the same colour"
    Same,
    /// «виды», "kinds of"
    Kinds,
    /// «висит», "hangs": said of what is on a wall
    Hang,
    /// «открывает», "unlocks": what a key does
    Opens,
    Pronoun(Pronoun),
    /// «там», "there"
    There,
    /// «эти», "the listed": shows several of those that were told.
    These,
    /// «которые ты назвал», "you listed": says behind a noun that they were told.
    Listed,
    /// «всего», "altogether": asks for the sum.
    Total,
    /// «теперь», "now": asks anew what was asked before.
    Now,
    /// «во всём доме», "in the whole house": wherever it is.
    Everywhere,
    /// «спасибо»: nothing but polite, and what may stand beside it.
    Polite(Courtesy),
    BesidePolite,
    /// "um": a sound drawn out.
    Sound,
    /// "seriously", "btw": says nothing of the world.
    Interjection,
    /// «только»: a particle by which a sentence says less or more.
    Limits,
    /// The noun that an English adjective stands for: "the red one".
    One,
    A,
    The,
    /// «дружок», "dear": how somebody is spoken to, where commas part it from the rest.
    Called,
    /// "Wait", «постой»: who says so before a question is about to ask.
    Hesitates,
    /// «короче», "you know": a particle of speech that says nothing, where commas part it from the rest.
    Particle,
    /// "Who is right?", «Кто из нас прав?»: asked at the end of a line of two who say different things.
    WhoIsRight,
    /// "I mean", «то есть»: the same, but within a clause what follows takes the place of what stands before.
    Corrects,
    Filler,
}

impl Mark {
    /// Whether a word asks for something, or whether there is something.
    pub(super) fn asks(self) -> bool {
        matches!(
            self,
            Self::Where
                | Self::What
                | Self::Which
                | Self::HowMany
                | Self::HowFar
                | Self::HowGet
                | Self::HowBig(_)
                | Self::When
                | Self::Exists
                | Self::Who
                | Self::Whither
                | Self::Whence
        )
    }
}

/// Whom a pronoun may mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pronoun {
    He,
    /// «его», «нему»: masculine or neuter.
    HimOrIt,
    She,
    /// «неё», «ней»
    Her,
    It,
    They,
    /// English "it": of any gender.
    Any,
    /// «там», "there": the place spoken of, or that of the thing spoken of.
    There,
}
