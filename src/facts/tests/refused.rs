//! What Soufflé's checks refuse is refused, and what it only warns of runs: a small program for each of the checks.

use orthoframe_facts::Program;
use orthoframe_units::Source;

/// Types that the programs whose names begin with `ty_` may name.
const TYPES: &str = "
    .type N <: number .type M <: number .type S <: symbol .type U = N | M
    .type R = [a: number, b: symbol] .type L = [h: number, t: L]
    .type A = X {x: number} | Y {s: symbol, a: A} | Z {}
";

fn parsed(name: &str, text: &str) -> Result<Program, String> {
    let types = if name.starts_with("ty_") { TYPES } else { "" };
    let source = Source::new("t.dl", format!("{types}{text}\n"));
    Program::parse(&source).map_err(|faults| faults.to_string())
}

#[test]
fn what_souffle_refuses_is_refused() {
    let taken: Vec<&str> = REFUSED
        .iter()
        .filter(|(name, text)| parsed(name, text).is_ok())
        .map(|(name, _)| *name)
        .collect();
    assert!(taken.is_empty(), "not refused: {taken:?}");
}

#[test]
fn what_souffle_takes_runs() {
    for (name, text) in TAKEN {
        let program = parsed(name, text).unwrap_or_else(|fault| panic!("{name}: {fault}"));
        program.evaluate(&program.database()).unwrap_or_else(|fault| panic!("{name}: {fault}"));
    }
}

