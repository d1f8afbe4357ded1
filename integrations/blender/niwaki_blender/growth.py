"""A search in a worker process, watched by a thread: Blender stays responsive and polls the progress.

The worker is that of the studio: a process of the same Python that does jobs. Only this process imports and runs
models.
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
from .order import Mesh

#: Seconds between attempts to stop a search.
INTERVAL = 0.05


@dataclass(frozen=True)
class GrowthOutcome:
    """The outcome of a search.

    Attributes
    ----------
    run : str
        The text of run.json: the whole search with its results, for repetition.
    outcomes
        The numbers of the results, the best first.
    files
        The GLB files of the results.
    interrupted
        Whether the search was cancelled before its end.
    """

    run: str
    outcomes: list[Outcome]
    files: list[Path]
    interrupted: bool


@dataclass(frozen=True)
class Repetition:
    """A stored search to repeat.

    Attributes
    ----------
    run : str
        The text of its run.json.
    number
        The number of the result whose parts are held.
    seed, count
        A new seed and a new number of results; None for the stored values.
    held
        Addresses of held parts; None for the stored ones.
    """

    run: str
    number: int = 0
    seed: int | None = None
    count: int | None = None
    held: Sequence[str] | None = None


class Growth:
    """A search in the background.

    Parameters
    ----------
    job
        The search.
    words
        Files of models that may be run.

    Attributes
    ----------
    progress : Progressed or None
        The newest report.
    best : order.Mesh or None
        The shape of the best result so far, from the model's origin.
    outcome : GrowthOutcome or None
        The outcome, after the end of the search.
    problem, code : str
        The reason of a failure, for people and for programs.
    """

    def __init__(self, job: GrowValues | Repetition, words: Sequence[str] = ()) -> None:
        self.progress: Progressed | None = None
        self.best: Mesh | None = None
        self.outcome: GrowthOutcome | None = None
        self.problem = self.code = ""
        self._folder = Path(tempfile.mkdtemp(prefix="niwaki-"))
        self._worker = Worker(*words, environment=environment())
        self._job = job
        self._loop = asyncio.new_event_loop()
        self._is_searching, self._is_stopping, self._is_abandoned = True, False, False
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    @property
    def has_ended(self) -> bool:
        """Whether the search has ended."""
        return not self._thread.is_alive()

    def wait(self, seconds: float | None = None) -> None:
        """Wait for the end of the search."""
        self._thread.join(seconds)

    def stop(self) -> None:
        """Stop the search, and keep its results so far."""
        if not self.has_ended and not self._is_stopping:
            self._is_stopping = True
            asyncio.run_coroutine_threadsafe(self._stop(), self._loop)

    def abandon(self) -> None:
        """Stop the search, and remove its results."""
        self._is_abandoned = True
        self.stop()
        if self.has_ended:
            self.clear()

    def clear(self) -> None:
        """Remove the files."""
        shutil.rmtree(self._folder, ignore_errors=True)

    def _run(self) -> None:
        try:
            self._loop.run_until_complete(self._work())
        except _Failed as error:
            self.problem, self.code = str(error), error.code
        except Exception as error:  # errors of a thread are otherwise invisible
            self.problem = f"{type(error).__name__}: {error}"
        finally:
            self._is_searching = False
            self._loop.run_until_complete(self._end())
            self._loop.close()
            if self._is_abandoned:
                self.clear()

    async def _end(self) -> None:
        """End the worker, and wait for a pending `stop`."""
        await self._worker.kill()
        tasks = asyncio.all_tasks() - {asyncio.current_task()}
        await asyncio.gather(*tasks, return_exceptions=True)

    async def _stop(self) -> None:
        """Stop the worker's job, as soon as its process and the job have started."""
        while self._is_searching:
            await self._worker.stop()
            await asyncio.sleep(INTERVAL)

    async def _work(self) -> None:
        file = self._folder / "run.json"
        job = self._job if isinstance(self._job, GrowValues) else await self._repeat(self._job)
        job.file = str(file)
        answer = Answer() if self._is_stopping else await self._do(job)
        self._is_searching = False
        if not answer.outcomes:
            raise _Failed("The search was cancelled before it found a result")
        files = []
        for outcome in answer.outcomes:
            number = outcome.key.number
            folder = self._folder / str(number)
            export = await self._do(
                WriteFile(source=str(file), number=number, format="glb", folder=str(folder))
            )
            files.append(Path(export.path))
        self.outcome = GrowthOutcome(file.read_text(), answer.outcomes, files, answer.interrupted)

    async def _repeat(self, stored: Repetition) -> GrowAgain:
        """Make the job of a stored search, with the choices of its held parts."""
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
    """Read the light mesh of a worker (`niwaki.studio.worker.shapes`): positions, colours, corners, parts."""
    points = np.frombuffer(payload, "<f4", 3 * shape.vertices).reshape(-1, 3)
    faces = np.frombuffer(payload, "<u4", 3 * shape.triangles, 16 * shape.vertices).reshape(-1, 3)
    return Mesh("best so far", axes.to_blender(points), faces.astype(np.int64))


def environment() -> dict[str, str]:
    """Make the environment of a worker: it has the extension's packages, and ignores the current folder."""
    packages = str(Path(niwaki.__file__).parents[1])
    paths = [packages, *filter(None, [os.environ.get("PYTHONPATH")])]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(paths), "PYTHONSAFEPATH": "1"}


def results(run: str) -> list[dict[str, Any]]:
    """Read the results of a run.json: seeds, scores and choices."""
    rows: list[dict[str, Any]] = json.loads(run)["runs"]
    return rows


def title(reference: str) -> str:
    """Name the results of a model: by the model, its function or its file."""
    path, _, function = reference.rpartition(":")
    return Path(reference).stem if reference.endswith(".py") or not path else function


def reference(run: str) -> str:
    """Return the reference of the model of a run.json."""
    return str(json.loads(run)["model"])


def model_file(run: str) -> tuple[Path, str] | None:
    """Return the model's file of a run.json and the hash of its bytes; None for a model of the gallery."""
    data = json.loads(run)
    path, colon, _ = str(data["model"]).rpartition(":")
    return (Path(path), str(data["file_hash"])) if colon and data.get("file_hash") else None
