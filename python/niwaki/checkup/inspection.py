"""Inspection of an installation; the module imports no part of the package that may be broken."""

from __future__ import annotations

import hashlib
import os
import platform
import re
import warnings
from collections.abc import Callable
from importlib import import_module, metadata
from pathlib import Path
from types import ModuleType
from typing import Any

from niwaki.checkup.report import Checkup, Extra, Trial
from niwaki.errors.extras import EXTRAS, install
from niwaki.errors.memory import UNKNOWN, free_memory

#: The packages that the core needs.
CORE = ("numpy", "pillow", "trimesh", "mapbox_earcut", "msgspec", "typer", "rich", "lazy-loader")
#: A requirement in the package's metadata: the name of a package, its least version, and the extra.
_REQUIREMENT = re.compile(r"""([\w.-]+)>=([\w.]+)[^;]*; extra == ["']([\w-]+)["']""")


def doctor() -> Checkup:
    """Inspect this installation: versions, the core, the machine, and the extras.

    Returns
    -------
    Checkup
        The report; `print` shows it as `niwaki doctor` does.
    """
    versions = {
        "Niwaki": _version("niwaki") or "not installed: run from a folder",
        "engine": "not loaded",
        "Python": f"{platform.python_version()}, {platform.system()} {platform.machine()}",
        **{name: _version(name) or "not installed" for name in CORE},
    }
    core = [_try("the engine loads", lambda: import_module("niwaki._engine"))]
    free = free_memory()
    machine: dict[str, Any] = {
        "processors": os.cpu_count() or 1,
        "free_memory": free if free < UNKNOWN else None,
    }
    if not core[0].error:
        engine = import_module("niwaki._engine")
        versions["engine"] = f"{engine.__version__}, SHA-256 {_hash(engine)}"
        core.append(_try("the engine knows the machine", lambda: machine.update(_of_engine(engine))))
        core += _trials(_version("niwaki"))
    return Checkup(versions, tuple(core), machine, tuple(map(_extra, EXTRAS)))


def _trials(package: str | None) -> list[Trial]:
    """Run small searches; their module imports everything that a search needs."""
    loaded = _try("the modules of a search load", lambda: import_module("niwaki.checkup.trials"))
    if loaded.error:
        return [loaded]
    trials = import_module("niwaki.checkup.trials")
    results = [
        loaded,
        _try("a search gives the exact answer", trials.exact),
        _try("a scene grows into a target; its picture and its mesh are written", trials.growth),
    ]
    if package is not None:
        name = "package and engine have the same version"
        results.append(_try(name, lambda: trials.same_version(package)))
    return results


def _try(name: str, trial: Callable[[], object]) -> Trial:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            trial()
    except Exception as error:
        return Trial(name, f"{type(error).__name__}: {' '.join(str(error).split())}")
    return Trial(name)


def _of_engine(engine: Any) -> dict[str, Any]:
    threads, vectors, compiles = engine.machine()
    return {"threads": threads, "vectors": vectors, "machine_code": compiles, "bits": engine.fingerprint()}


def _extra(name: str) -> Extra:
    """Return an extra by the package's metadata, with its missing packages."""
    needed = [match for text in _requirements() if (match := _REQUIREMENT.match(text)) and match[3] == name]
    missing = []
    for package, least, _ in (match.groups() for match in needed):
        installed = _version(package)
        if installed is None:
            missing.append(package)
        elif _numbers(installed) < _numbers(least):
            missing.append(f"{package}>={least}, not {installed}")
    if not needed:
        missing.append("the package itself, installed")
    return Extra(name, EXTRAS[name], tuple(missing), install(name))


def _requirements() -> list[str]:
    try:
        return metadata.requires("niwaki") or []
    except metadata.PackageNotFoundError:
        return []


def _version(package: str) -> str | None:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None


def _numbers(version: str) -> tuple[int, ...]:
    """Return the numbers at the start of a version, without zeros at the end."""
    start = re.match(r"\d+(?:\.\d+)*", version)
    numbers = [int(part) for part in start[0].split(".")] if start else []
    while numbers and numbers[-1] == 0:
        numbers.pop()
    return tuple(numbers)


def _hash(engine: ModuleType) -> str:
    """Return the first digits of the SHA-256 of the engine's file."""
    return hashlib.sha256(Path(engine.__file__ or "").read_bytes()).hexdigest()[:16]
