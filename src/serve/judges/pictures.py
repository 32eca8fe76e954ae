"""The pictures of docs/console.md and the README, made anew: python3 pictures.py ORTHO [FOLDER], the folder docs unless told.

Each is what a person sees who does what stands beside it; nothing is posed.
"""

import pathlib
import sys

if len(sys.argv) < 3:
    sys.argv.append(str(pathlib.Path(__file__).resolve().parents[3] / "docs"))

from console import drag, expect, get, get_posted, judge, opened, picture, say, watched  # noqa: E402


def another(browser, server, page, faults, name, **more):
    token = get_posted(page, "/api/invite", {"role": "edit", "name": name})["token"]
    other = watched(browser, server, faults, **more)
    opened(other, f"{server.base}/?token={token}")
    return other


def run(browser, server, faults):
    page = watched(browser, server, faults)
    opened(page, server.address)
    english = another(browser, server, page, faults, "Boris", locale="en-GB", color_scheme="dark")
    say(page, "Где лекарство?")
    expect(page.locator(".log .turn").last).to_contain_text("Тумбочк")

    # A reason: what was measured, where it was measured.
    say(page, "Почему Книга-4 на Столе-1?")
    page.wait_for_timeout(600)
    page.locator('#map .thing[data-name="Стул-1"]').click()
    page.locator("#panel .rel > li", has_text="рядом с").first.locator(".why").click()
    page.wait_for_selector("#panel .pf p")
    page.wait_for_selector("#map .m-measure", state="attached")
    page.wait_for_timeout(300)
    picture(page, "console-why")
    page.keyboard.press("Escape")

    # Two edit one thing: the second is shown what the first did.
    for one in (page, english):
        one.locator("#map").focus()
        one.keyboard.press("e")
    drag(page, "Стул-1", 30, 0)
    drag(english, "Стул-1", 0, 25)
    expect(page.locator("#panel .note.ok")).to_be_visible()
    expect(english.locator("#panel .note.ok")).to_be_visible()
    page.locator("#write").click()
    expect(page.locator(".toast")).to_contain_text("ревизия 2")
    english.locator("#write").click()
    expect(english.locator("#panel .note.warn")).to_contain_text("operator")
    picture(english, "console-stale")
    page.locator(".toast").get_by_role("button", name="Закрыть").click()
    page.locator("#map").focus()
    page.keyboard.press("Control+z")
    page.wait_for_function("() => document.querySelector('.time').textContent.includes('ревизия 3')")
    # Editing ends, so that what matters now has its card again.
    page.locator("#map").focus()
    page.keyboard.press("e")
    expect(page.locator(".edbar")).to_have_count(0)

    # An order under way.
    say(page, "Принеси лекарство")
    expect(page.locator(".next")).to_contain_text("План")
    page.locator("#tab-task").click()
    page.locator("#confirm").click()
    page.wait_for_function("() => document.querySelectorAll('#panel .steps .done').length >= 2")
    page.wait_for_timeout(500)
    picture(page, "console")

    phone = another(browser, server, page, faults, "Анна", viewport={"width": 360, "height": 760}, has_touch=True, device_scale_factor=2)
    phone.locator("#tab-task").click()
    phone.wait_for_timeout(300)
    picture(phone, "console-phone")
    page.keyboard.press("Control+.")


if __name__ == "__main__":
    judge(run)
