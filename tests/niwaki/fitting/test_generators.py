"""Claim: parameters and ranges are those that a signature, a Customizer or a command states, by the manual's rules."""

from __future__ import annotations

import shutil
import sys
from enum import Enum
from typing import Annotated, Literal

import niwaki as nw
import pytest
from fit_hosts import block, by_run, tower
from niwaki.errors import InputError
from niwaki.fitting import customizer, discovery
from niwaki.fitting.draws import DrawError, Draws
from niwaki.fitting.functions import FunctionGenerator
from niwaki.fitting.generator import value_of
from niwaki.fitting.loading import generator_of, generator_of_recipe
from niwaki.fitting.meshes import mesh_of
from niwaki.words.distributions import Bernoulli, DiscreteUniform, Uniform


class Finish(Enum):
    RAW = 1
    ROUND = 2


def ranges(generator):
    return {axis.name: axis.range or axis.values for axis in generator.space.axes}


def test_ranges_hints_and_defaults_are_parameters():
    def shape(
        a=Uniform(1, 2),
        b: Annotated[float, Uniform(3, 4)] = 3.5,
        c: Literal["x", "y"] = "x",
        d: Finish = Finish.RAW,
        e: bool = True,
        f=8,
        g=-2.5,
        h="text",
        *,
        i=None,
    ): ...

    assert ranges(FunctionGenerator(shape)) == {
        "a": Uniform(1.0, 2.0),
        "b": Uniform(3.0, 4.0),
        "c": ("x", "y"),
        "d": (Finish.RAW, Finish.ROUND),
        "e": (False, True),
        "f": range(4, 17),
        "g": Uniform(-5.0, -1.25),
    }


@pytest.mark.parametrize(
    ("function", "text"),
    [
        (lambda width, height: None, "`width` has neither a range nor a default"),
        (lambda width=0: None, "`width` has the default 0"),
        (lambda name="x": None, "no parameter of the function has a range"),
    ],
)
def test_a_function_without_ranges_is_refused_with_a_cure(function, text):
    with pytest.raises(InputError) as error:
        FunctionGenerator(function)
    assert error.value.code == "no-ranges" and text in str(error.value) and "nw.Uniform" in str(error.value)


def test_a_choice_crosses_to_a_worker_by_its_index():
    def shape(finish: Finish = Finish.RAW, width=Uniform(1.0, 2.0)):
        assert finish is Finish.ROUND
        return block(width, 1, 1)

    generator = FunctionGenerator(shape)
    assert generator.call({"finish": 1, "width": 1.5}).mesh[0].max() == 1.0
    assert value_of(generator.space, "finish", 1) is Finish.ROUND


def test_a_function_is_found_again_by_its_recipe():
    again = generator_of_recipe(FunctionGenerator(tower).recipe())
    assert again.function.__qualname__ == "tower" and ranges(again) == ranges(FunctionGenerator(tower))
    assert "lambda" in FunctionGenerator(lambda width=1.0: None).reason


def test_draws_show_parameters_and_when_they_are_used():
    traces = []
    for number in range(discovery.RUNS):
        draws = Draws(discovery.probe(0, number))
        by_run(draws)
        traces.append(draws.drawn)
    space = discovery.space_of("by_run", traces)
    used = {axis.name: axis.when for axis in space.axes}
    names = list(used)
    assert set(names) == {"floors", "width", "lid", "size", "kind", "step"}
    assert used["floors"] == used["width"] == used["lid"] == used["kind"] == ()
    assert used["size"] == (((names.index("lid"), (1,)),),)
    assert used["step"] == (((names.index("kind"), (1,)),),)


def test_draws_that_no_search_can_follow_are_refused():
    draws = Draws({"a": 0.9})
    with pytest.raises(DrawError, match="changes from run to run"):
        draws.real("a", 0.0, 0.5)
    draws.switch("b")
    with pytest.raises(DrawError, match="drawn twice"):
        draws.switch("b")
    with pytest.raises(DrawError, match="lower one first"):
        draws.whole("c", 3, 1)


SCAD = """// A box.
/* [Size] */
width = 40; // [20:80]
count = 3; // [1:8]
wall = 2.5;
gap = 0;
kind = "round"; // [round:With corners, flat]
grade = 2; // [1, 2, 5]
deep = 10; // [50]
back = true;
label = "text";
both = [1, 2];
/* [Hidden] */
secret = 3; // [1:9]
module part() { cube(1); }
late = 4; // [1:9]
cube([width, count, wall]);
"""


def test_the_customizer_of_a_file_gives_ranges():
    assert {row.name: row.range for row in customizer.slots(SCAD)} == {
        "width": Uniform(20.0, 80.0),
        "count": DiscreteUniform(1, 8),
        "wall": Uniform(1.25, 5.0),
        "gap": None,
        "kind": ["round", "flat"],
        "grade": [1, 2, 5],
        "deep": Uniform(0.0, 50.0),
        "back": Bernoulli(0.5),
        "label": None,
        "both": None,
    }


