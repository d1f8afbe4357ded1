"""Differences of the results of a search: names for people of kinds, and addresses of choices that people named."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

from niwaki.errors import InputError, ModelFault
from niwaki.errors.warned import warn
from niwaki.lang.labels import SEPARATOR
from niwaki.methods import Improve, Method
from niwaki.result import Result, Sample
from niwaki.result.info import ImproveInfo
from niwaki.result.search_like import SearchLike
from niwaki.search.warnings import SearchWarning

#: Runs of the prior in which labels are looked for.
LOOKED_AT = 20
#: The beginning of the warning about too few results.
TOO_FEW = r"only \d+ of \d+ results"


def named(result: Result) -> list[list[tuple[str, str]]]:
    """The differences of the results of a search, by label, for each result."""
    info = result.info
    if not isinstance(info, ImproveInfo) or len(info.kinds) != len(result):
        return [[] for _ in result]
    labels, by = result.model.labels, getattr(result.method, "by", "kind")
    is_query = isinstance(by, str) and by not in ("kind", "look")
    # Numbers of calls that follow from the choices, and what all kinds have in common, tell nothing apart.
    chosen = [
        {place: value for place, value in kind.items() if not place.endswith("/")} for kind in info.kinds
    ]
    kinds = chosen if _number(chosen) == _number(info.kinds) else info.kinds
    shared = set.intersection(*(set(kind.items()) for kind in kinds)) if len(kinds) > 1 else set()
    return [
        [
            (place if is_query else labels.place(place), value)
            for place, value in kind.items()
            if (place, value) not in shared
        ]
        for kind in kinds
    ]


def narrow(result: Result, numbers: Sequence[int]) -> None:
    """Leave some results of a search, each with its kind."""
    info = result.info
    if isinstance(info, ImproveInfo) and len(info.kinds) == len(result):
        result.info = replace(info, kinds=tuple(info.kinds[number] for number in numbers))
    result.samples = [result.samples[number] for number in numbers]


def _number(kinds: Sequence[Mapping[str, str]]) -> int:
    """The number of different kinds."""
    return len({tuple(kind.items()) for kind in kinds})


def with_addresses(search: SearchLike) -> Method:
    """Return the method of a search, with the addresses of choices that `by` names by their labels."""
    method = search.method
    if not isinstance(method, Improve) or (isinstance(method.by, str) and SEPARATOR not in method.by):
        return method
    names = (method.by,) if isinstance(method.by, str) else method.by
    known = _labels(search)
    return replace(method, by=tuple(known.get(_plain(name), name) for name in names))


def _plain(label: str) -> str:
    """A label as people write it: any case, ">" for the separator."""
    return re.sub(r"\s*[›>]\s*", ">", label).casefold()


def _labels(search: SearchLike) -> dict[str, str]:
    """The addresses of choices in a few runs of the prior, by label; of a label without numbers, the pattern."""
    known: dict[str, str] = {}
    for seed in range(LOOKED_AT):
        try:
            trace = search.task.replay({}, seed)
        except (ModelFault, InputError):
            continue
        for address in Sample.of_trace(trace, search).choices:
            known.setdefault(_plain(search.model.labels.label(address)), address)
            pattern = re.sub(r"\[\d+\]", "[*]", address)
            known.setdefault(_plain(search.model.labels.place(re.sub(r"\[\d+\]", "[]", address))), pattern)
    return known


def check_number(info: ImproveInfo, results: int, most: int | None, interrupted: bool) -> None:
    """Warn if a search has fewer results than it should."""
    if most is None or results >= most or interrupted:
        return
    kinds = f"{info.niches} kind{'' if info.niches == 1 else 's'}"
    warn(
        f"only {results} of {most} results in {info.searches} searches differ, of {kinds}; give more `rounds`, or "
        "accept that the model has few results",
        SearchWarning,
    )
