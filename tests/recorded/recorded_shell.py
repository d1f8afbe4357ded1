"""Commands of the shell that are recorded: what each prints, and the files that it writes.

A command is called in a folder of its own, after the commands that it goes on from.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from digests import digest, digest_of_files, of_json
from niwaki.shell.main import app
from PIL import Image
from studio_process import PILE, serving
from typer.testing import CliRunner

TREE = ["grow", "gnarly-tree", "--seed", "1", "--quick"]
DRAWN = ["grow", "vines", "--match-image", "scribbles/008", "--seed", "1", "--no-picture"]
CHAINS = ["gmm", "points=10", "--steps", "600", "--chains", "2", "--seed", "1", "--quick"]
TRAINED = ["guide", "train", "lightning", "--targets", "pages", "--searches", "4,2", "--seed", "1"]

SPEC = """
model = "simple-ship"
seeds = 2

[grow]
voxel = 0.5

[vary.grow]
particles = [5, 10]
"""

ROOM = """
from niwaki import box

gap = 0.1
parts = {
    "bed": box((-1.2, 0.3, 0.0), (1, 0.6, 2)),
    "desk": box((-0.8 + gap, 0.4, 0.4), (1, 0.8, 0.6)),
    "shelf": box((1.7, 1.0, -0.2), (0.8, 2, 0.3)),
}
"""
SLAB = """
from niwaki import Uniform, box

def slab(width=Uniform(0.5, 9.0), height=Uniform(0.5, 9.0)):
    return box((0, height / 2, 0), (width, height, 3))
