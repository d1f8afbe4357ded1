"""Rules about several settings of a method or kernel, by the names that the engine reports.

The engine checks them; the texts are the `expected` and the `suggestion` of `bad-setting`.
"""

from __future__ import annotations

NO_POWERS = "a kernel without powers of its own, which `anneal` and `tempering` have"

#: By rule: the value that is expected, and what to set.
RULES: dict[str, tuple[str, str]] = {
    "anneal-absolute": (
        "None with absolute weights, which have no schedule of powers",
        'None, or `weights` to "ratio"',
    ),
    "chains-draws": ("1 without `draws`, the number of states of each chain", "1"),
    "draws-kernel": ("None without `rejuvenate`, the kernel of the chains", "None"),
    "gradient-end": (
        "a kernel without `hmc_step` and `nuts_step`, because a particle that still runs has no gradient",
        'another kernel, or `at` to "end"',
    ),
    "kernel-powers": (NO_POWERS, "the kernel inside, and give `powers`"),
    "look-ahead-moves": (
        "None with `rejuvenate` of particles that still run, whose moves ignore it",
        'None, or `at` to "end"',
    ),
    "metric-numbers": ("variances above 0, or the rows of a covariance", '"diagonal"'),
    "moves-absolute": (
        "None with absolute weights, which follow no fixed distribution",
        'None, or `weights` to "ratio"',
    ),
    "moves-kernel": ("1 without `rejuvenate`, the kernel that moves particles", "1, or give `rejuvenate`"),
    "moves-powers": (NO_POWERS, "the kernel inside, and give `anneal`"),
    "pathfinder-start": ('"pathfinder" with the family "pathfinder"', '"pathfinder"'),
    "powers-falling": ("powers that fall from 1", "(1, 0.5, 0.25, 0.125)"),
    "powers-rising": ("a number of rungs, or powers that rise from above 0 to 1", "100"),
    "proposal-absolute": (
        "None with absolute weights, which ignore the density of a proposal",
        'None, or `weights` to "ratio"',
    ),
    "seconds-alone": ("no number of populations with `seconds`", "None"),
    "generations-diverse": ("None without `diverse`", "None, or give `diverse`"),
    "sizes-alone": ("None with a list of sizes", "None"),
    "tempered-absolute": (
        "another resampling with absolute weights, which no copy can carry on",
        '"systematic", or `weights` to "ratio"',
    ),
    "warmup-steps": ("fewer proposals than `steps`", "0, or `steps` to more"),
}
