"""Models compiled for the engine, their arguments, and the engine's faults as errors of the package."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from types import FunctionType
from typing import Any

from niwaki import _engine
from niwaki.errors import InputError, ModelFault
from niwaki.errors.messages import MESSAGES
from niwaki.errors.settings import MAX_MEMORY, MAX_STEPS, bad, count, refused
from niwaki.lang import lookup, vocabulary
from niwaki.lang.blame import Blame, marked
from niwaki.lang.core import Core
from niwaki.lang.labelling import labels_of
from niwaki.lang.labels import Labels
from niwaki.lang.lower import lower
from niwaki.lang.marks import Marked, P, T


class Compiled(Marked[P, T]):
    """A marked function with its core form and its program for the engine, both compiled on first use."""

    def __init__(self, function: Callable[P, T]) -> None:
        if not isinstance(function, FunctionType):
            raise InputError("model-of-a-value", found=repr(function))
        super().__init__(function)
        self._core: Core | None = None
        self._program: _engine.Program | None = None
        self._labels: Labels | None = None

    def core(self) -> Core:
        """Return the model in core form."""
        if self._core is None:
            self._core = lower(self.function)
        return self._core

    def program(self) -> _engine.Program:
        """Return the model compiled for the engine."""
        if self._program is None:
            self._program = compile_core(self.core())
        return self._program

    @property
    def labels(self) -> Labels:
        """The labels of choices and parts by address; without the source of the model, the words of addresses."""
        if self._labels is None:
            self._labels = labels_of(self.function)
        return self._labels


def compile_core(core: Core) -> _engine.Program:
    """Compile a model in core form to a program of the engine."""
    with translated(core.entry):
        return _engine.Program(core.text, list(core.constants), list(core.classes))


def task(
    model: Compiled[..., Any],
    args: Sequence[Any] = (),
    kwargs: Mapping[str, Any] | None = None,
    sketches: Sequence[_engine.SketchSpec] = (),
    max_steps: int = MAX_STEPS,
    max_memory: int = MAX_MEMORY,
    hold: Mapping[str, Any] | None = None,
) -> _engine.Task:
    """Return a model with its arguments and sketches, ready for a search; `hold` has the values of held choices."""
    count("max_steps", max_steps)
    count("max_memory", max_memory, 1 << 20)
    program = model.program()
    values = arguments(model, args, kwargs or {})
    try:
        ready = _engine.Task(program, values, list(sketches), max_steps, max_memory)
    except (TypeError, OverflowError) as error:
        raise _bad_argument(model, program, values, error) from error
    if not hold:
        return ready
    try:
        with translated(model.name, model=model):
            return ready.holding(dict(hold))
    except (TypeError, OverflowError) as error:
        expected = "numbers, truth values and lists of numbers, by address"
        raise bad("hold", dict(hold), expected, '`result.held("wing[1]")`') from error


def _bad_argument(
    model: Compiled[..., Any], program: _engine.Program, values: list[Any], error: Exception
) -> InputError:
    """Return the error about the argument that the engine cannot take."""
    for number, value in enumerate(values, 1):
        try:
            _engine.Task(program, [value])
        except (TypeError, OverflowError) as found:
            return InputError("argument-value", number=number, name=model.name, found=str(found))
    return InputError("argument-value", number="?", name=model.name, found=str(error))


def arguments(model: Compiled[..., Any], args: Sequence[Any], kwargs: Mapping[str, Any]) -> list[Any]:
    """Return the arguments by position, without unchanged defaults at the end."""
    core = model.core()
    try:
        bound = _signature(model, max(len(args), core.required)).bind(*args, **kwargs)
    except TypeError as error:
        least, most = core.required, len(core.parameters)
        many = f"{least} to {most}" if least < most else str(most)
        raise InputError(
            "model-arguments",
            name=model.name,
            expected=f"{many} argument{'' if many == '1' else 's'}",
            found=str(len(args) + len(kwargs)),
            parameters=", ".join(core.parameters) or "none",
            detail=str(error),
        ) from error
    passed = set(bound.arguments)
    bound.apply_defaults()
    last = max((n for n, name in enumerate(core.parameters, 1) if name in passed), default=0)
    return [bound.arguments[name] for name in core.parameters[:last]]


def _signature(model: Compiled[..., Any], count: int) -> inspect.Signature:
    """Return a model's signature; without its Python function, a signature of its first parameters' names."""
    if hasattr(model, "function"):
        return inspect.signature(model.function)
    kind = inspect.Parameter.POSITIONAL_ONLY
    return inspect.Signature([inspect.Parameter(name, kind) for name in model.core().parameters[:count]])


@contextmanager
def translated(
    name: str,
    replay: str = "",
    choices: Mapping[str, Any] | None = None,
    model: Compiled[..., Any] | None = None,
) -> Iterator[None]:
    """Raise a fault of the engine in the block as `ModelFault` or `InputError`; the model labels its parts."""
    try:
        yield
    except _engine.EngineFault as fault:
        raise _error(fault, name, replay, choices or {}, model) from None


def as_fault(fault: BaseException | None, name: str, replay: str = "") -> ModelFault | None:
    """Return a fault that the engine kept as a `ModelFault`; None for anything else."""
    if not isinstance(fault, _engine.EngineFault):
        return None
    error = _error(fault, name, replay, {})
    return error if isinstance(error, ModelFault) else None


def _error(
    fault: Any,
    name: str,
    replay: str,
    choices: Mapping[str, Any],
    model: Compiled[..., Any] | None = None,
) -> Exception:
    if fault.code == "missing-choice":
        near = get_close_matches(fault.subject, list(choices), n=3, cutoff=0.0)
        nearest = ", ".join(f'"{address}"' for address in near) or "none"
        return InputError("missing-choice", address=fault.subject, nearest=nearest)
    if fault.kind == "run":
        help = fault.help or vocabulary.shape_help(fault.message)
        error = ModelFault.from_engine(fault.code, fault.message, help, fault.stack, replay)
        error.values |= {"omitted": fault.omitted, "invalid": fault.invalid}
        return error
    if fault.kind == "compile":
        return InputError("machine-limit", found=fault.message)
    if fault.code == "no-continuous-choices":
        return InputError(fault.code)
    if fault.code == "no-normal-fits":
        return InputError(fault.code, name=name, found=fault.message)
    if fault.code == "no-address":
        nearest = _nearest(fault.help)
        if model is not None and model.labels.tables:
            known = lookup.choices(model.labels)
            nearest = lookup.nearest(model.labels, fault.subject, known, "choice")
        return InputError("no-address", pattern=fault.subject, name=name, nearest=nearest)
    if fault.code == "no-part":
        return InputError("no-part", pattern=fault.subject, name=name, parts=_nearest(fault.help))
    if fault.code == "many-parts":
        return InputError("many-parts", pattern=fault.subject, name=name, parts=fault.help)
    if fault.kind == "no-start":
        if fault.tries == 0:
            constraint = "the score of this run is minus infinity"
            return InputError("no-start", name=name, tried="the start run is", constraint=constraint)
        causes = ", ".join(f"{cause} ({count})" for cause, count in fault.causes)
        tried = f"all {fault.tries} forward runs were"
        return InputError("no-start", name=name, tried=tried, constraint=f"the runs broke: {causes}")
    if fault.kind == "impossible":
        total = sum(count for _, count in fault.causes)
        if fault.barrier == 1 and all(cause == "avoid" for cause, _ in fault.causes):
            return InputError("obstacle-at-start", count=total)
        causes = ", ".join(f"{cause} ({count})" for cause, count in fault.causes)
        blame = [Blame.of(entry) for entry in fault.blame]
        labels = Labels() if model is None else model.labels
        return InputError(
            "everything-impossible",
            marked(blame, fault.looked_at, labels),
            barrier=f"barrier {fault.barrier}" if fault.barrier else "the end",
            count=total,
            constraint=causes,
            cure=_cure(fault),
            often=f"{blame[0].text(labels)} in {blame[0].runs} of {fault.looked_at}" if blame else "",
            elsewhere="; ".join(f"{part.text(labels)} in {part.runs}" for part in blame[1:4]),
            attempts=_tried(fault.attempts),
        )
    if fault.code not in MESSAGES or MESSAGES[fault.code].names - {"detail"}:
        return refused(fault, {}, {})
    return InputError(fault.code, detail=fault.message)


def _nearest(help: str | None) -> str:
    """Return the end of a message about a pattern, from the engine's list of the nearest addresses or its text."""
    if help is None or not help.startswith("`"):
        return help or "there is none"
    return f"the nearest {'are' if ', ' in help else 'is'} {help}"


#: Advice for a constraint without any of its own.
LOOSEN = "loosen the constraint, so that more runs meet it"
#: Share of the runs that one place forbids, from which more particles do not help.
NEARLY_ALL = 0.9


def _cure(fault: Any) -> str:
    """Return the help: more particles only if runs become impossible late and in many places."""
    cause = fault.causes[0][0] if fault.causes else ""
    _, first = _engine.SKETCHES.get(cause) or ("", LOOSEN)
    often = max((runs for *_, runs in fault.blame), default=0)
    hopeless = fault.barrier <= 1 or (fault.looked_at and often >= NEARLY_ALL * fault.looked_at)
    return (
        first
        if hopeless
        else f"{first}; more particles may help, because runs become impossible late and in many places"
    )


def _tried(attempts: list[tuple[str, int, int | None]]) -> str:
    """Describe the populations of a search in which every particle became impossible."""
    return "; ".join(
        f"{particles} particles ({form}), all impossible at barrier {barrier}"
        for form, particles, barrier in attempts
    )
