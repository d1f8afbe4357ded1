"""The parts of a result: numbers in its repr, weights that sum to one, files and pictures of the best. After any
method it is the same class, can be pickled, and has draws by address."""

from __future__ import annotations

import pickle
import warnings
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki.gallery import entries, entry


@nw.model
def tower(n: int = 3):  # type: ignore[no-untyped-def]
    y = 0.0
    for i in range(n):  # noqa: B007
        height = nw.uniform(0.5, 1.5)
        nw.emit(nw.box((0, y + height / 2, 0), (1, height, 1)))
        y = y + height
    nw.query("height", y)
    return y


@pytest.fixture(scope="module")
def grown() -> nw.Result:
    pillar = nw.Target(
        [[x, y, z] for x in (-0.5, 0.5) for y in (0.0, 3.2) for z in (-0.5, 0.5)],
        [
            [0, 1, 3],
            [0, 3, 2],
            [4, 6, 7],
            [4, 7, 5],
            [0, 4, 5],
            [0, 5, 1],
            [2, 3, 7],
            [2, 7, 6],
            [0, 2, 6],
            [0, 6, 4],
            [1, 5, 7],
            [1, 7, 3],
        ],
        name="pillar",
    )
    return nw.grow(tower, pillar, particles=50, voxel=0.2, runs=3, seed=7)


def test_a_grown_result_has_one_sample_for_each_run(grown: nw.Result) -> None:
    assert [sample.seed for sample in grown] == [7, 8, 9]
    assert grown.best.log_score == max(sample.log_score for sample in grown)
    assert grown.best.similarity is not None and grown.best.similarity > 0.9
    assert grown.best.log_joint == grown.best.log_prior + grown.best.log_score
    assert grown.seconds > 0 and grown.best.cpu_seconds > 0
    assert not grown.interrupted


def test_a_sample_has_value_choices_queries_and_scene(grown: nw.Result) -> None:
    best = grown.best
    assert list(best.choices) == ["i[0]/height", "i[1]/height", "i[2]/height"]
    assert best.value == best.queries["height"] == pytest.approx(sum(best.choices.values()))
    assert set(best.families.values()) == {"uniform"}
    # The replay that names the choices and parts does not score the scene; its run has the scores of the first run.
    assert best._trace.run.log_score == best.log_score and best._trace.run.similarity == best.similarity
    assert [part.address for part in best.scene] == ["i[0]/emit", "i[1]/emit", "i[2]/emit"]


def test_reprs_have_the_numbers(grown: nw.Result) -> None:
    assert repr(grown).startswith("<Result of tower: 3 samples, best log score ")
    assert "% covered" in repr(grown.best) and "3 primitives" in repr(grown.best)


def test_files_and_pictures(grown: nw.Result, tmp_path: Path) -> None:
    for suffix in (".glb", ".obj", ".stl", ".ply"):
        assert grown.export(tmp_path / f"tower{suffix}").stat().st_size > 100
    assert grown.save(tmp_path / "tower.png", size=(80, 60), samples=1).read_bytes()[:4] == b"\x89PNG"
    picture = grown.best._repr_png_()
    assert picture is not None and picture[:4] == b"\x89PNG"
    assert grown.sheet(size=(60, 40), samples=1).size[0] >= 120


def test_weights_sum_to_one() -> None:
    weighted = nw.run(tower, method=nw.importance(20), seed=1)
    assert weighted.weights.sum() == pytest.approx(1.0)
    assert np.allclose(weighted.weights, 1 / 20)


def test_arguments_by_position_and_name() -> None:
    assert nw.run(tower, 2, seed=1).best.primitives == 2
    assert nw.run(tower, n=5, seed=1).best.primitives == 5
    assert nw.run(tower, seed=1).best.primitives == 3


def test_choices_can_be_given_and_the_rest_drawn() -> None:
    run = nw.run(tower, choices={"i[1]/height": 1.25}, seed=4).best
    assert run.choices["i[1]/height"] == 1.25
    assert run.choices["i[0]/height"] == nw.run(tower, seed=4).best.choices["i[0]/height"]


def test_values_that_cannot_be_keys_are_replaced_by_their_repr() -> None:
    @nw.model
    def pair():  # type: ignore[no-untyped-def]
        return [nw.flip(0.25), 1]

    shares = nw.run(pair, method=nw.enumerate_all()).distribution()
    assert shares == pytest.approx({"[True, 1]": 0.25, "[False, 1]": 0.75})


