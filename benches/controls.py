"""The cost of another part for each sketch of a large scene: CPU microseconds, which should not grow.

A row of turned boxes grows as a search grows it: before each part the sketch is copied and the old copy kept for a
while, so that the cost of sharing is included. Run it alone on one core; the figures are this process's own CPU time.
"""

from __future__ import annotations

import time
from collections import deque
from math import cos, sin

import niwaki as nw
import numpy as np
from niwaki import _engine
from niwaki.targets.sketches import Score

COUNTS = (50, 200, 800, 3200)


def part(k: int) -> object:
    """Box number `k` of a helix that climbs."""
    angle = 0.31 * k
    turn = ((cos(angle), 0.0, sin(angle)), (0.0, 1.0, 0.0), (-sin(angle), 0.0, cos(angle)))
    radius = 4.0 + 3.0 * sin(0.011 * k)
    center = (radius * cos(angle), 0.5 + 0.006 * k, radius * sin(angle))
    return _engine.shape("box", center, (0.5, 0.08, 0.3), rotation=turn)


def scores() -> dict[str, Score]:
    """Each control by itself, at the sizes of the published figures."""
    size = (18.0, 22.0, 18.0)
    box = _engine.shape("box", (0.0, 10.5, 0.0), size)
    target = nw.Target(box.vertices(), box.faces(), "box")
    wall = _engine.shape("box", (-12.0, 10.0, 0.0), (2.0, 20.0, 20.0))
    obstacle = nw.Target(wall.vertices(), wall.faces(), "wall")
    rows, columns = np.mgrid[:250, :250]
    disc = (rows - 125) ** 2 + (columns - 125) ** 2 < 90**2
    camera = nw.Camera.perspective((0, 10, 40), (0, 10, 0))
    floor = nw.Receiver.floor(0.0, (-14.0, -14.0), (14.0, 14.0))
    return {
        "match_volume": nw.match_volume(target, 0.25),
        "no_self_intersection": nw.no_self_intersection(),
        "match_image": nw.match_image(disc, camera, weight_image=disc),
        "match_shadow": nw.match_shadow(disc, (-0.4, -1.0, 0.2), floor),
        "avoid": nw.avoid(obstacle, 0.4),
        "floor": nw.floor(0.0),
        "overshoot": nw.overshoot(target),
    }


def cost(score: Score, count: int, last: int = 50, repeats: int = 5) -> float:
    """CPU microseconds of each of the `last` parts of `count`, a copy of the sketch included; the best of `repeats`."""
    parts = [[part(k)] for k in range(count)]
    grown = _engine.Sketch(score.specs)
    for shapes in parts[: count - last]:
        grown.add(shapes)
    best = float("inf")
    for _ in range(repeats):
        sketch, kept = grown.fork(), deque(maxlen=4)
        start = time.process_time_ns()
        for shapes in parts[count - last :]:
            kept.append(sketch)
            sketch = sketch.fork()
            sketch.add(shapes)
            sketch.log_score()
        best = min(best, (time.process_time_ns() - start) / 1e3 / last)
    return best


def empty(last: int = 50) -> float:
    """Return the time without a sketch: what Python itself takes."""
    return cost(Score(), last, last)


def main() -> None:
    """Print the table."""
    print(f"CPU microseconds for each part (without a sketch {empty():.2f}), when there are")
    print(f"{'':<22}" + "".join(f"{count:>8}" for count in COUNTS))
    for name, score in scores().items():
        print(f"{name:<22}" + "".join(f"{cost(score, count):8.2f}" for count in COUNTS))


if __name__ == "__main__":
    main()
