"""Claim: sockets of Blender's node trees have the ranges and conditions that the manual states, and any program that
speaks as Blender's worker does is fitted. No Blender is needed here; `make test-blender` has the tests with one.
"""

from __future__ import annotations

import json
import os
import sys
from math import pi
from types import SimpleNamespace

import niwaki as nw
import pytest
import trimesh
from niwaki.errors import FileError, InputError
from niwaki.fitting import node_ranges
from niwaki.fitting.blend import find_blender
from niwaki.fitting.in_blender import sockets
from niwaki.fitting.in_blender.sockets import Socket
from niwaki.shell import fit as shell
from niwaki.words.distributions import Bernoulli, DiscreteUniform, Uniform


def row(
    name, kind="real", value=1.0, low=None, high=None, subtype="", entries=(), used=True, rules=(), place=None
):
    return Socket(
        name, f"id {name}", place, kind, value, low, high, subtype, list(entries), used, list(rules)
    )


@pytest.mark.parametrize(
    ("socket", "range_"),
    [
        (row("a", low=0.5, high=2.0), Uniform(0.5, 2.0)),
        (row("a", value=3.0), Uniform(1.5, 6.0)),
        (row("a", value=-3.0), Uniform(-6.0, -1.5)),
        (row("a", value=3.0, low=2.0), Uniform(2.0, 6.0)),
        (row("a", value=3.0, high=4.0), Uniform(1.5, 4.0)),
        (row("a", value=0.0), Uniform(-1.0, 1.0)),
        (row("a", value=0.0, low=0.0), Uniform(0.0, 1.0)),
        (row("a", value=1.0, low=5.0), Uniform(5.0, 10.0)),
        (row("a", value=0.0, subtype="ANGLE"), Uniform(-pi, pi)),
        (row("a", low=1.0, high=1.0), None),
        (row("a", "whole", 3, 1, 8), DiscreteUniform(1, 8)),
        (row("a", "whole", 3), DiscreteUniform(2, 6)),
        (row("a", "whole", 0), DiscreteUniform(0, 10)),
        (row("a", "whole", 3, 0, 9_000), DiscreteUniform(2, 6)),
        (row("a", "switch", True), Bernoulli(0.5)),
        (row("a", "menu", "x", entries=["x", "y"]), ["x", "y"]),
        (row("a", "menu", "x", entries=["x"]), None),
    ],
)
def test_a_socket_has_the_range_that_the_manual_states(socket, range_):
    assert node_ranges.usual_range(socket) == range_


ROWS = [
    row("Height", low=0.1, high=1.0, rules=[{"id Back": [True], "id Kind": ["a", "b"]}]),
    row("Back", "switch", False),
    row("Kind", "menu", "a", entries=["a", "b", "c"]),
]


def usual(*names):
    return {entry.name: node_ranges.usual_range(entry) for entry in ROWS if entry.name in names}


def test_a_parameter_comes_after_the_switches_that_decide_when_it_is_used():
    result = node_ranges.parameters_of(ROWS, usual("Height", "Back", "Kind"), {})
    assert list(result) == ["Back", "Kind", "Height"]
    assert result["Height"].when == [{"Back": [True], "Kind": ["a", "b"]}] and result["Back"].when is None
    # A held switch decides at once, and a range that lacks some values leaves the others.
    result = node_ranges.parameters_of(ROWS, usual("Height", "Kind"), {"id Back": True})
    assert result["Height"].when == [{"Kind": ["a", "b"]}]
    result = node_ranges.parameters_of(ROWS, {**usual("Height"), "Kind": ["b", "c"]}, {"id Back": True})
    assert result["Height"].when == [{"Kind": ["b"]}]
    assert list(node_ranges.parameters_of(ROWS, usual("Height", "Kind"), {})) == ["Kind"]
    result = node_ranges.parameters_of(ROWS, usual("Height"), {"id Back": True, "id Kind": "b"})
    assert result["Height"].when is None


