"""The first hour of a designer: the first screen, the pen, sizes, layout, menus, messages, two windows, a restart."""

from __future__ import annotations

import json
import os
from functools import partial
from pathlib import Path

import pytest
import trimesh
from studio_page import at_rest, camera, choose, click_part, grow, picture, resize, settled, until, visible
from studio_process import serving

#: Sizes of windows, from a small laptop to a large screen.
SIZES = [(1024, 700), (1440, 900), (1920, 1080)]


@pytest.fixture
def open_page(open_page):
    """Small windows, which a software renderer draws faster."""
    return partial(open_page, viewport={"width": 1080, "height": 700})


def first(page, reference):
    """Choose a model without results."""
    page.select_option("select[aria-label=Model]", reference)
    until(page, f"window.__studio.view.model.reference == {json.dumps(reference)}")


def test_the_first_screen_shows_a_run_says_what_is_missing_and_offers_six_models(open_page, served, pile):
    page = open_page(served)
    until(page, "window.__studio.shown.role == 'prior' && window.__studio.shown.triangles > 0")
    until(page, "document.querySelectorAll('.models canvas[data-drawn]').length == 6")
    button = page.get_by_role("button", name="Grow", exact=True)
    assert button.is_disabled()
    reason = page.locator(f"#{button.get_attribute('aria-describedby')}").inner_text()
    assert reason.startswith("Choose what to grow into")
    picture(page, "first")
    page.get_by_role("group", name="Models to begin with").get_by_text("Castle").click()
    until(page, "window.__studio.view.model.reference == 'castle' && window.__studio.isGhostShown")
    until(page, "window.__studio.shown.role == 'prior' && window.__studio.shown.parts.length > 8")
    assert button.is_enabled() and page.evaluate("window.__studio.seesAll")
    first(page, str(pile))
    page.get_by_label("Target", exact=True).select_option("box")
    until(page, "window.__studio.view.ask.target")
    assert button.is_enabled()


def test_a_slider_at_a_whole_number_stays_a_slider_of_real_numbers(open_page, served, pile):
    page = open_page(served)
    choose(page, str(pile), 1, seed=4)
    page.get_by_label("Target", exact=True).select_option("box")
    until(page, "window.__studio.view.ask.target?.source == 'box'")
    assert page.get_by_label("height").get_attribute("step") == "any"
    assert page.get_by_label("count").get_attribute("step") == "1"
    grow(page)
    at_rest(page)
    choices = "window.__studio.described.choices"
    address = page.evaluate(f"{choices}.find(choice => choice.family == 'uniform').address")
    command = {"kind": "choose", "address": address, "value": 1}
    page.evaluate(f"window.__studio.tell({json.dumps(command)})")
    until(page, f"{choices}.some(choice => choice.address == {json.dumps(address)} && choice.value === 1)")
    assert not page.evaluate(f"{choices}.find(choice => choice.address == {json.dumps(address)}).is_whole")
    slider = page.locator(f"label[title*={json.dumps(address)}] input")
    assert 0 < float(slider.get_attribute("step")) < 0.1


def test_a_closed_outline_means_its_inside_and_is_shown_as_it_is_scored(open_page, served):
    page = open_page(served)
    choose(page, "building", 1)
    settled(page)
    page.keyboard.press("d")
    box = page.locator("main.stage").bounding_box()
    house = [(0.36, 0.7), (0.36, 0.4), (0.5, 0.22), (0.64, 0.4), (0.64, 0.7), (0.38, 0.705)]
    points = [(box["x"] + x * box["width"], box["y"] + y * box["height"]) for x, y in house]
    page.mouse.move(*points[0])
    page.mouse.down()
    for point in points[1:]:
        page.mouse.move(*point, steps=4)
    page.mouse.up()
    until(page, "window.__studio.mask?.share > 0.1")
    filled = page.evaluate("window.__studio.mask.share")
    picture(page, "outline")
    fill = page.get_by_label("fill outlines")
    fill.uncheck()
    until(page, f"window.__studio.mask.share < {0.7 * filled}")
    fill.check()
    until(page, f"window.__studio.mask.share == {filled}")
    grow(page, "Grow into it")
    assert page.evaluate("window.__studio.view.results[0].covered") > 0.8


