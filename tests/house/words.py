"""Writes what follows from the engine's tables of solids, families and sketches, and from the options; a test compares.

`make words`: the words for shapes, the classes of distributions and the words that draw from them in Python, with their
docstrings; their names and those of sketches in the package's stub; and the manual's tables of these and of options.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

from niwaki import _engine
from niwaki.targets.asks import OPTIONS, flag

ROOT = Path(__file__).parents[2]
WORDS = "python/niwaki/words/shapes.py"
CLASSES = "python/niwaki/words/distributions.py"
DRAWS = "python/niwaki/words/draws.py"
STUB = "python/niwaki/__init__.pyi"
GUIDE = "docs/guide/language.md"
COMMANDS = "docs/guide/command-line.md"

Row = tuple[str, str, str | None, str]

_HEAD = '''"""Shapes, the things that `emit` adds to a scene. Right-handed, y up, metres by default.

A point is a 3-tuple, a list or a `vec`. Flat shapes lie on a plane parallel to z = 0, and are seen from +z. A colour
is `(r, g, b)` in [0, 1] or a name. A rotation is three rows of three numbers, as `rotation(axis, angle)` gives. In a
plain-Python run a shape is the engine's own `Shape`.

Written by tests/house/words.py from the engine's table of solids.
"""

from __future__ import annotations

from typing import Any

from niwaki.words.measures import Axis, Bark, Color, Frame, Pairs, Points, Rotation, make
from niwaki.words.vectors import VecLike
'''


def texts() -> dict[str, str]:
    """Every file that follows from the engine, by its place: what it should hold."""
    stub, guide, commands = ((ROOT / name).read_text(encoding="utf-8") for name in (STUB, GUIDE, COMMANDS))
    return {
        WORDS: _words(),
        CLASSES: _classes(),
        DRAWS: _draws(),
        STUB: _stub(stub),
        GUIDE: _guide(guide),
        COMMANDS: _replaced(commands, COMMANDS, "target or constraint", _options()),
    }


def _words() -> str:
    listed = _listed(list(_engine.SHAPES))
    functions = [_function(name, doc.strip(), rows) for name, (doc, rows) in _engine.SHAPES.items()]
    all_words = f"SHAPES = ({', '.join(_engine.SHAPES)})"
    if len(all_words) > 110:
        all_words = "SHAPES = (\n" + "".join(f"    {name},\n" for name in _engine.SHAPES) + ")"
    last = f"#: The functions for shapes; the engine has one of the same name for each.\n{all_words}\n"
    return "\n\n".join([f"{_HEAD}\n{listed}\n", *functions, last])


def _listed(names: list[str]) -> str:
    names = sorted(names)
    listed = f"__all__ = [{', '.join(map(_quoted, names))}]"
    if len(listed) > 110:
        listed = "__all__ = [\n" + "".join(f"    {_quoted(name)},\n" for name in names) + "]"
    return listed


def _quoted(name: str) -> str:
    return f'"{name}"'


def _function(name: str, doc: str, rows: list[Row]) -> str:
    """A word in Python: the signature, the docstring and the call."""
    parameters = [_parameter(*row) for row in rows]
    arguments = [_quoted(name), *(row[0] for row in rows)]
    lines = [_fitted(f"def {name}(", parameters, ") -> Any:", ""), f'    """{_indented(doc)}', ""]
    lines += [*_parameters(rows), _call(arguments)]
    return "\n".join(lines) + "\n"


def _parameters(rows: list[Row]) -> Iterator[str]:
    """The end of a docstring, with each parameter; neighbours of which the same is said go together."""
    yield from ("    Parameters", "    ----------")
    for about, group in groupby(rows, key=lambda row: row[3]):
        yield from (f"    {', '.join(row[0] for row in group)}", f"        {_indented(about.strip(), 8)}")
    yield '    """'


def _parameter(name: str, kind: str, default: str | None, _: str) -> str:
    if default is None:
        return f"{name}: {kind}"
    return f"{name}: {kind}{' | None' if default == 'None' else ''} = {default}"


