"""Users' Python files, run as modules.

A file must not replace a module of Python or of a package that has the same name, such as `json`. So its module gets a
name that nothing imports, made from its path. Stored data (run.json, the hash of a search) have the file's public name,
which is the same on all machines.
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

#: Public names and paths of the files that were run, by the names of their modules; the latest comes last.
_run: dict[str, tuple[str, Path]] = {}


def run_file(
    place: Path,
    name: str = "",
    check: Callable[[bytes], object] | None = None,
    source: bytes | None = None,
) -> tuple[ModuleType, str]:
    """Run a file as a module that can import from its folder, as `python file.py` does.

    Later the folder stays importable, after all others, for imports inside the file's functions.

    Parameters
    ----------
    place
        The file.
    name
        The public name; by default the file's name.
    check
        A function that gets the file's bytes before the run, and raises an error to refuse them.
    source
        What is run in place of the file's bytes, as if it stood there.

    Returns
    -------
    module
        The file's module.
    digest : str
        SHA-256 of the file's bytes.
    """
    name = name or place.stem
    stem, path = re.sub(r"\W", "_", name), hashlib.sha256(os.fsencode(place)).hexdigest()
    private = f"_{stem}_{path[:12]}"
    module = ModuleType(private)
    module.__file__ = str(place)
    try:
        # The import system is not used: its cache misses the second of two edits within a second.
        source = bytes_of(place, "model") if source is None else source
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
        # Also SystemExit: a file that ends the program does not define its models.
        line = _last_line(error, place)
        raise InputError(
            "model-file-failed", path=place, reason=f"{type(error).__name__}: {error}{line}"
        ) from error
    return module, hashlib.sha256(source).hexdigest()


def public(module: str) -> str:
    """Return the public name of a module, which stored data have."""
    return _run[module][0] if module in _run else module


def modules(name: str) -> list[ModuleType]:
    """Return the modules that a public name may mean: the latest file of the name, and a loaded module."""
    latest = [private for private, (stem, _) in _run.items() if stem == name][-1:]
    return [sys.modules[module] for module in (*latest, name) if module in sys.modules]


def prefer(place: Path) -> None:
    """Let a public name mean this file from now on."""
    for private, (_, path) in list(_run.items()):
        if path == place:
            _run[private] = _run.pop(private)


def files(names: Iterable[str]) -> tuple[tuple[str, Path], ...]:
    """Return the public names that mean files, with the files."""
    last = dict(_run.values())
    return tuple((name, last[name]) for name in sorted(set(names) & set(last)))


def folders() -> set[str]:
    """Return the folders of the files that were run."""
    return {str(place.parent) for _, place in _run.values()}


def run_files(entries: Iterable[tuple[str, Path]]) -> None:
    """Run the files that another process has run, unless this process has run them."""
    for name, place in entries:
        if (name, place) not in _run.values():
            run_file(place, name)


@dataclass(frozen=True)
class _Elsewhere:
    """A finder of a module in all folders but one, so that a file never replaces a module of the same name."""

    name: str
    folder: str

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        if name != self.name:
            return None
        return PathFinder.find_spec(name, [folder for folder in sys.path if folder != self.folder])


@contextmanager
def _importable(place: Path) -> Iterator[None]:
    """Make a file's folder importable, before all others in the block and after all others later."""
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
    """Return the line of the file at which an error happened, for a message."""
    line, trace = "", error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(place):
            line = f" (line {trace.tb_lineno})"
        trace = trace.tb_next
    return line
