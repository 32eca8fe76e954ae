//! Corridor road graphs: the paper's example whole, and faults of descriptions and questions.

use std::fmt::Write as _;

use expect_test::{Expect, expect, expect_file};
use orthoframe_corridor::{
    ArcIx, Command, CorridorError, CorridorSystem, Directions, DoubleArcKind, DoubleGraph,
    SingleGraph, Variant, directions, figure,
};
use orthoframe_draw::{CorridorArc, CorridorDrawing, CorridorMark, CorridorVertex, corridor_svg};
use orthoframe_units::Source;

const PAPER: &str = include_str!("../maps/corridor-paper4.toml");

fn read(text: &str) -> Result<CorridorSystem, String> {
    CorridorSystem::from_toml(&Source::new("к.toml", text)).map_err(|e| e.to_string())
}

fn paper() -> CorridorSystem {
    let system = read(PAPER).unwrap();
    system.check_invariants();
    system
}

fn pair(system: &CorridorSystem, arc: ArcIx) -> (u32, u32) {
    let number = |v| system.vertex(v).number;
    (number(system.tail(arc).vertex), number(system.head(arc).vertex))
}

fn way(system: &CorridorSystem, from: &str, last: Option<(u32, u32)>, to: &str) -> Directions {
    let [one, two] = [Variant::Single, Variant::Double]
        .map(|variant| directions(system, from, last, to, variant).unwrap());
    assert_eq!(one.commands(), two.commands(), "{from} {last:?} {to}");
    assert!((one.cost - two.cost).abs() < 1e-9, "{from} {last:?} {to}");
    assert_eq!(one.arrived_by, two.arrived_by);
    one
}

fn russian(directions: &Directions) -> Vec<&str> {
    directions.steps.iter().map(|s| s.ru.as_str()).collect()
}

#[test]
fn paper_variant_1_has_nine_vertices_and_sixteen_arcs() {
    let system = paper();
    let graph = SingleGraph::new(&system).unwrap();
    assert_eq!((graph.graph.node_count(), graph.graph.edge_count()), (9, 16));
    let code = |from, to| {
        let ends = [from, to].map(|n| system.numbered(n).unwrap());
        system.code(system.arc_between(ends[0], ends[1]).unwrap()).number()
    };
    assert_eq!([code(1, 2), code(3, 2), code(7, 2)], [3, 4, 2]);
    assert_eq!([code(2, 1), code(2, 7), code(8, 7), code(4, 5)], [12, 11, 12, 12]);
}

#[test]
fn paper_table_3() {
    let system = paper();
    let mut rows: Vec<_> = SingleGraph::new(&system)
        .unwrap()
        .table
        .iter()
        .map(|row| (pair(&system, row.first), pair(&system, row.second), row.turn.code()))
        .collect();
    rows.sort_unstable();
    let mut table = vec![
        ((1, 2), (2, 3), 0),
        ((1, 2), (2, 7), 1),
        ((7, 2), (2, 3), 1),
        ((7, 2), (2, 1), 2),
        ((3, 2), (2, 1), 0),
        ((3, 2), (2, 7), 2),
    ];
    table.sort_unstable();
    assert_eq!(rows, table);
}

#[test]
fn paper_variant_2_has_two_vertices_per_entrance() {
    let system = paper();
    let graph = DoubleGraph::new(&system).unwrap();
    let count = |kind| graph.graph.edge_weights().filter(|arc| arc.kind == kind).count();
    assert_eq!(graph.graph.node_count(), 16);
    assert_eq!(count(DoubleArcKind::UTurn), 16);
    assert_eq!(count(DoubleArcKind::Corridor), 10);
    assert_eq!(count(DoubleArcKind::Junction), 6);
}

