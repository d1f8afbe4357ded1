"""Files of models that do not end, or that end their process: a message, and a fresh process."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Coroutine
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("starlette")

from niwaki.studio import messages as m
from niwaki.studio import process
from niwaki.studio.process import Worker
from niwaki.studio.session import Session, begin, loading, reload, reshaping, searching
from niwaki.studio.window import Window
from niwaki.studio.worker import models, offers
from studio_process import PILE

#: Texts of files, and a part of the message about each.
ENDINGS = {
    "raise SystemExit(3)": "SystemExit: 3 (line 1)",
    "import sys\nsys.exit()": "SystemExit",
    "raise KeyboardInterrupt": "it raises KeyboardInterrupt",
    "raise GeneratorExit": "GeneratorExit",
    "class Odd(BaseException): pass\nraise Odd('x')": "Odd: x",
    "import os\nos._exit(0)": "the process that ran it has ended",
    "import os, signal\nos.kill(os.getpid(), signal.SIGSEGV)": "the process that ran it has ended",
    "import os\nos.close(1); os.closerange(3, 50)": "",
}


def alive(work: Coroutine[Any, Any, None]) -> None:
    """Do work with a limit of time."""

    async def bounded() -> None:
        async with asyncio.timeout(60):
            await work

    asyncio.run(bounded())


def test_a_file_that_loops_is_ended_with_its_line_and_a_fresh_process_goes_on(tmp_path, monkeypatch):
    monkeypatch.setattr(process, "LOADING", 2.0)
    place = tmp_path / "pile.py"

    async def work() -> None:
        worker = Worker(str(place))
        try:
            for text, line in (("x = 1\nwhile True:\n    pass\n", 2), ("import time\ntime.sleep(1e6)\n", 2)):
                place.write_text(text)
                answer = await worker.do(m.ListModels(files=[str(place)]))
                assert answer.problem is not None and answer.problem.code == "model-file-failed"
                text = answer.problem.text
                assert f"it was ended at line {line}" in text or f"at line {line + 1}" in text
                assert str(place) in text
                # Loading the unchanged file again fails at once.
                monkeypatch.setattr(process, "LOADING", 1e6)
                again = await worker.do(m.Load(reference=str(place)))
                assert again.problem is not None and again.problem.code == "model-file-failed"
                monkeypatch.setattr(process, "LOADING", 2.0)
                assert (await worker.do(m.ListModels(files=[]))).models
            place.write_text(PILE)
            answer = await worker.do(m.Load(reference=str(place)))
            assert answer.problem is None and answer.models[0].parameters
        finally:
            await worker.kill()

    alive(work())


@pytest.mark.parametrize("text", ENDINGS)
def test_a_file_that_ends_its_process_is_named_and_the_gallery_stays(tmp_path, text):
    place = tmp_path / "pile.py"
    place.write_text(text + "\n")

    async def work() -> None:
        session = Session(tmp_path / "session", [str(place)])
        try:
            await begin(session)
            assert session.problem is not None and session.problem.code == "model-file-failed"
            assert ENDINGS[text] in session.problem.text and str(place) in session.problem.text
            assert len(session.models) > 10 and session.models[0].reference == str(place)
            place.write_text(PILE)
            await reload(session, {place})
            assert session.problem is None and session.model is not None and session.model.parameters
        finally:
            await session.end()

    alive(work())


def test_a_file_that_is_mended_while_it_loads_is_not_waited_for(tmp_path, monkeypatch):
    monkeypatch.setattr(process, "LOADING", 1e6)
    place = tmp_path / "pile.py"
    place.write_text(PILE)

    async def work() -> None:
        session = Session(tmp_path / "session", [str(place)])
        try:
            await begin(session)
            place.write_text("while True: pass\n")
            first = session.start(reload(session, {place}))
            while session.desk._loading.path != str(place) or not session.desk._loading.line:
                await asyncio.sleep(0.02)
            place.write_text(PILE)
            await reload(session, {place})
            await first
            assert session.problem is None and session.model is not None and session.model.parameters
        finally:
            await session.end()

    alive(work())


def test_the_changes_of_one_save_are_one_reload(tmp_path, monkeypatch):
    place = tmp_path / "pile.py"
    place.write_text(PILE)
    reloads = []

    async def load(session):
        reloads.append(place.read_text())
        await asyncio.sleep(0.2)

    async def work() -> None:
        session = Session(tmp_path / "session", [str(place)])
        try:
            await begin(session)
            monkeypatch.setattr(loading, "load", load)
            place.write_text(PILE + "\n")
            # Two changes while the file loads, and a third right after.
            await asyncio.gather(reload(session, {place}), reload(session, {place}))
            await reload(session, {place})
            assert len(reloads) == 1
            # Another text is another save, and so is the same text later: what the model reads may have changed.
            place.write_text(PILE)
            await reload(session, {place})
            assert len(reloads) == 2
            monkeypatch.setattr(session, "settled", 0.0)
            await reload(session, {place})
            assert len(reloads) == 3
        finally:
            await session.end()

    alive(work())


def test_a_result_that_is_run_again_is_dropped_where_a_search_has_replaced_it(tmp_path):
    place = tmp_path / "pile.py"
    place.write_text(PILE)
    settings = m.Settings(count=1, seed=1, effort=0.05)

    async def work() -> None:
        session = Session(tmp_path / "session", [str(place)])
        window = Window()
        try:
            await begin(session)
            session.step("set", {"ask": m.Ask(target=m.TargetAsk("box")), "settings": settings})
            await searching.run(session, window, m.Run())
            do, released = session.desk.do, asyncio.Event()

            async def late(job: m.Job, report: Any = None) -> m.Answer:
                answer = await do(job, report)
                if isinstance(job, m.Change):
                    await released.wait()
                return answer

            session.desk.do = late
            again = asyncio.create_task(reshaping.reshape(session))
            await asyncio.sleep(0)
            await searching.run(session, window, m.Run())
            results, picked = session.document.results, session.document.picked
            released.set()
            await again
            assert session.document.results == results and session.document.picked == picked
        finally:
            await session.end()

    alive(work())


def test_a_search_survives_a_change_of_the_file_that_it_loads(tmp_path, monkeypatch):
    monkeypatch.setattr(process, "LOADING", 1e6)
    place = tmp_path / "pile.py"
    place.write_text("while True: pass\n")
    ask = m.Question(str(place), {}, m.Ask(target=m.TargetAsk("box")), m.Settings(count=1, effort=0.25))

    async def work() -> None:
        worker = Worker(str(place))
        try:
            job = m.Grow(question=ask, run=1, seed=1, file=str(tmp_path / "1.json"))
            search = asyncio.create_task(worker.do(job))
            while worker._loading.path != str(place):
                await asyncio.sleep(0.02)
            place.write_text(PILE)
            await worker.drop([place])
            answer = await search
            assert answer.problem is None and not answer.interrupted and len(answer.outcomes) == 1
        finally:
            await worker.kill()

    alive(work())


def test_a_host_function_that_does_not_end_does_not_hold_the_desk_for_ever(tmp_path):
    place = tmp_path / "pile.py"
    text = PILE.replace("from niwaki import", "import niwaki\nfrom niwaki import")
    text = text.replace(
        "@model", "@niwaki.host\ndef slow() -> float:\n    while True:\n        pass\n\n\n@model", 1
    )
    place.write_text(text.replace("    for i in range(count):", "    slow()\n    for i in range(count):", 1))
    ask = m.Question(str(place), {}, m.Ask(target=m.TargetAsk("box")), m.Settings(count=1))

    async def work() -> None:
        worker = Worker(str(place))
        try:
            assert (await worker.do(m.Load(reference=str(place)))).problem is None
            worker.patience = 2.0
            job = m.Grow(question=ask, run=0, seed=1, file=str(tmp_path / "0.json"))
            answer = await worker.do(job)
            assert answer.problem is not None and answer.problem.code == "too-slow"
            worker.patience = None
            assert (await worker.do(m.Load(reference=ask.model))).problem is None
        finally:
            await worker.kill()

    alive(work())


@pytest.mark.skipif(os.name == "nt", reason="groups of processes are Unix")
def test_processes_of_a_file_end_with_its_worker(tmp_path, monkeypatch):
    monkeypatch.setattr(process, "LOADING", 2.0)
    place, note = tmp_path / "pile.py", tmp_path / "child"
    place.write_text(
        "import subprocess, pathlib\n"
        "child = subprocess.Popen(['sleep', '1000'])\n"
        f"pathlib.Path({str(note)!r}).write_text(str(child.pid))\n"
        "while True: pass\n"
    )

    async def work() -> None:
        worker = Worker(str(place))
        try:
            assert (await worker.do(m.Load(reference=str(place)))).problem is not None
        finally:
            await worker.kill()
        child = Path(f"/proc/{note.read_text()}/stat")
        while child.exists() and child.read_text().rpartition(")")[2].split()[0] != "Z":
            await asyncio.sleep(0.02)

    alive(work())


def test_all_models_of_a_file_are_offered(tmp_path, monkeypatch):
    place = tmp_path / "two.py"
    place.write_text(PILE + PILE.partition('"""A pile."""')[2].replace("def pile(", "def heap("))
    monkeypatch.setitem(models.named, place.resolve(), str(place))
    answer = offers.listed(m.ListModels(files=[str(place)]))
    files = [info.reference for info in answer.models if info.is_file]
    assert files == [f"{place}:pile", f"{place}:heap"]
