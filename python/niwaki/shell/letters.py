"""`niwaki letters`: a text in vines or lightning, written to a folder."""

from __future__ import annotations

import time
from typing import Annotated

import typer

from niwaki import letters as writing
from niwaki import search
from niwaki.draw.limits import LARGEST
from niwaki.errors.settings import count
from niwaki.letters.word import PARTICLES, STYLES, TRIES
from niwaki.shell import folders
from niwaki.shell.app import Folder, app
from niwaki.shell.progress import said


@app.command()
def letters(
    text: Annotated[str, typer.Argument(metavar="TEXT", help="What to write.")],
    output: Folder = None,
    force: folders.Force = False,
    style: Annotated[str, typer.Option("--style", help=f"{' or '.join(STYLES)}.")] = STYLES[0],
    seed: Annotated[int | None, typer.Option(help="Default: a new one, which is printed.")] = None,
    particles: Annotated[int, typer.Option("-n", "--particles", help="Of each search.")] = PARTICLES,
    tries: Annotated[
        int, typer.Option("--tries", help="Searches for each letter; the best is kept.")
    ] = TRIES,
    font: Annotated[
        str | None, typer.Option("--font", metavar="FILE", help="A TrueType or OpenType file.")
    ] = None,
    width: Annotated[
        int, typer.Option("--width", help="Pixels of the picture; the animation has half.")
    ] = 1600,
    moving: Annotated[bool, typer.Option("--gif/--no-gif", help="Write growth.gif.")] = True,
    threads: Annotated[
        int | None, typer.Option(help="Default: all cores. Results do not depend on it.")
    ] = None,
) -> None:
    """Write TEXT in vines or lightning; writes word.png, word.svg and growth.gif."""
    count("--width", width, most=LARGEST)
    seed = search.fresh(seed)
    start = time.perf_counter()
    with folders.own_folder(output, force) as folder:
        with said(f"writing {text}", keeps=False) as show:
            word = writing.write(
                text,
                style,
                seed=seed,
                particles=particles,
                tries=tries,
                font=font,
                threads=threads,
                progress=lambda done, wanted: show(f"{done} of {wanted} searches"),
            )
        seconds = time.perf_counter() - start
        files = [word.save(folder / "word.png", width), word.save(folder / "word.svg")]
        if moving:
            files.append(word.animate(folder / "growth.gif", width=max(1, width // 2)))
    print("  ".join(f"{one.letter.character} {one.similarity:.2f}" for one in word.letters))
    names = ", ".join(file.name for file in files)
    print(f"{len(word.letters)} letters in {seconds:.1f} s, seed {seed}; {names} in {folder}")
