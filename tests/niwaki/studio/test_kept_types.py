"""Numbers keep their types between a page and a model: a page's JSON writes the real number 2.0 as 2."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("starlette")

import msgspec
from niwaki import _engine
from niwaki.studio import messages as m
from niwaki.studio.session import Session, setting
from niwaki.studio.window import Window
from niwaki.studio.worker import jobs, models, runs
from niwaki.words.distributions import FAMILIES

#: A call of each family that draws a single number, and a value of it that JSON writes without a point.
CALLS = {
    "bernoulli": ("flip(0.5)", True),
    "categorical": ("categorical([1, 1, 1])", 1),
    "discrete_uniform": ("discrete_uniform(1, 3)", 2),
    "poisson": ("poisson(2)", 2),
    "binomial": ("binomial(4, 0.5)", 2),
    "geometric": ("geometric(0.5)", 2),
    "uniform": ("uniform(1, 3)", 2),
    "gaussian": ("gaussian(0, 1)", 0),
    "log_normal": ("log_normal(0, 1)", 1),
    "gamma": ("gamma(2, 1)", 2),
    "inverse_gamma": ("inverse_gamma(2, 1)", 2),
    "beta": ("beta(1, 1)", 1),
    "exponential": ("exponential(1)", 1),
    "laplace": ("laplace(0, 1)", 0),
    "cauchy": ("cauchy(0, 1)", 0),
    "student_t": ("student_t(2, 0, 1)", 0),
    "von_mises": ("von_mises(0, 1)", 0),
    "truncated_gaussian": ("truncated_gaussian(0, 1, -2, 2)", 1),
    "mixture": ("sample(Mixture([1, 1], [Gaussian(0, 1), Gaussian(2, 1)]))", 1),
}
#: Families that draw tuples, which have no slider, and the fixed value.
NO_SLIDER = {
    "dirichlet",
    "multivariate_gaussian",
    "diagonal_gaussian",
    "multinomial",
    "multivariate_bernoulli",
    "delta",
}


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, m.Question]:
    """A stored result with a choice of each family, and its question."""
    folder = tmp_path_factory.mktemp("families")
    place = folder / "families.py"
    words = ", ".join(call.partition("(")[0] for name, (call, _) in CALLS.items() if name != "mixture")
    lines = "\n".join(f"    {name}_ = {call}" for name, (call, _) in CALLS.items())
    place.write_text(
        '"""A choice of each family."""\n\n'
        f"from niwaki import box, emit, model, sample, {words}\n"
        "from niwaki.words import Gaussian, Mixture\n\n\n"
        "@model\n"
        "def families(width: float = 4.0, depth: float = 4, count: int = 3, plain=2.0, whole=2):\n"
        f'    """A box."""\n{lines}\n    emit(box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)))\n'
    )
    models.named[place.resolve()] = str(place)
    question = m.Question(str(place), {}, m.Ask(m.TargetAsk("box")), m.Settings(count=1, effort=0.07), {})
    file = folder / "1.json"
    job = m.Grow(question=question, run=1, seed=1, file=str(file))
    jobs.grow(job, lambda *_: None, lambda: None)
    return file, question


def test_every_family_is_tried():
    assert {family.family for family in FAMILIES} == set(CALLS) | NO_SLIDER


@pytest.mark.parametrize("family", list(CALLS))
def test_a_choice_keeps_the_type_of_its_family_over_a_pages_json(result, family):
    file, question = result
    before = runs.sample(str(file), 0).choices
    address = f"{family}_"
    value = CALLS[family][1]
    sent = json.loads(f'{{"kind": "choose", "address": "{address}", "value": {json.dumps(value)}}}')
    command: Any = msgspec.convert(sent, m.AnyCommand)
    written = file.with_name(f"{family}.json")
    job = m.Change(
        source=str(file),
        number=0,
        question=question,
        changes={command.address: command.value},
        run=2,
        file=str(written),
    )
    # A job crosses a pipe as JSON too.
    jobs.change(msgspec.json.decode(msgspec.json.encode(job), type=m.Change), lambda *_: None)
    now = runs.sample(str(written), 0).choices[address]
    assert now == value and type(now) is type(before[address])
    reports: list[m.Described] = []
    describe = m.DescribeRun(source=str(written), number=0, question=question, key=m.Key(2))
    runs.describe(describe, reports.append)
    info = next(choice for choice in reports[0].choices if choice.address == address)
    space = _engine.FAMILIES[family][3]
    assert info.is_whole == (space in ("Booleans", "Categories", "Integers")) and info.low is not None


def test_an_argument_keeps_the_type_of_its_parameter(result, tmp_path):
    _, question = result
    listed = models.info(models.reference(question.model), question.model, is_file=True)
    assert {row.name: row.is_whole for row in listed.parameters} == {
        "width": False,
        "depth": False,
        "count": True,
        "plain": False,
        "whole": True,
    }
    session = Session(tmp_path, [])
    session.models = [listed]
    session.step("model", {"model": question.model})
    setting.set_values(session, Window(), m.Set(arguments={"width": 5, "depth": 5, "count": 4.0, "other": 7}))
    kept = session.document.arguments
    assert [(name, type(value)) for name, value in kept.items()] == [
        ("width", float),
        ("depth", float),
        ("count", int),
        ("other", int),
    ]
    session.journal.close()