const REFUSED: &[(&str, &str)] = &[
    (
        "undef_rel_body",
        ".decl a(x:number)
.output a
a(X) :- b(X).",
    ),
    (
        "undef_rel_head",
        ".decl a(x:number)
.output a
b(1).
a(1).",
    ),
    (
        "undef_rel_neg",
        ".decl a(x:number)
a(1) :- !b(1).",
    ),
    (
        "undef_rel_agg",
        ".decl a(x:number)
a(X) :- X = count : b(_).",
    ),
    (
        "arity_body",
        ".decl a(x:number) .decl b(x:number,y:number)
b(1,2).
a(X) :- b(X).",
    ),
    (
        "arity_head",
        ".decl a(x:number)
a(1,2).",
    ),
    (
        "underscore_cmp",
        ".decl a(x:number)
a(1). .decl b(x:number)
b(X) :- a(X), X = _.",
    ),
    (
        "underscore_cmp2",
        ".decl a(x:number)
a(1). .decl b(x:number)
b(X) :- a(X), _ < X.",
    ),
    (
        "lattice_storage",
        ".decl a(x: symbol, c: number) btree_max
a(\"x\", 1).",
    ),
    (
        "iteration",
        ".decl a(x: number)
a(0). a(X + 1) :- a(X), __ITERATION__ < 10.",
    ),
    (
        "delta",
        ".decl a(x: number)
.debug_delta a()
a(0).",
    ),
    (
        "mutual_agg",
        ".decl a(x:number,y:number) .decl b(x:number) a(1,2).
b(x) :- x = max y : { a(_, y), y < z }, z = max w : { a(_, w), w < x }.",
    ),
    (
        "undef_functor",
        ".decl a(x:number)
a(@f(1)).",
    ),
    (
        "fact_var",
        ".decl a(x:number)
a(X).",
    ),
    (
        "fact_var_agg",
        ".decl a(x:number)
a(X+1).",
    ),
    (
        "fact_autoinc",
        ".decl a(x:number)
a(autoinc()).",
    ),
    (
        "fact_underscore",
        ".decl a(x:number)
a(_).",
    ),
    (
        "head_underscore",
        ".decl a(x:number) .decl b(x:number) b(1).
a(_) :- b(_).",
    ),
    (
        "subs_diff",
        ".decl a(x:number) btree_delete .decl b(x:number) btree_delete a(1). b(2).
a(X) <= b(Y) :- X < Y.",
    ),
    (
        "autoinc_rec",
        ".decl a(x:number) a(1).
a(autoinc()) :- a(X), X < 10.",
    ),
    (
        "undef_type",
        ".decl a(x:foo)
",
    ),
    (
        "dup_attr",
        ".decl a(x:number, x:number)
a(1,2).",
    ),
    (
        "choice_attr",
        ".decl a(x:number, y:number) choice-domain z
a(1,2).",
    ),
    (
        "eqrel_dom",
        r#".decl a(x:number, y:symbol) eqrel
a(1,"2")."#,
    ),
    (
        "eqrel_arity3",
        ".decl a(x:number, y:number, z:number) eqrel
a(1,2,3).",
    ),
    (
        "eqrel_arity1",
        ".decl a(x:number) eqrel
a(1).",
    ),
    (
        "btree_delete_null",
        ".decl a() btree_delete
a().",
    ),
    ("dir_undef", ".output zzz"),
    ("dir_undef_in", ".input zzz"),
    ("dir_undef_ps", ".printsize zzz"),
    ("dir_undef_ls", ".limitsize zzz(n=3)"),
    (
        "witness_count",
        ".decl a(x:number,y:number) a(1,2). .decl r(x:number,c:number)
r(x,c) :- c = count : a(x,_).",
    ),
    (
        "witness_sum",
        ".decl a(x:number,y:number) a(1,2). .decl r(x:number,c:number)
r(x,c) :- c = sum y : a(x,y).",
    ),
    (
        "witness_mean",
        ".decl a(x:number,y:float) a(1,2.0). .decl r(x:number,c:float)
r(x,c) :- c = mean y : a(x,y).",
    ),
    (
        "inline_io",
        ".decl a(x:number) inline
.output a
a(1).",
    ),
    (
        "inline_in",
        ".decl a(x:number) inline
.input a
",
    ),
    (
        "inline_cycle",
        ".decl a(x:number) inline .decl b(x:number) inline .decl c(x:number) .output c c(X):-a(X).
a(X) :- b(X). b(X) :- a(X).",
    ),
    (
        "inline_self",
        ".decl a(x:number) inline .decl c(x:number) .output c c(X):-a(X).
a(X) :- a(X).",
    ),
    (
        "inline_counter",
        ".decl a(x:number) inline .decl b(x:number) .decl c(x:number) b(1). .output c a(autoinc()) :- b(_). c(X) :- a(X).",
    ),
    (
        "inline_counter2",
        ".decl a(x:number) inline .decl b(x:number) .decl c(x:number) b(1). .output c a(X) :- b(X). c(X) :- b(X), a(autoinc()).",
    ),
    (
        "inline_neg_newvar",
        ".decl a(x:number) inline .decl b(x:number,y:number) .decl c(x:number) b(1,2). .output c a(X) :- b(X,Y), Y > 1. c(X) :- b(X,_), !a(X).",
    ),
    (
        "inline_agg",
        ".decl a(x:number) inline .decl b(x:number) .decl c(x:number) b(1). .output c a(X) :- b(X). c(X) :- X = count : a(_).",
    ),
    (
        "inline_neg_unnamed",
        ".decl a(x:number,y:number) inline .decl b(x:number,y:number) .decl c(x:number) b(1,1). .output c a(X,Y) :- b(X,Y). c(X) :- b(X,_), !a(X,_).",
    ),
    (
        "clash_type_rel",
        ".type A <: number
.decl A(x:number)
A(1).",
    ),
    (
        "clash_comp_rel",
        ".comp A { .decl x(y:number) }
.decl A(x:number)
A(1).",
    ),
    (
        "clash_comp_type",
        ".comp A { .decl x(y:number) }
.type A <: symbol
",
    ),
    (
        "clash_inst_rel",
        ".comp A { .decl x(y:number) }
.decl b(x:number)
b(1).
.init b = A",
    ),
    (
        "clash_inst",
        ".comp A { .decl x(y:number) }
.init b = A
.init b = A",
    ),
    (
        "clash_comp2",
        ".comp A { .decl x(y:number) }
.comp A { .decl y(x:number) }",
    ),
    (
        "redef_rel",
        ".decl a(x:number)
.decl a(x:number)
a(1).",
    ),
    (
        "redef_type",
        ".type T <: number
.type T <: symbol",
    ),
    (
        "redef_ps",
        ".decl a(x:number)
a(1).
.printsize a
.printsize a",
    ),
    (
        "redef_ls",
        ".decl a(x:number)
a(1).
.limitsize a(n=1)
.limitsize a(n=2)",
    ),
    ("redef_prim", ".type number <: symbol"),
    (
        "ungrounded_head",
        ".decl a(x:number) .decl b(x:number) b(1).
a(X) :- b(Y).",
    ),
    (
        "ungrounded_neg",
        ".decl a(x:number) .decl b(x:number) b(1).
a(1) :- !b(Y).",
    ),
    (
        "ungrounded_cmp",
        ".decl a(x:number) .decl b(x:number) b(1).
a(X) :- b(X), Y < X.",
    ),
    (
        "ungrounded_rec",
        ".type R=[a:number] .decl a(x:R) .decl b(x:number) b(1).
a([X]) :- b(Y), Y>0.",
    ),
    (
        "ungrounded_fun",
        ".decl a(x:number) .decl b(x:number) b(1).
a(X) :- b(X+1).",
    ),
    (
        "ungrounded_agg",
        ".decl a(x:number) .decl b(x:number) b(1).
a(X) :- X = sum Z : { b(Y), Y > 0 }.",
    ),
    (
        "ungrounded_eqcycle",
        ".decl a(x:number) .decl b(x:number) b(1).
a(X) :- b(_), X = Y, Y = X.",
    ),
    (
        "neg_cycle",
        ".decl a(x:number) .decl b(x:number) .decl c(x:number) c(1).
a(X) :- c(X), !b(X). b(X) :- c(X), !a(X).",
    ),
    (
        "neg_self",
        ".decl a(x:number) .decl c(x:number) c(1).
a(X) :- c(X), !a(X).",
    ),
    (
        "agg_cycle",
        ".decl a(x:number) .decl c(x:number) c(1).
a(X) :- c(X), X = count : a(_).",
    ),
    (
        "agg_cycle2",
        ".decl a(x:number) .decl b(x:number) .decl c(x:number) c(1).
a(X) :- c(X), X = count : b(_). b(X) :- a(X).",
    ),
    ("comp_undef", ".init a = Foo"),
    (
        "comp_undef_base",
        ".comp A : B { .decl x(y:number) }
.init a = A",
    ),
    (
        "comp_undef_base_uninst",
        ".comp A : B { .decl x(y:number) }
",
    ),
    (
        "comp_params",
        ".comp A<T> { .decl x(y:T) }
.init a = A",
    ),
    (
        "comp_params2",
        ".comp A<T> { .decl x(y:T) }
.init a = A<number,symbol>",
    ),
    (
        "comp_params_base",
        ".comp A<T> { .decl x(y:T) }
.comp B : A { }
.init a = B",
    ),
    (
        "comp_override_noninh",
        ".comp A { .decl x(y:number) overridable .override x x(1). }
.init a = A",
    ),
    (
        "comp_override_nonover",
        ".comp A { .decl x(y:number) x(1). }
.comp B : A { .override x x(2). }
.init a = B",
    ),
    (
        "comp_override_unmade",
        ".comp A { .decl x(y:number) overridable .decl z(y:number) x(1). z(1). }
.comp B : A { x(2). }
.comp C : B { .override z z(3). }",
    ),
    ("comp_override_own_unmade", ".comp A { .decl x(y:number) overridable .override x x(1). }"),
    (
        "comp_cycle",
        ".comp A : B { }
.comp B : A { }
.init a = A",
    ),
    (
        "comp_cycle_self",
        ".comp A : A { }
.init a = A",
    ),
    (
        "comp_inst_rec",
        ".comp A { .init b = A .decl x(y:number) }
.init a = A",
    ),
    ("comp_undef_nested", ".comp A { .init b = Foo }"),
    (
        "comp_redef",
        ".comp A { .decl x(y:number) }
.comp B : A { .decl x(y:number) }
.init b = B",
    ),
    (
        "comp_rel_undef",
        ".comp A { .decl x(y:number) x(Y) :- z(Y). }
.init b = A",
    ),
    (
        "comp_orphan",
        ".comp A { zz(1). }
.init b = A",
    ),
    (
        "esc",
        r#".decl a(x:symbol)
a("b\q")."#,
    ),
    (
        "ip",
        ".decl a(x:number)
a(300.1.1.1).",
    ),
    (
        "comment",
        ".decl a(x:number)
a(1). /* abc",
    ),
    (
        "nodot",
        ".decl a(x:number)
a(1)
a(2).",
    ),
    ("nodecl", "decl a(x:number)"),
    (
        "badchar",
        ".decl a(x:number)
a(1) & a(2).",
    ),
    ("agg_disj_arity", ".decl a(x:number) a(1). .decl b(x:number) b(X) :- X = sum : a(_)."),
    ("count_expr", ".decl a(x:number) a(1). .decl b(x:number) b(X) :- X = count Y : a(Y)."),
    ("max_noexpr", ".decl a(x:number) a(1). .decl b(x:number) b(X) :- X = max : a(_)."),
    ("sum_func", ".decl b(x:number) b(sum(1,2))."),
    ("min_single", ".decl b(x:number) b(min(1))."),
    (
        "tag_dup",
        ".decl a(x:number) btree brie
a(1).",
    ),
    (
        "tag_dup2",
        ".decl a(x:number) eqrel eqrel
",
    ),
    (
        "tag_dup3",
        ".decl a(x:number) inline inline
",
    ),
    (
        "plan_bad",
        ".decl a(x:number,y:number) .decl e(x:number,y:number) e(1,2). .output a
a(X,Y):-e(X,Y).
a(X,Z) :- a(X,Y), e(Y,Z). .plan 0:(1,3)",
    ),
    (
        "plan_bad2",
        ".decl a(x:number,y:number) .decl e(x:number,y:number) e(1,2). .output a
a(X,Y):-e(X,Y).
a(X,Z) :- a(X,Y), e(Y,Z). .plan 0:(1)",
    ),
    (
        "plan_ver",
        ".decl a(x:number,y:number) .decl e(x:number,y:number) e(1,2). .output a
a(X,Y):-e(X,Y).
a(X,Z) :- a(X,Y), e(Y,Z). .plan 1:(1,2)",
    ),
    (
        "pp_if",
        "#ifdef A
.decl a(x:number)
",
    ),
    (
        "pp_endif",
        ".decl a(x:number)
#endif
a(1).",
    ),
    (
        "ty_str_num",
        r#".decl a(x:number)
a("x")."#,
    ),
    (
        "ty_num_str",
        ".decl a(x:symbol)
a(1).",
    ),
    ("ty_num_sub", ".decl n(x:N) .decl m(x:M) n(1). m(X) :- n(X)."),
    ("ty_super_sub", ".decl n(x:N) .decl m(x:number) m(1). n(X) :- m(X)."),
    ("ty_union_sub", ".decl n(x:N) .decl m(x:U) m(1). n(X) :- m(X)."),
    ("ty_join_sib", ".decl n(x:N) .decl m(x:M) .decl r(x:number) n(1). m(1). r(X) :- n(X), m(X)."),
    ("ty_union_mixed", ".type Q = N | S"),
    ("ty_union_undef", ".type Q = N | Foo"),
    ("ty_union_rec", ".type Q = N | R"),
    ("ty_union_cyc", ".type Q = N | Q"),
    ("ty_alias_undef", ".type Q = Foo"),
    ("ty_sub_undef", ".type Q <: Foo"),
    ("ty_sub_cyc", ".type Q <: W .type W <: Q"),
    ("ty_alias_cyc", ".type Q = W .type W = Q"),
    ("ty_sub_union_base", ".type Q <: U"),
    ("ty_sub_rec_base", ".type Q <: R"),
    ("ty_rec_undef", ".type Q = [a:Foo]"),
    ("ty_rec_dup", ".type Q = [a:number,a:number]"),
    ("ty_adt_undef", ".type Q = QQ {a:Foo}"),
    ("ty_adt_dup", ".type Q = X {a:number}"),
    ("ty_adt_dup2", ".type Q = QA {a:number} | QA {}"),
    ("ty_branch_undef", ".decl a(x:A) a($W(1))."),
    ("ty_branch_arity", ".decl a(x:A) a($X(1,2))."),
    ("ty_branch_type", r#".decl a(x:A) a($X("s"))."#),
    ("ty_branch_wrong", ".type B = BX {} .decl a(x:A) a($BX())."),
    ("ty_rec_arity", ".decl a(x:R) a([1])."),
    ("ty_rec_type", r#".decl a(x:R) a(["a",1])."#),
    ("ty_rec_ambig", r#".decl a(x:number) a(1) :- [1,"a"] = [1,"a"]."#),
    ("ty_nil_num", ".decl a(x:number) a(nil)."),
    ("ty_nil_adt", ".decl a(x:A) a(nil)."),
    ("ty_rec_num", r#".decl a(x:number) a([1,"a"])."#),
    (
        "ty_cmp_diff",
        r#".decl a(x:number) .decl b(x:symbol) .decl c(x:number) a(1). b("x"). c(X) :- a(X), b(Y), X < Y."#,
    ),
    (
        "ty_cmp_eq",
        r#".decl a(x:number) .decl b(x:symbol) .decl c(x:number) a(1). b("x"). c(X) :- a(X), b(Y), X = Y."#,
    ),
    (
        "ty_cmp_ne",
        r#".decl a(x:number) .decl b(x:symbol) .decl c(x:number) a(1). b("x"). c(X) :- a(X), b(Y), X != Y."#,
    ),
    ("ty_cmp_rec", r#".decl a(x:R) .decl c(x:R) a([1,"a"]). c(X) :- a(X), a(Y), X < Y."#),
    ("ty_match_num", r#".decl a(x:number) .decl c(x:number) a(1). c(X) :- a(X), match("a", X)."#),
    (
        "ty_contains_num",
        r#".decl a(x:number) .decl c(x:number) a(1). c(X) :- a(X), contains(X, "a")."#,
    ),
    ("ty_cat_num", r#".decl a(x:symbol) a(cat("a", 1))."#),
    ("ty_strlen_num", ".decl a(x:number) a(strlen(1))."),
    ("ty_substr", r#".decl a(x:symbol) a(substr("abc", "1", 1))."#),
    ("ty_substr_ar", r#".decl a(x:symbol) a(substr("abc", 1))."#),
    ("ty_add_str", r#".decl a(x:number) a(1+"a")."#),
    ("ty_add_var", r#".decl b(x:symbol) b("a"). .decl a(x:number) a(X+1) :- b(X)."#),
    ("ty_mix_uf", ".decl a(x:number) a(1+2u)."),
    ("ty_float_num", ".decl a(x:number) a(1.5)."),
    ("ty_num_float", ".decl a(x:float) .decl b(x:number) b(1). a(X) :- b(X)."),
    ("ty_neg_uns", ".decl a(x:unsigned) a(-1)."),
    ("ty_uns_num", ".decl a(x:number) a(1u)."),
    ("ty_fmod", ".decl a(x:float) a(5.0 % 2.0)."),
    ("ty_fband", ".decl a(x:float) a(5.0 band 2.0)."),
    ("ty_sum_str", r#".decl b(x:symbol) b("1"). .decl a(x:symbol) a(X) :- X = sum Y : b(Y)."#),
    ("ty_max_str", r#".decl b(x:symbol) b("1"). .decl a(x:symbol) a(X) :- X = max Y : b(Y)."#),
    ("ty_count_sym", ".decl b(x:number) b(1). .decl a(x:symbol) a(X) :- X = count : b(_)."),
    (
        "ty_neg_atom",
        r#".decl b(x:number) b(1). .decl s(x:symbol) s("a"). .decl a(x:number) a(X) :- b(X), !s(X)."#,
    ),
    ("ty_as_wider", r#".decl a(x:symbol) a("a"). .decl b(x:S) b(as(X, symbol)) :- a(X)."#),
    ("ty_as_undef", ".decl a(x:number) a(as(1, Foo))."),
    ("ty_functor_undef_ty", ".functor f(Foo):number"),
    (
        "ty_functor_redef",
        ".functor f(number):number
.functor f(number):number",
    ),
    ("ty_ord", r#".decl a(x:symbol) a(ord("a"))."#),
    ("ty_tonum_rec", r#".decl a(x:number) a(to_number([1,"a"]))."#),
    (
        "ty_var_conflict",
        r#".decl n(x:number) .decl s(x:symbol) .decl r(x:number) n(1). s("a"). r(X) :- n(X), s(X)."#,
    ),
    ("ty_adt_cmp", ".decl a(x:A) .decl b(x:A) a($Z()). b(X) :- a(X), X < $Z()."),
    ("ty_range_mixed", ".decl a(x:number) a(X) :- X = range(1, 2.0)."),
    ("ty_branch_noparen_args", ".decl a(x:A) a($X)."),
];

const TAKEN: &[(&str, &str)] = &[
    (
        "type_bare_before_a_fact",
        ".decl a(x: T) .output a
.type T
a(\"x\").
.type S
g.a(1).
.comp G { .decl a(x: number) }
.init g = G",
    ),
    (
        "functor_declared_only",
        ".functor f(x: number, symbol): number stateful .functor g(): symbol",
    ),
    (
        "named_as_a_primitive",
        ".decl number(x: number) .decl float(x: number) number(1). float(X) :- number(X).",
    ),
    (
        "warn_once",
        ".decl a(x:number) .decl b(x:number,y:number) b(1,2).
a(X) :- b(X,Y).",
    ),
    (
        "warn_marked",
        ".decl a(x:number) .decl b(x:number,y:number) b(1,1).
a(_X) :- b(_X,_X).",
    ),
    (
        "btree_delete_nosub",
        ".decl a(x:number) btree_delete
a(1).",
    ),
    ("norules", ".decl a(x:number) .decl b(x:number) .output b b(X) :- a(X)."),
    (
        "witness_max",
        ".decl a(x:number,y:number) a(1,2). .decl r(x:number,c:number) .output r
r(x,c) :- c = max y : a(x,y).",
    ),
    (
        "two_out",
        r#".decl a(x:number)
a(1).
.output a
.output a(filename="b.csv")"#,
    ),
    (
        "plan_ok",
        ".decl a(x:number,y:number) .decl e(x:number,y:number) e(1,2). .output a
a(X,Y):-e(X,Y).
a(X,Z) :- a(X,Y), e(Y,Z). .plan 0:(2,1)",
    ),
    ("ty_sub_super", ".decl n(x:N) .decl m(x:number) n(1). m(X) :- n(X)."),
    ("ty_sub_union", ".decl n(x:N) .decl m(x:U) n(1). m(X) :- n(X)."),
    ("ty_union_join", ".decl n(x:N) .decl m(x:U) n(1). m(1). n(X) :- n(X), m(X)."),
    ("ty_cmp_sym", r#".decl b(x:symbol) .decl c(x:symbol) b("x"). c(X) :- b(X), X < "z"."#),
    ("ty_const_float", ".decl a(x:float) a(1)."),
    ("ty_const_uns", ".decl a(x:unsigned) a(1)."),
    (
        "ty_neg_atom_sub",
        ".decl b(x:N) b(1). .decl s(x:M) s(1). .decl a(x:number) a(X) :- b(X), !s(X).",
    ),
    (
        "comp_override_of_a_parameter",
        ".comp A { .decl x(y:number) overridable x(1). }
.comp B<T> : T { .override x x(2). }
.init b = B<A>",
    ),
    ("ty_as_ok", ".decl m(x:M) .decl n(x:N) n(1). m(as(X,M)) :- n(X)."),
];
