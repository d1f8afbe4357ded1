"""Blender files as generators: the sockets of a Geometry Nodes modifier are the parameters.

Blender runs as a worker process, and opens the file once (`in_blender/serve.py`); it is no part of the package. A
Python that has `bpy`, Blender as a module, does as well as the program.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable, Mapping
from importlib.util import find_spec
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from niwaki.errors import InputError
from niwaki.errors.settings import bad
from niwaki.errors.warned import warn
from niwaki.fitting.generator import Called, Generator, Numbers
from niwaki.fitting.in_blender.sockets import Socket
from niwaki.fitting.node_ranges import given_range, kept_value, parameters_of, usual_range
from niwaki.fitting.protocol import read_answer
from niwaki.inputs import regular
from niwaki.search.space import Parameter, Space
from niwaki.search.warnings import SearchWarning
from niwaki.words.distributions import Distribution

#: The variable that names Blender, and where it may lie beside the search path.
VARIABLE = "NIWAKI_BLENDER"
PLACES = ("/Applications/Blender.app/Contents/MacOS/Blender",)

#: The script of a worker process.
SCRIPT = Path(__file__).with_name("in_blender") / "serve.py"

#: Seconds for Blender's start and the file.
SECONDS = 300.0

#: The most characters of Blender's output in an error.
SHOWN = 400


def blend(
    path: str | PathLike[str],
    object: str | None = None,
    modifier: str | None = None,
    *,
    hold: Iterable[str] | Mapping[str, Any] = (),
    up: str = "z",
    blender: str | PathLike[str] | None = None,
    **ranges: Any,
) -> BlendGenerator:
    """Make a model of a Blender file; its parameters are the sockets of a Geometry Nodes modifier.

    Floats, whole numbers, switches and menus are parameters, and each component of a vector: `Size.x`. A number
    without limits goes from half of its value to twice it. A socket behind a switch is used only while the switch
    lets it through. The mesh is what Blender shows of the object, with all of its modifiers and instances.

    Parameters
    ----------
    path
        The file.
    object, modifier
        Their names in the file. Default: the only ones that there are.
    hold
        Sockets that keep the values of the file: their names; or values by name.
    up
        "z": coordinates as in Blender, and in the STL files that it writes; "y": as in its glTF and OBJ files.
    blender
        The program `blender`, or a Python that has the package `bpy`. Default: the environment variable
        `NIWAKI_BLENDER`, the program on the search path, then `bpy` in this Python.
    ranges
        Ranges of sockets in place of their limits: `width=nw.Uniform(0.3, 0.6)`. Capitals do not matter, and `_` stands
        for every other character. A value that is no distribution and no list is held.

    Raises
    ------
    InputError
        `no-blender`: Blender is not here; `bad-node-tree`: the object or the modifier cannot be fitted;
        `blender-failed`: Blender does not open the file; `no-ranges`: no socket is left to search; `bad-setting`: a
        name is none of the modifier's.
    FileError
        The file cannot be read.

    Warns
    -----
    SearchWarning
        Drivers or scripts of the file did not run.
    """
    if up not in ("y", "z"):
        raise bad("up", up, '"y" or "z"', '"z"')
    held = (
        dict(hold) if isinstance(hold, Mapping) else dict.fromkeys([hold] if isinstance(hold, str) else hold)
    )
    return BlendGenerator(Path(path), object, modifier, held, ranges, up, find_blender(path, blender))


def find_blender(path: str | PathLike[str], blender: str | PathLike[str] | None = None) -> list[str]:
    """Return the words that run Blender on the script of a worker.

    Raises
    ------
    InputError
        `no-blender`.
    """
    name = os.fspath(blender) if blender is not None else os.environ.get(VARIABLE, "")
    if name:
        program = shutil.which(name)
        if program is None:
            raise InputError("no-blender", name=Path(path).name, reason=f"there is no program `{name}`")
    else:
        program = shutil.which("blender") or next(filter(os.path.exists, PLACES), None)
        if program is None and find_spec("bpy") is not None:
            program = sys.executable
    if program is None:
        raise InputError(
            "no-blender",
            name=Path(path).name,
            reason=f"`blender` is not on the search path, {VARIABLE} does not name it, and this Python has no `bpy`",
        )
    if Path(program).stem.lower().startswith("python"):
        return [program, "-I", str(SCRIPT)]
    return [program, "--background", "--factory-startup", "--python", str(SCRIPT)]


class BlendGenerator(Generator):
    """A Geometry Nodes modifier of a Blender file: see `blend`.

    Attributes
    ----------
    sockets : list of Socket
        All sockets of the modifier.
    """

    def __init__(
        self,
        path: Path,
        object: str | None,
        modifier: str | None,
        held: Mapping[str, Any],
        ranges: Mapping[str, Any],
        up: str,
        program: list[str],
    ) -> None:
        self.path, self.up, self._program = path.resolve(), up, program
        self._hash = _sha256(regular(path))
        self.object, self.modifier = object, modifier
        self.sockets: list[Socket] = []
        self.kept: dict[str, Any] = {}
        self.space = None
        head, _ = self._reply({})
        if "reason" in head:
            raise InputError("bad-node-tree", name=path.name, reason=head["reason"], cure=head["cure"])
        if "unloadable" in head:
            raise InputError("blender-failed", name=path.name, reason=head["unloadable"])
        self.object, self.modifier, self.version = head["object"], head["modifier"], head["blender"]
        self.name = f"{path.stem}-{self.object}"
        if head.get("blocked"):
            warn(
                f"`{path.name}` has code that did not run: {head['blocked']}. What it computes keeps its values of the "
                "file",
                SearchWarning,
            )
        self._libraries = [place for place in head["libraries"] if Path(place).is_file()]
        self.sockets = [Socket(**row) for row in head["sockets"]]
        values = {}
        for name, value in {**held, **ranges}.items():
            row = self._named(name)
            values[row.name] = row.value if name in held and value is None else value
        self.space = Space(self._space(values))

    def _named(self, name: str) -> Socket:
        """Return a socket by the name that a person writes."""
        for row in self.sockets:
            if row.name == name:
                return row
        rows = [row for row in self.sockets if _plain(row.name) == _plain(name)]
        if len(rows) != 1:
            listed = ", ".join(row.name for row in self.sockets) or "it has none"
            raise InputError(
                "bad-setting",
                name=name,
                found="a range or a value",
                expected=f"a socket of `{self.modifier}`: {listed}",
                suggestion="one of these names",
            )
        return rows[0]

    def _space(self, values: Mapping[str, Any]) -> dict[str, Parameter]:
        """Return the parameters: the sockets that the tree uses, with the ranges that a person gives to some."""
        ranges: dict[str, Any] = {}
        for row in self.sockets:
            range_ = values.get(row.name, usual_range(row) if row.is_used else None)
            if isinstance(range_, Distribution | Parameter | list | tuple | range):
                ranges[row.name] = given_range(row, range_)
            elif row.name in values:
                self.kept[row.key] = kept_value(row, range_)
        parameters = parameters_of(self.sockets, ranges, self.kept)
        if not parameters:
            cure = "link a socket of the group's input to what makes the mesh, or hold fewer of them"
            raise InputError("no-ranges", name=self.path.name, reason=self._lack(), cure=cure)
        return parameters

    def _lack(self) -> str:
        if not self.sockets:
            return f"the modifier `{self.modifier}` has no number, switch or menu"
        if not any(row.is_used for row in self.sockets):
            return f"the mesh of `{self.modifier}` depends on none of its sockets"
        return f"all sockets of `{self.modifier}` are held"

    def call(self, numbers: Numbers) -> Called:
        """Open the file in Blender for this call alone; a search has worker processes that keep it open."""
        head, body = self._reply(numbers)
        if "failed" in head or "unloadable" in head:
            raise RuntimeError(head.get("failed") or head["unloadable"])
        cut = 24 * head["vertices"]
        vertices, faces = np.frombuffer(body[:cut], "<f8"), np.frombuffer(body[cut:], "<i8")
        return Called((vertices.reshape(-1, 3), faces.reshape(-1, 3)))

    def _reply(self, numbers: Numbers) -> tuple[dict[str, Any], bytes]:
        """Have Blender open the file, describe the modifier, and make the mesh of a point."""
        recipe = {**self.recipe(), "describe": dict(numbers)}
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        try:
            done = subprocess.run(
                self._program,
                input=json.dumps(recipe).encode() + b"\n",
                capture_output=True,
                env=environment,
                timeout=SECONDS,
            )
        except subprocess.TimeoutExpired:
            reason = f"it did not answer in {SECONDS:.0f} s"
            raise InputError("blender-failed", name=self.path.name, reason=reason) from None
        except OSError as error:
            raise InputError("blender-failed", name=self.path.name, reason=str(error)) from None
        answer = read_answer(io.BytesIO(done.stdout))
        if answer is None:
            shown = " ".join((done.stderr or done.stdout).decode(errors="replace").split())[-SHOWN:]
            reason = f"it ended with code {done.returncode}: {shown or 'it printed nothing'}"
            raise InputError("blender-failed", name=self.path.name, reason=reason)
        return answer

    def identity(self) -> dict[str, str]:
        """Return the hashes of the file and of what it links, the modifier, and the version of Blender."""
        hashes = [_sha256(Path(place)) for place in self._libraries]
        return {
            "the model": f"{self.path.name}, {self.object}, {self.modifier}",
            "the model's file": self._hash,
            "the files that it links": " ".join(hashes),
            "the values that it keeps": repr(sorted(self.kept.items())),
            "the axis that is up": self.up,
            "the version of Blender": self.version,
        }

    def recipe(self) -> dict[str, Any]:
        """Return the file, the modifier, and the sockets of the parameters."""
        parameters = {}
        keys = {row.name: row.key for row in self.sockets}
        for axis in () if self.space is None else self.space.axes:
            values = list(axis.values) if axis.kind == "choice" else []
            parameters[axis.name] = {"key": keys[axis.name], "values": values}
        return {
            "kind": "blend",
            "path": str(self.path),
            "object": self.object,
            "modifier": self.modifier,
            "up": self.up,
            "kept": self.kept,
            "parameters": parameters,
        }

    def worker_command(self) -> list[str]:
        """Return the words that run Blender on the script of a worker."""
        return self._program


def _plain(name: str) -> str:
    """Return a name as a person can write it in Python."""
    return re.sub(r"[^0-9a-z]+", "_", name.casefold()).strip("_")


def _sha256(place: Path) -> str:
    with place.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
