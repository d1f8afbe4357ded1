"""OpenSCAD files as generators: parameters by their Customizer, evaluated by a library or by the program.

The library `openscad-evaluator` evaluates in the worker process; without it, the program `openscad` runs for each
evaluation. The library is none of the package's extras, because it needs a package under the LGPL. OpenSCAD's z is up,
and so is the mesh's.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki.errors import InputError
from niwaki.fitting.commands import SHOWN, levels, read, space_of_levels, text_of
from niwaki.fitting.customizer import slots, written
from niwaki.fitting.generator import Called, Generator, Numbers
from niwaki.inputs import text_of as file_text
from niwaki.search.space import Space

#: The library and the program that evaluate a file.
LIBRARY, PROGRAM = "openscad_evaluator", "openscad"


def scad(path: str | PathLike[str], **ranges: Any) -> ScadGenerator:
    """Make a model of an OpenSCAD file; its parameters are those of its Customizer.

    Parameters
    ----------
    path
        The file.
    ranges
        Ranges of parameters in place of those of the Customizer: `width=nw.Uniform(20, 80)`. A parameter of the file
        whose value is no distribution and no list keeps this value: `holes=4`.

    Raises
    ------
    InputError
        `no-ranges`: the file has no parameters; `bad-setting`: a name is none of the file's; `no-openscad`: neither the
        library nor the program is there.
    FileError
        The file cannot be read.
    """
    return ScadGenerator(Path(path), ranges)


class ScadGenerator(Generator):
    """An OpenSCAD file: see `scad`."""

    def __init__(self, path: Path, ranges: Mapping[str, Any], space: Space | None = None) -> None:
        self.path, self.name = path.resolve(), path.stem
        self.text = file_text(path, "model", ".scad")
        rows = {row.name: row for row in slots(self.text)}
        if unknown := sorted(set(ranges) - set(rows)):
            raise InputError(
                "bad-setting",
                name=unknown[0],
                found="a range",
                expected=f"a parameter of {path.name}: {', '.join(rows) or 'it has none'}",
                suggestion="one of these names",
            )
        self.lines = {name: row.line for name, row in rows.items()}
        parameters, self.kept = {}, dict[str, str]()
        for name, row in rows.items():
            range_ = ranges.get(name, row.range)
            if isinstance(range_, bool | int | float | str):
                self.kept[name] = _literal(range_)
            elif range_ is not None:
                parameters[name] = range_
        if not parameters and space is None:
            raise InputError(
                "no-ranges",
                name=path.name,
                reason="the file has no parameters of a Customizer: assignments of numbers at its beginning",
                cure="write them there with their ranges: `width = 40; // [20:80]`",
            )
        self.space = space or Space(parameters)
        self.program = None if find_spec(LIBRARY) else shutil.which(PROGRAM)
        if self.program is None and find_spec(LIBRARY) is None:
            raise InputError("no-openscad", name=path.name)

    def call(self, numbers: Numbers) -> Called:
        """Evaluate the file with other values in its assignments."""
        texts = self.kept | {name: _literal(value) for name, value in self.values(numbers).items()}
        source = written(self.text, {name: (self.lines[name], text) for name, text in texts.items()})
        return Called(_evaluated(source) if self.program is None else self._by_program(source))

    def _by_program(self, source: str) -> Any:
        assert self.program is not None
        with program_output(self.program, source, self.path.parent, "mesh.stl") as (place, done, errors):
            if "is empty" in done.stderr and not errors:
                return None
            if done.returncode or not place.is_file():
                shown = errors[:SHOWN] or done.stderr[-SHOWN:].strip()
                raise RuntimeError(f"openscad ended with code {done.returncode}: {shown}")
            return read(place)

    def identity(self) -> dict[str, str]:
        """Return the hash of the file, and what evaluates it."""
        return {
            "the model": self.path.name,
            "the model's file": hashlib.sha256(self.text.encode()).hexdigest(),
            "the values that it keeps": repr(sorted(self.kept.items())),
            "the evaluator": LIBRARY if self.program is None else PROGRAM,
        }

    def recipe(self) -> dict[str, Any]:
        """Return the path, the parameters, and the values that others keep."""
        assert self.space is not None
        return {"kind": "scad", "path": str(self.path), "kept": self.kept, "levels": levels(self.space)}

    @classmethod
    def of_recipe(cls, recipe: Mapping[str, Any]) -> ScadGenerator:
        """Make it again, in its folder, from which it includes other files."""
        generator = cls(Path(recipe["path"]), {}, space_of_levels(recipe["levels"]))
        generator.kept = dict(recipe["kept"])
        os.chdir(generator.path.parent)
        return generator


@contextmanager
def program_output(
    program: str, source: str, folder: Path, name: str
) -> Iterator[tuple[Path, subprocess.CompletedProcess[str], str]]:
    """Run the program on a source; files that it includes or imports are found in a folder.

    Yields the place of its output, whose format the name's suffix tells, how the program ended, and its errors. After
    an error it reports an empty object, too.
    """
    with (
        tempfile.NamedTemporaryFile("w", suffix=".scad", dir=folder, prefix=".niwaki-") as file,
        tempfile.TemporaryDirectory(prefix="niwaki-") as outputs,
    ):
        file.write(source)
        file.flush()
        place = Path(outputs, name)
        command = [program, "-o", str(place), file.name]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        errors = "; ".join(line for line in done.stderr.splitlines() if line.startswith("ERROR"))
        yield place, done, errors


def _literal(value: Any) -> str:
    """Return a value as OpenSCAD writes it."""
    return json.dumps(value) if isinstance(value, str) else text_of(value)


def _evaluated(source: str) -> Any:
    """Evaluate a source by the library: the union of its bodies, as a manifold; None for an empty one."""
    evaluator, parser, manifold3d = map(import_module, (LIBRARY, "openscad_lalr_parser", "manifold3d"))
    nodes = parser.getASTfromString(source)
    bodies, _ = evaluator.Evaluator().evaluate(nodes, parser.build_scopes(nodes))
    solids = [body.body for body in bodies if body.body is not None]
    return manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add) if solids else None