def test_a_target_of_another_size_direction_or_place_is_offered_a_fit(open_page, served, pile, tmp_path):
    page = open_page(served)
    first(page, str(pile))
    mesh = trimesh.creation.box((800.0, 600.0, 2400.0))
    mesh.apply_translation((0.0, 0.0, 1200.0))
    mesh.export(tmp_path / "mm.stl")
    page.get_by_label("A mesh to grow into").set_input_files(tmp_path / "mm.stl")
    until(page, "window.__studio.view.sizes.offers.length == 2")
    sizes = page.get_by_role("group", name="Sizes")
    assert "800 × 600 × 2,400" in sizes.inner_text() and "800 times as large" in sizes.inner_text()
    picture(page, "sizes")
    sizes.get_by_role("button", name="Stand it up").click()
    until(page, "window.__studio.view.ask.target.up == 'z' && window.__studio.view.sizes.offers.length == 1")
    sizes.get_by_role("button", name="Scale to fit").click()
    until(page, "window.__studio.view.sizes.offers.length == 0 && window.__studio.seesAll")
    wide, high, deep = page.evaluate("window.__studio.view.sizes.target")
    assert high == pytest.approx(page.evaluate("window.__studio.view.sizes.model[1]"), rel=0.01)
    assert (wide, deep) == (pytest.approx(high / 3, rel=0.01), pytest.approx(high / 4, rel=0.01))
    target = page.evaluate("window.__studio.view.ask.target")
    page.evaluate(
        f"window.__studio.tell({json.dumps({'kind': 'ask', 'ask': {'target': target | {'move': [90, 0, 0]}}})})"
    )
    sizes.get_by_role("button", name="Move it here").click()
    until(page, "window.__studio.view.sizes.offers.length == 0")
    assert abs(page.evaluate("window.__studio.view.ask.target.move[0]")) < 1


def test_nothing_is_cut_off_in_small_and_large_windows_with_classic_scrollbars(browser, served):
    flags = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    chromium = browser.browser_type.launch(
        executable_path=os.environ["NIWAKI_BROWSER"],
        chromium_sandbox=False,
        args=flags,
        ignore_default_args=["--hide-scrollbars"],
    )
    page = chromium.new_context(bypass_csp=True).new_page()
    page.goto(f"{served.url}/open?token={served.link()}")
    page.wait_for_function("window.__studio?.view?.model")
    page.set_default_timeout(60_000)
    choose(page, "spaceship", 12, seed=3)
    grow(page)
    at_rest(page)
    for wide, high in SIZES:
        resize(page, wide, high)
        page.keyboard.press("f")
        until(page, "window.__studio.isStill")
        strip = page.locator(".gallery").bounding_box()
        # The scrollbar of the strip lies below its cards.
        room = page.evaluate("document.querySelector('.gallery').clientHeight")
        card = page.locator(".caption").first.bounding_box()
        assert card["y"] + card["height"] <= strip["y"] + room and card["height"] > 10
        start = page.locator("button.primary").bounding_box()
        assert start["y"] + start["height"] <= high
        bar, stage = page.locator(".growth").bounding_box(), page.locator("main.stage").bounding_box()
        left, top, right, bottom = page.evaluate("window.__studio.box")
        assert left >= 0 and top >= 0 and right <= stage["width"]
        assert stage["y"] + bottom <= bar["y"] + 1
        cut = "nodes => nodes.filter(node => node.scrollWidth > node.clientWidth + 1).map(node => node.outerHTML)"
        assert page.eval_on_selector_all(".caption span, .bar, .growth, .start", cut) == []
        picture(page, f"layout-{wide}")
    chromium.close()


def test_menus_close_by_escape_by_a_click_elsewhere_and_by_undo(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 1)
    grow(page)
    at_rest(page)
    click_part(page, visible(page, "wings"))
    until(page, "window.__studio.selection.part")
    part = page.evaluate("window.__studio.selection.part")
    menu = page.get_by_role("menu")
    for name in ("Export", "Add an object"):
        button = page.get_by_role("button", name=name)
        button.click()
        assert menu.count() == 1
        page.keyboard.press("Escape")
        menu.wait_for(state="detached")
        assert page.evaluate("window.__studio.selection.part") == part
        assert button.evaluate("node => node === document.activeElement")
        button.click()
        page.locator(".mark").click()
        menu.wait_for(state="detached")
        button.click()
        page.keyboard.press("Control+z")
        menu.wait_for(state="detached")
        page.keyboard.press("Control+Shift+z")


