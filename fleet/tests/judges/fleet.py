"""The fleet's page in a real Chromium: python3 fleet.py ADDRESS EDITOR'S-KEY LOOKER'S-KEY [FOLDER FOR PICTURES].

One line for each thing done; the first that fails ends it. Exit code 77 where there is no browser.
"""

import os
import pathlib
import shutil
import sys

try:
    from playwright.sync_api import expect, sync_playwright
except ImportError:
    sys.exit(77)

NAMES = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"]
BROWSER = os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)
if BROWSER is None:
    sys.exit(77)

ADDRESS, EDITOR, LOOKER = sys.argv[1:4]
PICTURES = pathlib.Path(sys.argv[4]) if len(sys.argv) > 4 else None
PATIENCE = 60_000
FAULTS = []
expect.set_options(timeout=PATIENCE)


def watched(browser, **more):
    """A page of one's own, whose faults and foreign requests are noted."""
    context = browser.new_context(**{"locale": "ru-RU", "viewport": {"width": 1280, "height": 900}, **more})
    page = context.new_page()
    page.set_default_timeout(PATIENCE)

    def console(message):
        # A key that is none, and an edit that cannot be, are refused: told here too.
        if message.type == "error" and not any(said in message.text for said in ("401", "400", "403", "409")):
            FAULTS.append(f"console: {message.text}")

    page.on("console", console)
    page.on("pageerror", lambda error: FAULTS.append(f"page: {error}"))
    page.on("request", lambda r: r.url.startswith(ADDRESS) or FAULTS.append(f"foreign request: {r.url}"))
    return page


def picture(page, name):
    if PICTURES:
        PICTURES.mkdir(parents=True, exist_ok=True)
        page.screenshot(path=PICTURES / f"{name}.png", full_page=True)


def no_overflow(page):
    wide = page.evaluate("document.documentElement.scrollWidth - innerWidth")
    assert wide <= 0, f"scrolls sideways by {wide} px"


def entered(page, key):
    page.goto(ADDRESS)
    page.wait_for_selector("body[data-ready=yes]")
    page.fill("#key", key)
    page.get_by_role("button", name="Войти").click()
    expect(page.locator("#totals")).to_be_visible()


def drawn(page):
    page.wait_for_function("() => { const i = document.querySelector('figure img'); return i && i.complete && i.naturalWidth > 0; }")


