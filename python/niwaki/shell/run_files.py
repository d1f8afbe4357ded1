"""run.json: a search as a file that can be replayed in another session.

It holds the whole search (`Search.data`: the model itself, its arguments, the score, the method, the seed) and its
hash, and for each run its scores, its choices by readable address with their families, and its order choices. It names
the model's file with a hash of its bytes, and the files beside it that show one of its runs, each with a hash.
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
    """A run, as it can be replayed."""

    choices: list[Choice]
    ended: bool
    seed: Whole = 0
    log_score: float | None = None


class RunFile(Struct):
    """What must be in a run.json."""

    format: Whole
    search: dict[str, Any]
    runs: Annotated[list[Run], Meta(min_length=1)]
    best: Whole
    hash: str
    model: str
    file_hash: str | None = None
    files: dict[str, str | None] = {}
    shown: Whole | None = None


def written(result: Result, found: ModelReference) -> dict[str, Any]:
    """A search and its result as plain data."""
    return {
        "format": FORMAT,
        "niwaki": _engine.__version__,
        "model": found.reference,
        "file_hash": found.file_hash,
        "search": result.search.data(),
        "hash": result.search.hash,
        "plan": list(getattr(result.info, "plan", ())),
        "rounds": max(len(getattr(result.info, "rounds", ())) - 1, 0),
        "interrupted": result.interrupted,
        "best": result.samples.index(result.best),
        "shown": result.samples.index(result.best),
        "runs": [{**numbers(sample), **_names(sample)} for sample in result],
    }


def numbers(sample: Sample) -> dict[str, Any]:
    """The scores of a run, as `--json` prints them; numbers that are not finite become null."""
    fits = sample.fit
    found = {
        "log_score": sample.log_score,
        "log_prior": sample.log_prior,
        "covered": None if fits is None else fits.covered,
        "outside": None if fits is None else fits.outside,
        "similarity": sample.similarity,
        "primitives": sample.primitives,
        "seconds": sample.seconds,
        "cpu_seconds": sample.cpu_seconds,
    }
    return {k: finite.scalar(v) if isinstance(v, float) else v for k, v in found.items()}


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


def _chosen(value: Any) -> Any:
    """A choice from JSON."""
    if isinstance(value, list):
        return tuple(_chosen(part) for part in value)
    if isinstance(value, dict):
        raise Unfit("$", "the value of a choice", shown(value))
    if not isinstance(value, str):
        return value
    try:
        return float(value)
    except ValueError:
        raise Unfit("$", "the value of a choice", shown(value)) from None


def load(path: str | PathLike[str]) -> dict[str, Any]:
    """Read a search, and check that it is one; what is in its values is checked where they are read."""
    place = Path(path)
    if not is_file(place):
        raise InputError("bad-run-file", path=place, reason="there is no such file")
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
    """One run of a search once more (the best).

    Nothing but the file is needed, and the meshes that it names: no file of Python is run.

    Parameters
    ----------
    data
        What `load` gave.
    number
        Which run; the best when left out.
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
            suggestion=f"such a number, or leave it out for the best, {data['best']}",
        )
    number = data["best"] if number is None else number
    search, given = searched(data, trust, path), choices(data["runs"][number], number, path)
    try:
        with translated(search.model.name, choices=given):
            trace = search.task.replay(given, None, not data["runs"][number]["ended"])
    except MALFORMED as error:
        reason = (
            f"at `$.runs[{number}].choices` is something that is no list of choices of this model: {error}"
        )
        raise InputError("bad-run-file", path=path, reason=reason) from error
    except InputError as error:
        raise _read_from(error, path) from error
    return Sample.of_trace(trace, search)


def searched(
    data: dict[str, Any], trust: tuple[str, ...] = (), path: str | PathLike[str] = "run.json"
) -> Search:
    """The search of a run.json; `trust` and `path` as for `replayed`."""
    try:
        return _searched(data["search"], trust)
    except InputError as error:
        raise _read_from(error, path) from error


def choices(run: dict[str, Any], number: int, path: str | PathLike[str]) -> dict[str, Any]:
    """The choices of a run by address; its number and the file are for messages."""
    found = {}
    try:
        for place, part in enumerate(run["choices"]):
            with inside(f".runs[{number}].choices[{place}].value"):
                found[part["address"]] = _chosen(part["value"])
    except Unfit as error:
        raise InputError("bad-run-file", path=path, reason=str(error)) from error
    return found


def _read_from(error: InputError, path: str | PathLike[str]) -> InputError:
    """An error about a search, as one about the file that it was read from."""
    unfit, reason = error.values.get("unfit"), ""
    if isinstance(unfit, Unfit):
        reason = str(unfit.inside(".search"))
    elif error.code == "machine-limit":
        reason = f"at `$.search.model.core` is no model: {error.values['found']}"
    if reason:
        return InputError("bad-run-file", path=path, reason=reason)
    error.values["source"] = ", ".join([f"`{path}`", *filter(None, [error.values.get("source")])])
    return error


def style(data: dict[str, Any], sample: Sample) -> str | None:
    """The style in which a search's drawings are drawn: its model's own; None for scenes in space."""
    known = gallery.entry(str(data.get("model", "")))
    if known is not None and known.draws is not None:
        return known.draws
    return "ink" if sample.search.score.window is not None else None


def _searched(data: dict[str, Any], trust: tuple[str, ...]) -> Search:
    """The search; without its score where a mesh of the score is missing or has changed."""
    try:
        return Search.of_data(data, trust)
    except InputError as error:
        if error.code not in ("file-missing", "changed-mesh"):
            raise
        message = f"{str(error).splitlines()[0]}; the picture is without its target"
        warn(message, TargetWarning)
        return Search.of_data({**data, "score": []}, trust)
