"""The source of a model: its file, its text, and places in the text.

A :class:`Span` is a piece of a source file, counted as editors count it (lines and columns from 1, the end excluded).
:func:`find_function` finds the syntax tree of a function object in the tree of the whole file, so that every node has
the file's lines and columns.
"""

from __future__ import annotations

import ast
import linecache
from dataclasses import dataclass
from types import FunctionType


@dataclass(frozen=True)
class SourceFile:
    """The name and the lines (without line ends) of a source file."""

    path: str
    lines: tuple[str, ...]

    def line(self, number: int) -> str:
        """Return the text of a line, counted from 1; an empty text beyond the end."""
        return self.lines[number - 1] if 0 < number <= len(self.lines) else ""


@dataclass(frozen=True)
class Span:
    """A piece of a file: from (line, column) up to, not including, (end_line, end_column); all from 1."""

    file: SourceFile
    line: int
    column: int
    end_line: int
    end_column: int

    def __str__(self) -> str:
        return f"{self.line}:{self.column}-{self.end_line}:{self.end_column}"

    @property
    def text(self) -> str:
        """The text of the span; only the first line of a span of several lines."""
        line = self.file.line(self.line)
        if self.end_line == self.line:
            return line[self.column - 1 : self.end_column - 1]
        return line[self.column - 1 :]


@dataclass
class _Parsed:
    """A parsed file with an index of its functions, so that a search for a function does not walk the tree.

    Attributes
    ----------
    raw : list of str
        The lines as `linecache` returned them.
    file : SourceFile
        The lines without their ends.
    functions : dict
        Definitions by name and first line, decorators included.
    lambdas : dict
        Lambdas by their lines, in the order of the tree.
    """

    raw: list[str]
    file: SourceFile
    functions: dict[tuple[str, int], ast.FunctionDef]
    lambdas: dict[int, list[ast.Lambda]]


_files: dict[str, _Parsed] = {}


def _parsed(path: str, module_globals: dict[str, object]) -> _Parsed | None:
    """Return the parsed file, or None; a file that has changed is parsed again."""
    # An editor may have changed the file since the last call.
    linecache.checkcache(path)
    raw = linecache.getlines(path, module_globals)
    known = _files.get(path)
    if known is not None and known.raw is raw:
        return known
    lines = tuple(line.rstrip("\r\n") for line in raw)
    if not lines:
        return None
    if known is not None and known.file.lines == lines:
        known.raw = raw
        return known
    try:
        tree = ast.parse("\n".join(lines) + "\n", filename=path)
    except (SyntaxError, RecursionError, MemoryError):
        return None
    parsed = _files[path] = _Parsed(raw, SourceFile(path, lines), {}, {})
    for node in ast.walk(tree):
        if isinstance(node, ast.Lambda):
            parsed.lambdas.setdefault(node.lineno, []).append(node)
        elif isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            first = min([node.lineno, *(decorator.lineno for decorator in node.decorator_list)])
            parsed.functions.setdefault((node.name, first), node)  # type: ignore[arg-type]
    return parsed


def span_of(node: ast.AST, file: SourceFile) -> Span:
    """Return the span of a syntax node. The tree counts columns in UTF-8 bytes, a span in characters."""
    line, column = getattr(node, "lineno", 1), getattr(node, "col_offset", 0)
    end_line = getattr(node, "end_lineno", None) or line
    end_column = getattr(node, "end_col_offset", None)
    if end_column is None:
        end_column = column + 1
    return Span(
        file,
        line,
        _characters(file.line(line), column) + 1,
        end_line,
        _characters(file.line(end_line), end_column) + 1,
    )


def _characters(line: str, offset: int) -> int:
    if line.isascii():
        return offset
    return len(line.encode()[:offset].decode(errors="replace"))


def head_span(node: ast.FunctionDef | ast.Lambda, file: SourceFile) -> Span:
    """Return the span of a definition's first line, `def name(...)`, without the body."""
    whole = span_of(node, file)
    if isinstance(node, ast.Lambda):
        return whole
    first = span_of(node.body[0], file)
    line = file.line(whole.line)
    if first.line == whole.line:
        line = line[: first.column - 1]
    end = line.rfind(":") if line.rstrip().endswith(":") else len(line.rstrip())
    return Span(file, whole.line, whole.column, whole.line, max(end, whole.column) + 1)


def find_function(function: FunctionType) -> tuple[SourceFile, ast.FunctionDef | ast.Lambda] | None:
    """Return the file and the syntax tree of a function object, or None when its source cannot be read."""
    code = function.__code__
    parsed = _parsed(code.co_filename, function.__globals__)
    if parsed is None:
        return None
    if code.co_name == "<lambda>":
        return _find_lambda(function, parsed.file, parsed.lambdas.get(code.co_firstlineno, []))
    node = parsed.functions.get((code.co_name, code.co_firstlineno))
    return None if node is None else (parsed.file, node)


def _find_lambda(
    function: FunctionType, file: SourceFile, lambdas: list[ast.Lambda]
) -> tuple[SourceFile, ast.Lambda] | None:
    """Choose among the lambdas of a line the smallest with a body that contains every instruction's position."""
    code = function.__code__
    places = [
        (p[0], p[2]) for p in code.co_positions() if p[0] is not None and p[2] is not None and p[3] != 0
    ]
    best: ast.Lambda | None = None
    for node in lambdas:
        body = node.body
        start, end = (
            (body.lineno, body.col_offset),
            (body.end_lineno or body.lineno, body.end_col_offset or 0),
        )
        if all(start <= place <= end for place in places) and (
            best is None or node.col_offset > best.col_offset
        ):
            best = node
    return (file, best) if best is not None else None
