"""Claim: words of `choose` change no law, are the same in every search and in plain Python, and stand in files."""

from __future__ import annotations

import csv
import json
import math
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from niwaki import _engine, batches, choose, flip, kernels
from niwaki.batches import export
from niwaki.draw.scene import Scene
from niwaki.errors import ModelError, NiwakiError
from niwaki.lang.compiled import task
from niwaki.result.hmc import GradientWarning
from niwaki.search.drag.structure import _alternatives
from niwaki.search.engine_runs import engine_form
from niwaki.shell import run_files
from niwaki.shell.main import app
from niwaki.shell.references import find
from typer.testing import CliRunner

OLD = Path(__file__).parents[2] / "golden" / "run_with_places.json"
WALLS = {"brick": 3, "wood": 1}
ROOFS = ["gable", "hip", "flat"]


@nw.model
def house():
    """A roof among words of a list, a wall of a dict, and a score by both."""
    roof = choose(["gable", "hip", "flat"])
    wall = choose(WALLS)
    door = choose({"left": 1, "right": 2})
    match = 1.0 if roof == "hip" and wall in ("wood", "stone") else 0.0
    nw.factor(match + (0.5 if door == "left" else 0.0))
    nw.emit(nw.box((0.0, 0.5, 0.0), (1.0, 1.0, 1.0)))
    return roof, wall, door


def picked(names, weights):
    """Choose from lists of a caller."""
    word = choose(names, weights)
    return word


@nw.model
def moved():
    """Options whose number and order another choice decides, in a list made at run time."""
    more = flip(0.4)
    names = [f"n{i}" for i in range(3)] if more else ["n2", "n1"]
    first = choose(names)
    second = picked(names, [1, 3, 2] if more else [2, 1])
    nw.factor(0.7 if first == second else 0.0)
    return more, first, second


@nw.model
def line():
    """A word beside a real choice."""
    kind = choose(["a", "b"])
    x = nw.gaussian(0.0, 1.0)
    nw.factor(-x if kind == "a" else x)


def law(model: Any, **settings: Any) -> dict[Any, float]:
    return nw.run(model, nw.enumerate_all(), **settings).distribution()


def weights() -> dict[tuple[str, str, str], float]:
    """The exact law of `house`, by hand."""
    rows = {
        (roof, wall, door): p
        * q
        * math.exp((1.0 if roof == "hip" and wall == "wood" else 0.0) + (0.5 if door == "left" else 0.0))
        for roof in ROOFS
        for wall, p in (("brick", 0.75), ("wood", 0.25))
        for door, q in (("left", 1 / 3), ("right", 2 / 3))
    }
    total = sum(rows.values())
    return {row: weight / total for row, weight in rows.items()}


def test_the_law_is_exact_and_every_method_has_it() -> None:
    exact = weights()
    assert law(house) == pytest.approx(exact)
    roofs = {roof: sum(p for row, p in exact.items() if row[0] == roof) for roof in ROOFS}
    for method in (
        nw.importance(4000),
        nw.smc(4000),
        nw.mh(steps=8000, thin=4, chains=2),
        nw.rejection(2000, bound=1.5),
    ):
        result = nw.run(house, method, seed=3)
        # Five deviations of a share of about 2000 independent draws.
        assert result.distribution("roof") == pytest.approx(roofs, abs=5 * 0.5 / math.sqrt(2000)), method
        assert set(result.distribution("wall")) == {"brick", "wood"}


@pytest.mark.parametrize("name", ["gable", "hip", "flat"])
def test_a_held_word_gives_the_law_under_its_condition(name: str) -> None:
    exact = {row: p for row, p in weights().items() if row[0] == name}
    total = sum(exact.values())
    for value in (name, ROOFS.index(name)):
        held = law(house, hold={"roof": value})
        assert held == pytest.approx({row: p / total for row, p in exact.items()})


def test_a_held_word_is_found_wherever_its_list_has_it() -> None:
    free = law(moved)
    exact = {row: p for row, p in free.items() if row[1] == "n1"}
    held = law(moved, hold={"first": "n1"})
    assert held == pytest.approx({row: p / sum(exact.values()) for row, p in exact.items()})
    # Only one of the lists has it: runs with the other are invalid, not the search.
    assert set(law(moved, hold={"first": "n0"})) == {row for row in free if row[1] == "n0"}
    for method in (nw.smc(1000), nw.mh(steps=6000, thin=2)):
        shares = nw.run(moved, method, seed=4, hold={"first": "n1"}).distribution()
        assert shares == pytest.approx(held, abs=5 * 0.5 / math.sqrt(500))


