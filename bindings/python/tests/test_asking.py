"""What is asked and changes nothing."""

import json

import pytest

import orthoframe
from conftest import FLAT, MAP, ROOT


def test_a_question_is_answered_in_its_own_language(flat):
    assert "bedside" in flat.ask("Where is the medicine?")["text"].lower()
    assert "тумб" in flat.ask("Где лекарство?")["text"].lower()
    answer = flat.ask("What is on Table 1?")
    assert answer["outcome"] == "found" and "ON_TOP_OF" in answer["rule"]
    assert set(answer["bindings"]) == {"Книга-4", "Чашка-1"}


def test_what_is_not_understood_is_an_answer_and_no_exception(flat):
    assert flat.ask("Blorp the wuzzle?")["outcome"] in ("not_understood", "unknown")


def test_relations_are_dicts_and_arrays_of_the_same(flat):
    dicts = flat.relations("ON_TOP_OF")
    table = flat.relation("ON_TOP_OF")
    assert table.name == "ON_TOP_OF" and table.rows.shape == (len(dicts), len(table.columns))
    assert [list(row) for row in table.tuples()] == [fact["args"] for fact in dicts]
    assert flat.relations("ON_TOP_OF", of="Table 1") == [
        {"relation": "ON_TOP_OF", "args": ["Книга-4", "Стол-1"]},
        {"relation": "ON_TOP_OF", "args": ["Чашка-1", "Стол-1"]},
    ]


def test_every_relation_is_an_array_as_numpy_takes_it(flat):
    numpy = pytest.importorskip("numpy")
    for name in [row["name"] for row in flat.relations()["relations"]]:
        table = flat.relation(name)
        rows = numpy.asarray(table.rows)
        assert rows.dtype == numpy.int64 and rows.shape == table.rows.shape
        assert rows.tolist() == table.rows.tolist()
        for column, symbol in enumerate(table.is_symbol):
            if symbol:
                assert 0 <= rows[:, column].min() and rows[:, column].max() < len(table.names)


def test_the_floor_is_convex_and_as_wide_as_its_rooms(flat):
    numpy = pytest.importorskip("numpy")
    floor = flat.floor()
    assert floor.map == MAP and len(floor.rooms) == 4
    assert floor == flat.floor(MAP) or floor.rooms == flat.floor(MAP).rooms
    corners, offsets = numpy.asarray(floor.corners), numpy.asarray(floor.offsets)
    assert offsets[0] == 0 and offsets[-1] == len(corners) and len(floor.room) == len(offsets) - 1
    area = 0.0
    for polygon in floor.polygons():
        p = numpy.array(polygon)
        to, on = numpy.roll(p, -1, axis=0) - p, numpy.roll(p, -2, axis=0) - numpy.roll(p, -1, axis=0)
        turns = to[:, 0] * on[:, 1] - to[:, 1] * on[:, 0]
        assert (turns > -1e-6).all(), "convex and counter-clockwise"
        area += 0.5 * abs((p[:, 0] * numpy.roll(p[:, 1], -1) - p[:, 1] * numpy.roll(p[:, 0], -1)).sum())
    assert 20 * 1e4 < area < 80 * 1e4, "square centimetres of a flat"
    links = {tuple(pair) for pair in floor.links.tolist()}
    assert links and all((b, a) in links for a, b in links)
    room = floor.room.tolist()
    assert all(room[a] == room[b] for a, b in links)


def test_an_array_without_numpy(flat):
    table = flat.relation("ON_TOP_OF")
    flat_numbers = list(table.rows.memoryview())
    assert flat_numbers == [n for row in table.rows.tolist() for n in row]
    with pytest.raises(TypeError):
        table.rows.memoryview()[0] = 1


def test_why_goes_down_to_what_was_measured(flat):
    holds = flat.why("ON_TOP_OF", "Cup 1", "Table 1")
    assert holds["holds"] and holds["proof"][-1]["because"] or holds["proof"]
    assert "measured" in json.dumps(holds)
    not_so = flat.why("ON_TOP_OF", "Cup 1", "Sofa 1")
    assert not not_so["holds"] and not_so["nearest"]["premises"]


