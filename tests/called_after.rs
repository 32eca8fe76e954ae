//! "Is there a medicine cabinet?": what a thing is called after may be no thing near it, and what is not found under such a
//! name may be there under another. So it is never denied.

use orthoframe::engine::Memory;
use orthoframe_language::question::Said;

use crate::talk::engine;

const MAPS: [&str; 3] = [
    "maps/rb2.toml",
    "../shared/data/procthor/house_6.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
];

const NOUNS: [&str; 14] = [
    "book", "cup", "bowl", "apple", "bottle", "pillow", "lamp", "knife", "table", "bed", "chair",
    "cabinet", "box", "plate",
];

#[test]
fn what_is_called_after_another_thing_is_never_denied() {
    let (mut asked, mut found) = (0, 0);
    for map in MAPS {
        let Some(engine) = engine(map) else { continue };
        for first in NOUNS {
            for head in NOUNS.iter().filter(|head| **head != first) {
                for question in [
                    format!("Is there a {first} {head}?"),
                    format!("Where is the {first} {head}?"),
                    format!("Is the {first} {head} white?"),
                ] {
                    asked += 1;
                    let answer = engine.ask(&question, &mut Memory::default()).unwrap();
                    let Ok(answer) = answer else { continue };
                    found += 1;
                    let denied = answer.said == Said::Nothing
                        || answer.said == Said::No && question.starts_with("Is there");
                    assert!(!denied, "{question}: {}", answer.text);
                }
            }
        }
    }
    assert!(asked > 500 && found > 10, "{asked} {found}");
}

/// "Is there a wine glass?" was answered with bottles of glass.
#[test]
fn a_material_behind_a_noun_makes_a_name_of_both() {
    for map in MAPS {
        let Some(engine) = engine(map) else { continue };
        for noun in NOUNS {
            for material in ["glass", "paper", "metal", "plastic"] {
                let question = format!("Is there a {noun} {material}?");
                let answer = engine.ask(&question, &mut Memory::default()).unwrap();
                let Ok(answer) = answer else { continue };
                // A glass is a thing as well, of which it is said near what it stands.
                assert!(answer.text.contains(" near "), "{question}: {}", answer.text);
            }
        }
    }
}
