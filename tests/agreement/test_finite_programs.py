"""On random finite programs every method follows the exact answer, and every sample agrees with its choices.

Programs of `finite_programs`: futures of every shape, loops, closures, branches, shadowed names. Of each:

- plain Python and the engine do the same with the same choices, in both directions;
- particles in both orders, with every kind of resampling and of rejuvenation, particle Gibbs, PIMH and annealed
  importance sampling: a sample's value has a probability by enumeration, and plain Python with the sample's choices
  gives its value and scores;
- the evidence is unbiased, and each value has its share: z-scores against enumeration. Few particles and many small
  populations are most sensitive, as nothing averages an error away;
- states of Markov chains agree with their choices, and the four strategies agree to the bit.

The same of programs with memoised functions, without kernels that grow a part again.

Programs whose every run looks at a future that is not forced are refused by each of them.

A quantity is wrong only if it is wrong twice: by 5 standard errors, and then with fresh seeds and sixteen times the
runs by 7. Only values with a share of at least a twentieth are counted. The least standard error is the one of
three runs, so that rare runs that never occurred do not count against a method. For a share of a twentieth, chance
passes both bounds on its binomial count once in 1e13. A soak of an hour checks less than 1e7 quantities, so it fails
once in a million.

Mutants. Each method is judged by the answer of a program that lacks what counts twice in its own, and must be wrong by
it. Two wrong engines have failed. In one, `force` read its future from a register that was overwritten (in `place.rs`,
no `SiteKind::Force` among those that are read again, and no check of it in `verify.rs`): every fourth or fifth program
failed. In the other, chains tested, of `a or b`, a value of the last run (in `expressions.rs`, `shortcut` jumps by
`to`; no check of it in `verify.rs`): the 974th and the 114th program of two runs failed, and `EITHER` is their reduced
form.
"""

from __future__ import annotations

import linecache
import math
import os
import secrets
import time
from collections import Counter
from collections.abc import Iterable
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from finite_programs import looking, reduced, text
from niwaki import kernels
from niwaki.errors import ModelError, NiwakiError
from niwaki.lang import futures
from niwaki.lang.plain import run_python
from test_chains import disagreement
from test_engine import compared, differs, facts, load

#: Strategies of chains, as in the engine.
STRATEGIES = ("c3", "rerun", "resume", "cache")
#: Methods of resampling, as in the engine.
RESAMPLING = ("systematic", "residual", "stratified", "multinomial", "tempered")

#: Programs of `make test`; the long test tries new ones for as long as it is told.
PROGRAMS = 14
#: Those with memoised functions.
MEMOISED = 8
#: States of a chain.
STATES = 150
#: As many values of a method's samples are run again in plain Python.
AGAIN = 6
#: Longer enumerations are left out.
MOST_RUNS = 5000
#: Values less probable are not counted.
LEAST_SHARE = 0.05
FIRST_LIMIT, LIMIT = 5.0, 7.0
#: Populations, annealed searches, runs of particle Gibbs, and batches of a chain at the first look; the second has
#: sixteen times as many.
POPULATIONS, ANNEALED, STARTS, BATCHES, BATCH, TIMES = 150, 60, 60, 40, 20, 16

#: Of programs with memoised functions: no part of a run can be grown again.
SHARED = kernels.mixture(kernels.prior(), kernels.neighbour(), kernels.regenerate(1))
MOVES = kernels.mixture(kernels.prior(), kernels.neighbour(), kernels.regenerate(1), kernels.regrow(3))


def populations(count: int, seed: int, moves: Any = MOVES) -> dict[str, nw.methods.Smc]:
    """Particles, as each method has them; what is drawn from the seed does not decide what is right."""
    table: dict[str, Any] = {
        "particles": 2 + seed % 3,
        "populations": count,
        "resampling": RESAMPLING[seed % len(RESAMPLING)],
    }
    moved = {**table, "rejuvenate": moves}
    return {
        "particles": nw.smc(**table),
        "particles, depth first": nw.smc(order="depth-first", **table),
        "particles, resampled when few are effective": nw.smc(ess=0.6, **table),
        "particles, moved": nw.smc(at=1 + seed % 2, **moved),
        "particles, moved depth first": nw.smc(at="resampled", order="depth-first", **moved),
        "particles, final chain": nw.smc(at="end", draws=2, **moved),
    }


