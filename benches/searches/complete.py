"""The rule for a complete result: for each problem the least share that a result must have of each part.

The key of a share is a word of the part's name; a part without such a word need not be there. Shares lie in the gap
between results that have the part and results that lack it, as seen on the tuning seeds, where there is a gap.
What reaches far out of its target can be worse than an empty scene, which nobody calls complete. No search depends on
this file: after a change here the tables are made anew from the records.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

#: By problem: the shares, and why they are these.
LEAST: dict[str, tuple[dict[str, float], str]] = {
    "forked stems": (
        {"ball": 0.1},
        "a ball that no branch reaches is empty, one that a branch reaches is covered by more than a tenth; a branch "
        "may run beside its arm, so that the arm's share says less",
    ),
    "leaning discs": (
        {"disc": 0.1},
        "a quarter with less than a tenth looks bare: one branch grazes it",
    ),
    "sheaths": (
        {"trunk": 0.5, "crown": 0.1},
        "a crown that a branch reaches through the sheath is covered by more than a tenth",
    ),
    "shelves": (
        {"foot": 0.2, "quarter": 0.1},
        "as for the discs; the foot is wider than a trunk",
    ),
    "ledges": (
        {"foot": 0.2, "front": 0.05, "back": 0.05},
        "as for the shelves: both sides above the ledges have branches",
    ),
    "bent tube": (
        {"trunk": 0.3, "crown": 0.2},
        "a tree that ends early leaves the upper trunk to a tenth and the crown to nothing; thin trunks are trunks",
    ),
    "thin walls": (
        {"wall": 0.3, "side": 0.3},
        "a wall that leaves its place soon is covered by less than a third",
    ),
    "rows of towers": (
        {"tower": 0.5},
        "a tower that is half as high as it should be, or missing, is covered by less",
    ),
    "crescent": (
        {"tower": 0.3, "wing": 0.4},
        "a wing is covered to two thirds or not at all; the tower's region has corners that no tower fills",
    ),
    "two islands": (
        {"east": 0.4, "west": 0.4},
        "towers may be a little narrow; a search that founds one town has nothing of the other",
    ),
    "towns": (
        {"block": 0.4},
        "a block that got a green or a tower half as high is covered by less; greens are too low to count",
    ),
    "downtown": ({"block": 0.4}, "as for the towns; the park need not be there"),
    "ship": (
        {"hull": 0.6, "wings": 0.5, "pods": 0.2},
        "wings that end before the pods leave them empty; one block of a wing there is a quarter of them",
    ),
    "hulls": (
        {"hull": 0.6, "wing": 0.4, "pod": 0.15},
        "as for the ship; pods are long, and one block of a wing is less of them",
    ),
    "dart": (
        {"tail": 0.5, "nose": 0.5, "wings": 0.3},
        "wings are thin and swept: the blocks of a good result cover half of them",
    ),
    "garden tree": (
        {"cloud": 0.2, "crown": 0.2},
        "a cloud that is small, or beside its place, is a cloud and covers a fifth; one that is missing nothing",
    ),
    "coral fan": (
        {"third": 0.05},
        "arms are thin: a third that has two of them, from end to end, is covered by seven hundredths",
    ),
    "wall and tower": (
        {"stone": 0.4, "tower": 0.8},
        "stones are half as high as the target or higher; the tower is as wide as it may be, or nearly",
    ),
    "skylines": (
        {"tower": 0.7, "all": 0.93},
        "a tower that is missing has its lower half from others; at 7 % wrong pixels one storey is wrong",
    ),
    "strokes": (
        {"half": 0.75, "all": 0.93},
        "the stroke has few gaps in either half, and there are few blocks beside it",
    ),
    "face of blocks": (
        {"half": 0.9, "all": 0.975},
        "with 4 to 5 % wrong pixels, most of them at the profile, nobody sees a face: half of that is asked",
    ),
    "digits of pipes": (
        {"digit": 0.8, "all": 0.98},
        "both digits can be read; at 2 % wrong pixels hardly a pipe lies beside them",
    ),
    "long stems": (
        {"quarter": 0.3},
        "a stem that ends early leaves the last quarter empty; one that winds beside the target covers a third",
    ),
    "counted boards": (
        {"board": 0.5, "number": 1.0},
        "there are as many boards as in the target, and each is where one should be",
    ),
}


def is_complete(row: Mapping[str, Any]) -> bool:
    """Whether a search's record is of a result that has enough of each part, and is better than the empty scene."""
    is_better = row["score"] is not None and row["score"] > row["empty"]
    return is_better and has_enough(row["problem"], row["shares"])


def has_enough(problem: str, shares: Mapping[str, float]) -> bool:
    """Whether the shares of a scene's parts are enough."""
    least, _ = LEAST[problem]
    return all(
        share >= least_share
        for name, share in shares.items()
        for word, least_share in least.items()
        if word in name.split()
    )
