"""Claim: a run is invalid where a distribution has parameters out of range, a shape cannot be, or a host function
fails. It has probability zero in every search and is counted by place in the result, with a call as an example; alone,
and where every run meets it, it is an error with its line. What is no exception about the model (Ctrl-C, an exit, no
memory) is raised as it is.

Shares are over independent runs and within 5 standard errors of the sums over all runs: one false alarm in 1.7 million
each, about 120 are looked at.
"""

from __future__ import annotations

import linecache
import math
from collections import Counter
from typing import Any

import niwaki as nw
import pytest
from niwaki import batches, kernels
from niwaki.result import Invalid
from niwaki.words import Gaussian


@nw.host
def table(n: int) -> float:
    if n > 2:
        raise LookupError(f"there is no entry {n}")
    return 0.5 * n


@nw.model
def by_parameter() -> tuple[int, bool]:
    n = nw.discrete_uniform(0, 4)
    a = nw.flip((n + 1) / 3)
    nw.observe(Gaussian(0.5 * n, 1.0), 1.0)
    return n, a


@nw.model
def by_shape() -> tuple[int, bool]:
    n = nw.discrete_uniform(0, 4)
    nw.emit(nw.box((0, 0, 0), (1, 2.5 - n, 1)))
    a = nw.flip((n % 3 + 1) / 3)
    nw.observe(Gaussian(0.5 * n, 1.0), 1.0)
    return n, a


@nw.model
def by_host() -> tuple[int, bool]:
    n = nw.discrete_uniform(0, 4)
    x = table(n)
    a = nw.flip((n % 3 + 1) / 3)
    nw.observe(Gaussian(x, 1.0), 1.0)
    return n, a


def row(n: int) -> tuple[int, bool]:
    """Choices after the fault, and before it."""
    x = table(n)
    a = nw.flip((n % 3 + 1) / 3)
    nw.observe(Gaussian(x, 1.0), 1.0)
    return n, a


@nw.model
def in_future() -> tuple[int, bool]:
    n = nw.discrete_uniform(0, 4)
    f = nw.future(row, n)
    return nw.force(f)


@nw.model
def in_memoised() -> tuple[int, bool]:
    n = nw.discrete_uniform(0, 4)
    kept = nw.mem(lambda k: table(k))
    x = kept(n)
    a = nw.flip((n % 3 + 1) / 3)
    nw.observe(Gaussian(kept(n), 1.0), 1.0 + x - x)
    return n, a


def sized(n: int) -> bool:
    return nw.flip((n + 1) / 3)


@nw.model
def in_infer() -> tuple[int, bool]:
    n = nw.discrete_uniform(0, 4)
    a = nw.infer(sized, nw.forward(), n)
    nw.observe(Gaussian(0.5 * n, 1.0), 1.0)
    return n, a


@nw.model
def in_loop() -> tuple[int, bool]:
    n = nw.discrete_uniform(0, 4)
    x = 0.0
    for i in range(n):
        x = x + 0.5
        nw.emit(nw.disc((i, 0, 0), 1.5 - i))
    a = nw.flip((n % 3 + 1) / 3)
    nw.observe(Gaussian(x, 1.0), 1.0)
    return n, a


MODELS = [by_parameter, by_shape, by_host, in_future, in_memoised, in_infer, in_loop]

#: The place of each, as its name and a part of the line.
PLACES = {
    "by_parameter": ("bernoulli", "nw.flip("),
    "by_shape": ("box", "nw.emit("),
    "by_host": ("table", "table(n)"),
    "in_future": ("table", "table(n)"),
    "in_memoised": ("table", "table(k)"),
    "in_infer": ("bernoulli", "nw.infer("),
    "in_loop": ("disc", "nw.emit("),
}

#: A call that fails, as text.
CALLS = {
    "bernoulli": "bernoulli(1.3333333333333333)",
    "box": "box((0, 0, 0), (1, -0.5, 1), None, 1.0, 'z')",
    "table": "table(3)",
    "disc": "disc((2, 0, 0), -0.5)",
}


def exact(below: int = 3) -> dict[tuple[int, bool], float]:
    """The posterior of each model, summed by hand: n is even over 0 to 4, and from `below` on the run is invalid."""
    weights = {
        (n, a): math.exp(-0.5 * (1.0 - 0.5 * n) ** 2) * ((n + 1) / 3 if a else 1 - (n + 1) / 3)
        for n in range(below)
        for a in (True, False)
    }
    total = sum(weights.values())
    return {value: weight / total for value, weight in weights.items() if weight > 0}


