"""A picture of each problem: its target, and the default's median and worst result, from two sides.

The results are searched for again: the same version and seed give the same result.
"""

from __future__ import annotations

from pathlib import Path

from niwaki.draw.scene import Scene
from niwaki.targets.views import view_sheet
from pages import beside, stacked, together
from PIL import Image

from searches import table
from searches.complete import is_complete
from searches.methods import METHODS
from searches.problems import Case, Problem
from searches.searching import case_of, grown

SIZE = (320, 300)


def drawn(task_problem: Problem, rows: table.Rows, folder: Path) -> Path:
    """Draw a problem into a folder."""
    results = sorted(table.of(rows, task_problem.name, METHODS[0].name).values(), key=table.score)
    ranks = {"median": results[len(results) // 2], "worst": results[0]}
    strips = []
    for rank, row in ranks.items():
        case = case_of(task_problem.name, row["seed"])
        result = grown(task_problem, case, METHODS[0], 0, row["seed"])
        scene = Scene([]) if result is None else result.best.scene
        state = "complete" if is_complete(row) else "not complete"
        shares = ", ".join(f"{name} {share:.2f}" for name, share in row["shares"].items())
        text = f"{task_problem.name}, {rank}, seed {row['seed']}: {table.score(row):.1f}, {state}: {shares or 'dead'}"
        strips.append((text, strip(case, scene)))
    path = folder / f"{task_problem.name.replace(' ', '-')}.png"
    stacked(strips).save(path)
    return path


def strip(case: Case, scene: Scene) -> Image.Image:
    """A scene beside its target: alone, and in it as a ghost; with obstacles from another side."""
    if case.score is not None and case.score.views:
        return view_sheet(scene, case.score.views[0], height=SIZE[1], samples=4, captions=False)
    assert case.target is not None
    shown = scene if case.obstacle is None else together(scene, case.obstacle)
    look = {
        "size": SIZE,
        "samples": 4,
        "elevation": 20.0,
        "margin": 0.03,
        "frame": together(shown, case.target),
    }
    views = [case.target.picture(azimuth=20.0, **look)]
    if len(scene):
        views.append(scene.picture(case.target, azimuth=20.0, **look))
    if len(shown):
        views += [shown.picture(azimuth=turned, **look) for turned in (20.0, 110.0)]
    return beside([view.convert("RGB") for view in views])
