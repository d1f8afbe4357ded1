"""Claims: a batch gives the same bytes however it is computed; what is done is not done again; a fault is a result;
what would give other results is refused.

Most searches here run in a thread, which is an executor as any other; pools of processes are in `test_lost.py`.
"""

from __future__ import annotations

import json
import shutil
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import batched
import niwaki as nw
import pytest
from niwaki import batches
from niwaki.batches import segments, worker
from niwaki.batches.plan import MOST, shard_of
from niwaki.batches.spec import Case, Spec
from niwaki.errors import FileError, InputError
from niwaki.shell.references import find


@pytest.fixture
def thread() -> Iterator[ThreadPoolExecutor]:
    with ThreadPoolExecutor(1) as executor:
        yield executor


def logged(folder: Path) -> Counter[str]:
    """How often the logs name each key."""
    lines = [line for log in folder.glob("*/log-*") for line in log.read_text().splitlines()]
    return Counter(json.loads(line)["key"] for line in lines)


def scores(outcomes: Any) -> list[tuple[int, int, float]]:
    return [(outcome.case, outcome.seed, outcome.best.log_score) for outcome in outcomes]


def test_outcomes_are_those_of_the_searches_alone_and_in_order(thread: ThreadPoolExecutor) -> None:
    outcomes = list(nw.batch(batched.PILES, seeds=[7, 3], executor=thread))
    alone = [
        (case, seed, search.with_seed(seed).run().best)
        for case, search in enumerate(batched.PILES)
        for seed in (3, 7)
    ]
    assert scores(outcomes) == [(case, seed, best.log_score) for case, seed, best in alone]
    assert [outcome.best.choices for outcome in outcomes] == [best.choices for _, _, best in alone]
    assert [outcome.labels for outcome in outcomes] == [{"search": 0}] * 2 + [{"search": 1}] * 2


def test_one_worker_a_pool_and_shards_give_one_hash(tmp_path: Path, thread: ThreadPoolExecutor) -> None:
    expected = scores(nw.batch(batched.PILES, seeds=batched.SEEDS, folder=tmp_path / "one", executor=thread))
    pool = nw.batch(batched.PILES, seeds=batched.SEEDS, folder=tmp_path / "pool", processes=2)
    assert scores(pool) == expected and len(expected) == batched.COUNT
    parts = []
    for part in (3, 1, 2):
        folder = tmp_path / f"part-{part}"
        done = nw.batch(batched.PILES, seeds=batched.SEEDS, folder=folder, shard=f"{part}/3", executor=thread)
        parts += scores(done)
        shutil.copytree(folder, tmp_path / "united", dirs_exist_ok=True)
    assert sorted(parts) == expected
    hashes = {batched.whole(tmp_path / name) for name in ("one", "pool", "united")}
    assert len(hashes) == 1
    assert scores(batches.stored(tmp_path / "united")) == expected


def test_what_is_there_is_not_done_again(tmp_path: Path, thread: ThreadPoolExecutor) -> None:
    first_run = nw.batch(batched.PILES, seeds=batched.SEEDS, folder=tmp_path, executor=thread, chunk=0.0)
    for _ in range(20):
        next(first_run)
    first_run.close()
    assert batched.COUNT > len(logged(tmp_path)) >= 20
    outcomes = list(nw.batch(batched.PILES, seeds=batched.SEEDS, folder=tmp_path, executor=thread))
    assert len(outcomes) == batched.COUNT and set(logged(tmp_path).values()) == {1}
    # More seeds of the same cases go to the same folder.
    list(nw.batch(batched.PILES, seeds=range(20, 40), folder=tmp_path, executor=thread))
    assert len(batches.Store(tmp_path).whole) == len(batches.Store(tmp_path)) == 80
    assert set(logged(tmp_path).values()) == {1}


