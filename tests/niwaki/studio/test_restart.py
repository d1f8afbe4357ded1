"""Restarts: a session after `kill -9`, and a studio whose worker has ended."""

from __future__ import annotations

import os
import signal
import time
import urllib.request
from pathlib import Path

import pytest

pytest.importorskip("starlette")

from niwaki import studio
from studio_process import serving


def test_kill_in_a_search_loses_nothing_that_was_shown(tmp_path):
    with serving(tmp_path) as served:
        with studio.connect(served.url, served.key) as script:
            script.ask("model", reference="spaceship")
            script.ask("set", settings={"count": 3, "seed": 1, "effort": 0.25})
            script.ask("run")
            script.ask("star", key=script.view["results"][1]["key"])
            script.ask("hold", parts=["while[0]/length"])
            before = {
                name: script.view[name]
                for name in ("results", "picked", "stars", "held", "settings", "model", "undo")
            }
            script.ask("set", settings={"count": 8, "seed": 2, "effort": 64.0})
            script.events.clear()
            script.send("run")
            while not any(event["kind"] == "shape" and event["role"] == "best" for event in script.events):
                script.read(20)
            served.kill()
    start = time.monotonic()
    with serving(tmp_path) as served, studio.connect(served.url, served.key) as script:
        while script.view["model"] is None:
            script.read(10)
        assert time.monotonic() - start < 30.0
        before |= {"settings": script.view["settings"], "undo": before["undo"] + 1}
        assert {name: script.view[name] for name in before} == before
        assert (
            script.view["settings"]["seed"] == 2
            and script.view["interrupted"]
            and script.view["searching"] is None
        )
        key = script.view["picked"]
        script.ask("show", key=key)
        assert script.shapes[-1][0].key is not None or script.read(5)["kind"] == "shape"
        script.ask("set", settings={"count": 1, "seed": 2, "effort": 0.25})
        script.ask("run")
        assert not script.view["interrupted"]


def test_a_page_that_is_open_finds_the_studio_again(tmp_path):
    def answer(served):
        _, name, value = (tmp_path / "cookie").read_text().split()
        request = urllib.request.Request(f"{served.url}/", headers={"Cookie": f"{name}={value}"})
        with urllib.request.urlopen(request, timeout=30) as reply:
            return reply.status, served.url, name, value

    with serving(tmp_path) as served:
        before = answer(served)
        served.kill()
    assert before[0] == 200 and (os.name != "posix" or (tmp_path / "cookie").stat().st_mode & 0o077 == 0)
    with serving(tmp_path) as served:
        assert answer(served) == before
    # A file that is damaged is as good as none.
    (tmp_path / "cookie").write_text("80 niwaki_80_x short")
    with serving(tmp_path) as served:
        assert answer(served)[3] != before[3]


def test_a_killed_worker_gives_a_message_and_a_fresh_process(tmp_path):
    with serving(tmp_path) as served, studio.connect(served.url, served.key) as script:
        script.ask("model", reference="gnarly-tree")
        script.ask("set", settings={"count": 1, "seed": 1, "effort": 64.0})
        number = script.send("run")
        while not any(event["kind"] == "shape" and event["role"] == "best" for event in script.events):
            script.read(20)
        for child in _children(served.process.pid):
            os.kill(child, signal.SIGKILL)
        with pytest.raises(studio.StudioError, match="fresh process"):
            script.wait(number, 10)
        script.ask("set", settings={"count": 1, "seed": 1, "effort": 0.25})
        script.ask("run")
        assert len(script.view["results"]) == 1


def test_workers_end_with_the_server(tmp_path):
    with serving(tmp_path) as served:
        with studio.connect(served.url, served.key) as script:
            script.ask("model", reference="spaceship")
            script.ask("run")
        children = _children(served.process.pid)
        assert len(children) == 2
        served.kill()
        for _ in range(100):
            if not any(Path(f"/proc/{child}/stat").exists() and _state(child) != "Z" for child in children):
                break
            time.sleep(0.05)
        else:
            raise AssertionError("a worker outlives its server")


def _children(process: int) -> list[int]:
    return [int(number) for number in Path(f"/proc/{process}/task/{process}/children").read_text().split()]


def _state(process: int) -> str:
    return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
