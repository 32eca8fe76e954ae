//! Words that say nothing of the world, wherever they stand: sounds of hesitation, interjections, particles.
//!
//! Invariant: a word that limits or denies («только», "only") is none of them; the vocabulary of questions has those.

use crate::words;

/// Whether a word, in [`name_key`](crate::units::name_key) form, that neither the map nor the vocabulary knows, may be left
/// out of any sentence.
pub(super) fn says_nothing(key: &str) -> bool {
    is_sound(key)
        || is_interjection(key)
        || curses(key)
        || (!limits(key) && words::says_nothing(key))
}

/// "um", "hmmm", «эээ», «ммм»: a sound drawn out.
fn is_sound(key: &str) -> bool {
    const SOUNDS: [&str; 22] = [
        "um", "uh", "er", "erm", "hm", "m", "mhm", "ah", "oh", "eh", "aw", "э", "эм", "м", "хм",
        "гм", "ах", "ох", "ой", "эх", "уф", "ага",
    ];
    let mut short = String::new();
    for c in key.chars() {
        if !short.ends_with(c) {
            short.push(c);
        }
    }
    // A single letter may be a name.
    key.chars().count() > 1 && SOUNDS.contains(&short.as_str())
}

fn is_interjection(key: &str) -> bool {
    const SAID: [&str; 48] = [
        "seriously",
        "already",
        "hey",
        "hi",
        "hello",
        "hiya",
        "yo",
        "wow",
        "oops",
        "whoops",
        "gosh",
        "jeez",
        "damn",
        "darn",
        "dammit",
        "bloody",
        "yikes",
        "ugh",
        "phew",
        "kindly",
        "anyway",
        "anyhow",
        "maybe",
        "perhaps",
        "actually",
        "honestly",
        "basically",
        "literally",
        "simply",
        "mate",
        "buddy",
        "pal",
        "dude",
        "folks",
        "btw",
        "lol",
        "pls",
        "plz",
        "thx",
        "hopefully",
        "presumably",
        "apparently",
        "probably",
        "obviously",
        "definitely",
        "really",
        "gonna",
        "kinda",
    ];
    SAID.contains(&key)
}

/// «эти чёртовы ключи»: an adjective that says only how the speaker feels.
fn curses(key: &str) -> bool {
    ["чертов", "проклят", "дурацк", "треклят", "окаянн", "злосчастн"]
        .iter()
        .any(|stem| key.starts_with(stem))
}

/// Particles by which a sentence says less or more.
fn limits(key: &str) -> bool {
    const LIMITING: [&str; 12] = [
        "только",
        "лишь",
        "даже",
        "почти",
        "именно",
        "хоть",
        "едва",
        "ни",
        "не",
        "нет",
        "всего",
        "якобы",
    ];
    LIMITING.contains(&key)
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