METHODS: list[Any] = [
    nw.smc(particles=2000),
    nw.smc(particles=[200, 100]),
    nw.smc(particles=500, rejuvenate=kernels.prior()),
    nw.importance(1000),
    nw.rejection(500, max_tries=20_000),
    nw.particle_gibbs(20, sweeps=50),
    nw.pimh(20, sweeps=50),
    nw.mh(steps=2000),
    nw.mh(steps=2000, kernel=kernels.block(share=0.5)),
    nw.mh(steps=500, kernel=kernels.regenerate(), strategy="rerun"),
    nw.mh(steps=500, kernel=kernels.tempering(kernels.prior(), [1.0, 0.5])),
    nw.mh(steps=500, kernel=kernels.regrow(4)),
    nw.ais(particles=200, powers=10, moves=2),
    nw.improve(rounds=2),
    nw.enumerate_all(),
]


def fits(model: Any, method: Any) -> bool:
    """Whether a method suits a model at all: parts with memoised functions cannot be grown again."""
    text = repr(method)
    if model is in_memoised and ("regrow" in text or "improve" in text):
        return False
    # Seeds of an inner search cannot be listed.
    return not (model is in_infer and "EnumerateAll" in text)


@pytest.mark.parametrize("method", METHODS, ids=repr)
@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_invalid_runs_have_no_weight_and_are_counted_by_place(model: Any, method: Any) -> None:
    if not fits(model, method):
        pytest.skip("the method is not for this model")
    result = nw.run(model, method=method, seed=1)
    name, text = PLACES[model.name]
    # A chain may start from a valid run and never propose another one.
    assert len(result.invalid) == 1, result.invalid
    (place,) = result.invalid
    assert isinstance(place, Invalid) and place.name == name and place.runs > 0
    assert place.file == __file__
    assert text in linecache.getline(__file__, place.line)
    assert place.call == CALLS[name]
    assert place.reason and str(place).startswith(
        f"`{name}` at test_invalid.py:{place.line}, {place.runs} run"
    )
    assert {value for value, p in result.distribution().items() if p > 0} <= set(exact())
    assert f"{place.runs} invalid" in repr(result)
    if result.log_evidence is not None:
        assert "with invalid runs as zero" in repr(result)


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_shares_are_those_of_the_valid_runs(model: Any) -> None:
    shares = nw.run(model, method=nw.rejection(4000), seed=2).distribution()
    for value, p in exact().items():
        assert abs(shares.get(value, 0.0) - p) < 5 * math.sqrt(p * (1 - p) / 4000)
    weighted = nw.run(model, method=nw.importance(4000), seed=3)
    # Two of five values of n have no weight: the evidence is the mean over all five.
    weights = [math.exp(-0.5 * (1.0 - 0.5 * n) ** 2) / math.sqrt(math.tau) for n in range(3)]
    evidence, square = sum(weights) / 5, sum(w * w for w in weights) / 5
    assert weighted.log_evidence is not None
    error = math.sqrt((square - evidence**2) / 4000)
    assert abs(math.exp(weighted.log_evidence) - evidence) < 5 * error
    (place,) = weighted.invalid
    assert abs(place.runs - 1600) < 5 * math.sqrt(4000 * 0.4 * 0.6)


@pytest.mark.parametrize(
    "method", [sample for sample in METHODS if "EnumerateAll" not in repr(sample)], ids=repr
)
@pytest.mark.parametrize("model", [by_shape, by_host, in_future], ids=lambda model: model.name)
def test_threads_change_nothing(model: Any, method: Any) -> None:
    alone = nw.run(model, method=method, seed=5, threads=1)
    for threads in (2, 3):
        several = nw.run(model, method=method, seed=5, threads=threads)
        assert several.invalid == alone.invalid
        assert [sample.choices for sample in several if sample.has_ended] == [
            sample.choices for sample in alone if sample.has_ended
        ]


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_runs_from_the_prior_are_those_that_are_valid(model: Any) -> None:
    result = nw.run(model, method=nw.forward(500), seed=1)
    (place,) = result.invalid
    assert len(result) + place.runs == 500
    counts = Counter(sample.value[0] for sample in result)
    assert set(counts) == {0, 1, 2}
    for n in range(3):
        # Each run has the value with probability 1/5.
        assert abs(counts[n] - 100) < 5 * math.sqrt(500 * 0.2 * 0.8)


def test_a_held_choice_may_be_invalid() -> None:
    with pytest.raises(nw.ModelFault, match="no entry 3"):
        nw.run(by_host, method=nw.importance(50), seed=1, hold={"n": 3})
    held = nw.run(by_host, method=nw.importance(50), seed=1, hold={"a": True})
    assert held.invalid[0].call == "table(3)" and {
        sample.value[0] for sample in held if sample.has_ended
    } <= {0, 1, 2}