def test_a_tail_that_was_cut_costs_what_it_held(tmp_path: Path, thread: ThreadPoolExecutor) -> None:
    def all_of_it() -> str:
        list(nw.batch(batched.PILES, seeds=batched.SEEDS, folder=tmp_path, executor=thread))
        return batched.whole(tmp_path)

    expected = all_of_it()
    (segment,) = tmp_path.glob("*/seg-*")
    held = [(at, at + length) for _, at, length in segments.records(segment)]
    cut = segment.stat().st_size - 700
    segment.write_bytes(segment.read_bytes()[:cut])
    lost = sum(end > cut for _, end in held)
    assert all_of_it() == expected
    assert sorted(logged(tmp_path).values()) == [1] * (batched.COUNT - lost) + [2] * lost


def test_unequal_results_of_one_search_are_an_error(tmp_path: Path, thread: ThreadPoolExecutor) -> None:
    list(nw.batch(batched.PILES, seeds=2, folder=tmp_path, executor=thread))
    (first,) = tmp_path.glob("*/seg-*")
    key = next(iter(segments.records(first)))[0]
    # The same again is nothing; another body is an error.
    (tmp_path / "1-of-1" / "seg-same").write_bytes(first.read_bytes())
    assert len(batches.Store(tmp_path)) == 4
    (tmp_path / "1-of-1" / "seg-wrong").write_bytes(segments.record(key, b"{}"))
    with pytest.raises(InputError, match="unequal-results"):
        batches.Store(tmp_path)


#: Every ninth bit is one bit of each byte, and each of the eight in turn.
EVERY_BYTE = pytest.mark.parametrize("stride", [9, pytest.param(1, marks=pytest.mark.soak)])


