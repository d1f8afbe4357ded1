"""What a checkup found, as values, as text and as JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from niwaki.errors.memory import size


@dataclass(frozen=True)
class Trial:
    """Something that must work, tried.

    Attributes
    ----------
    name : str
        What was tried.
    error : str
        Why it does not work; empty where it does.
    """

    name: str
    error: str = ""


@dataclass(frozen=True)
class Extra:
    """Packages that one may leave out.

    Attributes
    ----------
    name : str
        As `pip` knows it.
    purpose : str
        What it is for.
    missing : tuple of str
        Packages that are not there, or are too old; empty where the extra is installed.
    command : str
        What installs it.
    """

    name: str
    purpose: str
    missing: tuple[str, ...]
    command: str


@dataclass(frozen=True)
class Checkup:
    """What an installation has, and what works.

    Attributes
    ----------
    versions : mapping of str to str
        Of the package, its engine, Python and what the core needs.
    core : tuple of Trial
        What must work.
    machine : mapping
        `processors`; `free_memory`, bytes, None where the system does not say; and where the engine loads `threads`, as
        many as a search takes; `vectors`, the instructions for gradients; `machine_code`, whether gradients are
        compiled; `bits`, a fingerprint of the numbers that the machine computes.
    extras : tuple of Extra
        What may be installed beside the core.
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
        """Everything, for JSON."""
        return {"works": self.works, **asdict(self)}

    def __str__(self) -> str:
        """The report that `niwaki doctor` prints."""
        return "\n".join(
            [
                "Versions",
                *_rows(self.versions),
                "",
                "Core: works" if self.works else "Core: does not work",
                *(f"  {'fails' if one.error else 'ok':<7}{one.name}{_after(one.error)}" for one in self.core),
                "",
                "This machine",
                *_rows(_told(self.machine)),
                "",
                "Extras",
                *(line for extra in self.extras for line in _extra(extra)),
            ]
        )

    __repr__ = __str__


def _told(machine: Mapping[str, Any]) -> dict[str, str]:
    """The machine in words."""
    free = machine["free_memory"]
    told = {
        "processors": str(machine["processors"]),
        "memory": "how much is free is not known" if free is None else f"{size(free)} free",
    }
    if "threads" in machine:
        told |= {
            "threads": f"{machine['threads']} for a search; `threads=` and RAYON_NUM_THREADS say another number",
            "vectors": machine["vectors"].replace("any", "those of any processor"),
            "gradients": "compiled to machine code" if machine["machine_code"] else "evaluated by tape",
            "bits": f"{machine['bits']}: machines with the same give the same results",
        }
    return told


def _rows(values: Mapping[str, Any]) -> list[str]:
    width = max(map(len, values), default=0)
    return [f"  {name:<{width}}  {value}" for name, value in values.items()]


def _after(error: str) -> str:
    return f": {error}" if error else ""


def _extra(extra: Extra) -> list[str]:
    state = "missing" if extra.missing else "there"
    lines = [f"  {state:<9}{extra.name:<9}{extra.purpose}"]
    if extra.missing:
        lines.append(f"{'':20}{extra.command}   (needs {', '.join(extra.missing)})")
    return lines
