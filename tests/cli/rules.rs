//! Relations and rules: what is derived, why, and Datalog programs.

use serde_json::Value;

use super::{Place, project};

#[test]
fn relations_answer_to_both_names() {
    let place = Place::with_rb2();
    let counts = place.json(&["relations"], 0);
    assert!(counts["relations"].as_array().unwrap().len() > 20);
    let facts = |args: &[&str]| place.json(args, 0)["facts"].clone();
    let russian = facts(&["relations", "--name", "НАХОДИТСЯ_СВЕРХУ_НА"]);
    assert_eq!(russian, facts(&["relations", "--name", "ON_TOP_OF"]));
    let medicine = serde_json::json!(
        {"relation": "НАХОДИТСЯ_СВЕРХУ_НА", "args": ["Лекарство", "Тумбочка-2"]}
    );
    assert!(russian.as_array().unwrap().contains(&medicine), "{russian}");
    let of_medicine = facts(&["relations", "--of", "Лекарство"]);
    assert!(of_medicine.as_array().unwrap().contains(&medicine), "{of_medicine}");
    // Another case, another alphabet, other letters.
    for name in ["лекарства", "Medicine", "ЛЕКАРСТВОМ"] {
        assert_eq!(facts(&["relations", "--of", name]), of_medicine, "{name}");
    }
    let both = facts(&["relations", "--name", "ON_TOP_OF", "--of", "Лекарство"]);
    assert_eq!(both, serde_json::json!([medicine]));
}

#[test]
fn why_and_why_not_go_down_to_the_measurements() {
    let place = Place::with_rb2();
    let facts = place.run(&["relations", "--name", "ON_TOP_OF", "--json"]).is(0);
    let facts: Value = serde_json::from_str(&facts.out).unwrap();
    let one = &facts["facts"][0]["args"];
    let (upper, lower) = (one[0].as_str().unwrap(), one[1].as_str().unwrap());
    let why = place.run(&["why", &format!("НАХОДИТСЯ_СВЕРХУ_НА({upper}, {lower})")]).is(0);
    assert!(why.out.starts_with("НАХОДИТСЯ_СВЕРХУ_НА("), "{}", why.out);
    assert!(why.out.contains("over(") && why.out.contains("Gap <= Up: "), "{}", why.out);

    let english =
        place.run(&["why", "--lang", "en", &format!("on_top_of({upper}, \"{lower}\")")]).is(0);
    assert!(
        english.out.starts_with("ON_TOP_OF(") && english.out.contains("RESTS_ON("),
        "{}",
        english.out
    );

    // The other way round it does not hold: the nearest rule, and below it what failed.
    let swapped = format!("ON_TOP_OF({lower}, {upper})");
    let why_not = place.run(&["why", "--not", &swapped]).is(0);
    assert!(why_not.out.contains("- bears(") && why_not.out.contains("- over("), "{}", why_not.out);
    let json = place.run(&["why", "--not", "--json", &swapped]);
    let json: Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(json["holds"], false);
    let failed = &json["nearest"]["premises"][0];
    assert!(failed["holds"] == false && failed["nearest"]["premises"].is_array(), "{json}");

    place.run(&["why", &swapped]).is(1);
    place.run(&["why", "--not", &format!("ON_TOP_OF({upper}, {lower})")]).is(1);
    let wrong = place.run(&["why", "Чашка на столе"]).is(2);
    assert!(wrong.err.contains("не читается как факт"), "{}", wrong.err);
}

#[test]
fn relations_are_kept_in_the_store_for_its_map_and_rules() {
    let place = Place::with_rb2();
    let derived = place.run(&["relations", "--name", "NEXT_TO"]).is(0).out;
    let kept = place.path("ortho-store").join("derived/relations");
    let bytes = std::fs::read(&kept).unwrap_or_else(|_| panic!("{} is there", kept.display()));
    assert_eq!(place.run(&["relations", "--name", "NEXT_TO"]).is(0).out, derived);
    assert_eq!(std::fs::read(&kept).unwrap(), bytes);

    // Other rules: what was kept does not count.
    let rules = std::fs::read_to_string(project("rules/relations.dl")).unwrap();
    place.write(
        "rules/relations.dl",
        rules.replace(
            "limit(\"common\",   \"next most\",         6000)",
            "limit(\"common\",   \"next most\",         0)",
        ),
    );
    assert_ne!(place.run(&["relations", "--name", "NEXT_TO"]).is(0).out, derived);
    assert_ne!(std::fs::read(&kept).unwrap(), bytes);
    // Broken bytes: derived anew.
    std::fs::write(&kept, b"broken").unwrap();
    std::fs::remove_file(place.path("rules/relations.dl")).unwrap();
    assert_eq!(place.run(&["relations", "--name", "NEXT_TO"]).is(0).out, derived);
    assert_eq!(std::fs::read(&kept).unwrap(), bytes);
}

#[test]
fn a_datalog_program_runs_on_files() {
    let place = Place::empty();
    let program = place.write(
        "reach.dl",
        ".decl door(a: symbol, b: symbol)\n.input door\n.decl reach(a: symbol, b: symbol)\n.output reach\n\
         reach(a, b) :- door(a, b).\nreach(a, c) :- reach(a, b), door(b, c).\n"
            ,
    );
    place.write("door.facts", "кухня\tзал\nзал\tспальня\n");
    place.run(&["datalog", &program, "-F", ".", "-D", "."]).is(0);
    let reached = std::fs::read_to_string(place.path("reach.csv")).unwrap();
    assert!(reached.contains("кухня\tспальня"), "{reached}");
    let faulty = place.write("faulty.dl", ".decl p(a: symbol)\np(X) :- q(X).\n");
    let faults = place.json(&["datalog", &faulty], 2)["errors"].clone();
    let at = |f: &Value| (f["line"].as_u64(), f["column"].as_u64());
    assert!(faults.as_array().unwrap().iter().any(|f| at(f) == (Some(2), Some(9))), "{faults}");
}

