"""What an operator does with the console, in a real Chromium: python3 operator.py ORTHO [FOLDER FOR PICTURES].

Exit code 77 where there is no browser. One line for each thing done; the first that fails ends it.
"""

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
    from playwright.sync_api import expect, sync_playwright
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
    """`ortho serve --demo` on a store that outlives it."""

    def __init__(self, store, pace="4", port="0"):
        self.store, self.pace, self.port = store, pace, port
        self.start()

    def start(self):
        command = [ORTHO, "serve", "--demo", "--store", self.store, "--port", self.port, "--pace", self.pace]
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
        # A server that was killed refuses the line, and an edit that another overtook is refused: told here too.
        meant = "ERR_" in message.text or "409 (Conflict)" in message.text
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


def get(page, path):
    return json.loads(page.evaluate("path => fetch(path).then((answer) => answer.text())", path))


def say(page, text):
    page.fill("#say", text)
    page.press("#say", "Enter")


def where(page, name):
    things = get(page, "/api/drawing")["things"]
    return next(thing["at"] for thing in things if thing["name"] == name)


def idle(page):
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        tasks = get(page, "/api/tasks")
        if tasks["task"] is None and not tasks["queue"]:
            return tasks
        time.sleep(0.1)
    raise AssertionError("it drives for ever")


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


