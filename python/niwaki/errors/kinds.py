"""Classes of the errors that Niwaki raises on purpose, and the renderer of their messages.

ModelError   a model breaks a rule of the language; raised by the compiler, with one or two places in the source
ModelFault   a model failed while it ran; with the call stack of the model
InputError   a file, a setting or an argument cannot be used

The table `niwaki.errors.messages` has all texts; `str(error)` is the complete message.
"""

from __future__ import annotations

import linecache
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from niwaki.errors.messages import MESSAGES, Message
from niwaki.errors.source import SourceFile, Span


class NiwakiError(Exception):
    """Base class of the errors that Niwaki raises on purpose.

    Attributes
    ----------
    code : str
        The error's name, kebab-case; docs/errors has a page for each code.
    """

    code: str = ""

    def render(self) -> str:
        """Return the complete message, as in the manual."""
        raise NotImplementedError

    def __str__(self) -> str:
        return self.render()


class ModelError(NiwakiError):
    """Error about a model that breaks a rule of the language; the compiler raises it.

    Parameters
    ----------
    code
        A code of the table of messages.
    span
        The smallest place with the mistake.
    second
        Another place that explains the mistake.
    values
        Values for the names in the message's templates.
    """

    def __init__(self, code: str, span: Span, second: Span | None = None, **values: Any) -> None:
        super().__init__(code)
        self.code = code
        self.span = span
        self.second = second
        self.values = values

    def render(self) -> str:
        """Return the message with its places."""
        message = MESSAGES[self.code]
        first = (self.span, fill(message.label, self.values))
        other = (self.second, fill(message.second, self.values)) if self.second is not None else None
        lines = [f"error[{self.code}]: {fill(message.title, self.values)}", *snippet(first, other)]
        return "\n".join([*lines, *notes(message, self.values, margin=lines[-1].removesuffix("|"))])


@dataclass(frozen=True)
class Call:
    """A line of a model's call stack: a function's name, and the place that the call had reached."""

    function: str
    span: Span | None


class ModelFault(NiwakiError):
    """Error about a model that failed while it ran.

    Parameters
    ----------
    code
        The fault's name.
    message
        What happened, with the values; empty for the table's title.
    help
        What to do; None for the table's help.
    stack
        The model's calls, outermost first; the last call failed.
    replay
        The settings that repeat the run (seed, or choices).
    values
        Values for the names in the table's templates.
    """

    def __init__(
        self,
        code: str,
        message: str = "",
        help: str | None = None,
        stack: Sequence[Call] = (),
        replay: str = "",
        **values: Any,
    ) -> None:
        super().__init__(code)
        self.code = code
        self.message = message
        self.help = help
        self.stack = tuple(stack)
        self.replay = replay
        self.values = values

    @classmethod
    def from_engine(
        cls,
        code: str,
        message: str,
        help: str | None,
        stack: Sequence[tuple[str, str, tuple[int, int, int, int]]],
        replay: str = "",
    ) -> ModelFault:
        """Make the error from the engine's report; a line of the stack is (function, path, (l, c, end l, end c))."""
        calls = [Call(function, place(path, *span)) for function, path, span in stack]
        return cls(code, message, help, calls, replay)

    def render(self) -> str:
        """Return the message with its place and the model's calls."""
        message = MESSAGES.get(self.code, _UNKNOWN)
        title = self.message or fill(message.title, self.values)
        lines = [f"error[{self.code}]: {title}"]
        last = self.stack[-1].span if self.stack else None
        if last is not None:
            lines += snippet((last, fill(message.label, self.values)), None)
        else:
            lines.append(" |")
        margin = lines[-1].removesuffix("|")
        if len(self.stack) > 1 or (self.stack and last is None):
            lines.append(f"{margin}= calls:")
            shown = self.stack if len(self.stack) <= 12 else (*self.stack[:6], None, *self.stack[-5:])
            for call in shown:
                if call is None:
                    lines.append(
                        f"{margin}     ... {len(self.stack) - 11 + self.values.get('omitted', 0)} more ..."
                    )
                    continue
                where = f" at {call.span.file.path}:{call.span.line}" if call.span is not None else ""
                lines.append(f"{margin}     {call.function}{where}")
        lines += notes(message, self.values, self.help, margin)
        if self.replay:
            lines.append(f"{margin}= replay: {self.replay}")
        return "\n".join(lines)


