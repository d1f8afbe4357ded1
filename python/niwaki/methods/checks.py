"""Checks of the settings of methods."""

from __future__ import annotations

from typing import Any

from niwaki.errors import InputError
from niwaki.errors.settings import bad, is_whole
from niwaki.methods import kernels
from niwaki.methods.guide import Guide
from niwaki.methods.kernels import Kernel


def at_least_one(name: str, value: int) -> int:
    """The value, where it is a whole number above zero."""
    if not is_whole(value) or value < 1:
        raise bad(name, value, "a whole number above 0", "1 or more")
    return value


def from_zero(name: str, value: int, usual: str = "0") -> None:
    """Refuse what is not a whole number, 0 or more."""
    if not is_whole(value) or value < 0:
        raise bad(name, value, "a whole number, 0 or more", usual)


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


def one_of(name: str, value: str, known: tuple[str, ...]) -> None:
    """Refuse a word that is not known."""
    if value not in known:
        listed = ", ".join(f'"{one}"' for one in known)
        raise bad(name, value, f"one of {listed}", f'"{known[0]}"')


def samples(n: int) -> None:
    """Refuse a number of samples that is none."""
    if not is_whole(n) or n < 1:
        raise InputError("no-samples", detail=f"n={n!r}")


def particles(n: int, least: int = 1) -> None:
    """Refuse a number of particles that is too small."""
    if not is_whole(n) or n < 1:
        raise InputError("no-particles", found=repr(n))
    if n < least:
        raise bad("particles", n, f"a whole number, at least {least}", "100")
