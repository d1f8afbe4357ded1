"""The scene: objects beside the target, the difference from the target, results side by side."""

from __future__ import annotations

import json

import numpy as np
import trimesh
from niwaki import _engine
from niwaki.shell import run_files
from studio_page import at_rest, camera, choose, grow, picture, settled, timed, unstar, until


def add(page, name):
    page.get_by_role("button", name="Add an object").click()
    page.get_by_role("menuitem", name=name).click()


def drag(page, x, y, by_x, by_y):
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + by_x, y + by_y, steps=4)
    page.mouse.up()


def handle(page):
    """Return the point of the handles of the selected object, on the page."""
    box = page.locator("main.stage").bounding_box()
    x, y = page.evaluate("window.__studio.handle")
    return box["x"] + x, box["y"] + y


def test_objects_are_moved_by_handles_and_parts_avoid_them(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 1)
    add(page, "Floor")
    until(page, "window.__studio.view.ask.floor !== null")
    floor = page.evaluate("window.__studio.view.ask.floor")
    add(page, "Ball")
    until(page, "window.__studio.objects.includes('obstacle 0')")
    first = page.evaluate("window.__studio.view.ask.obstacles[0].move")
    before = camera(page)
    drag(page, *handle(page), 90, -60)
    until(page, f"window.__studio.view.ask.obstacles[0].move.some((length, k) => length != {first}[k])")
    moved = page.evaluate("window.__studio.view.ask.obstacles[0].move")
    picture(page, "objects")
    grow(page)
    at_rest(page)
    assert (camera(page) == before).all()
    assert page.evaluate("window.__studio.bounds.low")[1] >= floor - 1e-6
    for _ in range(3):
        page.keyboard.press("Control+z")
    until(page, "!window.__studio.view.ask.obstacles.length")
    assert page.evaluate("window.__studio.view.ask.floor") == floor
    for _ in range(3):
        page.keyboard.press("Control+Shift+z")
    until(page, "window.__studio.view.redo == 0")
    assert page.evaluate("window.__studio.view.ask.obstacles[0].move") == moved
    page.get_by_role("button", name="Remove the ball").click()
    until(page, "!window.__studio.objects.includes('obstacle 0')")


def test_a_mesh_becomes_an_obstacle(open_page, served, tmp_path):
    page = open_page(served)
    choose(page, "spaceship", 1)
    place = tmp_path / "wall.stl"
    trimesh.creation.box((1.0, 4.0, 4.0)).export(place)
    page.get_by_label("A mesh as an obstacle").set_input_files(place)
    until(page, "window.__studio.objects.includes('obstacle 0')")
    assert page.evaluate("window.__studio.view.ask.target") is None


def test_a_shadow_is_drawn_and_grown_into(open_page, served):
    page = open_page(served)
    choose(page, "building", 1)
    settled(page)
    page.keyboard.press("d")
    page.get_by_label("Meaning of the strokes").select_option("shadow")
    box = page.locator("main.stage").bounding_box()
    drag(page, box["x"] + 0.35 * box["width"], box["y"] + 0.66 * box["height"], 190, -30)
    until(page, "window.__studio.view.ask.sketch?.kind == 'shadow'")
    until(page, "window.__studio.objects.includes('light')")
    grow(page, "Grow into it")
    at_rest(page)
    picture(page, "shadow")
    page.get_by_role("button", name="Move the light").click()
    before = np.array(page.evaluate("window.__studio.view.ask.light"))
    drag(page, *handle(page), 60, 40)
    until(page, f"window.__studio.view.ask.light[0] != {before[0]}")


def engine_fit(served, key):
    """Count cells with the engine's own score: target and scene, target only, scene only."""
    data = run_files.load(served.folder / "runs" / f"{key['run']}.json")
    sample = run_files.replayed(data, key.get("number", 0))
    call = next((ask for ask in sample.search.score.asks if ask.function == "match_volume"), None)
    if call is None:
        view = sample.search.score.views[0]
        target, scene = view.image, view.mask(sample.scene)
        return int((target & scene).sum()), int((target & ~scene).sum()), int((scene & ~target).sum())
    sketch = _engine.Sketch([call.spec])
    for part in sample.scene:
        sketch.add(list(part.shapes))
    measures = sketch.measures()
    differ = round((1 - measures["similarity"]) * np.prod(call.grid.dims))
    inside = round((call.grid.filled + measures["filled"] - differ) / 2)
    assert abs(sample.fit.covered - inside / call.grid.filled) < 1e-12
    return inside, call.grid.filled - inside, round(measures["filled"]) - inside


