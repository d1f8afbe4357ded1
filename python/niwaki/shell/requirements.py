"""Requirements beside a model (`niwaki.requirements`): `requirements.toml`, which a person owns.

A search asks for a target and forbids intersections as always (`niwaki.targets.asks`), and its score has a term for the
height and the room (`Keep.aims`). Its results are held against the file, and those that do not keep all of it are left
out. If no result keeps the file, further searches look for many different results, among which one may keep it.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from niwaki.requirements import Keep
from niwaki.requirements.conflicts import against, rivals
from niwaki.requirements.form import Form
from niwaki.requirements.rows import RequirementRow
from niwaki.result import Result
from niwaki.search.kinds import TOO_FEW, narrow
from niwaki.search.warnings import SearchWarning
from niwaki.shell.references import ModelReference
from niwaki.targets.target import Target

NAME = "requirements.toml"
#: The most searches, with consecutive seeds, for a result that keeps the requirements.
ATTEMPTS = 3
#: How many different results a search after the first has, to choose from.
CANDIDATES = 12
#: A result that is held against the requirements.
Judged = list[RequirementRow]


def beside(reference: ModelReference) -> Keep | None:
    """Return the requirements beside the file of a model; None without a file of requirements.

    Raises
    ------
    InputError
        `bad-requirements`.
    """
    if reference.file_hash is None:
        return None
    place = Path(reference.name.rpartition(":")[0]).parent / NAME
    return Keep.load(place) if place.is_file() else None


def keeping(
    rules: Keep | None, attempt: Callable[[int, int], Result], seed: int, count: int
) -> tuple[Result, list[str]]:
    """Search until there are results that keep the requirements.

    Parameters
    ----------
    rules
        The requirements; None for none.
    attempt
        A search with a seed for a number of results that differ.
    seed
        The first seed; further searches have the seeds after it.
    count
        The number of results that are wanted.

    Returns
    -------
    result : Result
        The results that keep all requirements. If no search has such results: those of the first search.
    conflicts : list of str
        If no search has such results: which requirement stands against which.
    """
    first = result = attempt(seed, count)
    if rules is None:
        return first, []
    judged: list[Judged] = []
    for number in range(1, ATTEMPTS + 1):
        rows = [rules.judged(sample) for sample in result.samples]
        good = [place for place, each in enumerate(rows) if all(row.holds for row in each)]
        if good:
            narrow(result, good[:count])
            return result, []
        judged += rows
        if number == ATTEMPTS or result.interrupted:
            break
        # What is wanted is results that keep the requirements, not as many as there are candidates.
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", TOO_FEW, SearchWarning)
            result = attempt((seed + number) % 2**53, max(count, CANDIDATES))
    if result.interrupted or not first.samples:
        return first, []
    # The rows of the first search come first.
    of_best = judged[first.samples.index(first.best)]
    return first, list(conflicts(rules, first.search.score.target, of_best, judged))


def conflicts(rules: Keep, target: Target | None, of_best: Judged, judged: Sequence[Judged]) -> Iterator[str]:
    """Say what each requirement that a result does not keep stands against.

    Parameters
    ----------
    rules
        The requirements.
    target
        The target of the search; None without one.
    of_best
        The result, held against the requirements.
    judged
        All results that no search could better, held against the requirements.
    """
    of_target = [] if target is None else rules.judged(Form.of_target(target))
    for place, row in enumerate(of_best):
        if row.holds:
            continue
        if of_target and not of_target[place].holds:
            yield f"`{row.text}` stands against the target ({of_target[place].value})"
            continue
        keeping = sorted(
            ([other.text for other in rows if not other.holds] for rows in judged if rows[place].holds),
            key=len,
        )
        if keeping:
            yield against(row.text, rivals(keeping), "results")
        else:
            yield f"`{row.text}` is kept by none of {len(judged)} results: the model may not reach it"
