//! Words that say nothing of the world, wherever they stand: sounds of hesitation, interjections, particles.
//!
//! Invariant: a word that limits or denies («только», "only") is none of them; the vocabulary of questions has those.

use super::mark::Mark;
use super::vocabulary;
use crate::sets::set;
use crate::words;

/// Whether a word, in [`name_key`](crate::units::name_key) form, that neither the map nor the vocabulary knows, may be left
/// out of any sentence.
pub(super) fn says_nothing(key: &str) -> bool {
    is_sound(key)
        || is(key, Mark::Interjection)
        || curses(key)
        || (!is(key, Mark::Limits) && words::says_nothing(key))
}

/// "um", "hmmm", «эээ», «ммм»: a sound drawn out.
fn is_sound(key: &str) -> bool {
    let mut short = String::new();
    for c in key.chars() {
        if !short.ends_with(c) {
            short.push(c);
        }
    }
    // A single letter may be a name.
    key.chars().count() > 1 && is(&short, Mark::Sound)
}

/// «эти чёртовы ключи»: an adjective that says only how the speaker feels.
fn curses(key: &str) -> bool {
    set!("Swearing").iter().any(|stem| key.starts_with(stem))
}

/// Whether the vocabulary has a word under a mark.
fn is(key: &str, mark: Mark) -> bool {
    vocabulary::taken_by(mark, std::slice::from_ref(&key.to_owned())).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sounds_and_particles_say_nothing() {
        for word in ["um", "ummm", "hmm", "ээ", "ммм", "maybe"] {
            assert!(says_nothing(word), "{word}");
        }
        for word in ["m", "only", "только", "не", "cup", "блин", "уж", "вчера", "red"]
        {
            assert!(!says_nothing(word), "{word}");
        }
    }

    #[cfg(feature = "rumorph")]
    #[test]
    fn the_dictionary_tells_particles() {
        for word in ["ведь", "аж", "дескать"] {
            assert!(says_nothing(word), "{word}");
        }
    }
}
