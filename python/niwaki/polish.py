"""Going on from what a search found: a Markov chain that starts there.

A population is wide and short: it finds where to look, and each of its particles is built once. A chain is narrow and
long: each of its proposals changes one thing, and costs only what that touches. So one is good at starting where the
other ends.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from niwaki.errors import InputError
from niwaki.methods import Mh

if TYPE_CHECKING:
    from niwaki.mh_result import ChainResult
    from niwaki.result import Result


def polished(
    result: Result,
    method: Mh,
    seed: int | None,
    threads: int | None,
    watch: Callable[[int, int, float], None],
) -> ChainResult:
    """Chains from the best sample of a result; their time is added to that of the search."""
    from niwaki.one_search import chains_of
    from niwaki.search import check_seed, check_threads

    if not isinstance(method, Mh):
        raise InputError(
            "bad-setting",
            name="polish",
            found=repr(method),
            expected="Metropolis-Hastings",
            suggestion="`mh(20_000)`, or with a kernel `mh(20_000, kernel=kernels.drift())`",
        )
    best = result.best
    if not best.has_ended:
        raise InputError(
            "bad-setting",
            name="polish",
            found=repr(best),
            expected="a search with a run that has ended, for the chain to start from",
            suggestion="more time or particles",
        )
    known = {choice[1]: choice[3] for choice in best._trace.choices}
    first = result.seed if seed is None else check_seed(seed)
    chains = chains_of(
        result.model, best._task, method, result.score, first, check_threads(threads), watch, known
    )
    chains.seconds += result.seconds
    chains.cpu_seconds += result.cpu_seconds
    return chains
