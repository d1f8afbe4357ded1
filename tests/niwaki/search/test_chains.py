"""Markov chains from Python: a seed decides everything, chains continue where they stopped, errors contain the cure."""

from __future__ import annotations

import json
import linecache
import math
import os
import re
import signal
import threading
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from niwaki import _engine
from niwaki import kernels as k
from niwaki.lang import compiled
from niwaki.result.hmc import GradientWarning
from niwaki.search import SearchWarning
from niwaki.shell.main import app
from niwaki.words import Gaussian
from typer.testing import CliRunner

GOLDEN = Path(__file__).parents[2] / "golden"

TEXT = """
from niwaki import model; from niwaki.words import *

@model
def garden(n=5):
    mean = gaussian(0, 2)
    width = gamma(2, 1)
    for i in range(n):
        x = gaussian(mean, width)
        observe(Gaussian(x, 1), i * 0.5)
    return mean

def arm(y, n):
    size = uniform(0.5, 1.5)
    emit(box((0, y + size / 2, 0), (1, size, 1)))
    if n > 0 and flip(0.8):
        arm(y + size, n - 1)

@model
def tower():
    arm(0.0, 6)

@model
def impossible():
    x = uniform(0, 1)
    condition(x > 2)
    return x

@model
def never():
    x = uniform(0, 1)
    observe(Uniform(2, 3), x)
    return x

@model
def not_a_number():
    x = uniform(0, 1)
    factor((x - x) * inf)
    return x

@model
def twice():
    a = flip(0.5)
    query("a", a)
    query("a", not a)
    return a

@model
def late():
    n = poisson(1)
    for i in range(n):
        y = gaussian(0, 1)
    return n
"""


def loaded() -> dict[str, Any]:
    name = "chains.py"
    linecache.cache[name] = (len(TEXT), None, TEXT.splitlines(True), name)
    space: dict[str, Any] = {"__name__": "chains", "inf": float("inf")}
    exec(compile(TEXT, name, "exec"), space)
    return space


MODELS = loaded()
GARDEN, TOWER = MODELS["garden"], MODELS["tower"]


def states(result: Any) -> list[Any]:
    return [(sample.log_prior, sample.log_score, sample.choices) for sample in result]


def test_a_seed_decides_whatever_the_threads_and_the_strategy() -> None:
    method = {"steps": 400, "chains": 3, "keep": 5, "warmup": 100, "kernel": k.cycle(k.prior(), k.drift())}
    first = states(nw.run(GARDEN, nw.mh(**method), seed=4, threads=1))
    assert len(first) == 15
    for strategy in ("c3", "resume", "cache", "rerun"):
        assert states(nw.run(GARDEN, nw.mh(**method, strategy=strategy), seed=4, threads=3)) == first
    assert states(nw.run(GARDEN, nw.mh(**method), seed=5)) != first


def test_more_goes_on_where_it_stopped() -> None:
    settings = {"thin": 50, "kernel": k.cycle(k.prior(), k.repeat(2, k.drift()))}
    whole = nw.run(GARDEN, nw.mh(steps=1000, **settings), seed=3)
    parts = nw.run(GARDEN, nw.mh(steps=130, **settings), seed=3)
    assert parts.more(70) is parts
    parts.more(800)
    assert states(parts) == states(whole)
    assert parts.best.log_score == whole.best.log_score
    assert parts.counters["proposals"] == 1000
    assert parts.visits == [list(range(50, 1001, 50))]


def test_the_best_is_kept_whether_it_was_sampled_or_not() -> None:
    result = nw.run(GARDEN, nw.mh(steps=20_000, keep=0), seed=1)
    assert len(result) == 0
    best = result.best
    # Run once more, it scores what it scored.
    assert best._trace.run.log_score == best.log_score
    every = nw.run(GARDEN, nw.mh(steps=20_000, thin=1), seed=1)
    assert max(sample.log_score for sample in [*every, every.bests[0]]) == best.log_score
    assert max(every.trace[0]) == best.log_score


@pytest.mark.parametrize(
    "kernel", [k.prior(), k.regenerate(), k.cycle(k.block(share=0.5), k.prior())], ids=repr
)
def test_sketches_follow_the_chain(kernel: k.Kernel) -> None:
    solid = _engine.shape("box", (0, 2, 0), (1, 4, 1))
    target = nw.Target(solid.vertices(), solid.faces(), "tower")
    score = nw.no_self_intersection() * nw.match_volume(target, sigma=0.5)
    result = nw.run(TOWER, nw.mh(steps=2000, keep=50, kernel=kernel), seed=2, score=score)
    for sample in [*result, result.best]:
        assert sample._trace.run.log_score == sample.log_score
        assert sample._trace.run.primitives == sample.primitives == len(list(sample.scene))
    assert len({sample.primitives for sample in result}) > 1


