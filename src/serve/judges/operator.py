"""What an operator does with the console, in a real Chromium: python3 operator.py ORTHO [FOLDER FOR PICTURES].

One line for each thing done; the first that fails ends it.
"""

import time
from urllib.parse import quote

from console import drag, drawn, expect, get, get_posted, held, idle, judge, let_through, no_overflow, opened, picture, say, watched, where


def run(browser, server, faults):
    page = watched(browser, server, faults)
    ready = opened(page, server.address)
    assert "token" not in page.url, page.url
    no_overflow(page)
    print(f"opens the demo: {ready:.2f} s")

    say(page, "Где лекарство?")
    expect(page.locator(".log .turn").last).to_contain_text("Тумбочк")
    drawn(page, "#map .m-mark")
    picture(page, "asked")
    print("asks")

    # With the keyboard alone: the plan is shown, and driven by an empty line.
    say(page, "Поезжай к Точке-К")
    expect(page.locator(".next")).to_contain_text("План")
    before = get(page, "/api/state")["robot"]["place"]["pose"]
    drawn(page, "#map .m-planned")
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
    expect(page.locator("#say")).to_have_value("что-то недописанное")
    page.fill("#say", "")
    print("stops, while typing")

    # What answers late is older than what was heard meanwhile.
    held(page, "/confirm")
    say(page, "Поезжай в Комнату-В")
    page.locator("#confirm").click()
    page.wait_for_function("() => document.querySelector('.live').textContent.includes('едет')")
    page.press("#say", "Control+.")
    assert idle(page)["ended"][-1]["state"] == "stopped"
    expect(page.locator("#goon")).to_be_visible()
    let_through(page)
    page.locator(".lang button").first.click()
    expect(page.locator("#goon")).to_be_visible()
    held(page, f"/api/thing?name={quote('Стул-1')}")
    page.locator('#map .thing[data-name="Стул-1"]').click()
    page.locator('#map .thing[data-name="Стул-2"]').click()
    expect(page.locator("#panel .title").first).to_have_text("Стул-2")
    let_through(page)
    expect(page.locator("#panel .title").first).to_have_text("Стул-2")
    print("keeps to the newest, whatever answers late")

    other = watched(browser, server, faults, color_scheme="dark", locale="en-GB")
    token = get_posted(page, "/api/invite", {"role": "edit", "name": "Борис"})["token"]
    opened(other, f"{server.base}/?token={token}")
    expect(other.locator("html")).to_have_attribute("lang", "en")
    expect(other.locator("html")).to_have_attribute("data-theme", "dark")
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
    page.wait_for_selector("#panel .pf p")
    drawn(page, "#map .m-reason")
    picture(page, "why")
    print("selects a thing and asks why")

    phone = watched(browser, server, faults, viewport={"width": 360, "height": 760}, has_touch=True)
    token = get_posted(page, "/api/invite", {"role": "look", "name": "Анна"})["token"]
    opened(phone, f"{server.base}/?token={token}")
    no_overflow(phone)
    stop = phone.locator(".pstop")
    expect(stop).to_be_visible()
    assert stop.bounding_box()["height"] >= 44
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


if __name__ == "__main__":
    judge(run)
