//! Texts that the program carries are the files. With the feature `packed` this holds what was packed to them.

use orthoframe_units::{Carried, carried};

macro_rules! of_sources {
    ($($name:literal),+) => {
        ([$(carried!("../../" $name)),+], [$(include_str!(concat!("../../", $name))),+])
    };
}

#[test]
fn a_text_that_is_carried_is_the_file() {
    let (carried, files): ([Carried; 4], [&str; 4]) = of_sources![
        "language/question/marks.txt",
        "serve/page/app.js",
        "serve/page/icon.svg",
        "recording/schemas/Event.json"
    ];
    for (carried, file) in carried.iter().zip(files) {
        assert_eq!(**carried, file);
    }
}