@pytest.mark.parametrize("hold", [{}, {"first": "n1"}, {"first": "n1", "picked/word": "n2"}, {"first": "n0"}])
def test_all_strategies_agree_on_words(hold: dict[str, str]) -> None:
    prepared = task(moved, (), {}, (), 100_000)
    prepared = prepared.holding(hold) if hold else prepared
    for kernel in (kernels.prior(), kernels.cycle(kernels.neighbour(), kernels.regenerate())):
        method, functions = engine_form(nw.mh(201, kernel=kernel))
        difference, _, accepted, faults = _engine.agreement(prepared, method, 5, 200, 1, functions)
        assert difference is None and accepted > 20 and faults == 0


def test_plain_python_has_the_same_words() -> None:
    for model in (house, moved):
        for sample in nw.run(model, nw.forward(20), seed=2):
            plain = nw.run_python(model, choices=sample.choices)
            assert (plain.choices, plain.value) == (sample.choices, sample.value)
            by_place = nw.run_python(model, choices=sample.places)
            assert (by_place.choices, by_place.value) == (sample.choices, sample.value)
            assert nw.run(model, nw.forward(1), choices=sample.places).best.choices == sample.choices
            assert (plain.log_prior, plain.log_score) == (sample.log_prior, sample.log_score)


RULES = {
    "choose(['a', 'b', 'a'])": False,
    "choose(['a', 1])": False,
    "choose([1, 2])": False,
    "choose(('a', 'b'))": True,
    "choose(['a'])": True,
    "choose([x, 'b'])": True,
    "choose([x, x])": False,
    "choose([n, x])": False,
    "choose({'a': 1, n and 'b' or 'c': 2})": None,
    "choose({1: 2, 3: 4})": False,
    "choose({'a': 0, 'b': 1})": True,
    "choose({'a': 1}, [2])": None,
    "choose(GIVEN)": True,
    "choose(PLACES)": False,
    "choose(dict(a=1, b=2))": None,
}


@pytest.mark.parametrize("text", RULES)
def test_distinct_strings_are_words_and_nothing_else(text: str, tmp_path: Path) -> None:
    constants = "from niwaki import choose, model\nGIVEN = ('a', 'b')\nPLACES = (1, 2)\n"
    (tmp_path / "rule.py").write_text(f"{constants}@model\ndef m():\n    x, n = 'a', 1\n    return {text}\n")
    model = find(f"{tmp_path}/rule.py:m").model
    if RULES[text] is None:
        with pytest.raises(NiwakiError):
            nw.run(model, nw.forward(1), seed=1)
        return
    best = nw.run(model, nw.forward(1), seed=1).best
    assert nw.run_python(model, choices=best.choices).value == best.value
    (value,) = best.choices.values()
    assert isinstance(value, str) == RULES[text]


def test_a_dict_of_a_run_is_refused_with_what_to_write() -> None:
    def chosen(table):
        return choose(table)

    def listed(table):
        return choose(list(table), list(table.values()))

    with pytest.raises(NiwakiError, match=r"choose\(list\(d\), list\(d\.values\(\)\)\)"):
        nw.run(chosen, nw.forward(1), {"a": 1.0, "b": 0.0}, seed=1)
    assert nw.run(listed, nw.forward(1), {"a": 0.0, "b": 1.0}, seed=1).best.value == "b"


def test_weights_are_given_once() -> None:
    with pytest.raises(ModelError, match="`choose` gets `weights` twice"):
        nw.run(lambda: choose({"a": 1}, [1]), nw.forward(1))


@pytest.mark.parametrize("method", [nw.forward(3), nw.smc(4), nw.mh(steps=5), nw.enumerate_all()])
def test_a_word_that_is_no_option_names_the_options(method: Any) -> None:
    with pytest.raises(NiwakiError) as raised:
        nw.run(house, method, hold={"roof": "hipp"}, seed=1)
    text = str(raised.value)
    assert "'hipp' is not an option of the choice `roof`" in text
    assert "did you mean 'hip'? its options are 'gable', 'hip', 'flat'" in text
    assert 'roof = choose(["gable", "hip", "flat"])' in text


def test_other_unfit_words_have_messages() -> None:
    for run in (nw.run_python, lambda model, choices: nw.run(model, nw.forward(1), choices=choices, seed=1)):
        with pytest.raises(NiwakiError, match="'dome' is not an option of the choice `roof`"):
            run(house, choices={"roof": "dome", "wall": 0, "door": 0})
    with pytest.raises(NiwakiError, match="the choice `more` does not draw words"):
        nw.run(moved, nw.forward(1), hold={"more": "n1"}, seed=1)


