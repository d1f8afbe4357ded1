"""From a command to its last byte: what a person waits for, part by part, and the same primary rays by Embree.

    .venv/bin/python benches/wait.py [REPEATS] [MODEL ...]

Each gallery model that `niwaki grow MODEL --seed 1` grows is run in fresh processes, each with a folder of its own, and
timed from the start of the process to its end; the parts are those that the command prints itself. The figure is the
fastest of the repeats: everything that makes one slower is another process. CPU seconds, of both cores together, hardly
depend on others. `niwaki --help` and `niwaki models` are timed in the same way.

For best.png of models in space, Embree (embreex) then traces the primary rays of the same scene and camera:
all that 16 samples for each pixel can be, without light, shadow or paint. This is no renderer; it is the time below
which no renderer of that many rays can be.

Prints a table, then one JSON line.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from niwaki import _engine
from niwaki.draw.picture import surfaces
from niwaki.gallery import entries
from niwaki.shell import run_files

#: Seconds that a person should wait at most, on two quiet cores.
GOALS = {"spaceship": 0.8, "gnarly-tree": 1.2, "niwaki-tree": 2.0, "--help": 0.2, "models": 0.3}

#: What best.png is drawn with.
SIZE, SAMPLES = (960, 720), 16
BYTECODE = Path(__file__).parent / ".cache" / "bytecode"
PARTS = ("start", "compile", "target", "search", "pictures", "files")


def main(repeats: int = 3, *names: str) -> None:
    """Measure and print."""
    models = names or [
        one.name for one in entries() if one.target_name or one.drawing_name or one.score is not None
    ]
    rows = {name: waited([name], repeats) for name in ("--help", "models")}
    print(
        f"{'':<14}{'goal':>7}{'wait':>7}{'CPU':>7}"
        + "".join(f"{part:>10}" for part in PARTS)
        + f"{'Embree':>10}"
    )
    for name in models:
        with tempfile.TemporaryDirectory() as folder:
            rows[name] = waited(["grow", name, "--seed", "1", "--force", "-o", folder], repeats)
            rows[name]["embree"] = embree(Path(folder) / "run.json")
    for name, row in rows.items():
        shown = [
            GOALS.get(name),
            row["wait"],
            row["CPU"],
            *(row.get(part) for part in PARTS),
            row.get("embree"),
        ]
        widths = [7, 7, 7, *(10 for _ in PARTS), 10]
        print(
            f"{name:<14}"
            + "".join(
                f"{'-' if one is None else f'{one:.2f}':>{width}}"
                for one, width in zip(shown, widths, strict=True)
            )
        )
    print(json.dumps({"bench": "wait", "repeats": repeats, "goals": GOALS, "seconds": rows}))


def waited(words: list[str], repeats: int) -> dict[str, float | None]:
    """The fastest of some processes: seconds of the whole, and of its parts."""
    found = []
    # Bytecode is kept, as that of an installed package is; the first process may write it.
    kept = {"PYTHONDONTWRITEBYTECODE": "", "PYTHONPYCACHEPREFIX": str(BYTECODE)}
    for _ in range(repeats):
        began, before = time.perf_counter(), spent()
        command = [sys.executable, "-m", "niwaki.shell.main", *words]
        done = subprocess.run(command, capture_output=True, text=True, check=True, env={**os.environ, **kept})
        found.append((time.perf_counter() - began, spent() - before, done.stdout))
    wait, cpu, text = min(found)
    parts = {}
    if words[0] == "grow":
        last = text.splitlines()[-1].partition(": ")[2]
        parts = {part.split()[0]: float(part.split()[1]) for part in last.split(", ")}
    return {"wait": wait, "CPU": cpu, **parts}


def spent() -> float:
    """CPU seconds of all processes that were waited for."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def embree(place: Path) -> float | None:
    """Seconds for the primary rays of the best scene, with the building of the tree; None of a drawing."""
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    best = run_files.replayed(run_files.load(place), path=place)
    if best.search.score.window is not None:
        return None
    points = best.target.vertices if best.target else None
    eye, middle, up, fov = _engine.frame_camera(surfaces(best.scene), points, aspect=SIZE[0] / SIZE[1])
    origins, directions = rays(np.asarray(eye), np.asarray(middle), np.asarray(up), fov)
    began = time.perf_counter()
    scene = EmbreeScene()
    for vertices, faces, *_ in _engine.meshes([[one] for part in best.scene.parts for one in part.shapes]):
        TriangleMesh(scene, np.ascontiguousarray(vertices[faces], dtype=np.float32))
    for _ in range(SAMPLES):
        hit = scene.run(origins, directions)
    assert (hit >= 0).any(), "no ray meets the scene"
    return time.perf_counter() - began


def rays(eye: np.ndarray, middle: np.ndarray, up: np.ndarray, fov: float) -> tuple[np.ndarray, np.ndarray]:
    """A ray through the middle of each pixel, (pixels, 3) twice."""
    ahead = (middle - eye) / np.linalg.norm(middle - eye)
    right = np.cross(ahead, up)
    right /= np.linalg.norm(right)
    above = np.cross(right, ahead)
    width, height = SIZE
    high = np.tan(np.radians(fov) / 2.0)
    x = ((np.arange(width) + 0.5) / width * 2.0 - 1.0) * high * width / height
    y = (1.0 - (np.arange(height) + 0.5) / height * 2.0) * high
    across, down = np.meshgrid(x, y)
    directions = ahead + across.reshape(-1, 1) * right + down.reshape(-1, 1) * above
    origins = np.broadcast_to(eye, directions.shape)
    return np.ascontiguousarray(origins, dtype=np.float32), np.ascontiguousarray(directions, dtype=np.float32)


if __name__ == "__main__":
    main(*(int(word) if word.isdecimal() else word for word in sys.argv[1:]))
