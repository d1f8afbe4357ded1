"""Carrying out a search: run by run, each from where its checkpoint is, polished and kept, with what is said of it."""

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
from niwaki.search.checkpoint import Checkpoint, understood
from niwaki.search.keeping import Keeper, Stage
from niwaki.search.searching import given, polished, searched, starts
from niwaki.search.worth import SearchWarning, check_kinds, check_worth

#: So many of the things that a guide has lost are named.
SHOWN = 6

#: Of so many samples or more, fewer effective ones than this are a collapse of their weights.
MANY, COLLAPSED = 20, 2.0


#: One run of a search, with one seed: on the engine here, or elsewhere.
Once = Callable[[SearchLike, int, int | None, EngineWatch, Stage | None], Result]


class Left(Struct):
    """What a run gave, in a checkpoint: runs as data with their seconds, and what a `Result` has beside them."""

    samples: list[tuple[str, float, float]]
    info: dict[str, Any] | None
    invalid: list[tuple[str, str, int, int, str, str]]
    seconds: tuple[float, float]


def keeper(search: SearchLike, checkpoint: Checkpoint) -> Keeper:
    """What keeps the checkpoint of a search; an error where the file is of another one."""
    return Keeper(checkpoint, "search", search.about, search.data())


def carried_out(
    search: SearchLike,
    threads: int | None,
    progress: Watch | None,
    keeper: Keeper | None = None,
    once: Once = searched,
) -> Result:
    """Run a search, run by run, each by `once`.

    With a `keeper` it goes on from its checkpoint, which has a stage for each run and each polishing, and what a run
    gave that is done.

    Runs in which every particle became impossible are left out with a warning, and are an error when there is no other.
    """
    if search.choices is not None and not starts(search.method):
        return given(search)
    guides = _checked(search)
    if search.runs == 1 and search.keep == "all" and search.polish is None:
        result = once(search, search.seed, threads, watcher(progress, search), _stage(keeper, "0/search"))
        if guides:
            _check_weights(result)
        if keeper is not None:
            keeper.finish(result.interrupted)
        return result
    runs = _Runs(search, threads, progress, keeper, once)
    for number in range(search.runs):
        runs.add(number)
        if runs.interrupted:
            break
    return runs.result()


@dataclass
class _Runs:
    """The runs of a search, and what they gave so far."""

    search: SearchLike
    threads: int | None
    progress: Watch | None
    keeper: Keeper | None
    once: Once
    samples: list[Sample] = field(default_factory=list)
    failed: list[InputError | ModelFault] = field(default_factory=list)
    invalid: tuple[Invalid, ...] = ()
    spent: float = 0.0
    interrupted: bool = False
    #: Several runs share the statistics of the last one, without evidence; runs of chains have none.
    info: Info = field(default_factory=Info)

    def add(self, number: int) -> None:
        """One run: searched or found in the checkpoint, polished, and kept."""
        watch = watcher(self.progress, self.search, number, self.search.runs)
        try:
            stage, one = self._found(number, watch)
        except (InputError, ModelFault) as error:
            if error.code != "everything-impossible" and not error.values.get("invalid"):
                raise
            self.failed.append(error)
            return
        except KeyboardInterrupt:
            # Ctrl-C between two checks of the engine.
            if not self.samples:
                raise
            self.interrupted = True
            return
        if not isinstance(one.info, MhInfo | DrawnInfo):
            self.info = without_evidence(one.info)
        self._note(one)
        if self.interrupted and self.samples and not any(sample.has_ended for sample in one):
            self.spent += one.seconds
            return
        if self.search.polish is not None and not self.interrupted and stage != "done":
            one = self._polished(number, stage, one, watch)
        self.spent += one.seconds
        is_whole = getattr(self.search.method, "diverse", None) is not None or self.search.keep == "all"
        samples = list(one.samples) if is_whole else [one.best]
        self.samples.extend(samples)
        if not self.interrupted and stage != "done":
            _leave(self.keeper, f"{number}/done", one, samples, self.info)

    def result(self) -> Result:
        """All of them together."""
        if self.failed and not self.samples:
            raise self.failed[0]
        if self.failed:
            warn(
                f"{len(self.failed)} of {self.search.runs} runs became impossible and are left out"
                f"{_lost(self.failed[0])}",
                SearchWarning,
            )
        if self.search.score.asks and self.search.keep == "best":
            best = max(self.samples, key=lambda sample: sample.log_score)
            check_worth(self.search.task, self.search.score, best)
        if self.keeper is not None:
            self.keeper.finish(self.interrupted)
        return Result(
            self.search,
            self.samples,
            self.search.seed,
            info=self.info,
            interrupted=self.interrupted,
            invalid=self.invalid,
            seconds=(self.spent, sum(sample.cpu_seconds for sample in self.samples)),
        )

    def _found(self, number: int, watch: EngineWatch) -> tuple[str, Result]:
        """What a run gave, and how far it was in the checkpoint: "done", "begun" (searched, not polished), or ""."""
        seed = (self.search.seed + number) % 2**64
        for stage in ("done", "begun"):
            left = _left(self.keeper, f"{number}/{stage}", self.search, seed)
            if left is not None:
                return stage, left
        return "", self.once(self.search, seed, self.threads, watch, _stage(self.keeper, f"{number}/search"))

    def _polished(self, number: int, stage: str, begun: Result, watch: EngineWatch) -> Result:
        """The chains that continue from a run."""
        if not stage:
            _leave(self.keeper, f"{number}/begun", begun, [begun.best])
        assert self.search.polish is not None
        kept = _stage(self.keeper, f"{number}/polish")
        one = polished(begun, self.search.polish, begun.seed, self.threads, watch, kept)
        self._note(one)
        one.invalid = merged(begun.invalid, one.invalid)
        return one

    def _note(self, one: Result) -> None:
        self.interrupted = one.interrupted
        self.invalid = merged(self.invalid, one.invalid)


