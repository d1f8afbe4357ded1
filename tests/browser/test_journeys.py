"""Five journeys of a designer in a browser, with their times.

Tests compare numbers, never pixels; pictures for people go to `out/studio`.
"""

from __future__ import annotations

import json
from pathlib import Path

from niwaki import gallery, studio
from studio_page import (
    at_rest,
    camera,
    choose,
    click_part,
    contrasts,
    grow,
    nameless,
    picture,
    settled,
    timed,
    times,
    until,
    visible,
)
from studio_process import serving


def test_fill(open_page, served):
    page = open_page(served)
    with timed("model"):
        page.select_option("select[aria-label=Model]", "spaceship")
        until(page, "window.__studio.view.model.reference == 'spaceship'")
    choose(page, "spaceship", 8)
    settled(page)
    before = camera(page)
    with timed("first shape"):
        page.locator("button.primary").click()
        until(page, "['best', 'result'].includes(window.__studio.shown.role)")
    assert page.evaluate("window.__studio.shown.triangles > 0")
    with timed("gallery"):
        until(page, "window.__studio.view.results.length >= 2")
    until(
        page, "document.querySelectorAll('canvas[data-drawn]').length == window.__studio.view.results.length"
    )
    at_rest(page)
    assert (camera(page) == before).all()
    times["frame"] = page.evaluate("window.__studio.frameSeconds(5)")
    picture(page, "fill")


def test_shape_by_hand(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 1, seed=3)
    grow(page)
    at_rest(page)
    before = camera(page)
    address = visible(page, "wings")
    with timed("part"):
        click_part(page, address)
        until(page, f"window.__studio.selection.part == {json.dumps(address)}")
    call = address.rpartition("/")[0]
    assert page.evaluate("window.__studio.selection.level") == call
    assert "spaceship.py:" in page.locator(".source").inner_text()
    ship = gallery.entry("spaceship").model
    whole, last = ship.labels.label(call), ship.labels.short(call)
    crumbs = page.locator(".levels button").all_inner_texts()
    assert crumbs[-1] == last and last.startswith("section") and " › " in whole
    assert page.locator(".levels button[aria-current=true]").get_attribute("title") == call
    assert any(crumb.startswith("wing") for crumb in crumbs) and "while" not in "".join(crumbs)
    fit = page.evaluate("window.__studio.view.results[0].fit")
    caption = page.locator(".card .caption span").first.inner_text()
    assert caption.replace("\u00a0", " ") == fit and fit.endswith("% outside")
    picture(page, "shape")
    first = page.evaluate("window.__studio.view.picked.run")
    with timed("re-roll"):
        page.get_by_role("button", name="Re-roll").click()
        until(page, f"window.__studio.view.picked.run != {first}")
    with timed("undo"):
        page.keyboard.press("Control+z")
        until(page, f"window.__studio.view.picked.run == {first}")
    at_rest(page)
    with timed("hold"):
        page.keyboard.press("h")
        until(page, "document.querySelector('.held li')")
    until(page, "window.__studio.view.held.length == 1")
    held = page.evaluate("window.__studio.view.held[0].choices")
    page.get_by_role("button", name="Grow the rest").click()
    until(page, f"!window.__studio.view.searching && window.__studio.view.picked.run != {first}")
    at_rest(page)
    until(page, "window.__studio.described.key.run == window.__studio.view.picked.run")
    choices = {row["address"]: row["value"] for row in page.evaluate("window.__studio.described.choices")}
    assert {name: choices[name] for name in held} == held
    assert (camera(page) == before).all()
    picture(page, "held")
    page.get_by_role("button", name=f"Free {whole}").click()
    until(page, "window.__studio.view.held.length == 0")


def test_a_slider_of_a_choice(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 1, seed=3)
    grow(page)
    at_rest(page)
    page.locator(".choice input[type=range]").nth(2).focus()
    before = page.evaluate("window.__studio.view.picked.run")
    page.keyboard.press("ArrowRight")
    until(page, f"window.__studio.view.picked.run != {before}")
    assert page.evaluate("window.__studio.view.results.at(-1).origin") == "choose"


def test_write(open_page, served, pile):
    page = open_page(served)
    good = pile.read_text()
    choose(page, str(pile), 1, seed=4)
    page.select_option("select[aria-label=Target]", "box")
    until(page, "window.__studio.view.ask.target?.source == 'box'")
    grow(page)
    at_rest(page)
    before, triangles = camera(page), page.evaluate("window.__studio.shown.triangles")
    try:
        with timed("error"):
            pile.write_text(good.replace("w = uniform(0.5, 2.0)", "w = [uniform(0.5, 2.0)]\n    w.append(1)"))
            until(page, "document.querySelector('.problem')")
        assert "^^^" not in page.locator(".problem").inner_text()
        page.locator(".problem summary").click()
        text = page.locator(".problem").inner_text()
        assert "pile.py:15" in text and "w.append(1)" in text and "^^^" in text
        assert page.evaluate("window.__studio.shown.triangles") == triangles
        picture(page, "write")
        with timed("mended"):
            pile.write_text(good)
            until(page, "!document.querySelector('.problem')")
        assert (camera(page) == before).all()
    finally:
        pile.write_text(good)


