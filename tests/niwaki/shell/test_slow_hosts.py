"""Claim: slow host functions get fewer particles; progress says evaluations, the best so far and the time left."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import niwaki as nw
import pytest
from niwaki import box
from niwaki.draw.scene import Scene
from niwaki.lang.marks import Host
from niwaki.result import Progress
from niwaki.shell import evaluations, progress, run_files, trust
from niwaki.shell.main import app
from typer.testing import CliRunner

SLOW = """
from sys import modules

from niwaki import box, emit, host, model, uniform

@host
def size(x: float) -> float:
    modules["slow_clock"].time += modules["slow_clock"].step
    return x

@model
def slow():
    emit(box((0, 1, 0), (size(uniform(0.5, 2.0)), 2, 1)))
"""


@pytest.fixture
def lines(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The lines of progress; the time is that of the host function alone, which does not sleep."""
    clock, shown = SimpleNamespace(time=0.0, step=0.3), []
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, "slow_clock", clock)
    monkeypatch.setattr(evaluations, "now", lambda: clock.time)
    monkeypatch.setattr(progress, "EVERY", 0.0)
    monkeypatch.setattr(progress, "print", lambda text, **_: shown.append(text), raising=False)
    (tmp_path / "slow.py").write_text(SLOW)
    Scene([("pillar", [box((0, 1, 0), (1, 2, 1))])]).export(tmp_path / "pillar.obj")
    return shown


def grow(*flags: str) -> tuple[str, tuple[int, int, int]]:
    """Grow the slow model; return what the command said, and the numbers of the search in run.json."""
    words = "grow slow.py --target pillar.obj --seed 1 --no-picture --format glb --force -o out".split()
    done = CliRunner().invoke(app, [*words, *flags])
    assert done.exit_code == 0, done.output
    method = json.loads(Path("out/run.json").read_text())["search"]["method"]
    return done.output, tuple(method.get(name) for name in ("particles", "regrow", "rounds"))


def test_the_search_is_sized_by_a_run_and_repeated_from_the_file(lines: list[str]) -> None:
    text, numbers = grow()
    # A minute has 200 runs of 0.3 s: a quarter of them in the population, and rounds of 25.
    assert numbers == (50, 10, 6)
    assert (
        "takes 0.3 s in host functions, so the search has 50 particles, 10 regrow, 6 rounds (--particles"
        in text
    )
    assert lines[0] == "growing slow: 1 of about 200 evaluations, about 60 s left"
    # On a machine on which the host function is fast, the search from the file is the same.
    sys.modules["slow_clock"].step = 0.0
    data = run_files.load("out/run.json")
    again = run_files.searched(data, trust.trusted(data, None, trust=True)).run().best
    assert again.choices == run_files.replayed(data, trust=trust.trusted(data, None, trust=True)).choices


def test_what_the_user_sets_is_kept(lines: list[str]) -> None:
    text, (particles, *_) = grow("--particles", "300")
    assert particles == 300 and "host functions" not in text
    assert lines[0].startswith("growing slow: 1 of about 300 evaluations")


def test_a_line_has_evaluations_the_best_so_far_and_the_time_left(lines: list[str]) -> None:
    spent = evaluations.Evaluations(each=2, expected=100)
    call = Host(lambda: setattr(sys.modules["slow_clock"], "time", sys.modules["slow_clock"].time + 0.3))
    with progress.progress_line("slow", False, spent) as update:
        for _ in range(20):
            call()
        update(Progress(0, 1, 1, 10, -3.0, SimpleNamespace(fit="80 % covered, 5 % outside")))
    assert lines[0] == "growing slow: 0 of about 50 evaluations, about 30 s left"
    assert lines[-1] == "growing slow: 10 of about 50 evaluations, 80 % covered, 5 % outside, about 24 s left"
    call()
    assert spent.calls == 20


@nw.host
def identity(x: float) -> float:
    return x


@nw.model
def sheds(count: int = 1):
    for k in range(count):
        height = identity(nw.uniform(0.2, 1.0))
        nw.emit(box((k, height / 2, 0), (0.9, height, 0.9)))
        if nw.flip(0.5):
            nw.emit(box((k, height + 0.5, 0), (0.5, 0.9, 0.5)))


@pytest.mark.parametrize(
    ("count", "settings"),
    [
        (1, {"effort": 1.0}),
        (3, {"effort": 0.3}),
        (1, {"effort": 0.3, "diverse": 4}),
        (1, {"rounds": 5, "diverse": 4}),
    ],
)
def test_a_search_makes_about_as_many_evaluations_as_are_expected(
    count: int, settings: dict[str, float]
) -> None:
    target = nw.Target.of_shapes(box((1, 1, 0), (3, 1.3, 1.3)))
    search = nw.grow(sheds, target, count=count, rounds=1, seed=1, engine="sampler").search
    _, spent, _ = evaluations.sized(replace(search, method=nw.improve(**settings)), False)
    with spent.counted():
        replace(search, method=nw.improve(**settings)).run()
    assert spent.expected / 1.6 < spent.calls < 1.6 * spent.expected
