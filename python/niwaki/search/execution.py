"""Execution of a search: its runs one after the other, resumed from a checkpoint, polished, and with warnings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import astuple, dataclass, field
from math import exp
from typing import Any

from msgspec import Struct

from niwaki.errors import InputError, ModelFault
from niwaki.errors.memory import check_room
from niwaki.errors.schema import Unfit, fitted
from niwaki.errors.warned import warn
from niwaki.lang.compiled import translated
from niwaki.methods import Forward, Guide
from niwaki.methods.room import RUN
from niwaki.result import Result, Sample
from niwaki.result.chains import MhInfo
from niwaki.result.drawn import DrawnInfo
from niwaki.result.info import Info, restored_info, stored_info, without_evidence
from niwaki.result.invalid import Invalid, merged
from niwaki.result.progress import EngineWatch, Watch, watcher
from niwaki.result.search_like import SearchLike
from niwaki.search.checkpoint import Checkpoint, reading
from niwaki.search.engine_runs import has_start, polish, replay_choices, run_once
from niwaki.search.keeper import Keeper, Stage
from niwaki.search.warnings import SearchWarning, check_best, check_observations

#: The most differences between a guide and a model that a warning lists.
SHOWN = 6

#: Weights collapse if this many samples or more have fewer effective samples than this.
MANY, COLLAPSED = 20, 2.0


#: Function that makes one run of a search, with one seed: on the engine here, or elsewhere.
Runner = Callable[[SearchLike, int, int | None, EngineWatch, Stage | None], Result]


class StoredResult(Struct):
    """Result of a run in a checkpoint: samples as data with their seconds, and the other fields of a `Result`."""

    samples: list[tuple[str, float, float]]
    info: dict[str, Any] | None
    invalid: list[tuple[str, str, int, int, str, str]]
    seconds: tuple[float, float]


def keeper(search: SearchLike, checkpoint: Checkpoint) -> Keeper:
    """Open the checkpoint of a search.

    Raises
    ------
    InputError
        The file is the checkpoint of another search.
    """
    return Keeper(checkpoint, "search", search.about, search.data())


def execute(
    search: SearchLike,
    threads: int | None,
    progress: Watch | None,
    keeper: Keeper | None = None,
    runner: Runner = run_once,
) -> Result:
    """Execute the runs of a search, each by `runner`.

    With a `keeper` the search resumes from its checkpoint. A checkpoint has a stage for each run and each polishing,
    and the results of finished runs.

    Runs in which every particle became impossible are left out with a warning. They are an error if no run is left.
    """
    if search.choices is not None and not has_start(search.method):
        return replay_choices(search)
    guides = _guides(search)
    if search.runs == 1 and search.keep == "all" and search.polish is None:
        result = runner(search, search.seed, threads, watcher(progress, search), _stage(keeper, "0/search"))
        if guides:
            _check_weights(result)
        if keeper is not None:
            keeper.finish(result.interrupted)
        return result
    runs = _Runs(search, threads, progress, keeper, runner)
    for number in range(search.runs):
        try:
            runs.add(number)
        except KeyboardInterrupt:
            # Ctrl-C between two checks of the engine, or while a result is stored.
            if not runs.samples:
                raise
            runs.interrupted = True
        if runs.interrupted:
            break
    return runs.result()


@dataclass
class _Runs:
    """The runs of a search, and their results so far."""

    search: SearchLike
    threads: int | None
    progress: Watch | None
    keeper: Keeper | None
    runner: Runner
    samples: list[Sample] = field(default_factory=list)
    failed: list[InputError | ModelFault] = field(default_factory=list)
    invalid: tuple[Invalid, ...] = ()
    spent: tuple[float, float] = (0.0, 0.0)
    interrupted: bool = False
    #: Statistics of the last run, without evidence, which stand for all runs; runs of chains have none.
    info: Info = field(default_factory=Info)

    def add(self, number: int) -> None:
        """Search a run or read it from the checkpoint, polish it, and add its samples."""
        watch = watcher(self.progress, self.search, number, self.search.runs)
        try:
            stage, result = self._run(number, watch)
        except (InputError, ModelFault) as error:
            if error.code != "everything-impossible" and not error.values.get("invalid"):
                raise
            self.failed.append(error)
            return
        if not isinstance(result.info, MhInfo | DrawnInfo):
            self.info = without_evidence(result.info)
        self._record(result)
        if self.interrupted and self.samples and not any(sample.has_ended for sample in result):
            self._spend(result)
            return
        if self.search.polish is not None and not self.interrupted and stage != "done":
            result = self._polish(number, stage, result, watch)
        self._spend(result)
        is_whole = getattr(self.search.method, "diverse", None) is not None or self.search.keep == "all"
        samples = list(result.samples) if is_whole else [result.best]
        self.samples.extend(samples)
        if not self.interrupted and stage != "done":
            _store(self.keeper, f"{number}/done", result, samples, self.info)

    def _spend(self, result: Result) -> None:
        """Add the wall and processor time of a run."""
        self.spent = self.spent[0] + result.seconds, self.spent[1] + result.cpu_seconds

    def result(self) -> Result:
        """The result of all runs together."""
        if self.failed and not self.samples:
            raise self.failed[0]
        if self.failed:
            warn(
                f"{len(self.failed)} of {self.search.runs} runs became impossible and are left out"
                f"{_cause(self.failed[0])}",
                SearchWarning,
            )
        if self.search.score.asks and self.search.keep == "best":
            best = max(self.samples, key=lambda sample: sample.log_score)
            check_best(self.search.task, self.search.score, best)
        if self.keeper is not None:
            self.keeper.finish(self.interrupted)
        return Result(
            self.search,
            self.samples,
            self.search.seed,
            info=self.info,
            interrupted=self.interrupted,
            invalid=self.invalid,
            seconds=self.spent,
        )

    def _run(self, number: int, watch: EngineWatch) -> tuple[str, Result]:
        """The result of a run, and its stage in the checkpoint: "done", "begun" (searched, not polished), or ""."""
        seed = (self.search.seed + number) % 2**64
        for stage in ("done", "begun"):
            stored = _stored(self.keeper, f"{number}/{stage}", self.search, seed)
            if stored is not None:
                return stage, stored
        return "", self.runner(
            self.search, seed, self.threads, watch, _stage(self.keeper, f"{number}/search")
        )

    def _polish(self, number: int, stage: str, run: Result, watch: EngineWatch) -> Result:
        """Run the chains that continue from a run."""
        if not stage:
            _store(self.keeper, f"{number}/begun", run, [run.best])
        assert self.search.polish is not None
        part = _stage(self.keeper, f"{number}/polish")
        result = polish(run, self.search.polish, run.seed, self.threads, watch, part)
        self._record(result)
        result.invalid = merged(run.invalid, result.invalid)
        return result

    def _record(self, result: Result) -> None:
        self.interrupted = result.interrupted
        self.invalid = merged(self.invalid, result.invalid)


def _guides(search: SearchLike) -> list[Guide]:
    """The guides of a search, after checks of memory, guides and observations."""
    if search.runs > 1:
        check_room("runs", search.runs, RUN, "run")
    guides = [function for function in search.method.text()[1] if isinstance(function, Guide)]
    for guide in guides:
        _check_guide(search, guide)
    if not isinstance(search.method, Forward):
        check_observations(search.task, search.seed)
    return guides


def _stage(keeper: Keeper | None, name: str) -> Stage | None:
    return None if keeper is None else keeper.stage(name)


def _store(
    keeper: Keeper | None, name: str, result: Result, samples: Sequence[Sample], info: Info | None = None
) -> None:
    """Store the result of a run in its checkpoint, in place of its stage."""
    if keeper is None:
        return
    keeper.drop(f"{name.partition('/')[0]}/")
    keeper.put(
        name,
        {
            "samples": [(sample._run.data(), sample.seconds, sample.cpu_seconds) for sample in samples],
            "info": stored_info(result.info if info is None else info),
            "invalid": [astuple(invalid) for invalid in result.invalid],
            "seconds": (result.seconds, result.cpu_seconds),
        },
    )
    keeper.write_if_due()


def _stored(keeper: Keeper | None, name: str, search: SearchLike, seed: int) -> Result | None:
    """Read the result of a run from the checkpoint; None if it is not there."""
    data = None if keeper is None else keeper.get(name)
    if keeper is None or data is None:
        return None
    with reading(keeper.path):
        stored = fitted(data, StoredResult)
        samples = [
            Sample(search.task.run_of_data(run), search, seed, *spent) for run, *spent in stored.samples
        ]
        if not samples:
            raise Unfit("$.samples", "at least one run", "none")
        for sample in samples:
            # Choices can be read only from a run of this model.
            _ = sample.choices
        info = restored_info(stored.info)
        invalid = [Invalid(*fields) for fields in stored.invalid]
    return Result(search, samples, seed, info=info, invalid=invalid, seconds=stored.seconds)


def _cause(error: InputError | ModelFault) -> str:
    """The cause that made a run impossible, its place, and a cure."""
    if not isinstance(error, InputError):
        return f": {error.message}"
    cause = error.values.get("often") or error.values.get("constraint", "")
    return f": {cause}; {error.values.get('cure', '')}"


def _check_guide(search: SearchLike, guide: Guide) -> None:
    """Warn if a guide was trained for another version of the model."""
    with translated(search.model.name):
        lost = guide._engine.lost(search.task)
    if lost:
        shown = "; ".join([*lost[:SHOWN], *([f"and {len(lost) - SHOWN} more"] if len(lost) > SHOWN else [])])
        warn(
            f"the guide of `{guide.model}` was trained for another version of the model. It draws only the choices "
            f"that match: {shown}",
            SearchWarning,
        )


def _check_weights(result: Result) -> None:
    """Warn if one of many samples has all the weight.

    The weight of each choice is bounded, but their product is not. Resampling evens the weights, so they collapse in
    methods that resample seldom or never.
    """
    if len(result) < MANY or result.interrupted:
        return
    logs = [sample.log_weight for sample in result]
    shares = [exp(log - max(logs)) for log in logs]
    effective = sum(shares) ** 2 / sum(share**2 for share in shares)
    if effective < COLLAPSED:
        warn(
            f"{effective:.1f} of {len(result)} samples are effective: the guide's weights are too uneven. Resample "
            '(`smc` with `resampling="tempered"` and without `ess`), or train the guide with a larger `share`',
            SearchWarning,
        )
