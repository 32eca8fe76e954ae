"""What a person looks into, in a real Chromium: python3 reasons.py ORTHO [FOLDER FOR PICTURES].

Relations, reasons and what was measured, on the map; what was seen elsewhere; a point of the floor that is driven to; any two
revisions beside each other. One line for each thing done; the first that fails ends it.
"""

import os
import re
import subprocess

from console import ORTHO, drawn, expect, get, get_posted, idle, judge, opened, picture, say, watched, where
from editor import at, revision


def select(page, name):
    page.locator("#tab-thing").click()
    if page.locator("#panel input[type=search]").count() == 0:
        page.locator("#panel .lnk.end").click()
    page.locator("#panel input[type=search]").fill(name)
    page.locator("#panel .pick").get_by_role("button", name=name, exact=True).click()
    expect(page.locator("#panel .title").first).to_have_text(name)


def tagged(page, *lengths):
    """Waits for a tag on the map with one of these lengths."""
    text = re.compile("|".join(f"^{re.escape(length)}$" for length in lengths))
    expect(page.locator("#map .m-tag text", has_text=text).first).to_be_attached()


def measured(page, relation, *of):
    """The lengths that a reason rests on, as the map is to show them."""
    told = get(page, f"/api/why?relation={relation}&of={','.join(of)}&lang=ru")
    return told, [f"{one['length_cm']:.1f} см".replace(".", ",") for one in told["measures"] if one["length_cm"] < 1000]


