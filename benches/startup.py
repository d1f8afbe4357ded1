"""The time before anything runs: `import niwaki`, and compiling the spaceship.

    .venv/bin/python benches/startup.py [PROCESSES]

Each figure is measured in fresh processes, so that nothing is warm but the disk. Compiling is measured twice in
each: the first time with the front end's own imports, and again without them. Prints one JSON line with the
median and the largest of each figure in seconds, beside the budgets that people feel (0.3 s and 0.05 s).
"""

import json
import statistics
import subprocess
import sys

BUDGETS = {"import": 0.3, "compile": 0.05}

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


def main(processes: int = 10) -> None:
    """Measure and print."""
    runs = []
    for _ in range(processes):
        line = subprocess.run(
            [sys.executable, "-c", PROGRAM], check=True, capture_output=True, text=True
        ).stdout
        runs.append(json.loads(line))
    figures = {
        name: {"median": statistics.median(r[name] for r in runs), "max": max(r[name] for r in runs)}
        for name in runs[0]
    }
    print(json.dumps({"bench": "startup", "processes": processes, "seconds": figures, "budgets": BUDGETS}))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
