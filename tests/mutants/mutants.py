"""Deliberate errors in the engine and in the package, each of which a test must reject: `make mutants`.

`mutants.toml` holds one entry for each error: a file, the text that is there, the text of the error, and the
judge, which is the tests that must fail. The sources are copied to `target/mutants/tree`, so that the working tree is
never changed. Each judge first passes there without any error. Then, for each entry, the text is replaced, the judge is
built and run, and the text is put back.

| outcome  | what happened                                                      |
| -------- | ------------------------------------------------------------------ |
| caught   | each pattern of the judge has a test that failed                   |
| survived | some pattern has none                                              |
| timeout  | the judge was not done after five times its usual time and a minute |
| no build | the error does not compile: an error of the entry                  |

The table goes to `out/mutants.md`, with times. A name as argument (`make mutants ONLY=name`) runs that entry alone;
part of a name runs all entries that have it. `--page` writes the table of the manual's page and runs nothing.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LIST = ROOT / "tests" / "mutants" / "mutants.toml"
PAGE = ROOT / "docs" / "guide" / "mutants.md"
REPORT = ROOT / "out" / "mutants.md"
SCRATCH = ROOT / "target" / "mutants"
TREE = SCRATCH / "tree"

CRATES = sorted(manifest.parent.name for manifest in (ROOT / "crates").glob("*/Cargo.toml"))
# Builds that take seconds: incremental, in many units, without debugging information. Third-party crates are built
# once, as for a release.
OWN_SETTINGS = ("codegen-units=64", "debug=false")
QUICK = ["profile.release.incremental=true"]
QUICK += [f"profile.release.package.niwaki-{crate}.{key}" for crate in CRATES for key in OWN_SETTINGS]
#: What cargo needs to build the crates and their tests, and pytest for the package.
SOURCES = ["Cargo.toml", "Cargo.lock", "crates", "benches/hmc", "pyproject.toml", "python", "tests"]
#: The engine as Python loads it; it is built, and not among the sources.
ENGINE = "python/niwaki/_engine.abi3.so"
#: The command that builds the engine for judges in Python.
BUILD_ENGINE = ["cargo", "build", "--locked", "--quiet", "-p", "niwaki-py"]
BUILD_LIMIT = 1800.0  # seconds
#: A line of pytest: the test's name, and how it ended.
PYTEST = r"^\S+::(\S+) (PASSED|FAILED)"
MARKS = ("<!-- table of mutants: begin -->", "<!-- table of mutants: end -->")


@dataclass(frozen=True)
class Judge:
    """Tests of one target: `infer chain: board calibration` is `cargo test -p niwaki-search --test chain` of both.

    `python studio/test_variety: order` are the tests of `tests/niwaki/studio/test_variety.py` with that name.
    """

    crate: str
    target: str
    patterns: tuple[str, ...]

    @staticmethod
    def read(text: str) -> "Judge":
        match = re.fullmatch(r"(\w+) ([\w/]+): (\S+(?: \S+)*)", text)
        if not match or match[1] not in (*CRATES, "python"):
            raise ValueError(f"the judge `{text}` is not of the form `crate target: pattern ...`")
        return Judge(match[1], match[2], tuple(match[3].split()))

    def __str__(self) -> str:
        return f"{self.crate} {self.target}: {' '.join(self.patterns)}"

    def command(self) -> list[str]:
        if self.crate == "python":
            return [
                sys.executable,
                "-m",
                "pytest",
                "-vv",
                "-p",
                "no:cacheprovider",
                f"tests/niwaki/{self.target}.py",
            ]
        config = [word for line in QUICK for word in ("--config", line)]
        target = ["--lib"] if self.target == "lib" else ["--test", self.target]
        return [
            "cargo",
            "test",
            "--release",
            "--locked",
            "--quiet",
            *config,
            "-p",
            f"niwaki-{self.crate}",
            *target,
        ]


@dataclass(frozen=True)
class Mutant:
    """One deliberate error."""

    name: str
    breaks: str
    file: str
    old: str
    new: str
    judge: Judge
    survives: str | None = None

    def applied(self, text: str) -> str:
        """The file's text with the error."""
        if text.count(self.old) != 1:
            raise ValueError(
                f"{self.name}: its text stands {text.count(self.old)} times in {self.file}, expected once"
            )
        return text.replace(self.old, self.new)


