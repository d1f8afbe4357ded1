"""run.json: a search as a file that another session can replay.

The file contains the whole search (`Search.data`: model, arguments, score, method, seed) and its hash. For each run it
has the scores, the choices by readable address with their families, and the order choices. It names the model's file
with a hash of its bytes, and the files beside run.json that show its runs, each with a hash.
"""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta, Struct

from niwaki import _engine, gallery
from niwaki.draw import finite
from niwaki.errors import InputError
from niwaki.errors.files import is_file
from niwaki.errors.schema import Unfit, decoded, fitted, inside, shown
from niwaki.errors.warned import warn
from niwaki.inputs import bytes_of
from niwaki.lang.compiled import translated
from niwaki.result import Result, Sample
from niwaki.result.info import ImproveInfo
from niwaki.search import Search
from niwaki.search.data import MALFORMED
from niwaki.search.request import check_format
from niwaki.shell.references import ModelReference
from niwaki.targets.target import TargetWarning

FORMAT = 2

Whole = Annotated[int, Meta(ge=0)]


class Choice(Struct):
    """A choice of a run."""

    address: str
    value: Any
    family: str = ""


class Run(Struct):
    """A run with the data that a replay needs."""

    choices: list[Choice]
    ended: bool
    seed: Whole = 0
    log_score: float | None = None


class RunFile(Struct):
    """The required fields of a run.json."""

    format: Whole
    search: dict[str, Any]
    runs: Annotated[list[Run], Meta(min_length=1)]
    best: Whole
    hash: str
    model: str
    file_hash: str | None = None
    files: dict[str, str | None] = {}
    shown: Whole | None = None


def written(result: Result, reference: ModelReference) -> dict[str, Any]:
    """Return a search and its result as plain data."""
    return {
        "format": FORMAT,
        "niwaki": _engine.__version__,
        "model": reference.name,
        "file_hash": reference.file_hash,
        "search": result.search.data(),
        "hash": result.search.hash,
        "plan": list(getattr(result.info, "plan", ())),
        "rounds": max(len(getattr(result.info, "rounds", ())) - 1, 0),
        **(
            {"generations": result.info.generations, "spent": result.info.spent}
            if isinstance(result.info, ImproveInfo)
            else {}
        ),
        "interrupted": result.interrupted,
        "best": result.samples.index(result.best),
        "shown": result.samples.index(result.best),
        "runs": [{**numbers(sample), **_names(sample)} for sample in result],
    }


def numbers(sample: Sample) -> dict[str, Any]:
    """Return the scores of a run as `--json` prints them; numbers that are not finite become null."""
    fits = sample.fit
    row = {
        "log_score": sample.log_score,
        "log_prior": sample.log_prior,
        "covered": None if fits is None else fits.covered,
        "outside": None if fits is None else fits.outside,
        "similarity": sample.similarity,
        "primitives": sample.primitives,
        "seconds": sample.seconds,
        "cpu_seconds": sample.cpu_seconds,
    }
    return {k: finite.scalar(v) if isinstance(v, float) else v for k, v in row.items()}


def _names(sample: Sample) -> dict[str, Any]:
    families = sample.families
    return {
        "seed": sample.seed,
        "ended": sample.has_ended,
        "choices": [
            {"address": address, "family": families[address], "value": finite.plain(value)}
            for address, value in sample.choices.items()
        ],
        "order_choices": [{"future": f"{future:032x}", "place": place} for future, place in sample.order],
    }


#: The families of which a choice can be among words. A string is the word there, and else a number that is not finite.
_OF_WORDS = ("categorical", "discrete_uniform")


def _choice_value(value: Any, family: str | None) -> Any:
    """Read the value of a choice from JSON; `family` is that of its distribution, if the file has it."""
    if isinstance(value, list):
        return tuple(_choice_value(part, family) for part in value)
    if isinstance(value, dict):
        raise Unfit("$", "the value of a choice", shown(value))
    if not isinstance(value, str) or family in _OF_WORDS:
        return value
    try:
        return float(value)
    except ValueError:
        if family is None:
            return value
        raise Unfit("$", "the value of a choice", shown(value)) from None