@nw.model
def alike():  # type: ignore[no-untyped-def]
    kind = nw.discrete_uniform(0, 4)
    if kind == 0:
        return 0.0
    if kind == 1:
        return -0.0
    if kind == 2:
        return True
    if kind == 3:
        return 1
    return 2


def test_values_that_are_equal_and_not_the_same_are_kept_apart() -> None:
    result = nw.run(alike, nw.enumerate_all(), seed=1)
    shares = result.distribution()
    assert set(shares) == {"0.0", "-0.0", "True", "1", 2}
    assert all(abs(share - 0.2) < 1e-12 for share in shares.values())
    for value in (0.0, -0.0, True, 1, 2, 2.0):
        assert result.info.bounds(value) == pytest.approx((0.2, 0.2)), value


def test_the_gallery_has_titles_and_no_other_names() -> None:
    models: list[Any] = entries()
    assert "spaceship" in {model.name for model in models if model.target_name is not None}
    assert all(model.title for model in models)
    assert entry("targets") is None and entry("no such") is None


@nw.model
def pair():  # type: ignore[no-untyped-def]
    first = nw.flip(0.4)
    x = nw.uniform(-1.0, 1.0)
    y = nw.dirichlet([1.0, 2.0])
    nw.observe(nw.words.Gaussian(x + y[0], 1.0), 0.3)
    return (first, x)


METHODS: dict[str, Any] = {
    "forward": nw.forward(4),
    "rejection": nw.rejection(4),
    "importance": nw.importance(8),
    "smc": nw.smc(8),
    "particle_gibbs": nw.particle_gibbs(4, 3),
    "pimh": nw.pimh(4, 3),
    "mh": nw.mh(60, chains=2, thin=10),
    "mh and nuts": nw.mh(
        60, chains=2, thin=10, kernel=nw.kernels.cycle(nw.kernels.prior(), nw.kernels.nuts_step())
    ),
    "hmc": nw.hmc(draws=6, warmup=20, chains=2, steps=4),
    "nuts": nw.nuts(draws=6, warmup=20, chains=2),
    "explore": nw.explore(chains=2, draws=3),
}


@pytest.mark.parametrize("name", METHODS)
def test_after_any_method_a_result_is_pickled_and_has_draws_by_address(name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what chains that follow the gradient hold fixed
        result = nw.run(pair, method=METHODS[name], seed=1)
    again = pickle.loads(pickle.dumps(result))
    assert type(result) is type(again) is nw.Result
    assert repr(again) == repr(result) and again.method == result.method
    assert [(s.choices, s.value, s.log_joint) for s in again] == [
        (s.choices, s.value, s.log_joint) for s in result
    ]
    assert again.best.choices == result.best.choices
    count, least = len(result.sizes), min(result.sizes)
    assert sum(result.sizes) == len(result) and [len(chain) for chain in result.by_chain] == result.sizes
    assert result.draws["x"].shape == (count, least) and result.draws["y"].shape == (count, least, 2)
    for address, values in result.draws.items():
        assert np.array_equal(again.draws[address], values)
        first = result.by_chain[0][0].choices[address]
        assert np.array_equal(values[0, 0], first)


@pytest.mark.parametrize("name", METHODS)
def test_after_any_method_arviz_reads_the_draws(name: str) -> None:
    pytest.importorskip("arviz")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = nw.run(pair, method=METHODS[name], seed=1)
        read = result.to_arviz()
    assert np.array_equal(read["posterior"]["x"], result.draws["x"])
    assert read["sample_stats"]["lp"].shape == (len(result.sizes), min(result.sizes))


def test_the_statistics_of_a_method_are_attributes_of_the_result() -> None:
    chains = nw.run(pair, method=METHODS["mh"], seed=1)
    assert chains.acceptance is chains.info.acceptance and chains.visits[0] == list(range(10, 61, 10))
    with pytest.raises(AttributeError, match="a result of `mh` has no `step_size`"):
        _ = chains.step_size
    weighted = nw.run(pair, method=METHODS["importance"], seed=1)
    with pytest.raises(nw.InputError, match="samples of equal weight"):
        weighted.summary()
    with pytest.raises(nw.InputError, match="whose chains can continue"):
        weighted.more(10)
