"""Scripts repaired by few numbers, beside an optimiser made for them: `python benches/repair.py [SCENES]`.

Two tables:

- Fifteen scripts of our own (`benches/repairs`), with requirements in their comments.
- The scene programs of the repository mxgmn/ImperativeScene (MIT; SIGGRAPH Asia 2025), in the folder that
  `NIWAKI_SCENE_PROGRAMS` names; without it this part is left out. Their evaluator is a black box here: a function of
  a text that returns boxes and losses. The peer is their own optimiser with their settings and seed 0. It multiplies
  constants by random factors and turns groups of objects, and keeps the best change of each round. Numbers in calls
  of `Object`, `Door`, `Window` and `set_size` stay, as in theirs; words are their four directions.

"moved" is their own measure: the sum of volume times distance of all objects. All calls of their evaluator count.
"""

from __future__ import annotations

import contextlib
import json
import os
import random
import re
import statistics
import sys
import time
import tomllib
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
from niwaki.repairing import Repair

SCRIPTS = Path(__file__).parent / "repairs"
#: The results of the peer, which takes minutes.
PEER = Path(__file__).parent / ".cache" / "scene-programs.json"
LAYOUTS = "layouts/claude-3-5-sonnet-20241022/250105"
FIX = ("Object", "Door", "Window", "set_size")
WORDS = [{"X_MIN", "X_MAX", "Y_MIN", "Y_MAX"}]
#: The most runs of a scene: less than a fifth of the peer's mean, which is 1,001.
EVALUATIONS = 150


def keep_in(text: str) -> nw.Keep:
    """Read the requirements in the comments of a script."""
    table = tomllib.loads("\n".join(re.findall(r"^(?:#|//) keep: (.*)$", text, re.MULTILINE)))
    if "within" in table:
        table["within"] = tuple(tuple(corner) for corner in table["within"])
    return nw.Keep(**table)


def own_scripts() -> list[Path]:
    """List our scripts."""
    return sorted(place for place in SCRIPTS.iterdir() if place.suffix in (".py", ".scad"))


def own_table() -> None:
    """Repair our scripts, and print their patches."""
    rows = []
    for place in own_scripts():
        start = time.process_time()
        repair = nw.repair(place, keep_in(place.read_text()), workers=0)
        seconds = time.process_time() - start
        best = repair.best
        print(best.difference() if best else f"{place.name}: no patch")
        for conflict in repair.conflicts:
            print(conflict.reason)
        left = len(best.violations) if best else len(repair.before)
        numbers = best.numbers if best else 0
        rows.append((place.name, len(repair.before), left, numbers, repair.evaluations, seconds))
    print("\n| script | violated | left | numbers | runs | s CPU |\n| --- | --- | --- | --- | --- | --- |")
    for row in rows:
        print("| {} | {} | {} | {} | {} | {:.1f} |".format(*row))


class Programs:
    """The scene programs, their evaluator and their optimiser."""

    def __init__(self, root: Path) -> None:
        self.root = root
        # Their modules read folders relative to the repository; two of their imports are not needed here.
        sys.path.insert(0, str(root))
        sys.modules["astor"] = types.ModuleType("astor")
        quiet: Any = types.ModuleType("optimizer.logger")
        for name in ("info", "debug", "warning", "critical"):
            setattr(quiet, name, lambda *_, **__: None)
        sys.modules["optimizer.logger"] = quiet
        with contextlib.chdir(root):
            from optimizer import Optimizer, Scene, Settings, helper
        self.optimizer, self.scenes, self.helper = Optimizer, Scene, helper
        self.settings = Settings.Settings
        self.settings.MODE = Settings.MODE.RUN_FULL_LAYOUT
        self.settings.ANIMATION_FRAMES, self.settings.SAVE_JSON, self.settings.SEED = 0, False, 0
        self.environment = (root / "optimizer" / "env.py").read_text(encoding="utf-8")

    def places(self) -> list[Path]:
        """List the programs."""
        return sorted((self.root / LAYOUTS).glob("*.py"))

    def scene(self, text: str) -> Any:
        """Evaluate a program."""
        code = self.helper.remove_imports(self.helper.remove_markdown(self.helper.remove_comments(text)))
        random.seed(0)
        code = code.replace("while True:", "for _ in range(18):")
        return self.scenes.Scene("scene", code, self.environment, 0, None, None, None)

    def output(self, text: str) -> nw.Output:
        """Return the boxes and the losses of a program."""
        scene = self.scene(text)
        names = [f"{thing.name} {number}" for number, thing in enumerate(scene.objs)]
        parts = {}
        for name, thing in zip(names, scene.objs, strict=True):
            low, high = thing.fmin(), thing.fmax()
            parts[name] = np.array([[low.x, low.y, low.z], [high.x, high.y, high.z]])
        return nw.Output(
            parts,
            [
                nw.Violation(row.rtype.name, tuple(names[number] for number in row.args), float(row.loss))
                for row in scene.relations
            ],
        )

    def moved(self, after: Any, before: Any) -> float:
        """Their measure of displacement."""
        return float(self.optimizer.compute_cost(after, before))

    def peer(self, place: Path) -> dict[str, float]:
        """Run their optimiser."""
        count = 0
        scene_class = self.scenes.Scene

        class Counted(scene_class):  # type: ignore[misc, valid-type]
            def __init__(self, *arguments: Any) -> None:
                nonlocal count
                count += 1
                super().__init__(*arguments)

        self.optimizer.Scene = Counted
        random.seed(0)
        start = time.process_time()
        code = self.helper.remove_comments(place.read_text(encoding="utf-8", errors="replace"))
        search = self.optimizer.Optimizer(place.stem, self.environment, "")
        scene = search.run(code)
        seconds = time.process_time() - start
        self.optimizer.Scene = scene_class
        first = scene_class(
            place.stem, search.safe_code, self.environment, 0, search.mapping, search.original_constants, None
        )
        numbers = sum(a != b for a, b in zip(scene.constant_vec, first.constant_vec, strict=True))
        turned = sum(turn is not None for turn in scene.consult_vec or [])
        return {
            "left": len(scene.relations),
            "loss": sum(row.loss for row in scene.relations),
            "moved": self.moved(scene, first) if len(scene.objs) == len(first.objs) else 0.0,
            "evaluations": count,
            "numbers": numbers + turned,
            "seconds": seconds,
        }

    def ours(self, place: Path) -> tuple[Repair, dict[str, float]]:
        """Repair a program."""
        start = time.process_time()
        repair = nw.repair(
            place, run=self.output, fix=FIX, words=WORDS, workers=0, up="z", evaluations=EVALUATIONS
        )
        seconds = time.process_time() - start
        text = place.read_text(encoding="utf-8")
        first, best = self.scene(text), repair.best
        scene = self.scene(best.changed) if best else first
        return repair, {
            "before": len(first.relations),
            "loss before": sum(row.loss for row in first.relations),
            "left": len(scene.relations),
            "loss": sum(row.loss for row in scene.relations),
            "moved": self.moved(scene, first),
            "evaluations": repair.evaluations,
            "numbers": best.numbers if best else 0,
            "seconds": seconds,
        }


