"""Promises of the studio, in a browser: searches, held parts, undo, files, large meshes, use by keyboard alone."""

from __future__ import annotations

import json
import subprocess
import sys
from functools import partial
from xml.etree import ElementTree

import pytest
import trimesh
from niwaki.shell import run_files
from studio_page import at_rest, camera, choose, click_part, grow, nameless, timed, unstar, until, visible

#: The width of the focus's outline, and the name of the control for a screen reader.
FOCUS = """() => {
  const control = document.activeElement;
  const style = getComputedStyle(control);
  const name = control.ariaLabel || control.title || control.textContent.trim() || control.closest("label")?.innerText;
  const isSeen = control === document.body || style.outlineStyle !== "none";
  return {outline: control === document.body ? 1 : isSeen ? parseFloat(style.outlineWidth) : 0, name: name || ""};
}"""
#: The fields of the view that undo restores.
DOCUMENT = ("model", "arguments", "ask", "settings", "results", "picked", "held", "stars")


@pytest.fixture
def open_page(open_page):
    """Small windows, which a software renderer draws faster; these tests compare no pictures."""
    return partial(open_page, viewport={"width": 1080, "height": 640})


def document(page):
    view = page.evaluate("window.__studio.view")
    return {name: view[name] for name in DOCUMENT} | {"model": view["model"]["reference"]}


def effort(page, power):
    page.get_by_role("slider", name="effort").fill(str(power))
    until(page, f"window.__studio.view.settings.effort == {2**power}")


def downloaded(page, name, folder):
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as download:
        page.get_by_role("menuitem", name=name).click()
    place = folder / download.value.suggested_filename
    download.value.save_as(place)
    return place


def test_sliders_move_during_a_search_and_the_newest_values_win(open_page, served):
    page = open_page(served)
    choose(page, "gnarly-tree", 1)
    effort(page, 3)
    page.locator("button.primary").click()
    until(page, "window.__studio.view.searching")
    for count in (3, 5, 7):
        page.get_by_role("slider", name="results").fill(str(count))
    page.get_by_role("slider", name="Variety").fill("0.5")
    assert page.locator("aside input:disabled, aside select:disabled").count() == 0
    until(page, "window.__studio.view.settings.count == 7 && window.__studio.view.settings.strength == 0.5")
    assert page.evaluate("window.__studio.view.searching !== null")
    until(page, "window.__studio.bests >= 2")
    page.keyboard.press("Escape")
    until(page, "!window.__studio.view.searching")
    assert page.evaluate("window.__studio.view.results.length") == 1
    at_rest(page)


def test_a_gallery_of_eight_differs_and_stars_keep_their_order(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 8)
    grow(page)
    at_rest(page)
    results = page.evaluate("window.__studio.view.results")
    assert len(results) >= 6 and len({result["kind"] for result in results}) == len(results)
    for number in (4, 1):
        page.locator(".card .star").nth(number).click()
        until(page, f"window.__studio.view.stars.some(star => star.number == {number})")
    starred = [results[1]["key"], results[4]["key"]]
    choose(page, "spaceship", 3, seed=5)
    grow(page)
    assert [result["key"] for result in page.evaluate("window.__studio.view.results")][:2] == starred
    unstar(page)


def test_pinned_choices_are_equal_after_searches(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 1, seed=3)
    effort(page, -2)
    grow(page)
    at_rest(page)
    address = visible(page, "wings")
    click_part(page, address)
    until(page, f"window.__studio.selection.part == {json.dumps(address)}")
    page.keyboard.press("h")
    until(page, "window.__studio.view.held.length == 1")
    held = page.evaluate("window.__studio.view.held[0].choices")
    seed = page.locator("input[placeholder='random']")
    for number in range(5):
        seed.fill(str(100 + number))
        seed.blur()
        until(page, f"window.__studio.view.settings.seed == {100 + number}")
        grow(page)
        key = page.evaluate("window.__studio.view.picked")
        data = run_files.load(served.folder / "runs" / f"{key['run']}.json")
        choices = {row["address"]: row["value"] for row in data["runs"][key.get("number", 0)]["choices"]}
        assert {address: choices[address] for address in held} == held
    page.keyboard.press("h")
    effort(page, 0)


