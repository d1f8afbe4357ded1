"""Searches as values: all settings that decide a result, and nothing else.

`niwaki.grow` and `niwaki.run` create a search and run it. A search can be written to JSON, read again and sent to
another process. Two searches are the same if their hashes are equal.

>>> import niwaki as nw
>>> @nw.model
... def coin():
...     return nw.flip(0.5)
>>> search = nw.Search(coin, method=nw.enumerate_all(), seed=1)
>>> nw.Search.of_json(search.json()).run().distribution() == search.run().distribution()
True
"""

from __future__ import annotations

import base64
import hashlib
import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.schema import Unfit, decoded, fitted, shown
from niwaki.errors.settings import MAX_MEMORY, MAX_STEPS, bad, count, is_whole
from niwaki.inputs.modules import files, public, run_files
from niwaki.lang.compiled import arguments, task
from niwaki.lang.core import Core
from niwaki.lang.labels import Labels
from niwaki.lang.models import Model, as_model
from niwaki.methods import Forward, Guide, Improve, Method, Mh
from niwaki.once import cached_property
from niwaki.result import Result, Sample, parts
from niwaki.result.progress import Watch, watcher
from niwaki.search import drag, engine_runs, execution
from niwaki.search.checkpoint import Checkpoint
from niwaki.search.checks import check_polish, check_seed, check_threads, check_values, fresh
from niwaki.search.data import MALFORMED, Reader, Writer, model_data, of_record_class, text_hash
from niwaki.search.schema import ModelData, SearchData
from niwaki.targets.sketches import Score

#: The version of the JSON form.
FORMAT = 1

#: Samples of each run in the result: all, or only the best.
KEEP = ("all", "best")

#: Places and names of files in core form; and texts, which stay.
_PLACES = re.compile(r'\(file \d+ "(?:[^"\\]|\\.)*"\)|("(?:[^"\\]|\\.)*")| @\d+:\d+-\d+:\d+')


class StoredModel(Model[..., Any]):
    """Model that was read from data: its core form, without its Python function."""

    def __init__(self, core: Core, name: str) -> None:
        self.name, self._core, self._program, self._labels = name, core, None, Labels()
        self.__name__ = name

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """Run the model once with a fresh seed, and return its value."""
        return Search(self, tuple(arguments(self, args, kwargs)), seed=fresh(None)).run().value


