"""Run every snippet of the manual: the pages stay plain Markdown, and what they save is their pictures.

    python docs/running/snippets.py docs/made            # all pages, each in a folder of its own, on all processors
    python docs/running/snippets.py docs/made tutorials  # the pages with `tutorials` in their names

A page is a program that is read from the top, in a process and a folder of its own (Sybil finds its blocks):

- a `python` block is run, in the names of the blocks before it;
- a line of a `console` block is run where it starts with `niwaki` or `python`. Of `pip install 'niwaki[extra]'` the
  extras must be there, and of `make target` the target;
- `<!--- file: NAME -->` before a block of any language writes the block into that file;
- `<!--- less: 250 => 5 -->` before a block: it is run with these words replaced, so that a page takes seconds
  (`<!--- less: words => -->`: without them);
- `<!--- invisible-code-block: python` and `console` hold what a page needs and a reader does not;
- `<!--- skip: next "why" -->` leaves out the next block. The reason is listed.

A page that saves `tower.png` shows it as `../made/PAGE/tower.png`.
"""

from __future__ import annotations

import importlib.util
import json
import linecache
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
import tomllib
import traceback
import warnings
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from unittest import SkipTest

from sybil import Document, Example, Region
from sybil.parsers.markdown import SkipParser
from sybil.parsers.markdown.lexers import DirectiveInHTMLCommentLexer, FencedCodeBlockLexer
from sybil.region import Lexeme
from sybil.typing import Evaluator

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
SECONDS = 600  # of a page, where other work is done beside it

MARKS = re.compile(r"(?:<!---+ (?:file|less): .*? -->\s*)+\Z")
MARK = re.compile(r"<!---+ (file|less): (.*?) -->")
RUN = ("niwaki", "python", "timeout")


@dataclass
class Report:
    """Counts, times and failures of the blocks of a page."""

    page: str
    ran: int = 0
    skipped: list[str] = field(default_factory=list)
    failed: list[str] = field(default_factory=list)
    seconds: float = 0.0
    slowest: tuple[float, int] = (0.0, 0)


def pages() -> list[Path]:
    """The pages that a person wrote."""
    return sorted(
        path
        for path in DOCS.rglob("*.md")
        if path.relative_to(DOCS).parts[0] not in ("_build", "made", "errors")
    )


def name(page: Path) -> str:
    """A page's name, as `guide/files`: its folder below that of all pages."""
    return page.relative_to(DOCS).with_suffix("").as_posix()


def document(page: Path) -> Document:
    """A page with its blocks."""
    return Document.parse(str(page), blocks, SkipParser())


def blocks(text: Document) -> Iterable[Region]:
    """The blocks of a page that are run or written."""
    shown = FencedCodeBlockLexer(r"[a-z]+", mapping={"language": "arguments", "source": "source"})
    hidden = DirectiveInHTMLCommentLexer(directive="invisible-code-block", arguments="[a-z]+")
    for region in (*shown(text), *hidden(text)):
        language = region.lexemes["arguments"]
        before = MARKS.search(text.text[: region.start])
        marks = MARK.findall(before[0]) if before else []
        region.parsed = shortened(
            region.lexemes["source"], [words for kind, words in marks if kind == "less"]
        )
        named = [words for kind, words in marks if kind == "file"]
        if named:
            region.evaluator = writer(named[0])
        elif language == "python":
            region.evaluator = run_python
        elif language == "console":
            region.evaluator = run_shell
        else:
            continue
        yield region


def shortened(source: Lexeme, marks: list[str]) -> Lexeme:
    """A block with the words replaced that would take long."""
    text = str(source)
    for mark in marks:
        long, _, short = f"{mark} ".partition(" => ")
        assert long in text, f"`less: {mark}`: the next block does not have `{long}`"
        text = text.replace(long, short.strip())
    return Lexeme(text, source.offset, source.line_offset)


def writer(file: str) -> Evaluator:
    """Return the evaluator of a block that is a file."""

    def write(example: Example) -> None:
        Path(file).parent.mkdir(parents=True, exist_ok=True)
        Path(file).write_text(example.parsed, encoding="utf-8")

    return write


def run_python(example: Example) -> None:
    """A block of Python; messages point at its lines of the page."""
    source = "\n" * (example.line + example.parsed.line_offset) + example.parsed
    place = f"{example.path}:{example.line}"
    # A file without a time stays in the cache: models read their own source.
    linecache.cache[place] = (len(source), None, source.splitlines(keepends=True), place)
    exec(compile(source, place, "exec", dont_inherit=True), example.namespace)


