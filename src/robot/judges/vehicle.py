"""Missions of `ortho do` that are driven by a body of another make, by the vehicle protocol (docs/vehicle.md)."""

import json
import socket
import subprocess
import time


class Refused(Exception):
    """`why` as the protocol has it."""


class Bumped(Exception):
    """`against` as the protocol has it."""


def serve(body, link):
    """Answers orders until the mission hangs up. A body has `time`, `at()` and a method for each order, which says what the
    way is told by `tell` and returns what is said in the end; nothing is done."""
    lines = link.makefile("rb")
    for line in lines:
        order = json.loads(line)
        if order["do"] == "cancel":
            continue

        def tell(message):
            whole = {"id": order["id"], "time": body.time, "at": body.at(), **message}
            link.sendall(json.dumps(whole, ensure_ascii=False).encode() + b"\n")

        if order["do"] == "hello":
            tell({"say": "ready", "protocol": 1, "name": type(body).__name__, "odometry": getattr(body, "odometry", False)})
            continue
        try:
            ending = getattr(body, order["do"])(order, tell) or {"say": "done"}
        except Bumped as bump:
            ending = {"say": "bumped", "against": bump.args[0]}
        except Refused as refused:
            ending = {"say": "refused", "why": refused.args[0]}
        tell(ending)


def drive(ortho, body, task, *more, patience=600):
    """One mission: what `ortho do --json` says in the end, its exit code, and how long it took by the clock."""
    listener = socket.create_server(("127.0.0.1", 0))
    listener.settimeout(patience)
    command = [ortho.program, "--store", ortho.store, "--lang", "en", "--json", "do", task, *more]
    command += ["--vehicle", "tcp:127.0.0.1:%d" % listener.getsockname()[1]]
    begun = time.monotonic()
    out = ortho.folder / "told.jsonl"
    with open(out, "wb") as told, subprocess.Popen(command, stdout=told, stderr=subprocess.STDOUT) as mission:
        try:
            listener.settimeout(0.2)
            while True:
                try:
                    link, _ = listener.accept()
                    break
                except TimeoutError:
                    if mission.poll() is not None or time.monotonic() - begun > patience:
                        link = None
                        break
            if link:
                link.settimeout(patience)
                link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                with link:
                    try:
                        serve(body, link)
                    except ConnectionError:
                        pass
            code = mission.wait(timeout=patience)
        finally:
            listener.close()
            if mission.poll() is None:
                mission.kill()
    lines = out.read_text().splitlines()
    return json.loads(lines[-1]), code, time.monotonic() - begun, lines
