"""Pages of structures: three draws of each, the mean picture of all draws, and autocorrelations."""

from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import niwaki as nw
import numpy as np
from niwaki.draw.scene import Scene
from PIL import Image
from stacking.effective import autocorrelation
from stacking.files import Drawn, Verdicts, chains
from stacking.judging import passes
from stacking.kinds import KINDS, Kind
from stacking.table import corners

#: Pixels of a picture's side.
SIDE = 360
VIEW = {"azimuth": 32.0, "elevation": 14.0}
TITLES = {"nuts": "HMC (no-U-turn)", "mh-original": "MH, the original's", "mh-adaptive": "MH, put right"}
NAMES = {
    "stack": "Stack",
    "lean": "Lean",
    "top_heavy": "TopHeavy",
    "platforms": "Platforms",
    "wheel": "Wheel",
    "tri_arch": "TriArch",
    "symmetric_arch": "Arch, symmetric",
    "symmetric_tri_arch": "TriArch, symmetric",
    "every_step": "Stable at every step",
    "tilt_arch": "Arch on tilted ground",
    "cut_lean": "Lean, of a board",
}
#: One of each, for the top of the manual's page.
OVERVIEW = (
    *("stack", "lean", "top_heavy", "every_step", "cut_lean"),
    *("platforms", "wheel", "tri_arch", "symmetric_arch", "tilt_arch"),
)


def scene_of(kind: Kind, all_chains: list[Drawn], place: tuple[int, int]) -> Scene:
    """The scene of a draw."""
    chain, draw = place
    return nw.run(kind.model, width=kind.width, choices=all_chains[chain].choices(draw)).best.scene


def far_apart(kind: Kind, folder: Path, all_chains: list[Drawn], count: int) -> list[tuple[int, int]]:
    """Draws that pass, each as far as can be from those before it; the first is nearest to the mean."""
    rows = list(Verdicts(folder, kind.name, "nuts"))
    good = [(row["chain"], row["draw"]) for row in [row for row in rows if passes(row)] or rows]
    at = corners(kind, all_chains)
    flat = np.array([at[place] for place in good if place[1] < at.shape[1]])
    chosen = [int(np.argmin(((flat - flat.mean(axis=0)) ** 2).sum(axis=1)))]
    while len(chosen) < min(count, len(flat)):
        near = ((flat[:, None] - flat[chosen][None]) ** 2).sum(axis=2).min(axis=1)
        chosen.append(int(near.argmax()))
    return [good[k] for k in chosen]


def framed(scene: Scene, frame: Scene | None, size: int = SIDE, **view: float) -> Image.Image:
    return scene.picture(size=(size, size), frame=frame, **(VIEW | view)).convert("RGB")