def _checked(search: SearchLike) -> list[Guide]:
    """The guides of a search, whose runs there is room for, and that can be weighed."""
    if search.runs > 1:
        check_room("runs", search.runs, RUN, "run")
    guides = [one for one in search.method.text()[1] if isinstance(one, Guide)]
    for guide in guides:
        _check_guide(search, guide)
    if not isinstance(search.method, Forward):
        check_kinds(search.task, search.seed)
    return guides


def _stage(keeper: Keeper | None, name: str) -> Stage | None:
    return None if keeper is None else keeper.stage(name)


def _leave(
    keeper: Keeper | None, name: str, result: Result, samples: Sequence[Sample], info: Info | None = None
) -> None:
    """Keep what a run gave in its checkpoint, in place of what it needed to go on."""
    if keeper is None:
        return
    keeper.drop(f"{name.partition('/')[0]}/")
    keeper.put(
        name,
        {
            "samples": [(one._run.data(), one.seconds, one.cpu_seconds) for one in samples],
            "info": stored_info(result.info if info is None else info),
            "invalid": [astuple(one) for one in result.invalid],
            "seconds": (result.seconds, result.cpu_seconds),
        },
    )
    keeper.write_if_due()


def _left(keeper: Keeper | None, name: str, search: SearchLike, seed: int) -> Result | None:
    """What a run gave, in the checkpoint; None where it is not there."""
    data = None if keeper is None else keeper.get(name)
    if keeper is None or data is None:
        return None
    with understood(keeper.path):
        left = fitted(data, Left)
        runs = [Sample(search.task.run_of_data(run), search, seed, *spent) for run, *spent in left.samples]
        if not runs:
            raise Unfit("$.samples", "at least one run", "none")
        for one in runs:
            # Whether it is a run of this model.
            _ = one.choices
        info = restored_info(left.info)
        invalid = [Invalid(*one) for one in left.invalid]
    return Result(search, runs, seed, info=info, invalid=invalid, seconds=left.seconds)


def _lost(error: InputError | ModelFault) -> str:
    """What made a run impossible, where, and what helps."""
    if not isinstance(error, InputError):
        return f": {error.message}"
    said = error.values.get("often") or error.values.get("constraint", "")
    return f": {said}; {error.values.get('cure', '')}"


def _check_guide(search: SearchLike, guide: Guide) -> None:
    """Warn where a guide is of another version of the model."""
    with translated(search.model.name):
        lost = guide._engine.lost(search.task)
    if lost:
        shown = "; ".join([*lost[:SHOWN], *([f"and {len(lost) - SHOWN} more"] if len(lost) > SHOWN else [])])
        warn(
            f"the guide of `{guide.model}` was trained for another version of the model, and only what matches is "
            f"used: {shown}",
            SearchWarning,
        )


def _check_weights(result: Result) -> None:
    """Warn where one of many samples has all the weight.

    Each choice's weight is bounded, their product is not. Resampling brings the weights back, so this happens where a
    method does not resample, or does so seldom.
    """
    if len(result) < MANY or result.interrupted:
        return
    logs = [sample.log_weight for sample in result]
    shares = [exp(one - max(logs)) for one in logs]
    effective = sum(shares) ** 2 / sum(share**2 for share in shares)
    if effective < COLLAPSED:
        warn(
            f"{effective:.1f} of {len(result)} samples are effective: what a guide drew weighs too unevenly. Resample "
            '(`smc` with `resampling="tempered"` and without `ess`), or train the guide with a larger `share`',
            SearchWarning,
        )
