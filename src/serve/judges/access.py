"""Who uses no pointer, hears the page, or has a small screen: python3 access.py ORTHO [FOLDER FOR PICTURES].

All is done by keys alone; then axe (target/judges, `.ci/run`) looks at the states of the page, in both languages and themes.
One line for each thing done; the first that fails ends it.
"""

import json
import pathlib
import sys
import time

from console import expect, get, get_posted, idle, judge, no_overflow, opened, picture, watched, where

AXE = pathlib.Path(__file__).resolve().parents[3] / "target/judges/node_modules/axe-core/axe.min.js"
if not AXE.exists():
    sys.exit(77)


FOCUS = """(target) => { const one = document.activeElement; if (!one?.matches(target)) return null;
    return [one, one.closest('.field')].filter(Boolean).map((it) => getComputedStyle(it)).some((style) => style.outlineStyle !== 'none' || style.boxShadow !== 'none'); }"""


def reach(page, target, most=250):
    """Goes by Tab alone until what has the focus is this; where it is to be seen, and is."""
    # The page draws with its next event: what is to be there is waited for.
    expect(page.locator(target).first).to_be_attached()
    for _ in range(most):
        is_seen = page.evaluate(FOCUS, target)
        if is_seen is not None:
            assert is_seen, f"{target}: the focus is not to be seen"
            return
        page.keyboard.press("Tab")
    raise AssertionError(f"{target} is not reached by Tab")


def typed(page, target, text):
    reach(page, target)
    page.keyboard.press("Control+a")
    page.keyboard.type(text)


def revision(page):
    return get(page, "/api/state")["revision"]


def until(page, number, word="ревизия"):
    page.wait_for_function(f"() => document.querySelector('.time').textContent.includes('{word} {number}')")


def chosen(page, name):
    """Takes something up from the list of tab Thing."""
    reach(page, "#tab-talk, #tab-task, #tab-thing, #tab-map")
    while page.evaluate("document.activeElement.id") != "tab-thing":
        page.keyboard.press("ArrowRight")
    if page.locator("#panel .field input[type=search]").count() == 0:
        reach(page, "#panel .lnk.end")
        page.keyboard.press("Enter")
    reach(page, "#panel input[type=search]")
    page.keyboard.press("Control+a")
    page.keyboard.type(name)
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(page.locator("#panel .title").first).to_have_text(name)


def ended(page, number):
    """How the task of this number ended, of those that this console drove."""
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        all_ended = [one for one in idle(page)["ended"] if one["state"] != "declined"]
        if len(all_ended) >= number:
            return all_ended[number - 1]["state"]
        time.sleep(0.1)
    raise AssertionError("it is not begun")


