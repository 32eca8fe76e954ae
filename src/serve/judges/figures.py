"""What the console's promises come to, measured in a real Chromium: python3 figures.py ORTHO [WARDS [MINUTES]].

A hospital of WARDS rooms (2000), and MINUTES of simulated driving (60), sixty times as fast as the clock. It prints the table of
benches/README.md, a row as soon as it is known, with the load that the machine was under; nothing is asserted.
"""

import http.client
import os
import pathlib
import statistics
import sys
import tempfile
import threading
import time

sys.argv, (WARDS, MINUTES) = sys.argv[:2], [int(n) for n in (sys.argv[2:] + ["2000", "60"][len(sys.argv) - 2:])[:2]]

from console import BROWSER, Server, get, get_posted, idle, opened, say, sync_playwright, watched  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
COLUMNS = 45


def hospital(wards):
    """Wards side by side and back to back, each with 20 things and a door to the next, as a map file."""
    text = (ROOT / "benches/wards/ward.toml").read_text()
    head, rest = text.split("[area.ward]")
    body = rest.split("[map.floor]")[0]
    corners = "[[0, 0], [500, 0], [500, 100], [500, 200], [500, 400], [0, 400], [0, 200], [0, 100]]"
    doors = 'side = { C = { permeability = "conditional" }, G = { permeability = "conditional" } } }'
    head = head.replace("rect = [500, 400], height = 270 }", f"points = {corners}, height = 270, {doors}")
    areas, gates, items, links = [], [], [], []
    for n in range(wards):
        row, column = divmod(n, COLUMNS)
        is_last = column == COLUMNS - 1 or n == wards - 1
        # A row begins and ends with a door out of the house, and hangs on the row before it.
        west, east = (f"w{n}", "inside") if column == 0 else (f"d{n}", "outside"), f"e{n}" if is_last else f"d{n + 1}"
        mounts = [f'{{ door = "{west[0]}", side = "A.G", opens = "{west[1]}" }}', f'{{ door = "{east}", side = "A.C", opens = "inside" }}']
        for door in [east] + ([west[0]] if column == 0 else []):
            gates.append(f'[door.{door}]\nname = "Дверь-{door}"\nkind = "hinged"\nwidth = 100\nheight = 200\n'
                         'state = "open"\nleaves = [{ hinge = "right" }]\n')
        if column == 0 and row:
            links.append(f'{{ from = "ward{n}.A.A", to = "ward{n - COLUMNS}.A.A", rel = [0, -420] }}')
        own = body.replace('name = "Палата"', f'name = "Палата-{n}"')
        for kind in set(part.split('"')[0] for part in body.split('name = "')[2:]):
            own = own.replace(f'name = "{kind}"', f'name = "{kind}-{n}"')
        areas.append(f"[area.ward{n}]{own.rstrip()}\ndoors = [{', '.join(mounts)}]\n")
        items.append(f'{{ area = "ward{n}", at = [{column * 520}, {row * 420}] }}')
    place = '\nplaces = [{ name = "Пост", at = [250, 150] }]\n'
    areas[0] = areas[0].rstrip() + place
    robot = '[robot]\nradius = 22\nheight = 110\nclearance = 3\nspeed = 50\nstart = "Пост"\n'
    return f"{head}{robot}{''.join(gates)}{''.join(areas)}[map.floor]\nname = \"Этаж\"\nitems = [{', '.join(items)}]\nlinks = [{', '.join(links)}]\n"


def seconds(values):
    return f"median {statistics.median(values):.3f} s, worst {max(values):.3f} s of {len(values)}"


def row(what, measured, promised):
    print(f"| {what} | {measured} | {promised} |", flush=True)


def shown(page, address):
    """Opens the page; at full view of a hospital no name has room, so that its floors are waited for."""
    begun = time.monotonic()
    page.goto(address)
    page.wait_for_selector("body[data-ready=yes]")
    page.wait_for_selector("#map .m-floor", state="attached")
    return time.monotonic() - begun


def ready(browser, server, owner, times):
    """Page ready: rooms and names drawn, from a browser that has nothing of it."""
    took = []
    for _ in range(times):
        page = watched(browser, server, [])
        token = get_posted(owner, "/api/invite", {"role": "edit", "name": "Анна"})["token"]
        took.append(shown(page, f"{server.base}/?token={token}"))
        nodes = page.evaluate("document.querySelectorAll('*').length")
        page.context.close()
    return took, nodes


def until_seen(page, owner, times=40):
    """From before a request that causes an event until the frame that shows it."""
    script = """(word) => new Promise((done) => { const look = () => document.querySelector('.live').textContent.includes(word)
        ? requestAnimationFrame(() => done(Date.now())) : setTimeout(look, 1); look(); })"""
    took = []
    for n in range(times):
        take = n % 2 == 0
        # Asked first, so that the page waits for it.
        page.evaluate("(word) => { window.seen = null; }", "")
        page.evaluate(f"(word) => {{ ({script})(word).then((at) => {{ window.seen = at; }}); }}", "управляет" if take else "готов")
        if not take:
            page.evaluate("() => { window.seen = null; const look = () => document.querySelector('.live').textContent.includes('управляет') ? setTimeout(look, 1) : requestAnimationFrame(() => { window.seen = Date.now(); }); look(); }")
        begun = time.time() * 1000
        get_posted(owner, "/api/lease", {"do": "take" if take else "give"})
        page.wait_for_function("() => window.seen !== null")
        took.append((page.evaluate("window.seen") - begun) / 1000)
    return took


class Listener(threading.Thread):
    """A client that listens to all events and counts them."""

    def __init__(self, base, cookie):
        super().__init__(daemon=True)
        self.host, self.cookie, self.heard, self.over = base.split("//")[1], cookie, 0, False

    def run(self):
        line = http.client.HTTPConnection(self.host, timeout=30)
        line.request("GET", "/api/events", headers={"Cookie": self.cookie})
        answer = line.getresponse()
        while not self.over and answer.readline():
            self.heard += 1


