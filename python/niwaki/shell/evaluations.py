"""Searches of models with slow host functions: numbers of particles that fit, and progress by calls of host functions.

A run is timed before the search. The numbers that follow are settings of the search, so they are in run.json, and a
search that is repeated from there does not depend on time.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, replace
from typing import Any

from niwaki import Search, _engine
from niwaki.errors import NiwakiError
from niwaki.lang.marks import Host
from niwaki.methods import Improve, Method, Smc

#: The settings of a search that decide how many runs of the model it makes.
SIZES = ("particles", "regrow", "rounds", "seconds", "populations")
#: Seconds in host functions that a search should take; fewer numbers follow for a run above `SLOW` seconds.
PATIENCE, SLOW = 60.0, 0.05
#: The fewest particles of a population and of a part that is grown again, and the fewest rounds.
FEWEST, FEWEST_REGROWN, FEWEST_ROUNDS = 12, 4, 3
#: The most rounds of `improve` that are given.
ROUNDS = 15
#: Calls of host functions in the rounds of a search with an effort of 1 (`FLOOR` of the engine's `price.rs`).
CALLS = 1000
#: The work of a search for several results over that of a search for one (`TIMES` of the engine's `archive.rs`).
SEVERAL = 4.0
#: Runs of the model in a round, counted with small models: of moves, and for each particle of a regrown part.
MOVED, REGROWN = 5, 2

#: The clock.
now = time.perf_counter


@dataclass
class Evaluations:
    """Calls of host functions: their number and their seconds.

    Attributes
    ----------
    each : float
        Calls in one run of the model, as counted before the search.
    expected : float
        About the calls of the whole search; 0 if unknown.
    """

    each: float = 0.0
    expected: float = 0.0
    calls: int = 0
    seconds: float = 0.0
    _lock: threading.Lock = field(default_factory=threading.Lock, repr=False)

    @contextmanager
    def counted(self, report: Callable[[], None] = lambda: None) -> Iterator[None]:
        """Count the calls inside the context; `report` follows each of them."""

        def around(function: Callable[..., Any], *args: Any, **kwargs: Any) -> Any:
            start = now()
            try:
                return function(*args, **kwargs)
            finally:
                with self._lock:
                    self.calls += 1
                    self.seconds += now() - start
                report()

        before, Host.around = Host.around, around
        try:
            yield
        finally:
            Host.around = before

    @property
    def runs(self) -> int:
        """The calls so far as a number of runs of the model."""
        return round(self.calls / max(self.each, 1.0))

    def __str__(self) -> str:
        """Runs of the model so far, and about how many there will be."""
        most = f" of about {self.expected / self.each:,.0f}" if self.expected >= max(self.calls, 1) else ""
        return f"{self.runs:,}{most} evaluations"

    @property
    def seconds_left(self) -> float | None:
        """Seconds until the expected calls are done; None if unknown."""
        if self.calls == 0 or self.expected < self.calls:
            return None
        return (self.expected - self.calls) * self.seconds / self.calls


def sized(search: Search, is_free: bool) -> tuple[Search, Evaluations, str]:
    """Give a search as many particles and rounds as its host functions allow.

    Parameters
    ----------
    search
        The search.
    is_free
        Whether the numbers may change: the user has not set them.

    Returns
    -------
    search, evaluations, note
        The search, its expected evaluations, and a line for the user, empty if nothing has changed.
    """
    if not any(isinstance(constant, Host) for constant in search.model.core().constants):
        return search, Evaluations(), ""
    pilot = Evaluations()
    try:
        with pilot.counted():
            search.task.replay({}, search.seed)
    except (NiwakiError, _engine.EngineFault):
        # An invalid run says little about its time; the search itself reports why.
        pass
    method = search.method
    expected = _runs(method, pilot.calls)
    if expected is None:
        return search, Evaluations(pilot.calls), ""
    note = ""
    fitting = PATIENCE / pilot.seconds if is_free and pilot.seconds > SLOW else math.inf
    if fitting < expected:
        smaller = _smaller(method, fitting)
        names = [
            item.name for item in fields(method) if getattr(smaller, item.name) != getattr(method, item.name)
        ]
        numbers = ", ".join(f"{getattr(smaller, name)} {name}" for name in names)
        flags = ", ".join(f"--{name}" for name in names)
        note = f"a run takes {pilot.seconds:.2g} s in host functions, so the search has {numbers} ({flags} set them)"
        search, expected = replace(search, method=smaller), _runs(smaller, pilot.calls) or 0.0
    return search, Evaluations(pilot.calls, search.runs * expected * pilot.calls), note


def _smaller(method: Method, runs: float) -> Method:
    """Return a method that makes about this number of runs of the model."""
    if isinstance(method, Improve):
        runs /= _side_by_side(method)
        particles = min(max(round(runs / 4), FEWEST), method.particles)
        regrow = min(max(particles // 5, FEWEST_REGROWN), method.regrow)
        rounds = round((runs - particles) / (REGROWN * regrow + MOVED))
        return replace(
            method, particles=particles, regrow=regrow, rounds=min(max(rounds, FEWEST_ROUNDS), ROUNDS)
        )
    assert isinstance(method, Smc) and isinstance(method.particles, int)
    return replace(method, particles=min(max(int(runs / len(method.sizes)), FEWEST), method.particles))


def _runs(method: Method, calls: float) -> float | None:
    """Return about the number of runs of the model that a search makes; None if it is unknown.

    Parameters
    ----------
    method
        The method.
    calls
        The calls of host functions in a run.
    """
    if isinstance(method, Improve) and method.seconds is None:
        if method.rounds is None:
            rounds = CALLS * (method.effort or 1.0) / max(calls, 1)
        else:
            rounds = method.rounds * (REGROWN * method.regrow + MOVED)
        return (method.particles + rounds) * _side_by_side(method)
    if isinstance(method, Smc) and method.seconds is None and isinstance(method.particles, int):
        return float(sum(method.sizes))
    return None


def _side_by_side(method: Improve) -> float:
    """Return the work of a search for several results over that of a search for one."""
    return SEVERAL if method.diverse else 1.0
