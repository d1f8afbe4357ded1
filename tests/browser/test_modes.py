"""Drawings and structures in the page: colourings, rules, the check of structures."""

from __future__ import annotations

import io
import json
from pathlib import Path

import ezdxf
from niwaki.color.drawing import EXAMPLES
from studio_page import at_rest, choose, contrasts, grow, nameless, picture, until
from studio_process import PILE, serving


def colored(page):
    """Wait for the picture and the rules of the active result."""
    until(page, "window.__studio.easel?.detail == 'fine'")
    until(page, "window.__studio.palette?.key.run == window.__studio.view.picked.run")


def click_region(page, name):
    until(page, f"window.__studio.regionPoint({json.dumps(name)})")
    box = page.locator("main.easel").bounding_box()
    x, y = page.evaluate("name => window.__studio.regionPoint(name)", name)
    page.mouse.click(box["x"] + x, box["y"] + y)


def colors(page):
    return page.evaluate("window.__studio.palette.colors")


def test_a_held_region_keeps_its_colour_and_rules_show_their_misses(open_page, served):
    page = open_page(served)
    choose(page, "drawing:house", 8)
    until(page, "window.__studio.view.model.regions.length > 10")
    grow(page)
    colored(page)
    click_region(page, "roof")
    until(page, "window.__studio.selection.level == 'roof'")
    page.get_by_role("button", name="Hold roof", exact=True).click()
    until(page, "window.__studio.view.held.length == 1")
    before = colors(page)
    picture(page, "coloring")
    page.get_by_role("button", name="Colour the rest").click()
    until(page, "window.__studio.view.picked.run > 0")
    colored(page)
    after = colors(page)
    assert after["roof"] == before["roof"]
    assert sum(after[name] != before[name] for name in before) > len(before) / 2
    # The page shows the studio's report on the rules.
    rules = page.evaluate("window.__studio.palette.rules")
    assert len(rules) > 40 and all(rule["holds"] for rule in rules)
    page.keyboard.press("Escape")
    page.get_by_text(f"all {len(rules)} hold").wait_for()
    # A colour against the rules has a miss.
    page.get_by_label("Colour of wall", exact=True).fill("#2040ff")
    until(page, "window.__studio.view.held.some(held => held.part == 'wall')")
    until(page, "window.__studio.palette?.colors.wall == '#2040ff'")
    missed = [rule for rule in page.evaluate("window.__studio.palette.rules") if not rule["holds"]]
    assert any({"wall", "wall-shade"} == {rule["first"], rule["second"]} for rule in missed)
    page.get_by_text(f"{len(missed)} of {len(rules)} missed").wait_for()
    picture(page, "rules")
    for _ in range(2):
        page.keyboard.press("Control+z")
    until(page, "window.__studio.view.held.length == 1 && window.__studio.palette?.colors.wall != '#2040ff'")


def test_a_rule_is_added_by_clicking_regions_and_a_result_is_exported(open_page, served):
    page = open_page(served)
    choose(page, "drawing:robot", 2)
    page.get_by_role("button", name="Lighter", exact=True).click()
    click_region(page, "face")
    # The second region is chosen by its name, with the keyboard.
    page.get_by_role("button", name="body", exact=True).press("Enter")
    page.get_by_role("button", name="Add", exact=True).click()
    rules = "window.__studio.view.ask.rules?.rules.at(-1)"
    until(page, f"{rules}?.kind == 'lighter'")
    assert page.evaluate(rules)["regions"] == ["face", "body"]
    grow(page)
    colored(page)
    reports = page.evaluate("window.__studio.palette.rules")
    assert any((report["first"], report["second"]) == ("face", "body") for report in reports)
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as download:
        page.get_by_role("menuitem", name="SVG").click()
    assert colors(page)["face"] in Path(download.value.path()).read_text()


def test_an_uploaded_drawing_is_coloured(open_page, served):
    page = open_page(served)
    choose(page, "drawing:bug", 1)
    page.get_by_label("A drawing to colour").set_input_files(EXAMPLES / "rocket.svg")
    until(page, "window.__studio.view.model.reference.startsWith('drawing:upload:')")
    until(page, "window.__studio.view.model.regions.some(region => region.name == 'flame')")
    grow(page)
    colored(page)
    page.reload()
    until(page, "window.__studio?.view?.model")
    colored(page)


def test_a_structure_shows_forces_and_falling_blocks_and_exports_boards(open_page, served):
    page = open_page(served)
    choose(page, "stack:cut_lean", 2, seed=3)
    grow(page)
    at_rest(page)
    until(page, "window.__studio.judged?.key.run == window.__studio.view.picked.run")
    judged = page.evaluate("window.__studio.judged")
    assert judged["holds"] and judged["tilt"] > 0.5 and judged["loose"] == [] and judged["board"] > 37.9
    until(page, "window.__studio.arrows > 0")
    assert page.evaluate("window.__studio.arrows") == 2 * len(judged["arrows"])
    page.get_by_text("Stands", exact=True).wait_for()
    page.get_by_text(f"until the ground is tilted by {judged['tilt']:.1f}°").wait_for()
    page.get_by_role("button", name="Simulate").click()
    until(page, "window.__studio.judged.stands === true")
    picture(page, "structure")
    with page.expect_download() as download:
        page.get_by_role("group", name="Boards").get_by_role("button", name="DXF").click()
    board = ezdxf.read(io.StringIO(Path(download.value.path()).read_text()))
    cuts = [line for line in board.modelspace().query("LWPOLYLINE") if line.dxf.layer == "CUT"]
    assert len(cuts) == 6
    # A block pushed to the edge of the one below it falls.
    choices = page.evaluate("window.__studio.described.choices")
    sliding = [
        choice
        for choice in choices
        if choice["family"] == "uniform" and (choice["low"], choice["high"]) == (-1.0, 1.0)
    ]
    label = page.locator(f"label[title*='\\A {sliding[0]['address']}:']")
    label.locator("input").fill("1")
    until(page, "window.__studio.judged?.holds === false")
    assert page.evaluate("window.__studio.judged.loose.length") > 0
    page.get_by_text("Falls", exact=True).wait_for()
    picture(page, "falls")


