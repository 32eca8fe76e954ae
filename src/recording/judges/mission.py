"""Reads recordings of missions by Foxglove's own reader: python3 mission.py ORTHO, in the repository's root.

What is written is what Foxglove's schemas ask and what the program told as it drove; a recording whose program was killed
is readable up to the cut; one that was cut or damaged anywhere is told so, and never brings the program down."""

import base64
import json
import math
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    import jsonschema
    from mcap.exceptions import EndOfFile, McapError
    from mcap.reader import NonSeekingReader, make_reader
except ImportError as missing:
    print(missing)
    sys.exit(77)

ORTHO = sys.argv[1]
HERE = Path(tempfile.mkdtemp())
STORE = str(HERE / "store")


def run(*arguments, code=0):
    done = subprocess.run([ORTHO, *arguments], capture_output=True, text=True, timeout=300)
    assert done.returncode == code, (arguments, done.returncode, done.stdout[-2000:], done.stderr[-2000:])
    return done


def messages(path):
    """Topic, schema's name, time and value of each message, by the index of the file."""
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        for schema, channel, message in reader.iter_messages():
            assert channel.message_encoding == "json" and schema.encoding == "jsonschema"
            yield channel.topic, schema, message.log_time, json.loads(message.data)


def checked(path):
    """Every message by topic; each is valid by the schema that the file bears for it."""
    validators, found, last = {}, {}, 0
    for topic, schema, at, value in messages(path):
        if schema.id not in validators:
            text = json.loads(schema.data)
            jsonschema.Draft202012Validator.check_schema(text)
            assert text["title"] == schema.name, schema.name
            published = Path("src/recording/schemas") / f"{schema.name.split('.')[1]}.json"
            assert json.loads(published.read_text()) == text
            validators[schema.id] = jsonschema.Draft202012Validator(text)
        validators[schema.id].validate(value)
        assert at >= last, "times go back"
        last = at
        stamp = value.get("timestamp")
        if stamp:
            assert stamp["sec"] * 10**9 + stamp["nsec"] == at
        found.setdefault(topic, []).append((at, value))
    return found


def yaw(turn):
    return math.degrees(2 * math.atan2(turn["z"], turn["w"]))


def a_mission_is_recorded_as_it_was_told():
    path = str(HERE / "mission.mcap")
    told = run("--store", STORE, "--json", "do", "Принеси лекарство", "--reset", "--record", path, "--senses", "7")
    lines = [json.loads(line) for line in told.stdout.splitlines()]
    events = [line for line in lines if "event" in line]
    found = checked(path)
    recorded = [value for _, value in sorted(found["/directives"] + found.get("/surprises", []), key=lambda one: one[0])]
    assert sorted(map(str, recorded)) == sorted(map(str, events)), "events differ"
    for topic in ["/frames", "/tf", "/pose", "/scan", "/path", "/words", "/tasks", "/directives"]:
        assert found.get(topic), f"{topic} is missing: {sorted(found)}"
    # The robot is at last where the last report has it.
    last = [event for event in events if "pose" in event][-1]["pose"]
    pose = found["/pose"][-1][1]["pose"]
    assert abs(pose["position"]["x"] * 100 - last["x"]) < 0.011 and abs(pose["position"]["y"] * 100 - last["y"]) < 0.011
    assert abs((yaw(pose["orientation"]) - last["heading_deg"] + 180) % 360 - 180) < 0.011
    # Each pose lies on the picture, on a free cell.
    key = found["/pose"][0][1]["frame_id"]
    grid = found[f"/map/{key}"][0][1]
    cells = base64.b64decode(grid["data"])
    assert len(cells) % grid["row_stride"] == 0 and grid["row_stride"] == grid["column_count"] * 4
    for _, value in found["/pose"]:
        at, low = value["pose"]["position"], grid["pose"]["position"]
        column, row = (int((at[a] - low[a]) / grid["cell_size"][a]) for a in "xy")
        red = cells[row * grid["row_stride"] + column * 4]
        assert red > 200, f"the robot stands in a wall at {at}"
    # A scan's rays that met something end within the building's outline, and there are as many as degrees.
    for _, value in found["/scan"]:
        assert len(value["ranges"]) == len(value["intensities"])
        assert all((r > 0) == (i == 1) for r, i in zip(value["ranges"], value["intensities"]))
    assert {e["id"].split("-")[0] for e in found[f"/rooms/{key}"][0][1]["entities"]} >= {"room", "place"}
    assert {e["id"].split("-")[0] for e in found[f"/things/{key}"][0][1]["entities"]} >= {"thing", "door"}
    # What begins is ended, and the words are those that the program says.
    assert [value["event"] for _, value in found["/tasks"]] == ["task", "task_ended"]
    with open(path, "rb") as file:
        reader = make_reader(file)
        maps = [a for a in reader.iter_attachments()]
        assert [a.name for a in maps] == ["map.toml"]
        (HERE / "map.toml").write_bytes(maps[0].data)
    run("check", str(HERE / "map.toml"))
    words = run("replay", path).stdout
    for event in events:
        if event.get("ru"):
            assert event["ru"] in words, event["ru"]
    again = [json.loads(line) for line in run("--json", "replay", path).stdout.splitlines()]
    assert again[-1]["outcome"] == "replayed" and again[-1]["cut"] is None
    strip = lambda event: {key: value for key, value in event.items() if key != "at_seconds"}
    assert [strip(e) for e in again if e.get("event") not in (None, "task", "task_ended")] == events
    seconds = [event["at_seconds"] for event in again[:-1]]
    assert seconds == sorted(seconds)
    task = lines[-1]
    assert abs(seconds[-1] - task["seconds"]) < 0.5 + 0.02 * task["seconds"], (seconds[-1], task["seconds"])
    return path


