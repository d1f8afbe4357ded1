"""run.json: a search as a file that can be replayed in another session.

It holds the whole search (`Search.data`: the model itself, its arguments, the score, the method, the seed) and its
hash, and for each run its scores, its choices by readable address with their families, and its order choices.
"""

from __future__ import annotations

import json
import math
import warnings
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki import _engine, gallery
from niwaki.errors import InputError
from niwaki.errors.files import write_whole
from niwaki.lang.compiled import translated
from niwaki.result import Result, Sample
from niwaki.search import Search
from niwaki.shell.references import ModelReference
from niwaki.targets.target import TargetWarning

FORMAT = 2


def written(result: Result, found: ModelReference) -> dict[str, Any]:
    """A search and its result as plain data."""
    return {
        "format": FORMAT,
        "niwaki": _engine.__version__,
        "model": found.reference,
        "search": result.search.data(),
        "hash": result.search.hash,
        "plan": list(getattr(result.info, "plan", ())),
        "rounds": max(len(getattr(result.info, "rounds", ())) - 1, 0),
        "interrupted": result.interrupted,
        "best": result.samples.index(result.best),
        "runs": [{**numbers(sample), **_names(sample)} for sample in result],
    }


def numbers(sample: Sample) -> dict[str, Any]:
    """The scores of a run, as `--json` prints them; numbers that are not finite become null."""
    found = {
        "log_score": sample.log_score,
        "log_prior": sample.log_prior,
        "similarity": sample.similarity,
        "primitives": sample.primitives,
        "seconds": sample.seconds,
        "cpu_seconds": sample.cpu_seconds,
    }
    return {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in found.items()}


def _names(sample: Sample) -> dict[str, Any]:
    families = sample.families
    return {
        "seed": sample.seed,
        "ended": sample.has_ended,
        "choices": [
            {"address": address, "family": families[address], "value": _plain(value)}
            for address, value in sample.choices.items()
        ],
        "order_choices": [{"future": f"{future:032x}", "place": place} for future, place in sample.order],
    }


def _plain(value: Any) -> Any:
    """A choice as JSON; reals that are not finite as text."""
    if isinstance(value, tuple):
        return [_plain(part) for part in value]
    if isinstance(value, float) and not math.isfinite(value):
        return repr(value)
    return value


def _chosen(value: Any) -> Any:
    """A choice from JSON."""
    if isinstance(value, list):
        return tuple(_chosen(part) for part in value)
    return float(value) if isinstance(value, str) else value


def save(path: str | PathLike[str], data: dict[str, Any]) -> Path:
    """Write a search, completely or not at all."""
    return write_whole(Path(path), (json.dumps(data, indent=1, allow_nan=False) + "\n").encode())


def load(path: str | PathLike[str]) -> dict[str, Any]:
    """Read a search, and check that it is one."""
    place = Path(path)
    if not place.is_file():
        raise InputError("bad-run-file", path=place, reason="there is no such file")
    try:
        data = json.loads(place.read_text(encoding="utf-8"))
        if data["format"] != FORMAT:
            reason = f"it has format {data['format']}, this version reads {FORMAT}"
            raise InputError("bad-run-file", path=place, reason=reason)
        run = data["runs"][data["best"]]
        for part in run["choices"]:
            part["address"], part["value"]
        run["ended"], data["search"]["model"]
    except (ValueError, OSError) as error:
        raise InputError("bad-run-file", path=place, reason=f"it is not JSON: {error}") from error
    except (KeyError, IndexError, TypeError) as error:
        raise InputError("bad-run-file", path=place, reason=f"a field is missing: {error!r}") from error
    return dict(data)


def replayed(data: dict[str, Any], number: int | None = None) -> Sample:
    """One run of a search once more (the best).

    Nothing but the file is needed, and the meshes that it names: no file of Python is run.
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
    search = _searched(data["search"])
    run = data["runs"][data["best"] if number is None else number]
    choices = {part["address"]: _chosen(part["value"]) for part in run["choices"]}
    with translated(search.model.name, choices=choices):
        trace = search.task.replay(choices, None, not run["ended"])
    return Sample.of_trace(trace, search)


def style(data: dict[str, Any], sample: Sample) -> str | None:
    """The style in which a search's drawings are drawn: its model's own; None for scenes in space."""
    known = gallery.entry(str(data.get("model", "")))
    if known is not None and known.draws is not None:
        return known.draws
    return "ink" if sample.search.score.window is not None else None


def _searched(data: dict[str, Any]) -> Search:
    """The search; without its score where a mesh of the score is missing or has changed."""
    try:
        return Search.of_data(data)
    except InputError as error:
        if error.code not in ("file-missing", "changed-mesh"):
            raise
        message = f"{str(error).splitlines()[0]}; the picture is without its target"
        warnings.warn(message, TargetWarning, stacklevel=4)
        return Search.of_data({**data, "score": []})
