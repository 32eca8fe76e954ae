"""What changes the map, and what is noted of it."""

import pytest

import orthoframe
from conftest import FLAT, Cart


def test_a_store_is_opened_imported_and_opened_again(tmp_path):
    store = tmp_path / "store"
    with orthoframe.open(store) as engine:
        with pytest.raises(orthoframe.InputError):
            engine.ask("Where is the cup?")
        done = engine.import_file(FLAT, reason="survey")
        assert done["outcome"] == "imported" and done["revision"] == engine.revision == 1
        # Between two calls others may have it.
        with orthoframe.open(store) as beside:
            assert beside.revision == 1
    with pytest.raises(orthoframe.InputError, match="closed"):
        engine.ask("Where is the cup?")
    with orthoframe.open(store, user="anna") as again:
        assert again.history()[0]["reason"] == "survey"
        assert "Чашка-1" in again.names() and "Cup 1" in again.names()


def test_a_foreign_file_is_imported(tmp_path):
    (tmp_path / "map.yaml").write_text(
        "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    width, height = 80, 60
    free = lambda x, y: 10 <= x < width - 10 and 10 <= y < height - 10
    pixels = bytes(254 if free(x, y) else 0 for y in range(height) for x in range(width))
    (tmp_path / "map.pgm").write_bytes(b"P5\n%d %d\n255\n" % (width, height) + pixels)
    with orthoframe.open(tmp_path / "store") as engine:
        done = engine.import_file(tmp_path / "map.yaml")
        assert done["reading"]["format"]
        assert len(engine.floor().rooms) == 1


def test_an_edit_is_made_told_and_taken_back(house):
    before = house.find("Cup 1")["place"]["at"]
    step = {"edit": [{"move": "Cup 1", "by": [5, 0]}]}
    tried = house.edit(step, dry_run=True)
    assert tried["outcome"] == "tried" and house.find("Cup 1")["place"]["at"] == before
    edited = house.edit(step, reason="to the edge")
    assert edited["outcome"] == "edited" and edited["differences"][0]["table"]
    assert house.find("Cup 1")["place"]["at"][0] == pytest.approx(before[0] + 5)
    assert [one["reason"] for one in house.history()][-1] == "to the edge"
    assert house.history()[-1]["user"] == "python"
    assert house.diff(1) == edited["differences"]
    assert house.as_of(1).where(225, 380)["area"] == "Комната-В"
    house.undo()
    assert house.find("Cup 1")["place"]["at"] == before
    house.redo()
    assert house.find("Cup 1")["place"]["at"] != before
    # As text.
    house.edit('[[edit]]\nstate = "Дверь-ВZ"\nis = "locked"\n')


def test_a_faulty_edit_leaves_all_as_it_was(house):
    with pytest.raises(orthoframe.InputError) as caught:
        house.edit({"edit": [{"move": "Cup 77", "by": [5, 0]}]})
    assert "Cup 77" in str(caught.value) and house.revision == 1
    with pytest.raises(orthoframe.InputError) as caught:
        house.edit('[[edit]]\nmove = "Cup 1"\nby = [5, ')
    assert caught.value.line
    with pytest.raises(TypeError):
        house.edit({"edit": {1, 2}})


def test_what_was_seen_becomes_a_proposal_and_the_map(house):
    here = house.find("Cup 1")["place"]
    seen = house.observe("Cup 1", [here["at"][0], here["at"][1] - 50], sure=0.95)
    assert not seen["is_surveyed"]
    assert [one["name"] for one in house.proposals()] == ["Чашка-1"]
    assert len(house.story("Cup 1")) == 2
    house.confirm("Cup 1")
    assert house.proposals() == [] and house.revision == 2
    house.observe("Cup 1")  # It was not there.
    assert house.find("Cup 1")["missed"]
    house.reject("Cup 1")
    for wrong in ({"at": [1]}, {"at": [1, float("nan")]}, {"sure": 2.0}, {"at": [1, 2], "room": "Nowhere"}):
        with pytest.raises(orthoframe.InputError):
            house.observe("Cup 1", **wrong)


def test_a_dialogue_remembers(house):
    talk = house.dialogue()
    assert talk.hear("Where is the medicine?")[0]["outcome"] == "found"
    [went] = talk.hear("Bring it")
    assert went["outcome"] == "done" and went["directives"]
    assert "medicine" in talk.hear("What did you do?")[0]["text"].lower()
    # What was done is kept.
    assert house.find("Medicine")["carried"] is not None or not house.find("Medicine")["is_surveyed"]
    house.reset_robot()
    assert house.find("Medicine")["is_surveyed"]


def test_the_map_goes_out_as_it_came(house, tmp_path):
    copy = tmp_path / "copy.toml"
    copy.write_text(house.export_map(), encoding="utf-8")
    assert orthoframe.in_memory(copy).relations() == house.relations()


def test_two_programs_write_in_turn(house, tmp_path):
    with orthoframe.open(tmp_path / "store") as other:
        for step in range(3):
            house.edit({"edit": [{"move": "Cup 1", "by": [1, 0]}]})
            assert other.revision == house.revision == 2 * step + 2
            other.edit({"edit": [{"move": "Cup 1", "by": [-1, 0]}]})
            assert len(house.history()) == 2 * step + 3
        other.observe("Cup 1", [60, 40])
        assert house.story("Cup 1") == other.story("Cup 1")
        # While the robot of one is under way, the other is answered and not let in.
        task = house.run("Bring the medicine", Cart())
        assert other.ask("Where is the medicine?")["text"]
        task.result(60)
        other.edit({"edit": [{"move": "Cup 1", "by": [1, 0]}]})
        assert house.revision == other.revision == 8
