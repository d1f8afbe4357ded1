"""The tools of the protocol: one for each message, with its schema; answers in pages; files below one folder alone."""

from __future__ import annotations

import os
from pathlib import Path
from typing import get_args

import pytest

pytest.importorskip("mcp")

import msgspec
from agent import Agent
from jsonschema import Draft202012Validator
from niwaki.agents import answers, tools
from niwaki.studio import messages as m
from niwaki.studio.worker import confinement

TOWER = """from niwaki import box, emit, model, uniform


@model
def tower(storeys: int = 3):
    for i in range(storeys):
        w = uniform(0.5, 1.0)
        emit(box((0, i + 0.5, 0), (w, 1, w)))
"""


def test_each_message_is_a_tool_with_its_text_and_its_schema():
    listed = {tool.name: tool for tool in tools.tools()}
    kinds = {kind.__struct_config__.tag: kind for kind in get_args(m.AnyCommand) if kind is not m.Hello}
    assert set(listed) == {*kinds, "answer"}
    for name, kind in kinds.items():
        fields = {field.encode_name for field in msgspec.structs.fields(kind)} - {"id"}
        assert set(listed[name].schema["properties"]) == fields
        assert listed[name].description.startswith(kind.__doc__.split("\n")[0])
        Draft202012Validator.check_schema(listed[name].schema)


def test_a_schema_accepts_what_the_session_accepts_and_refuses_what_it_refuses():
    validators = {tool.name: Draft202012Validator(tool.schema) for tool in tools.tools()}
    calls = {
        "run": ({}, {"now": 1}),
        "ask": ({"ask": {"target": {"source": "box"}}}, {"ask": {"target": {"from": "box"}}}),
        "set": ({"settings": {"count": 3}}, {"settings": {"count": 99}}),
        "show": ({"key": {"run": 0}, "detail": "picture"}, {"key": {"run": 0}, "detail": "large"}),
        "drag": ({"part": "a", "to": [0, 1, 0]}, {"part": "a", "to": [0, 1]}),
    }
    for name, (right, wrong) in calls.items():
        assert validators[name].is_valid(right) and not validators[name].is_valid(wrong), name
        tools.command(name, right, 1)
        with pytest.raises(msgspec.ValidationError):
            tools.command(name, wrong, 1)


def test_pages_have_all_lines_and_no_page_is_too_long():
    lines = [f"line {number} {'é' * (number % 90)}" for number in range(400)] + ["x" * 20_000, "end"]
    pages = answers.pages(lines)
    assert max(len(page.encode()) for page in pages) <= answers.PAGE - answers.HEAD
    assert "".join(pages).replace("\n", "") == "".join(lines)


def test_a_long_answer_has_pages_that_can_be_asked_for(agent: Agent):
    first = agent.call("look", fields=["models"])
    assert "page 1 of" in first.text.splitlines()[0]
    number, count = int(first.text.split()[1][:-1]), int(first.text.split(" of ")[1].split(";")[0])
    rest = [agent.call("answer", id=number, page=page).text for page in range(2, count + 1)]
    assert "spaceship" in first.text + rest[0] and '"stack:wheel"' in rest[-1]
    assert agent.call("answer", id=number).text == first.text
    assert "pages" in agent.failed("answer", id=number, page=count + 1)
    assert "no call 999" in agent.failed("answer", id=999)


def test_a_fault_names_its_line_and_a_mended_model_runs(agent: Agent):
    text = agent.failed("write", path="tower.py", text=TOWER.replace("(w, 1, w)))", "(w, 1, w))"))
    assert "model-file-failed at tower.py:8:" in text
    text = agent.failed("write", path="tower.py", text=TOWER.replace("uniform(", "unifrom("))
    assert "unknown-name at tower.py:7:13" in text and "did you mean `uniform`" in text
    text = agent.done("write", path="tower.py", text=TOWER)
    assert '"choice":"w","line":7' in text
    agent.done("model", reference="tower.py")
    reply = agent.call("preview", seed=1, count=2)
    assert '"seed":2' in reply.text and reply.picture is not None and reply.picture.startswith(b"\x89PNG")
    agent.done("ask", ask={"target": {"source": "box", "scale": [1, 3, 1]}})
    agent.done("set", settings={"count": 2, "seed": 1, "effort": 0.1})
    assert "covered" in agent.done("run")
    assert (agent.call("show", key={"run": 0}).picture or b"").startswith(b"\x89PNG")
    assert "tower-1-1.glb" in agent.done("export", key={"run": 0}, format="glb")


@pytest.mark.parametrize(
    "tool", ["read", "write", "model", "check"], ids=["read", "written", "chosen", "checked"]
)
@pytest.mark.parametrize("name", ["../outside.py", "link.py", "linked/outside.py", "ABSOLUTE"])
def test_no_message_reaches_a_file_outside_the_folder(agent: Agent, tool: str, name: str):
    outside = agent.folder.parent / "outside.py"
    outside.write_text("raise SystemExit('this file was run')\n")
    for link, end in (("link.py", outside), ("linked", outside.parent)):
        if not (agent.folder / link).is_symlink():
            os.symlink(end, agent.folder / link)
    name = str(outside) if name == "ABSOLUTE" else name
    key = "path" if tool in ("read", "write") else "reference"
    text = agent.failed(tool, **{key: name}, **({"text": TOWER} if tool == "write" else {}))
    assert "outside-folder" in text
    assert outside.read_text() == "raise SystemExit('this file was run')\n"


@pytest.mark.skipif(confinement.version() == 0, reason="the system has no Landlock")
def test_a_model_writes_below_the_folder_alone(agent: Agent):
    # Everybody may write there; the folder for temporary files is open to a worker.
    outside = Path("/var/tmp") / f"niwaki-{os.getpid()}.txt"
    program = "from pathlib import Path\n\nPath({!r}).write_text('x')\n" + TOWER
    text = agent.failed("write", path="writes.py", text=program.format(str(outside)))
    assert "model-file-failed at writes.py:3:1" in text and "PermissionError" in text
    assert not outside.exists()
    agent.done("write", path="writes.py", text=program.format(str(agent.folder / "inside.txt")))
    assert (agent.folder / "inside.txt").read_text() == "x"


def test_a_target_is_a_mesh_below_the_folder(agent: Agent):
    (agent.folder / "cube.obj").write_text(
        "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))
        + "".join(f"f {a} {b} {c}\n" for a, b, c in CUBE)
    )
    agent.done("write", path="tower.py", text=TOWER)
    agent.done("model", reference="tower.py")
    agent.done("ask", ask={"target": {"source": "cube.obj"}})
    assert "outside-folder" in agent.failed("ask", ask={"target": {"source": "../cube.obj"}})
    agent.done("set", settings={"count": 1, "seed": 1, "effort": 0.05})
    assert "covered" in agent.done("run")


#: The triangles of a cube, by its corners.
CUBE = [
    *((1, 2, 4), (1, 4, 3), (5, 7, 8), (5, 8, 6), (1, 5, 6), (1, 6, 2)),
    *((3, 4, 8), (3, 8, 7), (1, 3, 7), (1, 7, 5), (2, 6, 8), (2, 8, 4)),
]


def test_no_message_writes_what_is_not_a_model_or_a_note(agent: Agent):
    for name in ("requirements.toml", "notes.txt", "studio-session/key", "run.json"):
        assert "file-format" in agent.failed("write", path=name, text="x")
    agent.done("write", path="notes/first.md", text="a note")
    assert "a note" in agent.done("read", path="notes/first.md")
