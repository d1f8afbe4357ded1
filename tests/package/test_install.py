"""The wheel in empty environments, without a toolchain: it grows the spaceship, and its extras install what they name.

The sdist builds a wheel in a folder of its own, which imports.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tarfile
from pathlib import Path

import pytest
from environments import ROOT, Environment, pythons
from niwaki.errors.extras import EXTRAS

#: Large, and tested by `make cluster`.
LARGE = {"cluster"}


@pytest.mark.parametrize("python", pythons().values(), ids=pythons())
def test_the_wheel_grows_the_spaceship(python: str, wheel: Path, tmp_path: Path) -> None:
    empty = Environment(python, tmp_path)
    empty.install("--require-hashes", "-r", ROOT / "requirements" / "core.txt")
    empty.install("--no-deps", "--no-index", wheel)
    output = empty.run("niwaki", "grow", "spaceship", "--seed", "1", "-o", "out")
    assert "covered" in output
    assert {"best.glb", "best.png", "run.json"} <= {file.name for file in (tmp_path / "out").iterdir()}
    assert all(file.stat().st_size for file in (tmp_path / "out").iterdir())
    report = json.loads(empty.run("niwaki", "doctor", "--json"))
    assert report["works"] and not any("starlette" == name for name in report["versions"])
    assert all(extra["missing"] for extra in report["extras"])
    where = empty.run("python", "-c", "import niwaki; print(niwaki.__file__)")
    assert where.startswith(str(tmp_path))


def test_the_extras_install_what_they_name(wheel: Path, tmp_path: Path) -> None:
    named = sorted(set(EXTRAS) - LARGE)
    empty = Environment(sys.executable, tmp_path)
    empty.install(f"{wheel}[{','.join(named)}]")
    report = json.loads(empty.run("niwaki", "doctor", "--json"))
    assert report["works"]
    assert {extra["name"] for extra in report["extras"] if not extra["missing"]} >= set(named)
    libraries = "anywidget, arviz, resvg_py, pyarrow.parquet, manifold3d, mujoco, scipy.sparse, shapely"
    # The studio needs POSIX limits of resources.
    served = "starlette, uvicorn, watchfiles, websockets" if os.name == "nt" else "niwaki.studio.serving"
    empty.run("python", "-W", "ignore", "-c", f"import {libraries}, ezdxf, rectpack, {served}")


def test_the_sdist_builds_a_wheel_in_a_clean_folder(sdist: Path, tmp_path: Path) -> None:
    with tarfile.open(sdist) as archive:
        archive.extractall(tmp_path, filter="data")
    (folder,) = tmp_path.iterdir()
    # A build of its own: in the checkout's, cargo would take these crates for those of the checkout. What an earlier
    # run left is older than the files, and is compiled again; only crates from elsewhere stay.
    for file in folder.rglob("*"):
        os.utime(file)
    target = str(ROOT / "target" / "sdist")
    maturin = Path(sys.executable).with_name("maturin")
    command = [maturin, "build", "--release", "--locked", "--out", tmp_path / "built"]
    subprocess.run(command, cwd=folder, check=True, env={**os.environ, "CARGO_TARGET_DIR": target})
    (wheel,) = (tmp_path / "built").iterdir()
    empty = Environment(sys.executable, tmp_path)
    empty.install("--require-hashes", "-r", ROOT / "requirements" / "core.txt")
    empty.install("--no-deps", "--no-index", wheel)
    assert json.loads(empty.run("niwaki", "doctor", "--json"))["works"]