@pytest.fixture
def openscad(tmp_path, monkeypatch):
    """A program of the name `openscad`, which writes a box as wide as the file says."""
    program = tmp_path / "openscad"
    program.write_text(
        f"#!{sys.executable}\n"
        "import re, sys\n"
        "text = open(sys.argv[3]).read()\n"
        "width = float(re.search(r'^width = ([^;]*);', text, re.M)[1])\n"
        "assert 'kind = \"flat\";' in text and 'gap = 0.5;' in text, text\n"
        "corner = f'vertex {width} 0 0'\n"
        "facet = f'facet normal 0 0 1\\nouter loop\\n{corner}\\nvertex 0 1 0\\nvertex 0 0 1\\nendloop\\nendfacet\\n'\n"
        "open(sys.argv[2], 'w').write('solid a\\n' + facet + 'endsolid a\\n')\n"
    )
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr("niwaki.fitting.openscad.find_spec", lambda name: None)
    (tmp_path / "box.scad").write_text(SCAD)
    return tmp_path / "box.scad"


@pytest.mark.skipif(sys.platform == "win32", reason="a script is no program there")
def test_a_file_is_evaluated_by_the_program_with_other_values(openscad, monkeypatch):
    # `os.chdir` of a worker is undone.
    monkeypatch.chdir(openscad.parent)
    generator = nw.scad(openscad, gap=0.5, kind=["flat", "round"])
    assert "gap" not in ranges(generator) and ranges(generator)["kind"] == ("flat", "round")
    again = generator_of_recipe(generator.recipe())
    vertices, _ = again.call({"width": 33.0, "kind": 0}).mesh
    assert vertices.max() == 33.0
    with pytest.raises(InputError, match="a parameter of box.scad: width, count"):
        nw.scad(openscad, widht=4)


def test_a_machine_without_openscad_is_told_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr("niwaki.fitting.openscad.find_spec", lambda name: None)
    (tmp_path / "box.scad").write_text(SCAD)
    with pytest.raises(InputError) as error:
        nw.scad(tmp_path / "box.scad")
    assert error.value.code == "no-openscad" and "pip install openscad-evaluator" in str(error.value)


def test_the_library_evaluates_a_file(tmp_path):
    pytest.importorskip("openscad_evaluator")
    (tmp_path / "box.scad").write_text(SCAD)
    vertices, _ = mesh_of(nw.scad(tmp_path / "box.scad").call({"width": 33.0}).mesh)
    assert vertices.max() == 33.0


@pytest.mark.skipif(shutil.which("openscad") is None, reason="OpenSCAD is not installed")
def test_openscad_itself_evaluates_a_file(tmp_path, monkeypatch):
    monkeypatch.setattr("niwaki.fitting.openscad.find_spec", lambda name: None)
    part = tmp_path / "part.scad"
    part.write_text("module part(w) { cube([w, 2, 3]); }\n")
    (tmp_path / "box.scad").write_text(
        'width = 40; // [20:80]\nkind = "box"; // [box, none, wrong]\nuse <part.scad>\n'
        'if (kind == "box") part(width);\nif (kind == "wrong") assert(false, "no such kind");\n'
    )
    generator = nw.scad(tmp_path / "box.scad")
    vertices, _ = mesh_of(generator.call({"width": 33.0, "kind": 0}).mesh)
    assert vertices.min(0).tolist() == [0.0, 0.0, 0.0] and vertices.max(0).tolist() == [33.0, 2.0, 3.0]
    assert generator.call({"width": 33.0, "kind": 1}).mesh is None
    with pytest.raises(RuntimeError, match="no such kind"):
        generator.call({"width": 33.0, "kind": 2})
    # No file is left beside the model.
    assert sorted(path.name for path in tmp_path.iterdir()) == ["box.scad", "part.scad"]


def test_a_file_without_parameters_is_refused(tmp_path):
    (tmp_path / "cube.scad").write_text("cube(3);\n")
    with pytest.raises(InputError) as error:
        generator_of(tmp_path / "cube.scad")
    assert error.value.code == "no-ranges" and "// [20:80]" in str(error.value)


WRITER = "import sys, shutil; shutil.copy(sys.argv[1], sys.argv[3]); assert sys.argv[2] == 'a; b'"


def test_a_command_gets_its_words_without_a_shell(tmp_path):
    (tmp_path / "in.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    words = [sys.executable, "-c", WRITER, str(tmp_path / "in.obj"), "{text}", "{out}.obj"]
    generator = nw.command(words, text=["a; b", "c"])
    again = generator_of_recipe(generator.recipe())
    assert again.call({"text": 0}).mesh[0].shape == (3, 3)
    with pytest.raises(RuntimeError, match="ended with code 1.*AssertionError"):
        again.call({"text": 1})


@pytest.mark.parametrize(
    ("words", "parameters", "text"),
    [
        ("tool {out}.stl", {}, "not a list"),
        ([sys.executable], {}, "no word has `{out}`"),
        ([sys.executable, "{out}"], {}, "no suffix"),
        ([sys.executable, "{out}.step"], {}, ".step files are not read"),
        ([sys.executable, "{w}", "{out}.stl"], {}, "`{w}` has no range"),
        ([sys.executable, "{out}.stl"], {"w": Uniform(1, 2)}, "no word has the parameter `w`"),
        (["no-such-tool", "{out}.stl"], {}, "no program `no-such-tool`"),
    ],
)
def test_a_command_that_cannot_work_is_refused(words, parameters, text):
    with pytest.raises(InputError) as error:
        nw.command(words, **parameters)
    assert error.value.code == "bad-command" and text in str(error.value)