def test_a_hold_is_shown_at_once_and_later_commands_wait_for_it(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 1, seed=3)
    effort(page, -2)
    grow(page)
    at_rest(page)
    address = visible(page, "wings")
    click_part(page, address)
    until(page, f"window.__studio.selection.part == {json.dumps(address)}")
    steps = page.evaluate("window.__studio.view.undo")
    # Both keys in the same script, so that no answer arrives between them.
    press = "key => dispatchEvent(new KeyboardEvent('keydown', key))"
    count = page.evaluate(
        f"() => {{ const press = {press}; press({{key: 'h'}}); press({{key: 'z', ctrlKey: true}});"
        " return new Promise(done => setTimeout(() => done(document.querySelectorAll('.held li').length))); }"
    )
    assert count == 1
    # The undo removes the hold, not the step before it.
    until(page, f"window.__studio.view.redo == 1 && window.__studio.view.undo == {steps}")
    until(page, "document.querySelectorAll('.held li').length == 0")
    assert page.evaluate("window.__studio.view.held") == []
    first = page.evaluate("window.__studio.view.picked.run")
    page.evaluate(f"() => {{ const press = {press}; press({{key: 'h'}}); press({{key: 'Enter'}}); }}")
    until(page, f"!window.__studio.view.searching && window.__studio.view.picked.run != {first}")
    held = page.evaluate("window.__studio.view.held[0].choices")
    data = run_files.load(
        served.folder / "runs" / f"{page.evaluate('window.__studio.view.picked')['run']}.json"
    )
    choices = {row["address"]: row["value"] for row in data["runs"][0]["choices"]}
    assert {address: choices[address] for address in held} == held
    page.keyboard.press("h")
    until(page, "window.__studio.view.held.length == 0")
    # The page removes a hold that fails.
    page.evaluate("window.__studio.hold('nothing/like/this')")
    page.locator(".notice", has_text="nothing/like/this").first.wait_for()
    until(page, "document.querySelectorAll('.held li').length == 0")
    effort(page, 0)


def test_undo_ten_deep_and_redo_give_the_same_states(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 3, seed=2)
    grow(page)
    at_rest(page)
    before = camera(page)
    states = [document(page)]

    def do(act):
        steps = page.evaluate("window.__studio.view.undo")
        act()
        until(page, f"window.__studio.view.undo == {steps + 1}")
        states.append(document(page))

    do(lambda: page.locator(".card .star").nth(1).click())
    do(lambda: page.locator("[role=option]").nth(2).click())
    do(lambda: page.get_by_role("slider", name="results").fill("5"))
    do(lambda: page.get_by_role("slider", name="Variety").fill("0.75"))
    until(page, "window.__studio.described?.key.number == 2")
    do(lambda: page.locator(".choice .icon-button").first.click())
    do(lambda: page.locator(".choice .icon-button").nth(1).click())
    do(lambda: page.select_option("select[aria-label=Target]", "box"))
    page.get_by_role("button", name="Add an object").click()
    do(lambda: page.get_by_role("menuitem", name="Floor").click())
    page.get_by_role("button", name="Add an object").click()
    do(lambda: page.get_by_role("menuitem", name="Box").click())
    do(lambda: page.locator(".card .star").nth(0).click())
    assert len(states) == 11
    for state in states[-2::-1]:
        redo = page.evaluate("window.__studio.view.redo")
        page.keyboard.press("Control+z")
        until(page, f"window.__studio.view.redo == {redo + 1}")
        assert document(page) == state
    for state in states[1:]:
        redo = page.evaluate("window.__studio.view.redo")
        page.keyboard.press("Control+Shift+z")
        until(page, f"window.__studio.view.redo == {redo - 1}")
        assert document(page) == state
    assert (camera(page) == before).all()
    for _ in range(10):
        page.keyboard.press("Control+z")


def test_files_can_be_opened_elsewhere_and_the_recipe_makes_the_same_bytes(open_page, served, tmp_path):
    page = open_page(served)
    choose(page, "spaceship", 2)
    grow(page)
    at_rest(page)
    places = {name: downloaded(page, name, tmp_path) for name in ("GLB", "STL", "OBJ", "Recipe")}
    for name in ("GLB", "STL", "OBJ"):
        assert len(trimesh.load(places[name], force="mesh").faces) > 100
    command = [sys.executable, "-m", "niwaki.shell.main", "replay", str(places["Recipe"]), "--no-picture"]
    subprocess.run([*command, "--format", "glb"], cwd=tmp_path, check=True, capture_output=True)
    assert (tmp_path / "out" / "best.glb").read_bytes() == places["GLB"].read_bytes()
    choose(page, "vines", 1)
    effort(page, -2)
    grow(page)
    at_rest(page)
    drawing = downloaded(page, "SVG", tmp_path)
    assert ElementTree.parse(drawing).getroot().tag.endswith("svg")
    effort(page, 0)


