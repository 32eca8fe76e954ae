//! What rooms have, asked again of another thing: «В какой комнате нет дивана? А телевизора?», "Which room has the most
//! chairs? And paintings?"
//!
//! Invariant: whether rooms have a thing or lack it stays as it was asked.

use super::{Asker, Extreme, Noun, Query, Rel};

impl Asker<'_> {
    /// The question which rooms have something, of another thing; where rooms are compared by how many, of that.
    pub(super) fn another_had(&self, last: &Query, noun: &Noun) -> Option<Query> {
        let Query::Find(rooms) = last else { return None };
        let is_thing = !noun.head.kinds.is_empty() && !self.is_room(noun);
        let alone = noun.restrictions.is_empty() && noun.best.is_none() && noun.count.is_none();
        if !self.is_room(rooms) || !is_thing || !alone {
            return None;
        }
        let mut asked = rooms.clone();
        let most = |extreme| matches!(extreme, Extreme::Most | Extreme::Fewest);
        let had = match (&mut asked.best, &mut asked.restrictions[..]) {
            (Some(best), _) => best.anchor.as_deref_mut().filter(|_| most(best.extreme))?,
            (None, [has]) if has.rel == Rel::Has => match &mut has.anchors[..] {
                [had] => had,
                _ => return None,
            },
            _ => return None,
        };
        *had = Noun { plural: noun.plural || had.plural, indefinite: true, ..noun.clone() };
        Some(Query::Find(asked))
    }
}
