"""Dragging a part of a run to a point: the choices above it are moved by the derivatives of its position.

The position of a point fixed to a part is a function of the real choices that the part depends on; the engine records
it with its derivatives (`crates/grad/src/positions.rs`). Each answer is a damped Gauss-Newton descent (Levenberg 1944,
Marquardt 1963) to

    argmin  |position(x) - to|^2 + damping |z|^2,    z = (x - start) / spread,

with x within the supports of the choices and `spread` the deviation of each prior, so that of all ways there the one
is taken that changes the choices least. Where the edit has several answers, these differ in the choices that may
change. Where no real choice takes the part there, discrete choices that decide its structure are tried, too.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from math import inf, pi, tau
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.errors import InputError
from niwaki.errors.settings import bad
from niwaki.lang.compiled import translated
from niwaki.once import cached_property
from niwaki.result import Result, Sample, Watch, parts
from niwaki.search.source import NEAR, SourceChange, explained
from niwaki.targets.sketches import Score

if TYPE_CHECKING:
    from niwaki.search.request import Search

Vector = NDArray[np.float64]
Point = Sequence[float]

#: A descent ends at this share.
DONE = 1e-4
#: Steps of a descent at most, and the longest first one, in deviations of the priors.
STEPS, REACH = 24, 1.5
#: Descents that have come no nearer by this share in so many steps end.
STALLED, PATIENCE = 0.02, 4
#: So often a descent may enter another branch of the model.
BRANCHES = 3
#: Answers are the same if their choices differ by less than this, in deviations of the priors.
SAME = 0.05
#: Another structure that does not reach the point is given as the nearest where it leaves this share at most.
WORTH = 0.8
#: Descents from other values where the first ones give no answer, and how far these are, in deviations of the priors.
ELSEWHERE, AROUND = 6, 0.5
#: Values of discrete choices that are tried, and those of them from which a descent begins.
TRIED, BEGUN = 32, 6
#: A number stays this share of its range away from an end that is no value.
MARGIN = 1e-6


@dataclass(frozen=True)
class Dragged:
    """One answer to a drag.

    Attributes
    ----------
    sample : Sample
        The run with the changed choices.
    changed : dict
        By address: the value before and the value after; None where the run before had no such choice, or the run after
        has none.
    distance, share : float
        What is left to the point: scene units, and as a share of the scene's size.
    kind : str
        What was allowed to change: "least" all choices, "fewest" the three that move it most, "own" those of the part's
        own call, "outermost" those of the model itself, "other" all, from other values, "structure"
        discrete choices, too.
    part : str
        The address of the part that is there.
    holds : dict
        The choices that place the part there, with their values: a `lock` with which the rest is grown again.
    """

    sample: Sample
    changed: dict[str, tuple[Any, Any]]
    distance: float
    share: float
    kind: str
    part: str
    holds: dict[str, Any]

    def follow(
        self, *, seed: int | None = None, threads: int | None = None, progress: Watch | None = None
    ) -> Result:
        """Grow the rest again around the part, by the method of the sample's search, which holds what places the part.

        Parameters
        ----------
        seed
            Decides every random choice; that of the search when left out.
        threads, progress
            As for `niwaki.run`.

        Raises
        ------
        InputError
            With the part there every particle is impossible.
        """
        search = self.sample.search
        lock = {**(search.lock or {}), **self.holds}
        own = replace(search, lock=lock, choices=None, seed=search.seed if seed is None else seed)
        return own.run(threads=threads, progress=progress)


@dataclass(frozen=True)
class Moved:
    """A part that is being dragged: the run as it is, without its score.

    Attributes
    ----------
    scene : Scene
        The scene of the run.
    point : tuple
        Where the held point is, scene units.
    share : float
        What is left to where it should be, as a share of the scene's size.
    reason : str
        Why it is not there; empty where it is.
    """

    scene: Scene
    point: tuple[float, float, float]
    share: float
    reason: str


@dataclass(frozen=True)
class Drag:
    """The answers to a drag, the least change first; or why there is none.

    Attributes
    ----------
    answers : list of Dragged
        Those with the part at the point, none of them impossible.
    nearest : Dragged or None
        The nearest that was found, where there is no answer.
    reason : str
        Why there is no answer; empty where there is one.
    """

    answers: list[Dragged]
    nearest: Dragged | None = None
    reason: str = ""

    @property
    def best(self) -> Dragged | None:
        """The first answer; without one, the nearest."""
        return self.answers[0] if self.answers else self.nearest


@dataclass(frozen=True)
class Grip:
    """A point that is fixed to a shape of a part: a sum of the shape's directions, and an offset that stays."""

    part: str
    shape: int
    shares: tuple[float, float, float]
    offset: Vector

    def at(self, frame: Vector) -> Vector:
        """Where the point is, given the middle and the directions of the shape, (4, 3)."""
        return np.asarray(frame[0] + np.asarray(self.shares) @ frame[1:] + self.offset)


