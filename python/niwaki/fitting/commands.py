"""Programs as generators: a command that writes a mesh file.

    nw.command(["tool", "--w", "{w}", "-o", "{out}.stl"], w=nw.Uniform(20, 80))

The words of the command are a list, and no shell reads them: spaces and quotes in values are plain characters.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from niwaki.errors import FileError, InputError
from niwaki.fitting.generator import Called, Generator, Numbers
from niwaki.search.space import Space
from niwaki.targets import reading
from niwaki.words.distributions import DiscreteUniform, Uniform

#: A name in a word of a command.
NAME = re.compile(r"\{(\w+)\}")

#: The name of the file that the command writes.
OUT = "out"

#: The most characters of a program's output in the text of a failure.
SHOWN = 400


def command(words: Sequence[str], **parameters: Any) -> CommandGenerator:
    """Make a model of a program that writes a mesh file.

    Parameters
    ----------
    words
        The program and its arguments. `{w}` stands for the value of the parameter `w`, and `{out}` for a new file's
        path without a suffix; one word has it, with the suffix of the file: `"{out}.stl"`.
    parameters
        The range of each parameter: `w=nw.Uniform(20, 80)`.

    Raises
    ------
    InputError
        `bad-command`: the words and the parameters do not fit, or there is no such program.
    """
    return CommandGenerator(words, parameters)


class CommandGenerator(Generator):
    """A program that writes a mesh file: see `command`."""

    def __init__(
        self, words: Sequence[str], parameters: Mapping[str, Any], space: Space | None = None
    ) -> None:
        if isinstance(words, str) or not words or not all(isinstance(word, str) for word in words):
            raise _bad(
                "the words are not a list of texts",
                'write `nw.command(["tool", "--w", "{w}", "-o", "{out}.stl"])`',
            )
        self.words = [str(word) for word in words]
        names = {name for word in self.words for name in NAME.findall(word)}
        if OUT not in names:
            raise _bad(
                "no word has `{out}`, the file that the program writes", 'add such a word: "{out}.stl"'
            )
        self.suffix = self._suffix()
        if unknown := sorted(names - set(parameters) - {OUT}):
            raise _bad(f"`{{{unknown[0]}}}` has no range", f"give it one: `{unknown[0]}=nw.Uniform(20, 80)`")
        if unused := sorted(set(parameters) - names):
            raise _bad(
                f"no word has the parameter `{unused[0]}`",
                f"add a word with `{{{unused[0]}}}`, or leave it out",
            )
        self.program = shutil.which(self.words[0]) or ""
        if not self.program:
            raise _bad(f"there is no program `{self.words[0]}`", "install it, or write its whole path")
        self.space = space or Space(parameters)
        self.name = Path(self.words[0]).stem

    def _suffix(self) -> str:
        for word in self.words:
            if match := re.search(r"\{out\}(\.\w+)", word):
                if match[1].lower() in reading.FORMATS:
                    return match[1]
                raise _bad(
                    f"{match[1]} files are not read", f"let it write one of {', '.join(reading.FORMATS)}"
                )
        raise _bad("`{out}` has no suffix, which tells the format", 'write `"{out}.stl"`')

    def call(self, numbers: Numbers) -> Called:
        """Run the program, and read its file; a file without triangles is the empty mesh."""
        with tempfile.TemporaryDirectory(prefix="niwaki-") as folder:
            out = os.path.join(folder, "mesh")
            texts = {name: text_of(value) for name, value in self.values(numbers).items()} | {OUT: out}
            words = [NAME.sub(lambda match: texts.get(match[1], match[0]), word) for word in self.words]
            done = subprocess.run(
                [self.program, *words[1:]],
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                errors="replace",
            )
            if done.returncode:
                raise RuntimeError(
                    f"{self.name} ended with code {done.returncode}: {_end(done.stderr or done.stdout)}"
                )
            place = Path(out + self.suffix)
            if not place.is_file():
                raise RuntimeError(
                    f"{self.name} wrote no file {OUT}{self.suffix}: {_end(done.stderr or done.stdout)}"
                )
            return Called(place.read_bytes() and read(place))

    def identity(self) -> dict[str, str]:
        """Return the words of the command, and the hash of the program."""
        with open(self.program, "rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
        # A script is a word of the command, too.
        files = [Path(word) for word in self.words[1:] if Path(word).is_file()]
        hashes = [hashlib.sha256(place.read_bytes()).hexdigest() for place in files]
        return {
            "the command": " ".join(self.words),
            "the program": digest,
            "the command's files": " ".join(hashes),
        }

    def recipe(self) -> dict[str, Any]:
        """Return the words and the parameters."""
        assert self.space is not None
        return {"kind": "command", "words": self.words, "levels": levels(self.space)}

    @classmethod
    def of_recipe(cls, recipe: Mapping[str, Any]) -> CommandGenerator:
        """Make it again."""
        return cls(recipe["words"], recipe["levels"], space_of_levels(recipe["levels"]))


def read(place: Path) -> Any:
    """Read a mesh file; None for one without triangles."""
    try:
        return reading.load(place)
    except FileError as error:
        if error.code == "target-empty":
            return None
        raise


def levels(space: Space) -> dict[str, Any]:
    """Return the parameters as plain data: the texts of the values of a choice; an empty list for a number."""
    return {
        axis.name: [list(map(_plain, axis.values)), axis.kind] if axis.kind == "choice" else [[], axis.kind]
        for axis in space.axes
    }


def space_of_levels(table: Mapping[str, Any]) -> Space:
    """Return a space that turns plain numbers into values; its ranges mean nothing."""
    kinds: dict[str, Any] = {"real": Uniform(0.0, 1.0), "whole": DiscreteUniform(0, 1)}
    return Space(
        {name: values if kind == "choice" else kinds[kind] for name, (values, kind) in table.items()}
    )


def text_of(value: Any) -> str:
    """Return a value as a word of a command: all digits of a number, `true` or `false` for a switch."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, int | float) else str(value)


def _plain(value: Any) -> Any:
    return value if isinstance(value, bool | int | float | str) else str(value)


def _end(text: str) -> str:
    """Return the end of a program's output in one line."""
    line = " ".join(text.split())
    return ("... " + line[-SHOWN:] if len(line) > SHOWN else line) or "it printed nothing"


def _bad(reason: str, cure: str) -> InputError:
    return InputError("bad-command", reason=reason, cure=cure)
