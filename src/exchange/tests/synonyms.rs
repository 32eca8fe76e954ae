//! Words of files and what they mean.

use std::path::Path;

use orthoframe_exchange::{Synonyms, Vocabulary};

#[test]
fn a_room_is_told_by_a_part_of_its_word_and_a_thing_is_not() {
    let table = Synonyms::built_in();
    let name = |word| table.find(Vocabulary::Object, word).map(|f| f.meaning.name.clone());
    assert_eq!(name("OfficeChair_Black-3").as_deref(), Some("Офисное кресло"));
    assert_eq!(name("big red mug").as_deref(), Some("Кружка"));
    // Of a head every compound is one, of any other noun none, and no word is told by what it is not a sort of.
    assert_eq!(name("Executive Chair").as_deref(), Some("Стул"));
    assert_eq!(name("Table-Dining Round w Chairs").as_deref(), Some("Стол"));
    for word in ["ShowerGlass", "cup holder", "chair lift", "desk with lamp", "garden chairs"] {
        assert_eq!(name(word), None, "{word}");
    }
    assert_eq!(name("Dining_Table_3").as_deref(), Some("Обеденный стол"));
    assert_eq!(name("chairs").as_deref(), Some("Стул"));
    assert_eq!(name("стул").as_deref(), Some("Стул"));
    assert_eq!(name("flux capacitor"), None);
    let room = table.find(Vocabulary::Area, "Bedroom 2").expect("a bedroom");
    assert!(room.is_whole);
    assert!(!table.find(Vocabulary::Area, "Anna bedroom").expect("a bedroom").is_whole);
}

#[test]
fn codes_hold_in_their_own_format_only() {
    let table = Synonyms::built_in();
    assert!(table.find(Vocabulary::Area, "E1-F2-MR").is_none());
    let table = table.of_format("osmag");
    let found = table.find(Vocabulary::Area, "E1-F2-MR").expect("a code");
    assert_eq!((found.meaning.name.as_str(), found.is_whole), ("Мужской туалет", false));
}

#[test]
fn a_user_s_table_lies_over_the_built_in_one() {
    let table = |text: &str| {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("synonyms.toml");
        std::fs::write(&path, text).expect("it is written");
        Synonyms::load(&path)
    };
    let text = r#"
            [[object]]
            name = "Стул"
            words = ["sitzding"]
            [[object]]
            name = "Каталка"
            name_en = "gurney"
            size = [60, 200, 90]
            [[model]]
            word = "AcmeGurney"
            is = "Каталка"
            size = [70, 190, 80]
        "#;
    let own = table(text).expect("sound");
    let find = |word| own.find(Vocabulary::Object, word).expect("known");
    assert_eq!(find("SitzDing").meaning.name, find("chair").meaning.name);
    assert!(find("chair").meaning.traits.contains(&"seat".to_owned()));
    assert_eq!(find("gurney").size, Some([60.0, 200.0, 90.0]));
    assert_eq!(find("AcmeGurney").size, Some([70.0, 190.0, 80.0]));

    for (spoilt, wants) in [
        ("[[object]]\nnam = \"Стул\"", "unknown field"),
        ("[[object]]\nname = \"Стул\"\nsize = [1, -2, 3]", "размеры"),
        ("[[model]]\nword = \"x\"\nis = \"Нечто\"", "нет типа"),
        ("[[code]]\nformat = \"osmag\"\nword = \"x\"\nis = \"Нечто\"", "нет типа"),
    ] {
        let error = table(spoilt).expect_err(spoilt);
        assert!(error.to_string().contains(wants), "{error}");
    }
}
