"""Claim: the engine refuses each setting of a method or kernel that is out of its range or breaks a rule, by its name.

A new setting without a range, and a rule without a text or without a row here, fail.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from niwaki import kernels as k
from niwaki import methods as m
from niwaki.errors import InputError
from niwaki.errors.texts.rules import RULES
from niwaki.methods import FutureOrder, Method

CRATES = Path(__file__).parents[3] / "crates"

#: Settings that a method converts to truth values, or that only Python reads.
TRUTHS = {"likely", "ancestors", "designs"}
SETTINGS = [
    (method, field.name)
    for method in Method.KNOWN.values()
    for field in fields(method)
    if field.name not in TRUTHS
]

PRIOR, STEP = k.prior(), k.hmc_step()
ANNEALED = k.anneal(PRIOR, 5)
ABSOLUTE = {"weights": "absolute"}
DRAWN = k.on("x", k.proposal(lambda old: nw.Gaussian(old, 1)))

BROKEN: dict[str, list[tuple[str, Callable[[], Any]]]] = {
    "anneal-absolute": [("anneal", lambda: m.smc(9, anneal=[1.0], **ABSOLUTE))],
    "chains-draws": [("chains", lambda: m.smc(9, rejuvenate=PRIOR, chains=2))],
    "draws-kernel": [("draws", lambda: m.smc(9, draws=2))],
    "gradient-end": [
        ("rejuvenate", lambda: m.smc(9, rejuvenate=STEP)),
        ("rejuvenate", lambda: m.smc(9, rejuvenate=k.cycle(PRIOR, k.nuts_step()), at="resampled")),
    ],
    "kernel-powers": [
        ("kernel", lambda: m.ais(9, kernel=k.cycle(PRIOR, ANNEALED))),
        ("kernel", lambda: m.ais(9, kernel=k.tempering(PRIOR))),
    ],
    "look-ahead-moves": [("look_ahead", lambda: m.smc(9, rejuvenate=PRIOR, look_ahead=0.2))],
    "metric-numbers": [
        ("metric", lambda: m.hmc(metric=((1.0, 2.0),))),
        ("metric", lambda: m.nuts(metric=((1.0, 2.0), (2.0, 1.0)))),
    ],
    "moves-absolute": [("rejuvenate", lambda: m.smc(9, rejuvenate=PRIOR, **ABSOLUTE))],
    "moves-kernel": [("moves", lambda: m.smc(9, moves=2)), ("at", lambda: m.smc(9, at="end"))],
    "moves-powers": [("rejuvenate", lambda: m.smc(9, rejuvenate=ANNEALED))],
    "pathfinder-start": [("start", lambda: m.vi("pathfinder", start="run"))],
    "powers-falling": [
        ("powers", lambda: k.tempering(PRIOR, [1, 0.5, 0.6])),
        ("powers", lambda: k.tempering(PRIOR, [0.5])),
    ],
    "powers-rising": [
        ("powers", lambda: m.ais(9, powers=[0.5, 0.4, 1])),
        ("powers", lambda: m.ais(9, powers=[0.5])),
        ("powers", lambda: m.ais(9, powers=[0.5, 2])),
    ],
    "proposal-absolute": [("proposal", lambda: m.smc(9, proposal=DRAWN, **ABSOLUTE))],
    "seconds-alone": [
        ("populations", lambda: m.smc(9, populations=2, seconds=1)),
        ("particles", lambda: m.smc([9, 9], seconds=1)),
    ],
    "generations-diverse": [("generations", lambda: m.improve(generations=4))],
    "sizes-alone": [("populations", lambda: m.smc([9, 9], populations=2))],
    "tempered-absolute": [("resampling", lambda: m.smc(9, resampling="tempered", **ABSOLUTE))],
    "warmup-steps": [("warmup", lambda: m.mh(100, warmup=100))],
}

KERNELS: list[tuple[str, Callable[[Any], Any], list[Any]]] = [
    ("step", lambda x: k.drift(x), [0, -1, "1", float("nan")]),
    ("target", lambda x: k.drift(target=x), [0, 1, True]),
    ("reach", lambda x: k.neighbour(x), [0, 1.5, "1"]),
    ("step", lambda x: k.block(x), [0]),
    ("share", lambda x: k.block(share=x), [0, 1.1]),
    ("target", lambda x: k.block(target=x), [1]),
    ("levels", lambda x: k.regenerate(x), [-1, 0.5]),
    ("particles", lambda x: k.regrow(x), [1, 2.0]),
    ("turn", lambda x: k.regrow(turn=x), [-0.1, 1.1]),
    ("steps", lambda x: k.hmc_step(x), [0, 2**32]),
    ("step", lambda x: k.hmc_step(step=x), [0]),
    ("jitter", lambda x: k.hmc_step(jitter=x), [-0.1, 1.1]),
    ("target", lambda x: k.hmc_step(target=x), [1]),
    ("max_depth", lambda x: k.nuts_step(x), [0, 21]),
    ("step", lambda x: k.nuts_step(step=x), [0]),
    ("target", lambda x: k.nuts_step(target=x), [1]),
    ("times", lambda x: k.repeat(x, PRIOR), [0, "2"]),
    ("weights", lambda x: k.mixture(PRIOR, PRIOR, weights=[1, x]), [0, -1, float("inf")]),
    ("start", lambda x: k.anneal(PRIOR, 5, start=x), [0]),
    ("end", lambda x: k.anneal(PRIOR, 5, end=x), [0]),
    ("steps", lambda x: k.anneal(PRIOR, x), [0]),
    ("powers", lambda x: k.tempering(PRIOR, [1, x]), [0, "0.5"]),
    ("every", lambda x: k.tempering(PRIOR, every=x), [0]),
]


def refusal(make: Callable[[], Any], name: str) -> str:
    with pytest.raises(InputError, match=f"`{name}` cannot be") as caught:
        make()
    assert caught.value.code == "bad-setting"
    return str(caught.value)


@pytest.mark.parametrize(("method", "name"), SETTINGS, ids=lambda part: getattr(part, "NAME", part))
@pytest.mark.parametrize("value", [-60, float("nan"), "no such word", object(), {}])
def test_settings_have_ranges(method: type[Method], name: str, value: Any) -> None:
    if name == "by" and value == "no such word":
        assert method(by=value).by == value  # The key of a query.
    elif value == -60 and name in ("rest", "bound"):
        assert getattr(method(**{name: value}), name) == value
    else:
        refusal(lambda: method(**{name: value}), name)


@pytest.mark.parametrize(("name", "make", "values"), KERNELS)
def test_settings_of_kernels_have_ranges(name: str, make: Callable[[Any], Any], values: list[Any]) -> None:
    for value in values:
        refusal(lambda value=value: make(value), name)  # type: ignore[misc]


@pytest.mark.parametrize("name", ["depth", "turns", "waited", "stay", "tree"])
def test_numbers_of_an_order_have_a_range(name: str) -> None:
    for value in (50.1, -51, float("nan"), "1"):
        settings = {"functions": {"m": 1.0, "tree": value}} if name == "tree" else {name: value}
        assert "a number from -50 to 50" in refusal(lambda settings=settings: FutureOrder(**settings), name)  # type: ignore[misc]


@pytest.mark.parametrize("rule", RULES)
def test_broken_rules_are_refused(rule: str) -> None:
    for name, make in BROKEN[rule]:
        assert RULES[rule][0] in refusal(make, name)


def test_rules_of_the_engine_have_texts() -> None:
    sources = (path.read_text(encoding="utf-8") for path in CRATES.glob("*/src/**/*.rs"))
    literals = {word for source in sources for word in re.findall(r'"([a-z]+(?:-[a-z]+)+)"', source)}
    assert RULES.keys() <= literals and BROKEN.keys() == RULES.keys()
