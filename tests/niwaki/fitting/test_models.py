"""Models that call a generator: the text that `niwaki init --generator` writes, and its meshes."""

from __future__ import annotations

from importlib.util import find_spec
from itertools import compress
from pathlib import Path
from shutil import which

import niwaki as nw
import numpy as np
import pytest
from niwaki import InputError
from niwaki.fitting import generator_of, mesh_at
from niwaki.methods import Forward
from niwaki.shell.app import app
from niwaki.shell.references import find
from niwaki.words import box
from typer.testing import CliRunner

LAMP = '''"""Parameters of every kind, used under conditions, one with the name of a word."""

from enum import Enum

import niwaki as nw
from niwaki import Parameter
from niwaki.words import box
from niwaki.words.distributions import LogNormal, Poisson


class Metal(Enum):
    BRASS = 1
    IRON = 2


def lamp(
    emit=nw.Uniform(0.5, 2.0),
    arms=nw.DiscreteUniform(1, 4),
    shade=nw.Bernoulli(0.3),
    web=Parameter(("solid", 'a "word"')),
    metal: Metal = Metal.BRASS,
    tall=LogNormal(0.0, 0.2),
    rings=Poisson(1.0),
    reach=Parameter(nw.Uniform(1.0, 2.0), when={"web": ("solid",), "shade": True}),
    bent=Parameter(("a", "b"), when=[{"metal": Metal.IRON}, {"arms": range(2, 4)}]),
    bend=Parameter(nw.Uniform(3.0, 4.0), when={"bent": "a"}),
):
    if rings == 0:
        return None
    used = [emit, arms, 1 + shade, len(web), metal.value, tall, rings]
    hung = [reach if shade and web == "solid" else 0.25, ord(bent) if metal is Metal.IRON else 0.25]
    return [box((k, 0, 0), (0.5, float(size), 0.5)) for k, size in enumerate(used + hung)]
'''


@pytest.fixture
def lamp(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a generator, and a model that calls it in a folder below."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lamp.py").write_text(LAMP)
    init("wrapped", "--generator", "lamp.py")
    return tmp_path


def init(*words: str) -> str:
    return CliRunner().invoke(app, ["init", *words], catch_exceptions=False).stdout


def test_a_model_has_the_meshes_of_its_generator(lamp: Path):
    model = find("wrapped/lamp_model.py").model
    generator = generator_of("lamp.py:lamp")
    empty = used = 0
    for seed in range(1, 40):
        run = nw.run(model, Forward(), seed=seed).best
        values = {name.removesuffix("_"): value for name, value in run.choices.items()}
        for name, options in {
            "web": ("solid", 'a "word"'),
            "metal": generator.space.axis("metal").values,
        }.items():
            if isinstance(values[name], int):
                values[name] = options[values[name]]
        # A model draws the parameters that are used, and no other.
        _, used_now = generator.space.row(values)
        assert list(values) == list(compress(generator.space.names, used_now))
        vertices, faces = mesh_at(generator, values)
        empty, used = empty + (not len(faces)), used + ("bend" in values)
        if len(faces):
            assert np.array_equal(
                np.unique(run.scene.merged(fine=False)[0], axis=0), np.unique(vertices, axis=0)
            )
        else:
            assert len(run.scene) == 0
    assert empty > 5 and used > 5


def test_such_a_model_is_searched_by_an_emulator_and_its_parameters_are_held(lamp: Path):
    model = find("wrapped/lamp_model.py").model
    hidden = nw.run(model, Forward(), seed=3, hold={"rings": 2, "arms": 3}).best
    target = nw.Target(*hidden.scene.merged(fine=False))
    result = nw.grow(model, target, seed=1, hold={"arms": 3}, evaluations=60)
    assert isinstance(result.method, nw.emulate)
    assert result.best.choices["arms"] == 3 and result.best.fit.covered > 0.9


def test_a_value_outside_of_its_range_is_refused():
    def wall(width=nw.Uniform(1.0, 2.0)):
        return box((0, 0, 0), (width, 1, 1))

    generator = generator_of(wall)
    assert np.ptp(mesh_at(generator, {"width": 1.5})[0], axis=0).tolist() == [1.5, 1.0, 1.0]
    with pytest.raises(InputError, match="width"):
        mesh_at(generator, {"width": 2.5})


def test_what_is_no_generator_or_no_model_is_named_with_the_cure(lamp: Path):
    (lamp / "run.py").write_text("def run(d):\n    return d.real('width', 1, 2)\n")
    with pytest.raises(InputError, match="ranges in its signature"):
        init("folder", "--generator", "run.py")
    with pytest.raises(InputError, match="no file"):
        init("folder", "--generator", "absent.py:lamp")
    with pytest.raises(InputError, match="niwaki init NEW-FOLDER --generator box.scad"):
        find("box.scad")
    with pytest.raises(InputError, match="already"):
        init("wrapped", "--generator", "lamp.py")
    assert not (lamp / "folder").exists()


@pytest.mark.skipif(not find_spec("openscad_evaluator") and not which("openscad"), reason="needs OpenSCAD")
def test_a_file_of_openscad_becomes_a_model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "box.scad").write_text(
        "width = 40; // [20:80]\nlid = true;\ncube([width, 10, lid ? 5 : 3]);\n"
    )
    init("wrapped", "--generator", "box.scad")
    run = nw.run(find("wrapped/box_model.py").model, Forward(), seed=1).best
    assert np.allclose(run.scene.size, [run.choices["width"], 10, 5 if run.choices["lid"] else 3])
