"""The parameters of a function that is defined by run, and when they are used, from a few runs at random.

A parameter that some runs lack depends on the nearest switch or choice before it whose values tell these runs from
the others, or on a whole number with a border between them. Where nothing tells them apart, it counts as always used,
and the function ignores its value in some runs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from niwaki.errors import InputError
from niwaki.fitting.draws import Drawn
from niwaki.search.space import Parameter, Space
from niwaki.words.distributions import DiscreteUniform, Uniform

#: Runs from which the parameters are taken.
RUNS = 16

Run = Mapping[str, Drawn]


def probe(seed: int, number: int) -> dict[str, float]:
    """Return a point without any parameter, whose draws are decided by the seed and the number."""
    return {"seed of the runs at random": float(seed), "number of the run": float(number)}


def space_of(name: str, traces: Sequence[Sequence[Drawn]]) -> Space:
    """Return the parameters that some runs have drawn.

    Parameters
    ----------
    name
        The function.
    traces
        The draws of each run, in order.

    Raises
    ------
    InputError
        `no-ranges`: no run draws anything, or a range differs between runs.
    """
    runs: list[Run] = [{drawn.name: drawn for drawn in trace} for trace in traces]
    firsts: dict[str, Drawn] = {}
    for run in runs:
        for drawn in run.values():
            first = firsts.setdefault(drawn.name, drawn)
            if first.domain != drawn.domain:
                raise InputError(
                    "no-ranges",
                    name=name,
                    reason=f"the range of its draw `{drawn.name}` differs from run to run",
                    cure="draw a share between 0 and 1, and compute the value from it; or give the draws two names",
                )
    if not firsts:
        raise InputError(
            "no-ranges",
            name=name,
            reason="the function draws no parameter from the value that it is called with",
            cure='write `width = d.real("width", 20, 80)` in it, or ranges as defaults of its parameters',
        )
    parameters: dict[str, Any] = {}
    for parameter, drawn in firsts.items():
        parameters[parameter] = Parameter(
            _range(drawn), _condition(parameter, runs, list(parameters), firsts)
        )
    return Space(parameters)


def _range(drawn: Drawn) -> Any:
    if drawn.kind == "real":
        return Uniform(drawn.low, drawn.high)
    if drawn.kind == "whole":
        return DiscreteUniform(int(drawn.low), int(drawn.high))
    return [False, True] if drawn.labels == ("False", "True") else list(drawn.labels)


def _condition(
    name: str, runs: Sequence[Run], before: Sequence[str], firsts: Mapping[str, Drawn]
) -> dict[str, Any] | None:
    """Return the values of an earlier parameter under which a parameter is used; None if there are none."""
    having, lacking = [run for run in runs if name in run], [run for run in runs if name not in run]
    if not lacking:
        return None
    # Few values first: many values tell any two groups apart.
    discrete = [other for other in reversed(before) if firsts[other].kind != "real"]
    for other in sorted(discrete, key=lambda entry: firsts[entry].high - firsts[entry].low):
        if not all(other in run for run in having):
            continue
        used = {int(run[other].number) for run in having}
        unused = {int(run[other].number) for run in lacking if other in run}
        allowed = _apart(firsts[other], used, unused)
        if allowed is not None:
            range_ = _range(firsts[other])
            values = range_ if isinstance(range_, list) else range(range_.lo, range_.hi + 1)
            start = 0 if isinstance(range_, list) else range_.lo
            return {other: [values[level - start] for level in allowed]}
    return None


def _apart(drawn: Drawn, used: set[int], unused: set[int]) -> list[int] | None:
    """Return the levels under which a parameter is used, if the runs with it and without it are apart."""
    levels = range(int(drawn.low), int(drawn.high) + 1)
    if not unused or used & unused:
        # Without `other`, too, the parameter is unused; that is said by the condition of `other`.
        return list(levels) if not unused else None
    if drawn.kind == "choice":
        return [level for level in levels if level not in unused]
    if max(unused) < min(used):
        return [level for level in levels if level > max(unused)]
    return [level for level in levels if level < min(unused)] if max(used) < min(unused) else None