def ortho(server, *arguments):
    environment = {**os.environ, "ORTHO_LANG": "ru"}
    done = subprocess.run([ORTHO, "--store", server.store, *arguments], capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stderr


def reasons(page):
    select(page, "Стул-1")
    page.wait_for_selector("#map .m-rel", state="attached")
    drawn(page, "#map .m-rellab", 3)
    page.locator("#map").focus()
    page.keyboard.press("l")
    page.get_by_label("Отношения выбранного").uncheck()
    expect(page.locator("#map .m-rel")).to_have_count(0)
    page.get_by_label("Отношения выбранного").check()
    page.locator("#map").focus()
    page.keyboard.press("l")
    picture(page, "relations")
    select(page, "Дверь-ВZ")
    page.wait_for_selector("#map .m-rel", state="attached")
    select(page, "Комната-Z")
    page.wait_for_selector("#map .m-rel", state="attached")
    print("sees the relations of a thing, a door and a room")

    select(page, "Стул-1")
    relation = next(r for r in get(page, "/api/thing?name=Стул-1&lang=ru")["relations"] if r["relation"] == "НАХОДИТСЯ_РЯДОМ_С")
    told, lengths = measured(page, relation["relation"], *relation["args"])
    assert told["holds"] and lengths, told
    row = page.locator("#panel .rel > li", has_text="рядом с").first
    row.locator(".why").click()
    page.wait_for_selector("#map .m-measure", state="attached")
    tagged(page, *lengths)
    drawn(page, "#map .m-reason", 2)
    expect(row.locator(".pf p").first).to_contain_text("потому что")
    picture(page, "why-measured")
    row.locator(".why").click()
    expect(page.locator("#map .m-measure")).to_have_count(0)
    print("is shown why, with what was measured where it was")

    page.wait_for_selector("#not-relation option", state="attached")
    page.locator("#not-relation").select_option("НАХОДИТСЯ_РЯДОМ_С")
    page.locator("#not-other").fill("Шкаф-1")
    page.locator("#panel").get_by_role("button", name="Спросить").click()
    expect(page.locator("#panel form .pf p").first).to_contain_text("не ")
    told, lengths = measured(page, "НАХОДИТСЯ_РЯДОМ_С", "Стул-1", "Шкаф-1")
    assert not told["holds"], told
    assert {"Стул-1", "Шкаф-1"} <= set(told["about"]), told["about"]
    drawn(page, "#map .m-reason", 2)
    for length in lengths:
        tagged(page, length)
    picture(page, "why-not")
    print("is shown why not")

    say(page, "Почему Книга-4 на Столе-1?")
    expect(page.locator(".log .turn").last).to_contain_text("потому что")
    page.wait_for_selector("#map .m-measure", state="attached")
    say(page, "Почему Книга-4 не на Диване-1?")
    page.wait_for_function("() => document.querySelectorAll('.log .turn:last-child .a').length && !document.querySelector('.log .turn:last-child .a').textContent.includes('…')")
    picture(page, "why-asked")
    print("asks why in the talk, and sees it on the map")


def by_clicking(page):
    room = next(room for room in get(page, "/api/drawing")["rooms"] if room["name"] == "Комната-В")
    x, y = [round(n) for n in room["middle"]]
    page.keyboard.press("Escape")
    page.locator(".tools").get_by_role("button", name="Ехать туда, куда щёлкну (G)").click()
    page.mouse.click(*at(page, x - 40, y + 30))
    expect(page.locator(".next")).to_contain_text("План")
    expect(page.locator("#panel .steps")).to_contain_text("точке")
    picture(page, "point")
    page.locator("#confirm").click()
    page.wait_for_function("() => document.querySelector('.live').textContent.includes('едет')")
    assert idle(page)["ended"][-1]["state"] == "done"
    pose = get(page, "/api/state")["robot"]["place"]["pose"]
    assert abs(pose["x"] - (x - 40)) < 20 and abs(pose["y"] - (y + 30)) < 20, (pose, x, y)
    page.locator(".tools").get_by_role("button", name="Ехать туда, куда щёлкну (G)").click()
    left = min(p[0] for one in get(page, "/api/drawing")["rooms"] for polygon in one["polygons"] for p in polygon)
    page.mouse.click(*at(page, left - 25, y))
    expect(page.locator(".log .turn").last).to_contain_text("ни в одном помещении")
    print("drives to the very point that was clicked, and is told where there is none")


def elsewhere(page, server):
    server.kill()
    for name, x, y in [("Стул-2", 330, 150), ("Стул-1", 330, 200)]:
        ortho(server, "observe", name, "--pose", f"{x},{y}", "--sure", "0.9")
    server.start()
    page.wait_for_function("() => document.querySelector('.live').textContent.includes('стоит')", timeout=30_000)
    page.reload()
    page.wait_for_selector("body[data-ready=yes]")
    page.wait_for_selector("#map .m-away", state="attached")
    page.locator("#tab-map").click()
    expect(page.locator("#panel .pair")).to_have_count(2)
    picture(page, "proposals")
    select(page, "Стул-2")
    expect(page.locator("#panel")).to_contain_text("уверенность")
    expect(page.locator("#panel")).to_contain_text("Где бывала")
    stood = where(page, "Стул-2")
    page.locator("#tab-map").click()
    now = revision(page)
    note = page.locator("#panel .note", has_text="Стул-2")
    note.get_by_role("button", name="Так и есть").click()
    page.wait_for_function(f"() => document.querySelector('.time').textContent.includes('ревизия {now + 1}')")
    assert where(page, "Стул-2") != stood
    page.locator("#panel .note", has_text="Стул-1").get_by_role("button", name="Нет, как на карте").click()
    expect(page.locator("#panel .pair")).to_have_count(0)
    assert get(page, "/api/proposals")["proposals"] == []
    print("confirms what was seen elsewhere, and rejects it")


def compared(page):
    for dx in (5, 5):
        get_posted(page, "/api/edits", {"on": revision(page), "reason": "", "edit": [{"move": "Чашка-1", "by": [dx / 5, 0]}]})
    page.locator("#tab-map").click()
    last = revision(page)
    page.wait_for_function(f"() => document.querySelector('#panel .rev li .r')?.textContent === '{last}'")
    page.locator("#panel .rev li", has=page.locator(f".r:text-is('{last - 1}')")).get_by_role("button", name="показать").click()
    expect(page.locator(".next")).to_contain_text(f"ревизии {last - 1}")
    page.locator("#panel .rev li", has=page.locator(".r:text-is('1')")).get_by_role("button", name="сравнить").click()
    expect(page.locator(".next")).to_contain_text(f"1 → {last - 1}")
    page.wait_for_selector("#map .m-past", state="attached")
    picture(page, "two-revisions")
    page.keyboard.press("Escape")
    print("compares any two revisions on the map")


def run(browser, server, faults):
    page = watched(browser, server, faults)
    opened(page, server.address)
    reasons(page)
    by_clicking(page)
    elsewhere(page, server)
    compared(page)


if __name__ == "__main__":
    judge(run)