def run(browser):
    page = watched(browser)
    page.goto(ADDRESS)
    page.wait_for_selector("body[data-ready=yes]")
    page.fill("#key", "0000")
    page.get_by_role("button", name="Войти").click()
    expect(page.get_by_role("alert")).to_contain_text("ключ")
    picture(page, "enter")
    entered(page, EDITOR)
    assert page.evaluate("document.cookie") == "", "scripts do not see the session"
    assert EDITOR not in page.evaluate("JSON.stringify([...Object.values(sessionStorage), ...Object.values(localStorage)])")
    print("enters with a key, which the browser does not keep")

    for wanted in ("robot 1.1", "<b>robot</b> 2.1"):
        expect(page.locator("#list-robots")).to_contain_text(wanted)
    expect(page.locator("#list-robots .pill", has_text="карты разошлись")).to_have_count(1)
    expect(page.locator("#list-buildings")).to_contain_text("Корпус-2")
    expect(page.locator("#list-missions")).to_contain_text("Принеси чашку")
    expect(page.locator("#list-proposals tbody tr").first).to_be_attached()
    expect(page.locator(".conflict .thing").first).to_be_visible()
    no_overflow(page)
    picture(page, "fleet")
    page.fill("#find", "2.1")
    expect(page.locator("#list-robots tbody tr")).to_have_count(1)
    page.fill("#find", "")
    expect(page.locator("#list-robots tbody tr")).to_have_count(3)
    print("shows buildings, robots with state, missions, proposals and conflicts; finds by name")

    page.fill("#question", "Что изменилось за неделю?")
    page.get_by_role("button", name="Спросить").click()
    expect(page.locator("#answer")).to_be_visible()
    page.fill("#question", "В каких корпусах есть свободные стулья?")
    page.get_by_role("button", name="Спросить").click()
    expect(page.locator("#answer code")).to_contain_text("IS_A")
    picture(page, "asked")
    print("answers a question, with the rule that ran")

    page.locator("#list-robots").get_by_role("link", name="robot 1.2").click()
    expect(page.locator("#whose")).to_have_value("2")
    drawn(page)
    page.locator("#believed").check()
    drawn(page)
    expect(page.locator("#list-facts tbody tr").nth(10)).to_be_attached()
    expect(page.locator("#editor")).to_have_count(0)
    no_overflow(page)
    picture(page, "robot")
    print("shows a building as its robot has it")

    page.locator("#whose").select_option("0")
    expect(page.locator("#editor")).to_be_visible()
    drawn(page)
    revision = int(page.locator("#list-revisions tbody td").first.inner_text())
    thing = page.locator("#thing option").first.get_attribute("value")
    page.locator("#thing").select_option(thing)
    x = float(page.locator("#to-x").input_value())
    page.fill("#to-x", str(round(x + 0.5, 1)))
    page.fill("#reason", "сдвинули на обходе")
    page.locator("#editor details").first.get_by_role("button", name="Проверить").click()
    expect(page.locator("#editor .told.ok")).to_contain_text(thing)
    picture(page, "centre")
    expect(page.locator("#list-revisions tbody td").first).to_have_text(str(revision))
    page.locator("#editor details").first.get_by_role("button", name="Записать ревизию").click()
    expect(page.get_by_role("status")).to_contain_text(f"ревизия {revision + 1}")
    expect(page.locator("#list-revisions tbody tr").first).to_contain_text("сдвинули на обходе")
    page.locator("#editor summary", has_text="Правка словами").click()
    page.fill("#text", "[[edit]]\nmove = \"Нет такой вещи\"\nto = [1, 2]")
    page.locator("#editor details").nth(1).get_by_role("button", name="Записать ревизию").click()
    expect(page.locator("#editor .told.bad")).to_contain_text("Нет такой вещи")
    print("makes a revision of the centre's map; what cannot be is told")

    page.goto(f"{ADDRESS}/#/")
    expect(page.locator(".conflict")).to_have_count(1)
    page.get_by_role("button", name="Оставить карту центра").click()
    print("settles a conflict for the centre's map")

    # Markup that a page did not bring with it does not run.
    page.evaluate("() => { const s = document.createElement('script'); s.textContent = 'window.ran = 1'; document.body.append(s); }")
    assert page.evaluate("window.ran") is None
    FAULTS[:] = [fault for fault in FAULTS if "Content Security Policy" not in fault]
    page.get_by_role("button", name="Выйти").click()
    expect(page.locator("#enter")).to_be_visible()
    assert page.evaluate("fetch('/v1/fleet').then((answer) => answer.status)") == 401
    print("leaves, and is outside then")

    for name, more in {"dark": {"color_scheme": "dark"}, "narrow": {"viewport": {"width": 360, "height": 740}, "has_touch": True}}.items():
        page = watched(browser, **more)
        entered(page, LOOKER)
        expect(page.locator("#list-robots")).to_contain_text("robot 1.1")
        expect(page.get_by_role("button", name="Оставить карту центра")).to_have_count(0)
        no_overflow(page)
        picture(page, f"fleet-{name}")
        page.goto(f"{ADDRESS}/#/building/1/robot/0")
        drawn(page)
        expect(page.locator("#editor")).to_have_count(0)
        no_overflow(page)
        picture(page, f"building-{name}")
        status = """fetch('/v1/insist', { method: 'POST', headers: { 'Content-Type': 'application/json' },
            body: JSON.stringify({ building: 1, robot: 2 }) }).then((answer) => answer.status)"""
        assert page.evaluate(status) == 403
    print("looks without editing, in the dark and on a telephone")


with sync_playwright() as playwright:
    browser = playwright.chromium.launch(executable_path=BROWSER, args=["--no-sandbox"])
    try:
        run(browser)
    finally:
        browser.close()
if FAULTS:
    sys.exit("\n".join(FAULTS))
