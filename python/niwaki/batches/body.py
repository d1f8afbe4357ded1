"""Results as bytes of records, and back: JSON without times and without names of machines.

Two machines write the same bytes for the same search. Reading runs no search: a run is restored from its choices. A
failed search stores the code and the first line of its error. The rest of the message names files, and is in the log.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import Annotated, Any

from msgspec import Meta, Struct

from niwaki import _engine, draw
from niwaki.errors import InputError, NiwakiError
from niwaki.errors.schema import Unfit, fitted
from niwaki.lang.compiled import translated
from niwaki.once import cached_property
from niwaki.result import Result, Sample
from niwaki.result.info import EnumerationInfo, ImproveInfo, Info, restored_info, stored_info
from niwaki.result.invalid import Invalid
from niwaki.search import Search
from niwaki.search.data import MALFORMED, Reader, Writer


class Body(Struct):
    """A stored result, or the error of a failed search.

    Attributes
    ----------
    samples
        Data of the runs.
    sizes
        Number of samples of each chain.
    best
        Data of the best run, if it is not among the samples.
    info
        The method's statistics.
    invalid
        `Result.invalid` without folders of files and texts of exceptions, which differ between machines.
    fault, message
        Code and first line of the error of a failed search.
    """

    samples: list[str] = []
    sizes: list[Annotated[int, Meta(ge=0)]] = []
    best: str | None = None
    info: dict[str, Any] | None = None
    invalid: list[tuple[str, str, int, Annotated[int, Meta(ge=0)], str]] = []
    fault: str | None = None
    message: str = ""


def body_of(result: Result) -> bytes:
    """Return the bytes of a result."""
    samples = [sample._run.data() for sample in result]
    best = None if isinstance(result.info, EnumerationInfo) else result.best._run.data()
    return _bytes(
        {
            "samples": samples,
            "sizes": result.sizes,
            "best": None if best in samples else best,
            "info": _info(result.info),
            "invalid": [
                (place.name, PurePath(place.file).name, place.line, place.runs, place.call)
                for place in result.invalid
            ],
        }
    )


def fault_of(error: NiwakiError) -> bytes:
    """Return the bytes of a failed search."""
    first = str(error).partition("\n")[0].removeprefix(f"error[{error.code}]: ")
    return _bytes({"fault": error.code, "message": first})


def _bytes(data: Mapping[str, Any]) -> bytes:
    return json.dumps(data, sort_keys=True, separators=(",", ":")).encode()


def _info(info: Info) -> dict[str, Any] | None:
    """Return statistics without times."""
    stored = stored_info(info)
    if stored is None:
        return None
    if isinstance(info, ImproveInfo):
        stored["fields"]["seconds"] = ()
    if isinstance(info, EnumerationInfo):
        write = Writer("inside")
        stored["fields"]["table"] = [[write(value), log] for value, log in info.table]
    return stored


@dataclass(frozen=True)
class Outcome:
    """The outcome of one search of a batch: a result or an error.

    Attributes
    ----------
    case : int
        Number of the case, from 0.
    labels : dict
        The values in which the case differs from the others.
    seed : int
        Seed of the search.
    search : Search
        The search, which can be run again.
    """

    case: int
    labels: Mapping[str, Any]
    seed: int
    search: Search
    _bytes: bytes

    @cached_property
    def _body(self) -> Body:
        try:
            body: Body = fitted(json.loads(self._bytes), Body)
            return body
        except (Unfit, ValueError, RecursionError) as error:
            raise self._refused(error) from error

    @property
    def fault(self) -> str | None:
        """The code of the error of a failed search, such as "everything-impossible"; None for a result."""
        return self._body.fault

    @property
    def message(self) -> str:
        """The first line of the error of a failed search."""
        return self._body.message

    @cached_property
    def result(self) -> Result:
        """The result, without seconds, which are in the log of the batch.

        Raises
        ------
        InputError
            The search failed, or the stored bytes are not a result of it.
        """
        body = self._body
        if body.fault is not None:
            raise InputError(
                "search-failed", name=self.search.model.name, seed=self.seed, reason=body.message
            )
        return Result(
            self.search,
            [self._sample(data) for data in body.samples],
            self.seed,
            info=self._statistics(body.info),
            sizes=body.sizes,
            invalid=[Invalid(*place, reason="") for place in body.invalid],
        )

    @property
    def runs(self) -> list[str]:
        """Data of the runs."""
        return self._body.samples

    @cached_property
    def best(self) -> Sample:
        """The best run; for chains, the best state of all chains."""
        return self.result.best if self._body.best is None else self._sample(self._body.best)

    def _sample(self, data: str) -> Sample:
        try:
            with translated(self.search.model.name):
                return Sample(self.search.task.run_of_data(data), self.search, self.seed)
        except (*MALFORMED, _engine.EngineFault) as error:
            raise self._refused(error) from error

    def _statistics(self, data: dict[str, Any] | None) -> Info:
        try:
            info = restored_info(data)
            if isinstance(info, EnumerationInfo):
                read = Reader()
                table = tuple((read(value), log) for value, log in info.table)
                return replace(info, table=table)
            return info
        except (*MALFORMED, Unfit) as error:
            raise self._refused(error) from error

    def _refused(self, error: Exception) -> InputError:
        where = f"the result of case {self.case}, seed {self.seed}"
        return InputError("bad-batch", path=where, reason=str(error))

    def _repr_html_(self) -> str:
        rows = {**self.labels, "seed": self.seed}
        if self.fault is not None:
            return draw.card.card(f"Outcome: {self.fault}", {**rows, "message": self.message})
        return draw.card.card("Outcome", {**rows, **self.best.numbers}, self.best._repr_png_())

    def __repr__(self) -> str:
        labels = "".join(f"{name}={value!r}, " for name, value in self.labels.items())
        return f"<Outcome: {labels}seed {self.seed}, {self.message if self.fault else repr(self.best)}>"
