"""A console and a real Chromium to look at it, for the judges beside this file. Exit code 77 where there is no browser."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

try:
    from playwright.sync_api import Error, expect, sync_playwright
except ImportError:
    sys.exit(77)

NAMES = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"]
BROWSER = os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)
if BROWSER is None:
    sys.exit(77)

ORTHO = sys.argv[1]
PICTURES = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
PATIENCE = 60_000


class Server:
    """`ortho serve` on a store that outlives it; the demo's flat unless told otherwise."""

    def __init__(self, store, *more, port="0"):
        self.store, self.more, self.port = store, more or ("--demo", "--pace", "4"), port
        self.start()

    def start(self):
        command = [ORTHO, "serve", "--store", self.store, "--port", self.port, *self.more]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().split()[-1]
        self.base = self.address.split("/?")[0]
        self.port = self.base.rsplit(":", 1)[1]

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()


def watched(browser, server, faults, **more):
    """A page of one's own, whose faults and foreign requests are noted."""
    context = browser.new_context(**{"locale": "ru-RU", "viewport": {"width": 1440, "height": 900}, **more})
    page = context.new_page()
    page.set_default_timeout(PATIENCE)

    def console(message):
        # A server that was killed refuses the line, and an edit that another overtook, or that cannot be, is refused:
        # told here too.
        meant = any(said in message.text for said in ("ERR_", "409 (Conflict)", "422 (Unprocessable"))
        if message.type == "error" and not meant:
            faults.append(f"console: {message.text}")

    page.on("console", console)
    page.on("pageerror", lambda error: faults.append(f"page: {error}"))
    page.on("request", lambda r: r.url.startswith(server.base) or faults.append(f"foreign request: {r.url}"))
    return page


def opened(page, address):
    begun = time.monotonic()
    page.goto(address)
    page.wait_for_selector("body[data-ready=yes]")
    page.wait_for_selector("#map .labels text")
    return time.monotonic() - begun


def picture(page, name):
    if PICTURES:
        PICTURES.mkdir(parents=True, exist_ok=True)
        page.screenshot(path=PICTURES / f"{name}.png")


def drawn(page, selector, at_least=1):
    """The page draws with its next frame: what is to stand on the map is waited for, never counted at once."""
    expect(page.locator(selector).nth(at_least - 1)).to_be_attached()


def get(page, path):
    return json.loads(page.evaluate("path => fetch(path).then((answer) => answer.text())", path))


def say(page, text):
    page.fill("#say", text)
    page.press("#say", "Enter")


def where(page, name):
    things = get(page, "/api/drawing")["things"]
    return next(thing["at"] for thing in things if thing["name"] == name)


def idle(page):
    """Waits until nothing is driven and nothing is to begin."""
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        tasks = get(page, "/api/tasks")
        is_held = tasks["paused"] or not any(task["is_released"] for task in tasks["queue"])
        if tasks["task"] is None and is_held:
            return tasks
        time.sleep(0.1)
    raise AssertionError("it drives for ever")


def held(page, part):
    """Holds the answers to all requests whose address has this part, until they are let through."""
    page.evaluate("""part => {
        window.foreign ??= window.fetch;
        let open;
        const gate = new Promise((done) => { open = done; });
        window.letThrough = () => { window.fetch = window.foreign; open(); };
        window.fetch = async (path, ...more) => {
            const answer = await window.foreign(path, ...more);
            if (String(path).includes(part)) await gate;
            return answer;
        };
    }""", part)


def let_through(page):
    """Lets the answers that are held through, and waits until the page has done what it does with them."""
    page.evaluate("() => { letThrough(); return new Promise((done) => setTimeout(done, 100)); }")


def drag(page, name, dx, dy):
    box = page.locator(f'#map .thing[data-name="{name}"]').bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.keyboard.down("Alt")
    for step in range(1, 6):
        page.mouse.move(x + dx * step / 5, y + dy * step / 5)
    page.keyboard.up("Alt")
    page.mouse.up()


def no_overflow(page):
    wide = page.evaluate("document.documentElement.scrollWidth - innerWidth")
    assert wide <= 0, f"scrolls sideways by {wide} px"


def get_posted(page, path, body):
    script = """([path, body]) => fetch(path, { method: 'POST', headers: { 'content-type': 'application/json' },
        body: JSON.stringify(body) }).then((answer) => answer.text())"""
    return json.loads(page.evaluate(script, [path, body]))


def judge(run, *more):
    """Runs a judge on a console of its own; what the pages complained of ends it too."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        server = Server(str(pathlib.Path(folder) / "store"), *more)
        browser = playwright.chromium.launch(executable_path=BROWSER, args=["--no-sandbox"])
        faults = []
        try:
            run(browser, server, faults)
        finally:
            browser.close()
            server.kill()
        if faults:
            sys.exit("\n".join(faults))
