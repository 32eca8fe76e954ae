//! Faults and warnings of a text, each at its place.

use expect_test::{Expect, expect};
use miette::Diagnostic as _;
use orthoframe_facts::{FileFaults, Program};
use orthoframe_units::Source;

/// Every fault and warning with its place and code.
fn check(text: &str, expected: &Expect) {
    let (found, is_sound) = match Program::parse(&Source::new("п.dl", text)) {
        Ok(program) => (program.warnings().to_vec(), true),
        Err(faults) => (faults.files, false),
    };
    let mut shown = String::new();
    for (line, column, fault) in found.iter().flat_map(FileFaults::placed) {
        let code = fault.code().map(|code| code.to_string()).unwrap_or_default();
        shown += &format!("{line}:{column} {code} {fault}\n");
    }
    shown += if is_sound { "годится\n" } else { "" };
    expected.assert_eq(&shown);
}

#[test]
fn all_faults_of_a_text_come_at_once() {
    check(
        ".decl стоит_на(а: symbol, б: symbol) .output стоит_на
.decl n(x: number) .input n .output n
стоит_на(A, B) :- стоит_нa(A, B).
n(X) :- стоит_на(X, _).
n(1, 2).
n(Y) :- n(X), !n(Z).
n(\"три\").
n(_).",
        &expect![[r#"
                3:19 facts::unknown_relation неизвестное отношение «стоит_нa»
                4:3 facts::types «X»: нужен тип number, а здесь symbol
                5:1 facts::arity у «n» аргументов 1, а дано 2
                6:3 facts::ungrounded переменная «Y» ничем не связана
                6:18 facts::ungrounded переменная «Z» ничем не связана
                7:3 facts::types «три»: нужен тип number, а здесь symbol
                8:3 facts::wildcard «_» стоит там, где нужно значение
            "#]],
    );
}

#[test]
fn a_syntax_fault_says_what_was_expected() {
    check(
        ".decl a(x: number) .output a
a(1) a(2).
a(X) :- a(X), X > .
a(3).
.comp Дом
a(99999999999999999999). a(1.5). a(\"без конца).
a(№). a(4",
        &expect![[r#"
                2:6 facts::syntax здесь ожидается «,» или «:-» или «.», а стоит «a»
                3:19 facts::syntax здесь ожидается имя или число или текст в кавычках или «(», а стоит «.»
                6:1 facts::syntax здесь ожидается «:» или «{», а стоит «a»
                6:3 facts::number число «99999999999999999999» не помещается в 64 бита
                6:28 facts::types «1.5»: нужен тип number, а здесь float
                6:36 facts::unclosed текст в кавычках не закрыт
                7:1 facts::syntax здесь ожидается действие или «,» или «)», а стоит «a»
                7:3 facts::character символ «№» здесь ничего не значит
                7:10 facts::syntax здесь ожидается действие или «,» или «)», а стоит конец текста
            "#]],
    );
}

#[test]
fn negation_in_a_cycle_shows_the_cycle() {
    check(
        ".decl a(x: number) .decl b(x: number) .decl c(x: number) .output a
a(1). a(X) :- b(X). b(X) :- c(X). c(X) :- a(X), !b(X).
.decl d(x: number) .output d
d(N) :- N = count : { d(_) }.",
        &expect![[r#"
                2:50 facts::cycle отношение зависит от собственного отрицания или счёта: c → не b → c
                4:23 facts::cycle отношение зависит от собственного отрицания или счёта: d → не d
            "#]],
    );
}

#[test]
fn warnings_do_not_stop_a_program() {
    check(
        ".decl used(x: number) .decl idle(x: number) .decl empty(x: number) .output used
used(X) :- empty(X).
used(1) :- used(Y).",
        &expect![[r#"
                1:29 facts::never_used отношение «idle» нигде не используется
                1:51 facts::never_derived отношение «empty» всегда пусто: его ничто не выводит
                3:17 facts::single_variable переменная «Y» встречается один раз
                годится
            "#]],
    );
}

#[test]
fn subtypes_keep_kinds_of_symbols_apart() {
    check(
            ".type Место <: symbol .type Вещь <: symbol .type Всё = Место | Вещь
.decl где(в: Вещь, м: Место) .input где .decl есть(x: Всё) .output есть .decl любое(x: symbol) .output любое
есть(X) :- где(X, _). есть(M) :- где(_, M). любое(X) :- где(X, _).
где(M, M) :- где(_, M).
есть(X) :- где(X, X).",
            &expect![[r#"
                4:5 facts::types «M»: нужен тип Вещь, а здесь Место
                5:19 facts::types «X»: нужен тип Место, а здесь Вещь
            "#]],
        );
}

#[test]
fn rubbish_is_refused_and_nothing_more() {
    let deep = "(".repeat(100_000);
    let chain = format!("a(1{}).", "+1".repeat(100_000));
    let tangled = format!("a(X) :- {}a(X){}.", "(".repeat(60), ")".repeat(60));
    let nested = format!("a(X) :- X = {}1{}.", "count : { 1 = ".repeat(60), "}".repeat(60));
    for text in
        ["", "\0\0", ".", ":-", "/*", "\"", "a(", ".decl", &deep, &chain, &tangled, &nested, "−"]
    {
        let _ = Program::parse(&Source::new("мусор", text));
    }
}