def test_a_question_in_the_rules_language(flat):
    answer = flat.query('?- ON_TOP_OF(X, "Стол-1")', proofs=True)
    assert answer["columns"] == ["X"]
    assert sorted(row[0] for row in answer["rows"]) == ["Книга-4", "Чашка-1"]
    assert len(answer["proofs"]) == 2


def test_a_way_and_a_place(flat):
    route = flat.route("Point A", "Room Y")
    assert route["outcome"] == "route" and route["length_cm"] > 100
    assert flat.where(225, 380)["en"] == "I am in Room V at the door leading from Room V to Room Z."
    assert flat.where()["area"] == "Комната-В"


def test_plans(flat):
    planned = flat.plan("Bring the medicine")
    steps = planned["plan"]["events"][0]["steps"]
    assert len(steps) > 4 and all("do_en" in action for step in steps for action in step)
    # Nothing was carried out.
    assert flat.where()["area"] == "Комната-В" and "bedside" in flat.ask("Where is the medicine?")["text"].lower()
    scenario = flat.plan_scenario(ROOT / "rules" / "scenarios" / "medicine-walk.strips", time_limit=60)
    assert scenario["outcome"] == "plan" and scenario["optimal"] and scenario["parallel_steps"] == 5
    assert flat.plan("Where is the cup?")["plan"] is None


def test_a_drawing(flat):
    assert flat.draw().lstrip().startswith("<") and "svg" in flat.draw(MAP, floor=True)[:400]


def test_a_name_that_nothing_bears(flat):
    with pytest.raises(orthoframe.InputError) as caught:
        flat.find("Tabel 1")
    assert caught.value.code and "Tabel 1" in str(caught.value)
    with pytest.raises(ValueError):
        flat.relation("NO_SUCH_RELATION")


def test_faults_of_a_file_come_all_at_once_with_their_places(tmp_path):
    text = FLAT.read_text(encoding="utf-8")
    lines = text.splitlines()
    line = next(n for n, one in enumerate(lines) if 'name_en = "Sofa 1"' in one)
    lines[line] = lines[line].replace('object = "sofa"', 'object = "soffa"')
    wrong = tmp_path / "wrong.toml"
    wrong.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(orthoframe.InputError) as caught:
        orthoframe.in_memory(wrong)
    error = caught.value
    assert error.code == "map::unknown_reference"
    assert error.line == line + 1 and error.file.endswith("wrong.toml")
    assert lines[line][error.column - 1 :].lstrip('"').startswith("soffa")
    assert "sofa" in error.help or "sofa" in error.message
    two = tmp_path / "two.toml"
    two.write_text("\n".join(lines).replace('object = "table"', 'object = "tabel"', 1), encoding="utf-8")
    with pytest.raises(orthoframe.InputError) as caught:
        orthoframe.in_memory(two)
    assert len(caught.value.faults) == 2 and caught.value.faults[0].line != caught.value.faults[1].line


@pytest.mark.parametrize("language", ["en", "ru"])
def test_errors_speak_the_language_that_was_asked_for(language):
    engine = orthoframe.in_memory(FLAT, language=language)
    with pytest.raises(orthoframe.InputError) as caught:
        engine.find("Tabel 1")
    assert any("а" <= letter <= "я" for letter in caught.value.message) == (language == "ru")


def test_nonsense_is_refused(flat, tmp_path):
    with pytest.raises(orthoframe.InputError):
        orthoframe.in_memory(tmp_path / "none.toml")
    with pytest.raises(orthoframe.InputError):
        orthoframe.in_memory(FLAT, language="fr")
    with pytest.raises(orthoframe.InputError):
        flat.where(1.0)
    for number in (float("nan"), float("inf"), 1e308):
        with pytest.raises(orthoframe.InputError):
            flat.where(number, 0.0)
    with pytest.raises(orthoframe.InputError):
        flat.query("?- (")
    with pytest.raises(TypeError):
        flat.ask(3)
    with pytest.raises(orthoframe.Error):
        flat.history()  # it has no store
