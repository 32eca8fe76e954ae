//! What a directive has done, in words: what was switched, found, put away, and who was called.

use crate::language::{Case, Language};
use crate::map::{Entity, World};
use crate::robot::{Deed, Directive};
use crate::semantics::predicate;

use super::OPERATOR;
use super::lexicon::named;

/// A sentence for each deed that the robot's position does not tell; motion and doors are told by that.
#[must_use]
pub fn deeds_in_words(world: &World, directive: &Directive, language: Language) -> Vec<String> {
    let is_russian = language == Language::Russian;
    let name = |name: &str| {
        let thing = world.find(name).into_iter().find(|e| matches!(e, Entity::Replica(_)));
        match thing.map(|e| named(world, e)) {
            Some(thing) if is_russian => thing.phrase().case(Case::Accusative),
            Some(thing) => thing.english(),
            None => name.to_owned(),
        }
    };
    let say = |ru: String, en: String| Some(if is_russian { ru } else { en });
    let sentence = |deed: &Deed| match deed {
        Deed::Switch { device, on } => {
            let device = name(device);
            let (ru, en) = if *on { ("включил", "on") } else { ("выключил", "off") };
            say(format!("Я {ru} {device}."), format!("I switched {en} {device}."))
        }
        Deed::Seek(thing) => {
            let thing = name(thing);
            say(format!("Я вижу {thing}."), format!("I see {thing}."))
        }
        Deed::Put { thing, .. } if directive.brings_about(predicate::IN_ITS_PLACE) => {
            let thing = name(thing);
            say(format!("Я вернул {thing} на место."), format!("I put {thing} back in its place."))
        }
        Deed::Call(person) => {
            let english = if person == OPERATOR { "Operator" } else { person };
            say(
                format!("{person}, подойдите, пожалуйста, ко мне."),
                format!("{english}, please come to me."),
            )
        }
        _ => None,
    };
    directive.deeds().iter().filter_map(sentence).collect()
}
