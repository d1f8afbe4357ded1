"""Short hashes of all that a person gets from a search: values to the bit, files without times, paths and versions."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
from niwaki.errors import NiwakiError
from niwaki.methods import Method
from niwaki.methods.kernels import Kernel
from niwaki.result import Result, Sample
from niwaki.result.chains import MhInfo
from niwaki.result.drawn import DrawnInfo
from niwaki.result.normals import ViInfo
from niwaki.search import Search
from niwaki.words import Vec
from PIL import Image, ImageSequence

#: Characters of a hash: two of a hundred thousand tables have the same for different results.
LENGTH = 16

#: Fields that are no result: what was asked for, how long it took, where a source file is, and the work of a process,
#: of which a search that is gone on with has several.
LEFT_OUT = {
    "cpu_seconds",
    "file",
    "line",
    "method",
    "path",
    "recordings",
    "search",
    "seconds",
    "span",
    "structures",
}

#: What a sample is, beside its choices.
OF_SAMPLE = (
    "log_score",
    "log_prior",
    "log_weight",
    "similarity",
    "primitives",
    "has_ended",
    "cause",
    "order",
    "value",
    "choices",
)
#: Statistics that are computed when they are read, so that they are no fields; without counters of work.
READ_LATE = {
    MhInfo: ("bests", "last", "acceptance", "trajectories"),
    DrawnInfo: ("values", "positions", "log_prior", "log_score"),
}
#: Numbers that NumPy computes by functions whose last bits depend on the processor, and the digits that count.
OF_NUMPY = {
    Sample: {"log_weight"},
    ViInfo: {"bound_error", "k_curvature", "k_curvature_error", "k_hat", "log_evidence", "log_weights"},
}
DIGITS = 6

#: Keys of a JSON file that say when, where and by which version it was written, where the model stands in its source,
#: or what the bytes of the files beside it are, which have digests of their own.
OF_A_PLACE = {"core", "cpu_seconds", "file", "file_hash", "files", "hash", "niwaki", "path", "seconds"}

#: Numbers of a text that are times or depend on them.
TIMES = re.compile(
    r"\d[\d.,]* ?(?:m?s\b|seconds\b|a second\b)|\b(start|compile|target|search|runs|pictures?|files) \d+\.\d+"
)

#: The hash of what was searched, which has the place of the model's source in it.
HASH = re.compile(r"\bhash [0-9a-f]+\b")


def digest(result: Any) -> str:
    """The hash of a result, or of any value that is made of numbers, texts, samples and arrays."""
    hashed = hashlib.sha256()
    for part in _parts(result):
        hashed.update(len(part).to_bytes(8, "little") + part)
    return hashed.hexdigest()[:LENGTH]


def _parts(value: Any) -> Iterable[bytes]:
    """The bytes of a value, each part with its kind."""
    if isinstance(value, np.generic):
        value = value.item()
    if value is None or isinstance(value, bool | int | str):
        yield f"{type(value).__name__} {value}".encode()
    elif isinstance(value, float):
        yield f"float {value.hex()}".encode()
    elif isinstance(value, bytes):
        yield b"bytes " + value
    elif isinstance(value, np.ndarray):
        yield f"array {value.dtype.str} {value.shape}".encode()
        yield np.ascontiguousarray(value).tobytes()
    elif isinstance(value, Vec):
        yield from _parts(("vec", *value.parts))
    elif isinstance(value, NiwakiError):
        # Its text names places in source files.
        yield f"error {getattr(value, 'code', type(value).__name__)}".encode()
    elif isinstance(value, nw.Guide):
        yield from _parts(value.data)
    elif isinstance(value, Sample):
        yield from _named(value, OF_SAMPLE)
    elif isinstance(value, Result):
        yield from _named(value, ("sizes", "seed", "interrupted", "invalid", "info"))
        yield from _parts(list(value.samples))
        yield from _scene(value)
    elif isinstance(value, Mapping):
        yield f"mapping {len(value)}".encode()
        for key, part in value.items():
            yield from _parts(key)
            yield from _parts(part)
    elif is_dataclass(value) and not isinstance(value, type | Method | Kernel | Search):
        late = [name for kind, names in READ_LATE.items() if isinstance(value, kind) for name in names]
        names = [field.name for field in fields(value) if not field.name.startswith("_")]
        yield from _named(value, [name for name in names if name not in LEFT_OUT] + late)
    elif hasattr(value, "_fields"):
        yield from _named(value, value._fields)
    elif isinstance(value, list | tuple):
        yield f"{type(value).__name__} {len(value)}".encode()
        for part in value:
            yield from _parts(part)
    elif isinstance(value, Kernel):
        yield repr(value).encode()
    else:
        raise TypeError(f"a result has {type(value).__name__}, and no digest is known for it")


def _named(value: Any, names: Iterable[str]) -> Iterable[bytes]:
    """Attributes with their names."""
    for name in names:
        if name not in LEFT_OUT:
            yield name.encode()
            # The run itself holds the places of words.
            of_places = name == "choices" and isinstance(value, Sample)
            part = value.places if of_places else getattr(value, name)
            yield from _parts(_rounded(part) if name in OF_NUMPY.get(type(value), ()) else part)


def _rounded(value: Any) -> Any:
    """A number or an array as texts of few digits."""
    if value is None:
        return None
    return f"{value:.{DIGITS}g}" if np.ndim(value) == 0 else [_rounded(part) for part in value]


def _scene(result: Result) -> Iterable[bytes]:
    """The mesh of the best sample, as files have it."""
    if len(result.samples) and result.best.primitives:
        yield from _parts([np.asarray(array) for array in result.best.scene.merged()])


def digest_of_files(folder: Path, names: Iterable[str], output: str) -> str:
    """The hash of what a command printed, and of the files that it wrote."""
    stdout = _without(json.loads(output)) if output.startswith("{") else _plain(output, folder)
    contents = [("stdout", stdout)]
    contents += [(name, _content(folder / name, folder)) for name in sorted(names)]
    return digest(contents)


def _content(place: Path, folder: Path) -> Any:
    """Return the contents of a file: pictures as pixels, tables and texts without what is of this run alone."""
    if place.suffix in (".png", ".gif", ".jpg", ".webp"):
        with Image.open(place) as picture:
            return [np.asarray(frame.convert("RGBA")) for frame in ImageSequence.Iterator(picture)]
    if place.suffix == ".json":
        return of_json(place)
    if place.suffix in (".csv", ".svg", ".txt"):
        return _plain(place.read_text(encoding="utf-8"), folder)
    return place.read_bytes()


def of_json(place: Path) -> Any:
    """Return the contents of a JSON file, without data of this run alone."""
    return _without(json.loads(place.read_text(encoding="utf-8")))


def _without(data: Any) -> Any:
    """Return JSON without data of this run alone."""
    if isinstance(data, dict):
        return {key: _without(part) for key, part in data.items() if key not in OF_A_PLACE}
    return [_without(part) for part in data] if isinstance(data, list) else data


def _plain(text: str, folder: Path) -> str:
    """A text without times, the folder and the version."""
    text = text.replace(str(folder), "").replace(nw.__version__, "")
    return HASH.sub("", TIMES.sub("", text))
