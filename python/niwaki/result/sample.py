"""One run of a model: its scores, choices, scene and value."""

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


class Sample:
    """One run of a model.

    Scores are natural logarithms (nats) of power 1.

    Attributes
    ----------
    log_score : float
        Factors, observations and sketches.
    log_prior : float
        The log density of the choices.
    log_weight : float
        The weight in its population; 0 where all weigh the same.
    similarity : float or None
        Share of cells that are equal in the scene and its target, which the score looks at; `fit` is for people.
    primitives : int
        How many primitives the scene has.
    has_ended : bool
        Whether the run went to its end; a search that was stopped may leave others.
    cause : str or None
        What made the run impossible.
    search : Search
        The search.
    seed : int or None
        Of the run of that search.
    seconds, cpu_seconds : float
        Wall and processor time of that search.
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
        """A run whose choices were given."""
        sample = cls(trace.run, search, *rest)
        sample.__dict__["_trace"] = trace
        return sample

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.search, self._run.data(), self.seed, self.seconds, self.cpu_seconds)

    @cached_property
    def _trace(self) -> _engine.Trace:
        """The run once more, with names."""
        with translated("model"):
            return self.search.task.trace(self._run)

    def log_density(self) -> LogDensity:
        """The log density around this run over its continuous choices: see `niwaki.log_density`."""
        with translated("model"):
            return LogDensity(self.search.task.density(self._run))

    @property
    def log_joint(self) -> float:
        """Choices and score together, nats."""
        return self.log_prior + self.log_score

    @property
    def value(self) -> Any:
        """What the model returned; None for a run that did not end."""
        try:
            return (self._trace.run if self._run.is_bare else self._run).value
        except TypeError as error:
            raise InputError("value-too-deep", found=str(error)) from None

    @property
    def target(self) -> Target | None:
        """What the scene should fill."""
        return self.search.score.target

    @property
    def choices(self) -> dict[str, Any]:
        """Every choice by its readable address; give them to `run(choices=...)` to get the same run."""
        return {choice.path: choice.value for choice in self._trace.choices}

    def held(self, *patterns: str) -> dict[str, Any]:
        """Choices with their values, to hold them in another search: its `hold`.

        Parameters
        ----------
        patterns
            Patterns of addresses, as for `kernels.on`. One that matches a choice takes that choice. One that matches a
            part (a call, an iteration of a loop, or a primitive of the scene, which stands for the call that emits it)
            takes all choices at and below it, and those that decide that it exists: of the calls around it, and of the
            earlier iterations of its loops. All choices, where there is no pattern.

        Raises
        ------
        InputError
            A pattern matches nothing; with the addresses that are nearest.
        """
        return dict(self._held(patterns)) if patterns else self._free

    def _held(self, hold: parts.Hold) -> Mapping[str, Any]:
        """What is held, by address, with the values of this run for patterns."""
        scene = [address for address, _ in self._trace.parts]
        return parts.held(hold, self._free, scene, self.search.model.name)

    @property
    def _free(self) -> dict[str, Any]:
        """The choices that could have another value: what has one value only is computed, not chosen."""
        return {one.path: one.value for one in self._trace.choices if one.family != "delta"}

    def regrow(
        self,
        part: str,
        particles: int = 200,
        *,
        power: float | None = None,
        seed: int | None = None,
        threads: int | None = None,
    ) -> Result:
        """Grow one part of this run again by particles, in place; everything outside of it stays as it is.

        Parameters
        ----------
        part
            A pattern that matches the address of one call or iteration: all choices at and below it are drawn again.
        particles
            How many.
        power
            The power of the score; that of the search when left out, 1 where it has none.
        seed
            Decides every random choice; that of this run when left out.
        threads
            How many to use; all of the machine's when left out.

        Returns
        -------
        Result
            The particles that are possible: whole runs, weighed by the law of the part given the rest.

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
        """Drag a part of the scene to a point: the choices that its place depends on are moved by its derivatives.

        Parameters
        ----------
        part
            A pattern that matches the address of a primitive, or of a call or iteration that emits some.
        to
            Where it should be, scene units; two numbers for a drawing.
        grab
            The point that should be there, fixed to the shape of the part that it is nearest to; left out, the middle
            of the part's shape that is nearest to `to`.
        along
            A direction in which distances do not count, such as the one in which a camera looks.
        hold
            What stays as it is: as in a search, values of choices by address, which are those of this run; or patterns
            of choices and parts, as for `held`. What the search holds stays, too.
        answers
            How many at most: they differ in the choices that may change.
        structure
            Whether discrete choices that decide the part are tried where real choices do not take it there. What a
            run chooses that the run before did not is drawn from the seed of the search.

        Returns
        -------
        Drag
            The answers, the least change first; or why there is none, with the nearest that was found.

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
    def order(self) -> list[tuple[int, int]]:
        """Order choices: the hash of the future that ran, and its place among those that could."""
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
        """How much of the target the scene covers, and how much of the scene is outside; None without a target."""
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
        """Draw the scene, with the target as a ghost; `target=None` leaves that out."""
        return self.scene.picture(self._ghost(target), **self._shown(settings))

    def save(self, path: str | PathLike[str], target: Target | None | bool = True, **settings: Any) -> Path:
        """Draw the scene into an image file, with the target as a ghost; `target=None` leaves that out."""
        return self.scene.save(path, self._ghost(target), **self._shown(settings))

    def _shown(self, settings: dict[str, Any]) -> dict[str, Any]:
        """Settings of a picture: of a drawing the page is shown that the score looks at."""
        window = self.search.score.window
        return settings if window is None else {"window": window, **settings}

    def _ghost(self, target: Target | None | bool) -> Target | None:
        if isinstance(target, bool):
            return self.target if target else None
        return target

    @property
    def numbers(self) -> dict[str, Any]:
        """What is worth knowing about the run, by name; None for what it does not have."""
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
    """The sample of its pickled data; the returned value comes from another run, when it is read."""
    return Sample(search.task.run_of_data(data), search, *rest)


def log_density(sample: Sample) -> LogDensity:
    """The log density of a model around one of its runs: priors, factors and observations, with the Jacobians.

    Parameters
    ----------
    sample : Sample
        Of any result: `nw.run(model, seed=1).best`, for example.

    Raises
    ------
    InputError
        The scene is scored by a sketch, which has no gradient, or there are no continuous choices.
    ModelFault
        An operation that the score depends on has no derivative, or the run is impossible; with the line.
    """
    return sample.log_density()
