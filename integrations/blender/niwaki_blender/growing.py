"""A search in a worker process, watched from a thread: Blender stays free, and asks now and then how far it is.

The worker is the studio's: a process of the same Python that does jobs. A model is imported and run only there.
"""

from __future__ import annotations

import asyncio
import json
import os
import shutil
import tempfile
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import niwaki
import numpy as np
from niwaki.studio.messages import Answer, GrowAgain, GrowValues, Hold, Outcome, Progressed, Shape, WriteFile
from niwaki.studio.process import Worker

from . import axes
from .asking import Mesh

#: Seconds between two tries to stop a search.
LOOK = 0.05


@dataclass(frozen=True)
class Grown:
    """What a search found.

    Attributes
    ----------
    run : str
        The run.json: the whole search with its results, to carry it out again.
    outcomes
        Numbers of the results, the best first.
    files
        Their GLB files.
    interrupted
        Whether it was cancelled before its end.
    """

    run: str
    outcomes: list[Outcome]
    files: list[Path]
    interrupted: bool


@dataclass(frozen=True)
class Again:
    """A stored search to carry out again.

    Attributes
    ----------
    run : str
        Its run.json.
    number
        The result of it whose parts are held.
    seed, count
        As they were, where they are None.
    held
        Addresses of parts that stay as they are; as they were stored, where it is None.
    """

    run: str
    number: int = 0
    seed: int | None = None
    count: int | None = None
    held: Sequence[str] | None = None


class Growing:
    """A search that was begun.

    Parameters
    ----------
    job
        What to search.
    words
        Files of models that may be run.

    Attributes
    ----------
    progress : Progressed or None
        The newest report.
    best : asking.Mesh or None
        The shape of the best so far, from the model's origin.
    grown : Grown or None
        What was found, when it has ended.
    problem, code : str
        Why it failed, for people and for programs.
    """

    def __init__(self, job: GrowValues | Again, words: Sequence[str] = ()) -> None:
        self.progress: Progressed | None = None
        self.best: Mesh | None = None
        self.grown: Grown | None = None
        self.problem = self.code = ""
        self._folder = Path(tempfile.mkdtemp(prefix="niwaki-"))
        self._worker = Worker(*words, environment=environment())
        self._job = job
        self._loop = asyncio.new_event_loop()
        self._is_searching, self._is_stopping, self._is_abandoned = True, False, False
        self._thread = threading.Thread(target=self._carry_out, daemon=True)
        self._thread.start()

    @property
    def has_ended(self) -> bool:
        """Whether there is a result or a problem."""
        return not self._thread.is_alive()

    def wait(self, seconds: float | None = None) -> None:
        """Wait for the end."""
        self._thread.join(seconds)

    def stop(self) -> None:
        """End the search; what it has found is kept."""
        if not self.has_ended and not self._is_stopping:
            self._is_stopping = True
            asyncio.run_coroutine_threadsafe(self._stop(), self._loop)

    def abandon(self) -> None:
        """End the search, and leave nothing of it."""
        self._is_abandoned = True
        self.stop()
        if self.has_ended:
            self.clear()

    def clear(self) -> None:
        """Remove the files."""
        shutil.rmtree(self._folder, ignore_errors=True)

    def _carry_out(self) -> None:
        try:
            self._loop.run_until_complete(self._work())
        except _Failed as error:
            self.problem, self.code = str(error), error.code
        except Exception as error:  # a thread has nobody who would see it
            self.problem = f"{type(error).__name__}: {error}"
        finally:
            self._is_searching = False
            self._loop.run_until_complete(self._end())
            self._loop.close()
            if self._is_abandoned:
                self.clear()

    async def _end(self) -> None:
        """End the worker, and wait for a `stop` that is still trying."""
        await self._worker.kill()
        left = asyncio.all_tasks() - {asyncio.current_task()}
        await asyncio.gather(*left, return_exceptions=True)

    async def _stop(self) -> None:
        """Stop the worker's job: once there is one, and its process."""
        while self._is_searching:
            await self._worker.stop()
            await asyncio.sleep(LOOK)

    async def _work(self) -> None:
        file = self._folder / "run.json"
        job = self._job if isinstance(self._job, GrowValues) else await self._again(self._job)
        job.file = str(file)
        answer = Answer() if self._is_stopping else await self._do(job)
        self._is_searching = False
        if not answer.outcomes:
            raise _Failed("Cancelled before anything was found")
        files = []
        for outcome in answer.outcomes:
            number = outcome.key.number
            folder = self._folder / str(number)
            written = await self._do(
                WriteFile(source=str(file), number=number, format="glb", folder=str(folder))
            )
            files.append(Path(written.path))
        self.grown = Grown(file.read_text(), answer.outcomes, files, answer.interrupted)

    async def _again(self, stored: Again) -> GrowAgain:
        """The job of a stored search, with the choices that hold its parts."""
        source = self._folder / "stored.json"
        source.write_text(stored.run)
        hold: dict[str, Any] | None = None
        if stored.held is not None:
            hold = {}
            if stored.held:
                answer = await self._do(
                    Hold(source=str(source), number=stored.number, parts=list(stored.held))
                )
                for part in answer.held:
                    hold |= part.choices
        return GrowAgain(source=str(source), run=0, file="", seed=stored.seed, hold=hold, count=stored.count)

    async def _do(self, job: Any) -> Answer:
        answer = await self._worker.do(job, self._report)
        if answer.problem is not None:
            raise _Failed(answer.problem.text, answer.problem.code)
        return answer

    def _report(self, report: Any, payload: bytes) -> None:
        if isinstance(report, Progressed):
            self.progress = report
        elif isinstance(report, Shape) and report.role == "best":
            self.best = _mesh(report, payload)


class _Failed(Exception):
    """A job that ended with a problem."""

    def __init__(self, text: str, code: str = "") -> None:
        super().__init__(text)
        self.code = code


def _mesh(shape: Shape, payload: bytes) -> Mesh:
    """The light mesh of a worker: places, colours, corners, numbers of parts (`niwaki.studio.worker.shapes`)."""
    points = np.frombuffer(payload, "<f4", 3 * shape.vertices).reshape(-1, 3)
    faces = np.frombuffer(payload, "<u4", 3 * shape.triangles, 16 * shape.vertices).reshape(-1, 3)
    return Mesh("best so far", axes.to_blender(points), faces.astype(np.int64))


def environment() -> dict[str, str]:
    """Of a worker: it finds the packages of the extension, and nothing of the folder that Blender was started in."""
    packages = str(Path(niwaki.__file__).parents[1])
    paths = [packages, *filter(None, [os.environ.get("PYTHONPATH")])]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(paths), "PYTHONSAFEPATH": "1"}


def results(run: str) -> list[dict[str, Any]]:
    """The results of a run.json: their seeds, scores and choices."""
    found: list[dict[str, Any]] = json.loads(run)["runs"]
    return found


def title(reference: str) -> str:
    """What results of a model are called: the model's name, or that of its function or file."""
    path, _, function = reference.rpartition(":")
    return Path(reference).stem if reference.endswith(".py") or not path else function


def reference(run: str) -> str:
    """The model of a run.json, as it was named."""
    return str(json.loads(run)["model"])


def model_file(run: str) -> tuple[Path, str] | None:
    """The model's file of a run.json with the hash of its bytes; None where a model of the gallery was grown."""
    data = json.loads(run)
    path, colon, _ = str(data["model"]).rpartition(":")
    return (Path(path), str(data["file_hash"])) if colon and data.get("file_hash") else None
