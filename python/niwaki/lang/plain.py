"""Runs of a model as ordinary Python, the reference for the engine, for debuggers to step through.

The user's function runs, instrumented (see `instrument`), and this module records the path of calls and loops, the
choices by readable address, scores, shapes and answers of queries. Futures run where they are created.
"""

from __future__ import annotations

import difflib
import math
import secrets
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import FrameType, FunctionType
from typing import Any

from niwaki import _engine, words
from niwaki.errors import Call, InputError, ModelFault, NiwakiError
from niwaki.errors.kinds import place
from niwaki.lang import densities, futures, inference, inner, memoised, vocabulary
from niwaki.lang.constraints import Constraint
from niwaki.lang.instrument import instrumented
from niwaki.lang.marks import Host, Marked, underlying
from niwaki.lang.names import is_library
from niwaki.methods import EnumerateAll
from niwaki.words.distributions import Distribution
from niwaki.words.effects import flatten
from niwaki.words.memo import Memoised
from niwaki.words.running import current

VIEWS: tuple[type[Iterable[Any]], ...] = (type({}.keys()), type({}.values()), type({}.items()))
LAZY: tuple[type[Iterable[Any]], ...] = (zip, map, filter, enumerate, reversed, type(reversed([])), *VIEWS)


@dataclass(frozen=True)
class Run:
    """The record of a run of a model.

    Attributes
    ----------
    value
        The model's return value.
    choices : dict of str to value
        The values of all choices by address, in the order of the run.
    log_prior : float
        Sum of the choices' log densities, in nats.
    log_score : float
        Sum of factors, observations and conditions, in nats.
    scene : list of (str, list of shapes)
        The shapes, with the address of their `emit`.
    queries : dict
        Answers of queries by key.
    constraints : list of Constraint
        The soft constraints, in the order of the run.
    """

    value: Any
    choices: dict[str, Any]
    log_prior: float
    log_score: float
    scene: list[tuple[str, list[Any]]] = field(default_factory=list)
    queries: dict[str, Any] = field(default_factory=dict)
    constraints: list[Constraint] = field(default_factory=list, compare=False)

    @property
    def log_joint(self) -> float:
        """Sum of `log_prior` and `log_score`, in nats."""
        return self.log_prior + self.log_score


def run_python(
    model: Marked[..., Any] | Callable[..., Any],
    *args: Any,
    seed: int | None = None,
    choices: Mapping[str, Any] | None = None,
    **kwargs: Any,
) -> Run:
    """Run a model once as plain Python.

    Parameters
    ----------
    model
        A model, or a function written in the modelling language.
    args, kwargs
        The model's arguments.
    seed
        The seed of all choices that `choices` does not have; a fresh seed if you give neither.
    choices
        Values of choices by address. Without a seed, `choices` must have a value for every choice of the run.

    Returns
    -------
    Run
        Value, choices, score, scene and queries.
    """
    function = underlying(model)
    if not isinstance(function, FunctionType):
        raise InputError("model-of-a-value", found=repr(model))
    return run(function, args, kwargs, seed, choices)


def run(
    function: FunctionType,
    args: Sequence[Any],
    kwargs: Mapping[str, Any],
    seed: int | None = None,
    choices: Mapping[str, Any] | None = None,
) -> Run:
    """Run a model as `run_python` does, with arguments in `args` and `kwargs` so that a parameter may have any name."""
    if seed is None and choices is None:
        seed = secrets.randbits(63)
    state = PlainRun(seed, choices)
    token = current.set(state)
    try:
        value = state.enter(function, args, kwargs)
    except NiwakiError:
        raise
    except Exception as error:
        if isinstance(error, MemoryError) and failed_host(error) is not None:
            raise
        raise state.fault(error) from error
    finally:
        current.reset(token)
    log_prior, log_score = densities.total(state.priors), densities.total(state.scores)
    queries = {key: futures.opened(answer) for key, answer in state.answers.items()}
    value = futures.opened(value)
    return Run(value, state.choices_made, log_prior, log_score, state.scene, queries, state.constraints)


