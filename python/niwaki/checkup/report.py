"""The report of a checkup as values, as text and as JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from niwaki.errors.memory import size


@dataclass(frozen=True)
class Trial:
    """A test of the core.

    Attributes
    ----------
    name : str
        The subject of the test.
    error : str
        The error of a test that fails; empty if it passes.
    """

    name: str
    error: str = ""


@dataclass(frozen=True)
class Extra:
    """An extra: optional packages.

    Attributes
    ----------
    name : str
        The name of the extra for `pip`.
    purpose : str
        The features that need it.
    missing : tuple of str
        Packages that are missing or too old; empty if the extra is installed.
    command : str
        The command that installs it.
    """

    name: str
    purpose: str
    missing: tuple[str, ...]
    command: str


@dataclass(frozen=True)
class Checkup:
    """The report on an installation.

    Attributes
    ----------
    versions : mapping of str to str
        Versions of the package, its engine, Python and the packages that the core needs.
    core : tuple of Trial
        Tests of the core.
    machine : mapping
        `processors`; `free_memory` in bytes, None if the system does not tell it. If the engine loads, also `threads`,
        the number of threads of a search; `vectors`, the instructions for gradients; `machine_code`, whether gradients
        are compiled; `bits`, a fingerprint of the numbers that the machine computes.
    extras : tuple of Extra
        Optional packages beside the core.
    """

    versions: Mapping[str, str]
    core: tuple[Trial, ...]
    machine: Mapping[str, Any]
    extras: tuple[Extra, ...]

    @property
    def works(self) -> bool:
        """Whether the core works."""
        return not any(trial.error for trial in self.core)

    def data(self) -> dict[str, Any]:
        """Return the report as data for JSON."""
        return {"works": self.works, **asdict(self)}

    def __str__(self) -> str:
        """Return the report that `niwaki doctor` prints."""
        return "\n".join(
            [
                "Versions",
                *_rows(self.versions),
                "",
                "Core: works" if self.works else "Core: does not work",
                *(
                    f"  {'fails' if trial.error else 'ok':<7}{trial.name}{_suffix(trial.error)}"
                    for trial in self.core
                ),
                "",
                "This machine",
                *_rows(_description(self.machine)),
                "",
                "Extras",
                *(line for extra in self.extras for line in _extra(extra)),
            ]
        )

    __repr__ = __str__


def _description(machine: Mapping[str, Any]) -> dict[str, str]:
    """Describe the machine in words."""
    free = machine["free_memory"]
    words = {
        "processors": str(machine["processors"]),
        "memory": "the free memory is unknown" if free is None else f"{size(free)} free",
    }
    if "threads" in machine:
        words |= {
            "threads": f"{machine['threads']} for a search; `threads=` and RAYON_NUM_THREADS set another number",
            "vectors": machine["vectors"].replace("any", "instructions of any processor"),
            "gradients": "compiled to machine code" if machine["machine_code"] else "evaluated by tape",
            "bits": f"{machine['bits']}: machines with the same bits give the same results",
        }
    return words


def _rows(values: Mapping[str, Any]) -> list[str]:
    width = max(map(len, values), default=0)
    return [f"  {name:<{width}}  {value}" for name, value in values.items()]


def _suffix(error: str) -> str:
    return f": {error}" if error else ""


def _extra(extra: Extra) -> list[str]:
    state = "missing" if extra.missing else "ok"
    lines = [f"  {state:<9}{extra.name:<9}{extra.purpose}"]
    if extra.missing:
        lines.append(f"{'':20}{extra.command}   (needs {', '.join(extra.missing)})")
    return lines
