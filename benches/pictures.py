"""The pictures of the README and the manual, made again by one command.

    python benches/pictures.py docs/pictures

ships.png: ten ships in one target; tree.png: three trees in one target and, below, three that no target asked for;
growth.gif: the best of the ships, growing. Each stays below `LARGEST` bytes.
"""

from __future__ import annotations

import io
import sys
from pathlib import Path
from typing import Any

from niwaki.draw.scene import Scene
from niwaki.draw.sheet import sheet
from niwaki.errors.files import write_whole
from niwaki.gallery.niwaki_tree import VOXEL as TREE_VOXEL
from niwaki.gallery.niwaki_tree import niwaki_tree
from niwaki.gallery.spaceship import VOXEL as SHIP_VOXEL
from niwaki.gallery.spaceship import spaceship
from niwaki.methods import forward
from niwaki.result import Result
from niwaki.search import grow, run
from niwaki.targets import examples as targets
from PIL import Image

LARGEST = 300_000


def draw(folder: Path) -> list[Path]:
    """Draw every picture.

    Parameters
    ----------
    folder
        Made where it is missing.

    Returns
    -------
    list of Path
        The files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    ships = grow(spaceship, targets.ship(), particles=300, voxel=SHIP_VOXEL, runs=10, seed=1)
    trees = grow(niwaki_tree, targets.niwaki(), particles=1000, voxel=TREE_VOXEL, runs=10, seed=1)
    return [
        written(folder / "ships.png", fleet(ships)),
        written(folder / "tree.png", garden(trees)),
        ships.best.animate(folder / "growth.gif", seconds=3.0, size=(320, 200), elevation=30.0, margin=0.03),
    ]


def fleet(ships: Result) -> Image.Image:
    """All ships in rows of five, best first."""
    settings: dict[str, Any] = {"elevation": 30.0, "margin": 0.03, "lift": 0.3}
    return sheet(_scenes(ships), target=ships.score.target, columns=5, size=(280, 176), **settings)


def garden(trees: Result) -> Image.Image:
    """Three trees grown into the target; below, three forward runs."""
    grown = sheet(_scenes(trees)[:3], target=trees.score.target, columns=3, size=(320, 305), elevation=14.0)
    wild = run(niwaki_tree, method=forward(3), seed=3)
    free = sheet(_scenes(wild), columns=3, size=(320, 305), elevation=14.0)
    return _above(grown, free)


def written(path: Path, image: Image.Image) -> Path:
    """Write a picture; with 256 colours where it would be too large with all."""
    flat = image.convert("RGB")
    data = _png(flat)
    if len(data) > LARGEST:
        data = _png(flat.quantize(256, Image.Quantize.MEDIANCUT, kmeans=3))
    return write_whole(path, data)


def _png(image: Image.Image) -> bytes:
    out = io.BytesIO()
    image.save(out, "PNG", optimize=True)
    return out.getvalue()


def _scenes(result: Result) -> list[Scene]:
    """Scenes, best first."""
    return [sample.scene for sample in sorted(result, key=lambda sample: -sample.log_score)]


def _above(top: Image.Image, bottom: Image.Image, gap: int = 4) -> Image.Image:
    """Paste one picture above another of the same width."""
    page = Image.new("RGB", (top.width, top.height + gap + bottom.height), "white")
    page.paste(top.convert("RGB"), (0, 0))
    page.paste(bottom.convert("RGB"), (0, top.height + gap))
    return page


if __name__ == "__main__":
    for place in draw(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/pictures")):
        print(f"{place}   {place.stat().st_size / 1000:.0f} kB")