def test_a_save_by_rename_twice_at_once_is_one_reload_with_the_same_seed_and_scores(open_page, served, pile):
    page = open_page(served)
    good = pile.read_text()
    choose(page, str(pile), 1, seed=4)
    page.select_option("select[aria-label=Target]", "box")
    until(page, "window.__studio.view.ask.target?.source == 'box'")
    grow(page)
    at_rest(page)
    steps = page.evaluate("window.__studio.view.undo")
    first = page.evaluate("window.__studio.view.results[0]")
    copies = [pile.with_suffix(f".{number}") for number in range(2)]
    for copy in copies:
        copy.write_text(good + "\n")
    try:
        for copy in copies:
            copy.rename(pile)
        until(page, f"window.__studio.view.undo == {steps + 1}")
        again = page.evaluate("window.__studio.view.results[0]")
        assert (again["log_score"], again["seed"]) == (first["log_score"], first["seed"])
        # Reloads are done one after the other, so that a second one would have come before that of the next change.
        pile.write_text(good.replace("3.0", "4.0"))
        until(page, "window.__studio.view.model.parameters[0].default == 4")
        until(page, f"window.__studio.view.picked.run > {again['key']['run']}")
        assert page.evaluate("window.__studio.view.undo") == steps + 2
    finally:
        pile.write_text(good)
    until(page, "window.__studio.view.model.parameters[0].default == 3")


def test_a_large_mesh_is_shown_thinned_and_parts_are_still_picked_at_once(open_page, served, tmp_path):
    page = open_page(served)
    choose(page, "spaceship", 1)
    grow(page)
    at_rest(page)
    place = tmp_path / "ball.stl"
    place.write_bytes(trimesh.creation.icosphere(8, 3.0).export(file_type="stl"))
    page.get_by_label("A mesh to grow into").set_input_files(place)
    page.locator(".notice", has_text="1,310,720").wait_for(timeout=120_000)
    assert 2_000 < page.evaluate("window.__studio.ghost") <= 60_000
    address = visible(page, "emit")
    with timed("part, large"):
        click_part(page, address)
        until(page, f"window.__studio.selection.part == {json.dumps(address)}")


def test_a_mesh_above_the_limit_is_refused_with_a_message(open_page, served, tmp_path):
    page = open_page(served)
    choose(page, "spaceship", 1)
    place = tmp_path / "ball.stl"
    place.write_bytes(bytes(66 << 20))
    page.get_by_label("A mesh to grow into").set_input_files(place)
    page.locator(".notice", has_text="at most 64 MB").wait_for()
    assert page.evaluate("window.__studio.view.ask.target") is None


def test_a_floor_waits_for_the_target_under_which_it_lies(open_page, served):
    page = open_page(served)
    delayed = []

    def ghosts_wait(socket):
        studio = socket.connect_to_server()

        def on_message(message):
            is_ghost = (
                isinstance(message, bytes) and b'"role":"ghost"' in message and b"gallery:ship" in message
            )
            (delayed.append if is_ghost else socket.send)(message)
            sockets.append(socket)

        studio.on_message(on_message)

    sockets = []
    page.route_web_socket("**/socket", ghosts_wait)
    page.reload()
    until(page, "window.__studio?.view?.model")
    page.select_option("select[aria-label=Model]", "building")
    until(page, "window.__studio.view.model.reference == 'building' && window.__studio.isGhostShown")
    page.select_option("select[aria-label=Model]", "spaceship")
    until(page, "window.__studio.view.model.reference == 'spaceship'")
    page.get_by_title("Add an object").click()
    page.get_by_role("menuitem", name="Floor").click()
    while not delayed:
        page.evaluate("1")  # Playwright delivers messages only during its calls.
    assert page.evaluate("window.__studio.view.ask.floor") is None
    for message in delayed:
        sockets[-1].send(message)
    until(page, "window.__studio.view.ask.floor != null")
    assert page.evaluate("window.__studio.view.ask.floor") == -1.0