@dataclass
class State:
    """A run, and where its choices have been moved to."""

    trace: _engine.Trace
    placer: _engine.Placer
    values: dict[int, float] = field(default_factory=dict)
    error: float = inf
    #: Changed discrete choices, by address.
    switched: dict[str, Any] = field(default_factory=dict)


@dataclass
class Place:
    """The numbers of a descent: what may move, by how much, and the derivatives of the point."""

    movables: list[tuple[int, str, bool]]
    #: Value, bounds and deviation of each, (n, 4).
    ranges: Vector
    #: The point, and its derivatives, (3,) and (3, n).
    point: Vector
    slopes: Vector


class Dragging:
    """A part that is held by a point of it: see `Sample.drag` for the parameters."""

    def __init__(
        self,
        search: Search,
        sample: Sample,
        part: str,
        *,
        grab: Point | None = None,
        along: Point | None = None,
        lock: Iterable[str] = (),
        to: Point | None = None,
    ) -> None:
        self.search, self.sample = search, sample
        if not sample.has_ended:
            raise bad("sample", sample, "a run that has ended", "more time or particles")
        # Descents do not score the scene.
        bare = replace(search, score=Score(), choices=None, polish=None)
        with translated(search.model.name):
            self.task = bare.task
            trace = self.task.replay(dict(sample.choices), None)
            self.start = State(trace, self.task.placer(trace.run))
        scene = [address for address, _ in trace.parts]
        if not scene:
            raise InputError(
                "no-address", pattern=part, name=search.model.name, nearest="none: it has no part"
            )
        boxes = np.array([shape.aabb() for _, shapes in trace.parts for shape in shapes])
        self.size = float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max()) or 1.0
        self.locked = set(sample.held(*lock)) if lock else set()
        self.locked |= set(search.lock or ())
        self.across = _across(along)
        self.values = {choice.path: choice.value for choice in trace.choices}
        self._grips = self._gripped(part, grab)
        self.grip = self._grip(
            None if grab is None else _point("grab", grab), None if to is None else _point("to", to)
        )
        self._warm: dict[int, float] = {}

    def source(self, point: Point, most: int = 3) -> list[SourceChange]:
        """The changes of the model's file that take the part to a point, those that change it least first.

        There are none for a model without a file of its own, such as those of the gallery.
        """
        return explained(self, _point("to", point), most)

    # ---- what is held, and what may move

    def _gripped(self, part: str, grab: Point | None) -> list[tuple[int, int, Vector, Any]]:
        """The shapes of the part: place, number, middle and directions, and the shape."""
        trace = self.start.trace
        scene = [address for address, _ in trace.parts]
        wanted = {n for n, address in enumerate(scene) if _engine.matches(part, address)}
        if not wanted:
            choices = [choice.path for choice in trace.choices if choice.family != "delta"]
            calls = parts.matching(part, choices, scene, self.search.model.name)
            wanted = {n for n, place in enumerate(scene) if any(place.startswith(f"{c}/") for c in calls)}
        if not wanted:
            near = ", ".join(f"`{one}`" for one in _engine.nearest(part, scene))
            raise InputError("no-address", pattern=part, name=self.search.model.name, nearest=near)
        free = {choice.address for choice in trace.choices}
        # A part that is held is placed as well: then nothing moves it, and the reason says so.
        self._all = self.start.placer.positions({}, free)
        spreads = np.maximum(self._all.ranges()[:, 3], 1e-12).tolist()
        self._spreads = {one[1]: spread for one, spread in zip(self._all.movables, spreads, strict=True)}
        found: list[tuple[int, int, Vector, Any]] = []
        for n in sorted(wanted):
            for k, shape in enumerate(trace.parts[n][1]):
                frame = self._all.frame(n, k)
                low, high = (np.array(corner) for corner in shape.aabb())
                middle = np.vstack([(low + high) / 2, np.zeros((3, 3))]) if frame is None else frame
                found.append((n, k, middle, shape))
        return found

    def _grip(self, grab: Vector | None, to: Vector | None) -> Grip:
        """The point that is held.

        It is `grab`, fixed to the shape that it is nearest to; without it the middle of the shape that is nearest to
        where it should go.
        """
        goal = to if grab is None else grab

        def distance(one: tuple[int, int, Vector, Any]) -> float:
            low, high = (np.array(corner) for corner in one[3].aabb())
            return 0.0 if goal is None else float(np.linalg.norm(np.clip(goal, low, high) - goal))

        self._at, shape, frame, _ = min(self._grips, key=distance)
        address = self.start.trace.parts[self._at][0]
        if grab is None:
            return Grip(address, shape, (0.0, 0.0, 0.0), np.zeros(3))
        shares = np.linalg.lstsq(frame[1:].T, grab - frame[0], rcond=1e-9)[0]
        offset = grab - frame[0] - shares @ frame[1:]
        return Grip(address, shape, _triple(shares), offset)

    def _movable(self, state: State) -> set[int]:
        """Choices that may move: all that are not held, in calls that the part can depend on."""
        return {choice.address for choice in state.trace.choices if choice.path not in self.locked}

    @cached_property
    def _begun(self) -> Place | None:
        """The point in the run where the drag begins, with all that may move."""
        return self.place(self.start, self.grip.part, self._movable(self.start))

    def place(self, state: State, part: str, free: set[int]) -> Place | None:
        """The point and its derivatives; None where nothing moves it."""
        positions = state.placer.positions(state.values, free)
        number = next((n for n, (address, _) in enumerate(positions.parts) if address == part), None)
        if number is None or self.grip.shape >= positions.parts[number][1]:
            return None
        frame = positions.frame(number, self.grip.shape)
        if frame is None:
            return None
        slopes = positions.slopes(number, self.grip.shape, self.grip.shares)
        assert slopes is not None
        return Place(positions.movables, positions.ranges(), self.grip.at(frame), slopes)

    # ---- going there

    def to(self, point: Point, *, answers: int = 4, structure: bool = True) -> Drag:
        """The answers for a point: see `Sample.drag`."""
        goal = _point("to", point)
        begun = self._begun
        names = set[str]() if begun is None else _movers(begun, self.size)
        if begun is None or not names:
            found: list[tuple[str, State]] = []
        else:
            found = [
                (kind, self._descend(goal, self.start, names)) for kind, names in self._kinds(begun, names)
            ]
        answered, forbidden = self._possible(found, answers)
        if found and not answered:
            others = [("other", state) for state in self._elsewhere(goal, names)]
            found += others
            answered, forbidden = self._possible(others, answers, forbidden)
        if structure and not answered:
            others = [("structure", state) for state in self._structures(goal)]
            found += others
            answered, forbidden = self._possible(others, answers, forbidden)
        if answered:
            return Drag(answered)
        there = [(kind, state) for kind, state in found if state.error <= NEAR * self.size]
        if there:
            near = self._scored(*there[0])
            return Drag([], near, f"the run is impossible with `{self.grip.part}` there: {forbidden}")
        if not found:
            return Drag([], None, self._nothing_moves())
        # Another structure only where it is nearer by a good deal.
        kind, state = min(found, key=lambda one: one[1].error / (WORTH if one[0] == "structure" else 1.0))
        return Drag([], self._scored(kind, state), self._too_far(goal, state))

    def _possible(
        self, found: Sequence[tuple[str, State]], answers: int, forbidden: str = ""
    ) -> tuple[list[Dragged], str]:
        """The answers among these: there, different, and possible, the least change first; or what forbids one."""
        answered: list[Dragged] = []
        looked_at: list[dict[str, Any]] = []
        there = [(kind, state) for kind, state in found if state.error <= NEAR * self.size]
        for kind, state in sorted(there, key=lambda one: self._change(one[1])):
            after = _choices(state)
            if len(answered) >= answers or any(self._is_same(after, other) for other in looked_at):
                continue
            looked_at.append(after)
            one = self._scored(kind, state)
            if one.sample.cause is None or self.sample.cause is not None:
                answered.append(one)
            else:
                forbidden = forbidden or one.sample.cause
        return answered, forbidden

    def _elsewhere(self, goal: Vector, names: set[str]) -> list[State]:
        """Descents that begin at other values of the choices, drawn around those of the run: by the search's seed."""
        rng = np.random.default_rng(self.search.seed)
        first = self._begun
        assert first is not None
        low, high = _bounds(first.ranges)
        moving = np.array([name in names for _, name, _ in first.movables])
        found = []
        for _ in range(ELSEWHERE):
            drawn = first.ranges[:, 0] + rng.normal(size=len(moving)) * first.ranges[:, 3] * AROUND
            values = np.clip(drawn, low, high).tolist()
            warm = {
                one[0]: value
                for one, value, is_in in zip(first.movables, values, moving, strict=True)
                if is_in
            }
            # A run with these values may fail, or make other choices.
            with suppress(_engine.EngineFault):
                found.append(self._descend(goal, self.start, names, warm, is_near_warm=True))
        return found

    def move(self, point: Point) -> Moved:
        """The part with the least change, for a pointer that moves: it goes on from where the last point was."""
        goal = _point("to", point)
        begun = self._begun
        names = set() if begun is None else _movers(begun, self.size)
        if begun is None or not names:
            middle = next(frame[0] for n, k, frame, _ in self._grips if (n, k) == (self._at, self.grip.shape))
            left = float(np.linalg.norm(self.across @ (goal - middle))) / self.size
            return Moved(Scene(self.start.trace.parts), _triple(middle), left, self._nothing_moves())
        state = self._descend(goal, self.start, names, self._warm)
        self._warm = {} if state.switched else state.values
        here = self.place(state, self.grip.part, self._movable(state))
        assert here is not None
        reason = "" if state.error <= NEAR * self.size else self._too_far(goal, state)
        scene = Scene(self._replayed(self.task, state).parts)
        return Moved(scene, _triple(here.point), state.error / self.size, reason)

    def _kinds(self, begun: Place, names: set[str]) -> list[tuple[str, set[str]]]:
        """Sets of choices that may change: the ways in which an edit can be meant."""
        call = self.grip.part.rpartition("/")[0]
        own = {name for name in names if name.rpartition("/")[0] == call}
        outer = {name for name in names if "/" not in name}
        kinds = [("least", names), ("own", own), ("outermost", outer)]
        reach = _reach(begun)
        few = set(sorted(names, key=lambda name: -reach[name])[:3])
        kinds.append(("fewest", few))
        kept: list[tuple[str, set[str]]] = []
        for kind, some in kinds:
            if some and some not in [other for _, other in kept]:
                kept.append((kind, some))
        return kept

    def _descend(
        self,
        goal: Vector,
        start: State,
        names: set[str],
        warm: Mapping[int, float] | None = None,
        branches: int = BRANCHES,
        is_near_warm: bool = False,
    ) -> State:
        """Move these choices until the point is there, or no step brings it nearer.

        Where a step leads into another branch of the model, the descent goes on from the run there. The change is least
        from the start; `is_near_warm`: from where the descent begins.
        """
        free = {choice.address for choice in start.trace.choices if choice.path in names}
        state = replace(start, values=dict(start.values), error=inf)
        origin = start.values
        here = self.place(replace(state, values={**origin, **(warm or {})}), self.grip.part, free)
        first = self.place(state, self.grip.part, free)
        if here is None or first is None:
            return state
        zero, spread = first.ranges[:, 0], np.maximum(first.ranges[:, 3], 1e-12)
        low, high = _bounds(first.ranges)
        low, high = (low - zero) / spread, (high - zero) / spread
        z = (here.ranges[:, 0] - zero) / spread
        center = z if is_near_warm else np.zeros(len(z))
        error = float(np.linalg.norm(self.across @ (goal - here.point)))
        reach, damping, held = REACH, 1e-4, [error]
        for _ in range(STEPS):
            if error <= DONE * self.size or reach < 1e-6:
                break
            rows = self.across @ here.slopes * spread
            left = self.across @ (goal - here.point) + rows @ (z - center)
            aim = center + _step(rows, left, damping, low - center, high - center)
            step = aim - z
            longest = float(np.abs(step).max(initial=0.0))
            if longest > reach:
                step *= reach / longest
            tried = np.clip(z + step, low, high)
            values = {
                address: _wrapped(x) if is_angle else x
                for (address, _, is_angle), x in zip(
                    here.movables, (zero + spread * tried).tolist(), strict=True
                )
            }
            try:
                there = self.place(replace(state, values={**origin, **values}), self.grip.part, free)
            except _engine.EngineFault:
                # The run fails there, or makes other choices.
                there = None
            is_other = there is None or [one[0] for one in there.movables] != [
                one[0] for one in here.movables
            ]
            if is_other and branches > 0:
                other = self._branched(
                    goal, replace(state, values={**origin, **values}), names, branches, error
                )
                if other is not None:
                    return other
            nearer = inf if there is None else float(np.linalg.norm(self.across @ (goal - there.point)))
            if there is not None and not is_other and nearer < error:
                z, here, error = tried, there, nearer
                state.values = {**origin, **values}
                reach, damping = min(2 * reach, REACH), max(damping / 10, 1e-9)
                held.append(error)
                if len(held) > PATIENCE and held[-1] > (1 - STALLED) * held[-1 - PATIENCE]:
                    break
            else:
                reach, damping = min(reach, longest) / 4, min(damping * 10, 1.0)
        if error == held[0] and warm:
            state.values = {**origin, **warm}
        state.error = error
        return state

    def _branched(
        self, goal: Vector, state: State, names: set[str], branches: int, error: float
    ) -> State | None:
        """The descent from a run with other choices, where the part is nearer in it; missing ones are drawn."""
        try:
            trace = self._replayed(self.task, state, self.search.seed)
        except _engine.EngineFault:
            return None
        other = State(trace, self.task.placer(trace.run), switched={"": self.grip.part})
        here = self.place(other, self.grip.part, self._movable(other))
        if here is None or float(np.linalg.norm(self.across @ (goal - here.point))) >= error:
            return None
        known = {choice.path for choice in state.trace.choices}
        free = {name for name in _movers(here, self.size) if name in names or name not in known}
        return self._descend(goal, other, free, branches=branches - 1)

    # ---- structure

    def _structures(self, goal: Vector) -> list[State]:
        """Runs with another value of one discrete choice that decides the part, each moved to the point."""
        trace, begun = self.start.trace, []
        call = self.grip.part.rpartition("/")[0]
        deciding = {*parts.deciding(call), call}
        choices = [
            c for c in trace.choices if c.path.rpartition("/")[0] in deciding and c.path not in self.locked
        ]
        tries = 0
        for choice in reversed(choices):
            for value in _others(choice):
                tries += 1
                if tries > TRIED:
                    break
                changed = {**self.values, choice.path: value}
                try:
                    other = self.task.replay(changed, self.search.seed)
                except _engine.EngineFault:
                    continue
                if other.run.log_prior == -inf:
                    continue
                state = State(other, self.task.placer(other.run), switched={choice.path: value})
                begun += self._near(goal, state)
        begun.sort(key=lambda one: one[0])
        return [self._moved(goal, state, part) for _, state, part in begun[:BEGUN]]

    def _near(self, goal: Vector, state: State) -> list[tuple[float, State, str]]:
        """The part in another run, by its address, and how far it is; with those that take its place in its loops."""
        found = []
        for part in {self.grip.part, *_siblings(self.grip.part)} & {a for a, _ in state.trace.parts}:
            here = self.place(state, part, self._movable(state))
            if here is not None:
                found.append((float(np.linalg.norm(self.across @ (goal - here.point))), state, part))
        return found

    def _moved(self, goal: Vector, state: State, part: str) -> State:
        kept, self.grip = self.grip, replace(self.grip, part=part)
        try:
            here = self.place(state, part, self._movable(state))
            assert here is not None
            moved = self._descend(goal, state, _movers(here, self.size))
            return replace(moved, switched={**state.switched, "": part})
        finally:
            self.grip = kept

    # ---- answers

    def _change(self, state: State) -> float:
        """The sum of squares of the changes, in deviations; a changed structure comes after all others."""
        moved = [
            (value - self.values[name]) / self._spreads[name]
            for name, value in _choices(state).items()
            if name in self._spreads
        ]
        return float(np.square(moved).sum()) + (1e6 if state.switched else 0.0)

    def _is_same(self, one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
        """Whether two runs differ by little in all of their choices."""
        return one.keys() == other.keys() and all(
            value == other[name]
            or (isinstance(value, float) and abs(value - other[name]) < SAME * self._spreads.get(name, 0.0))
            for name, value in one.items()
        )

    def _replayed(self, task: _engine.Task, state: State, seed: int | None = None) -> _engine.Trace:
        return task.replay(_choices(state), seed)

    def _scored(self, kind: str, state: State) -> Dragged:
        with translated(self.search.model.name):
            trace = self._replayed(self.search.task, state)
        sample = Sample.of_trace(trace, self.search, self.sample.seed)
        after = sample.choices
        changed = {
            name: (self.values.get(name), after.get(name))
            for name in dict.fromkeys([*self.values, *after])
            if self.values.get(name) != after.get(name)
        }
        part = state.switched.get("", self.grip.part)
        here = self.place(state, part, self._movable(state))
        movers = set() if here is None else _movers(here, self.size)
        call = part.rpartition("/")[0]
        deciding = {*parts.deciding(call), call}
        free = {choice.path for choice in sample._trace.choices if choice.family != "delta"}
        holds = {
            name: value
            for name, value in after.items()
            if name in free and (name in movers or name.rpartition("/")[0] in deciding)
        }
        return Dragged(sample, changed, state.error, state.error / self.size, kind, part, holds)

    # ---- reasons

    def _nothing_moves(self) -> str:
        number, part = self._at, self.grip.part
        slopes = self._all.slopes(number, self.grip.shape, self.grip.shares)
        moves = [] if slopes is None else np.abs(slopes).max(axis=0) > 0
        names = [name for (_, name, _), is_one in zip(self._all.movables, moves, strict=False) if is_one]
        if self.search.lock:
            names += [name for name in self.search.lock if name not in names]
        if not names:
            return f"no choice of a real number moves `{part}`: its place follows from the source"
        many = (
            "the choice that moves it is held"
            if len(names) == 1
            else f"all {len(names)} choices that move it are held"
        )
        return f"nothing that is free moves `{part}`: {many} ({_listed(names)})"

    def _too_far(self, goal: Vector, state: State) -> str:
        part = state.switched.get("", self.grip.part)
        share = f"{state.error / self.size:.1%} of the scene"
        left = f"the nearest that `{part}` can come is {state.error:.3g} away ({share})"
        here = self.place(state, part, self._movable(state))
        assert here is not None
        low, high = _bounds(here.ranges)
        ends = []
        pull = (self.across @ (goal - here.point)) @ here.slopes
        for (_, name, _), (x, below, above, spread), want, lo, hi in zip(
            here.movables, here.ranges, pull, low, high, strict=True
        ):
            slack = 1e-3 * max(spread, 1e-12)
            if (x <= lo + slack and want < 0) or (x >= hi - slack and want > 0):
                ends.append(f"`{name}` is at the end of its range ({below:.3g} to {above:.3g})")
        if ends:
            more = f" and {len(ends) - 2} more" if len(ends) > 2 else ""
            return f"{left}: {'; '.join(ends[:2])}{more}"
        strength = np.linalg.svd(self.across @ here.slopes * here.ranges[:, 3], compute_uv=False)
        free = int((strength > 1e-6 * max(self.size, strength[0])).sum())
        wanted = int(round(float(np.trace(self.across))))
        if free < wanted:
            moves = (
                "does not move it that way",
                "moves it along a line only",
                "moves it within a surface only",
            )
            return f"{left}: what is free {moves[free]}"
        return f"{left}: beyond this the choices bring it no nearer"


def dragged(
    search: Search,
    sample: Sample,
    part: str,
    to: Point,
    *,
    grab: Point | None = None,
    along: Point | None = None,
    lock: Iterable[str] = (),
    answers: int = 4,
    structure: bool = True,
) -> Drag:
    """Drag a part of a sample of this search: see `Sample.drag`."""
    return Dragging(search, sample, part, grab=grab, along=along, lock=lock, to=to).to(
        to, answers=answers, structure=structure
    )


def _choices(state: State) -> dict[str, Any]:
    """The choices of a run where they have been moved to, by readable address."""
    return {c.path: state.values.get(c.address, c.value) for c in state.trace.choices}


def _point(name: str, given: Point) -> Vector:
    point = np.array(given, dtype=np.float64)
    if point.shape == (2,):
        point = np.append(point, 0.0)
    if point.shape != (3,) or not np.isfinite(point).all():
        raise bad(name, given, "a point of two or three finite numbers", "(1.0, 2.0, 0.0)")
    return point


def _triple(point: Vector) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return x, y, z


def _across(along: Point | None) -> Vector:
    """The projection along a direction in which distances do not count."""
    if along is None:
        return np.eye(3)
    direction = _point("along", along)
    norm = float(np.linalg.norm(direction))
    if norm == 0.0:
        raise bad("along", along, "a direction", "(0.0, 0.0, 1.0)")
    return np.asarray(np.eye(3) - np.outer(direction, direction) / norm**2)


def _reach(place: Place) -> dict[str, float]:
    """How far each choice moves the point when it changes by its deviation, scene units."""
    far = np.linalg.norm(place.slopes, axis=0) * place.ranges[:, 3]
    return {name: float(d) for (_, name, _), d in zip(place.movables, far, strict=True)}


def _movers(place: Place, size: float) -> set[str]:
    """The choices that move the point."""
    return {name for name, far in _reach(place).items() if far > 1e-9 * size}


def _bounds(ranges: Vector) -> tuple[Vector, Vector]:
    """The ends between which values stay, within those of their ranges."""
    is_between = np.isfinite(ranges[:, 1]) & np.isfinite(ranges[:, 2])
    width = ranges[:, 3].copy()
    width[is_between] = ranges[is_between, 2] - ranges[is_between, 1]
    low, high = ranges[:, 1] + MARGIN * width, ranges[:, 2] - MARGIN * width
    # A value that is nearer to an end may stay there.
    return np.minimum(low, ranges[:, 0]), np.maximum(high, ranges[:, 0])


def _step(rows: Vector, goal: Vector, damping: float, low: Vector, high: Vector) -> Vector:
    """The z of least `|rows z - goal|^2 + damping' |z|^2` within bounds: those it would cross are set to their ends."""
    z, is_free = np.zeros(rows.shape[1]), np.ones(rows.shape[1], bool)
    for _ in range(rows.shape[1] + 1):
        own = rows[:, is_free]
        square = own @ own.T
        scale = max(float(np.trace(square)), 1e-300)
        left = goal - rows[:, ~is_free] @ z[~is_free]
        best = own.T @ np.linalg.solve(square + damping * scale * np.eye(3), left)
        z[is_free] = np.clip(best, low[is_free], high[is_free])
        crossed = is_free.copy()
        crossed[is_free] = (best < low[is_free]) | (best > high[is_free])
        if not crossed.any():
            break
        is_free &= ~crossed
    return z


def _wrapped(x: float) -> float:
    return x if -pi <= x <= pi else (x + pi) % tau - pi


def _others(choice: _engine.Choice) -> list[Any]:
    """Other values of a discrete choice, those that are near first; outside of its support a run is impossible."""
    if isinstance(choice.value, bool):
        return [not choice.value]
    if not isinstance(choice.value, int):
        return []
    reach = 5 if choice.family == "categorical" else 2
    return [choice.value + by for n in range(1, reach + 1) for by in (n, -n) if choice.value + by >= 0]


def _siblings(part: str) -> Iterable[str]:
    """The same part of the next and of the last iteration of each loop that it is in."""
    at = part.find("]")
    while at >= 0:
        begin = part.rfind("[", 0, at)
        number = part[begin + 1 : at]
        if number.isdigit():
            yield from (
                f"{part[: begin + 1]}{int(number) + by}{part[at:]}" for by in (1, -1) if int(number) + by >= 0
            )
        at = part.find("]", at + 1)


def _listed(names: Sequence[str]) -> str:
    shown = ", ".join(f"`{name}`" for name in names[:3])
    return f"{shown} and {len(names) - 3} more" if len(names) > 3 else shown
