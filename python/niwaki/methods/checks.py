"""Checks of the settings of methods."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from niwaki.errors import InputError
from niwaki.errors.settings import bad, count, is_whole, real, shown
from niwaki.methods import kernels
from niwaki.methods.guide import Guide
from niwaki.methods.kernels import Kernel


def at_least_one(name: str, value: int) -> int:
    """The value, where it is a whole number above zero."""
    return count(name, value)


def from_zero(name: str, value: int, usual: str = "0") -> None:
    """Refuse what is not a whole number, 0 or more."""
    count(name, value, 0, usual=usual)


def proposal(kernel: Any) -> None:
    """Refuse what cannot draw the choices of a new run."""
    if kernel is None:
        return
    usual = 'kernels.on("x", kernels.proposal(function))'
    if not isinstance(kernel, Kernel):
        raise bad("proposal", kernel, "a kernel from `kernels.proposal` or `kernels.guided`", usual)
    weighted = kernel.name == "on" and not kernel.settings["sites"]
    if kernel.name not in ("proposal", "guided", "on", "cycle") or weighted:
        expected = "`proposal` or `guided`, `on` around them, or a `cycle` of those"
        raise bad("proposal", kernel, expected, usual)
    for part in kernel.parts:
        proposal(part)


def guided(kernel: Kernel | None, guide: Guide | None) -> Kernel | None:
    """The proposal that consists of a checked proposal and a guide for all other choices."""
    proposal(kernel)
    if guide is None:
        return kernel
    own = kernels.guided(guide)
    return own if kernel is None else kernels.cycle(kernel, own)


def look_ahead(strength: float | None, proposal: Kernel | None, moves: bool = False) -> float | None:
    """The checked strength of a look-ahead; `moves` says that particles are moved while they run."""
    if strength is None:
        return None
    strength = real("look_ahead", strength, 0, usual="0.2")
    if not any(guide.looks_ahead for guide in _guides(proposal)):
        raise InputError("guide-ahead", detail="no guide of this search has learned to look ahead")
    if moves:
        expected = "None beside `rejuvenate` of particles that still run: moves would have to know it"
        raise bad("look_ahead", strength, expected, 'None, or `at="end"`')
    return strength


def _guides(kernel: Kernel | None) -> Iterator[Guide]:
    """The guides of a proposal."""
    if kernel is None:
        return
    if isinstance(kernel.function, Guide):
        yield kernel.function
    for part in kernel.parts:
        yield from _guides(part)


def one_of(name: str, value: str, known: tuple[str, ...]) -> None:
    """Refuse a word that is not known."""
    if value not in known:
        listed = ", ".join(f'"{one}"' for one in known)
        raise bad(name, value, f"one of {listed}", f'"{known[0]}"')


def samples(n: int) -> None:
    """Refuse a number of samples that is none."""
    if is_whole(n) and n < 1:
        raise InputError("no-samples", detail=f"n={shown(n)}")
    count("n", n)


def particles(n: int, least: int = 1) -> None:
    """Refuse a number of particles that is too small."""
    if is_whole(n) and n < 1:
        raise InputError("no-particles", found=shown(n))
    count("particles", n, least, usual="100")