@pytest.mark.parametrize(
    ("socket", "range_", "text"),
    [
        (row("a", used=False), Uniform(0, 1), "depends"),
        (row("a", "whole", 3), [1, 2.5], "a whole number"),
        (row("a", "switch", True), Uniform(0, 1), "`Bernoulli"),
        (row("a", "switch", True), [1], "True or False"),
        (row("a", "menu", "x", entries=["x", "y"]), ["x", "z"], "one of x, y"),
        (row("a", "menu", "x", entries=["x", "y"]), Bernoulli(0.5), "a list of its entries"),
    ],
)
def test_a_range_that_a_socket_cannot_have_is_refused(socket, range_, text):
    with pytest.raises(InputError, match=text):
        node_ranges.given_range(socket, range_)


class Nodes:
    """A node tree of plain objects, as Blender shows it."""

    def __init__(self, *inputs):
        self.nodes, self.links, self.interface = [], [], SimpleNamespace(items_tree=[])
        for name in inputs:
            self.interface.items_tree.append(
                SimpleNamespace(item_type="SOCKET", in_out="INPUT", identifier=name)
            )
        self.start = self.add("NodeGroupInput", [], inputs)

    def add(self, kind, inputs=(), outputs=("out",), **settings):
        node = SimpleNamespace(
            bl_idname=kind, name=str(len(self.nodes)), mute=False, id_data=self, **settings
        )
        entry = lambda name: SimpleNamespace(name=name, identifier=name, enabled=True)  # noqa: E731
        node.inputs, node.outputs = [entry(name) for name in inputs], [entry(name) for name in outputs]
        self.nodes.append(node)
        return node

    def link(self, node, output, to, name, muted=False):
        socket = next(entry for entry in to.inputs if entry.name == name)
        origin = next(entry for entry in node.outputs if entry.name == output)
        ends = {"from_node": node, "from_socket": origin, "to_node": to, "to_socket": socket}
        self.links.append(SimpleNamespace(**ends, is_muted=muted))

    def switch(self, control, false=None, true=None):
        node = self.add("GeometryNodeSwitch", ["Switch", "False", "True"])
        for source, name in ((control, "Switch"), (false, "False"), (true, "True")):
            if source is not None:
                self.link(self.start, source, node, name)
        return node

    def end(self, *nodes):
        out = self.add("NodeGroupOutput", ["Geometry"], [])
        for node in nodes:
            self.link(node, "out", out, "Geometry")
        return self


def test_conditions_follow_switches_and_menus_back_to_the_sockets():
    tree = Nodes("on", "kind", "a", "b", "c", "d", "e")
    menu = tree.add("GeometryNodeMenuSwitch", ["Menu", "x", "y", "z"])
    tree.link(tree.start, "kind", menu, "Menu")
    for name, entry in (("c", "x"), ("c", "y"), ("a", "z")):
        tree.link(tree.start, name, menu, entry)
    outer = tree.add("GeometryNodeSwitch", ["Switch", "False", "True"])
    reroute = tree.add("NodeReroute", ["in"])
    tree.link(tree.start, "on", reroute, "in")
    tree.link(reroute, "out", outer, "Switch")
    tree.link(menu, "out", outer, "True")
    first = tree.switch("on", false="d", true="d")
    computed = tree.add("ShaderNodeMath", ["x"])
    tree.link(tree.start, "on", computed, "x")
    unknown = tree.switch(None, true="b")
    tree.link(computed, "out", unknown, "Switch")
    tree.link(tree.start, "e", computed, "x", muted=True)
    tree.end(outer, first, unknown)
    result = sockets.conditions(tree, {"on": [False, True], "kind": ["x", "y", "z"]})
    assert result["c"] == [{"on": [True], "kind": ["x", "y"]}] and result["a"] == [
        {"on": [True], "kind": ["z"]}
    ]
    assert result["kind"] == [{"on": [True]}]
    # Both branches, a computed switch: used always. A muted link: never.
    assert result["on"] == result["d"] == result["b"] == [] and "e" not in result


def test_conditions_go_through_groups_and_zones():
    inner = Nodes("flag", "length")
    inner.end(inner.switch("flag", true="length"))
    tree = Nodes("on", "size", "often")
    group = tree.add("GeometryNodeGroup", ["flag", "length"], ["Geometry"], node_tree=inner)
    tree.link(tree.start, "on", group, "flag")
    tree.link(tree.start, "size", group, "length")
    last = tree.add("GeometryNodeRepeatOutput", ["in"])
    first = tree.add("GeometryNodeRepeatInput", ["Iterations"], paired_output_node=last)
    tree.link(tree.start, "often", first, "Iterations")
    tree.link(group, "Geometry", last, "in")
    tree.end(last)
    result = sockets.conditions(tree, {"on": [False, True]})
    assert result == {"on": [], "size": [{"on": [True]}], "often": []}


