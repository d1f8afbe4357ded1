"""A search is one value: JSON, another process and another folder keep it, and its hash identifies it.

Small models, few particles: the same samples must come back, to the bit.
"""

import json
import os
import pickle
import subprocess
import sys
import textwrap
from pathlib import Path

import niwaki as nw
import numpy as np
import pytest
from niwaki import box, emit, flip, gaussian, host, kernels, model, uniform
from niwaki.methods import Method
from niwaki.shell.references import find
from niwaki.targets.examples import ship

MODEL = """
    from niwaki import *
    from niwaki import host, model; from niwaki.words import *

    SIZES = (0.5, 1.0)
    BLOCK = box((0, 0.5, 0), (1, 1, 1))

    @model
    def pile(y=0.0, width=2.0):
        # A comment.
        height = uniform(SIZES[0], SIZES[1])
        emit(box((0, y + height / 2, 0), (width, height, width)))
        if flip(0.7):
            pile(y + height, width * uniform(0.6, 1.0))
        elif flip(0.5):
            emit(BLOCK)
"""

CUBE = """v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nv 0 0 2\nv 2 0 2\nv 2 3 2\nv 0 3 2
f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8
"""


def written(folder: Path, text: str = MODEL) -> nw.Search:
    """A search of the model in a file of that folder, into a mesh beside it."""
    folder.mkdir(exist_ok=True)
    (folder / "pile.py").write_text(textwrap.dedent(text))
    (folder / "cube.obj").write_text(CUBE)
    score = nw.no_self_intersection() * nw.match_volume(nw.Target.load(folder / "cube.obj"), 0.5)
    kernel = kernels.cycle(kernels.prior(), kernels.on("height", kernels.drift(0.2)))
    method = nw.smc(30, power=4.0, anneal=[0.5, 1.0], rejuvenate=kernel, moves=2, at="end")
    return nw.Search(find(f"{folder / 'pile.py'}:pile").model, (0.1,), score, method, seed=7)


def scores(result: nw.Result) -> list[tuple[float, float, float]]:
    return [(sample.log_score, sample.log_prior, sample.log_weight) for sample in result]


