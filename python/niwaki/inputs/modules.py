"""Python files that a person names, run as modules.

A file is no module of Python's or of a package, whatever its name: `json.py` must not take the place of `json`. So its
module has a name that nothing imports, made of its path. What is stored (run.json, the hash of a search) has the file's
own name, `public`, which is the same on all machines.
"""

from __future__ import annotations

import hashlib
import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from types import ModuleType
from typing import Any

from niwaki.errors import InputError, NiwakiError
from niwaki.inputs.files import bytes_of

#: Files that were run, with their own names, by the names of their modules; the last one comes last.
_run: dict[str, tuple[str, Path]] = {}


def run_file(
    place: Path, name: str = "", check: Callable[[bytes], object] | None = None
) -> tuple[ModuleType, str]:
    """Run a file as a module, with its own folder importable, as `python file.py` would.

    The folder stays importable, for what a function of the file imports when it is called; but then after all others.

    Parameters
    ----------
    place
        The file.
    name
        Of what is stored; the file's when left out.
    check
        Gets the bytes that are about to be run, and raises an error where they must not be.

    Returns
    -------
    module
        What the file defines.
    digest : str
        SHA-256 of the bytes that were run.
    """
    name = name or place.stem
    own, path = re.sub(r"\W", "_", name), hashlib.sha256(os.fsencode(place)).hexdigest()
    private = f"_{own}_{path[:12]}"
    module = ModuleType(private)
    module.__file__ = str(place)
    try:
        # Not through the import system: its cache misses the second of two edits within a second.
        source = bytes_of(place, "model")
        if check is not None:
            check(source)
        code = compile(source, str(place), "exec", dont_inherit=True)
        sys.modules[private] = module
        _run.pop(private, None)
        _run[private] = name, place
        with _importable(place):
            exec(code, module.__dict__)
    except (NiwakiError, KeyboardInterrupt):
        raise
    except BaseException as error:
        # Also SystemExit: a file that ends the program has not said which models it has.
        line = _last_line(error, place)
        raise InputError(
            "model-file-failed", path=place, reason=f"{type(error).__name__}: {error}{line}"
        ) from error
    return module, hashlib.sha256(source).hexdigest()


def public(module: str) -> str:
    """The name of a module, as it is stored: of a file that was run, the file's."""
    return _run[module][0] if module in _run else module


def modules(name: str) -> list[ModuleType]:
    """The modules that a stored name may mean: the last file of that name, and a module that is loaded."""
    found = [private for private, (own, _) in _run.items() if own == name][-1:]
    return [sys.modules[one] for one in (*found, name) if one in sys.modules]


def prefer(place: Path) -> None:
    """Of the files that have the same name, mean this one from now on."""
    for private, (_, path) in list(_run.items()):
        if path == place:
            _run[private] = _run.pop(private)


def files(names: Iterable[str]) -> tuple[tuple[str, Path], ...]:
    """The names and the files of what stored names mean, of those that mean files."""
    last = dict(_run.values())
    return tuple((name, last[name]) for name in sorted(set(names) & set(last)))


def folders() -> set[str]:
    """The folders of the files that were run."""
    return {str(place.parent) for _, place in _run.values()}


def run_files(wanted: Iterable[tuple[str, Path]]) -> None:
    """Run files that another process has run, unless this one has."""
    for name, place in wanted:
        if (name, place) not in _run.values():
            run_file(place, name)


@dataclass(frozen=True)
class _Elsewhere:
    """Finds a module in all folders but one, so that a file is never imported in place of what has its name."""

    name: str
    folder: str

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        if name != self.name:
            return None
        return PathFinder.find_spec(name, [one for one in sys.path if one != self.folder])


@contextmanager
def _importable(place: Path) -> Iterator[None]:
    """The folder of a file before all others; afterwards it comes last."""
    folder = str(place.parent)
    elsewhere: Any = _Elsewhere(place.stem, folder)
    sys.path.insert(0, folder)
    sys.meta_path.insert(0, elsewhere)
    try:
        yield
    finally:
        sys.meta_path.remove(elsewhere)
        sys.path.remove(folder)
        if folder not in sys.path:
            sys.path.append(folder)


def _last_line(error: BaseException, place: Path) -> str:
    """The line of the file where it stopped."""
    found, trace = "", error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(place):
            found = f" (line {trace.tb_lineno})"
        trace = trace.tb_next
    return found
