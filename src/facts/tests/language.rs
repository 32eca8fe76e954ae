//! The language beyond plain rules, each part by small programs: what is derived, and what is refused.

use expect_test::{Expect, expect};
use orthoframe_facts::{Live, Program, Value};
use orthoframe_units::Source;

/// The tuples of all `.output` relations, or the faults with their lines.
pub(super) fn check(text: &str, expected: &Expect) {
    expected.assert_eq(&shown(text));
}

fn shown(text: &str) -> String {
    let program = match Program::parse(&Source::new("t.dl", text)) {
        Ok(program) => program,
        Err(faults) => {
            let placed = faults.files.iter().flat_map(|file| file.placed());
            return placed.map(|(line, _, fault)| format!("{line}: {fault}\n")).collect();
        }
    };
    let derived = program.evaluate(&program.database()).unwrap();
    let mut shown = String::new();
    for (id, info) in program.relations().filter(|(_, info)| !info.outputs.is_empty()) {
        for tuple in derived.sorted(id).unwrap() {
            let values: Vec<String> = tuple.iter().map(ToString::to_string).collect();
            shown += &format!("{}({})\n", info.name, values.join(", "));
        }
    }
    shown
}

#[test]
fn a_component_has_what_its_bases_have_under_its_own_name() {
    check(
        r#"
        .comp Graph<N> {
            .type Edge = [from: N, to: N]
            .decl edge(a: N, b: N)
            .decl path(a: N, b: N) overridable
            .decl taken(e: Edge) .output taken
            path(A, B) :- edge(A, B).
            path(A, C) :- path(A, B), edge(B, C).
            taken([A, B]) :- edge(A, B).
        }
        .comp Both<N> : Graph<N> { edge(A, B) :- edge(B, A). .output path }
        .comp Short<N> : Graph<N> { .override path path(A, B) :- edge(A, B). .output path }
        .comp Two<G> { .init one = G<number> .init other = G<number> other.edge(X, Y) :- one.edge(Y, X). }
        .init all = Two<Both>
        all.one.edge(1, 2).
        .init short = Short<symbol>
        short.edge("a", "b"). short.edge("b", "c")."#,
        &expect![[r#"
            all.one.path(1, 1)
            all.one.path(1, 2)
            all.one.path(2, 1)
            all.one.path(2, 2)
            all.one.taken([1, 2])
            all.one.taken([2, 1])
            all.other.path(1, 1)
            all.other.path(1, 2)
            all.other.path(2, 1)
            all.other.path(2, 2)
            all.other.taken([1, 2])
            all.other.taken([2, 1])
            short.path(a, b)
            short.path(b, c)
            short.taken([a, b])
            short.taken([b, c])
        "#]],
    );
}

#[test]
fn what_is_wrong_with_a_component_is_said_where_it_stands() {
    check(
        ".comp A { .decl r(x: number) r(1). }
.comp B : C { }
.comp D<T> : A { .override r .override s }
.init d = D<number>
.init e = D
.init f = Nothing
.comp G { .init g = G }
.comp H : I {} .comp I : H {}
",
        &expect![[r#"
            2: неизвестный компонент «C»
            3: не поддерживается: .override r: отношение не объявлено overridable
            3: не поддерживается: .override s: у наследуемых компонентов нет такого отношения
            5: у «D» аргументов 1, а дано 0
            6: неизвестный компонент «Nothing»
            7: не поддерживается: компонент «G» внутри самого себя
            8: не поддерживается: компонент «H» внутри самого себя
            8: не поддерживается: компонент «I» внутри самого себя
        "#]],
    );
}

#[test]
fn records_are_built_and_taken_apart() {
    check(
        r#"
        .type List = [head: number, tail: List]
        .decl list(l: List, length: number) .output list
        .decl n(x: number) n(1). n(2).
        list(nil, 0).
        list([X, L], N + 1) :- list(L, N), n(X), N < 2.
        .decl second(x: number) .output second
        second(B) :- list([_, [B, _]], _).
        .decl starts(x: number, y: number) .output starts
        starts(X, Y) :- list(L, 2), L = [X, T], T = [Y, nil], X != Y.
        .decl any(n: number) .output any
        any(N) :- N = count : { list([_, _], _) }.
        .decl none() .output none
        none() :- list(L, _), L = nil, !list([7, L], _)."#,
        &expect![[r#"
            list([1, [1, nil]], 2)
            list([1, [2, nil]], 2)
            list([1, nil], 1)
            list([2, [1, nil]], 2)
            list([2, [2, nil]], 2)
            list([2, nil], 1)
            list(nil, 0)
            second(1)
            second(2)
            starts(1, 2)
            starts(2, 1)
            any(6)
            none()
        "#]],
    );
}

#[test]
fn branches_are_told_apart() {
    check(
        r#"
        .type Expr = Number { n: number } | Add { a: Expr, b: Expr } | Neg { a: Expr } | Zero {}
        .decl expr(e: Expr) .decl value(e: Expr, v: number) .output value
        expr($Add($Number(2), $Neg($Zero()))). expr($Neg($Number(5))).
        expr(A) :- expr($Neg(A)).
        expr(A), expr(B) :- expr($Add(A, B)).
        value($Zero, 0) :- expr($Zero).
        value(E, N) :- expr(E), E = $Number(N).
        value(E, -N) :- expr(E), E = $Neg(A), value(A, N).
        value($Add(A, B), N + M) :- expr($Add(A, B)), value(A, N), value(B, M)."#,
        &expect![[r#"
            value($Add($Number(2), $Neg($Zero)), 2)
            value($Neg($Number(5)), -5)
            value($Neg($Zero), 0)
            value($Number(2), 2)
            value($Number(5), 5)
            value($Zero, 0)
        "#]],
    );
}

#[test]
fn records_that_fit_no_type_are_refused() {
    check(
        ".type P = [x: number, y: symbol]
.type T = Leaf {} | Node { l: T, r: T }
.decl p(a: P) .output p
.decl t(a: T) .output t
p([1]).
p([1, 2]).
p($Leaf).
t([1, 2]).
t($Tree).
t($Node($Leaf)).
p(X) :- p(X), X < X.
t(X) :- X = [1, 2].
.type U = Leaf {}
.decl s(x: symbol, n: number) .output s
s(X, 1) :- s(X, _), X = nil.
s(nil, 2).
s(X, N) :- s(X, N), s(nil, N).
",
        &expect![[r#"
            5: у «P» аргументов 2, а дано 1
            6: «2»: нужен тип symbol, а здесь number
            7: «$Leaf»: нужен тип P, а здесь U
            8: «[…]»: нужен тип T, а здесь […]
            9: у записи здесь нет известного типа: $Tree
            10: у «$Node» аргументов 2, а дано 1
            11: не поддерживается: < между значениями типа P
            12: «[…]»: нужен тип T, а здесь […]
            13: «Leaf» объявлено дважды
            15: «nil»: нужен тип symbol, а здесь запись
            16: «nil»: нужен тип symbol, а здесь запись
            17: «nil»: нужен тип symbol, а здесь запись
        "#]],
    );
}

#[test]
fn of_a_choice_domain_one_tuple_stays_for_each_key() {
    let text = r#"
        .decl edge(a: number, b: number)
        edge(1, 2). edge(1, 3). edge(2, 4). edge(3, 4). edge(4, 1).
        .decl tree(child: number, parent: number) choice-domain child
        .output tree
        tree(1, 0).
        tree(C, P) :- tree(P, _), edge(P, C).
        .decl match(a: number, b: number) choice-domain a, b .output match
        match(A, B) :- edge(A, B)."#;
    check(
        text,
        &expect![[r#"
            tree(1, 0)
            tree(2, 1)
            tree(3, 1)
            tree(4, 2)
            match(1, 2)
            match(2, 4)
            match(4, 1)
        "#]],
    );
}

#[test]
fn subsumption_keeps_the_best_and_ends_where_all_would_not() {
    check(
        r#"
        .decl edge(a: symbol, b: symbol, n: number)
        edge("a", "b", 1). edge("b", "c", 1). edge("c", "a", 1). edge("a", "c", 5).
        .decl far(a: symbol, n: number) .output far
        far("a", 0).
        far(B, N + M) :- far(A, N), edge(A, B, M).
        far(A, N) <= far(A, M) :- M < N.
        .decl widest(a: symbol) .output widest
        widest(A) :- far(A, N), N = max M : far(_, M)."#,
        &expect![[r#"
            far(a, 0)
            far(b, 1)
            far(c, 2)
            widest(c)
        "#]],
    );
}

#[test]
fn witnesses_of_an_extreme_are_found() {
    check(
        r#"
        .decl mark(who: symbol, class: symbol, n: number)
        mark("A", "x", 3). mark("B", "x", 5). mark("C", "x", 5). mark("D", "y", 1).
        .decl class(c: symbol) class("x"). class("y").
        .decl best(who: symbol, n: number) .output best
        best(W, N) :- N = max M : { mark(W, _, M) }.
        .decl worst(c: symbol, who: symbol, n: number) .output worst
        worst(C, W, N) :- class(C), N = min M : { mark(W, C, M) }.
        .decl own(n: number) .output own
        own(N) :- N = min M + N : { mark("A", _, M), mark("D", _, N) }.
"#,
        &expect![[r#"
            best(B, 5)
            best(C, 5)
            worst(x, A, 3)
            worst(y, D, 1)
            own(4)
        "#]],
    );
    // Of an extreme within an aggregate the witness is the rule's; where that extreme hangs on what the aggregate goes
    // through there is none.
    check(
        r#"
        .decl mark(who: symbol, n: number)
        mark("A", 3). mark("B", 1). mark("C", 1).
        .decl limit(class: symbol, n: number)
        limit("x", 1). limit("y", 2). limit("y", 3).
        .decl above(n: number, who: symbol) .output above
        above(N, W) :- N = count : { limit(_, X), X > min Y : { mark(W, Y) } }.
        .decl both(n: number, c: symbol, who: symbol) .output both
        both(N, C, W) :- N = max X : { limit(C, X), X > min Y : { mark(W, Y) } }.
        .decl own(n: number) .output own
        own(N) :- N = count : { limit(_, X), X > min N : { mark(_, N) } }.
        .decl alone(n: number, who: symbol) .output alone
        alone(N, W) :- mark(W, 3), N = count : { limit(_, X), X <= max Y : { mark(W, Y) } }."#,
        &expect![[r#"
            above(2, B)
            above(2, C)
            both(3, y, B)
            both(3, y, C)
            own(2)
            alone(3, A)
        "#]],
    );
    check(
        ".decl mark(who: symbol, n: number) .input mark
.decl hangs(n: number, who: symbol) .output hangs
hangs(N, W) :- N = count : { mark(_, X), X > min Y : { mark(W, Y), Y < X } }.",
        &expect![[r#"
            3: переменная «N» ничем не связана
            3: переменная «W» ничем не связана
        "#]],
    );
    check(
        ".decl mark(who: symbol, n: number) .input mark
.decl sums(who: symbol, n: number) .output sums
sums(W, N) :- N = sum M : { mark(W, M) }.",
        &expect![[r#"
            3: переменная «W» ничем не связана
            3: переменная «N» ничем не связана
        "#]],
    );
}

#[test]
fn unsigned_numbers_go_round_and_ranges_are_of_their_type() {
    check(
        r#"
        .decl u(x: unsigned) .output u
        u(0 - 1). u(bnot(0u)). u(4294967295 + 2). u(1 bshl 33). u(to_unsigned(-3)). u(7 / 2). u(2u ^ 33u).
        .decl r(x: unsigned) .output r
        r(X) :- X = range(5, 2).
        .decl f(x: float) .output f
        f(X) :- X = range(0.5, 2).
        f(X) :- X = range(1, 0, -0.25).
        .decl n(x: number) .output n
        n(autoinc()) :- u(_).
        n(2 ^ -1 + 100). n(to_number(to_unsigned(-5)))."#,
        &expect![[r#"
            u(0)
            u(1)
            u(2)
            u(3)
            u(4294967293)
            u(4294967295)
            r(3)
            r(4)
            r(5)
            f(0.25)
            f(0.5)
            f(0.75)
            f(1)
            f(1.5)
            n(-5)
            n(0)
            n(100)
        "#]],
    );
}

#[test]
fn foreign_code_is_refused_with_a_reason() {
    check(
        ".functor f(x: number): number
.decl a(x: number) .output a
a(@f(1)).
.lattice L {}
a(X) :- a(X), match(\"(a)\\\\1\", \"aa\").
.plan 0:(1,2)
",
        &expect![[r#"
            3: не поддерживается: функция из .functor
            4: не поддерживается: .lattice
        "#]],
    );
}

/// A proof goes through records, components and what was chosen.
#[test]
fn why_holds_for_records_components_and_choices() {
    let text = r#"
        .type Pair = [a: symbol, b: symbol]
        .comp C { .decl at(p: Pair) .decl on(a: symbol, b: symbol) choice-domain a
                  on(A, B) :- at([A, B]), match("cup.*", A). }
        .init c = C
        c.at(["cup", "table"]). c.at(["cup", "floor"]).
        .output c.on"#;
    let program = Program::parse(&Source::new("t.dl", text)).unwrap();
    let derived = program.evaluate(&program.database()).unwrap();
    let tuples = derived.sorted("c.on").unwrap();
    assert_eq!(tuples.len(), 1);
    let proof = derived.why("c.on", &tuples[0]).unwrap().expect("the tuple holds");
    assert_eq!(proof.steps.len(), 2, "{proof:?}");
    let pair = Value::Record("[cup, table]".into());
    assert_eq!(derived.contains("c.at", std::slice::from_ref(&pair)), Ok(true));
    assert!(derived.why("c.at", &[pair]).unwrap().is_some());
}

/// Records and choices under edits: as from scratch.
#[test]
fn edits_are_followed_through_records_choices_and_subsumption() {
    let text = r#"
        .type Step = [a: number, b: number]
        .decl edge(e: Step) .input edge
        .decl far(a: number, n: number) .output far
        far(0, 0).
        far(B, N + 1) :- far(A, N), edge([A, B]).
        far(A, N) <= far(A, M) :- M < N.
        .decl from(b: number, a: number) choice-domain b .output from
        from(B, A) :- edge([A, B])."#;
    let program = Program::parse(&Source::new("t.dl", text)).unwrap();
    let mut live = Live::new(program.clone(), program.database()).unwrap();
    let edge = |a: u32, b: u32| [Value::Record(format!("[{a}, {b}]").into())];
    let mut state = 7_u32;
    for _ in 0..60 {
        for _ in 0..3 {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let (a, b) = (state >> 20 & 7, state >> 25 & 7);
            if state >> 30 == 0 {
                live.remove("edge", &edge(a, b)).unwrap();
            } else {
                live.insert("edge", &edge(a, b)).unwrap();
            }
        }
        live.update().unwrap();
        let fresh = program.evaluate(live.database()).unwrap();
        assert_eq!(live.derived().sorted("far"), fresh.sorted("far"));
        assert_eq!(live.derived().len("from"), fresh.len("from"));
    }
}

/// Lists as long as memory allows are written and read without recursion.
#[test]
fn a_long_list_is_written_and_read() {
    let text = r#"
        .type List = [n: number, rest: List]
        .decl list(l: List, n: number) .output list
        list(nil, 0).
        list([N, L], N + 1) :- list(L, N), N < 20000."#;
    let program = Program::parse(&Source::new("t.dl", text)).unwrap();
    let derived = program.evaluate(&program.database()).unwrap();
    let longest = derived
        .tuples("list")
        .unwrap()
        .find(|tuple| tuple.number(1) == Some(20000))
        .unwrap()
        .values();
    assert_eq!(derived.contains("list", &longest), Ok(true));
    let mut database = program.database();
    assert_eq!(database.insert("list", &longest), Ok(true));
    assert!(database.insert("list", &[Value::Record("[1, [2".into()), 1.into()]).is_err());
}

/// What in brackets follows `max` is arguments or a value to be counted; addresses, escapes and line marks of others.
#[test]
fn brackets_behind_max_and_marks_of_other_programs_are_read() {
    check(
        r#"# 1 "made.dl"
        #line 7 "made.dl"
        .decl e(x: number, y: number) e(1, 2). e(3, 4).
        .decl m(x: number) .output m
        m(X) :- X = max (A * 2) : { e(A, _) }.
        m(X) :- X = min (A) + (A) * 5 : e(A, _).
        m(X) :- X = max(A, B) + 100, e(A, B).
        m(X) :- e(A, _), X = min(max(A, 2), 9).
        .decl a(x: number, n: number) .output a
        a(10.0.0.1, strlen("a\b\\")). a(255.255.255.255, strlen("\v\a\"")).
        "#,
        &expect![[r#"
            m(2)
            m(3)
            m(6)
            m(102)
            m(104)
            a(-1, 3)
            a(167772161, 3)
        "#]],
    );
    let arity = shown(".decl m(x: number) .output m m(max(1)).");
    assert!(arity.contains("у «max» аргументов 2, а дано 1"), "{arity}");
    let address = shown(".decl m(x: number) .output m m(256.0.0.1).");
    assert!(address.contains("256.0.0.1"), "{address}");
}

#[test]
fn numbers_become_texts_and_others_as_in_souffle() {
    check(
        r#"
        .decl f(x: float) .output f
        f(2.0 ^ 0.5). f(16.0 ^ -0.25). f(-1.0 ^ 0.5). f(itof(3)).
        f(X) :- X = 0.0 - 4.0, Y = X ^ 0.5, Y > 0.0.
        .decl s(x: symbol) .output s
        s(to_string(4.5)). s(to_string(-0.25)). s(cat("a")). s(cat()).
        .decl n(x: number) .output n
        f(3.14159265).
        n(ftoi(3.9)). n(1 bshl 64). n(-1 bshru 63)."#,
        &expect![[r#"
            f(-1)
            f(0.5)
            f(1.414214)
            f(3)
            f(3.141593)
            s()
            s(-0.250000)
            s(4.500000)
            s(a)
            n(1)
            n(3)
        "#]],
    );
}

/// A step of none gives the first number wherever the range is not empty, up or down.
#[test]
fn a_range_without_a_step_gives_its_first_number() {
    check(
        "
        .decl r(a: number, s: symbol) .output r
        .decl u(a: unsigned) .output u
        .decl f(a: float) .output f
        r(X, \"up\") :- X = range(1, 5, 0).
        r(X, \"down\") :- X = range(5, 1, 0).
        r(X, \"empty\") :- X = range(5, 5, 0).
        r(X, \"known\") :- X = 5, X = range(5, 1, 0).
        r(X, \"other\") :- X = 4, X = range(5, 1, 0).
        u(X) :- X = range(7, 2, 0).
        f(X) :- X = range(5.0, 3.75, 0.0).",
        &expect![[r#"
            r(1, up)
            r(5, down)
            r(5, known)
            u(7)
            f(5)
        "#]],
    );
}

#[test]
fn texts_are_joined_by_a_plus() {
    check(
        r#"
        .decl s(a: symbol) s("(a)"). s("(b)").
        .decl t(a: symbol) .output t
        t("до" + "-" + "после").
        t("до-" + S) :- s(S).
        t(A + B + to_string(1 + 2)) :- s(A), s(B), A != B.
        t(T) :- s(S), T = S + "-после", T != "(b)" + "-после"."#,
        &expect![[r#"
            t((a)(b)3)
            t((a)-после)
            t((b)(a)3)
            t(до-(a))
            t(до-(b))
            t(до-после)
        "#]],
    );
    for wrong in ["S - \"x\"", "S + 1", "1 + S", "S * S"] {
        let text =
            format!(".decl s(a: symbol) s(\"a\"). .decl t(a: symbol) t(T) :- s(S), T = {wrong}.");
        assert!(Program::parse(&Source::new("t.dl", text)).is_err(), "{wrong}");
    }
}

/// `_ = min …` asks for a value and its witnesses; `_` compared with anything else says nothing, and is refused.
#[test]
fn an_aggregate_may_go_to_a_nameless_variable() {
    check(
        "
        .decl d(a: number, b: number) d(3, 1). d(1, 2). d(1, 1).
        .decl w(a: number, b: number) .output w
        .decl any(a: number) .output any
        w(X, Y) :- _ = min X + Y : { d(X, Y) }.
        any(1) :- _ = max X : { d(X, _) }, _ = min X : { d(X, _) }.
        any(2) :- max X : { d(X, 7) } = _.",
        &expect![[r#"
            w(1, 1)
            any(1)
        "#]],
    );
}

/// Texts are numbers in tens, sixteens and twos, with one sign at most and in front.
#[test]
fn texts_are_numbers_in_three_bases() {
    check(
        r#"
        .decl t(a: symbol)
        t("12"). t("-12"). t(" 0x1F "). t("-0xcafe"). t("0b101"). t("-0b1"). t("0x-1"). t("0b+1"). t("--0b1").
        t("0x"). t("0b2"). t("0x8000000000000000"). t("-0x8000000000000000"). t("0xffffffff"). t("0x100000000").
        .decl n(a: symbol, b: number) .output n
        n(T, to_number(T)) :- t(T).
        .decl u(a: symbol, b: unsigned) .output u
        u(T, to_unsigned(T)) :- t(T)."#,
        &expect![[r#"
            n( 0x1F , 31)
            n(-0b1, -1)
            n(-0x8000000000000000, -9223372036854775808)
            n(-0xcafe, -51966)
            n(-12, -12)
            n(0b101, 5)
            n(0x100000000, 4294967296)
            n(0xffffffff, 4294967295)
            n(12, 12)
            u( 0x1F , 31)
            u(0b101, 5)
            u(0xffffffff, 4294967295)
            u(12, 12)
        "#]],
    );
}

/// What stands in `@[…]` and `@![…]` is for other tools, whatever words it is made of.
#[test]
fn annotations_are_left_out() {
    check(
        r#"
        .type R = [ @[form = {}] a: number, @[doc = "]"] b: number ]
        @[xcomp { .comp C { @[x(q())] .decl q(a: number) q(1). } }]
        .comp C { @[xdecl] .decl q( @[t] @[u (=)] r: R) @[x [=]] q([1, 2]). }
        @[xinit(.init c = C)] .init c = C
        @[out] .output c.q
        .decl m(a: number) .decl j(a: number) .output m, j
        @[x] @[y()] m(X), @[z] j(X) :- @![doc = "inner"] X = range(0, 2)."#,
        &expect![[r#"
            c.q([1, 2])
            m(0)
            m(1)
            j(0)
            j(1)
        "#]],
    );
}
