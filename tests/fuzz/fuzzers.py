"""Runs the fuzzers, each for a time, and prints what they tried and found; `make fuzz`.

    python tests/fuzz/fuzzers.py [--minutes M] [--jobs J] [--only NAME ...] [--corpora]

The fuzzers of the engine are in `fuzz/`, targets of cargo-fuzz. They are built with the address sanitizer where a
nightly toolchain is installed, and without it on the stable one. Those in Python are the other files here: each takes
seconds and a seed, and ends with a line of JSON.

A target starts from its corpus, `fuzz/corpora/NAME.zip`, and keeps what it finds in `fuzz/corpus/NAME`, which git
ignores. `--corpora` runs nothing: it packs the smallest inputs that reach all that was reached, as many as fit.

Exit code 1 with findings. Their inputs are in `fuzz/artifacts` and `out/fuzz`; `cargo fuzz run NAME FILE` repeats one.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import resource
import secrets
import shutil
import subprocess
import sys
import time
import tomllib
import zipfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ENGINE = ROOT / "fuzz"
#: Limits of one input of the engine: seconds, mebibytes of memory, mebibytes of one allocation, bytes of the input.
LIMITS = {"timeout": 20, "rss_limit_mb": 2048, "malloc_limit_mb": 1024, "max_len": 4096, "len_control": 0}
#: Bytes of a packed corpus.
PACKED = 100_000
#: A fuzzer that has found so much is stopped.
MOST_FINDINGS = 20
#: Files here that are no fuzzers.
NO_FUZZERS = {"fuzzers", "reports", "seeds", "test_fuzzers"}


@dataclass
class Tried:
    """The result of a fuzzer."""

    name: str
    inputs: int = 0
    seconds: float = 0.0
    cpu: float = 0.0
    findings: list[str] = field(default_factory=list)


def engine_targets() -> list[str]:
    """The targets of cargo-fuzz."""
    return [binary["name"] for binary in tomllib.loads((ENGINE / "Cargo.toml").read_text())["bin"]]


def python_targets() -> list[str]:
    """The fuzzers in Python."""
    here = Path(__file__).parent
    return sorted(
        path.stem
        for path in here.glob("*.py")
        if path.stem not in ("fuzzers", "reports", "seeds", "test_fuzzers")
    )


def toolchain() -> list[str]:
    """The toolchain and the sanitizer: nightly has one, stable builds without."""
    nightly = subprocess.run(["cargo", "+nightly", "--version"], capture_output=True).returncode == 0
    return ["+nightly", "address"] if nightly else ["+stable", "none"]


def build() -> None:
    """Builds every target."""
    chain, sanitizer = toolchain()
    print(f"building by the toolchain {chain[1:]}, sanitizer: {sanitizer}", flush=True)
    subprocess.run(["cargo", chain, "fuzz", "build", "--sanitizer", sanitizer], cwd=ROOT, check=True)


def program(target: str) -> str:
    """The program of a target; cargo-fuzz builds it in a folder that is named by the machine."""
    programs = sorted(ENGINE.glob(f"target/*/release/{target}"))
    if not programs:
        raise SystemExit(f"`cargo fuzz build` made no program {target}")
    return str(programs[0])


def unpacked(target: str) -> Path:
    """The folder of a target's corpus, with what the repository has of it."""
    folder = ENGINE / "corpus" / target
    folder.mkdir(parents=True, exist_ok=True)
    packed = ENGINE / "corpora" / f"{target}.zip"
    if packed.exists():
        with zipfile.ZipFile(packed) as archive:
            for name in archive.namelist():
                (folder / Path(name).name).write_bytes(archive.read(name))
    return folder


def run_engine(target: str, seconds: float, job: int) -> Tried:
    """One target of cargo-fuzz. It goes on after a finding, until the time is over."""
    tried, began = Tried(target), time.monotonic()
    artifacts = ENGINE / "artifacts" / target
    artifacts.mkdir(parents=True, exist_ok=True)
    before = set(artifacts.glob(f"{job}-*"))
    flags = [f"-{name}={value}" for name, value in LIMITS.items()]
    # Running out of memory or time is a finding as well, and ends a process; another one goes on.
    while (left := seconds - (time.monotonic() - began)) > 1 and len(tried.findings) < MOST_FINDINGS:
        command = [program(target), str(ENGINE / "corpus" / target), *flags, f"-max_total_time={left:.0f}"]
        command += ["-print_final_stats=1", "-reload=1", f"-artifact_prefix={artifacts}/{job}-"]
        done = subprocess.run(
            command, cwd=ROOT, env=environment(), capture_output=True, text=True, errors="replace"
        )
        counts = re.findall(r"stat::number_of_executed_units:\s*(\d+)", done.stderr)
        tried.inputs += int(counts[-1]) if counts else 0
        new = set(artifacts.glob(f"{job}-*")) - before
        before |= new
        tried.findings += [f"{path.relative_to(ROOT)}: {reason(done.stderr)}" for path in new]
        if done.returncode and not new:
            tried.findings.append(f"{target} ended with {done.returncode}: {done.stderr[-2000:]}")
            break
        if not done.returncode:
            break
    return tried


