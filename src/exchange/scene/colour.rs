//! Colours and materials in words: properties ЦВЕТ and МАТЕРИАЛ.

use crate::synonyms::parts;

/// A colour whose channels differ by less has no hue.
const HUE: f64 = 0.12;

/// Names of the colours that people tell apart, those with a hue (of Berlin and Kay's eleven, and голубой), as sRGB.
const COLOURS: [(&str, [f64; 3]); 9] = [
    ("Красный", [0.8, 0.1, 0.1]),
    ("Оранжевый", [1.0, 0.55, 0.1]),
    ("Жёлтый", [0.95, 0.9, 0.15]),
    ("Зелёный", [0.15, 0.6, 0.2]),
    ("Голубой", [0.55, 0.8, 0.95]),
    ("Синий", [0.1, 0.2, 0.75]),
    ("Фиолетовый", [0.5, 0.15, 0.65]),
    ("Розовый", [1.0, 0.65, 0.75]),
    ("Коричневый", [0.45, 0.27, 0.12]),
];

/// English names that files use.
const ENGLISH: [(&str, &str); 16] = [
    ("black", "Чёрный"),
    ("gray", "Серый"),
    ("grey", "Серый"),
    ("white", "Белый"),
    ("red", "Красный"),
    ("orange", "Оранжевый"),
    ("yellow", "Жёлтый"),
    ("green", "Зелёный"),
    ("lightblue", "Голубой"),
    ("cyan", "Голубой"),
    ("blue", "Синий"),
    ("purple", "Фиолетовый"),
    ("violet", "Фиолетовый"),
    ("magenta", "Фиолетовый"),
    ("pink", "Розовый"),
    ("brown", "Коричневый"),
];

/// Materials by the word that asset names contain, lower case.
const MATERIALS: [(&str, &str); 16] = [
    ("wood", "Дерево"),
    ("metal", "Металл"),
    ("steel", "Металл"),
    ("glass", "Стекло"),
    ("ceramic", "Керамика"),
    ("porcelain", "Фарфор"),
    ("plastic", "Пластик"),
    ("fabric", "Ткань"),
    ("cloth", "Ткань"),
    ("leather", "Кожа"),
    ("marble", "Мрамор"),
    ("stone", "Камень"),
    ("tile", "Плитка"),
    ("brick", "Кирпич"),
    ("carpet", "Ковролин"),
    ("paper", "Бумага"),
];

/// The name of the colour nearest to an sRGB one, each channel 0..=1.
pub(super) fn of_rgb([r, g, b]: [f64; 3]) -> &'static str {
    let (dark, bright) = (r.min(g).min(b), r.max(g).max(b));
    if bright - dark < HUE {
        return match () {
            () if bright < 0.25 => "Чёрный",
            () if dark > 0.8 => "Белый",
            () => "Серый",
        };
    }
    // Green weighs most and red least: how well the eye tells shades apart.
    let far = |c: &[f64; 3]| {
        2.0 * (r - c[0]).powi(2) + 4.0 * (g - c[1]).powi(2) + 3.0 * (b - c[2]).powi(2)
    };
    COLOURS.iter().min_by(|x, y| far(&x.1).total_cmp(&far(&y.1))).expect("there are colours").0
}

/// The colour of an English name or of `#RRGGBB`.
pub(super) fn of_text(text: &str) -> Option<&'static str> {
    let word: String =
        text.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect();
    if let Some((_, name)) = ENGLISH.iter().find(|(english, _)| *english == word) {
        return Some(name);
    }
    if !text.starts_with('#') || word.len() != 6 || !word.is_ascii() {
        return None;
    }
    let channel =
        |i: usize| u8::from_str_radix(&word[i..i + 2], 16).ok().map(|v| f64::from(v) / 255.0);
    Some(of_rgb([channel(0)?, channel(2)?, channel(4)?]))
}

/// The colour that a material's name tells of, as one of its words: "Glass_Detailed_Green_Mat". None where it tells of
/// several.
pub(super) fn of_name(name: &str) -> Option<&'static str> {
    let words = parts(name);
    let told = words.iter().filter_map(|w| ENGLISH.iter().find(|(english, _)| english == w));
    let mut colours = told.map(|(_, colour)| *colour);
    let first = colours.next()?;
    colours.all(|other| other == first).then_some(first)
}

/// The material that an asset's or texture's name tells of.
pub(super) fn material(name: &str) -> Option<&'static str> {
    let name = name.to_lowercase();
    MATERIALS.iter().find(|(word, _)| name.contains(word)).map(|(_, material)| *material)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_get_the_name_that_people_give_them() {
        assert_eq!(of_rgb([0.68, 0.68, 0.67]), "Серый");
        assert_eq!(of_rgb([0.05, 0.05, 0.1]), "Чёрный");
        assert_eq!(of_rgb([0.9, 0.92, 0.88]), "Белый");
        assert_eq!(of_rgb([1.0, 0.0, 0.0]), "Красный");
        assert_eq!(of_rgb([0.0, 0.0, 0.6]), "Синий");
        assert_eq!(of_text("light blue"), Some("Голубой"));
        assert_eq!(of_text("#FF0000"), Some("Красный"));
        assert_eq!(of_text("#ЖЖЖ"), None);
        assert_eq!(of_name("Glass_Detailed_Green_Mat"), Some("Зелёный"));
        assert_eq!(of_name("PureBlack_Wood"), Some("Чёрный"));
        assert_eq!(of_name("GreyFloor 3"), Some("Серый"));
        assert_eq!(of_name("bathroomTilesBlue"), Some("Синий"));
        assert_eq!(of_name("WoodFineDarkFloorsRedNRM2"), Some("Красный"));
        assert_eq!(of_name("BlackWhiteTiles"), None);
        assert_eq!(of_name("Bowl_Mat4 (Glass)"), None);
        assert_eq!(material("TexturesCom_WoodFine0050_1_seamless_S_white"), Some("Дерево"));
    }
}