def _fitted(opening: str, parts: list[str], closing: str, indent: str) -> str:
    """The parts on one line, on a line of their own or on one each, as the formatter has them."""
    for text in f"{opening}{', '.join(parts)}{closing}", f"{opening}\n    {', '.join(parts)}\n{closing}":
        if all(len(indent + line) <= 110 for line in text.split("\n")):
            return text
    return "\n".join([opening, *(f"    {part}," for part in parts), closing])


def _call(arguments: list[str]) -> str:
    text = _fitted("return make(", arguments, ")", "    ")
    return "\n".join(f"    {line}" for line in text.split("\n"))


def _indented(doc: str, by: int = 4) -> str:
    """The text of a comment as a docstring: a blank after each line's start is the comment's."""
    text = re.sub(r"\n ", "\n", doc)
    if any(by + len(line) > 118 for line in text.split("\n")):
        text = "\n\n".join(textwrap.fill(part, 112 - by) for part in text.split("\n\n"))
    return "\n".join(" " * by * (k > 0 and bool(line)) + line for k, line in enumerate(text.split("\n")))


_CLASSES_HEAD = '''"""Distributions as values: `sample(Gaussian(0, 1))`, `observe(Gaussian(m, s), x)`.

The lower-case word of the same name (`gaussian(0, 1)`) draws from it at once. The engine knows a distribution by its
family and its parameters in the order of the fields; densities and draws are the engine's.

Each family is a class, so that an editor can complete and explain it. Written by tests/house/words.py from the engine's
table of families.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any, ClassVar
'''

_BASE = '''@dataclass(frozen=True)
class Distribution:
    """Base class of all distributions, with the family's name and the parameters in order."""

    family: ClassVar[str] = ""

    @property
    def parameters(self) -> tuple[Any, ...]:
        """The parameters, in the order of the family's signature."""
        return tuple(getattr(self, field.name) for field in fields(self))
'''

_DRAWS_HEAD = '''"""Draws: a lower-case name makes a choice at once, `gaussian(0, 1)` for `sample(Gaussian(0, 1))`.

Parameters and defaults of such a word are those of its class in `distributions`, and a `label`. Written by
tests/house/words.py from the engine's table of families.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from niwaki.words import distributions as d
from niwaki.words.running import runner
'''

_LABEL = "The choice's name for people, a constant text; by default what the choice decides."
#: The word of a family whose name is another; a fixed value is not drawn.
_OTHER = {"bernoulli": "flip", "delta": None}
_DRAWN = {
    "Booleans": "bool",
    "Categories": "int",
    "Integers": "int",
    "Simplex": "list[float]",
    "Vectors": "list[float]",
    "Counts": "list[int]",
    "Truths": "list[bool]",
    "Components": "object",
}


def _words_that_draw() -> dict[str, str]:
    """The families that have a word that draws from them, by that word."""
    return {word: family for family in _engine.FAMILIES if (word := _OTHER.get(family, family)) is not None}


def _classes() -> str:
    classes = [_class(family) for family in _engine.FAMILIES]
    names = ["Distribution", *(family[0] for family in _engine.FAMILIES.values())]
    last = (
        "#: In the order of this file.\n"
        "FAMILIES: tuple[type[Distribution], ...] = tuple(Distribution.__subclasses__())\n"
    )
    return "\n\n".join([f"{_CLASSES_HEAD}\n{_listed(names)}\n", _BASE, *classes, last])


def _class(family: str) -> str:
    name, doc, rows, *_ = _engine.FAMILIES[family]
    lines = [
        "@dataclass(frozen=True)",
        f"class {name}(Distribution):",
        f'    """{_indented(doc.strip())}',
        "",
    ]
    lines += [*_parameters(rows), "", f'    family: ClassVar[str] = "{family}"', ""]
    lines += [f"    {row[0]}: {row[1]}{'' if row[2] is None else f' = {row[2]}'}" for row in rows]
    return "\n".join(lines) + "\n"


