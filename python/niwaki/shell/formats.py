"""The formats in which a result is written: `--format glb,stl,gif`, and the settings of each format.

Files of the best result have the names `best.` and the format, and an animation is `growth.gif` or `growth.apng`. Files
of a result by its number are `run-3.glb`, `run-3.gif`. All settings are checked before the search starts.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

import niwaki as nw
from niwaki import draw
from niwaki.errors import InputError, NiwakiError
from niwaki.errors.schema import Unfit, fitted, shown
from niwaki.shell import selection

MESHES, SOLIDS, ANIMATIONS = ("glb", "obj", "ply"), ("stl", "3mf"), ("gif", "apng")
DRAWINGS = ("svg",)
FORMATS = (*MESHES, *SOLIDS, *ANIMATIONS, *DRAWINGS)
#: Suffixes of files that can be written without a folder: also a picture, and run.json.
SINGLE_FILES = (*FORMATS, "png", "json")

Formats = Annotated[
    str | None,
    typer.Option(
        "--format",
        metavar="LIST",
        help=f"Formats, with commas: {', '.join(FORMATS)}. Default: glb, for drawings svg.",
    ),
]
Scale = Annotated[
    float | None,
    typer.Option("--scale", metavar="MM", help="stl, 3mf: millimetres of a scene unit. Default: 1000."),
]
Fuse = Annotated[
    float | None,
    typer.Option("--fuse", metavar="GAP", help="stl, 3mf: close gaps up to twice this, in scene units."),
]
Frames = Annotated[
    int | None,
    typer.Option("--frames", metavar="N", help="gif, apng: maximum number of frames. Default: 48."),
]
Size = Annotated[
    str | None, typer.Option("--size", metavar="WxH", help="gif, apng: size in pixels. Default: 480x360.")
]


@dataclass(frozen=True)
class Flags:
    """Flags about files."""

    formats: Formats = None
    scale: Scale = None
    fuse: Fuse = None
    frames: Frames = None
    size: Size = None
    export: selection.Export = None

    @property
    def of_folders(self) -> dict[str, str | None]:
        """The flags that select the files in a folder."""
        return {"format": self.formats, "export": self.export}


def parse(text: str, allowed: Iterable[str]) -> tuple[str, ...]:
    """Read the formats of `--format`."""
    formats = tuple(dict.fromkeys(part.strip().lower().lstrip(".") for part in text.split(",")))
    if not set(formats) <= set(allowed):
        raise _refused(
            "--format", repr(text), f"formats among {', '.join(allowed)}", ",".join([*allowed][:2])
        )
    return formats


@dataclass(frozen=True)
class Files:
    """The formats of the files to write, with their settings, checked."""

    formats: tuple[str, ...] = ("glb",)
    scale: float | None = None
    fuse: float | None = None
    frames: int | None = None
    size: tuple[int, int] | None = None
    style: str | None = None

    @classmethod
    def of_flags(cls, flags: Flags, style: str | None = None, single_file: Path | None = None) -> Files:
        """Return the files that the flags select; a setting without its format is an error.

        `style` is the drawing style, None for a scene in space. The suffix of a single file is its format.
        """
        formats, scale, fuse, frames = flags.formats, flags.scale, flags.fuse, flags.frames
        if single_file is not None and single_file.suffix[1:].lower() in FORMATS:
            formats = single_file.suffix
        if formats is None:
            formats = "glb" if style is None else "svg"
        selected = parse(formats, FORMATS)
        if style is None and set(DRAWINGS) & set(selected):
            raise _refused(
                "--format",
                repr(formats),
                "formats for a scene in space; svg is for models that draw in the plane",
                "glb",
            )
        for flag, value, kinds in (
            ("--scale", scale, SOLIDS),
            ("--fuse", fuse, SOLIDS),
            ("--frames", frames, ANIMATIONS),
            ("--size", flags.size, ANIMATIONS),
        ):
            if value is not None and not set(kinds) & set(selected):
                other = " or ".join(f"`{kind}`" for kind in kinds) + " in `--format`"
                raise InputError(
                    "flag-alone", flag=flag, other=other, reason="this setting is for those formats only"
                )
        if scale is not None and not 0.0 < scale < float("inf"):
            raise _refused(
                "--scale", repr(scale), "millimetres above 0", "10, if a scene unit is a centimetre"
            )
        if fuse is not None and not 0.0 <= fuse < float("inf"):
            raise _refused("--fuse", repr(fuse), "scene units, 0 or more", "half the gap to close")
        if frames is not None and not 1 <= frames <= 10_000:
            raise _refused("--frames", repr(frames), "a whole number from 1 to 10000", "48")
        if set(SOLIDS) & set(selected):
            draw.solid.kernel()
        return cls(selected, scale, fuse, frames, _pixels(flags.size), style)

    @classmethod
    def of_data(cls, data: Mapping[str, Any]) -> Files:
        """Read the files from the data of `dataclasses.asdict`.

        Raises
        ------
        Unfit
            The data has another form, or unknown formats.
        """
        files: Files = fitted(data, cls)
        # Formats become parts of file names.
        if unknown := [name for name in files.formats if name not in FORMATS]:
            raise Unfit("$.formats", f"formats among {', '.join(FORMATS)}", shown(unknown[0]))
        return files

    def write_one(self, sample: nw.Sample, place: Path) -> Path:
        """Write one file, in the format of its suffix."""
        return self._write(sample, place, place.suffix[1:].lower())

    def names(self, number: int | None = None) -> list[str]:
        """Return the names of the files of the best result, or of the result with this number."""
        return [self._name(form, number) for form in self.formats]

    def write(self, sample: nw.Sample, folder: Path, number: int | None = None) -> list[Path]:
        """Write each file; animations show the target as a ghost. `number` selects names as in `names`.

        If a file cannot be written, the error comes after all other files.
        """
        files, first_error = [], None
        for name in self.formats:
            try:
                files.append(self._write(sample, folder / self._name(name, number), name))
            except NiwakiError as error:
                first_error = first_error or error
        if first_error is not None:
            raise first_error
        return files

    def _name(self, form: str, number: int | None) -> str:
        if number is not None:
            return f"run-{number}.{form}"
        return f"{'growth' if form in ANIMATIONS else 'best'}.{form}"

    def _write(self, sample: nw.Sample, place: Path, name: str) -> Path:
        if name in ANIMATIONS:
            settings = {"frames": self.frames, "size": self.size, "style": self.style}
            options: dict[str, Any] = {key: value for key, value in settings.items() if value is not None}
            return sample.animate(place, **options)
        if name in SOLIDS:
            return sample.export(place, scale=self.scale, fuse=self.fuse)
        return sample.export(place, style=self.style if name in DRAWINGS else None)


def _pixels(text: str | None) -> tuple[int, int] | None:
    if text is None:
        return None
    width, _, height = text.partition("x")
    if not (
        width.isdecimal() and height.isdecimal() and 16 <= int(width) <= 4096 and 16 <= int(height) <= 4096
    ):
        raise _refused(
            "--size", repr(text), "a width and a height from 16 to 4096 with an x between them", "480x360"
        )
    return int(width), int(height)


def _refused(flag: str, value: str, expected: str, suggestion: str) -> InputError:
    return InputError("bad-setting", name=flag, found=value, expected=expected, suggestion=suggestion)