def test_the_difference_to_a_target_has_the_cells_that_the_engine_counts(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 2)
    grow(page)
    at_rest(page)
    with timed("difference"):
        page.keyboard.press("x")
        until(page, "window.__studio.counts")
    picture(page, "difference")
    for _ in range(2):
        key = page.evaluate("window.__studio.view.picked")
        until(page, "window.__studio.counts")
        counts = page.evaluate("window.__studio.counts")
        assert (counts["covered"], counts["missing"], counts["outside"]) == engine_fit(served, key)
        # The numbers below the result are rounded in the same way.
        legend = page.locator(".legend .quiet").inner_text()
        caption = page.locator("[role=option][aria-selected=true] .caption span").inner_text()
        assert legend == caption.replace("\u00a0", " ") and legend.endswith("% outside")
        page.locator("[role=option]").nth(1).click()
        until(page, "window.__studio.view.picked.number == 1")
    page.keyboard.press("x")
    until(page, "!document.querySelector('.legend')")


def test_a_late_difference_of_another_result_is_not_shown(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 2)
    grow(page)
    at_rest(page)
    delayed, sockets = [], []

    def differences_wait(socket):
        studio = socket.connect_to_server()
        is_first = lambda message: b'"kind":"difference"' in message and not delayed  # noqa: E731
        studio.on_message(
            lambda message: (
                delayed.append(message)
                if isinstance(message, bytes) and is_first(message)
                else socket.send(message)
            )
        )
        sockets.append(socket)

    page.route_web_socket("**/socket", differences_wait)
    page.reload()
    until(page, "window.__studio?.view?.model")
    at_rest(page)
    page.keyboard.press("x")
    while not delayed:
        page.evaluate("1")  # Playwright delivers messages only during its calls.
    other = page.locator("[role=option][aria-selected=false]").first
    other.click()
    until(page, "window.__studio.counts")
    counts = page.evaluate("window.__studio.counts")
    sockets[-1].send(delayed[0])
    # The answer to a star comes after it, by the same way.
    page.keyboard.press("s")
    until(page, "window.__studio.view.stars.length == 1")
    assert page.evaluate("window.__studio.counts") == counts
    unstar(page)


def test_the_difference_to_a_drawn_silhouette_lies_over_the_view(open_page, served):
    page = open_page(served)
    choose(page, "building", 1)
    settled(page)
    page.keyboard.press("d")
    box = page.locator("main.stage").bounding_box()
    drag(page, box["x"] + 0.5 * box["width"], box["y"] + 0.35 * box["height"], 3, 180)
    until(page, "window.__studio.view.ask.sketch")
    grow(page, "Grow into it")
    at_rest(page)
    page.keyboard.press("x")
    until(page, "window.__studio.counts")
    counts = page.evaluate("window.__studio.counts")
    key = page.evaluate("window.__studio.view.picked")
    assert (counts["covered"], counts["missing"], counts["outside"]) == engine_fit(served, key)
    picture(page, "difference-drawn")


def test_starred_results_stand_side_by_side_seen_by_one_camera(open_page, served):
    page = open_page(served)
    choose(page, "spaceship", 3)
    page.get_by_role("slider", name="Variety").fill("1")
    until(page, "window.__studio.view.settings.strength == 1")
    grow(page)
    at_rest(page)
    for number in range(3):
        page.locator(".card .star").nth(number).click()
        until(page, f"window.__studio.view.stars.length == {number + 1}")
    before = camera(page)
    with timed("compare"):
        page.keyboard.press("c")
        until(page, "window.__studio.compared.filter(triangles => triangles > 0).length == 3")
    until(page, "window.__studio.comparedDetails.every(detail => detail == 'fine')")
    picture(page, "compare")
    assert page.locator(".side-name").count() == 3
    assert (camera(page) == before).all()
    page.locator(".side-name").nth(1).click()
    until(page, "window.__studio.view.picked.number == 1 && !window.__studio.compared.length")
    unstar(page)