def test_enumeration_leaves_invalid_runs_out() -> None:
    for model in (by_parameter, by_shape, by_host, in_future, in_loop):
        result = nw.run(model, method=nw.enumerate_all())
        shares = {value: p for value, p in result.distribution().items() if p > 0}
        assert shares.keys() == exact().keys()
        assert all(math.isclose(shares[value], p) for value, p in exact().items())
        assert result.invalid[0].runs == (
            2 if model in (by_shape, by_host, in_future, in_loop, by_parameter) else 0
        )


@nw.model
def border() -> float:
    x = nw.uniform(0, 1)
    y = nw.uniform(0.5, x)
    nw.observe(Gaussian(y, 0.2), 0.7)
    return x


@nw.model
def plate() -> float:
    x = nw.gaussian(0.2, 0.5)
    nw.emit(nw.box((0, 0, 0), (1, x, 1)))
    nw.observe(Gaussian(x, 0.8), -0.1)
    return x


TRAJECTORIES: list[Any] = [
    nw.nuts(draws=300, chains=2),
    nw.hmc(draws=300, chains=2),
    nw.hmc(draws=50, chains=16),
]


@pytest.mark.parametrize("method", TRAJECTORIES, ids=repr)
@pytest.mark.parametrize("model", [border, plate], ids=lambda model: model.name)
def test_trajectories_end_at_the_border(model: Any, method: Any) -> None:
    result: Any = nw.run(model, method=method, seed=1)
    (place,) = result.invalid
    assert (place.name, place.line - model.function.__code__.co_firstlineno) == (
        ("uniform", 3) if model is border else ("box", 3)
    )
    assert result.divergences.impossible > 0
    assert result.divergences.not_finite == 0 and result.fault is None
    assert result.draws["x"].min() > (0.5 if model is border else 0.0)
    assert all(math.isfinite(sample.log_score) for sample in result)


def test_chains_go_on_counting() -> None:
    result: Any = nw.run(by_host, method=nw.mh(steps=500), seed=1)
    before = result.invalid[0].runs
    assert result.more(500).invalid[0].runs > before
    assert nw.run(by_host, method=nw.mh(steps=500), seed=1).invalid[0].runs == before


def test_a_chain_starts_from_a_valid_run_and_counts_the_others() -> None:
    result: Any = nw.run(by_host, method=nw.mh(steps=1, chains=40), seed=1)
    (place,) = result.invalid
    # Before each start as many as a geometric number with success 3/5; of the proposals, half are to `n`.
    mean, variance = 2 / 3 + 0.5 * 0.4, 0.4 / 0.36 + 0.2 * 0.8
    assert abs(place.runs - 40 * mean) < 5 * math.sqrt(40 * variance)
    with pytest.raises(nw.ModelFault, match="no entry 4"):
        nw.run(by_host, method=nw.mh(steps=10), seed=1, choices={"n": 4})


def test_a_search_of_several_runs_counts_all_of_them() -> None:
    search = nw.Search(by_host, method=nw.smc(50), runs=3, keep="all", polish=nw.mh(50))
    result = search.run()
    alone = [
        nw.Search(by_host, method=nw.smc(50), seed=search.seed + k).run().invalid[0].runs for k in range(3)
    ]
    assert result.invalid[0].runs >= sum(alone) > 0


def test_a_batch_keeps_the_counts() -> None:
    search = nw.Search(by_host, method=nw.importance(200), seed=1)
    (stored,) = batches.batch(search, seeds=[1], processes=1)
    (place,) = stored.result.invalid
    (whole,) = search.run().invalid
    assert (place.name, place.line, place.runs, place.call) == (
        whole.name,
        whole.line,
        whole.runs,
        whole.call,
    )
    # Nothing of a machine is stored: neither the folder of a file nor the text of an exception.
    assert (place.file, place.reason) == ("test_invalid.py", "")


@nw.model
def always(s: float) -> float:
    return nw.gaussian(0, -s)


@nw.model
def never_a_box(s: float) -> float:
    x = nw.flip()
    nw.emit(nw.box((0, 0, 0), (1, -s, 1)))
    return x


@nw.model
def never_an_entry(s: float) -> float:
    x = nw.flip()
    return x + table(int(s) + 7)


@pytest.mark.parametrize(
    ("model", "code", "text"),
    [
        (always, "bad-parameter", "nw.gaussian(0, -s)"),
        (never_a_box, "bad-shape", "nw.box((0, 0, 0), (1, -s, 1))"),
        (never_an_entry, "host-function", "table(int(s) + 7)"),
    ],
    ids=lambda part: getattr(part, "name", None),
)
@pytest.mark.parametrize("method", [*METHODS, nw.forward(20)], ids=repr)
def test_what_every_run_meets_is_raised_with_its_line(model: Any, code: str, text: str, method: Any) -> None:
    with pytest.raises(nw.ModelFault) as caught:
        nw.run(model, 1.0, method=method, seed=1)
    assert caught.value.code == code
    assert text in caught.value.render()


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_a_run_of_its_own_is_raised(model: Any) -> None:
    for run in (
        lambda seed: nw.run(model, method=nw.forward(), seed=seed),
        lambda seed: nw.run_python(model, seed=seed),
    ):
        faults = set()
        for seed in range(40):
            try:
                run(seed)
            except nw.ModelFault as fault:
                faults.add(fault.code)
        assert faults <= {"bad-parameter", "bad-shape", "host-function"} and faults


