"""Figures 5.1 to 5.8 and table 5.1: every experiment of chapter 5 on our own targets.

Each row of a picture is the best of a few searches: above with the original's settings (so many particles, whole
scores), below with ours. The target is beside the result. A silhouette or a shadow is shown in its own
view, and the scene from one other side.
"""

import statistics
from collections.abc import Callable
from pathlib import Path

import niwaki as nw
from experiments import EXPERIMENTS, Experiment
from niwaki.draw.scene import Scene
from niwaki.draw.sheet import sheet
from niwaki.gallery import entry, named_target
from niwaki.gallery.simple_ship import MODEL as SIMPLE_SHIP
from niwaki.targets.views import view_sheet
from pages import beside, stacked, together
from pictures import written
from PIL import Image

#: Particles and seconds of table 5.1: Core i7-3840QM of 2012, one thread. The trees of 5.4 are one row there.
PUBLISHED = {
    "ship": 3.09,
    "tree": 598.34,
    "building": 24.14,
    "tree-and-ledges": 164.25,
    "tree-and-emblem": 164.25,
    "skyline": 38.44,
    "ship-front": 7.33,
    "face-of-blocks": 135.91,
    "digits-of-pipes": 675.81,
}
TITLES = {"original": "with the original's settings", "ours": "with ours"}
SEEDS = (1, 2, 3, 4)
SIZE = (300, 300)
#: From where each model shows itself: azimuth and elevation, degrees; the second beside a view that the target has.
EYES = {"spaceship": (38.0, 30.0), "building": (30.0, 26.0), "gnarly-tree": (20.0, 14.0)}
SIDES = {
    "toy-blocks": (25.0, 22.0),
    "pipes": (25.0, 24.0),
    "building": (0.0, 62.0),
    "spaceship": (50.0, 28.0),
}


def draw(folder: Path, tell: Callable[[dict], None], quick: bool) -> None:
    """Search, draw a picture of each experiment and of figure 5.2, and print the table."""
    seeds = SEEDS[:1] if quick else SEEDS
    print(
        f"{'experiment':<18}{'particles':>10}{'their s':>9}{'CPU s':>8}{'s, all threads':>16}{'times':>7}  scores"
    )
    for example in EXPERIMENTS:
        if example.name not in PUBLISHED:
            continue
        rows = []
        for preset in ("original", "ours"):
            results = searches(example, preset, seeds, quick)
            if not results:
                tell({"experiment": example.name, "preset": preset, "impossible": len(seeds)})
                print(f"{example.name}, {preset}: all {len(seeds)} searches became impossible", flush=True)
                continue
            record = row(example, preset, results, len(seeds) - len(results))
            tell(record)
            print(line(record), flush=True)
            best = max(results, key=lambda pair: pair[0].best.log_score)[0].best
            rows.append((TITLES[preset], panels(example, best, draft=quick)))
        if rows:
            written(folder / f"figure-{example.figure.replace('.', '-')}-{example.name}.png", stacked(rows))
    written(folder / "figure-5-2.png", order_matters(quick))


def searches(
    example: Experiment, preset: str, seeds: tuple[int, ...], quick: bool
) -> list[tuple[nw.Result, float]]:
    """Results of all seeds, on one thread, each with the seconds that it takes on all threads."""
    results = []
    for seed in seeds:
        less = {"particles": 30, "populations": 1} if quick else {}
        less |= {"moves": 1} if quick and "moves" in example.settings(preset) else {}
        less |= {"steps": 1000} if quick else {}
        try:
            result = example.run(preset, seed=seed, threads=1, **less)
        except nw.InputError as error:
            if error.code != "everything-impossible":
                raise
            continue
        results.append((result, example.run(preset, seed=seed, **less).seconds))
    return results


def row(example: Experiment, preset: str, results: list[tuple[nw.Result, float]], impossible: int) -> dict:
    """The line of the table for an experiment."""
    return {
        "experiment": example.name,
        "preset": preset,
        "particles": example.settings(preset)["particles"],
        "published": PUBLISHED[example.name] if preset == "original" else None,
        "cpu": statistics.fmean(result.cpu_seconds for result, _ in results),
        "wall": statistics.fmean(seconds for _, seconds in results),
        "scores": [result.best.log_score for result, _ in results],
        "impossible": impossible,
        "primitives": [result.best.primitives for result, _ in results],
    }


def line(record: dict) -> str:
    """A row of the table for people."""
    name = record["experiment"] if record["preset"] == "original" else "  our settings"
    known = record["published"]
    text = f"{name:<18}{record['particles']:>10}{known or '':>9}{record['cpu']:>8.2f}{record['wall']:>16.2f}"
    text += f"{known / record['cpu']:>7.0f}" if known else f"{'':>7}"
    text += "  " + " ".join(f"{score:.1f}" for score in record["scores"])
    return text + (f"  {record['impossible']} impossible" if record["impossible"] else "")


def panels(example: Experiment, sample: nw.Sample, draft: bool) -> Image.Image:
    """The target beside the result."""
    scene, samples = sample.scene, 2 if draft else 16
    if example.image is not None:
        left = view_sheet(scene, example.score().views[0], height=SIZE[1], samples=samples, captions=False)
        azimuth, elevation = SIDES[example.model]
        side = scene.picture(size=SIZE, samples=samples, azimuth=azimuth, elevation=elevation, margin=0.04)
        return beside([left, side.convert("RGB")])
    target = named_target(example.fill)
    target_scene = together(Scene([]), target)
    azimuth, elevation = EYES[example.model]
    look = {"size": SIZE, "samples": samples, "elevation": elevation, "margin": 0.03}
    obstacle = None if example.avoid is None else named_target(example.avoid)
    shown = scene if obstacle is None else together(scene, obstacle)
    look["frame"] = together(shown, target)
    views = [target_scene.picture(azimuth=azimuth, **look), scene.picture(target, azimuth=azimuth, **look)]
    views += [shown.picture(azimuth=turned, **look) for turned in (azimuth, azimuth + 110.0)]
    return beside([view.convert("RGB") for view in views])


def order_matters(quick: bool) -> Image.Image:
    """Figure 5.2: simple ships by the same particles, depth-first above and in a stochastic order below."""
    target = entry("simple-ship").target()
    scenes, captions = [], []
    for order in ("depth-first", "stochastic"):
        result = nw.grow(
            SIMPLE_SHIP, target, particles=20 if quick else 100, order=order, runs=2 if quick else 4, seed=1
        )
        for sample in sorted(result, key=lambda sample: -sample.log_score)[: 2 if quick else 4]:
            scenes.append(sample.scene)
            captions.append(f"{order}: {sample.log_score:.1f}")
    samples = 2 if quick else 16
    page = sheet(
        scenes, captions, target, columns=2 if quick else 4, size=(280, 190), samples=samples, elevation=35.0
    )
    return page.convert("RGB")
