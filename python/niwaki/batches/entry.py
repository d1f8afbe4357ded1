"""`batch`: many searches in one call, with results in the order of cases and seeds."""

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

from niwaki.batches import execution, plan, pools
from niwaki.batches.body import Outcome
from niwaki.batches.execution import Watch
from niwaki.batches.pools import Workers
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
    """Search many times: each combination of varied values with each seed, on all processors.

    Parameters
    ----------
    model
        A model, which is grown as in `niwaki.grow`; or a `Search`, or several of them, whose seeds are ignored.
    target, args, settings
        Target, arguments and settings of `niwaki.grow`, the same for all searches.
    seeds
        Number of seeds, from 0; or the seeds themselves.
    vary
        Lists of values by the name of a setting, an argument or `target`. All combinations are searched.
    folder
        Folder of the results. A stopped or killed batch resumes from its folder. Without it results are not kept.
    processes
        Number of worker processes. Default: the processors of the machine.
    executor
        Any executor of `concurrent.futures`, in place of processes of this machine. `processes` is then the number of
        its workers.
    shard
        A part of the batch, such as "3/16"; the parts may run on different machines.
    chunk
        Seconds of searches, about, that a worker gets at once.
    progress
        A function that gets a `BatchProgress` whenever results have come.

    Returns
    -------
    iterator of Outcome
        An outcome for each search, in the order of cases and seeds. Searches run while you read the iterator. A fault
        of the model is an outcome, too.

    Raises
    ------
    InputError
        The result of a search depends on a clock; the folder has another batch; a worker has another engine; or, at
        the end, searches have lost their workers three times.
    """
    if isinstance(model, Model) or (callable(model) and not isinstance(model, Search)):
        table = Table.of_grow(model, target, *args, vary=vary, **settings)
    else:
        if target is not None or args or vary or settings:
            name = next(iter([*(vary or ()), *settings]), "target")
            raise InputError(
                "unknown-setting",
                name=name,
                suggestion="change the setting in the `Search`, which has them all",
            )
        table = Table.of_searches([model] if isinstance(model, Search) else model)
    spec, part, workers = table.spec(seeds), plan.shard_of(shard), Workers(executor, processes, chunk)
    if folder is not None:
        return table.run(Store(Path(folder), spec), part, workers, progress)
    return _run_in_temporary_folder(table, spec, part, workers, progress)


def _run_in_temporary_folder(table: Table, spec: Spec, *options: Any) -> Iterator[Outcome]:
    """Yield the outcomes of a batch whose folder is removed at the end."""
    with TemporaryDirectory(prefix="niwaki-batch-") as place:
        yield from table.run(Store(Path(place), spec), *options)


