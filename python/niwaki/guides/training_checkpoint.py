"""The checkpoint of a training: the results of its rounds, and traces and network of the last round."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import asdict

from niwaki import _engine
from niwaki.errors.schema import fitted
from niwaki.guides.report import Round
from niwaki.methods import Guide
from niwaki.search.checkpoint import reading
from niwaki.search.keeper import Keeper, Stage


class TrainingCheckpoint:
    """The checkpoint of a training; without a keeper it stores nothing.

    Parameters
    ----------
    keeper
        The keeper of the file.
    """

    def __init__(self, keeper: Keeper | None) -> None:
        self.keeper = keeper
        self._texts: dict[int, list[str | None]] = {}

    def done(self, number: int) -> tuple[Guide | None, Round] | None:
        """Return the guide of a complete round, and the round; the guide of `start` has the number -1."""
        data = None if self.keeper is None else self.keeper.get(f"{number}/done")
        if self.keeper is None or data is None:
            return None
        with reading(self.keeper.path):
            tables = {
                name: [tuple(row) for row in data["round"][name]] for name in ("losses", "bounds", "lost")
            }
            now = Round(**data["round"] | tables)
            return None if data["guide"] is None else Guide(base64.b85decode(data["guide"])), now

    def store(self, number: int, guide: Guide | None, now: Round) -> None:
        """Store the result of a round, in place of the data that it needed to resume."""
        if self.keeper is None:
            return
        self.keeper.drop(f"{number}/")
        packed = None if guide is None else base64.b85encode(guide.data).decode()
        self.keeper.put(f"{number}/done", {"guide": packed, "round": asdict(now)})
        self.keeper.write_if_due()

    def traces(self, number: int) -> Sequence[str | None]:
        """Return the runs of a round's finished searches, as data; None for a search without a trace."""
        if self.keeper is not None and number not in self._texts:
            with reading(self.keeper.path):
                self._texts[number] = fitted(self.keeper.get(f"{number}/traces") or [], list[str | None])
        return tuple(self._texts.get(number, ()))

    def add(self, number: int, run: _engine.Run | None) -> None:
        """Add the result of another search."""
        if self.keeper is None:
            return
        self._texts.setdefault(number, []).append(None if run is None else run.data())
        if self.keeper.is_due:
            self.keep(number)
            self.keeper.write()

    def keep(self, number: int) -> None:
        """Put the traces of a round into the checkpoint."""
        if self.keeper is not None:
            self.keeper.put(f"{number}/traces", self._texts.get(number, []))

    def stage(self, number: int) -> Stage | None:
        """Return the stage of the training of a round's network."""
        return None if self.keeper is None else self.keeper.stage(f"{number}/network")

    def finish(self, interrupted: bool) -> None:
        """Note that the training has ended."""
        if self.keeper is not None:
            self.keeper.finish(interrupted)
