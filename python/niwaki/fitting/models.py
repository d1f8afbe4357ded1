"""The text of a model that calls a generator: each parameter is a random choice, and the scene is the generator's mesh.

So the studio, `hold`, batches and every search of the package take a generator as they take any model. The text is a
file that a person may change.
"""

from __future__ import annotations

import json
import keyword
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields
from typing import Any

from niwaki.fitting.generator import Generator, number_of
from niwaki.fitting.meshes import Arrays, mesh_of
from niwaki.search.space import Axis, Space

#: Names of the text that no variable may take.
RESERVED = {"GENERATOR", "Path", "faces", "generator_of", "len", "mesh_at", "mesh_of", "vertices"}

#: Words of the language that every such model needs.
WORDS = {"emit", "host", "mesh", "model"}


def model_text(generator: Generator, place: str) -> str:
    """Return the text of a model.

    Parameters
    ----------
    generator
        A generator whose parameters are known before a run.
    place
        Its reference, from the folder of the text: `../box.scad`, `../lamp.py:lamp`.
    """
    space = generator.space
    assert space is not None
    texts = _Texts(space)
    names = texts.names
    draws = [line for number in range(len(space.axes)) for line in texts.draw(number)]
    listed = ", ".join(names)
    used = [f'"{axis.name}": {texts.value(number)}' for number, axis in enumerate(space.axes)]
    name = _identifier(generator.name)
    lines = [
        f'"""{generator.name} as a model: its parameters are random choices, and its mesh is the scene."""',
        "",
        "from pathlib import Path",
        "",
        f"from niwaki import {', '.join(sorted(texts.words))}",
        "from niwaki.fitting import generator_of, mesh_at",
        "",
        f"GENERATOR = generator_of(str(Path(__file__).parent / {_literal(place)}))",
        "",
        "",
        "@host",
        f"def mesh_of({listed}):",
        "    values = {",
        *(f"        {row}," for row in used),
        "    }",
        "    return mesh_at(GENERATOR, values)",
        "",
        "",
        "@model",
        f"def {name}():",
        *(f"    {line}" for line in draws),
        f"    vertices, faces = mesh_of({listed})",
        "    if len(faces) > 0:",
        "        emit(mesh(vertices, faces))",
    ]
    return "\n".join(lines) + "\n"


def mesh_at(generator: Generator, values: Mapping[str, Any]) -> Arrays:
    """Call a generator in this process.

    Parameters
    ----------
    generator
        A generator whose parameters are known before a run.
    values
        A value for each parameter; those of parameters that are not used are ignored.

    Returns
    -------
    tuple of ndarray
        Vertices (n, 3) and triangles (m, 3); empty arrays for an empty mesh.

    Raises
    ------
    InputError
        `bad-setting`: a value is outside of its range, or there is none.
    NotAMesh
        The generator returned something that is no mesh.
    """
    space = generator.space
    assert space is not None
    _, used = space.row(values)
    numbers = {
        axis.name: number_of(space, axis.name, values[axis.name])
        for axis, is_used in zip(space.axes, used, strict=True)
        if is_used
    }
    return mesh_of(generator.call(numbers).mesh)


class _Texts:
    """Texts of draws and conditions.

    Attributes
    ----------
    space : Space
        The parameters.
    words : set of str
        The words of the language that the text needs.
    names : list of str
        The variable of each parameter.
    """

    def __init__(self, space: Space) -> None:
        self.space = space
        self.words = set(WORDS)
        for axis in space.axes:
            self._choice(axis)
        self.names = _variables(space, RESERVED | self.words)

    def draw(self, number: int) -> list[str]:
        """Return the lines that draw a parameter, where it is used."""
        axis, name = self.space.axes[number], self.names[number]
        text = self._choice(axis)
        if not axis.when:
            return [f"{name} = {text}"]
        # The placeholder of an unused parameter has the type of its values.
        placeholder = 0.0 if axis.range is not None else _shown(axis)[0]
        return [f"{name} = {_literal(placeholder)}", f"if {self._used(number)}:", f"    {name} = {text}"]

    def value(self, number: int) -> str:
        """Return the text of a parameter's value in the call of the generator."""
        axis, name = self.space.axes[number], self.names[number]
        return (
            name
            if axis.range is not None or _is_plain(axis)
            else f"GENERATOR.space.axes[{number}].values[{name}]"
        )

    def _choice(self, axis: Axis) -> str:
        """Return the call that draws a value."""
        if axis.range is not None:
            arguments = [getattr(axis.range, field.name) for field in fields(axis.range)]
            return self._call(
                re.sub(r"(?<=[a-z])(?=[A-Z])", "_", type(axis.range).__name__).lower(), *arguments
            )
        values, weights = _shown(axis), axis.weights
        if values == (False, True):
            return self._call("flip", 0.5 if weights is None else weights[1])
        if isinstance(values, range):
            if weights is None:
                return self._call("discrete_uniform", values[0], values[-1])
            text = self._call("categorical", list(weights))
            return text if values[0] == 0 else f"{values[0]} + {text}"
        return self._call("choose", list(values), *([] if weights is None else [list(weights)]))

    def _call(self, word: str, *arguments: Any) -> str:
        self.words.add(word)
        return f"{word}({', '.join(map(_literal, arguments))})"

    def _used(self, number: int) -> str:
        """Return the condition under which a parameter is used: also those that it names must be."""
        rules = [
            " and ".join(term for other, levels in rule for term in self._terms(other, levels))
            for rule in self.space.axes[number].when
        ]
        return rules[0] if len(rules) == 1 else " or ".join(f"({rule})" for rule in rules)

    def _terms(self, number: int, levels: Sequence[int]) -> Iterable[str]:
        if self.space.axes[number].when:
            yield f"({self._used(number)})"
        name, values = self.names[number], _shown(self.space.axes[number])
        allowed = [values[level] for level in levels]
        if len(allowed) < len(values):
            if values == (False, True):
                yield name if allowed[0] else f"not {name}"
            else:
                tests = " or ".join(f"{name} == {_literal(value)}" for value in allowed)
                yield tests if len(allowed) == 1 else f"({tests})"


def _literal(value: Any) -> str:
    """Return a value as a formatter would write it."""
    if isinstance(value, list):
        return f"[{', '.join(map(_literal, value))}]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def _shown(axis: Axis) -> Sequence[Any]:
    """Return the values as the model draws them: their numbers where they are no plain values."""
    return axis.values if _is_plain(axis) else range(len(axis.values))


def _is_plain(axis: Axis) -> bool:
    """Whether all levels can be written into a text, and a model can compare them."""
    return all(isinstance(value, bool | int | float | str) for value in axis.values)


def _identifier(name: str) -> str:
    text = re.sub(r"\W", "_", name)
    return f"_{text}" if not text or text[0].isdigit() or keyword.iskeyword(text) else text


def _variables(space: Space, reserved: set[str]) -> list[str]:
    """Return a variable for each parameter: its name, unless that is none or is reserved."""
    names = list[str]()
    for axis in space.axes:
        name = _identifier(axis.name).lstrip("_") or "value"
        while name in reserved or not name.isidentifier() or keyword.iskeyword(name):
            name += "_"
        reserved = reserved | {name}
        names.append(name)
    return names
