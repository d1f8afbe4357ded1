"""Checks of the types of settings: words, kernels, proposals and guides."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from niwaki.errors import InputError
from niwaki.errors.settings import bad, count, worded
from niwaki.methods import kernels
from niwaki.methods.guide import Guide
from niwaki.methods.kernels import Kernel


def at_least_one(name: str, value: int) -> int:
    """Check a whole number above zero."""
    return count(name, value)


def one_of(name: str, value: Any, words: tuple[str, ...]) -> None:
    """Refuse an unknown word."""
    if value not in words:
        raise bad(name, value, worded(("words", words)), f'"{words[0]}"')


def check_kernel(name: str, value: Any, usual: str = "kernels.prior()") -> None:
    """Refuse a value that is neither None nor a kernel."""
    if value is not None and not isinstance(value, Kernel):
        raise bad(name, value, "a kernel", f"one of `niwaki.kernels`, such as `{usual}`")


def proposal(kernel: Any) -> None:
    """Refuse a kernel that cannot draw the choices of a new run."""
    if kernel is None:
        return
    usual = 'kernels.on("x", kernels.proposal(function))'
    if not isinstance(kernel, Kernel):
        raise bad("proposal", kernel, "a kernel from `kernels.proposal` or `kernels.guided`", usual)
    is_weighted = kernel.name == "on" and not kernel.settings["sites"]
    if kernel.name not in ("proposal", "guided", "on", "cycle") or is_weighted:
        expected = "`proposal` or `guided`, `on` around them, or a `cycle` of those"
        raise bad("proposal", kernel, expected, usual)
    for part in kernel.parts:
        proposal(part)


def with_guide(kernel: Kernel | None, guide: Guide | None) -> Kernel | None:
    """Check a proposal, and add a guide for all other choices."""
    proposal(kernel)
    if guide is None:
        return kernel
    by_guide = kernels.guided(guide)
    return by_guide if kernel is None else kernels.cycle(kernel, by_guide)


def look_ahead(strength: Any, proposal: Kernel | None) -> None:
    """Refuse a look-ahead that no guide of the proposal has learned."""
    if strength is not None and not any(guide.looks_ahead for guide in _guides(proposal)):
        raise InputError("guide-ahead", detail="no guide of this search has learned to look ahead")


def _guides(kernel: Kernel | None) -> Iterator[Guide]:
    """The guides of a proposal."""
    if kernel is None:
        return
    if isinstance(kernel.function, Guide):
        yield kernel.function
    for part in kernel.parts:
        yield from _guides(part)
