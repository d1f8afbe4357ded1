"""The committed page equals a build of its sources; compared if node and the page's packages are installed."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[3]
SOURCES = REPOSITORY / "studio" / "page"
BUILT = REPOSITORY / "python" / "niwaki" / "studio" / "page"


def test_the_page_is_built_from_its_sources(tmp_path):
    if shutil.which("node") is None or not (SOURCES / "node_modules" / "esbuild").is_dir():
        pytest.skip("no node, or its packages are not installed: `make studio-page` installs them")
    subprocess.run(["node", "build.mjs", str(tmp_path)], cwd=SOURCES, check=True, capture_output=True)
    names = sorted(path.name for path in BUILT.iterdir())
    assert names == sorted(path.name for path in tmp_path.iterdir())
    for name in names:
        assert (tmp_path / name).read_bytes() == (BUILT / name).read_bytes(), (
            f"{name}: run `make studio-page`"
        )


def test_the_page_has_no_external_resources():
    text = (BUILT / "index.html").read_text() + (BUILT / "app.css").read_text()
    assert "http" not in text and "//" not in text.replace("/*", "").replace("*/", "")


def test_three_js_is_in_the_page_once():
    scripts = {name: (BUILT / name).read_text() for name in ("app.js", "view.js")}
    assert [name for name, text in scripts.items() if "Three.js Authors" in text] == ["view.js"]
    assert '"/view.js"' in scripts["app.js"]
