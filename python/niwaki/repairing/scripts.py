"""Scripts as generators: a text with other literals is run, and what it makes comes back as parts with names.

| script | parts |
| --- | --- |
| `scene.py:room` | what the function `room` returns when it is called without arguments |
| `scene.py` | its variable `scene` or `parts`, or what its only function returns |
| `scene.scad` | the objects at the top of the file |
| any, with `run=` | what the function `run` makes of the text |

Parts are a dictionary of meshes by name, a list of meshes or of pairs (name, mesh), a scene, or one mesh; a mesh is
whatever `nw.fit` accepts (`niwaki.fitting.meshes`).
"""

from __future__ import annotations

import hashlib
import inspect
import random
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from niwaki.draw.assembly import Assembly
from niwaki.errors import InputError
from niwaki.fitting.functions import FunctionGenerator
from niwaki.fitting.generator import Called, Generator, Numbers
from niwaki.inputs.modules import run_file
from niwaki.repairing.csg import parts_of_scad
from niwaki.repairing.literals import Literal
from niwaki.repairing.writing import written
from niwaki.requirements import Violation

#: Variables of a script that may have its parts.
VARIABLES = ("scene", "parts")


@dataclass(frozen=True)
class Output:
    """The parts of a script, from a function that a person gives as `run`.

    Attributes
    ----------
    parts : dict
        Meshes by name; or a box as an array of two rows, its lowest and its highest corner.
    violations : list of Violation
        What is violated, if the function judges.
    """

    parts: Mapping[str, Any]
    violations: Sequence[Violation] = field(default_factory=list)


class ScriptGenerator(Generator):
    """A script with literals that may change.

    Parameters
    ----------
    path
        The file; it need not have `text` any more.
    text
        The text as it was read.
    rows
        Its literals.
    function
        The function that makes the parts; empty for the script itself.
    run
        A function of the text that makes the parts.
    """

    def __init__(
        self,
        path: Path,
        text: str,
        rows: Sequence[Literal],
        function: str = "",
        run: Callable[[str], Any] | None = None,
    ) -> None:
        self.path, self.text, self.function, self.run = path, text, function, run
        self.name, self.space = path.name, None
        self.rows = {row.key: row for row in rows}
        self._runner = None if run is None else FunctionGenerator.__new__(FunctionGenerator)
        if self._runner is not None and run is not None:
            self._runner.function = run
            self._runner.name = getattr(run, "__name__", "run")

    @property
    def is_scad(self) -> bool:
        """Whether the script is OpenSCAD's."""
        return self.path.suffix.lower() == ".scad"

    def call(self, numbers: Numbers) -> Called:
        """Run the text with other literals, by key."""
        text = written(self.text, self.rows, numbers)
        # A script that draws random numbers makes the same of the same text.
        random.seed(0)
        if "numpy.random" in sys.modules:
            np.random.seed(0)
        if self.run is not None:
            output = self.run(text)
        elif self.is_scad:
            output = parts_of_scad(text, self.path)
        else:
            output = self._python(text)
        facts = output.violations if isinstance(output, Output) else []
        parts = {name: _mesh(part) for name, part in parts_of(output).items()}
        return Called(
            None, parts=parts, facts=[[row.requirement, list(row.parts), row.amount] for row in facts]
        )

    def _python(self, text: str) -> Any:
        try:
            module, _ = run_file(self.path, source=text.encode())
        except InputError as error:
            # The script's own error says more than that the file failed.
            raise error.__cause__ or error from None
        values = vars(module)
        if self.function:
            if not callable(values.get(self.function)):
                raise NameError(f"{self.path.name} defines no function `{self.function}`")
            return values[self.function]()
        for name in VARIABLES:
            if name in values and not callable(values[name]):
                return values[name]
        functions = [
            value
            for value in values.values()
            if inspect.isfunction(value) and value.__module__ == module.__name__ and _is_called_bare(value)
        ]
        if len(functions) != 1:
            raise NameError(
                f"{self.path.name} shows no parts: it needs a variable `scene` or `parts`, or a function that returns "
                "them; name one of several functions as file.py:function"
            )
        return functions[0]()

    def identity(self) -> dict[str, str]:
        """Return the hash of the text."""
        return {"the model": self.name, "the model's file": hashlib.sha256(self.text.encode()).hexdigest()}

    @property
    def reason(self) -> str:
        """The reason why it must stay in this process."""
        return "" if self._runner is None else self._runner.reason

    def recipe(self) -> dict[str, Any] | None:
        """Return the text with its literals."""
        runner = None if self._runner is None else self._runner.recipe()
        if self._runner is not None and runner is None:
            return None
        fields = ("start", "end", "line", "text", "value", "kind", "sign", "words")
        return {
            "kind": "niwaki.repairing.scripts:ScriptGenerator",
            "path": str(self.path),
            "text": self.text,
            "function": self.function,
            "rows": [{name: getattr(row, name) for name in fields} for row in self.rows.values()],
            "run": runner,
        }

    @classmethod
    def of_recipe(cls, recipe: Mapping[str, Any]) -> ScriptGenerator:
        """Make it again."""
        rows = [Literal(**{**row, "words": tuple(row["words"])}) for row in recipe["rows"]]
        run = None if recipe["run"] is None else FunctionGenerator.loaded(recipe["run"])
        return cls(Path(recipe["path"]), recipe["text"], rows, recipe["function"], run)