@nw.model
def wrong_kind() -> float:
    n = nw.discrete_uniform(0, 4)
    nw.emit(nw.box((0, 0, 0), (1, 1, 1), taper=0.5, taper_axis="x" if n < 2 else "up"))
    return n


@nw.host
def untyped(n: int) -> Any:
    return n if n < 3 else object()


@nw.model
def wrong_value() -> float:
    return untyped(nw.discrete_uniform(0, 4))


@nw.model
def endless() -> float:
    n = nw.discrete_uniform(0, 4)
    while n > 2:
        n = n + 1 if n < 10 else 5
    return n


@pytest.mark.parametrize(
    ("model", "code"), [(wrong_kind, "bad-shape"), (wrong_value, "host-function"), (endless, "step-budget")]
)
@pytest.mark.parametrize(
    "method", [nw.importance(200), nw.smc(200), nw.mh(steps=200), nw.rejection(200)], ids=repr
)
def test_faults_of_the_program_end_a_search(model: Any, code: str, method: Any) -> None:
    with pytest.raises(nw.ModelFault) as caught:
        nw.run(model, method=method, seed=1, max_steps=10_000)
    assert caught.value.code == code


class Stop(BaseException):
    """An exception that is no `Exception`."""


@pytest.mark.parametrize("kind", [KeyboardInterrupt, SystemExit, MemoryError, GeneratorExit, Stop])
@pytest.mark.parametrize(
    "method", [*METHODS, nw.forward(), nw.forward(200), *TRAJECTORIES, nw.vi()], ids=repr
)
def test_what_is_not_about_the_model_is_raised_as_it_is(kind: type[BaseException], method: Any) -> None:
    calls = 0

    @nw.host
    def leaving(n: float) -> float:
        nonlocal calls
        calls += 1
        # With its methods that follow a gradient a model is run seldom.
        if calls >= (1 if method.NAME in ("forward", "nuts", "hmc", "vi") else 8):
            raise kind("now")
        return 0.0

    @nw.model
    def model() -> float:
        x = nw.gaussian(0, 1)
        n = nw.discrete_uniform(0, 8)
        y = leaving(3.0)
        nw.observe(Gaussian(x, 1.0), y)
        return n

    @nw.model
    def finite() -> int:
        n = nw.discrete_uniform(0, 20)
        return n + leaving(n)

    with pytest.raises(kind, match="now"):
        nw.run(finite if method.NAME == "enumerate_all" else model, method=method, seed=1, threads=2)
    # Nothing of it is left for the next search.
    calls = -(10**9)
    nw.run(finite, method=nw.importance(5), seed=1)


@pytest.mark.parametrize("kind", [KeyboardInterrupt, SystemExit, MemoryError])
def test_a_plain_run_raises_it_too(kind: type[BaseException]) -> None:
    @nw.host
    def leaving() -> float:
        raise kind("now")

    @nw.model
    def model() -> float:
        return leaving()

    with pytest.raises(kind, match="now"):
        nw.run_python(model, seed=1)
    with pytest.raises(kind, match="now"):
        nw.run(model, seed=1)


@pytest.mark.parametrize("kind", [KeyboardInterrupt, SystemExit, MemoryError])
@pytest.mark.parametrize("method", ["mh", "smc"])
def test_an_exit_inside_a_proposal_is_raised_as_it_is(kind: type[BaseException], method: str) -> None:
    calls = 0

    @nw.host
    def leaving() -> float:
        nonlocal calls
        calls += 1
        if calls >= 3:
            raise kind("now")
        return 0.5

    @nw.model
    def model() -> float:
        x = nw.gaussian(0, 1)
        nw.observe(Gaussian(x, 1.0), 1.0)
        y = nw.gaussian(x, 1)
        return y

    kernel = nw.kernels.on("y", nw.kernels.proposal(lambda x: Gaussian(x * leaving(), 1.0)))
    search = {
        "mh": nw.mh(steps=200, kernel=kernel),
        "smc": nw.smc(50, rejuvenate=kernel),
    }[method]
    with pytest.raises(kind, match="now"):
        nw.run(model, method=search, seed=1, threads=1)
    # Nothing of it is left for the next search.
    calls = -(10**9)
    nw.run(model, method=search, seed=1)
