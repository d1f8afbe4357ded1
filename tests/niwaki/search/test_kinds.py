"""Claim: a search names an observation that has a probability in some runs and a density in others, with both lines.
It accuses no model that observes different values by different families in the same manner in all runs.
"""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from niwaki import gallery, model
from niwaki.lang.compiled import task
from niwaki.search.warnings import SearchWarning
from niwaki.words import Bernoulli, Categorical, Delta, Gaussian, Mixture, Poisson, Uniform


@model
def grade():
    perfect = nw.flip(0.1)
    nw.observe(Delta(10.0) if perfect else Uniform(0.0, 10.0), 10.0)
    return perfect


@model
def by_branch():
    y = 3.0
    if nw.flip(0.5):
        nw.observe(Poisson(2.0), y)
    else:
        nw.observe(Gaussian(2.0, 1.0), y)


@model
def by_element():
    kinds = [Delta(0.0), Gaussian(0.0, 1.0)]
    nw.observe(kinds[nw.flip(0.5)], 0.0)


@model
def held():
    certain = nw.flip(0.5)
    x = nw.sample(Delta(0.0) if certain else Uniform(-1.0, 1.0))
    return x


def kind_warnings(program: Any, method: Any, **settings: Any) -> list[str]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        nw.run(program, method, seed=1, **settings)
    texts = [str(warning.message) for warning in caught if issubclass(warning.category, SearchWarning)]
    return [text for text in texts if "probability of a single value" in text]


def line(program: Any, text: str) -> int:
    lines = Path(__file__).read_text(encoding="utf-8").split("\n")
    first = program.function.__code__.co_firstlineno
    return next(n for n in range(first, len(lines)) if text in lines[n - 1])


METHODS = {
    "importance": nw.importance(50),
    "particles": nw.smc(20),
    "a chain": nw.mh(50),
    "enumeration": nw.enumerate_all(),
}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("program", [grade, by_branch, by_element], ids=lambda program: program.name)
def test_who_mixes_is_told(program: Any, method: str) -> None:
    (text,) = kind_warnings(program, METHODS[method])
    assert "test_kinds.py:" in text
    if program is by_branch:
        for part in ("Poisson", "Gaussian(2"):
            assert f"test_kinds.py:{line(program, part)}" in text


def test_a_held_choice_that_mixes_is_told() -> None:
    assert len(kind_warnings(held, nw.importance(50), hold={"x": 0.0})) == 1
    assert kind_warnings(held, nw.importance(50)) == []


def test_a_forward_run_weighs_nothing() -> None:
    assert kind_warnings(grade, nw.forward(3)) == []


COLUMNS = [("count", 3), ("length", 0.5), ("truth", True)]


@model
def columns():
    """A table whose columns are of different kinds, the same in all runs."""
    rate = nw.gamma(2.0, 1.0)
    for kind, value in COLUMNS:
        if kind == "count":
            nw.observe(Poisson(rate), value)
        else:
            nw.observe(Gaussian(rate, 1.0) if kind == "length" else Bernoulli(0.4), value)
    return rate


@model
def twice():
    """One number that is scored by two families in each run."""
    n = nw.poisson(3.0)
    nw.observe(Poisson(4.0), n)
    nw.observe(Gaussian(4.0, 2.0), n)
    return n


@model
def alike():
    """Distributions that are values, of one kind."""
    a = Categorical([1.0, 2.0]) if nw.flip(0.5) else Delta(1)
    nw.observe(a, 1)
    nw.observe(Mixture([1, 1], [Gaussian(0, 1), Gaussian(5, 1)]) if nw.flip(0.5) else Uniform(0, 9), 2.0)


@pytest.mark.parametrize("program", [columns, twice, alike], ids=lambda program: program.name)
def test_who_does_not_mix_is_told_nothing(program: Any) -> None:
    assert kind_warnings(program, nw.importance(20)) == []


def test_no_model_of_the_gallery_is_accused() -> None:
    entries = gallery.entries()
    assert len(entries) > 15
    for entry in entries:
        assert task(entry.model, (), {}).mixed(1) is None, entry.name