def test_the_keyboard_alone_is_enough(open_page, served):
    page = open_page(served)
    page.mouse.move(0, 0)
    # The first model differs from the typed model, so that the page tells when the typed model arrives.
    page.select_option("select[aria-label=Model]", "building")
    until(page, "window.__studio.view.model.reference == 'building'")

    def tab_to(condition, key="Tab"):
        for _ in range(80):
            page.keyboard.press(key)
            # Every stop is seen, and has a name for a screen reader.
            seen = page.evaluate(FOCUS)
            assert seen["outline"] >= 1 and seen["name"], seen
            if page.evaluate(f"(control => {condition})(document.activeElement)"):
                return
        raise AssertionError(f"no control with {condition}")

    tab_to("control.ariaLabel == 'Model'")
    page.keyboard.type("spaceship")
    until(page, "window.__studio.view.model.reference == 'spaceship'")
    tab_to("control.title == 'Add an object'")
    page.keyboard.press("Enter")
    until(page, "document.activeElement.getAttribute('role') == 'menuitem'")
    page.keyboard.press("Enter")
    until(page, "window.__studio.view.ask.floor == -1")
    tab_to("control.type == 'range' && control.closest('label').innerText.startsWith('results')")
    count = page.evaluate("window.__studio.view.settings.count")
    page.keyboard.press("ArrowRight")
    until(page, f"window.__studio.view.settings.count == {count + 1}")
    tab_to("control.closest('label')?.innerText.startsWith('seed')")
    page.keyboard.type("1")
    tab_to("control.classList.contains('primary')")
    until(page, "window.__studio.view.settings.seed == 1")
    first = page.evaluate("window.__studio.view.picked?.run ?? null")
    page.keyboard.press("Enter")
    until(page, f"(window.__studio.view.picked?.run ?? null) != {json.dumps(first)}")
    until(page, "!window.__studio.view.searching && window.__studio.view.results.length > 1")
    at_rest(page)
    tab_to("control.getAttribute('role') == 'option'")
    page.keyboard.press("ArrowRight")
    until(page, "window.__studio.view.picked.number == 1")
    page.keyboard.press("s")
    until(page, "window.__studio.view.stars.length == 1")
    page.keyboard.press("s")
    until(page, "window.__studio.view.stars.length == 0")
    at_rest(page)
    tab_to("control.classList.contains('call')")
    page.keyboard.press("Enter")
    until(page, "window.__studio.selection.level")
    page.keyboard.press("h")
    until(page, "window.__studio.view.held.length == 1")
    page.keyboard.press("Control+z")
    until(page, "window.__studio.view.held.length == 0")
    tab_to("control.textContent.trim() == 'Export'", "Shift+Tab")
    page.keyboard.press("Enter")
    until(page, "document.activeElement.textContent.startsWith('GLB')")
    page.keyboard.press("ArrowDown")
    until(page, "document.activeElement.textContent.startsWith('STL')")
    with page.expect_download() as download:
        page.keyboard.press("Enter")
    assert len(trimesh.load(download.value.path(), file_type="stl").faces) > 100
    assert nameless(page) == 0


def test_the_five_places_have_names_for_a_screen_reader(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 2)
    grow(page)
    at_rest(page)
    for role, name in (
        ("complementary", "Model and target"),
        ("complementary", "Part"),
        ("listbox", "Results"),
        ("group", "History"),
        ("group", "View"),
        ("group", "Growth"),
    ):
        assert page.get_by_role(role, name=name, exact=True).count() == 1, name
    option = page.locator("[role=option]").first.get_attribute("aria-label")
    assert "covered" in option and "outside" in option


def test_typed_text_stays_while_a_search_reports_its_progress(open_page, served):
    page = open_page(served)
    choose(page, "gnarly-tree", 1)
    effort(page, 3)
    page.locator("button.primary").click()
    until(page, "window.__studio.view.searching?.seconds > 0")
    seed = page.locator("input[placeholder='random']")
    seed.focus()
    page.keyboard.press("Control+a")
    for digit in "4321":
        page.keyboard.type(digit)
        seconds = page.evaluate("window.__studio.view.searching.seconds")
        until(page, f"window.__studio.view.searching?.seconds > {seconds}")
    assert page.evaluate("window.__studio.view.searching") is not None
    assert seed.input_value() == "4321"
    seed.blur()
    until(page, "window.__studio.view.settings.seed == 4321")
    page.keyboard.press("Escape")
    until(page, "!window.__studio.view.searching")
    effort(page, 0)