def run_shell(example: Example) -> None:
    """The lines of a console block that are ours; each must end well."""
    for line in commands(example.parsed):
        words = shlex.split(line, comments=True)
        program = next((word for word in words if "=" not in word), "")
        if program == "pip":
            known(line, re.findall(r"niwaki\[([\w,-]+)\]", line), extras())
        elif program == "make":
            known(line, [word for word in words[1:] if "=" not in word], targets())
        elif program in RUN:
            done = subprocess.run(
                ["bash", "-euo", "pipefail", "-c", line], capture_output=True, text=True, timeout=SECONDS
            )
            if done.returncode:
                raise AssertionError(f"{line}\nended with {done.returncode}\n{done.stdout}{done.stderr}")
        else:
            raise AssertionError(f"{line}\nis not a command that is run here: skip it, and say why")


def commands(text: str) -> Iterator[str]:
    """Lines of a console block, without prompts and comments, put together where one ends with a backslash."""
    for line in text.replace("\\\n", " ").splitlines():
        line = line.removeprefix("$ ").strip()
        if line and not line.startswith("#"):
            yield line


def known(line: str, words: list[str], all_of_them: set[str]) -> None:
    """Refuse a word that does not exist."""
    missing = [part for word in words for part in word.split(",") if part not in all_of_them]
    assert not missing, f"{line}\nnames {', '.join(missing)}, which is not there"


def extras() -> set[str]:
    """The extras of the package."""
    return set(tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"])


def targets() -> set[str]:
    """The targets of the Makefile."""
    return set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))


def installed(package: str) -> bool:
    """Whether an optional package is there: for `skip: next if(...)`."""
    return importlib.util.find_spec(package) is not None


def run(page: Path, folder: Path) -> Report:
    """Run the blocks of a page in a folder, in this process."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    os.chdir(folder)
    sys.path[:0] = [str(folder), str(ROOT / "benches")]
    warnings.simplefilter("error")
    report, start = Report(name(page)), time.perf_counter()
    parsed = document(page)
    parsed.namespace.update(__name__="__main__", installed=installed)
    for example in parsed.examples():
        began = time.perf_counter()
        try:
            example.evaluate()
        except SkipTest as reason:
            report.skipped.append(f"{page.relative_to(ROOT)}:{example.line}: {reason}")
        except BaseException:
            trace = traceback.format_exc(limit=-3)
            report.failed.append(f"{page.relative_to(ROOT)}:{example.line}\n{trace}")
        else:
            report.ran += not isinstance(example.region.evaluator, type(SkipParser().skipper))
        report.slowest = max(report.slowest, (time.perf_counter() - began, example.line))
    report.seconds = time.perf_counter() - start
    return report


def run_apart(page: Path, out: Path) -> Report:
    """Run a page in a process of its own; what it prints goes into `printed.txt`."""
    folder = out / name(page)
    environment = {**os.environ, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    command = [sys.executable, __file__, "--one", str(page), str(folder)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return Report(
            name(page), failed=[f"{page.relative_to(ROOT)}: more than {SECONDS} s"], seconds=SECONDS
        )
    printed, _, last = done.stdout.rpartition("\x1e")
    if done.returncode or not last.strip():
        return Report(name(page), failed=[f"{page.relative_to(ROOT)}\n{done.stdout}{done.stderr}"])
    (folder / "printed.txt").write_text(printed, encoding="utf-8")
    return Report(**json.loads(last))


def main(out: Path, words: list[str]) -> int:
    """Run the pages; the number of those that failed."""
    chosen = [page for page in pages() if not words or any(word in name(page) for word in words)]
    with ThreadPoolExecutor(int(os.environ.get("NIWAKI_JOBS", os.cpu_count() or 1))) as pool:
        reports = list(pool.map(lambda page: run_apart(page, out), chosen))
    for report in reports:
        seconds, line = report.slowest
        most = f", {seconds:.1f} s of them in line {line}" if seconds > 5.0 else ""
        print(
            f"{report.seconds:6.1f} s  {report.ran:3} blocks  {len(report.skipped):2} skipped  {report.page}{most}"
        )
    for line in (line for report in reports for line in report.skipped):
        print("skipped", line)
    for failed in (failed for report in reports for failed in report.failed):
        print(f"\nfailed: {failed}")
    broken = sum(bool(report.failed) for report in reports)
    print(f"{sum(report.ran for report in reports)} blocks ran; {broken} of {len(reports)} pages failed")
    return broken


if __name__ == "__main__":
    if sys.argv[1] == "--one":
        report = run(Path(sys.argv[2]), Path(sys.argv[3]))
        print("\x1e" + json.dumps(report.__dict__))
    else:
        sys.exit(main(Path(sys.argv[1]).resolve(), sys.argv[2:]) > 0)
