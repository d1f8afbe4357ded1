"""Keeping a checkpoint while a search goes on: when it is written, and what an earlier process left.

A search consists of stages, such as the third run, or the chains that polish it. A stage runs on the engine, which
stores its parts at its own borders (crates/run/src/checkpoint.rs). A stage that is done leaves its result.
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
from niwaki.search.checkpoint import Checkpoint, opened, understood

#: The time between two writes is at least so many times that of one.
SHARE = 50.0

#: So many seconds after it was asked the engine has mostly stored all parts that run.
GRACE = 0.1


class Keeper:
    """A checkpoint that is written now and then.

    Parameters
    ----------
    checkpoint
        Its file, and how often it is written.
    kind, about
        What it is of, as for `opened`.
    search
        A search as plain data, to be written with it.

    Raises
    ------
    InputError
        Niwaki cannot resume from the file.
    """

    def __init__(
        self, checkpoint: Checkpoint, kind: str, about: Mapping[str, Any], search: Any = None
    ) -> None:
        self.checkpoint, self.path = checkpoint, Path(checkpoint.path)
        self.stored = opened(self.path, kind, about)
        self.stored.note = {"own": checkpoint.note, "search": search}
        self.next = time.monotonic() + checkpoint.every
        self.is_written, self._has_failed = False, False

    def put(self, name: str, data: Any) -> None:
        """Keep plain data as a part."""
        self.stored.parts[name] = json.dumps(data).encode()

    def get(self, name: str) -> Any:
        """A part that was put; None where there is none."""
        part = self.stored.parts.get(name)
        with understood(self.path):
            return None if part is None else json.loads(part)

    def drop(self, name: str) -> None:
        """Forget the parts of a stage."""
        for one in [one for one in self.stored.parts if one.startswith(name)]:
            del self.stored.parts[one]

    def stage(self, name: str) -> Stage:
        """A stage, which goes on where it was."""
        return Stage(self, name)

    @property
    def is_due(self) -> bool:
        """Whether it is time to write the file."""
        return time.monotonic() >= self.next

    def write_if_due(self) -> None:
        """Write the file, if it is time."""
        if self.is_due:
            self.write()

    def write(self, cost: float = 0.0) -> None:
        """Write the file; storing its parts took `cost` seconds.

        A file that was written once and now cannot be is a warning: the search is worth more.
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
                warn(f"the checkpoint `{self.path}` is not written any more: {first}", UserWarning)
        now = time.monotonic()
        self.next = now + max(self.checkpoint.every, SHARE * (now - began + cost))

    def finish(self, interrupted: bool) -> None:
        """Write or remove the file of a search that has ended."""
        if interrupted or self.checkpoint.keep:
            self.write()
        else:
            self.path.unlink(missing_ok=True)


class Stage:
    """A stage of a search, with its part of the checkpoint.

    Attributes
    ----------
    engine : Checkpoint
        What the engine stores into.
    """

    def __init__(self, keeper: Keeper, name: str) -> None:
        self.keeper, self.name = keeper, name
        own = f"{name}/part/"
        with understood(keeper.path):
            left = {
                int(one.removeprefix(own)): part.decode()
                for one, part in keeper.stored.parts.items()
                if one.startswith(own)
            }
            self.engine = _engine.Checkpoint(left)
            self.before: tuple[float, float] = fitted(
                keeper.get(f"{name}/seconds") or (0.0, 0.0), tuple[float, float]
            )
        self._began = time.perf_counter(), time.process_time()
        self._asked: float | None = None

    def watched(self, watch: EngineWatch) -> EngineWatch:
        """A function for the engine to call, which also keeps the checkpoint."""

        def watching(done: int, ended: int, best: float, run: _engine.Run | None) -> None:
            self._tick()
            watch(done, ended, best, run)

        return watching

    def finish(self, interrupted: bool) -> None:
        """Write or remove the file of a search that has ended with this stage."""
        self.keeper.finish(interrupted)

    def _tick(self) -> None:
        now = time.monotonic()
        if self._asked is None:
            if self.keeper.is_due:
                self.engine.ask()
                self._asked = now
        elif now >= self._asked + GRACE:
            cost = self.collect()
            if cost > 0.0 or not self.keeper.is_written:
                self._asked = None
                self.keeper.write(cost)

    def collect(self) -> float:
        """Take what the engine has stored; the seconds that this took it, 0 where there is nothing."""
        parts, cost = self.engine.collect()
        for number, text in parts.items():
            self.keeper.stored.parts[f"{self.name}/part/{number}"] = text.encode()
        wall = time.perf_counter() - self._began[0] + self.before[0]
        cpu = time.process_time() - self._began[1] + self.before[1]
        self.keeper.put(f"{self.name}/seconds", (wall, cpu))
        return max(cost, 1e-9) if parts else 0.0
