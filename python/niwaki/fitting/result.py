"""The result of a fit: its evaluations as samples, the best of them, and the table of all."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from niwaki import _engine, draw, targets
from niwaki.draw.scene import Scene
from niwaki.fitting.answers import Answer, Answers, Effect, Interval, write_rows
from niwaki.fitting.archive import Entry
from niwaki.fitting.generator import Generator, value_of
from niwaki.fitting.goals import Outcome, scene_of
from niwaki.fitting.loop import FitLoop
from niwaki.once import cached_property
from niwaki.targets.target import Target

if TYPE_CHECKING:
    from PIL.Image import Image


def scene_of_arrays(vertices: Any, faces: Any) -> Scene:
    """Return the scene of a mesh; the empty scene without triangles."""
    if not len(faces):
        return Scene([])
    points, corners = np.array(vertices, dtype=np.float64), np.array(faces, dtype=np.int64)
    return scene_of(_engine.shape("mesh", points, corners))


@dataclass(frozen=True)
class FitSample:
    """One evaluation of a fit, with its mesh.

    The attributes of its `Answer` are its own: `number`, `parameters`, `log_score`, `covered`, `outside`, `iou`,
    `numbers`.

    Attributes
    ----------
    answer : Answer
        Its parameters and scores; a log score of minus infinity for a failure.
    failure : str
        The text of a failure; empty for a mesh.
    entry : Entry
        The evaluation as the archive has it.
    target : Target or None
        The target that the mesh should fill.
    """

    answer: Answer
    failure: str
    entry: Entry
    target: Target | None

    @property
    def number(self) -> int:
        """Its place in the order of asking, from 0."""
        return self.answer.number

    @property
    def parameters(self) -> dict[str, Any]:
        """The values of the parameters that it used, by name."""
        return self.answer.parameters

    @property
    def log_score(self) -> float:
        """The log score, nats; minus infinity for a failure."""
        return self.answer.log_score

    @property
    def covered(self) -> float | None:
        """The share of the target that the mesh fills."""
        return self.answer.covered

    @property
    def outside(self) -> float | None:
        """The share of the mesh outside of the target."""
        return self.answer.outside

    @property
    def iou(self) -> float | None:
        """The volume that mesh and target share over the volume of both together."""
        return self.answer.iou

    @property
    def numbers(self) -> dict[str, float]:
        """Measures of the mesh, by name."""
        return self.answer.numbers

    @cached_property
    def scene(self) -> Scene:
        """The scene; empty for a failure."""
        return scene_of_arrays(*self.entry.arrays)

    def save(self, path: str | PathLike[str], **settings: Any) -> Path:
        """Draw the mesh, with its target as a ghost, into an image file."""
        return self.scene.save(path, self.target, **settings)

    def export(self, path: str | PathLike[str], **settings: Any) -> Path:
        """Write the mesh as .glb, .obj, .ply, .stl or .3mf."""
        return self.scene.export(path, **settings)

    def _repr_png_(self) -> bytes | None:
        return self.scene._repr_png_() if len(self.scene) else None

    def __repr__(self) -> str:
        shares = "" if self.covered is None else f", {targets.fit.Fit(self.covered, self.outside or 0.0)}"
        return f"<FitSample {self.number}: log score {self.log_score:.2f}{shares}>"


class FitResult(Sequence[FitSample]):
    """The result of `nw.fit`; a sequence of its evaluations, in the order of asking.

    Attributes
    ----------
    loop : FitLoop
        The search.
    interrupted : bool
        Whether Ctrl-C ended it.
    seconds : float
        Wall time of the call of `fit`.
    spread : float or None
        The largest difference between the log scores of two calls of one point; 0 for equal meshes; None if no point
        was called twice.
    """

    def __init__(
        self,
        generator: Generator,
        loop: FitLoop,
        entries: Sequence[Entry],
        *,
        interrupted: bool,
        seconds: float,
        spread: float | None,
    ) -> None:
        self.generator, self.loop, self._entries = generator, loop, list(entries)
        self.interrupted, self.seconds, self.spread = interrupted, seconds, spread

    @property
    def name(self) -> str:
        """The name of the model."""
        return self.generator.name

    @property
    def target(self) -> Target | None:
        """The target that the mesh should fill."""
        return self.loop.goal.score.target

    def __len__(self) -> int:
        return len(self._entries)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self._sample(number) for number in range(*index.indices(len(self)))]
        return self._sample(range(len(self))[index])

    def _sample(self, number: int) -> FitSample:
        entry, outcome = self._entries[number], self._entries[number].outcome
        values = self._values(entry)
        if not isinstance(outcome, Outcome):
            return FitSample(
                Answer(number, values, -math.inf, None, None, {}), outcome.text, entry, self.target
            )
        answer = Answer(
            number, values, outcome.score, outcome.covered, outcome.outside, dict(outcome.numbers)
        )
        return FitSample(answer, "", entry, self.target)

    def _values(self, entry: Entry) -> dict[str, Any]:
        """Return the values of the parameters that an evaluation used; of a function defined by run, those it drew."""
        space, drawn = self.loop.space, {row.name: row for row in entry.drawn}
        known = set(space.names)
        names = [row.name for row in entry.drawn] or list(entry.numbers)
        names += [name for name in entry.numbers if name not in names and name.startswith("align.")]
        values = {}
        for name in names:
            number = drawn[name].number if name in drawn else entry.numbers[name]
            if name in known:
                values[name] = value_of(space, name, number)
            else:
                labels = drawn[name].labels
                values[name] = labels[int(number)] if labels else number
        return values

    @property
    def answers(self) -> Answers:
        """The answers of the evaluations: intervals, and what each parameter moves."""
        return self.loop.answers

    @property
    def best(self) -> FitSample:
        """The evaluation with the highest log score.

        Raises
        ------
        InputError
            No evaluation gave a mesh.
        """
        return self._sample(self.answers.best.number)

    def variants(self, count: int = 10, loss: float = 3.0) -> list[FitSample]:
        """Return different good evaluations; see `Answers.variants`."""
        return [self._sample(answer.number) for answer in self.answers.variants(count, loss)]

    def interval(self, name: str, share: float = 0.9) -> Interval:
        """Return how sure a parameter is; see `Answers.interval`."""
        return self.answers.interval(name, share)

    def sensitivity(self) -> list[Effect]:
        """Return what each parameter moves, the strongest first; see `Answers.sensitivity`."""
        return self.answers.sensitivity()

    @property
    def failures(self) -> Counter[str]:
        """The texts of failures, with their numbers, the most frequent first."""
        texts = [entry.outcome.text for entry in self._entries if not isinstance(entry.outcome, Outcome)]
        return Counter(dict(Counter(texts).most_common()))

    @property
    def defects(self) -> dict[str, float]:
        """Shares of the meshes that are "open", "inverted" or "flat"."""
        meshes = [entry for entry in self._entries if isinstance(entry.outcome, Outcome)]
        counts = Counter(name for entry in meshes for name in entry.defects)
        return {name: number / len(meshes) for name, number in sorted(counts.items())}

    def table(self, path: str | PathLike[str] | None = None) -> list[dict[str, Any]]:
        """Return a row for each evaluation, in the order of asking; None for what it lacks.

        The columns are those of `Answers.table`, the seconds of the call and the defects of the mesh.

        Parameters
        ----------
        path
            A file to write, too: .csv or .parquet.
        """
        rows = self.answers.table()
        late = dict.fromkeys(name for entry in self._entries for name in self._values(entry))
        for row, entry in zip(rows, self._entries, strict=True):
            values = self._values(entry)
            row |= {name: values.get(name) for name in late}
            row |= {"seconds": entry.seconds, "defects": " ".join(entry.defects)}
        if path is not None:
            write_rows(Path(path), rows)
        return rows

    def sheet(self, shown: Sequence[FitSample] | None = None, **settings: Any) -> Image:
        """Draw evaluations side by side, each with its log score; by default ten variants."""
        listed = self.variants() if shown is None else list(shown)
        captions = [_caption(place, sample) for place, sample in enumerate(listed, 1)]
        scenes = [sample.scene for sample in listed]
        sheet: Image = draw.sheet.sheet(scenes, captions, self.target, **settings)
        return sheet

    def numbers(self) -> dict[str, Any]:
        """Return the result as plain data: the best parameters and scores, counts, the seed."""
        best = self.best
        return {
            "model": self.name,
            "evaluations": len(self),
            "failed": sum(self.failures.values()),
            "seed": self.loop.seed,
            "best": {
                "number": best.number,
                "parameters": {name: _json(value) for name, value in best.parameters.items()},
                "log_score": best.log_score,
                "covered": best.covered,
                "outside": best.outside,
                "iou": best.iou,
                "numbers": best.numbers,
            },
            "spread": self.spread,
            "defects": self.defects,
        }

    def _repr_png_(self) -> bytes | None:
        return self.best._repr_png_() if len(self) else None

    def __repr__(self) -> str:
        failed = sum(self.failures.values())
        rest = f", {failed} failed" if failed else ""
        best = "" if failed == len(self) else f", best {self.best.log_score:.2f}"
        return f"<FitResult of {self.name}: {len(self)} evaluations{rest}{best}>"


def _caption(place: int, sample: FitSample) -> str:
    shares = "" if sample.covered is None else f"   {targets.fit.Fit(sample.covered, sample.outside or 0.0)}"
    return f"#{place}   log score {sample.log_score:.2f}{shares}"


def _json(value: Any) -> Any:
    try:
        json.dumps(value)
    except (TypeError, ValueError):
        return str(value)
    return value
