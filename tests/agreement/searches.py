"""Searches of random programs by populations or chains; prints all that they say, as JSON by seed.

    python searches.py FIRST COUNT [populations | chains]

A program is that of `programs` as a function, called from a loop with choices of all kinds, observations and factors.
Some have jumps that depend on choices, so that particles part and meet.
"""

from __future__ import annotations

import hashlib
import json
import random
import sys

import niwaki as nw
from niwaki.errors import NiwakiError
from programs import program
from test_engine import load

#: Strategies of chains, as in the engine.
STRATEGIES = ("c3", "rerun", "resume", "cache")

BODY = """

inner = m


@model
def around():
    x, n, b = 0.5, 2, True
    kept = []
    for i in range({barriers}):
        x = gaussian(x, 0.5)
        {choices}
        {jump}
        observe(Gaussian(x, 1.0), 0.1 * i)
        factor(-0.05 * abs(n) * {scale})
        {call}
    return (x, n, b, kept)

m = around
"""

#: Most steps of a search: one program in a hundred takes more, and some of those would take minutes.
STEPS = 5_000

CHOICES = [
    "n = poisson(2.0)",
    "b = flip(0.4)",
    "n = categorical([0.2, 0.5, 0.3]) + n % 3",
    "x = x * uniform(0.5, 1.0)",
    "pair = (uniform(0.0, 1.0), n); x = x + pair[0]; kept = kept + [pair[1]]",
    "kept = kept + [x]",
    "x = max(-5, min(x, 5.0))",
    "n = int(abs(x) * 3) - n",
]
JUMPS = [
    "pass",
    "pass",
    "if x > 1.2: x = x - uniform(0.0, 1.0)",
    "if i % 3 == 2: n = n + 1",
    "if b: x = 0.9 * x",
]


def text(seed: int) -> str:
    """The module of a search."""
    pick = random.Random(seed)
    base = program(seed, pick.randint(1, 5)).text
    return base + BODY.format(
        barriers=pick.randint(2, 8),
        choices="; ".join(pick.sample(CHOICES, 2)),
        jump=pick.choice(JUMPS),
        scale=pick.choice([0.5, 1, 2]),
        call=pick.choice(["pass", "pass", "if i == 2: inner()"]),
    )


def population(pick: random.Random) -> nw.smc:
    """Some population."""
    return nw.smc(
        particles=pick.choice([16, 40, 100]),
        order=pick.choice(["depth-first", "stochastic"]),
        resampling=pick.choice(["systematic", "residual", "stratified", "multinomial", "tempered"]),
        ess=pick.choice([None, 0.5]),
    )


def chain(pick: random.Random) -> nw.mh:
    """Some chain."""
    return nw.mh(steps=pick.choice([50, 300]), strategy=pick.choice(STRATEGIES))


def result_hash(seed: int, kind: str) -> str:
    """Return the hash of the result of a program's search, or the message of its failure."""
    pick = random.Random(seed + 1)
    method = population(pick) if kind == "populations" else chain(pick)
    try:
        result = nw.run(
            load(text(seed)), method=method, seed=seed, max_steps=STEPS, threads=pick.choice([1, 2])
        )
    except NiwakiError as error:
        return f"{type(error).__name__}: {error}"
    facts = [
        (
            sorted(s.choices.items()),
            repr(s.value),
            *(x.hex() for x in (s.log_prior, s.log_score, s.log_weight)),
        )
        for s in result
    ]
    evidence = None if result.log_evidence is None else float(result.log_evidence).hex()
    effort = result.info.steps if kind == "populations" else (result.info.acceptance, result.info.counters)
    return f"{evidence} {effort} " + hashlib.sha256(repr(facts).encode()).hexdigest()


if __name__ == "__main__":
    first, count = map(int, sys.argv[1:3])
    kind = sys.argv[3] if len(sys.argv) > 3 else "populations"
    print(json.dumps({str(seed): result_hash(seed, kind) for seed in range(first, first + count)}))