def test_colouring_in_the_dark_by_the_keyboard_alone(open_page, served):
    page = open_page(served, color_scheme="dark")
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
    choose(page, "drawing:house", 3)
    until(page, "window.__studio.view.model.regions.length > 10")
    page.get_by_label("The drawing.").focus()
    page.keyboard.press("Enter")
    until(page, "window.__studio.view.results.length > 1 && !window.__studio.view.searching")
    colored(page)
    page.locator("[role=option][aria-selected=true]").focus()
    first = page.evaluate("window.__studio.view.picked.number")
    page.keyboard.press("ArrowRight")
    until(page, f"window.__studio.view.picked.number != {first}")
    colored(page)
    # A region is chosen by its name and held; the rest is coloured again.
    page.get_by_role("button", name="roof", exact=True).press("Enter")
    until(page, "window.__studio.selection.level == 'roof'")
    page.keyboard.press("h")
    until(page, "window.__studio.view.held.length == 1")
    before = colors(page)["roof"]
    page.get_by_label("The drawing.").focus()
    run = page.evaluate("window.__studio.view.picked.run")
    page.keyboard.press("Enter")
    until(page, f"!window.__studio.view.searching && window.__studio.view.picked.run != {run}")
    colored(page)
    assert colors(page)["roof"] == before
    assert nameless(page) == 0 and contrasts(page) == []
    picture(page, "coloring-dark")
    page.keyboard.press("h")
    until(page, "window.__studio.view.held.length == 0")


def test_structures_in_the_dark_by_the_keyboard_alone(open_page, served):
    page = open_page(served, color_scheme="dark")
    choose(page, "stack:cut_stack", 2, seed=3)
    page.locator("main.stage canvas").first.focus()
    page.keyboard.press("Enter")
    until(page, "window.__studio.view.results.length == 2 && !window.__studio.view.searching")
    at_rest(page)
    judged = "window.__studio.judged?.key.number == window.__studio.view.picked.number"
    until(page, judged)
    page.locator("[role=option][aria-selected=true]").focus()
    page.keyboard.press("ArrowRight")
    until(page, "window.__studio.view.picked.number == 1")
    until(page, judged)
    page.get_by_role("button", name="Simulate").press("Enter")
    until(page, "window.__studio.judged.stands === true")
    # A call is chosen by its name, then its slider moves.
    until(page, "window.__studio.described?.key.number == 1")
    page.locator("button.call").last.press("Enter")
    until(page, "window.__studio.selection.level")
    run = page.evaluate("window.__studio.view.picked.run")
    page.locator(".choice input[type=range]").first.press("ArrowRight")
    until(page, f"window.__studio.view.picked.run != {run}")
    assert nameless(page) == 0 and contrasts(page) == []
    picture(page, "structure-dark")


def test_a_structure_still_stands_after_a_call_is_grown_again(open_page, served):
    page = open_page(served)
    choose(page, "stack:cut_stack", 1, seed=3)
    grow(page)
    at_rest(page)
    page.locator("button.call").last.click()
    until(page, "window.__studio.selection.level")
    run = page.evaluate("window.__studio.view.picked.run")
    page.get_by_role("button", name="Re-roll").click()
    until(page, f"window.__studio.view.picked.run != {run}")
    until(page, "window.__studio.judged?.key.run == window.__studio.view.picked.run")
    assert page.evaluate("window.__studio.judged.holds")


def test_a_choice_among_words_is_a_list_of_its_options(open_page, served):
    page = open_page(served)
    choose(page, "vines", 1, seed=2)
    grow(page)
    at_rest(page)
    options = page.locator(".choice select").first
    assert options.locator("option").all_inner_texts() == ["none", "left", "right"]
    other = "left" if options.input_value() == "right" else "right"
    picture(page, "words")
    run = page.evaluate("window.__studio.view.picked.run")
    options.select_option(other)
    until(page, f"window.__studio.view.picked.run != {run}")
    at_rest(page)
    assert page.locator(".choice select").first.input_value() == other
    assert not nameless(page)


def test_a_result_that_does_not_keep_its_requirements_is_marked_and_says_which(open_page, tmp_path):
    model = tmp_path / "pile.py"
    model.write_text(PILE)
    (tmp_path / "requirements.toml").write_text("height = [8.0, 9.0]\nstands = true\n")
    with serving(tmp_path / "session", model) as served:
        page = open_page(served)
        choose(page, str(model), 1)
        page.select_option("select[aria-label=Target]", "box")
        until(page, "window.__studio.view.ask.target?.source == 'box'")
        grow(page)
        at_rest(page)
        text = "height 8 to 9: height 3"
        assert page.locator(".card .warning").get_attribute("title").endswith(f"does not keep: {text}")
        assert page.locator("section[aria-label=Requirements]").inner_text().splitlines()[-1] == text
        picture(page, "requirements")