def run(browser, server, faults):
    page = watched(browser, server, faults)
    ready = opened(page, server.address)
    assert "token" not in page.url, page.url
    no_overflow(page)
    print(f"opens the demo: {ready:.2f} s")

    say(page, "Где лекарство?")
    expect(page.locator(".log .turn").last).to_contain_text("Тумбочк")
    assert page.locator("#map .m-mark").count() > 0, "what is named is marked on the map"
    picture(page, "asked")
    print("asks")

    # With the keyboard alone: the plan is shown, and driven by an empty line.
    say(page, "Поезжай к Точке-К")
    expect(page.locator(".next")).to_contain_text("План")
    before = get(page, "/api/state")["robot"]["place"]["pose"]
    assert page.locator("#map .m-planned").count() > 0
    picture(page, "planned")
    page.press("#say", "Enter")
    page.wait_for_selector("#map .m-trail", state="attached")
    picture(page, "driving")
    tasks = idle(page)
    assert tasks["ended"][-1]["state"] == "done", tasks["ended"][-1]
    after = get(page, "/api/state")["robot"]["place"]["pose"]
    assert after != before, "it drove"
    expect(page.locator(".live")).to_contain_text("стоит")
    print("orders, says yes and sees it end")

    say(page, "Поезжай в Комнату-В")
    expect(page.locator(".next")).to_contain_text("План")
    page.press("#say", "Escape")
    expect(page.locator(".next")).to_have_count(0)
    assert get(page, "/api/tasks")["task"] is None
    print("declines a plan")

    say(page, "Принеси лекарство")
    expect(page.locator(".next")).to_contain_text("План")
    page.locator("#confirm").click()
    page.wait_for_function("() => document.querySelector('.live').textContent.includes('едет')")
    time.sleep(0.5)
    page.fill("#say", "что-то недописанное")
    page.press("#say", "Control+.")
    tasks = idle(page)
    assert tasks["ended"][-1]["state"] == "stopped", tasks["ended"][-1]
    expect(page.locator(".next")).to_contain_text("Остановлено")
    assert page.input_value("#say") == "что-то недописанное", "what was typed stays"
    page.fill("#say", "")
    print("stops, while typing")

    other = watched(browser, server, faults, color_scheme="dark", locale="en-GB")
    token = get_posted(page, "/api/invite", {"role": "edit", "name": "Борис"})["token"]
    opened(other, f"{server.base}/?token={token}")
    assert other.evaluate("document.documentElement.lang") == "en"
    assert other.evaluate("document.documentElement.dataset.theme") == "dark"
    no_overflow(other)
    picture(other, "dark")
    print("opens in English and dark, by the browser")

    chair = "Стул-1"
    stood = where(page, chair)
    page.locator("#map").focus()
    page.keyboard.press("e")
    other.locator("#map").focus()
    other.keyboard.press("e")
    drag(page, chair, 30, 0)
    expect(page.locator("#panel .note.ok")).to_be_visible()
    assert where(page, chair) == stood, "a try writes nothing"
    picture(page, "editing")
    page.locator("#write").click()
    expect(page.locator(".toast")).to_contain_text("ревизия 2")
    moved = where(page, chair)
    assert moved != stood, moved
    page.locator("#map").focus()
    page.keyboard.press("Control+z")
    page.wait_for_function("() => document.querySelector('.time').textContent.includes('ревизия 3')")
    assert where(page, chair) == stood, "undone"
    print("drags a chair, writes it, and undoes it")

    other.wait_for_function("() => document.querySelector('.time').textContent.includes('revision 3')")
    drag(page, chair, 30, 0)
    drag(other, chair, 0, 25)
    expect(page.locator("#write")).to_be_enabled()
    expect(other.locator("#write")).to_be_enabled()
    page.locator("#write").click()
    expect(page.locator(".toast")).to_contain_text("ревизия 4")
    other.locator("#write").click()
    expect(other.locator("#panel .note.warn")).to_contain_text("operator")
    assert get(page, "/api/history")["revisions"][-1]["revision"] == 4, "nothing was overwritten"
    picture(other, "stale")
    other.locator("#panel .note.warn .btn.pri").click()
    expect(other.locator("#write")).to_be_enabled()
    other.locator("#write").click()
    other.wait_for_function("() => document.querySelector('.time').textContent.includes('revision 5')")
    authors = [revision["user"] for revision in get(page, "/api/history")["revisions"]][3:]
    assert authors == ["operator", "Борис"], authors
    print("two edit one thing, and neither loses anything")

    page.keyboard.press("Escape")
    page.locator(".time input").focus()
    page.keyboard.press("Home")
    expect(page.locator(".next")).to_contain_text("ревизии 1")
    picture(page, "past")
    page.keyboard.press("Escape")
    expect(page.locator(".next.past")).to_have_count(0)
    print("looks back and returns")

    page.locator('#map .thing[data-name="Кровать-1"]').click()
    expect(page.locator("#panel .title")).to_contain_text("Кровать")
    page.locator("#panel .why").first.click()
    page.wait_for_selector("#panel .pf li")
    assert page.locator("#map .m-reason").count() > 0, "reasons are on the map"
    picture(page, "why")
    print("selects a thing and asks why")

    phone = watched(browser, server, faults, viewport={"width": 360, "height": 760}, has_touch=True)
    token = get_posted(page, "/api/invite", {"role": "look", "name": "Анна"})["token"]
    opened(phone, f"{server.base}/?token={token}")
    no_overflow(phone)
    stop = phone.locator(".pstop")
    assert stop.is_visible() and stop.bounding_box()["height"] >= 44
    picture(phone, "phone")
    for tab in ["task", "thing", "map"]:
        phone.locator(f"#tab-{tab}").click()
        no_overflow(phone)
        picture(phone, f"phone-{tab}")
    nameless = phone.evaluate(
        """() => [...document.querySelectorAll('button, input, [role=tab]')].filter((one) =>
        one.offsetParent && !(one.getAttribute('aria-label') || one.textContent.trim())).map((one) => one.outerHTML)"""
    )
    assert not nameless, nameless
    print("works on 360 px, and every control has a name")

    server.kill()
    expect(page.locator(".next")).to_contain_text("Связи нет", timeout=10_000)
    picture(page, "no-link")
    server.start()
    page.wait_for_function("() => document.querySelector('.live').textContent.includes('стоит')", timeout=30_000)
    expect(page.locator(".next", has_text="Связи нет")).to_have_count(0)
    assert get(page, "/api/state")["revision"] == 5
    say(page, "Где чашка?")
    expect(page.locator(".log .turn").last).to_contain_text("Чашка")
    print("goes on after the server was killed")


def get_posted(page, path, body):
    script = """([path, body]) => fetch(path, { method: 'POST', headers: { 'content-type': 'application/json' },
        body: JSON.stringify(body) }).then((answer) => answer.text())"""
    return json.loads(page.evaluate(script, [path, body]))


with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
    server = Server(str(pathlib.Path(folder) / "store"))
    browser = playwright.chromium.launch(executable_path=BROWSER, args=["--no-sandbox"])
    faults = []
    try:
        run(browser, server, faults)
    finally:
        browser.close()
        server.kill()
    if faults:
        sys.exit("\n".join(faults))