def mean_picture(
    kind: Kind, all_chains: list[Drawn], frame: Scene, most: int = 60, **view: float
) -> Image.Image:
    """The mean of pictures of draws, at most `most` of them, evenly spread."""
    places = [
        (chain, draw)
        for chain, chain_draws in enumerate(all_chains)
        for draw in range(len(chain_draws.values))
    ]
    places = [places[k] for k in np.unique(np.linspace(0, len(places) - 1, most).astype(int))]
    total = np.zeros((SIDE // 2, SIDE // 2, 3))
    for place in places:
        picture = scene_of(kind, all_chains, place).picture(
            size=(SIDE // 2, SIDE // 2), samples=4, frame=frame, **(VIEW | view)
        )
        total += np.asarray(picture.convert("RGB"), dtype=np.float64)
    small = Image.fromarray((total / len(places)).round().astype(np.uint8))
    return small.resize((SIDE, SIDE), Image.Resampling.LANCZOS)


def overview(path: Path, folder: Path) -> None:
    """One draw of each kind: the one farthest from the mean draw that both judges pass."""
    names = [name for name in OVERVIEW if chains(folder, name, "nuts")]
    figure, axes = plt.subplots(2, len(OVERVIEW) // 2, figsize=(14, 6.2), squeeze=False)
    for cell in axes.flat:
        cell.axis("off")
    for cell, name in zip(axes.flat, names, strict=False):
        kind, all_chains = KINDS[name], chains(folder, name, "nuts")
        scene = scene_of(kind, all_chains, far_apart(kind, folder, all_chains, 2)[-1])
        cell.imshow(framed(scene, scene))
        cell.set_title(NAMES[name], fontsize=11)
    figure.tight_layout()
    figure.savefig(path, dpi=75, bbox_inches="tight")
    plt.close(figure)


def compared(path: Path, folder: Path, names: tuple[str, ...]) -> None:
    """Rows: three draws, the mean of all draws of both samplers, and their autocorrelations."""
    names = tuple(name for name in names if chains(folder, name, "nuts"))
    if not names:
        return
    figure, axes = plt.subplots(len(names), 6, figsize=(18, 3.2 * len(names)), squeeze=False)
    for row, name in zip(axes, names, strict=True):
        kind, all_chains = KINDS[name], chains(folder, name, "nuts")
        places = far_apart(kind, folder, all_chains, 3)
        scenes = [scene_of(kind, all_chains, place) for place in places]
        largest = scene_of(kind, all_chains, widest(kind, all_chains))
        shown = [framed(scene, largest) for scene in scenes]
        shown.append(mean_picture(kind, all_chains, largest))
        theirs = chains(folder, name, "mh-original")
        if theirs:
            shown.append(mean_picture(kind, theirs, largest))
        titles = [NAMES[name], "", "", "mean of HMC's draws", "mean of MH's (the original's)"]
        for cell, picture, title in zip(row, shown, titles, strict=False):
            cell.imshow(picture)
            cell.set_title(title, fontsize=11)
        for cell in row[:5]:
            cell.axis("off")
        curves(row[5], kind, folder)
    figure.tight_layout()
    figure.savefig(path, dpi=60, bbox_inches="tight")
    plt.close(figure)


def widest(kind: Kind, all_chains: list[Drawn]) -> tuple[int, int]:
    """The draw with the largest extent."""
    at = corners(kind, all_chains)
    boxes = np.ptp(at.reshape(*at.shape[:2], -1, 3), axis=2)
    chain, draw = np.unravel_index(np.linalg.norm(boxes, axis=-1).argmax(), at.shape[:2])
    return int(chain), int(draw)


def extent(scene: Scene) -> float:
    """The diagonal of a scene's box."""
    low, high = np.array(scene.bounds)
    return float(np.linalg.norm(high - low))


def curves(cell: Any, kind: Kind, folder: Path) -> None:
    """Autocorrelations of all corners, by draws."""
    for sampler, title in TITLES.items():
        all_chains = chains(folder, kind.name, sampler)
        if all_chains and len(all_chains[0].values) > 2:
            lags = autocorrelation(corners(kind, all_chains))
            cell.plot(lags[: max(2, len(lags) * 4 // 5)], label=title)
    cell.axhline(0.0, color="0.7", linewidth=0.8)
    cell.set_ylim(-0.6, 1.05)
    cell.set_xlabel("draws apart")
    cell.set_title("autocorrelation", fontsize=11)
    cell.legend(fontsize=8, frameon=False)


def gallery(path: Path, folder: Path, names: tuple[str, ...], **view: float) -> None:
    """Three draws of each, without comparison."""
    names = tuple(name for name in names if chains(folder, name, "nuts"))
    if not names:
        return
    figure, axes = plt.subplots(len(names), 3, figsize=(10.5, 3.6 * len(names)), squeeze=False)
    for row, name in zip(axes, names, strict=True):
        kind, all_chains = KINDS[name], chains(folder, name, "nuts")
        scenes = [scene_of(kind, all_chains, place) for place in far_apart(kind, folder, all_chains, 3)]
        largest = max(scenes, key=extent)
        for cell in row:
            cell.axis("off")
        for cell, scene in zip(row, scenes, strict=False):
            cell.imshow(framed(scene, largest, **view))
        row[1].set_title(NAMES[name], fontsize=11)
    figure.tight_layout()
    figure.savefig(path, dpi=75, bbox_inches="tight")
    plt.close(figure)


def tilted(path: Path, folder: Path) -> None:
    """One tower on ground tilted by 10 degrees to the left, level, and to the right."""
    kind, all_chains = KINDS["tilt_stack"], chains(folder, "tilt_stack", "nuts")
    if not all_chains:
        return
    scene = scene_of(kind, all_chains, far_apart(kind, folder, all_chains, 1)[0])
    figure, axes = plt.subplots(1, 3, figsize=(10.5, 3.8))
    for cell, degrees in zip(axes, (-10.0, 0.0, 10.0), strict=True):
        picture = framed(scene, scene, azimuth=0.0, elevation=4.0, size=2 * SIDE)
        turned = picture.rotate(degrees, Image.Resampling.BICUBIC, fillcolor=picture.getpixel((4, 4)))
        # What of the picture is inside of its turned self.
        edge = SIDE // 7
        cell.imshow(turned.crop((edge, edge, 2 * SIDE - edge, 2 * SIDE - edge)))
        cell.set_title(f"ground tilted by {degrees:+.0f}°" if degrees else "level", fontsize=11)
        cell.axis("off")
    figure.tight_layout()
    figure.savefig(path, dpi=75, bbox_inches="tight")
    plt.close(figure)