def what_the_robot_changes_is_seen():
    """A door that is opened on the way is open in the scene that follows."""
    path = str(HERE / "door.mcap")
    run("--store", STORE, "do", "Открой Дверь-КY", "--reset", "--record", path)
    found = checked(path)
    key = found["/pose"][0][1]["frame_id"]
    scenes = [value for _, value in found[f"/things/{key}"]]
    color = lambda scene: next(e["lines"][0]["color"] for e in scene["entities"] if e["texts"] and e["texts"][0]["text"] == "Дверь-КY")
    assert color(scenes[0]) != color(scenes[-1]) and color(scenes[-1])["g"] > color(scenes[-1])["r"]


def a_killed_mission_is_readable_up_to_the_cut():
    path = str(HERE / "killed.mcap")
    vehicle = f"cmd:{ORTHO} simulate maps/rb2.toml --stdio --pace 1"
    arguments = [ORTHO, "--store", STORE, "do", "Принеси лекарство", "--reset", "--record", path, "--vehicle", vehicle]
    drive = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    poses = 0
    until = time.monotonic() + 120
    while poses < 20 and time.monotonic() < until:
        time.sleep(0.2)
        poses = len([1 for topic, _ in cut_messages(path) if topic == "/pose"])
    time.sleep(2)
    drive.send_signal(signal.SIGKILL)
    drive.wait()
    found = list(cut_messages(path))
    drawn = [value for topic, value in found if topic == "/pose"]
    assert len(drawn) >= 20, len(drawn)
    assert any(topic == "/words" for topic, _ in found) and any(topic == "/directives" for topic, _ in found)
    told = run("replay", path)
    assert "обрывается" in told.stderr and "подъехать" in told.stdout, (told.stdout, told.stderr)
    print(f"killed: {len(found)} messages, {len(drawn)} poses")


def cut_messages(path):
    """What Foxglove's reader makes of a file without an end."""
    if not os.path.exists(path):
        return
    with open(path, "rb") as file:
        reader = NonSeekingReader(file)
        try:
            for _, channel, message in reader.iter_messages(log_time_order=False):
                yield channel.topic, json.loads(message.data)
        except (EndOfFile, McapError):
            return


def damage_is_told(path):
    whole = Path(path).read_bytes()
    chance = random.Random(7)
    broken = HERE / "broken.mcap"
    lines = len(run("--json", "replay", path).stdout.splitlines())
    for no in range(60):
        data = bytearray(whole)
        if no % 2:
            data = data[: chance.randrange(len(data))]
        else:
            for _ in range(chance.randrange(1, 9)):
                data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
        broken.write_bytes(data)
        done = subprocess.run([ORTHO, "--json", "replay", str(broken)], capture_output=True, text=True, timeout=60)
        last = json.loads(done.stdout.splitlines()[-1]) if done.stdout else json.loads(done.stderr.splitlines()[-1])
        assert done.returncode in (0, 2), (no, done.returncode, done.stderr[-500:])
        if done.returncode == 0 and len(done.stdout.splitlines()) < lines:
            assert last["cut"], (no, len(data), len(whole))
    for name, text in [("none", b""), ("text", b"not an mcap")]:
        broken.write_bytes(text)
        done = run("--json", "replay", str(broken), code=2)
        assert "recording::not_mcap" in done.stdout + done.stderr
    run("replay", str(HERE / "absent.mcap"), code=2)
    run("--store", STORE, "do", "Где ты?", "--record", str(HERE / "no" / "such.mcap"), code=3)


run("--store", STORE, "import", "maps/rb2.toml")
path = a_mission_is_recorded_as_it_was_told()
what_the_robot_changes_is_seen()
a_killed_mission_is_readable_up_to_the_cut()
damage_is_told(path)
print("recordings are read by Foxglove's reader")
