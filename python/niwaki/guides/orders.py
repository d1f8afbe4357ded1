"""Learning in which order futures should run, from which orders won.

The cross-entropy method (Rubinstein 1999): draw orders from normals over their numbers, search with each by the same
seeds, keep the quarter that won, fit the normals to them, and begin again. An order wins by the log of its searches'
estimates of the normalising constant. The estimate is unbiased under any order, so its log is lower the more it
scatters: the mean log is a bound that is tight where no weight is wasted. What survives inside one population is no
judge of orders, because it also rewards those that put bad news off.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from math import inf
from os import cpu_count
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki.errors import InputError
from niwaki.errors.settings import bad
from niwaki.lang.models import Model, as_model
from niwaki.methods import FutureOrder, Smc, at_least_one, smc
from niwaki.search import Search
from niwaki.search.checks import check_seed, check_threads, fresh

#: The largest number of an order that is tried; the engine refuses larger ones.
LARGEST = 50.0
#: Numbers of an order beside those of its functions.
FEATURES = ("depth", "turns", "waited", "stay")
#: The share of the orders of a round that the next one is fitted to.
WINNERS = 0.25
#: How far the first normals reach, and the least that a later one does, nats.
SPREAD, LEAST = 1.5, 0.1


#: In core form, the functions that futures call, and that of the model, which is a future too.
_CALLED = re.compile(r'\((?:future|entry) (?:[@#]\S+ )*"([^"]+)"')


@dataclass(frozen=True)
class OrderTraining:
    """What a training found.

    Attributes
    ----------
    order : FutureOrder
        The mean of the last normals; the uniform order where that did no better on seeds of its own.
    learned, uniform : float
        Mean log normalising constant of the judging searches with the learned order and with the uniform one, nats; of
        those searches that both survived.
    error : float
        Standard error of their difference, search by search.
    died : (int, int)
        Judging searches in which every particle became impossible, of each.
    rounds : tuple of FutureOrder
        The mean after each round.
    """

    order: FutureOrder
    learned: float
    uniform: float
    error: float
    died: tuple[int, int]
    rounds: tuple[FutureOrder, ...]


def train_order(
    model: Model[..., Any] | Callable[..., Any],
    searches: Sequence[Search],
    *,
    method: Smc | None = None,
    rounds: int = 6,
    orders: int = 32,
    runs: int = 4,
    judging: int = 16,
    seed: int | None = None,
    threads: int | None = None,
) -> OrderTraining:
    """Learn which future should run next.

    Parameters
    ----------
    model
        The model of the searches.
    searches
        What to be good at.
    method
        How: 100 particles at the power 1 when left out. Its own order does not matter. Ratio weights alone have a
        normalising constant.
    rounds, orders
        How many rounds, and how many orders each tries.
    runs
        How often each order makes each search in a round, by seeds that all orders of the round share.
    judging
        How often each search is made to compare the order that was learned with the uniform one, by seeds that no round
        had.
    seed
        Decides everything; fresh when left out.
    threads
        How many to use; the result does not depend on it.

    Examples
    --------
    >>> import niwaki as nw
    >>> from niwaki.guides import train_order
    >>> from niwaki.gallery.spaceship import spaceship
    >>> score = nw.match_volume(nw.targets.examples.ship(), voxel=1.0)
    >>> searches, quick = [nw.Search(spaceship, score=score)], {"rounds": 1, "orders": 4, "runs": 1, "judging": 2}
    >>> found = train_order(spaceship, searches, method=nw.smc(20), seed=1, **quick)
    >>> found.order == found.rounds[-1] or found.order == nw.methods.FutureOrder()
    True
    """
    model, seed, method = as_model(model), fresh(seed), method or smc(100)
    check_seed(seed)
    for name, value in (("rounds", rounds), ("orders", orders), ("runs", runs), ("judging", judging)):
        at_least_one(name, value)
    if not searches:
        raise bad("searches", searches, "at least one search", "`[Search(model, score=score)]`")
    if method.weights != "ratio":
        raise bad("method", method, "ratio weights, which have a normalising constant", "`smc(100)`")
    names = sorted(set(_CALLED.findall(model.core().text)))
    draw = np.random.default_rng(seed)
    mean, spread = np.zeros(len(FEATURES) + len(names)), np.full(len(FEATURES) + len(names), SPREAD)
    means: list[FutureOrder] = []
    with ThreadPoolExecutor(check_threads(threads) or cpu_count() or 1) as pool:

        def judged(tried: Sequence[FutureOrder], seeds: Sequence[int]) -> NDArray[np.float64]:
            """Log normalising constants: a row for each order, a column for each search and seed."""
            jobs = [
                replace(search, method=replace(method, order=order), seed=own)
                for order in tried
                for search in searches
                for own in seeds
            ]
            return np.array(list(pool.map(_log_normaliser, jobs))).reshape(len(tried), -1)

        for _ in range(rounds):
            numbers = np.clip(mean + spread * draw.normal(size=(orders, len(mean))), -LARGEST, LARGEST)
            found = judged([_order(own, names) for own in numbers], draw.integers(2**63, size=runs).tolist())
            # Ranks, because a search that died is as bad as can be, and one that nearly did says little about the rest.
            won = np.argsort(-_ranks(found).mean(axis=1), kind="stable")[: max(2, round(WINNERS * orders))]
            mean, spread = numbers[won].mean(axis=0), np.maximum(numbers[won].std(axis=0), LEAST)
            means.append(_order(mean, names))
        learned, uniform = judged([means[-1], FutureOrder()], draw.integers(2**63, size=judging).tolist())
    lived = np.isfinite(learned) & np.isfinite(uniform)
    died = (int(np.sum(learned == -inf)), int(np.sum(uniform == -inf)))
    by = (learned - uniform)[lived]
    error = float(np.std(by) / max(1.0, np.sqrt(len(by)))) if len(by) else inf
    is_better = died[0] <= died[1] and len(by) > 0 and by.mean() > 0
    return OrderTraining(
        order=means[-1] if is_better else FutureOrder(),
        learned=float(learned[lived].mean()) if len(by) else -inf,
        uniform=float(uniform[lived].mean()) if len(by) else -inf,
        error=error,
        died=died,
        rounds=tuple(means),
    )


def _order(numbers: NDArray[np.float64], names: Sequence[str]) -> FutureOrder:
    """The order of its numbers."""
    features = dict(zip(FEATURES, numbers.tolist(), strict=False))
    functions = dict(zip(names, numbers[len(FEATURES) :].tolist(), strict=True))
    return FutureOrder(functions, **features)


def _ranks(found: NDArray[np.float64]) -> NDArray[np.float64]:
    """The rank of each order within each column; ties share the mean of theirs."""
    below = (found[:, None, :] > found[None, :, :]).sum(axis=1)
    same = (found[:, None, :] == found[None, :, :]).sum(axis=1)
    ranks: NDArray[np.float64] = below + 0.5 * (same - 1)
    return ranks


def _log_normaliser(search: Search) -> float:
    """The estimate of a search, nats; minus infinity where every particle became impossible."""
    try:
        info: Any = search.run(threads=1).info
    except InputError as error:
        if error.code != "everything-impossible":
            raise
        return -inf
    return float(info.log_normaliser)
