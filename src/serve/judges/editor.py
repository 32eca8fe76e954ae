"""What an editor draws, and what waits to be done, in a real Chromium: python3 editor.py ORTHO [FOLDER FOR PICTURES].

One line for each thing done; the first that fails ends it.
"""

import struct
import time
import zlib

from console import Error, drag, drawn, expect, get, get_posted, idle, judge, no_overflow, opened, picture, say, watched


def revision(page):
    return get(page, "/api/state")["revision"]


def last(page):
    return get(page, "/api/history")["revisions"][-1]


def at(page, x, y):
    """Where on the screen a point of the map is."""
    box = page.locator("#map").bounding_box()
    left, top, width, _ = [float(n) for n in page.locator("#map").get_attribute("viewBox").split()]
    k = box["width"] / width
    return box["x"] + (x - left) * k, box["y"] + (-y - top) * k


def press(page, mark):
    """Clicks a mark of the map, also where the map is drawn anew meanwhile."""
    for again in range(5):
        try:
            expect(page.locator(mark).first).to_be_visible()
            return page.locator(mark).first.click(force=True)
        except Error:
            if again == 4:
                raise
            time.sleep(0.2)


def outline(page, *corners):
    """Drags from the first corner to the second; or clicks all of them."""
    if len(corners) == 2:
        page.mouse.move(*at(page, *corners[0]))
        page.mouse.down()
        for step in range(1, 6):
            x, y = [a + (b - a) * step / 5 for a, b in zip(*corners)]
            page.mouse.move(*at(page, x, y))
        page.mouse.up()
    else:
        for corner in corners:
            page.mouse.click(*at(page, *corner))


def write(page):
    expect(page.locator("#panel .note.ok")).to_be_visible()
    before = revision(page)
    page.locator("#write").click()
    expect(page.locator(".toast")).to_contain_text(f"ревизия {before + 1}")
    assert last(page)["user"] == "operator"


def tool(page, name):
    page.locator(".edbar").get_by_role("button", name=name, exact=True).click()


def extent(page):
    points = [p for room in get(page, "/api/drawing")["rooms"] for polygon in room["polygons"] for p in polygon]
    return [f(p[axis] for p in points) for f in (min, max) for axis in (0, 1)]


def png(width, height):
    """A grey picture with a black frame."""
    row = lambda y: b"\0" + bytes(0 if min(x, y, width - 1 - x, height - 1 - y) < 3 else 200 for x in range(width))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    pixels = zlib.compress(b"".join(row(y) for y in range(height)))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


