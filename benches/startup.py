"""The time before anything runs: `import niwaki`, compiling the spaceship, and the machine code of the tree.

    .venv/bin/python benches/startup.py [PROCESSES]

Each figure is measured in fresh processes, so that nothing is warm but the disk. Compiling is measured twice in
each: the first time with the front end's own imports, and again without them. Machine code is written by a thread of
its own while runs go on: its figure is the processor time of that thread, by the kernel's account, after searches of
some seconds. Prints one JSON line with the least, the median and the largest of each figure in seconds, beside the
budgets that people feel (0.3 s and 0.05 s) and that of a thread in the background (0.02 s).
"""

import json
import statistics
import subprocess
import sys

BUDGETS = {"import": 0.3, "compile": 0.05, "code": 0.02}

PROGRAM = """
import json, time
start = time.perf_counter()
import niwaki
imported = time.perf_counter()
from niwaki.lang.compiled import compile_core
from niwaki.gallery.spaceship import spaceship
from niwaki.lang.lower import lower
loaded = time.perf_counter()
compile_core(lower(spaceship.function))
first = time.perf_counter()
program = compile_core(lower(spaceship.function))
again = time.perf_counter()
print(json.dumps({
    "import": imported - start, "front_end": loaded - imported, "compile": first - loaded, "again": again - first,
}))
"""

CODE = """
import json, time
from pathlib import Path
import niwaki
from niwaki import gallery
tree = gallery.entry("niwaki-tree").model
begun = time.perf_counter()
while time.perf_counter() - begun < 4.0:
    niwaki.run(tree, method=niwaki.smc(100), seed=1, threads=1)
(writer,) = [task for task in Path("/proc/self/task").iterdir() if (task / "comm").read_text() == "machine code\\n"]
print(json.dumps({"code": int((writer / "schedstat").read_text().split()[0]) * 1e-9}))
"""


def measured(program: str) -> dict[str, float]:
    """What a program prints in a fresh process."""
    command = [sys.executable, "-c", program]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def main(processes: int = 10) -> None:
    """Measure and print."""
    runs = [measured(PROGRAM) | measured(CODE) for _ in range(processes)]
    figures = {}
    for name in runs[0]:
        all_of = [run[name] for run in runs]
        figures[name] = {"least": min(all_of), "median": statistics.median(all_of), "most": max(all_of)}
    print(json.dumps({"bench": "startup", "processes": processes, "seconds": figures, "budgets": BUDGETS}))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