#: A program that answers as the script of a worker does, for boxes.
FAKE = """#!{python}
import json, os, struct, sys
print("Blender 4.2.0", flush=True)
print("Read blend", flush=True)
def write(head, body=b""):
    sys.stdout.buffer.write(json.dumps({{**head, "bytes": len(body)}}).encode() + b"\\n" + body)
    sys.stdout.buffer.flush()
def mesh(values):
    w, h = values.get("Socket_1", 1.0), values.get("Socket_2.1", 1.0)
    if values.get("Socket_3") == "crash" : os._exit(3)
    if values.get("Socket_3") == "fail" : return {{"failed": "the modifier gives points"}}, b""
    v = [(x * w, y * h, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    f = [(0,1,3),(0,3,2),(4,6,7),(4,7,5),(0,4,5),(0,5,1),(2,3,7),(2,7,6),(0,2,6),(0,6,4),(1,5,7),(1,7,3)]
    body = b"".join(struct.pack("<3d", *p) for p in v) + b"".join(struct.pack("<3q", *c) for c in f)
    return {{"vertices": 8, "faces": 12}}, body
recipe = json.loads(sys.stdin.readline())
if not os.path.exists({about!r}):
    sys.exit("error while loading shared libraries")
about = json.load(open({about!r}))
if "unloadable" in about:
    write(about)
    sys.exit(1)
def values(numbers):
    rows = recipe["parameters"]
    named = {{rows[n]["key"]: rows[n]["values"][int(x)] if rows[n]["values"] else x for n, x in numbers.items()}}
    return recipe["kept"] | named
if "describe" in recipe:
    head, body = mesh(values(recipe["describe"]))
    write({{**about, **head}}, body)
    sys.exit()
write({{"ready": True}})
for line in sys.stdin:
    request = json.loads(line)
    head, body = mesh(values(request["numbers"]))
    write({{"key": request["key"], **head}}, body)
"""