#[test]
fn a_query_joins_stored_and_computed_relations() {
    let place = Place::with_rb2();
    let medicine = place.json(&["query", "?- ON_TOP_OF(\"Лекарство\", X), CONTAINS(R, X)"], 0);
    assert_eq!(medicine["columns"], serde_json::json!(["X", "R"]));
    assert_eq!(medicine["rows"].as_array().unwrap().len(), 1, "{medicine}");
    assert_eq!(medicine["rows"][0][0], "Тумбочка-2");
    let near = place.json(
        &[
            "query",
            "?- ON_TOP_OF(X, Y), distance_between(X, Z, D), X != Z, D < 3000.order D.limit 3",
        ],
        0,
    );
    let distances: Vec<i64> =
        near["rows"].as_array().unwrap().iter().map(|row| row[3].as_i64().unwrap()).collect();
    assert!(distances.len() == 3 && distances.is_sorted(), "{near}");
    let ways = place.json(
        &["query", "?- CONTAINS(R, \"Лекарство\"), CONTAINS(Q, _), way_length(R, Q, D).order D"],
        0,
    );
    assert!(!ways["rows"].as_array().unwrap().is_empty(), "{ways}");
    let seen = place.json(&["query", "?- seen_from(\"Лекарство\", X)"], 0);
    assert!(!seen["rows"].as_array().unwrap().is_empty(), "{seen}");
    // No answer is "no"; a name that nothing bears is told.
    let nothing = place.json(&["query", "?- ON_TOP_OF(X, \"Стол-99\")"], 1);
    assert_eq!(nothing["unknown"], serde_json::json!(["Стол-99"]));
    let why = place.run(&["query", "--explain", "?- ON_TOP_OF(\"Лекарство\", X)"]).is(0);
    assert!(why.out.contains("over("), "{}", why.out);
    let blocked = place.run(&["query", "?- distance_between(X, Y, D)"]).is(2);
    assert!(blocked.err.contains("РАССТОЯНИЕ_МЕЖДУ"), "{}", blocked.err);
}

#[test]
fn rule_files_take_one_form() {
    let place = Place::empty();
    let path =
        place.write("r.dl", ".decl a(x:number,y:number) output\na(1,2).\n\n\n\na(X,Y):-a(Y,X).\n");
    let changed = place.run(&["rules", "--format", &path]).is(0);
    assert_eq!(changed.out.trim(), path);
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(text, ".decl a(x:number, y:number) output\na(1, 2).\n\na(X, Y) :- a(Y, X).\n");
    assert_eq!(place.run(&["rules", "--format", &path]).is(0).out.trim(), "");
    place.run(&["rules"]).is(2);
}

#[test]
fn a_datalog_run_explains_its_joins() {
    let place = Place::empty();
    let program = place.write(
        "p.dl",
        ".decl e(a: number, b: number)\ne(1, 2). e(2, 3).\n.decl p(a: number, b: number) output\np(A, B) :- e(A, B).\np(A, C) :- p(A, B), e(B, C).\n.decl idle(a: number)\nidle(A) :- e(A, _), A > 3, A < 2.\n.decl all(a: number, b: number) output\nall(A, C) :- e(A, _), p(_, C).\n",
    );
    let out = place.path("").display().to_string();
    let run = place.run(&["datalog", &program, "-D", &out, "--explain"]).is(0);
    for told in ["  p  ", "запусков 1, найдено 2", "p: новые строки", "e по a: строк 2"]
    {
        assert!(run.err.contains(told), "{told}: {}", run.err);
    }
    let args = ["datalog", &program, "-D", &out, "--explain", "--lang", "en"];
    let run = place.run(&args).is(0);
    for told in [
        "  p  ",
        "1 run, 2 found",
        "p: new rows",
        "e by a: 2 rows",
        "is used nowhere",
        "never fires",
        "all pairs",
    ] {
        assert!(run.err.contains(told), "{told}: {}", run.err);
    }
    let is_russian = |c: char| ('а'..='я').contains(&c) || ('А'..='Я').contains(&c);
    assert!(!run.err.contains(is_russian), "{}", run.err);
    let rules = place.json(&args, 0)["rules"].clone();
    let joins = |rule: &Value| rule["joins"].as_array().map_or(0, Vec::len);
    assert!(rules.as_array().unwrap().iter().any(|rule| joins(rule) == 2), "{rules}");
    let limited = place.run(&["datalog", &program, "-D", &out, "--row-limit", "2"]);
    assert!(limited.code != 0 && limited.err.contains("больше 2 строк"), "{}", limited.err);
}

/// What is derived when asked is told where it can be, and never told to be of nothing where it cannot.
#[test]
fn what_is_derived_when_asked_is_not_told_to_be_of_nothing() {
    let place = Place::with_rb2();
    let listed = place.json(&["relations"], 0).to_string();
    assert!(!listed.contains("BETWEEN") && listed.contains("NEXT_TO"), "{listed}");
    let all = place.json(&["relations", "--name", "BETWEEN"], 2);
    assert!(all.to_string().contains("amid"), "{all}");
    let about = ["AHEAD_OF_ROBOT", "BEHIND_ROBOT", "LEFT_OF_ROBOT", "RIGHT_OF_ROBOT"];
    let about = about.map(|name| place.json(&["relations", "--name", name], 0)["facts"].clone());
    assert!(about.iter().any(|facts| !facts.as_array().unwrap().is_empty()), "{about:?}");
}