def test_a_search_goes_through_json_to_another_process_and_folder(tmp_path, monkeypatch):
    search = written(tmp_path / "here")
    expected = scores(search.run())
    text = search.json()
    assert scores(nw.Search.of_json(text).run()) == expected
    assert nw.Search.of_json(text).hash == search.hash
    # The model's own file is not needed, nor the folder that the search was made in.
    (tmp_path / "here" / "pile.py").unlink()
    (tmp_path / "search.json").write_text(text)
    code = (
        "import niwaki, pathlib; s = niwaki.Search.of_json(pathlib.Path('search.json').read_text()); "
        "print(s.hash); print([(o.log_score, o.log_prior, o.log_weight) for o in s.run(threads=1)])"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    there = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    digest, samples = there.stdout.splitlines()
    assert digest == search.hash and samples == repr(expected)


def test_the_meshes_can_travel_inside(tmp_path):
    search = written(tmp_path / "here")
    inside, named = search.json("inside"), search.json()
    (tmp_path / "here" / "cube.obj").unlink()
    assert scores(nw.Search.of_json(inside).run()) == scores(search.run())
    with pytest.raises(nw.NiwakiError, match="no file"):
        nw.Search.of_json(named)


def test_a_mesh_that_has_changed_is_refused(tmp_path):
    text = written(tmp_path / "here").json()
    (tmp_path / "here" / "cube.obj").write_text(CUBE.replace("2 3 2", "2 4 2"))
    with pytest.raises(nw.InputError, match="has changed"):
        nw.Search.of_json(text)


def test_a_moved_file_a_comment_and_a_blank_line_change_no_hash(tmp_path):
    plain = written(tmp_path / "here")
    commented = MODEL.replace("# A comment.", "\n        # Another,\n        # longer one.\n")
    moved = written(tmp_path / "there", commented)
    assert moved.hash == plain.hash and moved == plain and hash(moved) == hash(plain)


@pytest.mark.parametrize(
    "change",
    [
        lambda folder: written(folder, MODEL.replace("0.7", "0.6")),
        lambda folder: written(folder, MODEL.replace("(0.5, 1.0)", "(0.5, 1.5)")),
        lambda folder: written(folder, MODEL.replace("(1, 1, 1)", "(1, 1, 1.5)")),
        lambda folder: changed(written(folder), args=(0.2,)),
        lambda folder: changed(written(folder), seed=8),
        lambda folder: changed(written(folder), max_steps=1000),
        lambda folder: changed(written(folder), runs=2, keep="best"),
        lambda folder: changed(written(folder), method=nw.smc(30)),
        lambda folder: changed(written(folder), score=nw.floor(0.0)),
        lambda folder: changed(written(folder), score=nw.match_volume(ship(), 1.0)),
        lambda folder: changed(written(folder), choices={"height": 0.6}),
    ],
)
def test_whatever_decides_the_result_changes_the_hash(change, tmp_path):
    assert change(tmp_path / "there").hash != written(tmp_path / "here").hash


def changed(search: nw.Search, **settings) -> nw.Search:
    names = (
        "model",
        "args",
        "score",
        "method",
        "seed",
        "choices",
        "runs",
        "keep",
        "polish",
        "max_steps",
        "max_memory",
    )
    return nw.Search(**{**{name: getattr(search, name) for name in names}, **settings})


def test_the_bytes_of_a_target_and_an_image_change_the_hash(tmp_path):
    square, wide = np.zeros((8, 8), bool), np.zeros((8, 8), bool)
    square[2:5, 2:5] = wide[2:5, 2:6] = True
    camera = nw.Camera.perspective((0, 2, 20), look_at=(0, 2, 0))
    hashes = {
        nw.Search(PILE, score=nw.match_image(image, camera), seed=1).hash
        for image in (square, wide, square.copy())
    }
    assert len(hashes) == 2
    search = written(tmp_path / "here")
    (tmp_path / "here" / "cube.obj").write_text(CUBE.replace("2 3 2", "2 4 2"))
    score = nw.no_self_intersection() * nw.match_volume(nw.Target.load(tmp_path / "here" / "cube.obj"), 0.5)
    assert changed(search, score=score).hash != search.hash


@model
def PILE(y=0.0):
    height = uniform(0.5, 1.5)
    emit(box((0, y + height / 2, 0), (1, height, 1)))
    if flip(0.6):
        PILE(y + height)


def test_every_method_and_sketch_goes_through_json():
    stripes = np.zeros((6, 6), bool)
    stripes[2:4] = True
    camera = nw.Camera.orthographic((0, 5, 0.1), (0, 0, 0), height=6)
    ground = nw.Receiver.floor(0.0, (-5, -5), (5, 5))
    score = (
        nw.no_self_intersection("surface")
        * nw.floor(-1.0)
        * nw.avoid(ship(), 2.0)
        * nw.match_image(stripes, camera, weight=2.0)
        * nw.match_shadow(stripes, (0, -1, 0.1), ground, weight_image=np.full((6, 6), 9, np.uint8))
        * nw.overshoot(((-5, 0, -5), (5, 9, 5)))
        * nw.match_volume(ship(), 1.0)
    )
    methods = [
        nw.smc((5, 6), diverse=1, order="depth-first", resampling="residual", ess=0.5),
        nw.smc(8, rejuvenate=kernels.mixture(kernels.prior(), kernels.proposal(lambda old: old)), draws=3),
        nw.particle_gibbs(8, 3, anneal=[1.0]),
        nw.pimh(8, 3),
        nw.mh(
            50,
            kernel=kernels.tempering(kernels.weighted(kernels.prior(), depth=lambda n: 2.0**-n), (1, 0.5), 5),
        ),
        nw.mh(50, "cache", kernels.anneal(kernels.repeat(2, kernels.block()), 20), thin=2),
        nw.hmc(20, 5, jitter=0.5),
        nw.nuts(20, metric="low-rank"),
        nw.nuts(20, metric=[[2.0, 0.5], [0.5, 1.0]]),
        nw.vi("full-rank", draws=20, tolerance=0.1),
        nw.explore(4),
        nw.enumerate_all(50),
        nw.rejection(4, -1),
        nw.importance(5),
        nw.ais(5, (0.1, 1), moves=2),
        nw.forward(2),
        nw.improve(rounds=3, seconds=2),
        nw.emulate(20, 2),
    ]
    assert {type(kind).NAME for kind in methods} == set(Method.KNOWN)
    for method in methods:
        polish = nw.mh(20) if getattr(method, "diverse", None) is None else None
        search = nw.Search(PILE, (0.5,), score, method, seed=2, polish=polish)
        again = nw.Search.of_json(search.json("inside"))
        assert again.hash == search.hash, method
        assert again.json("inside") == search.json("inside").replace('"file"', '"file"'), method
        if not any(
            leaf.function for leaf in getattr(method, "rejuvenate", None) and method.rejuvenate.leaves() or []
        ):
            assert again.method == method


def test_values_of_all_kinds_go_through_json():
    from niwaki import rotation, vec
    from niwaki.search.data import Reader, Writer
    from niwaki.words import Frame

    values = [
        None, True, 3, 2**62, -0.0, 0.1, float("inf"), "text", (1, (2.5,)), [1, []], {"a": 1, 2: (3,)}, range(2, 9, 3),
        vec(1, 2, 3), rotation((0, 1, 0), 0.3), box((0, 1, 0), (1, 2, 3), color=(0.1, 0.2, 0.3)),
        nw.words.Gaussian(0, 2.5), np.arange(6.0).reshape(2, 3),
    ]  # fmt: skip
    for value in values:
        text = json.dumps(Writer()(value), allow_nan=False)
        again = Reader()(json.loads(text))
        assert repr(again) == repr(value) or np.array_equal(again, value), text
    nan = json.loads(json.dumps(Writer()(float("nan"))))
    assert Reader()(nan) != Reader()(nan)
    frame = Reader()(Writer()(Frame((0, 0, 0), (0, 1, 0), (1, 0, 0), 0.5)))
    assert tuple(frame) == ((0, 0, 0), (0, 1, 0), (1, 0, 0), 0.5)


@host
def doubled(x):
    return 2.0 * x


@model
def hosted():
    return doubled(gaussian(0, 1))


def test_a_host_function_is_found_only_where_it_is_trusted():
    search = nw.Search(hosted, seed=3)
    with pytest.raises(nw.InputError, match="not trusted"):
        nw.Search.of_json(search.json())
    again = nw.Search.of_json(search.json(), trust=(__name__,))
    assert again.run().value == search.run().value and again.hash == search.hash
    other = search.json().replace('"doubled"', '"MODEL"')
    with pytest.raises(nw.InputError, match="not trusted"):
        nw.Search.of_json(other, trust=(__name__,))
    edited = search.data()
    edited["model"]["constants"][0]["host"]["sha256"] = "0" * 64
    with pytest.raises(nw.InputError, match="or it has changed"):
        nw.Search.of_data(edited, trust=(__name__,))


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", '{"format": 9}', '{"format": 1}', '{"format": 1, "model": 3}']
)
def test_what_is_no_search_is_a_message(text):
    with pytest.raises(nw.InputError):
        nw.Search.of_json(text)