def peers(programs: Programs, places: list[Path]) -> Iterator[dict[str, float]]:
    """Yield the results of the peer, from the cache where they are known."""
    known = json.loads(PEER.read_text()) if PEER.is_file() else {}
    for place in places:
        if place.stem not in known:
            known[place.stem] = programs.peer(place)
            PEER.parent.mkdir(exist_ok=True)
            PEER.write_text(json.dumps(known))
        yield known[place.stem]


def programs_table(root: Path, names: list[str]) -> None:
    """Repair the scene programs, and run the peer."""
    programs = Programs(root)
    places = [place for place in programs.places() if not names or place.stem in names]
    both = []
    print(
        "\n| scene | violated | left | moved | evaluations | numbers |\n| --- | --- | --- | --- | --- | --- |"
    )
    for place, peer in zip(places, peers(programs, places), strict=True):
        repair, ours = programs.ours(place)
        if names and repair.best:
            print(repair.best.difference(), *repair.best.violations, sep="\n")
        both.append((ours, peer))
        cells = [
            f"{ours['before']} ({ours['loss before']})",
            f"{ours['left']} ({ours['loss']}); {peer['left']} ({peer['loss']})",
            f"{ours['moved']:.2f}; {peer['moved']:.2f}",
            *(f"{ours[name]}; {peer[name]}" for name in ("evaluations", "numbers")),
        ]
        print(f"| {place.stem.replace('_', ' ')} | {' | '.join(cells)} |", flush=True)
    print(
        "\nOurs; theirs. In brackets: the sum of their losses.\n\n| all scenes | ours | theirs |\n| --- | --- | --- |"
    )
    for title, name in (
        ("violations left", "left"),
        ("losses left", "loss"),
        ("moved", "moved"),
        ("evaluations", "evaluations"),
        ("seconds of CPU", "seconds"),
    ):
        print(
            f"| {title} | {sum(row[name] for row, _ in both):.4g} | {sum(row[name] for _, row in both):.4g} |"
        )
    free = [sum(not row["left"] for row in side) for side in zip(*both, strict=True)]
    print(f"| scenes without a violation, of {len(both)} | {free[0]} | {free[1]} |")
    less = sum(ours["moved"] <= peer["moved"] for ours, peer in both if ours["before"])
    broken = [pair for pair in both if pair[0]["before"]]
    print(f"| scenes, of {len(broken)}, in which less moves | {less} | {len(broken) - less} |")
    halves = [statistics.median(row["numbers"] for row in side) for side in zip(*broken, strict=True)]
    print(f"| literals changed, median | {halves[0]:g} | {halves[1]:g} |")


def main() -> None:
    """Print both tables."""
    names = sys.argv[1:]
    if not names:
        own_table()
    folder = os.environ.get("NIWAKI_SCENE_PROGRAMS")
    if folder is None:
        print(
            "\nThe scene programs are left out: NIWAKI_SCENE_PROGRAMS names no copy of mxgmn/ImperativeScene."
        )
        return
    programs_table(Path(folder), names)


if __name__ == "__main__":
    main()
