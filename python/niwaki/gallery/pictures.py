"""The README's pictures and the gallery's plates, made again by one command.

    python -m niwaki.gallery.pictures docs/pictures

ships.png: ten ships in one target; tree.png: three trees in one target and, below, three that no target asked for.
gallery/NAME.png: each model, grown into its target and left to itself, or as its experiment wants it seen. Each stays
below `LARGEST` bytes.
"""

from __future__ import annotations

import io
import sys
from pathlib import Path
from typing import Any

from PIL import Image

from niwaki.draw.picture import write_whole
from niwaki.draw.sheet import sheet
from niwaki.draw.views import view_sheet
from niwaki.gallery import Entry, entries, targets
from niwaki.gallery.experiments import EXPERIMENTS
from niwaki.gallery.niwaki_tree import VOXEL as TREE_VOXEL
from niwaki.gallery.niwaki_tree import niwaki_tree
from niwaki.gallery.spaceship import VOXEL as SHIP_VOXEL
from niwaki.gallery.spaceship import spaceship
from niwaki.infer import grow, run
from niwaki.methods import forward, importance
from niwaki.result import Result
from niwaki.scene import Scene
from niwaki.sketches import no_self_intersection

LARGEST = 300_000

#: Searches for a plate, of which the best is shown; forward runs from which a free one is taken.
RUNS = 4
TRIED = 60


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
    (folder / "gallery").mkdir(exist_ok=True)
    return [
        written(folder / "ships.png", fleet(ships)),
        written(folder / "tree.png", garden(trees)),
        *(written(folder / "gallery" / f"{one.name}.png", plate(one)) for one in entries() if has_plate(one)),
    ]


def has_plate(one: Entry) -> bool:
    """Whether a model has a target, or an experiment instead of one."""
    return one.target_name is not None or any(experiment.model == one.name for experiment in EXPERIMENTS)


def plate(one: Entry) -> Image.Image:
    """One model: in its target and free, or with the shadow that it was asked for."""
    target = one.target()
    if target is None:
        return cast_shadow(one)
    found = grow(one.model, target, particles=one.particles, voxel=one.voxel, runs=RUNS, seed=1)
    settings: dict[str, Any] = {"size": (360, 320), "samples": 24, "margin": 0.05}
    settings["elevation"] = 30.0 if "ship" in one.name else 16.0
    grown = found.best.scene
    return _beside(grown.picture(target, **settings), free(one).picture(**settings))


def free(one: Entry) -> Scene:
    """A forward run of middling size that does not run through itself."""
    tried = run(one.model, method=importance(TRIED), score=no_self_intersection(), seed=2)
    sound = sorted((s for s in tried if s.log_score == 0.0), key=lambda sample: sample.primitives)
    return sound[2 * len(sound) // 3].scene


def cast_shadow(one: Entry) -> Image.Image:
    """What was wanted, what was made, and the scene that makes it."""
    asked = next(experiment for experiment in EXPERIMENTS if experiment.model == one.name)
    best = max(
        (asked.run(seed=seed).best for seed in range(1, RUNS + 1)), key=lambda sample: sample.log_score
    )
    return view_sheet(best.scene, asked.score().views[0], height=240)


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


def _beside(left: Image.Image, right: Image.Image, gap: int = 4) -> Image.Image:
    """Paste one picture beside another of the same height."""
    page = Image.new("RGB", (left.width + gap + right.width, left.height), "white")
    page.paste(left.convert("RGB"), (0, 0))
    page.paste(right.convert("RGB"), (left.width + gap, 0))
    return page


def _above(top: Image.Image, bottom: Image.Image, gap: int = 4) -> Image.Image:
    """Paste one picture above another of the same width."""
    page = Image.new("RGB", (top.width, top.height + gap + bottom.height), "white")
    page.paste(top.convert("RGB"), (0, 0))
    page.paste(bottom.convert("RGB"), (0, top.height + gap))
    return page


if __name__ == "__main__":
    for place in draw(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/pictures")):
        print(f"{place}   {place.stat().st_size / 1000:.0f} kB")
