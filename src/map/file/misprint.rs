//! What the TOML parser has to say, in Russian. A phrase that is not listed here is passed on as it is.

use crate::units::Bilingual;

const PHRASES: [(&str, &str); 63] = [
    ("`_` may only go between digits", "знак `_` может стоять только между цифрами"),
    (
        "cannot extend value of type array with a dotted key",
        "к списку не прибавляют поля через точку",
    ),
    (
        "cannot extend value of type inline table with a dotted key",
        "к таблице в скобках не прибавляют поля через точку",
    ),
    ("cannot recurse further; max recursion depth met", "слишком глубокая вложенность"),
    ("carriage return must be followed by newline", "после CR должен идти перевод строки"),
    ("duplicate key", "ключ дан дважды"),
    ("extra `=`", "лишний знак `=`"),
    ("extra assignment between key-value pairs", "лишний знак `=`"),
    ("extra comma in array", "лишняя запятая в списке"),
    ("extra comma in inline table", "лишняя запятая в таблице"),
    ("integers with a radix cannot be signed", "перед 0x, 0o и 0b знак не ставят"),
    ("invalid basic string", "строка в кавычках не закрыта или записана неверно"),
    ("invalid binary number", "неверное двоичное число"),
    ("invalid boolean", "ожидается true или false"),
    ("invalid comment character", "недопустимый знак в примечании"),
    ("invalid date-time", "неверная запись времени"),
    ("invalid exponent", "неверная степень числа"),
    ("invalid float", "неверная запись числа"),
    ("invalid fraction", "неверная дробная часть"),
    ("invalid hexadecimal number", "неверное шестнадцатеричное число"),
    ("invalid inline table element", "непонятный элемент таблицы"),
    ("invalid integer number", "неверная запись целого числа"),
    ("invalid key", "непонятный ключ"),
    ("invalid key-value pair", "строка не имеет вида «ключ = значение»"),
    ("invalid literal string", "строка в апострофах не закрыта или записана неверно"),
    ("invalid mantissa", "неверная запись числа"),
    ("invalid multi-line basic string", "многострочный текст не закрыт или записан неверно"),
    ("invalid multi-line literal string", "многострочный текст не закрыт или записан неверно"),
    ("invalid octal number", "неверное восьмеричное число"),
    ("invalid string", "строка записана неверно"),
    ("invalid table", "неверный заголовок таблицы"),
    ("invalid unquoted key", "недопустимый ключ; русские ключи берут в кавычки"),
    ("invalid value", "недопустимое значение"),
    ("key with no value", "ключ без значения"),
    ("keys cannot be multi-line basic strings", "ключ не может занимать несколько строк"),
    ("keys cannot be multi-line literal strings", "ключ не может занимать несколько строк"),
    ("missing array opening", "не хватает открывающей скобки списка"),
    ("missing assignment between key-value pairs", "не хватает знака `=`"),
    ("missing comma between array elements", "не хватает запятой между элементами списка"),
    ("missing comma between key-value pairs", "не хватает запятой между полями"),
    ("missing escaped value", "не хватает знака после `\\`"),
    ("missing inline table opening", "не хватает открывающей скобки таблицы"),
    ("missing key for inline table element", "не хватает ключа"),
    ("missing opening quote", "не хватает открывающей кавычки"),
    ("missing value for key", "не хватает значения"),
    ("missing value", "не хватает значения"),
    ("radix must be lowercase", "0x, 0o и 0b пишут строчными"),
    ("recursion limit", "слишком глубокая вложенность"),
    ("redundant integer number prefix", "лишняя приставка числа"),
    ("redundant numeric sign", "лишний знак числа"),
    ("string values must be quoted", "текст берут в кавычки"),
    ("too few unicode value digits", "не хватает цифр в коде знака"),
    ("unclosed array table", "не закрыт заголовок списка таблиц"),
    ("unclosed array", "не закрыт список"),
    ("unclosed inline table", "не закрыта таблица"),
    ("unclosed table", "не закрыт заголовок таблицы"),
    ("unexpected `=` in array", "знак `=` в списке"),
    ("unexpected content between comment and newline", "лишнее в конце строки"),
    ("unexpected content", "лишнее"),
    ("unexpected key or value", "лишний ключ или лишнее значение"),
    ("unexpected leading zero", "лишний ноль в начале числа"),
    ("unexpected sign", "лишний знак числа"),
    ("unquoted keys cannot be empty", "пустой ключ берут в кавычки"),
];

const EXPECTED: [(&str, &str); 13] = [
    ("basic string", "строка в кавычках"),
    ("literal string", "строка в апострофах"),
    ("multi-line basic string", "многострочный текст"),
    ("characters", "знаки"),
    ("digits", "цифры"),
    ("key", "ключ"),
    ("letters", "латинские буквы"),
    ("numbers", "цифры"),
    ("printable characters", "печатные знаки"),
    ("non-double-quote visible characters", "знаки, кроме кавычек"),
    ("non-single-quote visible characters", "знаки, кроме апострофов"),
    ("unicode hexadecimal value", "шестнадцатеричный код знака"),
    ("value", "значение"),
];

/// A message of the parser: what is wrong, and perhaps after a comma what it expected.
pub(super) fn in_both(message: &str) -> Bilingual {
    Bilingual::new(in_russian(message), message.to_owned())
}

fn in_russian(message: &str) -> String {
    let (wrong, expected) = message.split_once(", expected ").unwrap_or((message, ""));
    let wrong = look_up(&PHRASES, wrong);
    if expected.is_empty() {
        return wrong.to_owned();
    }
    let expected: Vec<_> = expected.split(", ").map(|word| look_up(&EXPECTED, word)).collect();
    format!("{wrong}; ожидается {}", expected.join(", "))
}

fn look_up<'t>(table: &[(&str, &'t str)], phrase: &'t str) -> &'t str {
    table.iter().find(|(english, _)| *english == phrase).map_or(phrase, |(_, russian)| russian)
}
