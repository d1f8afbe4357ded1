"""Mutated sources of models: each is a model or gives a message, in time; plain Python and the engine agree.

    python tests/fuzz/sources.py [SECONDS] [SEED]

The sources are the gallery, the programs of the language's specification, the features and random programs of the
agreement tests. Their tokens are deleted, doubled, exchanged, replaced by those of others; lines are taken from other
sources; names are made the same, so that they shadow each other. A child process reads the sources as `niwaki check`
does, each in a file of its own, and runs those that are models: the engine's choices are given to plain Python, and
those of plain Python to the engine. A source that takes the child down is a finding.
"""

from __future__ import annotations

import json
import os
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / part) for part in ("fuzz", "agreement", "language")]

from reports import Report, report  # noqa: E402

#: Compiling a source may take so many seconds, and the process so many bytes.
SECONDS, BYTES = 5.0, 1 << 30
#: A run of a model in plain Python, which has no budget, is given up after so many seconds.
PATIENCE = 2
#: Steps of a run; the child's address space.
STEPS, SPACE = 20_000, 4 << 30
#: A child that says nothing for so many seconds hangs.
HANGS = 60
#: Sources of one child.
BATCH = 200
#: What only one of the two looks at: bounds, and two values of a query, which the engine sees when a run is read.
ONE_SIDED = {"too-deep", "memory-budget", "step-budget", "query-twice"}

TOKEN = re.compile(
    r"[A-Za-z_]\w*|\d[\w.]*|\"[^\"\n]*\"|'[^'\n]*'|\*\*|//|[<>=!:+*/-]=|->|\n[ ]*|[ ]+|.", re.DOTALL
)
#: Tokens at which something changes.
WORDS = (
    "0 1 -1 2 10**20 2**63 -2**63 1e308 1e-320 0.0 -0.0 float('nan') None True () [] {} '' x y n not in is and or if "
    "else for while break continue return lambda def def* *args **kwargs := == < ** // % @ . , : yield await global "
    "import del try class sample factor emit future force infer observe condition query range len sum sorted"
).split()


def originals() -> list[str]:
    """Sources that are models."""
    from features import FEATURES, feature
    from specification import PRELUDE, cases

    files = sorted((ROOT / "python/niwaki/gallery").glob("*.py")) + sorted(
        (ROOT / "benches/models").glob("*.py")
    )
    sources = [path.read_text() for path in files if "@model" in path.read_text()]
    for page in sorted((ROOT / "tests/language").glob("*.md")):
        sources += [PRELUDE + case.program for case in cases(page)]
    return sources + [feature(name) for name in FEATURES]