def test_growth_is_scrubbed_and_played_in_the_order_of_the_run(open_page, served):
    page = open_page(served)
    choose(page, "building", 1, seed=2)
    grow(page)
    at_rest(page)
    parts = page.evaluate("window.__studio.described.parts.map(part => part.address)")
    assert len(parts) > 3 and page.evaluate("window.__studio.drawn.length") == len(parts)
    slider = page.get_by_role("slider", name="Visible parts")
    slider.fill("2")
    until(page, "window.__studio.drawn.length == 2")
    assert set(page.evaluate("window.__studio.drawn")) == set(parts[:2])
    page.get_by_label("Order of growth").select_option("depth")
    slider.fill("3")
    depths = [part.count("/") for part in page.evaluate("window.__studio.drawn")]
    assert sorted(depths) == sorted(part.count("/") for part in parts)[:3]
    page.locator("main.stage canvas").first.focus()
    page.keyboard.press("Space")
    until(page, "window.__studio.drawn.length > 3")
    until(page, f"window.__studio.drawn.length == {len(parts)}")


def test_growth_goes_part_by_part_with_reduced_motion(open_page, served):
    page = open_page(served, reduced_motion="reduce")
    choose(page, "building", 1, seed=2)
    grow(page)
    at_rest(page)
    button = page.get_by_role("button", name="Show one more part")
    for count in (1, 2):
        button.click()
        until(page, f"window.__studio.drawn.length == {count}")


def test_the_camera_moves_until_the_first_result_of_a_model_and_then_only_by_hand(open_page, served, pile):
    page = open_page(served)
    choose(page, "spaceship", 1)
    page.select_option("select[aria-label=Model]", str(pile))
    until(page, f"window.__studio.view.model.reference == {json.dumps(str(pile))}")
    settled(page)
    # The target of the model before does not count.
    left, top, right, bottom = page.evaluate("window.__studio.box")
    canvas = page.locator("main.stage canvas").first.bounding_box()
    assert right - left > 0.6 * canvas["width"] or bottom - top > 0.6 * canvas["height"]
    page.select_option("select[aria-label=Target]", "box")
    until(page, "window.__studio.isGhostShown && window.__studio.ghost == 12")
    until(page, "window.__studio.shown.role == 'prior' && window.__studio.seesAll")
    first = camera(page)
    # A larger run of the model is seen whole, too.
    page.get_by_label("height").fill("12")
    page.get_by_label("height").blur()
    until(page, "window.__studio.bounds.high?.[1] > 11")
    assert page.evaluate("window.__studio.seesAll") and not np.allclose(first, camera(page), atol=1e-3)
    grow(page)
    at_rest(page)
    second = camera(page)
    # After the first result only the user moves it.
    page.get_by_label("height").fill("30")
    page.get_by_label("height").blur()
    until(page, "window.__studio.bounds.high?.[1] > 20")
    assert np.allclose(camera(page), second, atol=1e-9) and not page.evaluate("window.__studio.seesAll")
    page.get_by_label("height").fill("3")
    page.get_by_label("height").blur()
    until(page, "window.__studio.bounds.high?.[1] < 20")


def test_arguments_are_written_as_defaults_by_one_button(open_page, served, pile):
    page = open_page(served)
    text = pile.read_text()
    choose(page, str(pile), 1, seed=4)
    button = page.get_by_role("button", name="Make these the defaults")
    page.get_by_label("height").fill("4")
    page.get_by_label("height").blur()
    button.click()
    page.get_by_text("line 7: 3.0 becomes 4.0").click()
    assert pile.read_text() == text
    try:
        page.get_by_role("button", name="Write", exact=True).click()
        until(page, "window.__studio.view.model.parameters[0].default == 4")
        assert pile.read_text() == text.replace("3.0", "4.0")
        assert button.count() == 0
    finally:
        pile.write_text(text)
