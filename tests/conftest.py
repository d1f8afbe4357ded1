"""Settings of all tests: `--update-golden` writes the golden files again, for a person to read the difference."""

from __future__ import annotations

import compileall
import os
import signal
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import niwaki
import pytest
from niwaki.errors import NiwakiError

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    # A shell's background jobs ignore Ctrl-C, and tests that press it would wait for ever.
    signal.signal(signal.SIGINT, signal.default_int_handler)


# Tests are about what is around a search, and searches are short, also in processes that tests start.
os.environ.setdefault("NIWAKI_ROUNDS", "15")


def pytest_configure(config: pytest.Config) -> None:
    # Tests start hundreds of processes. Where the environment forbids Python to write bytecode, each would compile the
    # package again.
    if not hasattr(config, "workerinput"):
        compileall.compile_dir(Path(niwaki.__file__).parent, quiet=2)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--update-golden", action="store_true", help="write the golden files again")


@pytest.fixture
def golden(request: pytest.FixtureRequest):
    """A function that compares a text with a file, or writes the file."""

    def check(path: Path, text: str) -> None:
        if request.config.getoption("--update-golden"):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        assert path.exists(), f"no golden file {path.name}; run with --update-golden"
        assert text == path.read_text()

    return check


@pytest.fixture
def reviewed(golden: Callable[[Path, str], None]) -> Callable[[Path, Mapping[str, Callable[[], Any]]], None]:
    """A function that compares the errors of calls that must fail, each under its name, with a file."""

    def check(path: Path, failing: Mapping[str, Callable[[], Any]]) -> None:
        lines = []
        for title, fails in failing.items():
            with pytest.raises(NiwakiError) as error:
                fails()
            lines.append(f"# {title}\n{error.value}")
        golden(path, "\n\n".join(lines) + "\n")

    return check