def test_draw(open_page, served):
    page = open_page(served)
    choose(page, "building", 1)
    settled(page)
    page.keyboard.press("d")
    box = page.locator("main.stage").bounding_box()
    x, y = box["x"] + 0.5 * box["width"], box["y"]
    page.mouse.move(x, y + 0.35 * box["height"])
    page.mouse.down()
    page.mouse.move(x + 3, y + 0.6 * box["height"], steps=6)
    with timed("stroke"):
        page.mouse.up()
        until(page, "window.__studio.view.ask.sketch?.strokes.length == 1")
    before = camera(page)
    picture(page, "draw")
    grow(page, "Grow into it")
    assert page.evaluate("window.__studio.view.results[0].similarity") >= 0.8
    at_rest(page)
    assert (camera(page) == before).all()
    picture(page, "drawn")


def test_finish(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 3)
    grow(page)
    at_rest(page)
    page.get_by_role("button", name="Star this result").first.click()
    until(page, "window.__studio.view.stars.length == 1")
    page.get_by_role("button", name="Export").click()
    with timed("export"), page.expect_download() as download:
        page.get_by_role("menuitem", name="GLB").click()
    assert Path(download.value.path()).read_bytes().startswith(b"glTF")


def test_dark_and_keyboard_only(open_page, served):
    page = open_page(served, color_scheme="dark")
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
    choose(page, "niwaki-tree", 3)
    page.locator("main.stage canvas").first.focus()
    page.keyboard.press("Enter")
    until(page, "window.__studio.view.results.length > 1 && !window.__studio.view.searching")
    at_rest(page)
    page.locator("[role=option][aria-selected=true]").focus()
    first = page.evaluate("window.__studio.view.picked.number")
    page.keyboard.press("ArrowRight")
    until(page, f"window.__studio.view.picked.number != {first}")
    page.keyboard.press("s")
    until(page, "window.__studio.view.stars.length > 0")
    assert nameless(page) == 0 and contrasts(page) == []
    picture(page, "dark")


def test_two_windows_share_a_session_and_have_separate_views(open_page, served):
    first, second = open_page(served), open_page(served)
    choose(first, "spaceship", 2)
    grow(first)
    at_rest(first)
    count = first.evaluate("window.__studio.view.results.length")
    until(second, f"window.__studio.view.results.length == {count}")
    at_rest(second)
    for page in (first, second):
        until(page, "window.__studio.isStill")
    before, camera_text = camera(second), first.evaluate("String(window.__studio.camera)")
    first.mouse.move(700, 400)
    first.mouse.down()
    first.mouse.move(820, 430, steps=3)
    first.mouse.up()
    # The camera's matrix is that of the last frame that was drawn.
    until(first, f"String(window.__studio.camera) != {json.dumps(camera_text)}")
    assert (camera(second) == before).all()


#: Frames and timers of a page come a second late, as on a machine that has much to do.
LATE = """
const [frame, timer] = [requestAnimationFrame, setTimeout];
window.requestAnimationFrame = (call) => frame(() => timer(call, 1000));
window.setTimeout = (call, wait, ...rest) => timer(call, (wait ?? 0) + 1000, ...rest);
"""


def test_a_window_that_draws_late_shows_the_target(open_page, served):
    choose(open_page(served), "spaceship")
    late = open_page(served, script=LATE)
    until(late, "window.__studio.ghost > 0")


def test_no_request_leaves_the_machine_and_the_security_policy_holds(browser, served):
    context = browser.new_context()
    page = context.new_page()
    urls, messages = [], []
    page.on("request", lambda request: urls.append(request.url))
    page.on("console", lambda message: messages.append(message.text))
    page.goto(f"{served.url}/open?token={served.link()}")
    # The pictures of models or results are the last that a page loads.
    page.locator("canvas[data-drawn]").first.wait_for()
    assert urls and all(url.startswith((served.url, "data:", "blob:")) for url in urls)
    assert not [text for text in messages if "Content Security Policy" in text]
    context.close()


def test_a_session_is_restored_after_a_kill_in_a_search(open_page, tmp_path):
    with serving(tmp_path) as served:
        page = open_page(served)
        choose(page, "spaceship", 3)
        grow(page)
        results = page.evaluate("window.__studio.view.results")
        with studio.connect(served.url, served.key) as script:
            script.ask("set", settings={"count": 8, "seed": 1, "effort": 64.0})
            script.ask("model", reference="gnarly-tree")
            script.ask("undo")
            script.ask("set", settings={"count": 16, "seed": 1, "effort": 64.0})
        page.locator("button.primary").click()
        until(page, "window.__studio.shown.role == 'best'")
        served.kill()
    with serving(tmp_path) as served:
        page = open_page(served)
        assert page.evaluate("window.__studio.view.results") == results
        assert page.evaluate("window.__studio.view.interrupted")
        until(
            page,
            "document.querySelectorAll('canvas[data-drawn]').length == window.__studio.view.results.length",
        )
        at_rest(page)