def keys(page):
    page.keyboard.press("/")
    page.keyboard.type("Где лекарство?")
    page.keyboard.press("Enter")
    expect(page.locator(".log .turn").last).to_contain_text("Тумбочк")
    page.keyboard.type("Поезжай к Точке-К")
    page.keyboard.press("Enter")
    expect(page.locator(".next")).to_contain_text("План")
    page.keyboard.press("Enter")
    assert ended(page, 1) == "done"
    page.keyboard.type("Принеси лекарство")
    page.keyboard.press("Enter")
    expect(page.locator(".next")).to_contain_text("План")
    page.keyboard.press("Enter")
    page.wait_for_function("() => document.querySelector('.live').textContent.includes('едет')")
    page.keyboard.press("Control+.")
    assert ended(page, 2) == "stopped"
    reach(page, "#goon")
    page.keyboard.press("Enter")
    assert ended(page, 3) == "done"
    print("asks, orders, stops and goes on by keys alone")

    # To a point of the floor: the cross in the middle of the map, the arrows bring the spot beneath it.
    page.keyboard.press("Escape")
    reach(page, "#map")
    page.keyboard.press("g")
    page.wait_for_selector(".cross")
    picture(page, "aim")
    page.keyboard.press("Enter")
    expect(page.locator(".next")).to_contain_text("План")
    page.keyboard.press("Escape")
    expect(page.locator(".next")).to_have_count(0)
    print("aims at a point of the floor")

    chosen(page, "Стул-1")
    reach(page, "#panel .why")
    page.keyboard.press("Enter")
    page.wait_for_selector("#panel .pf p")
    print("selects a thing and asks why")

    # A thing: moved, turned, written, undone.
    stood = where(page, "Стул-1")
    page.keyboard.press("Escape")
    chosen(page, "Стул-1")
    reach(page, "#map")
    page.keyboard.press("e")
    reach(page, "#map")
    page.keyboard.press("Shift+ArrowUp")
    page.keyboard.press("r")
    expect(page.locator("#panel .note.ok")).to_be_visible()
    now = revision(page)
    page.keyboard.press("Enter")
    until(page, now + 1)
    assert where(page, "Стул-1") != stood
    page.keyboard.press("Control+z")
    until(page, now + 2)
    assert where(page, "Стул-1") == stood
    page.keyboard.press("Control+Shift+Z")
    until(page, now + 3)
    page.keyboard.press("Control+z")
    until(page, now + 4)
    print("moves and turns a thing, writes, undoes and redoes it")

    # A thing of another kind put down.
    reach(page, ".edbar [aria-label='Вещь']")
    page.keyboard.press("Enter")
    reach(page, "#f-kind")
    kind = next(one["object"] for one in get(page, "/api/kinds")["objects"] if one["name"] == "Стул")
    page.locator("#f-kind").select_option(kind)
    middle = next(room["middle"] for room in get(page, "/api/drawing")["rooms"] if room["name"] == "Комната-Z")
    typed(page, "#f-x", str(round(middle[0])))
    typed(page, "#f-y", str(round(middle[1])))
    expect(page.locator("#verdict .note")).to_be_visible()
    picture(page, "put-down")
    now = revision(page)
    typed(page, "#f-name", "Стул-новый")
    expect(page.locator("#verdict .note.ok")).to_be_visible()
    page.keyboard.press("Enter")
    until(page, now + 1)
    assert where(page, "Стул-новый")
    print("puts down a thing of another kind")

    # A room's corner, by numbers; also the one where its coordinates begin.
    page.keyboard.press("Escape")
    chosen_room(page, "Комната-В")
    corner = page.locator("#panel input[id^='f-corner-']").first
    name = corner.get_attribute("id")
    was = float(corner.input_value())
    typed(page, f"#{name}", str(round(was - 1)))
    page.keyboard.press("Tab")
    expect(page.locator("#verdict .note")).to_be_visible()
    picture(page, "corner")
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    print("changes a corner by numbers")

    reach(page, ".time input")
    page.keyboard.press("Home")
    expect(page.locator(".next")).to_contain_text("ревизии 1")
    page.keyboard.press("Escape")
    expect(page.locator(".next.past")).to_have_count(0)
    print("looks back and returns")

    get_posted(page, "/api/reset", {})
    page.locator("#map").focus()
    page.keyboard.press("?")
    expect(page.locator(".keys")).to_contain_text("Ctrl Z")
    picture(page, "keys")
    page.keyboard.press("Escape")
    expect(page.locator(".keys")).to_have_count(0)
    print("is told the keys")


def chosen_room(page, name):
    """Selects a room and unlocks its shape."""
    chosen(page, name)
    if page.locator(".edbar").count() == 0:
        reach(page, "#map")
        page.keyboard.press("e")
    reach(page, ".edbar [aria-label='Форма заперта']")
    page.keyboard.press("Enter")
    page.wait_for_selector("#panel input[id^='f-corner-']")


def looked_at(page, state):
    page.evaluate(AXE.read_text() + "; undefined")
    told = page.evaluate("() => axe.run(document, { resultTypes: ['violations'] }).then((all) => JSON.stringify(all.violations))")
    faults = [f"{one['id']} ({one['impact']}): {one['help']}: {node['target']} {node['failureSummary']}" for one in json.loads(told) for node in one["nodes"][:3]]
    assert not faults, f"{state}:\n" + "\n".join(faults)


def states(browser, server, page, faults):
    for lang, theme, size in [("ru-RU", "light", (1440, 900)), ("en-GB", "dark", (1440, 900)), ("ru-RU", "dark", (360, 760)), ("en-GB", "light", (360, 760))]:
        token = get_posted(page, "/api/invite", {"role": "edit", "name": "Анна"})["token"]
        other = watched(browser, server, faults, locale=lang, color_scheme=theme, viewport={"width": size[0], "height": size[1]})
        opened(other, f"{server.base}/?token={token}")
        words = f"{lang} {theme} {size[0]}"
        looked_at(other, f"{words}: begun")
        for tab in ["task", "thing", "map"]:
            other.locator(f"#tab-{tab}").click()
            no_overflow(other)
            looked_at(other, f"{words}: {tab}")
        other.locator("#map").focus()
        other.keyboard.press("l")
        looked_at(other, f"{words}: layers")
        other.keyboard.press("l")
        other.keyboard.press("e")
        for tool in range(7):
            other.locator(".edbar .tb").nth(tool).focus()
            other.keyboard.press("Enter")
            no_overflow(other)
            looked_at(other, f"{words}: tool {tool}")
        other.keyboard.press("Escape")
        other.keyboard.press("e")
        other.locator("#tab-thing").click()
        other.locator("#panel .lnk.g").first.click()
        no_overflow(other)
        looked_at(other, f"{words}: a thing")
        picture(other, f"thing-{lang[:2]}-{theme}-{size[0]}")
        other.context.close()
    print("axe finds no fault")


def run(browser, server, faults):
    page = watched(browser, server, faults)
    opened(page, server.address)
    keys(page)
    states(browser, server, page, faults)


if __name__ == "__main__":
    judge(run)
