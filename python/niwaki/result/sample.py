"""Samples: single runs of a model, each with its scores, choices, scene and value."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from niwaki import _engine, draw
from niwaki.draw.assembly import Part
from niwaki.draw.scene import Scene
from niwaki.errors import InputError
from niwaki.lang.compiled import translated
from niwaki.once import cached_property
from niwaki.result import parts
from niwaki.result.gradient import LogDensity
from niwaki.targets.fit import Fit, fit
from niwaki.targets.target import Target

if TYPE_CHECKING:
    from niwaki.result.dragged import Drag
    from niwaki.result.result import Result
    from niwaki.result.search_like import SearchLike


def place(choice: _engine.Choice) -> Any:
    """Return the value of a choice, with the place among the options, from 0, for a word."""
    words = choice.words
    return choice.value if words is None or choice.value not in words else words.index(choice.value)


class Sample:
    """Single run of a model.

    Scores are natural logarithms (nats) of power 1.

    Attributes
    ----------
    log_score : float
        The log score: factors, observations and sketches.
    log_prior : float
        The log density of the choices.
    log_weight : float
        The log weight in its population; 0 if all samples have the same weight.
    similarity : float or None
        Share of cells that are equal in the scene and its target, for the score; `fit` is for people.
    primitives : int
        The number of primitives in the scene.
    has_ended : bool
        Whether the run reached its end; a search that was stopped may leave runs that did not.
    cause : str or None
        The cause that made the run impossible.
    search : Search
        The search.
    seed : int or None
        The seed of the run.
    seconds, cpu_seconds : float
        Wall and processor time of the search.
    """

    def __init__(
        self,
        run: _engine.Run,
        search: SearchLike,
        seed: int | None = None,
        seconds: float = 0.0,
        cpu_seconds: float = 0.0,
    ) -> None:
        self._run = run
        self.search = search
        self.log_score: float = run.log_score
        self.log_prior: float = run.log_prior
        self.log_weight: float = run.log_weight
        self.similarity: float | None = run.similarity
        self.primitives: int = run.primitives
        self.has_ended: bool = run.has_ended
        self.cause: str | None = run.cause
        self.seed, self.seconds, self.cpu_seconds = seed, seconds, cpu_seconds

    @classmethod
    def of_trace(cls, trace: _engine.Trace, search: SearchLike, *rest: Any) -> Sample:
        """Make a sample of a replayed run."""
        sample = cls(trace.run, search, *rest)
        sample.__dict__["_trace"] = trace
        return sample

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.search, self._run.data(), self.seed, self.seconds, self.cpu_seconds)

    @cached_property
    def _trace(self) -> _engine.Trace:
        """The run, replayed to get its addresses."""
        with translated("model"):
            return self.search.task.trace(self._run)

    def log_density(self) -> LogDensity:
        """The log density around this run over its continuous choices: see `niwaki.log_density`."""
        with translated("model"):
            return LogDensity(self.search.task.density(self._run))

    @property
    def log_joint(self) -> float:
        """The sum of `log_prior` and `log_score`, nats."""
        return self.log_prior + self.log_score

    @property
    def value(self) -> Any:
        """The value that the model returned; None for a run that did not end."""
        try:
            return (self._trace.run if self._run.is_bare else self._run).value
        except TypeError as error:
            raise InputError("value-too-deep", found=str(error)) from None

    @property
    def target(self) -> Target | None:
        """The target that the scene should fill."""
        return self.search.score.target

    @property
    def choices(self) -> dict[str, Any]:
        """The choices by readable address, words of `choose` as words; `run(choices=...)` repeats the run with them."""
        return {choice.path: choice.value for choice in self._trace.choices}

    def label(self, address: str) -> str:
        """Return the name for people of a choice, a part, a call or an iteration: *Wing 1 › section 2 › width*.

        Labels follow from the model's source, see the manual. `hold` knows them, too.
        """
        return self.search.model.labels.label(address)

    def held(self, *patterns: str) -> dict[str, Any]:
        """List choices with their values, for the `hold` of another search.

        Parameters
        ----------
        patterns
            Patterns of addresses, as for `kernels.on`; all choices without a pattern. A pattern that matches a choice
            takes that choice. A pattern that matches a part takes all choices at and below the part, and the choices
            that decide whether the part exists: those of the calls around it, and of the earlier iterations of its
            loops. A part is a call, an iteration of a loop, or a primitive, which stands for the call that emits it.

        Raises
        ------
        InputError
            A pattern matches nothing; the message names the nearest addresses.
        """
        return dict(self._held(patterns)) if patterns else self._free

    def _held(self, hold: parts.Hold) -> Mapping[str, Any]:
        """The values of held choices by address; patterns take the values of this run."""
        scene = [address for address, _ in self._trace.parts]
        return parts.held(hold, self._free, scene, self.search.model)

    @property
    def _free(self) -> dict[str, Any]:
        """The choices that could have another value."""
        return {choice.path: choice.value for choice in self._trace.choices if choice.family != "delta"}

    def regrow(
        self,
        part: str,
        particles: int = 200,
        *,
        power: float | None = None,
        seed: int | None = None,
        threads: int | None = None,
    ) -> Result:
        """Grow one part of this run again by particles; everything outside of the part stays as it is.

        Parameters
        ----------
        part
            A pattern that matches the address of one call or iteration: all choices at and below it are drawn again.
        particles
            The number of particles.
        power
            The power of the score; the power of the search when left out, or 1 for methods without a power.
        seed
            The seed of all random choices; the seed of this run when left out.
        threads
            The number of threads; all of the machine when left out.

        Returns
        -------
        Result
            The possible particles: whole runs, with weights for the distribution of the part given the rest.

        Raises
        ------
        InputError
            The pattern matches no part, or several; every particle is impossible.
        """
        return self.search.regrown(self, part, particles, power=power, seed=seed, threads=threads)

    def drag(
        self,
        part: str,
        to: Sequence[float],
        *,
        grab: Sequence[float] | None = None,
        along: Sequence[float] | None = None,
        hold: parts.Hold = (),
        answers: int = 4,
        structure: bool = True,
    ) -> Drag:
        """Drag a part of the scene to a point, by moving the choices on which its place depends, along derivatives.

        Parameters
        ----------
        part
            A pattern that matches the address of a primitive, or of a call or iteration that emits primitives.
        to
            The goal, scene units; two numbers for a drawing.
        grab
            The point that should reach the goal, fixed to the nearest shape of the part. The default is the middle of
            the shape of the part that is nearest to `to`.
        along
            A direction in which distances do not count, such as the direction of view of a camera.
        hold
            The choices that stay: values of choices by address, as in this run, or patterns of choices and parts, as
            for `held`. Choices that the search holds stay, too.
        answers
            The most answers; they differ in the choices that may change.
        structure
            Whether to try discrete choices that decide the part, if real choices do not take it to the goal. Choices
            that are new in a run are drawn from the seed of the search.

        Returns
        -------
        Drag
            The answers, the least change first; or the reason why there is none, with the nearest state.

        Raises
        ------
        InputError
            The pattern matches no part; a point is not a point.
        """
        return self.search.dragged(
            self, part, to, grab=grab, along=along, hold=hold, answers=answers, structure=structure
        )

    @property
    def families(self) -> dict[str, str]:
        """The distribution of every choice."""
        return {choice.path: choice.family for choice in self._trace.choices}

    @property
    def options(self) -> dict[str, tuple[str, ...]]:
        """The options of every choice among words, in their order."""
        return {
            choice.path: tuple(choice.words) for choice in self._trace.choices if choice.words is not None
        }

    @property
    def places(self) -> dict[str, Any]:
        """The choices by readable address, with the place among the options, from 0, for each word."""
        return {choice.path: place(choice) for choice in self._trace.choices}

    @property
    def order(self) -> list[tuple[int, int]]:
        """Choices of the order: the hash of the future that ran, and its place among the futures that could run."""
        return self._run.order()

    @property
    def queries(self) -> dict[Any, Any]:
        """The model's answers by key."""
        return dict(self._trace.queries)

    @property
    def parts(self) -> list[Part]:
        """The primitives in the order in which a run adds them."""
        return [Part(address, tuple(shapes)) for address, shapes in self._trace.parts]

    @cached_property
    def scene(self) -> Scene:
        """The primitives, by the addresses of their `emit`."""
        return Scene(self._trace.parts)

    @cached_property
    def fit(self) -> Fit | None:
        """The share of the target that the scene covers, and of the scene outside of it; None without a target."""
        return fit(self.search.score, self.scene)

    def export(
        self,
        path: str | PathLike[str],
        *,
        scale: float | None = None,
        fuse: float | None = None,
        style: str | None = None,
    ) -> Path:
        """Write the scene as .glb, .obj, .ply, .stl, .3mf, .gif, .apng or .svg; see `niwaki.draw.files.export`.

        A .glb has the choices among its extras. The `style` is for drawings, as .svg, .gif or .apng.
        """
        styled: dict[str, Any] = {} if style is None else {"style": style}
        suffix = Path(path).suffix.lower()
        if suffix in draw.animation.FORMATS and scale is None and fuse is None:
            return self.animate(path, **styled)
        if suffix in draw.files.DRAWINGS:
            styled = self._shown(styled)
        if suffix == ".glb":
            styled["about"] = draw.glb.About(self.search.model.name, self._free)
        return self.scene.export(path, scale=scale, fuse=fuse, **styled)

    def animate(
        self, path: str | PathLike[str], target: Target | None | bool = True, **settings: Any
    ) -> Path:
        """Write the scene growing, in the order in which a run adds its parts, as .gif or .apng.

        Settings are those of `niwaki.draw.animation.growth`; the target is a ghost unless it is None.
        """
        return self.scene.animate(path, self._ghost(target), parts=self.parts, **self._shown(settings))

    def picture(self, target: Target | None | bool = True, **settings: Any) -> Any:
        """Draw the scene, with the target as a ghost; `target=None` leaves the ghost out."""
        return self.scene.picture(self._ghost(target), **self._shown(settings))

    def save(self, path: str | PathLike[str], target: Target | None | bool = True, **settings: Any) -> Path:
        """Draw the scene into an image file, with the target as a ghost; `target=None` leaves the ghost out."""
        return self.scene.save(path, self._ghost(target), **self._shown(settings))

    def _shown(self, settings: dict[str, Any]) -> dict[str, Any]:
        """Settings of a picture with what is around the scene; of a drawing, with the page of the score."""
        window = self.search.score.window
        around = self.search.score.surroundings if window is None else {"window": window}
        return {**around, **settings}

    def _ghost(self, target: Target | None | bool) -> Target | None:
        if isinstance(target, bool):
            return self.target if target else None
        return target

    @property
    def numbers(self) -> dict[str, Any]:
        """The most important numbers of the run, by name; None for missing numbers."""
        return {
            "log score": self.log_score,
            "log prior": self.log_prior,
            "fit": self.fit,
            "primitives": self.primitives or None,
            "cause": self.cause,
            "seed": self.seed,
        }

    def _repr_png_(self) -> bytes | None:
        return draw.picture.png(self.picture(**draw.card.QUICK)) if self.primitives else None

    def _repr_html_(self) -> str:
        return draw.card.card(f"Sample of {self.search.model.name}", self.numbers, self._repr_png_())

    def __repr__(self) -> str:
        parts = [f"log score {self.log_score:.2f}", f"log prior {self.log_prior:.2f}"]
        if self.fit is not None:
            parts.append(str(self.fit))
        if self.primitives:
            parts.append(f"{self.primitives} primitives")
        if not self.has_ended:
            parts.append("not ended")
        return f"<Sample: {', '.join(parts)}>"


def _restored(search: SearchLike, data: str, *rest: Any) -> Sample:
    """Read a sample from pickled data; a replay gives the returned value when it is read."""
    return Sample(search.task.run_of_data(data), search, *rest)


def log_density(sample: Sample) -> LogDensity:
    """The log density of a model around one of its runs: priors, factors and observations, with the Jacobians.

    Parameters
    ----------
    sample : Sample
        A sample of any result, such as `nw.run(model, seed=1).best`.

    Raises
    ------
    InputError
        The scene is scored by a sketch, which has no gradient, or there are no continuous choices.
    ModelFault
        An operation that the score depends on has no derivative, or the run is impossible; with the line.
    """
    return sample.log_density()