def test_acceptance_is_reported_by_site() -> None:
    result = nw.run(GARDEN, nw.mh(steps=4000, warmup=1000, kernel=k.drift(step=30.0)), seed=2)
    rows = result.acceptance
    assert set(rows) == {"garden/mean", "garden/width", "garden/i#0/x"} or len(rows) == 3
    assert sum(row.proposed for row in rows.values()) == 4000
    # A first step of thirty standard deviations would be kept hardly ever: the steps were adapted.
    assert all(0.15 < row.rate < 0.75 for row in rows.values()), rows


def test_steps_are_frozen_after_the_warmup() -> None:
    result = nw.run(GARDEN, nw.mh(steps=3000, warmup=0, kernel=k.drift(step=30.0)), seed=2)
    assert all(row.rate < 0.15 for row in result.acceptance.values())


def test_chains_start_from_given_choices() -> None:
    first = nw.run(GARDEN, seed=9).best.choices
    result = nw.run(GARDEN, nw.mh(steps=1, thin=1), seed=1, choices=first)
    changed = [address for address, value in result.last[0].choices.items() if first[address] != value]
    assert len(changed) <= 1


def test_samples_are_bounded() -> None:
    task = compiled.task(GARDEN, (), {})
    chains = nw._engine.Chains(task, nw.mh(thin=1).text()[0], 1, room=100)
    chains.advance(2000)
    kept = chains.samples()[0]
    assert len(kept) * 8 <= 100
    assert [run.visit for run in kept] == list(range(chains.thin()[0], 2001, chains.thin()[0]))