def reason(log: str) -> str:
    """The line that says what happened."""
    for pattern in (r"panicked at .*\n.*", r"ERROR: .*", r"ALARM: .*", r"SUMMARY: .*"):
        if match := re.search(pattern, log):
            return " ".join(match[0].split())[:300]
    return log.strip().splitlines()[-1][:300] if log.strip() else "no message"


def environment() -> dict[str, str]:
    """One thread for each fuzzer; no sanitizer for the leaks of a process that is killed."""
    return os.environ | {"RAYON_NUM_THREADS": "1", "ASAN_OPTIONS": "detect_leaks=0", "RUST_BACKTRACE": "1"}


def run_python(name: str, seconds: float, _job: int) -> Tried:
    """One fuzzer in Python, from a seed of its own."""
    tried = Tried(name)
    command = [sys.executable, str(Path(__file__).with_name(f"{name}.py")), f"{seconds:.0f}"]
    command.append(str(secrets.randbelow(2**31)))
    done = subprocess.run(command, cwd=ROOT, env=environment(), stdout=subprocess.PIPE, text=True)
    try:
        last = json.loads(done.stdout.strip().splitlines()[-1])
        tried.inputs, tried.findings = last["inputs"], last["findings"]
    except (IndexError, ValueError):
        tried.findings = [f"{name} ended with {done.returncode}: {done.stdout[-500:]}"]
    return tried


def together(run: Callable[[str, float, int], Tried], name: str, seconds: float, jobs: int) -> Tried:
    """A fuzzer, run by several processes at once; of the engine they share a corpus."""
    all_of_them, began, before = Tried(name), time.monotonic(), cpu()
    with ThreadPoolExecutor(jobs) as pool:
        for tried in pool.map(lambda job: run(name, seconds, job), range(jobs)):
            all_of_them.inputs += tried.inputs
            all_of_them.findings += tried.findings
    all_of_them.seconds, all_of_them.cpu = time.monotonic() - began, cpu() - before
    return all_of_them


def pack(target: str) -> None:
    """The smallest inputs that reach what the corpus reaches, into the repository."""
    files = unpacked(target)
    least = files.with_name(f"{target}.least")
    shutil.rmtree(least, ignore_errors=True)
    least.mkdir()
    merge = [program(target), "-merge=1", str(least), str(files)]
    subprocess.run(merge, cwd=ROOT, env=environment(), check=True, stderr=subprocess.DEVNULL)
    zipped(target, least)
    shutil.rmtree(files)
    least.rename(files)


def zipped(target: str, folder: Path) -> None:
    """The inputs of a folder in one file, the smallest first, as many as fit."""
    packed = ENGINE / "corpora" / f"{target}.zip"
    packed.parent.mkdir(exist_ok=True)
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path in sorted(folder.iterdir(), key=lambda path: (path.stat().st_size, path.name)):
            # The list at the end of an archive has an entry of about 70 bytes for each file.
            if archive.start_dir + 70 * len(archive.namelist()) > PACKED - 5000:
                break
            # The same inputs give the same bytes.
            entry = zipfile.ZipInfo(path.name[:12], (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, path.read_bytes())
    print(f"{packed.relative_to(ROOT)}: {packed.stat().st_size} bytes")


def cpu() -> float:
    """Seconds of processors that ended children took: on a machine that others use, less than the time that passed."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def row(name: str, inputs: int, seconds: float, of_cpu: float, findings: int) -> str:
    """A row of the table."""
    return f"{name:<16} {inputs:>12,} {seconds:>8.0f} {of_cpu:>8.0f} {findings:>8}"


def main() -> int:
    """Runs what the command line names."""
    parser = argparse.ArgumentParser(description="Runs the fuzzers.")
    parser.add_argument("--minutes", type=float, default=10.0, help="for each of them")
    parser.add_argument("--jobs", type=int, default=1, help="processes of each of them")
    parser.add_argument("--only", nargs="*", default=[], help="their names")
    parser.add_argument("--corpora", action="store_true", help="pack the corpora instead")
    chosen = parser.parse_args()
    engine, python = engine_targets(), python_targets()
    if unknown := set(chosen.only) - {*engine, *python}:
        parser.error(f"no fuzzer {', '.join(sorted(unknown))}; there are {', '.join(engine + python)}")
    engine = [name for name in engine if not chosen.only or name in chosen.only]
    python = [name for name in python if not chosen.only or name in chosen.only]
    if engine:
        if shutil.which("cargo-fuzz") is None:
            print("no cargo-fuzz; install it: cargo install cargo-fuzz --locked", file=sys.stderr)
            return 2
        build()
    if chosen.corpora:
        for name in engine:
            pack(name)
        return 0
    tried = []
    print(f"{'fuzzer':<16} {'inputs':>12} {'seconds':>8} {'of CPU':>8} {'findings':>8}", flush=True)
    for name in engine + python:
        if name in engine:
            unpacked(name)
        run = run_engine if name in engine else run_python
        result = together(run, name, 60 * chosen.minutes, chosen.jobs)
        print(row(result.name, result.inputs, result.seconds, result.cpu, len(result.findings)), flush=True)
        for finding in result.findings:
            print(f"    {finding}", flush=True)
        tried.append(result)
    inputs, findings = sum(result.inputs for result in tried), sum(len(result.findings) for result in tried)
    print(
        row(
            "all",
            inputs,
            sum(result.seconds for result in tried),
            sum(result.cpu for result in tried),
            findings,
        )
    )
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
