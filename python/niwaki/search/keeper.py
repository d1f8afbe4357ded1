"""Checkpoints of running searches: when they are written, and the stages that they store.

A search consists of stages, such as the third run, or the chains that polish it. A stage runs on the engine, which
stores its parts at its own borders (crates/run/src/checkpoint.rs). A finished stage is replaced by its result.
"""

from __future__ import annotations

import json
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from niwaki import _engine
from niwaki.errors import FileError
from niwaki.errors.schema import fitted
from niwaki.errors.warned import warn
from niwaki.result.progress import EngineWatch
from niwaki.search.checkpoint import Checkpoint, open_file, reading

#: The time between two writes is at least this many times the time that a write takes.
SHARE = 50.0

#: Seconds in which the engine has usually stored all running parts after a request.
GRACE = 0.1


class Keeper:
    """Checkpoint file that is written at intervals.

    Parameters
    ----------
    checkpoint
        The path of the file, and the interval.
    kind, about
        The kind and the settings of the search or training, as for `open_file`.
    search
        A search as plain data, which is written to the file.

    Raises
    ------
    InputError
        Niwaki cannot resume from the file.
    """

    def __init__(
        self, checkpoint: Checkpoint, kind: str, about: Mapping[str, Any], search: Any = None
    ) -> None:
        self.checkpoint, self.path = checkpoint, Path(checkpoint.path)
        self.stored = open_file(self.path, kind, about)
        self.stored.note = {"own": checkpoint.note, "search": search}
        self.next = time.monotonic() + checkpoint.every
        self.is_written, self._has_failed = False, False

    def put(self, name: str, data: Any) -> None:
        """Store plain data as a part."""
        self.stored.parts[name] = json.dumps(data).encode()

    def get(self, name: str) -> Any:
        """Read a part; None if there is none."""
        part = self.stored.parts.get(name)
        with reading(self.path):
            return None if part is None else json.loads(part)

    def drop(self, name: str) -> None:
        """Remove the parts of a stage."""
        for part in [part for part in self.stored.parts if part.startswith(name)]:
            del self.stored.parts[part]

    def stage(self, name: str) -> Stage:
        """A stage, resumed from its stored parts."""
        return Stage(self, name)

    @property
    def is_due(self) -> bool:
        """Whether the interval since the last write is over."""
        return time.monotonic() >= self.next

    def write_if_due(self) -> None:
        """Write the file if it is due."""
        if self.is_due:
            self.write()

    def write(self, cost: float = 0.0) -> None:
        """Write the file.

        A file that cannot be written for the first time is an error. Later it is a warning, because the search is
        worth more than its checkpoint.

        Parameters
        ----------
        cost
            Seconds that the engine took to store the parts.
        """
        began = time.monotonic()
        try:
            self.stored.write(self.path)
            self.is_written = True
        except FileError as error:
            if not self.is_written:
                raise
            if not self._has_failed:
                self._has_failed = True
                first = str(error).splitlines()[0]
                warn(f"the checkpoint `{self.path}` can no longer be written: {first}", UserWarning)
        now = time.monotonic()
        self.next = now + max(self.checkpoint.every, SHARE * (now - began + cost))

    def finish(self, interrupted: bool) -> None:
        """Write or remove the file at the end of a search."""
        if interrupted or self.checkpoint.keep:
            self.write()
        else:
            self.path.unlink(missing_ok=True)


class Stage:
    """Stage of a search, with its parts of the checkpoint.

    Attributes
    ----------
    engine : Checkpoint
        The engine's part of the checkpoint.
    """

    def __init__(self, keeper: Keeper, name: str) -> None:
        self.keeper, self.name = keeper, name
        prefix = f"{name}/part/"
        with reading(keeper.path):
            parts = {
                int(key.removeprefix(prefix)): part.decode()
                for key, part in keeper.stored.parts.items()
                if key.startswith(prefix)
            }
            self.engine = _engine.Checkpoint(parts)
            self.before: tuple[float, float] = fitted(
                keeper.get(f"{name}/seconds") or (0.0, 0.0), tuple[float, float]
            )
        self._began = time.perf_counter(), time.process_time()
        self._requested: float | None = None

    def watched(self, watch: EngineWatch) -> EngineWatch:
        """Wrap a callback of the engine, so that each call also writes the checkpoint when it is due."""

        def watching(done: int, ended: int, best: float, run: _engine.Run | None) -> None:
            self._tick()
            watch(done, ended, best, run)

        return watching

    def finish(self, interrupted: bool) -> None:
        """Write or remove the file at the end of a search of this one stage."""
        self.keeper.finish(interrupted)

    def _tick(self) -> None:
        now = time.monotonic()
        if self._requested is None:
            if self.keeper.is_due:
                self.engine.ask()
                self._requested = now
        elif now >= self._requested + GRACE:
            cost = self.collect()
            if cost > 0.0 or not self.keeper.is_written:
                self._requested = None
                self.keeper.write(cost)

    def collect(self) -> float:
        """Collect the parts that the engine has stored; the seconds that it took to store them, 0 without parts."""
        parts, cost = self.engine.collect()
        for number, text in parts.items():
            self.keeper.stored.parts[f"{self.name}/part/{number}"] = text.encode()
        wall = time.perf_counter() - self._began[0] + self.before[0]
        cpu = time.process_time() - self._began[1] + self.before[1]
        self.keeper.put(f"{self.name}/seconds", (wall, cpu))
        return max(cost, 1e-9) if parts else 0.0
