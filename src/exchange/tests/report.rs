//! What an import says of itself.

use orthoframe_exchange::{Report, What, Why};
use orthoframe_units::Language;

#[test]
fn like_notes_stand_together_and_the_file_s_ids_are_named() {
    let mut report = Report::new("Open-RMF", "office.building.yaml");
    report.found(What::Door, 3);
    report.taken(What::Door, 1);
    report.skipped(What::Door, "17", Why::NoRoom);
    report.skipped(What::Door, "18", Why::NoRoom);
    report.mended(What::Room, "pantry", Why::OutlineCrosses);
    expect_test::expect![[r#"
            Импорт «office.building.yaml», формат Open-RMF.
            Прочитано: дверей 1 из 3.
            Исправлено: 1.
              помещение «pantry»: контур пересекал сам себя; оставлена наибольшая часть
            Пропущено: 2.
              дверей: 2 (import::no_room)
                «17»: рядом нет ни одного помещения
                «18»: рядом нет ни одного помещения"#]]
    .assert_eq(&report.to_string());
    assert_eq!(report.to_json(Language::Russian)["notes"][0]["code"], "import::no_room");
    assert!(!report.is_clean());
}
