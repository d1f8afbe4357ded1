"""Claim: a fit keeps every evaluation, whatever the model does. Killed and resumed it gives the same bits,
and so it does on any number of workers.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import fit_hosts
import niwaki as nw
import pytest
from niwaki.errors import FileError, InputError
from niwaki.errors.folders import held_folder
from niwaki.fitting import pool
from niwaki.fitting.archive import NAME
from niwaki.fitting.functions import FunctionGenerator
from niwaki.fitting.meshes import mesh_of
from niwaki.search.warnings import SearchWarning

HERE = Path(__file__).parent
SEED = 3


@pytest.fixture(scope="module")
def goal():
    return nw.match_volume(nw.Target(*mesh_of(fit_hosts.tower(1.3, 3, True))), voxel=0.1)


def rows(result):
    """The table without seconds, which differ."""
    return [{name: value for name, value in row.items() if name != "seconds"} for row in result.table()]


@pytest.fixture(scope="module")
def whole(goal):
    return nw.fit(fit_hosts.tower, goal, 24, workers=2, seed=SEED)


def test_the_number_of_workers_changes_nothing(goal, whole):
    assert rows(nw.fit(fit_hosts.tower, goal, 24, workers=1, seed=SEED)) == rows(whole)
    assert whole.spread == 0.0 and not whole.interrupted and not whole.failures


def test_a_result_has_its_best_with_its_mesh(whole):
    best = whole.best
    assert best.log_score == max(row["log_score"] for row in rows(whole))
    assert {"width", "floors", "lid"} == set(best.parameters) and len(best.scene) == 1
    assert 0.0 < best.iou <= 1.0 and best.number in [sample.number for sample in whole.variants(4)]
    assert len(whole) == 24 and [sample.number for sample in whole[2:4]] == [2, 3]


#: What `share` decides about a point of `hostile`, by the kind of its evaluation.
FATES = {"raised": range(20), "time-out": range(20, 25), "died": range(25, 27), "": range(27, 100)}


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGSEGV")
def test_workers_survive_calls_that_raise_hang_and_crash():
    points, left = [], {kind: list(fates) for kind, fates in FATES.items()}
    for number in range(10_000):
        width = 0.5 + number / 10_000
        kind = next(kind for kind, fates in FATES.items() if fit_hosts.share(width, 1, False) in fates)
        if left.pop(kind, None):
            points.append((kind, {"width": width, "floors": 1, "lid": 0}))
    recipe = FunctionGenerator(fit_hosts.hostile).recipe()
    workers = pool.Workers(recipe, 1, pool.Limit(2.0))
    try:
        replies = dict(workers.call([numbers for _, numbers in points]))
    finally:
        workers.close()
    assert [replies[number].kind for number in range(len(points))] == [kind for kind, _ in points]
    texts = {reply.kind: reply.failed for reply in replies.values()}
    assert "RuntimeError: the shape would tear (fit_hosts.py:" in texts["raised"]
    assert texts["time-out"] == "it took more than 2 s" and "SIGSEGV" in texts["died"]


def test_the_limit_of_a_call_follows_from_ten_calls_and_has_a_floor():
    limit = pool.Limit(60.0)
    for number in range(10):
        assert limit.seconds == 60.0
        limit.note(pool.Reply(seconds=0.2 if number < 9 else 500.0))
        limit.note(pool.Reply(kind="time-out", seconds=900.0))
    assert limit.seconds == 6.0
    for _ in range(20):
        limit.note(pool.Reply(kind="raised", seconds=2.0))
    assert limit.seconds == 20.0


SCRIPT = """
import sys, niwaki as nw, fit_hosts
from niwaki.fitting.meshes import mesh_of
goal = nw.match_volume(nw.Target(*mesh_of(fit_hosts.tower(1.3, 3, True))), voxel=0.1)
nw.fit(getattr(fit_hosts, sys.argv[1]), goal, 24, workers=1, seed=3, folder=sys.argv[2])
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_a_fit_that_is_killed_three_times_gives_the_same_bits(goal, whole, tmp_path, monkeypatch):
    monkeypatch.setenv("FIT_COUNTER", str(tmp_path / "counter"))
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(HERE), *filter(None, sys.path)]))
    folder = tmp_path / "fit"
    command = [sys.executable, "-c", SCRIPT, "deadly", str(folder)]
    codes = [subprocess.run(command, check=False).returncode for _ in range(4)]
    assert codes == [-signal.SIGKILL] * 3 + [0]
    resumed = nw.fit(fit_hosts.deadly, goal, 24, workers=1, folder=folder)
    assert rows(resumed) == rows(whole)
    # One lost call for each kill, and the best called again.
    assert 24 + 1 + 3 - 3 <= (tmp_path / "counter").stat().st_size <= 24 + 1 + 3


def test_an_archive_whose_end_is_lost_is_completed(goal, whole, tmp_path):
    nw.fit(fit_hosts.tower, goal, 24, workers=1, seed=SEED, folder=tmp_path)
    place = tmp_path / NAME
    place.write_bytes(place.read_bytes()[:-700])
    assert rows(nw.fit(fit_hosts.tower, goal, 24, workers=1, folder=tmp_path)) == rows(whole)