class PlainRun:
    """The state of a plain run, which serves the words (`Runner`) and the instrumented code."""

    def __init__(self, seed: int | None, choices: Mapping[str, Any] | None) -> None:
        self.model: FunctionType | None = None
        self.around: inner.Around | None = None
        self.seed = seed
        self.values = choices
        self.path: list[str] = []
        self.loops: list[int] = []
        self.pending = ""
        self.choices_made: dict[str, Any] = {}
        self.priors: list[float] = []
        self.scores: list[float] = []
        self.scene: list[tuple[str, list[Any]]] = []
        self.answers: dict[str, Any] = {}
        self.answered: dict[str, str] = {}
        self.constraints: list[Constraint] = []
        self.functions: dict[FunctionType, FunctionType] = {}
        self.codes: set[Any] = set()
        self.calls = memoised.Calls()
        self.frame: Any = None

    # methods for the instrumented code

    def call(self, label: str | tuple[str, str], function: Any, /, *args: Any, **kwargs: Any) -> Any:
        """Run a call at a site."""
        function = underlying(function)
        depth, loops = len(self.path), len(self.loops)
        if isinstance(function, Memoised):
            value = self.recall(function, args, kwargs)
        elif isinstance(function, FunctionType) and self.is_model_code(function):
            assert isinstance(label, str)
            self.path.append(label)
            value = self.enter(function, args, kwargs)
        elif isinstance(label, tuple):
            value = self.with_function(label, function, args, kwargs)
        else:
            futures.refuse(function, args, kwargs)
            self.pending = label
            value = function(*args, **kwargs)
        del self.path[depth:], self.loops[loops:]
        return [*value] if isinstance(value, LAZY) else value

    def is_model_code(self, function: FunctionType) -> bool:
        """Return whether a function is the user's, which runs instrumented."""
        return function.__code__ in self.codes or not (
            function in vocabulary.ALL_WORDS or is_library(function)
        )

    def enter(self, function: FunctionType, args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
        """Run a function of the user; the first function is the model."""
        self.model = self.model or function
        if function.__code__ not in self.codes:
            if function not in self.functions:
                traced = instrumented(function, self)
                self.functions[function] = traced
                self.add_code(traced.__code__)
            function = self.functions[function]
        return function(*args, **kwargs)

    def add_code(self, code: Any) -> None:
        """Note instrumented code, with the functions nested in it."""
        self.codes.add(code)
        for part in code.co_consts:
            if hasattr(part, "co_consts"):
                self.add_code(part)

    def with_function(
        self, label: tuple[str, str], word: Any, args: Sequence[Any], kwargs: dict[str, Any]
    ) -> Any:
        """Run a word or a built-in that calls its function once for each item, in order."""
        loop, callee = label
        if word in (words.mirrored, words.arrayed):
            frames, function, *rest = args
            if word is words.mirrored:
                frames = (None, _engine.operation("reflection", frames))
            return [self.placed(frame, callee, function, rest) for frame in self.loop(loop, frames)]
        if word in (map, filter):
            function, *lists = args
            if function is None:
                return list(filter(None, lists[0]))
            rows = zip(*lists, strict=False)
            results = [(row[0], self.call(callee, function, *row)) for row in self.loop(loop, rows)]
            return [item for _, item in results] if word is map else [item for item, keep in results if keep]
        function = kwargs.pop("key", None)
        if function is None:
            return word(*args, **kwargs)
        items = list(args[0]) if len(args) == 1 else list(args)
        keys = [self.call(callee, function, item) for item in self.loop(loop, items)]
        if not items and word is not sorted:
            return word([], **kwargs)
        order = word(
            range(len(items)), key=keys.__getitem__, **{k: v for k, v in kwargs.items() if k != "default"}
        )
        return [items[place] for place in order] if word is sorted else items[order]

    def placed(self, frame: Any, label: str, function: Any, args: Sequence[Any]) -> Any:
        """Run a call in a frame, inside of the current frame."""
        outer, self.frame = self.frame, _engine.operation("frame_in", self.frame, frame)
        value = self.call(label, function, *args)
        self.frame = outer
        return value

    def loop(self, label: str, items: Iterable[Any]) -> Iterator[Any]:
        """Yield the items of a loop, each with its iteration in the path."""
        depth, loops = len(self.path), len(self.loops)
        self.loops.append(depth)
        for number, item in enumerate(items):
            del self.path[depth:], self.loops[loops + 1 :]
            self.path.append(label.replace("[]", f"[{number}]"))
            yield item
        del self.path[depth:], self.loops[loops:]

    def forever(self, label: str) -> Iterator[int]:
        """Yield the iterations of a `while`."""

        def count() -> Iterator[int]:
            number = 0
            while True:
                yield number
                number += 1

        return self.loop(label, count())

    def named(self, root: FunctionType, number: int) -> Callable[[FunctionType], FunctionType]:
        """Return a decorator that marks a nested function with its place, for an `infer` of it."""

        def name_it(function: FunctionType) -> FunctionType:
            function.__dict__.update({inner.ROOT: root, inner.NUMBER: number})
            return function

        return name_it

    def leave(self) -> None:
        """Leave a loop at a `break`."""
        del self.path[self.loops.pop() :]

    # methods for the words

    def address(self, fallback: str) -> str:
        """Return the address of the current site."""
        label, self.pending = self.pending or fallback, ""
        return "/".join([*self.path, label])

    def sample(self, dist: Any, words: Sequence[str] | None = None) -> Any:
        """Make a choice; words name its numbers in the record of the run."""
        address = self.address("sample")
        self.check(dist)
        assert address not in self.choices_made
        if self.values is not None and address in self.values:
            value = self.own_value(address, self.values[address], words)
        elif self.seed is None:
            near = difflib.get_close_matches(address, list(self.values or ()), n=3, cutoff=0.0)
            raise InputError(
                "missing-choice", address=address, nearest=", ".join(f'"{name}"' for name in near) or "none"
            )
        else:
            try:
                value = densities.draw(dist, self.seed, address)
            except (ValueError, TypeError) as error:
                raise ModelFault("bad-parameter", str(error), stack=self.stack()) from error
        self.priors.append(self.density(dist, value))
        is_named = words is not None and type(value) is int and 0 <= value < len(words)
        self.choices_made[address] = words[value] if words is not None and is_named else value
        return value

    def own_value(self, address: str, value: Any, words: Sequence[str] | None) -> Any:
        """Return a given value as the choice draws it: a word becomes its number."""
        if not isinstance(value, str) or words is None:
            return value
        if value not in words:
            message = f"{value!r} is not an option of the choice `{address}`"
            raise ModelFault(
                "unknown-option",
                message,
                stack=self.stack(),
                help=f"its options are {', '.join(map(repr, words))}",
            )
        return words.index(value)

    def observe(self, dist: Any, value: Any) -> Any:
        """Score an observed value."""
        self.address("observe")
        self.check(dist)
        self.scores.append(self.density(dist, value))
        return value

    def check(self, dist: Any) -> None:
        """Refuse a value that is not a distribution."""
        if not isinstance(dist, Distribution):
            raise ModelFault(
                "not-a-distribution", f"expected a distribution, found {dist!r}", stack=self.stack()
            )

    def density(self, dist: Distribution, value: Any) -> float:
        """Return the log density of a value; infinite density, a bad parameter or a bad value is a fault."""
        try:
            log_density = densities.log_density(dist, value)
        except (ValueError, TypeError) as error:
            code = "type-mismatch" if densities.is_valid(dist) else "bad-parameter"
            raise ModelFault(code, str(error), stack=self.stack()) from error
        if math.isnan(log_density) or log_density == math.inf:
            message = f"the log density of {value!r} is {log_density}"
            raise ModelFault("non-finite-score", message, stack=self.stack())
        return log_density

    def factor(self, log_score: float) -> None:
        """Add to the score."""
        self.address("factor")
        if math.isnan(log_score) or log_score == math.inf:
            raise ModelFault("non-finite-score", f"a factor is {log_score}", stack=self.stack())
        self.scores.append(densities.grid(float(log_score)))

    def condition(self, holds: Any) -> None:
        """Forbid the run unless `holds`."""
        self.address("condition")
        if not holds:
            self.scores.append(-math.inf)

    def query(self, key: Any, value: Any) -> None:
        """Record the answer of a query."""
        address = self.address("query")
        _refuse_as_key(key)
        if key in self.answers:
            other = self.answered[key]
            raise ModelFault(
                "query-twice",
                f"the query {key!r} is written twice, at {other} and at {address}",
                stack=self.stack(),
            )
        self.answers[key], self.answered[key] = value, address

    def emit(self, shapes: Sequence[Any]) -> None:
        """Add shapes to the scene."""
        flat = flatten(shapes)
        if self.frame is not None:
            flat = list(_engine.operation("placed", self.frame, tuple(flat)))
        self.scene.append((self.address("emit"), flat))

    def future(self, function: Callable[..., Any], args: Sequence[Any]) -> Any:
        """Run a call now, and return its value as a future."""
        label, self.pending = self.pending or "apply", ""
        depth, loops = len(self.path), len(self.loops)
        function = underlying(function)
        if isinstance(function, Memoised):
            value = self.recall(function, args, {})
        elif isinstance(function, FunctionType) and self.is_model_code(function):
            self.path.append(label)
            value = self.enter(function, args, {})
        else:
            futures.refuse(function, args, {})
            value = function(*args)
        del self.path[depth:], self.loops[loops:]
        return futures.Future(value)

    def place(self, frame: Any, function: Callable[..., Any], args: Sequence[Any]) -> Any:
        """Run a call in a frame."""
        label, self.pending = self.pending or "apply", ""
        return self.placed(frame, label, function, args)

    def mirrored(self, axis: Any, function: Callable[..., Any], args: Sequence[Any]) -> Any:
        """Run `mirrored` where it is not called by its name."""
        return self.with_function(("mirrored[]", "apply"), words.mirrored, (axis, function, *args), {})

    def arrayed(self, frames: Any, function: Callable[..., Any], args: Sequence[Any]) -> Any:
        """Run `arrayed` where it is not called by its name."""
        return self.with_function(("arrayed[]", "apply"), words.arrayed, (frames, function, *args), {})

    def force(self, value: Any) -> Any:
        """Return the value of a future."""
        return futures.forced(value)

    def mem(self, function: Callable[..., Any]) -> Memoised[..., Any]:
        """Memoise a function."""
        address = self.address("mem")
        function = underlying(function)
        if isinstance(function, Memoised):
            return function
        if not isinstance(function, FunctionType):
            message = f"`mem` takes a function, found {function!r}"
            raise ModelFault("not-callable", message, stack=self.stack())
        return Memoised(function, address)

    def recall(self, function: Memoised[..., Any], args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
        """Call a memoised function; only the first call with equal arguments runs, from the root of addresses."""
        values = memoised.bound(function, args, kwargs)
        try:
            address = self.calls.address(function) + memoised.text_of(values)
        except ModelFault as fault:
            raise ModelFault(fault.code, fault.message, stack=self.stack()) from None
        if address not in self.calls.values:
            self.calls.values[address] = memoised.RUNNING
            outer = self.path, self.loops, self.pending, self.frame
            self.path, self.loops, self.frame = [address], [], None
            value = self.enter(underlying(function.function), args, kwargs)
            self.path, self.loops, self.pending, self.frame = outer
            self.calls.values[address] = value
        if self.calls.values[address] is memoised.RUNNING:
            message = f"the memoised call `{address}` needs its own value"
            raise ModelFault("memo-cycle", message, stack=self.stack())
        return self.calls.values[address]

    def infer(self, model: Callable[..., Any], method: Any, args: Sequence[Any], keep: str) -> Any:
        """Search another model, in the engine, which has the methods."""
        inference.check(method, keep)
        function = underlying(model)
        if memoised.holds_one([model, *args]):
            message = "a memoised function belongs to the outer run, and cannot be an argument of an `infer`"
            raise ModelFault("memo-outside", message, stack=self.stack())
        if not isinstance(function, FunctionType):
            raise ModelFault("not-callable", f"`infer` runs a model, found {model!r}", stack=self.stack())
        seed = 0 if isinstance(method, EnumerateAll) else self.sample(inference.SEEDS)
        self.pending = ""
        try:
            if self.around is None:
                self.around = inner.Around(self.model or function)
            return self.around.infer(inference.constant(method, keep), function, args, seed)
        except _engine.EngineFault as fault:
            raise ModelFault(fault.code, fault.message, fault.help, stack=self.stack()) from None

    def constraint(self, kind: str, a: float, b: float, width: float) -> None:
        """Record the numbers that a soft constraint compares."""
        calls = self.stack()
        span = calls[-1].span if calls else None
        self.constraints.append(Constraint(kind, "/".join([*self.path, kind]), span, a, b, width))

    compared = staticmethod(futures.compared)
    searched = staticmethod(futures.searched)

    # faults

    def stack(self, error: BaseException | None = None) -> list[Call]:
        """Return the model's calls, outermost first."""
        calls: list[Call] = []
        if error is not None:
            trace = error.__traceback__
            while trace is not None:
                calls += self._line(trace.tb_frame.f_code, trace.tb_lasti)
                trace = trace.tb_next
            return calls
        frame: FrameType | None = sys._getframe(1)
        while frame is not None:
            calls += self._line(frame.f_code, frame.f_lasti)
            frame = frame.f_back
        return calls[::-1]

    def _line(self, code: Any, instruction: int) -> list[Call]:
        if code not in self.codes or instruction < 0:
            return []
        line, end_line, column, end_column = list(code.co_positions())[instruction // 2]
        if line is None or column is None:
            return []
        name = code.co_qualname.replace(".<locals>", "").replace("<lambda>", "lambda")
        return [
            Call(
                name, place(code.co_filename, line, column + 1, end_line or line, (end_column or column) + 1)
            )
        ]

    def fault(self, error: Exception) -> ModelFault:
        """Return a Python exception as a fault with a code."""
        code = next((code for kind, code in CODES if isinstance(error, kind)), "model-failed")
        text = str(error)
        finer_codes = (finer for kind, words, finer in FINER if isinstance(error, kind) and words in text)
        code = next(finer_codes, code)
        # The engine's errors about the numbers of shapes have a code.
        code = getattr(error, "code", code) if isinstance(error, ValueError) else code
        if isinstance(error, KeyError):
            text = f"the dict has no key {error.args[0]!r}" if error.args else ""
        if (host := failed_host(error)) is not None:
            code, text = (
                "host-function",
                f"the host function `{host.name}` failed: {type(error).__name__}: {error}",
            )
        replay = f"seed={self.seed}" if self.seed is not None else ""
        return ModelFault(code, text, vocabulary.shape_help(text), stack=self.stack(error), replay=replay)


def _refuse_as_key(key: Any) -> None:
    """Refuse keys of queries that cannot be keys of a dict, also after a way through the engine."""
    hash(key)
    waiting = [key]
    while waiting:
        part = waiting.pop()
        if isinstance(part, (FunctionType, Distribution)):
            raise TypeError(f"{part!r} cannot be a key")
        waiting.extend(futures.parts_of(part))


def failed_host(error: BaseException) -> Host[Any, Any] | None:
    """Return the host function that raised an exception, or None."""
    trace = error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code is Host.__call__.__code__:
            host: Host[Any, Any] = trace.tb_frame.f_locals["self"]
            return host
        trace = trace.tb_next
    return None


CODES: tuple[tuple[type[BaseException], str], ...] = (
    (futures.NotForced, "future-not-forced"),
    (ZeroDivisionError, "division-by-zero"),
    (IndexError, "list-index"),
    (KeyError, "missing-key"),
    (AssertionError, "assertion"),
    (RecursionError, "too-deep"),
    (OverflowError, "float-overflow"),
    (NameError, "unassigned-variable"),
    (AttributeError, "missing-field"),
    (TypeError, "type-mismatch"),
    (ValueError, "bad-argument"),
)

FINER: tuple[tuple[type[BaseException], str, str], ...] = (
    (ValueError, "unpack", "unpack-length"),
    (ValueError, "math domain", "math-domain"),
    (ValueError, "invalid literal", "bad-text"),
    (ValueError, "could not convert", "bad-text"),
    (ValueError, "ormat", "bad-format"),
    (ValueError, "is not in", "missing-element"),
    (TypeError, "is not callable", "not-callable"),
)
