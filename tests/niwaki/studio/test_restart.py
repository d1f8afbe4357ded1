"""What was shown is there after `kill -9`; a worker that ends does not end the studio."""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path

import pytest

pytest.importorskip("starlette")

from niwaki import studio
from studio_process import serving


def test_kill_in_a_search_loses_nothing_that_was_shown(tmp_path):
    with serving(tmp_path) as served:
        with studio.connect(served.url, served.key) as one:
            one.ask("model", reference="spaceship")
            one.ask("set", settings={"count": 3, "seed": 1, "effort": 0.25})
            one.ask("run")
            one.ask("star", key=one.view["results"][1]["key"])
            one.ask("hold", parts=["while[0]/length"])
            before = {
                name: one.view[name]
                for name in ("results", "picked", "stars", "held", "settings", "model", "undo")
            }
            one.ask("set", settings={"count": 8, "seed": 2, "effort": 64.0})
            one.events.clear()
            one.send("run")
            while not any(event["kind"] == "shape" and event["what"] == "best" for event in one.events):
                one.read(20)
            served.kill()
    begun = time.monotonic()
    with serving(tmp_path) as served, studio.connect(served.url, served.key) as one:
        while one.view["model"] is None:
            one.read(10)
        assert time.monotonic() - begun < 30.0
        before |= {"settings": one.view["settings"], "undo": before["undo"] + 1}
        assert {name: one.view[name] for name in before} == before
        assert one.view["settings"]["seed"] == 2 and one.view["interrupted"] and one.view["searching"] is None
        key = one.view["picked"]
        one.ask("show", key=key)
        assert one.shapes[-1][0].key is not None or one.read(5)["kind"] == "shape"
        one.ask("set", settings={"count": 1, "seed": 2, "effort": 0.25})
        one.ask("run")
        assert not one.view["interrupted"]


def test_a_worker_that_is_killed_is_named_and_a_fresh_one_takes_its_place(tmp_path):
    with serving(tmp_path) as served, studio.connect(served.url, served.key) as one:
        one.ask("model", reference="gnarly-tree")
        one.ask("set", settings={"count": 1, "seed": 1, "effort": 64.0})
        number = one.send("run")
        while not any(event["kind"] == "shape" and event["what"] == "best" for event in one.events):
            one.read(20)
        for child in _children(served.process.pid):
            os.kill(child, signal.SIGKILL)
        with pytest.raises(studio.StudioError, match="fresh one"):
            one.wait(number, 10)
        one.ask("set", settings={"count": 1, "seed": 1, "effort": 0.25})
        one.ask("run")
        assert len(one.view["results"]) == 1


def test_workers_end_with_the_server(tmp_path):
    with serving(tmp_path) as served:
        with studio.connect(served.url, served.key) as one:
            one.ask("model", reference="spaceship")
            one.ask("run")
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
    return [int(one) for one in Path(f"/proc/{process}/task/{process}/children").read_text().split()]


def _state(process: int) -> str:
    return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
