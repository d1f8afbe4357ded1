"""A generator of somebody else in the page: a model that calls it has sliders, held choices and results that differ."""

from __future__ import annotations

from niwaki.shell.app import app
from studio_page import at_rest, choose, grow, picture, until
from studio_process import serving
from typer.testing import CliRunner

STAND = """import niwaki as nw
from niwaki.words import box, cylinder


def stand(
    width=nw.Uniform(0.4, 2.0),
    height=nw.Uniform(0.5, 2.0),
    legs=nw.DiscreteUniform(2, 5),
    shelf=nw.Bernoulli(0.5),
):
    gap = (width - 0.1) / (legs - 1)
    places = [k * gap - width / 2 + 0.05 for k in range(legs)]
    parts = [box((x, height / 2, z), (0.1, height, 0.1)) for x in places for z in (-0.3, 0.3)]
    parts.append(box((0, height + 0.04, 0), (width, 0.08, 0.7)))
    return parts + ([box((0, height / 3, 0), (width - 0.2, 0.06, 0.6))] if shelf else [])
"""


def test_a_generator_has_sliders_held_choices_and_results_that_differ(open_page, tmp_path):
    (tmp_path / "stand.py").write_text(STAND)
    command = ["init", str(tmp_path / "studio"), "--generator", str(tmp_path / "stand.py")]
    assert CliRunner().invoke(app, command, catch_exceptions=False).exit_code == 0
    model = tmp_path / "studio" / "stand_model.py"
    with serving(tmp_path / "session", model) as served:
        page = open_page(served)
        choose(page, str(model), 4)
        page.select_option("select[aria-label=Target]", "box")
        until(page, "window.__studio.view.ask.target?.source == 'box'")
        grow(page)
        at_rest(page)
        choices = page.evaluate("window.__studio.described.choices.map(choice => choice.address)")
        assert choices == ["width", "height", "legs", "shelf"]
        page.get_by_label("legs").fill("5")
        page.get_by_label("legs").blur()
        until(page, "window.__studio.view.picked.run == 1")
        at_rest(page)
        picture(page, "generator")
