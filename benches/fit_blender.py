"""Hidden values of node trees that Blender evaluates: how often, and after how many evaluations, `nw.fit` finds them.

    NIWAKI_BLENDER=/path/to/blender python benches/fit_blender.py

The trees are the table and the chair of tests/integrations/blender/node_trees.py. Hidden values are drawn from the
ranges of their sockets. Solved: the best score is within 0.085 nats of that of the hidden values, as in `fit/`.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

import niwaki as nw
import numpy as np
from niwaki.fitting.blend import find_blender
from niwaki.fitting.goals import Goal
from niwaki.fitting.result import scene_of_arrays

TREES = Path(__file__).parents[1] / "tests" / "integrations" / "blender"
NEAR, EVALUATIONS, TARGETS, SEEDS = 0.085, 200, 4, 2
AFTER = (50, 100, 200)

#: What Blender runs to write the file.
SCRIPT = """
import sys
sys.path.insert(0, {trees!r})
import bpy, node_trees
bpy.ops.wm.read_homefile(use_empty=True)
node_trees.add(node_trees.table(), "Table")
node_trees.add(node_trees.chair(), "Chair")
bpy.ops.wm.save_as_mainfile(filepath={place!r})
"""


def furniture(folder: Path) -> Path:
    """Have Blender write a file with both trees."""
    place, script = folder / "furniture.blend", folder / "make.py"
    script.write_text(SCRIPT.format(trees=str(TREES), place=str(place)))
    subprocess.run([*find_blender(place)[:-1], str(script)], stdout=subprocess.DEVNULL)
    return place


def hidden(model: nw.fitting.blend.BlendGenerator, target: int) -> dict[str, float]:
    """Draw values that no search sees."""
    draws = np.random.default_rng(1000 + target)
    numbers: dict[str, float] = {}
    levels: list[int | None] = []
    for axis in model.space.axes:
        is_used = not axis.when or any(all(levels[k] in allowed for k, allowed in rule) for rule in axis.when)
        value = axis.value(draws.uniform())
        level = axis.level(value) if axis.range is None else None
        levels.append(level if is_used else None)
        if is_used:
            numbers[axis.name] = level if axis.kind == "choice" else value
    return numbers


def main() -> None:
    print(
        "| tree | searches | solved after "
        + " | ".join(f"{count}" for count in AFTER)
        + " | evaluations, median |"
    )
    print("| --- | --- |" + " --- |" * (len(AFTER) + 1))
    with tempfile.TemporaryDirectory() as folder:
        place = furniture(Path(folder))
        for tree in ("Table", "Chair"):
            model, counts = nw.blend(place, tree), []
            for target in range(TARGETS):
                mesh = model.call(hidden(model, target)).mesh
                score = nw.match_volume(nw.Target(*mesh))
                goal = Goal.of(score).measure(scene_of_arrays(*mesh)).score
                for seed in range(SEEDS):
                    result = nw.fit(model, score, EVALUATIONS, seed=seed, workers=2)
                    solved = [sample.number + 1 for sample in result if sample.log_score >= goal - NEAR]
                    counts.append(solved[0] if solved else np.inf)
                    print(tree, target, seed, counts[-1], file=sys.stderr)
            solved = [sum(count <= most for count in counts) for most in AFTER]
            print(
                f"| {tree} | {len(counts)} | "
                + " | ".join(map(str, solved))
                + f" | {np.median(counts):.0f} |"
            )


if __name__ == "__main__":
    main()
