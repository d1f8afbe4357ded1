"""Write the pages of the reference that come from the package: a page for each name, and one for each gallery model.

    python docs/running/reference.py docs/made

The names are those that the packages list; Sphinx's autodoc makes their pages from the docstrings. A gallery model's
page has its source, what it makes, and what a quick search finds of it, drawn at this moment.
"""

from __future__ import annotations

import importlib
import inspect
import os
import sys
import warnings
from pathlib import Path

import niwaki as nw
from niwaki import draw
from niwaki.errors import NiwakiError
from niwaki.gallery import Entry, entries

#: The packages with public names, and what they are, in the order of the reference.
PACKAGES = {
    "niwaki": "What most models and scripts need",
    "niwaki.words": "What a model may use besides",
    "niwaki.methods": "Methods and their settings",
    "niwaki.kernels": "Kernels of Markov chains",
    "niwaki.targets": "What a scene should match",
    "niwaki.result": "Results and diagnostics",
    "niwaki.search": "Searches as values",
    "niwaki.batches": "Many searches",
    "niwaki.guides": "Guides",
    "niwaki.draw": "Pictures and files",
    "niwaki.stacks": "Structures of blocks",
    "niwaki.color": "Colours for drawings",
    "niwaki.letters": "Words that grow",
    "niwaki.notebook": "Results in notebooks",
    "niwaki.studio": "The studio from a script",
    "niwaki.errors": "Errors",
}

#: Rounds of the search for a picture: seconds, not the best.
ROUNDS = 2

PAGE = """---
orphan: true
---
# {title}

```{{eval-rst}}
.. {directive}:: {place}
```
"""


def reference(folder: Path) -> None:
    """Write `reference.md`, which lists all names, and a page for each name, where it is first listed.

    The pages are in no table of contents: five hundred entries beside each page would take longer than the pages.
    """
    seen: set[int] = set()
    lines = [
        "# Every name\n",
        "Each name has a page: what it does, its settings with their units, what it raises.\n",
    ]
    (folder / "names").mkdir(exist_ok=True)
    for package, title in PACKAGES.items():
        module = nw.kernels if package == "niwaki.kernels" else importlib.import_module(package)
        lines.append(f"## {title}: `{module.__name__}`\n")
        for name in sorted(
            getattr(module, "__all__", None) or [key for key in vars(module) if key[0] != "_"]
        ):
            value = getattr(module, name)
            ours = getattr(value, "__module__", None) or ""
            if id(value) in seen or not callable(value) or not ours.startswith("niwaki"):
                continue
            seen.add(id(value))
            place = f"{module.__name__}.{name}"
            directive = "autoclass" if inspect.isclass(value) else "autofunction"
            (folder / "names" / f"{place}.md").write_text(
                PAGE.format(title=name, directive=directive, place=place), encoding="utf-8"
            )
            first = (inspect.getdoc(value) or "").partition("\n")[0]
            lines.append(f"- [{name}](names/{place}.md): {first}")
        lines.append("")
    (folder / "reference.md").write_text("\n".join(lines), encoding="utf-8")


def gallery(folder: Path) -> None:
    """Write a page and a picture for each model of the gallery."""
    place = folder / "gallery"
    place.mkdir(exist_ok=True)
    texts = {entry.name: page(entry, place) for entry in entries()}
    for name, text in texts.items():
        (place / f"{name}.md").write_text(text, encoding="utf-8")
    toc = "\n".join(sorted(texts))
    head = "# Models, grown today\n\nEach page is made when the manual is built."
    text = f"{head}\n\n```{{toctree}}\n:maxdepth: 1\n\n{toc}\n```\n"
    (place / "index.md").write_text(text, encoding="utf-8")


def page(entry: Entry, folder: Path) -> str:
    """The page of a model; its picture is drawn into the folder."""
    source = Path(inspect.getsourcefile(sys.modules[entry_module(entry)]) or "")
    path = os.path.relpath(source, folder)
    command = (
        f"niwaki grow {entry.name}"
        if entry.target_name or entry.drawing_name
        else f"niwaki sample {entry.name}"
    )
    text = f"# {entry.name}\n\n{entry.title[0].upper()}{entry.title[1:]}.\n\n"
    result = grown(entry)
    if result is not None and result.best.primitives:
        style = {} if entry.draws is None else {"style": entry.draws}
        result.best.save(folder / f"{entry.name}.png", size=(720, 480), samples=4, **style)
        text += (
            f"![{entry.title}]({entry.name}.png)\n\n{draw.card.card('The picture', result.best.numbers)}\n\n"
        )
    elif result is not None:
        text += (
            f"{draw.card.card('One run', {'value': str(result.best.value)[:200]} | result.best.numbers)}\n\n"
        )
    return text + f"```console\n{command}\n```\n\n```{{literalinclude}} {path}\n:language: python\n```\n"


def entry_module(entry: Entry) -> str:
    """The module of a gallery model."""
    return f"niwaki.gallery.{entry.name.replace('-', '_')}"


def grown(entry: Entry) -> nw.Result | None:
    """Return the result of a short search, or a few runs of the prior without a drawing, target or score."""
    if entry.drawing_name is not None and entry.window is not None:
        drawing = nw.targets.drawings.drawing(entry.drawing_name)
        start, score = drawing.place(entry.window), drawing.score(entry.window)
        return nw.grow(entry.model, None, *start, score=score, particles=200, seed=1)
    if (target := entry.target()) is not None:
        return nw.grow(entry.model, target, voxel=entry.voxel, rounds=ROUNDS, seed=1)
    if entry.score is not None:
        return nw.grow(entry.model, None, score=entry.score(), particles=200, seed=1)
    try:
        return nw.run(entry.model, seed=1)
    except NiwakiError:
        return None


def main(folder: Path) -> None:
    """Write all pages."""
    warnings.simplefilter("ignore")
    folder.mkdir(parents=True, exist_ok=True)
    reference(folder)
    gallery(folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
