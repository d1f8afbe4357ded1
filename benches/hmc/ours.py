"""Our chains, as the engine runs them on a recorded density, and the limit: chains with gradients by hand."""

import json
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from machine import CACHE, HERE, prepare_limit

from hmc import densities
from hmc.peers import Run

REPOSITORY = HERE.parent
DRAWING = HERE / "hmc" / "coloring.txt"
REFERENCE = HERE / "hmc" / "reference.txt"


@dataclass(frozen=True)
class Programs:
    """Where they are."""

    chains: Path
    limit: Path

    @classmethod
    def prepared(cls) -> "Programs":
        """Build both; the engine's in the repository's own target folder, as `make test` does."""
        build = "cargo build --release --locked --quiet --workspace --example trajectories".split()
        subprocess.run(build, cwd=REPOSITORY, check=True)
        target = Path(os.environ.get("CARGO_TARGET_DIR", REPOSITORY / "target"))
        return cls(target / "release" / "examples" / "trajectories", prepare_limit())

    def start(self, model: str) -> dict[str, Any]:
        """Milliseconds until the first gradient and until machine code."""
        return read(self.chains, "start", model)

    def check(self, model: str) -> list[tuple[str, dict[str, Any]]]:
        """Worst relative errors of values and gradients, ours and the limit's."""
        errors = [("niwaki", read(self.chains, "check", model))]
        if model != "stack":
            errors.append(("limit", read(self.limit, "gradients", model, DRAWING, REFERENCE)))
        return errors

    def chain(self, model: str, point: np.ndarray, draws: int, seed: int, lanes: bool = False) -> Run:
        """One chain with machine code, or 64 in lanes; draws are those of the first."""
        words = (densities.STEP_SIZES[model], densities.STEPS[model], draws, seed)
        out = CACHE / "hmc.draws"
        mode = "lanes" if lanes else "chain"
        return run(read(self.chains, mode, model, written(point), *words, out), out, model, draws)

    def nuts(self, model: str, point: np.ndarray, warmup: int, draws: int, seed: int) -> Run:
        """The no-U-turn sampler with its own warm-up; machine code is compiled during the run."""
        out = CACHE / "hmc.draws"
        record = read(self.chains, "nuts", model, written(point), warmup, draws, seed, out)
        return run(record, out, model, draws)

    def by_hand(self, model: str, point: np.ndarray, draws: int, seed: int) -> Run:
        """One chain of the limit; no draws are kept."""
        words = (densities.STEP_SIZES[model], densities.STEPS[model], draws, seed)
        record = read(self.limit, "hmc", model, DRAWING, written(point), *words)
        return Run(
            record["gradients"], record["seconds"], record["cpu_seconds"], record["accept"], np.empty(0)
        )


def written(point: np.ndarray) -> Path:
    """A point as a file."""
    path = CACHE / "hmc.point"
    np.savetxt(path, point, fmt="%.17g")
    return path


def run(record: dict[str, Any], out: Path, model: str, draws: int) -> Run:
    """The output of a program, and what it wrote."""
    rows = np.fromfile(out).reshape((-1, densities.DIMS[model]))[:draws]
    return Run(record["gradients"], record["seconds"], record["cpu_seconds"], record["accept"], rows)


def read(*command: object) -> dict[str, Any]:
    """The JSON line that a command prints."""
    words = [str(word) for word in command]
    return json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