def test_a_pickled_result_saves_the_same_file(tmp_path):
    search = written(tmp_path / "here")
    result = search.run()
    (tmp_path / "here" / "pile.py").unlink()
    again = pickle.loads(pickle.dumps(result))
    assert scores(again) == scores(result) and again.info.plan == result.info.plan
    assert again.log_evidence == result.log_evidence
    for sample, other in zip(result, again, strict=True):
        assert other.value == sample.value and other.choices == sample.choices
    result.export(tmp_path / "one.glb")
    again.export(tmp_path / "two.glb")
    assert (tmp_path / "one.glb").read_bytes() == (tmp_path / "two.glb").read_bytes()


def test_a_search_that_makes_no_sense_is_refused():
    with pytest.raises(nw.InputError, match="method"):
        nw.Search(PILE, method="smc")
    with pytest.raises(nw.InputError, match="runs"):
        nw.Search(PILE, runs=0)
    with pytest.raises(nw.InputError, match="polish"):
        nw.Search(PILE, method=nw.smc(diverse=2), polish=nw.mh(10))
    with pytest.raises(nw.InputError, match="particles"):
        nw.grow(PILE, ship(), method=nw.pimh(), particles=3)


@model
def line():
    a = gaussian(0, 1)
    nw.observe(nw.words.Gaussian(a, 0.5), 1.0)
    return a + flip(0.5)


def test_results_of_chains_are_pickled_with_all_statistics():
    chains = nw.run(
        line,
        nw.mh(600, chains=2, keep=20, kernel=kernels.cycle(kernels.prior(), kernels.hmc_step(3))),
        seed=2,
    )
    again = pickle.loads(pickle.dumps(chains))
    assert scores(again) == scores(chains) and again.best.choices == chains.best.choices
    assert again.acceptance == chains.acceptance and again.counters == chains.counters
    assert [sample.value for sample in again.last] == [sample.value for sample in chains.last]
    assert again.trajectories == chains.trajectories and again.method == chains.method
    with pytest.raises(nw.InputError, match="cannot continue the chains"):
        again.more(10)
    with pytest.warns(UserWarning, match="discrete"):
        drawn = nw.run(line, nw.nuts(20, warmup=30, chains=2), seed=2)
    again = pickle.loads(pickle.dumps(drawn))
    assert all(np.array_equal(again.draws[path], drawn.draws[path]) for path in drawn.draws)
    assert again.best.choices == drawn.best.choices and scores(again[:3]) == scores(drawn[:3])
    assert [len(chain) for chain in again.by_chain] == [20, 20]


def test_draws_are_by_address_for_every_method():
    for method in (nw.mh(100, chains=2, keep=9), nw.smc(9), nw.importance(9), nw.pimh(5, 9)):
        result = nw.run(line, method, seed=3)
        a, heads = result.draws["a"], result.draws["bernoulli"]
        assert a.shape == heads.shape == (len(result.by_chain), len(result.by_chain[0]))
        assert a[0, 4] == result.by_chain[0][4].choices["a"] and heads.dtype == bool
