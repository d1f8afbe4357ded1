"""Training of the order in which futures run.

The cross-entropy method (Rubinstein 1999): draw orders from normals over their numbers, search with each order and the
same seeds, keep the best quarter, fit the normals to it, and repeat. An order is ranked by the logs of its searches'
estimates of the normalising constant. The estimate is unbiased under any order, so its log is lower the more it
scatters: the mean log is a bound that is tight where no weight is wasted. Survival inside one population does not rank
orders, because it also rewards orders that put off bad news.
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
#: Numbers of an order, beside the numbers of its functions.
FEATURES = ("depth", "turns", "waited", "stay")
#: The share of a round's orders to which the next normals are fitted.
WINNERS = 0.25
#: Standard deviation of the first normals, and the least of later normals, in nats.
SPREAD, LEAST = 1.5, 0.1


#: In core form, the functions that futures call, and the model's own function, which is also a future.
_FUTURES = re.compile(r'\((?:future|entry) (?:[@#]\S+ )*"([^"]+)"')


@dataclass(frozen=True)
class OrderTraining:
    """The result of a training of orders.

    Attributes
    ----------
    order : FutureOrder
        The mean of the last normals; the uniform order if the mean is no better on fresh seeds.
    learned, uniform : float
        Mean log normalising constant of the judging searches with the learned order and with the uniform order, in
        nats, over the searches that both survived.
    error : float
        Standard error of the difference, search by search.
    died : (int, int)
        Number of judging searches in which all particles became impossible, for each of the two orders.
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
    """Train an order of futures.

    Parameters
    ----------
    model
        The model of the searches.
    searches
        Searches for which the order is trained.
    method
        Method of the searches. Default: 100 particles at the power 1. It needs ratio weights, which have a normalising
        constant; its order is ignored.
    rounds, orders
        Number of rounds, and of orders in each round.
    runs
        Number of runs of each search with each order in a round; all orders of a round share the seeds.
    judging
        Number of runs of each search that compare the learned order with the uniform order, with fresh seeds.
    seed
        Seed of the training. Default: a new seed.
    threads
        Number of threads; the result does not depend on it.

    Examples
    --------
    >>> import niwaki as nw
    >>> from niwaki.guides import train_order
    >>> from niwaki.gallery.spaceship import spaceship
    >>> score = nw.match_volume(nw.targets.examples.ship(), voxel=1.0)
    >>> searches, quick = [nw.Search(spaceship, score=score)], {"rounds": 1, "orders": 4, "runs": 1, "judging": 2}
    >>> trained = train_order(spaceship, searches, method=nw.smc(20), seed=1, **quick)
    >>> trained.order == trained.rounds[-1] or trained.order == nw.methods.FutureOrder()
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
    names = sorted(set(_FUTURES.findall(model.core().text)))
    draw = np.random.default_rng(seed)
    mean, spread = np.zeros(len(FEATURES) + len(names)), np.full(len(FEATURES) + len(names), SPREAD)
    means: list[FutureOrder] = []
    with ThreadPoolExecutor(check_threads(threads) or cpu_count() or 1) as pool:

        def judge(candidates: Sequence[FutureOrder], seeds: Sequence[int]) -> NDArray[np.float64]:
            """Return log normalising constants: a row for each order, a column for each search and seed."""
            jobs = [
                replace(search, method=replace(method, order=order), seed=shared_seed)
                for order in candidates
                for search in searches
                for shared_seed in seeds
            ]
            return np.array(list(pool.map(_log_normaliser, jobs))).reshape(len(candidates), -1)

        for _ in range(rounds):
            numbers = np.clip(mean + spread * draw.normal(size=(orders, len(mean))), -LARGEST, LARGEST)
            logs = judge([_order(row, names) for row in numbers], draw.integers(2**63, size=runs).tolist())
            # Ranks are robust: a search that died has minus infinity, and a search that nearly died an outlier.
            best = np.argsort(-_ranks(logs).mean(axis=1), kind="stable")[: max(2, round(WINNERS * orders))]
            mean, spread = numbers[best].mean(axis=0), np.maximum(numbers[best].std(axis=0), LEAST)
            means.append(_order(mean, names))
        learned, uniform = judge([means[-1], FutureOrder()], draw.integers(2**63, size=judging).tolist())
    survived = np.isfinite(learned) & np.isfinite(uniform)
    died = (int(np.sum(learned == -inf)), int(np.sum(uniform == -inf)))
    differences = (learned - uniform)[survived]
    error = float(np.std(differences) / max(1.0, np.sqrt(len(differences)))) if len(differences) else inf
    is_better = died[0] <= died[1] and len(differences) > 0 and differences.mean() > 0
    return OrderTraining(
        order=means[-1] if is_better else FutureOrder(),
        learned=float(learned[survived].mean()) if len(differences) else -inf,
        uniform=float(uniform[survived].mean()) if len(differences) else -inf,
        error=error,
        died=died,
        rounds=tuple(means),
    )


def _order(numbers: NDArray[np.float64], names: Sequence[str]) -> FutureOrder:
    """Return the order with these numbers."""
    features = dict(zip(FEATURES, numbers.tolist(), strict=False))
    functions = dict(zip(names, numbers[len(FEATURES) :].tolist(), strict=True))
    return FutureOrder(functions, **features)


def _ranks(logs: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the rank of each order within each column; ties share their mean rank."""
    below = (logs[:, None, :] > logs[None, :, :]).sum(axis=1)
    equal = (logs[:, None, :] == logs[None, :, :]).sum(axis=1)
    ranks: NDArray[np.float64] = below + 0.5 * (equal - 1)
    return ranks


def _log_normaliser(search: Search) -> float:
    """Return the log normalising constant of a search, in nats; minus infinity if all particles became impossible."""
    try:
        info: Any = search.run(threads=1).info
    except InputError as error:
        if error.code != "everything-impossible":
            raise
        return -inf
    return float(info.log_normaliser)