FATES = ["well", "crash", "fail"]
SOCKETS = [
    Socket("Width", "Socket_1", None, "real", 1.0, 0.5, 3.0, "", [], True, []),
    Socket("Size.y", "Socket_2", 1, "real", 1.0, 0.5, 3.0, "", [], True, []),
    Socket("My Fate", "Socket_3", None, "menu", "well", None, None, "", FATES, True, []),
    Socket("Useless", "Socket_4", None, "real", 1.0, 0.5, 3.0, "", [], False, []),
]


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A file that a program which is no Blender describes."""
    if sys.platform == "win32":
        pytest.skip("a script is no program there")
    program, about = tmp_path / "blender", tmp_path / "about.json"
    program.write_text(FAKE.format(python=sys.executable, about=str(about)))
    program.chmod(0o755)
    rows = [vars(entry) for entry in SOCKETS]
    about.write_text(
        json.dumps(
            {"object": "Box", "modifier": "Nodes", "sockets": rows, "libraries": [], "blender": "4.2.0"}
        )
    )
    monkeypatch.setenv("NIWAKI_BLENDER", str(program))
    (tmp_path / "box.blend").write_bytes(b"BLENDER")
    return tmp_path / "box.blend"


def test_a_program_that_answers_as_blender_does_is_fitted(place):
    model = nw.blend(place, hold=["my fate"])
    assert model.space.names == ["Width", "Size.y"] and model.kept == {"Socket_3": "well"}
    target = nw.Target.of_shapes(nw.box((1.0, 0.6, 0.5), (2.0, 1.2, 1.0)))
    result = nw.fit(model, nw.match_volume(target), 24, workers=1, seed=1)
    assert result.best.iou > 0.95 and result.best.parameters["Size.y"] == pytest.approx(1.2, abs=0.1)
    assert result.spread == 0.0 and not result.failures and not result.defects


def test_a_crash_costs_its_points_alone(place):
    target = nw.Target.of_shapes(nw.box((1.0, 0.6, 0.5), (2.0, 1.2, 1.0)))
    result = nw.fit(nw.blend(place), nw.match_volume(target), 12, workers=1, seed=1)
    texts = {
        "crash": "its process ended with code 3",
        "fail": "the modifier gives points",
        "well": "",
    }
    fates = [(sample.parameters["My Fate"], sample.failure) for sample in result]
    assert {fate for fate, _ in fates} == set(FATES) and all(text == texts[fate] for fate, text in fates)


def test_ranges_and_values_are_given_by_names_as_python_writes_them(place):
    model = nw.blend(place, width=Uniform(1, 2), my_fate=["well", "fail"], **{"Size.y": 2})
    assert model.space.axis("Width").range == Uniform(1.0, 2.0) and model.kept == {"Socket_2.1": 2}
    assert model.space.axis("My Fate").values == ("well", "fail")
    assert model.recipe()["parameters"]["My Fate"] == {"key": "Socket_3", "values": ["well", "fail"]}
    assert model.call({"Width": 1.5, "My Fate": 0}).mesh[0].max(axis=0).tolist() == [1.5, 2.0, 1.0]
    assert nw.blend(place, hold=["size"]).kept == {"Socket_2.1": 1.0}
    for words, text in (
        ({"depth": 3}, "a socket of `Nodes`: Width, Size.y, My Fate, Useless"),
        ({"useless": Uniform(1, 2)}, "depends"),
        ({"hold": ["Width", "Size.y", "My Fate"]}, "all sockets of `Nodes` are held"),
        ({"up": "x"}, '"y" or "z"'),
    ):
        with pytest.raises(InputError) as error:
            nw.blend(place, **words)
        assert text in str(error.value)


def test_blender_is_named_or_found_or_asked_for(place, monkeypatch, tmp_path):
    assert find_blender("a.blend", sys.executable)[:2] == [sys.executable, "-I"]
    assert find_blender("a.blend")[1:4] == ["--background", "--factory-startup", "--python"]
    with pytest.raises(InputError, match="there is no program `nowhere`"):
        find_blender("a.blend", "nowhere")
    monkeypatch.setenv("NIWAKI_BLENDER", "")
    monkeypatch.setenv("PATH", str(tmp_path / "empty"))
    with pytest.raises(InputError, match=r"(?s)there is no Blender here.*NIWAKI_BLENDER=/path/to/blender"):
        nw.blend(place)
    with pytest.raises(FileError):
        nw.blend(tmp_path / "missing.blend", blender=sys.executable)


def test_what_blender_says_of_a_file_reaches_the_person(place, tmp_path):
    about = tmp_path / "about.json"
    about.write_text(
        json.dumps({"unloadable": "x", "reason": "there is no object `A`", "cure": "name one of B"})
    )
    with pytest.raises(
        InputError, match=r"(?s)`box.blend` cannot be fitted: there is no object `A`.*name one of B"
    ):
        nw.blend(place, "A")
    about.write_text(json.dumps({"unloadable": "File format is not supported"}))
    with pytest.raises(InputError, match=r"(?s)`box.blend` does not open in Blender.*not supported"):
        nw.blend(place)
    os.remove(about)
    with pytest.raises(InputError, match="it ended with code 1: error while loading shared libraries"):
        nw.blend(place)


def test_the_command_names_an_object_and_stands_targets_up(place):
    model = shell.generator_named(f"{place}:Box:Nodes", ["my fate=well", "Width"])
    assert (model.name, model.up, model.kept) == ("box-Box", "y", {"Socket_1": 1.0, "Socket_3": "well"})
    with pytest.raises(InputError, match="a Blender file, whose sockets"):
        shell.generator_named("box.py:box", ["width=3"])
    block = nw.Target.of_shapes(nw.box((1.0, 0.5, 2.0), (2.0, 1.0, 4.0)))
    for name, size in (("a.stl", [2.0, 4.0, 1.0]), ("a.obj", [2.0, 1.0, 4.0])):
        trimesh.Trimesh(block.vertices, block.faces).export(place.with_name(name))
        score = shell.goal(model, {"target": str(place.with_name(name))})
        assert score.target.size.tolist() == pytest.approx(size)
