"""A viewer by Foxglove's websocket protocol: python3 viewer.py ORTHO ORTHO_FOXGLOVE, in the repository's root.

Sees a drive while it is driven, from its beginning or coming late; is told what is wrong, and others are not troubled."""

import asyncio
import json
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    import jsonschema
    import websockets
except ImportError as missing:
    print(missing)
    sys.exit(77)

ORTHO, FOXGLOVE = (str(Path(path).resolve()) for path in sys.argv[1:3])
HERE = Path(tempfile.mkdtemp())
STORE, FILE = str(HERE / "store"), HERE / "mission.mcap"


async def look(address, topics, until, protocol, seconds=90):
    """Subscribes to topics; gives every message of them until one of a topic is as asked for."""
    seen = {}
    async with websockets.connect(address, subprotocols=[protocol], max_size=None) as socket:
        assert socket.subprotocol == protocol
        info = json.loads(await socket.recv())
        assert info["op"] == "serverInfo" and info["name"] and info["capabilities"] == []
        channels, validators, end = {}, {}, time.monotonic() + seconds
        while time.monotonic() < end:
            told = await asyncio.wait_for(socket.recv(), seconds)
            if isinstance(told, str):
                said = json.loads(told)
                assert said["op"] == "advertise", said
                for channel in said["channels"]:
                    assert channel["encoding"] == "json" and channel["schemaEncoding"] == "jsonschema"
                    if channel["topic"].split("/")[1] in topics:
                        subscription = 1000 + channel["id"]
                        channels[subscription] = channel["topic"]
                        validators[subscription] = jsonschema.Draft202012Validator(json.loads(channel["schema"]))
                        await socket.send(json.dumps({"op": "subscribe", "subscriptions": [{"id": subscription, "channelId": channel["id"]}]}))
                continue
            opcode, subscription, at = struct.unpack_from("<BIQ", told)
            assert opcode == 1 and at > 10**18
            value = json.loads(told[13:])
            validators[subscription].validate(value)
            topic = channels[subscription]
            seen.setdefault(topic, []).append(value)
            if until(topic, value):
                return seen
    raise AssertionError(f"it never came: {[(topic, len(all)) for topic, all in seen.items()]}")


async def nonsense(address):
    try:
        async with websockets.connect(address):
            raise AssertionError("who speaks no protocol of Foxglove was let in")
    except websockets.exceptions.InvalidStatus as refused:
        assert refused.response.status_code == 400
    async with websockets.connect(address, subprotocols=["foxglove.sdk.v1"]) as socket:
        await socket.recv()
        for text in ["{", "[]", '{"op":"publish"}', '{"op":"subscribe","subscriptions":[{"id":-1,"channelId":99999}]}']:
            await socket.send(text)
        told = []
        while sum(one["op"] == "status" for one in told) < 3:
            told.append(json.loads(await asyncio.wait_for(socket.recv(), 20)))


async def main():
    subprocess.run([ORTHO, "--store", STORE, "import", "maps/rb2.toml"], check=True, capture_output=True)
    server = subprocess.Popen([FOXGLOVE, str(FILE), "--listen", "127.0.0.1:0"], stderr=subprocess.PIPE, text=True)
    address = server.stderr.readline().strip()
    vehicle = f"cmd:{ORTHO} simulate maps/rb2.toml --stdio --pace 2"
    drive = None
    try:
        first = asyncio.create_task(look(address, {"pose", "words", "tasks", "map"}, lambda topic, value: value.get("event") == "task_ended", "foxglove.sdk.v1"))
        await asyncio.sleep(0.5)
        drive = subprocess.Popen([ORTHO, "--store", STORE, "do", "Поезжай к Точке-К", "--reset", "--record", str(FILE), "--vehicle", vehicle], stdout=subprocess.DEVNULL)
        await asyncio.sleep(4)
        assert drive.poll() is None, "the drive was to take longer"
        # Who comes late has the picture at once, and the robot on it.
        late = await look(address, {"pose", "map", "rooms"}, lambda topic, value: topic == "/pose", "foxglove.websocket.v1", 20)
        assert drive.poll() is None, "the robot was to be seen on its way"
        assert late["/pose"]
        await nonsense(address)
        seen = await first
        assert len(seen["/pose"]) > 20 and seen["/words"] and any(topic.startswith("/map/") for topic in seen), {t: len(v) for t, v in seen.items()}
        assert [value["event"] for value in seen["/tasks"]] == ["task", "task_ended"]
        print(f"seen live: {len(seen['/pose'])} poses, {len(seen['/words'])} words")
    finally:
        if drive:
            drive.wait(60)
        server.kill()
        server.wait()


asyncio.run(main())
print("a viewer sees the drive while it is driven")