"""

#: What is called, by name; a name begins with that of its command. The last call is the one that is meant.
CALLS: dict[str, Sequence[Sequence[str]]] = {
    "models": [["models"]],
    "init": [["init", "house"]],
    "show": [["show", "spaceship", "-n", "2", "--seed", "1", "--quick"]],
    "grow improve": [[*TREE, "--rounds", "3"]],
    "grow smc": [
        [*TREE, "--particles", "30", "--runs", "2", "--resampling", "tempered", "--format", "glb,obj,ply"]
    ],
    "grow ais": [
        [
            *TREE,
            "--method",
            "ais",
            "--particles",
            "5",
            "--powers",
            "0.1,1",
            "--moves",
            "2",
            "--kernel",
            "drift(0.2)",
        ]
    ],
    "grow particle-gibbs": [[*TREE, "--method", "particle-gibbs", "--particles", "10", "--sweeps", "3"]],
    "grow pimh": [[*TREE, "--method", "pimh", "--particles", "10", "--sweeps", "3"]],
    "grow polish": [
        [*TREE, "--particles", "20", "--polish", "50", "--polish-kernel", "mixture(prior(), drift(0.1))"]
    ],
    "grow diverse": [[*TREE, "--diverse", "2", "--rounds", "1", "--export", "all"]],
    "grow guide": [[*TREE, "--guide", "shipped", "--particles", "20"]],
    "grow drawing": [
        [*DRAWN, "--particles", "20", "--format", "svg,gif", "--size", "60x60", "--frames", "3"]
    ],
    "grow circuit": [["grow", "circuit", "--particles", "10", "--seed", "1", "--quick"]],
    "grow from": [
        [*TREE, "--particles", "20", "-o", "first"],
        [*TREE, "--from", "first/run.json", "--reroll", "branch/branch", "--rounds", "2", "--seed", "3"],
    ],
    "grow json": [[*TREE, "--particles", "10", "--json"]],
    "fit": [
        "fit slab.py:slab --target gallery:ship --voxel 1 --evaluations 20 --workers 1 --seed 1 --json".split()
    ],
    "repair": ["repair room.py --workers 0 --patches 2 --write 1".split()],
    "batch": [
        ["batch", "run", "ships.toml", "--processes", "1"],
        "batch export ships --format csv,png,glb -n 3 --choices".split(),
    ],
    "replay": [
        [*TREE, "--particles", "10", "--no-picture", "-o", "first"],
        [
            "replay",
            "first/run.json",
            "-o",
            "again",
            "--quick",
            "--format",
            "glb,stl,3mf,apng",
            "--frames",
            "2",
        ],
    ],
    "check": [["check", "hmm", "steps=5", "--bytecode"]],
    "sample": [["sample", *CHAINS, "--kernel", "mixture(prior(), drift())"]],
    "sample target": [
        ["sample", "spaceship", "--target", "gallery:ship", "--steps", "300", "--seed", "1", "--quick"]
    ],
    "color": [["color", "robot", "-n", "2", "--side", "64", "--pixels", "128", "--seed", "1"]],
    "letters": [["letters", "Hi", "--seed", "1", "--particles", "10", "--searches", "2", "--width", "160"]],
    "guide train": [[*TRAINED, "-o", "lines.guide"]],
    "guide show": [[*TRAINED, "-o", "lines.guide"], ["guide", "show", "lines.guide"]],
    "explain": [["explain", "hmm", "--choice", "n[21]/state", "--seed", "0"]],
    "doctor": [["doctor"]],
}


def of_commands() -> Iterator[tuple[str, Callable[[], str]]]:
    """Every command of the shell: functions that give the digest itself."""
    for name, calls in CALLS.items():
        yield f"shell {name}", partial(called, calls)
    yield "shell studio", served


@contextmanager
def place() -> Iterator[Path]:
    """A folder with what the commands read, where they are called."""
    before = Path.cwd()
    with TemporaryDirectory() as name:
        folder = Path(name).resolve()
        (folder / "ships.toml").write_text(SPEC)
        (folder / "slab.py").write_text(SLAB)
        (folder / "room.py").write_text(ROOM)
        (folder / "requirements.toml").write_text("collisions = false\nwithin = [[-2, 0, -2], [2, 3, 2]]\n")
        (folder / "pages").mkdir()
        for number in range(4):
            page = np.full((100, 100), 255, dtype=np.uint8)
            page[10:90, 30 + 4 * number : 45 + 4 * number] = 0
            Image.fromarray(page).save(folder / "pages" / f"{number}.png")
        os.chdir(folder)
        try:
            yield folder
        finally:
            os.chdir(before)


def called(calls: Sequence[Sequence[str]]) -> str:
    """Return the digest of the last call's output and of all files after it."""
    with place() as folder:
        before = written(folder)
        for words in calls:
            done = CliRunner().invoke(app, list(words))
            if done.exit_code != 0:
                raise RuntimeError(f"{' '.join(words)}: {done.output}") from done.exception
        output = "\n".join(core_lines(done.stdout)) if words[0] == "doctor" else done.stdout
        return digest_of_files(folder, written(folder) - before, output)


def written(folder: Path) -> set[str]:
    """The files of a folder; of a batch those that it exports, because its segments hold times."""
    names = {file.relative_to(folder).as_posix() for file in folder.rglob("*") if file.is_file()}
    return {name for name in names if not re.match(r"ships/(?!results\.csv|sheet\.png|meshes/)", name)}


def core_lines(report: str) -> Iterator[str]:
    """Yield the lines about the core from the report of `niwaki doctor`."""
    _, _, core = report.partition("\nCore: ")
    yield from core.partition("\n\n")[0].splitlines()


def served() -> str:
    """The digest of a model's results in the studio."""
    from niwaki import studio  # needs an extra

    with TemporaryDirectory() as name:
        model, folder = Path(name) / "pile.py", Path(name) / "session"
        model.write_text(PILE)
        with serving(folder, model) as served, studio.connect(served.url, served.key) as connected:
            connected.ask("model", reference="spaceship")
            connected.ask("set", settings={"count": 2, "seed": 1, "effort": 0.25})
            connected.ask("run")
            return digest([connected.view["results"], of_json(folder / "runs" / "0.json")])