def cookie_of(base, token):
    line = http.client.HTTPConnection(base.split("//")[1], timeout=30)
    line.request("GET", f"/?token={token}")
    return line.getresponse().getheader("set-cookie").split(";")[0]


def drive(page, text):
    """Orders, confirms and waits; how long the robot was under way by the clock."""
    said = get_posted(page, "/api/say", {"text": text, "lang": "ru"})
    begun = time.monotonic()
    get_posted(page, f"/api/tasks/{said['task']['task']}/confirm", {})
    ended = idle(page)["ended"][-1]
    assert ended["state"] == "done", ended
    return time.monotonic() - begun


def memory(server):
    status = pathlib.Path(f"/proc/{server.process.pid}/status").read_text()
    return next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS")) / 1024


def heap(page):
    line = page.context.new_cdp_session(page)
    line.send("HeapProfiler.collectGarbage")
    return line.send("Runtime.getHeapUsage")["usedSize"] / 1e6


def flat(browser, folder):
    server = Server(f"{folder}/flat", "--demo", "--pace", "2")
    try:
        owner = watched(browser, server, [])
        opened(owner, server.address)
        took, nodes = ready(browser, server, owner, 7)
        row("rb2, page ready", f"{seconds(took)}; {nodes} nodes", "1 s")
        page = watched(browser, server, [])
        token = get_posted(owner, "/api/invite", {"role": "look", "name": "Вера"})["token"]
        opened(page, f"{server.base}/?token={token}")
        row("a request until the frame that shows its event", seconds(until_seen(page, owner)), "100 ms")
        alone = [drive(owner, to) for to in ["Поезжай к Точке-К", "Поезжай к Точке-А"] * 2]
        token = get_posted(owner, "/api/invite", {"role": "look", "name": "Хор"})["token"]
        cookie = cookie_of(server.base, token)
        choir = [Listener(server.base, cookie) for _ in range(50)]
        for one in choir:
            one.start()
        time.sleep(1)
        watched_by = [drive(owner, to) for to in ["Поезжай к Точке-К", "Поезжай к Точке-А"] * 2]
        heard = min(one.heard for one in choir)
        row("a drive with 1 client, with 50 more", f"{seconds(alone)}; {seconds(watched_by)}; each heard {heard} lines or more", "no slower")
    finally:
        server.kill()


def wards(browser, folder):
    file = pathlib.Path(folder) / "hospital.toml"
    file.write_text(hospital(WARDS))
    begun = time.monotonic()
    server = Server(f"{folder}/hospital", "--map", str(file))
    try:
        imported = time.monotonic() - begun
        owner = watched(browser, server, [])
        first = shown(owner, server.address)
        took, nodes = ready(browser, server, owner, 5)
        row(f"hospital of {WARDS} rooms ({20 * WARDS} things), page ready", f"{seconds(took)}; the first {first:.3f} s, {imported:.0f} s after the start; {nodes} nodes at full view", "2 s")
        frames = """(steps) => new Promise((done) => { const map = document.querySelector('#map'), took = []; let last = performance.now(), n = 0;
            map.focus(); const step = () => { const now = performance.now(); took.push(now - last); last = now; n += 1;
            if (n > steps) { done(took.slice(1)); return; } map.dispatchEvent(new KeyboardEvent('keydown', { key: n % 2 ? 'ArrowRight' : 'ArrowLeft', bubbles: true })); requestAnimationFrame(step); }; requestAnimationFrame(step); })"""
        took = owner.evaluate(frames, 60)
        row("its frames while panning, at full view", f"median {statistics.median(took):.1f} ms, worst {max(took):.1f} ms", "16 ms")
        owner.locator("#map").focus()
        for _ in range(16):
            owner.keyboard.press("+")
        owner.wait_for_function("() => document.querySelectorAll('#map .thing').length > 5")
        time.sleep(1)
        nodes = owner.evaluate("document.querySelectorAll('*').length")
        took = owner.evaluate(frames, 60)
        row("its frames while panning, close by", f"median {statistics.median(took):.1f} ms, worst {max(took):.1f} ms; {nodes} nodes", "16 ms")
    finally:
        server.kill()


def hour(browser, folder):
    server = Server(f"{folder}/hour", "--demo", "--pace", "60")
    try:
        page = watched(browser, server, [])
        opened(page, server.address)
        said, marks = 0, []
        simulated = 0.0
        while simulated < MINUTES * 60:
            for text in ["Поезжай к Точке-К", "Принеси лекарство", "Поезжай к Точке-А", "Отнеси лекарство на Тумбочку-2"]:
                answer = get_posted(page, "/api/say", {"text": text, "lang": "ru"})
                if "task" not in answer:
                    continue
                get_posted(page, f"/api/tasks/{answer['task']['task']}/confirm", {})
                idle(page)
                simulated += answer["task"]["plan"]["seconds"]
                said += 1
            marks.append((simulated / 60, memory(server), heap(page)))
        third = len(marks) // 3
        shown = [marks[0], marks[third], marks[2 * third], marks[-1]]
        told = "; ".join(f"{minutes:.0f} min {mib:.0f} MiB, page {mb:.1f} MB" for minutes, mib, mb in shown)
        row(f"memory in {MINUTES} minutes of simulated driving, {said} tasks", told, "no growth")
    finally:
        server.kill()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=BROWSER, args=["--no-sandbox"])
        print(f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores\n\n| what | measured | promised |\n|---|---|---|", flush=True)
        for measure in [flat, wards, hour]:
            measure(browser, folder)
        browser.close()
