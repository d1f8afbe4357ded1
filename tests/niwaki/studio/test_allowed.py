"""Which files a studio runs for stored results, and which folder it writes to."""

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

#: Leaves a mark when it is run.
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


def shown(one):
    """Whether the picked result is shown and described."""
    one.ask("show", key=one.view["picked"], detail="fine")
    return one.ask("describe", key=one.view["picked"])["choices"]


def ready(one):
    while one.view["model"] is None:
        one.read(20)


def test_a_result_runs_its_file_only_where_it_was_named_or_trusted(tmp_path: Path) -> None:
    file, mark, folder = tmp_path / "garden.py", tmp_path / "mark", tmp_path / "session"
    file.write_text(MODEL.format(mark=str(mark)))
    with serving(folder, file) as served, studio.connect(served.url, served.key) as one:
        ready(one)
        one.ask("ask", ask={"target": {"source": "box"}})
        one.ask("set", settings={"count": 1, "seed": 1, "effort": 0.25})
        one.ask("run")
        # The other process has not searched: it reads the stored run.
        choices = shown(one)
        assert len(choices) == 1
    mark.unlink()
    with serving(folder) as served, studio.connect(served.url, served.key) as one:
        ready(one)
        assert one.view["problem"]["code"] == "unnamed-file"
        with pytest.raises(studio.StudioError, match="was not named") as refused:
            shown(one)
        assert refused.value.code == "untrusted-file" and "--trust" in refused.value.text
    assert not mark.exists()
    with serving(folder, "--trust") as served, studio.connect(served.url, served.key) as one:
        ready(one)
        assert [found["value"] for found in shown(one)] == [found["value"] for found in choices]
        assert mark.read_text() == "run "
        with pytest.raises(studio.StudioError, match="was not named"):
            one.ask("run")
    mark.unlink()
    file.write_text(file.read_text() + "\nX = 1\n")
    with serving(folder, "--trust") as served, studio.connect(served.url, served.key) as one:
        ready(one)
        with pytest.raises(studio.StudioError, match="has changed since"):
            shown(one)
        assert not mark.exists()
    # Who names it has read it.
    with serving(folder, file) as served, studio.connect(served.url, served.key) as one:
        ready(one)
        assert shown(one) == choices


def test_two_sessions_at_once_and_one_folder_for_one_studio(tmp_path: Path) -> None:
    with serving(tmp_path / "a") as first, serving(tmp_path / "b") as second:
        assert first.port != second.port
        with studio.connect(first.url, first.key) as one, studio.connect(second.url, second.key) as other:
            one.ask("model", reference="spaceship")
            other.ask("model", reference="drawing:bug")
            assert one.session != other.session
            for window, name in ((one, "spaceship"), (other, "drawing:bug")):
                while window.view["model"]["reference"] != name:
                    window.read(20)
        command = [sys.executable, "-m", "niwaki.shell.main", "studio", "--no-browser"]
        refused = subprocess.run(
            [*command, "--session", str(tmp_path / "a")], capture_output=True, text=True, timeout=60
        )
        assert refused.returncode != 0
        assert "folder-in-use" in refused.stderr and "--session" in refused.stderr
        with pytest.raises(Exception, match="403"):
            studio.connect(first.url, second.key)
    # It is free again once the studio has ended.
    with serving(tmp_path / "a") as third, studio.connect(third.url, third.key) as one:
        ready(one)
        assert one.view["model"]["reference"] == "spaceship"


def test_each_model_of_a_file_that_was_named_can_be_chosen(tmp_path: Path) -> None:
    file, other = tmp_path / "garden.py", tmp_path / "other.py"
    text = MODEL.format(mark=str(tmp_path / "mark"))
    file.write_text(text + text[text.index("@model") :].replace("tower", "wall"))
    other.write_text(text)
    with serving(tmp_path / "session", file) as served, studio.connect(served.url, served.key) as one:
        for name in ("tower", "wall"):
            one.ask("model", reference=f"{file}:{name}")
            while one.view["model"]["reference"] != f"{file.resolve()}:{name}":
                one.read(20)
            assert f"{file.resolve()}:{name}" in {listed["reference"] for listed in one.view["models"]}
            one.ask("ask", ask={"target": {"source": "box"}})
            one.ask("set", settings={"count": 1, "seed": 1, "effort": 0.25})
            one.ask("run")
            assert one.view["results"]
        with pytest.raises(studio.StudioError, match="was not named at the start"):
            one.ask("model", reference=f"{other}:tower")


@pytest.mark.parametrize("port", [-1, 65_536, 70_000, 10**20])
def test_a_port_that_is_none_is_refused(port: int) -> None:
    with pytest.raises(InputError, match="a port from 0 to 65535") as refused:
        listening(port)
    assert refused.value.code == "bad-setting"


def test_a_port_that_is_taken_is_refused() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        with pytest.raises(InputError, match="expected a free port [(]Address already in use[)]"):
            listening(taken.getsockname()[1])