def test_ctrl_c_gives_what_there_is() -> None:
    timer = threading.Timer(0.4, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    result = nw.run(GARDEN, nw.mh(steps=10**12, thin=10**6, chains=2), seed=1)
    assert result.interrupted
    assert 0 < result.counters["proposals"] < 10**12
    assert result.best.log_score > -1e9
    result.more(100)
    assert not result.interrupted


def test_a_selection_may_wait_for_a_site_that_is_not_there_yet() -> None:
    kernel = k.cycle(k.on("y", k.drift()), k.prior())
    for seed in range(20):
        result = nw.run(MODELS["late"], nw.mh(steps=50, kernel=kernel), seed=seed)
        assert result.counters["proposals"] == 50


def failing() -> dict[str, Callable[[], Any]]:
    """Every kind of error, by name."""
    run = nw.run
    return {
        "no first state: a condition": lambda: run(MODELS["impossible"], nw.mh(steps=10, tries=50), seed=1),
        "no first state: an observation": lambda: run(MODELS["never"], nw.mh(steps=10, tries=50), seed=1),
        "no first state: a sketch": lambda: run(
            MODELS["tower"], nw.mh(steps=10, tries=5), seed=1, score=_never()
        ),
        "a score that is not a number": lambda: run(MODELS["not_a_number"], nw.mh(steps=10), seed=1),
        "a query written twice": lambda: run(MODELS["twice"], nw.mh(steps=10), seed=1).best.queries,
        "no such address": lambda: run(GARDEN, nw.mh(kernel=k.on("widht", k.drift())), seed=1),
        "no such whole address": lambda: run(GARDEN, nw.mh(kernel=k.on("garden/i[9]/x", k.prior())), seed=1),
        "a proposal of another kind": lambda: run(
            MODELS["late"], nw.mh(kernel=k.on("n", k.proposal(lambda old: Gaussian(old, 1)))), seed=1
        ),
        "a proposal that draws": lambda: run(
            GARDEN, nw.mh(kernel=k.on("mean", k.proposal(MODELS["late"]))), seed=1
        ),
        "a proposal that is no distribution": lambda: run(
            GARDEN, nw.mh(kernel=k.on("mean", k.proposal(lambda old: old + 1))), seed=1
        ),
        "no kernel": lambda: nw.mh(kernel="drift"),  # type: ignore[arg-type]
        "tempering inside": lambda: k.cycle(k.tempering(k.prior())),
        "powers that rise": lambda: k.tempering(k.prior(), (0.5, 1.0)),
        "selection weight below zero": lambda: k.weighted(k.prior(), depth=lambda depth: 1 - depth),
        "a kernel that does nothing": lambda: k.cycle(),
        "warm-up without end": lambda: nw.mh(steps=100, warmup=100),
        "no strategy": lambda: nw.mh(strategy="c4"),
        "a kernel misspelt": lambda: k.parse("cycl(prior())"),
        "a kernel that is code": lambda: k.parse("prior().__class__"),
        "explained: no such choice": lambda: nw.search.explain(GARDEN, "hight"),
    }


def _never() -> Any:
    """A score under which every tower is forbidden: the floor above it."""
    return nw.no_self_intersection() * nw.floor(100.0)


def test_errors_are_as_reviewed(reviewed) -> None:
    reviewed(GOLDEN / "chains.txt", failing())


def test_a_proposal_outside_the_support_is_rejected_and_counted() -> None:
    far = k.on("width", k.proposal(lambda old: Gaussian(-100.0, 1.0)))
    result = nw.run(GARDEN, nw.mh(steps=200, kernel=far), seed=1)
    (row,) = result.acceptance.values()
    assert (row.proposed, row.accepted, row.outside) == (200, 0, 200)


def test_kernels_are_read_as_they_are_written() -> None:
    text = "cycle(on(['z', 'a/*'], prior()), repeat(3, drift(0.2)), mixture(block(share=0.5), prior, weights=[1, 2]))"
    expected = k.cycle(
        k.on(["z", "a/*"], k.prior()),
        k.repeat(3, k.drift(0.2)),
        k.mixture(k.block(share=0.5), k.prior(), weights=[1, 2]),
    )
    assert k.parse(text) == expected


def test_explain_tells_what_each_strategy_did() -> None:
    explained = nw.search.explain(GARDEN, "x", seed=1)
    assert set(explained["runs"]) == {"rerun", "resume", "cache", "c3"}
    from niwaki.draw.reuse import counts

    total = len(explained["activations"])
    seen = {name: counts(steps, total) for name, (steps, _) in explained["runs"].items()}
    assert seen["rerun"]["invoked"] == total
    assert seen["c3"]["untouched"] > seen["resume"]["untouched"] >= 0
    assert seen["c3"]["invoked"] + seen["c3"]["unwound"] <= 2


def test_the_shell_fills_a_target_of_the_gallery(tmp_path: Path) -> None:
    (tmp_path / "chains.py").write_text(TEXT)
    words = ["sample", f"{tmp_path / 'chains.py'}:tower", "--target", "gallery:bent-tube", "--voxel", "1"]
    more = ["--steps", "200", "--chains", "1", "--seed", "1", "--no-picture", "-o", str(tmp_path / "out")]
    outcome = CliRunner().invoke(app, [*words, *more])
    assert outcome.exit_code == 0, outcome.output
    written = json.loads((tmp_path / "out" / "run.json").read_text())
    assert written["search"]["score"][-1]["given"]["target"]["file"] == "gallery:bent_tube"
    again = CliRunner().invoke(
        app, ["replay", str(tmp_path / "out" / "run.json"), "-o", str(tmp_path / "again"), "--no-picture"]
    )
    assert again.exit_code == 0, again.output
    words[3] = "gallery:bent-tub"
    assert CliRunner().invoke(app, [*words, *more]).exit_code != 0


def test_the_shell_samples_and_explains(tmp_path: Path) -> None:
    (tmp_path / "chains.py").write_text(TEXT)
    place = f"{tmp_path / 'chains.py'}:tower"
    words = ["sample", place, "--steps", "300", "--chains", "2", "--seed", "1", "-o", str(tmp_path / "out")]
    outcome = CliRunner().invoke(app, [*words, "--kernel", "cycle(prior(), drift())"])
    assert outcome.exit_code == 0, outcome.output
    written = {file.name for file in (tmp_path / "out").iterdir()}
    assert written == {"run.json", "samples.csv", "best.glb", "best.png", "sheet.png"}
    again = CliRunner().invoke(
        app, ["replay", str(tmp_path / "out" / "run.json"), "-o", str(tmp_path / "again"), "--no-picture"]
    )
    assert again.exit_code == 0, again.output
    assert (tmp_path / "again" / "best.glb").read_bytes() == (tmp_path / "out" / "best.glb").read_bytes()
    for name in ("why.svg", "why.png"):
        drawn = CliRunner().invoke(app, ["explain", place, "--choice", "size", "-o", str(tmp_path / name)])
        assert drawn.exit_code == 0, drawn.output
        assert (tmp_path / name).stat().st_size > 2000


def test_every_kernel_of_the_engine_has_a_function_a_text_and_a_row_in_the_manual():
    with pytest.raises(nw.InputError) as raised:
        nw.run(MODELS["garden"], nw.mh(steps=10, kernel=k.Kernel("nothing")), seed=1)
    named = set(re.findall(r"`(\w+)`", str(raised.value).split("expected one of")[1].splitlines()[0]))
    assert {"prior", "drift", "nuts_step"} <= named
    with pytest.raises(nw.InputError) as raised:
        k.parse("nothing()")
    written = str(raised.value).split("there are ")[1]
    page = (GOLDEN.parents[1] / "docs" / "guide" / "chains.md").read_text(encoding="utf-8")
    for name in named - {"by_family"}:  # which is the leaf of `original`
        assert name in k.__all__ and re.search(rf"\b{name}\b", written), name
        assert f"`{name}(" in page, name


@nw.model
def rounds():
    n = 0
    for _ in range(3):
        for _ in range(5):
            if nw.flip(0.2):
                break
            n = n + 1
    return n


@nw.model
def even():
    return [nw.flip(0.3) for _ in range(3)]


def test_a_kernel_that_does_not_reach_all_runs_is_named():
    alone = [
        k.regrow(4, pick="choice"),
        k.repeat(2, k.regrow(4, pick="choice", turn=0.0)),
        k.on("*", k.regrow(4, pick="choice")),
    ]
    for kernel in alone:
        with pytest.warns(SearchWarning, match='Use `pick="size"`'):
            result = nw.run(rounds, nw.mh(steps=300, kernel=kernel, chains=4), seed=1)
        # The chains keep the iterations of their first runs.
        assert all(len({tuple(sample.choices) for sample in chain}) == 1 for chain in result.by_chain)
    with pytest.warns(SearchWarning, match='Use `pick="size"`'):
        nw.run(rounds, seed=1).polish(nw.mh(steps=10, kernel=alone[0]))


@pytest.mark.parametrize(
    "kernel",
    [
        k.regrow(4),
        k.cycle(k.regrow(4, pick="choice"), k.prior()),
        k.mixture(k.regrow(4, pick="choice"), k.regrow(4)),
        None,
    ],
    ids=repr,
)
def test_kernels_that_reach_all_runs_are_not(kernel):
    with warnings.catch_warnings():
        warnings.simplefilter("error", SearchWarning)
        result = nw.run(rounds, nw.mh(steps=300, kernel=kernel, chains=4), seed=1)
        nw.run(even, nw.mh(steps=30, kernel=k.regrow(4, pick="choice")), seed=1)
    assert all(len({tuple(sample.choices) for sample in chain}) > 1 for chain in result.by_chain)


@nw.model
def discrete():
    n = nw.discrete_uniform(0, 3)
    return [nw.flip(0.3), nw.flip(0.6), n, nw.flip(0.1 + 0.2 * n)]


def test_a_block_alone_reaches_all_values_of_discrete_choices():
    exact = nw.run(discrete, nw.enumerate_all()).distribution()
    with warnings.catch_warnings():
        warnings.simplefilter("error", SearchWarning)
        result = nw.run(discrete, nw.mh(steps=80_000, kernel=k.block(), chains=4, keep=4000), seed=1)
    for chain in result.by_chain:
        values = [str(sample.value) for sample in chain]
        for value, probability in exact.items():
            # 4000 samples, 20 proposals apart: six standard errors of independent ones, in 128 comparisons.
            limit = 6.0 * math.sqrt(probability * (1.0 - probability) / len(values))
            assert abs(values.count(value) / len(values) - probability) < limit, value


@nw.model
def counts():
    return nw.multinomial(4, [0.5, 0.5]), nw.gaussian(0.0, 1.0), nw.flip(0.5)


@pytest.mark.parametrize(
    ("kernel", "kept"),
    [
        (k.block(), "a block does not move it: `multinomial`"),
        (k.hmc_step(), "a gradient does not move them: `bernoulli`, `multinomial`"),
        (k.cycle(k.block(), k.nuts_step()), "a block does not move it: `multinomial`"),
    ],
    ids=["block", "trajectory", "both"],
)
def test_choices_that_a_kernel_never_changes_are_named(kernel, kept):
    with pytest.warns(GradientWarning, match=kept):
        result = nw.run(counts, nw.mh(steps=200, kernel=kernel, chains=2), seed=1)
    assert all(len({str(sample.value[0]) for sample in chain}) == 1 for chain in result.by_chain)
    with warnings.catch_warnings():
        warnings.simplefilter("error", GradientWarning)
        nw.run(counts, nw.mh(steps=20, kernel=k.cycle(kernel, k.prior())), seed=1)