class Mutator:
    """Makes sources from sources."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.originals = originals()

    def source(self) -> str:
        """A source that is changed in one to four places; nearly always one that Python can read."""
        text = self.changed()
        while self.random.random() < 0.95 and not readable(text):
            text = self.changed()
        return text

    def changed(self) -> str:
        """An original, changed in one to four places."""
        pick = self.random
        if pick.random() < 0.4:
            from programs import program

            text = program(pick.randrange(2**31)).text
        else:
            text = pick.choice(self.originals)
        for _ in range(pick.choice((1, 1, 1, 2, 4))):
            changed = pick.choice((self.tokens, self.tokens, self.tokens, self.lines, self.names))
            text = changed(text)
        return text

    def tokens(self, text: str) -> str:
        """One token is deleted, doubled, exchanged with another, or replaced."""
        pick, tokens = self.random, TOKEN.findall(text)
        worth = [at for at, token in enumerate(tokens) if token.strip()]
        if not worth:
            return text
        # A source is mostly a few long functions: what is near is more often of one kind.
        at = pick.choice(worth)
        other = pick.choice([k for k in worth if abs(k - at) < 60])
        match pick.randrange(6):
            case 0:
                del tokens[at]
            case 1:
                tokens.insert(at, tokens[at])
            case 2:
                tokens[at], tokens[other] = tokens[other], tokens[at]
            case 3:
                tokens[at] = tokens[other]
            case 4:
                tokens[at] = pick.choice(WORDS)
            case _:
                tokens[at] = pick.choice(TOKEN.findall(pick.choice(self.originals)))
        return "".join(tokens)

    def lines(self, text: str) -> str:
        """Lines are deleted, doubled, moved, indented, or taken from another source."""
        pick, lines = self.random, text.splitlines()
        if not lines:
            return text
        at, size = pick.randrange(len(lines)), pick.randint(1, 3)
        match pick.randrange(6):
            case 0:
                del lines[at : at + size]
            case 1:
                lines[at:at] = lines[at : at + size]
            case 2:
                lines[at] = pick.choice(("    ", " ", "")) + lines[at].removeprefix("    ")
            case 3:
                to = pick.randrange(len(lines))
                lines[to:to] = lines[at : at + size]
            case _:
                other = pick.choice(self.originals).splitlines()
                start = pick.randrange(len(other))
                block = other[start : start + size]
                # As deep as the line that it stands before.
                here = len(lines[at]) - len(lines[at].lstrip())
                there = len(block[0]) - len(block[0].lstrip())
                lines[at:at] = [
                    " " * max(0, len(t) - len(t.lstrip()) + here - there) + t.lstrip() for t in block
                ]
        return "\n".join(lines) + "\n"

    def names(self, text: str) -> str:
        """One name becomes another of the same source, everywhere or in one place: it shadows it."""
        pick = self.random
        assigned = re.findall(
            r"(?m)^\s*([A-Za-z_]\w*)\s*=|for (\w+) in|def (\w+)\(|[(,]\s*(\w+)\s*[,)=]", text
        )
        names = sorted({name for names in assigned for name in names if name})
        if len(names) < 2:
            return text
        old, new = pick.sample(names, 2)
        places = list(re.finditer(rf"\b{re.escape(old)}\b", text))
        if places and pick.random() < 0.5:
            places = [pick.choice(places)]
        for place in reversed(places):
            text = text[: place.start()] + new + text[place.end() :]
        return text


def readable(text: str) -> bool:
    """Whether it is Python at all."""
    try:
        compile(text, "source", "exec", dont_inherit=True)
    except (SyntaxError, ValueError, RecursionError, MemoryError, OverflowError):
        return False
    return True


class Late(BaseException):
    """Plain Python takes too long."""


@contextmanager
def within(seconds: float) -> Iterator[None]:
    """Raises `Late` after so many seconds."""

    def late(*_: Any) -> None:
        raise Late

    before = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def judged(path: Path) -> tuple[str, str]:
    """Return the outcome of a source (`refused`, `parameters`, `runs`, `fails`), and what is wrong, if anything."""
    import niwaki as nw
    from niwaki.errors import NiwakiError
    from niwaki.lang.plain import run_python
    from niwaki.shell.references import find
    from test_engine import compared, facts

    def attempt(run: Any, *args: Any, **settings: Any) -> Any:
        try:
            return facts(run(*args, **settings))
        except NiwakiError as error:
            return error

    def engine(**settings: Any) -> Any:
        return attempt(lambda: nw.run(model, max_steps=STEPS, max_memory=1 << 26, **settings).best)

    def plain(**settings: Any) -> Any:
        with within(PATIENCE):
            return attempt(run_python, model, **settings)

    try:
        # The file's own lines run here: what they take is theirs.
        with within(PATIENCE):
            model = find(str(path)).model
    except (NiwakiError, Late):
        return "refused", ""
    began = time.monotonic()
    try:
        core = model.core()
        model.program()
    except NiwakiError as error:
        return "refused", "" if str(error) else "an error without a message"
    finally:
        spent = time.monotonic() - began
    if spent > SECONDS:
        return "slow", f"compiled in {spent:.1f} s"
    if core.required:
        return "parameters", ""
    there = engine(seed=1)
    try:
        if isinstance(there, dict):
            return "runs", compared(plain(choices=there["choices"]), there)
        reference = plain(seed=1)
    except Late:
        return "late", ""
    if isinstance(reference, dict):
        there = engine(choices=reference["choices"])
    if any(isinstance(run, NiwakiError) and run.code in ONE_SIDED for run in (reference, there)):
        return "one-sided", ""
    return "fails", compared(reference, there)


def child(first: int, count: int, folder: Path) -> None:
    """Judges sources by number; a line of JSON before and after each."""
    resource.setrlimit(resource.RLIMIT_AS, (SPACE, SPACE))
    warnings.simplefilter("ignore")
    mutator = Mutator(first)
    # What the sources print is theirs.
    out = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    os.chdir(folder)
    # A process that was forked begins with the peak of its parent.
    start = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for number in range(count):
        path = folder / f"source{number}.py"
        path.write_text(mutator.source())
        print(json.dumps({"begins": str(path)}), file=out, flush=True)
        began = time.monotonic()
        try:
            became, wrong = judged(path)
        except BaseException:
            became, wrong = "broken", traceback.format_exc(limit=-6)
        if resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - start << 10 > BYTES:
            wrong = wrong or "the process has grown beyond a gigabyte"
        ends = {"became": became, "wrong": wrong, "seconds": time.monotonic() - began}
        print(json.dumps(ends), file=out, flush=True)
        if wrong.startswith("the process"):
            break


def batch(seed: int, seconds: float, folder: Path, to: Report) -> None:
    """One child, until its sources are done or the time is over."""
    command = [sys.executable, __file__, "--child", str(seed), str(BATCH), str(folder)]
    error = folder / "stderr"
    with (
        error.open("w") as stderr,
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=stderr, text=True) as run,
    ):
        path, ended, began = None, True, time.monotonic()
        signal.signal(signal.SIGALRM, lambda *_: run.kill())
        assert run.stdout is not None
        for line in run.stdout:
            report = json.loads(line)
            signal.alarm(HANGS)
            if "begins" in report:
                path, ended = Path(report["begins"]), False
                continue
            ended = True
            to.tried(report["became"])
            if report["wrong"]:
                to.finding(path.read_text() if path else "", ".py", report["wrong"])
            if time.monotonic() - began > seconds:
                run.kill()
                break
        signal.alarm(0)
    if path and not ended:
        to.finding(
            path.read_text(), ".py", f"the child ended with {run.returncode}\n{error.read_text()[-2000:]}"
        )


def fuzz(seconds: float, seed: int, to: Report) -> None:
    """Children one after the other."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        with tempfile.TemporaryDirectory() as folder:
            batch(seed, end - time.monotonic(), Path(folder), to)
        seed += 1


if __name__ == "__main__":
    if sys.argv[1:2] == ["--child"]:
        child(int(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4]))
    else:
        report("sources", fuzz)
