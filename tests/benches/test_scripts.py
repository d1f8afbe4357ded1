"""Claim: each script of the benches can be loaded with the package as it is, and the benches' page names it."""

from __future__ import annotations

import runpy
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

BENCHES = Path(__file__).resolve().parents[2] / "benches"
SCRIPTS = sorted(path for path in BENCHES.glob("*.py") if "__main__" in path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_a_script_can_be_loaded(script):
    loaded = set(sys.modules)
    try:
        runpy.run_path(str(script), run_name="loaded")
    except ModuleNotFoundError as missing:
        # What only a bench's own extra installs is absent here; what is ours is never.
        name = (missing.name or "").partition(".")[0]
        if name == "niwaki" or find_spec(name) is not None or (BENCHES / f"{name}.py").exists():
            raise
        pytest.skip(f"{name} is not installed")
    finally:
        for name in set(sys.modules) - loaded:
            if str(getattr(sys.modules[name], "__file__", None)).startswith(str(BENCHES)):
                del sys.modules[name]


def test_the_page_names_each_script():
    page = (BENCHES / "README.md").read_text(encoding="utf-8")
    assert {path.name for path in SCRIPTS if f"`{path.name}`" not in page} == set()
