"""Claim: each snippet of the manual can be run, what is left out has a reason, and a broken one is reported.

All pages are run when the manual is built (`make docs`); those here take a second each.
"""

from __future__ import annotations

from pathlib import Path

import pytest
import snippets
from sybil.evaluators.skip import Skipper

QUICK = [
    "guide/garden-paths",
    "guide/holding",
    "guide/language",
    "guide/troubleshooting",
    "guide/writing-a-model",
    "ideas/choices",
    "ideas/scores",
    "tutorials/from-nodes",
    "tutorials/from-probabilistic-programs",
]


def named(name: str) -> Path:
    return snippets.DOCS / f"{name}.md"


@pytest.mark.parametrize("name", QUICK)
def test_a_quick_page_runs(name: str, tmp_path: Path) -> None:
    report = snippets.run_apart(named(name), tmp_path)
    assert report.failed == [] and report.ran > 0


@pytest.mark.parametrize("page", snippets.pages(), ids=snippets.name)
def test_blocks_are_read(page: Path) -> None:
    """Marks fit their blocks, Python compiles, and commands are ones that are run here, or are skipped."""
    skips = False
    for example in snippets.document(page).examples():
        if isinstance(example.region.evaluator, Skipper):
            action, reason = example.region.parsed
            assert action == "next" and reason, f"line {example.line}: a skip says why"
            skips = True
            continue
        if example.region.evaluator is snippets.run_python:
            compile(str(example.parsed), str(page), "exec")
        elif example.region.evaluator is snippets.run_shell and not skips:
            for line in snippets.commands(example.parsed):
                program = next(word for word in line.split() if "=" not in word)
                assert program in (*snippets.RUN, "pip", "make"), f"line {example.line}: {line}"
        skips = False


def reported(text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> snippets.Report:
    monkeypatch.setattr(snippets, "DOCS", tmp_path)
    monkeypatch.setattr(snippets, "ROOT", tmp_path)
    page = tmp_path / "page.md"
    page.write_text(text)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.path", list(__import__("sys").path))
    return snippets.run(page, tmp_path / "made")


def test_a_broken_snippet_is_reported_with_its_line(tmp_path, monkeypatch):
    text = "# A page\n\n```python\nx = 1\n```\n\n```python\ny = 2\nassert x == y\n```\n"
    report = reported(text, tmp_path, monkeypatch)
    assert report.ran == 1
    (failed,) = report.failed
    assert failed.startswith("page.md:7\n") and "line 9" in failed


def test_a_command_that_fails_is_reported(tmp_path, monkeypatch):
    report = reported('```console\npython -c "raise SystemExit(3)"\nrm -rf x\n```\n', tmp_path, monkeypatch)
    assert report.ran == 0 and "ended with 3" in report.failed[0]
    report = reported("```console\nrm -rf x\n```\n", tmp_path, monkeypatch)
    assert "not a command that is run here" in report.failed[0]


def test_files_shorter_blocks_and_reasons(tmp_path, monkeypatch):
    text = """<!--- file: a.txt -->
<!--- less: 250 => 5 -->
```toml
seeds = 250
```

<!--- invisible-code-block: python
from pathlib import Path

found = Path("a.txt").read_text()
-->

<!--- skip: next "it takes a day" -->
```python
raise ValueError
```

```python
assert found == "seeds = 5\\n"
```
"""
    report = reported(text, tmp_path, monkeypatch)
    assert report.failed == [] and report.ran == 3
    (skipped,) = report.skipped
    assert skipped.startswith("page.md:") and skipped.endswith("it takes a day")


def test_a_shorter_block_must_have_the_words(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("<!--- less: 250 => 5 -->\n```python\nx = 25\n```\n")
    with pytest.raises(AssertionError, match="does not have `250`"):
        snippets.document(page)