@dataclass(frozen=True, eq=False)
class Search:
    """A model with its arguments, its score and the method that searches it.

    Parameters
    ----------
    model
        A model, or a function of the modelling language.
    args
        Its arguments, by position.
    score
        The sketches that score its scene.
    method
        The method of the search, such as `smc(...)`; one run of the prior when left out.
    seed
        The seed of all random choices, 0 to 2^64 - 1.
    choices
        Values of choices by address: the start of chains, or for any other method the choices of the one run.
    hold
        Values of choices by address that every run has, as if they were observed. `Sample.held` returns such values.
        Patterns of choices and parts are allowed if `choices` has their values.
    runs
        The number of searches, with seeds `seed`, `seed + 1`, ...
    keep
        "all" samples of the search, or the "best" of each.
    polish
        The chains that continue from the best of each run, `mh(...)`.
    max_steps
        The most calls and loop steps of one run, with those of an `infer` inside. An operation on many elements counts
        one step for every eight of them, a primitive 256.
    max_memory
        The most bytes of a run, or of a population or several chains together: calls, values and choices.
    """

    model: Model[..., Any]
    args: tuple[Any, ...] = ()
    score: Score = field(default_factory=Score)
    method: Method = Forward()  # noqa: RUF009
    seed: int = 0
    choices: Mapping[str, Any] | None = None
    hold: parts.Hold | None = None
    runs: int = 1
    keep: str = "all"
    polish: Mh | None = None
    max_steps: int = MAX_STEPS
    max_memory: int = MAX_MEMORY

    def __post_init__(self) -> None:
        """Check the fields."""
        object.__setattr__(self, "model", as_model(self.model))
        object.__setattr__(self, "args", tuple(self.args))
        check_seed(self.seed)
        check_values("choices", self.choices)
        if self.hold is not None:
            # Patterns are resolved here, because a search that is derived from this one may have other `choices`.
            object.__setattr__(self, "hold", self.held)
        for name, kind, suggestion in (
            ("method", Method, "`smc(particles=300)`"),
            ("score", Score, "`no_self_intersection() * match_volume(target)`"),
        ):
            if not isinstance(getattr(self, name), kind):
                raise bad(name, getattr(self, name), f"a {kind.__name__.lower()}", suggestion)
        count("runs", self.runs)
        if self.keep not in KEEP:
            raise bad("keep", self.keep, '"all" or "best"', '"all"')
        if self.polish is not None:
            check_polish(self.polish)
        if self.polish is not None and getattr(self.method, "diverse", None) is not None:
            suggestion = "None, and `Result.polish` for one of the results"
            expected = "None together with `diverse`, because chains may end in the same state"
            raise InputError(
                "bad-setting", name="polish", found="mh(...)", expected=expected, suggestion=suggestion
            )

    @cached_property
    def held(self) -> dict[str, Any]:
        """The values of held choices, by address."""
        return dict(parts.held(self.hold or {}, self.choices, (), self.model))

    @cached_property
    def task(self) -> _engine.Task:
        """The model with its arguments and sketches, ready to be searched."""
        return task(self.model, self.args, None, self.score.specs, self.max_steps, self.max_memory, self.held)

    def run(
        self,
        *,
        threads: int | None = None,
        progress: Watch | None = None,
        checkpoint: Checkpoint | str | PathLike[str] | None = None,
    ) -> Result:
        """Run the search.

        Parameters
        ----------
        threads
            The number of threads; all of the machine when left out. The result does not depend on it.
        progress
            A function that is called at intervals with a `Progress`; an exception that it raises ends the search.
        checkpoint
            A file, or a `Checkpoint`, from which the search resumes after its process was killed.

        Raises
        ------
        InputError
            The checkpoint is damaged, or of another search or version.
        """
        keeper = None if checkpoint is None else execution.keeper(self, Checkpoint.of(checkpoint))
        return execution.execute(self, check_threads(threads), progress, keeper)

    def with_seed(self, seed: int) -> Search:
        """Copy the search with another seed; both share the compiled program."""
        other = replace(self, seed=seed)
        other.__dict__["task"] = self.task
        return other

    def polished(
        self,
        result: Result,
        method: Mh | Improve,
        *,
        seed: int | None = None,
        threads: int | None = None,
        progress: Watch | None = None,
    ) -> Result:
        """Continue from the best sample of a result of this search; see `Result.polish`."""
        seed = result.seed if seed is None else seed
        return engine_runs.polish(result, method, seed, threads, watcher(progress, self))

    def regrown(
        self,
        sample: Sample,
        part: str,
        particles: int = 200,
        *,
        power: float | None = None,
        seed: int | None = None,
        threads: int | None = None,
    ) -> Result:
        """Grow one part of a sample of this search again; see `Sample.regrow`."""
        return engine_runs.regrow(self, sample, part, particles, power, seed, threads)

    def dragged(self, sample: Sample, part: str, to: Sequence[float], **settings: Any) -> drag.Drag:
        """Drag a part of a sample of this search; see `Sample.drag`."""
        return drag.dragged(self, sample, part, to, **settings)

    def data(self, files: str = "named") -> dict[str, Any]:
        """The search as plain data.

        Parameters
        ----------
        files
            The form of meshes that were read from files: "named" (the file and a hash of the mesh) or "inside", for a
            machine without the files.
        """
        write = Writer(files)
        function = _function_writer(write)
        return {
            "format": FORMAT,
            "model": model_data(self.model, write),
            "args": write.each(self.args),
            "score": self.score.data(write),
            "method": self.method.data(function),
            "seed": self.seed,
            "choices": None if self.choices is None else write(dict(self.choices)),
            # Files of all versions have this name.
            "lock": None if self.hold is None else write(self.held),
            "runs": self.runs,
            "keep": self.keep,
            "polish": None if self.polish is None else self.polish.data(function),
            "max_steps": self.max_steps,
            "max_memory": self.max_memory,
        }

    def json(self, files: str = "named") -> str:
        """The search as JSON; `files` as for `data`."""
        return json.dumps(self.data(files), allow_nan=False)

    @classmethod
    def of_data(cls, data: Mapping[str, Any], trust: tuple[str, ...] = ()) -> Search:
        """Read a search from plain data.

        Reading runs no Python file, because the model is in the data. Meshes are read from the named files.

        Parameters
        ----------
        data
            The result of `Search.data`.
        trust
            Names of modules whose host functions the model may call; importing a module runs it.

        Raises
        ------
        InputError
            The text is not a search, names a mesh that has changed, or calls a function that is not trusted.
        """
        read = Reader(tuple(trust))
        try:
            check_format(data, FORMAT)
            fitted(data, SearchData)
            polish = data["polish"]
            return cls(
                model=_read("model", lambda: _stored(data["model"], read)),
                args=tuple(_read("args", lambda: read.each(data["args"]))),
                score=_read("score", lambda: Score.of_data(data["score"], read)),
                method=_read("method", lambda: Method.of_data(data["method"], _function_reader(read))),
                seed=data["seed"],
                choices=_read("choices", lambda: _optional(data["choices"], read)),
                hold=_read("lock", lambda: _optional(data["lock"], read)),
                runs=data["runs"],
                keep=data["keep"],
                polish=_read(
                    "polish", lambda: None if polish is None else Mh.of_data(polish, _function_reader(read))
                ),
                max_steps=data["max_steps"],
                max_memory=data["max_memory"],
            )
        except Unfit as error:
            raise InputError("bad-run-file", path="the search", reason=str(error), unfit=error) from error

    @classmethod
    def of_json(cls, text: str, trust: tuple[str, ...] = ()) -> Search:
        """Read a search from JSON; as for `of_data`."""
        try:
            data = decoded(text)
        except Unfit as error:
            raise InputError("bad-run-file", path="the search", reason=str(error)) from error
        return cls.of_data(data, trust)

    @cached_property
    def hash(self) -> str:
        """SHA-256 of all settings that decide the result, in hexadecimal.

        The hash changes with the model's source, an argument, the bytes of a target, an image or a mesh, and any
        setting. It does not change with a comment, the place of a line, or the place of a file.
        """
        return text_hash(json.dumps(self._settings(), sort_keys=True))

    def _settings(self) -> dict[str, Any]:
        """The settings that decide the result, by name; hashes of the model and of long values."""
        return self.data("hashed") | {"model": model_hash(self.model)}

    @cached_property
    def about(self) -> dict[str, Any]:
        """The settings that decide the result, by name: short values, and hashes of other values."""

        def short(value: Any) -> Any:
            return (
                value if isinstance(value, int | str | None) else text_hash(json.dumps(value, sort_keys=True))
            )

        return {f"its `{name}`": short(value) for name, value in self._settings().items()}

    @cached_property
    def key(self) -> str:
        """SHA-256 of the search, the engine and the arithmetic of this machine: the name of a stored result."""
        return text_hash(f"{self.hash} {engine_hash()} {_engine.fingerprint()}")

    def __eq__(self, other: object) -> bool:
        return self.hash == other.hash if isinstance(other, Search) else NotImplemented

    def __hash__(self) -> int:
        return int(self.hash[:15], 16)

    @property
    def host_modules(self) -> tuple[str, ...]:
        """The modules of the host functions that the model calls."""
        constants = self.model.core().constants
        hosts = {public(constant.__module__) for constant in constants if callable(constant)}
        return tuple(sorted(hosts))

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self.json("inside"), self.host_modules, files(self.host_modules))