def test_a_message_is_a_plain_sentence_with_folded_details_that_goes_when_it_is_solved(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 1)
    grow(page)
    at_rest(page)
    page.evaluate("window.__studio.hold('block#1/roof/gable')")
    notice = page.locator(".notice.error")
    notice.wait_for()
    text = notice.locator("p").inner_text()
    assert text.endswith(".") and text[0].isupper() and not set("`#\n=") & set(text), text
    box, stage = notice.bounding_box(), page.locator("main.stage").bounding_box()
    assert box["width"] * box["height"] < 0.12 * stage["width"] * stage["height"]
    page.get_by_role("slider", name="results").fill("2")
    notice.wait_for(state="detached")


def test_a_held_part_is_grown_again_only_after_it_is_freed(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 1, seed=3)
    grow(page)
    at_rest(page)
    click_part(page, visible(page, "wings"))
    until(page, "window.__studio.selection.part")
    # All wings of a section: a wing alone decides whether others follow, and these may not change.
    page.locator("nav.levels button:not([aria-current=true])").last.click()
    page.keyboard.press("h")
    until(page, "window.__studio.view.held.length == 1")
    run = page.evaluate("window.__studio.view.picked.run")
    page.keyboard.press("r")
    page.get_by_role("button", name="Free it and re-roll").click()
    until(page, f"window.__studio.view.held.length == 0 && window.__studio.view.picked.run != {run}")


def test_another_window_says_what_it_chose_and_every_model_keeps_its_results(open_page, served):
    window, other = open_page(served), open_page(served)
    choose(window, "spaceship", 2)
    grow(window)
    results = window.evaluate("window.__studio.view.results")
    # The message is for changes that this window has not made itself.
    window.evaluate("window.__studio.forgetChoice()")
    first(other, "simple-ship")
    window.locator(".notice", has_text="Another window chose simple-ship").wait_for()
    grow(other)
    first(other, "spaceship")
    until(other, "window.__studio.view.results.length >= 1")
    assert other.evaluate("window.__studio.view.results") == results
    assert other.evaluate("window.__studio.view.picked") == results[0]["key"]
    first(other, "simple-ship")
    until(other, "window.__studio.view.results.length >= 1 && window.__studio.view.picked")


def test_an_export_has_the_models_name_and_the_page_says_where_it_is(open_page, served):
    page = open_page(served)
    choose(page, "simple-ship", 2)
    grow(page)
    at_rest(page)
    key = page.evaluate("window.__studio.view.picked")
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as download:
        page.get_by_role("menuitem", name="GLB").click()
    name = f"simple-ship-{key['run'] + 1}-{key.get('number', 0) + 1}.glb"
    assert download.value.suggested_filename == name
    notice = page.locator(".notice", has_text=name).first
    notice.get_by_text("Details").click()
    place = Path(notice.locator("pre").inner_text().split(": ")[-1])
    assert place.name == name and place.read_bytes() == Path(download.value.path()).read_bytes()


def test_an_open_page_comes_back_by_itself_after_a_kill(open_page, tmp_path):
    with serving(tmp_path) as served:
        used = served.token
        page = open_page(served)
        choose(page, "simple-ship", 1)
        grow(page)
        at_rest(page)
        before = camera(page)
        served.kill()
        page.get_by_text("Not connected").wait_for()
        assert page.locator(".contents[inert] button.primary").count() == 1
    with serving(tmp_path) as again:
        assert again.url == served.url
        page.get_by_text("Not connected").wait_for(state="detached")
        assert (camera(page) == before).all()
        run = page.evaluate("window.__studio.view.picked.run")
        grow(page)
        until(page, f"window.__studio.view.picked.run != {run}")
        # A link that has been used leads a known browser to the page.
        page.goto(f"{again.url}/open?token={used}")
        until(page, "window.__studio?.view?.model")
        assert page.url == f"{again.url}/"