def gibbs(seed: int) -> dict[str, nw.methods.ParticleGibbs]:
    """Particle Gibbs, from a start that follows the posterior: so does what it comes to."""
    order = ("stochastic", "depth-first")[seed % 2]
    return {
        "particle Gibbs": nw.particle_gibbs(2 + seed % 3, 2),
        "particle Gibbs by tempered weights": nw.particle_gibbs(5, 2, order, resampling="tempered"),
        "particle Gibbs that keeps ancestors": nw.particle_gibbs(3, 2, order, ancestors=False),
    }


def pimh(sweeps: int, seed: int) -> nw.methods.Pimh:
    """A chain of populations."""
    return nw.pimh(5 + seed % 3, sweeps, ("stochastic", "depth-first")[seed // 2 % 2])


def annealed(seed: int, moves: Any = MOVES) -> nw.methods.Ais:
    """Two particles on a short ladder, which is as sensitive as few particles are."""
    return nw.ais(2, ((0.3, 1), (0.1, 0.4, 1))[seed % 2], moves, 1 + seed % 3, tries=10**6)


METHODS = (*populations(1, 0), *gibbs(0), "PIMH", "AIS")
#: Moves of one choice need not reach every value, so its shares are not judged.
CHAIN = "Markov chain"


class Tally:
    """Counts of the programs and quantities that were checked."""

    def __init__(self) -> None:
        self.programs = self.looks = self.replays = self.quantities = self.looked_twice = 0
        self.skipped: Counter[str] = Counter()

    def __str__(self) -> str:
        return (
            f"{self.programs} programs, {self.looks} that look at futures, {self.replays} samples run "
            f"again in plain Python, {self.quantities} quantities against the "
            f"exact answer ({self.looked_twice} looked at twice); left out: {dict(self.skipped)}"
        )


class Exact:
    """The exact answer of a program."""

    def __init__(self, model: Any) -> None:
        result = nw.run(model, nw.enumerate_all(max_runs=MOST_RUNS))
        assert result.log_evidence is not None
        self.log_evidence = result.log_evidence
        self.shares: dict[str, float] = {}
        for value, share in result.distribution().items():
            name = value if isinstance(value, str) else repr(value)
            self.shares[name] = self.shares.get(name, 0.0) + share
        self.counted = [name for name, share in self.shares.items() if share >= LEAST_SHARE]

    def scores(self, rows: np.ndarray, truths: list[float]) -> list[float]:
        """How many standard errors the means of columns are from the truths."""
        n = len(rows)
        error = np.sqrt(rows.var(axis=0) / n + (3.0 / n) ** 2)
        return list((rows.mean(axis=0) - truths) / error)

    def of_populations(self, result: Any, count: int) -> list[float]:
        """Evidence, and evidence in each value, relative to the truth: of each population, none of those that died."""
        size = len(result) // (count - result.info.died)
        scale = math.exp(result.log_evidence - self.log_evidence) / result.info.plan[0]
        rows = np.zeros((count, 1 + len(self.counted)))
        for i, sample in enumerate(result):
            weight = math.exp(sample.log_weight) * scale
            rows[i // size, 0] += weight
            name = repr(sample.value)
            if name in self.counted:
                rows[i // size, 1 + self.counted.index(name)] += weight
        return self.scores(rows, [1.0, *(self.shares[name] for name in self.counted)])

    def of_searches(self, searches: list[Any]) -> list[float]:
        """Return z-scores of searches whose mean weight is the evidence."""
        rows = np.zeros((len(searches), 1 + len(self.counted)))
        for row, search in zip(rows, searches, strict=True):
            for sample in search:
                weight = math.exp(sample.log_weight - self.log_evidence) / len(search)
                row[0] += weight
                name = repr(sample.value)
                if name in self.counted:
                    row[1 + self.counted.index(name)] += weight
        return self.scores(rows, [1.0, *(self.shares[name] for name in self.counted)])

    def of_values(self, names: list[str]) -> list[float]:
        """The share of each value, of independent draws."""
        rows = np.array([[name == other for other in self.counted] for name in names], float)
        return self.scores(rows.reshape(len(names), -1), [self.shares[name] for name in self.counted])

    def of_chain(self, names: list[str]) -> list[float]:
        """The share of each value, by batches; the first batches are the warm-up."""
        size = len(names) // (BATCHES + BATCHES // 10)
        rows = np.array(
            [[name == other for other in self.counted] for name in names[-BATCHES * size :]], float
        )
        means = rows.reshape(BATCHES, size, -1).mean(axis=1)
        error = np.sqrt(means.var(axis=0) / BATCHES + (3.0 / (BATCHES * size)) ** 2)
        return list((means.mean(axis=0) - [self.shares[name] for name in self.counted]) / error)


def exact_draws(model: Any, count: int, seed: int) -> Any:
    """Draws by rejection, under a bound that many runs do not reach, or under a higher one."""
    bound = nw.run(model, nw.importance(1000), seed=seed, threads=1).best.log_score
    while True:
        try:
            return nw.run(model, nw.rejection(count, bound), seed=seed, threads=1)
        except NiwakiError as error:
            if error.code != "rejection-bound":
                raise
            bound += 0.5


def check_samples(
    model: Any, exact: Exact, name: str, times: int, seed: int, tally: Tally, moves: Any = MOVES
) -> tuple[str, float]:
    """Return the fault of a method's samples, or nothing, and the largest z-score."""
    scores: list[float] = []
    if name in gibbs(0):
        starts = exact_draws(model, STARTS * times, seed)
        runs = [
            nw.run(model, gibbs(seed)[name], choices=start.choices, seed=seed + i, threads=1)
            for i, start in enumerate(starts)
        ]
        samples = [run[-1] for run in runs]
        scores = exact.of_values([repr(sample.value) for sample in samples])
    elif name == CHAIN:
        method = nw.mh(STATES * times, kernel=moves, thin=1, keep=STATES * times)
        samples = nw.run(model, method, seed=seed, threads=1).samples
    elif name == "PIMH":
        samples = nw.run(
            model, pimh((BATCHES + BATCHES // 10) * BATCH * times, seed), seed=seed, threads=1
        ).samples
        scores = exact.of_chain([repr(sample.value) for sample in samples])
    elif name == "AIS":
        method = annealed(seed, moves)
        searches = [nw.run(model, method, seed=seed + i, threads=1) for i in range(ANNEALED * times)]
        scores = exact.of_searches(searches)
        samples = [sample for search in searches for sample in search]
    else:
        count = POPULATIONS * times
        result = nw.run(model, populations(count, seed, moves)[name], seed=seed, threads=1)
        scores = exact.of_populations(result, count)
        samples = [sample for sample in result if sample.log_weight > -math.inf]
    # One of each value, of a few, is run again; and some of a chain, whose states are made of each other.
    seen: set[str] = set()
    for i, sample in enumerate(samples):
        value = repr(sample.value)
        if value not in exact.shares:
            return f"{name}: the value {value} has no probability", math.inf
        if (value not in seen and len(seen) < AGAIN) or (name == CHAIN and i % 10 == 0):
            seen.add(value)
            tally.replays += 1
            plain = facts(run_python(model, choices=sample.choices))
            engine_facts = {
                **plain,
                "value": sample.value,
                "log_prior": sample.log_prior,
                "log_score": sample.log_score,
            }
            if wrong := compared(plain, engine_facts):
                return (
                    f"{name}: plain Python with the choices {plain['choices']} has another {wrong}",
                    math.inf,
                )
    tally.quantities += len(scores)
    return "", max(map(abs, scores), default=0.0)


def wrong(program: str, seed: int, tally: Tally | None = None) -> str:
    """Return the fault of a program, or nothing."""
    tally = tally or Tally()
    if fault := differs(program):
        return fault
    try:
        model = load(program)
        model.core()
    except (SyntaxError, ModelError) as error:
        tally.skipped[getattr(error, "code", "syntax")] += 1
        return ""
    try:
        run_python(model, seed=seed)
        exact = Exact(model)
    except NiwakiError as error:
        tally.skipped[error.code] += 1
        return ""
    moves = SHARED if "mem(" in program or "@mem" in program else MOVES
    for name in (*METHODS, CHAIN):
        try:
            fault, z = check_samples(model, exact, name, 1, seed, tally, moves)
            if not fault and z > FIRST_LIMIT:
                tally.looked_twice += 1
                fault, z = check_samples(model, exact, name, TIMES, seed + 2**32, tally, moves)
                if z > LIMIT:
                    fault = fault or f"{name}: {z:.1f} standard errors from the exact answer"
        except NiwakiError as error:
            fault = f"{name}: {error}"
        if fault:
            return fault
    if fault := disagreement(program, seed, 80):
        return f"strategies: {fault}"
    tally.programs += 1
    return ""


def answers_a_look(program: str, seed: int) -> str:
    """The executor that does not refuse a program that uses a future without `force`, or an empty text."""
    model = load(program)
    try:
        model.core()
    except (SyntaxError, ModelError):
        return ""
    smooth = load(program.replace("def m():\n", "def m():\n    x = gaussian(0, 1)\n"))
    methods: dict[str, Any] = {
        **populations(2, seed),
        **gibbs(seed),
        "PIMH": pimh(2, seed),
        "AIS": annealed(seed),
        "forward": nw.forward(2),
        "importance": nw.importance(2),
        "rejection": nw.rejection(1, 9.0),
        "enumeration": nw.enumerate_all(),
        **{name: nw.mh(5, kernel=MOVES, strategy=name) for name in STRATEGIES},
    }
    runs = {name: lambda method=method: nw.run(model, method, seed=seed) for name, method in methods.items()}
    runs["plain Python"] = lambda: run_python(model, seed=seed)
    runs["gradients"] = lambda: nw.run(smooth, nw.hmc(2, warmup=2), seed=seed)
    for name, run in runs.items():
        try:
            run()
        except NiwakiError as error:
            if error.code == "future-not-forced":
                continue
            return f"{name}: {error}"
        return f"{name}: answers"
    return ""


def look(seeds: Iterable[int], tally: Tally, memo: bool = False) -> None:
    """Looks at programs; the first that is wrong is made smaller and reported."""
    before = set(linecache.cache)
    for seed in seeds:
        program, looks = text(seed, memo=memo), looking(seed)
        if fault := answers_a_look(looks, seed):
            pytest.fail(f"seed {seed}: {fault}\n{looks}")
        tally.looks += 1
        try:
            fault = wrong(program, seed, tally)
        except Exception as error:
            raise AssertionError(f"seed {seed}:\n{program}") from error
        if fault:
            small = reduced(program, lambda less: still_wrong(less, seed, fault))  # noqa: B023
            pytest.fail(f"seed {seed}: {fault}\n{small}\n{wrong(small, seed)}")
        # The texts of programs that were looked at, and of nothing else.
        for name in set(linecache.cache) - before:
            del linecache.cache[name]


def still_wrong(program: str, seed: int, before: str) -> bool:
    """Whether a program, which may be none any more, is wrong as it was before."""
    try:
        return wrong(program, seed).partition(":")[0] == before.partition(":")[0]
    except Exception:
        return False


#: A future that one branch creates, forced where nothing waited for it before.
CHOSEN = """from niwaki import model; from niwaki.words import *

def leaf():
    factor(-0.1)
    return 7

@model
def m():
    f = future(leaf) if flip(0.5) else None
    v = force(f)
    factor(0.0 if v is None else 3.0)
    return v
"""

#: A truth value that is made of an earlier one, and kept past a barrier.
EITHER = """from niwaki import model; from niwaki.words import *

@model
def m():
    b = flip(0.6)
    c = flip(0.3) or b
    factor(-0.1)
    return c
"""

#: A truth value that `or` and `and` write in several places, where a future's argument changes below them.
SEVERAL = """from dataclasses import dataclass
from niwaki import model; from niwaki.words import *

LOGS = (0.0, -0.7, 0.6)
@dataclass(frozen=True)
class Both:
    first: object
    second: object
def late(promise, n=1):
    factor(LOGS[n % 3])
def h0(n, b=True):
    k = categorical([1.0, 2.0, 1.0])
    return k % 3
@model
def m():
    n, b = 0, flip(0.6)
    f1 = future(h0, n) if b else n
    if flip(0.8):
        c3 = ((n if (n > 1) else n) + (n - 2)) % 3
    c4 = ((not (n % 2 == 0)) or (n % 2 == 0)) and (not (2 % 2 == 0))
    r5 = Both(future(late, f1), f1)
    return (n, b, c4, f1)
"""

ONCE = """from niwaki import model; from niwaki.words import *

def leaf(n):
    factor(0.5 if n > 1 else -0.2)
    k = 1 if flip(0.4) else 0
    factor(0.6 * k)
    return k

@model
def m():
    fs = [future(leaf, 1), future(leaf, 2)]
    b = flip(0.5)
    n = sum([force(q) for q in fs])
    factor(0.3 * n if b else 0.0)
    return (n, b)
"""


def test_a_force_that_waits_reads_what_it_waits_for() -> None:
    assert not wrong(CHOSEN, 1)
    assert Exact(load(CHOSEN)).shares["7"] == pytest.approx(1 / (1 + math.exp(-2.9)))


def test_a_chain_tests_what_it_has_now() -> None:
    assert not wrong(EITHER, 1)


def test_what_several_places_write_is_not_set_back() -> None:
    assert not wrong(SEVERAL, 1)


@pytest.mark.parametrize("name", METHODS)
def test_a_factor_that_counts_twice_is_seen(name: str) -> None:
    """The mutant of every method: what it follows is not the program that it is judged by. At `TIMES` particle Gibbs is
    about as far off as the limit, so it looks at the wrong program twice as often; the others are off by twice the
    limit at a quarter.
    """
    twice = load(ONCE.replace("0.6 * k", "1.2 * k"))
    few, many = TIMES // 4, 2 * TIMES if name in gibbs(0) else TIMES // 4
    assert check_samples(load(ONCE), Exact(load(ONCE)), name, few, 5, Tally())[1] < FIRST_LIMIT
    assert check_samples(twice, Exact(load(ONCE)), name, many, 5, Tally())[1] > LIMIT


def test_an_executor_that_answers_a_look_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """The mutant of plain Python: a future is its value. Those of the engine are in `tests/mutants`."""
    assert not any(answers_a_look(looking(seed), seed) for seed in range(5))
    monkeypatch.setattr(futures, "Future", lambda value: value)
    assert any(answers_a_look(looking(seed), seed).startswith("plain") for seed in range(5))


def test_every_method_follows_the_exact_answer() -> None:
    tally = Tally()
    look(range(PROGRAMS), tally)
    print(tally)
    assert tally.programs > 0.5 * PROGRAMS


def test_every_method_follows_the_exact_answer_with_memoised_functions() -> None:
    tally = Tally()
    look(range(MEMOISED), tally, memo=True)
    print(tally)
    assert tally.programs > 0.3 * MEMOISED


@pytest.mark.soak
def test_every_method_follows_the_exact_answer_for_long() -> None:
    """For `NIWAKI_FUZZ_SECONDS` (600), from a fresh seed that is printed; `NIWAKI_SEED` repeats one."""
    first = int(os.environ.get("NIWAKI_SEED", secrets.randbelow(2**31)))
    seconds = float(os.environ.get("NIWAKI_FUZZ_SECONDS", "600"))
    print(f"NIWAKI_SEED={first}", flush=True)
    tally, began, printed = Tally(), time.monotonic(), 0.0
    seed = first
    while (spent := time.monotonic() - began) < seconds:
        look([seed], tally, memo=seed % 2 == 0)
        seed += 1
        if spent > printed:
            print(f"{spent:.0f} s: {tally}", flush=True)
            printed = spent + 60
    print(tally, flush=True)
