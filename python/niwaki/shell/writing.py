"""Which files a result becomes: `--format glb,stl,gif`, and the settings of each kind.

The names are `best.` and the format; a moving picture is `growth.gif` or `growth.apng`. Of a result that is picked by
its number they are `run-3.glb`, `run-3.gif`. All settings are checked before
the search starts.
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
from niwaki.shell import picking

MESHES, SOLIDS, ANIMATIONS = ("glb", "obj", "ply"), ("stl", "3mf"), ("gif", "apng")
DRAWINGS = ("svg",)
FORMATS = (*MESHES, *SOLIDS, *ANIMATIONS, *DRAWINGS)
#: What can be written alone: also a picture, and run.json.
ALONE = (*FORMATS, "png", "json")

Formats = Annotated[
    str | None,
    typer.Option(
        "--format",
        metavar="LIST",
        help=f"Which files, with commas: {', '.join(FORMATS)}. Default: glb, for drawings svg.",
    ),
]
Scale = Annotated[
    float | None,
    typer.Option("--scale", metavar="MM", help="stl, 3mf: millimetres for a scene unit. Default: 1000."),
]
Fuse = Annotated[
    float | None,
    typer.Option("--fuse", metavar="GAP", help="stl, 3mf: close gaps up to twice this, scene units."),
]
Frames = Annotated[
    int | None, typer.Option("--frames", metavar="N", help="gif, apng: most frames. Default: 48.")
]
Size = Annotated[
    str | None, typer.Option("--size", metavar="WxH", help="gif, apng: pixels. Default: 480x360.")
]


@dataclass(frozen=True)
class Flags:
    """The flags about files, as they are typed."""

    formats: Formats = None
    scale: Scale = None
    fuse: Fuse = None
    frames: Frames = None
    size: Size = None
    export: picking.Export = None

    @property
    def of_folders(self) -> dict[str, str | None]:
        """Those that say which files a folder gets."""
        return {"format": self.formats, "export": self.export}


def listed(text: str, known: Iterable[str]) -> tuple[str, ...]:
    """The formats of `--format`."""
    chosen = tuple(dict.fromkeys(part.strip().lower().lstrip(".") for part in text.split(",")))
    if not set(chosen) <= set(known):
        raise _refused("--format", repr(text), f"formats among {', '.join(known)}", ",".join([*known][:2]))
    return chosen


@dataclass(frozen=True)
class Files:
    """What to write, checked."""

    formats: tuple[str, ...] = ("glb",)
    scale: float | None = None
    fuse: float | None = None
    frames: int | None = None
    size: tuple[int, int] | None = None
    style: str | None = None

    @classmethod
    def of_flags(cls, flags: Flags, style: str | None = None, alone: Path | None = None) -> Files:
        """The files that the flags select; a setting of any other format is an error.

        The `style` is that of a drawing; None for a scene in space. A file that is written alone has its format.
        """
        formats, scale, fuse, frames = flags.formats, flags.scale, flags.fuse, flags.frames
        if alone is not None and alone.suffix[1:].lower() in FORMATS:
            formats = alone.suffix
        if formats is None:
            formats = "glb" if style is None else "svg"
        chosen = listed(formats, FORMATS)
        if style is None and set(DRAWINGS) & set(chosen):
            raise _refused(
                "--format", repr(formats), "no svg, which is for models that draw in the plane", "glb"
            )
        for flag, given, kinds in (
            ("--scale", scale, SOLIDS),
            ("--fuse", fuse, SOLIDS),
            ("--frames", frames, ANIMATIONS),
            ("--size", flags.size, ANIMATIONS),
        ):
            if given is not None and not set(kinds) & set(chosen):
                other = " or ".join(f"`{kind}`" for kind in kinds) + " in `--format`"
                raise InputError(
                    "flag-alone", flag=flag, other=other, reason="no other format has this setting"
                )
        if scale is not None and not 0.0 < scale < float("inf"):
            raise _refused("--scale", repr(scale), "millimetres above 0", "10, for a centimetre a scene unit")
        if fuse is not None and not 0.0 <= fuse < float("inf"):
            raise _refused("--fuse", repr(fuse), "scene units, 0 or more", "half the gap to close")
        if frames is not None and not 1 <= frames <= 10_000:
            raise _refused("--frames", repr(frames), "a whole number from 1 to 10000", "48")
        if set(SOLIDS) & set(chosen):
            draw.solid.kernel()
        return cls(chosen, scale, fuse, frames, _pixels(flags.size), style)

    @classmethod
    def of_data(cls, data: Mapping[str, Any]) -> Files:
        """The files of `dataclasses.asdict`, read from JSON.

        Raises
        ------
        Unfit
            They are none.
        """
        found: Files = fitted(data, cls)
        # They become parts of names.
        if unknown := [name for name in found.formats if name not in FORMATS]:
            raise Unfit("$.formats", f"formats among {', '.join(FORMATS)}", shown(unknown[0]))
        return found

    def write_one(self, sample: nw.Sample, place: Path) -> Path:
        """Write one file, of the format of its suffix."""
        return self._written(sample, place, place.suffix[1:].lower())

    def names(self, number: int | None = None) -> list[str]:
        """The names of the files: of the best, or of the result of that number."""
        return [self._name(form, number) for form in self.formats]

    def write(self, sample: nw.Sample, folder: Path, number: int | None = None) -> list[Path]:
        """Write each file, moving ones with the target as a ghost; the `number` is as for `names`.

        Where one cannot be written the others are, and then it is an error.
        """
        found, failed = [], None
        for name in self.formats:
            try:
                found.append(self._written(sample, folder / self._name(name, number), name))
            except NiwakiError as error:
                failed = failed or error
        if failed is not None:
            raise failed
        return found

    def _name(self, form: str, number: int | None) -> str:
        if number is not None:
            return f"run-{number}.{form}"
        return f"{'growth' if form in ANIMATIONS else 'best'}.{form}"

    def _written(self, sample: nw.Sample, place: Path, name: str) -> Path:
        if name in ANIMATIONS:
            settings = {"frames": self.frames, "size": self.size, "style": self.style}
            given: dict[str, Any] = {key: value for key, value in settings.items() if value is not None}
            return sample.animate(place, **given)
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
            "--size", repr(text), "a width and a height from 16 to 4096, with x between", "480x360"
        )
    return int(width), int(height)


def _refused(flag: str, found: str, expected: str, suggestion: str) -> InputError:
    return InputError("bad-setting", name=flag, found=found, expected=expected, suggestion=suggestion)