@cache
def engine_hash() -> str:
    """SHA-256 of the compiled engine, in hexadecimal."""
    return hashlib.sha256(Path(_engine.__file__).read_bytes()).hexdigest()


def model_hash(model: Model[..., Any]) -> str:
    """SHA-256 of a model: its core form without places, its constants, the sources of its host functions."""
    core = model.core()

    def without_places(match: re.Match[str]) -> str:
        return match.group(1) or ""

    data = model_data(model, Writer("hashed"))
    return text_hash(json.dumps(data | {"core": _PLACES.sub(without_places, core.text)}, sort_keys=True))


def check_format(data: Any, format: int) -> None:
    """Refuse data of another version.

    Raises
    ------
    Unfit
        The data have another `format`, or none.
    """
    version = data.get("format") if isinstance(data, Mapping) else None
    if version is not None and is_whole(version) and version != format:
        age = "a newer" if version > format else "an older"
        raise Unfit("$.format", f"{format}", f"{version}, the format of {age} Niwaki, which can read it")
    if not is_whole(version):
        raise Unfit("$.format", f"{format}", "nothing" if version is None else shown(version))


def _read(name: str, read: Callable[[], Any]) -> Any:
    """Read a part of a search; an error names the place of the part."""
    try:
        return read()
    except Unfit as error:
        raise error.inside(f".{name}") from error
    except InputError as error:
        error.values.setdefault("source", f"`$.{name}` of the search")
        raise
    except MALFORMED as error:
        raise Unfit(f"$.{name}", "the JSON of `Search.json`", f"something else ({error})") from error


def _optional(data: Any, read: Reader) -> Any:
    return None if data is None else read(data)


def _function_reader(read: Reader) -> Any:
    """A function that reads a user's proposal or a guide."""

    def function(data: Any) -> Model[..., Any] | Guide:
        return Guide(base64.b85decode(data["guide"])) if "guide" in data else _stored(data, read)

    return function


def _stored(data: Mapping[str, Any], read: Reader) -> StoredModel:
    """Read a model from its data."""
    fitted(data, ModelData)
    core = Core(
        text=data["core"],
        constants=read.each(data["constants"], ".constants"),
        classes=[of_record_class(kind) for kind in data["classes"]],
        files=[],
        entry=data["name"],
        parameters=tuple(data["parameters"]),
        required=data["required"],
    )
    return StoredModel(core, data["name"])


def _unpickled(text: str, trust: tuple[str, ...], paths: tuple[tuple[str, Path], ...]) -> Search:
    """Read a search of another process, after running the files that the other process has run."""
    run_files(paths)
    return Search.of_json(text, trust)


def _function_writer(write: Writer) -> Any:
    """A function that writes a user's proposal or a guide, or for the hash of a search its hash."""

    def function(value: Any) -> Any:
        if isinstance(value, Guide):
            return {"guide": value.hash if write.files == "hashed" else base64.b85encode(value.data).decode()}
        proposal = as_model(value)
        return model_hash(proposal) if write.files == "hashed" else model_data(proposal, write)

    return function
