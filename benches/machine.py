"""How fast particles step, beside WebPPL (the peer) and particle filters written by hand (the limit).

    make bench                                 # or: .venv/bin/python benches/machine.py [SECONDS] [SEED]

Two programs, each in three systems, one after the other on one thread in one run: a hidden Markov chain of
100 steps with 1000 particles, and a recursive branching program with 300. All resample at every factor. The
rate is particle-steps per second of the process's CPU time. A particle-step is a call that draws choices and
meets a factor; particles that ended take none.

Every run of every system gives an estimate of the evidence, and the mean of the estimates must be the answer
that `answers.py` computes without sampling: a fast wrong answer fails.

Prints a JSON line for each measurement (with the answer, not every estimate), then a table. Needs node, npm and
cargo for the peers.
"""

import json
import math
import os
import platform
import shutil
import statistics
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import answers
import data
import niwaki
from models import branching, hmm
from rich.console import Console
from rich.table import Table

HERE = Path(__file__).resolve().parent
CACHE = HERE / ".cache"
WEBPPL = CACHE / "webppl"
PARTICLES = {"hmm": 1000, "branching": 300}
# Standard errors that the mean of the evidence estimates may lie from the answer. 4.9 for a normal mean is a
# false alarm in a million; the estimates are skewed and a peer may give only four, so count on one in ten
# thousand.
ALLOWED = 4.9


@dataclass(frozen=True)
class Measurement:
    """One system on one program: particle-steps, their CPU seconds, log evidence of each run (nats)."""

    system: str
    program: str
    particles: int
    seed: int
    steps: int
    cpu_seconds: float
    log_evidence: list[float]

    @property
    def rate(self) -> float:
        """Particle-steps per CPU second."""
        return self.steps / self.cpu_seconds

    def off(self, answer: float, spread: float) -> float:
        """How many standard errors the mean evidence lies from the answer.

        The estimates themselves are unbiased, their logarithms are not. `spread` is the standard deviation of
        one estimate as a share of the answer: the limit's, which has thousands of runs where a peer has four.
        """
        mean = statistics.fmean(math.exp(estimate - answer) for estimate in self.log_evidence)
        return (mean - 1) * math.sqrt(len(self.log_evidence)) / spread


def main(seconds: float = 3.0, seed: int = 1) -> int:
    """Measure, print, and return 1 when an answer is wrong."""
    chain = data.write(CACHE / "data")
    webppl = prepare_webppl()
    limit = prepare_limit()
    console, wrong = Console(), 0
    table = Table("program", "rows", "system", "steps/s", "/ WebPPL", "/ limit", "runs", "off, s.e.")
    known = {"hmm": answers.hmm(data.hmm()), "branching": answers.branching()}
    for program, particles in PARTICLES.items():
        file = str(chain) if program == "hmm" else "-"
        arguments = [program, file, str(particles), str(seconds), str(seed)]
        measured = [
            peer("node", str(HERE / "webppl" / "bench.js"), str(webppl), *arguments),
            peer(str(limit), *arguments),
            niwaki_rate(program, particles, seconds, seed),
        ]
        rates = {measurement.system: measurement.rate for measurement in measured}
        spread = statistics.stdev(math.exp(e - known[program]) for e in measured[1].log_evidence)
        for measurement in measured:
            off = measurement.off(known[program], spread)
            wrong += abs(off) > ALLOWED
            evidence = {"runs": len(measurement.log_evidence), "log_evidence": known[program]}
            print(
                json.dumps(
                    asdict(measurement) | evidence | {"rate": measurement.rate, "off": off} | machine()
                )
            )
            table.add_row(
                program,
                str(particles),
                measurement.system,
                f"{measurement.rate / 1e6:.3g} M",
                f"{measurement.rate / rates['webppl']:.3g}",
                f"{measurement.rate / rates['limit']:.3g}",
                str(len(measurement.log_evidence)),
                f"{off:+.1f}{' WRONG' if abs(off) > ALLOWED else ''}",
            )
    console.print(table)
    return int(wrong > 0)


def niwaki_rate(program: str, particles: int, seconds: float, seed: int) -> Measurement:
    """Our own side: particles over the same program, on one thread, for `seconds` of CPU time.

    The CPU time is that of the searches, not of turning the particles' values into Python objects: the peers give
    no values at all.
    """
    model = {"hmm": hmm.loop, "branching": branching.tree}[program]
    method = niwaki.smc(particles=particles, order="depth-first")
    niwaki.run(model, method=method, seed=0, threads=1)
    steps, cpu, evidence = 0, 0.0, []
    while cpu < seconds:
        result = niwaki.run(model, method=method, seed=seed + len(evidence), threads=1)
        steps, cpu = steps + result.info.steps, cpu + result.cpu_seconds
        evidence.append(result.log_evidence)
    return Measurement("niwaki", program, particles, seed, steps, cpu, evidence)


def peer(*command: str) -> Measurement:
    """The one JSON line of a peer."""
    line = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return Measurement(**json.loads(line))


def prepare_webppl() -> Path:
    """Install WebPPL at the version that its lock file pins, once, and return its folder."""
    installed = WEBPPL / "node_modules" / "webppl"
    stamp, lock = WEBPPL / "installed", (HERE / "webppl" / "package-lock.json").read_text()
    if stamp.exists() and stamp.read_text() == lock:
        return installed
    WEBPPL.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(HERE / "webppl" / name, WEBPPL / name)
    run("npm", "ci", "--silent", "--no-fund", "--no-audit", "--ignore-scripts", folder=WEBPPL)
    stamp.write_text(lock)
    return installed


def prepare_limit() -> Path:
    """Build the filters written by hand and return the program."""
    target = CACHE / "limit"
    build = "cargo build --release --locked --quiet --target-dir".split()
    run(*build, str(target), folder=HERE / "limit")
    return target / "release" / "limit"


def run(*command: str, folder: Path) -> None:
    """Run a command that must succeed, or say what is missing."""
    if shutil.which(command[0]) is None:
        sys.exit(f"this bench needs `{command[0]}`; install it and try again")
    subprocess.run(command, cwd=folder, check=True)


def machine() -> dict[str, str]:
    """Return the machine to which the numbers belong."""
    return {
        "processor": platform.processor() or platform.machine(),
        "cores": str(os.cpu_count()),
        "python": platform.python_version(),
        "date": time.strftime("%Y-%m-%d"),
    }


if __name__ == "__main__":
    sys.exit(main(*(kind(word) for kind, word in zip((float, int), sys.argv[1:], strict=False))))
