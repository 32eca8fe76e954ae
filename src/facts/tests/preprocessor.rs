//! What the preprocessor makes of a program before it is read.

use expect_test::expect;

use super::language::check;

#[test]
fn the_preprocessor_puts_words_for_names() {
    check(
        "#define LIMIT 3
#define ABOVE(x, y) x > (y)
#ifdef LIMIT
.decl n(x: number) .output n
#else
nonsense
#endif
n(0).
n(X + 1) :- n(X), X < LIMIT.
.decl big(x: number) .output big
big(X) :- n(X), ABOVE(X, LIMIT - 2).
#define LONG(x) \\
  n(x)
big(-X) :- LONG(X), X < 0 + LIMIT, X > 1.
#undef LIMIT
#ifndef LIMIT
n(100).
#endif
#define A B
#define B A
",
        &expect![[r#"
            n(0)
            n(1)
            n(2)
            n(3)
            n(100)
            big(-2)
            big(2)
            big(3)
            big(100)
        "#]],
    );
}

#[test]
fn the_preprocessor_chooses_joins_and_names_the_place() {
    check(
        r##"
#define WIDTH 10
#define SUM(a, b) ((a) + (b))
#define WORD(x) #x
#define JOIN(a, b) a##b
#if defined(WIDTH) && WIDTH * 2 == 20
.decl n(x: number) .output n
#elif 1
what is left out need not be read
#else
nor this
#endif
#if 0
#if 1
n(1).
#else
n(2).
#endif
#elif WIDTH > 5
n(3).
#elif 1
n(4).
#endif
JOIN(n,)(SUM(WIDTH, __LINE__)).
.decl s(x: symbol) .output s
s(WORD(a  b)). s(__FILE__).
#line 70 "other.dl"
s(__FILE__). n(__LINE__)."##,
        &expect![[r#"
            n(3)
            n(34)
            n(70)
            s(a b)
            s(other.dl)
            s(t.dl)
        "#]],
    );
    check(
        "#if 1 +\n#endif\n#elif 1\n#if 1",
        &expect![[r#"
            1: не поддерживается: условие препроцессора «1 +»
            3: не поддерживается: препроцессор C: «#elif 1»
            4: #if не закрыт
        "#]],
    );
}

/// Numbers have 64 bits: programs written for either width find theirs.
#[test]
fn the_preprocessor_knows_how_wide_numbers_are() {
    check(
        ".decl n(x: number) .output n
#if RAM_DOMAIN_SIZE == 32
n(32).
#elif RAM_DOMAIN_SIZE == 64
n(64).
#endif
#ifdef RAM_DOMAIN_SIZE
n(1).
#endif
n(RAM_DOMAIN_SIZE / 2).",
        &expect![[r#"
            n(1)
            n(32)
            n(64)
        "#]],
    );
}