def run(browser, server, faults):
    page = watched(browser, server, faults)
    opened(page, server.address)
    left, bottom, right, top = extent(page)
    page.locator("#map").focus()
    page.keyboard.press("e")
    for _ in range(2):
        page.keyboard.press("-")

    # A room beside the house, by a drag; it is tried while it is drawn.
    tool(page, "Помещение")
    outline(page, (right + 20, bottom + 10), (right + 320, bottom + 260))
    expect(page.locator("#f-name")).to_have_value("Помещение-1")
    expect(page.locator("#panel .note.ok")).to_be_visible()
    page.locator("#f-name").fill("Кладовая")
    picture(page, "room")
    write(page)
    rooms = {room["name"]: room for room in get(page, "/api/drawing")["rooms"]}
    assert abs(rooms["Кладовая"]["m2"] - 7.5) < 1.5, rooms["Кладовая"]["m2"]
    print("draws a room")

    # One with six corners, by clicks; Enter closes it.
    outline(page, (left, top + 60), (left + 300, top + 60), (left + 300, top + 160), (left + 150, top + 160), (left + 150, top + 260), (left, top + 260))
    page.locator("#map").focus()
    page.keyboard.press("Enter")
    expect(page.locator("#panel .note.ok")).to_be_visible()
    picture(page, "room-corners")
    page.keyboard.press("Enter")
    page.wait_for_function("() => document.querySelector('.time').textContent.includes('ревизия 3')")
    print("draws a room of six corners and writes it with Enter")

    # What cannot be is told while it is drawn: a room over another.
    outline(page, (left + 60, bottom + 60), (left + 260, bottom + 260))
    expect(page.locator("#panel .note.bad")).to_be_visible()
    expect(page.locator("#write")).to_be_disabled()
    picture(page, "room-wrong")
    page.keyboard.press("Escape")
    assert revision(page) == 3
    print("is told what cannot be, and writes nothing")

    # A room by the keyboard alone.
    page.locator("#map").focus()
    page.locator(".edbar").get_by_role("button", name="Помещение", exact=True).focus()
    page.keyboard.press("Enter")
    for field, value in [("f-box0", left), ("f-box1", bottom - 400), ("f-box2", 250), ("f-box3", 200)]:
        page.locator(f"#{field}").focus()
        page.keyboard.press("Control+a")
        page.keyboard.type(str(round(value)))
        page.keyboard.press("Tab")
    expect(page.locator("#panel .note.ok")).to_be_visible()
    page.locator("#f-name").focus()
    page.keyboard.press("Enter")
    page.wait_for_function("() => document.querySelector('.time').textContent.includes('ревизия 4')")
    page.locator("#map").focus()
    page.keyboard.press("Escape")
    page.keyboard.press("Control+z")
    page.wait_for_function("() => document.querySelector('.time').textContent.includes('ревизия 5')")
    print("draws a room by the keyboard alone, and takes it back")

    # A door between two rooms: by the fields, then moved along the wall.
    tool(page, "Дверь")
    page.locator("#f-one").select_option("Комната-Z")
    page.locator("#f-other").select_option("Комната-В")
    expect(page.locator("#verdict")).to_contain_text("Всё верно")
    page.locator("#f-along").fill("-60")
    page.locator("#f-width").fill("80")
    expect(page.locator("#verdict")).to_contain_text("Всё верно")
    picture(page, "door")
    write(page)
    doors = {door["name"]: door for door in get(page, "/api/drawing")["doors"] if door["name"]}
    name = next(name for name in doors if name.startswith("Дверь-новая"))
    assert set(doors[name]["rooms"]) == {"Комната-Z", "Комната-В"}, doors[name]
    print("puts a door into the wall of two rooms")

    # Open, shut, locked.
    page.keyboard.press("Escape")
    leaf = f'#map .door[data-name="{name}"] :is(.m-leaf, .m-locked)'
    press(page, leaf)
    for word, state in [("Заперта", "locked"), ("Открыта", "open")]:
        page.locator("#panel").get_by_role("button", name=word, exact=True).click()
        write(page)
        doors = {door["name"]: door for door in get(page, "/api/drawing")["doors"] if door["name"]}
        assert doors[name]["state"] == state, doors[name]
        press(page, leaf)
    print("locks a door and opens it")

    # A zone with an end in time.
    tool(page, "Зона")
    page.locator("#f-kind").select_option("closed")
    outline(page, (left + 250, bottom + 280), (left + 350, bottom + 340))
    page.locator("#f-reason").fill("моют пол")
    page.locator("#f-until").fill("2099-01-01T10:00")
    write(page)
    zones = get(page, "/api/drawing")["zones"]
    assert [zone["kind"] for zone in zones] == ["closed"] and zones[0]["until"].startswith("2099"), zones
    assert zones[0]["in_force"] and zones[0]["reason"] == "моют пол", zones
    expect(page.locator("#map .m-zone")).to_have_count(1)
    page.keyboard.press("Escape")
    picture(page, "zone")
    page.mouse.click(*at(page, left + 300, bottom + 310))
    page.locator("#panel").get_by_role("button", name="Кончается сейчас").click()
    write(page)
    zones = get(page, "/api/drawing")["zones"]
    assert not zones[0]["in_force"], zones
    print("draws a zone with its end in time, and ends it")

    def of_room(field):
        return next(room for room in get(page, "/api/drawing")["rooms"] if room["name"] == "Кладовая")[field]

    # The shape is locked until somebody unlocks it, for each edit anew. Each corner is dragged outward, that at the origin of
    # the room's coordinates too: all others stay.
    page.locator("#map").focus()
    page.keyboard.press("-")
    for number in range(4):
        press(page, '#map [data-name="Кладовая"]')
        expect(page.locator("#map rect.m-handle")).to_have_count(0)
        tool(page, "Форма заперта")
        page.wait_for_selector("#map rect.m-handle", state="attached")
        corners, area = of_room("polygons")[0], of_room("m2")
        x, y = corners[number]
        away = [60 if at > sum(axis) / 4 else -15 for at, axis in zip((x, y), zip(*corners))]
        outline(page, (x, y), (x + away[0], y + away[1]))
        picture(page, f"shape-{number}")
        write(page)
        assert of_room("m2") > area, (number, of_room("m2"), area)
        for other, (was, now) in enumerate(zip(corners, of_room("polygons")[0])):
            moved = max(abs(a - b) for a, b in zip(was, now))
            assert moved > 10 if other == number else moved < 0.2, (number, other, was, now)
    print("puts each corner of a room elsewhere, unlocked")

    # A picture of a plan beneath, dragged, and scaled by two points of it.
    before = revision(page)
    tool(page, "Рисунок")
    page.set_input_files("#f-plan", {"name": "plan.png", "mimeType": "image/png", "buffer": png(400, 300)})
    page.wait_for_selector(".canvas.traced")
    page.mouse.click(*at(page, left, bottom))
    page.mouse.click(*at(page, left + 200, bottom))
    scale = float(page.locator("#f-plan-scale").input_value())
    page.locator("#f-plan-cm").fill("400")
    page.locator("#f-plan-cm").press("Tab")
    page.wait_for_function(f"() => Math.abs(document.querySelector('#f-plan-scale').value - {2 * scale}) < 0.02")
    picture(page, "picture")
    page.reload()
    page.wait_for_selector(".canvas.traced")
    assert revision(page) == before, "the picture is no part of the map"
    page.locator("#map").focus()
    page.keyboard.press("e")
    tool(page, "Рисунок")
    page.get_by_role("button", name="Убрать рисунок").click()
    page.wait_for_selector(".canvas:not(.traced)")
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    print("lays a picture of a plan beneath, scales it and finds it again")

    # What changed between two revisions, on the map.
    page.locator("#tab-map").click()
    page.locator("#panel .rev li").nth(0).get_by_role("button", name="что").click()
    page.wait_for_selector("#map .changes path", state="attached")
    expect(page.locator(".next")).to_contain_text("Что изменилось")
    page.locator(".time input").focus()
    page.keyboard.press("Home")
    expect(page.locator(".next")).to_contain_text("ревизии 1")
    page.wait_for_selector("#map .m-next.new", state="attached")
    picture(page, "changes")
    page.keyboard.press("Escape")
    print("sees on the map what changed")
    tasks(page, browser, server, faults)


