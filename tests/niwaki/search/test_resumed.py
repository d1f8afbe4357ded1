"""Claim: what is told by effort resumes. A search that is killed at any moment, as often as one likes, goes on from its
checkpoint and gives the bytes of one that was left alone; a checkpoint that is damaged or of something else is refused.
"""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import time
from functools import cache
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
import resumed
from niwaki.errors import InputError
from niwaki.search.keeper import Keeper

SUBJECT = Path(resumed.__file__)

#: That trajectories diverge is no matter here.
pytestmark = pytest.mark.filterwarnings("ignore::niwaki.result.hmc.GradientWarning")


class Ended(Exception):
    """Ends a search from within, as a kill would: nothing is written any more."""


@cache
def left_alone(case: str) -> tuple[str, float]:
    """The digest of a search that is left alone, without a checkpoint, and its seconds."""
    start = time.monotonic()
    digest = resumed.digest(resumed.CASES[case]())
    return digest, time.monotonic() - start


def alone(case: str) -> str:
    """The digest of a search that is left alone."""
    return left_alone(case)[0]


def broken_off(case: str, place: Path, times: int, seed: int) -> tuple[Any, int]:
    """The result of a search that is ended at most so many times, and how often it was."""
    chance, seconds = random.Random(seed), left_alone(case)[1]
    for ended in range(times + 1):
        until = time.monotonic() + (chance.uniform(0.05, 0.5) * seconds if ended < times else 1e9)

        def watch(_: Any, until: float = until) -> None:
            if time.monotonic() > until:
                raise Ended

        try:
            kept = nw.Checkpoint(place, every=resumed.EVERY)
            return resumed.CASES[case](checkpoint=kept, progress=watch), ended
        except Ended:
            continue
    raise AssertionError("the last one is not ended")


@pytest.mark.parametrize("case", list(resumed.CASES))
def test_what_goes_on_gives_the_same_bytes(case: str, tmp_path: Path) -> None:
    result, ended = broken_off(case, tmp_path / "checkpoint", 3, 1)
    assert ended > 0
    assert resumed.digest(result) == alone(case)


def killed(case: str, place: Path, times: int, seed: int) -> tuple[str, int]:
    """The digest of a search in processes that are killed at random moments, and how often that was."""
    chance, kills, seconds = random.Random(seed), 0, left_alone(case)[1]
    mark = Path(f"{place}.begun")
    while True:
        mark.unlink(missing_ok=True)
        words = [sys.executable, str(SUBJECT), case, str(place)]
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as child:
            while kills < times and not mark.exists() and child.poll() is None:
                time.sleep(0.01)
            try:
                output, _ = child.communicate(
                    timeout=chance.uniform(0.0, 0.2) * seconds if kills < times else 300
                )
            except subprocess.TimeoutExpired:
                child.send_signal(signal.SIGKILL)
                child.wait()
                kills += 1
                continue
            assert child.returncode == 0
            return output.strip(), kills


def test_a_killed_search_goes_on(tmp_path: Path) -> None:
    output, kills = killed("improve", tmp_path / "checkpoint", 4, 2)
    assert kills > 1
    assert output == alone("improve")


@pytest.mark.soak
@pytest.mark.parametrize("case", list(resumed.CASES))
def test_a_hundred_kills(case: str, tmp_path: Path) -> None:
    seed, kills, tries = random.randrange(10**6), 0, 0
    print(f"seed {seed}")
    while kills < 100:
        output, more = killed(case, tmp_path / str(tries), 100 - kills, seed + tries)
        assert output == alone(case)
        kills, tries = kills + more, tries + 1


def test_chains_go_on_with_more(tmp_path: Path) -> None:
    place = tmp_path / "checkpoint"
    whole = resumed.chain().more(500)
    part = resumed.chain(checkpoint=place).more(300)
    del part
    result = resumed.chain(checkpoint=place).more(200)
    assert resumed.digest(result) == resumed.digest(whole)


def test_a_search_that_is_done_is_not_done_again(tmp_path: Path) -> None:
    place = tmp_path / "checkpoint"
    first = resumed.improve(checkpoint=place)
    began = time.process_time()
    again = resumed.improve(checkpoint=place)
    assert time.process_time() - began < 0.3 * first.cpu_seconds
    assert resumed.digest(again) == resumed.digest(first)
    resumed.improve(checkpoint=nw.Checkpoint(place, keep=False))
    assert not place.exists()


def test_no_seed_is_that_of_the_checkpoint(tmp_path: Path) -> None:
    @nw.model
    def one():  # type: ignore[no-untyped-def]
        return nw.gaussian(0, 1)

    first = nw.run(one, nw.mh(500), checkpoint=tmp_path / "a")
    again = nw.run(one, nw.mh(500), checkpoint=tmp_path / "a")
    assert first.seed == again.seed and resumed.digest(first) == resumed.digest(again)


def test_what_is_no_checkpoint_of_it_is_refused(tmp_path: Path, reviewed: Any) -> None:
    @nw.model
    def one(wide):  # type: ignore[no-untyped-def]
        return nw.gaussian(0, wide)

    def searched(place: Path, wide: float = 1.0, steps: int = 500, seed: int = 1) -> Any:
        return nw.run(one, wide, method=nw.mh(steps), seed=seed, checkpoint=place)

    place = tmp_path / "checkpoint"
    searched(place)
    whole = place.read_bytes()
    files = {
        "cut": whole[:-7],
        "longer": whole + b"x",
        "version": whole.replace(b"checkpoint 1", b"checkpoint 2", 1),
        "picture": b"\x89PNG\r\n" + whole,
        "empty": b"",
    }
    for name, data in files.items():
        (tmp_path / name).write_bytes(data)
        with pytest.raises(InputError) as refused:
            searched(tmp_path / name)
        assert refused.value.code == "bad-checkpoint"
    chance = random.Random(3)
    for _ in range(100):
        at = chance.randrange(len(whole) * 8)
        flipped = bytearray(whole)
        flipped[at // 8] ^= 1 << at % 8
        (tmp_path / "flipped").write_bytes(flipped)
        with pytest.raises(InputError):
            searched(tmp_path / "flipped")
    for change in ({"wide": 2.0}, {"steps": 600}, {"seed": 2}):
        with pytest.raises(InputError) as refused:
            searched(place, **change)  # type: ignore[arg-type]
        assert refused.value.code == "other-checkpoint"
    message = str(refused.value)
    assert "its `seed` was 1 and is 2" in message, message
    place.unlink()
    searched(place)


def test_keeping_a_checkpoint_costs_little(tmp_path: Path) -> None:
    """A checkpoint that takes long to write is written less often: at most a fiftieth of the time is spent on it."""
    keeper = Keeper(nw.Checkpoint(tmp_path / "checkpoint", every=2.0), "search", {})
    for cost, pause in ((0.0, 2.0), (0.5, 25.0)):
        now = time.monotonic()
        keeper.write(cost)
        assert keeper.next - now >= pause and not keeper.is_due
