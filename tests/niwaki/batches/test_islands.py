"""The populations of one search on many workers: to the bit the result of one process."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import niwaki as nw
import pytest
from batched import bump, dangerous, often_impossible, pile
from niwaki import batches, kernels
from niwaki.batches.body import body_of
from niwaki.errors import InputError, ModelFault

#: Methods whose populations differ in size, die, are tempered, annealed, moved, or sought for different results.
METHODS = {
    "of one size": nw.smc(20, populations=4),
    "of sizes that differ": nw.smc([5, 20, 5, 1]),
    "tempered": nw.smc(20, populations=4, power=3.0, resampling="tempered"),
    "with adapted powers": nw.smc(20, populations=3, anneal=0.9, ess=0.5),
    "moved": nw.smc(10, populations=3, rejuvenate=kernels.prior(), moves=2),
    "continued by chains": nw.smc(10, populations=3, rejuvenate=kernels.prior(), draws=5, chains=2),
    "that differ": nw.smc(20, diverse=3),
    "only one": nw.smc(20, diverse=1),
}


@pytest.mark.parametrize("name", METHODS)
def test_populations_anywhere_give_the_same_bits(name: str) -> None:
    with ThreadPoolExecutor(2) as threads:
        for model, seed in ((pile, 3), (bump, 5)):
            search = nw.Search(model, method=METHODS[name], seed=seed)
            assert body_of(batches.spread(search, executor=threads, processes=2)) == body_of(search.run())


def test_populations_that_died_count_as_zero() -> None:
    search = nw.Search(often_impossible, method=nw.smc([1, 1, 1, 2, 1]), seed=2)
    with ThreadPoolExecutor(2) as threads:
        result = batches.spread(search, executor=threads)
        assert 0 < result.died < 5
        assert body_of(result) == body_of(search.run())
        all_dead = nw.Search(often_impossible, method=nw.smc([1, 1]), seed=_dead())
        with pytest.raises((InputError, ModelFault), match="everything-impossible"):
            batches.spread(all_dead, executor=threads)


def _dead() -> int:
    """A seed by which two particles die."""
    for seed in range(100):
        try:
            nw.Search(often_impossible, method=nw.smc([1, 1]), seed=seed).run()
        except (InputError, ModelFault):
            return seed
    raise AssertionError("no such seed")


def test_several_runs_the_best_of_each_and_a_folder_that_goes_on(tmp_path: Path) -> None:
    """In spawned processes, as a person has it; the second time nothing is searched."""
    search = nw.Search(pile, method=nw.smc(20, populations=3), runs=2, keep="best")
    result = batches.spread(search, folder=tmp_path / "islands", processes=2)
    assert body_of(result) == body_of(search.run())
    stored = [segment.stat().st_size for segment in sorted((tmp_path / "islands").rglob("seg-*"))]
    assert stored and body_of(batches.spread(search, folder=tmp_path / "islands")) == body_of(result)
    assert [segment.stat().st_size for segment in sorted((tmp_path / "islands").rglob("seg-*"))][
        : len(stored)
    ] == stored


def test_a_fault_of_the_model_is_raised_with_its_place() -> None:
    def broken() -> float:
        x = nw.gaussian(0, 1)
        return [1, 2][5] + x  # type: ignore[no-any-return]

    search = nw.Search(nw.model(broken), method=nw.smc(5, populations=2))
    with ThreadPoolExecutor(2) as threads, pytest.raises(ModelFault, match=r"return \[1, 2\]\[5\]"):
        batches.spread(search, executor=threads)


def test_what_has_no_populations_is_refused() -> None:
    for method in (nw.importance(3), nw.smc(seconds=1.0)):
        with pytest.raises(InputError, match="smc"):
            batches.spread(nw.Search(dangerous, method=method))


def test_the_constant_is_given_at_every_power() -> None:
    """At power 1 it is the evidence; at another there is no evidence."""
    plain = nw.Search(bump, method=nw.smc(50)).run()
    assert plain.log_normaliser == plain.log_evidence
    sharp = nw.Search(bump, method=nw.smc(4000, power=4.0)).run()
    assert sharp.log_evidence is None
    # A Gaussian by exp(-4 (x - 1)^2): 1 / sqrt(1 + 8) exp(-4 / 9).
    assert sharp.log_normaliser == pytest.approx(-0.5 * 2.1972245773 - 4 / 9, abs=0.1)