class InputError(NiwakiError):
    """Error about a file, a setting or an argument that cannot be used.

    Parameters
    ----------
    code
        A code of the table of messages.
    places
        Up to two places in a model that explain the error, each with a label.
    values
        Values for the message's templates. `detail`, `elsewhere`, `attempts` and `source` are shown on separate lines.
    """

    def __init__(self, code: str, places: Sequence[tuple[Span, str]] = (), **values: Any) -> None:
        super().__init__(code)
        self.code = code
        self.places = tuple(places)
        self.values = values

    def render(self) -> str:
        """Return the message, with its places if it has any."""
        message = MESSAGES.get(self.code, _UNKNOWN)
        lines = [f"error[{self.code}]: {fill(message.title, self.values)}"]
        margin = " "
        if self.places:
            first, *further = self.places
            lines += snippet(first, further[0] if further else None)
            margin = lines[-1].removesuffix("|")
        for name, label in (
            ("detail", "found"),
            ("elsewhere", "elsewhere"),
            ("attempts", "tried"),
            ("source", "read from"),
        ):
            if self.values.get(name):
                lines.append(f"{margin}= {label}: {self.values[name]}")
        return "\n".join([*lines, *notes(message, self.values, margin=margin)])


_UNKNOWN = Message("unknown", "the model failed")


def fill(template: str, values: dict[str, Any]) -> str:
    """Fill a template's names with values; a name without a value becomes empty."""

    class Values(dict[str, Any]):
        def __missing__(self, key: str) -> str:
            return ""

    return template.format_map(Values(values))


def place(path: str, line: int, column: int, end_line: int, end_column: int) -> Span:
    """Return a span in the file at a path."""
    lines = tuple(text.rstrip("\r\n") for text in linecache.getlines(path))
    return Span(SourceFile(path, lines), line, column, end_line, end_column)


def notes(message: Message, values: dict[str, Any], help: str | None = None, margin: str = " ") -> list[str]:
    """Return the lines `= why:` and `= help:` of a message."""
    why, cure = fill(message.why, values), help if help is not None else fill(message.help, values)
    return [f"{margin}= {kind}: {text}" for kind, text in (("why", why), ("help", cure)) if text]


def snippet(first: tuple[Span, str], second: tuple[Span, str] | None) -> list[str]:
    """Return the source lines of places, with carets under the first and dashes under the second, in file order."""
    main = first[0]
    elsewhere = second is not None and second[0].file.path != main.file.path
    marks = [(main, first[1], "^")]
    if second is not None and not elsewhere:
        marks.append((second[0], second[1], "-"))
    marks.sort(key=lambda mark: (mark[0].line, mark[0].column))
    numbers = [span.line for span, _, _ in marks] + (
        [second[0].line] if second is not None and elsewhere else []
    )
    width = max(len(str(number)) for number in numbers)
    margin = " " * (width + 1)
    lines = [f"{' ' * width}--> {main.file.path}:{main.line}:{main.column}", f"{margin}|"]
    lines += _marked(marks, width)
    if second is not None and elsewhere:
        other = second[0]
        lines += [
            f"{margin}|",
            f"{' ' * width}::: {other.file.path}:{other.line}:{other.column}",
            f"{margin}|",
        ]
        lines += _marked([(other, second[1], "-")], width)
    lines.append(f"{margin}|")
    return lines


def _marked(marks: Sequence[tuple[Span, str, str]], width: int) -> list[str]:
    lines: list[str] = []
    shown = 0
    for span, label, sign in marks:
        text = span.file.line(span.line)
        if span.line != shown:
            lines.append(f"{span.line:>{width}} | {text}".rstrip())
            shown = span.line
        end = span.end_column if span.end_line == span.line else len(text.rstrip()) + 1
        carets = sign * max(end - span.column, 1)
        lines.append(f"{' ' * width} | {' ' * (span.column - 1)}{carets} {label}".rstrip())
    return lines