def test_another_search_is_refused_with_the_difference(goal, tmp_path):
    nw.fit(fit_hosts.tower, goal, 4, workers=1, seed=SEED, folder=tmp_path)
    with pytest.raises(InputError, match="its `seed` was 3 and is 4") as error:
        nw.fit(fit_hosts.tower, goal, 4, workers=1, seed=4, folder=tmp_path)
    assert error.value.code == "other-fit"
    with pytest.raises(InputError, match="its goal differs"):
        nw.fit(fit_hosts.tower, goal * nw.floor(0), 4, workers=1, folder=tmp_path)
    with pytest.raises(InputError, match="the model was tower and is hostile"):
        nw.fit(fit_hosts.hostile, goal, 4, workers=1, folder=tmp_path)
    with held_folder(tmp_path), pytest.raises(FileError) as used:
        nw.fit(fit_hosts.tower, goal, 8, workers=1, folder=tmp_path)
    assert used.value.code == "folder-in-use"
    (tmp_path / NAME).write_bytes(b"nonsense")
    with pytest.raises(InputError) as damaged:
        nw.fit(fit_hosts.tower, goal, 4, workers=1, folder=tmp_path)
    assert damaged.value.code == "bad-archive"


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGSEGV")
def test_a_host_that_raises_hangs_and_crashes_is_searched_all_the_same(goal, tmp_path, monkeypatch):
    # The limit stays at its first value: a busy machine must not make a time-out of a call that returns.
    monkeypatch.setattr(pool, "LEAST", 1.0)
    result = nw.fit(fit_hosts.hostile, goal, 40, workers=2, seed=7, limit=3.0, folder=tmp_path)
    for sample in result:
        values = sample.entry.numbers
        fate = fit_hosts.share(values["width"], int(values["floors"]), bool(values["lid"]))
        assert fate in FATES[sample.entry.kind], sample
    assert "RuntimeError: the shape would tear (fit_hosts.py:" in " ".join(result.failures)
    assert result.best.log_score > 0.0
    # What failed is known: nothing is called again.
    monkeypatch.setattr(pool.Workers, "_start", None)
    assert rows(nw.fit(fit_hosts.hostile, goal, 40, workers=2, folder=tmp_path)) == rows(result)


def test_a_model_that_always_fails_ends_early(goal):
    with pytest.raises(
        InputError, match=r"first 20 evaluations of `broken` all failed(.|\n)*ValueError: never"
    ):
        nw.fit(fit_hosts.broken, goal, 100, workers=1, seed=1)


def test_a_function_that_no_worker_can_load_runs_here(goal):
    with pytest.warns(SearchWarning, match="it is a lambda.*runs in this process"):
        result = nw.fit(lambda width=nw.Uniform(0.5, 2.0): fit_hosts.block(width, 1, 1), goal, 4, seed=1)
    assert len(result) == 4


def test_a_function_that_is_not_deterministic_is_named(goal):
    with pytest.warns(SearchWarning, match="`restless` is not deterministic: 1 of 1 points"):
        result = nw.fit(fit_hosts.restless, goal, 4, workers=1, seed=1)
    assert result.spread > 0.0


def test_draws_while_a_function_runs_are_its_parameters(goal):
    result = nw.fit(fit_hosts.by_run, goal, 12, workers=1, seed=1)
    for sample in result:
        assert ("size" in sample.parameters) == sample.parameters["lid"]
        assert ("step" in sample.parameters) == (sample.parameters["kind"] == "stepped")


def test_an_interrupt_keeps_all_evaluations(goal):
    def stop(now):
        if now.done >= 16:
            raise KeyboardInterrupt

    result = nw.fit(fit_hosts.tower, goal, 100, workers=1, seed=SEED, progress=stop)
    assert result.interrupted and 16 <= len(result) < 100


def test_defects_and_empty_meshes_are_scored_with_one_warning(goal):
    def shape(width=nw.Uniform(0.5, 2.0), kind: str = "x", hole=nw.DiscreteUniform(0, 2)):
        vertices, faces = fit_hosts.block(width, 1, 1)
        return [(vertices, faces), (vertices, faces[1:]), (vertices, faces[:0])][hole]

    with pytest.warns(SearchWarning) as caught:
        result = nw.fit(shape, goal, 16, seed=1)
    assert sum("% are open" in str(warning.message) for warning in caught) == 1
    assert 0.0 < result.defects["open"] < 1.0 and not result.failures
    empty = [sample for sample in result if sample.parameters["hole"] == 2]
    assert empty and all(not len(sample.scene) and sample.covered == 0.0 for sample in empty)


def test_an_aligned_search_finds_a_mesh_in_other_units_and_axes(goal):
    def far(width=nw.Uniform(500.0, 2000.0)):
        (vertices, faces) = mesh_of(fit_hosts.tower(width / 1000, 3, True))
        return vertices[:, [0, 2, 1]] * (1000, -1000, 1000) + 4000, faces

    with pytest.warns(SearchWarning):
        lost = nw.fit(far, goal, 12, seed=1)
        near = nw.fit(far, goal, 12, seed=1, align=True)
    assert lost.best.covered == 0.0 and near.best.covered > 0.3
    assert near.best.parameters["align.up"] in ("y", "z")


@pytest.mark.parametrize(
    ("goal", "settings", "text"),
    [
        (3, {}, "`goal`"),
        ("none.obj", {}, "none.obj"),
        (nw.floor(0), {"align": True}, "`align`"),
        (nw.floor(0), {"evaluations": 0}, "`evaluations`"),
        (nw.floor(0), {"limit": float("nan")}, "`limit`"),
        (nw.floor(0), {"workers": 0}, "`workers`"),
    ],
)
def test_bad_settings_are_refused(goal, settings, text):
    with pytest.raises((InputError, FileError)) as error:
        nw.fit(fit_hosts.tower, goal, **settings)
    assert text in str(error.value)
