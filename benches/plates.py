"""The gallery's plates: each model grown into its target and free, or with the shadow that it should cast.

python benches/plates.py docs/pictures/gallery [NAME ...]
"""

from __future__ import annotations

import sys
from collections.abc import Collection
from pathlib import Path
from typing import Any

from experiments import EXPERIMENTS
from niwaki.draw.scene import Scene
from niwaki.gallery import Entry, entries
from niwaki.methods import importance
from niwaki.search import grow, run
from niwaki.targets.sketches import no_self_intersection
from niwaki.targets.views import view_sheet
from pictures import written
from PIL import Image

#: Searches for a plate, of which the best is shown; forward runs from which a free one is taken.
RUNS = 4
TRIED = 60


def draw(folder: Path, names: Collection[str] = ()) -> list[Path]:
    """Draw a plate of each model, or of those named, that has a target or an experiment.

    Parameters
    ----------
    folder
        Made where it is missing.
    names
        Entries of the gallery.

    Returns
    -------
    list of Path
        The files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    chosen = [gallery_entry for gallery_entry in entries() if not names or gallery_entry.name in names]
    return [
        written(folder / f"{gallery_entry.name}.png", plate(gallery_entry))
        for gallery_entry in chosen
        if has_plate(gallery_entry)
    ]


def has_plate(gallery_entry: Entry) -> bool:
    """Whether a model has a target, or an experiment instead of one."""
    return gallery_entry.target_name is not None or any(
        experiment.model == gallery_entry.name for experiment in EXPERIMENTS
    )


def plate(gallery_entry: Entry) -> Image.Image:
    """One model: in its target and free, or with the shadow that it should cast."""
    target = gallery_entry.target()
    if target is None:
        return cast_shadow(gallery_entry)
    results = grow(
        gallery_entry.model,
        target,
        particles=gallery_entry.particles,
        voxel=gallery_entry.voxel,
        runs=RUNS,
        seed=1,
    )
    settings: dict[str, Any] = {"size": (360, 320), "samples": 24, "margin": 0.05}
    settings["elevation"] = 30.0 if "ship" in gallery_entry.name else 16.0
    return _beside(results.best.scene.picture(target, **settings), free(gallery_entry).picture(**settings))


def free(gallery_entry: Entry) -> Scene:
    """A forward run of middling size that does not run through itself."""
    tried = run(gallery_entry.model, method=importance(TRIED), score=no_self_intersection(), seed=2)
    sound = sorted((s for s in tried if s.log_score == 0.0), key=lambda sample: sample.primitives)
    return sound[2 * len(sound) // 3].scene


def cast_shadow(gallery_entry: Entry) -> Image.Image:
    """Return the target, the result, and the scene that makes it."""
    chosen = next(experiment for experiment in EXPERIMENTS if experiment.model == gallery_entry.name)
    results = [chosen.run(seed=seed).best for seed in range(1, RUNS + 1)]
    best = max(results, key=lambda sample: sample.log_score)
    return view_sheet(best.scene, chosen.score().views[0], height=240)


def _beside(left: Image.Image, right: Image.Image, gap: int = 4) -> Image.Image:
    """Paste one picture beside another of the same height."""
    page = Image.new("RGB", (left.width + gap + right.width, left.height), "white")
    page.paste(left.convert("RGB"), (0, 0))
    page.paste(right.convert("RGB"), (left.width + gap, 0))
    return page


if __name__ == "__main__":
    for place in draw(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/pictures/gallery"), sys.argv[2:]):
        print(f"{place}   {place.stat().st_size / 1000:.0f} kB")
