"""Claim: the settings of chains are checked when they are created, and each refusal names its setting."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import niwaki as nw
import pytest
from niwaki.methods import Hmc, Nuts, explore, hmc, nuts

BAD: dict[str, list[Any]] = {
    "draws": [0, -1, 1.5, True, "9"],
    "chains": [0, 2.0],
    "warmup": [-1, 10.0, None],
    "thin": [0],
    "target_accept": [0, 1, math.nan, "0.8"],
    "metric": ["sparse", None],
    "step_size": [0, -1, math.inf, math.nan, "1"],
}


@pytest.mark.parametrize("method", [hmc, nuts])
@pytest.mark.parametrize(("name", "value"), [(name, value) for name in BAD for value in BAD[name]])
def test_settings_are_checked(method: Any, name: str, value: Any) -> None:
    with pytest.raises(nw.InputError, match=f"`{name}`") as caught:
        method(**{name: value})
    assert caught.value.code == "bad-setting"


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: hmc(steps=0), "steps"),
        (lambda: hmc(jitter=1.5), "jitter"),
        (lambda: hmc(jitter=math.nan), "jitter"),
        (lambda: hmc(climb=-1), "climb"),
        (lambda: explore(climb=1.5), "climb"),
        (lambda: explore(chains=0), "chains"),
        (lambda: nuts(max_depth=0), "max_depth"),
        (lambda: nuts(max_depth=21), "max_depth"),
    ],
)
def test_settings_of_one_method_are_checked(make: Any, name: str) -> None:
    with pytest.raises(nw.InputError, match=f"`{name}`"):
        make()


def test_defaults_are_those_of_the_functions() -> None:
    assert hmc() == Hmc() and nuts() == Nuts()
    assert hmc(500, steps=1000, metric="unit") == Hmc(draws=500, steps=1000, metric="unit")
    short = Hmc(8, 30, 0.5, chains=128, warmup=6, target_accept=0.65, metric="unit", climb=2000, designs=True)
    assert explore() == short and explore(3, 5) == replace(short, draws=3, chains=5)
