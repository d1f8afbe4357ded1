"""Interface of a search for its results: its settings, and its methods that continue from a result.

`niwaki.Search` implements it. Results use the interface, because the module of `Search` imports results.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import Field
from os import PathLike
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

from niwaki import _engine
from niwaki.lang.models import Model
from niwaki.methods import Improve, Method, Mh
from niwaki.targets.sketches import Score

if TYPE_CHECKING:
    from niwaki.result.dragged import Drag
    from niwaki.result.progress import Watch
    from niwaki.result.result import Result
    from niwaki.result.sample import Sample


class SearchLike(Protocol):
    """Search, as results and executions use it: see `niwaki.Search`."""

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]

    @property
    def model(self) -> Model[..., Any]:
        """The model."""

    @property
    def args(self) -> tuple[Any, ...]:
        """Its arguments, by position."""

    @property
    def score(self) -> Score:
        """The sketches that score its scene."""

    @property
    def method(self) -> Method:
        """The method of the search."""

    @property
    def seed(self) -> int:
        """The seed of all random choices."""

    @property
    def choices(self) -> Mapping[str, Any] | None:
        """Values of choices by address, from which it starts."""

    @property
    def held(self) -> dict[str, Any]:
        """Values of held choices by address."""

    @property
    def runs(self) -> int:
        """The number of runs, with seeds that follow one another."""

    @property
    def keep(self) -> str:
        """Whether all samples are kept, or the best of each run."""

    @property
    def polish(self) -> Mh | None:
        """The chains that continue from the best of each run."""

    @property
    def max_steps(self) -> int:
        """Most calls and loop steps of one run."""

    @property
    def max_memory(self) -> int:
        """Most bytes of a run, or of a population."""

    @property
    def task(self) -> _engine.Task:
        """The model with its arguments and sketches, ready to be searched."""

    @property
    def hash(self) -> str:
        """SHA-256 of the settings that decide the result."""

    @property
    def key(self) -> str:
        """The name of a stored result."""

    @property
    def about(self) -> dict[str, Any]:
        """The settings that decide the result, by name."""

    @property
    def host_modules(self) -> tuple[str, ...]:
        """The modules of the host functions that the model calls."""

    def data(self, files: str = "named") -> dict[str, Any]:
        """The search as plain data."""

    def json(self, files: str = "named") -> str:
        """The search as JSON."""

    def with_seed(self, seed: int) -> SearchLike:
        """Copy the search with another seed."""

    def run(
        self,
        *,
        threads: int | None = None,
        progress: Watch | None = None,
        checkpoint: str | PathLike[str] | None = None,
    ) -> Result:
        """Run the search."""

    def polished(
        self,
        result: Result,
        method: Mh | Improve,
        *,
        seed: int | None = None,
        threads: int | None = None,
        progress: Watch | None = None,
    ) -> Result:
        """Continue from the best sample of a result."""

    def regrown(
        self,
        sample: Sample,
        part: str,
        particles: int = 200,
        *,
        power: float | None = None,
        seed: int | None = None,
        threads: int | None = None,
    ) -> Result:
        """Grow one part of a sample again."""

    def dragged(self, sample: Sample, part: str, to: Sequence[float], **settings: Any) -> Drag:
        """Drag a part of a sample."""
