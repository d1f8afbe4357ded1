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
from niwaki.shell import folders, writing
from niwaki.shell.app import Seed, Threads, app
from niwaki.shell.progress import said

#: What can be written, and the names in a folder.
FORMATS = {"png": "word.png", "svg": "word.svg", "gif": "growth.gif"}


@app.command()
def letters(
    text: Annotated[str, typer.Argument(metavar="TEXT", help="What to write.")],
    output: folders.Output = None,
    force: folders.Force = False,
    formats: Annotated[
        str, typer.Option("--format", metavar="LIST", help="Which files, with commas: png, svg, gif.")
    ] = ",".join(FORMATS),
    style: Annotated[
        str, typer.Option("--style", metavar="|".join(STYLES), help="The model that writes.")
    ] = STYLES[0],
    seed: Seed = None,
    particles: Annotated[int, typer.Option("--particles", metavar="N", help="Of a population.")] = PARTICLES,
    searches: Annotated[
        int, typer.Option("--searches", metavar="N", help="How many for each letter; the best is kept.")
    ] = SEARCHES,
    font: Annotated[
        str | None, typer.Option("--font", metavar="FILE", help="A TrueType or OpenType file.")
    ] = None,
    width: Annotated[
        int,
        typer.Option("--width", metavar="N", help="Pixels of the picture; the animation has half."),
    ] = 1600,
    threads: Threads = None,
) -> None:
    """Write TEXT in vines or lightning; writes word.png, word.svg and growth.gif."""
    count("--width", width, most=LARGEST)
    seed = search.fresh(seed)
    start = time.perf_counter()
    alone = folders.one_file(output, tuple(FORMATS), force)
    chosen = writing.listed(alone.suffix if alone else formats, FORMATS)
    with folders.own_folder(output, force) if alone is None else nullcontext() as folder:
        with said(f"writing {text}", keeps=False) as show:
            word = words.write(
                text,
                style,
                seed=seed,
                particles=particles,
                searches=searches,
                font=font,
                threads=threads,
                progress=lambda done, wanted: show(f"{done} of {wanted} searches"),
            )
        seconds = time.perf_counter() - start
        files = [_written(word, alone or Path(folder or "", FORMATS[one]), width) for one in chosen]
    print("  ".join(f"{one.letter.character} {one.similarity:.2f}" for one in word.letters))
    names = ", ".join(file.name for file in files)
    print(f"{len(word.letters)} letters in {seconds:.1f} s, seed {seed}; {names} in {files[0].parent}")


def _written(word: Word, place: Path, width: int) -> Path:
    """Write a file, as its suffix says."""
    return (
        word.animate(place, width=max(1, width // 2)) if place.suffix == ".gif" else word.save(place, width)
    )