def tasks(page, browser, server, faults):
    # The way, and what would open it.
    token = get_posted(page, "/api/edits", {"on": revision(page), "reason": "запереть", "edit": [
        {"state": door["name"], "is": "locked"} for door in get(page, "/api/drawing")["doors"] if door["name"] and door.get("leaves")]})
    assert token["outcome"] == "edited", token
    press(page, '#map [data-name="Точка-К"]')
    page.locator("#panel").get_by_role("button", name="Путь", exact=True).click()
    expect(page.locator(".next")).to_contain_text("Точка-К")
    picture(page, "way")
    if "не проехать" in page.locator(".next").inner_text():
        drawn(page, "#map .m-cure")
    get_posted(page, "/api/undo", {"on": revision(page)})
    page.keyboard.press("Escape")
    print("is shown the way, and what bars it")

    # A favourite, put off, begun, paused, gone on with after a kill.
    say(page, "Принеси лекарство")
    expect(page.locator(".next")).to_contain_text("План")
    expect(page.locator("#panel")).to_contain_text("План держится на том, что")
    expect(page.locator("#panel")).not_to_contain_text("ДВЕРЬ_")
    page.locator("#panel .star").first.click()
    page.locator(".next").get_by_role("button", name="Позже").click()
    page.locator("#tab-task").click()
    expect(page.locator("#panel .queue li")).to_have_count(1)
    say(page, "Позже: поезжай к Точке-К")
    expect(page.locator("#panel .queue li")).to_have_count(2)
    page.get_by_role("button", name="Раньше: поезжай к Точке-К").click()
    expect(page.locator("#panel .queue li").first).to_contain_text("Точке-К")
    page.get_by_role("button", name="Раньше: Принеси лекарство").click()
    expect(page.locator("#panel .queue li").first).to_contain_text("лекарство")
    picture(page, "queue")
    page.locator("#panel .queue").get_by_role("button", name="Начать: Принеси лекарство").click()
    page.wait_for_function("() => document.querySelector('.live').textContent.includes('едет')")
    deadline = time.monotonic() + 60
    while get(page, "/api/state")["robot"]["carries"] is None:
        assert time.monotonic() < deadline, "it takes nothing"
        time.sleep(0.05)
    page.wait_for_selector("#map .m-tag.belief", state="attached")
    picture(page, "carried")
    page.locator("#panel").get_by_role("button", name="Пауза", exact=True).click()
    idle(page)
    expect(page.locator("#panel .queue li").first).to_contain_text("начато и прервано")
    server.kill()
    # A request that nobody waits for is no fault of the page when the line is down.
    page.evaluate("""async () => {
        const { api } = await import('./base.js');
        api('/api/state');
        await new Promise((done) => setTimeout(done, 200));
    }""")
    expect(page.locator(".next")).to_contain_text("Связи нет", timeout=10_000)
    server.start()
    page.wait_for_function("() => document.querySelector('.live').textContent.includes('стоит')", timeout=30_000)
    expect(page.locator("#panel .queue li")).to_have_count(2)
    picture(page, "broken-off")
    page.locator("#panel").get_by_role("button", name="Продолжить", exact=True).click()
    # Between the two it stands for a moment.
    expect(page.locator("#panel .queue li")).to_have_count(0, timeout=60_000)
    ended = idle(page)["ended"]
    assert [task["state"] for task in ended] == ["done", "done"], ended
    expect(page.locator("#panel")).to_contain_text("Избранное")
    picture(page, "ended")
    print("puts off, pauses, goes on after the server was killed, and keeps a favourite")

    phone = watched(browser, server, faults, viewport={"width": 360, "height": 760}, has_touch=True, color_scheme="dark", locale="en-GB")
    token = get_posted(page, "/api/invite", {"role": "edit", "name": "Анна"})["token"]
    opened(phone, f"{server.base}/?token={token}")
    phone.locator(".tools").get_by_role("button", name="Edit (E)").click()
    phone.locator(".edbar").get_by_role("button", name="Zone", exact=True).click()
    no_overflow(phone)
    picture(phone, "phone-zone")
    phone.locator("#tab-task").click()
    no_overflow(phone)
    picture(phone, "phone-tasks")
    nameless = phone.evaluate(
        """() => [...document.querySelectorAll('button, input, select, [role=tab]')].filter((one) => one.offsetParent &&
        !(one.getAttribute('aria-label') || one.textContent.trim() || one.closest('label'))).map((one) => one.outerHTML)"""
    )
    assert not nameless, nameless
    print("draws on 360 px, in English and dark, and every control has a name")


if __name__ == "__main__":
    judge(run)
