"""Permissions of a studio: files that it runs for stored results, and its folder."""

from __future__ import annotations

import socket
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("starlette")

from niwaki import InputError, studio
from niwaki.studio.serving import listening
from studio_process import serving

#: A model file that leaves a mark when it is run.
MODEL = """
from pathlib import Path
from niwaki import box, emit, host, model, uniform

with Path({mark!r}).open("a") as file:
    file.write("run ")

@host
def doubled(x):
    return 2.0 * x

@model
def tower():
    size = doubled(uniform(0.5, 1.5))
    emit(box((0, 1, 0), (1, size, 1)))
"""


def described(script):
    """Show and describe the active result; return its choices."""
    script.ask("show", key=script.view["picked"], detail="fine")
    return script.ask("describe", key=script.view["picked"])["choices"]


def ready(script):
    while script.view["model"] is None:
        script.read(20)


def test_a_result_runs_its_file_only_where_it_was_named_or_trusted(tmp_path: Path) -> None:
    file, mark, folder = tmp_path / "garden.py", tmp_path / "mark", tmp_path / "session"
    file.write_text(MODEL.format(mark=str(mark)))
    with serving(folder, file) as served, studio.connect(served.url, served.key) as script:
        ready(script)
        script.ask("ask", ask={"target": {"source": "box"}})
        script.ask("set", settings={"count": 1, "seed": 1, "effort": 0.25})
        script.ask("run")
        # The other worker has not searched, so it reads the stored run.
        choices = described(script)
        assert len(choices) == 1
    mark.unlink()
    with serving(folder) as served, studio.connect(served.url, served.key) as script:
        ready(script)
        assert script.view["problem"]["code"] == "unnamed-file"
        with pytest.raises(studio.StudioError, match="was not named") as caught:
            described(script)
        assert caught.value.code == "untrusted-file" and "--trust" in caught.value.text
    assert not mark.exists()
    with serving(folder, "--trust") as served, studio.connect(served.url, served.key) as script:
        ready(script)
        assert [row["value"] for row in described(script)] == [row["value"] for row in choices]
        assert mark.read_text() == "run "
        with pytest.raises(studio.StudioError, match="was not named"):
            script.ask("run")
    mark.unlink()
    file.write_text(file.read_text() + "\nX = 1\n")
    with serving(folder, "--trust") as served, studio.connect(served.url, served.key) as script:
        ready(script)
        with pytest.raises(studio.StudioError, match="has changed since"):
            described(script)
        assert not mark.exists()
    # A user who names the file has read it.
    with serving(folder, file) as served, studio.connect(served.url, served.key) as script:
        ready(script)
        assert described(script) == choices


def test_two_sessions_at_once_and_one_folder_for_one_studio(tmp_path: Path) -> None:
    with serving(tmp_path / "a") as first, serving(tmp_path / "b") as second:
        assert first.port != second.port
        with studio.connect(first.url, first.key) as script, studio.connect(second.url, second.key) as other:
            script.ask("model", reference="spaceship")
            other.ask("model", reference="drawing:bug")
            assert script.session != other.session
            for window, name in ((script, "spaceship"), (other, "drawing:bug")):
                while window.view["model"]["reference"] != name:
                    window.read(20)
        command = [sys.executable, "-m", "niwaki.shell.main", "studio", "--no-browser"]
        done = subprocess.run(
            [*command, "--session", str(tmp_path / "a")], capture_output=True, text=True, timeout=60
        )
        assert done.returncode != 0
        assert "folder-in-use" in done.stderr and "--session" in done.stderr
        with pytest.raises(Exception, match="403"):
            studio.connect(first.url, second.key)
    # The folder is free after the end of the studio.
    with serving(tmp_path / "a") as third, studio.connect(third.url, third.key) as script:
        ready(script)
        assert script.view["model"]["reference"] == "spaceship"


def test_each_model_of_a_file_that_was_named_can_be_chosen(tmp_path: Path) -> None:
    file, other = tmp_path / "garden.py", tmp_path / "other.py"
    text = MODEL.format(mark=str(tmp_path / "mark"))
    file.write_text(text + text[text.index("@model") :].replace("tower", "wall"))
    other.write_text(text)
    with serving(tmp_path / "session", file) as served, studio.connect(served.url, served.key) as script:
        for name in ("tower", "wall"):
            script.ask("model", reference=f"{file}:{name}")
            while script.view["model"]["reference"] != f"{file.resolve()}:{name}":
                script.read(20)
            assert f"{file.resolve()}:{name}" in {listed["reference"] for listed in script.view["models"]}
            script.ask("ask", ask={"target": {"source": "box"}})
            script.ask("set", settings={"count": 1, "seed": 1, "effort": 0.25})
            script.ask("run")
            assert script.view["results"]
        with pytest.raises(studio.StudioError, match="not a model of the gallery"):
            script.ask("model", reference=f"{other}:tower")


@pytest.mark.parametrize("port", [-1, 65_536, 70_000, 10**20])
def test_an_invalid_port_is_refused(port: int) -> None:
    with pytest.raises(InputError, match="a port from 0 to 65535") as caught:
        listening(port)
    assert caught.value.code == "bad-setting"


def test_a_port_in_use_is_refused() -> None:
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        with pytest.raises(InputError, match="expected a free port [(]Address already in use[)]"):
            listening(other.getsockname()[1])
