"""All seeds of the bench, fixed before any search was tuned.

Seed k of a set makes the k-th target of a kind that is made from seeds, and searches it; the given targets are only
searched with it. Whoever changes a search develops on `tuning` and judges on `held_out`, once, at the end.
"""

#: How many searches there are for each problem and method, in the quick form, and at most.
FULL, QUICK, MOST = 20, 5, 40

SETS = {
    "tuning": tuple(range(2100, 2100 + MOST)),
    "held_out": tuple(range(7300, 7300 + MOST)),
}

#: What a method costs is found out on these, which are in neither set.
PILOT = (51, 52, 53)
