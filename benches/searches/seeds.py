"""All seeds of the bench: those fixed before any search was tuned, and those drawn from the hash of a commit.

Seed k of a set makes the k-th target of a kind that is made from seeds, and searches it; the given targets are only
searched with it. Whoever changes a search develops on `tuning` and judges on `held_out`, once, at the end; or on
`commit`, seeds that nobody knew before the change was committed.
"""

import hashlib
from collections.abc import Sequence

#: How many searches there are for each problem and method, in the quick form, and at most.
FULL, QUICK, MOST = 20, 5, 40

SETS = {
    "tuning": tuple(range(2100, 2100 + MOST)),
    "held_out": tuple(range(7300, 7300 + MOST)),
}

#: The set whose seeds follow from the commit, and how many there are at most.
COMMIT, MOST_OF_COMMIT = "commit", 100


def drawn(commit: str, count: int) -> Sequence[int]:
    """Different seeds of a commit, below 2^31 and in neither fixed set."""
    known = {seed for seeds in SETS.values() for seed in seeds}
    seeds: dict[int, None] = {}
    number = 0
    while len(seeds) < count:
        digest = hashlib.sha256(f"{commit} {number}".encode()).digest()
        seed = int.from_bytes(digest[:4], "big") // 2
        number += 1
        if seed not in known:
            seeds[seed] = None
    return tuple(seeds)


#: What a method costs is found out on these, which are in neither set.
PILOT = (51, 52, 53)
