"""The page goes with the package: in every wheel."""

from __future__ import annotations

import subprocess
import sys
import tomllib
import zipfile
from fnmatch import fnmatch
from pathlib import Path

import pytest

pytest.importorskip("starlette")

from niwaki.studio import server

REPOSITORY = Path(__file__).parents[3]
FILES = [f"niwaki/studio/page/{name}" for name in set(server.PAGE.values())]


def test_the_files_of_the_page_are_named_to_the_packager():
    settings = tomllib.loads((REPOSITORY / "pyproject.toml").read_text())["tool"]["maturin"]
    patterns = [one["path"] for one in settings["include"] if set(one["format"]) == {"sdist", "wheel"}]
    for name in FILES:
        assert (REPOSITORY / "python" / name).is_file()
        assert any(fnmatch(f"python/{name}", one) for one in patterns), name


@pytest.mark.soak
def test_a_wheel_has_the_page(tmp_path):
    command = [
        sys.executable,
        "-m",
        "pip",
        "wheel",
        "--no-deps",
        "--wheel-dir",
        str(tmp_path),
        str(REPOSITORY),
    ]
    subprocess.run(command, check=True, capture_output=True)
    with zipfile.ZipFile(next(tmp_path.glob("*.whl"))) as wheel:
        assert set(FILES) <= set(wheel.namelist())