def test_summaries_have_places_and_drags_try_words() -> None:
    result = nw.run(house, nw.mh(steps=40, chains=2), seed=1)
    assert set(result.draws["roof"].ravel().tolist()) <= {0, 1, 2}
    assert result.best.options == {"roof": tuple(ROOFS), "wall": ("brick", "wood"), "door": ("left", "right")}
    roof = result.best._trace.choices[0]
    assert sorted([roof.value, *_alternatives(roof)]) == sorted(ROOFS)
    with pytest.warns(GradientWarning, match="does not move it: `kind = 'b'`"):
        nw.run(line, nw.hmc(steps=2, draws=2), seed=1, choices={"kind": "b", "x": 0.5})
    explained = nw.search.explain(house, "roof", seed=1)
    assert {explained["old"], explained["new"]} < set(ROOFS)


MODEL = """
from niwaki import box, choose, emit, gaussian, model

@model
def house():
    roof = choose(["gable", "hip", "inf"])
    height = choose([1.0, 2.0], [3, 1])
    emit(box((0.0, height / 2, 0.0), (1.0, height, 1.0)))
    x = gaussian()
    return roof, height
"""


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "roofs.py").write_text(MODEL)
    Scene([("wall", [nw.box((0.0, 1.0, 0.0), (1.0, 2.0, 1.0))])]).export(tmp_path / "wall.obj")
    return tmp_path


def test_files_have_words_and_files_with_places_still_open(place: Path) -> None:
    result = nw.run(find("roofs.py:house").model, nw.forward(9), seed=1)
    data = json.loads(json.dumps(run_files.written(result, find("roofs.py:house"))))
    assert {sample.choices["roof"] for sample in result} == {"gable", "hip", "inf"}
    for number, sample in enumerate(result):
        stored = {row["address"]: row["value"] for row in data["runs"][number]["choices"]}
        assert stored["roof"] == sample.choices["roof"] and isinstance(stored["roof"], str)
        assert run_files.replayed(data, number).choices == sample.choices
        for row in data["runs"][number]["choices"]:
            row["value"] = sample.places[row["address"]]
        assert run_files.replayed(data, number).choices == sample.choices
    search = nw.Search(result.model, method=nw.mh(steps=2), hold={"roof": "hip"}, seed=1)
    assert nw.Search.of_json(search.json()).run().best.choices["roof"] == "hip"
    sample.export(place / "house.glb")
    assert f'"value":"{sample.choices["roof"]}"'.encode() in (place / "house.glb").read_bytes()


def test_a_file_of_a_model_without_words_replays_as_it_was() -> None:
    sample = run_files.replayed(run_files.load(OLD))
    assert (sample.choices, sample.value) == ({"roof": 2, "height": 0}, ("flat", 1.0))
    # The model of today takes the places.
    assert nw.run_python(lambda: choose(ROOFS), choices={"discrete_uniform": 2}).choices == {
        "discrete_uniform": "flat"
    }


def test_the_shell_holds_words(place: Path) -> None:
    def grown(*words: str) -> Any:
        size = ["--target", "wall.obj", "--voxel", "0.5", "--particles", "4", "--seed", "1", "--no-picture"]
        return CliRunner().invoke(app, ["grow", "roofs.py:house", *size, *words])

    def roof_in(folder: str) -> str:
        return run_files.choices(json.loads((place / folder / "run.json").read_text())["runs"][0], 0, "")[
            "roof"
        ]

    assert grown("--hold", "roof=hip", "-o", "held").exit_code == 0 and roof_in("held") == "hip"
    assert grown("--from", "held/run.json", "--hold", "roof", "-o", "again").exit_code == 0
    assert roof_in("again") == "hip"
    with pytest.raises(NiwakiError, match="did you mean 'hip'?"):
        grown_wrong = grown("--hold", "roof=hop", "-o", "wrong")
        raise grown_wrong.exception or AssertionError(grown_wrong.output)


def test_tables_of_batches_have_words(tmp_path: Path) -> None:
    table = batches.Table.of_searches([nw.Search(house, method=nw.smc(3), hold={"wall": "wood"})])
    store = batches.Store(tmp_path, table.spec([0, 1]))
    with ThreadPoolExecutor(1) as thread:
        list(table.run(store, (1, 1), batches.Workers(thread)))
    with open(export.write_csv(tmp_path / "results.csv", store, choices=True), newline="") as file:
        rows = [json.loads(row["choices"]) for row in csv.DictReader(file)]
    assert [row["wall"] for row in rows] == ["wood", "wood"] and all(row["roof"] in ROOFS for row in rows)
