"""Built-in targets, made by code: solids to fill or to avoid, and images to match.

- `ships`, `towns`, `trees`  solids to fill
- `obstacles`                solids to avoid, and volumes to fill around them
- `images`                   pictures of silhouettes and shadows
- `lofts`                    the parts of the solids

All lengths are scene units, y is up.
"""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from pathlib import Path

from PIL import Image

from niwaki.errors.files import ensure_folder, write_whole
from niwaki.targets.examples import images
from niwaki.targets.examples.obstacles import emblem, funnel, gem, ledges
from niwaki.targets.examples.ships import dart, ship
from niwaki.targets.examples.towns import (
    amphora,
    armchair,
    crescent,
    downtown,
    farmstead,
    fortress,
    viaduct,
    wreath,
)
from niwaki.targets.examples.trees import bent_tube, fan, forked_tree, niwaki, umbrella
from niwaki.targets.target import Target

__all__ = [
    "IMAGES",
    "TARGETS",
    "amphora",
    "armchair",
    "bent_tube",
    "crescent",
    "dart",
    "downtown",
    "emblem",
    "fan",
    "farmstead",
    "forked_tree",
    "fortress",
    "funnel",
    "gem",
    "image",
    "ledges",
    "niwaki",
    "ship",
    "umbrella",
    "viaduct",
    "wreath",
    "write_all",
]

SOLIDS = (
    amphora,
    armchair,
    bent_tube,
    crescent,
    dart,
    downtown,
    emblem,
    fan,
    farmstead,
    forked_tree,
    fortress,
    funnel,
    gem,
    ledges,
    niwaki,
    ship,
    umbrella,
    viaduct,
    wreath,
)

TARGETS: dict[str, Callable[[], Target]] = {make.__name__: make for make in SOLIDS}

IMAGES = ("digits", "face", "face_stroke", "ship_front", "skyline")


def image(name: str) -> Image.Image:
    """Draw the image of that name, one of `IMAGES`."""
    picture: Image.Image = getattr(images, name)()
    return picture


def write_all(folder: str | PathLike[str]) -> list[Path]:
    """Write every target into a folder, solids as OBJ and images as PNG files, and return their paths."""
    place = ensure_folder(Path(folder))
    paths = []
    for name, make in TARGETS.items():
        target = make()
        lines = [f"# niwaki target: {name}", f"o {name}"]
        lines += ["v " + " ".join(f"{c:.6f}" for c in vertex) for vertex in target.vertices]
        lines += ["f " + " ".join(str(i + 1) for i in face) for face in target.faces]
        paths.append(write_whole(place / f"{name}.obj", ("\n".join(lines) + "\n").encode("ascii")))
    for name in IMAGES:
        paths.append(place / f"{name}.png")
        image(name).save(paths[-1])
    return paths
