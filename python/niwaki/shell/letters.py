"""`niwaki letters`: a text in vines or lightning, written to a folder."""

from __future__ import annotations

import time
from contextlib import nullcontext
from pathlib import Path
from typing import Annotated

import typer

from niwaki import letters as words
from niwaki import search
from niwaki.draw.limits import LARGEST
from niwaki.errors.settings import count
from niwaki.letters.word import PARTICLES, SEARCHES, STYLES, Word
from niwaki.shell import folders, formats
from niwaki.shell.app import Seed, Threads, app
from niwaki.shell.progress import status_line

#: The formats, and the names of their files in a folder.
FORMATS = {"png": "word.png", "svg": "word.svg", "gif": "growth.gif"}


@app.command()
def letters(
    text: Annotated[str, typer.Argument(metavar="TEXT", help="The text to write.")],
    output: folders.Output = None,
    force: folders.Force = False,
    file_formats: Annotated[
        str, typer.Option("--format", metavar="LIST", help="Formats, with commas: png, svg, gif.")
    ] = ",".join(FORMATS),
    style: Annotated[
        str, typer.Option("--style", metavar="|".join(STYLES), help="The model that draws the letters.")
    ] = STYLES[0],
    seed: Seed = None,
    particles: Annotated[
        int, typer.Option("--particles", metavar="N", help="Number of particles of a population.")
    ] = PARTICLES,
    searches: Annotated[
        int,
        typer.Option(
            "--searches", metavar="N", help="Number of searches for each letter; the best result stays."
        ),
    ] = SEARCHES,
    font: Annotated[
        str | None, typer.Option("--font", metavar="FILE", help="A TrueType or OpenType file.")
    ] = None,
    width: Annotated[
        int,
        typer.Option(
            "--width", metavar="N", help="Width of the picture in pixels; the animation has half of it."
        ),
    ] = 1600,
    threads: Threads = None,
) -> None:
    """Write TEXT in vines or lightning. Writes word.png, word.svg and growth.gif."""
    count("--width", width, most=LARGEST)
    seed = search.fresh(seed)
    start = time.perf_counter()
    single_file = folders.one_file(output, tuple(FORMATS), force)
    selected = formats.parse(single_file.suffix if single_file else file_formats, FORMATS)
    with folders.own_folder(output, force) if single_file is None else nullcontext() as folder:
        with status_line(f"writing {text}", keeps_best=False) as show:
            word = words.write(
                text,
                style,
                seed=seed,
                particles=particles,
                searches=searches,
                font=font,
                threads=threads,
                progress=lambda done, total: show(f"{done} of {total} searches"),
            )
        searched = time.perf_counter()
        files = [_write(word, single_file or Path(folder or "", FORMATS[name]), width) for name in selected]
    print("  ".join(f"{grown.letter.character} {grown.similarity:.2f}" for grown in word.letters))
    names = ", ".join(file.name for file in files)
    drawn = time.perf_counter() - searched
    print(
        f"{len(word.letters)} letters in {searched - start:.1f} s, pictures in {drawn:.1f} s, seed {seed}; {names} in "
        f"{files[0].parent}"
    )


def _write(word: Word, place: Path, width: int) -> Path:
    """Write a file in the format of its suffix."""
    return (
        word.animate(place, width=max(1, width // 2)) if place.suffix == ".gif" else word.save(place, width)
    )