def parts_of(value: Any) -> dict[str, Any]:
    """Return the parts of what a script made, by names of their own."""
    pairs: list[tuple[str, Any]]
    if isinstance(value, Output):
        value = value.parts
    if isinstance(value, Mapping):
        pairs = [(str(name), part) for name, part in value.items()]
    elif isinstance(value, Assembly):
        pairs = [(part.address, list(part.shapes)) for part in value.parts]
    elif hasattr(value, "graph") and hasattr(value, "geometry"):
        pairs = [
            (str(node), value.geometry[value.graph[node][1]].copy().apply_transform(value.graph[node][0]))
            for node in value.graph.nodes_geometry
        ]
    elif isinstance(value, list) and all(isinstance(row, tuple) and len(row) == 2 for row in value):
        pairs = [(str(name), part) for name, part in value]
    elif isinstance(value, list):
        pairs = [("part", part) for part in value]
    else:
        pairs = [("part", value)]
    if not pairs:
        raise ValueError("the script made nothing")
    total: dict[str, int] = {}
    for name, _ in pairs:
        total[name] = total.get(name, 0) + 1
    counted: dict[str, int] = {}
    out = {}
    for name, part in pairs:
        counted[name] = counted.get(name, 0) + 1
        out[name if total[name] == 1 else f"{name} {counted[name]}"] = part
    return out


def _mesh(part: Any) -> Any:
    """Return the mesh of a part; an array of two corners is a box."""
    if isinstance(part, np.ndarray) and part.shape == (2, 3):
        return _box(part)
    return part


#: The triangles of a box whose corners are numbered by the bits of (x, y, z).
_FACES = np.array(
    [
        *([0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4]),
        *([2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]),
    ]
)


def _box(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    bits = np.array([[(n >> 2) & 1, (n >> 1) & 1, n & 1] for n in range(8)])
    return corners[bits, np.arange(3)], _FACES


def _is_called_bare(function: Any) -> bool:
    """Tell whether a function can be called without arguments, and is not private."""
    if function.__name__.startswith("_"):
        return False
    return all(
        row.default is not row.empty or row.kind in (row.VAR_POSITIONAL, row.VAR_KEYWORD)
        for row in inspect.signature(function).parameters.values()
    )


def split(path: str | Path) -> tuple[Path, str]:
    """Return the file of `file.py:function` and the function's name, empty without one.

    Raises
    ------
    InputError
        `unknown-model`: there is no such file.
    """
    text = str(path)
    place, _, function = (
        text.rpartition(":") if not text.lower().endswith((".py", ".scad")) else (text, "", "")
    )
    if not Path(place).is_file():
        raise InputError(
            "unknown-model", name=text, reason=f"there is no file {Path(place or text).absolute()}"
        )
    return Path(place).resolve(), function