def load(path: str | PathLike[str]) -> dict[str, Any]:
    """Read a run.json and check its fields; values are checked where they are used."""
    place = Path(path)
    if not is_file(place):
        raise InputError("bad-run-file", path=place, reason="the file does not exist")
    try:
        data = decoded(bytes_of(place, "run"))
        check_format(data, FORMAT)
        fitted(data, RunFile)
        if data["best"] >= len(data["runs"]):
            raise Unfit("$.best", f"the number of a run, less than {len(data['runs'])}", str(data["best"]))
    except Unfit as error:
        raise InputError("bad-run-file", path=place, reason=str(error)) from error
    except OSError as error:
        raise InputError("bad-run-file", path=place, reason=error.strerror or str(error)) from error
    return dict(data)


def replayed(
    data: dict[str, Any],
    number: int | None = None,
    trust: tuple[str, ...] = (),
    path: str | PathLike[str] = "run.json",
) -> Sample:
    """Replay a run of a search.

    A replay needs only the file and the meshes that it names. It runs no Python file.

    Parameters
    ----------
    data
        The data of `load`.
    number
        The index of the run; None for the best.
    trust
        Names of modules whose host functions the model may call.
    path
        The file, for messages.
    """
    count = len(data["runs"])
    if number is not None and not 0 <= number < count:
        raise InputError(
            "bad-setting",
            name="run",
            found=repr(number),
            expected=f"one of the {count} results of this search, from 0 to {count - 1}",
            suggestion=f"such a number; without it you get the best, {data['best']}",
        )
    number = data["best"] if number is None else number
    search, values = searched(data, trust, path), choices(data["runs"][number], number, path)
    try:
        with translated(search.model.name, choices=values):
            trace = search.task.replay(values, None, not data["runs"][number]["ended"])
    except MALFORMED as error:
        reason = f"`$.runs[{number}].choices` is not a list of choices of this model: {error}"
        raise InputError("bad-run-file", path=path, reason=reason) from error
    except InputError as error:
        raise _read_from(error, path) from error
    return Sample.of_trace(trace, search)


def searched(
    data: dict[str, Any], trust: tuple[str, ...] = (), path: str | PathLike[str] = "run.json"
) -> Search:
    """Return the search of a run.json; see `replayed` for `trust` and `path`."""
    try:
        return _search_without_missing_meshes(data["search"], trust)
    except InputError as error:
        raise _read_from(error, path) from error


def choices(run: dict[str, Any], number: int, path: str | PathLike[str]) -> dict[str, Any]:
    """Return the choices of a run by address; its number and the file are for messages."""
    values = {}
    try:
        for place, part in enumerate(run["choices"]):
            with inside(f".runs[{number}].choices[{place}].value"):
                values[part["address"]] = _choice_value(part["value"], part.get("family"))
    except Unfit as error:
        raise InputError("bad-run-file", path=path, reason=str(error)) from error
    return values


def _read_from(error: InputError, path: str | PathLike[str]) -> InputError:
    """Convert an error about a search to an error about its file."""
    unfit, reason = error.values.get("unfit"), ""
    if isinstance(unfit, Unfit):
        reason = str(unfit.inside(".search"))
    elif error.code == "machine-limit":
        reason = f"`$.search.model.core` is not a model: {error.values['found']}"
    if reason:
        return InputError("bad-run-file", path=path, reason=reason)
    error.values["source"] = ", ".join([f"`{path}`", *filter(None, [error.values.get("source")])])
    return error


def style(data: dict[str, Any], sample: Sample) -> str | None:
    """Return the drawing style of a search's model; None for scenes in space."""
    entry = gallery.entry(str(data.get("model", "")))
    if entry is not None and entry.draws is not None:
        return entry.draws
    return "ink" if sample.search.score.window is not None else None


def _search_without_missing_meshes(data: dict[str, Any], trust: tuple[str, ...]) -> Search:
    """Return the search, without its score if a mesh of the score is missing or has changed."""
    try:
        return Search.of_data(data, trust)
    except InputError as error:
        if error.code not in ("file-missing", "changed-mesh"):
            raise
        message = f"{str(error).splitlines()[0]}; the picture does not show its target"
        warn(message, TargetWarning)
        return Search.of_data({**data, "score": []}, trust)