@dataclass(frozen=True)
class Table:
    """Searches of a batch, without their seeds.

    Attributes
    ----------
    searches : sequence of Search
        A search for each case.
    labels : sequence of dict
        For each case, the values by name in which it differs from the others.
    """

    searches: Sequence[Search]
    labels: Sequence[Mapping[str, Any]] = field(default=())

    @classmethod
    def of_searches(cls, searches: Iterable[Search]) -> Table:
        """Return a table of searches; several searches have numbers as labels."""
        cases = list(searches)
        if not cases or not all(isinstance(case, Search) for case in cases):
            raise bad("searches", cases, "one `Search` or more", "`[Search(...), Search(...)]`")
        return cls(cases, [{"search": number} if len(cases) > 1 else {} for number in range(len(cases))])

    @classmethod
    def of_grow(cls, model: Any, target: Any, *args: Any, vary: Any = None, **settings: Any) -> Table:
        """Return a table for settings of `niwaki.grow`, some of which vary."""
        axes = _axes(vary)
        for name in axes:
            if name in settings or (name == "target" and target is not None):
                raise InputError(
                    "flags-exclude",
                    flag=name,
                    other=f"vary[{name!r}]",
                    reason="a setting either varies or is the same for all searches",
                    cure="use only one of the two",
                )
        for name in ("seed", "threads", "checkpoint"):
            if name in settings or name in axes:
                cure = "a batch has `seeds`, `processes` and `folder` instead"
                raise InputError("unknown-setting", name=name, suggestion=cure)
        if "target" in axes:
            axes["target"] = [Target.of(value) for value in axes["target"]]
        searches, labels = [], []
        for values in product(*axes.values()):
            varied = dict(zip(axes, values, strict=True))
            labels.append({name: label(value) for name, value in varied.items()})
            searches.append(
                grow_search(model, varied.pop("target", target), *args, seed=0, **settings, **varied)
            )
        return cls(searches, labels)

    def spec(self, seeds: Any) -> Spec:
        """Return the spec of the searches and seeds, for this engine and this machine."""
        _ = self.searches[0].task  # A model that does not compile fails here, and not in each worker.
        return Spec.here(map(Case.of_search, self.searches, self.labels), Seeds.of(seeds))

    def run(
        self,
        store: Store,
        shard: tuple[int, int],
        workers: Workers,
        progress: Watch | None = None,
    ) -> Iterator[Outcome]:
        """Run the searches that a store lacks; yield all outcomes in order (see `batch`)."""
        trust = tuple(sorted({name for search in self.searches for name in search.host_modules}))
        with store.writer(shard) as writer:
            left = plan.Plan(store, shard, workers.seconds, trust, _folders(trust))
            steps = execution.Execution(left, writer, workers, progress).steps()
            try:
                for job in plan.part(store.spec, shard):
                    key = store.spec.key(*job)
                    while key not in store and job not in left.lost and next(steps, self) is not self:
                        pass
                    if key in store:
                        yield self._outcome(*job, store.body(key))
            finally:
                steps.close()
            if left.lost:
                raise execution.lost(left.lost, left.total)

    def _outcome(self, case: int, seed: int, body: bytes) -> Outcome:
        return Outcome(case, self.labels[case], seed, self.searches[case].with_seed(seed), body)


def stored(folder: str | PathLike[str], trust: tuple[str, ...] = ()) -> Iterator[Outcome]:
    """Yield the results in the folder of a batch, in the order of cases and seeds.

    Parameters
    ----------
    folder
        The folder.
    trust
        Names of modules whose host functions the model may call; importing a module runs it.

    Raises
    ------
    InputError
        The folder has no batch, or a damaged batch.
    """
    return outcomes(Store(Path(folder)), trust)


def outcomes(store: Store, trust: tuple[str, ...] = ()) -> Iterator[Outcome]:
    """Yield the results of an open store, in the order of cases and seeds."""

    @cache
    def search_of(case: int) -> Search:
        return store.whole.cases[case].search(trust)

    for case, seed, body in store.present():
        yield Outcome(case, store.whole.cases[case].labels, seed, search_of(case).with_seed(seed), body)


def label(value: Any) -> Any:
    """Return a value as a label of a table."""
    if isinstance(value, Target):
        return value.name
    return value if isinstance(value, (bool, int, float, str)) or value is None else repr(value)


def _axes(vary: Any) -> dict[str, list[Any]]:
    """Return the lists of varied values by name."""
    expected, example = "a dict with a list of values for each name", '`{"particles": [100, 200]}`'
    if vary is None:
        return {}
    if not isinstance(vary, Mapping):
        raise bad("vary", vary, expected, example)
    axes: dict[str, list[Any]] = {}
    for name, values in vary.items():
        if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
            raise bad(f"vary[{name!r}]", values, "a list of values", example)
        axes[name] = list(values)
        if not axes[name]:
            raise bad(f"vary[{name!r}]", axes[name], "at least one value", example)
    return axes


def _folders(modules: tuple[str, ...]) -> tuple[str, ...]:
    """Return the folders of modules of host functions, except the package's modules and files."""
    folders = set()
    for name in {*modules} - {name for name, _ in files(modules)}:
        first = sys.modules.get(name.partition(".")[0])
        place = getattr(first, "__file__", None)
        if place is not None and not name.startswith("niwaki."):
            path = Path(place).resolve()
            folders.add(str(path.parent.parent if path.name == "__init__.py" else path.parent))
    return tuple(sorted(folders))