#[test]
fn paper_variant_2_command_lists() {
    let system = paper();
    let graph = DoubleGraph::new(&system).unwrap().graph;
    let labels = DoubleGraph::new(&system).unwrap();
    let mut text = String::new();
    for edge in graph.edge_indices().filter(|e| graph[*e].kind == DoubleArcKind::Junction) {
        let (from, to) = graph.edge_endpoints(edge).unwrap();
        let words: Vec<_> = graph[edge].commands.iter().map(|c| c.russian()).collect();
        writeln!(text, "{} → {}: {}", labels.label(from), labels.label(to), words.join(", "))
            .unwrap();
    }
    expect![[r#"
        1 → 3: движение до соединения коридоров, движение прямо, движение до двери слева
        1 → 7: движение до соединения коридоров, поворот направо, движение до двери справа
        3' → 1': движение до соединения коридоров, движение прямо, движение до двери слева
        3' → 7: движение до соединения коридоров, поворот налево, движение до двери справа
        7' → 1': движение до соединения коридоров, поворот налево, движение до двери слева
        7' → 3: движение до соединения коридоров, поворот направо, движение до двери слева
    "#]]
    .assert_eq(&text);
}

/// The thirteen states (an arc that ends at an entrance) times the eight goals.
#[test]
fn paper_all_104_pairs_of_state_and_goal() {
    let system = paper();
    let mut text = String::new();
    let mut pairs = 0;
    for last in system.arcs() {
        let Some(at) = system.vertex(system.head(last).vertex).entrance() else { continue };
        for (_, goal) in system.vertices() {
            let Some(to) = goal.entrance() else { continue };
            let found = way(&system, &at.room, Some(pair(&system, last)), &to.room);
            let (a, b) = pair(&system, last);
            writeln!(text, "({a}, {b}) {} → {}: {}", at.room, to.room, russian(&found).join(", "))
                .unwrap();
            pairs += 1;
        }
    }
    assert_eq!(pairs, 104);
    expect_file!["golden/corridor/paper4/all-pairs.txt"].assert_eq(&text);
}

#[test]
fn a_u_turn_comes_first_when_the_way_starts_back() {
    let system = paper();
    let back = way(&system, "201", Some((1, 0)), "210");
    assert_eq!(back.commands()[0], Command::UTurn);
    assert_eq!(back.path, ["0", "1", "2", "7", "8"]);
    assert_eq!(back.arrived_by, Some((7, 8)));
    let on = way(&system, "203", Some((2, 3)), "206");
    assert!(!on.commands().contains(&Command::UTurn));
    assert_eq!(on.ru, ["Проезжайте до 3-го входа, дверь справа."]);
    assert_eq!(on.en, ["Drive to the 3rd entrance, the door on the right."]);
}

#[test]
fn an_unknown_heading_is_told_by_the_door_beside_the_robot() {
    let found = way(&paper(), "202", None, "208");
    assert_eq!(
        russian(&found),
        [
            "встать вдоль коридора, чтобы дверь была справа",
            "движение до соединения коридоров",
            "поворот направо",
            "движение до двери справа"
        ]
    );
}

#[test]
fn a_robot_at_its_goal_stays() {
    let found = way(&paper(), "202", Some((0, 1)), "202");
    assert!(found.steps.is_empty());
    assert_eq!(found.ru, ["Робот уже у цели."]);
    assert_eq!(found.arrived_by, Some((0, 1)));
}

#[test]
fn variant_1_can_start_at_a_junction() {
    let system = paper();
    let from = |last| directions(&system, "#2", last, "208", Variant::Single);
    assert_eq!(
        russian(&from(Some((1, 2))).unwrap()),
        ["поворот направо", "движение до двери справа"]
    );
    assert_eq!(
        russian(&from(Some((7, 2))).unwrap()),
        ["разворот", "движение до двери слева"][..1]
            .iter()
            .copied()
            .chain(["движение до двери справа"])
            .collect::<Vec<_>>()
    );
    assert!(matches!(from(None), Err(CorridorError::HeadingNeeded { vertex: 2 })));
    let second = directions(&system, "#2", Some((1, 2)), "208", Variant::Double);
    assert!(matches!(second, Err(CorridorError::AtJunction { vertex: 2 })));
}

fn refused(from: &str, last: Option<(u32, u32)>, to: &str, expected: &Expect) {
    let system = read(&format!(
        "{PAPER}\n[[corridor]]\nalong = [ {{ vertex = 20, room = \"Склад\", side = \"right\" }}, {{ vertex = 21, room = \"202\", side = \"left\" }} ]"
    ))
    .unwrap();
    let [one, two] = [Variant::Single, Variant::Double].map(|variant| {
        let error = directions(&system, from, last, to, variant).unwrap_err();
        let help = miette::Diagnostic::help(&error).map(|h| h.to_string()).unwrap_or_default();
        format!("{error}\n{help}")
    });
    assert_eq!(one, two);
    expected.assert_eq(&one);
}

#[test]
fn unknown_room() {
    refused(
        "201",
        None,
        "211",
        &expect![[r#"
        неизвестное помещение «211»: в коридоры не выходит вход с таким именем
        может быть, «201»?"#]],
    );
    refused(
        "Склат",
        None,
        "201",
        &expect![[r#"
        неизвестное помещение «Склат»: в коридоры не выходит вход с таким именем
        может быть, «Склад»?"#]],
    );
    refused(
        "#99",
        None,
        "201",
        &expect![[r#"
        вершины 99 в системе коридоров нет
        вершины нумеруются так: 0, 1, 2, 3, 4, 5, 6, 7, 8, 20, 21"#]],
    );
}

#[test]
fn corridors_that_do_not_meet() {
    refused(
        "201",
        None,
        "Склад",
        &expect![[r#"
        из «201» нельзя проехать по коридорам в «Склад»
        их коридоры не соединены"#]],
    );
}

#[test]
fn a_position_that_cannot_be() {
    refused(
        "201",
        Some((0, 1)),
        "206",
        &expect![[r#"
        робот не может стоять в вершине 0, если последней пройдена дуга (0, 1)
        последняя дуга должна вести в вершину 0; если курс неизвестен, не указывайте её"#]],
    );
    refused(
        "201",
        Some((5, 0)),
        "206",
        &expect![[r#"
        дуги (5, 0) в графе нет
        последняя дуга ведёт в вершину 0 из соседней с ней: 1"#]],
    );
    refused(
        "202",
        None,
        "206",
        &expect![[r#"
        у помещения «202» несколько входов: вершины 1, 21
        укажите вершину (например, #1) или последнюю пройденную дугу"#]],
    );
    refused(
        "201",
        None,
        "#2",
        &expect![[r#"
        цель – вершина 2, а это соединение коридоров, не вход
        назовите помещение или вершину входа"#]],
    );
}

#[test]
fn a_room_with_two_entrances_is_reached_by_the_nearer() {
    let system = read(&format!("{PAPER}\n[[corridor]]\nalong = [ {{ vertex = 9, room = \"208\", side = \"right\" }}, {{ vertex = 10, room = \"201\", side = \"left\" }} ]")).unwrap();
    assert_eq!(way(&system, "#9", None, "201").to_vertex, 10);
    assert_eq!(way(&system, "202", None, "201").to_vertex, 0);
    assert_eq!(way(&system, "208", Some((8, 7)), "201").from_vertex, 7);
}

#[test]
fn metres_and_the_weight_of_a_u_turn_choose_the_way() {
    // A ring of four doors: forth the long way without a U-turn, or back the short way with one.
    let ring = |u_turn: f64| {
        read(&format!(
            r#"
            format = 1
            measure = "metres"
            u_turn = {u_turn}
            [[corridor]]
            closed = true
            along = [
              {{ vertex = 0, room = "A", side = "right", metres = 5 }},
              {{ vertex = 1, room = "B", side = "right", metres = 5.0 }},
              {{ vertex = 2, room = "C", side = "right", metres = 5 }},
              {{ vertex = 3, room = "D", side = "right", metres = 5 }},
            ]"#
        ))
        .unwrap()
    };
    assert_eq!(way(&ring(1.0), "B", Some((0, 1)), "A").path, ["1", "0"]);
    assert_eq!(way(&ring(100.0), "B", Some((0, 1)), "A").path, ["1", "2", "3", "0"]);
    assert!((way(&ring(1.0), "B", Some((0, 1)), "A").cost - 6.0).abs() < 1e-9);
}

#[test]
fn metres_need_lengths() {
    let system = read(&PAPER.replace("measure = \"arcs\"", "measure = \"metres\"")).unwrap();
    let error = directions(&system, "201", None, "202", Variant::Single).unwrap_err();
    assert!(matches!(error, CorridorError::NoLength { from: 0, to: 1 }));
}

/// Every folder of faulty files: the text and what is said of it.
#[test]
fn faulty_files_are_refused_with_all_their_faults() {
    let folder =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/corridor/faults");
    let mut cases = 0;
    for case in std::fs::read_dir(&folder).unwrap() {
        let case = case.unwrap().path();
        let text = std::fs::read_to_string(case.join("input.toml")).unwrap();
        let error = CorridorSystem::from_toml(&Source::new("input.toml", &text)).unwrap_err();
        let mut said = error.to_string();
        for fault in &error.faults {
            let part = |d: Option<Box<dyn std::fmt::Display + '_>>| d.map(|d| d.to_string());
            let code = part(miette::Diagnostic::code(fault)).unwrap();
            write!(said, "\n{code}: {}", part(miette::Diagnostic::help(fault)).unwrap()).unwrap();
        }
        said.push('\n');
        expect_file![case.join("expected.txt")].assert_eq(&said);
        cases += 1;
    }
    assert!(cases >= 6);
}

#[test]
fn rubbish_is_refused_without_panic() {
    let deep = format!("corridor = {}1{}", "[".repeat(5_000), "]".repeat(5_000));
    let long = format!("name = \"{}\"", "я".repeat(1_000_000));
    let huge = "format = 1\n[[corridor]]\nalong = [ { vertex = 99999999999999999999, room = \"1\", side = \"left\", metres = nan } ]";
    let texts = [
        "",
        "\0\u{1}",
        "[[",
        "corridor = 1",
        "format = \"1\"",
        "[corridor]\nalong = 5",
        huge,
        &deep,
        &long,
    ];
    for text in texts {
        assert!(read(text).is_err(), "{}", &text[..text.len().min(40)]);
    }
    // Another notation is one fault, not one a line.
    let json = format!("\n{{\n{}\n}}", "\"format\": 1,\n".repeat(500));
    assert!(read(&json).unwrap_err().starts_with("описание коридоров не принято, ошибок: 1\n"));
}

#[test]
fn every_cut_and_every_lost_line_of_a_good_file_is_borne() {
    for at in (0..PAPER.len()).filter(|at| PAPER.is_char_boundary(*at)) {
        let _ = read(&PAPER[..at]);
    }
    let lines: Vec<&str> = PAPER.lines().collect();
    for gone in 0..lines.len() {
        let mut rest = lines.clone();
        rest.remove(gone);
        if let Ok(system) = read(&rest.join("\n")) {
            system.check_invariants();
        }
    }
}

fn drawn(system: &CorridorSystem, way: &Directions, variant: Variant) -> String {
    let figure = figure(system, variant, &way.path).unwrap();
    let vertices = figure.vertices.into_iter().map(|v| CorridorVertex {
        at: v.at,
        mark: if v.is_junction { CorridorMark::Junction } else { CorridorMark::Entrance },
        label: v.label,
        name: v.name,
        name_towards: v.name_towards,
    });
    let arcs = figure.arcs.into_iter().map(|a| CorridorArc {
        from: a.from,
        to: a.to,
        label: a.label,
        on_way: a.on_way,
        faint: a.is_u_turn,
    });
    corridor_svg(&CorridorDrawing {
        title: format!("{}: вариант {}", system.name, variant.number()),
        vertices: vertices.collect(),
        arcs: arcs.collect(),
        notes: way.ru.clone(),
        ..CorridorDrawing::default()
    })
}

#[test]
fn paper_figures_2_and_3() {
    let system = paper();
    for variant in [Variant::Single, Variant::Double] {
        let way = directions(&system, "206", Some((5, 6)), "210", variant).unwrap();
        let svg = drawn(&system, &way, variant);
        let name = format!("golden/corridor/paper4/variant-{}.svg", variant.number());
        expect_file![name].assert_eq(&svg);
    }
}

/// `ortho route --words`: through a corridor the way is told by its road graph, elsewhere by rooms and doors.
#[test]
fn a_way_in_words_counts_entrances_along_corridors() {
    let mut world = crate::worlds::rb2();
    for door in world.doors.values_mut() {
        match door.name.as_str() {
            "Дверь-КY" => door.state = orthoframe_map::DoorState::OPEN,
            "Дверь-ВZ" => door.state = orthoframe_map::DoorState::CLOSED,
            _ => {}
        }
    }
    let engine = orthoframe::engine::Engine::in_memory(world, None).unwrap();
    let answer = engine.route("Точка-А", "Точка-К", orthoframe::engine::Method::Shortest).unwrap();
    let words = |language| {
        let detail = orthoframe_language::report::Detail::Spot;
        engine.route_in_words(&answer, None, language, detail).unwrap().join("\n")
    };
    expect![[r#"
        Выйдите из Комнаты-В через Проход-ВК в Коридор.
        Встаньте вдоль коридора, чтобы дверь была слева.
        Проезжайте до 1-го входа, дверь прямо.
        Идите прямо до Точки-К."#]]
    .assert_eq(&words(orthoframe_language::Language::Russian));
    let english = words(orthoframe_language::Language::English);
    assert!(english.starts_with("Leave Room V through Passage VK into"), "{english}");
    assert!(english.contains("1st entrance"), "{english}");
}
