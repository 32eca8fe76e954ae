//! The name that may have been meant where one is not known.

use crate::units::{Bilingual, name_key, nearest_name, said};

pub(super) fn hint<'a>(
    wanted: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<Bilingual> {
    nearest_name(wanted, known).map(|near| {
        if looks_the_same(near, wanted) {
            said!("perhaps-the-letters-look-the-same-but", near)
        } else {
            perhaps(near)
        }
    })
}

pub(super) fn perhaps(near: &str) -> Bilingual {
    said!("perhaps-2", near)
}

/// Whether two names differ only in the alphabet of letters that look alike, as В and B.
pub(super) fn looks_the_same(a: &str, b: &str) -> bool {
    fn latin(c: char) -> char {
        const CYRILLIC: &str = "авекмнорстухіј";
        const LATIN: &str = "abekmhopctyxij";
        match CYRILLIC.chars().position(|letter| letter == c) {
            Some(at) => LATIN.chars().nth(at).expect("both alphabets are of one length"),
            None => c,
        }
    }
    name_key(a).chars().map(latin).eq(name_key(b).chars().map(latin))
}
