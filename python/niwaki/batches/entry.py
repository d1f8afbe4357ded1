"""`batch`: many searches as one call, whose results come in the order of the table."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from functools import cache
from itertools import product
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from niwaki.batches import plan, pools, running
from niwaki.batches.body import Outcome
from niwaki.batches.pools import Workers
from niwaki.batches.running import Watch
from niwaki.batches.spec import Case, Seeds, Spec
from niwaki.batches.store import Store
from niwaki.errors import InputError
from niwaki.errors.settings import bad
from niwaki.inputs.modules import files
from niwaki.lang.models import Model
from niwaki.search import Search, grow_search
from niwaki.targets.target import Target


def batch(
    model: Model[..., Any] | Callable[..., Any] | Search | Iterable[Search],
    target: Target | str | PathLike[str] | None = None,
    *args: Any,
    seeds: int | Iterable[int] = 1,
    vary: Mapping[str, Sequence[Any]] | None = None,
    folder: str | PathLike[str] | None = None,
    processes: int | None = None,
    executor: Executor | None = None,
    shard: str | tuple[int, int] | None = None,
    chunk: float = pools.TARGET,
    progress: Watch | None = None,
    **settings: Any,
) -> Iterator[Outcome]:
    """Search many times: each combination of what varies, by each seed, on all processors.

    Parameters
    ----------
    model
        A model, which is grown as by `niwaki.grow`; or a `Search`, or several, whose seeds do not matter.
    target, args, settings
        As for `niwaki.grow`, the same for all searches.
    seeds
        How many seeds, from 0; or the seeds.
    vary
        Values of these settings, arguments or targets by name: each is combined with each of the others.
    folder
        Where results are stored. A batch that was stopped or killed goes on from its folder. Results are not kept when
        it is left out.
    processes
        How many; as many as the machine has processors when left out.
    executor
        Where searches run, instead of processes of this machine: any executor of `concurrent.futures`. Name its workers
        with `processes`.
    shard
        One part of the batch, such as "3/16"; the parts may run on different machines.
    chunk
        About so many seconds of searches are given to a worker at once.
    progress
        Called with a `Standing` whenever results came.

    Returns
    -------
    iterator of Outcome
        One for each search, in the order of cases and seeds; they are searched while it is read. A model's fault is an
        outcome, too.

    Raises
    ------
    InputError
        A clock would decide a result; the folder holds another batch; a worker has another engine; or, at the end,
        some searches lost their workers three times.
    """
    if isinstance(model, Model) or (callable(model) and not isinstance(model, Search)):
        table = Table.of_grow(model, target, *args, vary=vary, **settings)
    else:
        if target is not None or args or vary or settings:
            found = next(iter([*(vary or ()), *settings]), "target")
            raise InputError(
                "unknown-setting", name=found, suggestion="a `Search` has all its settings: change it there"
            )
        table = Table.of_searches([model] if isinstance(model, Search) else model)
    spec, part, workers = table.spec(seeds), plan.shard_of(shard), Workers(executor, processes, chunk)
    if folder is not None:
        return table.run(Store(Path(folder), spec), part, workers, progress)
    return _kept_nowhere(table, spec, part, workers, progress)


def _kept_nowhere(table: Table, spec: Spec, *given: Any) -> Iterator[Outcome]:
    """The outcomes of a batch, in a folder that goes with them."""
    with TemporaryDirectory(prefix="niwaki-batch-") as place:
        yield from table.run(Store(Path(place), spec), *given)


@dataclass(frozen=True)
class Table:
    """Searches of a batch, without their seeds.

    Attributes
    ----------
    searches : sequence of Search
        One for each case.
    labels : sequence of dict
        The values in which each differs from the others, by name.
    """

    searches: Sequence[Search]
    labels: Sequence[Mapping[str, Any]] = field(default=())

    @classmethod
    def of_searches(cls, searches: Iterable[Search]) -> Table:
        """Of searches, which are numbered."""
        found = list(searches)
        if not found or not all(isinstance(one, Search) for one in found):
            raise bad("searches", found, "one `Search` or more", "`[Search(...), Search(...)]`")
        return cls(found, [{"search": number} if len(found) > 1 else {} for number in range(len(found))])

    @classmethod
    def of_grow(cls, model: Any, target: Any, *args: Any, vary: Any = None, **settings: Any) -> Table:
        """Of the settings of `niwaki.grow`, some of which vary."""
        axes = _axes(vary)
        for name in axes:
            if name in settings or (name == "target" and target is not None):
                raise InputError(
                    "flags-exclude",
                    flag=name,
                    other=f"vary[{name!r}]",
                    reason="a setting is the same for all searches, or varies",
                    cure="leave one of them out",
                )
        for name in ("seed", "threads", "checkpoint"):
            if name in settings or name in axes:
                cure = "a batch has `seeds`, `processes` and `folder` instead"
                raise InputError("unknown-setting", name=name, suggestion=cure)
        if "target" in axes:
            axes["target"] = [Target.of(one) for one in axes["target"]]
        searches, labels = [], []
        for values in product(*axes.values()):
            own = dict(zip(axes, values, strict=True))
            labels.append({name: label(value) for name, value in own.items()})
            searches.append(grow_search(model, own.pop("target", target), *args, seed=0, **settings, **own))
        return cls(searches, labels)

    def spec(self, seeds: Any) -> Spec:
        """The searches with seeds, as for `batch`, for this engine and this machine."""
        _ = self.searches[0].task  # A model that does not compile fails here, and not in each worker.
        return Spec.here(map(Case.of_search, self.searches, self.labels), Seeds.of(seeds))

    def run(
        self,
        store: Store,
        shard: tuple[int, int],
        workers: Workers,
        progress: Watch | None = None,
    ) -> Iterator[Outcome]:
        """Search what a store lacks; the outcomes in order, as for `batch`."""
        trust = tuple(sorted({name for search in self.searches for name in search.host_modules}))
        with store.held(shard) as own:
            left = plan.Plan(store, shard, workers.seconds, trust, _folders(trust))
            steps = running.Running(left, own, workers, progress).steps()
            try:
                for item in plan.part(store.spec, shard):
                    key = store.spec.key(*item)
                    while key not in store and item not in left.lost and next(steps, self) is not self:
                        pass
                    if key in store:
                        yield self._outcome(*item, store.body(key))
            finally:
                steps.close()
            if left.lost:
                raise running.lost(left.lost, left.total)

    def _outcome(self, case: int, seed: int, body: bytes) -> Outcome:
        return Outcome(case, self.labels[case], seed, self.searches[case].with_seed(seed), body)


def stored(folder: str | PathLike[str], trust: tuple[str, ...] = ()) -> Iterator[Outcome]:
    """The results that a batch has in its folder, in the order of cases and seeds.

    Parameters
    ----------
    folder
        The folder.
    trust
        Names of modules whose host functions the model may call; importing a module runs it.

    Raises
    ------
    InputError
        The folder holds no batch, or one that is damaged.
    """
    return outcomes(Store(Path(folder)), trust)


def outcomes(store: Store, trust: tuple[str, ...] = ()) -> Iterator[Outcome]:
    """The same, of a store that is open."""

    @cache
    def searched(case: int) -> Search:
        return store.whole.cases[case].search(trust)

    for case, seed, body in store.present():
        yield Outcome(case, store.whole.cases[case].labels, seed, searched(case).with_seed(seed), body)


def label(value: Any) -> Any:
    """A value as a table names it."""
    if isinstance(value, Target):
        return value.name
    return value if isinstance(value, (bool, int, float, str)) or value is None else repr(value)


def _axes(vary: Any) -> dict[str, list[Any]]:
    """What varies, by name."""
    expected, example = "a dict with a list of values for each name", '`{"particles": [100, 200]}`'
    if vary is None:
        return {}
    if not isinstance(vary, Mapping):
        raise bad("vary", vary, expected, example)
    found: dict[str, list[Any]] = {}
    for name, values in vary.items():
        if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
            raise bad(f"vary[{name!r}]", values, "a list of values", example)
        found[name] = list(values)
        if not found[name]:
            raise bad(f"vary[{name!r}]", found[name], "at least one value", example)
    return found


def _folders(modules: tuple[str, ...]) -> tuple[str, ...]:
    """Where the modules of host functions are found, but for our own and for files."""
    found = set()
    for name in {*modules} - {name for name, _ in files(modules)}:
        first = sys.modules.get(name.partition(".")[0])
        place = getattr(first, "__file__", None)
        if place is not None and not name.startswith("niwaki."):
            own = Path(place).resolve()
            found.add(str(own.parent.parent if own.name == "__init__.py" else own.parent))
    return tuple(sorted(found))