def _draws() -> str:
    words = _words_that_draw()
    return "\n\n".join([f"{_DRAWS_HEAD}\n{_listed(list(words))}\n", *map(_word, words, words.values())])


def _word(word: str, family: str) -> str:
    """A word that draws: the signature, the docstring and the draw."""
    name, doc, rows, space, *_ = _engine.FAMILIES[family]
    # What is drawn is not known of mixtures: the annotation says so.
    drawn = {"object": "Any"}.get(_DRAWN.get(space, "float"), _DRAWN.get(space, "float"))
    typed = [
        (n, kind.replace("Distribution", "d.Distribution"), default, about)
        for n, kind, default, about in rows
    ]
    signature = [*(_parameter(*row) for row in typed), "*", "label: str | None = None"]
    draw = f'runner("{word}").sample(d.{name}({", ".join(row[0] for row in rows)}))'
    lines = [_fitted(f"def {word}(", signature, f") -> {drawn}:", ""), f'    """{_indented(doc.strip())}', ""]
    lines += _parameters([*rows, ("label", "str", "None", _LABEL)])
    lines += (
        [f"    return {draw}"] if drawn == "Any" else [f"    drawn: {drawn} = {draw}", "    return drawn"]
    )
    return "\n".join(lines) + "\n"


def _stub(stub: str) -> str:
    """The stub with a line for each word and each sketch."""
    lines = stub.split("\n")
    for module, names in {
        "words": [*_engine.SHAPES, *_words_that_draw()],
        "targets.sketches": _engine.SKETCHES,
    }.items():
        present = [line for line in lines if line.startswith(f"from .{module} import ")]
        start, end = lines.index(present[0]), lines.index(present[-1]) + 1
        imports = {f"from .{module} import {name} as {name}" for name in names}
        lines[start:end] = sorted({*present, *imports})
    return "\n".join(lines)


def _guide(guide: str) -> str:
    """The manual with the signature of each word for shapes."""
    block = re.search(r"(?s)(## Shapes\n\n```text\n).*?(\n```)", guide)
    assert block is not None, f"{GUIDE} has no block of signatures below `## Shapes`"
    guide = guide[: block.end(1)] + "\n".join(_signatures()) + guide[block.start(2) :]
    return _replaced(guide, GUIDE, "draws", _rows())


def _replaced(text: str, file: str, heading: str, rows: Iterator[str]) -> str:
    """A page with other rows in the table that has a column of this heading."""
    table = re.search(rf"(?m)^(\|(?:.*\|)? {heading} \|.*\n\|[ |-]*\n)(\|.*\n)+", text)
    assert table is not None, f"{file} has no table with a column `{heading}`"
    return text[: table.end(1)] + "".join(rows) + text[table.end() :]


def _options() -> Iterator[str]:
    """Rows of options: the flag with its value, and its help."""
    for name, option in OPTIONS.items():
        about = re.sub(r"--[a-z-]+", r"`\g<0>`", option.help)
        value = option.metavar.replace("|", r"\|")
        yield f"| `{flag(name)} {value}` | {about} |\n"


def _rows() -> Iterator[str]:
    """Rows of families."""
    for word, family in _words_that_draw().items():
        name, _, rows, _, gives, limits = _engine.FAMILIES[family]
        alias = "" if word == family else f" (`{name}`)"
        yield f"| `{word}`{alias} | {', '.join(row[0] for row in rows)} | {gives} | {limits} |\n"


def _signatures() -> Iterator[str]:
    for name, (_, rows) in _engine.SHAPES.items():
        parts = [row[0] if row[2] is None else f"{row[0]}={row[2]}" for row in rows]
        text = f"{name}({', '.join(parts)})"
        yield textwrap.fill(text, 122, subsequent_indent=" " * (len(name) + 1), break_long_words=False)


if __name__ == "__main__":
    for place, text in texts().items():
        (ROOT / place).write_text(text, encoding="utf-8")