def entries() -> list[Mutant]:
    """The entries of the list."""
    read = tomllib.loads(LIST.read_text(encoding="utf-8"))["mutant"]
    known = {"name", "breaks", "file", "from", "to", "judge", "survives"}
    for entry in read:
        if extra := set(entry) - known:
            raise ValueError(f"{entry.get('name')}: unknown keys {sorted(extra)}")
    return [
        Mutant(
            e["name"], e["breaks"], e["file"], e["from"], e["to"], Judge.read(e["judge"]), e.get("survives")
        )
        for e in read
    ]


def copy_sources() -> None:
    """Makes the scratch tree equal to the sources; equal files keep their time, so nothing is rebuilt."""
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run([*command, *SOURCES], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    names = {name for name in listed.split("\0") if name and (ROOT / name).is_file()}
    for old in [path for path in TREE.rglob("*") if path.is_file()]:
        if old.relative_to(TREE).as_posix() not in names:
            old.unlink()
    for name in names:
        (TREE / name).parent.mkdir(parents=True, exist_ok=True)
        text = (ROOT / name).read_bytes()
        if not (TREE / name).is_file() or (TREE / name).read_bytes() != text:
            (TREE / name).write_bytes(text)
    if (ROOT / ENGINE).is_file():
        shutil.copy2(ROOT / ENGINE, TREE / ENGINE)


def run(command: list[str], limit: float) -> tuple[int | None, str, float]:
    """Status (None: too long), its output, seconds."""
    of_engine = {"PYO3_BUILD_EXTENSION_MODULE": "1", "PYO3_PYTHON": sys.executable}
    of_tree = {"CARGO_TARGET_DIR": str(SCRATCH / "build"), "PYTHONPATH": str(TREE / "python")}
    env = {**os.environ, **of_engine, **of_tree}
    start = time.monotonic()
    with subprocess.Popen(
        command,
        cwd=TREE,
        env=env,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    ) as process:
        try:
            output, _ = process.communicate(timeout=limit)
            status: int | None = process.returncode
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            output, _ = process.communicate()
            status = None
        except KeyboardInterrupt:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    return status, output, time.monotonic() - start


@dataclass
class Outcome:
    """The outcome of a judge's tests."""

    state: str
    failed: list[str]
    build: float
    took: float
    output: str


def judged(judge: Judge, limit: float) -> Outcome:
    """Builds a judge and runs it; `passed` where no test of it failed."""
    if judge.crate == "python":
        # The engine of the tree, which a mutant in Rust changes; cargo builds it only where it is not up to date.
        status, output, build = run(BUILD_ENGINE, BUILD_LIMIT)
        if status != 0:
            return Outcome("no build", [], build, 0.0, output)
        shutil.copy2(SCRATCH / "build/debug/lib_engine.so", TREE / ENGINE)
        status, output, took = run([*judge.command(), "-k", " or ".join(judge.patterns)], limit)
        ended = {
            name: "FAILED" if how == "FAILED" else "ok" for name, how in re.findall(PYTEST, output, re.M)
        }
        return outcome(judge, status, output, build, took, ended)
    status, output, build = run([*judge.command(), "--no-run"], BUILD_LIMIT)
    if status != 0:
        return Outcome("no build", [], build, 0.0, output)
    # Not quiet: the names of the tests.
    command = [word for word in judge.command() if word != "--quiet"]
    status, output, took = run([*command, "--", *judge.patterns], limit)
    ended = dict(re.findall(r"^test (\S+).* \.\.\. (?:.*\n)*?.*?(ok|FAILED|ignored)$", output, re.M))
    return outcome(judge, status, output, build, took, ended)


def outcome(
    judge: Judge, status: int | None, output: str, build: float, took: float, ended: dict[str, str]
) -> Outcome:
    """Return the outcome of a judge from the results of its tests."""
    if status is None:
        return Outcome("timeout", [], build, took, output)
    failed = sorted(name for name, how in ended.items() if how == "FAILED")
    unmatched = [p for p in judge.patterns if not any(p in name for name in ended)]
    # A process that crashed names no test that failed.
    if unmatched and status == 0:
        return Outcome("no test", unmatched, build, took, output)
    if status == 0:
        return Outcome("passed", [], build, took, output)
    if not failed:
        return Outcome("crashed", [], build, took, output)
    return Outcome("failed", failed, build, took, output)


def verdict(mutant: Mutant, outcome: Outcome) -> str:
    """Return the verdict on a mutant: caught, survived, or the failure of the judge."""
    if outcome.state in ("crashed", "timeout", "no build"):
        return outcome.state
    rejects = all(any(pattern in name for name in outcome.failed) for pattern in mutant.judge.patterns)
    return "caught" if rejects else "survived"


def short(name: str) -> str:
    """A test's name without the modules around it."""
    return name.rsplit("::", 1)[-1]


def page_table(all_of_them: list[Mutant]) -> str:
    """The table of the manual's page: what is broken, and which tests reject it."""
    lines = ["| mutant | what is broken | rejected by |", "| --- | --- | --- |"]
    for m in all_of_them:
        tests = ", ".join(f"`{pattern}`" for pattern in m.judge.patterns)
        where = f"{m.judge.crate}, {'unit tests' if m.judge.target == 'lib' else m.judge.target}: {tests}"
        lines.append(f"| `{m.name}` | {m.breaks} | {'nothing: ' + m.survives if m.survives else where} |")
    return "\n".join(lines)


def page_with_table(page: str, all_of_them: list[Mutant]) -> str:
    """The manual's page with the table of these mutants."""
    head, rest = page.split(MARKS[0])
    _, tail = rest.split(MARKS[1])
    return f"{head}{MARKS[0]}\n\n{page_table(all_of_them)}\n\n{MARKS[1]}{tail}"


def main(arguments: list[str]) -> int:
    """Runs the mutants that the arguments name, or all."""
    every = entries()
    if arguments == ["--page"]:
        PAGE.write_text(page_with_table(PAGE.read_text(encoding="utf-8"), every), encoding="utf-8")
        return 0
    chosen = [m for m in every if not arguments or any(part in m.name for part in arguments)]
    if not chosen:
        print(f"no mutant is named like {arguments}", file=sys.stderr)
        return 2
    copy_sources()
    for m in chosen:
        m.applied((TREE / m.file).read_text(encoding="utf-8"))
    usual: dict[Judge, float] = {}
    for judge in dict.fromkeys(m.judge for m in chosen):
        outcome = judged(judge, BUILD_LIMIT)
        print(
            f"{outcome.state:9} {judge}, as it is: built in {outcome.build:.0f} s, ran {outcome.took:.1f} s",
            flush=True,
        )
        if outcome.state != "passed":
            print(outcome.output[-4000:], file=sys.stderr)
            print(
                f"`{judge}` must pass before it can judge ({outcome.state} {outcome.failed})", file=sys.stderr
            )
            return 2
        usual[judge] = outcome.took
    rows, bad = [], []
    for m in chosen:
        path = TREE / m.file
        text = path.read_text(encoding="utf-8")
        path.write_text(m.applied(text), encoding="utf-8")
        try:
            outcome = judged(m.judge, 60.0 + 5.0 * usual[m.judge])
        finally:
            path.write_text(text, encoding="utf-8")
        state = verdict(m, outcome)
        if state in ("survived", "no build", "crashed"):
            (SCRATCH / f"{m.name}.log").write_text(outcome.output, encoding="utf-8")
        expected = "survived" if m.survives else "caught"
        if state != expected:
            bad.append(m.name)
        tests = ", ".join(short(name) for name in outcome.failed)
        print(
            f"{state:9} {m.name}: built in {outcome.build:.0f} s, ran {outcome.took:.1f} s {tests}",
            flush=True,
        )
        rows.append(
            f"| `{m.name}` | {m.breaks} | {state} | {tests or m.survives or ''} "
            f"| {outcome.build:.0f} | {outcome.took:.1f} |"
        )
    caught = sum("| caught |" in row for row in rows)
    REPORT.parent.mkdir(exist_ok=True)
    head = [
        "| mutant | what is broken | outcome | tests that failed | build, s | judge, s |",
        "| --- " * 6 + "|",
    ]
    REPORT.write_text("\n".join([f"{caught} of {len(rows)} caught.", "", *head, *rows, ""]), encoding="utf-8")
    print(f"{caught} of {len(rows)} caught; {REPORT.relative_to(ROOT)} has the table")
    if bad:
        print(f"not as the list says: {', '.join(bad)}", file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