@EVERY_BYTE
def test_a_spec_with_any_bit_changed_is_refused(
    tmp_path: Path, thread: ThreadPoolExecutor, stride: int
) -> None:
    list(nw.batch(batched.PILES, seeds=2, folder=tmp_path, executor=thread))
    (spec,) = tmp_path.glob("spec-*.json")
    whole = spec.read_bytes()
    for bit in range(0, 8 * len(whole), stride):
        changed = bytearray(whole)
        changed[bit // 8] ^= 1 << bit % 8
        with pytest.raises(InputError, match="bad-batch"):
            Spec.of_file(bytes(changed), spec)
    spec.write_bytes(whole.replace(b"0.", b"1.", 1))
    for reads in (
        lambda: list(batches.stored(tmp_path)),
        lambda: list(nw.batch(batched.PILES, seeds=3, folder=tmp_path, executor=thread)),
    ):
        with pytest.raises(InputError, match="its bytes do not have the hash"):
            reads()


@EVERY_BYTE
def test_a_result_with_any_bit_changed_is_none(
    tmp_path: Path, thread: ThreadPoolExecutor, stride: int
) -> None:
    list(nw.batch(batched.PILES, seeds=1, folder=tmp_path, executor=thread))
    before = list(batches.Store(tmp_path).present())
    (segment,) = tmp_path.glob("*/seg-*")
    whole = segment.read_bytes()
    for bit in range(0, 8 * len(whole), stride):
        changed = bytearray(whole)
        changed[bit // 8] ^= 1 << bit % 8
        segment.write_bytes(changed)
        after = list(batches.Store(tmp_path).present())
        assert len(after) == 1 and after[0] in before


def test_a_case_with_the_search_of_another_is_refused(tmp_path: Path, thread: ThreadPoolExecutor) -> None:
    list(nw.batch(batched.PILES, seeds=2, folder=tmp_path, executor=thread))
    (spec,) = tmp_path.glob("spec-*.json")
    data = json.loads(spec.read_bytes())
    first, second = data["cases"]
    first["search"], second["search"] = second["search"], first["search"]
    text = json.dumps(data).encode()
    spec.unlink()
    (tmp_path / Spec.name_of(text)).write_bytes(text)
    # Its scores would stand beside scenes that have others.
    with pytest.raises(InputError, match="its results belong to the search"):
        list(batches.stored(tmp_path))


def test_a_spec_is_written_once(tmp_path: Path, thread: ThreadPoolExecutor) -> None:
    for seeds in (2, 2, 3, 2):
        list(nw.batch(batched.PILES, seeds=seeds, folder=tmp_path, executor=thread))
    assert len(list(tmp_path.glob("spec-*.json"))) == 2
    # Other places of the same source are another text of the same searches.
    moved = [Case(case.labels, case.hash, {}, case.data) for case in batches.Store(tmp_path).spec.cases]
    with batches.Store(tmp_path, batches.Spec.here(moved, batches.Seeds.of(3))).writer():
        assert len(list(tmp_path.glob("spec-*.json"))) == 2


def test_a_fault_is_the_result_of_its_search(tmp_path: Path, thread: ThreadPoolExecutor) -> None:
    search = nw.Search(batched.often_impossible, method=nw.smc(1))
    outcomes = list(nw.batch(search, seeds=20, folder=tmp_path, executor=thread))
    failed = [outcome for outcome in outcomes if outcome.fault is not None]
    assert 0 < len(failed) < 20
    assert {outcome.fault for outcome in failed} == {"everything-impossible"}
    with pytest.raises(InputError, match="search-failed"):
        _ = failed[0].result
    (log,) = tmp_path.glob("*/log-*")
    errors = [json.loads(line) for line in log.read_text().splitlines() if "error" in json.loads(line)]
    assert len(errors) == len(failed) and "= help:" in errors[0]["error"]
    # The first line is stored, which names no file, so that it is the same in every checkout.
    assert {outcome.message for outcome in failed} == {"every run of the search is impossible"}
    assert __file__ not in (tmp_path / "1-of-1").joinpath(next(tmp_path.glob("*/seg-*")).name).read_text(
        "latin-1"
    )


@pytest.mark.filterwarnings("ignore::niwaki.result.hmc.GradientWarning")
@pytest.mark.parametrize(
    "method", [nw.mh(30, chains=2), nw.nuts(5), nw.smc(5), nw.importance(4)], ids=lambda method: method.NAME
)
def test_results_of_every_kind_come_back(method: Any, thread: ThreadPoolExecutor) -> None:
    search = nw.Search(batched.bump, method=method)
    (outcome,) = nw.batch(search, seeds=[5], executor=thread)
    result = search.with_seed(5).run()
    assert [sample.log_joint for sample in outcome.result] == [sample.log_joint for sample in result]
    assert outcome.result.sizes == result.sizes and outcome.best.choices == result.best.choices


def test_a_distribution_comes_back(thread: ThreadPoolExecutor) -> None:
    search = nw.Search(batched.often_impossible, method=nw.enumerate_all())
    (outcome,) = nw.batch(search, executor=thread)
    assert outcome.result.distribution() == search.run().distribution() == {1: 1.0}


def test_settings_vary(thread: ThreadPoolExecutor) -> None:
    outcomes = list(
        nw.batch(
            batched.pile,
            nw.targets.examples.ship(),
            voxel=1.0,
            vary={"particles": [5, 9], "width": [1.0, 2.0]},
            executor=thread,
        )
    )
    assert [outcome.labels for outcome in outcomes] == [
        {"particles": p, "width": w} for p in (5, 9) for w in (1.0, 2.0)
    ]
    assert [outcome.search.method.particles for outcome in outcomes] == [5, 5, 9, 9]
    assert [outcome.search.args[1] for outcome in outcomes] == [1.0, 2.0, 1.0, 2.0]


def test_what_cannot_be_a_batch_is_refused(reviewed: Any, tmp_path: Path, thread: ThreadPoolExecutor) -> None:
    def tried(*args: Any, **settings: Any) -> Any:
        # At once, and not when the first result is read.
        return lambda: nw.batch(*args, executor=thread, **settings)

    target, pile = nw.targets.examples.ship(), batched.pile
    list(nw.batch(batched.PILES, folder=tmp_path / "there", executor=thread))
    failing = {
        "a clock that decides": tried(pile, target, seconds=1.0),
        "several runs": tried(pile, target, runs=2),
        "a seed": tried(pile, target, seed=3),
        "no seeds": tried(batched.PILES, seeds=[]),
        "a negative seed": tried(batched.PILES, seeds=[-1]),
        "text as seeds": tried(batched.PILES, seeds="all"),
        "a name that is fixed and varies": tried(pile, target, width=1.0, vary={"width": [1.0]}),
        "nothing to vary": tried(pile, target, vary={"width": []}),
        "one value to vary": tried(pile, target, vary={"width": 2.0}),
        "no searches": tried([]),
        "settings beside searches": tried(batched.PILES, vary={"width": [1.0]}),
        "a part that is none": tried(batched.PILES, shard="3 of 16"),
        "a part beyond the last": tried(batched.PILES, shard=(4, 3)),
        "a folder without a batch": lambda: list(batches.stored("tests/golden")),
    }
    reviewed(Path(__file__).with_name("refused.txt"), failing)
    with pytest.raises(InputError, match="it has 2 cases, and this batch 1"):
        list(nw.batch(batched.PILES[:1], folder=tmp_path / "there", executor=thread))
    with pytest.raises(InputError, match="in case 1 its `args` differs"):
        other = nw.Search(pile, (0.0, 2.5), method=nw.smc(20), keep="best")
        list(nw.batch([batched.PILES[0], other], folder=tmp_path / "there", executor=thread))


def test_another_engine_and_other_bits_are_refused(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, thread: ThreadPoolExecutor
) -> None:
    list(nw.batch(batched.PILES, folder=tmp_path, executor=thread))
    for name, place in (("engine_hash", worker), ("fingerprint", worker._engine)):
        with monkeypatch.context() as changed:
            changed.setattr(place, name, lambda: "0" * 32)
            if name == "engine_hash":
                with pytest.raises(InputError, match="worker-differs"):
                    list(nw.batch(batched.PILES, seeds=2, folder=tmp_path, executor=thread))
            else:
                with pytest.raises(InputError, match="a machine that computes other bits"):
                    list(nw.batch(batched.PILES, seeds=2, folder=tmp_path, executor=thread))
    assert len(batches.Store(tmp_path)) == 2


HOSTS = """
from niwaki import box, emit, factor, host, model, uniform

@host
def judged(x):
    return -x

SIZE = 1.0
BLOCK = box((0, 0, 0), (SIZE, 1, 1))

@model
def tower():
    factor(judged(uniform(0.0, 1.0)))
    emit(BLOCK)
"""


def test_whatever_decides_a_result_changes_its_key(tmp_path: Path) -> None:
    def key(name: str, text: str, target: Any) -> bytes:
        (tmp_path / f"{name}.py").write_text(text)
        score = nw.match_volume(target, 1.0)
        search = nw.Search(find(f"{tmp_path / name}.py:tower").model, score=score)
        return batches.Spec.here([Case.of_search(search, {})], batches.Seeds.of(1)).key(0, 0)

    ship, other = nw.targets.examples.ship(), nw.targets.examples.dart()
    plain = key("keyed", HOSTS, ship)
    assert key("keyed", "# A comment.\n" + HOSTS, ship) == plain
    variants = [
        key("keyed", HOSTS.replace("return -x", "return -2 * x"), ship),
        key("keyed", HOSTS.replace("SIZE = 1.0", "SIZE = 1.5"), ship),
        key("keyed", HOSTS, other),
    ]
    assert len({plain, *variants}) == 4


def test_one_run_at_a_time_has_a_part_of_a_folder(tmp_path: Path, thread: ThreadPoolExecutor) -> None:
    first_run = nw.batch(batched.PILES, seeds=2, folder=tmp_path, executor=thread)
    next(first_run)
    with pytest.raises(FileError, match="folder-in-use"):
        next(nw.batch(batched.PILES, seeds=2, folder=tmp_path, executor=thread))
    assert len(list(nw.batch(batched.PILES, seeds=2, folder=tmp_path, shard="1/2", executor=thread))) == 2
    assert len(list(first_run)) == 3 and len(batches.Store(tmp_path)) == 4


def test_seeds_are_ranges() -> None:
    assert batches.Seeds.of([5, 3, 4, 9]).ranges == [(3, 3), (9, 1)]
    assert list(batches.Seeds.of(range(2, 5))) == [2, 3, 4]
    assert batches.Seeds.of(10).united(batches.Seeds.of(range(5, 20))).ranges == [(0, 20)]
    assert [batches.Seeds.of([1, 5])[n] for n in (0, 1)] == [1, 5]
    assert shard_of("3/16") == (3, 16) and MOST > 1
